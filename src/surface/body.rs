//! The mesh of a surface with what is known of its triangles and edges.

use super::error_bound::{self, Moves};
use super::flats::Flats;
use super::{Mark, PlatformStation, Volumes, feet};
use crate::mesh::volume;
use crate::model::{Design, Part, Sheet as SheetKind, Tin};
use crate::slope::emit::{self, Slopes, Trace};
use crate::slope::network::Network;
use glam::DVec3;
use rayon::prelude::*;

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
            || error_bound::of(self, elevation, moves, open),
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
}
