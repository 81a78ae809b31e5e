//! The side slope.

use super::digits::{MOST_DECIMALS, digits_before_point, rounded};
use std::ops::RangeInclusive;

/// A side slope: rise per run, the tangent of the angle against the horizontal. Positive and finite.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Slope(f64);

impl Slope {
    /// Ratios a typed slope may have. Flatter or steeper ones are slips of the keyboard, and outside these limits the angle
    /// against the horizontal (0.006° to 89.994°) is lost among the errors of the coordinates.
    pub const ACCEPTED: RangeInclusive<f64> = 1e-4..=1e4;

    /// As much rise as run.
    pub const EVEN: Self = Self(1.0);

    /// A slope of `ratio` rise per run; `None` unless it is positive and finite.
    pub fn from_ratio(ratio: f64) -> Option<Self> {
        (ratio > 0.0 && ratio.is_finite()).then_some(Self(ratio))
    }

    /// Rise per run.
    pub fn ratio(self) -> f64 {
        self.0
    }

    /// Run per unit of rise: the `n` of 1V:nH.
    pub fn one_in(self) -> f64 {
        1.0 / self.0
    }

    /// In percent.
    pub fn percent(self) -> f64 {
        100.0 * self.0
    }

    /// Angle against the horizontal in degrees.
    pub fn degrees(self) -> f64 {
        self.0.atan().to_degrees()
    }

    /// All four forms for reports: `1V:1.5H · 1.5H:1V · 66.7 % · 33.69°`. Rounded to four digits (percent to three).
    pub fn forms(self) -> String {
        let n = rounded(self.one_in(), 4);
        format!("1V:{n}H · {n}H:1V · {} % · {}°", rounded(self.percent(), 3), rounded(self.degrees(), 4))
    }

    /// As `1V:1.5H`, rounded to four digits.
    pub fn short(self) -> String {
        format!("1V:{}H", rounded(self.one_in(), 4))
    }

    /// As `1V:1.25H` with four digits, rounded so that what is shown is never flatter: for "this steep or steeper".
    pub fn not_flatter(self) -> String {
        /// What one division leaves of a number typed with few digits, relative.
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        let unit = 10_f64.powi(4_i32.saturating_sub(digits_before_point(self.one_in())).clamp(0, MOST_DECIMALS));
        format!("1V:{}H", rounded((self.one_in() * (1.0 + ROUNDING) * unit).floor() / unit, 4))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn four_forms() {
        // Angles: atan(2/3) = 33.690°, atan(1/2) = 26.565°, atan(1/3) = 18.435°, atan(1/0.3) = 73.301°.
        for (ratio, expected) in [
            (1.0 / 1.5, "1V:1.5H · 1.5H:1V · 66.7 % · 33.69°"),
            (0.5, "1V:2H · 2H:1V · 50 % · 26.57°"),
            (1.0 / 3.0, "1V:3H · 3H:1V · 33.3 % · 18.43°"),
            (1.0, "1V:1H · 1H:1V · 100 % · 45°"),
            (1.0 / 0.3, "1V:0.3H · 0.3H:1V · 333 % · 73.3°"),
            (1e-4, "1V:10000H · 10000H:1V · 0.01 % · 0.00573°"),
            (1e4, "1V:0.0001H · 0.0001H:1V · 1000000 % · 89.99°"),
        ] {
            let slope = Slope::from_ratio(ratio).unwrap();
            assert_eq!(slope.forms(), expected);
            assert_eq!(slope.short(), expected.split(' ').next().unwrap());
        }
    }

    #[test]
    fn never_shown_flatter() {
        for (ratio, expected) in [
            (0.8, "1V:1.25H"),
            (1.0 / 1.1, "1V:1.1H"),
            (1.0 / 1.23456, "1V:1.234H"),
            (1.0 / 0.99999, "1V:0.9999H"),
            (1e-4, "1V:10000H"),
        ] {
            assert_eq!(Slope::from_ratio(ratio).unwrap().not_flatter(), expected);
        }
    }

    #[test]
    fn any_slope_can_be_shown() {
        for ratio in [5e-324, 1e-300, 1e300, f64::MAX] {
            let slope = Slope::from_ratio(ratio).unwrap();
            assert!(!slope.forms().is_empty() && !slope.not_flatter().is_empty());
        }
    }

    #[test]
    fn ratios_are_positive_and_finite() {
        for ratio in [0.0, -0.5, f64::NAN, f64::INFINITY] {
            assert_eq!(Slope::from_ratio(ratio), None);
        }
    }
}
