//! Heights of a mesh under points and along straight lines in plan: profiles and sections for drawings and setting out.
//!
//! Decided in floating point: a point within rounding of an edge may be given to either side, where both have the same height.
//! Volumes do not come from here.

use crate::kernel::box_tree::BoxTree;
use crate::kernel::plan_box::PlanBox;
use glam::{DVec2, DVec3};

/// Gaps along a line up to this, in the length unit, are rounding.
const GAP: f64 = 1e-6;

/// A point this far outside a triangle, as a share of its size, is on its edge.
const ON_EDGE: f64 = 1e-12;

/// Stretches a line is looked up in: more of them, fewer triangles beside the line are looked at.
const STRETCHES: usize = 64;

/// A mesh that can be asked for its heights. Triangles are counter-clockwise in plan and do not overlap.
#[derive(Debug)]
pub struct Drape<'a> {
    vertices: &'a [DVec3],
    triangles: &'a [[u32; 3]],
    tree: BoxTree,
}

/// Where a line in plan lies over a mesh without a gap.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Run {
    /// Distance along the line and height, at both ends and wherever an edge is crossed; distances ascend.
    pub points: Vec<DVec2>,
    /// The triangle below each stretch between points, one fewer than there are points.
    pub triangles: Vec<u32>,
}

impl Run {
    /// Height at a distance along the line, if the run is there.
    pub fn height(&self, at: f64) -> Option<f64> {
        let next = self.points.partition_point(|p| p.x < at).max(1);
        let (a, b) = (self.points.get(next - 1)?, self.points.get(next)?);
        let inside = (a.x..=b.x).contains(&at);
        inside.then(|| if b.x > a.x { a.y + (b.y - a.y) * (at - a.x) / (b.x - a.x) } else { a.y })
    }
}

impl<'a> Drape<'a> {
    /// Makes a mesh ready to be asked; with `within` only its triangles that meet this box.
    pub fn new(vertices: &'a [DVec3], triangles: &'a [[u32; 3]], within: Option<PlanBox>) -> Self {
        let boxed = |t: &[u32; 3]| PlanBox::of(t.map(|v| vertices[v as usize].truncate()));
        let wanted = |bounds: &PlanBox| within.is_none_or(|within| bounds.meets(&within));
        let boxes: Vec<_> = triangles.iter().zip(0..).map(|(t, i)| (i, boxed(t))).filter(|(_, b)| wanted(b)).collect();
        Self { vertices, triangles, tree: BoxTree::new(&boxes) }
    }

    fn corners(&self, t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| self.vertices[v as usize])
    }

    /// Height under a point, with the triangle; `None` beside the mesh. On an edge the triangle of the lowest number.
    pub fn at(&self, p: DVec2) -> Option<(f64, u32)> {
        let mut found: Option<u32> = None;
        self.tree.meeting(&PlanBox::of([p]), |t| {
            if found.is_none_or(|f| t < f) && holds(&self.corners(t), p) {
                found = Some(t);
            }
        });
        found.map(|t| (height(&self.corners(t), p), t))
    }

    /// Heights along the straight line between two points in plan. Where it runs along edges, the triangle of the lower number
    /// speaks for both.
    pub fn along(&self, from: DVec2, to: DVec2) -> Vec<Run> {
        let length = from.distance(to);
        if length <= 0.0 || !length.is_finite() {
            return Vec::new();
        }
        let mut near = Vec::new();
        for i in 0..STRETCHES {
            let point = |i: usize| from.lerp(to, i as f64 / STRETCHES as f64);
            let (a, b) = (point(i), point(i + 1));
            self.tree.meeting(&PlanBox::of([a, b]), |t| near.push(t));
        }
        near.sort_unstable();
        near.dedup();
        let along = (to - from) / length;
        let crossed = |t: u32| {
            let (a, b) = self.crossing(t, from, along, length)?;
            Some((a, b, t))
        };
        let mut pieces: Vec<(f64, f64, u32)> = near.into_iter().filter_map(crossed).collect();
        pieces.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.2.cmp(&q.2)));
        let mut runs: Vec<Run> = Vec::new();
        let mut end = f64::NEG_INFINITY;
        for (a, b, t) in pieces {
            // Along an edge the line crosses the triangles on both sides of it.
            if b <= end + GAP && b - a > GAP || b <= end {
                continue;
            }
            let corners = self.corners(t);
            let point = |s: f64| DVec2::new(s, height(&corners, from + along * s));
            match runs.last_mut() {
                Some(run) if a <= end + GAP => {
                    run.points.push(point(b));
                    run.triangles.push(t);
                }
                _ => runs.push(Run { points: vec![point(a), point(b)], triangles: vec![t] }),
            }
            end = b;
        }
        runs
    }

    /// Where a ray from `from` crosses a triangle, as distances from its beginning up to `length`.
    ///
    /// Edges are taken from the lower vertex number to the higher, so that triangles on both sides of one agree to the last bit on
    /// where it is crossed, also at a grazing angle.
    fn crossing(&self, t: u32, from: DVec2, along: DVec2, length: f64) -> Option<(f64, f64)> {
        let corners = self.triangles[t as usize];
        let (mut lo, mut hi) = (0.0_f64, length);
        for i in 0..3 {
            let (v, w) = (corners[i], corners[(i + 1) % 3]);
            let [a, b] = [v.min(w), v.max(w)].map(|v| self.vertices[v as usize].truncate());
            let edge = b - a;
            let sign = if v < w { 1.0 } else { -1.0 };
            // Left of the edge: side + s·rate ≥ 0.
            let (side, rate) = (sign * edge.perp_dot(from - a), sign * edge.perp_dot(along));
            let tie = ON_EDGE * edge.length() * (edge.length() + (from - a).length());
            if rate.abs() * length <= tie {
                if side < -tie {
                    return None;
                }
            } else if rate > 0.0 {
                lo = lo.max(-side / rate);
            } else {
                hi = hi.min(-side / rate);
            }
        }
        (hi > lo).then_some((lo, hi))
    }
}

