//! Existing ground.

use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;
use glam::DVec3;
use rayon::prelude::*;

/// Vertices a thread looks at in one go.
const CHUNK: usize = 1 << 16;

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

    /// Plan box of all vertices in the local frame.
    pub fn plan_box(&self) -> PlanBox {
        let of_some = |some: &[DVec3]| PlanBox::of(some.iter().map(|v| v.truncate()));
        self.vertices.par_chunks(CHUNK).map(of_some).reduce(|| PlanBox::EMPTY, PlanBox::join)
    }

    /// Lowest and highest vertex; the wrong way round if there are none.
    pub fn height_range(&self) -> (f64, f64) {
        let of_some = |some: &[DVec3]| range(some.iter().map(|v| v.z));
        let wider = |(lo, hi): (f64, f64), (a, b): (f64, f64)| (lo.min(a), hi.max(b));
        self.vertices.par_chunks(CHUNK).map(of_some).reduce(|| range([]), wider)
    }

    /// The same ground in another frame.
    pub fn in_frame(mut self, frame: Frame) -> Self {
        if frame != self.frame {
            let before = self.frame;
            self.vertices.par_iter_mut().for_each(|v| *v = frame.to_local(before.to_world(*v)));
            self.frame = frame;
        }
        self
    }
}
