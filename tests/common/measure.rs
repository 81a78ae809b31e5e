//! Figures of a surface from its triangles and lines alone, by loops of their own.

use glam::{DVec2, DVec3};
use slopegen::model::{CurveKind, LineFeature, Part};
use slopegen::surface::Surface;
use std::collections::HashMap;

/// Corners of all triangles, local frame.
pub(crate) fn triangles(surface: &Surface) -> impl Iterator<Item = ([DVec3; 3], Part)> + '_ {
    (0..surface.tin.triangles.len()).map(|t| (surface.tin.corners(t), surface.tin.parts[t]))
}

/// Plan area of a triangle.
pub(crate) fn area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * ((b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y))
}

/// Plan area of all triangles of a part.
pub(crate) fn plan_area(surface: &Surface, part: Part) -> f64 {
    triangles(surface).filter(|t| t.1 == part).map(|t| area(t.0)).sum()
}

/// Integral of height above `plane` over all triangles: fill less cut.
pub(crate) fn net_above(surface: &Surface, plane: f64) -> f64 {
    triangles(surface).map(|(t, _)| area(t) * ((t[0].z + t[1].z + t[2].z) / 3.0 - plane)).sum()
}

/// Height of the mesh over a plan point in the local frame; `None` beside it.
pub(crate) fn height(surface: &Surface, x: f64, y: f64) -> Option<f64> {
    let p = DVec3::new(x, y, 0.0);
    triangles(surface).find_map(|([a, b, c], _)| {
        let weights = [area([p, b, c]), area([a, p, c]), area([a, b, p])].map(|w| w / area([a, b, c]));
        let inside = weights.iter().all(|&w| w >= -1e-12);
        inside.then(|| weights[0] * a.z + weights[1] * b.z + weights[2] * c.z)
    })
}

/// Gradient of the plane through a triangle.
pub(crate) fn gradient([a, b, c]: [DVec3; 3]) -> DVec2 {
    let normal = (b - a).cross(c - a);
    -normal.truncate() / normal.z
}

/// The lines of a kind.
pub(crate) fn curves(surface: &Surface, kind: CurveKind) -> impl Iterator<Item = &LineFeature> {
    surface.lines.iter().filter(move |l| l.kind == kind)
}

/// Length of all lines of a kind, in space.
pub(crate) fn length(surface: &Surface, kind: CurveKind) -> f64 {
    curves(surface, kind).map(polyline_length).sum()
}

/// Length of the level curves at an elevation.
pub(crate) fn level_length(surface: &Surface, elevation: f64) -> f64 {
    let on = |l: &&LineFeature| l.elevation.is_some_and(|e| (e - elevation).abs() < 1e-9);
    curves(surface, CurveKind::LevelCurve).filter(on).map(polyline_length).sum()
}

fn polyline_length(line: &LineFeature) -> f64 {
    line.points.windows(2).map(|w| w[0].distance(w[1])).sum()
}

/// Edges with a triangle on one side only, directed with the triangle on their left; panics at an edge used twice in one
/// direction.
#[track_caller]
pub(crate) fn open_edges(name: &str, surface: &Surface) -> Vec<[u32; 2]> {
    let mut edges = HashMap::new();
    for (t, ids) in surface.tin.triangles.iter().enumerate() {
        for e in [[ids[0], ids[1]], [ids[1], ids[2]], [ids[2], ids[0]]] {
            assert!(edges.insert(e, t).is_none(), "{name}: edge {e:?} twice in one direction");
        }
    }
    let mut open: Vec<[u32; 2]> = edges.keys().copied().filter(|&[a, b]| !edges.contains_key(&[b, a])).collect();
    open.sort_unstable();
    open
}

/// Plan area that directed edges enclose (shoelace formula about the first vertex).
pub(crate) fn enclosed(surface: &Surface, edges: &[[u32; 2]]) -> f64 {
    let Some(&[first, _]) = edges.first() else { return 0.0 };
    let origin = surface.tin.vertices[first as usize].truncate();
    let about = |v: u32| surface.tin.vertices[v as usize].truncate() - origin;
    edges.iter().map(|&[a, b]| 0.5 * about(a).perp_dot(about(b))).sum()
}

/// Fails unless `found` lies within `relative` of `expected`.
#[track_caller]
pub(crate) fn close(found: f64, expected: f64, relative: f64, what: &str) {
    assert!((found - expected).abs() <= relative * expected.abs(), "{what}: {found} for {expected}");
}

/// Fails unless `found` lies at or below `expected` by no more than `below`, rounding aside.
#[track_caller]
pub(crate) fn not_above(found: f64, expected: f64, below: f64, what: &str) {
    let rounding = 1e-12 * expected.abs();
    assert!(found <= expected + rounding && found >= expected - below - rounding, "{what}: {found} for {expected} − {below}");
}
