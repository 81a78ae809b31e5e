//! Whether triangles form a surface: every defect counted on the mesh itself.

use crate::kernel::buckets::Buckets;
use crate::kernel::orientation::{Turn, turn};
use crate::kernel::segment_tree::SegmentTree;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
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
    /// Places where boundary edges cross in plan, or else loops of the boundary inside which the mesh lies on itself: where
    /// there are none and all triangles are counter-clockwise, no two triangles overlap.
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
pub struct HalfEdges(Buckets<u32>);

impl HalfEdges {
    /// Collects the edges of `triangles` over `count` vertices.
    pub fn new(count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut edges = Buckets::new(count, triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]));
        edges.sort_each(u32::cmp);
        Self(edges)
    }

    /// Ends of the edges that leave `v`, ascending.
    pub fn from(&self, v: u32) -> &[u32] {
        self.0.of(v)
    }

    /// Whether a triangle runs from `v` to `w`.
    pub fn has(&self, v: u32, w: u32) -> bool {
        self.from(v).binary_search(&w).is_ok()
    }

    /// Edges without an opposite one, by their start.
    pub fn open(&self) -> Vec<[u32; 2]> {
        let vertices = (0..self.0.count() as u32).into_par_iter();
        vertices.flat_map_iter(|v| self.from(v).iter().filter(move |&&w| !self.has(w, v)).map(move |&w| [v, w])).collect()
    }
}

/// The triangle of each of the open edges `open` of a mesh.
pub fn owners(open: &[[u32; 2]], vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut on_border = vec![false; vertices];
    open.as_flattened().iter().for_each(|&v| on_border[v as usize] = true);
    let number: FxHashMap<[u32; 2], usize> = open.iter().zip(0..).map(|(edge, i)| (*edge, i)).collect();
    let mut owners = vec![0; open.len()];
    for (t, corners) in triangles.iter().enumerate() {
        let border = corners.map(|v| on_border[v as usize]);
        for i in 0..3 {
            let next = (i + 1) % 3;
            if border[i]
                && border[next]
                && let Some(&edge) = number.get(&[corners[i], corners[next]])
            {
                owners[edge] = t as u32;
            }
        }
    }
    owners
}

/// Checks a mesh with the edges `edges`.
pub fn check(points: &[DVec3], triangles: &[[u32; 3]], edges: &HalfEdges) -> Soundness {
    check_with(points, triangles, edges, &edges.open())
}

/// The same where the open edges are known.
pub fn check_with(points: &[DVec3], triangles: &[[u32; 3]], edges: &HalfEdges, open: &[[u32; 2]]) -> Soundness {
    let plan = |v: u32| points[v as usize].truncate();
    let mut soundness = Soundness {
        turned: triangles.par_iter().filter(|t| turn(plan(t[0]), plan(t[1]), plan(t[2])) != Turn::Left).count(),
        pinched: open.windows(2).filter(|w| w[0][0] == w[1][0]).count(),
        boundary: loops(open),
        ..Soundness::default()
    };
    let vertices = (0..points.len() as u32).into_par_iter();
    soundness.unused = vertices.clone().filter(|&v| edges.from(v).is_empty()).count();
    soundness.repeated_edges = vertices.map(|v| edges.from(v).windows(2).filter(|w| w[0] == w[1]).count()).sum();
    let overlaps = Overlaps::new(points, &soundness.boundary);
    (soundness.overlaps, soundness.overlap_at) = overlaps.count();
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

/// The boundary in plan, to find out whether the mesh lies on itself.
struct Overlaps<'a> {
    boundary: &'a [[u32; 2]],
    ends: Vec<(DVec2, DVec2)>,
}

impl<'a> Overlaps<'a> {
    fn new(points: &[DVec3], boundary: &'a [[u32; 2]]) -> Self {
        let plan = |v: u32| points[v as usize].truncate();
        Self { boundary, ends: boundary.iter().map(|e| (plan(e[0]), plan(e[1]))).collect() }
    }

    /// Pairs of boundary edges that cross; where none do, loops with anything but one layer on their inner side. And the place
    /// of the first.
    fn count(&self) -> (usize, Option<DVec2>) {
        if self.ends.is_empty() {
            return (0, None);
        }
        let tree = SegmentTree::new(&self.ends);
        let crossings = self.crossings(&tree);
        if crossings.0 > 0 { crossings } else { self.layers(&tree) }
    }

