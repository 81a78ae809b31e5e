//! Closing the facets until the certificate holds.

use super::{SurfaceError, Watch};
use crate::kernel::orientation::{Turn, turn};
use crate::kernel::segment_tree::SegmentTree;
use crate::slope::arcs::Arcs;
use crate::slope::clear;
use crate::slope::closure::{self, Closure, Effort, Scope};
use crate::slope::cover::Covers;
use crate::slope::facet::{END, FacetId};
use crate::slope::refine::WIDEST_WEDGE;
use crate::slope::trim::Sheet;
use glam::{DVec2, DVec3};

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

/// How a sheet is closed.
#[derive(Clone, Copy)]
pub(super) struct Ask<'a> {
    /// The sheet.
    pub(super) sheet: &'a Sheet<'a>,
    /// The stretches of the line that do not show.
    pub(super) covers: &'a Covers,
    /// Vertices closer than this (length units) are one.
    pub(super) snap: f64,
    /// Another sheet may be higher than what is built by this (length units).
    pub(super) slack: f64,
}

/// Closes and pairs the facets. What a first pass misses (a cone that just touches another sheet between two rulings, a part that
/// stands above the middle of a boundary) shows at the outer end, as an arc without a counterpart, or as an arc below another sheet;
/// rulings there are looked at in the next pass.
pub(super) fn solve(ask: Ask, watch: &dyn Watch) -> Result<Solved, SurfaceError> {
    let Ask { sheet, covers, snap, slack } = ask;
    let mut scope = Scope::Wanted;
    let mut hints = between_covers(sheet, covers);
    let mut solved;
    let mut intruded;
    let mut attempt = 0;
    let effort = Effort::for_edges(sheet.network.edges.len());
    loop {
        if watch.cancelled() {
            return Err(SurfaceError::Cancelled);
        }
        let Some(closure) = closure::close(sheet, scope, &hints, snap, &effort) else { return Err(SurfaceError::Crowded) };
        if closure.strangers > 0 && scope == Scope::Wanted {
            scope = Scope::All;
            continue;
        }
        let arcs = Arcs::new(sheet, &closure, snap);
        intruded = clear::intruded(sheet, &closure, &arcs, slack);
        solved = Solved { closure, arcs };
        attempt += 1;
        let before = hints.len();
        let mut suspects = solved.seen_at_the_end(sheet);
        suspects.extend(solved.beside_crossing_ends(sheet));
        // A suspect that reaches the end all the same tells nothing new.
        suspects.retain(|&(f, tau)| sheet.trim_facet(f, tau).partner != END);
        hints.extend(suspects);
        hints.extend(solved.beside_unpaired(sheet));
        hints.extend(&intruded);
        hints.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
        hints.dedup();
        if hints.len() == before || attempt == ATTEMPTS {
            break;
        }
    }
    let below = intruded.first().map(|&(f, tau)| sheet.facet(f).foot(tau));
    match solved.first_flaw().or(below) {
        None => Ok(solved),
        Some(place) => {
            let p = sheet.network.world(place);
            Err(SurfaceError::Unclosed {
                x: p.x,
                y: p.y,
                unpaired: solved.arcs.unpaired.len() + solved.closure.stuck.len() + intruded.len(),
                arcs: solved.arcs.arcs.len(),
            })
        }
    }
}

/// Rulings in the middle of each stretch of the line that shows, and of each that does not, on both sides, where there are both.
fn between_covers(sheet: &Sheet, covers: &Covers) -> Vec<(FacetId, f64)> {
    let mut hints = Vec::new();
    for stretches in covers.edges() {
        let e = stretches[0].0;
        let length = sheet.index.segment(e).length;
        let places = std::iter::once(0.0).chain(stretches.iter().flat_map(|s| s.1)).chain([length]);
        let places: Vec<f64> = places.collect();
        for s in places.windows(2).filter(|w| w[1] > w[0]).map(|w| 0.5 * (w[0] + w[1])) {
            hints.extend([(2 * e, s), (2 * e + 1, length - s)]);
        }
    }
    hints
}

