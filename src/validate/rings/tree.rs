//! Which segments come near each other: a tree of boxes over segments in the order of their chains.

use glam::DVec2;

/// Bounds of a set of points in the directions x, y, x + y and x − y. Rounding of sums is monotone, so two sets that share a
/// point never have bounds apart.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    lo: [f64; 4],
    hi: [f64; 4],
}

impl Bounds {
    const EMPTY: Self = Self { lo: [f64::INFINITY; 4], hi: [f64::NEG_INFINITY; 4] };

    fn with(mut self, p: DVec2) -> Self {
        for (i, v) in [p.x, p.y, p.x + p.y, p.x - p.y].into_iter().enumerate() {
            self.lo[i] = self.lo[i].min(v);
            self.hi[i] = self.hi[i].max(v);
        }
        self
    }

    fn join(mut self, other: &Self) -> Self {
        for i in 0..4 {
            self.lo[i] = self.lo[i].min(other.lo[i]);
            self.hi[i] = self.hi[i].max(other.hi[i]);
        }
        self
    }

    fn meets(&self, other: &Self) -> bool {
        (0..4).all(|i| self.lo[i] <= other.hi[i] && other.lo[i] <= self.hi[i])
    }

    /// Whether the ray from `p` towards +x may meet the set.
    fn meets_ray(&self, p: DVec2) -> bool {
        self.lo[1] <= p.y && p.y <= self.hi[1] && self.hi[0] >= p.x
    }
}

/// Segments of a leaf. Small: neighbours on a line always meet, and a leaf is compared with its neighbour pair by pair.
const LEAF: usize = 4;

/// A binary tree over segments. Neighbours on a chain lie near each other, so runs of them make good boxes.
#[derive(Debug)]
pub(super) struct Tree {
    segments: Vec<Bounds>,
    /// Node `k` has the children `2k` and `2k + 1`; the leaves are the second half.
    nodes: Vec<Bounds>,
}

impl Tree {
    pub(super) fn new(segments: impl Iterator<Item = (DVec2, DVec2)>) -> Self {
        let segments: Vec<Bounds> = segments.map(|(a, b)| Bounds::EMPTY.with(a).with(b)).collect();
        let leaves = segments.len().div_ceil(LEAF).next_power_of_two();
        let mut nodes = vec![Bounds::EMPTY; 2 * leaves];
        for (leaf, run) in segments.chunks(LEAF).enumerate() {
            nodes[leaves + leaf] = run.iter().fold(Bounds::EMPTY, |all, one| all.join(one));
        }
        for k in (1..leaves).rev() {
            nodes[k] = nodes[2 * k].join(&nodes[2 * k + 1]);
        }
        Self { segments, nodes }
    }

    fn run(&self, node: usize) -> std::ops::Range<usize> {
        let leaf = node - self.nodes.len() / 2;
        leaf * LEAF..((leaf + 1) * LEAF).min(self.segments.len())
    }

    /// Calls `visit` once for every pair `i < j` of segments whose bounds meet, until it returns `false`.
    pub(super) fn pairs(&self, mut visit: impl FnMut(usize, usize) -> bool) {
        let leaves = self.nodes.len() / 2;
        let mut stack = vec![(1, 1)];
        while let Some((m, n)) = stack.pop() {
            if m != n && !self.nodes[m].meets(&self.nodes[n]) {
                continue;
            }
            if m < leaves {
                // All leaves are equally deep, so both nodes are of one level.
                let (a, b, c, d) = (2 * m, 2 * m + 1, 2 * n, 2 * n + 1);
                if m == n {
                    stack.extend([(b, b), (a, b), (a, a)]);
                } else {
                    stack.extend([(b, d), (b, c), (a, d), (a, c)]);
                }
                continue;
            }
            for i in self.run(m) {
                for j in self.run(n) {
                    if i < j && self.segments[i].meets(&self.segments[j]) && !visit(i, j) {
                        return;
                    }
                }
            }
        }
    }

    /// Calls `visit` for every segment that may meet the ray from `p` towards +x.
    pub(super) fn ray(&self, p: DVec2, mut visit: impl FnMut(usize)) {
        let leaves = self.nodes.len() / 2;
        let mut stack = vec![1];
        while let Some(n) = stack.pop() {
            if !self.nodes[n].meets_ray(p) {
                continue;
            }
            if n < leaves {
                stack.extend([2 * n + 1, 2 * n]);
            } else {
                self.run(n).filter(|&i| self.segments[i].meets_ray(p)).for_each(&mut visit);
            }
        }
    }
}
