//! A bounding volume hierarchy over segments, for the upper envelope of their sheets.

use glam::DVec2;

use super::focus::Focus;
use super::node::{self, NO_FOCUS, Node, Tree};
use super::{Ruling, Segment};

/// Room on the stack of a traversal. Halving 2³² segments takes 32 levels, and each level leaves one node behind.
const STACK: usize = 40;
/// Relative slack of bounds, in units of the scale of the numbers: several times the rounding of one height.
const SLACK: f64 = 64.0 * f64::EPSILON;

/// The index. Segments keep the numbers they came with; inside, they are stored leaf by leaf.
#[derive(Clone, Debug)]
pub struct Index {
    k: f64,
    nodes: Vec<Node>,
    foci: Vec<Focus>,
    /// In the order of the leaves.
    segments: Vec<Segment>,
    /// Number of each stored segment.
    ids: Vec<u32>,
    /// Where each number is stored.
    slots: Vec<u32>,
    /// Middle of everything in plan, half the diagonal, and the greatest height in magnitude: the scale of rounding.
    centre: DVec2,
    reach: f64,
    magnitude: f64,
}

impl Index {
    /// Builds the index for a side slope of `k` rise per run, in O(n log n); the same segments give the same index.
    ///
    /// Precondition: at least one segment, fewer than 2³¹, all built with this `k`.
    pub fn new(segments: &[Segment], k: f64) -> Self {
        debug_assert!(!segments.is_empty(), "bug: an index of no segments");
        let Tree { ids, segments, nodes, foci } = node::build(segments, k);
        let mut slots = vec![0; ids.len()];
        for (slot, &id) in ids.iter().enumerate() {
            slots[id as usize] = slot as u32;
        }
        let magnitude = segments.iter().fold(0.0, |m: f64, s| m.max(s.za.abs()).max(s.zb.abs()));
        let (centre, reach) = (nodes[0].centre, nodes[0].half.length());
        Self { k, nodes, foci, segments, ids, slots, centre, reach, magnitude }
    }

    /// The side slope, rise per run.
    #[inline]
    pub fn k(&self) -> f64 {
        self.k
    }

    /// Number of segments.
    pub fn len(&self) -> usize {
        self.segments.len()
    }

    /// Whether there are no segments.
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// The segment with the number `id`.
    #[inline]
    pub fn segment(&self, id: u32) -> &Segment {
        &self.segments[self.slots[id as usize] as usize]
    }

    /// How far rounding may carry a height at `x`, or two of them apart: about 1e-14 of the heights and distances involved.
    #[inline]
    pub fn rounding(&self, x: DVec2) -> f64 {
        let away = (x - self.centre).abs();
        SLACK * (self.magnitude + self.k * (self.reach + away.x + away.y + self.centre.x.abs() + self.centre.y.abs()))
    }

    /// Height of the sheet at `x` and the segment it belongs to: of several that are equally high, the one with the lowest
    /// number. Exactly the greatest of [`Segment::height`] over all segments.
    ///
    /// `hint` is a segment that is likely to be high there, best the answer for a point nearby. It never changes the answer.
    #[inline]
    pub fn height(&self, x: DVec2, hint: Option<u32>) -> (f64, u32) {
        let mut best = (f64::NEG_INFINITY, u32::MAX);
        if let Some(id) = hint {
            best = (self.segment(id).height(x, self.k), id);
        }
        let slack = self.rounding(x);
        let mut stack = Stack::new();
        let mut node = &self.nodes[0];
        loop {
            if node.count > 0 {
                let range = node.first as usize..(node.first + node.count) as usize;
                for (segment, &id) in self.segments[range.clone()].iter().zip(&self.ids[range]) {
                    let height = segment.height(x, self.k);
                    if height > best.0 || (height == best.0 && id < best.1) {
                        best = (height, id);
                    }
                }
            } else {
                let (near, far) = self.children(node, x, best.0 - slack);
                if far.1 >= best.0 - slack {
                    stack.push(far);
                }
                if near.1 >= best.0 - slack {
                    node = &self.nodes[near.0 as usize];
                    continue;
                }
            }
            loop {
                match stack.pop() {
                    None => return best,
                    Some((next, bound)) if bound >= best.0 - slack => {
                        node = &self.nodes[next as usize];
                        break;
                    }
                    Some(_) => {}
                }
            }
        }
    }

    /// Calls `visit` with where each segment is stored whose sheet reaches `floor` at `x` (see [`Self::visit_above`]), until
    /// it returns `false`.
    pub(super) fn visit_slots_above(&self, x: DVec2, floor: f64, mut visit: impl FnMut(u32) -> bool) {
        let floor = floor - self.rounding(x);
        let mut stack = Stack::new();
        stack.push((0, 0.0));
        while let Some((at, _)) = stack.pop() {
            let node = &self.nodes[at as usize];
            if self.bound(node, x, floor) < floor {
                continue;
            }
            if node.count == 0 {
                stack.push((node.first + 1, 0.0));
                stack.push((node.first, 0.0));
                continue;
            }
            for slot in node.first..node.first + node.count {
                if self.stored(slot).height(x, self.k) >= floor && !visit(slot) {
                    return;
                }
            }
        }
    }

