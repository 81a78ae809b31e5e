//! Platforms inside rings and floors of pits.

use super::{Buried, SurfaceError};
use crate::mesh::check::HalfEdges;
use crate::mesh::region::{self, RegionError};
use crate::model::{Design, Line, Side};
use crate::slope::emit::{Slopes, Trace};
use crate::slope::network::Network;
use rustc_hash::FxHashSet;

/// Triangles of platforms (inside rings that slope outwards) or of the floor (where slopes inside rings end), in numbers of
/// the emission.
pub(super) fn fill(
    line: &Line,
    design: &Design,
    network: &Network,
    slopes: &Slopes,
    buried: &[Buried],
) -> Result<Vec<[u32; 3]>, SurfaceError> {
    let platform = platform_outline(network, slopes);
    if !platform.is_empty() {
        if let Some(b) = buried.iter().find(|b| line.chains[b.chain].closed()) {
            let (x, y) = (b.at.x, b.at.y);
            let what = format!(
                "`{}` lies up to {:.3} below the slope of `{}` from station {:.3} to {:.3}",
                line.chains[b.chain].name, b.depth, line.chains[b.by_chain].name, b.from, b.to
            );
            return Err(SurfaceError::PlatformCovered { x, y, what });
        }
        return region::fill(&slopes.points, &platform).map_err(|cause| flat_error(network, "platform", cause));
    }
    let only_inside = design.side_of_rings == Side::Inside && line.chains.iter().all(|c| c.closed());
    if !only_inside {
        return Ok(Vec::new());
    }
    let rim = rim(slopes);
    if rim.is_empty() {
        return Ok(Vec::new());
    }
    region::fill(&slopes.points, &rim).map_err(|cause| flat_error(network, "floor", cause))
}

/// Edges of the line with the unsloped inside of a ring on their left.
fn platform_outline(network: &Network, slopes: &Slopes) -> Vec<Vec<u32>> {
    let mut outline = Vec::new();
    for (edge, inner) in network.edges.iter().zip(&slopes.edge_points) {
        for side in 0..2 {
            if !edge.interior[side] || edge.wanted[side] {
                continue;
            }
            let mut ids: Vec<u32> = vec![edge.a];
            ids.extend(inner.iter().map(|p| p.id));
            ids.push(edge.b);
            if side == 1 {
                ids.reverse();
            }
            outline.push(ids);
        }
    }
    outline
}

/// The boundary of the slopes away from the line, with the slopes on its right.
fn rim(slopes: &Slopes) -> Vec<Vec<u32>> {
    let hinge: FxHashSet<[u32; 2]> = slopes
        .traces
        .iter()
        .filter(|(kind, _)| matches!(kind, Trace::Hinge(_)))
        .flat_map(|&(_, [a, b])| [[a, b], [b, a]])
        .collect();
    let edges = HalfEdges::new(slopes.points.len(), &slopes.triangles);
    edges.open().into_iter().filter(|e| !hinge.contains(e)).map(|[a, b]| vec![b, a]).collect()
}

fn flat_error(network: &Network, part: &'static str, cause: RegionError) -> SurfaceError {
    let place = match &cause {
        RegionError::Crossing(p) | RegionError::Open(p) => network.world(*p),
        RegionError::Coordinate(_) => glam::DVec3::NAN,
    };
    SurfaceError::Flat { part, x: place.x, y: place.y, cause }
}
