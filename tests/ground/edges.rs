//! Where the ground ends: works that touch its edge, hang over it, or lie about it. What lies beyond is not compared, and the finished
//! ground ends where the ground ended.

use crate::closed::agrees;
use crate::common::build::{open, rectangle};
use crate::common::lines::Random;
use crate::common::oracle::Polyline;
use crate::figures::Figures;
use crate::finished::worth;
use crate::planar::{self, Tilt};
use crate::run::{Built, Folder, build, build_in, options};
use crate::site::Site;
use crate::tin::{Box2, Ground, about};
use std::f64::consts::PI;

/// Level ground at nought but for what lies inside (outside) of a box.
fn cut_out(all: Box2, cells: [usize; 2], [lo, hi]: Box2, keep_inside: bool) -> Ground {
    let inside = |t: [[f64; 3]; 3]| {
        let middle = [0, 1].map(|i| (t[0][i] + t[1][i] + t[2][i]) / 3.0);
        (0..2).all(|i| middle[i] > lo[i] && middle[i] < hi[i])
    };
    Ground::grid(all, cells[0], cells[1], |_, _| 0.0).only(|t| inside(t) == keep_inside)
}

/// The finished ground faces up, covers what the ground covered, and is worth what the report says.
#[track_caller]
fn sound(name: &str, site: &Site, built: &Built) {
    let finished = &built.finished.tin;
    let plan = |[x, y, _]: [f64; 3]| robust::Coord { x, y };
    for [a, b, c] in (0..finished.triangles.len()).map(|t| finished.corners(t)) {
        // The exact sign: triangles at the edge may be as thin as rounding.
        assert!(robust::orient2d(plan(a), plan(b), plan(c)) > 0.0, "{name}: {a:?} {b:?} {c:?}");
    }
    let (found, wanted) = (finished.plan_area(), site.ground.plan_area());
    assert!((found - wanted).abs() < 1e-9 * wanted, "{name}: {found} for {wanted}");
    worth(name, site, built);
}

/// Builds a site and its mirror image, with open ends, and compares the fill (cut of the image) with a closed form.
#[track_caller]
fn comes_to(name: &str, site: &Site, fill: f64) {
    let turned = site.upside_down();
    for (name, site, mirrored) in [(name.to_owned(), site, false), (format!("{name}, upside down"), &turned, true)] {
        let built = build(site, "--allow-open");
        let found = if mirrored { built.figures().swapped() } else { built.figures() };
        // Chords of cones leave less.
        let slack = built.number("volumes.error_bound") + 1e-9 * fill;
        assert!(found.fill <= fill + 1e-9 * fill && found.fill >= fill - slack, "{name}: {} for {fill}", found.fill);
        assert_eq!(found.cut, 0.0, "{name}");
        assert_eq!(built.report["volumes"]["complete"], false, "{name}");
        sound(&name, site, &built);
    }
}

/// A road whose platform lies exactly in level ground, with an edge of the ground along its axis and another across its end: nothing
/// to dig and nothing to fill with either sheet, and the ground stays what it is.
#[test]
fn a_road_exactly_in_level_ground() {
    let line = open(&[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [4.0, 0.0, 0.0], [6.0, 0.0, 0.0]]);
    for n in [1, 2, 4, 5, 20] {
        let site = Site::new(vec![line.clone()], 0.5, Ground::grid(about(10.0), n, n, |_, _| 0.0));
        let folder = Folder::of(&site);
        for direction in ["down", "up", "auto"] {
            let name = format!("{n} cells, {direction}");
            let given = format!("line.geojson --width 3 --terrain ground.obj --direction {direction}");
            let slopes = if direction == "auto" { options(&site) } else { "--slope 1:2".to_owned() };
            let built = build_in(&folder, &format!("{given} {slopes}"));
            let found = built.figures();
            assert_eq!((found.cut, found.fill), (0.0, 0.0), "{name}");
            assert_eq!(built.report["volumes"]["complete"], true, "{name}");
            assert!((built.number("surface.platform_area") - 18.0).abs() < 1e-12, "{name}");
            sound(&name, &site, &built);
        }
    }
}

