//! The part of a mesh inside an area.

use super::cell::{CUT, Corner, Patch, Ring};
use super::fabric::{Fabric, Linked, double_area};
use super::tally::in_chunks;
use super::walker::Walker;
use crate::kernel::sum::Sum;
use glam::{DVec2, DVec3};

/// Triangles to be laid on a mesh, neighbours near each other; counter-clockwise, with area.
pub(super) trait Pieces: Sync {
    fn count(&self) -> usize;
    fn piece(&self, i: usize) -> [DVec3; 3];
}

impl Pieces for Fabric {
    fn count(&self) -> usize {
        self.triangles.len()
    }

    fn piece(&self, i: usize) -> [DVec3; 3] {
        self.corners(i as u32)
    }
}

/// Loose triangles.
#[derive(Default)]
pub(super) struct Loose(Vec<[DVec3; 3]>);

impl Pieces for Loose {
    fn count(&self) -> usize {
        self.0.len()
    }

    fn piece(&self, i: usize) -> [DVec3; 3] {
        self.0[i]
    }
}

impl Loose {
    pub(super) fn new(triangles: Vec<[DVec3; 3]>) -> Self {
        Self(triangles)
    }

    /// A place of the largest of them.
    pub(super) fn place(&self) -> Option<DVec2> {
        let largest = self.0.iter().max_by(|a, b| double_area(**a).total_cmp(&double_area(**b)));
        largest.map(|[a, b, c]| ((*a + *b + *c) / 3.0).truncate())
    }

    /// Plan area of all of them.
    pub(super) fn area(&self) -> f64 {
        self.0.iter().map(|t| 0.5 * double_area(*t)).collect::<Sum>().value()
    }
}

/// A ring as triangles.
pub(super) fn fan<'r>(patch: &'r Patch, ring: &'r Ring) -> impl Iterator<Item = [DVec3; 3]> + 'r {
    let corners = ring.corners();
    let triangle = |pair: &[Corner]| [&corners[0], &pair[0], &pair[1]].map(|c| patch.point(c));
    corners.get(1..).unwrap_or_default().windows(2).map(triangle).filter(|t| double_area(*t) > 0.0)
}

/// The part of `mesh` inside `area`: its triangles clipped by those of the area.
pub(super) fn within(mesh: &impl Pieces, area: &Linked<'_>) -> Loose {
    let chunks = in_chunks(
        mesh.count(),
        || Walker::new(area),
        |walker, range| {
            let mut found = Vec::new();
            walker.reset();
            for t in range {
                let corners = mesh.piece(t);
                let patch = Patch::new(corners);
                walker.over(&patch, |t, ring| {
                    if ring.edges().iter().all(|&e| e >= CUT) {
                        found.push(corners);
                    } else if !ring.has_area(&patch, &area.fabric.corners(t)) {
                        // They only touch: nothing is inside.
                    } else {
                        found.extend(fan(&patch, ring));
                    }
                });
            }
            found
        },
    );
    Loose(chunks.concat())
}
