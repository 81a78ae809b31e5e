//! Flat parts: the inside of closed outlines, triangulated from the mesh edges that bound it.

use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};
use spade::{ConstrainedDelaunayTriangulation, HasPosition, Point2, Triangulation, handles::FixedFaceHandle, handles::InnerTag};

/// Why a region could not be filled. Places are in the coordinates given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionError {
    /// Two edges of the outline cross.
    #[error("two edges of the outline cross")]
    Crossing(DVec3),
    /// The outline is not closed.
    #[error("the outline is open")]
    Open(DVec3),
    /// The triangulation refused a coordinate.
    #[error("a coordinate cannot be triangulated: {0}")]
    Coordinate(String),
}

struct Vertex {
    position: Point2<f64>,
    id: u32,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// Triangulates the region on the left of the directed `outline`, using its vertices only.
///
/// `points` are all mesh vertices. The outline consists of closed loops, already noded: edges meet at common vertices only.
/// Each edge is straight and lists its vertices from end to end; the ends are triangulated (constrained Delaunay), then the
/// triangle at each edge is fanned out to the vertices between. So thousands of vertices on one straight edge cost nothing
/// and never form triangles among themselves. Returns counter-clockwise triangles of mesh vertices.
///
/// # Errors
/// [`RegionError::Crossing`] and [`RegionError::Open`] if the outline is not what is asked for.
pub fn fill(points: &[DVec3], outline: &[Vec<u32>]) -> Result<Vec<[u32; 3]>, RegionError> {
    fill_with(points, outline, &[])
}

/// As [`fill`]; `inner` are lines inside the region whose segments become edges of the triangulation, noded like the outline. A
/// line of one vertex is a point.
///
/// # Errors
/// As [`fill`].
pub fn fill_with(points: &[DVec3], outline: &[Vec<u32>], inner: &[Vec<u32>]) -> Result<Vec<[u32; 3]>, RegionError> {
    let mut local: FxHashMap<u32, usize> = FxHashMap::default();
    let mut vertices: Vec<Vertex> = Vec::new();
    let mut number = |id: u32| {
        *local.entry(id).or_insert_with(|| {
            let p = points[id as usize];
            vertices.push(Vertex { position: Point2::new(p.x, p.y), id });
            vertices.len() - 1
        })
    };
    let ends: Vec<[u32; 2]> = outline.iter().map(|edge| [edge[0], edge[edge.len() - 1]]).collect();
    let mut edges: Vec<[usize; 2]> = ends.iter().map(|e| e.map(&mut number)).collect();
    for line in inner {
        let local: Vec<usize> = line.iter().map(|&v| number(v)).collect();
        edges.extend(local.windows(2).map(|w| [w[0], w[1]]));
    }
    let boundary: FxHashSet<[u32; 2]> = ends.iter().flat_map(|&[a, b]| [[a, b], [b, a]]).collect();
    let place = |id: u32| points[id as usize];
    let ids: Vec<u32> = vertices.iter().map(|v| v.id).collect();
    let mut crossing = None;
    let triangulation = ConstrainedDelaunayTriangulation::<Vertex>::try_bulk_load_cdt(vertices, edges, |e| {
        crossing.get_or_insert(place(ids[e[0]]));
    })
    .map_err(|error| RegionError::Coordinate(error.to_string()))?;
    if let Some(p) = crossing {
        return Err(RegionError::Crossing(p));
    }
    let handle: FxHashMap<u32, _> = triangulation.vertices().map(|v| (v.data().id, v.fix())).collect();
    let mut inside = vec![false; triangulation.num_all_faces()];
    let mut pending: Vec<FixedFaceHandle<InnerTag>> = Vec::new();
    for &[a, b] in &ends {
        let open = || RegionError::Open(place(a));
        let (Some(&from), Some(&to)) = (handle.get(&a), handle.get(&b)) else { return Err(open()) };
        let edge = triangulation.get_edge_from_neighbors(from, to).ok_or_else(open)?;
        let face = edge.face().as_inner().ok_or_else(open)?.fix();
        if !std::mem::replace(&mut inside[face.index()], true) {
            pending.push(face);
        }
    }
    while let Some(face) = pending.pop() {
        for edge in triangulation.face(face).adjacent_edges() {
            if edge.is_constraint_edge() && boundary.contains(&[edge.from().data().id, edge.to().data().id]) {
                continue;
            }
            let next = edge.rev().face().as_inner().ok_or_else(|| RegionError::Open(place(edge.from().data().id)))?.fix();
            if !std::mem::replace(&mut inside[next.index()], true) {
                pending.push(next);
            }
        }
    }
    let between: FxHashMap<[u32; 2], &[u32]> =
        ends.iter().zip(outline).filter(|(_, edge)| edge.len() > 2).map(|(&e, edge)| (e, &edge[1..edge.len() - 1])).collect();
    let mut triangles = Vec::new();
    for face in triangulation.inner_faces().filter(|face| inside[face.fix().index()]) {
        fan_out(face.vertices().map(|v| v.data().id), &between, &mut triangles);
    }
    Ok(triangles)
}

/// Splits a triangle at the vertices on its edges.
fn fan_out(triangle: [u32; 3], between: &FxHashMap<[u32; 2], &[u32]>, out: &mut Vec<[u32; 3]>) {
    let [a, b, c] = triangle;
    for [a, b, c] in [[a, b, c], [b, c, a], [c, a, b]] {
        if let Some(inner) = between.get(&[a, b]) {
            let mut from = a;
            for &to in inner.iter().chain([&b]) {
                // The parts of the edge itself have no vertices between; the two outer parts keep the other edges.
                fan_out([from, to, c], between, out);
                from = to;
            }
            return;
        }
    }
    out.push(triangle);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn square(from: f64, to: f64) -> [DVec3; 4] {
        [(from, from), (to, from), (to, to), (from, to)].map(|(x, y)| DVec3::new(x, y, 1.0))
    }

    #[test]
    fn fills_a_ring_with_a_hole() {
        let points: Vec<DVec3> = square(0.0, 10.0).into_iter().chain(square(4.0, 6.0)).collect();
        let outline = [[0, 1], [1, 2], [2, 3], [3, 0], [5, 4], [6, 5], [7, 6], [4, 7]].map(Vec::from);
        let triangles = fill(&points, &outline).unwrap();
        let area: f64 = triangles
            .iter()
            .map(|t| t.map(|v| points[v as usize].truncate()))
            .map(|[a, b, c]| 0.5 * (b - a).perp_dot(c - a))
            .sum();
        assert_eq!(area, 96.0);
    }

    #[test]
    fn fans_out_to_vertices_on_all_edges() {
        let mut points = square(0.0, 4.0)[..3].to_vec();
        points.extend([(1.0, 0.0), (3.0, 0.0), (4.0, 2.0), (2.0, 2.0)].map(|(x, y)| DVec3::new(x, y, 1.0)));
        let triangles = fill(&points, &[vec![0, 3, 4, 1], vec![1, 5, 2], vec![2, 6, 0]]).unwrap();
        assert_eq!(triangles.len(), 5, "{triangles:?}");
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| points[v as usize].truncate());
            0.5 * (b - a).perp_dot(c - a)
        };
        assert!(triangles.iter().all(|t| area(t) > 0.0));
        assert_eq!(triangles.iter().map(area).sum::<f64>(), 8.0);
    }

    #[test]
    fn keeps_lines_and_points_inside() {
        // A ridge across the square from edge to edge, which the shorter diagonals would not choose, and a point.
        let mut points = square(0.0, 10.0).to_vec();
        points.extend([(1.0, 0.0), (9.0, 10.0), (5.0, 5.0), (2.0, 8.0)].map(|(x, y)| DVec3::new(x, y, 3.0)));
        let outline = [vec![0, 4], vec![4, 1], vec![1, 2], vec![2, 5], vec![5, 3], vec![3, 0]];
        let triangles = fill_with(&points, &outline, &[vec![4, 6, 5], vec![7]]).unwrap();
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| points[v as usize].truncate());
            0.5 * (b - a).perp_dot(c - a)
        };
        assert_eq!(triangles.iter().map(area).sum::<f64>(), 100.0);
        let has = |a: u32, b: u32| triangles.iter().any(|t| (0..3).any(|i| t[i] == a && t[(i + 1) % 3] == b));
        assert!(has(4, 6) && has(6, 4) && has(6, 5) && has(5, 6));
        assert!(triangles.iter().any(|t| t.contains(&7)));
    }

    #[test]
    fn refuses_crossing_and_open_outlines() {
        let points = square(0.0, 10.0);
        assert!(matches!(fill(&points, &[[0, 2], [2, 1], [1, 3], [3, 0]].map(Vec::from)), Err(RegionError::Crossing(_))));
        assert!(matches!(fill(&points, &[[0, 1], [1, 2]].map(Vec::from)), Err(RegionError::Open(_))));
    }
}
