//! Level rings: pads, pits, roofs, holes, cones.

use crate::common::build::{design, line, on_both_sheets, open, polygon, rectangle, regular};
use crate::common::measure::{close, curves, length, level_length, net_above, not_above, plan_area};
use slopegen::model::{CurveKind, Design, Extent, Part, Side};
use slopegen::selftest::formulas::{parallel_area, parallel_volume, pit_volume, roof_creases, roof_volume};
use slopegen::surface;
use std::f64::consts::{PI, TAU};

/// Polyhedral figures: rounding of sums of a few hundred terms.
const EXACT: f64 = 1e-9;

#[test]
fn pad() {
    for (l, w, h, k) in [(30.0, 30.0, 4.0, 0.5), (50.0, 20.0, 7.0, 2.0 / 3.0), (40.0, 25.0, 3.0, 2.0)] {
        let (n, a, p) = (1.0 / k, l * w, 2.0 * (l + w));
        // Levels are whole multiples of the interval: the end is one too.
        let end = 2.0 * h;
        let wanted = Design { interval: Some(h / 8.0), ..design(k, Extent::Elevation(end)) };
        on_both_sheets(&line(&[rectangle([10.0, -5.0, end + h], l, w)]), &wanted, |surface| {
            let (v, bound) = (&surface.volumes, surface.volumes.error_bound);
            // Chords take a third c of the tolerance, and only on cones: π n² h² in plan, and a strip c n wide along arcs of 2π n h.
            let c = wanted.tolerance / 3.0;
            let layer = c * PI * (n * h).powi(2) + c * c * n * TAU * n * h;
            assert!(bound <= layer * (1.0 + EXACT), "bound {bound}");
            not_above(v.fill, parallel_volume(a, p, n, h), bound, "fill");
            assert_eq!((v.cut, v.cut_max, v.reference), (0.0, 0.0, end));
            close(v.fill_max, h, EXACT, "greatest fill");
            not_above(surface.areas.plan, parallel_area(a, p, n * h), bound * n, "plan area");
            close(surface.areas.platform, a, EXACT, "platform");
            assert_eq!(surface.areas.cut_slope, 0.0);
            // Slope k: √(1 + k²) of the plan area; chord planes on cones are steeper by up to 0.05°, that is 0.1 % of 1 + k².
            let slope_plan = parallel_area(a, p, n * h) - a;
            close(surface.areas.fill_slope, slope_plan * 1.0_f64.hypot(k), 1e-3, "slope area");
            assert_eq!(surface.levels.len(), 7);
            for i in 1..8 {
                // A chord at sagitta s = (tolerance/3)/k and radius r is short of its arc by the factor θ²/24, s = rθ²/8: by s/3r
                // of 2πr in all.
                let depth = h * f64::from(i) / 8.0;
                let short = TAU / 3.0 * wanted.tolerance / (3.0 * k);
                not_above(level_length(surface, end + h - depth), p + TAU * n * depth, short, "level curve");
            }
            assert_eq!(curves(surface, CurveKind::Valley).count() + curves(surface, CurveKind::Ridge).count(), 0);
            close(length(surface, CurveKind::Hinge), p, EXACT, "hinge");
        });
    }
}

#[test]
fn pit() {
    for (l, w, d, k) in [(60.0, 35.0, 6.0, 0.5), (20.0, 20.0, 4.0, 1.0), (90.0, 31.0, 8.0, 0.75)] {
        let n = 1.0 / k;
        let floor = (l - 2.0 * n * d) * (w - 2.0 * n * d);
        let wanted = Design { side_of_rings: Side::Inside, ..design(k, Extent::Elevation(50.0 - d)) };
        on_both_sheets(&line(&[rectangle([0.0, 0.0, 50.0], l, w)]), &wanted, |surface| {
            let v = &surface.volumes;
            close(v.cut, pit_volume(l, w, n, d), EXACT, "cut");
            assert_eq!((v.fill, v.error_bound, v.reference), (0.0, 0.0, 50.0));
            close(v.cut_max, d, EXACT, "depth");
            close(surface.areas.plan, l * w, EXACT, "plan area");
            close(surface.areas.platform, floor, EXACT, "floor");
            close(surface.areas.fill_slope, (l * w - floor) * 1.0_f64.hypot(k), EXACT, "slopes");
            // Four creases under 45° in plan, n·d aside and d down.
            close(length(surface, CurveKind::Valley), 4.0 * (2.0 * n * n + 1.0).sqrt() * d, EXACT, "creases");
            close(net_above(surface, 50.0), -pit_volume(l, w, n, d), EXACT, "own sum");
        });
    }
}

