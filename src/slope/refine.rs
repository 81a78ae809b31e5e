//! Points on the far boundary between its vertices: where levels cross it, where it turns, and where a curved crease must be
//! broken into chords.

use super::arcs::Arc;
use super::facet::{END, Facet, FacetId, Kind};
use super::levels::{LEVEL_SNAP, Levels};
use super::trim::Sheet;
use glam::DVec3;
use std::f64::consts::TAU;

/// Chords of a cone turn by no more than this (radians): their planes are then steeper than the cone by less than 0.05°.
///
/// A plane through two rulings `Δ` apart has slope `k / cos(Δ/2)`; the angle differs by `k/(1 + k²)·Δ²/8`, at most `Δ²/16`.
pub const WIDEST_WEDGE: f64 = 0.115;

/// Depth of halving of one chord; 2²⁴ pieces are more than any tolerance can ask for.
const MAX_HALVINGS: u32 = 24;

/// What the surface is cut and measured by.
pub struct Cut<'a> {
    /// The levels.
    pub levels: &'a Levels,
    /// Greatest height of a cone above its chords.
    pub chord: f64,
    /// Length at which rulings end, if they end at a distance.
    pub reach: Option<f64>,
}

impl Cut<'_> {
    /// The widest angle between rulings of length `r` on a cone of slope `k`: the sagitta `r(1 − cos(Δ/2))` times `k` stays
    /// within the chord tolerance.
    pub fn widest(&self, r: f64, k: f64) -> f64 {
        let sagitta = self.chord / (k * r).max(f64::MIN_POSITIVE);
        // 1 − cos(Δ/2) = 2 sin²(Δ/4)
        WIDEST_WEDGE.min(4.0 * (0.5 * sagitta).min(1.0).sqrt().asin())
    }

    /// The points of an arc between its ends, in the order of the owner's `τ`.
    pub fn arc_points(&self, sheet: &Sheet, arc: &Arc, ends: [DVec3; 2]) -> Vec<DVec3> {
        let owner = sheet.facet(arc.owner);
        if arc.partner == END {
            return self.end_points(owner, ends);
        }
        let partner = sheet.facet(arc.partner);
        let mut points = if owner.is_strip() && partner.is_strip() {
            self.level_points_of_segment(ends)
        } else {
            let (sector, other) = if owner.is_strip() { (partner, arc.owner) } else { (owner, arc.partner) };
            self.curve_points(sheet, sector, other, ends)
        };
        if let Some(reach) = self.reach {
            points = self.with_reach(points, ends, [owner, partner], reach);
        }
        points
    }

    /// Where a straight line on the surface crosses levels.
    pub fn level_points_of_segment(&self, [a, b]: [DVec3; 2]) -> Vec<DVec3> {
        let at = |c: f64| a.lerp(b, (c - a.z) / (b.z - a.z)).truncate().extend(c);
        self.levels.crossed(a.z, b.z).map(|u| at(self.levels.heights[u])).collect()
    }

    /// The outer end of a sector is an arc of a circle, broken into chords; that of a strip is straight.
    fn end_points(&self, owner: &Facet, ends: [DVec3; 2]) -> Vec<DVec3> {
        if owner.is_strip() {
            return Vec::new();
        }
        let (from, r) = owner.parameters(ends[0].truncate());
        let (to, _) = owner.parameters(ends[1].truncate());
        self.circle(owner, from, to, r, ends[0].z)
    }

    /// Points on the circle of radius `r` of a sector, strictly between two rulings.
    pub fn circle(&self, sector: &Facet, from: f64, to: f64, r: f64, z: f64) -> Vec<DVec3> {
        let parts = ((to - from).abs() / self.widest(r, sector.drop)).ceil().max(1.0);
        (1..parts as usize)
            .map(|i| {
                let tau = from + (to - from) * (i as f64 / parts);
                (sector.origin + sector.ruling(tau) * r).extend(z)
            })
            .collect()
    }

    /// The points of the crease between a sector and another facet.
    fn curve_points(&self, sheet: &Sheet, sector: &Facet, other: FacetId, ends: [DVec3; 2]) -> Vec<DVec3> {
        let taus = ends.map(|p| sector.parameters(p.truncate()).0);
        let curve = Curve::new(sheet, sector, other, 0.5 * (taus[0] + taus[1]));
        let mut points: Vec<(f64, DVec3)> = vec![(taus[0], ends[0])];
        let between = |tau: f64| (tau > taus[0] && tau < taus[1]) || (tau < taus[0] && tau > taus[1]);
        // Near an end the end itself is the turning point: the heights differ in the square of the distance.
        let turning = curve.point(curve.middle);
        let turns = between(curve.middle) && ends.iter().all(|end| end.distance(turning) > LEVEL_SNAP);
        let mut stops = Vec::new();
        if turns {
            stops.push((curve.middle, turning));
        }
        stops.push((taus[1], ends[1]));
        for (tau, point) in stops {
            let from = points.last().map_or(ends[0], |p| p.1);
            let before = points.last().map_or(taus[0], |p| p.0);
            let marks: Vec<(f64, DVec3)> = self
                .levels
                .crossed(from.z, point.z)
                .filter_map(|u| {
                    let c = self.levels.heights[u];
                    let at = curve.tau_at((sector.z0 - c) / sector.drop, 0.5 * (before + tau))?;
                    Some((at, (sector.origin + sector.ruling(at) * ((sector.z0 - c) / sector.drop)).extend(c)))
                })
                .collect();
            for next in marks.into_iter().chain([(tau, point)]) {
                self.halve(&curve, sector, sheet, other, &mut points, next, MAX_HALVINGS);
                points.push(next);
            }
        }
        points.pop();
        points.into_iter().skip(1).map(|p| p.1).collect()
    }

    /// Adds points between the last one and `next` until all chords are short enough for the cones on both sides.
    #[allow(clippy::too_many_arguments, reason = "a recursion over one curve")]
    fn halve(
        &self,
        curve: &Curve,
        sector: &Facet,
        sheet: &Sheet,
        other: FacetId,
        points: &mut Vec<(f64, DVec3)>,
        next: (f64, DVec3),
        depth: u32,
    ) {
        let Some(&last) = points.last() else { return };
        let wide = |facet: &Facet| {
            let (t0, r0) = facet.parameters(last.1.truncate());
            let (t1, r1) = facet.parameters(next.1.truncate());
            (t1 - t0).abs() > self.widest(r0.max(r1), facet.drop)
        };
        let partner = sheet.facet(other);
        if depth == 0 || !(wide(sector) || (matches!(partner.kind, Kind::Sector(_)) && wide(partner))) {
            return;
        }
        let tau = 0.5 * (last.0 + next.0);
        let middle = (tau, curve.point(tau));
        self.halve(curve, sector, sheet, other, points, middle, depth - 1);
        points.push(middle);
        self.halve(curve, sector, sheet, other, points, next, depth - 1);
    }

    /// Adds the points at which a chain of chords reaches the outer distance of a facet on either side.
    fn with_reach(&self, points: Vec<DVec3>, ends: [DVec3; 2], facets: [&Facet; 2], reach: f64) -> Vec<DVec3> {
        let chain: Vec<DVec3> = std::iter::once(ends[0]).chain(points).chain([ends[1]]).collect();
        let mut out = Vec::with_capacity(chain.len());
        for w in chain.windows(2) {
            out.push(w[0]);
            let mut cuts: Vec<f64> = facets
                .iter()
                .filter_map(|f| {
                    let r = |p: DVec3| f.parameters(p.truncate()).1;
                    let (a, b) = (r(w[0]), r(w[1]));
                    let crosses = a.min(b) < reach - REACH_SNAP && a.max(b) > reach + REACH_SNAP;
                    crosses.then(|| if f.is_strip() { (reach - a) / (b - a) } else { on_circle(f, w[0], w[1], reach) })
                })
                .collect();
            cuts.sort_by(f64::total_cmp);
            cuts.dedup_by(|a, b| (*a - *b).abs() * w[0].distance(w[1]) < REACH_SNAP);
            out.extend(cuts.into_iter().map(|t| w[0].lerp(w[1], t)));
        }
        out.remove(0);
        out
    }
}

