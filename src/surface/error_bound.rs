//! How much volumes can be off through simplifying the line and cutting cones: see docs/theory.md, Section 12.

use super::body::Body;
use super::make::CHORD_SHARE;
use crate::kernel::sum::Sum;
use crate::mesh::check::owners;
use crate::mesh::volume;
use crate::model::{Chain, Design, Line, Side, Tin};
use crate::slope::emit::Trace;
use glam::DVec3;
use rustc_hash::FxHashSet;

/// An edge across which a slope has less than this share of itself is a ruling.
const RULING: f64 = 1e-4;

/// How far the sheet of the line as given may be from the mesh.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moves {
    /// In height, through simplifying and moving the line, and through chords of rounded corners of roads: at most.
    pub(crate) line: f64,
    /// In height, through chords, on cones alone: at most.
    pub(crate) cone: f64,
    /// Height over distance in plan: what turns heights into shifts of the border.
    slope: f64,
    /// Whether there are corners with a slope on one side only: on the other side there may be cones that are not part of the mesh.
    pub(crate) one_sided: bool,
}

impl Moves {
    /// `simplified_max` is the greatest displacement of a vertex, in the metric of the sheet.
    pub(crate) fn new(line: &Line, design: &Design, simplified_max: f64) -> Self {
        let slope = design.slope.ratio();
        let sagitta = line.chains.iter().filter_map(|c| c.axis.as_ref()).map(|axis| axis.sagitta).fold(0.0, f64::max);
        let one_sided = |chain: &Chain| {
            let side = if chain.closed() { design.side_of_rings } else { design.side_of_lines };
            side != Side::Both && chain.segment_count() > 1
        };
        Self {
            line: simplified_max + slope * sagitta,
            cone: CHORD_SHARE * design.tolerance,
            slope,
            one_sided: line.chains.iter().any(one_sided),
        }
    }

    /// Area of the strip by which an edge of the border may be off; `curved` if it may be that of a cone.
    ///
    /// Where a side of the line has no slope, the border may run where the slope would meet that of the other side. Two planes of one
    /// slope that meet along an edge differ across it by twice the slope they have there, and each may be off.
    pub(crate) fn strip(&self, [p, q]: [DVec3; 2], curved: bool) -> f64 {
        let length = p.truncate().distance(q.truncate());
        let along = (p.z - q.z).abs() / length;
        let across = ((self.slope - along) * (self.slope + along)).max(0.0).sqrt();
        let off = self.line + if curved { self.cone } else { 0.0 };
        // The ruling a slope ends in stays where it is.
        if across > RULING * self.slope { length * off / across } else { 0.0 }
    }
}

/// What the sheet can hold more or less than a mesh, its border aside: a layer of height `line` on all of it, and one more of height
/// `cone` on cones.
pub(crate) fn layers(tin: &Tin, on_cone: impl Fn(usize) -> bool, line: f64, cone: f64) -> f64 {
    let area = |t: usize| volume::plan_area(tin.corners(t));
    let all = (0..tin.triangles.len()).map(area).collect::<Sum>().value();
    let cones = (0..tin.triangles.len()).filter(|&t| on_cone(t)).map(area).collect::<Sum>().value();
    line * all + cone * cones
}

/// What the sheet of the line as given can hold more or less than the mesh, against the plane at `elevation`: its layers, and a strip
/// along its border (`open`), as high as the border stands above or below the plane.
pub(super) fn of(body: &Body, elevation: f64, moves: &Moves, open: &[[u32; 2]]) -> f64 {
    let on_cone = |t: usize| body.on_cone.get(t).is_some_and(|&on_cone| on_cone);
    let owners = owners(open, body.tin.vertices.len(), &body.tin.triangles);
    // Where both sides have slopes, the line is no border.
    let hinges = body.traces.iter().filter(|(trace, _)| moves.one_sided && matches!(trace, Trace::Hinge(_)));
    let hinges: FxHashSet<[u32; 2]> = hinges.flat_map(|&(_, [a, b])| [[a, b], [b, a]]).collect();
    let strip = |(edge, owner): (&[u32; 2], u32)| {
        let ends = edge.map(|v| body.tin.vertices[v as usize]);
        let curved =
            on_cone(owner as usize) || moves.one_sided && !hinges.contains(edge) && ends.iter().any(|p| p.z != elevation);
        let height = 0.5 * ends.iter().map(|p| (p.z - elevation).abs()).sum::<f64>();
        moves.strip(ends, curved) * (height + moves.line + moves.cone)
    };
    layers(&body.tin, on_cone, moves.line, moves.cone) + open.iter().zip(owners).map(strip).collect::<Sum>().value()
}
