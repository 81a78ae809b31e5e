//! Whether a mesh lies on itself in plan.

use super::cell::Patch;
use super::fabric::Linked;
use super::volume::AREA_ROUNDING;
use super::walker::Walker;
use crate::kernel::sum::Sum;
use glam::{DVec2, DVec3};

/// Plan area that was seen to lie double.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Double {
    pub(super) area: f64,
    /// A place of it.
    pub(super) at: DVec2,
}

/// Lays every triangle at the rim on the mesh itself.
///
/// Across an edge between two triangles that both face up, the number of layers does not change. So where there is more than
/// one, there is also a triangle at the rim that lies on others: if none does, the mesh has one layer everywhere.
pub(super) fn double(mesh: &Linked<'_>) -> Double {
    let mut walker = Walker::new(mesh);
    let mut double = Double::default();
    let mut area = Sum::default();
    for &t in &mesh.rim {
        let corners = mesh.fabric.corners(t);
        let patch = Patch::new(corners);
        let mut covered = 0.0;
        walker.over_all(&patch, |_, ring| covered += ring.measure().0);
        // In coordinates of the patch the whole triangle has the double area `double_area²`.
        let excess = covered / patch.double_area - patch.double_area;
        if excess > AREA_ROUNDING * patch.double_area {
            if area.value() == 0.0 {
                let [a, b, c] = corners.map(DVec3::truncate);
                double.at = (a + b + c) / 3.0;
            }
            area.add(0.5 * excess);
        }
    }
    double.area = area.value();
    double
}
