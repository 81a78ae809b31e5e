//! Lines whose sheets tie: mirrored notches, points where hundreds of sheets meet, and coordinates so large that rounding shows.

use crate::common::build::{build, design, line, on_both_sheets, open, regular, ring};
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
