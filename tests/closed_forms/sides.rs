//! Slopes on one side of the line, where those of the other side are not built but are part of the sheet all the same; and polygons
//! whose rings share a stretch.

use crate::common::build::{design, line, on_both_sheets, open, polygon, rectangle, ring};
use crate::common::measure::{close, height, plan_area};
use slopegen::model::{Design, Extent, Part, Side};
use slopegen::surface::{self, SurfaceError};
use std::f64::consts::PI;

/// A long line and a short one beside it, higher by 1. To the left of the long one its plane `−k·y` shows where the sheet of the other
/// one, `1 − k·distance`, is not higher: also where that is the side of it that is not built. The rulings at the ends of the long
/// line know nothing of it.
#[test]
fn the_other_side_of_a_line_beside_hides_what_it_covers() {
    let (length, end, k) = (300.0, -5.0, 0.5);
    for (from, to, aside) in [(70.0, 70.5, 5.0), (40.0, 60.0, 5.0), (100.0, 260.0, 1.5)] {
        let lines = line(&[open(&[[0.0, 0.0, 0.0], [length, 0.0, 0.0]]), open(&[[from, aside, 1.0], [to, aside, 1.0]])]);
        let left = Design { side_of_lines: Side::Left, ..design(k, Extent::Elevation(end)) };
        on_both_sheets(&lines, &left, |surface| {
            let (mut long, mut short) = (0, 0);
            for (i, j) in (0..600).flat_map(|i| (0..60).map(move |j| (i, j))) {
                // Off every edge and crease.
                let (x, y) = (0.251 + 0.5 * f64::from(i), 0.0123 + 0.25 * f64::from(j));
                let a = -k * y;
                let b = 1.0 - k * (x - x.clamp(from, to)).hypot(y - aside);
                if (a - b).abs() < 0.02 || (a.max(b) - end).abs() < 0.02 {
                    continue;
                }
                let built = if a > b { a > end } else { b > end && y > aside && x > from && x < to };
                let found = height(surface, x, y);
                assert_eq!(found.is_some(), built, "({x}, {y}): {found:?}, the two at {a} and {b}");
                if let Some(z) = found {
                    close(z, a.max(b), 1e-9, "height");
                    *(if a > b { &mut long } else { &mut short }) += 1;
                }
            }
            assert!(long > 1000 && short > 5, "{long} and {short} places");
        });
    }
}

/// The long edge of a pad, level at 0, with a peak at the edge across, 2 away and 1.4 high: that stands `1.4 − 2k` above it, far from
/// both of its ends.
#[test]
fn an_edge_under_the_peak_across_is_covered() {
    let pad = line(&[ring(&[[0.0, 0.0, 0.0], [300.0, 0.0, 0.0], [300.0, 2.0, 0.0], [50.0, 2.0, 1.4], [0.0, 2.0, 0.0]])]);
    for (k, depth) in [(2.0 / 3.0, Some("0.067")), (0.69, Some("0.020")), (0.71, None)] {
        match (surface::build(&pad, &design(k, Extent::Height(5.0)), None, &()), depth) {
            (Err(SurfaceError::PlatformCovered { x, what, .. }), Some(depth)) => {
                close(x, 50.0, 1e-6, "place of the greatest depth");
                assert!(what.contains(&format!("up to {depth} below")), "{what}");
            }
            (Ok(surface), None) => close(plan_area(&surface, Part::Platform), 600.0, 1e-9, "platform"),
            (other, _) => panic!("slope {k}: {:?}", other.map(|s| s.certificate)),
        }
    }
}

/// A hole at the edge of a square of 20: with a strip of the square between the two, however narrow, there are slopes outside and in
/// the hole. So there are where nothing is left of it. Slopes 1:1.5 of height 1 are 1.5 wide, and the hole of 8 by 4 keeps 5 by 1.
#[test]
fn a_hole_at_the_edge() {
    let square = || rectangle([0.0, 0.0, 0.0], 20.0, 20.0);
    let hole = |x: f64| rectangle([x, 4.0, 0.0], 8.0, 4.0);
    let wide = 1.5;
    for x in [0.0, 1e-3, 1.0, 12.0 - 1e-3, 12.0] {
        let pad = polygon(&[square(), hole(x)]);
        on_both_sheets(&pad, &design(1.0 / wide, Extent::Height(1.0)), |surface| {
            close(plan_area(surface, Part::Platform), 400.0 - 32.0, 1e-6, "platform");
            let slopes = 80.0 * wide + PI * wide * wide + 32.0 - 5.0 * 1.0;
            let found = surface.areas.plan - plan_area(surface, Part::Platform);
            // Chords of the corners.
            assert!(found < slopes + 1e-6 && found > slopes - 0.1, "hole at {x}: {found} for {slopes}");
        });
    }
    // Inside, slopes and floor fill what is left of the square.
    for x in [0.0, 12.0] {
        let pit = Design { side_of_rings: Side::Inside, ..design(1.0 / wide, Extent::Height(1.0)) };
        on_both_sheets(&polygon(&[square(), hole(x)]), &pit, |surface| close(surface.areas.plan, 368.0, 1e-6, "pit"));
    }
}

