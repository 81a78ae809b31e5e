//! Facets of the falling sheet and what one needs to know of them: foot, ruling, plane, crossing with another facet.
//!
//! A strip belongs to a half-edge and lies on its left; `τ` is the plan distance along it. A sector belongs to a corner of a
//! node; `τ` is the clockwise angle from its first ruling. With `r` along the ruling, `(τ, r)` is counter-clockwise in plan
//! for both. Every facet answers for its own ruling, drop and gradient: nothing outside this file knows that all facets
//! share one slope.

use super::network::{HalfEdge, Network};
use crate::kernel::dd::{Dd, DdVec2};
use glam::{DVec2, DVec3};

/// Index of a facet. Strips come first: facet `h` is the strip of half-edge `h`.
pub type FacetId = u32;

/// The pseudo-facet of the outer end: the horizontal plane at which the sheet stops.
pub const END: FacetId = u32::MAX;

/// What a facet is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Planar strip of a half-edge.
    Strip(HalfEdge),
    /// Cone sector of a node.
    Sector(u32),
}

/// What bounds a facet at an end of its `τ` range.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Lateral {
    /// A ruling shared with a neighbour.
    Joint(u32),
    /// A crease with the strip on the other side starts at the node itself.
    Crease(FacetId),
    /// The edge lies below another edge of the same node there.
    Hidden,
}

/// One facet.
#[derive(Clone, Debug)]
pub struct Facet {
    /// Strip or sector.
    pub kind: Kind,
    /// Foot at `τ = 0` in plan.
    pub origin: DVec2,
    /// Height there.
    pub z0: f64,
    /// Direction of growing `τ` on the line (strips).
    pub u: DVec2,
    /// Gradient of the line along `u` (strips).
    pub gamma: f64,
    /// Ruling direction at `τ = 0`.
    pub d: DVec2,
    /// Length of the `τ` range.
    pub tau_max: f64,
    /// Drop per unit of ruling.
    pub drop: f64,
    /// Gradient of a strip's plane, in double-double (strips).
    pub gradient: DdVec2,
    /// Neighbours at `τ = 0` and `τ = tau_max`.
    pub lateral: [Lateral; 2],
    /// Whether its part of the surface is wanted.
    pub wanted: bool,
}

/// Where along a ruling another sheet is met: at `r = num / den`, or nowhere when `den ≤ 0` (and `num > 0`).
#[derive(Clone, Copy, Debug)]
pub struct Crossing {
    /// Numerator; not positive when the foot is covered.
    pub num: f64,
    /// Denominator.
    pub den: f64,
}

impl Crossing {
    /// Length of the ruling up to the crossing; zero when the foot is covered, infinite when there is none.
    pub fn length(self) -> f64 {
        if self.num <= 0.0 {
            0.0
        } else if self.den > 0.0 {
            self.num / self.den
        } else {
            f64::INFINITY
        }
    }
}

impl Facet {
    /// The strip on the left of half-edge `h`, for slope `k`.
    pub fn strip(network: &Network, h: HalfEdge, k: f64) -> Self {
        let edge = &network.edges[(h / 2) as usize];
        let a = network.nodes[network.origin(h) as usize];
        let b = network.nodes[network.target(h) as usize];
        let span = DdVec2::between(a.truncate(), b.truncate());
        let length = span.length();
        let u = span.scale(Dd::ONE / length);
        let gamma = Dd::difference(b.z, a.z) / length;
        let slope = Dd::from(k);
        // Down the plane from the line to its left: √(k² − γ²).
        let side = ((slope - gamma) * (slope + gamma)).sqrt();
        let gradient = u.scale(gamma) - u.perp().scale(side);
        let down = gradient.scale(-Dd::ONE / slope).to_f64();
        Self {
            kind: Kind::Strip(h),
            origin: a.truncate(),
            z0: a.z,
            u: u.to_f64(),
            gamma: gamma.to_f64(),
            d: down,
            tau_max: length.to_f64(),
            drop: k,
            gradient,
            lateral: [Lateral::Hidden; 2],
            wanted: edge.wanted[(h & 1) as usize],
        }
    }

    /// The sector at a node that opens clockwise from ruling direction `from` by `angle`.
    pub fn sector(node: u32, at: DVec3, from: DVec2, angle: f64, k: f64, wanted: bool) -> Self {
        Self {
            kind: Kind::Sector(node),
            origin: at.truncate(),
            z0: at.z,
            u: DVec2::ZERO,
            gamma: 0.0,
            d: from,
            tau_max: angle,
            drop: k,
            gradient: DdVec2::from(DVec2::ZERO),
            lateral: [Lateral::Hidden; 2],
            wanted,
        }
    }