    fn crossings(&self, tree: &SegmentTree) -> (usize, Option<DVec2>) {
        let mut count = 0;
        let mut place = None;
        let mut before = vec![0; self.boundary.len()];
        for range in self.loops() {
            before[range.start] = range.end - 1;
            range.skip(1).for_each(|i| before[i] = i - 1);
        }
        tree.pairs(|i, j| {
            let ([a, b], [c, d]) = (self.boundary[i], self.boundary[j]);
            if [a, b].contains(&c) || [a, b].contains(&d) {
                return true;
            }
            let ((p, q), (r, s)) = (self.ends[i], self.ends[j]);
            let across = |a: DVec2, b: DVec2, c: DVec2, d: DVec2| {
                matches!((turn(a, b, c), turn(a, b, d)), (Turn::Left, Turn::Right) | (Turn::Right, Turn::Left))
            };
            let through = || self.passes_through(i, j, &before) || self.passes_through(j, i, &before);
            if across(p, q, r, s) && across(r, s, p, q) || through() {
                count += 1;
                place.get_or_insert(0.5 * (p + q));
            }
            true
        });
        (count, place)
    }

    /// Whether the boundary passes through edge `j`, or a corner that begins with it, at the start of edge `i`; `before` tells the
    /// edge that comes before each one.
    fn passes_through(&self, i: usize, j: usize, before: &[usize]) -> bool {
        let ((at, to), (c, d)) = (self.ends[i], self.ends[j]);
        let from = self.ends[before[i]].0;
        // The corner that it goes through: flat, within the edge.
        let corner = if at == c {
            self.ends[before[j]].0
        } else if at != d && turn(c, d, at) == Turn::Straight && (at - c).dot(at - d) < 0.0 {
            c
        } else {
            return false;
        };
        let side = |p: DVec2| {
            let (first, second) = (turn(corner, at, p), turn(at, d, p));
            match (turn(corner, at, d), first, second) {
                (_, Turn::Straight, _) | (_, _, Turn::Straight) => Turn::Straight,
                (Turn::Right, Turn::Right, Turn::Right) => Turn::Right,
                (Turn::Right, ..) => Turn::Left,
                (_, Turn::Left, Turn::Left) => Turn::Left,
                _ => Turn::Right,
            }
        };
        matches!((side(from), side(to)), (Turn::Left, Turn::Right) | (Turn::Right, Turn::Left))
    }

    /// Loops whose inner side does not have winding number one: a triangle mesh covers a place as often as its boundary winds
    /// around it. Slivers may be narrower than coordinates can tell apart, so the place is not computed, see [`Self::right_of`].
    fn layers(&self, tree: &SegmentTree) -> (usize, Option<DVec2>) {
        let mut count = 0;
        let mut place = None;
        for range in self.loops() {
            let height = |i: &usize| (self.ends[*i].1.y - self.ends[*i].0.y).abs();
            let Some(edge) = range.max_by(|i, j| height(i).total_cmp(&height(j))) else { continue };
            let (a, b) = self.ends[edge];
            let mut winding = 0;
            tree.ray(a, |i| winding += self.right_of(i, edge));
            if winding != 1 {
                count += 1;
                place.get_or_insert(0.5 * (a + b));
            }
        }
        (count, place)
    }

    /// How edge `i` winds around the place just left of the start of `edge`, which is not level: 1 where it rises to the right of
    /// that place, −1 where it falls there. Exact: the place is the start, moved along the edge by next to nothing, and then to
    /// the left by next to nothing of that.
    fn right_of(&self, i: usize, edge: usize) -> i32 {
        let ((c, d), (a, b)) = (self.ends[i], self.ends[edge]);
        let up = b.y > a.y;
        let passes = |low: DVec2, high: DVec2| if up { low.y <= a.y && a.y < high.y } else { low.y < a.y && a.y <= high.y };
        let side = || match (turn(c, d, a), turn(c, d, b)) {
            (Turn::Straight, Turn::Straight) if (d.y > c.y) == up => Turn::Left,
            (Turn::Straight, Turn::Straight) => Turn::Right,
            (Turn::Straight, of_end) => of_end,
            (of_start, _) => of_start,
        };
        if passes(c, d) && side() == Turn::Left {
            1
        } else if passes(d, c) && side() == Turn::Right {
            -1
        } else {
            0
        }
    }

