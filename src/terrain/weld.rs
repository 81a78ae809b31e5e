//! Common vertices for triangles that meet without sharing them.

use super::place::counted;
use crate::model::Note;
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;
use std::collections::hash_map::Entry;

/// Lets triangles use the first of all border vertices with the same coordinates. Where each triangle has vertices of its own
/// (STL and the like), or tiles were put side by side, all that meet are on the border; inner vertices need no look. Returns
/// whether any were the same.
pub(super) fn weld(vertices: &[DVec3], border: &[u32], triangles: &mut [[u32; 3]], notes: &mut Vec<Note>) -> bool {
    // Zero has two signs.
    let key = |v: DVec3| (v + 0.0).to_array().map(f64::to_bits);
    let mut first: FxHashMap<[u64; 3], u32> = FxHashMap::default();
    let mut same: FxHashMap<u32, u32> = FxHashMap::default();
    for &v in border {
        match first.entry(key(vertices[v as usize])) {
            Entry::Vacant(entry) => {
                entry.insert(v);
            }
            Entry::Occupied(entry) => {
                same.insert(v, *entry.get());
            }
        }
    }
    if same.is_empty() {
        return false;
    }
    triangles.as_flattened_mut().par_iter_mut().for_each(|v| {
        if let Some(&first) = same.get(v) {
            *v = first;
        }
    });
    let vertices = counted(same.len(), "vertex", "vertices");
    let message = format!("{vertices} of the ground had the coordinates of an earlier one, which its triangles now share");
    notes.push(Note::new("ground-welded", message));
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_soup_becomes_a_surface() {
        let points = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 0.0), (1.0, 1.0), (-0.0, 1.0)];
        let vertices = points.map(|(x, y)| DVec3::new(x, y, 0.0));
        let mut triangles = [[0, 1, 2], [3, 4, 5]];
        let mut notes = Vec::new();
        assert!(weld(&vertices, &[0, 1, 2, 3, 4, 5], &mut triangles, &mut notes));
        assert_eq!(triangles, [[0, 1, 2], [1, 4, 2]]);
        assert!(notes[0].message.starts_with("2 vertices"));
    }
}
