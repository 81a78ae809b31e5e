//! From closed facets to triangles: strip by strip and sector by sector, cut at the levels.
//!
//! No point is ever found twice: what facets share (vertices, points of arcs, of joints and of edges) is numbered first, then
//! every facet triangulates its own cell in terms of those numbers. Sharing is by number, never by coordinates.

use super::arcs::{Arcs, Piece};
use super::closure::{Closure, Knot, VertexId};
use super::facet::{END, FacetId, Kind, Lateral};
use super::levels::Code;
use super::network::{Given, twin};
use super::polygon::{self, Corner};
use super::refine::{Cut, REACH_SNAP};
use super::trim::Sheet;
use crate::kernel::range::held;
use glam::DVec3;
use rayon::prelude::*;

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

/// Shared points, numbered.
struct Shared<'a> {
    sheet: &'a Sheet<'a>,
    closure: &'a Closure,
    arcs: &'a Arcs,
    cut: &'a Cut<'a>,
    points: Vec<DVec3>,
    arc_start: Vec<PointId>,
    joint_start: Vec<PointId>,
    edge_points: Vec<Vec<EdgePoint>>,
}

/// What some facets contribute.
#[derive(Default)]
struct Cell {
    points: Vec<DVec3>,
    triangles: Vec<[PointId; 3]>,
    /// Each facet, and how many triangles there are up to the end of it.
    facets: Vec<(FacetId, usize)>,
    traces: Vec<Traced>,
    failed: Vec<FacetId>,
    longest: f64,
}

/// Facets that are triangulated at one go: lists for each of them would cost more than what is in them.
const AT_ONE_GO: usize = 128;

/// A place on the far boundary of a facet.
#[derive(Clone, Copy, Debug)]
struct Far {
    tau: f64,
    r: f64,
    id: PointId,
    /// Whether another wanted facet lies beyond the stretch up to the next place.
    shared: bool,
}

