//! Upright boxes in plan.

use glam::DVec2;

/// An upright box by its corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlanBox {
    /// Lower left.
    pub lo: DVec2,
    /// Upper right.
    pub hi: DVec2,
}

impl PlanBox {
    /// Holds nothing and meets nothing.
    pub const EMPTY: Self = Self { lo: DVec2::INFINITY, hi: DVec2::NEG_INFINITY };

    /// The smallest box around points; [`Self::EMPTY`] for none.
    #[inline]
    pub fn of(points: impl IntoIterator<Item = DVec2>) -> Self {
        points.into_iter().fold(Self::EMPTY, Self::with)
    }

    /// The same with a point in it.
    #[must_use]
    #[inline]
    pub fn with(self, p: DVec2) -> Self {
        Self { lo: self.lo.min(p), hi: self.hi.max(p) }
    }

    /// The smallest box around both.
    #[must_use]
    #[inline]
    pub fn join(self, other: Self) -> Self {
        Self { lo: self.lo.min(other.lo), hi: self.hi.max(other.hi) }
    }

    /// Whether the two have a common point, be it on their edges.
    #[inline]
    pub fn meets(&self, other: &Self) -> bool {
        self.lo.cmple(other.hi).all() && other.lo.cmple(self.hi).all()
    }

    /// Whether a point lies in it, be it on its edges.
    #[inline]
    pub fn contains(&self, p: DVec2) -> bool {
        self.lo.cmple(p).all() && p.cmple(self.hi).all()
    }

    /// Whether it holds nothing.
    pub fn is_empty(&self) -> bool {
        !self.lo.cmple(self.hi).all()
    }

    /// Width and height; −∞ of an empty box.
    pub fn size(&self) -> DVec2 {
        self.hi - self.lo
    }

    /// The point in the middle.
    pub fn middle(&self) -> DVec2 {
        0.5 * self.lo + 0.5 * self.hi
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn boxes_of_points() {
        let p = |x: f64, y: f64| DVec2::new(x, y);
        let bounds = PlanBox::of([p(1.0, 5.0), p(-2.0, 7.0), p(0.0, 6.0)]);
        assert_eq!(bounds, PlanBox { lo: p(-2.0, 5.0), hi: p(1.0, 7.0) });
        assert_eq!((bounds.size(), bounds.middle()), (p(3.0, 2.0), p(-0.5, 6.0)));
        assert_eq!(bounds.join(PlanBox::of([p(4.0, 6.0)])).hi, p(4.0, 7.0));
        // Edges and corners touch; nothing meets an empty box, not even another.
        let meets = |x, y| bounds.meets(&PlanBox::of([p(x, y)]));
        assert!(meets(1.0, 7.0) && meets(0.0, 6.0) && !meets(1.1, 6.0) && !meets(0.0, 4.9));
        assert!(!bounds.meets(&PlanBox::EMPTY) && !PlanBox::EMPTY.meets(&PlanBox::EMPTY) && PlanBox::of([]) == PlanBox::EMPTY);
        assert!(PlanBox::EMPTY.is_empty() && !PlanBox::of([p(4.0, 6.0)]).is_empty());
    }
}