/// Slopes of 1:4 down to ground 4 lower end 16 away: along all four edges of the ground, and in no corner. A prism of `k·16²` for each
/// unit of the line, and a cone.
#[test]
fn slopes_that_end_along_the_edge_of_the_ground() {
    let (k, r, h) = (0.25, 16.0, 4.0);
    for cells in [[1, 1], [3, 2], [12, 8], [6, 5]] {
        let name = format!("{cells:?}");
        let ground = Ground::grid([[-24.0, -16.0], [24.0, 16.0]], cells[0], cells[1], |_, _| -h);
        let site = Site::new(vec![open(&[[-8.0, 0.0, 0.0], [8.0, 0.0, 0.0]])], k, ground).tolerance(0.01);
        let expected =
            Figures { fill: 16.0 * r * h + PI * r * r * h / 3.0, fill_area: 16.0 * 2.0 * r + PI * r * r, ..Figures::default() };
        for (site, expected) in [(site.upside_down(), expected.swapped()), (site, expected)] {
            let built = build(&site, "");
            agrees(&name, &site, &built, &expected);
            assert_eq!((built.number("daylight.open_length"), built.number("daylight.loops")), (0.0, 1.0), "{name}");
            sound(&name, &site, &built);
        }
    }
}

/// A line along the edge of level ground, and on: half of a prism and of a cone lie on the ground. The rulings at the ends of the line run along
/// that edge, whose coordinate is no round number for all slopes.
#[test]
fn a_line_along_the_edge_of_the_ground() {
    let (k, h) = (0.5, 4.0);
    let r = h / k;
    let fill = 16.0 * 0.5 * r * h + 0.5 * PI * r * r * h / 3.0;
    for y in [0.0, 5.0, 60.0] {
        for (cells, tolerance) in [([4, 2], 0.1), ([1, 1], 0.05), ([7, 3], 0.01)] {
            let ground = Ground::grid([[-20.0, y - 20.0], [20.0, y]], cells[0], cells[1], |_, _| -h);
            let line = open(&[[-8.0, y, 0.0], [3.0, y, 0.0], [8.0, y, 0.0]]);
            comes_to(&format!("{y}, {cells:?}"), &Site::new(vec![line], k, ground).tolerance(tolerance), fill);
        }
    }
}

/// Pads of half width `a`, `h` above level ground that ends along a line. Strips of a slope have the section `h²/2k`, four corners make
/// a cone.
#[test]
fn pads_that_hang_over_the_edge() {
    let (a, h, k) = (3.0, 1.5, 0.5);
    let (strip, cone) = (h * h / (2.0 * k), PI * (h / k) * (h / k) * h / 3.0);
    for n in [12, 24, 8] {
        let pad = || vec![rectangle([-a, -a, h], 2.0 * a, 2.0 * a)];
        let upto = |x: f64| Site::new(pad(), k, cut_out(about(12.0), [n, n], [[-20.0, -20.0], [x, 20.0]], true));
        // Across the pad; at the feet of its left side; beyond them; along its right side.
        if n != 8 {
            comes_to("through the middle", &upto(0.0), 2.0 * a * a * h + 4.0 * a * strip + cone / 2.0);
            comes_to("at the near side", &upto(-a + 1.0), 2.0 * a * h + (2.0 * a + 2.0) * strip + cone / 2.0);
        }
        if n == 8 {
            comes_to("on the near side", &upto(-a), 2.0 * a * strip + cone / 2.0);
            comes_to("on the far side", &upto(a), 4.0 * a * a * h + 6.0 * a * strip + cone / 2.0);
        }
    }
}

/// Ground that does not reach the edge of the pad: an island under it, a strip across it, a frame about it; and a hole under it.
#[test]
fn pads_about_their_ground() {
    let (a, h, k) = (6.0, 1.5, 0.5);
    let (strip, cone) = (h * h / (2.0 * k), PI * (h / k) * (h / k) * h / 3.0);
    let pad = || vec![rectangle([-a, -a, h], 2.0 * a, 2.0 * a)];
    for cells in [16, 32] {
        let site = |hole: Box2, inside: bool| Site::new(pad(), k, cut_out(about(16.0), [cells, cells], hole, inside));
        comes_to("an island", &site([[-4.0, -2.0], [4.0, 4.0]], true), 48.0 * h);
        comes_to("a strip", &site([[-4.0, -16.0], [2.0, 16.0]], true), 6.0 * 2.0 * a * h + 12.0 * strip);
        let whole = 4.0 * a * a * h + 8.0 * a * strip + cone;
        comes_to("a hole", &site([[-4.0, -2.0], [4.0, 4.0]], false), whole - 48.0 * h);
        comes_to("a hole across its edge", &site([[-2.0, -2.0], [2.0, 8.0]], false), whole - 32.0 * h - 4.0 * (strip - 0.5 * k));
    }
    // The works are not followed over a gap in the ground.
    let frame = Site::new(pad(), k, cut_out(about(16.0), [16, 16], about(8.0), false));
    comes_to("a frame", &frame, 0.0);
}

