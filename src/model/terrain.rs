//! Existing ground.

use crate::kernel::frame::Frame;
use glam::{DVec2, DVec3};

/// A triangulated ground surface, single-valued in z (2.5D), triangles counter-clockwise seen from above.
///
/// Vertices and triangles are those of the file, in its order, so that ground far from the works can be written as it was
/// given, bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Terrain {
    /// Shift between world and the coordinates in `vertices`.
    pub frame: Frame,
    /// Vertices in the local frame. Some may be used by no triangle.
    pub vertices: Vec<DVec3>,
    /// Vertex indices, counter-clockwise in plan.
    pub triangles: Vec<[u32; 3]>,
}

impl Terrain {
    /// Corners of triangle `t` in the local frame.
    pub fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.vertices[v as usize])
    }

    /// Plan box of all vertices in the local frame, lower left and upper right; both infinite the wrong way round if there are
    /// none.
    pub fn plan_box(&self) -> (DVec2, DVec2) {
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        self.vertices.iter().fold(empty, |(lo, hi), v| (lo.min(v.truncate()), hi.max(v.truncate())))
    }

    /// The same ground in another frame.
    pub fn in_frame(mut self, frame: Frame) -> Self {
        if frame != self.frame {
            for v in &mut self.vertices {
                *v = frame.to_local(self.frame.to_world(*v));
            }
            self.frame = frame;
        }
        self
    }
}