    /// Whether the facet is a planar strip.
    pub fn is_strip(&self) -> bool {
        matches!(self.kind, Kind::Strip(_))
    }

    /// Foot point on the line at `τ`.
    pub fn foot(&self, tau: f64) -> DVec3 {
        match self.kind {
            Kind::Strip(_) => (self.origin + self.u * tau).extend(self.z0 + self.gamma * tau),
            Kind::Sector(_) => self.origin.extend(self.z0),
        }
    }

    /// Unit plan direction of the ruling at `τ`.
    pub fn ruling(&self, tau: f64) -> DVec2 {
        match self.kind {
            Kind::Strip(_) => self.d,
            Kind::Sector(_) => {
                let (sin, cos) = tau.sin_cos();
                DVec2::new(self.d.x * cos + self.d.y * sin, self.d.y * cos - self.d.x * sin)
            }
        }
    }

    /// The point of the facet at `(τ, r)`.
    pub fn point(&self, tau: f64, r: f64) -> DVec3 {
        let foot = self.foot(tau);
        (foot.truncate() + self.ruling(tau) * r).extend(foot.z - self.drop * r)
    }

    /// `(τ, r)` of a plan point in the facet's own parameters, not clamped. A sector's `τ` lies within half a turn of its middle.
    pub fn parameters(&self, x: DVec2) -> (f64, f64) {
        let w = x - self.origin;
        match self.kind {
            Kind::Strip(_) => {
                // w = τ u + r d; u ⟂-component of d is cos φ > 0.
                let r = self.u.perp_dot(w) / self.u.perp_dot(self.d);
                (self.u.dot(w) - r * self.u.dot(self.d), r)
            }
            Kind::Sector(_) => {
                let clockwise = w.perp_dot(self.d).atan2(w.dot(self.d));
                let turn = std::f64::consts::TAU;
                let low = 0.5 * self.tau_max - std::f64::consts::PI;
                (if clockwise < low { clockwise + turn } else { clockwise }, w.length())
            }
        }
    }

    /// Height of the facet, extended over the whole plan: its plane, or its full cone.
    pub fn height(&self, x: DVec2) -> f64 {
        match self.kind {
            Kind::Strip(_) => self.z0 + self.gradient.to_f64().dot(x - self.origin),
            Kind::Sector(_) => self.z0 - self.drop * (x - self.origin).length(),
        }
    }

    /// [`Self::height`] in double-double.
    pub fn height_dd(&self, x: DdVec2) -> Dd {
        let w = x - DdVec2::from(self.origin);
        match self.kind {
            Kind::Strip(_) => self.gradient.dot(w) + self.z0,
            Kind::Sector(_) => Dd::from(self.z0) - w.length() * self.drop,
        }
    }

    /// Gradient of the extended facet at `x`, in double-double.
    pub fn gradient_dd(&self, x: DdVec2) -> DdVec2 {
        match self.kind {
            Kind::Strip(_) => self.gradient,
            Kind::Sector(_) => {
                let w = x - DdVec2::from(self.origin);
                w.scale(Dd::from(-self.drop) / w.length())
            }
        }
    }

    /// Where the ruling with foot `p` and direction `d`, falling at this facet's own drop, meets the extended facet.
    ///
    /// Linear in `r` for a plane and, because both fall at the same rate along a ruling, for a cone as well: squaring
    /// `z_q − k|x − q| = z_p − k r` leaves `r = (|w|² − e²) / 2(e + w·d)` with `w = q − p`, `e = (z_q − z_p)/k`.
    pub fn crossing(&self, p: DVec3, d: DVec2) -> Crossing {
        match self.kind {
            Kind::Strip(_) => {
                let num = p.z - self.height(p.truncate());
                // k + G·d = k(1 − d·d_k), written so that small dihedrals keep their digits.
                Crossing { num, den: 0.5 * self.drop * (d - self.d).length_squared() }
            }
            Kind::Sector(_) => {
                let w = self.origin - p.truncate();
                let e = (self.z0 - p.z) / self.drop;
                let distance = w.length();
                if e + distance <= 0.0 {
                    // The node lies inside the cone that hangs from p: its own cone never comes up to the ruling.
                    return Crossing { num: 1.0, den: -1.0 };
                }
                Crossing { num: (distance - e) * (distance + e), den: 2.0 * (e + w.dot(d)) }
            }
        }
    }
}
