//! Only the part inside rings.

use super::*;
use slopegen::mesh::inside::inside;
use slopegen::overlay::{OverlayError, to_elevation};

fn ring(points: &[(f64, f64)]) -> Vec<DVec2> {
    points.iter().copied().map(DVec2::from).collect()
}

/// The wedge `h = x − 16` inside a rectangle [4, 40] × [10, 50] with a hole [20, 30] × [20, 30]: cut over x > 16 is
/// `40·24²/2 − 10·(14² − 4²)/2 = 11520 − 900`, fill over x < 16 is `40·12²/2 = 2880`.
#[test]
fn a_polygon_with_a_hole() {
    let design = random(1, 700, DVec2::ZERO, 64.0, |_| 3.0);
    let existing = random(2, 500, DVec2::ZERO, 64.0, |p| 3.0 + p.x - 16.0);
    let outer = ring(&[(4.0, 10.0), (40.0, 10.0), (40.0, 50.0), (4.0, 50.0)]);
    let hole = ring(&[(20.0, 20.0), (30.0, 20.0), (30.0, 30.0), (20.0, 30.0)]);
    for shift in [DVec2::ZERO, UTM] {
        let moved = |r: &Vec<DVec2>| r.iter().map(|p| *p + shift).collect::<Vec<_>>();
        let area = inside(&[moved(&outer), moved(&hole)]).unwrap();
        let (d, e) = if shift == UTM { (far(&design), far(&existing)) } else { (design.clone(), existing.clone()) };
        let found = between(&d, &e, Some(&area)).unwrap();
        near(found.cut, 11_520.0 - 900.0, 1e-12);
        near(found.fill, 2880.0, 1e-12);
        assert_eq!(found.areas.within, Some(1340.0));
        near(found.common_area(), 1340.0, 1e-12);
        assert_eq!((found.areas.design_uncovered, found.areas.existing_uncovered), (0.0, 0.0));
        let plane = to_elevation(&e, 3.0, Some(&area)).unwrap();
        near(plane.cut, found.cut, 1e-12);
        near(plane.fill, found.fill, 1e-12);
    }
}

/// Parts add up to the whole.
#[test]
fn strips_add_up() {
    let a = random(3, 900, DVec2::ZERO, 100.0, |p| hills(p, 0.0));
    let b = random(4, 800, DVec2::ZERO, 100.0, |p| hills(p, 0.7));
    let whole = volume(&a, &b);
    let mut sums = [0.0; 3];
    for i in 0..7 {
        let (x, next) = (f64::from(i) * 16.0, f64::from(i + 1) * 16.0);
        // Slanting strips that reach beyond the meshes.
        let strip = ring(&[(x - 20.0, -1.0), (next - 20.0, -1.0), (next, 101.0), (x, 101.0)]);
        let Ok(found) = between(&a, &b, Some(&inside(&[strip]).unwrap())) else { continue };
        sums[0] += found.cut;
        sums[1] += found.fill;
        sums[2] += found.common_area();
        assert!(found.areas.within.unwrap() >= found.common_area());
    }
    let last =
        between(&a, &b, Some(&inside(&[ring(&[(92.0, -1.0), (150.0, -1.0), (150.0, 101.0), (112.0, 101.0)])]).unwrap())).unwrap();
    near(sums[0] + last.cut, whole.cut, 1e-12);
    near(sums[1] + last.fill, whole.fill, 1e-12);
    near(sums[2] + last.common_area(), 10_000.0, 1e-13);
}

/// Where an area cuts a side twice at nearly the same place, a sliver is left that only rounding made: it measures nothing. (It once
/// measured an eighth of a square unit.) Expected: clipped in exact fractions.
#[test]
fn slivers_of_rounding_measure_nothing() {
    let corners = |points: &[[f64; 3]]| points.iter().map(|p| DVec3::from(*p)).collect::<Vec<_>>();
    let design = terrain(corners(&[[0.0, 0.0, -6.0], [5.0, 4.0, 3.0], [4.0, 5.0, -4.0]]), vec![[0, 1, 2]]);
    let existing = corners(&[[0.0, 0.0, -4.0], [5.0, 4.0, 1.0], [4.0, 5.0, -4.0], [8.0, 0.0, 0.0]]);
    let existing = terrain(existing, vec![[0, 1, 2], [1, 0, 3]]);
    let area = terrain(corners(&[[4.0, 3.0, 0.0], [4.0, 8.0, 0.0], [2.0, 4.0, 0.0]]), vec![[0, 1, 2]]);
    let found = between(&design, &existing, Some(&area)).unwrap();
    near(found.common_area(), 513.0 / 455.0, 1e-13);
    near(found.cut, 16.0 / 245.0, 1e-13);
    near(found.fill, 1424.0 / 4225.0, 1e-13);
}

/// Brought to a level inside a ring of 100, of which 60 lie beside the ground: these are told, as area that has no volume.
#[test]
fn a_level_beside_the_ground_is_told() {
    let ground = random(5, 80, DVec2::ZERO, 10.0, |_| 1.0);
    let area = inside(&[ring(&[(6.0, 0.0), (16.0, 0.0), (16.0, 10.0), (6.0, 10.0)])]).unwrap();
    let found = to_elevation(&ground, 3.0, Some(&area)).unwrap();
    near(found.fill, 2.0 * 40.0, 1e-13);
    near(found.areas.design_uncovered, 60.0, 1e-12);
    assert_eq!((found.areas.existing_uncovered, found.areas.within), (0.0, Some(100.0)));
    let whole = to_elevation(&ground, 3.0, Some(&inside(&[ring(&[(1.0, 1.0), (9.0, 1.0), (5.0, 9.0)])]).unwrap())).unwrap();
    assert_eq!(whole.areas.design_uncovered, 0.0);
}

#[test]
fn what_lies_beside_inside_the_rings_is_told() {
    let design = random(1, 50, DVec2::ZERO, 10.0, |_| 1.0);
    let existing = random(2, 50, DVec2::new(5.0, 0.0), 10.0, |_| 0.0);
    let area = inside(&[ring(&[(2.0, 2.0), (12.0, 2.0), (12.0, 8.0), (2.0, 8.0)])]).unwrap();
    let found = between(&design, &existing, Some(&area)).unwrap();
    near(found.fill, 30.0, 1e-13);
    near(found.areas.design_uncovered, 18.0, 1e-12);
    near(found.areas.existing_uncovered, 12.0, 1e-12);
    let beside = inside(&[ring(&[(20.0, 2.0), (30.0, 2.0), (30.0, 8.0)])]).unwrap();
    assert!(matches!(between(&design, &existing, Some(&beside)), Err(OverlayError::Outside { .. })));
    assert!(matches!(to_elevation(&existing, 0.0, Some(&beside)), Err(OverlayError::Outside { .. })));
}
