//! Lines that lie below the slope of another part: stretches, depths and the slope that would free them.

use crate::common::build::{build, design, line, on_both_sheets, open, polygon, rectangle, ring};
use crate::common::measure::{close, height, length, plan_area};
use slopegen::model::{CurveKind, Design, Extent, Part, Side};
use slopegen::surface::{self, SurfaceError};

/// Places on the line: the engine finds entries by crossing straight facets.
const EXACT: f64 = 1e-9;

/// Two legs `d` apart, climbing by `g` there and back, joined by a climb of `c`. At `x` along the lower leg the upper one lies
/// `c·d + 2g(l − x)` higher.
struct Hairpin {
    l: f64,
    d: f64,
    g: f64,
    c: f64,
    k: f64,
}

impl Hairpin {
    fn points(&self) -> [[f64; 3]; 4] {
        let Self { l, d, g, c, .. } = *self;
        [[0.0, 0.0, 0.0], [l, 0.0, g * l], [l, d, g * l + c * d], [0.0, d, 2.0 * g * l + c * d]]
    }

    /// How much higher the line ends than it starts, `d` away.
    fn rise(&self) -> f64 {
        2.0 * self.g * self.l + self.c * self.d
    }
}

/// Nothing is buried as long as the ends keep `Δz < k·d`.
#[test]
fn hairpin_below_the_limit() {
    for slack in [1.0, 0.9, 0.5, 1e-2, 1e-5] {
        let (d, g, c, k) = (10.0, 0.1, 0.2, 0.5);
        let hairpin = Hairpin { l: ((1.0 - slack * 0.5) * k * d - c * d) / (2.0 * g), d, g, c, k };
        let given = line(&[open(&hairpin.points())]);
        on_both_sheets(&given, &design(k, Extent::Elevation(-3.0)), |surface| {
            assert!(surface.buried.is_empty(), "slack {slack}: {:?}", surface.buried);
        });
    }
}

/// Above the limit: from the start of the line, where it is `Δz − k·d` deep, to where the plane of the upper leg meets the lower
/// one: `c·d + 2g(l − x) = d·√(k² − g²)`. Its foot, `d·g/√(k² − g²)` up-grade, must still be on the leg. The slope that frees it
/// is that between the two ends, `Δz/d`: any other pair is further apart or less steep.
#[test]
fn hairpin_above_the_limit() {
    let hairpin = Hairpin { l: 30.0, d: 10.0, g: 0.1, c: 0.2, k: 0.5 };
    let Hairpin { l, d, g, c, k } = hairpin;
    let side = ((k - g) * (k + g)).sqrt();
    let to = l - d * (side - c) / (2.0 * g);
    assert!(to > d * g / side, "the entry lies on the plane of the upper leg");
    on_both_sheets(&line(&[open(&hairpin.points())]), &design(k, Extent::Elevation(-3.0)), |surface| {
        let [stretch] = &surface.buried[..] else { panic!("{:?}", surface.buried) };
        assert_eq!((stretch.chain, stretch.by_chain), (0, 0));
        assert!(stretch.from.abs() < EXACT, "{stretch:?}");
        close(stretch.to, to, EXACT, "entry");
        // The deepest place is searched on samples: exact where it is an end.
        close(stretch.depth, hairpin.rise() - k * d, EXACT, "depth");
        close(stretch.by_station, 2.0 * l + d, EXACT, "foot of the cover");
        close(stretch.free_slope.expect("apart in plan"), hairpin.rise() / d, EXACT, "free slope");
        // There the surface is the upper leg's: a plane that the lower leg does not touch.
        let x = 0.5 * to + 0.5 * d * g / side;
        close(height(surface, x, 0.0).expect("inside"), hairpin.rise() - g * x - d * side, EXACT, "cover");
    });
}

/// The free slope does free it: at a slope a little steeper nothing is buried, at one a little flatter something is.
#[test]
fn the_free_slope_is_the_limit() {
    let hairpin = Hairpin { l: 30.0, d: 10.0, g: 0.1, c: 0.2, k: 0.5 };
    let limit = hairpin.rise() / hairpin.d;
    for (k, count) in [(limit * (1.0 + 1e-6), 0), (limit * (1.0 - 1e-6), 1)] {
        on_both_sheets(&line(&[open(&hairpin.points())]), &design(k, Extent::Elevation(-3.0)), |surface| {
            assert_eq!(surface.buried.len(), count, "slope {k}: {:?}", surface.buried);
        });
    }
}

