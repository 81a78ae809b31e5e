//! A bounding volume hierarchy over segments, for the upper envelope of their sheets.
//!
//! Every node is a box turned to the run of its segments, under a lid that rises with them. No sheet of a node reaches higher
//! at `x` than the sheet of the lid: that prunes. An upright box with a level lid would do, but worse: about a diagonal
//! stretch it is as wide as it is long, and above a steep one far too high (ten times slower on a long road near the slope).

use glam::{DVec2, DVec3};

use super::{Ruling, Segment};

/// Segments per leaf: testing a segment costs about as much as testing a box.
const LEAF: usize = 8;
/// Room on the stack of a traversal. Halving 2³² segments takes 32 levels, and each level leaves one node behind.
const STACK: usize = 40;
/// The steepest lid of a box, in slopes: short of 1, where its bound would lose its digits.
const STEEPEST_LID: f64 = 0.999;
/// Relative slack of bounds, in units of the scale of the numbers: several times the rounding of one height.
const SLACK: f64 = 64.0 * f64::EPSILON;

/// A box about segments.
#[derive(Clone, Copy, Debug)]
struct Node {
    centre: DVec2,
    /// Unit vector of its long side.
    axis: DVec2,
    /// Half its sides: along the axis and across.
    half: DVec2,
    /// Height at the middle of the lid: the plane that covers the segments in it, level across the axis.
    lid: f64,
    /// Rise of the lid along the axis, flatter than `k`.
    rise: f64,
    /// `rise / √(k² − rise²)`.
    lean: f64,
    /// First segment of a leaf; left child of an inner node, the right child follows it.
    first: u32,
    /// Number of segments of a leaf; nought for an inner node.
    count: u32,
}

impl Node {
    /// No sheet of the node's segments is higher at `x`, up to rounding.
    #[inline]
    fn bound(&self, x: DVec2, k: f64) -> f64 {
        let d = x - self.centre;
        let p = self.axis.dot(d);
        let q = (self.axis.perp_dot(d).abs() - self.half.y).max(0.0);
        let foot = (p + q * self.lean).clamp(-self.half.x, self.half.x);
        let along = p - foot;
        self.lid + self.rise * foot - k * (along * along + q * q).sqrt()
    }

    /// Plan distance from `x` to the box, squared.
    #[inline]
    fn distance_squared(&self, x: DVec2) -> f64 {
        let d = x - self.centre;
        let p = (self.axis.dot(d).abs() - self.half.x).max(0.0);
        let q = (self.axis.perp_dot(d).abs() - self.half.y).max(0.0);
        p * p + q * q
    }
}

