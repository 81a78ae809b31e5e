//! The local frame: all arithmetic runs about an origin close to the data.

use glam::{DVec2, DVec3};

/// A translation in plan between world coordinates and the local frame. Heights are never shifted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    origin: DVec2,
}

/// Coordinates within this multiple of the extent need no shift: arithmetic loses at most four of 53 bits.
const FAR_FROM_ORIGIN: f64 = 16.0;

impl Frame {
    /// The frame of world coordinates: no shift.
    pub const WORLD: Self = Self { origin: DVec2::ZERO };

    /// A frame for points of the given plan box, in world units.
    ///
    /// The origin is the rounded centre when the box lies further from zero than sixteen times its extent; otherwise zero.
    /// In both cases `to_world(to_local(p)) == p` bit for bit for every point of the box: `p − origin` is then a multiple of
    /// the unit in the last place of `p` and smaller than `p`, hence exact.
    pub fn around(min: DVec2, max: DVec2) -> Self {
        let extent = (max - min).max_element();
        let pick = |lo: f64, hi: f64| {
            let nearest = if lo <= 0.0 && hi >= 0.0 { 0.0 } else { lo.abs().min(hi.abs()) };
            if nearest > FAR_FROM_ORIGIN * extent { (0.5 * lo + 0.5 * hi).round() } else { 0.0 }
        };
        Self { origin: DVec2::new(pick(min.x, max.x), pick(min.y, max.y)) }
    }

    /// The local origin in world coordinates.
    pub fn origin(&self) -> DVec2 {
        self.origin
    }

    /// World to local.
    pub fn to_local(&self, p: DVec3) -> DVec3 {
        p - self.origin.extend(0.0)
    }

    /// Local to world.
    pub fn to_world(&self, p: DVec3) -> DVec3 {
        p + self.origin.extend(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_trip_is_exact() {
        for (min, max) in
            [((500_000.123, 4_649_776.22), (500_700.7, 4_650_000.9)), ((-3.3, 0.1), (7.7, 9.3)), ((0.1, 0.7), (80.3, 90.9))]
        {
            let (min, max) = (DVec2::from(min), DVec2::from(max));
            let frame = Frame::around(min, max);
            for i in 0..=1000 {
                let p = (min + (max - min) * (f64::from(i) / 1000.0)).extend(12.3);
                assert_eq!(frame.to_world(frame.to_local(p)), p);
                // Small numbers, which is what the frame is for: within the extent and the rounding of the origin.
                let most = FAR_FROM_ORIGIN.mul_add((max - min).max_element(), 1.0);
                assert!(frame.to_local(p).truncate().abs().max_element() <= most + (max - min).max_element(), "{p}");
            }
        }
    }

    /// Far boxes are shifted to their middle, each direction by itself; near ones stay.
    #[test]
    fn origins() {
        let origin = |min: (f64, f64), max: (f64, f64)| Frame::around(min.into(), max.into()).origin();
        assert_eq!(origin((500_000.0, 4_649_776.0), (500_700.0, 4_650_000.0)), DVec2::new(500_350.0, 4_649_888.0));
        assert_eq!(origin((-500_700.0, 1_000.0), (-500_000.0, 1_100.0)), DVec2::new(-500_350.0, 0.0));
        assert_eq!(origin((0.0, 0.0), (500_700.0, 4_650_000.0)), DVec2::ZERO);
        assert_eq!(origin((1_600.5, -3.0), (1_700.5, 3.0)), DVec2::new(1_651.0, 0.0));
    }
}
