//! What the trees of segments and of boxes share: a binary tree of boxes over items in a given order, and the walks through it.

use super::plan_box::PlanBox;
use std::ops::Range;

/// Items of a leaf. Small: neighbours on a line always meet, and a leaf is compared with its neighbour pair by pair.
pub(super) const LEAF: usize = 4;

/// A tree over items that are given by their boxes.
#[derive(Debug)]
pub(super) struct Tree {
    items: Vec<PlanBox>,
    /// Node `k` has the children `2k` and `2k + 1`; the leaves are the second half, all equally deep.
    nodes: Vec<PlanBox>,
}

impl Tree {
    /// A tree over items. Runs of them make good boxes if neighbours lie near each other.
    pub(super) fn new(items: Vec<PlanBox>) -> Self {
        let leaves = items.len().div_ceil(LEAF).next_power_of_two();
        let mut nodes = vec![PlanBox::EMPTY; 2 * leaves];
        for (leaf, run) in items.chunks(LEAF).enumerate() {
            nodes[leaves + leaf] = run.iter().copied().fold(PlanBox::EMPTY, PlanBox::join);
        }
        for k in (1..leaves).rev() {
            nodes[k] = nodes[2 * k].join(nodes[2 * k + 1]);
        }
        Self { items, nodes }
    }

    /// Number of the first leaf among the nodes, which is the number of leaves.
    pub(super) fn leaves(&self) -> usize {
        self.nodes.len() / 2
    }

    /// The box of a node.
    pub(super) fn node(&self, node: usize) -> &PlanBox {
        &self.nodes[node]
    }

    /// The items of a leaf.
    fn run(&self, node: usize) -> Range<usize> {
        let first = (node - self.leaves()) * LEAF;
        first.min(self.items.len())..(first + LEAF).min(self.items.len())
    }

    /// Calls `visit` once for every pair `i < j` of items whose boxes meet, until it returns `false`. `apart`: whether no item of
    /// one node can meet one of the other.
    pub(super) fn pairs(&self, apart: impl Fn(usize, usize) -> bool, mut visit: impl FnMut(usize, usize) -> bool) {
        let mut stack = vec![(1, 1)];
        while let Some((m, n)) = stack.pop() {
            if m != n && apart(m, n) {
                continue;
            }
            if m < self.leaves() {
                // Both nodes are of one level.
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
                    if i < j && self.items[i].meets(&self.items[j]) && !visit(i, j) {
                        return;
                    }
                }
            }
        }
    }

    /// Calls `visit` for every item whose box is `wanted`, in leaves all nodes above which are `reached`.
    pub(super) fn search(
        &self,
        reached: impl Fn(usize, &PlanBox) -> bool,
        wanted: impl Fn(&PlanBox) -> bool,
        mut visit: impl FnMut(usize),
    ) {
        let mut stack = vec![1];
        while let Some(n) = stack.pop() {
            if !reached(n, &self.nodes[n]) {
                continue;
            }
            if n < self.leaves() {
                stack.extend([2 * n + 1, 2 * n]);
            } else {
                self.run(n).filter(|&i| wanted(&self.items[i])).for_each(&mut visit);
            }
        }
    }
}
