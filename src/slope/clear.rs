//! Whether the far boundaries of the facets lie clear of everything else.
//!
//! Another sheet that comes up over a ruling stays above it, and rises ever further above it: every sheet falls by the slope at
//! most, and the ruling by the slope. So a facet whose far boundary is nowhere lower than another sheet, but for some slack, is so
//! nowhere. Sheets are concave: between two places of a straight piece of boundary they lie below their tangents there. Far from
//! two nodes their cones are all but parallel: that bounds what edges close to a node gain on its cone along a curved piece.

use super::arcs::{Arcs, Piece};
use super::closure::Closure;
use super::facet::{END, FacetId};
use super::trim::Sheet;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Pieces shorter than this (length units) are not parted further.
const SHORTEST: f64 = 1e-6;

/// A piece is looked at in at most this many parts.
const MAX_PARTS: usize = 20_000;

/// The curve between two places leaves the chord by no more than this many times what it does in the middle.
const BULGE: f64 = 2.0;

/// Edges within this part of the distance of a node are close to it.
const CLOSE: f64 = 0.4;

/// The chord of an angle is no longer than its sine times this, for edges that are [`CLOSE`].
const SINE_TO_CHORD: f64 = 1.1;

/// Places of far boundaries that lie lower than another sheet by more than `slack` (length units): facet and `τ`. None if there are
/// none, proved for every place of every boundary.
pub fn intruded(sheet: &Sheet, closure: &Closure, arcs: &Arcs, slack: f64) -> Vec<(FacetId, f64)> {
    let look = Look { sheet, closure, arcs, slack };
    let facets = arcs.pieces.par_iter().enumerate();
    // A shared piece is looked at from one side.
    facets
        .flat_map_iter(|(f, pieces)| pieces.iter().filter(|p| p.forward).flat_map(move |p| look.piece(f as FacetId, p)))
        .collect()
}

#[derive(Clone, Copy)]
struct Look<'a> {
    sheet: &'a Sheet<'a>,
    closure: &'a Closure,
    arcs: &'a Arcs,
    slack: f64,
}

/// A place of the boundary of a facet.
#[derive(Clone, Copy)]
struct Place {
    tau: f64,
    point: DVec3,
}

/// What there is about a part of a boundary.
enum Part {
    /// No other sheet is higher.
    Clear,
    /// One is, in the middle.
    Below,
    /// Not known yet; the middle.
    Unclear(Place),
}

impl Look<'_> {
    fn piece(&self, f: FacetId, piece: &Piece) -> Option<(FacetId, f64)> {
        let arc = &self.arcs.arcs[piece.arc as usize];
        let end = |i: usize| Place { tau: piece.tau[i], point: self.closure.vertices[arc.ends[i] as usize] };
        let mut parts = vec![[end(0), end(1)]];
        let mut count = 0;
        while let Some([from, to]) = parts.pop() {
            count += 1;
            match self.part(f, arc.partner, [from, to]) {
                Part::Clear => {}
                Part::Unclear(middle) if count < MAX_PARTS => parts.extend([[middle, to], [from, middle]]),
                Part::Below | Part::Unclear(_) => return Some((f, 0.5 * (from.tau + to.tau))),
            }
        }
        None
    }

    fn part(&self, f: FacetId, partner: FacetId, [from, to]: [Place; 2]) -> Part {
        let sheet = self.sheet;
        let facet = sheet.facet(f);
        let tau = 0.5 * (from.tau + to.tau);
        let r = sheet.crossing(facet.foot(tau), facet.ruling(tau), partner).length();
        if !r.is_finite() {
            return Part::Below;
        }
        let middle = facet.point(tau, r);
        let chord = (to.point - from.point).truncate();
        let length = chord.length();
        let straight = 0.5 * (from.point + to.point);
        // How far the curve leaves the chord: in plan across it, and in height.
        let off = middle - straight;
        let along = if length > 0.0 { chord.dot(off.truncate()) / (length * length) } else { 0.0 };
        let aside = (off.truncate() - chord * along).length();
        let lower = (off.z - (to.point.z - from.point.z) * along).min(0.0).abs();
        let bulge = BULGE * (sheet.k * aside + lower);
        let fall = 0.5 * (sheet.k * length + (to.point.z - from.point.z).abs());
        let floor = straight.z + self.slack - fall - bulge;
        let cone = [f, partner].into_iter().filter(|&g| g != END).map(|g| sheet.facet(g)).find(|facet| !facet.is_strip());
        let ends = [from.point, to.point].map(DVec3::truncate);
        let nearest = |q: DVec2| ends.map(|p| p.distance(q)).into_iter().fold(middle.truncate().distance(q), f64::min) - aside;
        let reach = ends.map(|p| p.distance(middle.truncate())).into_iter().fold(0.0, f64::max);
        let cone = cone.map(|facet| facet.origin).map(|apex| (apex, nearest(apex)));
        let (mut unclear, mut below) = (false, false);
        sheet.index.visit_above(straight.truncate(), floor, |other| {
            if below || sheet.belongs(f, other) || (partner != END && sheet.belongs(partner, other)) {
                return;
            }
            let segment = sheet.index.segment(other);
            // Above the chord at both ends, and how fast it rises from either towards the other one.
            let [a, b] = [(from, 1.0), (to, -1.0)].map(|(end, sign)| {
                let (height, gradient) = segment.tangent(end.point.truncate(), sheet.k);
                (height - end.point.z, sign * (gradient.dot(chord) - (to.point.z - from.point.z)))
            });
            let highest = if a.1 <= 0.0 {
                a.0
            } else if b.1 <= 0.0 {
                b.0
            } else {
                a.0 + a.1 * (b.0 - a.0 + b.1) / (a.1 + b.1)
            };
            if highest + bulge <= self.slack {
                return;
            }
            let above = segment.height(middle.truncate(), sheet.k) - middle.z;
            below |= above > self.slack;
            unclear |= cone.is_none_or(|(apex, nearest)| {
                // The rulings of the two to a place are at an angle of which this is the sine, at most.
                let away = segment.a.distance(apex).max(segment.b.distance(apex));
                let sine = away / (nearest - away);
                away > CLOSE * nearest || above + SINE_TO_CHORD * sine * sheet.k * reach > self.slack
            });
        });
        match (below, unclear && length > SHORTEST) {
            (true, _) => Part::Below,
            (false, true) => Part::Unclear(Place { tau, point: middle }),
            (false, false) => Part::Clear,
        }
    }
}
