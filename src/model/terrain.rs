//! Existing ground.

use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;
use glam::DVec3;
use rayon::prelude::*;

/// Triangles a thread looks at in one go.
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

    /// Plan box of the triangles in the local frame. Vertices of no triangle, which may lie anywhere, do not count.
    pub fn plan_box(&self) -> PlanBox {
        let of_some = |some: &[[u32; 3]]| PlanBox::of(self.used(some).map(|v| v.truncate()));
        self.triangles.par_chunks(CHUNK).map(of_some).reduce(|| PlanBox::EMPTY, PlanBox::join)
    }

    /// Lowest and highest corner of a triangle; the wrong way round if there are none.
    pub fn height_range(&self) -> (f64, f64) {
        let of_some = |some: &[[u32; 3]]| range(self.used(some).map(|v| v.z));
        let wider = |(lo, hi): (f64, f64), (a, b): (f64, f64)| (lo.min(a), hi.max(b));
        self.triangles.par_chunks(CHUNK).map(of_some).reduce(|| range([]), wider)
    }

    /// The corners of triangles, one after the other.
    fn used(&self, triangles: &[[u32; 3]]) -> impl Iterator<Item = DVec3> {
        triangles.as_flattened().iter().map(|&v| self.vertices[v as usize])
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

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec2;

    #[test]
    fn boxes_are_those_of_the_triangles() {
        let corner = DVec3::new(5e5, 5e6, 100.0);
        let mut vertices = vec![DVec3::ZERO, corner, corner + DVec3::new(9.0, 0.0, 1.0), corner + DVec3::new(0.0, 7.0, -2.0)];
        vertices.push(DVec3::splat(1e7));
        let terrain = Terrain { frame: Frame::WORLD, vertices, triangles: vec![[1, 2, 3]] };
        assert_eq!(terrain.plan_box(), PlanBox { lo: DVec2::new(5e5, 5e6), hi: DVec2::new(500_009.0, 5_000_007.0) });
        assert_eq!(terrain.height_range(), (98.0, 101.0));
        let none = Terrain { triangles: vec![], ..terrain };
        assert!(none.plan_box().is_empty() && none.height_range() == (f64::INFINITY, f64::NEG_INFINITY));
    }
}
