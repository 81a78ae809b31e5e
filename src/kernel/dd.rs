//! Double-double arithmetic: an unevaluated sum of two f64, about 106 bits (32 decimal digits).
//!
//! For the few crossings that nearly tie in f64; some twenty times dearer than plain arithmetic. Products are split by
//! Dekker's method, not by a fused multiply-add: baseline x86-64 has none, and the library call in its stead is slow.
//! The results hold for magnitudes between 1e-140 and 1e140, far beyond any coordinate; no test for overflow is made.
//!
//! References: T. J. Dekker, "A floating-point technique for extending the available precision", Numer. Math. 18 (1971);
//! M. Joldes, J.-M. Muller, V. Popescu, "Tight and rigorous error bounds for basic building blocks of double-word
//! arithmetic", ACM TOMS 44 (2017), after which these are written, products split instead of fused.

mod vec2;

use std::ops::{Add, AddAssign, Div, Mul, Neg, Sub, SubAssign};

pub use vec2::DdVec2;

/// A number `hi + lo`, `|lo| ≤ ulp(hi)/2`. Relative error of one operation: a few 2⁻¹⁰⁴.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub struct Dd {
    // Ordered by `hi`, then `lo`: right because the pair is normalised.
    hi: f64,
    lo: f64,
}

/// `a + b` exactly, for `|a| ≥ |b|` or `a = 0`.
#[inline]
fn quick_two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    Dd { hi, lo: b - (hi - a) }
}

/// `a + b` exactly.
#[inline]
fn two_sum(a: f64, b: f64) -> Dd {
    let hi = a + b;
    let b_part = hi - a;
    Dd { hi, lo: (a - (hi - b_part)) + (b - b_part) }
}

/// `a` as a sum of two numbers of 26 bits.
#[inline]
fn split(a: f64) -> (f64, f64) {
    const SPLITTER: f64 = 134_217_729.0; // 2²⁷ + 1
    let t = SPLITTER * a;
    let high = t - (t - a);
    (high, a - high)
}

/// `a · b` exactly.
#[inline]
fn two_prod(a: f64, b: f64) -> Dd {
    let hi = a * b;
    let ((ah, al), (bh, bl)) = (split(a), split(b));
    Dd { hi, lo: ((ah * bh - hi) + ah * bl + al * bh) + al * bl }
}

impl Dd {
    /// Nought.
    pub const ZERO: Self = Self { hi: 0.0, lo: 0.0 };
    /// One.
    pub const ONE: Self = Self { hi: 1.0, lo: 0.0 };

    /// `a + b`, exact.
    #[inline]
    pub fn sum(a: f64, b: f64) -> Self {
        two_sum(a, b)
    }

    /// `a − b`, exact.
    #[inline]
    pub fn difference(a: f64, b: f64) -> Self {
        two_sum(a, -b)
    }

    /// `a · b`, exact.
    #[inline]
    pub fn product(a: f64, b: f64) -> Self {
        two_prod(a, b)
    }

    /// The nearest f64.
    #[inline]
    pub fn to_f64(self) -> f64 {
        self.hi + self.lo
    }

    /// What the nearest f64 leaves over.
    #[inline]
    pub fn rest(self) -> f64 {
        self.lo
    }

    /// Whether the number is below nought.
    #[inline]
    pub fn is_negative(self) -> bool {
        self.hi < 0.0
    }

    /// −1, 0 or 1.
    #[inline]
    pub fn signum(self) -> f64 {
        if self.hi > 0.0 {
            1.0
        } else if self.hi < 0.0 {
            -1.0
        } else {
            0.0
        }
    }

    /// The absolute value.
    #[inline]
    pub fn abs(self) -> Self {
        if self.hi < 0.0 { -self } else { self }
    }

    /// The number times itself.
    #[inline]
    pub fn square(self) -> Self {
        let p = two_prod(self.hi, self.hi);
        quick_two_sum(p.hi, p.lo + 2.0 * (self.hi * self.lo))
    }

    /// The square root; nought for nought and for negative numbers, which here are always rounding below nought.
    #[inline]
    pub fn sqrt(self) -> Self {
        if self.hi <= 0.0 {
            return Self::ZERO;
        }
        let root = self.hi.sqrt();
        // One step of Newton: the remainder is exact in its leading part.
        let remainder = (self - two_prod(root, root)).hi;
        quick_two_sum(root, remainder / (2.0 * root))
    }

    /// The smaller of two.
    #[inline]
    pub fn min(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    /// The larger of two.
    #[inline]
    pub fn max(self, other: Self) -> Self {
        if other > self { other } else { self }
    }
}

impl From<f64> for Dd {
    #[inline]
    fn from(hi: f64) -> Self {
        Self { hi, lo: 0.0 }
    }
}

impl Neg for Dd {
    type Output = Self;
    #[inline]
    fn neg(self) -> Self {
        Self { hi: -self.hi, lo: -self.lo }
    }
}

impl Add for Dd {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        let (s, t) = (two_sum(self.hi, other.hi), two_sum(self.lo, other.lo));
        let v = quick_two_sum(s.hi, s.lo + t.hi);
        quick_two_sum(v.hi, t.lo + v.lo)
    }
}

impl Add<f64> for Dd {
    type Output = Self;
    #[inline]
    fn add(self, other: f64) -> Self {
        let s = two_sum(self.hi, other);
        quick_two_sum(s.hi, self.lo + s.lo)
    }
}

impl Mul for Dd {
    type Output = Self;
    #[inline]
    fn mul(self, other: Self) -> Self {
        let p = two_prod(self.hi, other.hi);
        let cross = self.hi * other.lo + self.lo * other.hi + self.lo * other.lo;
        quick_two_sum(p.hi, p.lo + cross)
    }
}

