//! From curves to polylines.

use super::{Element, Profile};
use glam::DVec2;

/// Most points of one file that curves may be resolved into.
pub(in crate::read) const MOST_POINTS: usize = 1_000_000;

/// Stations closer together than this, in the length unit, are one: where an element and a stretch of the profile end alike.
const SAME_STATION: f64 = 1e-6;

/// An element and its heights at both ends, where they are known.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::read) struct Piece {
    pub(in crate::read) element: Element,
    pub(in crate::read) heights: [Option<f64>; 2],
}

/// Where heights come from.
#[derive(Clone, Copy, Debug)]
pub(in crate::read) enum Heights<'a> {
    /// From both ends of each element, evenly between.
    Own,
    /// From a profile; only what lies between these stations is wanted, counted from the beginning of the first element.
    Profile {
        /// The profile, in stations of its own.
        profile: &'a Profile,
        /// Station of the beginning of the first element.
        start: f64,
        /// First station wanted.
        from: f64,
        /// Last station wanted.
        to: f64,
    },
}

/// The curves would be more than [`MOST_POINTS`]: how many.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::read) struct TooMany(pub(in crate::read) f64);

/// The polyline along elements that follow each other: their ends, the breaks of the profile, and as many points between as keep
/// the curve within `chord` of it in space. `left` is how many points there may be, and is lowered.
///
/// The bound holds for the distance in space: of a curve with second derivative r'' by its plan length, a chord over the length h
/// is off by at most h² max|r''| / 8, and r'' is made up of the curvature in plan and the second derivative of the height.
///
/// # Errors
/// [`TooMany`] points.
pub(in crate::read) fn sample(
    pieces: &[Piece],
    heights: Heights<'_>,
    chord: f64,
    left: &mut usize,
) -> Result<Vec<(DVec2, Option<f64>)>, TooMany> {
    let mut points: Vec<(DVec2, Option<f64>)> = Vec::new();
    let mut begin = 0.0;
    for piece in pieces {
        let length = piece.element.length();
        let end = begin + length;
        // What is wanted of it, and where it is divided: distances from its beginning.
        let stops = match heights {
            Heights::Own => vec![0.0, length],
            Heights::Profile { profile, start, from, to } => {
                let origin = start + begin;
                let [first, last] = [from - origin, to - origin].map(|s| s.clamp(0.0, length));
                let breaks = profile.breaks(origin + first + SAME_STATION, origin + last - SAME_STATION);
                std::iter::once(first).chain(breaks.map(|station| station - origin)).chain([last]).collect()
            }
        };
        if stops.first() == stops.last() {
            begin = end;
            continue;
        }
        let height = |s: f64| match heights {
            Heights::Own => match piece.heights {
                [Some(a), Some(b)] => Some(if s == length { b } else { a + (b - a) * (s / length) }),
                _ => None,
            },
            Heights::Profile { profile, start, .. } => Some(profile.height(start + begin + s)),
        };
        let share = |s: f64| s / length;
        for stop in stops.windows(2) {
            let &[s0, s1] = stop else { continue };
            let bend = match heights {
                Heights::Own => 0.0,
                Heights::Profile { profile, start, .. } => profile.bend(start + begin + s0, start + begin + s1),
            };
            let curvature = piece.element.curvature(share(s0), share(s1)).hypot(bend);
            let parts = ((s1 - s0) * (curvature / (8.0 * chord)).sqrt()).ceil().max(1.0);
            // Straights cost no more than what is in the file.
            if parts > 1.0 {
                if parts.is_nan() || parts > *left as f64 {
                    return Err(TooMany(parts));
                }
                *left -= parts as usize;
            }
            if points.is_empty() {
                points.push((piece.element.at(share(s0)), height(s0)));
            }
            for i in 1..=parts as usize {
                // The last one is the stop itself, to the bit.
                let s = if i as f64 == parts { s1 } else { s0 + (s1 - s0) * (i as f64 / parts) };
                points.push((piece.element.at(share(s)), height(s)));
            }
        }
        begin = end;
    }
    Ok(points)
}

#[cfg(test)]
mod tests {
    use super::super::{Curve, Pvi};
    use super::*;

    const E: DVec2 = DVec2::new(500_000.0, 5_400_000.0);
    const CHORD: f64 = 0.002;

    /// Straight, clothoid to a radius of 80, arc, clothoid back: tangential all along.
    fn plan() -> Vec<Piece> {
        let (r, l) = (80.0, 45.0);
        let (mut at, mut direction) = (E, DVec2::from_angle(0.3));
        let mut pieces = vec![Element::Straight { from: at, to: at + 30.0 * direction }];
        at += 30.0 * direction;
        for (length, curvature) in [(l, [0.0, -1.0 / r]), (70.0, [-1.0 / r, -1.0 / r]), (l, [-1.0 / r, 0.0])] {
            // The shape is found by one of unit chord, which only its place depends on.
            let (shape, _) = Element::clothoid(DVec2::ZERO, DVec2::X, length, curvature).unwrap();
            let scale = shape.length() / length;
            let turn = direction.rotate(DVec2::new(shape.direction(0.0).x, -shape.direction(0.0).y));
            let to = at + turn / scale;
            pieces.push(Element::clothoid(at, to, length, curvature).unwrap().0);
            direction = turn.rotate(shape.direction(1.0));
            at = to;
        }
        pieces.into_iter().map(|element| Piece { element, heights: [None; 2] }).collect()
    }

