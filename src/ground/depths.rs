//! How far a design lies above the ground at its vertices: for colours.

use crate::mesh::drape::Drape;
use crate::model::{Terrain, Tin};

/// Design minus ground height at each vertex of the design: positive is fill, negative is cut; nought beside the ground.
/// Both must be in the same frame.
pub fn depths(design: &Tin, terrain: &Terrain) -> Vec<f64> {
    let ground = Drape::new(&terrain.vertices, &terrain.triangles, Some(design.plan_box()));
    design.vertices.iter().map(|v| ground.at(v.truncate()).map_or(0.0, |(z, _)| v.z - z)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;
    use crate::model::Part;
    use glam::{DVec2, DVec3};

    #[test]
    fn above_is_fill_below_is_cut_beside_is_nought() {
        // Ground z = x over a square, the design level at 1: its corners lie above, on, below and beside the ground.
        let frame = Frame::around(DVec2::ZERO, DVec2::splat(2.0));
        let local = |x: f64, y: f64, z: f64| frame.to_local(DVec3::new(x, y, z));
        let vertices = vec![local(0.0, 0.0, 0.0), local(2.0, 0.0, 2.0), local(2.0, 2.0, 2.0), local(0.0, 2.0, 0.0)];
        let terrain = Terrain { frame, vertices, triangles: vec![[0, 1, 2], [0, 2, 3]] };
        let vertices = vec![local(0.5, 0.5, 1.0), local(1.0, 0.5, 1.0), local(1.75, 1.0, 1.0), local(3.0, 1.0, 1.0)];
        let design = Tin { frame, vertices, triangles: vec![[0, 1, 2], [0, 2, 3]], parts: vec![Part::Platform; 2] };
        assert_eq!(depths(&design, &terrain), [0.5, 0.0, -0.75, 0.0]);
    }
}
