//! Rulings trimmed where another part of the sheet comes up, and points checked against the whole sheet.
//!
//! All decisions that nearly tie are taken in double-double on the extended facets; the index only proposes candidates.

use super::facet::{Crossing, END, Facet, FacetId, Kind, Lateral};
use super::fan::{Fans, Joint};
use super::network::Network;
use crate::kernel::dd::{Dd, DdVec2};
use crate::sheet::{Index, Ruling, Segment};
use glam::{DVec2, DVec3};

/// Heights that differ by less (length units, in double-double) are equal: more facets meet there than a vertex needs.
const TIE: f64 = 1e-22;

/// Points at a smaller angle (radians) to a shared ruling are looked at in double-double: on which side of it they lie.
const ALONGSIDE: f64 = 1e-6;

/// A node is covered when the sheet of other edges is higher there by more than this (length units).
const COVERED: f64 = 1e-9;

/// The sheet with everything queries need.
pub struct Sheet<'a> {
    /// The line.
    pub network: &'a Network,
    /// Facets and joints.
    pub fans: &'a Fans,
    /// Index over the edges.
    pub index: &'a Index,
    /// Slope.
    pub k: f64,
    /// Height of the pseudo-facet [`END`].
    pub end: f64,
}

/// Where a ruling ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tip {
    /// Length of the ruling; zero when the foot is covered.
    pub r: f64,
    /// The facet met there; [`END`] at the outer end.
    pub partner: FacetId,
    /// The point.
    pub point: DVec3,
    /// Edges compared with the ruling: the effort it took.
    pub compared: u32,
}

/// The index of a network's edges.
pub fn index_of(network: &Network, k: f64) -> Index {
    let segments: Vec<Segment> =
        network.edges.iter().map(|e| Segment::new(network.nodes[e.a as usize], network.nodes[e.b as usize], k)).collect();
    Index::new(&segments, k)
}

impl<'a> Sheet<'a> {
    /// Puts the parts together; `end` is the height at which the sheet stops.
    pub fn new(network: &'a Network, fans: &'a Fans, index: &'a Index, k: f64, end: f64) -> Self {
        Self { network, fans, index, k, end }
    }

    /// Heights at `x` that differ by less are compared in double-double: rounding may hide which is higher.
    fn near(&self, x: DVec2) -> f64 {
        2.0 * self.index.rounding(x)
    }

    /// A facet.
    pub fn facet(&self, id: FacetId) -> &Facet {
        &self.fans.facets[id as usize]
    }

    /// Whether edge `e` ends at `node`.
    fn touches(&self, e: u32, node: u32) -> bool {
        let edge = &self.network.edges[e as usize];
        edge.a == node || edge.b == node
    }

    /// Whether facet `f` is part of the sheet of edge `e`: its strips, and the cones of its nodes.
    pub(super) fn belongs(&self, f: FacetId, e: u32) -> bool {
        match self.facet(f).kind {
            Kind::Strip(h) => h / 2 == e,
            Kind::Sector(node) => self.touches(e, node),
        }
    }

    /// The facet of edge `e` that covers `x`, where the sheet of `e` is the highest.
    pub fn facet_at(&self, e: u32, x: DVec2) -> FacetId {
        let segment = self.index.segment(e);
        let p = segment.local(x);
        let foot = p.x + p.y.abs() * segment.tan_phi;
        let edge = &self.network.edges[e as usize];
        let side = 2 * e + u32::from(p.y < 0.0);
        if foot <= 0.0 {
            self.sector_at(edge.a, x).unwrap_or(side)
        } else if foot >= segment.length {
            self.sector_at(edge.b, x).unwrap_or(side)
        } else {
            side
        }
    }

    /// The sector of `node` in whose direction `x` lies, or the nearest one.
    fn sector_at(&self, node: u32, x: DVec2) -> Option<FacetId> {
        let range = self.fans.sector_start[node as usize]..self.fans.sector_start[node as usize + 1];
        let outside = |f: FacetId| {
            let facet = self.facet(f);
            let (tau, _) = facet.parameters(x);
            (-tau).max(tau - facet.tau_max)
        };
        range.min_by(|&a, &b| outside(a).total_cmp(&outside(b)))
    }

    /// Where the ruling from foot `p` in direction `d` meets partner `k`.
    pub fn crossing(&self, p: DVec3, d: DVec2, k: FacetId) -> Crossing {
        if k == END { Crossing { num: (p.z - self.end) / self.k, den: 1.0 } } else { self.facet(k).crossing(p, d) }
    }

    /// Height of facet `k` (or the outer end) in double-double.
    pub fn height_dd(&self, k: FacetId, x: DdVec2) -> Dd {
        if k == END { Dd::from(self.end) } else { self.facet(k).height_dd(x) }
    }

