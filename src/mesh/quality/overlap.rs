//! Triangles that lie over each other in plan.
//!
//! Turned up, triangles cover a place as often as their boundary winds around it, however they hang together: edges that run
//! once each way cancel. So where the edges that remain are simple loops that touch nothing and have one layer on their inner
//! side, nothing overlaps, and a sound mesh costs no more than its boundary. Everywhere else all pairs of triangles whose boxes
//! meet are compared, exactly.

use super::faces::{Faces, Facing};
use super::finding::{Collector, Kind};
use super::weld;
use crate::kernel::box_tree::BoxTree;
use crate::kernel::buckets::Buckets;
use crate::kernel::orientation::{Turn, turn};
use crate::kernel::plan_box::PlanBox;
use crate::kernel::segment_tree::SegmentTree;
use glam::DVec2;
use std::cmp::Ordering;

/// Pairs of triangles that are compared before the search is given up: some ten seconds. A sound mesh has about six for each
/// triangle.
const MOST_PAIRS: usize = 1 << 29;

/// Overlapping pairs that are counted.
const MOST_OVERLAPS: usize = 1_000_000;

/// Finds overlapping triangles: those that reach deeper into each other than `hairline`, those that do not, and whether the
/// search was given up before it found any.
pub(super) fn overlaps(faces: &Faces<'_>, hairline: f64, keep: usize) -> [Collector; 3] {
    let [mut deep, mut hair, mut unfinished] =
        [Kind::Overlap, Kind::Hairline, Kind::Unfinished].map(|kind| Collector::new(kind, keep));
    if covered_once(faces) {
        return [deep, hair, unfinished];
    }
    let flat = |f: &usize| matches!(faces.facing[*f], Facing::Up | Facing::Down);
    let boxes: Vec<(u32, PlanBox)> = (0..faces.len()).filter(flat).map(|f| (f as u32, PlanBox::of(faces.plan_up(f)))).collect();
    let mut visits = 0;
    BoxTree::new(&boxes).pairs(|i, j| {
        visits += 1;
        let (first, second) = (i.min(j) as usize, i.max(j) as usize);
        let (p, q) = (faces.plan_up(first), faces.plan_up(second));
        if meet_inside(p, q) {
            let depth = depth(p, q);
            let collector = if depth > hairline { &mut deep } else { &mut hair };
            collector.add(depth, || {
                let at = middle(p, q);
                let [z, other] = [first, second].map(|f| height(faces, f, at));
                let mut place = faces.place(at.extend(z), &[first, second], &[]);
                place.figures = vec![("depth", depth), ("height", other - z)];
                place
            });
        }
        visits < MOST_PAIRS && deep.count + hair.count < MOST_OVERLAPS
    });
    let given_up = visits >= MOST_PAIRS || deep.count + hair.count >= MOST_OVERLAPS;
    (deep.at_least, hair.at_least) = (given_up, given_up);
    if given_up && deep.count == 0 {
        unfinished.add(0.0, || faces.place(faces.centre(0), &[], &[]));
    }
    [deep, hair, unfinished]
}

/// Whether it is plain from the boundary alone that no place is covered twice.
fn covered_once(faces: &Faces<'_>) -> bool {
    let Some(edges) = simple_boundary(faces) else { return false };
    if edges.is_empty() {
        return true;
    }
    // Loop by loop, so that neighbours in the list are neighbours in plan.
    let start: Vec<u32> = edges.iter().map(|e| e[0]).collect();
    let mut next: Vec<usize> = Vec::with_capacity(edges.len());
    for e in &edges {
        let Ok(after) = start.binary_search(&e[1]) else { return false };
        next.push(after);
    }
    let (mut used, mut order, mut begins) = (vec![false; edges.len()], Vec::with_capacity(edges.len()), Vec::new());
    for first in 0..edges.len() {
        if !used[first] {
            begins.push(order.len());
        }
        let mut at = first;
        while !std::mem::replace(&mut used[at], true) {
            order.push(edges[at]);
            at = next[at];
        }
    }
    begins.push(order.len());
    let ends: Vec<(DVec2, DVec2)> = order.iter().map(|e| (faces.plan(e[0]), faces.plan(e[1]))).collect();
    let tree = SegmentTree::new(&ends);
    let mut apart = true;
    tree.pairs(|i, j| {
        apart = match (order[i], order[j]) {
            ([_, a], [b, _]) | ([b, _], [_, a]) if a == b => leave_apart(ends[i], ends[j], order[i][1] == order[j][0]),
            _ => disjoint(ends[i], ends[j]),
        };
        apart
    });
    apart && begins.windows(2).all(|w| layers_inside(&tree, &ends, w[0]..w[1]) == 1)
}

