//! Which upright boxes meet each other: a tree over boxes in any order.

use super::plan_box::PlanBox;
use super::tree::Tree;

/// A binary tree over boxes, ordered along a space-filling curve through their centres.
#[derive(Debug)]
pub struct BoxTree {
    tree: Tree,
    /// What the caller calls each box.
    names: Vec<u32>,
}

impl BoxTree {
    /// A tree over boxes with finite corners, each with a name.
    pub fn new(boxes: &[(u32, PlanBox)]) -> Self {
        let all = boxes.iter().fold(PlanBox::EMPTY, |all, (_, one)| all.join(*one));
        let scale = f64::from(u32::MAX) / all.size().max_element().max(f64::MIN_POSITIVE);
        let mut order: Vec<(u64, u32)> = boxes
            .iter()
            .zip(0..)
            .map(|((_, one), i)| {
                let p = (one.middle() - all.lo) * scale;
                (spread(p.x as u32) | spread(p.y as u32) << 1, i)
            })
            .collect();
        order.sort_unstable();
        let in_order = || order.iter().map(|&(_, i)| boxes[i as usize]);
        Self { tree: Tree::new(in_order().map(|(_, one)| one).collect()), names: in_order().map(|(name, _)| name).collect() }
    }

    /// Calls `visit` with the name of every box that meets or touches another. The order is the same for the same boxes, but
    /// means nothing.
    pub fn meeting(&self, wanted: &PlanBox, mut visit: impl FnMut(u32)) {
        self.tree.search(|_, node| node.meets(wanted), |one| one.meets(wanted), |i| visit(self.names[i]));
    }

    /// Calls `visit` once for every pair of boxes that meet or touch, with their names, until it returns `false`. The order is
    /// the same for the same boxes, but means nothing.
    pub fn pairs(&self, mut visit: impl FnMut(u32, u32) -> bool) {
        let apart = |m, n| !self.tree.node(m).meets(self.tree.node(n));
        self.tree.pairs(apart, |i, j| visit(self.names[i], self.names[j]));
    }
}

/// The bits of a number with a gap after each.
fn spread(x: u32) -> u64 {
    [
        (16, 0x0000_FFFF_0000_FFFF),
        (8, 0x00FF_00FF_00FF_00FF),
        (4, 0x0F0F_0F0F_0F0F_0F0F),
        (2, 0x3333_3333_3333_3333),
        (1, 0x5555_5555_5555_5555),
    ]
    .into_iter()
    .fold(u64::from(x), |x, (shift, mask)| (x | x << shift) & mask)
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn finds_every_pair_once(corners in prop::collection::vec((0..40_i32, 0..40_i32, 0..9_i32, 0..9_i32), 0..60)) {
            let boxes: Vec<(u32, PlanBox)> = corners
                .iter()
                .zip(7..)
                .map(|(&(x, y, w, h), name)| {
                    let lo = DVec2::new(x.into(), y.into());
                    (name, PlanBox { lo, hi: lo + DVec2::new(w.into(), h.into()) })
                })
                .collect();
            let mut found = Vec::new();
            BoxTree::new(&boxes).pairs(|a, b| {
                found.push((a.min(b), a.max(b)));
                true
            });
            found.sort_unstable();
            let tree = BoxTree::new(&boxes);
            for (_, one) in &boxes {
                let mut met = Vec::new();
                tree.meeting(one, |name| met.push(name));
                met.sort_unstable();
                let all: Vec<u32> = boxes.iter().filter(|(_, other)| other.meets(one)).map(|(name, _)| *name).collect();
                prop_assert_eq!(met, all);
            }
            let mut expected = Vec::new();
            for (i, (a, first)) in boxes.iter().enumerate() {
                expected.extend(boxes[i + 1..].iter().filter(|(_, second)| first.meets(second)).map(|(b, _)| (*a, *b)));
            }
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn stops_when_told() {
        let boxes = vec![(0, PlanBox { lo: DVec2::ZERO, hi: DVec2::ONE }); 10];
        let mut count = 0;
        BoxTree::new(&boxes).pairs(|_, _| {
            count += 1;
            count < 3
        });
        assert_eq!(count, 3);
    }
}