/// Roads that cross in plan, the upper one `h` higher with gradient `g`, the lower one with gradient `c`. The upper one's planes
/// fall by `√(k² − g²)` a unit aside; along the lower line at the crossing angle 90°: `c·x = h − |x|·√(k² − g²)`.
#[test]
fn crossing_roads() {
    let (a, b, h, k) = (50.0, 40.0, 6.0, 0.5_f64);
    for (g, c) in [(0.0, 0.0), (0.2, 0.0), (0.0, 0.3), (0.25, -0.1)] {
        let given = line(&[open(&[[-a, 0.0, -a * c], [a, 0.0, a * c]]), open(&[[0.0, -b, h - b * g], [0.0, b, h + b * g]])]);
        let side = ((k - g) * (k + g)).sqrt();
        let (from, to) = (-h / (side - c), h / (side + c));
        on_both_sheets(&given, &design(k, Extent::Elevation(-30.0)), |surface| {
            let [stretch] = &surface.buried[..] else { panic!("{g} {c}: {:?}", surface.buried) };
            assert_eq!((stretch.chain, stretch.by_chain, stretch.free_slope), (0, 1, None));
            close(stretch.from, a + from, EXACT, "entry");
            close(stretch.to, a + to, EXACT, "exit");
            // Deepest under the crossing, where the upper line itself passes h higher.
            close(stretch.depth, h, 1e-6, "depth");
            assert!((stretch.by_station - b).abs() < 1e-5 && stretch.at.length() < 1e-5, "{stretch:?}");
            // Both lines show outside of the stretch, and nothing of it.
            let shown = (2.0 * a - (to - from)) * 1.0_f64.hypot(c) + 2.0 * b * 1.0_f64.hypot(g);
            close(length(surface, CurveKind::Hinge), shown, EXACT, "hinge");
            for x in [from - 1.0, to + 1.0] {
                close(height(surface, x, 0.0).expect("inside"), c * x, EXACT, "lower line");
            }
            close(height(surface, 0.0, 1.0).expect("inside"), h + g, EXACT, "upper line");
        });
    }
}

/// Two level pads 4 apart, 5 higher and lower, slope 1:2: the slope of the upper one is 5 − 4/2 = 3 above the lower one's edge.
/// The lower platform would have to be cut out of it; that is refused with both names, never drawn over.
#[test]
fn a_covered_platform_is_refused() {
    let pads = line(&[rectangle([0.0, 0.0, 10.0], 20.0, 20.0), rectangle([24.0, 0.0, 5.0], 20.0, 20.0)]);
    let wanted = Design { side_of_rings: Side::Outside, ..design(0.5, Extent::Elevation(0.0)) };
    match surface::build(&pads, &wanted, None, &()) {
        Err(SurfaceError::PlatformCovered { x, what, .. }) => {
            close(x, 24.0, EXACT, "place of the greatest depth");
            assert!(what.contains("up to 3.000 below"), "{what}");
        }
        other => panic!("{:?}", other.map(|s| s.certificate)),
    }
}

/// A pit in a sharp, tilted triangle. The plane of the side to (−8, 6), length 10, gradient −0.06, passes over the corner at (−6, 6),
/// which lies at s = 8.4 along that side and t = 1.2 beside it: it is `−0.06·8.4 − 1.2·√(k² − 0.06²)` high there, the corner −0.8.
/// They meet at `√(k² − 0.06²) = (0.8 − 0.504)/1.2`. With flatter slopes those of one side would go on outside of the ring.
#[test]
fn slopes_never_leave_the_ring_they_are_inside_of() {
    let triangle = |sign: f64| {
        let [z, w] = [-0.8 * sign, -0.6 * sign];
        line(&[ring(&[[0.0, 0.0, 0.0], [-6.0, 6.0, z], [-8.0, 6.0, w]])])
    };
    let inside = |k, extent| Design { side_of_rings: Side::Inside, ..design(k, extent) };
    let limit = (0.296_f64 / 1.2).hypot(0.06);
    for extent in [Extent::Height(0.2), Extent::Distance(0.5), Extent::Elevation(-5.0)] {
        match surface::build(&triangle(1.0), &inside(0.25, extent), None, &()) {
            Err(SurfaceError::RimCovered { x, y, what, cure }) => {
                close(x, -6.0, EXACT, "place of the greatest depth");
                close(y, 6.0, EXACT, "place of the greatest depth");
                // −0.504 − 1.2·√(0.0625 − 0.0036) = −0.795232, from the tip to the third corner at 6√2 + 2.
                assert_eq!(what, "`line 1` lies up to 0.005 below the slope of `line 1` from station 0.000 to 10.485");
                assert_eq!((cure, (1e3 / limit).floor()), ("use 1V:3.939H or steeper, or blunt the corner".to_owned(), 3939.0));
            }
            other => panic!("{:?}", other.map(|s| s.certificate)),
        }
    }
    let rising = Design { sheet: slopegen::model::Sheet::Rising, ..inside(0.25, Extent::Height(0.2)) };
    match surface::build(&triangle(-1.0), &rising, None, &()) {
        Err(SurfaceError::RimCovered { what, .. }) => assert!(what.contains("up to 0.005 above the slope"), "{what}"),
        other => panic!("{:?}", other.map(|s| s.certificate)),
    }
    // The slope of the cure holds, and slopes and floor fill the triangle: half of |(−6)·6 − (−8)·6| = 6.
    for extent in [Extent::Height(0.05), Extent::Distance(0.2), Extent::Elevation(-5.0)] {
        let built = surface::build(&triangle(1.0), &inside(1.0 / 3.939, extent), None, &()).unwrap();
        close(built.areas.plan, 6.0, EXACT, "plan area");
        assert!(built.buried.is_empty());
    }
}