    /// Index ranges of the loops.
    fn loops(&self) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let breaks: Vec<usize> = (0..self.boundary.len())
            .filter(|&i| i == 0 || self.boundary[i - 1][1] != self.boundary[i][0])
            .chain([self.boundary.len()])
            .collect();
        (0..breaks.len() - 1).map(move |i| breaks[i]..breaks[i + 1])
    }
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

    /// A triangle whose corner lies on the side of another one, and reaches in or stays outside; corner on corner likewise.
    #[test]
    fn corners_that_pass_through_are_seen() {
        let first = [(0.0, 0.0), (8.0, 0.0), (8.0, 8.0), (0.0, 8.0)];
        let with = |others: &[(f64, f64)], triangles: &[[u32; 3]]| {
            let all: Vec<(f64, f64)> = first.iter().chain(others).copied().collect();
            checked(&points(&all), &[&[[0, 1, 2], [0, 2, 3]], triangles].concat()).overlaps
        };
        // A strip across the side x = 8 whose vertices stand on it.
        let strip = [(9.0, 2.0), (9.0, 4.0), (6.0, 4.0), (6.0, 2.0), (8.0, 4.0), (8.0, 2.0)];
        assert_eq!(with(&strip, &[[9, 4, 5], [9, 5, 8], [7, 9, 8], [7, 8, 6]]), 2);
        // In through a corner, and out through the side.
        assert_eq!(with(&[(8.0, 8.0), (7.0, 5.0), (8.0, 4.0), (9.0, 6.0)], &[[4, 5, 6], [4, 6, 7]]), 2);
        // Corner to corner and corner to side from outside.
        assert_eq!(with(&[(8.0, 8.0), (9.0, 8.5), (8.5, 9.0)], &[[4, 5, 6]]), 0);
        assert_eq!(with(&[(8.0, 4.0), (9.0, 3.0), (9.0, 5.0)], &[[4, 5, 6]]), 0);
    }

    #[test]
    fn a_piece_above_another_is_seen() {
        // A small triangle over a large one, and beside it.
        let over = points(&[(0.0, 0.0), (9.0, 0.0), (0.0, 9.0), (1.0, 1.0), (2.0, 1.0), (1.0, 2.0)]);
        assert_eq!(checked(&over, &[[0, 1, 2], [3, 4, 5]]).overlaps, 1);
        let beside = points(&[(0.0, 0.0), (9.0, 0.0), (0.0, 9.0), (11.0, 1.0), (12.0, 1.0), (11.0, 2.0)]);
        assert_eq!(checked(&beside, &[[0, 1, 2], [3, 4, 5]]).overlaps, 0);
    }

    /// Slivers on both sides of a line, as narrow as they come: the middle of their long sides, as far as it can be computed, lies
    /// beside them.
    #[test]
    fn slivers_have_one_layer() {
        for e in 0..40 {
            let (x, y) = (-41.344373535166135 + f64::from(e), 6.344373535166139);
            let (dx, dy) = (0.9583596_f64, 2.0646259_f64);
            let middle = DVec2::new(x + 0.9 * dx, y + 0.9 * dy);
            for k in -3..=3 {
                let off = DVec2::new(middle.x + f64::from(k) * f64::EPSILON * 32.0, middle.y);
                let ends = [(x, y), (off.x, off.y), (x + dx, y + dy)];
                let plan = ends.map(DVec2::from);
                let sliver = match turn(plan[0], plan[1], plan[2]) {
                    Turn::Left => [0, 1, 2],
                    Turn::Right => [0, 2, 1],
                    Turn::Straight => continue,
                };
                assert_eq!(checked(&points(&ends), &[sliver]).overlaps, 0, "{ends:?}");
                let turned = [sliver[0], sliver[2], sliver[1]];
                assert_eq!(checked(&points(&ends), &[turned]).overlaps, 1, "{ends:?}");
            }
        }
    }

    /// Pieces that share stretches of their boundary without sharing vertices there; the same twice.
    #[test]
    fn pieces_along_each_other() {
        let beside = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (4.0, 1.0), (4.0, 3.0), (7.0, 2.0)];
        assert_eq!(checked(&points(&beside), &[[0, 1, 2], [3, 5, 4]]).overlaps, 0);
        let over = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (4.0, 1.0), (4.0, 3.0), (3.0, 2.0)];
        assert_eq!(checked(&points(&over), &[[0, 1, 2], [3, 4, 5]]).overlaps, 1);
        let twice = [(0.0, 0.0), (4.0, 1.0), (2.0, 4.0), (0.0, 0.0), (4.0, 1.0), (2.0, 4.0)];
        assert!(checked(&points(&twice), &[[0, 1, 2], [3, 4, 5]]).overlaps > 0);
    }

    #[test]
    fn a_ring_has_one_layer() {
        let ring = points(&[(0.0, 0.0), (9.0, 0.0), (0.0, 9.0), (1.0, 1.0), (2.0, 1.0), (1.0, 2.0)]);
        let triangles = [[0, 1, 4], [0, 4, 3], [1, 2, 5], [1, 5, 4], [2, 0, 3], [2, 3, 5]];
        let found = checked(&ring, &triangles);
        assert_eq!((found.turned, found.overlaps, found.boundary.len()), (0, 0, 6));
    }
}
