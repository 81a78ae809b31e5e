//! The cells of facets in triangles.

use super::shared::Shared;
use super::{EdgePoint, PointId, Trace, Traced, dusted};
use crate::kernel::range::held;
use crate::slope::arcs::Piece;
use crate::slope::closure::VertexId;
use crate::slope::facet::{END, FacetId, Kind, Lateral};
use crate::slope::levels::Code;
use crate::slope::polygon::{self, Corner};
use crate::slope::refine::REACH_SNAP;
use glam::DVec3;

/// What some facets contribute.
#[derive(Default)]
pub(super) struct Cell {
    pub(super) points: Vec<DVec3>,
    pub(super) triangles: Vec<[PointId; 3]>,
    /// Each facet, and how many triangles there are up to the end of it.
    pub(super) facets: Vec<(FacetId, usize)>,
    pub(super) traces: Vec<Traced>,
    pub(super) failed: Vec<FacetId>,
    pub(super) longest: f64,
}

/// A place on the far boundary of a facet.
#[derive(Clone, Copy, Debug)]
struct Far {
    tau: f64,
    r: f64,
    id: PointId,
    /// Whether another wanted facet lies beyond the stretch up to the next place.
    shared: bool,
}

impl Shared<'_> {
    /// Triangulates some facets, which number points of their own from [`Self::count`] on.
    pub(super) fn cell(&self, facets: &[FacetId]) -> Cell {
        let mut cell = Cell::default();
        for &f in facets {
            match self.sheet.facet(f).kind {
                Kind::Strip(_) => self.strip(f, &mut cell),
                Kind::Sector(_) => self.sector(f, &mut cell),
            }
            cell.facets.push((f, cell.triangles.len()));
        }
        cell
    }

    fn point(&self, id: PointId, cell: &Cell) -> DVec3 {
        match id.checked_sub(self.count()) {
            Some(own) => cell.points[own as usize],
            None => self.points[id as usize],
        }
    }

    /// Numbers a point of the cell's own.
    fn add(&self, point: DVec3, cell: &mut Cell) -> PointId {
        cell.points.push(dusted(point));
        self.count() + cell.points.len() as PointId - 1
    }

    /// The far boundary of facet `f` over consecutive pieces, cut off at the outer distance.
    fn far(&self, f: FacetId, pieces: &[Piece], cell: &mut Cell) -> Vec<Far> {
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
            Some(reach) => self.cut_off(f, &far, reach, cell),
            None => far,
        }
    }

    /// Replaces what lies beyond the outer distance. Arcs are cut there already, joints end there.
    fn cut_off(&self, f: FacetId, far: &[Far], reach: f64, cell: &mut Cell) -> Vec<Far> {
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
            let ends = [p.id, q.id].map(|id| self.point(id, cell));
            let points = if facet.is_strip() {
                self.cut.level_points_of_segment(ends)
            } else {
                self.cut.circle(facet, p.tau, q.tau, reach, facet.z0 - facet.drop * reach)
            };
            for point in points {
                let id = self.add(point, cell);
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
    fn strip(&self, f: FacetId, cell: &mut Cell) {
        let pieces = &self.arcs.pieces[f as usize];
        let mut from = 0;
        while from < pieces.len() {
            let mut to = from + 1;
            while to < pieces.len() && self.end_of(&pieces[to - 1]) == self.start_of(&pieces[to]) {
                to += 1;
            }
            let far = self.far(f, &pieces[from..to], cell);
            self.strip_run(f, &far, cell);
            from = to;
        }
    }

    fn start_of(&self, piece: &Piece) -> VertexId {
        self.arcs.arcs[piece.arc as usize].ends[usize::from(!piece.forward)]
    }

    fn end_of(&self, piece: &Piece) -> VertexId {
        self.arcs.arcs[piece.arc as usize].ends[usize::from(piece.forward)]
    }

    fn strip_run(&self, f: FacetId, far: &[Far], cell: &mut Cell) {
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
            let p = self.point(id, cell);
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
    fn sector(&self, f: FacetId, cell: &mut Cell) {
        let facet = self.sheet.facet(f);
        let Kind::Sector(node) = facet.kind else { return };
        let far = self.far(f, &self.arcs.pieces[f as usize], cell);
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
                let tip = self.point(end, cell);
                for u in self.cut.levels.crossed(apex.z, tip.z) {
                    let c = self.cut.levels.heights[u];
                    ids.push(self.add(apex.lerp(tip, (c - apex.z) / (tip.z - apex.z)).truncate().extend(c), cell));
                }
            }
            ids.push(end);
            ids
        };
        let mut left = ladder(0, cell);
        for i in 1..far.len() {
            let right = ladder(i, cell);
            self.wedge(&left, &right, cell);
            left = right;
        }
    }

    /// Triangles between two rulings from the same node, in step with the levels.
    fn wedge(&self, left: &[PointId], right: &[PointId], cell: &mut Cell) {
        let (mut i, mut j) = (0, 0);
        while i + 1 < left.len() || j + 1 < right.len() {
            let code = |ids: &[PointId], at: usize, cell: &Cell| {
                ids.get(at + 1).map_or(Code::MAX, |&id| self.code(self.point(id, cell)))
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
