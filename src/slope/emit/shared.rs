//! Numbers for the points that facets share.

use super::{EdgePoint, PointId, dusted};
use crate::slope::arcs::Arcs;
use crate::slope::closure::{Closure, Knot, VertexId};
use crate::slope::facet::FacetId;
use crate::slope::network::twin;
use crate::slope::refine::{Cut, REACH_SNAP};
use crate::slope::trim::Sheet;
use glam::DVec3;
use rayon::prelude::*;

/// Shared points, numbered.
pub(super) struct Shared<'a> {
    pub(super) sheet: &'a Sheet<'a>,
    pub(super) closure: &'a Closure,
    pub(super) arcs: &'a Arcs,
    pub(super) cut: &'a Cut<'a>,
    pub(super) points: Vec<DVec3>,
    /// Where the points of each arc begin, without its ends, and where those of the last one end.
    pub(super) arc_start: Vec<PointId>,
    /// The same of joints, without their nodes.
    pub(super) joint_start: Vec<PointId>,
    /// Points of each edge between its ends, from start to end.
    pub(super) edge_points: Vec<Vec<EdgePoint>>,
}

impl<'a> Shared<'a> {
    pub(super) fn new(sheet: &'a Sheet<'a>, closure: &'a Closure, arcs: &'a Arcs, cut: &'a Cut<'a>) -> Self {
        let (nodes, found) = closure.vertices.split_at(sheet.network.nodes.len());
        let mut shared = Self {
            sheet,
            closure,
            arcs,
            cut,
            points: nodes.iter().copied().chain(found.iter().copied().map(dusted)).collect(),
            arc_start: Vec::new(),
            joint_start: Vec::new(),
            edge_points: Vec::new(),
        };
        shared.number_arcs();
        shared.number_joints();
        shared.number_edges();
        shared
    }

    /// How many there are.
    pub(super) fn count(&self) -> PointId {
        self.points.len() as PointId
    }

    fn number_arcs(&mut self) {
        let vertex = |v: VertexId| self.closure.vertices[v as usize];
        let inner: Vec<Vec<DVec3>> =
            self.arcs.arcs.par_iter().map(|arc| self.cut.arc_points(self.sheet, arc, arc.ends.map(vertex))).collect();
        self.arc_start.reserve(inner.len() + 1);
        for points in inner {
            self.arc_start.push(self.points.len() as PointId);
            self.points.extend(points.into_iter().map(dusted));
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
                self.points.push(dusted(node.lerp(end, (c - node.z) / (end.z - node.z)).truncate().extend(c)));
            }
            if length < tip.r {
                self.points.push(dusted(end));
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
                    self.points.push(dusted(before.1.lerp(point, t).truncate().extend(c)));
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
}