/// Triangulates all wanted facets.
pub fn emit(sheet: &Sheet, closure: &Closure, arcs: &Arcs, cut: &Cut) -> Slopes {
    let shared = Shared::new(sheet, closure, arcs, cut);
    let wanted: Vec<FacetId> = (0..sheet.fans.facets.len() as FacetId)
        .filter(|&f| sheet.facet(f).wanted && !arcs.pieces[f as usize].is_empty())
        .collect();
    let base = shared.points.len() as PointId;
    let cells: Vec<Cell> = wanted.par_chunks(AT_ONE_GO).map(|facets| shared.cell(facets, base)).collect();
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

impl<'a> Shared<'a> {
    fn new(sheet: &'a Sheet<'a>, closure: &'a Closure, arcs: &'a Arcs, cut: &'a Cut<'a>) -> Self {
        let mut shared = Self {
            sheet,
            closure,
            arcs,
            cut,
            points: closure.vertices.clone(),
            arc_start: Vec::new(),
            joint_start: Vec::new(),
            edge_points: Vec::new(),
        };
        shared.number_arcs();
        shared.number_joints();
        shared.number_edges();
        shared
    }

    fn number_arcs(&mut self) {
        let vertex = |v: VertexId| self.closure.vertices[v as usize];
        let inner: Vec<Vec<DVec3>> =
            self.arcs.arcs.par_iter().map(|arc| self.cut.arc_points(self.sheet, arc, arc.ends.map(vertex))).collect();
        self.arc_start.reserve(inner.len() + 1);
        for points in inner {
            self.arc_start.push(self.points.len() as PointId);
            self.points.extend(points);
        }
        self.arc_start.push(self.points.len() as PointId);
    }

    /// Length of a joint's ruling in the mesh.
    fn joint_length(&self, j: u32) -> f64 {
        let r = self.closure.tips[j as usize].r;
        self.cut.reach.map_or(r, |reach| if r > reach + REACH_SNAP { reach } else { r })
    }

    fn number_joints(&mut self) {
        for (j, joint) in self.sheet.fans.joints.iter().enumerate() {
            self.joint_start.push(self.points.len() as PointId);
            let tip = self.closure.tips[j];
            let length = self.joint_length(j as u32);
            if length <= 0.0 || !(self.sheet.facet(joint.left).wanted || self.sheet.facet(joint.right).wanted) {
                continue;
            }
            let node = self.closure.vertices[joint.node as usize];
            // The tip may have been merged with a vertex nearby: the ruling runs there.
            let end = self.closure.vertices[self.arcs.vertex(self.tip_vertex(j as u32)) as usize];
            let end = if length < tip.r { node.lerp(end, length / tip.r) } else { end };
            for u in self.cut.levels.crossed(node.z, end.z) {
                let c = self.cut.levels.heights[u];
                self.points.push(node.lerp(end, (c - node.z) / (end.z - node.z)).truncate().extend(c));
            }
            if length < tip.r {
                self.points.push(end);
            }
        }
        self.joint_start.push(self.points.len() as PointId);
    }

    fn tip_vertex(&self, joint: u32) -> VertexId {
        self.sheet.network.nodes.len() as VertexId + joint
    }

    fn number_edges(&mut self) {
        for (e, edge) in self.sheet.network.edges.iter().enumerate() {
            let (a, b) = (self.points[edge.a as usize], self.points[edge.b as usize]);
            let length = self.sheet.facet(2 * e as FacetId).tau_max;
            let mut list: Vec<EdgePoint> = Vec::with_capacity(edge.inner.len());
            let mut before = (0.0, a);
            let ends = edge.inner.iter().map(|p| (p.s, p.point, Some(p.given))).chain([(length, b, None)]);
            for (s, point, given) in ends {
                for u in self.cut.levels.crossed(before.1.z, point.z) {
                    let c = self.cut.levels.heights[u];
                    let t = (c - before.1.z) / (point.z - before.1.z);
                    list.push(EdgePoint { s: before.0 + (s - before.0) * t, id: self.points.len() as PointId, given: None });
                    self.points.push(before.1.lerp(point, t).truncate().extend(c));
                }
                if given.is_some() {
                    list.push(EdgePoint { s, id: self.points.len() as PointId, given });
                    self.points.push(point);
                }
                before = (s, point);
            }
            list.extend(self.entries(e as u32, length));
            list.sort_by(|p, q| p.s.total_cmp(&q.s).then(p.id.cmp(&q.id)));
            list.dedup_by_key(|p| p.id);
            self.edge_points.push(list);
        }
    }

    /// Where edge `e` goes under the slope of another part or beyond the end: a platform on its other side has a vertex there.
    fn entries(&self, e: u32, length: f64) -> impl Iterator<Item = EdgePoint> {
        let nodes = self.sheet.network.nodes.len() as PointId;
        [2 * e, 2 * e + 1].into_iter().flat_map(move |h| {
            let at_entry = move |k: &&Knot| (k.left == twin(h)) != (k.right == twin(h));
            let s = move |tau: f64| if h & 1 == 0 { tau } else { length - tau };
            let knots = self.closure.knots[h as usize].iter().filter(at_entry);
            let points = knots.map(move |k| EdgePoint { s: s(k.tau), id: self.arcs.vertex(k.vertex), given: None });
            points.filter(move |p| p.id >= nodes)
        })
    }

    fn cell(&self, facets: &[FacetId], base: PointId) -> Cell {
        let mut cell = Cell::default();
        for &f in facets {
            match self.sheet.facet(f).kind {
                Kind::Strip(_) => self.strip(f, base, &mut cell),
                Kind::Sector(_) => self.sector(f, base, &mut cell),
            }
            cell.facets.push((f, cell.triangles.len()));
        }
        cell
    }

    fn point(&self, id: PointId, base: PointId, cell: &Cell) -> DVec3 {
        if id >= base { cell.points[(id - base) as usize] } else { self.points[id as usize] }
    }

    /// The far boundary of facet `f` over consecutive pieces, cut off at the outer distance.
    fn far(&self, f: FacetId, pieces: &[Piece], base: PointId, cell: &mut Cell) -> Vec<Far> {
        let facet = self.sheet.facet(f);
        let mut far: Vec<Far> = Vec::new();
        for piece in pieces {
            let arc = &self.arcs.arcs[piece.arc as usize];
            let range = self.arc_start[piece.arc as usize]..self.arc_start[piece.arc as usize + 1];
            let wanted = |g: FacetId| g != END && self.sheet.facet(g).wanted;
            let shared = wanted(arc.owner) && wanted(arc.partner);
            let inner: Vec<PointId> = if piece.forward { range.collect() } else { range.rev().collect() };
            let first = if piece.forward { arc.ends[0] } else { arc.ends[1] };
            for (i, id) in std::iter::once(first).chain(inner).enumerate() {
                let (tau, r) = facet.parameters(self.points[id as usize].truncate());
                let tau = if i == 0 { piece.tau[0] } else { held(tau, piece.tau) };
                far.push(Far { tau, r, id, shared });
            }
        }
        if let Some(last) = pieces.last() {
            let arc = &self.arcs.arcs[last.arc as usize];
            let id = if last.forward { arc.ends[1] } else { arc.ends[0] };
            let (_, r) = facet.parameters(self.points[id as usize].truncate());
            far.push(Far { tau: last.tau[1], r, id, shared: false });
        }
        match self.cut.reach {
            Some(reach) => self.cut_off(f, &far, reach, base, cell),
            None => far,
        }
    }

    /// Replaces what lies beyond the outer distance. Arcs are cut there already, joints end there.
    fn cut_off(&self, f: FacetId, far: &[Far], reach: f64, base: PointId, cell: &mut Cell) -> Vec<Far> {
        let facet = self.sheet.facet(f);
        let beyond = |p: &Far| p.r > reach + REACH_SNAP;
        let mut out: Vec<Far> = Vec::new();
        for (i, p) in far.iter().enumerate() {
            if !beyond(p) {
                let leaves = far.get(i + 1).is_some_and(&beyond);
                out.push(Far { shared: p.shared && !leaves, ..*p });
            } else if i == 0 || i + 1 == far.len() {
                // The end of the cell is a shared ruling, cut at the distance.
                if let Lateral::Joint(j) = facet.lateral[usize::from(i > 0)] {
                    let id = self.joint_start[j as usize + 1] - 1;
                    out.push(Far { tau: p.tau, r: reach, id, shared: false });
                }
            }
        }
        let mut whole: Vec<Far> = Vec::with_capacity(out.len());
        for (i, p) in out.iter().enumerate() {
            whole.push(*p);
            // Stretches along the distance, not those towards a facet that is not wanted.
            let at_reach = |p: &Far| (p.r - reach).abs() <= REACH_SNAP;
            let Some(q) = out.get(i + 1).filter(|q| !p.shared && at_reach(p) && at_reach(q)) else { continue };
            let ends = [p.id, q.id].map(|id| self.point(id, base, cell));
            let points = if facet.is_strip() {
                self.cut.level_points_of_segment(ends)
            } else {
                self.cut.circle(facet, p.tau, q.tau, reach, facet.z0 - facet.drop * reach)
            };
            for point in points {
                let id = base + cell.points.len() as PointId;
                cell.points.push(point);
                let tau = held(facet.parameters(point.truncate()).0, [p.tau, q.tau]);
                whole.push(Far { tau, r: reach, id, shared: false });
            }
        }
        whole
    }

    /// Level points of a joint from its node outwards, without its `end`.
    fn joint_ladder(&self, j: u32, end: PointId) -> Vec<PointId> {
        let range = self.joint_start[j as usize]..self.joint_start[j as usize + 1];
        range.filter(|&id| id != end).collect()
    }

    fn code(&self, p: DVec3) -> Code {
        self.cut.levels.code(p.z)
    }

    /// A strip: one polygon per visible stretch of its edge, sliced at the levels.
    fn strip(&self, f: FacetId, base: PointId, cell: &mut Cell) {
        let pieces = &self.arcs.pieces[f as usize];
        let mut from = 0;
        while from < pieces.len() {
            let mut to = from + 1;
            while to < pieces.len() && self.end_of(&pieces[to - 1]) == self.start_of(&pieces[to]) {
                to += 1;
            }
            let far = self.far(f, &pieces[from..to], base, cell);
            self.strip_run(f, &far, base, cell);
            from = to;
        }
    }

    fn start_of(&self, piece: &Piece) -> VertexId {
        self.arcs.arcs[piece.arc as usize].ends[usize::from(!piece.forward)]
    }

    fn end_of(&self, piece: &Piece) -> VertexId {
        self.arcs.arcs[piece.arc as usize].ends[usize::from(piece.forward)]
    }

    fn strip_run(&self, f: FacetId, far: &[Far], base: PointId, cell: &mut Cell) {
        let facet = self.sheet.facet(f);
        let (Some(first), Some(last)) = (far.first().copied(), far.last().copied()) else { return };
        let Kind::Strip(h) = facet.kind else { return };
        let nodes = [self.sheet.network.origin(h), self.sheet.network.target(h)];
        let joint_at = |i: usize, p: &Far| match facet.lateral[i] {
            Lateral::Joint(j) if p.tau == [0.0, facet.tau_max][i] && p.id != nodes[i] => Some(j),
            _ => None,
        };
        let (left, right) = (joint_at(0, &first), joint_at(1, &last));
        let corner = |id: PointId, tau: f64, r: f64, near: bool, cell: &Cell| {
            let p = self.point(id, base, cell);
            Corner { id, tau, r, plan: p.truncate(), code: self.code(p), near }
        };
        // Along the edge, out along the right ruling, back along the far boundary, home along the left ruling.
        let mut ring: Vec<Corner> = Vec::with_capacity(far.len() + 8);
        let begin = if left.is_some() { (nodes[0], 0.0) } else { (first.id, first.tau) };
        ring.push(corner(begin.0, begin.1, 0.0, true, cell));
        let points = &self.edge_points[(h / 2) as usize];
        let foot = |p: &EdgePoint| if h & 1 == 0 { p.s } else { facet.tau_max - p.s };
        let within = |p: &&EdgePoint| foot(p) > first.tau && foot(p) < last.tau && p.id != first.id && p.id != last.id;
        let mut on_edge: Vec<&EdgePoint> = points.iter().filter(within).collect();
        if h & 1 == 1 {
            on_edge.reverse();
        }
        ring.extend(on_edge.into_iter().map(|p| corner(p.id, foot(p), 0.0, true, cell)));
        let end = if right.is_some() { (nodes[1], facet.tau_max) } else { (last.id, last.tau) };
        ring.push(corner(end.0, end.1, 0.0, true, cell));
        cell.traces.extend(ring.windows(2).map(|w| (Trace::Hinge(h / 2), [w[0].id, w[1].id])));
        let rung = |id: PointId, tau: f64| corner(id, tau, facet.parameters(self.points[id as usize].truncate()).1, false, cell);
        if let Some(j) = right {
            ring.extend(self.joint_ladder(j, last.id).into_iter().map(|id| rung(id, facet.tau_max)));
        }
        let (skip_first, skip_last) = (usize::from(left.is_none()), usize::from(right.is_none()));
        ring.extend(far[skip_first..far.len() - skip_last].iter().rev().map(|p| corner(p.id, p.tau, p.r, false, cell)));
        if let Some(j) = left {
            ring.extend(self.joint_ladder(j, first.id).into_iter().rev().map(|id| rung(id, 0.0)));
        }
        cell.longest = far.iter().fold(cell.longest, |m, p| m.max(p.r));
        Self::trace_far(far, cell);
        let mut slice = polygon::Slice::new(facet.d);
        if !slice.triangulate(&ring, &mut cell.triangles) {
            cell.failed.push(f);
        }
        cell.traces.extend(slice.chords.iter().map(|&(u, ends)| (Trace::Level(u), ends)));
    }

    fn trace_far(far: &[Far], cell: &mut Cell) {
        cell.traces.extend(far.windows(2).filter(|w| w[0].shared).map(|w| (Trace::Crease, [w[0].id, w[1].id])));
    }

    /// A sector: a fan of wedges between neighbouring rulings, each a plane through the node.
    fn sector(&self, f: FacetId, base: PointId, cell: &mut Cell) {
        let facet = self.sheet.facet(f);
        let Kind::Sector(node) = facet.kind else { return };
        let far = self.far(f, &self.arcs.pieces[f as usize], base, cell);
        cell.longest = far.iter().fold(cell.longest, |m, p| m.max(p.r));
        Self::trace_far(&far, cell);
        let joints = facet.lateral.map(|l| if let Lateral::Joint(j) = l { Some(j) } else { None });
        let apex = self.closure.vertices[node as usize];
        let ladder = |i: usize, cell: &mut Cell| -> Vec<PointId> {
            let end = far[i].id;
            if end == node {
                return vec![node];
            }
            let side = if i == 0 {
                joints[0]
            } else if i + 1 == far.len() {
                joints[1]
            } else {
                None
            };
            let mut ids = vec![node];
            if let Some(j) = side {
                ids.extend(self.joint_ladder(j, end));
            } else {
                let tip = self.point(end, base, cell);
                for u in self.cut.levels.crossed(apex.z, tip.z) {
                    let c = self.cut.levels.heights[u];
                    ids.push(base + cell.points.len() as PointId);
                    cell.points.push(apex.lerp(tip, (c - apex.z) / (tip.z - apex.z)).truncate().extend(c));
                }
            }
            ids.push(end);
            ids
        };
        let mut left = ladder(0, cell);
        for i in 1..far.len() {
            let right = ladder(i, cell);
            self.wedge(&left, &right, base, cell);
            left = right;
        }
    }

    /// Triangles between two rulings from the same node, in step with the levels.
    fn wedge(&self, left: &[PointId], right: &[PointId], base: PointId, cell: &mut Cell) {
        let (mut i, mut j) = (0, 0);
        while i + 1 < left.len() || j + 1 < right.len() {
            let code = |ids: &[PointId], at: usize, cell: &Cell| {
                ids.get(at + 1).map_or(Code::MAX, |&id| self.code(self.point(id, base, cell)))
            };
            let (next_left, next_right) = (code(left, i, cell), code(right, j, cell));
            // At the node both rulings stand on one point; elsewhere the higher side goes first, and both on a level.
            if next_left < next_right {
                if left[i] != right[j] {
                    cell.triangles.push([left[i], right[j], left[i + 1]]);
                }
                i += 1;
            } else if next_right < next_left {
                if left[i] != right[j] {
                    cell.triangles.push([left[i], right[j], right[j + 1]]);
                }
                j += 1;
            } else {
                if left[i] != right[j] {
                    cell.triangles.push([left[i], right[j], right[j + 1]]);
                }
                cell.triangles.push([left[i], right[j + 1], left[i + 1]]);
                i += 1;
                j += 1;
                if next_left % 2 == 1 && (i + 1 < left.len() || j + 1 < right.len()) {
                    cell.traces.push((Trace::Level(next_left / 2), [left[i], right[j]]));
                }
            }
        }
    }
}
