//! Clothoids: curves whose curvature changes linearly with their length.

use glam::DVec2;

/// Nodes and weights of the Gauss–Legendre rule of eight points on −1 to 1, positive half (M. Abramowitz, I. A. Stegun, "Handbook
/// of Mathematical Functions", table 25.4).
const GAUSS: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_3),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_2, 0.101_228_536_290_376_26),
];

/// Turn in radians over which one rule of eight points integrates sine and cosine to the last digits.
const TURN: f64 = 1.0;

/// Most that a clothoid may turn, in radians: ten times round. Those of roads turn by less than a quarter.
pub(super) const MOST_TURN: f64 = 20.0 * std::f64::consts::PI;

/// A clothoid that begins at the origin, in the direction of the first axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Clothoid {
    /// Curvature at the beginning, 1 / radius; positive to the left.
    pub(super) from: f64,
    /// Curvature at the end.
    pub(super) to: f64,
    /// Length, positive.
    pub(super) length: f64,
}

impl Clothoid {
    /// Direction at the distance `s` along it, in radians.
    pub(super) fn direction(&self, s: f64) -> f64 {
        s * (self.from + 0.5 * s * (self.to - self.from) / self.length)
    }

    /// Upper bound of how far it turns this way and that, in radians.
    pub(super) fn turn(&self) -> f64 {
        self.length * self.from.abs().max(self.to.abs())
    }

    /// The point at the distance `s`: the integral of the direction (Fresnel integrals, if the curvature begins at nought).
    ///
    /// Relative error below 1e-13 for turns up to [`MOST_TURN`].
    pub(super) fn at(&self, s: f64) -> DVec2 {
        let bends = s.abs() * self.from.abs().max(self.to.abs());
        let panels = (bends.min(MOST_TURN) / TURN).ceil().max(1.0);
        let half = 0.5 * s / panels;
        let mut sum = DVec2::ZERO;
        for panel in 0..panels as u32 {
            let middle = half * (2.0 * f64::from(panel) + 1.0);
            let mut part = DVec2::ZERO;
            for (node, weight) in GAUSS {
                for t in [middle - half * node, middle + half * node] {
                    part += weight * DVec2::from_angle(self.direction(t));
                }
            }
            sum += half * part;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, PI};

    #[test]
    fn the_rule_is_exact_for_polynomials_of_degree_fifteen() {
        for degree in [0, 2, 4, 8, 14] {
            let sum: f64 = GAUSS.iter().map(|(node, weight)| 2.0 * weight * node.powi(degree)).sum();
            assert!((sum - 2.0 / f64::from(degree + 1)).abs() < 1e-15, "{degree}: {sum}");
        }
    }

    /// C(x) = ∫ cos(πt²/2) dt, S(x) = ∫ sin(πt²/2) dt from 0 to x: Abramowitz and Stegun, table 7.7 (seven digits and more);
    /// NIST Digital Library of Mathematical Functions, 7.23 points to the same tables.
    #[test]
    fn fresnel_integrals() {
        for (x, c, s) in [
            (0.5, 0.492_344_225_9, 0.064_732_432_9),
            (1.0, 0.779_893_400_4, 0.438_259_147_4),
            (1.5, 0.445_261_176, 0.697_504_960_1),
            (2.0, 0.488_253_406, 0.343_415_678_4),
        ] {
            // Curvature π t at the distance t.
            let found = Clothoid { from: 0.0, to: PI * x, length: x }.at(x);
            assert!((found - DVec2::new(c, s)).length() < 1e-9, "{x}: {found}");
        }
    }

    /// The power series of the same integrals, summed here: Abramowitz and Stegun 7.3.11 and 7.3.13.
    #[test]
    fn agrees_with_the_power_series() {
        let series = |x: f64| {
            let (mut c, mut s) = (0.0, 0.0);
            let mut term = x;
            let square = FRAC_PI_2 * x * x;
            for n in 0..40 {
                let power = f64::from(2 * n + 1);
                // term = (−1)^(n/2) (π/2)^n x^(2n+1) / n!
                match n % 4 {
                    0 => c += term / power,
                    1 => s += term / power,
                    2 => c -= term / power,
                    _ => s -= term / power,
                }
                term *= square / f64::from(n + 1);
            }
            DVec2::new(c, s)
        };
        for i in 1..=16 {
            let x = 0.1 * f64::from(i);
            let found = Clothoid { from: 0.0, to: PI * x, length: x }.at(x);
            assert!((found - series(x)).length() < 1e-12 * x, "{x}: {found} against {}", series(x));
        }
    }

    #[test]
    fn circles_and_straights_are_clothoids() {
        for (length, radius) in [(10.0, 25.0), (60.0, -20.0), (300.0, 7.0)] {
            let arc = Clothoid { from: 1.0 / radius, to: 1.0 / radius, length };
            let angle = length / radius;
            let expected = radius * DVec2::new(angle.sin(), 1.0 - angle.cos());
            assert!((arc.at(length) - expected).length() < 1e-12 * length, "{length} {radius}");
        }
        assert_eq!(Clothoid { from: 0.0, to: 0.0, length: 5.0 }.at(3.0), DVec2::new(3.0, 0.0));
    }

    #[test]
    fn parts_make_up_the_whole() {
        let whole = Clothoid { from: -0.05, to: 0.2, length: 80.0 };
        let cut = 31.0;
        let between = whole.from + (whole.to - whole.from) * cut / whole.length;
        let first = Clothoid { from: whole.from, to: between, length: cut };
        let second = Clothoid { from: between, to: whole.to, length: whole.length - cut };
        let turned = DVec2::from_angle(whole.direction(cut)).rotate(second.at(second.length));
        assert!((first.at(cut) + turned - whole.at(80.0)).length() < 1e-12);
    }
}
