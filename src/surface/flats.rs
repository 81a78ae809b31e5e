//! Platforms inside rings and floors of pits.

use super::SurfaceError;
use super::buried::{Found, freeing};
use super::formation::{Roads, Threads};
use crate::kernel::segment;
use crate::kernel::segment_tree::SegmentTree;
use crate::mesh::check::HalfEdges;
use crate::mesh::region::{self, RegionError};
use crate::model::{Chain, Design, Extent, Line, Note, Role, Sheet};
use crate::slope::emit::{Slopes, Trace};
use crate::slope::network::{Edge, Network};
use glam::DVec2;
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

/// Places nearer to the outline of a platform in plan (length units) lie on it.
const ON_OUTLINE: f64 = 1e-6;

/// Whether edge `edge` bounds a platform on side `side`: the unsloped inside of a ring.
fn bounds_platform(edge: &Edge, side: usize) -> bool {
    edge.interior[side] && !edge.wanted[side]
}

/// Refuses platforms and rims that slopes pass over.
pub(super) fn refuse_covered(line: &Line, design: &Design, network: &Network, hidden: &Found) -> Result<(), SurfaceError> {
    if network.edges.iter().any(|edge| bounds_platform(edge, 0) || bounds_platform(edge, 1)) {
        keep_off(line, network)?;
        if let Some(b) = hidden.stretches.iter().find(|b| line.chains[b.chain].closed()) {
            return Err(SurfaceError::PlatformCovered { x: b.at.x, y: b.at.y, what: b.told(line, design) });
        }
    } else if design.only_inside(line) {
        keep_inside(line, design, hidden)?;
    }
    Ok(())
}

/// Refuses lines that run over a platform, at whatever height: their slopes would pass over it. Along its edge they may run.
fn keep_off(line: &Line, network: &Network) -> Result<(), SurfaceError> {
    let outline: Vec<usize> =
        (0..network.edges.len()).filter(|&e| (0..2).any(|side| bounds_platform(&network.edges[e], side))).collect();
    let plan = |node: u32| network.nodes[node as usize].truncate();
    let ends: Vec<_> = outline.iter().map(|&e| [plan(network.edges[e].a), plan(network.edges[e].b)]).collect();
    let tree = SegmentTree::new(&ends.iter().map(|&[a, b]| (a, b)).collect::<Vec<_>>());
    // With the platform on one side only; those with one on both sides are inside of it.
    let bounds: Vec<bool> =
        outline.iter().map(|&e| bounds_platform(&network.edges[e], 0) != bounds_platform(&network.edges[e], 1)).collect();
    let on_platform = |p: DVec2| {
        let mut inside = false;
        tree.ray(p, |i| {
            let [a, b] = ends[i];
            let left = (b - a).perp_dot(p - a) > 0.0;
            inside ^= bounds[i] && (a.y > p.y) != (b.y > p.y) && left == (b.y > a.y);
        });
        inside
    };
    for edge in network.edges.iter().filter(|edge| edge.interior == [false; 2]) {
        let chain = &line.chains[edge.given[0].chain as usize];
        if chain.closed() {
            continue;
        }
        let (a, b) = (plan(edge.a), plan(edge.b));
        let (length, middle) = (a.distance(b), 0.5 * (a + b));
        let mut places = vec![0.0, 1.0];
        tree.near(middle, 0.5 * length, |i| {
            places.extend(segment::meeting([a, b], ends[i]).points().map(|p| segment::foot(p, [a, b])))
        });
        places.sort_unstable_by(f64::total_cmp);
        for part in places.windows(2).filter(|part| (part[1] - part[0]) * length > ON_OUTLINE) {
            let p = a.lerp(b, 0.5 * (part[0] + part[1]));
            let mut on_outline = false;
            tree.near(p, ON_OUTLINE, |i| on_outline |= segment::distance(p, ends[i]) <= ON_OUTLINE);
            if !on_outline && on_platform(p) {
                let at = network.world(p.extend(0.0));
                return Err(SurfaceError::LineOnPlatform { name: chain.name.clone(), x: at.x, y: at.y });
            }
        }
    }
    Ok(())
}

