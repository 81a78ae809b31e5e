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
}
