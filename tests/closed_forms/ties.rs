//! Lines whose sheets tie: mirrored notches, points where hundreds of sheets meet, and coordinates so large that rounding shows.

use crate::common::build::{build, design, line, mirrored, mirrored_design, on_both_sheets, open, regular, ring, upside_down};
use crate::common::measure::{close, height, plan_area};
use crate::common::oracle::Polyline;
use slopegen::model::{Design, Extent, Part, Side};
use slopegen::surface::Surface;
use std::f64::consts::PI;

fn joggled(surface: &Surface) -> bool {
    surface.notes.iter().any(|note| note.code == "line-joggled")
}

/// A level star of `2·spikes` corners on two circles about the origin.
fn star(spikes: usize, inner: f64, outer: f64) -> Polyline {
    let corner = |i: usize| {
        let (sin, cos) = (PI * i as f64 / spikes as f64).sin_cos();
        let radius = if i.is_multiple_of(2) { inner } else { outer };
        [radius * cos, radius * sin, 0.0]
    };
    ring(&(0..2 * spikes).map(corner).collect::<Vec<_>>())
}

/// Distance in plan from a point to a ring.
fn distance(ring: &Polyline, x: f64, y: f64) -> f64 {
    let n = ring.points.len();
    let to = |i: usize| {
        let ([ax, ay, _], [bx, by, _]) = (ring.points[i], ring.points[(i + 1) % n]);
        let (ux, uy) = (bx - ax, by - ay);
        let t = (((x - ax) * ux + (y - ay) * uy) / (ux * ux + uy * uy)).clamp(0.0, 1.0);
        (x - ax - t * ux).hypot(y - ay - t * uy)
    };
    (0..n).map(to).fold(f64::INFINITY, f64::min)
}

/// Between two spikes of a star everything is its own mirror image: strips and cones of both sides meet in one point, all but. The
/// line is built as it is, and the height is `−k·distance`.
#[test]
fn the_notches_of_a_star() {
    let (k, tolerance) = (2.0 / 3.0, 0.05);
    for (spikes, side, end) in
        [(55, Side::Outside, 20.0), (60, Side::Outside, 8.0), (100, Side::Outside, 20.0), (70, Side::Inside, 400.0)]
    {
        let ring = star(spikes, 350.0, 500.0);
        let wanted = Design { side_of_rings: side, tolerance, ..design(k, Extent::Elevation(-end)) };
        on_both_sheets(&line(std::slice::from_ref(&ring)), &wanted, |surface| {
            assert!(!joggled(surface), "{spikes} spikes");
            let mut seen = 0;
            for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
                // Two of the spikes, off every line of symmetry.
                let (sin, cos) = (0.001 + 0.13 * f64::from(i) / 12.0).sin_cos();
                let radius = 340.3 + 15.0 * f64::from(j);
                let (x, y) = (radius * cos, radius * sin);
                let expected = -k * distance(&ring, x, y);
                if let Some(z) = height(surface, x, y).filter(|z| *z < 0.0) {
                    assert!((z - expected).abs() <= tolerance, "({x}, {y}): {z} for {expected}");
                    seen += 1;
                }
            }
            assert!(seen > 20, "{seen} places");
        });
    }
}

