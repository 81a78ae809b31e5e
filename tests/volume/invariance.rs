//! What must not change the figures, and what must change them in a known way.

use super::*;
use std::f64::consts::TAU;

fn pair() -> (Terrain, Terrain) {
    (random(11, 1200, DVec2::ZERO, 150.0, |p| hills(p, 0.0)), random(12, 1500, DVec2::splat(-20.0), 150.0, |p| hills(p, 0.9)))
}

#[track_caller]
fn same(found: &Between, expected: &Between, relative: f64) {
    near(found.cut, expected.cut, relative);
    near(found.fill, expected.fill, relative);
    near(found.areas.cut, expected.areas.cut, relative);
    near(found.areas.fill, expected.areas.fill, relative);
    near(found.areas.design_uncovered, expected.areas.design_uncovered, relative);
    near(found.areas.existing_uncovered, expected.areas.existing_uncovered, relative);
    near(found.deepest_cut.unwrap().depth, expected.deepest_cut.unwrap().depth, relative);
    near(found.deepest_fill.unwrap().depth, expected.deepest_fill.unwrap().depth, relative);
}

#[test]
fn mirrored_in_z_cut_and_fill_swap_exactly() {
    let (a, b) = pair();
    let mirror = |mesh| changed(mesh, |p| DVec3::new(p.x, p.y, -p.z));
    let (found, mirrored) = (volume(&a, &b), volume(&mirror(&a), &mirror(&b)));
    assert!(found.cut > 0.0 && found.fill > 0.0);
    assert_eq!((mirrored.cut, mirrored.fill), (found.fill, found.cut));
    assert_eq!((mirrored.areas.cut, mirrored.areas.fill), (found.areas.fill, found.areas.cut));
    assert_eq!(mirrored.deepest_cut.unwrap().depth, found.deepest_fill.unwrap().depth);
}

#[test]
fn roles_swap_cut_and_fill() {
    let (a, b) = pair();
    let (found, back) = (volume(&a, &b), volume(&b, &a));
    near(back.cut, found.fill, 1e-13);
    near(back.fill, found.cut, 1e-13);
    near(back.areas.design_uncovered, found.areas.existing_uncovered, 1e-13);
    // The depth is found in the same place, told on the other surface.
    let (cut, fill) = (found.deepest_cut.unwrap(), back.deepest_fill.unwrap());
    assert!((cut.place.truncate() - fill.place.truncate()).length() < 1e-9, "{cut:?} {fill:?}");
    assert!((fill.place.z - cut.place.z - cut.depth).abs() < 1e-9, "{cut:?} {fill:?}");
}

#[test]
fn rotated() {
    let (a, b) = pair();
    let expected = volume(&a, &b);
    for i in 1..8 {
        let turn = DVec2::from_angle(TAU * f64::from(i) / 7.3);
        let rotate = |mesh| changed(mesh, |p| turn.rotate(p.truncate()).extend(p.z));
        same(&volume(&rotate(&a), &rotate(&b)), &expected, 1e-12);
    }
}

#[test]
fn moved_to_utm() {
    let (a, b) = pair();
    let (found, moved) = (volume(&a, &b), volume(&far(&a), &far(&b)));
    same(&moved, &found, 1e-13);
    let shift = moved.deepest_cut.unwrap().place - found.deepest_cut.unwrap().place;
    assert!((shift.truncate() - UTM).length() < 1e-8, "{shift}");
    // World coordinates without a frame, as someone may hand them over.
    let bare = |mesh| changed(mesh, |p: DVec3| p + UTM.extend(0.0));
    same(&volume(&bare(&a), &bare(&b)), &found, 1e-12);
}

#[test]
fn a_refinement_changes_nothing() {
    let (a, b) = pair();
    let expected = volume(&a, &b);
    // Every triangle split at its centroid; and every other one at the middles of its edges, with T-junctions.
    let mut centroids = a.clone();
    let mut middles = a.clone();
    centroids.triangles.clear();
    middles.triangles.clear();
    for (t, &[i, j, k]) in a.triangles.iter().enumerate() {
        let [p, q, r] = a.corners(t);
        let c = centroids.vertices.len() as u32;
        centroids.vertices.push((p + q + r) / 3.0);
        centroids.triangles.extend([[i, j, c], [j, k, c], [k, i, c]]);
        if t % 2 == 0 {
            middles.triangles.push([i, j, k]);
        } else {
            let m = middles.vertices.len() as u32;
            middles.vertices.extend([(p + q) / 2.0, (q + r) / 2.0, (r + p) / 2.0]);
            middles.triangles.extend([[i, m, m + 2], [m, j, m + 1], [m + 2, m + 1, k], [m, m + 1, m + 2]]);
        }
    }
    for refined in [centroids, middles] {
        same(&volume(&refined, &b), &expected, 1e-12);
        same(&volume(&b, &refined), &volume(&b, &a), 1e-12);
        // Against the mesh it refines: nothing but rounding.
        let nothing = volume(&refined, &a);
        assert!(nothing.cut < 1e-9 && nothing.fill < 1e-9, "{nothing:?}");
        assert_eq!((nothing.areas.cut, nothing.areas.fill), (0.0, 0.0));
        near(nothing.areas.unaffected, 22_500.0, 1e-13);
    }
}

#[test]
fn loose_triangles_are_as_good_as_a_mesh() {
    let (a, b) = pair();
    let loose = |mesh: &Terrain| {
        let vertices = (0..mesh.triangles.len()).flat_map(|t| mesh.corners(t)).collect();
        terrain(vertices, (0..mesh.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect())
    };
    let expected = volume(&a, &b);
    same(&volume(&loose(&a), &loose(&b)), &expected, 1e-13);
    same(&volume(&loose(&b), &a), &volume(&b, &a), 1e-13);
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let a = random(21, 9000, DVec2::ZERO, 300.0, |p| hills(p, 0.0));
    let b = random(22, 8000, DVec2::ZERO, 300.0, |p| hills(p, 0.6));
    let on = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(|| volume(&a, &b));
    let one = on(1);
    for threads in [2, 3, 8] {
        assert_eq!(on(threads), one);
    }
}