    /// Height of the sheet of edge `e` in double-double.
    fn edge_height_dd(&self, e: u32, x: DdVec2) -> Dd {
        let plan = x.to_f64();
        let segment = self.index.segment(e);
        let p = segment.local(plan);
        let foot = p.x + p.y.abs() * segment.tan_phi;
        let cone = |q: DVec2, z: f64| Dd::from(z) - (x - DdVec2::from(q)).length() * self.k;
        if foot <= 0.0 {
            cone(segment.a, segment.za)
        } else if foot >= segment.length {
            cone(segment.b, segment.zb)
        } else {
            self.facet(2 * e + u32::from(p.y < 0.0)).height_dd(x)
        }
    }

    /// Gradient of facet `k` (or the outer end).
    pub fn gradient_dd(&self, k: FacetId, x: DdVec2) -> DdVec2 {
        if k == END { DdVec2::from(DVec2::ZERO) } else { self.facet(k).gradient_dd(x) }
    }

    /// Where the ruling meets the sheet of edge `e`, if before `current`.
    ///
    /// The sheet lies under both planes of the edge and touches the lower one above its strip: the ruling meets the strip
    /// where it has met both planes, if the foot there is on the edge, and otherwise the nearer of the end cones.
    fn edge_crossing(&self, e: u32, ruling: &Ruling, current: f64) -> f64 {
        let s = self.index.segment(e);
        let k = self.k;
        let p = s.local(ruling.foot);
        let d = DVec2::new(s.u.dot(ruling.dir), s.u.perp_dot(ruling.dir));
        let fall = ruling.z - (s.za + s.gamma * p.x);
        // Planes z_a + γ s ∓ drop·t against z − k r.
        let meet = |side: f64| {
            let num = fall + side * s.drop * p.y;
            // k(1 − d·d_k) = k/2·|d − d_k|² with d_k = (−sin φ, ± cos φ).
            let off = DVec2::new(d.x + s.sin_phi, d.y - side * s.cos_phi);
            Crossing { num, den: 0.5 * k * off.length_squared() }.length()
        };
        let strip = meet(1.0).max(meet(-1.0));
        if strip >= current {
            return current;
        }
        let at = p + d * strip;
        let foot = at.x + at.y.abs() * s.tan_phi;
        if foot > 0.0 && foot < s.length {
            return strip;
        }
        let cone = |q: DVec2, zq: f64| {
            let w = q - ruling.foot;
            let e = (zq - ruling.z) / k;
            let distance = w.length();
            if e + distance <= 0.0 {
                return f64::INFINITY;
            }
            Crossing { num: (distance - e) * (distance + e), den: 2.0 * (e + w.dot(ruling.dir)) }.length()
        };
        current.min(cone(s.a, s.za)).min(cone(s.b, s.zb))
    }

    /// Trims the ruling with foot `foot`, direction `d`; edges for which `skip` holds do not count.
    pub fn trim(&self, foot: DVec3, d: DVec2, skip: impl Fn(u32) -> bool) -> Tip {
        let limit = (foot.z - self.end) / self.k;
        if limit <= 0.0 {
            return Tip { r: 0.0, partner: END, point: foot, compared: 0 };
        }
        let ruling = Ruling { foot: foot.truncate(), z: foot.z, dir: d };
        let mut met = u32::MAX;
        let mut compared = 0;
        let r = self.index.trim(&ruling, limit, &mut |e, current| {
            compared += 1;
            if skip(e) {
                return current;
            }
            let r = self.edge_crossing(e, &ruling, current);
            if r < current {
                met = e;
            }
            r
        });
        let tip = |r: f64, partner| Tip { r, partner, point: ruling.at(r).extend(foot.z - self.k * r), compared };
        if met == u32::MAX {
            return tip(limit, END);
        }
        if r <= 0.0 {
            return Tip { r: 0.0, partner: self.facet_at(met, foot.truncate()), point: foot, compared };
        }
        tip(r, self.facet_at(met, ruling.at(r)))
    }

    /// Trims ruling `τ` of facet `f`.
    pub fn trim_facet(&self, f: FacetId, tau: f64) -> Tip {
        let facet = self.facet(f);
        self.trim(facet.foot(tau), facet.ruling(tau), |e| self.belongs(f, e))
    }