/// Edges of triangles turned up that no other triangle runs the other way, ascending; vertices at the same place in plan are
/// one. `None` if an edge remains twice, or a vertex begins two.
fn simple_boundary(faces: &Faces<'_>) -> Option<Vec<[u32; 2]>> {
    let vertices = faces.subject.vertices;
    let first = weld::first_at_same_place(vertices.len(), |i| weld::in_plan(vertices[i].truncate()));
    let sides = (0..faces.len()).filter(|&f| matches!(faces.facing[f], Facing::Up | Facing::Down)).flat_map(|f| {
        let [a, b, c] = faces.corners[f].map(|v| first[v as usize]);
        let up = faces.facing[f] == Facing::Up;
        [(a, b), (b, c), (c, a)].map(|(v, w)| (v.min(w), v.max(w), (v < w) == up))
    });
    let mut entries = Buckets::new(vertices.len(), sides.map(|(lo, hi, forward)| (lo, u64::from(hi) << 1 | u64::from(forward))));
    let mut edges = Vec::new();
    for (bucket, lo) in entries.each_mut().zip(0..) {
        bucket.sort_unstable();
        for run in bucket.chunk_by(|a, b| a >> 1 == b >> 1) {
            let forward = run.iter().filter(|&&entry| entry & 1 == 1).count();
            let hi = (run[0] >> 1) as u32;
            match (forward, run.len() - forward) {
                (f, b) if f == b => {}
                (f, b) if f == b + 1 => edges.push([lo, hi]),
                (f, b) if f + 1 == b => edges.push([hi, lo]),
                _ => return None,
            }
        }
    }
    edges.sort_unstable();
    edges.windows(2).all(|w| w[0][0] != w[1][0]).then_some(edges)
}

/// Whether two edges of which one begins where the other ends have nothing else in common.
fn leave_apart(p: (DVec2, DVec2), q: (DVec2, DVec2), p_first: bool) -> bool {
    let ((a, b), (_, c)) = if p_first { (p, q) } else { (q, p) };
    turn(a, b, c) != Turn::Straight || (b - a).dot(c - b) > 0.0
}

