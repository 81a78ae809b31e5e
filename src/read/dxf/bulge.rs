//! Arcs in polylines.
//!
//! The bulge of a segment is the tangent of a quarter of the angle its arc goes round, positive counter-clockwise: 1 is half a
//! circle (Autodesk, DXF Reference, LWPOLYLINE).

use glam::DVec2;
use std::f64::consts::FRAC_PI_4;

/// Chords go round no more than this, however much they may lie off: arcs keep their shape.
const MOST_TURN: f64 = FRAC_PI_4;

/// The angle an arc goes round, with the sign of its bulge.
fn turn(bulge: f64) -> f64 {
    4.0 * bulge.atan()
}

/// Into how many chords an arc from `p` to `q` is cut so that they lie within `chord` of it. At least 1; at most `u32::MAX`.
///
/// A chord that goes round β lies off by r(1 − cos(β/2)) = 2r·sin²(β/4).
pub(super) fn chords(p: DVec2, q: DVec2, bulge: f64, chord: f64) -> u32 {
    let width = p.distance(q);
    // The middle of the arc lies this far off the straight.
    if bulge == 0.0 || width == 0.0 || 0.5 * width * bulge.abs() <= chord {
        return 1;
    }
    let radius = 0.25 * width * (bulge.abs() + 1.0 / bulge.abs());
    let most = 4.0 * (chord / (2.0 * radius)).sqrt().min(1.0).asin();
    // A hair off a whole number of chords is rounding.
    let count = (turn(bulge).abs() / most.min(MOST_TURN) * (1.0 - 1e-12)).ceil();
    (count as u32).max(1)
}

/// Point `i` of `count` on the arc: 0 is `p`, `count` is `q`.
///
/// The point at angle φ of an arc of angle θ is seen from `p` in the direction of the chord turned by (φ − θ)/2, at the distance
/// |pq|·sin(φ/2)/sin(θ/2): no centre, which for flat arcs is far away.
pub(super) fn point(p: DVec2, q: DVec2, bulge: f64, i: u32, count: u32) -> DVec2 {
    let all = turn(bulge);
    let part = all * (f64::from(i) / f64::from(count));
    let length = (0.5 * part).sin() / (0.5 * all).sin();
    p + DVec2::from_angle(0.5 * (part - all)).rotate(q - p) * length
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_a_circle() {
        let (p, q) = (DVec2::new(10.0, 5.0), DVec2::new(14.0, 5.0));
        // Counter-clockwise from west to east goes through the south.
        assert!((point(p, q, 1.0, 1, 2) - DVec2::new(12.0, 3.0)).length() < 1e-14);
        assert!((point(p, q, -1.0, 1, 2) - DVec2::new(12.0, 7.0)).length() < 1e-14);
        // A quarter: tan(90°/4); its centre is above the chord by half of it.
        let quarter = (std::f64::consts::PI / 8.0).tan();
        let middle = DVec2::new(12.0, 7.0 - 8_f64.sqrt());
        assert!((point(p, q, quarter, 1, 2) - middle).length() < 1e-14);
    }

    #[test]
    fn chords_keep_their_distance_and_are_few() {
        let (p, q) = (DVec2::new(1_757_392.8, 5_917_442.4), DVec2::new(1_757_543.777, 5_917_349.488));
        for bulge in [0.3, -0.3, 1.0, 3.0, -0.01, 1e-6, 200.0] {
            for chord in [0.1, 0.01 / 3.0, 1e-5] {
                let count = chords(p, q, bulge, chord);
                // The circle from three of its points, by its closed form.
                let radius = 0.25 * (q - p).length() * (bulge.abs() + 1.0 / bulge.abs());
                let centre = 0.5 * (p + q) + (q - p).perp() * (1.0 - bulge * bulge) / (4.0 * bulge);
                let off = |n: u32| radius * (1.0 - (turn(bulge) / (2.0 * f64::from(n))).cos());
                assert!(off(count) <= chord * (1.0 + 1e-9), "{bulge} {chord}");
                assert!(count <= 2 || off(count - 1) > chord || turn(bulge).abs() / f64::from(count - 1) > MOST_TURN);
                for i in 0..=count.min(50) {
                    let at = point(p, q, bulge, i, count);
                    assert!((at.distance(centre) - radius).abs() < 1e-8 + 1e-15 * radius, "{bulge} {chord} {i}");
                }
                assert!((point(p, q, bulge, count, count) - q).length() < 1e-8);
            }
        }
        assert_eq!(chords(p, q, 0.0, 0.01), 1);
        assert_eq!(chords(p, p, 1.0, 0.01), 1);
        assert_eq!(chords(p, q, 1e300, 0.01), u32::MAX);
    }
}