    fn profile() -> Profile {
        let points = [
            (1000.0, 50.0, Curve::Break),
            (1040.0, 54.0, Curve::Parabola(25.0, 25.0)),
            (1100.0, 51.0, Curve::Circle(300.0)),
            (1190.0, 55.0, Curve::Break),
        ];
        Profile::new(&points.map(|(station, height, curve)| Pvi { station, height, curve })).unwrap()
    }

    #[test]
    fn elements_follow_each_other_without_kinks() {
        let pieces = plan();
        for pair in pieces.windows(2) {
            assert!(pair[0].element.to().distance(pair[1].element.from()) < 1e-8);
            assert!(pair[0].element.direction(1.0).distance(pair[1].element.direction(0.0)) < 1e-9);
        }
    }

    /// Distance of points of the curve from the polyline, by brute force.
    #[test]
    fn chords_are_within_their_bound_in_space() {
        let (pieces, profile) = (plan(), profile());
        let total: f64 = pieces.iter().map(|piece| piece.element.length()).sum();
        assert!((total - 190.0).abs() < 1e-9);
        let heights = Heights::Profile { profile: &profile, start: 1000.0, from: 1000.0, to: 1190.0 };
        let mut left = MOST_POINTS;
        let points = sample(&pieces, heights, CHORD, &mut left).unwrap();
        let line: Vec<glam::DVec3> = points.iter().map(|(p, z)| (*p - E).extend(z.unwrap())).collect();
        let mut worst: f64 = 0.0;
        let mut begin = 0.0;
        for piece in &pieces {
            for i in 0..=400 {
                let share = f64::from(i) / 400.0;
                let z = profile.height(1000.0 + begin + share * piece.element.length());
                let p = (piece.element.at(share) - E).extend(z);
                let off = line.windows(2).map(|w| {
                    let d = w[1] - w[0];
                    let t = ((p - w[0]).dot(d) / d.length_squared()).clamp(0.0, 1.0);
                    (p - w[0] - t * d).length()
                });
                worst = worst.max(off.fold(f64::INFINITY, f64::min));
            }
            begin += piece.element.length();
        }
        assert!(worst < CHORD && worst > 0.5 * CHORD, "{worst} with {} points", points.len());
        assert!(points.len() < 155, "{}", points.len());
        // Ends of elements and of vertical curves are points.
        for station in [30.0, 75.0, 145.0, 15.0, 65.0] {
            let z = profile.height(1000.0 + station);
            assert!(line.iter().any(|p| (p.z - z).abs() < 1e-9), "{station}");
        }
    }

    #[test]
    fn a_part_of_an_alignment() {
        let (pieces, profile) = (plan(), profile());
        let heights = Heights::Profile { profile: &profile, start: 990.0, from: 1000.0, to: 1100.0 };
        let points = sample(&pieces, heights, CHORD, &mut { MOST_POINTS }).unwrap();
        let length: f64 = points.windows(2).map(|w| w[0].0.distance(w[1].0)).sum();
        assert!((length - 100.0).abs() < 0.01, "{length}");
        assert!(points[0].0.distance(E + 10.0 * DVec2::from_angle(0.3)) < 1e-8 && points[0].1 == Some(50.0));
        let none = Heights::Profile { profile: &profile, start: 5000.0, from: 5000.0, to: 1190.0 };
        assert_eq!(sample(&pieces, none, CHORD, &mut { MOST_POINTS }), Ok(vec![]));
    }

    #[test]
    fn heights_of_their_own() {
        let (arc, _) = Element::arc(E, E + DVec2::X * 10.0, E - DVec2::X * 10.0, true, false);
        let pieces = [
            Piece { element: arc, heights: [Some(1.0), Some(3.0)] },
            Piece { element: Element::Straight { from: arc.to(), to: E }, heights: [Some(3.0), None] },
        ];
        let points = sample(&pieces, Heights::Own, 0.01, &mut { MOST_POINTS }).unwrap();
        // h = √(8 r c) = 0.894 on a length of 31.4.
        assert_eq!(points.len(), 38);
        assert_eq!((points[18].1, points[36].1, points[37]), (Some(2.0), Some(3.0), (E, None)));
    }

    #[test]
    fn too_many_points_are_refused() {
        let (arc, _) = Element::arc(E, E + DVec2::X * 1e8, E - DVec2::X * 1e8, true, false);
        let pieces = [Piece { element: arc, heights: [None; 2] }];
        assert!(matches!(sample(&pieces, Heights::Own, 1e-9, &mut { MOST_POINTS }), Err(TooMany(n)) if n > 1e6));
    }
}
