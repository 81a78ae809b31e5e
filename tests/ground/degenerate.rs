//! Things that meet exactly: vertices on lines, planes in planes, ground where the works would be.

use crate::closed::agrees;
use crate::common::build::{open, rectangle};
use crate::common::lines::Random;
use crate::common::oracle::Polyline;
use crate::figures::Figures;
use crate::oracle::sample;
use crate::planar::{self, Tilt};
use crate::random::{pad, road};
use crate::run::{Folder, build, build_in, options};
use crate::site::Site;
use crate::tin::{Ground, about};

const LEVEL: Tilt = Tilt { level: 0.0, gradient: [0.0; 2] };

/// Corners and edges of the ring, the toe and the axes of the cones all run over vertices and along edges of the ground.
#[test]
fn ground_vertices_on_line_and_daylight() {
    let ring = rectangle([-8.0, -8.0, 4.0], 16.0, 16.0);
    for step in [4.0, 8.0, 16.0] {
        let site = Site::new(
            vec![ring.clone()],
            0.5,
            Ground::grid(about(48.0), (96.0 / step) as usize, (96.0 / step) as usize, |_, _| 0.0),
        );
        let expected = planar::pad(&ring.points, LEVEL, 1.0, 0.5);
        let built = build(&site, "");
        agrees(&format!("grid of {step}"), &site, &built, &expected);
        assert_eq!(built.number("daylight.loops"), 1.0);
        let down = site.upside_down();
        agrees(&format!("grid of {step}, upside down"), &down, &build(&down, ""), &expected.swapped());
    }
}

/// A vertex that no triangle uses may lie anywhere: nothing changes but the number of vertices.
#[test]
fn an_unused_vertex_far_away() {
    let height = |x: f64, y: f64| 2.0 * (0.11 * (x - 5e5)).sin() * (0.07 * (y - 5.4e6) + 1.0).cos();
    let ground = Ground::grid([[499_940.0, 5_399_940.0], [500_060.0, 5_400_060.0]], 24, 24, height);
    let site = Site::new(vec![rectangle([499_992.3, 5_399_991.7, 4.1], 16.0, 16.0)], 0.5, ground);
    let mut with = site.clone();
    with.ground.vertices.push([0.0; 3]);
    let (plain, with) = (build(&site, ""), build(&with, ""));
    for figure in ["volumes.cut", "volumes.fill", "surface.slope_area", "daylight.length"] {
        assert_eq!(plain.number(figure), with.number(figure), "{figure}");
    }
}

/// A line along edges of rolling ground: on it to the last bit at first, then above, then below.
#[test]
fn line_along_ground_edges() {
    let height = |x: f64, y: f64| 2.0 * (0.11 * x).sin() * (0.07 * y + 1.0).cos();
    let ground = Ground::grid([[-60.0, -40.0], [60.0, 40.0]], 24, 16, height);
    let lift = |x: f64| match x {
        _ if x <= -20.0 => 0.0,
        _ if x <= 10.0 => 0.1 * (x + 20.0).min(10.0 - x).max(0.0),
        _ => -0.1 * (x - 10.0).min(40.0 - x).max(0.0),
    };
    let points: Vec<[f64; 3]> = (-8..=8).map(|i| 5.0 * f64::from(i)).map(|x| [x, 0.0, height(x, 0.0) + lift(x)]).collect();
    let site = Site::new(vec![open(&points)], 0.8, ground);
    let built = build(&site, "");
    built.figures().roughly(&sample(&site, [[-45.0, -20.0], [45.0, 20.0]], 900), 2e-3, "brute force");
    let finer = Site { ground: site.ground.refined(), ..site };
    build(&finer, "").figures().near(&built.figures(), 1e-6, "finer ground");
}

/// The line passes through the ground exactly at its middle vertex, which lies on a vertex, an edge or a face of the ground.
#[test]
fn through_the_ground_at_a_vertex() {
    let tilt = Tilt { level: 100.0, gradient: [0.0, 0.25] };
    let (from, to) = ([-20.0, 0.0, 98.0], [20.0, 0.0, 102.0]);
    let expected = planar::line(from, to, tilt, 1.0, 0.5);
    for (nx, ny) in [(12, 12), (12, 11), (11, 12), (11, 13)] {
        let ground = Ground::grid(about(48.0), nx, ny, |x, y| tilt.height(x, y));
        let site = Site::new(vec![open(&[from, [0.0, 0.0, 100.0], to])], 0.5, ground).cut_slope(1.0);
        agrees(&format!("{nx} by {ny}"), &site, &build(&site, ""), &expected);
    }
}

