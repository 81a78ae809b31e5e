//! Whether the outer end of what is built lies clear of all other sheets.
//!
//! Another sheet that comes up over a ruling stays above it: every sheet falls by the slope at most, and the ruling by the slope. So a
//! part that was missed in the middle of a facet shows at the outer end, or at the line, which is looked at before
//! (docs/theory.md, "The certificate"). Sheets are concave: along a straight end they lie below their tangents. Far from two nodes
//! their cones are all but parallel: that bounds what edges close to a node gain on its cone along the arc around it.

use super::arcs::{Arcs, Piece};
use super::closure::Closure;
use super::facet::{END, FacetId};
use super::trim::Sheet;
use glam::DVec2;
use rayon::prelude::*;

/// Pieces shorter than this (length units) are not parted further.
const SHORTEST: f64 = 1e-6;

/// A piece is looked at in at most this many parts: where another sheet runs alongside, all but touching, there is no end of them.
const MAX_PARTS: usize = 500;

/// An arc leaves its chord by no more than this many times what it does in the middle: rounding.
const BULGE: f64 = 1.01;

/// Wider arcs (radians) are parted first: beside their chord they are no longer near it.
const WIDEST: f64 = 1.0;

/// Edges within this part of the distance of a node are close to it.
const CLOSE: f64 = 0.4;

/// The chord of an angle is no longer than its sine times this, for edges that are [`CLOSE`].
const SINE_TO_CHORD: f64 = 1.1;

/// Places of the outer end that lie lower than another sheet by more than `slack` (length units): facet and `τ`. None if there are
/// none, proved for every place but on ends that need more than 500 parts.
pub fn intruded(sheet: &Sheet, closure: &Closure, arcs: &Arcs, slack: f64) -> Vec<(FacetId, f64)> {
    let look = Look { sheet, closure, arcs, slack };
    let facets = arcs.pieces.par_iter().enumerate();
    let at_end = |piece: &&Piece| {
        let arc = &arcs.arcs[piece.arc as usize];
        arc.partner == END && sheet.facet(arc.owner).wanted
    };
    facets.flat_map_iter(|(f, pieces)| pieces.iter().filter(at_end).flat_map(move |p| look.piece(f as FacetId, p))).collect()
}

#[derive(Clone, Copy)]
struct Look<'a> {
    sheet: &'a Sheet<'a>,
    closure: &'a Closure,
    arcs: &'a Arcs,
    slack: f64,
}

/// A place of the outer end.
#[derive(Clone, Copy)]
struct Place {
    tau: f64,
    at: DVec2,
}

/// What there is about a part of it.
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
        let end = |i: usize| Place { tau: piece.tau[i], at: self.closure.vertices[arc.ends[i] as usize].truncate() };
        let mut parts = vec![[end(0), end(1)]];
        let mut count = 0;
        while let Some([from, to]) = parts.pop() {
            count += 1;
            match self.part(f, [from, to]) {
                Part::Clear => {}
                Part::Below => return Some((f, 0.5 * (from.tau + to.tau))),
                Part::Unclear(middle) if count < MAX_PARTS => parts.extend([[middle, to], [from, middle]]),
                Part::Unclear(_) => return None,
            }
        }
        None
    }

    fn part(&self, f: FacetId, [from, to]: [Place; 2]) -> Part {
        let (sheet, k) = (self.sheet, self.sheet.k);
        let facet = sheet.facet(f);
        let tau = 0.5 * (from.tau + to.tau);
        let middle = facet.point(tau, (facet.foot(tau).z - sheet.end) / k).truncate();
        if !facet.is_strip() && to.tau - from.tau > WIDEST {
            return Part::Unclear(Place { tau, at: middle });
        }
        let chord = to.at - from.at;
        let (straight, length) = (0.5 * (from.at + to.at), chord.length());
        // Heights beside the chord.
        let bulge = BULGE * k * middle.distance(straight);
        // An arc: its node, and how far its ends are from its middle.
        let arc = (!facet.is_strip()).then(|| (facet.origin, middle.distance(facet.origin), from.at.distance(middle)));
        let (mut unclear, mut below) = (false, false);
        sheet.index.visit_above(straight, sheet.end + self.slack - 0.5 * k * length - bulge, |other| {
            if below || sheet.belongs(f, other) {
                return;
            }
            let segment = sheet.index.segment(other);
            let above = segment.height(middle, k) - sheet.end;
            below |= above > self.slack;
            if let Some((node, radius, reach)) = arc {
                // The rulings of the two to a place are at an angle of which this is the sine, at most.
                let away = segment.a.distance(node).max(segment.b.distance(node));
                let sine = away / (radius - away);
                if away < CLOSE * radius && above + SINE_TO_CHORD * sine * k * reach <= self.slack {
                    return;
                }
            }
            // Height above either end of the chord, and what it gains from there to the other one.
            let [a, b] = [(from.at, chord), (to.at, -chord)].map(|(end, onwards)| {
                let (height, gradient) = segment.tangent(end, k);
                (height - sheet.end, gradient.dot(onwards))
            });
            let highest = if a.1 <= 0.0 {
                a.0
            } else if b.1 <= 0.0 {
                b.0
            } else {
                a.0 + a.1 * (b.0 - a.0 + b.1) / (a.1 + b.1)
            };
            unclear |= highest + bulge > self.slack;
        });
        match (below, unclear && length > SHORTEST) {
            (true, _) => Part::Below,
            (false, true) => Part::Unclear(Place { tau, at: middle }),
            (false, false) => Part::Clear,
        }
    }
}
