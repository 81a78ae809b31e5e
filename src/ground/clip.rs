//! The part of a cell in the works.

use super::cell::{Corner, Label, Side, class};
use super::patch::{NONE, Patch};
use super::shape::Shape;
use crate::model::Part;

/// Which side of the ground counts for a part of the design: above (1), below (−1), or both. `whole`: both for all of it.
pub(super) fn sense(part: Part, whole: bool) -> Option<f64> {
    match part {
        Part::CutSlope if !whole => Some(-1.0),
        Part::FillSlope if !whole => Some(1.0),
        _ => None,
    }
}

/// The part of a cell above the ground (`sense` 1) or below it (−1); empty unless a corner is.
pub(super) fn clip(shape: &Shape, patch: &Patch, ab: (u32, u32), corners: &[Corner], sense: f64, kept: &mut Vec<Corner>) {
    kept.clear();
    let sign = |c: &Corner| class(sense * c.h);
    if !corners.iter().any(|c| sign(c) > 0) {
        return;
    }
    for (n, corner) in corners.iter().enumerate() {
        let next = &corners[(n + 1) % corners.len()];
        match (sign(corner), sign(next)) {
            (0.., 0..) => kept.push(*corner),
            (0, _) => kept.push(Corner { side: Side::INSIDE, ..*corner }),
            (1.., _) => {
                kept.push(*corner);
                kept.push(Corner { side: Side::INSIDE, ..meeting(shape, patch, ab, corner, next) });
            }
            (_, 1..) => kept.push(Corner { side: corner.side, ..meeting(shape, patch, ab, corner, next) }),
            _ => {}
        }
    }
}

/// The cell with a corner wherever a side meets the ground.
pub(super) fn split_sides(shape: &Shape, patch: &Patch, ab: (u32, u32), corners: &[Corner], out: &mut Vec<Corner>) {
    out.clear();
    for (n, corner) in corners.iter().enumerate() {
        let next = &corners[(n + 1) % corners.len()];
        out.push(*corner);
        if class(corner.h) * class(next.h) < 0 {
            out.push(Corner { side: corner.side, ..meeting(shape, patch, ab, corner, next) });
        }
    }
}

/// Where the side from `p` to `q` meets the ground: the same from every cell around.
fn meeting(shape: &Shape, patch: &Patch, (a, b): (u32, u32), p: &Corner, q: &Corner) -> Corner {
    let label = match (p.side.design, p.side.ground) {
        (Some(i), Some(j)) => Label::EdgesMeet(shape.edge(a, i), patch.edge(b, j)),
        (Some(i), None) => Label::DesignMeets(shape.edge(a, i), b),
        (None, j) => Label::GroundMeets(patch.edge(b, j.unwrap_or(0)), a),
    };
    let bit = |side: Option<u8>| side.map_or(0, |i| 1 << i);
    let (on_design, on_ground) = (bit(p.side.design), bit(p.side.ground));
    let (first, second) = if p.label <= q.label { (p, q) } else { (q, p) };
    let t = first.h / (first.h - second.h);
    let at = first.at.lerp(second.at, t);
    // On an edge of the ground alone, the height of that edge.
    let lift = if p.side.design.is_some() { 0.0 } else { 1.0 };
    let height = |c: &Corner| c.z - lift * c.h;
    Corner {
        label,
        at,
        z: height(first) + t * (height(second) - height(first)),
        h: 0.0,
        vertex: NONE,
        on_design,
        on_ground,
        side: Side::INSIDE,
    }
}
