//! The side slope.

/// A side slope: rise per run, the tangent of the angle against the horizontal. Positive and finite.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Slope(f64);

impl Slope {
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
}
