//! The axes of a scene, with or without ground, and what runs along them.

use super::Scene;
use crate::ground::{self, Axis};
use glam::DVec2;

/// An axis with the heights of the design along it.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// The axis in plan, in the frame of the design.
    pub(super) axis: Axis,
    /// Station and elevation of its points; linear between.
    pub(super) heights: Vec<DVec2>,
    /// Whether it is the centre line of a road.
    pub(super) road: bool,
}

/// All axes, in the order of the chains of the line.
pub(super) fn courses(scene: &Scene<'_>) -> Vec<Course> {
    let axes = ground::axes(scene.line, &scene.design.frame);
    let course = |(index, axis): (usize, Axis)| {
        let chain = &scene.line.chains[index];
        let centre = scene.line.breaklines.iter().find(|b| b.of == Some(index) && b.stations.is_some());
        let road = chain.axis.is_some() && centre.is_some();
        let vertices = centre.filter(|_| road).map_or(&chain.vertices, |centre| &centre.vertices);
        let closing = chain.closed().then(|| &chain.vertices[0]);
        let elevations = vertices.iter().chain(closing).map(|v| v.z);
        let heights = axis.line.iter().zip(elevations).map(|(point, z)| DVec2::new(point.1, z)).collect();
        Course { axis, heights, road }
    };
    axes.into_iter().enumerate().map(course).collect()
}
