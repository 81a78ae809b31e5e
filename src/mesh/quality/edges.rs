//! How triangles hang together: edges with too many triangles, neighbours that face opposite ways, pieces, open edges.

use super::faces::{Faces, Facing};
use super::finding::{Collector, Kind};
use crate::kernel::buckets::Buckets;
use crate::kernel::union::Union;

/// An edge with one triangle, directed so that the triangle, seen from above and turned up, lies on its left.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Open {
    pub(super) from: u32,
    pub(super) to: u32,
    pub(super) face: u32,
}

/// How the triangles hang together.
pub(super) struct Edges {
    /// Open edges, in ascending order.
    pub(super) open: Vec<Open>,
    /// Edges not longer in plan than the gap.
    pub(super) short: Vec<[u32; 2]>,
    /// The least triangle of the piece each triangle belongs to.
    pub(super) piece: Vec<u32>,
}

impl Edges {
    /// Sorts the edges out; what that finds goes to `found`. `gap` is a plan distance.
    pub(super) fn new(faces: &Faces<'_>, gap: f64, keep: usize, found: &mut Vec<Collector>) -> Self {
        let mut non_manifold = Collector::new(Kind::NonManifold, keep);
        let mut orientation = Collector::new(Kind::Orientation, keep);
        let mut pieces = Union::new(faces.len());
        let (mut open, mut short) = (Vec::new(), Vec::new());
        each_edge(faces, |lo, hi, sides| {
            if (faces.plan(lo) - faces.plan(hi)).length() <= gap {
                short.push([lo, hi]);
            }
            let face = |side: u32| side as usize / 3;
            let forward = |side: u32| faces.corners[face(side)][side as usize % 3] == lo;
            if let [only] = *sides {
                let [from, to] = if forward(only) == (faces.facing[face(only)] != Facing::Down) { [lo, hi] } else { [hi, lo] };
                open.push(Open { from, to, face: only / 3 });
                return;
            }
            for w in sides.windows(2) {
                pieces.join(w[0] / 3, w[1] / 3);
            }
            let (several, same) = (sides.len() > 2, sides.len() == 2 && forward(sides[0]) == forward(sides[1]));
            if several || same {
                let collector = if several { &mut non_manifold } else { &mut orientation };
                collector.add(sides.len() as f64, || {
                    let of: Vec<usize> = sides.iter().map(|&side| face(side)).collect();
                    faces.place(0.5 * (faces.point(lo) + faces.point(hi)), &of, &[lo, hi])
                });
            }
        });
        open.sort_unstable();
        found.extend([non_manifold, orientation, pinched(faces, &open, keep)]);
        let piece = (0..faces.len() as u32).map(|f| pieces.root(f)).collect();
        Self { open, short, piece }
    }
}

/// Calls `visit` for every edge with its lower and higher vertex and its sides, three times the triangle plus the corner where
/// the side begins, ascending.
fn each_edge(faces: &Faces<'_>, mut visit: impl FnMut(u32, u32, &[u32])) {
    let ends = |side: usize| {
        let corners = faces.corners[side / 3];
        let (a, b) = (corners[side % 3], corners[(side % 3 + 1) % 3]);
        (a.min(b), a.max(b))
    };
    // The higher end above, the side below: sorted by both.
    let sides = (0..3 * faces.len()).map(|side| (ends(side), side as u64));
    let mut entries = Buckets::new(faces.subject.vertices.len(), sides.map(|((lo, hi), side)| (lo, u64::from(hi) << 32 | side)));
    let mut group = Vec::new();
    for (bucket, lo) in entries.each_mut().zip(0..) {
        bucket.sort_unstable();
        for run in bucket.chunk_by(|a, b| a >> 32 == b >> 32) {
            group.clear();
            group.extend(run.iter().map(|&entry| entry as u32));
            visit(lo, (run[0] >> 32) as u32, &group);
        }
    }
}

/// Vertices with more than two open edges.
fn pinched(faces: &Faces<'_>, open: &[Open], keep: usize) -> Collector {
    let mut found = Collector::new(Kind::Pinched, keep);
    let mut ends: Vec<u32> = open.iter().flat_map(|e| [e.from, e.to]).collect();
    ends.sort_unstable();
    for run in ends.chunk_by(|a, b| a == b).filter(|run| run.len() > 2) {
        found.add(run.len() as f64, || faces.place(faces.point(run[0]), &[], &run[..1]));
    }
    found
}