/// The same with an end above the lowest corner: the floor would hang over the ring, from −0.5 on one side (5/8 of 6√2) to −0.5 on
/// the other (1/6 of the way home from the third corner, at 6√2 + 2).
#[test]
fn a_floor_never_passes_over_its_ring() {
    let triangle = line(&[ring(&[[0.0, 0.0, 0.0], [-6.0, 6.0, -0.8], [-8.0, 6.0, -0.6]])]);
    let wanted = |end| Design { side_of_rings: Side::Inside, ..design(0.5, Extent::Elevation(end)) };
    match surface::build(&triangle, &wanted(-0.5), None, &()) {
        Err(error @ SurfaceError::RimBeyondEnd { x, y, limit, .. }) => {
            assert_eq!((x, y, limit), (-6.0, 6.0, -0.8));
            let [from, to] = [72_f64.sqrt() * 0.625, 72_f64.sqrt() + 2.0 + 10.0 / 6.0];
            let told =
                format!("`line 1` goes down to -0.8 there and lies below the end at -0.5 from station {from:.3} to {to:.3}");
            assert!(error.to_string().contains(&told) && error.to_string().contains("help: end below -0.8"), "{error}");
        }
        other => panic!("{:?}", other.map(|s| s.certificate)),
    }
    let built = surface::build(&triangle, &wanted(-0.81), None, &()).unwrap();
    close(built.areas.plan, 6.0, EXACT, "plan area");
}

/// Pits 3 apart in plan and 10 in height: the slope of the upper one does not go outside of it, but the sheet does. Such rings are
/// built one by one. A hole wholly under the slopes of its own pit is covered: the pit of a square of 30 has the area 900.
#[test]
fn pits_side_by_side_and_covered_holes() {
    let wanted = Design { side_of_rings: Side::Inside, ..design(0.5, Extent::Height(1.0)) };
    let pits = line(&[rectangle([0.0, 0.0, 10.0], 10.0, 10.0), rectangle([13.0, 0.0, 0.0], 10.0, 10.0)]);
    match surface::build(&pits, &wanted, None, &()) {
        Err(SurfaceError::RimCovered { cure, .. }) => assert!(cure.contains("one by one"), "{cure}"),
        other => panic!("{:?}", other.map(|s| s.certificate)),
    }
    let mut hole = rectangle([10.0, 10.0, -9.0], 10.0, 10.0);
    hole.points.reverse();
    let holed = polygon(&[rectangle([0.0, 0.0, 0.0], 30.0, 30.0), hole]);
    let wanted = Design { extent: Extent::Elevation(-10.0), ..wanted };
    let built = surface::build(&holed, &wanted, None, &()).unwrap();
    close(built.areas.plan, 900.0, EXACT, "plan area");
    // A pyramid of 30 · 30 and 7.5 deep.
    close(built.volumes.cut, 900.0 * 7.5 / 3.0, 1e-9 * 2250.0, "volume");
}

/// Level lines across a level one, 8 higher, fall to it `8n` beside them: three stretches of it are covered, and what lies between
/// them shows, however far from its ends.
#[test]
fn what_lies_between_two_covered_stretches_shows() {
    let (k, high) = (0.5, 8.0);
    let across = |x: f64| open(&[[x, -60.0, high], [x, 60.0, high]]);
    for from in [0.0, 45.0] {
        let given = line(&[open(&[[from, 0.0, 0.0], [250.0, 0.0, 0.0]]), across(50.0), across(90.0), across(130.0)]);
        on_both_sheets(&given, &design(k, Extent::Elevation(-10.0)), |surface| {
            let half = high / k;
            let stretches: Vec<[f64; 2]> = surface.buried.iter().map(|b| [b.from + from, b.to + from]).collect();
            assert_eq!(stretches.len(), 3, "{stretches:?}");
            for (stretch, middle) in stretches.iter().zip([50.0, 90.0, 130.0]) {
                close(stretch[0], (middle - half).max(from), EXACT, "entry");
                close(stretch[1], middle + half, EXACT, "exit");
            }
            assert!(surface.notes.is_empty(), "{:?}", surface.notes);
            for x in [70.0, 67.0, 110.0, 113.0, 200.0] {
                close(height(surface, x, 0.0).expect("inside"), 0.0, EXACT, "what shows");
                let beside = [50.0, 90.0, 130.0].map(|a| high - k * (x - a).abs()).into_iter().fold(-1.0, f64::max);
                close(height(surface, x, 2.0).expect("inside"), beside, EXACT, "beside it");
            }
        });
    }
}

