//! What must not change the figures: turning, moving, reversing, mirroring, scaling, finer vertices.

mod common;

use common::build::{build, design, line, mirrored, mirrored_design, upside_down};
use common::lines::{Random, crossing_roads, hairpin, islands, road, star, zigzag};
use common::measure::{length, level_length};
use common::oracle::Polyline;
use slopegen::model::{CurveKind, Design, Extent, Side};
use slopegen::surface::Surface;

/// Lines with vertices far enough apart that none is simplified.
struct Fixture {
    name: &'static str,
    lines: Vec<Polyline>,
    design: Design,
}

fn fixtures() -> Vec<Fixture> {
    let random = &mut Random::new(7);
    let k = 0.5;
    let to = |z: f64| Design { interval: Some(1.0), tolerance: 1e-4, ..design(k, Extent::Elevation(z)) };
    let of = |extent: Extent| Design { interval: Some(1.0), tolerance: 1e-4, ..design(k, extent) };
    let fixture = |name, lines, design| Fixture { name, lines, design };
    vec![
        fixture("level ring", vec![star(random, 30, 40.0, 0.0, 0.0, k)], to(-6.3)),
        fixture("wavy ring", vec![star(random, 40, 40.0, 2.0, 0.05, k)], to(-7.7)),
        fixture(
            "both sides of a ring",
            vec![star(random, 25, 30.0, 1.5, 0.02, k)],
            Design { side_of_rings: Side::Both, ..to(-5.1) },
        ),
        fixture(
            "inside of a ring",
            vec![star(random, 25, 30.0, 1.5, 0.02, k)],
            Design { side_of_rings: Side::Inside, ..of(Extent::Distance(5.3)) },
        ),
        fixture("road", vec![road(random, 30, 6.0, false, k)], of(Extent::Height(6.1))),
        fixture(
            "rough road, left",
            vec![road(random, 24, 8.0, true, 0.6 * k)],
            Design { side_of_lines: Side::Left, ..of(Extent::Distance(4.7)) },
        ),
        fixture("hairpin, buried", vec![hairpin(60.0, 8.0, 12, 0.5, k)], to(-4.4)),
        fixture("zig-zag", vec![zigzag(random, 9, 30.0, k)], to(-20.3)),
        fixture("islands", islands(random, 5, true, k), to(-25.6)),
        fixture("crossing roads", crossing_roads(random, 8, 3.0, k), to(-9.9)),
    ]
}

/// Figures that do not depend on where things stand: names and values, with the power of the length unit.
type Figures = Vec<(String, f64, i32)>;

fn figures(surface: &Surface) -> Figures {
    let (a, v) = (&surface.areas, &surface.volumes);
    let mut values: Figures = [
        ("plan area", a.plan, 2),
        ("slope area", a.slope, 2),
        ("fill slope", a.fill_slope, 2),
        ("cut slope", a.cut_slope, 2),
        ("platform", a.platform, 2),
        ("cut", v.cut, 3),
        ("fill", v.fill, 3),
        ("greatest cut", v.cut_max, 1),
        ("greatest fill", v.fill_max, 1),
        ("hinge", length(surface, CurveKind::Hinge), 1),
        ("valleys", length(surface, CurveKind::Valley), 1),
        ("ridges", length(surface, CurveKind::Ridge), 1),
        ("boundary", length(surface, CurveKind::Boundary), 1),
        ("levels", surface.levels.len() as f64, 0),
        ("buried stretches", surface.buried.len() as f64, 0),
    ]
    .map(|(name, value, power)| (name.to_owned(), value, power))
    .to_vec();
    for (i, b) in surface.buried.iter().enumerate() {
        values.push((format!("length of stretch {i}"), b.to - b.from, 1));
        values.push((format!("depth of stretch {i}"), b.depth, 1));
        values.push((format!("free slope of stretch {i}"), b.free_slope.unwrap_or(0.0), 0));
    }
    values
}

/// Lengths of the level curves.
fn levels(surface: &Surface) -> Figures {
    surface.levels.iter().map(|&z| (format!("level {z}"), level_length(surface, z), 1)).collect()
}

/// Compares figures of `found`, lengths scaled by `scale`, to `relative` of the largest figure of the kind.
#[track_caller]
fn same(name: &str, expected: &Figures, found: &Figures, scale: f64, relative: f64) {
    assert_eq!(expected.len(), found.len(), "{name}");
    for ((what, a, power), (_, b, _)) in expected.iter().zip(found) {
        let largest = expected.iter().filter(|v| v.2 == *power).map(|v| v.1.abs()).fold(0.0, f64::max);
        let unit = scale.powi(*power);
        assert!((b / unit - a).abs() <= relative * largest, "{name}: {what} was {a}, is {}", b / unit);
    }
}

/// Builds every fixture before and after `change`, which gives the new lines and design.
fn unchanged(relative: f64, scale: f64, change: impl Fn(&Fixture) -> (Vec<Polyline>, Design)) {
    for fixture in fixtures() {
        let before = build(&line(&fixture.lines), &fixture.design);
        assert_eq!(before.simplified, 0, "{}", fixture.name);
        let (lines, design) = change(&fixture);
        let after = build(&line(&lines), &design);
        same(fixture.name, &figures(&before), &figures(&after), scale, relative);
        same(fixture.name, &levels(&before), &levels(&after), scale, relative);
    }
}

