//! One element of an alignment in plan, between two given ends.

use super::clothoid::{Clothoid, MOST_TURN};
use glam::DVec2;
use std::f64::consts::TAU;

/// An element in plan. Begins and ends exactly at the points given.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::read) enum Element {
    /// A straight.
    Straight {
        /// Where it begins.
        from: DVec2,
        /// Where it ends.
        to: DVec2,
    },
    /// A circular arc. Where the ends lie at different distances from the centre, the radius goes evenly from one to the other.
    Arc {
        /// The centre.
        centre: DVec2,
        /// Where it begins.
        from: DVec2,
        /// Where it ends.
        to: DVec2,
        /// Angle it covers, in radians; positive to the left.
        sweep: f64,
    },
    /// A clothoid: its shape, turned and scaled so that it ends where it should.
    Clothoid(Transition),
}

/// A clothoid in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::read) struct Transition {
    shape: Clothoid,
    from: DVec2,
    to: DVec2,
    /// Turns and scales the shape.
    place: DVec2,
}

/// How an element differs from what is declared of it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::read) struct Misfit {
    /// By the coordinates of its ends (and of its centre).
    pub(in crate::read) given: f64,
    /// By its other figures.
    pub(in crate::read) computed: f64,
}

impl Misfit {
    /// The difference.
    pub(in crate::read) fn size(self) -> f64 {
        (self.given - self.computed).abs()
    }
}

impl Element {
    /// An arc about a centre, to the left or to the right; `long` tells whether it is more than half a circle, which is asked
    /// only where its ends fall together. The misfit is between the distances of both ends from the centre.
    pub(in crate::read) fn arc(centre: DVec2, from: DVec2, to: DVec2, left: bool, long: bool) -> (Self, Misfit) {
        let (a, b) = (from - centre, to - centre);
        let turn = if left { 1.0 } else { -1.0 };
        let mut sweep = turn * a.perp_dot(b).atan2(a.dot(b));
        // An angle this small lies on a chord below the digits of coordinates.
        const NONE: f64 = 1e-9;
        if sweep.abs() < NONE {
            sweep = if long { TAU + sweep } else { sweep.max(0.0) };
        } else if sweep < 0.0 {
            sweep += TAU;
        }
        let misfit = Misfit { given: b.length(), computed: a.length() };
        (Self::Arc { centre, from, to, sweep: turn * sweep }, misfit)
    }

    /// An arc of a radius; `long` tells whether it is more than half a circle. `None` if the ends are further apart than its
    /// diameter, or fall together.
    pub(in crate::read) fn arc_of_radius(radius: f64, from: DVec2, to: DVec2, left: bool, long: bool) -> Option<Self> {
        let chord = to - from;
        let half = 0.5 * chord.length();
        // Ends a diameter apart may be so but for the last digits.
        const SLACK: f64 = 1e-6;
        if half.is_nan() || half <= 0.0 || half > radius * (1.0 + SLACK) {
            return None;
        }
        let rise = (radius * radius - half * half).max(0.0).sqrt();
        let side = if left == long { -1.0 } else { 1.0 };
        let centre = 0.5 * (from + to) + side * rise / (2.0 * half) * chord.perp();
        Some(Self::arc(centre, from, to, left, long).0)
    }

    /// A clothoid between two points, by its length and the curvatures at both ends (positive to the left). The misfit is
    /// between the distance of both points and that of the ends of such a clothoid. `None` if it turns too far, or if either
    /// distance is nought.
    pub(in crate::read) fn clothoid(from: DVec2, to: DVec2, length: f64, curvature: [f64; 2]) -> Option<(Self, Misfit)> {
        let shape = Clothoid { from: curvature[0], to: curvature[1], length };
        if !(length > 0.0 && shape.turn() <= MOST_TURN) {
            return None;
        }
        let (end, chord) = (shape.at(length), to - from);
        let misfit = Misfit { given: chord.length(), computed: end.length() };
        let place = chord.rotate(DVec2::new(end.x, -end.y)) / end.length_squared();
        let sound = place.is_finite() && misfit.given > 0.0;
        sound.then_some((Self::Clothoid(Transition { shape, from, to, place }), misfit))
    }

    /// Where it begins.
    pub(in crate::read) fn from(&self) -> DVec2 {
        match self {
            Self::Straight { from, .. } | Self::Arc { from, .. } => *from,
            Self::Clothoid(transition) => transition.from,
        }
    }

