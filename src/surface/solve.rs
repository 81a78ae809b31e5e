//! Closing the facets until the certificate holds.

use super::{SurfaceError, Watch};
use crate::slope::arcs::Arcs;
use crate::slope::closure::{self, Closure, Scope};
use crate::slope::facet::{END, FacetId};
use crate::slope::refine::WIDEST_WEDGE;
use crate::slope::trim::Sheet;

/// Attempts with more and more rulings looked at.
const ATTEMPTS: usize = 8;

/// A sheet above the outer end by less than this (length units) does not count as seen there.
const SEEN: f64 = 1e-7;

/// A closed and paired sheet.
pub(super) struct Solved {
    /// Boundaries of the facets.
    pub(super) closure: Closure,
    /// Their arcs.
    pub(super) arcs: Arcs,
}

/// Closes and pairs the facets. What a first pass misses (a cone that just touches another sheet between two rulings) shows
/// at the outer end or as an arc without a counterpart; rulings there are looked at in the next pass.
pub(super) fn solve(sheet: &Sheet, watch: &dyn Watch) -> Result<Solved, SurfaceError> {
    let mut scope = Scope::Wanted;
    let mut hints: Vec<(FacetId, f64)> = Vec::new();
    let mut solved;
    let mut attempt = 0;
    loop {
        if watch.cancelled() {
            return Err(SurfaceError::Cancelled);
        }
        let closure = closure::close(sheet, scope, &hints);
        if closure.strangers > 0 && scope == Scope::Wanted {
            scope = Scope::All;
            continue;
        }
        let arcs = Arcs::new(sheet, &closure);
        solved = Solved { closure, arcs };
        attempt += 1;
        let before = hints.len();
        hints.extend(solved.seen_at_the_end(sheet));
        hints.extend(solved.beside_unpaired(sheet));
        hints.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        hints.dedup();
        if hints.len() == before || attempt == ATTEMPTS {
            break;
        }
    }
    match solved.first_flaw() {
        None => Ok(solved),
        Some(place) => {
            let p = sheet.network.world(place);
            Err(SurfaceError::Unclosed {
                x: p.x,
                y: p.y,
                unpaired: solved.arcs.unpaired.len() + solved.closure.stuck.len(),
                arcs: solved.arcs.arcs.len(),
            })
        }
    }
}

impl Solved {
    /// Rulings that reach the outer end though another sheet is higher there.
    fn seen_at_the_end(&self, sheet: &Sheet) -> Vec<(FacetId, f64)> {
        let mut hints = Vec::new();
        for (f, pieces) in self.arcs.pieces.iter().enumerate() {
            let facet = sheet.facet(f as FacetId);
            for piece in pieces.iter().filter(|p| self.arcs.arcs[p.arc as usize].partner == END) {
                let width = piece.tau[1] - piece.tau[0];
                let parts = if facet.is_strip() { 2 } else { 2 * (width / WIDEST_WEDGE).ceil() as usize };
                for i in 1..parts {
                    let tau = piece.tau[0] + width * (i as f64 / parts as f64);
                    let r = (facet.foot(tau).z - sheet.end) / sheet.k;
                    let p = facet.point(tau, r);
                    if sheet.index.height(p.truncate(), None).0 > sheet.end + SEEN {
                        hints.push((f as FacetId, tau));
                    }
                }
            }
        }
        hints
    }

    /// Rulings in the middle of arcs without a counterpart, on both sides.
    fn beside_unpaired(&self, sheet: &Sheet) -> Vec<(FacetId, f64)> {
        let mut hints = Vec::new();
        for &i in &self.arcs.unpaired {
            let arc = &self.arcs.arcs[i as usize];
            let [a, b] = arc.ends.map(|v| self.closure.vertices[v as usize].truncate());
            for f in [arc.owner, arc.partner] {
                hints.push((f, sheet.facet(f).parameters(0.5 * (a + b)).0));
            }
        }
        hints
    }

    /// A place where the surface does not close.
    fn first_flaw(&self) -> Option<glam::DVec3> {
        let unpaired = self.arcs.unpaired.first().map(|&i| self.arcs.arcs[i as usize].ends[0]);
        let stuck = self.closure.stuck.first().and_then(|&f| self.closure.knots[f as usize].first()).map(|k| k.vertex);
        unpaired.or(stuck).map(|v| self.closure.vertices[v as usize])
    }
}