/// A stretch that dips below the end of the slope, next to one that is covered there: each is told for what it is.
#[test]
fn beyond_the_end_is_not_covered() {
    // From 0 down to −20 at x = 100; the end at −10 is half way. A level line across at x = 30, 4 above it, at −2.
    let given = line(&[open(&[[0.0, 0.0, 0.0], [100.0, 0.0, -20.0]]), open(&[[30.0, -60.0, -2.0], [30.0, 60.0, -2.0]])]);
    on_both_sheets(&given, &design(0.5, Extent::Elevation(-10.0)), |surface| {
        let [stretch] = &surface.buried[..] else { panic!("{:?}", surface.buried) };
        // −x/5 = −2 − |x − 30|/2 on either side.
        close(stretch.from, 17.0 / 0.7, EXACT, "entry");
        close(stretch.to, 13.0 / 0.3, EXACT, "exit");
        let below = surface.notes.iter().find(|note| note.code == "line-beyond-end").expect("a note");
        assert!(below.message.starts_with("50.000 of the line"), "{}", below.message);
    });
}

/// Lines that run over each other in plan and cross in height: each shows where it is the higher one.
#[test]
fn the_higher_of_two_lines_over_each_other_shows() {
    let given = line(&[open(&[[0.0, 0.0, 0.0], [10.0, 0.0, 0.0]]), open(&[[2.0, 0.0, -1.0], [8.0, 0.0, 1.0]])]);
    on_both_sheets(&given, &design(0.5, Extent::Elevation(-5.0)), |surface| {
        // The last one lies on the cone at the end of the line that rises, which is built of chords.
        for (x, z, bound) in [(1.0, 0.0, EXACT), (4.9, 0.0, EXACT), (5.3, 0.1, EXACT), (7.4, 0.8, EXACT), (9.9, 0.05, 2e-3)] {
            close(height(surface, x, 0.0).expect("inside"), z, bound, "the higher one");
        }
        assert_eq!(surface.buried.len(), 2, "{:?}", surface.buried);
    });
}

/// A line over a platform is no part of it, and its slopes may not pass over it: wherever its middle lies, and at any height. Beside the
/// platform, and along its edge, it may run.
#[test]
fn a_line_over_a_platform_is_refused() {
    let over = [
        [[40.0, 50.0, 1.0], [60.0, 50.0, 1.0]],
        [[40.0, 50.0, 0.0], [60.0, 50.0, 0.0]],
        [[40.0, 50.0, 1.0], [150.0, 50.0, 1.0]],
        // Across the whole of it, its middle beyond; over a corner of it; from a corner; from an edge to the next.
        [[-10.0, 50.0, 2.0], [400.0, 40.0, 2.0]],
        [[-200.0, 205.0, 30.0], [21.0, -16.0, 30.0]],
        [[0.0, 0.0, 0.0], [300.0, 250.0, 60.0]],
        [[0.0, 99.0, 1.0], [1.0, 100.0, 1.0]],
        [[-50.0, 50.0, -20.0], [1.0, 50.0, -20.0]],
    ];
    for ends in over {
        let given = line(&[rectangle([0.0, 0.0, 0.0], 100.0, 100.0), open(&ends)]);
        match surface::build(&given, &design(0.5, Extent::Elevation(-5.0)), None, &()) {
            Err(SurfaceError::LineOnPlatform { name, .. }) => assert_eq!(name, "line 2"),
            other => panic!("{ends:?}: {:?}", other.map(|s| s.certificate)),
        }
    }
    for ends in
        [[[-50.0, -10.0, 0.0], [200.0, -10.0, 0.0]], [[-50.0, 0.0, 0.0], [200.0, 0.0, 0.0]], [[0.0, 0.0, 0.0], [-9.0, -9.0, 0.0]]]
    {
        let given = line(&[rectangle([0.0, 0.0, 0.0], 100.0, 100.0), open(&ends)]);
        let surface = build(&given, &design(0.5, Extent::Elevation(-5.0)));
        close(plan_area(&surface, Part::Platform), 1e4, 1e-9, "platform");
    }
}
