//! The boxes of the index.
//!
//! Every node is a box turned to the run of its segments, under a lid that rises with them. No sheet of a node reaches higher
//! at `x` than the sheet of the lid: that prunes. An upright box with a level lid would do, but worse: about a diagonal
//! stretch it is as wide as it is long, and above a steep one far too high (ten times slower on a long road near the slope).

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::Segment;
use super::focus::{Around, Bend, Focus};
use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;

/// Segments per leaf: testing a segment costs about as much as testing a box.
const LEAF: usize = 8;
/// Segments beyond which both halves are ordered in parallel.
const PARALLEL: usize = 4096;
/// The steepest lid of a box, in slopes: short of 1, where its bound would lose its digits.
const STEEPEST_LID: f64 = 0.999;

/// A box about segments.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) centre: DVec2,
    /// Unit vector of its long side.
    axis: DVec2,
    /// Half its sides: along the axis and across.
    pub(super) half: DVec2,
    /// Height at the middle of the lid: the plane that covers the segments in it, level across the axis.
    lid: f64,
    /// Rise of the lid along the axis, flatter than `k`.
    rise: f64,
    /// `rise / √(k² − rise²)`.
    lean: f64,
    /// First segment of a leaf; left child of an inner node, the right child follows it.
    pub(super) first: u32,
    /// Number of segments of a leaf; nought for an inner node.
    pub(super) count: u32,
    /// Its focus, or [`NO_FOCUS`].
    pub(super) focus: u32,
}

/// The number of a focus where there is none.
pub(super) const NO_FOCUS: u32 = u32::MAX;

impl Node {
    /// No sheet of the node's segments is higher at `x`, up to rounding.
    #[inline]
    pub(super) fn bound(&self, x: DVec2, k: f64) -> f64 {
        let d = x - self.centre;
        let p = self.axis.dot(d);
        let q = (self.axis.perp_dot(d).abs() - self.half.y).max(0.0);
        let foot = (p + q * self.lean).max(-self.half.x).min(self.half.x);
        let along = p - foot;
        self.lid + self.rise * foot - k * (along * along + q * q).sqrt()
    }

    /// Plan distance from `x` to the box, squared.
    #[inline]
    pub(super) fn distance_squared(&self, x: DVec2) -> f64 {
        let d = x - self.centre;
        let p = (self.axis.dot(d).abs() - self.half.x).max(0.0);
        let q = (self.axis.perp_dot(d).abs() - self.half.y).max(0.0);
        p * p + q * q
    }
}

/// Segments ordered leaf by leaf, with the nodes above them.
pub(super) struct Tree {
    /// Number of each segment, in the order of the leaves.
    pub(super) ids: Vec<u32>,
    /// The same order.
    pub(super) segments: Vec<Segment>,
    /// From the top; the children of a node lie side by side.
    pub(super) nodes: Vec<Node>,
    /// The foci of those that have one.
    pub(super) foci: Vec<Focus>,
}

/// Which segments lie under a node, and where its children are.
#[derive(Clone, Copy)]
struct Shape {
    from: u32,
    to: u32,
    /// The left child; nought for a leaf.
    child: u32,
}

/// The middle of a segment, with its number.
#[derive(Clone, Copy)]
struct Middle {
    at: DVec2,
    id: u32,
}

/// Builds the tree from the top. It depends on the segments alone, not on the number of threads.
pub(super) fn build(segments: &[Segment], k: f64) -> Tree {
    let middle = |(id, s): (usize, &Segment)| Middle { at: 0.5 * (s.a + s.b), id: id as u32 };
    let mut middles: Vec<Middle> = segments.iter().enumerate().map(middle).collect();
    let shapes = order(&mut middles, 0);
    let ids: Vec<u32> = middles.iter().map(|m| m.id).collect();
    drop(middles);
    let segments: Vec<Segment> = ids.iter().map(|&id| segments[id as usize]).collect();
    let root = boxed(&segments, f64::INFINITY, k).0;
    let size = root.half.length();
    let boxes: Vec<(Node, Option<Focus>)> =
        shapes.par_iter().map(|s| boxed(&segments[s.from as usize..s.to as usize], size, k)).collect();
    let mut foci = Vec::new();
    let nodes = shapes.iter().zip(boxes).map(|(shape, (node, focus))| {
        let (first, count) = if shape.child == 0 { (shape.from, shape.to - shape.from) } else { (shape.child, 0) };
        let number = if focus.is_some() { foci.len() as u32 } else { NO_FOCUS };
        foci.extend(focus);
        Node { first, count, focus: number, ..node }
    });
    let nodes = nodes.collect();
    Tree { ids, segments, nodes, foci }
}

