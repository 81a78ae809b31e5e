//! The finished ground as a mesh of its own: whole, sound, the given one away from the works, and worth what the report says.

use crate::clip;
use crate::common::build::rectangle;
use crate::common::oracle;
use crate::random::{pad, road};
use crate::run::{Built, Feature, Folder, Mesh, build};
use crate::site::Site;
use crate::tin::{Cells, Ground, plan_box, twice_area};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::OnceLock;

fn sites() -> Vec<(&'static str, Site)> {
    let far = |site: Site| site.map(|[x, y, z]| [x + 641_000.0, y + 5_203_000.0, z]);
    let island = Ground::grid([[-36.0, -34.0], [36.0, 38.0]], 36, 36, |x, y| if x == 0.0 && y == 14.0 { 5.0 } else { 0.0 });
    let boxes = vec![rectangle([-10.0, -10.0, 4.0], 20.0, 20.0)];
    vec![
        ("road", road(2, 9)),
        ("road far off", far(road(7, 12))),
        ("pad", pad(3, 6, 0.3)),
        ("pad far off", far(pad(5, 8, 0.2))),
        ("island", Site::new(boxes.clone(), 0.5, island)),
        ("two triangles", Site::new(boxes, 0.5, Ground::grid([[-80.0, -70.0], [75.0, 90.0]], 1, 1, |x, y| 0.1 * x - 0.2 * y))),
    ]
}

/// Built once, for all tests.
fn each(check: impl Fn(&str, &Site, &Built)) {
    static BUILT: OnceLock<Vec<(&str, Site, Built)>> = OnceLock::new();
    let all = BUILT.get_or_init(|| {
        let with = |(name, site): (&'static str, Site)| {
            let built = build(&site, "--stations 7.5");
            (name, site, built)
        };
        sites().into_iter().map(with).collect()
    });
    all.iter().for_each(|(name, site, built)| check(name, site, built));
}

/// Digits that two coordinates share or not.
fn bits(p: [f64; 3]) -> [u64; 3] {
    p.map(f64::to_bits)
}

/// Edges without a partner, as pairs of points.
fn rim(mesh: &Mesh) -> BTreeSet<[[u64; 3]; 2]> {
    let edges = mesh.edges();
    let open = edges.keys().filter(|&&[a, b]| !edges.contains_key(&[b, a]));
    open.map(|&[a, b]| [bits(mesh.tin.vertices[a]), bits(mesh.tin.vertices[b])]).collect()
}

/// Triangles as sets of points: the corner that comes first in bits leads.
fn triangles(tin: &Ground) -> BTreeSet<[[u64; 3]; 3]> {
    let key = |t: usize| {
        let mut corners = tin.corners(t).map(bits);
        let least = (0..3).min_by_key(|&i| corners[i]).unwrap_or(0);
        corners.rotate_left(least);
        corners
    };
    (0..tin.triangles.len()).map(key).collect()
}

fn plan([x, y, _]: [f64; 3]) -> robust::Coord<f64> {
    robust::Coord { x, y }
}

/// Every edge has two triangles, one each way, but for those of the given rim. All triangles face up, and cover the ground once.
#[track_caller]
pub(crate) fn watertight(name: &str, site: &Site, built: &Built) {
    let given = Mesh { tin: site.ground.clone(), parts: Vec::new() };
    assert_eq!(rim(&built.finished), rim(&given), "{name}");
    for t in 0..built.finished.tin.triangles.len() {
        let [a, b, c] = built.finished.tin.corners(t);
        // The exact sign: along an edge that two meshes have in common, triangles may be as thin as rounding.
        let turn = robust::orient2d(plan(a), plan(b), plan(c));
        assert!(turn > 0.0, "{name}: triangle {t} {a:?} {b:?} {c:?}");
    }
    let (found, wanted) = (built.finished.tin.plan_area(), site.ground.plan_area());
    assert!((found - wanted).abs() < 1e-9 * wanted, "{name}: {found} for {wanted}");
    let used: BTreeSet<usize> = built.finished.tin.triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), built.finished.tin.vertices.len(), "{name}: vertices without a triangle");
    let distinct: BTreeSet<[u64; 3]> = built.finished.tin.vertices.iter().map(|&v| bits(v)).collect();
    assert_eq!(distinct.len(), built.finished.tin.vertices.len(), "{name}: vertices twice");
}

#[test]
fn is_watertight_and_single_valued() {
    each(watertight);
}

