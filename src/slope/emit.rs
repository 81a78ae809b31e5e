//! From closed facets to triangles: strip by strip and sector by sector, cut at the levels.
//!
//! No point is ever found twice: what facets share (vertices, points of arcs, of joints and of edges) is numbered first, then
//! every facet triangulates its own cell in terms of those numbers. Sharing is by number, never by coordinates.

mod cell;
mod shared;

use super::arcs::Arcs;
use super::closure::Closure;
use super::facet::FacetId;
use super::network::Given;
use super::refine::Cut;
use super::trim::Sheet;
use cell::Cell;
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use shared::Shared;

/// Number of a mesh vertex.
pub type PointId = u32;

/// What a mesh edge that is more than a diagonal stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Trace {
    /// Part of the level curve with this index.
    Level(u32),
    /// Part of a crease between two strips or cones.
    Crease,
    /// Part of the line: of the edge of the network with this number.
    Hinge(u32),
}

/// A mesh edge with a meaning.
pub type Traced = (Trace, [PointId; 2]);

/// A point of an edge of the network: the ends are nodes, these lie between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EdgePoint {
    /// Distance from the edge's start.
    pub s: f64,
    /// The mesh vertex.
    pub id: PointId,
    /// The given vertex, unless it is only a crossing with a level or where the edge is buried.
    pub given: Option<Given>,
}

/// Triangles of the slope with what is known of them.
#[derive(Default)]
pub struct Slopes {
    /// Vertices, heights of the falling sheet, local frame.
    pub points: Vec<DVec3>,
    /// Counter-clockwise triangles.
    pub triangles: Vec<[PointId; 3]>,
    /// The facet each triangle lies in.
    pub facets: Vec<FacetId>,
    /// Mesh edges with a meaning; those that two facets share come twice.
    pub traces: Vec<Traced>,
    /// Points of each edge between its ends, from start to end.
    pub edge_points: Vec<Vec<EdgePoint>>,
    /// Facets whose cell could not be triangulated.
    pub failed: Vec<FacetId>,
    /// Length of the longest ruling.
    pub longest_ruling: f64,
}

/// Plan coordinates of points that are not given are whole multiples of 1/`GRAINS` (length units): what rounding leaves of a round number is
/// dust (10⁻¹⁷) that would keep a ruling from running along the edge of a ground, or of another mesh, where it does.
const GRAINS: f64 = (1_u64 << 42) as f64;

/// The point with the dust off.
fn dusted(p: DVec3) -> DVec3 {
    // Coordinates so large that they have no such fractions stay what they are.
    let plan = p.truncate();
    // The nought added takes the sign off another.
    ((plan * GRAINS).round() / GRAINS + DVec2::ZERO).extend(p.z)
}

/// Facets that are triangulated at one go: lists for each of them would cost more than what is in them.
const AT_ONE_GO: usize = 128;

/// Triangulates all wanted facets.
pub fn emit(sheet: &Sheet, closure: &Closure, arcs: &Arcs, cut: &Cut) -> Slopes {
    let shared = Shared::new(sheet, closure, arcs, cut);
    let wanted: Vec<FacetId> = (0..sheet.fans.facets.len() as FacetId)
        .filter(|&f| sheet.facet(f).wanted && !arcs.pieces[f as usize].is_empty())
        .collect();
    let base = shared.count();
    let cells: Vec<Cell> = wanted.par_chunks(AT_ONE_GO).map(|facets| shared.cell(facets)).collect();
    let mut slopes = Slopes::default();
    slopes.points.reserve(shared.points.len() + cells.iter().map(|c| c.points.len()).sum::<usize>());
    slopes.triangles.reserve(cells.iter().map(|c| c.triangles.len()).sum());
    slopes.facets.reserve(slopes.triangles.capacity());
    slopes.traces.reserve(cells.iter().map(|c| c.traces.len()).sum());
    slopes.points.extend_from_slice(&shared.points);
    for cell in cells {
        // A cell numbers its own points from `base`; they move behind those of the cells before it.
        let shift = slopes.points.len() as PointId - base;
        let place = |id: PointId| if id >= base { id + shift } else { id };
        let before = slopes.triangles.len();
        slopes.points.extend_from_slice(&cell.points);
        slopes.triangles.extend(cell.triangles.iter().map(|t| t.map(place)));
        for (f, upto) in cell.facets {
            slopes.facets.resize(before + upto, f);
        }
        slopes.traces.extend(cell.traces.iter().map(|&(kind, ends)| (kind, ends.map(place))));
        slopes.failed.extend(cell.failed);
        slopes.longest_ruling = slopes.longest_ruling.max(cell.longest);
    }
    slopes.edge_points = shared.edge_points;
    slopes
}
