//! Plan vectors in double-double.

use std::ops::{Add, Neg, Sub};

use glam::DVec2;

use super::Dd;

/// A plan vector of double-doubles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct DdVec2 {
    /// First coordinate.
    pub x: Dd,
    /// Second coordinate.
    pub y: Dd,
}

impl DdVec2 {
    /// `to − from`, exact.
    #[inline]
    pub fn between(from: DVec2, to: DVec2) -> Self {
        Self { x: Dd::difference(to.x, from.x), y: Dd::difference(to.y, from.y) }
    }

    /// Inner product.
    #[inline]
    pub fn dot(self, other: Self) -> Dd {
        self.x * other.x + self.y * other.y
    }

    /// `x·other.y − y·other.x`: positive when `other` lies to the left of `self`.
    #[inline]
    pub fn perp_dot(self, other: Self) -> Dd {
        self.x * other.y - self.y * other.x
    }

    /// The vector times a number.
    #[inline]
    pub fn scale(self, by: Dd) -> Self {
        Self { x: self.x * by, y: self.y * by }
    }

    /// The vector turned by a quarter to the left.
    #[inline]
    pub fn perp(self) -> Self {
        Self { x: -self.y, y: self.x }
    }

    /// Length squared.
    #[inline]
    pub fn length_squared(self) -> Dd {
        self.x.square() + self.y.square()
    }

    /// Length.
    #[inline]
    pub fn length(self) -> Dd {
        self.length_squared().sqrt()
    }

    /// The nearest vector of f64.
    #[inline]
    pub fn to_f64(self) -> DVec2 {
        DVec2::new(self.x.to_f64(), self.y.to_f64())
    }
}

impl From<DVec2> for DdVec2 {
    #[inline]
    fn from(v: DVec2) -> Self {
        Self { x: v.x.into(), y: v.y.into() }
    }
}

impl Add for DdVec2 {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y }
    }
}

impl Sub for DdVec2 {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y }
    }
}

impl Neg for DdVec2 {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { x: -self.x, y: -self.y }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_keep_what_f64_cancels() {
        // a × b with a = (1 + ε, 1), b = (1, 1 − ε): (1 + ε)(1 − ε) − 1 = −ε², nought in f64 for ε = 2⁻⁴⁰.
        let e = 2f64.powi(-40);
        let (a, b) = (DVec2::new(1.0 + e, 1.0), DVec2::new(1.0, 1.0 - e));
        assert_eq!(a.perp_dot(b), 0.0);
        assert_eq!(DdVec2::from(a).perp_dot(b.into()).to_f64(), -e * e);
        let d = DdVec2::between(DVec2::new(3.0, 4.0), DVec2::ZERO);
        assert_eq!((d.length().to_f64(), d.dot(d).to_f64(), d.perp().to_f64()), (5.0, 25.0, DVec2::new(4.0, -3.0)));
        assert_eq!((d.scale(Dd::from(2.0)) + d - -d).to_f64(), DVec2::new(-12.0, -16.0));
    }
}