/// Triangles that no triangle of the works touches are those of the file, to the last bit.
#[test]
fn keeps_the_ground_bit_for_bit() {
    each(|name, site, built| {
        let design = Cells::new(&built.design.tin);
        let works = plan_box_of(&built.design.tin);
        let finished = triangles(&built.finished.tin);
        let mut kept = 0;
        for t in 0..site.ground.triangles.len() {
            let corners = site.ground.corners(t);
            let area = plan_box(corners);
            let outside = (0..2).any(|i| area[1][i] < works[0][i] || area[0][i] > works[1][i]);
            let touched = !outside && design.near(area).into_iter().any(|d| touch(built.design.tin.corners(d), corners));
            if !touched {
                kept += 1;
                let only = Ground { vertices: corners.to_vec(), triangles: vec![[0, 1, 2]] };
                assert!(triangles(&only).is_subset(&finished), "{name}: {corners:?}");
            }
        }
        assert!(kept > 50 || site.ground.triangles.len() < 10, "{name}: {kept} triangles");
    });
}

/// Whether two triangles meet in plan: no side of either has the other wholly beyond it.
fn touch(a: [[f64; 3]; 3], b: [[f64; 3]; 3]) -> bool {
    let apart = |p: [[f64; 3]; 3], q: [[f64; 3]; 3]| (0..3).any(|i| q.iter().all(|&v| twice_area(p[i], p[(i + 1) % 3], v) < 0.0));
    !apart(a, b) && !apart(b, a)
}

fn plan_box_of(tin: &Ground) -> crate::tin::Box2 {
    let of = |axis: usize, most: fn(f64, f64) -> f64, start: f64| tin.vertices.iter().map(|v| v[axis]).fold(start, most);
    let lo = [0, 1].map(|axis| of(axis, f64::min, f64::INFINITY));
    [lo, [0, 1].map(|axis| of(axis, f64::max, f64::NEG_INFINITY))]
}

/// The design is what the finished ground has beside ground.
#[test]
fn holds_the_design() {
    each(|name, _, built| {
        let works = built.finished.without("ground");
        assert_eq!(triangles(&works.tin), triangles(&built.design.tin), "{name}");
        assert!(built.design.parts.iter().all(|p| ["platform", "fill_slope", "cut_slope"].contains(&p.as_str())), "{name}");
    });
}

/// The volume between finished and given ground is what the report says.
#[track_caller]
pub(crate) fn worth(name: &str, site: &Site, built: &Built) {
    let (found, common) = clip::between(&built.finished.tin, &site.ground);
    assert!((common - site.ground.plan_area()).abs() < 1e-9 * common, "{name}: {common} in common");
    let wanted = built.figures();
    found.volumes_near(&wanted, 1e-9, name);
    found.areas_near(&wanted, 1e-6, name);
    // The design alone, without the ground about it, says the same.
    clip::between(&built.design.tin, &site.ground).0.volumes_near(&wanted, 1e-9, name);
}

#[test]
fn is_worth_what_the_report_says() {
    each(worth);
}

#[test]
fn areas_are_those_of_the_mesh() {
    each(|name, _, built| {
        for part in ["platform", "fill_slope", "cut_slope"] {
            let of = |t: usize| {
                let [a, b, c] = built.design.tin.corners(t);
                let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
                let cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]];
                0.5 * cross.iter().map(|c| c * c).sum::<f64>().sqrt()
            };
            let mesh = &built.design;
            let found: f64 = (0..mesh.parts.len()).filter(|&t| mesh.parts[t] == part).map(of).sum();
            let wanted = built.number(&format!("surface.{part}_area"));
            assert!((found - wanted).abs() <= 1e-9 * (1.0 + wanted), "{name}: {part} {found} for {wanted}");
        }
    });
}

/// Pieces of the daylight line, cut and fill, join to closed loops, and every point of them lies on the ground, on the mesh of
/// the works, and on the sheet of the formula.
#[test]
fn daylight_is_on_both() {
    each(|name, site, built| {
        let (ground, works) = (Cells::new(&site.ground), Cells::new(&built.design.tin));
        let mut length = 0.0;
        let lines: Vec<_> = built.of_kind("daylight").collect();
        for line in &lines {
            for w in line.points.windows(2) {
                length += (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1]);
            }
            for &[x, y, z] in &line.points {
                let near = |at: Option<f64>, what: &str| {
                    assert!(at.is_some_and(|at| (at - z).abs() < 1e-6), "{name}: ({x}, {y}, {z}) off the {what}, {at:?}");
                };
                near(ground.height(&site.ground, x, y, 1e-6), "ground");
                near(works.height(&built.design.tin, x, y, 1e-6), "works");
                let sheets = [(site.fill_slope, false), (site.cut_slope, true)]
                    .map(|(k, rising)| (oracle::height(&site.lines, k, rising, x, y) - z).abs());
                let off = sheets[0].min(sheets[1]);
                assert!(off < site.tolerance + 1e-6, "{name}: ({x}, {y}, {z}) off the sheets by {off}");
            }
        }
        let wanted = built.number("daylight.length");
        assert!((length - wanted).abs() < 1e-9 * wanted, "{name}: {length} for {wanted}");
        assert_eq!(loops(name, &lines) as f64, built.number("daylight.loops"), "{name}");
    });
}

