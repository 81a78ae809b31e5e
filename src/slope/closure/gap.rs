//! A boundary while knots are put into it.

use super::Knot;

/// A list of knots with a gap that moves along it once: putting a knot in there does not move the others. The list is whole again
/// when the gap is dropped.
pub(super) struct Gap<'a> {
    /// The knots before the gap, in their order.
    pub(super) behind: &'a mut Vec<Knot>,
    /// Those after it, the nearest last.
    pub(super) ahead: Vec<Knot>,
}

impl<'a> Gap<'a> {
    /// The gap after the first knot.
    pub(super) fn new(knots: &'a mut Vec<Knot>) -> Self {
        let ahead = knots.drain(knots.len().min(1)..).rev().collect();
        Self { behind: knots, ahead }
    }

    /// Moves the gap over one knot.
    pub(super) fn step(&mut self) {
        self.behind.extend(self.ahead.pop());
    }

    /// Moves the gap over all knots before `tau`, but for the last of the list.
    pub(super) fn go_to(&mut self, tau: f64) {
        while self.ahead.len() > 1 && self.ahead.last().is_some_and(|k| k.tau < tau) {
            self.step();
        }
    }
}

impl Drop for Gap<'_> {
    fn drop(&mut self) {
        self.behind.extend(self.ahead.drain(..).rev());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn knot(tau: f64) -> Knot {
        Knot { tau, vertex: 0, left: 0, right: 0 }
    }

    #[test]
    fn what_is_put_in_stands_at_the_gap_and_the_ends_stay() {
        let mut knots: Vec<Knot> = [0.0, 1.0, 2.0].map(knot).into();
        let mut gap = Gap::new(&mut knots);
        for tau in [0.0, 1.5, 1.5, 7.0] {
            gap.go_to(tau);
            gap.ahead.push(knot(tau));
        }
        drop(gap);
        assert_eq!(knots.iter().map(|k| k.tau).collect::<Vec<_>>(), [0.0, 0.0, 1.0, 1.5, 1.5, 7.0, 2.0]);
    }

    #[test]
    fn an_empty_list_stays_empty() {
        let mut knots = Vec::new();
        Gap::new(&mut knots).step();
        assert!(knots.is_empty());
    }
}