/// Fills platforms (inside rings that slope outwards) or the floor (where slopes inside rings end). Vertices of breaklines are
/// added to the points of `slopes`.
pub(super) fn fill(line: &Line, design: &Design, network: &Network, slopes: &mut Slopes) -> Result<Flats, SurfaceError> {
    let outline = platform_outline(network, slopes);
    if !outline.is_empty() {
        return platform(line, network, slopes, outline).map_err(|cause| flat_error(network, "platform", cause));
    }
    let mut flats = Flats::default();
    if !line.breaklines.is_empty() {
        let text = format!("breaklines and spot heights without a platform to shape: {}", line.breaklines.len());
        flats.notes.push(Note::new("breaklines-unused", text));
    }
    if !design.only_inside(line) {
        return Ok(flats);
    }
    let rim = rim(slopes);
    if rim.is_empty() {
        return Ok(flats);
    }
    flats.triangles = region::fill(&slopes.points, &rim).map_err(|cause| flat_error(network, "floor", cause))?;
    Ok(flats)
}

/// Part of the length of a ring that may show although all of it is hidden: rounding of stations.
const ALL_BUT: f64 = 1e-9;

/// Slopes inside a ring begin at every place of it, else they or the floor would pass over it and go on outside. Holes that lie
/// wholly under the slopes or the floor are covered by them, and rings that lie wholly beyond the end have neither.
fn keep_inside(line: &Line, design: &Design, hidden: &Found) -> Result<(), SurfaceError> {
    let length = |chain: &Chain| chain.stations().last().copied().unwrap_or(0.0);
    let shares = |chain: usize| {
        let covered: f64 = hidden.stretches.iter().filter(|b| b.chain == chain).map(|b| b.to - b.from).sum();
        let beyond: f64 = hidden.below.iter().filter(|b| b.0 == chain).map(|b| b.2 - b.1).sum();
        let all = length(&line.chains[chain]) * (1.0 - ALL_BUT);
        (covered, beyond, covered + beyond >= all)
    };
    for b in &hidden.stretches {
        let (.., wholly) = shares(b.chain);
        if !(wholly && matches!(line.chains[b.chain].role, Role::Hole { .. })) {
            let apart = "build the rings one by one, or move them apart";
            let cure = match freeing(&hidden.stretches) {
                Some(slope) if b.chain == b.by_chain => format!("use {slope} or steeper, or blunt the corner"),
                Some(slope) => format!("use {slope} or steeper; {apart}"),
                None => apart.to_owned(),
            };
            return Err(SurfaceError::RimCovered { x: b.at.x, y: b.at.y, what: b.told(line, design), cure });
        }
    }
    for &(chain, from, to) in &hidden.below {
        let Extent::Elevation(end) = design.extent else { continue };
        if shares(chain).2 {
            continue;
        }
        let chain = &line.chains[chain];
        let heights = chain.vertices.iter().map(|v| v.z);
        let (beyond, limit) = match design.sheet {
            Sheet::Falling => ("below", heights.fold(f64::INFINITY, f64::min)),
            Sheet::Rising => ("above", heights.fold(f64::NEG_INFINITY, f64::max)),
        };
        let Some(at) = chain.vertices.iter().find(|v| v.z == limit) else { continue };
        let what = format!(
            "`{}` goes down to {limit} there and lies {beyond} the end at {end} from station {from:.3} to {to:.3}",
            chain.name
        );
        let what = if design.sheet == Sheet::Rising { what.replace("goes down", "goes up") } else { what };
        return Err(SurfaceError::RimBeyondEnd { x: at.x, y: at.y, what, beyond, limit });
    }
    Ok(())
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
            if !bounds_platform(edge, side) {
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
    // An edge with a platform on either side, as where a road goes on in another, is an outline for both.
    let own = |edge: &usize| network.edges[*edge].interior != [true; 2];
    let edges: FxHashSet<usize> = outline.iter().map(|piece| piece.edge).filter(own).collect();
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