/// One half of the pad lies in level ground, the other over ground that falls away: the works are those of that half on a plane.
#[test]
fn ground_in_the_platform() {
    let height = |_: f64, y: f64| if y > 0.0 { -0.25 * y } else { 0.0 };
    for n in [16, 12, 4] {
        let ground = Ground::grid([[-40.0, -40.0], [40.0, 40.0]], n, n, height);
        let site = Site::new(vec![rectangle([-10.0, -8.0, 0.0], 20.0, 16.0)], 0.5, ground);
        let half = rectangle([-10.0, 0.0, 0.0], 20.0, 8.0);
        let expected = planar::pad(&half.points, Tilt { level: 0.0, gradient: [0.0, -0.25] }, 1.0, 0.5);
        agrees(&format!("{n} cells"), &site, &build(&site, ""), &expected);
        let down = site.upside_down();
        agrees(&format!("{n} cells, upside down"), &down, &build(&down, ""), &expected.swapped());
    }
}

/// A peak that just touches the platform from below, and one that touches a line.
#[test]
fn peaks_that_touch() {
    let peak = Ground::grid(about(32.0), 16, 16, |x, y| if x == 0.0 && y == 0.0 { 0.0 } else { -3.0 });
    for line in [rectangle([-6.0, -6.0, 0.0], 12.0, 12.0), open(&[[-8.0, 0.0, 0.0], [8.0, 0.0, 0.0]])] {
        let site = Site::new(vec![line], 0.5, peak.clone());
        let built = build(&site, "");
        built.figures().roughly(&sample(&site, about(16.0), 700), 1e-3, "brute force");
        assert_eq!(built.number("volumes.cut"), 0.0);
        assert_eq!(built.number("daylight.loops"), 1.0);
    }
}

/// Nothing to cut and nothing to fill: said in so many words, or done with figures of nought. Never a failure.
#[track_caller]
fn nothing_to_do(name: &str, site: &Site, earth: f64) {
    let folder = Folder::of(site);
    let outputs = "-o d.obj --finished f.obj --report r.json";
    let run = folder.run(&format!("build line.geojson --terrain ground.obj {} {outputs}", options(site)));
    if run.code == 0 {
        let report: serde_json::Value = serde_json::from_str(&folder.read("r.json")).unwrap();
        let volumes = ["cut", "fill"].map(|key| report["volumes"][key].as_f64().unwrap());
        assert!(volumes.iter().all(|&v| (0.0..=earth).contains(&v)), "{name}: {volumes:?}");
    } else {
        assert_eq!((run.code, run.stderr.contains("nothing to")), (1, true), "{name}: {}", run.stderr);
        assert_eq!(folder.files(), ["ground.obj", "line.geojson"], "{name}");
    }
}

#[test]
fn everything_lies_as_it_should() {
    let flat = |tilt: Tilt| Ground::grid(about(40.0), 9, 8, move |x, y| tilt.height(x, y));
    let tilted = Tilt { level: 2.0, gradient: [0.25, -0.125] };
    let sloping = |line: &Polyline| Polyline {
        points: line.points.iter().map(|&[x, y, _]| [x, y, tilted.height(x, y)]).collect(),
        closed: line.closed,
    };
    let ring = rectangle([-8.0, -6.0, 0.0], 16.0, 12.0);
    let line = open(&[[-16.0, 0.0, 0.0], [0.0, 4.0, 0.0], [20.0, 4.0, 0.0]]);
    for (name, lines, tilt) in [
        ("level ring", vec![ring.clone()], LEVEL),
        ("level line", vec![line.clone()], LEVEL),
        ("ring in a slope", vec![sloping(&ring)], tilted),
        ("line in a slope", vec![sloping(&line)], tilted),
    ] {
        nothing_to_do(name, &Site::new(lines.clone(), 0.5, flat(tilt)), 1e-9);
        nothing_to_do(name, &Site::new(lines, 0.5, flat(tilt)).upside_down(), 1e-9);
    }
}