/// Slopes inwards with nothing to stop them meet over the middle line: a hip roof, height `k·w/2`, upside down when falling.
#[test]
fn roof() {
    for (l, w, k) in [(40.0, 18.0, 0.6), (25.0, 25.0, 1.0), (33.0, 10.0, 2.5)] {
        let wanted = Design { side_of_rings: Side::Inside, ..design(k, Extent::Elevation(-1000.0)) };
        on_both_sheets(&line(&[rectangle([-7.0, 3.0, 5.0], l, w)]), &wanted, |surface| {
            let v = &surface.volumes;
            close(v.cut, roof_volume(l, w, k), EXACT, "volume under the eaves");
            close(v.cut_max, k * w / 2.0, EXACT, "height");
            close(surface.areas.plan, l * w, EXACT, "plan area");
            close(surface.areas.fill_slope, l * w * 1.0_f64.hypot(k), EXACT, "slopes");
            assert_eq!(surface.areas.platform, 0.0);
            close(length(surface, CurveKind::Valley), roof_creases(l, w, k), EXACT, "hips and ridge");
            assert_eq!(curves(surface, CurveKind::Boundary).count(), 0);
        });
    }
}

/// A platform with a rectangular hole: outside of the polygon lie the far side and the hole, a shaft that narrows downwards.
#[test]
fn ring_with_a_hole() {
    let (l, w, a, b, h, k) = (80.0, 60.0, 30.0, 22.0, 4.0, 0.5);
    let n = 1.0 / k;
    let given = polygon(&[rectangle([0.0, 0.0, h], l, w), rectangle([20.0, 15.0, h], a, b)]);
    on_both_sheets(&given, &design(k, Extent::Elevation(0.0)), |surface| {
        let bound = surface.volumes.error_bound;
        let fill = parallel_volume(l * w, 2.0 * (l + w), n, h) - pit_volume(a, b, n, h);
        not_above(surface.volumes.fill, fill, bound, "fill");
        close(surface.areas.platform, l * w - a * b, EXACT, "platform");
        let open = (a - 2.0 * n * h) * (b - 2.0 * n * h);
        not_above(surface.areas.plan, parallel_area(l * w, 2.0 * (l + w), n * h) - open, n * bound, "plan area");
    });
    // Inside of the polygon the slopes run from both rings towards each other. They meet nowhere at this depth: the floor is what
    // is left of the rectangle, less all within n·d of the hole.
    let d = 2.0;
    let inside = Design { side_of_rings: Side::Inside, ..design(k, Extent::Elevation(h - d)) };
    on_both_sheets(&given, &inside, |surface| {
        let bound = surface.volumes.error_bound;
        let left = (l - 2.0 * n * d) * (w - 2.0 * n * d) - parallel_area(a * b, 2.0 * (a + b), n * d);
        close(surface.areas.plan, l * w - a * b, EXACT, "plan area");
        let chords = n * bound;
        assert!((surface.areas.platform - left).abs() <= chords, "floor {} for {left}", surface.areas.platform);
        // Dug: what the pit digs, less the hole and the slopes around it down to the floor, ∫₀ᵈ of the parallel area.
        let cut = pit_volume(l, w, n, d) - parallel_volume(a * b, 2.0 * (a + b), n, d);
        assert!((surface.volumes.cut - cut).abs() <= bound, "cut {} for {cut}", surface.volumes.cut);
    });
}

