//! Pairing: the proof that the facets glue to one surface.
//!
//! Every piece of a facet's far boundary that it shares with partner `k` must be a piece of `k`'s boundary with it as the
//! partner, run the other way. Where that holds for all, nothing was missed (docs/theory.md, "The certificate").

use super::closure::{Closure, Knot, VertexId};
use super::facet::{END, FacetId};
use super::network::twin;
use super::trim::Sheet;
use crate::kernel::union::Union;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// End points of arcs without a counterpart may be this far apart (length units) to be taken for one.
const FARTHEST: f64 = 1.001e-6;

/// Index of an arc.
pub type ArcId = u32;

/// A piece of boundary between two vertices: shared by two facets, or at the outer end, or towards an unwanted facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// The facet from whose side the arc is described.
    pub owner: FacetId,
    /// The facet on the other side, or [`END`].
    pub partner: FacetId,
    /// Vertices in the order of the owner's `τ`.
    pub ends: [VertexId; 2],
    /// Whether the partner has it as well (its order is reversed).
    pub paired: bool,
}

/// A piece of the boundary of one facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    /// The arc.
    pub arc: ArcId,
    /// Whether the facet runs it from first to last end.
    pub forward: bool,
    /// Range of the facet's `τ`.
    pub tau: [f64; 2],
}

/// All arcs of a closed sheet.
pub struct Arcs {
    /// The arcs.
    pub arcs: Vec<Arc>,
    /// Pieces of each facet in the order of `τ`; covered stretches are gaps.
    pub pieces: Vec<Vec<Piece>>,
    /// Arcs that should be shared and are not.
    pub unpaired: Vec<ArcId>,
    /// The vertex each vertex was merged into.
    merged: Vec<VertexId>,
}

impl Arcs {
    /// Merges vertices closer than `snap` along the boundary and pairs the arcs.
    pub fn new(sheet: &Sheet, closure: &Closure, snap: f64) -> Self {
        let nodes = sheet.network.nodes.len() as VertexId;
        let mut merge = Merge { sets: Union::new(closure.vertices.len()), nodes };
        let place = |v: VertexId| closure.vertices[v as usize];
        for knots in &closure.knots {
            for w in knots.windows(2) {
                // What stands for them must be as close: else a row of near neighbours would run together to one vertex.
                let [a, b] = [w[0], w[1]].map(|knot| merge.root(knot.vertex));
                if place(w[0].vertex).distance(place(w[1].vertex)) <= snap && place(a).distance(place(b)) <= snap {
                    merge.unite(a, b);
                }
            }
        }
        let mut arcs = Self::pair(sheet, closure, &mut merge);
        let mut reach = snap;
        while reach <= FARTHEST {
            while !arcs.unpaired.is_empty() && arcs.heal(&mut merge, &closure.vertices, reach) {
                arcs = Self::pair(sheet, closure, &mut merge);
            }
            // First those that coincide, the others only if that is not enough.
            reach *= 10.0;
        }
        arcs.merged = (0..closure.vertices.len() as VertexId).map(|v| merge.root(v)).collect();
        arcs
    }

    /// The vertex that stands for `v`.
    pub fn vertex(&self, v: VertexId) -> VertexId {
        self.merged[v as usize]
    }

    fn pair(sheet: &Sheet, closure: &Closure, merge: &mut Merge) -> Self {
        let mut arcs: Vec<Arc> = Vec::new();
        let mut pieces = vec![Vec::new(); closure.knots.len()];
        let mut waiting: FxHashMap<[u32; 4], ArcId> = FxHashMap::default();
        for (f, knots) in closure.knots.iter().enumerate() {
            let f = f as FacetId;
            let (Some(first), Some(last)) = (knots.first(), knots.last()) else { continue };
            let (first, last) = (merge.root(first.vertex), merge.root(last.vertex));
            for w in knots.windows(2) {
                let partner = w[0].right;
                let ends = [merge.root(w[0].vertex), merge.root(w[1].vertex)];
                let covered = sheet.facet(f).is_strip() && partner == twin(f);
                if ends[0] == ends[1] || covered {
                    continue;
                }
                // A vertex merged with an end of the range stands at that end.
                let place = |k: &Knot, root: VertexId| {
                    if root == first {
                        knots[0].tau
                    } else if root == last {
                        knots[knots.len() - 1].tau
                    } else {
                        k.tau
                    }
                };
                let tau = [place(&w[0], ends[0]), place(&w[1], ends[1])];
                let mine = [partner, f, ends[1], ends[0]];
                let mut arc = arcs.len() as ArcId;
                let mut forward = true;
                if partner != END
                    && let Some(other) = waiting.remove(&mine)
                {
                    arcs[other as usize].paired = true;
                    (arc, forward) = (other, false);
                } else {
                    if partner != END {
                        waiting.insert([f, partner, ends[0], ends[1]], arc);
                    }
                    arcs.push(Arc { owner: f, partner, ends, paired: false });
                }
                pieces[f as usize].push(Piece { arc, forward, tau });
            }
        }
        let unpaired = (0..arcs.len() as ArcId)
            .filter(|&i| {
                let arc = &arcs[i as usize];
                !arc.paired && arc.partner != END && !closure.knots[arc.partner as usize].is_empty()
            })
            .collect();
        Self { arcs, pieces, unpaired, merged: Vec::new() }
    }

    /// Unites end points of unpaired arcs of the same two facets that agree to within `reach`. Says whether there were any.
    fn heal(&self, merge: &mut Merge, vertices: &[DVec3], reach: f64) -> bool {
        let mut by_facets: FxHashMap<[FacetId; 2], Vec<ArcId>> = FxHashMap::default();
        for &i in &self.unpaired {
            let arc = &self.arcs[i as usize];
            by_facets.entry([arc.owner.min(arc.partner), arc.owner.max(arc.partner)]).or_default().push(i);
        }
        let mut any = false;
        for &i in &self.unpaired {
            let arc = &self.arcs[i as usize];
            let rivals = &by_facets[&[arc.owner.min(arc.partner), arc.owner.max(arc.partner)]];
            let place = |v: VertexId| vertices[v as usize];
            for &j in rivals.iter().filter(|&&j| j > i) {
                let other = &self.arcs[j as usize];
                if other.owner != arc.partner {
                    continue;
                }
                for (v, w) in [(arc.ends[0], other.ends[1]), (arc.ends[1], other.ends[0])] {
                    if v != w && place(v).distance(place(w)) <= reach {
                        any |= merge.unite(v, w);
                    }
                }
            }
            if place(arc.ends[0]).distance(place(arc.ends[1])) <= reach {
                any |= merge.unite(arc.ends[0], arc.ends[1]);
            }
        }
        any
    }
}

/// Vertices that were merged, each known by the least of them, so nodes of the line win. Two nodes are never united.
struct Merge {
    sets: Union,
    nodes: VertexId,
}

impl Merge {
    fn root(&mut self, v: VertexId) -> VertexId {
        self.sets.root(v)
    }

    /// Says whether they were two, and are one now.
    fn unite(&mut self, v: VertexId, w: VertexId) -> bool {
        self.root(v).max(self.root(w)) >= self.nodes && self.sets.join(v, w)
    }
}
