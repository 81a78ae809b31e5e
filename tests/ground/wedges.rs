//! Cases without cones: figures to the last digits.

use crate::common::build::{open, rectangle};
use crate::common::oracle::Polyline;
use crate::figures::Figures;
use crate::oracle::sample;
use crate::planar::{self, Tilt};
use crate::run::{Folder, build, options};
use crate::site::Site;
use crate::tin::{Ground, about};

/// Polyhedral figures: rounding of sums of a few hundred terms.
const EXACT: f64 = 1e-9;

/// A dam across a valley with sides `m₁` and `m₂`, `d` deep, whose crest of width `w` ends exactly where it meets the sides, at
/// `x = −d/m₁` and `x = d/m₂`. The ground rises from there, so nothing reaches beyond the ends: no cones. In plan the works are
/// the crest and on each side a triangle over its length, `d/k` deep, with heights that fall from `d` at the bottom of the valley
/// to nought at its three corners: `a = d/m₁ + d/m₂`, fill `w·a·d/2 + 2·(a·d/k/2)·d/3` over an area of `w·a + a·d/k`.
fn dam([m1, m2]: [f64; 2], d: f64, w: f64, k: f64) -> Figures {
    let a = d / m1 + d / m2;
    Figures { cut: 0.0, fill: w * a * d / 2.0 + a * d * d / (3.0 * k), cut_area: 0.0, fill_area: w * a + a * d / k }
}

fn dam_site(sides: [f64; 2], d: f64, w: f64, k: f64, shift: f64) -> Site {
    let [m1, m2] = sides;
    let height = |x: f64| if x < 0.0 { -m1 * x } else { m2 * x };
    // A column of the grid along the bottom of the valley, so that both sides are planes. The shift moves rows off the line.
    let ground = Ground::grid([[-32.0, -24.0 + shift], [32.0, 24.0 + shift]], 16, 12, |x, _| 50.0 + height(x) - d);
    let (from, to) = (-d / m1, d / m2);
    let line = if w > 0.0 {
        rectangle([from, -w / 2.0, 50.0], to - from, w)
    } else {
        open(&[[from, 0.0, 50.0], [0.0, 0.0, 50.0], [to, 0.0, 50.0]])
    };
    Site::new(vec![line], k, ground)
}

/// A dam with a crest across a valley with unequal sides.
pub(crate) fn dam_of_a_kind() -> Site {
    let (sides, d, w, k, shift) = DAMS[2];
    dam_site(sides, d, w, k, shift)
}

const DAMS: [([f64; 2], f64, f64, f64, f64); 5] = [
    ([0.25, 0.25], 2.0, 0.0, 0.5, 0.0),
    ([0.25, 0.25], 2.0, 0.0, 0.5, 0.7),
    ([0.25, 0.5], 3.0, 6.0, 0.5, 0.7),
    ([0.5, 0.25], 4.0, 4.0, 0.8, 0.0),
    ([0.4, 0.25], 3.0, 5.0, 0.5, 0.3),
];

#[test]
fn dams_by_brute_force() {
    for (sides, d, w, k, shift) in DAMS {
        let found = sample(&dam_site(sides, d, w, k, shift), about(20.0), 500);
        let expected = dam(sides, d, w, k);
        found.roughly(&expected, 1e-3, &format!("dam {sides:?} {d} {w} {k} {shift}"));
    }
}

/// And, upside down, a cutting through a ridge.
#[test]
fn dams() {
    for (sides, d, w, k, shift) in DAMS {
        let name = format!("dam {sides:?} {d} {w} {k} {shift}");
        let site = dam_site(sides, d, w, k, shift);
        let expected = dam(sides, d, w, k);
        build(&site, "").figures().near(&expected, EXACT, &name);
        build(&site.upside_down(), "").figures().near(&expected.swapped(), EXACT, &format!("{name}, upside down"));
    }
}

/// The ends of two straight works of different length on one plane are alike, chords and all. What is left of the difference is
/// the section times the difference in length: the exact figure of a strip without ends.
#[test]
fn straight_works_less_their_ends() {
    for (w, h) in STRIPS {
        let [short, long] = [20.0, 55.0].map(|length| build(&straight(w, h, length), "").figures());
        (long - short).near(&strip(w, h, 35.0), EXACT, &format!("strip {w} wide, {h} above"));
    }
}