/// A level pad on a plane, the ground in two parts that meet on a line across it: what is built on either comes to what is built on
/// both. Rulings of level sides do not cross the line.
#[test]
fn two_halves_make_a_whole() {
    let random = &mut Random::new(77);
    for seed in 0..24_u32 {
        let name = format!("pad {seed}");
        let whole = |random: &mut Random, lo: f64, hi: f64| random.between(lo, hi + 1.0).floor();
        let (x, y, z) = (whole(random, -8.0, -2.0), whole(random, -6.0, 0.0), whole(random, -2.0, 2.0));
        let (length, width) = (whole(random, 2.0, 10.0), whole(random, 2.0, 6.0));
        let tilt = Tilt { level: 0.0, gradient: [0.125 * whole(random, -2.0, 2.0), 0.125 * whole(random, -2.0, 2.0)] };
        let line: Polyline = rectangle([x, y, z], length, width);
        let n = [64, 32, 16][random.below(3)];
        let step = 64.0 / n as f64;
        // On a line of the grid, along a side of the pad now and then.
        let at = (whole(random, x, x + length) / step).round() * step;
        let at = at.clamp((x / step).ceil() * step, ((x + length) / step).floor().max((x / step).ceil()) * step);
        let all = Ground::grid(about(32.0), n, n, |x, y| tilt.height(x, y));
        let half = |left: bool| all.only(|t| (t.iter().map(|p| p[0]).sum::<f64>() < 3.0 * at) == left);
        let mut sum = Figures::default();
        let mut bound = 0.0;
        for left in [true, false] {
            // The other half of the vertices is there now and then, used by nothing.
            let ground = if seed % 2 == 0 { half(left) } else { half(left).compact() };
            let site = Site::new(vec![line.clone()], 0.5, ground).cut_slope(1.0);
            let built = build(&site, "--allow-open");
            sound(&format!("{name}, {left}"), &site, &built);
            sum = sum + built.figures();
            bound += built.number("volumes.error_bound");
        }
        let expected = planar::pad(&line.points, tilt, 1.0, 0.5);
        for (what, found, wanted) in [("cut", sum.cut, expected.cut), ("fill", sum.fill, expected.fill)] {
            let slack = bound + 1e-9 * (1.0 + expected.cut + expected.fill);
            assert!((found - wanted).abs() <= slack, "{name} cut at {at}: {what} {found} for {wanted}, {slack}");
        }
    }
}

/// Pits whose rim lies partly beyond the ground: 12 by 12, 2 deep at 1:1 from level ground, of which the half with x < 0 is there.
#[test]
fn pits_over_the_edge() {
    for n in [4, 12] {
        let ground = cut_out(about(12.0), [n, n], [[-20.0, -20.0], [0.0, 20.0]], true);
        let site = Site::new(vec![rectangle([-6.0, -6.0, 0.0], 12.0, 12.0)], 1.0, ground);
        let built = build_in(
            &Folder::of(&site),
            "line.geojson --terrain ground.obj --slope 1:1 --side inside --direction down --to-elevation -2 --allow-open",
        );
        let found = built.figures();
        // Half of a frustum between 12 · 12 and 8 · 8.
        let cut = 2.0 / 3.0 * (144.0 + 96.0 + 64.0) / 2.0;
        assert!((found.cut - cut).abs() < 1e-9 * cut && found.fill == 0.0, "{found:?} for {cut}");
        sound("half a pit", &site, &built);
    }
}

/// Lines without ground below: in a hole, or with nothing but a piece on the ground. Never figures of nought without a word.
#[test]
fn lines_without_ground() {
    let ground = cut_out(about(20.0), [10, 10], about(8.0), false);
    let given = |x: f64| Site::new(vec![open(&[[-2.0, 0.0, 1.0], [x, 0.0, 1.0]])], 0.5, ground.clone());
    for (name, site, length) in [("in a hole", given(2.0), 4.0), ("out of a hole", given(12.0), 10.0)] {
        let folder = Folder::of(&site);
        let arguments = format!("build line.geojson --terrain ground.obj {} -o d.obj --finished f.obj", options(&site));
        let run = folder.run(&arguments);
        assert_eq!(run.code, 1, "{name}: {}", run.stderr);
        let told = format!("there is no ground under {length:.3} of the line");
        assert!(run.stderr.contains(&told) || run.stderr.contains("the slopes do not meet the ground"), "{name}: {}", run.stderr);
        assert!(run.stderr.contains("--allow-open"), "{name}: {}", run.stderr);
        let built = build(&site, "--allow-open");
        assert_eq!(built.report["volumes"]["complete"], false, "{name}");
        assert!(built.report["warnings"].to_string().contains("line-uncovered"), "{name}");
        sound(name, &site, &built);
    }
}
