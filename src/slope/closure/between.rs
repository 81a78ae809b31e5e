//! What lies between two knots of a facet with different partners.

use super::{Knot, State, TIE_WIDTH, VertexId, sides_of, twin_strip};
use crate::kernel::range::held;
use crate::slope::facet::{END, FacetId, Lateral};
use crate::slope::junction;
use glam::{DVec2, DVec3};

/// What lies between two knots with different partners.
pub(super) enum Between {
    Junction { tau: f64, left: FacetId, right: FacetId, point: DVec3 },
    Vertex { tau: f64, left: FacetId, right: FacetId, vertex: VertexId },
    Hint { tau: f64, partner: FacetId },
    Stuck,
}

impl State<'_> {
    /// What lies between knots `a` and `b` of facet `f`.
    pub(super) fn between(&self, f: FacetId, a: &Knot, b: &Knot) -> Between {
        let (ka, kb) = (a.right, b.left);
        let width = b.tau - a.tau;
        // Neighbours across a shared ruling meet `f` at the end of that ruling.
        if let Some(j) = self.sheet.joint_between(kb, ka)
            && self.tips[j as usize].partner == f
            && self.tips[j as usize].r > 0.0
        {
            let vertex = self.tip_vertex(j);
            let (tau, _) = self.sheet.facet(f).parameters(self.vertices[vertex as usize].truncate());
            return Between::Vertex { tau: held(tau, [a.tau, b.tau]), left: ka, right: kb, vertex };
        }
        if self.sheet.joint_between(ka, kb).is_some() {
            // The other way round neighbours touch along their ruling and do not cross there: what algebra finds is rounding.
            return self.hint_by_looking(f, a, b, 0.5 * (a.tau + b.tau));
        }
        let root = junction::root(self.sheet, f, ka, kb, a.tau, b.tau);
        let tau = root.unwrap_or(0.5 * (a.tau + b.tau));
        if width > 0.0 && root.is_some() {
            let x = junction::polish(self.sheet, f, ka, kb, tau);
            let plan = x.to_f64();
            let (exact_tau, _) = self.sheet.facet(f).parameters(plan);
            let slack = 1e-7 * (1.0 + width);
            if plan.is_finite() && exact_tau > a.tau - slack && exact_tau < b.tau + slack {
                let tau = held(exact_tau, [a.tau, b.tau]);
                if let Some((neighbour, vertex)) = self.beyond(f, ka, plan, a, b) {
                    return self.step_over(f, ka, neighbour, vertex, a, b, tau);
                }
                if let Some((neighbour, vertex)) = self.beyond(f, kb, plan, a, b) {
                    return self.step_over(f, kb, neighbour, vertex, a, b, tau);
                }
                let (intruded, compared) = self.sheet.intruded(f, ka, kb, x);
                self.effort.compare(compared);
                if intruded {
                    // The intruder need not be what the ruling meets first, and its plane reaches farther than its strip: look.
                    return self.hint_by_looking(f, a, b, tau);
                }
                let point = plan.extend(self.sheet.height_dd(f, x).to_f64());
                return Between::Junction { tau, left: ka, right: kb, point };
            }
        }
        self.hint_by_looking(f, a, b, tau)
    }

    /// The knots lie on one ruling: everything between them happens in one place.
    fn tie(&self, f: FacetId, a: &Knot, b: &Knot) -> Between {
        let tau = 0.5 * (a.tau + b.tau);
        let point = self.sheet.facet(f).point(tau, self.sheet.trim_facet(f, tau).r);
        Between::Junction { tau, left: a.right, right: b.left, point }
    }

    /// Looks along a ruling between two knots where the algebra gave no answer.
    fn hint_by_looking(&self, f: FacetId, a: &Knot, b: &Knot, tau: f64) -> Between {
        let width = b.tau - a.tau;
        if width <= TIE_WIDTH * (1.0 + a.tau.abs() + b.tau.abs()) {
            return self.tie(f, a, b);
        }
        let inside = tau > a.tau + 0.01 * width && tau < b.tau - 0.01 * width;
        let tau = if inside { tau } else { 0.5 * (a.tau + b.tau) };
        Between::Hint { tau, partner: self.look(f, tau) }
    }

    /// If `x` lies beyond a shared ruling of partner `k`: the neighbour there, and the tip if it lies on `f`.
    fn beyond(&self, f: FacetId, k: FacetId, x: DVec2, a: &Knot, b: &Knot) -> Option<(FacetId, Option<(f64, VertexId)>)> {
        if k == END || k == twin_strip(self.sheet, f) {
            return None;
        }
        let facet = self.sheet.facet(k);
        let (tau, r) = facet.parameters(x);
        let limit = 1e-9 * (1.0 + facet.tau_max);
        if r < -limit {
            // The plane of a strip goes on behind its edge, the strip does not.
            return Some((k, None));
        }
        let end = if tau < -limit {
            0
        } else if tau > facet.tau_max + limit {
            1
        } else {
            return None;
        };
        let Lateral::Joint(j) = facet.lateral[end] else { return Some((k, None)) };
        let joint = &self.sheet.fans.joints[j as usize];
        let neighbour = if end == 0 { joint.left } else { joint.right };
        let tip = &self.tips[j as usize];
        if tip.partner != f || tip.r <= 0.0 {
            return Some((neighbour, None));
        }
        let vertex = self.tip_vertex(j);
        let (tau, _) = self.sheet.facet(f).parameters(self.vertices[vertex as usize].truncate());
        Some((neighbour, (tau > a.tau && tau < b.tau).then_some((tau, vertex))))
    }

    /// Goes from partner `k` to its neighbour over their shared ruling's end.
    #[allow(clippy::too_many_arguments, reason = "one place, all of it needed")]
    fn step_over(
        &self,
        f: FacetId,
        k: FacetId,
        neighbour: FacetId,
        vertex: Option<(f64, VertexId)>,
        a: &Knot,
        b: &Knot,
        tau: f64,
    ) -> Between {
        match vertex {
            Some((tau, vertex)) => {
                let (left, right) = if k == a.right { (k, neighbour) } else { (neighbour, k) };
                // The order of the vertex decides; a tip the other way round belongs to another crossing.
                match self.keys[vertex as usize].and_then(|key| sides_of(f, key)) {
                    Some(sides) if sides == (left, right) => Between::Vertex { tau, left, right, vertex },
                    _ => self.hint_by_looking(f, a, b, tau),
                }
            }
            None => self.hint_by_looking(f, a, b, tau),
        }
    }
}
