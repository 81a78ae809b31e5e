//! On which side of a ring another ring passes where they touch.

use super::Segment;
pub(super) use crate::kernel::orientation::doubled_area as orient;
use crate::kernel::segment::between;
use crate::model::Chain;
use glam::DVec2;

/// Whether the corner turns straight back.
pub(super) fn is_spike(before: DVec2, corner: DVec2, after: DVec2) -> bool {
    orient(before, corner, after) == 0.0 && same_direction(corner, before, after)
}

/// Whether `a` and `b`, collinear with `from`, lie on one side of it. Signs of differences are exact.
fn same_direction(from: DVec2, a: DVec2, b: DVec2) -> bool {
    let (u, v) = (a - from, b - from);
    if u.x.abs() >= u.y.abs() { (u.x > 0.0) == (v.x > 0.0) && v.x != 0.0 } else { (u.y > 0.0) == (v.y > 0.0) && v.y != 0.0 }
}

/// Where two rings that do not cross properly touch: on which sides of the first the second leaves its contacts.
///
/// Away from contacts the second ring stays on one side of the first. So it crosses the first, through vertices or along
/// common stretches, exactly if both sides occur; and it is the same ring if none does.
#[derive(Clone, Debug, Default)]
pub(super) struct Contacts {
    /// The first contact found, for messages.
    pub(super) first: Option<(Segment, Segment, DVec2)>,
    /// The second ring is left of the first somewhere.
    pub(super) left: bool,
    /// The second ring is right of the first somewhere.
    pub(super) right: bool,
}

impl Contacts {
    /// Adds the contacts of segment `s` of ring `first` with segment `t` of ring `second`, which touch.
    pub(super) fn add(&mut self, first: &Chain, s: Segment, second: &Chain, t: Segment) {
        for p in [t.a, t.b] {
            if orient(s.a, s.b, p) == 0.0 && between(p, [s.a, s.b]) {
                self.at(first, s, second, t, p);
            }
        }
        for p in [s.a, s.b] {
            if p != t.a && p != t.b && orient(t.a, t.b, p) == 0.0 && between(p, [t.a, t.b]) {
                self.at(first, s, second, t, p);
            }
        }
    }

    fn at(&mut self, first: &Chain, s: Segment, second: &Chain, t: Segment, p: DVec2) {
        self.first.get_or_insert((s, t, p));
        let (before, after) = around(first, s, p);
        let (coming, going) = around(second, t, p);
        for q in [coming, going] {
            let along = |w: DVec2| orient(p, w, q) == 0.0 && same_direction(p, w, q);
            if along(before) || along(after) {
                continue;
            }
            let (from, to) = (orient(before, p, q) > 0.0, orient(p, after, q) > 0.0);
            // In the narrow part of a corner both lines must agree, in the wide part one is enough.
            let left = if orient(before, p, after) >= 0.0 { from && to } else { from || to };
            if left {
                self.left = true;
            } else {
                self.right = true;
            }
        }
    }
}

/// The vertices before and after the point `p` of segment `s`: its ends, unless `p` is one of them.
fn around(chain: &Chain, s: Segment, p: DVec2) -> (DVec2, DVec2) {
    let n = chain.vertices.len();
    let vertex = |i: usize| chain.vertices[i % n].truncate();
    if p == s.a {
        (vertex(s.index + n - 1), s.b)
    } else if p == s.b {
        (s.a, vertex(s.index + 2))
    } else {
        (s.a, s.b)
    }
}
