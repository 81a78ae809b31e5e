//! Which segments come near each other: a tree of boxes over segments in the order of their chains.

use glam::DVec2;

/// An upright box.
#[derive(Clone, Copy, Debug)]
struct Bounds {
    lo: DVec2,
    hi: DVec2,
}

impl Bounds {
    const EMPTY: Self = Self { lo: DVec2::INFINITY, hi: DVec2::NEG_INFINITY };

    fn with(self, p: DVec2) -> Self {
        Self { lo: self.lo.min(p), hi: self.hi.max(p) }
    }

    fn join(self, other: &Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    fn meets(&self, other: &Self) -> bool {
        self.lo.cmple(other.hi).all() && other.lo.cmple(self.hi).all()
    }

    /// Whether the ray from `p` towards +x may meet the set.
    fn meets_ray(&self, p: DVec2) -> bool {
        self.lo.y <= p.y && p.y <= self.hi.y && self.hi.x >= p.x
    }
}

/// A box along a direction of its own: long parallel strokes, whose upright boxes all overlap, stay apart in theirs.
#[derive(Clone, Copy, Debug)]
struct Tilted {
    centre: DVec2,
    along: DVec2,
    /// Half the extent along and across, widened by the rounding error.
    half: DVec2,
}

/// Rounding error of a projection, relative to the largest coordinate: a few units in the last place.
const ROUNDING: f64 = 1e-15;

impl Tilted {
    /// A box about the ends of segments, along the longest of them.
    fn around(segments: &[(DVec2, DVec2)], bounds: &Bounds) -> Self {
        let longest = segments
            .iter()
            .map(|(a, b)| b - a)
            .fold(DVec2::ZERO, |longest, d| if d.length_squared() > longest.length_squared() { d } else { longest });
        let along = longest.normalize_or(DVec2::X);
        let centre = 0.5 * bounds.lo + 0.5 * bounds.hi;
        let (mut lo, mut hi) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        for p in segments.iter().flat_map(|&(a, b)| [a, b]) {
            let d = p - centre;
            let q = DVec2::new(along.dot(d), along.perp_dot(d));
            (lo, hi) = (lo.min(q), hi.max(q));
        }
        let middle = 0.5 * (lo + hi);
        let rounding = 16.0 * ROUNDING * bounds.lo.abs().max(bounds.hi.abs()).max_element();
        Self {
            centre: centre + along * middle.x + along.perp() * middle.y,
            along,
            half: 0.5 * (hi - lo) + DVec2::splat(rounding),
        }
    }

    /// Whether the boxes overlap across the direction of the first.
    fn meets_across(&self, other: &Self) -> bool {
        let across = self.along.perp();
        let reach = other.half.x * across.dot(other.along).abs() + other.half.y * across.dot(other.along.perp()).abs();
        across.dot(other.centre - self.centre).abs() <= self.half.y + reach
    }

    fn meets(&self, other: &Self) -> bool {
        self.meets_across(other) && other.meets_across(self)
    }