impl Solved {
    /// Rulings of cones that reach the outer end though another sheet is higher there.
    fn seen_at_the_end(&self, sheet: &Sheet) -> Vec<(FacetId, f64)> {
        let mut hints = Vec::new();
        for (f, tau, p) in self
            .ends(sheet)
            .iter()
            .filter(|e| !sheet.facet(e.0).is_strip())
            .flat_map(|(f, rim)| rim.iter().map(|q| (*f, q.0, q.1)))
        {
            if sheet.index.height(p, None).0 > sheet.end + SEEN {
                hints.push((f, tau));
            }
        }
        hints
    }

    /// Rulings on both sides of places where the outer ends of two facets cross.
    fn beside_crossing_ends(&self, sheet: &Sheet) -> Vec<(FacetId, f64)> {
        const ASIDE: f64 = 1e-3;
        let mut pieces: Vec<(FacetId, [f64; 2])> = Vec::new();
        let mut segments = Vec::new();
        for (f, rim) in self.ends(sheet) {
            for w in rim.windows(2) {
                pieces.push((f, [w[0].0, w[1].0]));
                segments.push((w[0].1, w[1].1));
            }
        }
        let mut hints = Vec::new();
        if segments.is_empty() {
            return hints;
        }
        SegmentTree::new(&segments).pairs(|i, j| {
            if pieces[i].0 != pieces[j].0
                && let Some(at) = crossing(segments[i], segments[j])
            {
                for ((f, range), t) in [(pieces[i], at[0]), (pieces[j], at[1])] {
                    let width = range[1] - range[0];
                    hints.extend([t - ASIDE, t + ASIDE].map(|t| (f, range[0] + width * t.clamp(ASIDE, 1.0 - ASIDE))));
                }
            }
            true
        });
        hints
    }

    /// The outer end of each facet that has one: `τ` and place in plan, cones by chords.
    fn ends(&self, sheet: &Sheet) -> Vec<(FacetId, Vec<(f64, DVec2)>)> {
        let mut ends = Vec::new();
        for (f, pieces) in self.arcs.pieces.iter().enumerate() {
            let facet = sheet.facet(f as FacetId);
            for piece in pieces.iter().filter(|p| self.arcs.arcs[p.arc as usize].partner == END) {
                let width = piece.tau[1] - piece.tau[0];
                let parts = if facet.is_strip() { 1 } else { 2 * (width / WIDEST_WEDGE).ceil() as usize };
                let rim = (0..=parts).map(|i| {
                    let tau = piece.tau[0] + width * (i as f64 / parts as f64);
                    let r = (facet.foot(tau).z - sheet.end) / sheet.k;
                    (tau, facet.point(tau, r).truncate())
                });
                ends.push((f as FacetId, rim.collect()));
            }
        }
        ends
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
    fn first_flaw(&self) -> Option<DVec3> {
        let unpaired = self.arcs.unpaired.first().map(|&i| self.arcs.arcs[i as usize].ends[0]);
        let stuck = self.closure.stuck.first().and_then(|&f| self.closure.knots[f as usize].first()).map(|k| k.vertex);
        unpaired.or(stuck).map(|v| self.closure.vertices[v as usize])
    }
}

/// Where two segments cross, as parts of their lengths.
fn crossing((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2)) -> Option<[f64; 2]> {
    let apart = |p, q, r, s| turn(p, q, r) == turn(p, q, s) || [turn(p, q, r), turn(p, q, s)].contains(&Turn::Straight);
    if apart(a, b, c, d) || apart(c, d, a, b) {
        return None;
    }
    let (u, v, w) = (b - a, d - c, c - a);
    let det = u.perp_dot(v);
    Some([w.perp_dot(v) / det, w.perp_dot(u) / det])
}