/// The closed form of the whole says the same.
#[test]
fn strips_by_closed_form() {
    for (w, h) in STRIPS {
        let [short, long] = [20.0, 55.0].map(|length| match &straight(w, h, length).lines[0] {
            line if line.closed => planar::pad(&line.points, CROSS, CUT, FILL),
            line => planar::line(line.points[0], line.points[1], CROSS, CUT, FILL),
        });
        (long - short).near(&strip(w, h, 35.0), 1e-12, &format!("strip {w} wide, {h} above"));
    }
}

/// Rulings of a level line run square to it, so a stretch inside has the section times its length, to the last digits. What is
/// over at both ends are the cones, half each.
#[test]
fn stations_of_a_straight_line() {
    for (w, h) in STRIPS {
        let (length, step) = (60.0, 16.0);
        let line = open(&[[0.0, 0.0, CROSS.level + h], [length, 0.0, CROSS.level + h]]);
        let site = Site { lines: vec![line], ..straight(w, h, length) };
        let width = if w > 0.0 { format!("--width {w}") } else { String::new() };
        let built = build(&site, &format!("{width} --stations {step}"));
        let stations = built.report["stations"].as_array().unwrap();
        assert_eq!(stations.len(), 4);
        let of = |i: usize| {
            let [cut, fill, cut_area, fill_area] =
                ["cut", "fill", "cut_area", "fill_area"].map(|k| stations[i][k].as_f64().unwrap());
            Figures { cut, fill, cut_area, fill_area }
        };
        let what = format!("stretch of a strip {w} wide, {h} above");
        for i in [1, 2] {
            of(i).near(&strip(w, h, step), EXACT, &what);
        }
        // The last stretch is 12 long. Its end is the mirror image of the first.
        (of(0) - strip(w, h, step)).near(&(of(3) - strip(w, h, 12.0)), 1e-7, &what);
    }
}

/// Cross-fall of the ground.
const CROSS: Tilt = Tilt { level: 100.0, gradient: [0.0, 0.2] };
const CUT: f64 = 0.8;
const FILL: f64 = 0.5;
/// Widths of strips, and heights of their middle above the ground.
const STRIPS: [(f64, f64); 6] = [(0.0, 1.0), (6.0, 1.0), (14.0, 1.0), (0.0, -1.0), (6.0, -1.0), (10.0, 0.0)];

fn straight(w: f64, h: f64, length: f64) -> Site {
    let ground = Ground::grid([[-40.0, -41.0], [90.0, 43.0]], 17, 9, |x, y| CROSS.height(x, y));
    let z = CROSS.level + h;
    let line = if w > 0.0 { rectangle([0.0, -w / 2.0, z], length, w) } else { open(&[[0.0, 0.0, z], [length, 0.0, z]]) };
    Site::new(vec![line], FILL, ground).cut_slope(CUT)
}

/// In section there is `h − c·y` over the platform, and beyond its edges a triangle with the height at the edge and the loss
/// `k ± c` of a slope that runs with the ground or against it.
fn strip(w: f64, h: f64, length: f64) -> Figures {
    let c = CROSS.gradient[1];
    let side = |sign: f64, lower: f64, upper: f64| {
        let at = |y: f64| (sign * (h - c * y)).max(0.0);
        let zero = (h / c).clamp(-w / 2.0, w / 2.0);
        let (below, above) = (zero + w / 2.0, w / 2.0 - zero);
        let (lo, hi) = (at(-w / 2.0), at(w / 2.0));
        let width = if lo > 0.0 { below } else { 0.0 } + if hi > 0.0 { above } else { 0.0 };
        let area = 0.5 * (lo + at(zero)) * below + 0.5 * (at(zero) + hi) * above;
        (length * (area + 0.5 * lo * lo / lower + 0.5 * hi * hi / upper), length * (width + lo / lower + hi / upper))
    };
    // Downhill (y < 0) fill runs with the ground, cut against it.
    let ((fill, fill_area), (cut, cut_area)) = (side(1.0, FILL - c, FILL + c), side(-1.0, CUT + c, CUT - c));
    Figures { cut, fill, cut_area, fill_area }
}

/// Ground parallel to the slope at first, then level. The fill is a layer of thickness 1 over the slope of length 6, and a
/// triangle from there: `k·t = 3 + 1` at `t = 8`. Two lengths again, to be rid of the ends.
#[test]
fn ground_parallel_to_the_slope() {
    let [short, long] = [20.0, 60.0].map(|length| build(&layered(length), "").figures());
    (long - short).near(&LAYER, EXACT, "layer");
}

