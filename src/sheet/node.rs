//! The boxes of the index.
//!
//! Every node is a box turned to the run of its segments, under a lid that rises with them. No sheet of a node reaches higher
//! at `x` than the sheet of the lid: that prunes. An upright box with a level lid would do, but worse: about a diagonal
//! stretch it is as wide as it is long, and above a steep one far too high (ten times slower on a long road near the slope).

use glam::{DVec2, DVec3};

use super::Segment;

/// Segments per leaf: testing a segment costs about as much as testing a box.
const LEAF: usize = 8;
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
}

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

/// Builds the nodes from the top and puts `ids` into the order of the leaves.
pub(super) fn build(segments: &[Segment], ids: &mut [u32], k: f64) -> Vec<Node> {
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