fn each_point(lines: &[Polyline], change: impl Fn([f64; 3]) -> [f64; 3]) -> Vec<Polyline> {
    lines.iter().map(|l| Polyline { points: l.points.iter().map(|&p| change(p)).collect(), closed: l.closed }).collect()
}

/// Rounding of turned coordinates, 1e-14 of 100, against figures of creases between strips a few degrees apart.
#[test]
fn turning() {
    let (sin, cos) = 33_f64.to_radians().sin_cos();
    unchanged(1e-9, 1.0, |f| (each_point(&f.lines, |[x, y, z]| [cos * x - sin * y, sin * x + cos * y, z]), f.design.clone()));
}

/// Far off, coordinates are multiples of 1e-9: about 1e-8 of the height of a crease between strips a few degrees apart.
#[test]
fn moving() {
    unchanged(1e-6, 1.0, |f| (each_point(&f.lines, |[x, y, z]| [x + 500_000.0, y + 5_000_000.0, z]), f.design.clone()));
}

/// Heights are never shifted inside: the same, with another plane and other levels (a whole number of intervals further up).
#[test]
fn lifting() {
    unchanged(1e-9, 1.0, |f| {
        let extent = if let Extent::Elevation(z) = f.design.extent { Extent::Elevation(z + 64.0) } else { f.design.extent };
        (each_point(&f.lines, |[x, y, z]| [x, y, z + 64.0]), Design { extent, ..f.design.clone() })
    });
}

fn other_side(side: Side) -> Side {
    match side {
        Side::Left => Side::Right,
        Side::Right => Side::Left,
        side => side,
    }
}

/// Reversed, left is right. Stretches come in another order: at most one is buried here in each line.
/// Creases between two cones are broken into chords as seen from the first one: 1e-9 of a volume is theirs.
#[test]
fn reversing() {
    for fixture in fixtures() {
        let before = build(&line(&fixture.lines), &fixture.design);
        let reversed = |l: &Polyline| Polyline { points: l.points.iter().rev().copied().collect(), closed: l.closed };
        let lines: Vec<Polyline> = fixture.lines.iter().map(reversed).collect();
        let side_of_lines = other_side(fixture.design.side_of_lines);
        let after = build(&line(&lines), &Design { side_of_lines, ..fixture.design.clone() });
        same(fixture.name, &figures(&before), &figures(&after), 1.0, 1e-8);
    }
}

/// Stations of buried stretches count from the other end of a reversed line.
#[test]
fn reversing_turns_stations_round() {
    let mut seen = 0;
    for fixture in fixtures() {
        let given = line(&fixture.lines);
        let before = build(&given, &fixture.design).buried;
        let mut reversed = given.clone();
        reversed.chains.iter_mut().for_each(|c| c.vertices.reverse());
        let side_of_lines = other_side(fixture.design.side_of_lines);
        let after = build(&reversed, &Design { side_of_lines, ..fixture.design.clone() }).buried;
        for b in before.iter().filter(|b| !given.chains[b.chain].closed()) {
            let [whole, by_whole] =
                [b.chain, b.by_chain].map(|c| given.chains[c].stations().last().copied().expect("never empty"));
            let near = |x: f64, y: f64| (x - y).abs() < 1e-6;
            let turned = after.iter().any(|a| {
                a.chain == b.chain
                    && near(a.from, whole - b.to)
                    && near(a.to, whole - b.from)
                    && a.by_chain == b.by_chain
                    && (a.by_station - (by_whole - b.by_station)).abs() < 1e-3
            });
            assert!(turned, "{}: {b:?} not among {after:?}", fixture.name);
            seen += 1;
        }
    }
    assert!(seen >= 2, "{seen} stretches");
}

#[test]
fn starting_rings_elsewhere() {
    unchanged(1e-9, 1.0, |f| {
        let mut lines = f.lines.clone();
        lines.iter_mut().filter(|l| l.closed).for_each(|l| {
            let third = l.points.len() / 3;
            l.points.rotate_left(third);
        });
        (lines, f.design.clone())
    });
}

/// In the mirror, left is right and sectors are cut from the other end. Lines are taken in an order that their places decide, so
/// in another one there, and creases between two cones are broken into chords as seen from the first one: some 1e-9 of a volume
/// is theirs.
#[test]
fn mirroring_in_plan() {
    for fixture in fixtures() {
        let before = build(&line(&fixture.lines), &fixture.design);
        let lines = each_point(&fixture.lines, |[x, y, z]| [-x, y, z]);
        let side_of_lines = other_side(fixture.design.side_of_lines);
        let after = build(&line(&lines), &Design { side_of_lines, ..fixture.design.clone() });
        same(fixture.name, &figures(&before), &figures(&after), 1.0, 1e-8);
    }
}