#[test]
fn ground_parallel_to_the_slope_by_brute_force() {
    let [short, long] = [20.0, 60.0].map(|length| sample(&layered(length), [[-30.0, -30.0], [90.0, 30.0]], 600));
    (long - short).roughly(&LAYER, 1e-3, "layer");
}

/// Crest 6 wide, layer 6 wide, triangle 1 high and 2 wide; on the other side a triangle 1 high and 2 wide: 40 long.
const LAYER: Figures = Figures { cut: 0.0, fill: 40.0 * (6.0 + 6.0 + 1.0 + 1.0), cut_area: 0.0, fill_area: 40.0 * 16.0 };

fn layered(length: f64) -> Site {
    let k = 0.5;
    let height = |y: f64| if y < 0.0 { 0.0 } else { (-k * y).max(-3.0) };
    let ground = Ground::grid([[-45.0, -30.0], [105.0, 30.0]], 25, 10, |_, y| height(y));
    Site::new(vec![rectangle([0.0, -6.0, 1.0], length, 6.0)], k, ground)
}

/// A ring with a hole on ground that lies at the level of the platform, except for a square basin in the hole, side `a`: the edge
/// of the hole is the rim of the basin, whose sides are as steep as 1 down to a floor at depth `d`. Slopes run down from the edge
/// into the basin. In section from the rim there is fill between slope `k·t` and ground `t` up to `t = d`, then between slope and
/// floor up to `t = d/k`. Corners are re-entrant, with valleys at 45°: at distance `t` the slope is `4(a − 2t)` long. So `V = ∫₀ᵈ
/// (1 − k)t·4(a − 2t) dt + ∫_d^{d/k} (d − kt)·4(a − 2t) dt`.
fn basin(a: f64, d: f64, k: f64) -> Figures {
    let n = 1.0 / k;
    let first = (1.0 - k) * 4.0 * (a * d * d / 2.0 - 2.0 * d * d * d / 3.0);
    let whole = |t: f64| 4.0 * (d * a * t - (k * a + 2.0 * d) * t * t / 2.0 + 2.0 * k * t * t * t / 3.0);
    let fill_area = a * a - (a - 2.0 * n * d) * (a - 2.0 * n * d);
    Figures { cut: 0.0, fill: first + whole(n * d) - whole(d), cut_area: 0.0, fill_area }
}

const BASIN: (f64, f64, f64) = (40.0, 4.0, 0.5);

fn basin_site() -> Site {
    let (a, d, k) = BASIN;
    // Depth: the distance from the rim, at most d. Its creases are diagonals of the grid.
    let depth = |x: f64, y: f64| (a / 2.0 - x.abs().max(y.abs())).clamp(0.0, d);
    let ground = Ground::grid(about(40.0), 20, 20, |x, y| 10.0 - depth(x, y));
    let hole = rectangle([-a / 2.0, -a / 2.0, 10.0], a, a);
    let outer = rectangle([-30.0, -30.0, 10.0], 60.0, 60.0);
    Site::new(vec![outer, hole], k, ground)
}

#[test]
fn basin_in_a_hole_by_brute_force() {
    let (a, d, k) = BASIN;
    sample(&basin_site(), about(35.0), 700).roughly(&basin(a, d, k), 1e-3, "basin");
}