    /// The segment stored at `slot`.
    #[inline]
    pub(super) fn stored(&self, slot: u32) -> &Segment {
        &self.segments[slot as usize]
    }

    /// Calls `visit` with every segment whose sheet reaches `floor` at `x`, in the same order each time. Segments that miss
    /// it by no more than [`Self::rounding`] come too.
    pub fn visit_above<F: FnMut(u32)>(&self, x: DVec2, floor: f64, mut visit: F) {
        self.visit_slots_above(x, floor, |slot| {
            visit(self.ids[slot as usize]);
            true
        });
    }

    /// Shortens a ruling to where it is visible: returns its length `r ≤ limit`.
    ///
    /// `crossing` is called with a segment and the present length and returns the new one: where the ruling meets that
    /// segment's sheet, or the present length if it does not before. It is called for every segment whose sheet is not
    /// lower than the ruling's present end (to within [`Self::rounding`]), the ruling's own segment included; the others
    /// cannot shorten it: once another sheet is higher along a ruling it stays higher.
    ///
    /// Precondition: `limit` is finite.
    pub fn trim(&self, ruling: &Ruling, limit: f64, crossing: &mut impl FnMut(u32, f64) -> f64) -> f64 {
        let slack = self.rounding(ruling.at(limit)).max(self.rounding(ruling.foot));
        let mut trim = Trim { index: self, ruling, r: limit, end: ruling.at(limit), slack, crossing };
        // Most rulings of a rough line end close to their foot: its surroundings come first.
        let mut node = &self.nodes[0];
        while node.count == 0 {
            let (left, right) = (&self.nodes[node.first as usize], &self.nodes[node.first as usize + 1]);
            node = if left.distance_squared(ruling.foot) <= right.distance_squared(ruling.foot) { left } else { right };
        }
        trim.leaf(node);
        let near = node.first;
        let mut stack = Stack::new();
        let mut node = &self.nodes[0];
        loop {
            if node.count > 0 {
                if node.first != near {
                    trim.leaf(node);
                }
            } else {
                let floor = trim.floor();
                let (near, far) = self.children(node, trim.end, floor);
                if far.1 >= floor {
                    // Kept with the length its bound was taken at.
                    stack.push((far.0, trim.r));
                }
                if near.1 >= floor {
                    node = &self.nodes[near.0 as usize];
                    continue;
                }
            }
            loop {
                let Some((next, taken_at)) = stack.pop() else { return trim.r };
                node = &self.nodes[next as usize];
                if taken_at == trim.r || self.bound(node, trim.end, trim.floor()) >= trim.floor() {
                    break;
                }
            }
        }
    }

    /// No sheet of the node's segments is higher at `x`, up to rounding. Once that is below `floor`, it is not made tighter.
    #[inline]
    fn bound(&self, node: &Node, x: DVec2, floor: f64) -> f64 {
        let bound = node.bound(x, self.k);
        if bound < floor || node.focus == NO_FOCUS {
            return bound;
        }
        bound.min(self.foci[node.focus as usize].bound(x, self.k))
    }

    /// The children of an inner node with their bounds at `x`, see [`Self::bound`], the higher bound first.
    #[inline]
    fn children(&self, node: &Node, x: DVec2, floor: f64) -> ((u32, f64), (u32, f64)) {
        let at = node.first as usize;
        let left = (node.first, self.bound(&self.nodes[at], x, floor));
        let right = (node.first + 1, self.bound(&self.nodes[at + 1], x, floor));
        if left.1 >= right.1 { (left, right) } else { (right, left) }
    }
}

/// A ruling being shortened.
struct Trim<'a, F> {
    index: &'a Index,
    ruling: &'a Ruling,
    r: f64,
    end: DVec2,
    slack: f64,
    crossing: &'a mut F,
}

impl<F: FnMut(u32, f64) -> f64> Trim<'_, F> {
    /// Height of the ruling's end, less the slack: what does not reach it there does not cross before.
    #[inline]
    fn floor(&self) -> f64 {
        self.ruling.z - self.index.k * self.r - self.slack
    }

    /// Tries the segments of a leaf.
    #[inline]
    fn leaf(&mut self, node: &Node) {
        for slot in node.first as usize..(node.first + node.count) as usize {
            if self.index.segments[slot].height(self.end, self.index.k) >= self.floor() {
                let shorter = (self.crossing)(self.index.ids[slot], self.r);
                if shorter < self.r {
                    self.r = shorter;
                    self.end = self.ruling.at(shorter);
                }
            }
        }
    }
}

/// Nodes left for later, each with a number.
struct Stack {
    entries: [(u32, f64); STACK],
    len: usize,
}

impl Stack {
    #[inline]
    fn new() -> Self {
        Self { entries: [(0, 0.0); STACK], len: 0 }
    }

    #[inline]
    fn push(&mut self, entry: (u32, f64)) {
        self.entries[self.len] = entry;
        self.len += 1;
    }

    #[inline]
    fn pop(&mut self) -> Option<(u32, f64)> {
        self.len = self.len.checked_sub(1)?;
        Some(self.entries[self.len])
    }
}

#[cfg(test)]
mod tests;
