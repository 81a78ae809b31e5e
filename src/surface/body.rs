//! The mesh of a surface with what is known of its triangles and edges.

use super::flats::Flats;
use super::make::CHORD_SHARE;
use super::{Mark, PlatformStation, Volumes, feet};
use crate::kernel::sum::Sum;
use crate::mesh::check::owners;
use crate::mesh::volume;
use crate::model::{Chain, Design, Line, Part, Sheet as SheetKind, Side, Tin};
use crate::slope::emit::{self, Slopes, Trace};
use crate::slope::network::Network;
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

/// An edge across which a slope has less than this share of itself is a ruling.
const RULING: f64 = 1e-4;

/// The mesh with what is known of its triangles.
pub(crate) struct Body {
    pub(super) tin: Tin,
    /// Whether a triangle belongs to a cone; shorter than the list of triangles, flats come last.
    pub(super) on_cone: Vec<bool>,
    /// Mesh edges with a meaning, in mesh numbers.
    pub(super) traces: Vec<emit::Traced>,
    /// Points of each edge of the network from end to end, in mesh numbers, with the given vertex where there is one.
    pub(super) edge_points: Vec<Vec<emit::EdgePoint>>,
    /// Stations of roads.
    pub(super) stations: Vec<PlatformStation>,
    /// Edges of breaklines.
    pub(super) breaks: Vec<(Mark, [u32; 2])>,
}

/// The order of traces as one number.
fn order(&(trace, [a, b]): &emit::Traced) -> u128 {
    let (kind, number) = match trace {
        Trace::Level(u) => (0, u),
        Trace::Crease => (1, 0),
        Trace::Hinge(e) => (2, e),
    };
    kind << 96 | u128::from(number) << 64 | u128::from(a) << 32 | u128::from(b)
}

impl Body {
    pub(super) fn new(network: &Network, design: &Design, slopes: &Slopes, flats: &Flats) -> Self {
        let mut number = vec![u32::MAX; slopes.points.len()];
        for &v in slopes.triangles.as_flattened().iter().chain(flats.triangles.as_flattened()) {
            number[v as usize] = 0;
        }
        let mut vertices = Vec::with_capacity(slopes.points.len());
        for (v, id) in number.iter_mut().enumerate().filter(|(_, id)| **id == 0) {
            *id = vertices.len() as u32;
            let p = slopes.points[v];
            vertices.push(DVec3::new(p.x, p.y, network.sign * p.z));
        }
        let renumber = |t: &[u32; 3]| t.map(|v| number[v as usize]);
        let part = if design.sheet == SheetKind::Falling { Part::FillSlope } else { Part::CutSlope };
        let triangles: Vec<[u32; 3]> = slopes.triangles.iter().chain(&flats.triangles).map(renumber).collect();
        let mut parts = vec![part; slopes.triangles.len()];
        parts.resize(triangles.len(), Part::Platform);
        let used = |ids: &[u32]| ids.iter().all(|&v| number[v as usize] != u32::MAX);
        let mut traces: Vec<emit::Traced> = slopes
            .traces
            .iter()
            .filter(|(_, ends)| used(ends))
            .map(|&(kind, ends)| {
                let [a, b] = ends.map(|v| number[v as usize]);
                (kind, [a.min(b), a.max(b)])
            })
            .collect();
        traces.par_sort_unstable_by_key(order);
        traces.dedup();
        let edge_points: Vec<Vec<emit::EdgePoint>> = slopes
            .edge_points
            .iter()
            .zip(&network.edges)
            .map(|(inner, edge)| {
                let end = |node: u32, given, s| emit::EdgePoint { s, id: number[node as usize], given: Some(given) };
                let length = network.nodes[edge.a as usize].truncate().distance(network.nodes[edge.b as usize].truncate());
                let inner = inner.iter().map(|p| emit::EdgePoint { id: number[p.id as usize], ..*p });
                std::iter::once(end(edge.a, edge.given[0], 0.0))
                    .chain(inner)
                    .chain([end(edge.b, edge.given[1], length)])
                    .collect()
            })
            .collect();
        let tin = Tin { frame: network.frame, vertices, triangles, parts };
        let on_cone = slopes.facets.iter().map(|&f| f as usize >= 2 * network.edges.len()).collect();
        let stations = flats.stations.iter().filter(|(v, ..)| used(&[*v]));
        let stations = stations.map(|&(v, chain, station)| PlatformStation { vertex: number[v as usize], chain, station });
        let mut stations: Vec<PlatformStation> = stations.collect();
        stations.sort_by_key(|s| (s.vertex, s.chain));
        let breaks = flats.breaks.iter().filter(|(_, ends)| used(ends)).map(|&(breakline, ends)| {
            let [a, b] = ends.map(|v| number[v as usize]);
            (Mark::Breakline(breakline), [a.min(b), a.max(b)])
        });
        let breaks = breaks.collect();
        Self { tin, on_cone, traces, edge_points, stations, breaks }
    }