#[test]
fn basin_in_a_hole() {
    let (a, d, k) = BASIN;
    let site = basin_site();
    // Outer ring and hole of one polygon.
    let positions = |points: &[[f64; 3]]| format!("{:?}", points.iter().chain(&points[..1]).collect::<Vec<_>>());
    let [outer, hole] = [0, 1].map(|i| positions(&site.lines[i].points));
    let text =
        format!(r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":"Polygon","coordinates":[{outer},{hole}]}}}}"#);
    let folder = crate::run::Folder::of(&site).with("hole.geojson", text);
    let arguments = format!("hole.geojson --terrain ground.obj {}", crate::run::options(&site));
    crate::run::build_in(&folder, &arguments).figures().near(&basin(a, d, k), EXACT, "basin");
}

/// Vertices that the tolerance lets the engine leave out change no section: about a pad 5 high on level ground each has 5²/2k = 25 on the
/// outside and nothing inside, and reaches 10 (at corners √2 times as much). The line that is built passes 3 mm beside the given one.
#[test]
fn sections_do_not_see_what_is_left_out() {
    let ground = || Ground::grid([[-50.0, -50.0], [150.0, 100.0]], 3, 3, |_, _| 0.0);
    for (y, tolerance) in [(39.997, 0.01), (40.003, 0.01), (40.0, 1e-4)] {
        for reversed in [false, true] {
            let mut points =
                vec![[0.0, 0.0, 5.0], [40.0, 0.0, 5.0], [80.0, 0.0, 5.0], [80.0, 40.0, 5.0], [40.0, y, 5.0], [0.0, 40.0, 5.0]];
            if reversed {
                points.reverse();
            }
            let site = Site::new(vec![Polyline { points, closed: true }], 0.5, ground()).tolerance(tolerance);
            let built = build(&site, "--stations 10");
            let stations = built.report["stations"].as_array().unwrap();
            assert!(stations.len() >= 24);
            for (row, at) in stations.iter().flat_map(|row| ["from", "middle", "to"].map(|at| (row, at))) {
                let [fill, left, right] = ["fill", "left", "right"].map(|key| row["section"][at][key].as_f64().unwrap());
                let [from, to] = ["from", "to"].map(|key| row[key].as_f64().unwrap());
                let station = if at == "middle" { 0.5 * (from + to) } else { row[at].as_f64().unwrap() };
                let outside = if reversed { left } else { right };
                assert_eq!(left + right, outside, "{row}");
                let corner = [0.0, 80.0, 120.0, 200.0, 240.0].iter().any(|c| (station - c).abs() < 0.1);
                // At corners it runs into the cone, which is a little flatter in chords.
                assert!(corner || (fill - 25.0).abs() < 0.05 && (outside - 10.0).abs() < 0.02, "{at} {row}");
            }
        }
    }
}

/// Inside an arc of radius 200, with a vertex every 0.25, 10 above level ground, slope 1 in 1.5: sections of 10·15/2 = 75 all along.
#[test]
fn sections_of_one_side_of_a_fine_arc() {
    let at = |i: i32| (f64::from(i) * 0.25 / 200.0).sin_cos();
    let points: Vec<[f64; 3]> = (0..=400).map(at).map(|(sin, cos)| [200.0 * sin, 200.0 - 200.0 * cos, 10.0]).collect();
    let ground = Ground::grid([[-60.0, -60.0], [200.0, 200.0]], 3, 3, |_, _| 0.0);
    let site = Site::new(vec![open(&points)], 1.0 / 1.5, ground).tolerance(0.01);
    let folder = Folder::of(&site);
    let outputs = "-o design.obj --report report.json --quiet";
    folder
        .run(&format!(
            "build line.geojson --terrain ground.obj {} --side left --allow-open --stations 10 {outputs}",
            options(&site)
        ))
        .done();
    let report: serde_json::Value = serde_json::from_str(&folder.read("report.json")).unwrap();
    let end_areas = report["volumes"]["end_area"]["fill"].as_f64().unwrap();
    assert!((end_areas - 7500.0).abs() < 20.0, "{end_areas}");
}

/// A road with a bend of 26.6°: the section at 57, which crosses the crease behind it, is the same for every spacing.
#[test]
fn sections_do_not_depend_on_the_spacing() {
    let bends = [[0.0, 0.0], [60.0, 0.0], [110.0, 25.0], [160.0, 25.0], [210.0, -10.0], [270.0, -10.0]];
    let ground = Ground::grid([[-60.0, -90.0], [330.0, 100.0]], 3, 3, |_, _| 0.0);
    let site = Site::new(vec![open(&bends.map(|[x, y]| [x, y, 10.0]))], 1.0 / 1.5, ground);
    let of = |spacing: f64| {
        let built = build(&site, &format!("--width 7 --stations {spacing}"));
        let stations = built.report["stations"].as_array().unwrap();
        let row = stations.iter().find(|row| row["from"] == 57.0).unwrap();
        row["section"]["from"]["fill"].as_f64().unwrap()
    };
    let found = [57.0, 19.0, 3.0].map(of);
    assert!(found.iter().all(|fill| (fill - found[0]).abs() < 1e-6) && (found[0] - 221.32).abs() < 0.01, "{found:?}");
}
