//! What hangs together with the line is built, what does not is left alone; what stands out stays.

use crate::closed::agrees;
use crate::common::build::rectangle;
use crate::figures::Figures;
use crate::oracle::sample;
use crate::planar::{self, Tilt, above};
use crate::run::{Built, Folder, build, build_in};
use crate::site::Site;
use crate::tin::{Ground, about};

/// Half width of the pad, its height over the level ground, the slope; the toe is at 18.
const HALF: f64 = 10.0;
const HIGH: f64 = 4.0;
const SLOPE: f64 = 0.5;

fn pad() -> crate::common::oracle::Polyline {
    rectangle([-HALF, -HALF, HIGH], 2.0 * HALF, 2.0 * HALF)
}

/// Level ground with a node at `(0, y)` lifted to `tip`. For `y` = 14, 18, 22 the node is one through which all diagonals run.
fn pyramid(y: f64, tip: f64) -> Ground {
    Ground::grid([[-36.0, -34.0], [36.0, 38.0]], 36, 36, |px, py| if px == 0.0 && py == y { tip } else { 0.0 })
}

/// The pad on level ground.
fn without() -> Figures {
    planar::pad(&pad().points, Tilt { level: 0.0, gradient: [0.0; 2] }, 1.0, SLOPE)
}

/// The same with a pyramid beside the middle of the upper side, where the slope is the plane `HIGH − SLOPE·(y − HALF)`: the fill
/// over its base is replaced by what is over its faces.
fn with_pyramid(y: f64, tip: f64) -> Figures {
    let ground = pyramid(y, tip);
    let slope = |py: f64| HIGH - SLOPE * (py - HALF);
    let base = |t: [[f64; 3]; 3]| t.iter().any(|v| v[0] == 0.0 && v[1] == y);
    let mut sums = without();
    for t in (0..ground.triangles.len()).map(|t| ground.corners(t)).filter(|&t| base(t)) {
        let (area, volume) = above(&t.map(|[px, py, z]| [px, py, slope(py) - z]));
        let (level_area, level_volume) = above(&t.map(|[px, py, _]| [px, py, slope(py)]));
        sums.fill += volume - level_volume;
        sums.fill_area += area - level_area;
    }
    sums
}

fn site(ground: Ground) -> Site {
    Site::new(vec![pad()], SLOPE, ground).cut_slope(1.0)
}

#[test]
fn brute_force_agrees() {
    for (y, tip) in [(14.0, 5.0), (14.0, 1.5), (18.0, -12.0)] {
        let expected = with_pyramid(y, tip);
        sample(&site(pyramid(y, tip)), about(20.0), 600).roughly(&expected, 1e-3, &format!("pyramid {tip} high at {y}"));
    }
    sample(&site(pyramid(22.0, -12.0)), about(30.0), 600).roughly(&without(), 1e-3, "hole behind level ground");
}

/// A peak 5 high stands with its foot wholly in the fill, which is 2 deep at its axis: an island.
#[test]
fn a_peak_stays_a_peak() {
    let (y, tip) = (14.0, 5.0);
    let expected = with_pyramid(y, tip);
    // By hand: over the base the slope holds 16·2 and, without the tip, the pyramid 16·5/3. The tip is what is above the plane.
    assert!(expected.fill > without().fill - 16.0 * tip / 3.0 && expected.fill < without().fill - 16.0);
    let site = site(pyramid(y, tip));
    for (site, expected) in [(site.upside_down(), expected.swapped()), (site, expected)] {
        let built = build(&site, "");
        agrees("island", &site, &built, &expected);
        assert_eq!(built.number("daylight.loops"), 2.0);
        assert_eq!(built.of_kind("daylight").count(), 2);
        // The tip is not touched.
        let tip = site.ground.vertices.iter().find(|v| v[0] == 0.0 && v[1] == y).unwrap();
        let found = built.finished.tin.vertices.iter().find(|v| v[..2] == tip[..2]);
        assert_eq!(found, Some(tip));
    }
}

