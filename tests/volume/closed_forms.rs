//! Volumes known by formula, on unrelated triangulations.

use super::*;

/// Two planes over a square of side `s`, their difference `(x − x₀)·g`: the design lies above where `x < x₀`. Both parts are
/// triangular prisms: `fill = s·g·x₀²/2`, `cut = s·g·(s − x₀)²/2`.
#[test]
fn wedge_between_two_planes() {
    let (s, x0, g) = (1024.0, 300.0, 0.0625);
    let design = random(1, 3000, DVec2::ZERO, s, |p| 80.0 + p.y / 32.0);
    let existing = random(2, 5000, DVec2::ZERO, s, |p| 80.0 + p.y / 32.0 + (p.x - x0) * g);
    for (design, existing) in [(design.clone(), existing.clone()), (far(&design), far(&existing))] {
        let found = volume(&design, &existing);
        near(found.fill, s * g * x0 * x0 / 2.0, 1e-13);
        near(found.cut, s * g * (s - x0).powi(2) / 2.0, 1e-13);
        near(found.areas.fill, s * x0, 1e-13);
        near(found.areas.cut, s * (s - x0), 1e-13);
        assert_eq!((found.areas.unaffected, found.areas.design_uncovered, found.areas.existing_uncovered), (0.0, 0.0, 0.0));
        // Deepest along the sides x = 0 and x = s.
        let (cut, fill) = (found.deepest_cut.unwrap(), found.deepest_fill.unwrap());
        near(cut.depth, (s - x0) * g, 1e-12);
        near(fill.depth, x0 * g, 1e-12);
        let origin = if design.frame == Frame::WORLD { DVec2::ZERO } else { UTM };
        assert!((cut.place.x - origin.x - s).abs() < 1e-9 && (fill.place.x - origin.x).abs() < 1e-9, "{cut:?} {fill:?}");
        assert!((cut.place.z - 80.0 - (cut.place.y - origin.y) / 32.0).abs() < 1e-9, "on the design: {cut:?}");
    }
}

/// A pyramid on a square of side 20, apex 9 above a plane and base 3 below it. Above the plane stands the similar pyramid with
/// base side 20·9/12 = 15: `fill = 15²·9/3 = 675`. The whole is `∫h = 20²·(12/3 − 3) = 400 = fill − cut`, so `cut = 275`. What
/// plane it is does not matter.
#[test]
fn pyramid_over_a_plane() {
    let plane = |p: DVec2| 50.0 + 0.25 * p.x - 0.125 * p.y;
    let corners = [(-10.0, -10.0), (10.0, -10.0), (10.0, 10.0), (-10.0, 10.0)].map(DVec2::from);
    let mut vertices: Vec<DVec3> = corners.iter().map(|p| p.extend(plane(*p) - 3.0)).collect();
    vertices.push(DVec3::new(0.0, 0.0, plane(DVec2::ZERO) + 9.0));
    let pyramid = terrain(vertices, vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]);
    for existing in [random(5, 900, DVec2::splat(-10.0), 20.0, plane), random(6, 900, DVec2::splat(-16.0), 32.0, plane)] {
        let found = volume(&pyramid, &existing);
        near(found.fill, 675.0, 1e-12);
        near(found.cut, 275.0, 1e-12);
        near(found.areas.fill, 225.0, 1e-12);
        near(found.deepest_fill.unwrap().depth, 9.0, 1e-12);
        near(found.deepest_cut.unwrap().depth, 3.0, 1e-12);
        assert!((found.areas.existing_uncovered - (area(&existing) - 400.0)).abs() < 1e-9);
        assert_eq!(found.areas.design_uncovered, 0.0);
    }
}

#[test]
fn nothing_between_a_mesh_and_itself() {
    let mesh = random(3, 2000, DVec2::ZERO, 200.0, |p| hills(p, 0.0));
    // In another order, corners turned round.
    let mut other = mesh.clone();
    other.triangles.reverse();
    other.triangles.iter_mut().for_each(|t| t.rotate_left(1));
    for other in [mesh.clone(), other] {
        let found = volume(&mesh, &other);
        assert_eq!((found.cut, found.fill, found.areas.cut, found.areas.fill), (0.0, 0.0, 0.0, 0.0));
        assert_eq!((found.deepest_cut, found.deepest_fill), (None, None));
        assert_eq!(found.cells, mesh.triangles.len());
        near(found.areas.unaffected, 40_000.0, 1e-14);
    }
}

/// The same mesh raised by a constant.
#[test]
fn a_layer() {
    let mesh = random(3, 2000, DVec2::ZERO, 200.0, |p| hills(p, 0.0));
    let found = volume(&changed(&mesh, |p| p + DVec3::new(0.0, 0.0, 0.25)), &mesh);
    near(found.fill, 10_000.0, 1e-13);
    assert_eq!((found.cut, found.areas.cut, found.deepest_cut), (0.0, 0.0, None));
}

/// Where both meshes cover the same square, net is the difference of the two solids, whose volumes need no overlay.
#[test]
fn net_is_the_difference_of_the_solids() {
    for seed in 0..20 {
        let a = random(2 * seed + 1, 400, DVec2::ZERO, 128.0, |p| hills(p, 0.0));
        let b = random(2 * seed + 2, 900, DVec2::ZERO, 128.0, |p| hills(p, 0.4));
        let found = volume(&a, &b);
        let net = integral(&b) - integral(&a);
        assert!((found.net() - net).abs() <= 1e-12 * (found.cut + found.fill) + 1e-15 * integral(&a), "{} {net}", found.net());
        near(found.common_area(), 128.0 * 128.0, 1e-14);
    }
}

/// A plane: the same as with a mesh of that plane; a tetrahedral hill of height 4 on base area 50 above elevation 10, cut off at
/// 13: what is above is similar, (1/4)³ of 50·4/3.
#[test]
fn to_an_elevation() {
    let hill = terrain(
        vec![DVec3::new(0.0, 0.0, 10.0), DVec3::new(10.0, 0.0, 10.0), DVec3::new(0.0, 10.0, 10.0), DVec3::new(3.0, 3.0, 14.0)],
        vec![[0, 1, 3], [1, 2, 3], [2, 0, 3]],
    );
    let found = slopegen::overlay::to_elevation(&hill, 13.0, None).unwrap();
    let whole = 50.0 * 4.0 / 3.0;
    near(found.cut, whole / 64.0, 1e-13);
    near(found.fill, 50.0 * 3.0 - whole + whole / 64.0, 1e-13);
    near(found.areas.cut, 50.0 / 16.0, 1e-13);
    assert_eq!(found.deepest_cut.unwrap().place, DVec3::new(3.0, 3.0, 13.0));
    assert_eq!((found.deepest_cut.unwrap().depth, found.deepest_fill.unwrap().depth), (1.0, 3.0));
    let plane = terrain(hill.vertices[..3].iter().map(|v| DVec3::new(v.x, v.y, 13.0)).collect(), vec![[0, 1, 2]]);
    let twin = volume(&plane, &hill);
    near(twin.cut, found.cut, 1e-13);
    near(twin.fill, found.fill, 1e-13);
}