    /// The traces in the words of the world.
    pub(super) fn marks(&self, network: &Network, design: &Design) -> Vec<(Mark, [u32; 2])> {
        let mark = |trace| match trace {
            Trace::Level(u) => Mark::Level(u),
            Trace::Crease => feet::crease(design.sheet),
            Trace::Hinge(e) => Mark::Hinge(network.edges[e as usize].given[0].chain),
        };
        let traces = self.traces.iter().map(|&(trace, ends)| (mark(trace), ends));
        let mut marks: Vec<(Mark, [u32; 2])> = traces.chain(self.breaks.iter().copied()).collect();
        // Levels and creases are in order, as traces are. Of edges several make a chain.
        let rest = marks.partition_point(|(mark, _)| *mark < Mark::Hinge(0));
        marks[rest..].par_sort_unstable();
        marks
    }

    /// Volumes above and below the horizontal plane at `elevation`, with the bound for their error.
    pub(super) fn volumes(&self, elevation: f64, moves: &Moves, open: &[[u32; 2]]) -> Volumes {
        let (found, error_bound) = rayon::join(
            || volume::above_plane((0..self.tin.triangles.len()).map(|t| self.tin.corners(t)), elevation),
            || self.error_bound(elevation, moves, open),
        );
        Volumes {
            cut: found.cut,
            fill: found.fill,
            error_bound,
            reference: elevation,
            cut_max: found.cut_max,
            fill_max: found.fill_max,
        }
    }

    /// What the sheet of the line as given can hold more or less than the mesh: a layer on all of it, one more on cones, and a strip
    /// along its border (`open`), as high as the border stands above or below the plane (docs/theory.md, Section 12).
    fn error_bound(&self, elevation: f64, moves: &Moves, open: &[[u32; 2]]) -> f64 {
        let area = |t: usize| volume::plan_area(self.tin.corners(t));
        let all = (0..self.tin.triangles.len()).map(area).collect::<Sum>().value();
        let cones = (0..self.on_cone.len()).filter(|&t| self.on_cone[t]).map(area).collect::<Sum>().value();
        let owners = owners(open, self.tin.vertices.len(), &self.tin.triangles);
        // Where both sides have slopes, the line is no border.
        let hinges = self.traces.iter().filter(|(trace, _)| moves.one_sided && matches!(trace, Trace::Hinge(_)));
        let hinges: FxHashSet<[u32; 2]> = hinges.flat_map(|&(_, [a, b])| [[a, b], [b, a]]).collect();
        let strip = |(edge, owner): (&[u32; 2], u32)| {
            let ends = edge.map(|v| self.tin.vertices[v as usize]);
            let on_cone = self.on_cone.get(owner as usize).is_some_and(|&on_cone| on_cone);
            let curved = on_cone || moves.one_sided && !hinges.contains(edge) && ends.iter().any(|p| p.z != elevation);
            let height = 0.5 * ends.iter().map(|p| (p.z - elevation).abs()).sum::<f64>();
            moves.strip(ends, curved) * (height + moves.line + moves.cone)
        };
        moves.line * all + moves.cone * cones + open.iter().zip(owners).map(strip).collect::<Sum>().value()
    }
}

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
