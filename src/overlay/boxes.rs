//! A tree of boxes over things that lie near each other in the order of their numbers.

use crate::kernel::plan_box::PlanBox;
use glam::DVec2;
use std::ops::{ControlFlow, Range};

/// Things in a leaf, and children of a node.
const FAN: usize = 8;

/// The whole plane.
pub(super) const ALL: PlanBox = PlanBox { lo: DVec2::NEG_INFINITY, hi: DVec2::INFINITY };

/// The sides of a box beyond which a point lies, a bit each. The box of points that share such a bit does not meet this one, and
/// every other does.
#[inline]
pub(super) fn beyond(one: &PlanBox, p: DVec2) -> u8 {
    let [left, low] = [p.x < one.lo.x, p.y < one.lo.y];
    let [right, high] = [p.x > one.hi.x, p.y > one.hi.y];
    u8::from(left) | u8::from(low) << 1 | u8::from(right) << 2 | u8::from(high) << 3
}

/// The tree: `levels[0]` has a box for every run of [`FAN`] things, each further level one for every run of the level below.
#[derive(Debug, Default)]
pub(super) struct Boxes {
    count: usize,
    levels: Vec<Vec<PlanBox>>,
}

impl Boxes {
    /// A tree over `count` things with the boxes `of`.
    pub(super) fn new(count: usize, of: impl Fn(usize) -> PlanBox) -> Self {
        let run = |from: usize, end: usize| (from..(from + FAN).min(end)).map(&of).fold(PlanBox::EMPTY, PlanBox::join);
        let mut levels: Vec<Vec<PlanBox>> = Vec::new();
        let mut level: Vec<PlanBox> = (0..count).step_by(FAN).map(|i| run(i, count)).collect();
        while level.len() > 1 {
            let next = level.chunks(FAN).map(|c| c.iter().copied().fold(PlanBox::EMPTY, PlanBox::join)).collect();
            levels.push(std::mem::replace(&mut level, next));
        }
        levels.push(level);
        Self { count, levels }
    }

    /// Calls `visit` with runs of things whose common box meets `target`, in ascending order, until it breaks.
    pub(super) fn meeting(&self, target: &PlanBox, mut visit: impl FnMut(Range<usize>) -> ControlFlow<()>) {
        let top = self.levels.len().saturating_sub(1);
        // Breaks are told by the result of the whole; nothing is to be done about them here.
        let _ = self.descend(top, 0..self.levels.last().map_or(0, Vec::len), target, &mut visit);
    }

    fn descend(
        &self,
        level: usize,
        nodes: Range<usize>,
        target: &PlanBox,
        visit: &mut impl FnMut(Range<usize>) -> ControlFlow<()>,
    ) -> ControlFlow<()> {
        for node in nodes {
            if !self.levels[level][node].meets(target) {
                continue;
            }
            let below = if level == 0 { self.count } else { self.levels[level - 1].len() };
            let children = node * FAN..((node + 1) * FAN).min(below);
            if level == 0 {
                visit(children)?;
            } else {
                self.descend(level - 1, children, target, visit)?;
            }
        }
        ControlFlow::Continue(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_all_in_order() {
        let at = |i: usize| DVec2::new((i % 100) as f64, (i / 100) as f64);
        for count in [0, 1, 7, 8, 9, 63, 64, 65, 5000] {
            let tree = Boxes::new(count, |i| PlanBox::of([at(i), at(i) + 0.5]));
            let target = PlanBox { lo: DVec2::new(10.2, 0.7), hi: DVec2::new(12.0, 33.0) };
            let mut found = Vec::new();
            tree.meeting(&target, |run| {
                found.extend(run.filter(|&i| PlanBox::of([at(i), at(i) + 0.5]).meets(&target)));
                ControlFlow::Continue(())
            });
            let expected: Vec<usize> = (0..count).filter(|&i| PlanBox::of([at(i), at(i) + 0.5]).meets(&target)).collect();
            assert_eq!(found, expected);
        }
    }
}