/// The middle of a regular polygon, where all strips meet but for rounding: the volume under it is that of a pyramid. Hundreds of
/// corners are seen through; with more, heights are told apart by moving the line a little, by a tenth of the tolerance at most.
#[test]
fn the_middle_of_a_polygon_of_very_many_corners() {
    let k = 2.0 / 3.0;
    for (corners, tolerance) in [(300, 1e-6), (1600, 1e-6), (1600, 1e-4)] {
        let radius = 500.0;
        let half = PI / corners as f64;
        let (area, depth) = (corners as f64 * radius * radius * half.sin() * half.cos(), k * radius * half.cos());
        let wanted = Design { side_of_rings: Side::Inside, tolerance, ..design(k, Extent::Elevation(-1000.0)) };
        let surface = build(&line(&[regular(corners, radius, 0.0)]), &wanted);
        assert_eq!(joggled(&surface), corners > 1000);
        let moved = 0.1 * tolerance;
        close(plan_area(&surface, Part::FillSlope), area, 1e-9, "plan area");
        let volume = area * depth / 3.0;
        assert!((surface.volumes.cut - volume).abs() <= moved * area + 1e-12 * volume, "{} for {volume}", surface.volumes.cut);
        assert!((surface.volumes.cut_max - depth).abs() <= moved + 1e-12 * depth, "{} for {depth}", surface.volumes.cut_max);
    }
}

/// The second segment lies exactly in the slope of the first: the rulings of that one run to the north, level for level. Moved apart
/// by a hair, the second segment either ends the slope, or is covered, and the slope goes on beyond: on one side of the line two
/// surfaces of different extent. A tie is one of the two, told, and the same for the line upside down.
///
/// Where the slope ends, the right side is the triangle (0, 0), (0, 5), (−15, 5) and, on the right of the second segment, what is
/// not under the cone of the first vertex: `10 + 2(5 − y) < 2√(x² + y²)` for `x` from 0 to 5, so `y > 5 − x²/20`; what the last segment
/// adds is less than 0.02.
#[test]
fn a_segment_in_the_slope_of_another() {
    let end = 34.627_416_997_969_52;
    let at = |aside: f64, side: Side| {
        let points = [[0.0, aside, 0.0], [-15.0, 5.0, -10.0], [5.0, 5.0, -10.0], [-5.0, -5.0, 2.0 - end]];
        let wanted = Design { side_of_lines: side, tolerance: 0.06, ..design(2.0, Extent::Elevation(-end)) };
        let given = line(&[open(&points)]);
        let surface = build(&given, &wanted);
        let mirror = mirrored(build(&upside_down(&given), &mirrored_design(&wanted)));
        assert_eq!(surface.tin.vertices, mirror.tin.vertices);
        assert_eq!(surface.volumes, mirror.volumes);
        assert_eq!(joggled(&surface), aside == 0.0);
        surface.areas.plan
    };
    let triangle = 0.5 * 15.0 * 5.0 + 125.0 / 60.0;
    close(at(-1e-6, Side::Right), triangle, 0.02, "clear of the slope");
    for side in [Side::Left, Side::Right, Side::Both] {
        let [clear, tie, covered] = [-1e-6, 0.0, 1e-6].map(|aside| at(aside, side));
        if side == Side::Both {
            close(clear, covered, 0.05, "both sides");
        } else {
            assert!((clear - covered).abs() > 100.0, "{side:?}: {clear}, {covered}");
        }
        // Shifts of up to 6·10⁻⁵ move the crease of two planes that differ by little.
        assert!((tie - clear).abs() < 0.5 || (tie - covered).abs() < 0.5, "{side:?}: {tie} for {clear} or {covered}");
    }
}

/// Half a million length units from end to end: coordinates are rounded by 3·10⁻¹¹, which turns a triangle 10⁻⁷ wide by more than what
/// a strip may be off. It is no fault of the surface.
#[test]
fn slivers_far_from_the_local_origin() {
    let points = [
        [0.0, 5_400_000.0, 100.0],
        [499_950.502, 5_399_707.151, 95.452],
        [499_951.504, 5_399_707.181, 95.4484],
        [499_952.003, 5_399_707.191, 95.4503],
        [499_960.003, 5_399_707.461, 95.4453],
    ];
    let wanted = Design { tolerance: 0.01, ..design(2.0 / 3.0, Extent::Height(5.0)) };
    let surface = build(&line(&[open(&points)]), &wanted);
    assert!(!joggled(&surface) && surface.certificate.strip_max_deviation_deg < 0.01);
}
