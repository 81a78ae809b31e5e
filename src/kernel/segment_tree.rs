//! Which segments come near each other: a tree of boxes over segments in the order of their chains.

use super::plan_box::PlanBox;
use super::tree::{LEAF, Tree};
use glam::DVec2;

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
    fn around(segments: &[(DVec2, DVec2)], bounds: &PlanBox) -> Self {
        let longest = segments
            .iter()
            .map(|(a, b)| b - a)
            .fold(DVec2::ZERO, |longest, d| if d.length_squared() > longest.length_squared() { d } else { longest });
        let along = longest.normalize_or(DVec2::X);
        let centre = 0.5 * bounds.lo + 0.5 * bounds.hi;
        let turned = |p: DVec2| DVec2::new(along.dot(p - centre), along.perp_dot(p - centre));
        let PlanBox { lo, hi } = PlanBox::of(segments.iter().flat_map(|&(a, b)| [a, b]).map(turned));
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

/// A binary tree over segments. Neighbours on a chain lie near each other, so runs of them make good boxes.
#[derive(Debug)]
pub struct SegmentTree {
    tree: Tree,
    /// Tilted boxes of the leaves and of nodes up to [`TILTED`] segments.
    tilted: Vec<Option<Tilted>>,
}

/// Larger nodes have no tilted box: they hold lines of many directions.
const TILTED: usize = 256;

impl SegmentTree {
    /// A tree over segments given by their ends.
    pub fn new(ends: &[(DVec2, DVec2)]) -> Self {
        let tree = Tree::new(ends.iter().map(|&(a, b)| PlanBox::of([a, b])).collect());
        let mut tilted = vec![None; 2 * tree.leaves()];
        let (mut size, mut first) = (LEAF, tree.leaves());
        while size <= TILTED && first > 0 {
            for (i, run) in ends.chunks(size).enumerate() {
                tilted[first + i] = Some(Tilted::around(run, tree.node(first + i)));
            }
            (size, first) = (2 * size, first / 2);
        }
        Self { tree, tilted }
    }

    fn apart(&self, m: usize, n: usize) -> bool {
        let tilted_apart = || match (&self.tilted[m], &self.tilted[n]) {
            (Some(m), Some(n)) => !m.meets(n),
            _ => false,
        };
        !self.tree.node(m).meets(self.tree.node(n)) || tilted_apart()
    }

    /// Calls `visit` once for every pair `i < j` of segments whose bounds meet, until it returns `false`.
    pub fn pairs(&self, visit: impl FnMut(usize, usize) -> bool) {
        self.tree.pairs(|m, n| self.apart(m, n), visit);
    }

    /// Calls `visit` for every segment whose bounds come within `reach` of `p`.
    pub fn near(&self, p: DVec2, reach: f64, visit: impl FnMut(usize)) {
        let around = PlanBox { lo: p - reach, hi: p + reach };
        let reached =
            |n: usize, node: &PlanBox| node.meets(&around) && self.tilted[n].is_none_or(|tilted| tilted.comes_near(p, reach));
        self.tree.search(reached, |one| one.meets(&around), visit);
    }

    /// Calls `visit` for every segment that may meet the ray from `p` towards +x.
    pub fn ray(&self, p: DVec2, visit: impl FnMut(usize)) {
        let meets_ray = |one: &PlanBox| one.lo.y <= p.y && p.y <= one.hi.y && one.hi.x >= p.x;
        self.tree.search(|_, node| meets_ray(node), meets_ray, visit);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::segment::{Meeting, distance, meeting};
    use proptest::prelude::*;

    /// Some runs of segments: chains on a coarse grid, where much meets, and off it.
    fn segments() -> impl Strategy<Value = Vec<(DVec2, DVec2)>> {
        let step = prop_oneof![
            (-3.0..3.0_f64, -3.0..3.0_f64).prop_map(DVec2::from),
            (-3..3_i32, -3..3_i32).prop_map(|(x, y)| DVec2::new(x.into(), y.into())),
        ];
        prop::collection::vec(step, 1..80).prop_map(|steps| {
            let mut at = DVec2::ZERO;
            let segment = |step| {
                let from = at;
                at += step;
                (from, at)
            };
            steps.into_iter().map(segment).collect()
        })
    }

    fn place() -> impl Strategy<Value = DVec2> {
        prop_oneof![
            (-9.0..9.0_f64, -9.0..9.0_f64).prop_map(DVec2::from),
            (-9..9_i32, -9..9_i32).prop_map(|(x, y)| DVec2::new(x.into(), y.into())),
        ]
    }

    fn box_of(&(a, b): &(DVec2, DVec2)) -> PlanBox {
        PlanBox::of([a, b])
    }

    proptest! {
        /// All that come within reach, and nothing whose box does not.
        #[test]
        fn near_finds_what_its_boxes_say(segments in segments(), p in place(), reach in 0.0..2.0_f64) {
            let mut found = Vec::new();
            SegmentTree::new(&segments).near(p, reach, |i| found.push(i));
            found.sort_unstable();
            prop_assert!(found.windows(2).all(|w| w[0] < w[1]), "{:?}", found);
            for (i, segment) in segments.iter().enumerate() {
                let away = distance(p, [segment.0, segment.1]);
                prop_assert!(away > reach || found.contains(&i), "{} at {}", i, away);
                let near = box_of(segment).meets(&PlanBox { lo: p - reach, hi: p + reach });
                prop_assert!(near || !found.contains(&i), "{} at {}", i, away);
            }
        }

        /// Every pair that meets, once and in order, and none whose boxes do not; no more once told to stop.
        #[test]
        fn pairs_are_found_once(segments in segments(), most in 1..20_usize) {
            let tree = SegmentTree::new(&segments);
            let mut found = Vec::new();
            tree.pairs(|i, j| {
                found.push((i, j));
                true
            });
            let mut some = 0;
            tree.pairs(|_, _| {
                some += 1;
                some < most
            });
            prop_assert_eq!(some, most.min(found.len()));
            found.sort_unstable();
            prop_assert!(found.windows(2).all(|w| w[0] < w[1]) && found.iter().all(|(i, j)| i < j), "{:?}", found);
            for j in 0..segments.len() {
                for i in 0..j {
                    let (s, t) = (segments[i], segments[j]);
                    let told = found.binary_search(&(i, j)).is_ok();
                    prop_assert!(told || meeting(s.into(), t.into()) == Meeting::Apart, "{:?} {:?}", s, t);
                    prop_assert!(!told || box_of(&s).meets(&box_of(&t)), "{:?} {:?}", s, t);
                }
            }
        }

        /// All segments level with a point and not wholly west of it.
        #[test]
        fn rays_meet_boxes(segments in segments(), p in place()) {
            let mut found = Vec::new();
            SegmentTree::new(&segments).ray(p, |i| found.push(i));
            found.sort_unstable();
            let level = |b: &PlanBox| b.lo.y <= p.y && p.y <= b.hi.y && b.hi.x >= p.x;
            let expected: Vec<usize> = (0..segments.len()).filter(|&i| level(&box_of(&segments[i]))).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
