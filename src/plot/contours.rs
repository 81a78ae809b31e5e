//! Contours of the existing ground.

use super::lines::Stroke;
use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;
use glam::{DVec2, DVec3};

/// Lines of equal height on the triangles that meet a plan box, for ascending levels; of each level its lines. A height at a
/// level counts as above it, so that no contour branches. The higher ground lies on the left.
pub(super) fn contours(vertices: &[DVec3], triangles: &[[u32; 3]], within: PlanBox, levels: &[f64]) -> Vec<Vec<Stroke>> {
    // Each crossing is named by the edge it lies on: lesser and greater vertex.
    let name = |a: u32, b: u32| (a.min(b), a.max(b));
    let mut segments: Vec<Vec<Segment>> = vec![Vec::new(); levels.len()];
    for t in near(vertices, triangles, within) {
        let corners = t.map(|v| vertices[v as usize].z);
        let (low, high) = range(corners);
        let first = levels.partition_point(|level| *level <= low);
        for (level, found) in levels.iter().zip(&mut segments).skip(first).take_while(|(level, _)| **level <= high) {
            let (mut from, mut to) = (None, None);
            for i in 0..3 {
                let j = (i + 1) % 3;
                match (corners[i] >= *level, corners[j] >= *level) {
                    (true, false) => from = Some(name(t[i], t[j])),
                    (false, true) => to = Some(name(t[i], t[j])),
                    _ => {}
                }
            }
            // Corners run counter-clockwise: the contour follows where an edge leaves the higher ground.
            found.extend(from.zip(to).map(|(from, to)| Segment { from, to }));
        }
    }
    let place = |edge: Edge, level: f64| {
        let (a, b) = (vertices[edge.0 as usize], vertices[edge.1 as usize]);
        a.truncate().lerp(b.truncate(), (level - a.z) / (b.z - a.z))
    };
    segments.into_iter().zip(levels).map(|(found, level)| chained(found, |edge| place(edge, *level))).collect()
}

type Edge = (u32, u32);

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
struct Segment {
    from: Edge,
    to: Edge,
}

/// Triangles that meet a plan box.
fn near<'a>(vertices: &'a [DVec3], triangles: &'a [[u32; 3]], within: PlanBox) -> impl Iterator<Item = [u32; 3]> + use<'a> {
    let meets = move |t: &[u32; 3]| PlanBox::of(t.map(|v| vertices[v as usize].truncate())).meets(&within);
    triangles.iter().copied().filter(meets)
}

/// Lowest and highest ground of the triangles that meet a plan box.
pub(super) fn heights(vertices: &[DVec3], triangles: &[[u32; 3]], within: PlanBox) -> Option<(f64, f64)> {
    let (low, high) = range(near(vertices, triangles, within).flatten().map(|v| vertices[v as usize].z));
    (low <= high).then_some((low, high))
}

/// Lines from segments; each edge begins one segment at most, and ends one.
fn chained(mut segments: Vec<Segment>, place: impl Fn(Edge) -> DVec2) -> Vec<Stroke> {
    segments.sort_unstable();
    segments.dedup_by_key(|segment| segment.from);
    let mut ends: Vec<Edge> = segments.iter().map(|segment| segment.to).collect();
    ends.sort_unstable();
    let begins = |segment: &Segment| ends.binary_search(&segment.from).is_err();
    // Open lines first, from their beginnings; what is left are rings.
    let (open, rings): (Vec<usize>, Vec<usize>) = (0..segments.len()).partition(|i| begins(&segments[*i]));
    let mut used = vec![false; segments.len()];
    let mut strokes = Vec::new();
    for first in open.into_iter().chain(rings) {
        if used[first] {
            continue;
        }
        let mut points = Vec::new();
        let mut at = first;
        let closed = loop {
            used[at] = true;
            points.push(place(segments[at].from));
            let end = segments[at].to;
            if end == segments[first].from {
                break true;
            }
            match segments.binary_search_by_key(&end, |segment| segment.from).ok().filter(|next| !used[*next]) {
                Some(next) => at = next,
                None => {
                    points.push(place(end));
                    break false;
                }
            }
        };
        strokes.push(Stroke { points, closed });
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A cone of height 10 − r over a grid: contours are closed, near circles of radius 10 − z, and one at each level.
    #[test]
    fn contours_of_a_cone() {
        let n: u32 = 40;
        let at = |i: u32, j: u32| {
            let p = DVec2::new(f64::from(i), f64::from(j)) * 0.5 - DVec2::splat(10.0);
            p.extend(10.0 - p.length())
        };
        let vertices: Vec<DVec3> = (0..=n).flat_map(|j| (0..=n).map(move |i| at(i, j))).collect();
        let index = |i: u32, j: u32| j * (n + 1) + i;
        let square = |i, j| {
            let q = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
            [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
        };
        let triangles: Vec<[u32; 3]> = (0..n).flat_map(|j| (0..n).flat_map(move |i| square(i, j))).collect();
        let everywhere = PlanBox { lo: DVec2::splat(-20.0), hi: DVec2::splat(20.0) };
        assert_eq!(heights(&vertices, &triangles, everywhere).unwrap().1, 10.0);
        for (lines, z) in contours(&vertices, &triangles, everywhere, &[2.0, 5.0, 8.0]).into_iter().zip([2.0, 5.0, 8.0]) {
            assert!(lines.len() == 1 && lines[0].closed, "{z}: {}", lines.len());
            assert!(lines[0].points.iter().all(|p| (p.length() - (10.0 - z)).abs() < 0.05));
            let points = &lines[0].points;
            let area: f64 = (0..points.len()).map(|i| 0.5 * points[i].perp_dot(points[(i + 1) % points.len()])).sum();
            assert!(area > 0.0, "the higher ground lies on the left");
        }
        // At the edge of the grid lines end.
        let low = contours(&vertices, &triangles, everywhere, &[-2.0]);
        assert_eq!((low[0].len(), low[0].iter().filter(|s| s.closed).count()), (4, 0));
    }
}
