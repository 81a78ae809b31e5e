//! Whether a mesh lies on itself in plan, where, and how much.
//!
//! Not a question of yes or no, as in `mesh::check`: along seams of rounded coordinates every mesh lies on itself a little.

use super::cell::{Patch, Ring};
use super::fabric::Linked;
use super::pieces::{Loose, Pieces, fan};
use super::tally::in_chunks;
use super::walker::Walker;
use crate::kernel::sum::Sum;
use glam::{DVec2, DVec3};

/// Cells that may lie double among the triangles of one piece of work, 4096 of them: slivers along seams are far fewer. Triangles
/// that all lie on each other would have a cell for each pair.
const MOST_CELLS: usize = 1 << 16;

/// Cells at the rim that are looked at, before all are counted. More than this are too many there as well.
const MOST_AT_RIM: usize = 64 * MOST_CELLS;

/// Plan area that lies double.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Double {
    /// Of all pairs of triangles that lie on each other, each pair once.
    pub(super) area: f64,
    /// A place of it.
    pub(super) at: DVec2,
}

/// Lays triangles at the rim on the mesh itself; all of them, unless `most` is exceeded and there are very many cells. `None` if
/// nothing lies double.
///
/// Across an edge between two triangles that both face up, the number of layers does not change. So where there is more than
/// one, there is also a triangle at the rim that lies on others: if none does, the mesh has one layer everywhere. If some do, that
/// is a part of what lies double: at least half of what is seen, for the other triangle may be at the rim as well.
pub(super) fn at_rim(mesh: &Linked<'_>, most: f64) -> Option<Double> {
    let mut walker = Walker::new(mesh);
    let mut found: Option<Double> = None;
    let mut area = Sum::default();
    let mut cells = 0;
    for &t in &mesh.rim {
        let patch = Patch::new(mesh.fabric.corners(t));
        walker.over_all(&patch, |u, ring| {
            if u != t && ring.has_area(&patch, &mesh.fabric.corners(u)) {
                // Half of its area, which is half the measure.
                area.add(0.25 * ring.measure().0 / patch.double_area);
                cells += 1;
                found.get_or_insert_with(|| Double { area: 0.0, at: middle(&patch, ring) });
            }
        });
        if cells > if area.value() > most { MOST_CELLS } else { MOST_AT_RIM } {
            break;
        }
    }
    found.map(|one| Double { area: area.value(), ..one })
}

/// Everything that lies double, as triangles: of three layers, every two. The second is whether that is all, or there is too much.
pub(super) fn cells(mesh: &Linked<'_>) -> (Loose, bool) {
    let chunks = in_chunks(
        mesh.fabric.count(),
        || Walker::new(mesh),
        |walker, range| {
            let mut found = Vec::new();
            let mut cells = 0;
            for t in range {
                let patch = Patch::new(mesh.fabric.piece(t));
                walker.over_all(&patch, |u, ring| {
                    if u as usize > t && ring.has_area(&patch, &mesh.fabric.corners(u)) && cells < MOST_CELLS {
                        cells += 1;
                        found.extend(fan(&patch, ring));
                    }
                });
                if cells == MOST_CELLS {
                    break;
                }
            }
            (found, cells < MOST_CELLS)
        },
    );
    let all = chunks.iter().all(|(_, all)| *all);
    (Loose::new(chunks.into_iter().flat_map(|(found, _)| found).collect()), all)
}

/// A point inside a ring.
fn middle(patch: &Patch, ring: &Ring) -> DVec2 {
    let sum: DVec3 = ring.corners().iter().map(|c| patch.point(c)).sum();
    (sum / ring.corners().len() as f64).truncate()
}