/// Closed loops that lines join to. Every end must meet an end.
fn loops(name: &str, lines: &[&Feature]) -> usize {
    let mut ends: BTreeMap<[u64; 3], Vec<usize>> = BTreeMap::new();
    for (i, line) in lines.iter().enumerate() {
        for end in [line.points[0], line.points[line.points.len() - 1]] {
            ends.entry(bits(end)).or_default().push(i);
        }
    }
    let mut group: Vec<usize> = (0..lines.len()).collect();
    for (end, met) in &ends {
        assert!(met.len() % 2 == 0, "{name}: an end at {:?} is loose", end.map(f64::from_bits));
        let [from, to] = [met[0], met[met.len() - 1]].map(|i| group[i]);
        group.iter_mut().filter(|g| **g == from).for_each(|g| *g = to);
    }
    group.into_iter().collect::<BTreeSet<_>>().len()
}

#[test]
fn stations_add_up() {
    each(|name, _, built| {
        let stations = built.report["stations"].as_array().unwrap_or_else(|| panic!("{name}: {}", built.report));
        // Platforms of rings have no stations.
        let rows = || stations.iter().chain([&built.report["pads"]].into_iter().filter(|p| !p.is_null()));
        let sum = |key: &str| rows().map(|s| s[key].as_f64().unwrap()).sum::<f64>();
        let wanted = built.figures();
        let earth = wanted.cut + wanted.fill;
        for (key, total) in [("cut", wanted.cut), ("fill", wanted.fill)] {
            assert!((sum(key) - total).abs() <= 1e-9 * earth, "{name}: {key} {} for {total}", sum(key));
            assert!(stations.iter().all(|s| s[key].as_f64().unwrap() >= 0.0), "{name}: {key}");
        }
        let area = wanted.cut_area + wanted.fill_area;
        for (key, total) in [("cut_area", wanted.cut_area), ("fill_area", wanted.fill_area)] {
            assert!((sum(key) - total).abs() <= 1e-9 * area, "{name}: {key} {} for {total}", sum(key));
        }
        let mut net = 0.0;
        let mut at = 0.0;
        for s in stations {
            assert_eq!(s["from"].as_f64().unwrap(), at, "{name}");
            at = s["to"].as_f64().unwrap();
            net += s["cut"].as_f64().unwrap() - s["fill"].as_f64().unwrap();
            let running = s["net_cumulative"].as_f64().unwrap();
            assert!((running - net).abs() <= 1e-9 * earth, "{name}: {running} for {net}");
        }
        let whole = built.number("line.length");
        assert!((at - whole).abs() < 1e-9 * whole && stations.len() == (whole / 7.5).ceil() as usize, "{name}: {at} of {whole}");
    });
}

#[test]
fn certificate_holds() {
    each(|name, site, built| {
        for key in ["paired", "manifold", "input_edges_kept"] {
            assert_eq!(built.report["certificate"][key], true, "{name}: {key}");
        }
        assert_eq!(built.number("certificate.overlaps"), 0.0, "{name}");
        assert!(built.number("certificate.slope_max_deviation_deg") < 0.1, "{name}");
        assert!(built.number("certificate.height_max_deviation") <= site.tolerance, "{name}");
    });
}

/// The finished ground has the slopes asked for: every triangle of a slope, thin ones aside.
#[test]
fn slopes_are_as_asked() {
    each(|name, site, built| {
        for (t, part) in built.design.parts.iter().enumerate() {
            let slope = match part.as_str() {
                "fill_slope" => site.fill_slope,
                "cut_slope" => site.cut_slope,
                _ => continue,
            };
            let [a, b, c] = built.design.tin.corners(t);
            let [u, v] = [b, c].map(|p| [p[0] - a[0], p[1] - a[1], p[2] - a[2]]);
            let area = twice_area(a, b, c);
            let longest = [u, v, [v[0] - u[0], v[1] - u[1], 0.0]].iter().map(|e| e[0].hypot(e[1])).fold(0.0, f64::max);
            // Coordinates far off are multiples of 1e-9, and the ends of daylight chords lie on both surfaces to about as much.
            if area / longest < 1e-3 {
                continue;
            }
            let found = ((u[1] * v[2] - u[2] * v[1]) / area).hypot((u[2] * v[0] - u[0] * v[2]) / area);
            let off = (found.atan() - slope.atan()).to_degrees().abs();
            assert!(off < 0.1, "{name}: triangle {t} is off by {off}°: {a:?} {b:?} {c:?}");
        }
    });
}