/// A slope as steep as the ground, through a line in the ground: the sheet lies in the ground all the way.
#[test]
fn slope_in_the_ground() {
    let ground = Ground::grid(about(40.0), 8, 8, |_, y| if y > 0.0 { -0.5 * y } else { 0.0 });
    let site = Site::new(vec![rectangle([-12.0, -8.0, 0.0], 24.0, 8.0)], 0.5, ground);
    nothing_to_do("slope in the ground", &site, 1e-9);
}

/// What has been built needs no more building: the finished ground as ground again. Slopes lie in it nearly everywhere.
#[test]
fn as_built() {
    for (name, site) in [("pad", pad(3, 6, 0.3)), ("road", road(2, 9)), ("other pad", pad(6, 5, 0.15))] {
        let built = build(&site, "");
        let again = Site { ground: built.finished.tin.clone(), ..site.clone() };
        let figures = built.figures();
        let left = 2.0 * built.number("volumes.error_bound") + 1e-9 * (figures.cut + figures.fill);
        nothing_to_do(name, &again, left);
    }
}

/// Higher by what no one can see: a layer of that thickness, or nothing.
#[test]
fn a_hair_above_the_ground() {
    for hair in [1e-3, 1e-6, 1e-9, 1e-12] {
        for ring in [rectangle([-8.0, -6.0, hair], 16.0, 12.0), rectangle([-8.0, -6.0, -hair], 16.0, 12.0)] {
            let up = ring.points[0][2] > 0.0;
            let site = Site::new(vec![ring], 0.5, Ground::grid(about(40.0), 9, 8, |_, _| 0.0));
            if hair < 1e-5 {
                nothing_to_do(&format!("{hair}"), &site, 200.0 * hair);
                continue;
            }
            let layer = 192.0 * hair;
            let expected =
                Figures { cut: if up { 0.0 } else { layer }, fill: if up { layer } else { 0.0 }, cut_area: 0.0, fill_area: 0.0 };
            build(&site, "").figures().volumes_near(&expected, 1e-3, &format!("{hair}"));
        }
    }
}

/// A ground that is much finer than the works, and one triangle that holds them all.
#[test]
fn fine_and_coarse_ground() {
    let tilt = Tilt { level: 5.0, gradient: [0.1, 0.2] };
    let ring = rectangle([-3.0, -2.0, 5.5], 6.0, 4.0);
    let expected = planar::pad(&ring.points, tilt, 1.0, 0.5);
    let one = Ground {
        vertices: [[-300.0, -200.0], [280.0, -190.0], [10.0, 340.0]].map(|[x, y]| [x, y, tilt.height(x, y)]).to_vec(),
        triangles: vec![[0, 1, 2]],
    };
    let fine = Ground::jittered(&mut Random::new(9), about(15.0), 150, |x, y| tilt.height(x, y));
    for ground in [one, fine] {
        let site = Site::new(vec![ring.clone()], 0.5, ground).cut_slope(1.0);
        agrees("pad", &site, &build(&site, ""), &expected);
    }
}

/// The strip of `--width` about a straight line is the rectangle with that middle line.
#[test]
fn width_of_a_straight_line() {
    let tilt = Tilt { level: 100.0, gradient: [0.0, 0.2] };
    let ground = Ground::grid(about(60.0), 12, 13, |x, y| tilt.height(x, y));
    let (from, to) = ([-20.0, 1.0, 99.0], [20.0, 1.0, 101.0]);
    let strip = [[-20.0, -2.5, 99.0], [20.0, -2.5, 101.0], [20.0, 4.5, 101.0], [-20.0, 4.5, 99.0]];
    let expected = planar::pad(&strip, tilt, 1.0, 0.5);
    let site = Site::new(vec![open(&[from, to])], 0.5, ground).cut_slope(1.0);
    let folder = Folder::of(&site);
    let built = build_in(&folder, &format!("line.geojson --terrain ground.obj --width 7 {}", options(&site)));
    agrees("strip", &site, &built, &expected);
    let platform = built.number("surface.platform_area");
    assert!((platform - 7.0 * (40_f64 * 40.0 + 4.0).sqrt()).abs() < 1e-9 * platform, "{platform}");
}
