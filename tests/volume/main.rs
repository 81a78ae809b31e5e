//! Exact volumes between two TINs: closed forms, invariance, hostile shapes, textbook cases, and figures of another program.

mod against_brute_force;
mod closed_forms;
mod hostile;
mod invariance;
mod outside;
mod textbook;
mod within;

#[allow(dead_code, reason = "shared, and used in part")]
#[path = "../../src/kernel/testing.rs"]
mod random;

use glam::{DVec2, DVec3};
use random::Random;
use slopegen::kernel::frame::Frame;
use slopegen::kernel::plan_box::PlanBox;
use slopegen::model::Terrain;
use slopegen::overlay::{Between, between};
use spade::{DelaunayTriangulation, Point2, Triangulation as _};

/// World coordinates as they occur in UTM, on the grid of [`snapped`].
const UTM: DVec2 = DVec2::new(524_288.0, 5_242_880.0);

/// Rounds to a multiple of 2⁻²⁰, so that moving to [`UTM`] and back rounds nothing.
fn snapped(v: f64) -> f64 {
    (v * 1_048_576.0).round() / 1_048_576.0
}

fn terrain(vertices: Vec<DVec3>, triangles: Vec<[u32; 3]>) -> Terrain {
    Terrain { frame: Frame::WORLD, vertices, triangles }
}

/// The Delaunay triangulation of points in plan.
fn delaunay(points: impl IntoIterator<Item = DVec2>, z: impl Fn(DVec2) -> f64) -> Terrain {
    let points = points.into_iter().map(|p| Point2::new(p.x, p.y)).collect();
    let mesh = DelaunayTriangulation::<Point2<f64>>::bulk_load(points).unwrap();
    let vertices = mesh.vertices().map(|v| DVec2::new(v.position().x, v.position().y)).map(|p| p.extend(z(p))).collect();
    terrain(vertices, mesh.inner_faces().map(|f| f.vertices().map(|v| v.index() as u32)).collect())
}

/// A random TIN over the square from `lo` to `lo + side`, its corners included.
fn random(seed: u64, count: usize, lo: DVec2, side: f64, z: impl Fn(DVec2) -> f64) -> Terrain {
    let mut random = Random::new(seed);
    for _ in 0..4 {
        random.unit();
    }
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(DVec2::from);
    let inner: Vec<DVec2> = (0..count).map(|_| DVec2::new(random.unit(), random.unit())).collect();
    delaunay(corners.into_iter().chain(inner).map(|p| (lo + p * side).to_array().map(snapped).into()), z)
}

/// Smooth hills.
fn hills(p: DVec2, phase: f64) -> f64 {
    50.0 + 6.0 * (p.x / 31.0 + phase).sin() * (p.y / 23.0).cos() + 0.7 * (p.x / 5.0 - p.y / 7.0 + phase).cos()
}

fn changed(mesh: &Terrain, change: impl Fn(DVec3) -> DVec3) -> Terrain {
    terrain(mesh.vertices.iter().map(|v| change(*v)).collect(), mesh.triangles.clone())
}

/// Moved to [`UTM`], in a frame of its own.
fn far(mesh: &Terrain) -> Terrain {
    let moved = changed(mesh, |p| p + UTM.extend(0.0));
    let PlanBox { lo, hi } = moved.plan_box();
    moved.in_frame(Frame::around(lo, hi))
}

fn volume(design: &Terrain, existing: &Terrain) -> Between {
    between(design, existing, None).unwrap_or_else(|e| panic!("{e}"))
}

fn plan_area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).truncate().perp_dot((c - a).truncate())
}

fn area(mesh: &Terrain) -> f64 {
    (0..mesh.triangles.len()).map(|t| plan_area(mesh.corners(t)).abs()).sum()
}

/// Volume under a mesh down to zero.
fn integral(mesh: &Terrain) -> f64 {
    let prism = |c: [DVec3; 3]| plan_area(c) * (c[0].z + c[1].z + c[2].z) / 3.0;
    (0..mesh.triangles.len()).map(|t| prism(mesh.corners(t))).sum()
}

/// Within `relative` of the expected value.
#[track_caller]
fn near(found: f64, expected: f64, relative: f64) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{found} instead of {expected}: {:e}", found / expected - 1.0);
}
