//! Ends at a distance and at a height below the line. Off the creases every point has one foot on the line, so the plan area
//! within reach is the sum over strips and sectors.

use crate::common::build::{design, line, on_both_sheets, open, rectangle};
use crate::common::measure::{close, curves, not_above};
use slopegen::model::{CurveKind, Design, Extent, Side};
use std::f64::consts::PI;

const EXACT: f64 = 1e-9;

/// Both ways to say the same end.
fn ends(reach: f64, k: f64) -> [Extent; 2] {
    [Extent::Distance(reach), Extent::Height(reach * k)]
}

#[test]
fn around_a_level_pad() {
    let (l, w, z, k, reach) = (33.0, 21.0, 7.0, 0.6, 8.0);
    for extent in ends(reach, k) {
        on_both_sheets(&line(&[rectangle([0.0, 0.0, z], l, w)]), &design(k, extent), |surface| {
            let plan = l * w + 2.0 * (l + w) * reach + PI * reach * reach;
            not_above(surface.areas.plan, plan, surface.volumes.error_bound / k, "plan area");
            close(surface.volumes.reference, z - k * reach, EXACT, "plane at the end");
            for p in curves(surface, CurveKind::Boundary).flat_map(|c| &c.points) {
                assert!((p.z - (z - k * reach)).abs() < 1e-9, "{p} is not at the end");
            }
        });
    }
}

/// Inside a level rectangle: a frame of width `reach`, and its floor; wider than half the rectangle, all of it.
#[test]
fn inside_a_level_rectangle() {
    let (l, w, z, k) = (30.0, 16.0, 2.0, 0.5);
    for reach in [3.0, 20.0] {
        for extent in ends(reach, k) {
            let wanted = Design { side_of_rings: Side::Inside, ..design(k, extent) };
            on_both_sheets(&line(&[rectangle([0.0, 0.0, z], l, w)]), &wanted, |surface| {
                let [a, b] = [l, w].map(|side| f64::max(side - 2.0 * reach, 0.0));
                close(surface.areas.plan, l * w, EXACT, "plan area");
                assert!((surface.areas.platform - if b > 0.0 { a * b } else { 0.0 }).abs() < EXACT * l * w, "floor");
                close(surface.volumes.cut_max, k * reach.min(w / 2.0), EXACT, "depth");
            });
        }
    }
}

/// A sloping segment: two parallelograms `l` by `reach`, leaning by `φ`, and sectors of `π + 2φ` and `π − 2φ`, one disc in all.
#[test]
fn along_a_sloping_segment() {
    let (l, rise, k, reach) = (26.0, 7.8, 0.5_f64, 5.0);
    let phi = (rise / l / k).asin();
    let given = line(&[open(&[[1.0, 2.0, 3.0], [1.0 + 0.6 * l, 2.0 + 0.8 * l, 3.0 + rise]])]);
    for extent in ends(reach, k) {
        on_both_sheets(&given, &design(k, extent), |surface| {
            let plan = 2.0 * l * reach * phi.cos() + PI * reach * reach;
            not_above(surface.areas.plan, plan, surface.volumes.error_bound / k, "plan area");
        });
        for side in [Side::Left, Side::Right] {
            let wanted = Design { side_of_lines: side, ..design(k, extent) };
            on_both_sheets(&given, &wanted, |surface| {
                close(surface.areas.plan, l * reach * phi.cos(), EXACT, "strip");
                // The far edge runs parallel to the line, k·reach below it: its end above the higher end of the line is the
                // foot less the drop. The plane of volumes is the lowest point.
                close(surface.volumes.reference, 3.0 - k * reach, EXACT, "plane at the end");
                // Over the strip the height above that plane grows from 0 at its lowest to rise + k·reach: the mean of the
                // four corners, as a plane over a parallelogram.
                close(surface.volumes.fill, (rise + k * reach) / 2.0 * l * reach * phi.cos(), EXACT, "volume");
            });
        }
    }
}

/// A bend by the angle `β` of a level line: on the outer side a sector of `β`, on the inner side strips cut short where they
/// meet: `tan(β/2)·reach²` less.
#[test]
fn around_a_bend() {
    let (l, k, reach, bend) = (40.0, 0.5, 6.0, 0.9_f64);
    let given = line(&[open(&[[-l, 0.0, 1.0], [0.0, 0.0, 1.0], [l * bend.cos(), l * bend.sin(), 1.0]])]);
    for extent in ends(reach, k) {
        on_both_sheets(&given, &design(k, extent), |surface| {
            let inner = 2.0 * l * reach - reach * reach * (bend / 2.0).tan();
            let plan = inner + 2.0 * l * reach + (bend / 2.0 + PI / 2.0) * reach * reach + (PI / 2.0) * reach * reach;
            not_above(surface.areas.plan, plan, surface.volumes.error_bound / k, "plan area");
        });
        let left = Design { side_of_lines: Side::Left, ..design(k, extent) };
        on_both_sheets(&given, &left, |surface| {
            let plan = 2.0 * l * reach - reach * reach * (bend / 2.0).tan();
            close(surface.areas.plan, plan, EXACT, "inner side");
        });
        let right = Design { side_of_lines: Side::Right, ..design(k, extent) };
        on_both_sheets(&given, &right, |surface| {
            let plan = 2.0 * l * reach + bend / 2.0 * reach * reach;
            not_above(surface.areas.plan, plan, surface.volumes.error_bound / k, "outer side");
        });
    }
}
