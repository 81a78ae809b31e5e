//! The design cut off at the ground: whole triangles stay, the others keep their part in the works.

use super::cell::{Corner, Label, Side, cell};
use super::clip::{clip, sense, split_sides};
use super::nodes::{Meeting, Nodes};
use super::patch::NONE;
use super::shape::Shape;
use super::works::{Border, Works};
use crate::mesh::polygon;
use crate::mesh::region::RegionError;
use crate::model::Part;
use rustc_hash::FxHashMap;

/// Triangles of the design after cutting, in numbers of [`Nodes`].
#[derive(Default)]
pub(crate) struct Trimmed {
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The triangle of the design each comes from.
    pub(crate) from: Vec<u32>,
    /// Pieces of edges of the design, lower vertex first, by the edge they are part of.
    pub(crate) pieces: FxHashMap<[u32; 2], Vec<[u32; 2]>>,
}

/// Numbers for the corners of pieces: those of vertices, and passing ones for places on edges that are no vertices.
pub(crate) struct Passing<'a> {
    nodes: &'a Nodes,
    first: u32,
    of: FxHashMap<Label, u32>,
}

impl<'a> Passing<'a> {
    pub(crate) fn new(nodes: &'a Nodes) -> Self {
        Self { nodes, first: nodes.places.len() as u32, of: FxHashMap::default() }
    }

    pub(crate) fn id(&mut self, corner: &Corner) -> u32 {
        if let Some(id) = self.nodes.meeting(corner.label) {
            return id;
        }
        if corner.vertex != NONE {
            return self.nodes.design(corner.vertex);
        }
        self.place(corner.label)
    }

    /// The number of a mere place, whether or not there is a vertex above it.
    pub(crate) fn place(&mut self, label: Label) -> u32 {
        let next = self.first + self.of.len() as u32;
        *self.of.entry(label).or_insert(next)
    }

    pub(crate) fn is_vertex(&self, id: u32) -> bool {
        id < self.first
    }
}

/// A straight side with all its vertices.
pub(crate) struct Path {
    ids: Vec<u32>,
    position: FxHashMap<u32, usize>,
}

impl Path {
    pub(crate) fn new(ids: Vec<u32>) -> Self {
        let position = ids.iter().enumerate().map(|(n, &v)| (v, n)).collect();
        Self { ids, position }
    }

    /// `id` if that is a vertex of the side, else a number for a mere place.
    pub(crate) fn number(&self, id: u32, corner: &Corner, passing: &mut Passing) -> u32 {
        if self.position.contains_key(&id) { id } else { passing.place(corner.label) }
    }

    /// The vertices from one to another further on.
    fn stretch(&self, [from, to]: [u32; 2]) -> Option<&[u32]> {
        let (from, to) = (*self.position.get(&from)?, *self.position.get(&to)?);
        (from < to).then(|| &self.ids[from..=to])
    }

    /// The edges that no stretch from vertex to vertex covers.
    pub(crate) fn uncovered(&self, stretches: &[[u32; 2]], edges: &mut Vec<[u32; 2]>) {
        let Self { ids, position } = self;
        let mut covered = vec![false; ids.len() - 1];
        for [from, to] in stretches {
            if let (Some(&from), Some(&to)) = (position.get(from), position.get(to)) {
                covered[from.min(to)..to.max(from)].iter_mut().for_each(|c| *c = true);
            }
        }
        edges.extend((0..covered.len()).filter(|&n| !covered[n]).map(|n| [ids[n], ids[n + 1]]));
    }
}

/// What the ground cuts off the design.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Cutting {
    /// Platform and slopes alike count with both signs and whatever their height.
    pub(crate) whole: bool,
    /// Also what counts whatever its height ends with the ground.
    pub(crate) at_rim: bool,
}

impl Cutting {
    /// Whether the ground cuts off a part.
    fn concerns(self, part: Part) -> bool {
        self.at_rim || sense(part, self.whole).is_some()
    }

    /// Whether any of the design goes on beyond the edge of the ground although it is not to be cut off there.
    pub(crate) fn leaves_over(self, shape: &Shape, works: &Works) -> bool {
        let over = |a: u32| !self.concerns(shape.parts[a as usize]) && works.hangs_over(a);
        (0..shape.triangles.len() as u32).any(over)
    }
}

impl Trimmed {
    /// Cuts the design.
    ///
    /// # Errors
    /// [`RegionError`] if a piece cannot be triangulated.
    pub(crate) fn new(meeting: Meeting, cutting: Cutting) -> Result<Self, RegionError> {
        let Meeting { shape, works, nodes, .. } = meeting;
        let mut trimmed = Self::default();
        let mut cells: FxHashMap<u32, Vec<u32>> = FxHashMap::default();
        for &(a, b) in &works.cells {
            if works.mixed[a as usize] && cutting.concerns(shape.parts[a as usize]) {
                cells.entry(a).or_default().push(b);
            }
        }
        let mut rims: FxHashMap<u32, Vec<Border>> = FxHashMap::default();
        for border in works.borders.iter().chain(&works.rims).filter(|border| border.side.design.is_none()) {
            rims.entry(border.a).or_default().push(*border);
        }
        for a in 0..shape.triangles.len() as u32 {
            let part = shape.parts[a as usize];
            if cutting.concerns(part) && !works.seen[a as usize] {
                continue;
            }
            let edges = match cells.get(&a) {
                Some(over) => {
                    let rims = rims.get(&a).map_or(&[][..], |list| list);
                    Some(trimmed.piece(meeting, sense(part, cutting.whole), a, over, rims))
                }
                None => trimmed.with_points(meeting, a),
            };
            match edges {
                None => trimmed.push(shape.triangles[a as usize].map(|v| nodes.design(v)), a),
                Some(edges) => {
                    let found = polygon::fill(&nodes.places, &edges, |_| true)?;
                    found.into_iter().for_each(|t| trimmed.push(t, a));
                }
            }
        }
        for list in trimmed.pieces.values_mut() {
            list.sort_unstable();
            list.dedup();
        }
        Ok(trimmed)
    }