/// Heights in the certificate are those of slopes as they are written: by brute force over their corners, and over places inside.
#[test]
fn heights_are_measured_on_what_the_ground_leaves() {
    const INSIDE: usize = 6;
    each(|name, site, built| {
        let told = built.number("certificate.height_max_deviation");
        let design = &built.design;
        let (mut at_corners, mut most, mut count) = (0.0_f64, 0.0_f64, 0);
        for (corners, part) in design.tin.triangles.iter().zip(&design.parts) {
            let (k, rising) = match part.as_str() {
                "fill_slope" => (site.fill_slope, false),
                "cut_slope" => (site.cut_slope, true),
                _ => continue,
            };
            count += 1;
            let corners = corners.map(|v| design.tin.vertices[v]);
            let off = |[x, y, z]: [f64; 3]| (oracle::height(&site.lines, k, rising, x, y) - z).abs();
            at_corners = corners.iter().fold(at_corners, |most, &p| most.max(off(p)));
            for (i, j) in (0..INSIDE).flat_map(|i| (0..INSIDE - i).map(move |j| (i, j))) {
                let [u, v] = [i, j].map(|i| (i as f64 + 1.0 / 3.0) / INSIDE as f64);
                let [a, b, c] = corners;
                most = most.max(off(std::array::from_fn(|n| a[n] + (b[n] - a[n]) * u + (c[n] - a[n]) * v)));
            }
        }
        let rounding = 1e-7;
        // Of more triangles only some are looked at.
        assert!(count > 2048 || told >= at_corners - rounding, "{name}: {told}, at corners {at_corners}");
        // Places are not the same.
        assert!(told <= 1.1 * most.max(at_corners) + rounding, "{name}: {told}, by brute force {most}");
    });
}

/// A pad 4 above level ground, slopes 1:2.
fn above_level_ground() -> Folder {
    let ground = Ground::grid([[-40.0, -40.0], [40.0, 40.0]], 8, 8, |_, _| 0.0);
    Folder::of(&Site::new(vec![rectangle([-10.0, -10.0, 4.0], 20.0, 20.0)], 0.5, ground))
}

const UP_TO: &str = "build line.geojson --terrain ground.obj --slope 1:2 --tolerance 0.01 -o d.obj --report r.json";

/// Slopes that end in the air at an end that was asked for would leave a wall there: told with the end, not with the line.
#[test]
fn no_walls_where_slopes_end() {
    let folder = above_level_ground();
    let run = folder.run(&format!("{UP_TO} --to-elevation 2 --allow-open --finished f.obj"));
    assert_eq!(run.code, 1, "{}", run.stderr);
    for words in
        ["the slopes are still up to 2.000 above or below the ground", "give a later end, or none", "at the end asked for"]
    {
        assert!(run.stderr.contains(words), "{}", run.stderr);
    }
    assert!(!run.stderr.contains("--direction"), "{}", run.stderr);
}

/// An end that was asked for is met within the tolerance, or it is open, with the length of the rim there.
#[test]
fn ends_within_the_tolerance_are_no_open_ends() {
    let folder = above_level_ground();
    let report = || serde_json::from_str::<serde_json::Value>(&folder.read("r.json")).unwrap();
    folder.run(&format!("{UP_TO} --to-elevation 0.009")).done();
    let met = report();
    assert_eq!(met["volumes"]["complete"], true);
    assert_eq!((&met["daylight"]["open_length"], &met["warnings"]), (&serde_json::json!(0.0), &serde_json::json!([])));
    let end = format!("{UP_TO} --to-elevation 0.011");
    let refused = folder.run(&end);
    assert!(refused.code == 1 && refused.stderr.contains("do not meet the ground"), "{}", refused.stderr);
    folder.run(&format!("{end} --allow-open")).done();
    let open = report();
    assert_eq!(open["volumes"]["complete"], false);
    assert_eq!(open["warnings"][0]["code"], "open-ends");
    // Four sides of 20 and the circle of the corners, whose chords are shorter.
    let rim = 80.0 + std::f64::consts::TAU * (4.0 - 0.011) / 0.5;
    let found = open["daylight"]["open_length"].as_f64().unwrap();
    assert!(found <= rim && found > 0.999 * rim, "{found} of {rim}");
}
