//! Where triangles meet without being joined: T-junctions and cracks.

use super::edges::{Edges, Open};
use super::faces::Faces;
use super::finding::{Collector, Kind};
use crate::kernel::orientation::{Turn, turn};
use crate::kernel::segment_tree::SegmentTree;
use crate::kernel::union::Union;
use glam::DVec2;
use rustc_hash::FxHashMap;

/// Pairs of a vertex and an edge, or of two vertices, that are looked at before the search is given up: some seconds.
const MOST_PAIRS: usize = 1 << 25;

/// Finds seams that are not joined; `order` has the open edges in the order of loops.
pub(super) fn seams(faces: &Faces<'_>, edges: &Edges, order: &[usize], gap: f64, keep: usize) -> [Collector; 3] {
    let mut unfinished = Collector::new(Kind::Unfinished, keep);
    let junctions = t_junctions(faces, edges, order, gap, keep, &mut unfinished);
    let cracks = cracks(faces, edges, gap, keep, &mut unfinished);
    [junctions, cracks, unfinished]
}

/// Vertices of the boundary within `gap` of a boundary edge in plan, but further than that from its ends.
fn t_junctions(
    faces: &Faces<'_>,
    edges: &Edges,
    order: &[usize],
    gap: f64,
    keep: usize,
    unfinished: &mut Collector,
) -> Collector {
    let mut found = Collector::new(Kind::TJunction, keep);
    if order.is_empty() {
        return found;
    }
    let open: Vec<Open> = order.iter().map(|&i| edges.open[i]).collect();
    let ends: Vec<(DVec2, DVec2)> = open.iter().map(|e| (faces.plan(e.from), faces.plan(e.to))).collect();
    let tree = SegmentTree::new(&ends);
    let mut visits = 0;
    // Each vertex of the boundary begins an edge, save where a loop does not close.
    for at in &open {
        let v = at.from;
        if visits > MOST_PAIRS {
            found.at_least = true;
            break;
        }
        tree.near(faces.plan(v), gap, |i| {
            visits += 1;
            let edge = open[i];
            if edge.from == v || edge.to == v || faces.corners[edge.face as usize].contains(&v) {
                return;
            }
            let Some((distance, along)) = foot(ends[i], faces.plan(v), gap) else { return };
            if overhangs(faces, edge, v) {
                return;
            }
            let z = faces.point(edge.from).z.mul_add(1.0 - along, faces.point(edge.to).z * along);
            let height = faces.point(v).z - z;
            found.add(distance.max(height.abs()), || {
                let mut place = faces.place(faces.point(v), &[edge.face as usize, at.face as usize], &[v, edge.from, edge.to]);
                place.figures = vec![("distance", distance), ("height", height)];
                place
            });
        });
    }
    if found.at_least && found.count == 0 {
        unfinished.add(0.0, || faces.place(ends[0].0.extend(0.0), &[], &[]));
    }
    found
}

/// Distance from an edge and share along it of a point that lies by its inside, further than `gap` from both ends.
fn foot((a, b): (DVec2, DVec2), p: DVec2, gap: f64) -> Option<(f64, f64)> {
    let d = b - a;
    let along = d.dot(p - a) / d.length_squared();
    let distance = (d.perp_dot(p - a) / d.length()).abs();
    let near_end = (p - a).length() <= gap || (p - b).length() <= gap;
    (along > 0.0 && along < 1.0 && distance <= gap && !near_end).then_some((distance, along))
}

/// Whether a vertex on the inner side of an edge lies beyond the triangle of that edge: both belong to one sharp corner.
fn overhangs(faces: &Faces<'_>, edge: Open, v: u32) -> bool {
    let p = faces.plan(v);
    let [a, b, c] = faces.plan_up(edge.face as usize);
    turn(faces.plan(edge.from), faces.plan(edge.to), p) == Turn::Left
        && [(a, b), (b, c), (c, a)].iter().any(|&(s, t)| turn(s, t, p) == Turn::Right)
}

/// Pairs of boundary vertices within `gap` in plan that no chain of edges as short as that joins.
fn cracks(faces: &Faces<'_>, edges: &Edges, gap: f64, keep: usize, unfinished: &mut Collector) -> Collector {
    let mut found = Collector::new(Kind::Crack, keep);
    let mut vertices: Vec<u32> = edges.open.iter().flat_map(|e| [e.from, e.to]).collect();
    vertices.sort_unstable();
    vertices.dedup();
    let mut joined = Joined::new(&edges.short);
    // Rows as high as the gap: what is close is in the same row or the next.
    let mut rows: Vec<(f64, f64, u32)> =
        vertices.iter().map(|&v| (faces.plan(v), v)).map(|(p, v)| ((p.y / gap).floor(), p.x, v)).collect();
    rows.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
    let mut visits = 0;
    for (i, &(row, x, v)) in rows.iter().enumerate() {
        if visits > MOST_PAIRS {
            found.at_least = true;
            break;
        }
        let above = i + rows[i..].partition_point(|r| r.0 < row + 1.0 || (r.0 == row + 1.0 && r.1 < x - gap));
        let same = rows[i + 1..].iter().take_while(|r| r.0 == row && r.1 <= x + gap);
        let next = rows[above..].iter().take_while(|r| r.0 == row + 1.0 && r.1 <= x + gap);
        for &(_, _, w) in same.chain(next) {
            visits += 1;
            let distance = (faces.plan(v) - faces.plan(w)).length();
            if distance <= gap && !joined.same(v, w) {
                let height = faces.point(w).z - faces.point(v).z;
                found.add(distance.max(height.abs()), || {
                    let mut place = faces.place(faces.point(v), &[], &[v, w]);
                    place.figures = vec![("distance", distance), ("height", height)];
                    place
                });
            }
        }
    }
    if found.at_least && found.count == 0 {
        unfinished.add(0.0, || faces.place(faces.point(vertices[0]), &[], &vertices[..1]));
    }
    found
}

/// Vertices joined by chains of short edges.
struct Joined {
    number: FxHashMap<u32, u32>,
    sets: Union,
}

impl Joined {
    fn new(short: &[[u32; 2]]) -> Self {
        let mut number = FxHashMap::default();
        for &v in short.as_flattened() {
            let next = number.len() as u32;
            number.entry(v).or_insert(next);
        }
        let mut sets = Union::new(number.len());
        for e in short {
            if let [Some(&a), Some(&b)] = e.map(|v| number.get(&v)) {
                sets.join(a, b);
            }
        }
        Self { number, sets }
    }

    fn same(&mut self, v: u32, w: u32) -> bool {
        match (self.number.get(&v), self.number.get(&w)) {
            (Some(&a), Some(&b)) => self.sets.root(a) == self.sets.root(b),
            _ => false,
        }
    }
}
