//! The one gate for signs in plan: exact, and an answer in words.

use glam::DVec2;
use robust::{Coord, orient2d};

/// Which way a path of three points turns, seen from above with x to the right and y up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Turn {
    /// Counter-clockwise.
    Left,
    /// Clockwise.
    Right,
    /// On one straight line (also when points coincide).
    Straight,
}

/// The turn at `b` of the path `a`, `b`, `c`; equally the side of the line from `a` to `b` on which `c` lies.
///
/// Exact for all finite coordinates whose products neither overflow nor underflow. Reference: J. R. Shewchuk, "Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates", Discrete Comput. Geom. 18 (1997).
#[inline]
pub fn turn(a: DVec2, b: DVec2, c: DVec2) -> Turn {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    let sign = orient2d(coord(a), coord(b), coord(c));
    if sign > 0.0 {
        Turn::Left
    } else if sign < 0.0 {
        Turn::Right
    } else {
        Turn::Straight
    }
}

/// Twice the area of a triangle, positive for counter-clockwise corners. Sign exact, value right to a few units in the last
/// place.
#[inline]
pub fn doubled_area(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Where the line through `r` and `s` crosses the segment from `p` to `q`, which has its ends on either side of it: 0 at `p`,
/// 1 at `q`. Right to a few units in the last place, however small the angle.
pub fn crossing([p, q]: [DVec2; 2], [r, s]: [DVec2; 2]) -> f64 {
    let coord = |p: DVec2| Coord { x: p.x, y: p.y };
    let side = |c: DVec2| orient2d(coord(r), coord(s), coord(c));
    let (from, to) = (side(p), side(q));
    (from / (from - to)).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sees_one_unit_in_the_last_place() {
        let (a, b) = (DVec2::new(12.0, 12.0), DVec2::new(24.0, 24.0));
        let c = DVec2::new(0.5, 0.5);
        assert_eq!(turn(a, b, c), Turn::Straight);
        assert_eq!(turn(a, b, DVec2::new(0.5, 0.5f64.next_up())), Turn::Left);
        assert_eq!(turn(a, b, DVec2::new(0.5f64.next_up(), 0.5)), Turn::Right);
        assert_eq!(turn(a, a, c), Turn::Straight);
        // The plain determinant is nought here, in either order of its terms.
        assert_eq!((b - a).perp_dot(DVec2::new(0.5, 0.5f64.next_up()) - a), 0.0);
    }

    /// Two lines that meet at a quarter under an angle of one unit in the last place.
    #[test]
    fn crosses_under_the_smallest_angle() {
        let (p, q) = (DVec2::new(0.0, 1.0_f64.next_up()), DVec2::new(4.0, 1.0 - 3.0 * f64::EPSILON));
        let t = crossing([p, q], [DVec2::new(-8.0, 1.0), DVec2::new(8.0, 1.0)]);
        assert_eq!(t, 0.25);
    }
}