/// Where the chord from `a` to `b`, one inside and one outside, crosses the circle of radius `r` about a sector's node:
/// the root in (0, 1) of `|w + t v|² = r²`.
fn on_circle(sector: &Facet, a: DVec3, b: DVec3, r: f64) -> f64 {
    let (w, v) = (a.truncate() - sector.origin, (b - a).truncate());
    let (p, q, c) = (v.length_squared(), w.dot(v), w.length_squared() - r * r);
    let root = (q * q - p * c).max(0.0).sqrt();
    // The root of the right sign, without cancellation.
    if c < 0.0 { if q > 0.0 { -c / (q + root) } else { (root - q) / p } } else { c / (root - q) }
}

/// Points closer to the outer distance than this (plan, length units) lie on it.
pub const REACH_SNAP: f64 = 1e-6;

/// The crease of a sector with another facet, as `R(ψ) = num / (shift + scale·cos ψ)` with `ψ` from its nearest ruling.
struct Curve<'a> {
    sector: &'a Facet,
    /// `τ` of the shortest ruling up to the other facet.
    middle: f64,
    num: f64,
    shift: f64,
    scale: f64,
}

impl<'a> Curve<'a> {
    fn new(sheet: &Sheet, sector: &'a Facet, other: FacetId, near: f64) -> Self {
        let foot = sector.origin.extend(sector.z0);
        let facet = sheet.facet(other);
        let (towards, num, shift, scale) = match facet.kind {
            // R = num / k(1 − d·d_k): shortest against the other's rulings.
            Kind::Strip(_) => (-facet.d, foot.z - facet.height(foot.truncate()), sector.drop, sector.drop),
            // R = num / 2(e + w·d): shortest towards the other's node.
            Kind::Sector(_) => {
                let w = facet.origin - sector.origin;
                let e = (facet.z0 - foot.z) / sector.drop;
                let distance = w.length();
                (w / distance, (distance - e) * (distance + e), 2.0 * e, 2.0 * distance)
            }
        };
        // Of the angles that stand for this direction the one within half a turn of the arc.
        let (angle, _) = sector.parameters(sector.origin + towards);
        let middle = angle - TAU * ((angle - near) / TAU).round();
        Self { sector, middle, num, shift, scale }
    }

    fn point(&self, tau: f64) -> DVec3 {
        let r = self.num / (self.shift + self.scale * (tau - self.middle).cos());
        self.sector.point(tau, r)
    }

    /// The ruling of length `r` on the same side of the shortest one as `near`.
    fn tau_at(&self, r: f64, near: f64) -> Option<f64> {
        let cos = (self.num / r - self.shift) / self.scale;
        (cos.abs() <= 1.0).then(|| self.middle + cos.acos().copysign(near - self.middle))
    }
}
