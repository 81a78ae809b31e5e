//! How much may be spent on closing a sheet.

use std::sync::atomic::{AtomicU64, Ordering};

/// Comparisons there are for every line, and for each of its edges. Lines as they occur take some ten for an edge, the middle of a
/// circle of which all vertices are kept a hundred.
const MOST: [u64; 2] = [1_000_000, 500];

/// What there is besides for each pair of edges, and for all of them. Where sheets tie to the last digits, each ruling is compared
/// with all of them, and the more they are the more is rounding of what comes of it: a thousand are seen through, more are not.
const TIED: [u64; 2] = [32, 30_000_000];

/// Comparisons that a step along a boundary is worth.
const STEP: u64 = 16;

/// Counts comparisons of rulings and vertices with edges. Whether it runs out does not depend on the order in which they are counted.
pub struct Effort {
    spent: AtomicU64,
    most: u64,
}

impl Effort {
    /// What there is for a line of so many edges.
    pub fn for_edges(count: usize) -> Self {
        let count = count as u64;
        let tied = (TIED[0] * count).saturating_mul(count).min(TIED[1]);
        Self { spent: AtomicU64::new(0), most: MOST[0] + MOST[1] * count + tied }
    }

    /// Counts comparisons.
    pub(super) fn compare(&self, count: u32) {
        self.spent.fetch_add(count.into(), Ordering::Relaxed);
    }

    /// Counts a step, or a vertex put in.
    pub(super) fn step(&self) {
        self.spent.fetch_add(STEP, Ordering::Relaxed);
    }

    /// Whether it ran out: what is left to do is not worth it.
    pub fn is_spent(&self) -> bool {
        self.spent.load(Ordering::Relaxed) > self.most
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_out_after_what_there_is_for_the_line_and_its_edges() {
        let effort = Effort::for_edges(10);
        effort.compare(1_000_000 + 10 * 500);
        (0..10 * 10 * 32 / STEP).for_each(|_| effort.step());
        assert!(!effort.is_spent());
        effort.compare(1);
        assert!(effort.is_spent());
    }
}
