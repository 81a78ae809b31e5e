//! How large the mesh will be, told before it is made.

use super::arcs::Arcs;
use super::closure::Closure;
use super::facet::END;
use super::refine::Cut;
use super::trim::Sheet;

/// Least number of triangles of the slopes, from the points that facets share: the ends of creases and rulings, and where levels
/// cross them. Points of chords come to it, and where slopes end at a distance what lies on their creases.
pub fn least_triangles(sheet: &Sheet, closure: &Closure, arcs: &Arcs, cut: &Cut) -> u64 {
    /// A triangulation has about two triangles for each of its points.
    const TRIANGLES: u64 = 2;
    let height = |v: u32| closure.vertices[v as usize].z;
    let crossed = |from: f64, to: f64| cut.levels.crossed(from, to).len() as u64;
    let creases: u64 = arcs
        .arcs
        .iter()
        .filter(|arc| arc.partner != END && cut.reach.is_none())
        .map(|arc| 1 + crossed(height(arc.ends[0]), height(arc.ends[1])))
        .sum();
    let joints = sheet
        .fans
        .joints
        .iter()
        .zip(&closure.tips)
        .filter(|(joint, _)| sheet.facet(joint.left).wanted || sheet.facet(joint.right).wanted);
    let joints: u64 = joints
        .map(|(joint, tip)| {
            let top = height(joint.node);
            let share = cut.reach.map_or(1.0, |reach| (reach / tip.r).min(1.0));
            1 + crossed(top, top + share * (tip.point.z - top))
        })
        .sum();
    let edges: u64 =
        sheet.network.edges.iter().map(|edge| 1 + edge.inner.len() as u64 + crossed(height(edge.a), height(edge.b))).sum();
    TRIANGLES * (creases + joints + edges)
}