/// Puts segments into the order of the leaves; the nodes above them, segments numbered from `first`.
fn order(middles: &mut [Middle], first: u32) -> Vec<Shape> {
    let count = middles.len();
    let mut shapes = vec![Shape { from: first, to: first + count as u32, child: 0 }];
    if count > PARALLEL {
        let half = halve(middles);
        let (left, right) = middles.split_at_mut(half);
        let (left, right) = rayon::join(|| order(left, first), || order(right, first + half as u32));
        shapes[0].child = 1;
        // Below the two children come the other nodes of the left one, then those of the right one.
        let moved = |shape: &Shape, by: u32| Shape { child: if shape.child == 0 { 0 } else { shape.child + by }, ..*shape };
        let shifts = [2, left.len() as u32 + 1];
        shapes.extend([moved(&left[0], shifts[0]), moved(&right[0], shifts[1])]);
        shapes.extend(left[1..].iter().map(|s| moved(s, shifts[0])));
        shapes.extend(right[1..].iter().map(|s| moved(s, shifts[1])));
        return shapes;
    }
    let mut open = vec![(0, 0, count)];
    while let Some((at, from, to)) = open.pop() {
        if to - from <= LEAF {
            continue;
        }
        let half = from + halve(&mut middles[from..to]);
        let child = shapes.len();
        shapes[at].child = child as u32;
        for (from, to) in [(from, half), (half, to)] {
            shapes.push(Shape { from: first + from as u32, to: first + to as u32, child: 0 });
        }
        open.push((child + 1, half, to));
        open.push((child, from, half));
    }
    shapes
}

/// Splits segments across the longer side of their box: the first half comes to the front. Its size.
fn halve(middles: &mut [Middle]) -> usize {
    let size = PlanBox::of(middles.iter().map(|m| m.at)).size();
    let half = middles.len() / 2;
    // The number settles ties: the order of the leaves depends on the segments alone.
    if size.x >= size.y {
        middles.select_nth_unstable_by(half, |a, b| a.at.x.total_cmp(&b.at.x).then(a.id.cmp(&b.id)));
    } else {
        middles.select_nth_unstable_by(half, |a, b| a.at.y.total_cmp(&b.at.y).then(a.id.cmp(&b.id)));
    }
    half
}

/// The box about some segments, turned to the principal axis of their ends, with its lid; and their focus. `size` is that of
/// everything.
fn boxed(segments: &[Segment], size: f64, k: f64) -> (Node, Option<Focus>) {
    let ends = || segments.iter().flat_map(|s| [s.a.extend(s.za), s.b.extend(s.zb)]);
    let mean = ends().sum::<DVec3>() / (2 * segments.len()) as f64;
    let (mut xx, mut xy, mut yy, mut tilt) = (0.0, 0.0, 0.0, DVec2::ZERO);
    for d in ends().map(|p| p - mean) {
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
        tilt += d.z * d.truncate();
    }
    let axis = principal_axis(0.5 * (xx - yy), xy);
    let (mut lo, mut hi, mut spread) = (DVec2::INFINITY, DVec2::NEG_INFINITY, 0.0);
    let mut bend = Bend::default();
    for d in ends().map(|p| p - mean) {
        let local = DVec2::new(axis.dot(d.truncate()), axis.perp_dot(d.truncate()));
        lo = lo.min(local);
        hi = hi.max(local);
        spread += local.x * local.x;
        bend.add(local.x, DVec2::new(local.y, d.z / k));
    }
    let middle = 0.5 * (lo + hi);
    let centre = mean.truncate() + middle.x * axis + middle.y * axis.perp();
    // The straight line of best fit, then lifted to cover all.
    let rise = if spread > 0.0 { (axis.dot(tilt) / spread).clamp(-STEEPEST_LID * k, STEEPEST_LID * k) } else { 0.0 };
    let above = |p: DVec3| p.z - rise * axis.dot(p.truncate() - centre);
    let (floor, lid) = range(ends().map(above));
    let lean = rise / ((k - rise) * (k + rise)).sqrt();
    let half = 0.5 * (hi - lo);
    let around = Around { mean: mean.truncate(), axis, rise, slack: lid - floor + 2.0 * k * half.y };
    let focus = Focus::of(segments, &around, &bend, size, k);
    (Node { centre, axis, half, lid, rise, lean, first: 0, count: 0, focus: NO_FOCUS }, focus)
}

/// Unit eigenvector of the larger eigenvalue of the symmetric matrix with half difference of diagonal `c` and
/// off-diagonal `s`; the first axis when all directions are alike.
fn principal_axis(c: f64, s: f64) -> DVec2 {
    let size = (c * c + s * s).sqrt();
    // Of the two columns that span the eigenspace, the one that does not cancel.
    let axis = if c >= 0.0 { DVec2::new(c + size, s) } else { DVec2::new(s, size - c) };
    axis.try_normalize().unwrap_or(DVec2::X)
}
