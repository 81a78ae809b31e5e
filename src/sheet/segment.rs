//! The falling sheet of one straight segment, in closed form.

use glam::{DVec2, DVec3};

/// A straight segment of the line with what its sheet needs, in the local frame.
///
/// `s` runs along the segment in plan from `a`, `t ≥ 0` is the plan distance from its straight line. The sheet is the
/// upper envelope of the cones of slope `k` on all points of the segment: two planes of slope `k` whose rulings leave the
/// segment at the angle φ from its normal, `sin φ = γ/k`, leaning down-grade, and a cone about each end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// First end in plan.
    pub a: DVec2,
    /// Height of the first end.
    pub za: f64,
    /// Second end in plan.
    pub b: DVec2,
    /// Height of the second end.
    pub zb: f64,
    /// Unit plan direction from `a` to `b`.
    pub u: DVec2,
    /// Plan length.
    pub length: f64,
    /// Gradient γ: rise per plan length from `a` to `b`.
    pub gamma: f64,
    /// `sin φ = γ/k`.
    pub sin_phi: f64,
    /// `cos φ`.
    pub cos_phi: f64,
    /// `tan φ`: how far the foot of a point lies from its normal foot, per distance `t`.
    pub tan_phi: f64,
    /// `√(k² − γ²) = k cos φ`: drop of the planes per distance `t`.
    pub drop: f64,
}

impl Segment {
    /// The segment from `a` to `b` under a side slope of `k` rise per run.
    ///
    /// Precondition: the ends differ in plan and the gradient is flatter than `k`. (A segment as steep as the slope has no
    /// such sheet; validation refuses it. Here it would merely count as its two ends.)
    pub fn new(a: DVec3, b: DVec3, k: f64) -> Self {
        let along = b.truncate() - a.truncate();
        let length = along.length();
        let gamma = (b.z - a.z) / length;
        debug_assert!(length > 0.0, "bug: a segment without plan length at {a}");
        debug_assert!(gamma.abs() < k, "bug: a segment as steep as the slope at {a}: {gamma} for {k}");
        // The factors keep the digits that k² − γ² would cancel.
        let drop = ((k - gamma) * (k + gamma)).max(0.0).sqrt();
        Self {
            a: a.truncate(),
            za: a.z,
            b: b.truncate(),
            zb: b.z,
            u: along / length,
            length,
            gamma,
            sin_phi: gamma / k,
            cos_phi: drop / k,
            tan_phi: gamma / drop.max(f64::MIN_POSITIVE),
            drop,
        }
    }

    /// Coordinates of `x` along the segment and across it, left positive.
    #[inline]
    pub fn local(&self, x: DVec2) -> DVec2 {
        let from_a = x - self.a;
        DVec2::new(self.u.dot(from_a), self.u.perp_dot(from_a))
    }

    /// Distance along the segment from `a` to the foot of `x`: where the ruling through `x` starts. Between 0 and `length`;
    /// at an end, `x` lies on that end's cone.
    #[inline]
    pub fn foot(&self, x: DVec2) -> f64 {
        let p = self.local(x);
        (p.x + p.y.abs() * self.tan_phi).max(0.0).min(self.length)
    }

    /// Height of the segment's sheet at `x`.
    ///
    /// # Accuracy
    /// Within 1e-14 of `|za| + k·(|x − a| + length)`, plus 1e-15 of the coordinates, for `|γ| ≤ 0.9999 k` and any length;
    /// proved by test `agrees_with_a_search_along_the_segment`. The ends' cones start from the ends as given, so that
    /// segments which share a vertex agree on its cone to the last bit.
    #[inline]
    pub fn height(&self, x: DVec2, k: f64) -> f64 {
        let p = self.local(x);
        let t = p.y.abs();
        let foot = p.x + t * self.tan_phi;
        if foot <= 0.0 {
            self.za - k * x.distance(self.a)
        } else if foot >= self.length {
            self.zb - k * x.distance(self.b)
        } else {
            self.za + (self.gamma * p.x - self.drop * t)
        }
    }

    /// Height of the segment's sheet at `x`, the same as [`Self::height`], and its gradient there. The sheet is concave: it
    /// lies nowhere above the plane of that height and gradient. On the segment itself, where the sheet has an edge, the
    /// gradient is that of the segment; at an end nought.
    #[inline]
    pub fn tangent(&self, x: DVec2, k: f64) -> (f64, DVec2) {
        let p = self.local(x);
        let t = p.y.abs();
        let foot = p.x + t * self.tan_phi;
        let cone = |end: DVec2, z: f64| {
            let distance = x.distance(end);
            (z - k * distance, if distance > 0.0 { (end - x) * (k / distance) } else { DVec2::ZERO })
        };
        if foot <= 0.0 {
            cone(self.a, self.za)
        } else if foot >= self.length {
            cone(self.b, self.zb)
        } else {
            let across = if t > 0.0 { self.drop.copysign(p.y) } else { 0.0 };
            (self.za + (self.gamma * p.x - self.drop * t), self.gamma * self.u - across * self.u.perp())
        }
    }

    /// The point of the segment at plan distance `s` from `a`, and its height; the ends come out as given.
    #[inline]
    pub fn point(&self, s: f64) -> DVec3 {
        if s >= self.length { self.b.extend(self.zb) } else { (self.a + s * self.u).extend(self.za + s * self.gamma) }
    }

    /// Unit plan direction of the rulings on the left: `cos φ · n − sin φ · u`, `n` the left normal. Steepest descent.
    #[inline]
    pub fn ruling_left(&self) -> DVec2 {
        self.cos_phi * self.u.perp() - self.sin_phi * self.u
    }