    /// Where it ends.
    pub(in crate::read) fn to(&self) -> DVec2 {
        match self {
            Self::Straight { to, .. } | Self::Arc { to, .. } => *to,
            Self::Clothoid(transition) => transition.to,
        }
    }

    /// Its length.
    pub(in crate::read) fn length(&self) -> f64 {
        match self {
            Self::Straight { from, to } => from.distance(*to),
            Self::Arc { sweep, .. } => sweep.abs() * self.radius(),
            Self::Clothoid(transition) => transition.shape.length * transition.place.length(),
        }
    }

    /// Mean radius of an arc.
    fn radius(&self) -> f64 {
        match self {
            Self::Arc { centre, from, to, .. } => 0.5 * (centre.distance(*from) + centre.distance(*to)),
            _ => f64::INFINITY,
        }
    }

    /// The point at a share of the length, 0 to 1.
    pub(in crate::read) fn at(&self, share: f64) -> DVec2 {
        if share <= 0.0 {
            return self.from();
        }
        if share >= 1.0 {
            return self.to();
        }
        match self {
            Self::Straight { from, to } => from.lerp(*to, share),
            Self::Arc { centre, from, to, sweep } => {
                let (a, b) = (*from - *centre, *to - *centre);
                let radius = a.length() + share * (b.length() - a.length());
                *centre + radius * DVec2::from_angle(sweep * share).rotate(a.normalize_or_zero())
            }
            Self::Clothoid(transition) => {
                transition.from + transition.place.rotate(transition.shape.at(share * transition.shape.length))
            }
        }
    }

    /// Direction of travel at a share of the length, a unit vector (nought for an element without length).
    pub(in crate::read) fn direction(&self, share: f64) -> DVec2 {
        match self {
            Self::Straight { from, to } => (*to - *from).normalize_or_zero(),
            Self::Arc { centre, from, sweep, .. } => {
                let out = DVec2::from_angle(sweep * share).rotate((*from - *centre).normalize_or_zero());
                if *sweep < 0.0 { -out.perp() } else { out.perp() }
            }
            Self::Clothoid(transition) => {
                let shape = &transition.shape;
                DVec2::from_angle(shape.direction(share * shape.length)).rotate(transition.place).normalize_or_zero()
            }
        }
    }

