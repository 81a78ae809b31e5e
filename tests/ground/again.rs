//! Grounds that were finished before: the same works on them move nothing, others are built as on any ground.

use crate::common::build::ring;
use crate::common::oracle::Polyline;
use crate::run::{Folder, build_in};
use crate::site::{Site, geojson};
use crate::tin::{Ground, about};

fn rolling(x: f64, y: f64) -> f64 {
    3.0 * (x / 17.0 + 0.3).sin() + 2.0 * (y / 11.0 + 1.0).cos() + 0.05 * x
}

fn ground() -> Ground {
    Ground::grid(about(100.0), 40, 40, rolling)
}

fn line() -> Polyline {
    let points = vec![[-60.0, -30.0, 0.0], [-30.0, 0.0, 2.0], [0.0, 10.0, 3.0], [30.0, 5.0, 2.0], [60.0, 30.0, 1.0]];
    Polyline { points, closed: false }
}

fn pad() -> Polyline {
    ring(&[[-20.0, -15.0, 1.0], [20.0, -15.0, 1.0], [20.0, 15.0, 1.0], [-20.0, 15.0, 1.0]])
}

/// Nowhere parallel to the grid.
fn turned() -> Polyline {
    ring(&[[-20.0, -3.0, 1.0], [3.0, -19.0, 1.5], [22.0, 4.0, 1.2], [-1.0, 21.0, 0.4]])
}

/// Builds once, and again on the finished ground with other options. Gives cut and fill of both.
fn twice(works: Polyline, first: &str, second: &str) -> [(f64, f64); 2] {
    let site = Site::new(vec![works], 2.0 / 3.0, ground());
    let folder = Folder::of(&site);
    let figures = |ground: &str, options: &str| {
        let built = build_in(&folder, &format!("line.geojson --terrain {ground} {options}")).figures();
        (built.cut, built.fill)
    };
    let before = figures("ground.obj", first);
    std::fs::copy(folder.path("finished.obj"), folder.path("before.obj")).unwrap();
    [before, figures("before.obj", second)]
}

/// What chords of cones may leave is within the bound that the report gives, a ten-thousandth here.
#[track_caller]
fn nothing_is_left(works: Polyline, options: &str) {
    let [before, after] = twice(works, options, options);
    let all = before.0 + before.1;
    assert!(all > 1000.0 && after.0 + after.1 < 1e-4 * all, "{before:?} then {after:?}");
}

#[test]
fn the_same_works_move_nothing() {
    nothing_is_left(pad(), "--slope 1:1.5");
    nothing_is_left(line(), "--slope 1:1.5");
    nothing_is_left(line(), "--slope 1:1.5 --width 6");
}

#[test]
fn the_same_works_move_nothing_across_the_grid() {
    nothing_is_left(turned(), "--slope 1:1.5");
    nothing_is_left(line(), "--slope 1:1.5 --width 6 --crossfall 2.5%");
}

/// Flatter slopes through the same line cut and fill more. What both builds move adds up to what one moves: only the order
/// differs.
#[test]
fn flatter_slopes_afterwards() {
    for works in [pad(), turned()] {
        let [steep, more] = twice(works.clone(), "--slope 1:1.5", "--slope 1:2");
        let [flat, _] = twice(works, "--slope 1:2", "--slope 1:2");
        let net = |(cut, fill): (f64, f64)| cut - fill;
        assert!((net(steep) + net(more) - net(flat)).abs() < 1e-3 * (flat.0 + flat.1), "{steep:?} {more:?} {flat:?}");
    }
}

/// A road with crossfall leaves slivers as narrow as coordinates can be; another pad on that ground must not call them overlaps.
#[test]
fn a_pad_on_a_finished_road() {
    let site = Site::new(vec![line()], 2.0 / 3.0, ground());
    let higher = ring(&pad().points.iter().map(|&[x, y, z]| [x, y, z + 1.0]).collect::<Vec<_>>());
    let folder = Folder::of(&site).with("pad.geojson", geojson(&[higher]));
    build_in(&folder, "line.geojson --terrain ground.obj --slope 1:1.5 --width 6 --crossfall 2.5%");
    std::fs::copy(folder.path("finished.obj"), folder.path("before.obj")).unwrap();
    let built = build_in(&folder, "pad.geojson --terrain before.obj --slope 1:1.5");
    assert!(built.figures().fill > 1000.0 && built.figures().cut > 1000.0, "{:?}", built.figures());
}