impl Mul<f64> for Dd {
    type Output = Self;
    #[inline]
    fn mul(self, other: f64) -> Self {
        let p = two_prod(self.hi, other);
        quick_two_sum(p.hi, p.lo + self.lo * other)
    }
}

impl Div for Dd {
    type Output = Self;
    #[inline]
    fn div(self, other: Self) -> Self {
        let quotient = self.hi / other.hi;
        let remainder = self - other * quotient;
        quick_two_sum(quotient, remainder.hi / other.hi)
    }
}

impl Div<f64> for Dd {
    type Output = Self;
    #[inline]
    fn div(self, other: f64) -> Self {
        let quotient = self.hi / other;
        let remainder = self - two_prod(quotient, other);
        quick_two_sum(quotient, remainder.hi / other)
    }
}

impl Sub for Dd {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Sub<f64> for Dd {
    type Output = Self;
    #[inline]
    fn sub(self, other: f64) -> Self {
        self + -other
    }
}

impl AddAssign for Dd {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl SubAssign for Dd {
    #[inline]
    fn sub_assign(&mut self, other: Self) {
        *self = *self - other;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::testing::Random;

    /// A few units of 2⁻¹⁰⁴ ≈ 4.9e-32.
    const RELATIVE: f64 = 2.0e-31;

    /// A number with all of its 106 bits in use, of either sign, between 1e-3 and 1e3 in magnitude.
    fn any(random: &mut Random) -> Dd {
        let sign = if random.unit() < 0.5 { -1.0 } else { 1.0 };
        let hi = sign * 10f64.powf(6.0 * random.unit() - 3.0);
        Dd::sum(hi, hi * (random.unit() - 0.5) * f64::EPSILON)
    }

    /// The number times 10³⁰, rounded down, in integers only: an independent reading of both words.
    fn scaled_digits(x: Dd) -> i128 {
        const UNIT: u32 = 100; // bits behind the point
        let fixed = |v: f64| -> i128 {
            let bits = v.to_bits();
            let exponent = ((bits >> 52) & 0x7ff) as i64 - 1075;
            let mantissa = ((bits & ((1 << 52) - 1)) | (1 << 52)) as i128;
            let shift = exponent + i64::from(UNIT);
            let magnitude = if shift >= 0 { mantissa << shift } else { mantissa >> -shift };
            if v < 0.0 { -magnitude } else { magnitude }
        };
        let mut rest = fixed(x.hi) + fixed(x.lo);
        let mut digits = 0i128;
        for _ in 0..=30 {
            digits = digits * 10 + (rest >> UNIT);
            rest = (rest & ((1i128 << UNIT) - 1)) * 10;
        }
        digits
    }

    #[test]
    fn known_digits() {
        // Square roots of 2 and 3, and 1/7, to thirty places (OEIS A002193, A002194; 142857 repeating).
        let cases = [
            (Dd::from(2.0).sqrt(), 1_414_213_562_373_095_048_801_688_724_209i128),
            (Dd::from(3.0).sqrt(), 1_732_050_807_568_877_293_527_446_341_505),
            (Dd::ONE / 7.0, 142_857_142_857_142_857_142_857_142_857),
            (Dd::ONE / Dd::from(7.0), 142_857_142_857_142_857_142_857_142_857),
        ];
        for (value, digits) in cases {
            assert!((scaled_digits(value) - digits).abs() <= 1, "{value:?}: {} for {digits}", scaled_digits(value));
        }
    }

    #[test]
    fn products_and_sums_of_f64_are_exact() {
        // (1 + 2⁻⁴⁰)² = 1 + 2⁻³⁹ + 2⁻⁸⁰ needs 81 bits.
        let x = 1.0 + 2f64.powi(-40);
        let p = Dd::product(x, x);
        assert_eq!((p.to_f64(), p.rest()), (1.0 + 2f64.powi(-39), 2f64.powi(-80)));
        let s = Dd::sum(1.0, 1e-30) - 1.0;
        assert_eq!(s.to_f64(), 1e-30);
        assert_eq!(Dd::difference(1.0, 1e-30).rest(), -1e-30);
    }

    #[test]
    fn field_identities_on_random_numbers() {
        let random = &mut Random::new(1);
        for _ in 0..20_000 {
            let (a, b, c) = (any(random), any(random), any(random));
            let near = |x: Dd, y: Dd, size: Dd| assert!((x - y).abs().to_f64() <= RELATIVE * size.abs().to_f64(), "{x:?} {y:?}");
            near(a * b / b, a, a);
            near(a * b.hi / b.hi, a, a);
            near((a + b) - b, a, a.abs() + b.abs());
            near((a + b.hi) - b.hi, a, a.abs() + b.abs());
            near(a * (b + c), a * b + a * c, (a * b).abs() + (a * c).abs());
            near(a * b.hi, a * Dd::from(b.hi), a * b);
            near(a.square(), a * a, a * a);
            near(a.abs().sqrt().square(), a.abs(), a);
            assert_eq!(a * b, b * a);
            assert_eq!(a + b, b + a);
        }
    }

    #[test]
    fn order_and_sign_see_the_low_word() {
        let above = Dd::sum(1.0, 1e-25);
        assert!(above > Dd::ONE && -above < -Dd::ONE && above.max(Dd::ONE) == above && above.min(Dd::ONE) == Dd::ONE);
        let below = Dd::ONE - above;
        assert!(below.is_negative() && below.signum() == -1.0 && below.abs().signum() == 1.0 && Dd::ZERO.signum() == 0.0);
        assert_eq!(Dd::from(-1.0).sqrt(), Dd::ZERO);
    }
}