/// Whether a triangle holds a point, its edges included.
fn holds([a, b, c]: &[DVec3; 3], p: DVec2) -> bool {
    let [a, b, c] = [a, b, c].map(|v| v.truncate());
    let size = (b - a).length_squared().max((c - b).length_squared()).max((a - c).length_squared());
    let left = |p: DVec2, q: DVec2, r: DVec2| (q - p).perp_dot(r - p) >= -ON_EDGE * size;
    left(a, b, p) && left(b, c, p) && left(c, a, p)
}

/// Height of the plane of a triangle.
fn height([a, b, c]: &[DVec3; 3], p: DVec2) -> f64 {
    let (u, v, w) = ((*b - *a).truncate(), (*c - *a).truncate(), p - a.truncate());
    let det = u.perp_dot(v);
    a.z + (w.perp_dot(v) * (b.z - a.z) + u.perp_dot(w) * (c.z - a.z)) / det
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A grid of `n` by `n` cells on the plane z = 2x − 3y + 5, each cut in two.
    fn plane(n: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let at = |i: u32, j: u32| DVec3::new(i.into(), j.into(), 2.0 * f64::from(i) - 3.0 * f64::from(j) + 5.0);
        let vertices = (0..=n).flat_map(|j| (0..=n).map(move |i| at(i, j))).collect();
        let cell = |i: u32, j: u32| {
            let a = j * (n + 1) + i;
            [[a, a + 1, a + n + 2], [a, a + n + 2, a + n + 1]]
        };
        (vertices, (0..n).flat_map(|j| (0..n).flat_map(move |i| cell(i, j))).collect())
    }

    proptest! {
        #[test]
        fn along_a_plane_heights_are_those_of_the_plane(ends in prop::array::uniform4(0.0..8.0_f64)) {
            let (vertices, triangles) = plane(8);
            let drape = Drape::new(&vertices, &triangles, None);
            let (from, to) = (DVec2::new(ends[0], ends[1]), DVec2::new(ends[2], ends[3]));
            let length = from.distance(to);
            prop_assume!(length > 1e-3);
            let runs = drape.along(from, to);
            prop_assert_eq!(runs.len(), 1);
            let run = &runs[0];
            prop_assert!((run.points[0].x).abs() < 1e-9 && (run.points[run.points.len() - 1].x - length).abs() < 1e-9);
            prop_assert_eq!(run.triangles.len() + 1, run.points.len());
            for p in &run.points {
                let at = from.lerp(to, p.x / length);
                prop_assert!((p.y - (2.0 * at.x - 3.0 * at.y + 5.0)).abs() < 1e-9);
                prop_assert!((drape.at(at.clamp(DVec2::ZERO, DVec2::splat(8.0))).unwrap().0 - p.y).abs() < 1e-6);
            }
            prop_assert!(run.points.windows(2).all(|w| w[0].x <= w[1].x));
            // As many stretches as there are triangles met by 10 000 points of the line, or more (short ones are missed).
            let mut met: Vec<u32> = (1..10_000).map(|i| drape.at(from.lerp(to, f64::from(i) / 1e4)).unwrap().1).collect();
            met.dedup();
            prop_assert!(run.triangles.len() + 1 >= met.len());
        }
    }

    #[test]
    fn lines_along_edges_and_over_holes() {
        let (vertices, mut triangles) = plane(4);
        let along_edge = Drape::new(&vertices, &triangles, None).along(DVec2::new(-1.0, 2.0), DVec2::new(6.0, 2.0));
        assert_eq!(along_edge.len(), 1);
        let run = &along_edge[0];
        assert_eq!((run.points[0].x, run.points[run.points.len() - 1].x), (1.0, 5.0));
        assert_eq!(run.triangles.len(), 4);
        assert_eq!(run.height(3.5), Some(2.0 * 2.5 - 6.0 + 5.0));
        assert_eq!(run.height(5.5), None);
        // Without the cells of the second column there are two runs.
        triangles.retain(|t| t.iter().map(|v| f64::from(v % 5)).sum::<f64>() / 3.0 < 1.0 || t.iter().all(|v| v % 5 >= 2));
        let drape = Drape::new(&vertices, &triangles, None);
        let runs = drape.along(DVec2::new(0.0, 1.3), DVec2::new(4.0, 1.3));
        assert_eq!(
            runs.iter().map(|r| (r.points[0].x, r.points[r.points.len() - 1].x)).collect::<Vec<_>>(),
            [(0.0, 1.0), (2.0, 4.0)]
        );
        assert_eq!(drape.at(DVec2::new(1.5, 1.5)), None);
        assert_eq!(drape.along(DVec2::ONE, DVec2::ONE), []);
    }
}
