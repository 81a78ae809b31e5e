//! Points and segments in plan.

use super::orientation::{Turn, turn};
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

/// How two segments meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meeting {
    /// No common point.
    Apart,
    /// They cross in the inside of both, at about this point.
    Cross(DVec2),
    /// Ends of one lie on the other: those of the second segment, then those of the first. At least one is there; an end that
    /// is one of both segments is there twice.
    Touch([Option<DVec2>; 4]),
}

impl Meeting {
    /// The common points: one where the segments cross, the ends that lie on the other where they touch.
    pub fn points(self) -> impl Iterator<Item = DVec2> {
        let points = match self {
            Self::Apart => [None; 4],
            Self::Cross(at) => [Some(at), None, None, None],
            Self::Touch(points) => points,
        };
        points.into_iter().flatten()
    }
}

/// How the closed segments `ab` and `cd` meet. Exact, but for the place of a crossing.
pub fn meeting([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> Meeting {
    let sides = [turn(a, b, c), turn(a, b, d), turn(c, d, a), turn(c, d, b)];
    if !sides.contains(&Turn::Straight) {
        if sides[0] == sides[1] || sides[2] == sides[3] {
            return Meeting::Apart;
        }
        let (u, v) = (b - a, d - c);
        return Meeting::Cross(a + u * ((c - a).perp_dot(v) / u.perp_dot(v)).clamp(0.0, 1.0));
    }
    let on = |side: Turn, p: DVec2, ends: [DVec2; 2]| (side == Turn::Straight && between(p, ends)).then_some(p);
    let points = [on(sides[0], c, [a, b]), on(sides[1], d, [a, b]), on(sides[2], a, [c, d]), on(sides[3], b, [c, d])];
    if points.iter().all(Option::is_none) { Meeting::Apart } else { Meeting::Touch(points) }
}

/// Whether `p`, collinear with `q` and `r`, lies between them or on one of them.
pub fn between(p: DVec2, [q, r]: [DVec2; 2]) -> bool {
    p.cmpge(q.min(r)).all() && p.cmple(q.max(r)).all()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn segments_cross_touch_or_stay_apart() {
        let p = |x: f64, y: f64| DVec2::new(x, y);
        let (a, b) = (p(0.0, 0.0), p(4.0, 4.0));
        let with = |c: DVec2, d: DVec2| meeting([a, b], [c, d]);
        assert_eq!(with(p(0.0, 2.0), p(2.0, 0.0)), Meeting::Cross(p(1.0, 1.0)));
        assert_eq!(with(p(3.0, 0.0), p(9.0, 1.0)), Meeting::Apart);
        assert_eq!(with(p(5.0, 5.0), p(6.0, 6.0)), Meeting::Apart);
        assert_eq!(with(p(0.0, 2.0), p(0.5, 1.0)), Meeting::Apart);
        assert_eq!(with(p(2.0, 2.0), p(6.0, 1.0)), Meeting::Touch([Some(p(2.0, 2.0)), None, None, None]));
        assert_eq!(with(p(0.0, 4.0), p(8.0, 4.0)), Meeting::Touch([None, None, None, Some(b)]));
        assert_eq!(with(b, p(6.0, 1.0)), Meeting::Touch([Some(b), None, None, Some(b)]));
        assert_eq!(with(p(6.0, 6.0), p(1.0, 1.0)), Meeting::Touch([None, Some(p(1.0, 1.0)), None, Some(b)]));
        assert_eq!(with(a, b).points().count(), 4);
        // One unit in the last place beside the segment.
        assert_eq!(with(p(2.0, 2.0_f64.next_up()), p(0.0, 5.0)), Meeting::Apart);
    }

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
