//! Open lines: a wedge, a sloping segment, crest and sag, two lines side by side.

use crate::common::build::{design, line, on_both_sheets, open};
use crate::common::measure::{area, close, curves, gradient, height, not_above, triangles};
use glam::DVec2;
use slopegen::model::{CurveKind, Design, Extent, Side};
use slopegen::selftest::formulas::{segment_area, segment_volume};
use std::f64::consts::PI;

const EXACT: f64 = 1e-9;

/// A level segment sloped on one side only is a wedge: a triangle `h` high and `n·h` wide along `l`.
#[test]
fn wedge() {
    let (l, h, k) = (37.0, 5.0, 0.8);
    let n = 1.0 / k;
    for side in [Side::Left, Side::Right] {
        let wanted = Design { side_of_lines: side, ..design(k, Extent::Elevation(1.0)) };
        // Askew, so that nothing is exact by accident.
        let direction = DVec2::from_angle(0.7);
        let [a, b] = [DVec2::new(3.0, 4.0), DVec2::new(3.0, 4.0) + l * direction].map(|p| [p.x, p.y, 1.0 + h]);
        on_both_sheets(&line(&[open(&[a, b])]), &wanted, |surface| {
            close(surface.volumes.fill, l * n * h * h / 2.0, EXACT, "volume");
            assert_eq!(surface.volumes.error_bound, 0.0);
            close(surface.areas.plan, l * n * h, EXACT, "plan area");
            close(surface.areas.fill_slope, l * n * h * 1.0_f64.hypot(k), EXACT, "slope");
            let out = if side == Side::Left { direction.perp() } else { -direction.perp() };
            for p in &surface.tin.vertices {
                let t = (p.truncate() - DVec2::new(a[0], a[1])).dot(out);
                assert!((p.z - (a[2] - k * t)).abs() < 1e-9, "{p} is not on the wedge");
            }
        });
    }
}

/// A sloping segment: volume and plan area; the strips are planes through the line.
#[test]
fn sloping_segment() {
    let (l, z1, z2) = (24.0, 14.0, 5.0);
    for k in [0.4, 0.5, 1.0, 3.0] {
        let (n, gamma): (f64, f64) = (1.0 / k, (z1 - z2) / l);
        let phi = (gamma / k).asin();
        let [a, b] = [DVec2::new(-2.0, 6.0), DVec2::new(-2.0, 6.0) + l * DVec2::from_angle(2.1)];
        let given = line(&[open(&[[a.x, a.y, z1], [b.x, b.y, z2]])]);
        on_both_sheets(&given, &design(k, Extent::Elevation(0.0)), |surface| {
            let bound = surface.volumes.error_bound;
            not_above(surface.volumes.fill, segment_volume(l, [z1, z2], k), bound, "volume");
            not_above(surface.areas.plan, segment_area(l, [z1, z2], k), n * bound, "plan area");
            // The strips are the planes through the line of slope k: gradient γu ∓ √(k² − γ²)·n, u the way up the line.
            let up = (a - b) / l;
            let side = ((k - gamma) * (k + gamma)).sqrt();
            let mut strips = [0.0; 2];
            for (corners, _) in triangles(surface) {
                let found = gradient(corners);
                for (total, out) in strips.iter_mut().zip([up.perp(), -up.perp()]) {
                    if found.distance(gamma * up - side * out) < 1e-9 {
                        *total += area(corners);
                    }
                }
            }
            // Each strip is bounded by rulings n·z long, the end apart by l·cos φ: a trapezium.
            for total in strips {
                close(total, n * (z1 + z2) / 2.0 * l * phi.cos(), EXACT, "strip");
            }
        });
    }
}