/// Two holes of 4 by 4 side by side: slopes run into both, from the edge they share too, and leave 1 by 1 of each.
#[test]
fn holes_side_by_side() {
    let hole = |x: f64| rectangle([x, 4.0, 0.0], 4.0, 4.0);
    let pad = polygon(&[rectangle([0.0, 0.0, 0.0], 20.0, 20.0), hole(4.0), hole(8.0)]);
    on_both_sheets(&pad, &design(1.0 / 1.5, Extent::Height(1.0)), |surface| {
        close(plan_area(surface, Part::Platform), 400.0 - 32.0, 1e-6, "platform");
        let slopes = 80.0 * 1.5 + PI * 1.5 * 1.5 + 2.0 * 15.0;
        let found = surface.areas.plan - plan_area(surface, Part::Platform);
        assert!(found < slopes + 1e-6 && found > slopes - 0.1, "{found} for {slopes}");
    });
}

/// Left and right of a ring are its inside or outside, as it runs. With slopes on the outside of a pad, a line along its edge has none
/// on the pad, whichever side of it is asked for; the slope beyond its end is its own.
#[test]
fn one_side_of_a_ring_and_of_a_line_along_it() {
    let (k, depth) = (0.5, 2.0);
    let wide = depth / k;
    let along = |from: f64, to: f64| open(&[[from, 0.0, 0.0], [to, 0.0, 0.0]]);
    // Counter-clockwise: its outside is on the right.
    for (mut pad, outside) in
        [(rectangle([0.0, 0.0, 0.0], 30.0, 20.0), Side::Right), (rectangle([0.0, 0.0, 0.0], 30.0, 20.0), Side::Left)]
    {
        if outside == Side::Left {
            pad.points.reverse();
        }
        for (from, to) in [(0.0, 30.0), (30.0, 0.0), (5.0, 25.0), (25.0, 5.0), (10.0, 40.0), (40.0, 10.0)] {
            let beyond = (f64::max(from, to) - 30.0).max(0.0);
            for side in [Side::Left, Side::Right, Side::Both] {
                let wanted = Design { side_of_rings: outside, side_of_lines: side, ..design(k, Extent::Height(depth)) };
                on_both_sheets(&line(&[pad.clone(), along(from, to)]), &wanted, |surface| {
                    close(plan_area(surface, Part::Platform), 600.0, 1e-9, "platform");
                    let slopes = surface.areas.plan - plan_area(surface, Part::Platform);
                    // Strips and four quarters of cones. Beyond the pad the strips of the line take the place of one quarter; where
                    // the one to the north meets that of the pad, half of a square goes to each, built or not.
                    let quarter = 0.25 * PI * wide * wide;
                    let northward = side == Side::Left && to > from || side == Side::Right && to < from;
                    let more = match side {
                        _ if beyond == 0.0 => 0.0,
                        Side::Both => 2.0 * beyond * wide - wide * wide + quarter,
                        _ if northward => beyond * wide - wide * wide - quarter,
                        _ => beyond * wide - 0.5 * wide * wide - quarter,
                    };
                    let expected = 100.0 * wide + 4.0 * quarter + more;
                    // Chords of cones.
                    assert!(slopes < expected + 1e-6 && slopes > expected - 0.3, "{side:?} {from} {to}: {slopes} for {expected}");
                });
            }
        }
    }
}

/// Two pads side by side that run round in opposite ways: right of one is outside, right of the other inside. On the edge they share the
/// slope of the second begins, and the platform of the first.
#[test]
fn rings_of_both_directions_side_by_side() {
    let (k, depth) = (0.5, 2.0);
    let wide = depth / k;
    let mut inward = rectangle([30.0, 0.0, 0.0], 40.0, 20.0);
    inward.points.reverse();
    for rings in
        [[rectangle([0.0, 0.0, 0.0], 30.0, 20.0), inward.clone()], [inward.clone(), rectangle([0.0, 0.0, 0.0], 30.0, 20.0)]]
    {
        let right = Design { side_of_rings: Side::Right, ..design(k, Extent::Height(depth)) };
        on_both_sheets(&line(&rings), &right, |surface| {
            close(plan_area(surface, Part::Platform), 600.0, 1e-9, "platform");
            // About three sides of the first, with two corners; within the second all of it but the middle. Where the outer slopes of the
            // first meet the line of the second, they end at the ruling across.
            let inside = 40.0 * 20.0 - (40.0 - 2.0 * wide) * (20.0 - 2.0 * wide);
            let outside = 80.0 * wide + 2.0 * 0.25 * PI * wide * wide;
            let found = surface.areas.plan - 600.0;
            let expected = inside + outside;
            assert!(found < expected + 1e-6 && found > expected - 0.2, "{found} for {expected}");
        });
    }
}
