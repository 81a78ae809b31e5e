//! What happens around each node: which edges are visible there, where sectors open and where creases start.

use super::facet::{Facet, FacetId, Lateral};
use super::network::{HalfEdge, Network, twin};
use crate::kernel::buckets::Buckets;
use glam::DVec2;
use std::f64::consts::{FRAC_PI_2, TAU};

/// Rulings that turn by less than this (radians) at a node are taken as parallel: one shared ruling, no sector, no crease.
const SMOOTH_TURN: f64 = 1e-7;

/// An edge counts as hidden at its node when another edge's sheet rises within this much (gradient, dimensionless) of it.
const HIDDEN_MARGIN: f64 = 1e-12;

/// A ruling shared by two facets: the left one ends there (`τ` largest), the right one begins (`τ = 0`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joint {
    /// Node of the foot.
    pub node: u32,
    /// The earlier of the two facets, walking along the line with both on the left.
    pub left: FacetId,
    /// The later one.
    pub right: FacetId,
    /// A strip whose rulings run this way.
    pub strip: FacetId,
    /// Direction of the ruling in plan.
    pub d: DVec2,
}

/// All facets of a network, with the joints between them.
#[derive(Clone, Debug)]
pub struct Fans {
    /// Strips by half-edge, then sectors.
    pub facets: Vec<Facet>,
    /// Shared rulings.
    pub joints: Vec<Joint>,
    /// Sectors of each node: `sectors[start[n]..start[n + 1]]` of the facet list.
    pub sector_start: Vec<u32>,
    /// Half-edges leaving each node.
    outgoing: Buckets<HalfEdge>,
}

impl Fans {
    /// Builds strips, sectors and joints for slope `k`.
    pub fn new(network: &Network, k: f64) -> Self {
        let strips = (0..2 * network.edges.len() as u32).map(|h| Facet::strip(network, h, k)).collect();
        let mut fans = Self { facets: strips, joints: Vec::new(), sector_start: Vec::new(), outgoing: network.outgoing() };
        for node in 0..network.nodes.len() as u32 {
            fans.sector_start.push(fans.facets.len() as u32);
            fans.add_node(network, node, k);
        }
        fans.sector_start.push(fans.facets.len() as u32);
        fans
    }

    /// Half-edges leaving a node.
    pub fn leaving(&self, node: u32) -> &[HalfEdge] {
        self.outgoing.of(node)
    }

    fn add_node(&mut self, network: &Network, node: u32, k: f64) {
        let mut visible: Vec<HalfEdge> = self.leaving(node).iter().copied().filter(|&h| !self.hidden(node, h)).collect();
        let angle = |h: HalfEdge| {
            let u = self.facets[h as usize].u;
            u.y.atan2(u.x)
        };
        visible.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
        for (i, &out) in visible.iter().enumerate() {
            let next = visible[(i + 1) % visible.len()];
            self.add_corner(network, node, next, out, k);
        }
    }

    /// Whether edge `h`, leaving `node`, lies below the sheet of another edge of the node there.
    fn hidden(&self, node: u32, h: HalfEdge) -> bool {
        let own = &self.facets[h as usize];
        self.leaving(node).iter().any(|&other| other != h && self.rise(other, own.u) >= own.gamma - HIDDEN_MARGIN)
    }

    /// Rise per unit length of the sheet of edge `h` in plan direction `towards`, at the node `h` leaves.
    fn rise(&self, h: HalfEdge, towards: DVec2) -> f64 {
        let facet = &self.facets[h as usize];
        let (k, gamma) = (facet.drop, facet.gamma);
        let (along, across) = (facet.u.dot(towards), facet.u.perp_dot(towards).abs());
        // Beyond the ruling, which leaves the normal by φ with sin φ = γ/k, the node's own cone takes over.
        let side = ((k - gamma) * (k + gamma)).sqrt();
        if along * side + across * gamma > 0.0 { gamma * along - side * across } else { -k }
    }

    /// The corner between visible edge `out` and the next one counter-clockwise. Along the line, the facet on the left of
    /// `twin(next)` comes in and the one on the left of `out` goes out.
    fn add_corner(&mut self, network: &Network, node: u32, next: HalfEdge, out: HalfEdge, k: f64) {
        let (left, right) = (twin(next), out);
        let (incoming, outgoing) = (&self.facets[left as usize], &self.facets[right as usize]);
        let opening = if next == out { TAU } else { positive_angle(outgoing.u, -incoming.u) };
        // Rulings leave the edges at 90° + φ, measured from the node outwards.
        let lean = |gamma: f64| FRAC_PI_2 + (gamma / k).asin();
        let mut turn = opening - lean(outgoing.gamma) - lean(-incoming.gamma);
        let (d_in, d_out) = (incoming.d, outgoing.d);
        if turn.abs() < 1.0 {
            // The same angle without the cancellation.
            turn = d_out.perp_dot(d_in).atan2(d_in.dot(d_out));
        }
        let wanted = incoming.wanted && outgoing.wanted;
        if turn > SMOOTH_TURN {
            let sector = self.facets.len() as FacetId;
            self.facets.push(Facet::sector(node, network.nodes[node as usize], d_in, turn, k, wanted));
            self.join(Joint { node, left, right: sector, strip: left, d: d_in });
            self.join(Joint { node, left: sector, right, strip: right, d: d_out });
        } else if turn < -SMOOTH_TURN {
            self.facets[left as usize].lateral[1] = Lateral::Crease(right);
            self.facets[right as usize].lateral[0] = Lateral::Crease(left);
        } else {
            self.join(Joint { node, left, right, strip: right, d: d_out });
        }
    }

    fn join(&mut self, joint: Joint) {
        let id = self.joints.len() as u32;
        self.facets[joint.left as usize].lateral[1] = Lateral::Joint(id);
        self.facets[joint.right as usize].lateral[0] = Lateral::Joint(id);
        self.joints.push(joint);
    }
}

/// Counter-clockwise angle from `a` to `b` in (0, 2π].
fn positive_angle(a: DVec2, b: DVec2) -> f64 {
    let angle = a.perp_dot(b).atan2(a.dot(b));
    if angle <= 0.0 { angle + TAU } else { angle }
}