/// Gradients `g1` before and `g2` after a vertex on a straight line. Strips lean by `sin φ = γ/k` down-grade: at a crest they
/// part and a sector of `φ1 + φ2` opens on either side.
#[test]
fn crest() {
    let (a, b, g1, g2, top, k, reach) = (30.0, 40.0, 0.3, 0.2, 20.0, 0.5, 6.0);
    let (phi1, phi2) = (f64::asin(g1 / k), f64::asin(g2 / k));
    let given = line(&[open(&[[-a, 0.0, top - a * g1], [0.0, 0.0, top], [b, 0.0, top - b * g2]])]);
    let wanted = design(k, Extent::Distance(reach));
    on_both_sheets(&given, &wanted, |surface| {
        // Strips l·reach·cos φ on two sides; the sectors of all three vertices make one full disc.
        let plan = 2.0 * reach * (a * phi1.cos() + b * phi2.cos()) + PI * reach * reach;
        not_above(surface.areas.plan, plan, surface.volumes.error_bound / k, "plan area");
        for i in 0..=8 {
            let lean = -phi1 + (phi1 + phi2) * f64::from(i) / 8.0;
            for sign in [1.0, -1.0] {
                let r = 0.8 * reach;
                let found = height(surface, r * lean.sin(), sign * r * lean.cos()).expect("within reach");
                not_above(found, top - k * r, wanted.tolerance / 3.0, "height in the sector");
            }
        }
        // Beyond the sector's rulings lie the planes of the strips.
        for (x, gamma) in [(-4.0, g1), (5.0, -g2)] {
            let t = 2.0;
            let expected = top + gamma * x - t * ((k - gamma) * (k + gamma)).sqrt();
            close(height(surface, x, t).expect("within reach"), expected, EXACT, "strip");
        }
        assert_eq!(curves(surface, CurveKind::Valley).count(), 0);
    });
}

/// At a sag the strips lean into each other: a crease starts at the vertex, where both planes are equally high,
/// `−g1·s − t·√(k² − g1²) = g2·s − t·√(k² − g2²)`.
#[test]
fn sag() {
    let (a, b, low, k) = (50.0, 50.0, 9.0, 0.5_f64);
    for (g1, g2) in [(0.2, 0.2), (0.3, 0.1), (0.0, 0.25)] {
        let given = line(&[open(&[[-a, 0.0, low + a * g1], [0.0, 0.0, low], [b, 0.0, low + b * g2]])]);
        let (side1, side2) = ((k * k - g1 * g1).sqrt(), (k * k - g2 * g2).sqrt());
        let aside = (side2 - side1) / (g1 + g2);
        on_both_sheets(&given, &design(k, Extent::Elevation(0.0)), |surface| {
            let mut starts = 0;
            for curve in curves(surface, CurveKind::Valley) {
                for p in &curve.points {
                    let t = p.y.abs();
                    assert!((p.x - aside * t).abs() < 1e-9, "{p} off the crease");
                    assert!((p.z - (low + g2 * p.x - t * side2)).abs() < 1e-9, "{p} off the planes");
                    starts += usize::from(t == 0.0);
                }
            }
            // One crease to either side, or one through the vertex, down to the end; the planes are steep enough to meet it.
            assert!((1..=2).contains(&starts), "{starts} creases at the vertex");
            let depth = low / (side2 - g2 * aside);
            let longest = curves(surface, CurveKind::Valley).flat_map(|c| &c.points).map(|p| p.y.abs()).fold(0.0, f64::max);
            close(longest, depth, EXACT, "end of the crease");
        });
    }
}

/// Two level lines `d` apart at different heights meet where `z1 − k·t = z2 − k(d − t)`; beyond their ends, where the distances
/// to the two end points differ by `(z2 − z1)/k` (a branch of a hyperbola).
#[test]
fn parallel_lines() {
    let (l, d, k) = (40.0, 12.0, 0.75);
    for (z1, z2) in [(10.0, 10.0), (10.0, 13.0), (10.0, 4.0)] {
        let given = line(&[open(&[[0.0, 0.0, z1], [l, 0.0, z1]]), open(&[[l, d, z2], [0.0, d, z2]])]);
        let t = (z1 - z2 + k * d) / (2.0 * k);
        on_both_sheets(&given, &design(k, Extent::Elevation(-4.0)), |surface| {
            let points: Vec<_> = curves(surface, CurveKind::Valley).flat_map(|c| &c.points).collect();
            assert!(points.iter().any(|p| p.x <= 0.0) && points.iter().any(|p| p.x >= l));
            assert!(points.iter().any(|p| p.x < -4.0) && points.iter().any(|p| p.x > l + 4.0), "creases of the caps");
            for p in points {
                let foot = p.x.clamp(0.0, l);
                let (near, far) = ((p.x - foot).hypot(p.y), (p.x - foot).hypot(p.y - d));
                assert!((near - far - (z1 - z2) / k).abs() < 1e-9, "{p}: {near} and {far}");
                assert!((p.z - (z1 - k * near)).abs() < 1e-9, "{p}");
                if p.x >= 0.0 && p.x <= l {
                    assert!((p.y - t).abs() < 1e-9, "{p} for y = {t}");
                }
            }
            assert!(surface.buried.is_empty());
        });
    }
}