/// A regular polygon: exact by Steiner's formula; with many corners a frustum, with a tiny radius a cone.
#[test]
fn cone() {
    let k = 0.5;
    let n = 1.0 / k;
    for (corners, radius, h) in [(3, 5.0, 2.0), (6, 12.0, 5.0), (90, 12.0, 5.0), (8, 1e-3, 4.0), (90, 0.5, 30.0)] {
        let wanted = Design { tolerance: 1e-4, ..design(k, Extent::Elevation(0.0)) };
        on_both_sheets(&line(&[regular(corners, radius, h)]), &wanted, |surface| {
            let half = PI / corners as f64;
            let (a, p) = (corners as f64 * radius * radius * half.sin() * half.cos(), 2.0 * corners as f64 * radius * half.sin());
            let v = &surface.volumes;
            let expected = parallel_volume(a, p, n, h);
            // Simplification moves the line both ways.
            assert!((v.fill - expected).abs() <= v.error_bound + EXACT * expected, "{corners}: {} for {expected}", v.fill);
            assert!(v.error_bound <= 2.0 / 3.0 * wanted.tolerance * surface.areas.plan, "{corners}: {}", v.error_bound);
            // The frustum from r to r + nh, πh/3·(r² + rR + R²): the polygon is inside the circle by r(1 − cos) at most.
            let far = radius + n * h;
            let frustum = |r: f64| PI * h / 3.0 * (r * r + r * (r + n * h) + (r + n * h).powi(2));
            not_above(v.fill, frustum(radius), frustum(radius) - frustum(radius * half.cos()) + v.error_bound, "frustum");
            assert!(surface.areas.plan <= PI * far * far);
        });
    }
}

/// A plane between foot and top, on no level: above it stands the upper part of the pad, below it lie the slopes outside, up to
/// `∫ (A(h) − A(t)) dt` over depths `t` from the plane to the foot.
#[test]
fn cut_and_fill_against_a_plane_in_between() {
    let (l, w, h, k, plane) = (30.0, 20.0, 6.0, 0.5, 2.3);
    let (n, a, p) = (1.0 / k, l * w, 2.0 * (l + w));
    let given = line(&[rectangle([0.0, 0.0, h], l, w)]);
    let surface = surface::build(&given, &design(k, Extent::Elevation(0.0)), Some(plane), &()).expect("a pad");
    assert!(surface.levels.iter().all(|z| (z - plane).abs() > 0.1), "{:?}", surface.levels);
    let v = &surface.volumes;
    not_above(v.fill, parallel_volume(a, p, n, h - plane), v.error_bound, "fill");
    let cut = parallel_area(a, p, n * h) * plane - (parallel_volume(a, p, n, h) - parallel_volume(a, p, n, h - plane));
    // Chords: short of the plan area at the foot as well.
    assert!((v.cut - cut).abs() <= v.error_bound * (1.0 + n * plane), "cut {} for {cut}", v.cut);
    close(v.fill - v.cut, net_above(&surface, plane), EXACT, "net");
    close(v.fill_max, h - plane, EXACT, "greatest fill");
    close(v.cut_max, plane, EXACT, "greatest cut");
    close(plan_area(&surface, Part::Platform), a, EXACT, "platform");
}

/// The same without cones: a pit whose slopes a plane cuts, at a depth on no level. Below it lies what a pit from there would
/// dig, above it the rest.
#[test]
fn a_plane_through_a_pit() {
    let (l, w, d, k, depth) = (60.0, 40.0, 6.0, 0.5, 2.37);
    let n = 1.0 / k;
    let wanted = Design { side_of_rings: Side::Inside, ..design(k, Extent::Elevation(-d)) };
    let surface = surface::build(&line(&[rectangle([0.0, 0.0, 0.0], l, w)]), &wanted, Some(-depth), &()).expect("a pit");
    let cut = pit_volume(l - 2.0 * n * depth, w - 2.0 * n * depth, n, d - depth);
    close(surface.volumes.cut, cut, EXACT, "below the plane");
    close(surface.volumes.fill, l * w * depth - (pit_volume(l, w, n, d) - cut), EXACT, "above the plane");
}

/// A line along the edge of a pad has its slopes on the outer side only: the platform stays whole, whichever of the two comes first.
#[test]
fn a_line_along_the_edge_of_a_pad() {
    let pad = rectangle([0.0, 0.0, 0.0], 20.0, 10.0);
    let along = open(&[[5.0, 0.0, 0.0], [15.0, 0.0, 0.0]]);
    let wanted =
        slopegen::model::Design { side_of_rings: slopegen::model::Side::Outside, ..design(0.5, Extent::Elevation(-2.0)) };
    let area = |lines: &[crate::common::oracle::Polyline]| {
        let built = surface::build(&line(lines), &wanted, None, &()).unwrap();
        assert!((built.areas.platform - 200.0).abs() < 1e-9, "{}", built.areas.platform);
        built.areas.plan
    };
    let alone = area(std::slice::from_ref(&pad));
    for lines in [[pad.clone(), along.clone()], [along, pad]] {
        let found = area(&lines);
        assert!((found - alone).abs() < 1e-9 * alone, "{found} for {alone}");
    }
}
