//! The ground outside the works: given triangles as they are, and what is left of those that the works cut.

use super::cell::{Corner, Label, cell, class};
use super::clip::{clip, sense, split_sides};
use super::nodes::{Meeting, Nodes};
use super::patch::Patch;
use super::trimmed::{Passing, Path, runs};
use super::works::{Border, Works};
use crate::mesh::polygon;
use crate::mesh::region::RegionError;
use rustc_hash::FxHashMap;

/// What the works leave of the patch of ground.
pub(crate) struct Left {
    /// Triangles of the patch that stay as they are.
    pub(crate) kept: Vec<u32>,
    /// Remainders of the others, in numbers of [`Nodes`].
    pub(crate) pieces: Vec<[u32; 3]>,
}

/// What bears on one triangle of the ground.
#[derive(Default)]
struct Cut {
    /// Triangles of the design over it.
    over: Vec<u32>,
    /// Boundary of the works through its inside.
    borders: Vec<Border>,
}

impl Left {
    /// Takes the works out of the ground. `whole`: everything of the design counts, whatever its height.
    ///
    /// # Errors
    /// [`RegionError`] if a remainder cannot be triangulated.
    pub(crate) fn new(meeting: Meeting, whole: bool) -> Result<Self, RegionError> {
        let Meeting { patch, works, nodes, .. } = meeting;
        let cuts = cuts(patch, works);
        let mut covered = vec![false; patch.triangles.len()];
        works.cells.iter().for_each(|&(_, b)| covered[b as usize] = true);
        let mut left = Self { kept: Vec::new(), pieces: Vec::new() };
        for b in 0..patch.triangles.len() as u32 {
            match cuts.get(&b) {
                Some(cut) => {
                    let mut passing = Passing::new(nodes);
                    let edges = remainder(meeting, &mut passing, b, cut, whole);
                    left.pieces.extend(polygon::fill(&nodes.places, &edges, |v| passing.is_vertex(v))?);
                }
                None if !covered[b as usize] => left.kept.push(b),
                None => {}
            }
        }
        Ok(left)
    }
}

/// The triangles that are not wholly in the works or out of them.
fn cuts(patch: &Patch, works: &Works) -> FxHashMap<u32, Cut> {
    let mut cuts: FxHashMap<u32, Cut> = FxHashMap::default();
    for border in works.daylight.iter().chain(&works.borders) {
        let cut = cuts.entry(border.b).or_default();
        if border.side.ground.is_none() {
            cut.borders.push(*border);
        }
    }
    // A point on a side is a vertex for the triangles on both of its sides.
    for b in 0..patch.triangles.len() as u32 {
        if !cuts.contains_key(&b) && (0..3).any(|j| works.on_ground.contains_key(&patch.edge(b, j))) {
            cuts.insert(b, Cut::default());
        }
    }
    for &(a, b) in &works.cells {
        if let Some(cut) = cuts.get_mut(&b) {
            cut.over.push(a);
        }
    }
    cuts
}

/// Directed edges around what is left of ground triangle `b`.
fn remainder(meeting: Meeting, passing: &mut Passing, b: u32, cut: &Cut, whole: bool) -> Vec<[u32; 2]> {
    let Meeting { shape, patch, works, nodes } = meeting;
    let t = patch.triangles[b as usize];
    let paths = [0, 1, 2_usize].map(|j| {
        let labels = works.on_ground.get(&patch.edge(b, j as u8)).map_or(&[][..], |list| list);
        let ids = labels.iter().filter_map(|&label| nodes.meeting(label));
        Path::new(nodes.along([t[j], t[(j + 1) % 3]].map(|v| nodes.ground(v)), ids))
    });
    let mut stretches: [Vec<[u32; 2]>; 3] = Default::default();
    let mut edges = Vec::new();
    let (mut corners, mut kept) = (Vec::new(), Vec::new());
    for &a in &cut.over {
        cell(shape, patch, a, b, &mut corners);
        match sense(shape.parts[a as usize], whole) {
            Some(sense) => clip(shape, patch, (a, b), &corners, sense, &mut kept),
            None => split_sides(shape, patch, (a, b), &corners, &mut kept),
        }
        for (n, corner) in kept.iter().enumerate() {
            let Some(j) = corner.side.ground else { continue };
            let next = &kept[(n + 1) % kept.len()];
            let path = &paths[j as usize];
            stretches[j as usize].push([number(corner, path, nodes, passing), number(next, path, nodes, passing)]);
        }
    }
    for border in &cut.borders {
        if let (Some(from), Some(to)) = (nodes.meeting(border.from), nodes.meeting(border.to)) {
            edges.extend(nodes.pieces([to, from]));
        }
    }
    for (path, list) in paths.iter().zip(&stretches) {
        path.uncovered(&runs(list, passing), &mut edges);
    }
    edges
}

/// Number of a corner on a side of a ground triangle. Vertices of the ground are themselves; a vertex of the design counts only where
/// it meets the ground, and not under a platform: the ground ends at the edge of that.
fn number(corner: &Corner, path: &Path, nodes: &Nodes, passing: &mut Passing) -> u32 {
    match corner.label {
        Label::Ground(v) => path.number(nodes.ground(v), corner, passing),
        _ if class(corner.h) == 0 => {
            let id = passing.id(corner);
            path.number(id, corner, passing)
        }
        label => passing.place(label),
    }
}
