//! Whether triangles form a surface: every defect counted on the mesh itself.

use crate::kernel::orientation::{Turn, turn};
use crate::kernel::segment_tree::SegmentTree;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// What is wrong with a mesh, and where it ends.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Soundness {
    /// Triangles that are not counter-clockwise in plan (turned over, upright or degenerate).
    pub turned: usize,
    /// Directed edges used more than once.
    pub repeated_edges: usize,
    /// Vertices at which more than one stretch of boundary begins.
    pub pinched: usize,
    /// Vertices no triangle uses.
    pub unused: usize,
    /// Pairs of boundary edges that cross in plan: where there are none and all triangles are counter-clockwise, no two
    /// triangles overlap.
    pub overlaps: usize,
    /// A place of the first overlap.
    pub overlap_at: Option<DVec2>,
    /// Boundary edges, directed with the surface on their left, loop by loop.
    pub boundary: Vec<[u32; 2]>,
}

impl Soundness {
    /// Whether the mesh is an oriented manifold with boundary, without degenerate triangles or unused vertices.
    pub fn manifold(&self) -> bool {
        self.turned == 0 && self.repeated_edges == 0 && self.unused == 0
    }
}

/// The directed edges of a mesh, by their start.
pub struct HalfEdges {
    start: Vec<u32>,
    to: Vec<u32>,
}

impl HalfEdges {
    /// Collects the edges of `triangles` over `count` vertices: a counting sort.
    pub fn new(count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut start = vec![0_u32; count + 1];
        for &v in triangles.as_flattened() {
            start[v as usize + 1] += 1;
        }
        for v in 0..count {
            start[v + 1] += start[v];
        }
        let mut next = start.clone();
        let mut to = vec![0_u32; 3 * triangles.len()];
        for t in triangles {
            for i in 0..3 {
                let slot = &mut next[t[i] as usize];
                to[*slot as usize] = t[(i + 1) % 3];
                *slot += 1;
            }
        }
        for v in 0..count {
            to[start[v] as usize..start[v + 1] as usize].sort_unstable();
        }
        Self { start, to }
    }

    /// Ends of the edges that leave `v`, ascending.
    pub fn from(&self, v: u32) -> &[u32] {
        &self.to[self.start[v as usize] as usize..self.start[v as usize + 1] as usize]
    }

    /// Whether a triangle runs from `v` to `w`.
    pub fn has(&self, v: u32, w: u32) -> bool {
        self.from(v).binary_search(&w).is_ok()
    }

    /// Edges without an opposite one, by their start.
    pub fn open(&self) -> Vec<[u32; 2]> {
        let vertices = 0..self.start.len() as u32 - 1;
        vertices.flat_map(|v| self.from(v).iter().filter(move |&&w| !self.has(w, v)).map(move |&w| [v, w])).collect()
    }
}

/// Checks a mesh with the edges `edges`.
pub fn check(points: &[DVec3], triangles: &[[u32; 3]], edges: &HalfEdges) -> Soundness {
    let plan = |v: u32| points[v as usize].truncate();
    let open = edges.open();
    let mut soundness = Soundness {
        turned: triangles.iter().filter(|t| turn(plan(t[0]), plan(t[1]), plan(t[2])) != Turn::Left).count(),
        pinched: open.windows(2).filter(|w| w[0][0] == w[1][0]).count(),
        boundary: loops(&open),
        ..Soundness::default()
    };
    for v in 0..points.len() as u32 {
        let ends = edges.from(v);
        soundness.unused += usize::from(ends.is_empty());
        soundness.repeated_edges += ends.windows(2).filter(|w| w[0] == w[1]).count();
    }
    (soundness.overlaps, soundness.overlap_at) = crossings(points, &soundness.boundary);
    soundness
}

/// The boundary edges in the order of loops.
fn loops(open: &[[u32; 2]]) -> Vec<[u32; 2]> {
    let mut by_start: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
    for e in open.iter().rev() {
        by_start.entry(e[0]).or_default().push(e[1]);
    }
    let mut ordered = Vec::with_capacity(open.len());
    for &[first, _] in open {
        let mut at = first;
        while let Some(to) = by_start.get_mut(&at).and_then(Vec::pop) {
            ordered.push([at, to]);
            at = to;
        }
    }
    ordered
}

/// Pairs of boundary edges that cross, and the place of the first.
fn crossings(points: &[DVec3], boundary: &[[u32; 2]]) -> (usize, Option<DVec2>) {
    let plan = |v: u32| points[v as usize].truncate();
    let ends: Vec<(DVec2, DVec2)> = boundary.iter().map(|e| (plan(e[0]), plan(e[1]))).collect();
    if ends.is_empty() {
        return (0, None);
    }
    let mut count = 0;
    let mut place = None;
    SegmentTree::new(&ends).pairs(|i, j| {
        let ([a, b], [c, d]) = (boundary[i], boundary[j]);
        if [a, b].contains(&c) || [a, b].contains(&d) {
            return true;
        }
        let ((p, q), (r, s)) = (ends[i], ends[j]);
        let across = |a: DVec2, b: DVec2, c: DVec2, d: DVec2| {
            matches!((turn(a, b, c), turn(a, b, d)), (Turn::Left, Turn::Right) | (Turn::Right, Turn::Left))
        };
        if across(p, q, r, s) && across(r, s, p, q) {
            count += 1;
            place.get_or_insert(0.5 * (p + q));
        }
        true
    });
    (count, place)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<DVec3> {
        list.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
    }

    fn checked(points: &[DVec3], triangles: &[[u32; 3]]) -> Soundness {
        check(points, triangles, &HalfEdges::new(points.len(), triangles))
    }

    #[test]
    fn a_square_is_sound() {
        let found = checked(&points(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)]), &[[0, 1, 2], [0, 2, 3]]);
        assert!(found.manifold());
        assert_eq!((found.boundary.len(), found.overlaps, found.pinched), (4, 0, 0));
    }

    #[test]
    fn every_defect_is_counted() {
        let square = points(&[(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0), (9.0, 9.0)]);
        let turned = checked(&square, &[[0, 1, 2], [0, 3, 2]]);
        assert_eq!((turned.turned, turned.unused), (1, 1));
        assert_eq!(checked(&square, &[[0, 1, 2], [0, 1, 3]]).repeated_edges, 1);
        // Two triangles that cross like a star of David.
        let star = points(&[(0.0, 0.0), (4.0, 0.0), (2.0, 3.0), (0.0, 2.0), (2.0, -1.0), (4.0, 2.0)]);
        let crossed = checked(&star, &[[0, 1, 2], [3, 4, 5]]);
        assert_eq!((crossed.turned, crossed.overlaps), (0, 6));
    }
}
