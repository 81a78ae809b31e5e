//! Boundary loops and pieces.

use super::edges::Edges;
use super::faces::Faces;
use super::finding::{Collector, Kind, Place};
use crate::kernel::sum::Sum;
use rustc_hash::FxHashMap;

/// What a loop of boundary edges surrounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LoopKind {
    /// A piece of the surface.
    Outer,
    /// A hole.
    Hole,
    /// Next to nothing: the two sides of a seam that is not joined.
    Seam,
    /// It does not close.
    Unclosed,
}

impl LoopKind {
    /// Stable name.
    pub fn name(self) -> &'static str {
        match self {
            Self::Outer => "outer",
            Self::Hole => "hole",
            Self::Seam => "seam",
            Self::Unclosed => "unclosed",
        }
    }
}

/// A loop of boundary edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Loop {
    /// What it surrounds.
    pub kind: LoopKind,
    /// Number of its edges.
    pub edges: usize,
    /// Its length in plan.
    pub length: f64,
    /// The area it surrounds in plan.
    pub area: f64,
    /// Its first vertex.
    pub place: Place,
}

/// A part of the surface that shares no edge with the rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Number of its triangles.
    pub triangles: usize,
    /// Their area in plan.
    pub plan_area: f64,
    /// The centre of its first triangle.
    pub place: Place,
}

/// The boundary as loops, longest first, and the open edges in the order of loops. A loop passes no vertex twice.
pub(super) fn loops(faces: &Faces<'_>, edges: &Edges, gap: f64) -> (Vec<Loop>, Vec<usize>) {
    let open = &edges.open;
    let mut next: FxHashMap<u32, (usize, usize)> = FxHashMap::default();
    let mut at = 0;
    for run in open.chunk_by(|a, b| a.from == b.from) {
        next.insert(run[0].from, (at, at + run.len()));
        at += run.len();
    }
    let mut used = vec![false; open.len()];
    let mut loops = Vec::new();
    let mut order = Vec::with_capacity(open.len());
    for first in 0..open.len() {
        if used[first] {
            continue;
        }
        let mut path: Vec<usize> = Vec::new();
        let mut position: FxHashMap<u32, usize> = FxHashMap::default();
        let mut vertex = open[first].from;
        loop {
            position.insert(vertex, path.len());
            let Some(range) = next.get_mut(&vertex).filter(|range| range.0 < range.1) else { break };
            let edge = range.0;
            range.0 += 1;
            used[edge] = true;
            path.push(edge);
            vertex = open[edge].to;
            if let Some(&begin) = position.get(&vertex) {
                let cycle = path.split_off(begin);
                for &e in &cycle {
                    position.remove(&open[e].from);
                }
                loops.push(measure(faces, edges, &cycle, true, gap));
                order.extend(cycle);
            }
        }
        if !path.is_empty() {
            loops.push(measure(faces, edges, &path, false, gap));
            order.extend(path);
        }
    }
    loops.sort_by(|a, b| b.length.total_cmp(&a.length));
    (loops, order)
}

fn measure(faces: &Faces<'_>, edges: &Edges, path: &[usize], closed: bool, gap: f64) -> Loop {
    let begin = edges.open[path[0]];
    let origin = faces.plan(begin.from);
    let (mut length, mut twice) = (Sum::default(), Sum::default());
    for &e in path {
        let (p, q) = (faces.plan(edges.open[e].from), faces.plan(edges.open[e].to));
        length.add((q - p).length());
        twice.add((p - origin).perp_dot(q - origin));
    }
    let (length, area) = (length.value(), 0.5 * twice.value());
    let kind = match () {
        () if !closed => LoopKind::Unclosed,
        () if area.abs() <= gap * length => LoopKind::Seam,
        () if area > 0.0 => LoopKind::Outer,
        () => LoopKind::Hole,
    };
    let place = faces.place(faces.point(begin.from), &[begin.face as usize], &[begin.from]);
    Loop { kind, edges: path.len(), length, area: if closed { area.abs() } else { 0.0 }, place }
}

/// The pieces, largest first.
pub(super) fn pieces(faces: &Faces<'_>, edges: &Edges) -> Vec<Piece> {
    let mut number: FxHashMap<u32, usize> = FxHashMap::default();
    let mut pieces: Vec<(usize, Sum, usize)> = Vec::new();
    for (f, &root) in edges.piece.iter().enumerate() {
        let piece = *number.entry(root).or_insert_with(|| {
            pieces.push((0, Sum::default(), f));
            pieces.len() - 1
        });
        let [a, b, c] = faces.plan_up(f);
        pieces[piece].0 += 1;
        pieces[piece].1.add(0.5 * (b - a).perp_dot(c - a).max(0.0));
    }
    let mut pieces: Vec<Piece> = pieces
        .into_iter()
        .map(|(triangles, area, f)| Piece { triangles, plan_area: area.value(), place: faces.place(faces.centre(f), &[f], &[]) })
        .collect();
    pieces.sort_by_key(|piece| std::cmp::Reverse(piece.triangles));
    pieces
}

/// What is remarkable about loops and pieces.
pub(super) fn remarks(loops: &[Loop], pieces: &[Piece], keep: usize, found: &mut Vec<Collector>) {
    let [mut holes, mut several, mut closed] = [Kind::Hole, Kind::Pieces, Kind::Closed].map(|kind| Collector::new(kind, keep));
    let with = |place: &Place, figures: Vec<(&'static str, f64)>| Place { figures, ..place.clone() };
    for hole in loops.iter().filter(|l| l.kind == LoopKind::Hole) {
        holes.add(hole.length, || with(&hole.place, vec![("length", hole.length), ("area", hole.area)]));
    }
    if pieces.len() > 1 {
        for piece in pieces {
            let figures = vec![("count", piece.triangles as f64), ("plan_area", piece.plan_area)];
            several.add(piece.triangles as f64, || with(&piece.place, figures));
        }
    }
    if let (Some(piece), true) = (pieces.first(), loops.is_empty()) {
        closed.add(0.0, || piece.place.clone());
    }
    found.extend([holes, several, closed]);
}
