//! Platforms inside rings and floors of pits.

use super::formation::{Roads, Threads};
use super::{Buried, SurfaceError};
use crate::mesh::check::HalfEdges;
use crate::mesh::region::{self, RegionError};
use crate::model::{Design, Line, Note, Side};
use crate::slope::emit::{Slopes, Trace};
use crate::slope::network::Network;
use rustc_hash::FxHashSet;

/// Flat parts, in numbers of the emission.
#[derive(Default)]
pub(super) struct Flats {
    /// Counter-clockwise triangles.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Vertices of roads: vertex, chain, station on the centre line.
    pub(super) stations: Vec<(u32, u32, f64)>,
    /// Edges of breaklines: breakline, ends.
    pub(super) breaks: Vec<(u32, [u32; 2])>,
    /// Things worth knowing.
    pub(super) notes: Vec<Note>,
}

/// Fills platforms (inside rings that slope outwards) or the floor (where slopes inside rings end). Vertices of breaklines are
/// added to the points of `slopes`.
pub(super) fn fill(
    line: &Line,
    design: &Design,
    network: &Network,
    slopes: &mut Slopes,
    buried: &[Buried],
) -> Result<Flats, SurfaceError> {
    let outline = platform_outline(network, slopes);
    if !outline.is_empty() {
        if let Some(b) = buried.iter().find(|b| line.chains[b.chain].closed()) {
            let (x, y) = (b.at.x, b.at.y);
            let what = format!(
                "`{}` lies up to {:.3} below the slope of `{}` from station {:.3} to {:.3}",
                line.chains[b.chain].name, b.depth, line.chains[b.by_chain].name, b.from, b.to
            );
            return Err(SurfaceError::PlatformCovered { x, y, what });
        }
        return platform(line, network, slopes, outline).map_err(|cause| flat_error(network, "platform", cause));
    }
    let mut flats = Flats::default();
    if !line.breaklines.is_empty() {
        let text = format!("breaklines and spot heights without a platform to shape: {}", line.breaklines.len());
        flats.notes.push(Note::new("breaklines-unused", text));
    }
    let only_inside = design.side_of_rings == Side::Inside && line.chains.iter().all(|c| c.closed());
    if !only_inside {
        return Ok(flats);
    }
    let rim = rim(slopes);
    if rim.is_empty() {
        return Ok(flats);
    }
    flats.triangles = region::fill(&slopes.points, &rim).map_err(|cause| flat_error(network, "floor", cause))?;
    Ok(flats)
}

/// A piece of outline with the unsloped inside of a ring on its left.
struct Piece {
    /// Edge of the network.
    edge: usize,
    ids: Vec<u32>,
}

/// Edges of the line with the unsloped inside of a ring on their left.
fn platform_outline(network: &Network, slopes: &Slopes) -> Vec<Piece> {
    let mut outline = Vec::new();
    for (e, (edge, inner)) in network.edges.iter().zip(&slopes.edge_points).enumerate() {
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
            outline.push(Piece { edge: e, ids });
        }
    }
    outline
}

/// The platforms: roads strip by strip where they are nothing else, the rest at once.
fn platform(line: &Line, network: &Network, slopes: &mut Slopes, outline: Vec<Piece>) -> Result<Flats, RegionError> {
    let mut flats = Flats::default();
    let mut threads = Threads::default();
    if !line.breaklines.is_empty() {
        threads = Threads::new(line, network, slopes);
    }
    let roads = Roads::new(line, network, slopes);
    flats.stations = roads.stations(&threads);
    let edges: FxHashSet<usize> = outline.iter().map(|piece| piece.edge).collect();
    let mut stripped = vec![false; line.chains.len()];
    for (chain, done) in stripped.iter_mut().enumerate() {
        if let Some(triangles) = roads.strip(chain, &threads, &slopes.points, &edges) {
            flats.triangles.extend(triangles);
            *done = true;
        }
    }
    let chain_of = |edge: usize| network.edges[edge].given[0].chain as usize;
    let rest: Vec<&Piece> = outline.iter().filter(|piece| !stripped[chain_of(piece.edge)]).collect();
    let mut inner = Vec::new();
    for (index, (ids, of)) in threads.lines.iter().enumerate() {
        flats.breaks.extend(ids.windows(2).map(|w| (index as u32, [w[0], w[1]])));
        if of.is_some_and(|of| !stripped[of]) {
            inner.push(ids.clone());
        }
    }
    if !rest.is_empty() {
        let nodes: FxHashSet<u32> = inner.iter().flatten().copied().collect();
        let outline: Vec<Vec<u32>> = rest.iter().flat_map(|piece| split(&piece.ids, &nodes)).collect();
        flats.triangles.extend(region::fill_with(&slopes.points, &outline, &inner)?);
    }
    Ok(flats)
}

/// Cuts a piece of outline where breaklines end on it.
fn split(ids: &[u32], nodes: &FxHashSet<u32>) -> Vec<Vec<u32>> {
    let mut pieces = Vec::new();
    let mut from = 0;
    for to in 1..ids.len() {
        if to + 1 == ids.len() || nodes.contains(&ids[to]) {
            pieces.push(ids[from..=to].to_vec());
            from = to;
        }
    }
    pieces
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