/// Upside down the other sheet is the same surface, bit for bit: cut is fill, and ridges are valleys.
#[test]
fn mirroring_in_height_swaps_the_sheets() {
    for fixture in fixtures() {
        let given = line(&fixture.lines);
        let falling = build(&given, &fixture.design);
        let rising = build(&upside_down(&given), &mirrored_design(&fixture.design));
        assert!(rising.areas.cut_slope > 0.0 && rising.areas.fill_slope == 0.0, "{}", fixture.name);
        let mirror = mirrored(rising);
        assert_eq!(falling.tin.vertices, mirror.tin.vertices, "{}", fixture.name);
        assert_eq!(falling.tin.triangles, mirror.tin.triangles, "{}", fixture.name);
        assert_eq!(falling.tin.parts, mirror.tin.parts, "{}", fixture.name);
        assert_eq!(falling.volumes, mirror.volumes, "{}", fixture.name);
        assert_eq!(falling.areas, mirror.areas, "{}", fixture.name);
        assert_eq!(falling.lines, mirror.lines, "{}", fixture.name);
        assert_eq!(falling.buried, mirror.buried, "{}", fixture.name);
        assert_eq!(falling.certificate, mirror.certificate, "{}", fixture.name);
    }
}

/// Larger and smaller, with everything that has a length.
#[test]
fn scaling() {
    for scale in [10.0, 0.25] {
        unchanged(1e-9, scale, |f| {
            let extent = match f.design.extent {
                Extent::Elevation(z) => Extent::Elevation(scale * z),
                Extent::Height(h) => Extent::Height(scale * h),
                Extent::Distance(d) => Extent::Distance(scale * d),
            };
            let tolerance = scale * f.design.tolerance;
            let interval = f.design.interval.map(|i| scale * i);
            let lines = each_point(&f.lines, |p| p.map(|v| scale * v));
            (lines, Design { extent, tolerance, interval, ..f.design.clone() })
        });
    }
}

/// Vertices on straight segments change nothing.
#[test]
fn splitting_segments() {
    for fixture in fixtures() {
        let before = build(&line(&fixture.lines), &fixture.design);
        let split: Vec<Polyline> = fixture.lines.iter().map(in_thirds).collect();
        let added =
            split.iter().map(|l| l.points.len()).sum::<usize>() - fixture.lines.iter().map(|l| l.points.len()).sum::<usize>();
        let after = build(&line(&split), &fixture.design);
        assert_eq!((after.simplified, after.collinear - before.collinear), (0, added), "{}", fixture.name);
        same(fixture.name, &figures(&before), &figures(&after), 1.0, 1e-9);
        same(fixture.name, &levels(&before), &levels(&after), 1.0, 1e-9);
        // They are vertices of the mesh all the same.
        assert!(after.certificate.input_edges_kept, "{}", fixture.name);
        let all: std::collections::HashSet<[u64; 3]> =
            (0..after.tin.vertices.len()).map(|v| after.tin.world(v).to_array().map(f64::to_bits)).collect();
        let kept = |p: &&[f64; 3]| all.contains(&p.map(f64::to_bits));
        let shown = split.iter().flat_map(|l| &l.points).filter(kept).count();
        let given: usize = split.iter().map(|l| l.points.len()).sum();
        if after.buried.is_empty() {
            assert_eq!(shown, given, "{}: given vertices in the mesh", fixture.name);
        }
    }
}

fn in_thirds(line: &Polyline) -> Polyline {
    let mut points: Vec<[f64; 3]> = line
        .segments()
        .flat_map(|(a, b)| [0.0, 1.0 / 3.0, 2.0 / 3.0].map(|w| std::array::from_fn(|i| a[i] + w * (b[i] - a[i]))))
        .collect();
    if !line.closed {
        points.extend(line.points.last());
    }
    Polyline { points, closed: line.closed }
}

/// The two sides of a line make up both, but for the caps at its ends: half discs, of `π/2 ± φ`.
#[test]
fn left_and_right_make_both() {
    let random = &mut Random::new(3);
    let k = 0.5;
    let reach = 4.0;
    for _ in 0..10 {
        let lines = [road(random, 12, 9.0, true, 0.8 * k)];
        let of = |side_of_lines| Design { side_of_lines, tolerance: 1e-4, ..design(k, Extent::Distance(reach)) };
        let [left, right, both] = [Side::Left, Side::Right, Side::Both].map(|side| build(&line(&lines), &of(side)));
        let lean = |a: [f64; 3], b: [f64; 3]| ((b[2] - a[2]) / (b[0] - a[0]).hypot(b[1] - a[1]) / k).asin();
        let p = &lines[0].points;
        let angle = std::f64::consts::TAU - 2.0 * lean(p[0], p[1]) + 2.0 * lean(p[p.len() - 2], p[p.len() - 1]);
        let caps = angle / 2.0 * reach * reach;
        let chords = both.volumes.error_bound / k;
        let apart = both.areas.plan - left.areas.plan - right.areas.plan;
        assert!((apart - caps).abs() <= chords, "{apart} for {caps}");
    }
}
