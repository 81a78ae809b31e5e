//! A point and a segment in plan.

use glam::DVec2;

/// Part of the way from `a` to `b`, 0 to 1, at which the segment comes nearest to `p`; 0 for a segment without length.
#[inline]
pub fn foot(p: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let part = ((p - a).dot(b - a) / (b - a).length_squared()).clamp(0.0, 1.0);
    if part.is_nan() { 0.0 } else { part }
}

/// Distance of `p` from a segment.
#[inline]
pub fn distance(p: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    p.distance(a.lerp(b, foot(p, [a, b])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_nearest_point_is_between_the_ends() {
        let (a, b) = (DVec2::new(1.0, 1.0), DVec2::new(5.0, 1.0));
        for (x, y, part, away) in [(2.0, 4.0, 0.25, 3.0), (-2.0, 5.0, 0.0, 5.0), (8.0, -3.0, 1.0, 5.0), (3.0, 1.0, 0.5, 0.0)] {
            let p = DVec2::new(x, y);
            assert_eq!((foot(p, [a, b]), distance(p, [a, b])), (part, away), "{p}");
        }
        assert_eq!((foot(b, [a, a]), distance(b, [a, a])), (0.0, 4.0));
    }
}
