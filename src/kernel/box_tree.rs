//! Which upright boxes meet each other: a tree over boxes in any order.

use glam::DVec2;

/// Boxes of a leaf.
const LEAF: usize = 4;

/// An upright box by its corners, lower left and upper right.
type Corners = (DVec2, DVec2);

/// Holds nothing and meets nothing.
const EMPTY: Corners = (DVec2::INFINITY, DVec2::NEG_INFINITY);

fn join(a: Corners, b: Corners) -> Corners {
    (a.0.min(b.0), a.1.max(b.1))
}

fn meet(a: &Corners, b: &Corners) -> bool {
    a.0.x <= b.1.x && b.0.x <= a.1.x && a.0.y <= b.1.y && b.0.y <= a.1.y
}

/// A binary tree over boxes, ordered along a space-filling curve through their centres.
#[derive(Debug)]
pub struct BoxTree {
    boxes: Vec<Corners>,
    /// What the caller calls each box.
    names: Vec<u32>,
    /// Node `k` has the children `2k` and `2k + 1`; the leaves are the second half.
    nodes: Vec<Corners>,
}

impl BoxTree {
    /// A tree over boxes with finite corners, each with a name.
    pub fn new(boxes: &[(u32, Corners)]) -> Self {
        let all = boxes.iter().fold(EMPTY, |all, (_, one)| join(all, *one));
        let scale = f64::from(u32::MAX) / (all.1 - all.0).max_element().max(f64::MIN_POSITIVE);
        let mut order: Vec<(u64, u32)> = boxes
            .iter()
            .zip(0..)
            .map(|((_, (lo, hi)), i)| {
                let p = (0.5 * lo + 0.5 * hi - all.0) * scale;
                (spread(p.x as u32) | spread(p.y as u32) << 1, i)
            })
            .collect();
        order.sort_unstable();
        let leaves = boxes.len().div_ceil(LEAF).next_power_of_two();
        let mut nodes = vec![EMPTY; 2 * leaves];
        for (leaf, run) in order.chunks(LEAF).enumerate() {
            nodes[leaves + leaf] = run.iter().fold(EMPTY, |all, &(_, i)| join(all, boxes[i as usize].1));
        }
        for k in (1..leaves).rev() {
            nodes[k] = join(nodes[2 * k], nodes[2 * k + 1]);
        }
        let boxes_in_order = order.iter().map(|&(_, i)| boxes[i as usize].1).collect();
        Self { boxes: boxes_in_order, names: order.iter().map(|&(_, i)| boxes[i as usize].0).collect(), nodes }
    }

    fn run(&self, node: usize) -> std::ops::Range<usize> {
        let leaf = node - self.nodes.len() / 2;
        (leaf * LEAF).min(self.boxes.len())..((leaf + 1) * LEAF).min(self.boxes.len())
    }

    /// Calls `visit` with the name of every box that meets or touches the box from `lo` to `hi`. The order is the same for the same
    /// boxes, but means nothing.
    pub fn meeting(&self, lo: DVec2, hi: DVec2, mut visit: impl FnMut(u32)) {
        let (leaves, wanted) = (self.nodes.len() / 2, (lo, hi));
        let mut stack = vec![1];
        while let Some(n) = stack.pop() {
            if !meet(&self.nodes[n], &wanted) {
                continue;
            }
            if n < leaves {
                stack.extend([2 * n + 1, 2 * n]);
            } else {
                self.run(n).filter(|&i| meet(&self.boxes[i], &wanted)).for_each(|i| visit(self.names[i]));
            }
        }
    }

    /// Calls `visit` once for every pair of boxes that meet or touch, with their names, until it returns `false`. The order is the
    /// same for the same boxes, but means nothing.
    pub fn pairs(&self, mut visit: impl FnMut(u32, u32) -> bool) {
        let leaves = self.nodes.len() / 2;
        let mut stack = vec![(1, 1)];
        while let Some((m, n)) = stack.pop() {
            if !meet(&self.nodes[m], &self.nodes[n]) {
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
                    if i < j && meet(&self.boxes[i], &self.boxes[j]) && !visit(self.names[i], self.names[j]) {
                        return;
                    }
                }
            }
        }
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
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn finds_every_pair_once(corners in prop::collection::vec((0..40_i32, 0..40_i32, 0..9_i32, 0..9_i32), 0..60)) {
            let boxes: Vec<(u32, Corners)> = corners
                .iter()
                .zip(7..)
                .map(|(&(x, y, w, h), name)| {
                    let lo = DVec2::new(x.into(), y.into());
                    (name, (lo, lo + DVec2::new(w.into(), h.into())))
                })
                .collect();
            let mut found = Vec::new();
            BoxTree::new(&boxes).pairs(|a, b| {
                found.push((a.min(b), a.max(b)));
                true
            });
            found.sort_unstable();
            let tree = BoxTree::new(&boxes);
            for (_, (lo, hi)) in &boxes {
                let mut met = Vec::new();
                tree.meeting(*lo, *hi, |name| met.push(name));
                met.sort_unstable();
                let all: Vec<u32> = boxes.iter().filter(|(_, other)| meet(other, &(*lo, *hi))).map(|(name, _)| *name).collect();
                prop_assert_eq!(met, all);
            }
            let mut expected = Vec::new();
            for (i, (a, first)) in boxes.iter().enumerate() {
                expected.extend(boxes[i + 1..].iter().filter(|(_, second)| meet(first, second)).map(|(b, _)| (*a, *b)));
            }
            prop_assert_eq!(found, expected);
        }
    }

    #[test]
    fn stops_when_told() {
        let boxes = vec![(0, (DVec2::ZERO, DVec2::ONE)); 10];
        let mut count = 0;
        BoxTree::new(&boxes).pairs(|_, _| {
            count += 1;
            count < 3
        });
        assert_eq!(count, 3);
    }
}