/// The index. Segments keep the numbers they came with; inside, they are stored leaf by leaf.
#[derive(Clone, Debug)]
pub struct Index {
    k: f64,
    nodes: Vec<Node>,
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
        let mut ids: Vec<u32> = (0..segments.len() as u32).collect();
        let nodes = build(segments, &mut ids, k);
        let mut slots = vec![0; ids.len()];
        for (slot, &id) in ids.iter().enumerate() {
            slots[id as usize] = slot as u32;
        }
        let magnitude = segments.iter().fold(0.0, |m: f64, s| m.max(s.za.abs()).max(s.zb.abs()));
        let (centre, reach) = (nodes[0].centre, nodes[0].half.length());
        Self { k, nodes, segments: ids.iter().map(|&id| segments[id as usize]).collect(), ids, slots, centre, reach, magnitude }
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
                let (near, far) = self.children(node, x);
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
            if node.bound(x, self.k) < floor {
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
                let (near, far) = self.children(node, trim.end);
                let floor = trim.floor();
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
                if taken_at == trim.r || node.bound(trim.end, self.k) >= trim.floor() {
                    break;
                }
            }
        }
    }

    /// The children of an inner node with their bounds at `x`, the higher bound first.
    #[inline]
    fn children(&self, node: &Node, x: DVec2) -> ((u32, f64), (u32, f64)) {
        let at = node.first as usize;
        let left = (node.first, self.nodes[at].bound(x, self.k));
        let right = (node.first + 1, self.nodes[at + 1].bound(x, self.k));
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

/// Builds the nodes from the top and puts `ids` into the order of the leaves.
fn build(segments: &[Segment], ids: &mut [u32], k: f64) -> Vec<Node> {
    let middle = |id: u32| {
        let segment = &segments[id as usize];
        0.5 * (segment.a + segment.b)
    };
    let mut nodes = vec![boxed(segments, ids, k)];
    let mut open = vec![(0, 0, ids.len())];
    while let Some((at, from, to)) = open.pop() {
        if to - from <= LEAF {
            nodes[at].first = from as u32;
            nodes[at].count = (to - from) as u32;
            continue;
        }
        let part = &mut ids[from..to];
        let (mut lo, mut hi) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for &id in part.iter() {
            lo = lo.min(middle(id));
            hi = hi.max(middle(id));
        }
        let key = |id: u32| if hi.x - lo.x >= hi.y - lo.y { middle(id).x } else { middle(id).y };
        let half = part.len() / 2;
        // The number settles ties: the order of the leaves depends on the segments alone.
        part.select_nth_unstable_by(half, |&i, &j| key(i).total_cmp(&key(j)).then(i.cmp(&j)));
        let children = nodes.len();
        nodes[at].first = children as u32;
        nodes.push(boxed(segments, &ids[from..from + half], k));
        nodes.push(boxed(segments, &ids[from + half..to], k));
        open.push((children + 1, from + half, to));
        open.push((children, from, from + half));
    }
    nodes
}

/// The box about some segments, turned to the principal axis of their ends, with its lid.
fn boxed(segments: &[Segment], ids: &[u32], k: f64) -> Node {
    let ends = || ids.iter().map(|&id| &segments[id as usize]).flat_map(|s| [s.a.extend(s.za), s.b.extend(s.zb)]);
    let mean = ends().sum::<DVec3>() / (2 * ids.len()) as f64;
    let (mut xx, mut xy, mut yy, mut tilt) = (0.0, 0.0, 0.0, DVec2::ZERO);
    for d in ends().map(|p| p - mean) {
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        tilt += d.z * d.truncate();
    }
    let axis = principal_axis(0.5 * (xx - yy), xy);
    let (mut lo, mut hi, mut spread) = (DVec2::INFINITY, DVec2::NEG_INFINITY, 0.0);
    for d in ends().map(|p| p.truncate() - mean.truncate()) {
        let local = DVec2::new(axis.dot(d), axis.perp_dot(d));
        lo = lo.min(local);
        hi = hi.max(local);
        spread += local.x * local.x;
    }
    let middle = 0.5 * (lo + hi);
    let centre = mean.truncate() + middle.x * axis + middle.y * axis.perp();
    // The straight line of best fit, then lifted to cover all.
    let rise = if spread > 0.0 { (axis.dot(tilt) / spread).clamp(-STEEPEST_LID * k, STEEPEST_LID * k) } else { 0.0 };
    let lid = ends().fold(f64::NEG_INFINITY, |lid, p| lid.max(p.z - rise * axis.dot(p.truncate() - centre)));
    let lean = rise / ((k - rise) * (k + rise)).sqrt();
    Node { centre, axis, half: 0.5 * (hi - lo), lid, rise, lean, first: 0, count: 0 }
}

/// Unit eigenvector of the larger eigenvalue of the symmetric matrix with half difference of diagonal `c` and
/// off-diagonal `s`; the first axis when all directions are alike.
fn principal_axis(c: f64, s: f64) -> DVec2 {
    let size = (c * c + s * s).sqrt();
    // Of the two columns that span the eigenspace, the one that does not cancel.
    let axis = if c >= 0.0 { DVec2::new(c + size, s) } else { DVec2::new(s, size - c) };
    axis.try_normalize().unwrap_or(DVec2::X)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::testing::{Random, sets};

    /// Places near and far, some of them on the segments' ends.
    fn places(random: &mut Random, segments: &[Segment]) -> Vec<DVec2> {
        let mut places = Vec::new();
        for i in 0..60 {
            let near = &segments[random.bits() as usize % segments.len()];
            let reach = [0.0, 1e-6, 1.0, 100.0, 1e4][i % 5];
            places.push(near.a + DVec2::new(random.between(-reach, reach), random.between(-reach, reach)));
        }
        places
    }

    #[test]
    fn height_is_the_greatest_of_all() {
        let mut random = Random::new(3);
        for (k, segments) in sets(&mut random) {
            let index = Index::new(&segments, k);
            let mut hint = None;
            for x in places(&mut random, &segments) {
                let mut expected = (f64::NEG_INFINITY, 0);
                for (id, segment) in segments.iter().enumerate() {
                    let height = segment.height(x, k);
                    if height > expected.0 {
                        expected = (height, id as u32);
                    }
                }
                assert_eq!(index.height(x, None), expected, "{} segments at {x}", segments.len());
                assert_eq!(index.height(x, hint), expected, "with a hint");
                assert_eq!(index.segment(expected.1), &segments[expected.1 as usize]);
                hint = Some(expected.1);
            }
        }
    }

    #[test]
    fn visits_all_that_reach_the_floor() {
        let mut random = Random::new(4);
        for (k, segments) in sets(&mut random) {
            let index = Index::new(&segments, k);
            for x in places(&mut random, &segments) {
                let floor = index.height(x, None).0 - random.between(0.0, 5.0);
                let mut seen = Vec::new();
                index.visit_above(x, floor, |id| seen.push(id));
                seen.sort_unstable();
                let reaches = |id: &u32, floor: f64| segments[*id as usize].height(x, k) >= floor;
                let all = 0..segments.len() as u32;
                let expected: Vec<u32> = all.filter(|id| reaches(id, floor)).collect();
                seen.dedup();
                assert!(expected.iter().all(|id| seen.binary_search(id).is_ok()), "missed one at {x}");
                assert!(seen.iter().all(|id| reaches(id, floor - 2.0 * index.rounding(x))), "one too many at {x}");
            }
        }
    }

    /// Where the ruling falls below the segment's sheet, by bisection on the definition.
    fn bisected(segment: &Segment, ruling: &Ruling, r: f64, k: f64) -> f64 {
        let above = |r: f64| segment.height(ruling.at(r), k) > ruling.z - k * r + 1e-10;
        if !above(r) {
            return r;
        }
        let (mut lo, mut hi) = (0.0, r);
        for _ in 0..80 {
            let mid = 0.5 * (lo + hi);
            if above(mid) { hi = mid } else { lo = mid }
        }
        hi
    }

    #[test]
    fn trim_finds_the_first_crossing_of_all() {
        let mut random = Random::new(5);
        for (k, segments) in sets(&mut random) {
            let index = Index::new(&segments, k);
            for i in 0..30 {
                let own = &segments[random.bits() as usize % segments.len()];
                let foot = own.point(own.length * random.between(0.0, 1.0));
                let dir = if i % 2 == 0 { own.ruling_left() } else { own.ruling_right() };
                let ruling = Ruling { foot: foot.truncate(), z: foot.z, dir };
                let limit = [1.0, 50.0, 1e3][i % 3];
                let expected = segments.iter().map(|s| bisected(s, &ruling, limit, k)).fold(limit, f64::min);
                let mut calls = 0;
                let found = index.trim(&ruling, limit, &mut |id, r| {
                    calls += 1;
                    bisected(index.segment(id), &ruling, limit, k).min(r)
                });
                assert_eq!(found, expected, "{} segments, ruling {ruling:?}", segments.len());
                assert!(calls > 0, "the ruling's own segment reaches its end or another does");
            }
        }
    }

    #[test]
    fn boxes_hold_their_segments_and_turn_with_them() {
        let mut random = Random::new(6);
        for (k, segments) in sets(&mut random) {
            let index = Index::new(&segments, k);
            let mut seen = 0;
            let mut open = vec![(0usize, Vec::new())];
            while let Some((at, above)) = open.pop() {
                let node = &index.nodes[at];
                let mut above: Vec<usize> = above;
                above.push(at);
                if node.count == 0 {
                    open.extend([(node.first as usize, above.clone()), (node.first as usize + 1, above)]);
                    continue;
                }
                seen += node.count as usize;
                for slot in node.first as usize..(node.first + node.count) as usize {
                    let s = &index.segments[slot];
                    for (p, z) in [(s.a, s.za), (s.b, s.zb)] {
                        for node in above.iter().map(|&n| &index.nodes[n]) {
                            assert!(node.bound(p, k) >= z - index.rounding(p), "{p} sticks out of {node:?}");
                        }
                    }
                }
            }
            assert_eq!(seen, segments.len());
        }
    }

    #[test]
    fn box_of_a_straight_line_is_as_good_as_the_line() {
        // A diagonal rise of 0.9 k: thin box, slanting lid, so the bound is the height itself.
        let step = DVec3::new(1.0, 1.0, 0.45 * 2f64.sqrt());
        let point = |i: u32| f64::from(i) * step;
        let segments: Vec<Segment> = (0..64).map(|i| Segment::new(point(i), point(i + 1), 0.5)).collect();
        let index = Index::new(&segments, 0.5);
        assert!(index.nodes[0].half.y <= 1e-12);
        for x in [DVec2::new(30.0, 0.0), DVec2::new(0.0, 90.0), DVec2::new(-20.0, -30.0), DVec2::new(99.0, 99.0)] {
            let (bound, height) = (index.nodes[0].bound(x, 0.5), index.height(x, None).0);
            assert!((bound - height).abs() <= 1e-12, "{bound} for {height} at {x}");
        }
    }
}