    fn push(&mut self, t: [u32; 3], a: u32) {
        if t[0] != t[1] && t[1] != t[2] && t[2] != t[0] {
            self.triangles.push(t);
            self.from.push(a);
        }
    }

    /// Edges of the part of triangle `a` in the works.
    fn piece(&mut self, meeting: Meeting, sense: Option<f64>, a: u32, over: &[u32], rims: &[Border]) -> Vec<[u32; 2]> {
        let Meeting { shape, patch, works, nodes } = meeting;
        let paths = [0, 1, 2_usize].map(|i| {
            let labels = works.on_design.get(&shape.edge(a, i as u8)).map_or(&[][..], |list| list);
            let ends = [i, (i + 1) % 3].map(|n| nodes.design(shape.triangles[a as usize][n]));
            Path::new(nodes.along(ends, labels.iter().filter_map(|&label| nodes.meeting(label))))
        });
        let mut passing = Passing::new(nodes);
        let (mut corners, mut kept) = (Vec::new(), Vec::new());
        let mut edges = Vec::new();
        let mut on_sides: [Vec<[u32; 2]>; 3] = Default::default();
        for &b in over {
            cell(shape, patch, a, b, &mut corners);
            match sense {
                Some(sense) => clip(shape, patch, (a, b), &corners, sense, &mut kept),
                None => split_sides(shape, patch, (a, b), &corners, &mut kept),
            }
            for (n, corner) in kept.iter().enumerate() {
                let next = &kept[(n + 1) % kept.len()];
                let edge = [passing.id(corner), passing.id(next)];
                if let Some(i) = corner.side.design {
                    let path = &paths[i as usize];
                    on_sides[i as usize]
                        .push([path.number(edge[0], corner, &mut passing), path.number(edge[1], next, &mut passing)]);
                } else if corner.side == Side::INSIDE {
                    edges.extend(nodes.pieces(edge));
                }
            }
        }
        for rim in rims {
            if let (Some(from), Some(to)) = (nodes.meeting(rim.from), nodes.meeting(rim.to)) {
                edges.extend(nodes.pieces([from, to]));
            }
        }
        for (i, list) in on_sides.iter().enumerate() {
            let edge = shape.edge(a, i as u8);
            let mut pieces = Vec::new();
            for run in runs(list, &passing) {
                for w in paths[i].stretch(run).unwrap_or(&run).windows(2) {
                    edges.push([w[0], w[1]]);
                    pieces.push([w[0].min(w[1]), w[0].max(w[1])]);
                }
            }
            // Without one the works on this side only touch the edge: the other side may have the whole of it.
            if !pieces.is_empty() {
                self.pieces.entry(edge).or_default().extend(pieces);
            }
        }
        edges
    }

    /// Edges of a triangle that stays as it is but for points on its sides; `None` if it has none.
    fn with_points(&mut self, meeting: Meeting, a: u32) -> Option<Vec<[u32; 2]>> {
        let Meeting { shape, works, nodes, .. } = meeting;
        let t = shape.triangles[a as usize];
        let lists = [0, 1, 2].map(|i| works.on_design.get(&shape.edge(a, i)).map_or(&[][..], |list| list));
        if lists.iter().all(|list| list.is_empty()) {
            return None;
        }
        let mut edges = Vec::new();
        for (i, list) in lists.iter().enumerate() {
            let ends = [t[i], t[(i + 1) % 3]];
            let ids = list.iter().filter_map(|&label| nodes.meeting(label));
            let path = nodes.along(ends.map(|v| nodes.design(v)), ids);
            let pieces: Vec<[u32; 2]> = path.windows(2).map(|w| [w[0], w[1]]).collect();
            let known = self.pieces.entry(shape.edge(a, i as u8)).or_default();
            known.extend(pieces.iter().map(|e| [e[0].min(e[1]), e[0].max(e[1])]));
            edges.extend(pieces);
        }
        Some(edges)
    }
}

/// Stretches from vertex to vertex, of pieces of a side that follow one another.
pub(crate) fn runs(pieces: &[[u32; 2]], passing: &Passing) -> Vec<[u32; 2]> {
    let pieces: Vec<[u32; 2]> = pieces.iter().copied().filter(|e| e[0] != e[1]).collect();
    let next: FxHashMap<u32, u32> = pieces.iter().map(|e| (e[0], e[1])).collect();
    let mut runs = Vec::new();
    for e in pieces.iter().filter(|e| passing.is_vertex(e[0])) {
        let mut at = e[1];
        // Places that are no vertices follow one another at most once each.
        for _ in 0..pieces.len() {
            if passing.is_vertex(at) {
                break;
            }
            at = next.get(&at).copied().unwrap_or(at);
        }
        if passing.is_vertex(at) && at != e[0] {
            runs.push([e[0], at]);
        }
    }
    runs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn free_stretches_of_a_side() {
        let mut edges = Vec::new();
        let path = Path::new(vec![1, 2, 3, 4]);
        path.uncovered(&[[3, 4], [1, 2]], &mut edges);
        assert_eq!(edges, [[2, 3]]);
        edges.clear();
        path.uncovered(&[], &mut edges);
        assert_eq!(edges, [[1, 2], [2, 3], [3, 4]]);
    }
}