    /// Trims a joint. The partner is decided exactly where several nearly tie.
    pub fn trim_joint(&self, joint: &Joint) -> Tip {
        let foot = self.network.nodes[joint.node as usize];
        let mut tip = self.trim(foot, joint.d, |e| self.touches(e, joint.node));
        if tip.r <= 0.0 {
            return tip;
        }
        let d = self.facet(joint.strip).gradient.scale(-Dd::ONE / Dd::from(self.k));
        let length = |k: FacetId| self.joint_length(foot, d, k);
        let mut best = length(tip.partner);
        self.index.visit_above(tip.point.truncate(), tip.point.z - self.near(tip.point.truncate()), |e| {
            tip.compared += 1;
            if self.touches(e, joint.node) {
                return;
            }
            let x = DdVec2::from(foot.truncate()) + d.scale(best);
            if self.edge_height_dd(e, x) <= Dd::from(foot.z) - best * self.k + Dd::from(TIE) {
                return;
            }
            let rival = self.facet_at(e, tip.point.truncate());
            if length(rival) < best {
                best = length(rival);
                tip.partner = rival;
            }
        });
        // A strip and a cone are all but equally high beside the ruling they share. On which side of it the tip lies must agree with
        // what that ruling finds of this joint, where the two lie alike.
        let neighbour = self.beside(tip.partner, DdVec2::from(foot.truncate()) + d.scale(best));
        if neighbour != tip.partner {
            tip.partner = neighbour;
            best = length(neighbour);
        }
        tip.r = best.to_f64();
        tip.point = (foot.truncate() + joint.d * tip.r).extend(foot.z - self.k * tip.r);
        tip
    }

    /// The facet at `x` where it lies all but on a shared ruling of facet `k`: `k`, or the neighbour.
    fn beside(&self, k: FacetId, x: DdVec2) -> FacetId {
        if k == END {
            return k;
        }
        for (end, lateral) in self.facet(k).lateral.into_iter().enumerate() {
            let Lateral::Joint(j) = lateral else { continue };
            let joint = &self.fans.joints[j as usize];
            let foot = self.network.nodes[joint.node as usize].truncate();
            let (w, down) = (x - DdVec2::from(foot), self.facet(joint.strip).gradient.scale(-Dd::ONE));
            let (along, aside) = (down.dot(w).to_f64(), down.perp_dot(w));
            if aside.to_f64().abs() > ALONGSIDE * along {
                continue;
            }
            if end == 0 && aside.signum() > 0.0 {
                return joint.left;
            }
            if end == 1 && aside.signum() < 0.0 {
                return joint.right;
            }
        }
        k
    }

    /// Length of the ruling from `foot` along `d` to the extended facet `k`, in double-double; a huge number where they do
    /// not meet.
    fn joint_length(&self, foot: DVec3, d: DdVec2, k: FacetId) -> Dd {
        const NEVER: f64 = 1e30;
        if k == END {
            return Dd::difference(foot.z, self.end) / self.k;
        }
        let facet = self.facet(k);
        let (num, den) = match facet.kind {
            Kind::Strip(_) => (Dd::from(foot.z) - facet.height_dd(DdVec2::from(foot.truncate())), facet.gradient.dot(d) + self.k),
            Kind::Sector(_) => {
                let w = DdVec2::between(foot.truncate(), facet.origin);
                let e = Dd::difference(facet.z0, foot.z) / self.k;
                (w.length_squared() - e * e, (e + w.dot(d)) * 2.0)
            }
        };
        if den.to_f64() > 0.0 { num / den } else { Dd::from(NEVER) }
    }

    /// Whether the sheet of the other edges covers a node.
    pub fn covered(&self, node: u32) -> bool {
        let p = self.network.nodes[node as usize];
        let mut covered = false;
        self.index.visit_above(p.truncate(), p.z + COVERED, |e| {
            covered |= !self.touches(e, node) && self.index.segment(e).height(p.truncate(), self.k) > p.z + COVERED;
        });
        covered
    }

    /// Whether another facet is higher at `x` than `f`, which meets `a` and `b` there; and how many edges were compared for it.
    pub fn intruded(&self, f: FacetId, a: FacetId, b: FacetId, x: DdVec2) -> (bool, u32) {
        let own = self.height_dd(f, x);
        let limit = own + Dd::from(TIE);
        if ![a, b].contains(&END) && Dd::from(self.end) > limit {
            return (true, 0);
        }
        let plan = x.to_f64();
        let near = self.near(plan);
        let hint = match self.facet(f).kind {
            Kind::Strip(h) => h / 2,
            Kind::Sector(node) => self.fans.leaving(node)[0] / 2,
        };
        if self.index.height(plan, Some(hint)).0 > own.to_f64() + near {
            return (true, 1);
        }
        let (mut intruded, mut compared) = (false, 0);
        self.index.visit_above(plan, own.to_f64() - near, |e| {
            compared += 1;
            intruded =
                intruded || ([f, a, b].iter().all(|&g| g == END || !self.belongs(g, e)) && self.edge_height_dd(e, x) > limit);
        });
        (intruded, compared)
    }

    /// The joint through which facets `a` and `b` are neighbours, with `a` on the left.
    pub fn joint_between(&self, a: FacetId, b: FacetId) -> Option<u32> {
        if a == END || b == END {
            return None;
        }
        match self.facet(a).lateral[1] {
            Lateral::Joint(j) if self.fans.joints[j as usize].right == b => Some(j),
            _ => None,
        }
    }
}
