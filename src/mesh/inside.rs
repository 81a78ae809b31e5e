//! The area bounded by rings, as triangles.

use super::region::RegionError;
use crate::kernel::frame::Frame;
use crate::kernel::orientation::{Turn, turn};
use crate::kernel::plan_box::PlanBox;
use crate::kernel::segment_tree::SegmentTree;
use crate::model::Terrain;
use glam::{DVec2, DVec3};
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

/// The area inside an odd number of `rings` (closed, the first vertex not repeated; world coordinates), triangulated at height
/// nought. Rings may touch and share stretches, but not cross: what holds for rings that were checked by
/// [`crate::validate`]. Triangles come counter-clockwise.
///
/// # Errors
/// [`RegionError`] if rings cross, or a coordinate cannot be triangulated.
pub fn inside(rings: &[Vec<DVec2>]) -> Result<Terrain, RegionError> {
    let all = || rings.iter().flatten();
    let bounds = PlanBox::of(all().copied());
    let frame = if bounds.is_empty() { Frame::WORLD } else { Frame::around(bounds.lo, bounds.hi) };
    let local = |p: &DVec2| frame.to_local(p.extend(0.0)).truncate();
    let points: Vec<Point2<f64>> = all().map(local).map(|p| Point2::new(p.x, p.y)).collect();
    let mut edges = Vec::with_capacity(points.len());
    let mut first = 0;
    for ring in rings {
        edges.extend((0..ring.len()).map(|i| [first + i, first + (i + 1) % ring.len()]));
        first += ring.len();
    }
    let ends: Vec<(DVec2, DVec2)> =
        edges.iter().map(|e| e.map(|i| DVec2::new(points[i].x, points[i].y))).map(|[a, b]| (a, b)).collect();
    let mut crossing = None;
    let triangulation = ConstrainedDelaunayTriangulation::<Point2<f64>>::try_bulk_load_cdt(points, edges, |[i, _]| {
        crossing.get_or_insert(i);
    })
    .map_err(|error| RegionError::Coordinate(error.to_string()))?;
    if let Some(&(a, _)) = crossing.and_then(|i| ends.get(i)) {
        return Err(RegionError::Crossing(frame.to_world(a.extend(0.0))));
    }
    let tree = SegmentTree::new(&ends);
    let odd = |p: DVec2| {
        let mut odd = false;
        tree.ray(p, |i| {
            let (a, b) = ends[i];
            let (low, high) = if a.y <= b.y { (a, b) } else { (b, a) };
            odd ^= low.y <= p.y && p.y < high.y && turn(low, high, p) == Turn::Left;
        });
        odd
    };
    let vertices = triangulation.vertices().map(|v| DVec3::new(v.position().x, v.position().y, 0.0)).collect();
    let triangles = triangulation
        .inner_faces()
        .filter(|face| {
            let [a, b, c] = face.positions().map(|p| DVec2::new(p.x, p.y));
            odd((a + b + c) / 3.0)
        })
        .map(|face| face.vertices().map(|v| v.index() as u32))
        .collect();
    Ok(Terrain { frame, vertices, triangles })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(x: f64, y: f64, side: f64) -> Vec<DVec2> {
        [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| DVec2::new(x + u * side, y + v * side)).to_vec()
    }

    fn area(rings: &[Vec<DVec2>]) -> f64 {
        let found = inside(rings).unwrap();
        let double = |[a, b, c]: [DVec3; 3]| (b - a).truncate().perp_dot((c - a).truncate());
        let areas: Vec<f64> = (0..found.triangles.len()).map(|t| 0.5 * double(found.corners(t))).collect();
        assert!(areas.iter().all(|&a| a > 0.0), "{areas:?}");
        areas.iter().sum()
    }

    #[test]
    fn rings_bound_by_turns() {
        let (x, y) = (500_000.0, 5_400_000.0);
        // A square of 10 with a hole of 6, in which stands one of 2, whichever way they run.
        let mut hole = square(x + 2.0, y + 2.0, 6.0);
        for _ in 0..2 {
            assert_eq!(area(&[square(x, y, 10.0), hole.clone(), square(x + 4.0, y + 4.0, 2.0)]), 100.0 - 36.0 + 4.0);
            hole.reverse();
        }
    }

    #[test]
    fn rings_may_touch() {
        // Neighbours that share half a side, a hole that touches its ring in the middle of a side.
        assert_eq!(area(&[square(0.0, 0.0, 4.0), square(4.0, 2.0, 4.0)]), 32.0);
        let hole = [(0.0, 2.0), (2.0, 1.0), (2.0, 3.0)].map(DVec2::from).to_vec();
        assert_eq!(area(&[square(0.0, 0.0, 4.0), hole]), 14.0);
    }

    #[test]
    fn rings_that_cross_are_refused() {
        assert!(matches!(inside(&[square(0.0, 0.0, 4.0), square(2.0, 2.0, 4.0)]), Err(RegionError::Crossing(_))));
        assert_eq!(inside(&[]).unwrap().triangles.len(), 0);
    }
}