/// The same works, but for the chords on cones: how many there are depends on how deep the ground lies that slopes might reach.
#[track_caller]
fn alike(a: &Built, b: &Built) {
    let bound = a.number("volumes.error_bound") + b.number("volumes.error_bound");
    let fill = a.figures().fill;
    assert!(bound < 1e-4 * fill, "{bound}");
    a.figures().volumes_near(&b.figures(), bound / fill, "with and without");
    a.figures().areas_near(&b.figures(), 1e-4, "with and without");
}

/// A peak that does not reach the slope is covered.
#[test]
fn a_low_peak_is_covered() {
    let expected = with_pyramid(14.0, 1.5);
    let site = site(pyramid(14.0, 1.5));
    let built = build(&site, "");
    agrees("covered", &site, &built, &expected);
    assert_eq!(built.number("daylight.loops"), 1.0);
    // 16·1.5/3 less than without it.
    assert!((without().fill - expected.fill - 8.0).abs() < 1e-9);
}

/// A hole beyond the toe is deeper than the slope would be there, but level ground lies between.
#[test]
fn a_hole_behind_level_ground_is_not_filled() {
    let (there, not) = (site(pyramid(22.0, -12.0)), site(pyramid(22.0, 0.0)));
    let built = build(&there, "");
    agrees("hole", &there, &built, &without());
    assert_eq!(built.number("daylight.loops"), 1.0);
    alike(&built, &build(&not, ""));
    let upside_down = build(&there.upside_down(), "");
    upside_down.figures().near(&built.figures().swapped(), 1e-12, "tower behind level ground");
}

/// The same hole across the toe is filled as far as the slope reaches down in it.
#[test]
fn a_hole_at_the_toe_is_filled() {
    let expected = with_pyramid(18.0, -12.0);
    assert!(expected.fill > without().fill + 10.0);
    let site = site(pyramid(18.0, -12.0));
    agrees("hole at the toe", &site, &build(&site, ""), &expected);
}

/// Behind a ridge the ground falls to far below what the slope would be. The slope ends on the near side of the ridge, so it
/// makes no difference whether the valley is there.
#[test]
fn a_valley_behind_a_hill_is_not_filled() {
    let profile = |valley: bool| {
        move |_: f64, y: f64| match y {
            _ if y <= 16.0 => 0.0,
            _ if y <= 20.0 => 0.75 * (y - 16.0),
            _ if valley => (3.0 - 33.0 / 8.0 * (y - 20.0)).max(-30.0),
            _ => 3.0,
        }
    };
    let [with, without] = [true, false].map(|valley| site(Ground::grid(about(48.0), 24, 24, profile(valley))));
    let [w, o] = [&with, &without].map(|site| build(site, ""));
    alike(&w, &o);
    assert_eq!(w.number("daylight.loops"), 1.0);
    w.figures().roughly(&sample(&with, about(24.0), 500), 1e-3, "brute force");
    let upside_down = build(&with.upside_down(), "");
    upside_down.figures().near(&w.figures().swapped(), 1e-12, "hill behind a valley");
}

/// Two pads, each with its works: figures add up, and loops are counted.
#[test]
fn two_pads() {
    let apart = |x: f64| rectangle([x - 8.0, -8.0, 4.0], 16.0, 16.0);
    let level = Ground::grid([[-60.0, -30.0], [60.0, 30.0]], 11, 7, |_, _| 0.0);
    let one = planar::pad(&apart(0.0).points, Tilt { level: 0.0, gradient: [0.0; 2] }, 1.0, SLOPE);
    let two = Site::new(vec![apart(-30.0), apart(30.0)], SLOPE, level.clone());
    let built = build(&two, "");
    agrees("apart", &two, &built, &(one + one));
    assert_eq!(built.number("daylight.loops"), 2.0);
    // Near each other the slopes meet in a valley: one loop, less fill.
    let near = Site::new(vec![apart(-12.0), apart(12.0)], SLOPE, level);
    let built = build(&near, "");
    assert_eq!(built.number("daylight.loops"), 1.0);
    built.figures().roughly(&sample(&near, [[-32.0, -20.0], [32.0, 20.0]], 700), 1e-3, "brute force");
    assert!(built.figures().fill < 2.0 * one.fill - 10.0);
}