    /// Greatest curvature between two shares of the length.
    pub(in crate::read) fn curvature(&self, from: f64, to: f64) -> f64 {
        match self {
            Self::Straight { .. } => 0.0,
            Self::Arc { .. } => 1.0 / self.radius(),
            Self::Clothoid(Transition { shape, place, .. }) => {
                let at = |share: f64| (shape.from + share * (shape.to - shape.from)).abs();
                at(from).max(at(to)) / place.length()
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    const E: DVec2 = DVec2::new(500_000.0, 5_400_000.0);

    #[test]
    fn points_of_circles() {
        for (left, sweep) in [(true, 0.5 * PI), (false, -1.5 * PI)] {
            let (arc, misfit) = Element::arc(E, E + DVec2::X * 50.0, E + DVec2::Y * 50.0, left, false);
            assert!((arc.length() - 50.0 * sweep.abs()).abs() < 1e-9 && misfit.size() < 1e-9);
            for i in 0..=10 {
                let share = 0.1 * f64::from(i);
                let expected = E + 50.0 * DVec2::from_angle(sweep * share);
                assert!(arc.at(share).distance(expected) < 1e-8, "{left} {share}");
                let tangent = DVec2::from_angle(sweep * share).perp() * sweep.signum();
                assert!(arc.direction(share).distance(tangent) < 1e-10);
            }
            assert!((arc.curvature(0.0, 1.0) - 0.02).abs() < 1e-12);
        }
    }

    #[test]
    fn whole_circles_and_nothing() {
        let at = E + DVec2::X * 10.0;
        assert!((Element::arc(E, at, at, true, true).0.length() - 20.0 * PI).abs() < 1e-9);
        assert_eq!(Element::arc(E, at, at, true, false).0.length(), 0.0);
        // A little backwards is not all the way round.
        let before = E + 10.0 * DVec2::from_angle(-1e-10);
        assert!(Element::arc(E, at, before, true, false).0.length() < 1e-6);
    }

    #[test]
    fn arcs_by_their_radius() {
        let to = E + DVec2::X * 50.0 + DVec2::Y * 50.0;
        for (left, long) in [(true, false), (true, true), (false, false), (false, true)] {
            let from = E;
            let arc = Element::arc_of_radius(50.0, from, to, left, long).unwrap();
            let quarter = 0.5 * PI * 50.0;
            assert!((arc.length() - if long { 3.0 * quarter } else { quarter }).abs() < 1e-8, "{left} {long}");
            // To the left one begins along the first axis, on the short way.
            let expected = match (left, long) {
                (true, false) => DVec2::X,
                (false, false) => DVec2::Y,
                (true, true) => -DVec2::Y,
                (false, true) => -DVec2::X,
            };
            assert!(arc.direction(0.0).distance(expected) < 1e-8, "{left} {long}: {}", arc.direction(0.0));
        }
        assert!(Element::arc_of_radius(50.0, E, E + DVec2::X * 100.0, true, false).is_some());
        assert!(Element::arc_of_radius(50.0, E, E + DVec2::X * 101.0, true, false).is_none());
        assert!(Element::arc_of_radius(50.0, E, E, true, false).is_none());
    }

    /// The end of a clothoid from a straight into a circle of radius `r`, by the series of the handbooks with τ = L / (2 r):
    /// x = L (1 − τ²/10 + τ⁴/216 − τ⁶/9360 + …), y = L (τ/3 − τ³/42 + τ⁵/1320 − τ⁷/75600 + …).
    #[test]
    fn clothoids_of_both_turns_and_ways() {
        let (r, l): (f64, f64) = (200.0, 60.0);
        let t = l / (2.0 * r);
        let x = l * (1.0 - t.powi(2) / 10.0 + t.powi(4) / 216.0 - t.powi(6) / 9360.0);
        let y = l * (t / 3.0 - t.powi(3) / 42.0 + t.powi(5) / 1320.0 - t.powi(7) / 75_600.0);
        for turn in [1.0, -1.0] {
            let start = DVec2::from_angle(0.7);
            let end = E + start.rotate(DVec2::new(x, turn * y));
            let (entry, misfit) = Element::clothoid(E, end, l, [0.0, turn / r]).unwrap();
            assert!(misfit.size() < 1e-8, "{misfit:?}");
            assert!(entry.direction(0.0).distance(start) < 1e-9);
            assert!(entry.direction(1.0).distance(DVec2::from_angle(0.7 + turn * l / (2.0 * r))) < 1e-9);
            // The same curve, run the other way: it turns to the other side.
            let (exit, _) = Element::clothoid(end, E, l, [-turn / r, 0.0]).unwrap();
            for i in 0..=8 {
                let share = 0.125 * f64::from(i);
                assert!(entry.at(share).distance(exit.at(1.0 - share)) < 1e-8);
            }
            assert!((entry.curvature(0.0, 0.5) - 0.5 / r).abs() < 1e-10);
        }
    }

    #[test]
    fn between_two_radii() {
        // A part of a longer clothoid keeps its shape.
        let whole = Clothoid { from: 0.0, to: 0.02, length: 100.0 };
        let (a, b) = (whole.at(40.0), whole.at(100.0));
        let (part, misfit) = Element::clothoid(a, b, 60.0, [0.008, 0.02]).unwrap();
        assert!(misfit.size() < 1e-12);
        for i in 0..=6 {
            assert!(part.at(f64::from(i) / 6.0).distance(whole.at(40.0 + 10.0 * f64::from(i))) < 1e-11);
        }
    }

    #[test]
    fn ends_are_met_where_figures_do_not_fit() {
        let end = E + DVec2::new(59.0, 4.0);
        let (element, misfit) = Element::clothoid(E, end, 60.0, [0.0, 0.005]).unwrap();
        assert!(misfit.size() > 0.5);
        assert!(element.at(1.0 - 1e-12).distance(end) < 1e-8);
        assert!(Element::clothoid(E, E, 60.0, [0.0, 0.005]).is_none());
        assert!(Element::clothoid(E, end, 60.0, [0.0, 5.0]).is_none());
        assert!(Element::clothoid(E, end, f64::INFINITY, [0.0, 0.0]).is_none());
        assert!(Element::clothoid(E, end, 0.0, [0.0, 0.0]).is_none());
    }
}
