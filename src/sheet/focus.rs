//! Bounds for stretches of the line that are equally high at one place: arcs, seen from their centre.
//!
//! In the middle of a circle all sheets nearly tie. The box about a chord's worth of segments reaches nearer to the middle than
//! the segments do, by the rise of their arc, and so no box can be left out there. But seen from the middle itself all of them
//! are equally high, and from a place `ρ` aside of it they are higher by no more than `k·ρ·cos ψ`, where `ψ` is the least angle
//! between the way there and any of their directions. On a curve of any shape the same holds about its centre of curvature, and
//! for sloping lines about the place where their rulings meet.

use glam::DVec2;

use super::Segment;

/// A focus is kept where it bounds heights this much better than the box.
const WORTHWHILE: f64 = 0.25;

/// How far a focus may be away, in units of the size of everything: beyond, its heights lose digits.
const FARTHEST: f64 = 4.0;

/// The place at which the segments of a node are about equally high.
#[derive(Clone, Copy, Debug)]
pub(super) struct Focus {
    at: DVec2,
    /// Height of the sheet of the segments there.
    height: f64,
    /// Unit vector to the middle of the segments as seen from there, with cosine and sine of half the angle that they fill.
    towards: DVec2,
    cos: f64,
    sin: f64,
}

/// What the box of a node knows of its segments.
pub(super) struct Around {
    /// Mean of all ends in plan, and unit vector of the long side.
    pub(super) mean: DVec2,
    pub(super) axis: DVec2,
    /// Rise of the lid along the axis.
    pub(super) rise: f64,
    /// How much higher than the segments the box may bound them.
    pub(super) slack: f64,
}

impl Focus {
    /// The focus of some segments, if it is worthwhile; `bend` is that of their ends, in plan and, over `k`, in height. `size` is
    /// that of everything.
    pub(super) fn of(segments: &[Segment], around: &Around, bend: &Bend, size: f64, k: f64) -> Option<Self> {
        let ends = || segments.iter().flat_map(|s| [(s.a, s.za), (s.b, s.zb)]);
        let (sin_phi, axis) = (around.rise / k, around.axis);
        let cos_phi = ((1.0 - sin_phi) * (1.0 + sin_phi)).max(0.0).sqrt();
        let DVec2 { x: across, y: up } = bend.square();
        // Seen from D along the rulings of the middle a bend b·s² is level where b = cos²φ / 2D.
        let side = 1.0_f64.copysign(across);
        let bend = up + across.abs() * cos_phi;
        let distance = 0.5 * cos_phi * cos_phi / bend;
        if !(distance > 0.0 && distance <= FARTHEST * size) {
            return None;
        }
        let ruling = side * cos_phi * axis.perp() - sin_phi * axis;
        let at = around.mean + distance * ruling;
        let (mut low, mut high, mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY, f64::NEG_INFINITY);
        for (p, z) in ends() {
            let seen = p - at;
            let height = z - k * seen.length();
            (low, high) = (low.min(height), high.max(height));
            if high - low > WORTHWHILE * around.slack {
                return None;
            }
            let (along, aside) = (-ruling.dot(seen), -ruling.perp_dot(seen));
            if along <= 0.0 {
                return None;
            }
            (left, right) = (left.min(aside / along), right.max(aside / along));
        }
        let height = segments.iter().map(|s| s.height(at, k)).fold(f64::NEG_INFINITY, f64::max);
        if height - low > WORTHWHILE * around.slack {
            return None;
        }
        let direction = |tan: f64| (-ruling - tan * ruling.perp()).normalize();
        let (first, last) = (direction(left), direction(right));
        let towards = (first + last).try_normalize()?;
        Some(Self { at, height, towards, cos: towards.dot(last), sin: towards.perp_dot(last).abs() })
    }

    /// No sheet of the segments is higher at `x`, up to rounding.
    ///
    /// For a point `p` of them in the unit direction `v` from the focus `c`, `|x − p| ≥ v·(p − x) = |p − c| − v·(x − c)`. So its cone
    /// is at `x` no higher than its height at `c` and `k·v·(x − c)`.
    #[inline]
    pub(super) fn bound(&self, x: DVec2, k: f64) -> f64 {
        let d = x - self.at;
        let (along, aside) = (self.towards.dot(d), self.towards.perp_dot(d).abs());
        let between = aside * self.cos <= along * self.sin;
        self.height + k * if between { d.length() } else { along * self.cos + aside * self.sin }
    }
}

/// A parabola of two values over one variable, by least squares.
#[derive(Default)]
pub(super) struct Bend {
    count: f64,
    /// Sums of powers of the variable, from the first to the fourth.
    powers: [f64; 4],
    /// Sums of the values times powers of the variable, from the zeroth to the second.
    values: [DVec2; 3],
}

impl Bend {
    #[inline]
    pub(super) fn add(&mut self, s: f64, value: DVec2) {
        let square = s * s;
        self.count += 1.0;
        for (sum, power) in self.powers.iter_mut().zip([s, square, square * s, square * square]) {
            *sum += power;
        }
        for (sum, power) in self.values.iter_mut().zip([1.0, s, square]) {
            *sum += value * power;
        }
    }

    /// The coefficients of the square; not finite where there are no three places.
    fn square(&self) -> DVec2 {
        let n = self.count;
        let [a, b, c, d] = self.powers.map(|p| p / n);
        let [v, w, q] = self.values.map(|v| v / n);
        // Normal equations about the means of the variable and of its square.
        let (ss, sq, qq) = (b - a * a, c - a * b, d - b * b);
        ((q - v * b) * ss - (w - v * a) * sq) / (ss * qq - sq * sq)
    }
}