/// The pad of 20 by 20 with its corner at the origin, 40 above a basin in a dike; the slope 1:2 comes to the crest, 60 from the pad, in
/// a height of 10. The crest is 15 high but for a notch of half-width `half` on the bisector of a corner, which is `drop` below the
/// slope. Beyond the dike the ground is 20 below the basin.
fn dike(drop: f64, half: f64) -> Site {
    const CREST: f64 = 60.0;
    let notch = (half / CREST).to_degrees();
    let angles = |quarter: usize| {
        let first = 90.0 * quarter as f64 - 90.0;
        let mut angles: Vec<f64> = (0..=24).map(|i| first + 3.75 * f64::from(i)).collect();
        if quarter == 1 {
            angles.retain(|a| (a - 45.0).abs() > 3.0 * notch);
            angles.extend([-2.0, -1.0, 0.0, 1.0, 2.0].map(|n| 45.0 + n * notch));
            angles.sort_by(f64::total_cmp);
        }
        angles
    };
    let mut ground = Ground { vertices: vec![[10.0, 10.0, 0.0]], triangles: Vec::new() };
    let mut rows: Vec<Vec<usize>> = Vec::new();
    for distance in [0.5, 20.0, CREST - 1.0, CREST, CREST + 1.0, CREST + 60.0, CREST + 120.0] {
        let mut row = Vec::new();
        for (quarter, [x, y]) in [[20.0, 0.0], [20.0, 20.0], [0.0, 20.0], [0.0, 0.0]].into_iter().enumerate() {
            for angle in angles(quarter) {
                let in_notch = quarter == 1 && (angle - 45.0).abs() < 1.1 * notch;
                let z = match distance {
                    CREST if in_notch => 40.0 - 0.5 * CREST - drop,
                    CREST => 15.0,
                    _ if distance < CREST => 0.0,
                    _ => -20.0,
                };
                let (sin, cos) = angle.to_radians().sin_cos();
                row.push(ground.vertices.len());
                ground.vertices.push([x + distance * cos, y + distance * sin, z]);
            }
        }
        rows.push(row);
    }
    let next = |row: &[usize], i: usize| row[(i + 1) % row.len()];
    ground.triangles.extend((0..rows[0].len()).map(|i| [0, rows[0][i], next(&rows[0], i)]));
    for w in rows.windows(2) {
        for i in 0..w[0].len() {
            let [a, b, c, d] = [w[0][i], w[1][i], next(&w[1], i), next(&w[0], i)];
            ground.triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    Site::new(vec![rectangle([0.0, 0.0, 40.0], 20.0, 20.0)], 0.5, ground).tolerance(0.01)
}

/// A slope through a notch that chords of a coarse tolerance are too low for goes on beyond it, and all the way, whether or not open
/// ends are allowed.
#[test]
fn open_ends_are_none_where_the_slope_goes_on() {
    let site = dike(0.01, 0.05);
    let folder = Folder::of(&site);
    let build = |more: &str| build_in(&folder, &format!("line.geojson --terrain ground.obj --slope 1:2 {more}"));
    let [without, with] = ["", "--allow-open"].map(build);
    // Closed in by the dike it would be a basin with 20 400 m² at 0 to 10 under the slope, some 360 000 m³.
    assert!(without.figures().fill > 800_000.0);
    assert_eq!(with.figures(), without.figures());
    assert_eq!(with.report["volumes"]["complete"], true);
    assert_eq!(with.number("daylight.open_length"), 0.0);
    assert_eq!(
        (with.design.tin.vertices, with.design.tin.triangles),
        (without.design.tin.vertices, without.design.tin.triangles)
    );
}