    /// Whether a disc about `p` may meet the box.
    fn comes_near(&self, p: DVec2, reach: f64) -> bool {
        let d = p - self.centre;
        self.along.dot(d).abs() <= self.half.x + reach && self.along.perp_dot(d).abs() <= self.half.y + reach
    }
}

/// Segments of a leaf. Small: neighbours on a line always meet, and a leaf is compared with its neighbour pair by pair.
const LEAF: usize = 4;

/// A binary tree over segments. Neighbours on a chain lie near each other, so runs of them make good boxes.
#[derive(Debug)]
pub struct SegmentTree {
    segments: Vec<Bounds>,
    /// Node `k` has the children `2k` and `2k + 1`; the leaves are the second half.
    nodes: Vec<Bounds>,
    /// Tilted boxes of the leaves and of nodes up to [`TILTED`] segments.
    tilted: Vec<Option<Tilted>>,
}

/// Larger nodes have no tilted box: they hold lines of many directions.
const TILTED: usize = 256;

impl SegmentTree {
    /// A tree over segments given by their ends.
    pub fn new(ends: &[(DVec2, DVec2)]) -> Self {
        let segments: Vec<Bounds> = ends.iter().map(|&(a, b)| Bounds::EMPTY.with(a).with(b)).collect();
        let leaves = segments.len().div_ceil(LEAF).next_power_of_two();
        let mut nodes = vec![Bounds::EMPTY; 2 * leaves];
        for (leaf, run) in segments.chunks(LEAF).enumerate() {
            nodes[leaves + leaf] = run.iter().fold(Bounds::EMPTY, |all, one| all.join(one));
        }
        for k in (1..leaves).rev() {
            nodes[k] = nodes[2 * k].join(&nodes[2 * k + 1]);
        }
        let mut tilted = vec![None; 2 * leaves];
        let (mut size, mut first) = (LEAF, leaves);
        while size <= TILTED && first > 0 {
            for (i, run) in ends.chunks(size).enumerate() {
                tilted[first + i] = Some(Tilted::around(run, &nodes[first + i]));
            }
            (size, first) = (2 * size, first / 2);
        }
        Self { segments, nodes, tilted }
    }

    fn apart(&self, m: usize, n: usize) -> bool {
        let tilted_apart = || match (&self.tilted[m], &self.tilted[n]) {
            (Some(m), Some(n)) => !m.meets(n),
            _ => false,
        };
        !self.nodes[m].meets(&self.nodes[n]) || tilted_apart()
    }

    fn run(&self, node: usize) -> std::ops::Range<usize> {
        let leaf = node - self.nodes.len() / 2;
        leaf * LEAF..((leaf + 1) * LEAF).min(self.segments.len())
    }

    /// Calls `visit` once for every pair `i < j` of segments whose bounds meet, until it returns `false`.
    pub fn pairs(&self, mut visit: impl FnMut(usize, usize) -> bool) {
        let leaves = self.nodes.len() / 2;
        let mut stack = vec![(1, 1)];
        while let Some((m, n)) = stack.pop() {
            if m != n && self.apart(m, n) {
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

    /// Calls `visit` for every segment whose bounds come within `reach` of `p`.
    pub fn near(&self, p: DVec2, reach: f64, mut visit: impl FnMut(usize)) {
        let leaves = self.nodes.len() / 2;
        let around = Bounds { lo: p - reach, hi: p + reach };
        let mut stack = vec![1];
        while let Some(n) = stack.pop() {
            if !self.nodes[n].meets(&around) || self.tilted[n].is_some_and(|t| !t.comes_near(p, reach)) {
                continue;
            }
            if n < leaves {
                stack.extend([2 * n + 1, 2 * n]);
            } else {
                self.run(n).filter(|&i| self.segments[i].meets(&around)).for_each(&mut visit);
            }
        }
    }

    /// Calls `visit` for every segment that may meet the ray from `p` towards +x.
    pub fn ray(&self, p: DVec2, mut visit: impl FnMut(usize)) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn near_misses_none(
            steps in prop::collection::vec((-3.0..3.0_f64, -3.0..3.0_f64), 1..80),
            p in (-9.0..9.0_f64, -9.0..9.0_f64),
            reach in 0.0..2.0_f64,
        ) {
            let mut at = DVec2::ZERO;
            let segments: Vec<(DVec2, DVec2)> = steps.iter().map(|&step| {
                let from = at;
                at += DVec2::from(step);
                (from, at)
            }).collect();
            let p = DVec2::from(p);
            let mut found = Vec::new();
            SegmentTree::new(&segments).near(p, reach, |i| found.push(i));
            found.sort_unstable();
            prop_assert!(found.windows(2).all(|w| w[0] < w[1]), "{:?}", found);
            for (i, &(a, b)) in segments.iter().enumerate() {
                let along = ((b - a).dot(p - a) / (b - a).length_squared()).clamp(0.0, 1.0);
                let distance = (p - a - (b - a) * along).length();
                prop_assert!(distance > reach || found.contains(&i), "{} at {}", i, distance);
            }
        }
    }
}