    /// Unit plan direction of the rulings on the right.
    #[inline]
    pub fn ruling_right(&self) -> DVec2 {
        -self.cos_phi * self.u.perp() - self.sin_phi * self.u
    }
}

/// A ruling: a straight line of steepest descent, from its foot on the line outwards. Its height at plan distance `r` from
/// the foot is `z − k·r`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ruling {
    /// Where it starts, in plan.
    pub foot: DVec2,
    /// Height of the foot.
    pub z: f64,
    /// Unit plan direction.
    pub dir: DVec2,
}

impl Ruling {
    /// The plan point at distance `r` from the foot.
    #[inline]
    pub fn at(&self, r: f64) -> DVec2 {
        self.foot + r * self.dir
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::testing::Random;

    /// The greatest of `z(s) − k·|x − p(s)|` over the segment: the definition, by golden section (it is concave in `s`).
    fn searched(a: DVec3, b: DVec3, x: DVec2, k: f64) -> f64 {
        let at = |w: f64| a.z * (1.0 - w) + b.z * w - k * x.distance(a.truncate() * (1.0 - w) + b.truncate() * w);
        let ratio = 0.5 * (5f64.sqrt() - 1.0);
        let (mut lo, mut hi) = (0.0, 1.0);
        for _ in 0..200 {
            let (m1, m2) = (hi - ratio * (hi - lo), lo + ratio * (hi - lo));
            if at(m1) < at(m2) { lo = m1 } else { hi = m2 }
        }
        at(0.5 * (lo + hi)).max(at(0.0)).max(at(1.0))
    }

    #[test]
    fn agrees_with_a_search_along_the_segment() {
        let mut random = Random::new(7);
        for i in 0..4000 {
            let k = random.between(0.1, 3.0);
            let steep = [random.between(-1.0, 1.0), 0.99, -0.9999, 0.0][i % 4] * k;
            let length = [1e-4, 1e3, random.between(0.1, 50.0)][i % 3];
            let turn = random.between(0.0, std::f64::consts::TAU);
            let a = DVec3::new(random.between(-1e3, 1e3), random.between(-1e3, 1e3), random.between(-50.0, 50.0));
            let b = a + (length * DVec2::from_angle(turn)).extend(length * steep);
            let reach = if i % 2 == 0 { 3.0 * length } else { 1e3 };
            let x = a.truncate() + DVec2::new(random.between(-reach, reach), random.between(-reach, reach));
            // Rounding of `b` may carry the gradient of a tiny segment past k.
            if (b.z - a.z).abs() >= 0.99995 * k * b.truncate().distance(a.truncate()) {
                continue;
            }
            let segment = Segment::new(a, b, k);
            let (found, expected) = (segment.height(x, k), searched(a, b, x, k));
            let scale = a.z.abs() + k * (x.distance(a.truncate()) + length) + 0.1 * a.length();
            assert!((found - expected).abs() <= 1e-14 * scale, "{i}: {found} for {expected}, {segment:?} at {x}");
            // The foot attains that height.
            let foot = segment.point(segment.foot(x));
            let attained = foot.z - k * foot.truncate().distance(x);
            assert!((attained - expected).abs() <= 1e-12 * scale, "{i}: foot attains {attained} for {expected}");
        }
    }

    #[test]
    fn lies_below_its_tangent_planes() {
        let mut random = Random::new(8);
        for i in 0..2000 {
            let (k, length) = (random.between(0.1, 3.0), [1e-4, 10.0][i % 2]);
            let b = DVec3::new(0.6 * length, -0.8 * length, length * k * random.between(-0.99, 0.99));
            let segment = Segment::new(DVec3::ZERO, b, k);
            let mut place = || DVec2::new(random.between(-9.0, 9.0), random.between(-9.0, 9.0));
            let at = if i % 20 == 0 { segment.point(0.3 * length).truncate() } else { place() };
            let (height, gradient) = segment.tangent(at, k);
            assert_eq!(height, segment.height(at, k));
            assert!(i % 20 == 0 || (gradient.length() - k).abs() <= 1e-14, "the sheet has slope k");
            for _ in 0..20 {
                let x = place();
                assert!(segment.height(x, k) <= height + gradient.dot(x - at) + 1e-13, "{segment:?} from {at} to {x}");
            }
        }
    }

    #[test]
    fn plane_rulings_and_ends() {
        // A rise of 3 in 10 under k = 0.5: sin φ = 0.6, cos φ = 0.8, exactly.
        let segment = Segment::new(DVec3::new(1.0, 2.0, 5.0), DVec3::new(11.0, 2.0, 8.0), 0.5);
        let close = |a: f64, b: f64| assert!((a - b).abs() <= 1e-14, "{a} for {b}");
        close(segment.sin_phi, 0.6);
        close(segment.cos_phi, 0.8);
        // Five along the left ruling from s = 6: x = (7, 2) + 5·(−0.6, 0.8), height 5 + 0.3·6 − 0.5·5.
        for (ruling, y) in [(segment.ruling_left(), 6.0), (segment.ruling_right(), -2.0)] {
            let x = DVec2::new(7.0, 2.0) + 5.0 * ruling;
            assert!(x.distance(DVec2::new(4.0, y)) <= 1e-14, "{x}");
            close(segment.height(x, 0.5), 4.3);
            close(segment.foot(x), 6.0);
        }
        // The ends are exact, and beyond them stand cones.
        assert_eq!((segment.height(segment.a, 0.5), segment.height(segment.b, 0.5)), (5.0, 8.0));
        close(segment.height(DVec2::new(14.0, 6.0), 0.5), 8.0 - 0.5 * 5.0);
        assert_eq!(segment.point(segment.length), DVec3::new(11.0, 2.0, 8.0));
    }
}