/// Whether two edges do not even touch; exact, but edges on one line count as touching.
fn disjoint((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> bool {
    let one_side = |s: Turn, t: Turn| s == t && s != Turn::Straight;
    one_side(turn(a, b, c), turn(a, b, d)) || one_side(turn(c, d, a), turn(c, d, b))
}

/// How many layers lie just left of a loop that touches no other.
fn layers_inside(tree: &SegmentTree, ends: &[(DVec2, DVec2)], range: std::ops::Range<usize>) -> i32 {
    let rise = |i: &usize| (ends[*i].1.y - ends[*i].0.y).abs();
    let Some(edge) = range.max_by(|i, j| rise(i).total_cmp(&rise(j))) else { return 0 };
    let (a, b) = ends[edge];
    let p = 0.5 * a + 0.5 * b;
    // Just left of a rising edge a ray to the right crosses that edge too; left of a falling one it does not.
    let mut winding = i32::from(b.y > a.y);
    tree.ray(p, |i| {
        let (c, d) = ends[i];
        if i != edge {
            winding += i32::from(c.y <= p.y && p.y < d.y && turn(c, d, p) == Turn::Left);
            winding -= i32::from(d.y <= p.y && p.y < c.y && turn(c, d, p) == Turn::Right);
        }
    });
    winding
}

/// Whether the insides of two counter-clockwise triangles meet: no edge of either has the other on its outer side. Exact.
fn meet_inside(p: [DVec2; 3], q: [DVec2; 3]) -> bool {
    let parts =
        |p: [DVec2; 3], q: [DVec2; 3]| (0..3).any(|i| q.iter().all(|&corner| turn(p[i], p[(i + 1) % 3], corner) != Turn::Left));
    !parts(p, q) && !parts(q, p)
}

/// How far one triangle would have to be moved across an edge to set the two apart, at most.
fn depth(p: [DVec2; 3], q: [DVec2; 3]) -> f64 {
    let reach = |p: [DVec2; 3], q: [DVec2; 3]| {
        (0..3).map(move |i| {
            let (a, d) = (p[i], (p[(i + 1) % 3] - p[i]).normalize_or_zero());
            q.iter().map(|&corner| d.perp_dot(corner - a)).fold(0.0, f64::max)
        })
    };
    reach(p, q).chain(reach(q, p)).fold(f64::INFINITY, f64::min)
}

/// A point of what two triangles have in common: the centre of its corners.
fn middle(p: [DVec2; 3], q: [DVec2; 3]) -> DVec2 {
    let mut common = p.to_vec();
    for i in 0..3 {
        let (a, d) = (q[i], q[(i + 1) % 3] - q[i]);
        let side = |r: DVec2| d.perp_dot(r - a);
        let mut cut = Vec::with_capacity(common.len() + 1);
        for (k, &r) in common.iter().enumerate() {
            let s = common[(k + 1) % common.len()];
            let (from, to) = (side(r), side(s));
            if from >= 0.0 {
                cut.push(r);
            }
            if from.partial_cmp(&0.0) != to.partial_cmp(&0.0) && from != 0.0 && to.total_cmp(&0.0) != Ordering::Equal {
                cut.push(r + (s - r) * (from / (from - to)));
            }
        }
        common = cut;
    }
    // Rounding may leave nothing of a hair.
    let corners = if common.is_empty() { &p[..] } else { &common[..] };
    corners.iter().sum::<DVec2>() / corners.len() as f64
}

/// Height of the plane of a triangle.
fn height(faces: &Faces<'_>, f: usize, at: DVec2) -> f64 {
    let [a, b, c] = faces.points(f);
    let normal = (b - a).cross(c - a);
    let d = at - a.truncate();
    let z = a.z - normal.truncate().dot(d) / normal.z;
    // Next to upright, the plane may run far off; within the triangle it cannot.
    z.clamp(a.z.min(b.z).min(c.z), a.z.max(b.z).max(c.z))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn insides_meet_or_not() {
        let triangle = |x: f64, y: f64, s: f64| [DVec2::new(x, y), DVec2::new(x + s, y), DVec2::new(x, y + s)];
        let big = triangle(0.0, 0.0, 4.0);
        assert!(meet_inside(big, triangle(1.0, 1.0, 1.0)) && meet_inside(triangle(1.0, 1.0, 1.0), big) && meet_inside(big, big));
        // Corner to corner, edge on edge, corner on edge.
        for (x, y) in [(4.0, 0.0), (2.0, 2.0), (-1.0, 0.5), (0.0, 4.0), (1.0, -1.0)] {
            assert!(!meet_inside(big, triangle(x, y, 1.0)), "{x} {y}");
        }
        // By one unit in the last place.
        assert!(meet_inside(big, triangle(2.0f64.next_down(), 2.0, 1.0)));
        assert!(depth(big, triangle(-0.75, 1.0, 1.0)) == 0.25);
        let at = middle(big, triangle(-0.75, 1.0, 1.0));
        assert!(at.x > 0.0 && at.x < 0.25 && at.y > 1.0 && at.y < 1.25, "{at}");
    }
}
