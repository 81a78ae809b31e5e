//! The axes of a scene, with or without ground, and what runs along them.

use super::Scene;
use crate::ground::{self, Axis};
use crate::model::Chain;
use glam::{DVec2, DVec3};

/// An axis with the heights of the design along it.
#[derive(Clone, Debug)]
pub(super) struct Course {
    /// The axis in plan, in the frame of the design.
    pub(super) axis: Axis,
    /// Station and elevation of its points; linear between.
    pub(super) heights: Vec<DVec2>,
    /// Whether it is the centre line of a road.
    pub(super) road: bool,
    /// Station and elevation along the left edge of the road and along the right one; nothing where there is no road.
    pub(super) edges: [Vec<DVec2>; 2],
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
        let edges = centre.filter(|_| road).map(|centre| edges(chain, &centre.vertices)).unwrap_or_default();
        Course { axis, heights, road, edges }
    };
    axes.into_iter().enumerate().map(course).collect()
}

/// The edges of a road: its ring runs along the left one, and past the end of the centre line back along the right one.
fn edges(ring: &Chain, centre: &[DVec3]) -> [Vec<DVec2>; 2] {
    let Some(axis) = &ring.axis else { return Default::default() };
    let place = |end: Option<&DVec3>| ring.vertices.iter().position(|v| Some(v) == end);
    let Some((begin, end)) = place(centre.first()).zip(place(centre.last())) else { return Default::default() };
    let n = ring.vertices.len();
    // From one end to the other, without them.
    let between = |from: usize, to: usize| -> Vec<DVec2> {
        let count = (to + n - from) % n;
        (1..count).map(|i| (from + i) % n).map(|i| DVec2::new(axis.stations[i], ring.vertices[i].z)).collect()
    };
    let (left, mut right) = (between(begin, end), between(end, begin));
    right.reverse();
    [left, right]
}
