//! Shapes that break simple overlays, and meshes that must be refused.

use super::*;
use slopegen::mesh::inside::inside;
use slopegen::overlay::{OverlayError, Surface};

fn square(lo: DVec2, side: f64, z: f64) -> Terrain {
    let corners = [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| (lo + DVec2::new(u, v) * side).extend(z));
    terrain(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

/// Both meshes in one.
fn joined(a: &Terrain, b: &Terrain) -> Terrain {
    let shift = a.vertices.len() as u32;
    let triangles = a.triangles.iter().copied().chain(b.triangles.iter().map(|t| t.map(|v| v + shift)));
    terrain(a.vertices.iter().chain(&b.vertices).copied().collect(), triangles.collect())
}

#[test]
fn holes_are_uncovered() {
    // A ring of eight squares around a hole of 4 × 4, under a mesh without.
    let squares: Vec<Terrain> =
        (0..9).filter(|&i| i != 4).map(|i| square(DVec2::new(f64::from(i % 3), f64::from(i / 3)) * 4.0, 4.0, 1.0)).collect();
    let ring = squares[1..].iter().fold(squares[0].clone(), |all, one| joined(&all, one));
    for count in [0, 5, 300] {
        let cover = random(4, count, DVec2::ZERO, 12.0, |_| 3.0);
        let found = volume(&cover, &ring);
        near(found.fill, 2.0 * 128.0, 1e-13);
        near(found.areas.design_uncovered, 16.0, 1e-12);
        assert_eq!(found.areas.existing_uncovered, 0.0);
        let back = volume(&ring, &cover);
        near(back.cut, 2.0 * 128.0, 1e-13);
        near(back.areas.existing_uncovered, 16.0, 1e-12);
    }
}

/// One triangle over all, a million times as large as the others; strips a thousand times as long as wide. On planes the wedge
/// `h = x/16 − 5` over the square [0, 128]² is known: zero at x = 80.
#[test]
fn sizes_may_differ_as_they_like() {
    let (s, x0, g) = (128.0, 80.0, 0.0625);
    let (cut, fill) = (s * g * x0 * x0 / 2.0, s * g * (s - x0) * (s - x0) / 2.0);
    let giant =
        terrain(vec![DVec3::new(-1e5, -1e5, 20.0), DVec3::new(3e5, -1e5, 20.0), DVec3::new(-1e5, 3e5, 20.0)], vec![[0, 1, 2]]);
    let tilted = |p: DVec2| 20.0 + (p.x - x0) * g;
    let strips: Vec<DVec2> =
        (0..=200).flat_map(|i| [DVec2::new(0.0, 0.64 * f64::from(i)), DVec2::new(s, 0.64 * f64::from(i))]).collect();
    let diagonal = {
        let mut vertices = vec![DVec3::ZERO, DVec3::new(s, s, tilted(DVec2::splat(s)))];
        vertices[0].z = tilted(DVec2::ZERO);
        let side = |i: u32, flip: bool| {
            let t = s * f64::from(i) / 300.0;
            let p = if flip { DVec2::new(t, s) } else { DVec2::new(s, t) };
            p.extend(tilted(p))
        };
        // Fans of slivers from two opposite corners.
        let first = vertices.len() as u32;
        vertices.extend((0..300).map(|i| side(i, false)));
        let second = vertices.len() as u32;
        vertices.extend((0..300).map(|i| side(i, true)));
        let mut triangles: Vec<[u32; 3]> = (0..299).map(|i| [0, first + i, first + i + 1]).collect();
        triangles.push([0, first + 299, 1]);
        triangles.extend((0..299).map(|i| [0, second + i + 1, second + i]));
        triangles.push([0, 1, second + 299]);
        terrain(vertices, triangles)
    };
    for design in [delaunay(strips, tilted), diagonal, random(8, 20_000, DVec2::ZERO, s, tilted)] {
        near(area(&design), s * s, 1e-12);
        let found = volume(&design, &giant);
        near(found.fill, fill, 1e-12);
        near(found.cut, cut, 1e-12);
        let back = volume(&giant, &design);
        near(back.cut, fill, 1e-12);
        for ground in [random(9, 10, DVec2::ZERO, s, |_| 20.0), random(9, 4000, DVec2::splat(-8.0), s + 16.0, |_| 20.0)] {
            let found = volume(&design, &ground);
            near(found.fill, fill, 1e-12);
            near(found.cut, cut, 1e-12);
        }
    }
}

/// Points on a grid: every edge of one mesh lies on edges of the other.
#[test]
fn grids_over_each_other() {
    let grid = |n: i32, z: fn(DVec2) -> f64| {
        let step = 64.0 / f64::from(n);
        delaunay((0..=n).flat_map(move |i| (0..=n).map(move |j| DVec2::new(f64::from(i), f64::from(j)) * step)), z)
    };
    for (m, n) in [(16, 16), (16, 32), (32, 8), (1, 64)] {
        let found = volume(&grid(m, |_| 0.0), &grid(n, |p| p.x - 16.0));
        near(found.fill, 64.0 * 16.0 * 16.0 / 2.0, 1e-13);
        near(found.cut, 64.0 * 48.0 * 48.0 / 2.0, 1e-13);
        near(found.common_area(), 4096.0, 1e-14);
    }
}

#[test]
fn upright_and_turned_triangles_do_no_harm() {
    let ground = square(DVec2::ZERO, 8.0, 2.0);
    let mut odd = square(DVec2::ZERO, 8.0, 5.0);
    odd.vertices.extend([DVec3::new(4.0, 4.0, 9.0), DVec3::new(8.0, 8.0, 7.0)]);
    odd.triangles[1] = [0, 3, 2];
    odd.triangles.extend([[0, 4, 5], [1, 1, 2], [0, 0, 0]]);
    let found = volume(&odd, &ground);
    assert_eq!((found.fill, found.cut), (192.0, 0.0));
}

#[test]
fn a_mesh_on_itself_is_refused() {
    let ground = random(1, 50, DVec2::ZERO, 10.0, |_| 0.0);
    let upper = square(DVec2::new(2.0, 3.0), 2.0, 1.0);
    let twice = joined(&ground, &upper);
    let refused = |found: Result<Between, OverlayError>, which: Surface, least: f64| match found {
        Err(OverlayError::Double { surface, area, of, at }) => {
            assert_eq!(surface, which);
            // The upper square lies double, and no more.
            assert!(area > least && area <= 4.0 + 1e-9 && (of - 104.0).abs() < 1e-9, "{area} {of}");
            assert!(at.cmpge(DVec2::new(2.0, 3.0)).all() && at.cmple(DVec2::new(4.0, 5.0)).all(), "{at}");
        }
        other => panic!("{other:?}"),
    };
    refused(between(&twice, &ground, None), Surface::Design, 1.99);
    refused(between(&ground, &twice, None), Surface::Existing, 1.99);
    refused(slopegen::overlay::to_elevation(&twice, 0.5, None), Surface::Existing, 1.99);
    // Also where the other mesh lies wholly in the part that is double.
    let inner = square(DVec2::new(2.9, 3.9), 0.2, 4.0);
    assert!(matches!(between(&inner, &twice, None), Err(OverlayError::Double { .. })));
    // Two layers that share an edge, folded back.
    let folded = terrain(
        vec![DVec3::ZERO, DVec3::new(4.0, 0.0, 0.0), DVec3::new(0.0, 4.0, 0.0), DVec3::new(1.0, 1.0, 3.0)],
        vec![[0, 1, 2], [0, 1, 3]],
    );
    assert!(matches!(between(&folded, &ground, None), Err(OverlayError::Double { .. })));
}

/// Of a mesh of 10⁸ square units 49 lie double: nothing of the whole, and all of a design that lies there. What counts is the part
/// that is compared.
#[test]
fn what_is_compared_must_lie_single() {
    let ground = |z| joined(&square(DVec2::ZERO, 1e4, z), &square(DVec2::splat(5e3), 7.0, z));
    let refused = |found: Result<Between, OverlayError>, which: Surface, whole: f64| {
        let Err(OverlayError::Double { surface, area, of, at }) = found else { panic!("{found:?}") };
        assert_eq!(surface, which);
        assert!((area - 49.0).abs() < 1e-6 && (of - whole).abs() < 1e-6, "{area} {of}");
        assert!(at.cmpge(DVec2::splat(5e3)).all() && at.cmple(DVec2::splat(5007.0)).all(), "{at}");
    };
    let there = square(DVec2::splat(5e3), 7.0, 1.0);
    refused(between(&there, &ground(0.0), None), Surface::Existing, 98.0);
    refused(between(&ground(1.0), &square(DVec2::splat(5e3), 7.0, 0.0), None), Surface::Design, 98.0);
    let beside = volume(&square(DVec2::splat(6e3), 7.0, 1.0), &ground(0.0));
    near(beside.fill, 49.0, 1e-9);
    assert_eq!(beside.double, [0.0; 2]);
    // A design of which half has no ground below, the other half lies on the double part among others.
    let half = square(DVec2::new(4900.0, 9800.0), 400.0, 1.0);
    let moved = joined(&square(DVec2::ZERO, 1e4, 0.0), &square(DVec2::new(5e3, 9990.0), 7.0, 0.0));
    let found = between(&half, &moved, None);
    assert!(
        matches!(found, Err(OverlayError::Double { surface: Surface::Existing, of, .. }) if (of - 80_049.0).abs() < 1e-6),
        "{found:?}"
    );
    // Against a level, all and inside rings.
    let all = slopegen::overlay::to_elevation(&ground(0.0), 1.0, None).unwrap();
    assert!((all.double[1] - 49.0).abs() < 1e-6, "{:?}", all.double);
    let rings = |lo: f64| {
        inside(&[[(0.0, 0.0), (20.0, 0.0), (20.0, 20.0), (0.0, 20.0)].map(|(x, y)| DVec2::new(lo + x, lo + y)).to_vec()])
    };
    refused(slopegen::overlay::to_elevation(&ground(0.0), 1.0, Some(&rings(4990.0).unwrap())), Surface::Existing, 449.0);
    refused(between(&square(DVec2::ZERO, 1e4, 1.0), &ground(0.0), Some(&rings(4990.0).unwrap())), Surface::Existing, 449.0);
    let beside = slopegen::overlay::to_elevation(&ground(0.0), 1.0, Some(&rings(2e3).unwrap())).unwrap();
    assert_eq!((beside.fill, beside.double), (400.0, [0.0; 2]));
}

/// As many squares on each other as you like are refused at once, without a look at every pair.
#[test]
fn stacks_are_refused_at_once() {
    let one = square(DVec2::ZERO, 1.0, 0.0);
    let shift = |n: u32| one.triangles.iter().map(move |t| t.map(|v| v + 4 * n));
    let vertices = (0..100_000).flat_map(|_| one.vertices.iter().copied()).collect();
    let stack = terrain(vertices, (0..100_000).flat_map(shift).collect());
    assert!(matches!(between(&stack, &one, None), Err(OverlayError::Double { surface: Surface::Design, .. })));
}

/// Rounded coordinates leave slivers along seams; they are told, not refused.
#[test]
fn a_seam_of_slivers_is_reported() {
    let seam = joined(&square(DVec2::ZERO, 10.0, 1.0), &square(DVec2::new(10.0 - 1e-6, 0.0), 10.0, 1.0));
    let found = volume(&seam, &square(DVec2::splat(-1.0), 40.0, 0.0));
    assert!((found.double[0] - 1e-5).abs() < 1e-10 && found.double[1] == 0.0, "{:?}", found.double);
    near(found.fill, 200.0, 1e-6);
}

#[test]
fn meshes_apart_are_refused_with_both_boxes() {
    let error = between(&square(DVec2::ZERO, 1.0, 0.0), &far(&square(DVec2::ZERO, 1.0, 0.0)), None).unwrap_err();
    let OverlayError::Apart { design, existing } = error else { panic!("{error:?}") };
    assert_eq!(design, [DVec2::ZERO, DVec2::ONE]);
    assert_eq!(existing, [UTM, UTM + 1.0]);
    // Boxes that meet are not enough; nor is a common side.
    let lower = terrain(vec![DVec3::ZERO, DVec3::new(9.0, 0.0, 0.0), DVec3::new(0.0, 9.0, 0.0)], vec![[0, 1, 2]]);
    for apart in [square(DVec2::splat(6.0), 3.0, 0.0), square(DVec2::new(0.0, -9.0), 9.0, 0.0)] {
        assert!(matches!(between(&lower, &apart, None), Err(OverlayError::Apart { .. })));
    }
    let empty = terrain(vec![DVec3::ZERO, DVec3::X, DVec3::X * 2.0], vec![[0, 1, 2]]);
    assert_eq!(between(&empty, &lower, None), Err(OverlayError::Empty(Surface::Design)));
    assert_eq!(between(&lower, &terrain(Vec::new(), Vec::new()), None), Err(OverlayError::Empty(Surface::Existing)));
}
