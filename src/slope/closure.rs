//! Closure: the far boundary of every facet, as a list of vertices with the partner between each two.
//!
//! Every facet starts with the ends of its `τ` range. Between two knots with different partners there must be a vertex where
//! the facet meets both; if a third one comes up there first, it is put between them, and so on. A vertex found by one facet
//! is handed to the two others that meet there, so that what one facet missed another tells. Rounds run until nobody learns
//! anything new; facets are independent within a round.

mod between;
mod effort;
mod gap;

use super::facet::{END, FacetId, Kind, Lateral};
use super::network::twin;
use super::trim::{Sheet, Tip};
use between::Between;
pub use effort::Effort;
use gap::Gap;
use glam::DVec3;
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Vertices of one facet closer than this (length units) are one, unless that spoils a surface.
pub const SNAP: f64 = 1e-8;

/// The same where it does, as in the tips of very narrow strips: ten times the rounding of coordinates ten kilometres from the
/// local origin.
pub const FINER_SNAP: f64 = 2e-11;

/// Knots closer than this (relative, in `τ`) lie on one ruling.
const TIE_WIDTH: f64 = 1e-15;

/// Rounds of exchange before giving up; sound input needs fewer than ten.
const MAX_ROUNDS: usize = 60;

/// Steps one facet may take in a round, and per edge of the line, before it is given up: it can meet all others.
const MAX_STEPS: [usize; 2] = [1000, 4];

/// Sectors are looked at from rulings at most this far apart (radians) before closure starts.
const SECTOR_STEP: f64 = 0.5;

/// Three facets in counter-clockwise order around a vertex, the least first. Facets meet at most once in a given order.
pub type Key = [FacetId; 3];

/// A vertex id: nodes first, then joint tips, then junctions.
pub type VertexId = u32;

/// No vertex: a knot that only says which partner is met there.
const HINT: VertexId = VertexId::MAX;

/// A junction found in this round by one facet is numbered from here until all facets agree on numbers: fewer than a
/// thousand million vertices fit below.
const FRESH: VertexId = 1 << 30;

/// A place on the far boundary of a facet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    /// Parameter of the ruling.
    pub tau: f64,
    /// Vertex there.
    pub vertex: VertexId,
    /// Partner before it.
    pub left: FacetId,
    /// Partner after it.
    pub right: FacetId,
}

/// A junction found by one facet, not numbered yet.
#[derive(Clone, Copy, Debug)]
struct Found {
    knot: usize,
    key: Key,
    point: DVec3,
}

/// The far boundary of a facet while it is being closed.
#[derive(Clone, Debug, Default)]
struct Boundary {
    knots: Vec<Knot>,
    /// Whether it could not be closed.
    stuck: bool,
}

/// The closed boundaries of all facets.
pub struct Closure {
    /// Knots of each closed facet, from `τ = 0` to the end; empty for the others.
    pub knots: Vec<Vec<Knot>>,
    /// Position of each vertex id.
    pub vertices: Vec<DVec3>,
    /// The facets around each junction and tip, counter-clockwise; `None` for nodes.
    pub keys: Vec<Option<Key>>,
    /// Facets that could not be closed.
    pub stuck: Vec<FacetId>,
    /// How often a closed facet meets one that is not closed.
    pub strangers: usize,
    /// Length of the visible part of each joint.
    pub tips: Vec<Tip>,
}

/// The key of facets `f`, then `b` and `a` counter-clockwise.
fn key_of(f: FacetId, right: FacetId, left: FacetId) -> Key {
    let cycle = [f, right, left];
    let least = (0..3).min_by_key(|&i| cycle[i]).unwrap_or(0);
    [cycle[least], cycle[(least + 1) % 3], cycle[(least + 2) % 3]]
}

/// The partners of `f` on its left and right at a vertex.
fn sides_of(f: FacetId, key: Key) -> Option<(FacetId, FacetId)> {
    let i = key.iter().position(|&g| g == f)?;
    Some((key[(i + 2) % 3], key[(i + 1) % 3]))
}

/// Which facets are closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scope {
    /// Those that are wanted: enough where they never meet another.
    Wanted,
    /// All.
    All,
}

/// Closes the facets of a sheet. `hints` are extra rulings to look at: facet and `τ`. Vertices of one facet closer than `snap`
/// are one. `None` when the effort ran out.
pub fn close(sheet: &Sheet, scope: Scope, hints: &[(FacetId, f64)], snap: f64, effort: &Effort) -> Option<Closure> {
    let nodes = sheet.network.nodes.len();
    let joints = &sheet.fans.joints;
    let wanted = |f: FacetId| scope == Scope::All || sheet.facet(f).wanted;
    let covered: Vec<bool> = (0..nodes as u32).into_par_iter().map(|n| sheet.covered(n)).collect();
    let tips: Vec<Tip> = joints
        .par_iter()
        .map(|joint| {
            let foot = sheet.network.nodes[joint.node as usize];
            if covered[joint.node as usize] || !(wanted(joint.left) || wanted(joint.right)) || effort.is_spent() {
                return Tip { r: 0.0, partner: END, point: foot, compared: 0 };
            }
            let tip = sheet.trim_joint(joint);
            effort.compare(tip.compared);
            tip
        })
        .collect();
    let mut state = State::new(sheet, scope, tips, snap, effort);
    let mut boundaries: Vec<Boundary> = (0..sheet.fans.facets.len() as FacetId)
        .into_par_iter()
        .map(|f| if wanted(f) { state.begin(f, &covered) } else { Boundary::default() })
        .collect();
    for &(f, tau) in hints {
        state.insert_hint(f, tau, &mut boundaries[f as usize].knots);
    }
    let mut pending: Vec<(FacetId, Vec<VertexId>)> =
        (0..boundaries.len() as FacetId).filter(|&f| wanted(f)).map(|f| (f, Vec::new())).collect();
    for (j, tip) in state.tips.iter().enumerate() {
        if tip.r > 0.0 && tip.partner != END && wanted(tip.partner) {
            pending_entry(&mut pending, tip.partner).push((nodes + j) as VertexId);
        }
    }
    for _ in 0..MAX_ROUNDS {
        if pending.is_empty() || effort.is_spent() {
            break;
        }
        pending = state.round(&mut boundaries, pending);
    }
    if effort.is_spent() {
        return None;
    }
    let mut stuck: Vec<FacetId> = pending.iter().map(|p| p.0).collect();
    stuck.extend((0..boundaries.len() as FacetId).filter(|&f| boundaries[f as usize].stuck));
    stuck.sort_unstable();
    stuck.dedup();
    let strangers = boundaries
        .iter()
        .enumerate()
        .flat_map(|(f, b)| b.knots.iter().map(move |k| (f as FacetId, k.left)))
        .filter(|&(f, k)| k != END && k != twin_strip(sheet, f) && !wanted(k))
        .count();
    let knots = boundaries.into_iter().map(|b| b.knots).collect();
    Some(Closure { knots, vertices: state.vertices, keys: state.keys, stuck, strangers, tips: state.tips })
}

/// The entry of facet `f` in a list sorted by facet.
fn pending_entry(pending: &mut Vec<(FacetId, Vec<VertexId>)>, f: FacetId) -> &mut Vec<VertexId> {
    let at = match pending.binary_search_by_key(&f, |p| p.0) {
        Ok(at) => at,
        Err(at) => {
            pending.insert(at, (f, Vec::new()));
            at
        }
    };
    &mut pending[at].1
}

/// The strip on the other side of a strip's edge: the partner of its covered stretches. Sectors have none.
pub(super) fn twin_strip(sheet: &Sheet, f: FacetId) -> FacetId {
    match sheet.facet(f).kind {
        Kind::Strip(h) => twin(h),
        Kind::Sector(_) => END,
    }
}

struct State<'a> {
    sheet: &'a Sheet<'a>,
    scope: Scope,
    snap: f64,
    tips: Vec<Tip>,
    vertices: Vec<DVec3>,
    keys: Vec<Option<Key>>,
    ids: FxHashMap<Key, VertexId>,
    effort: &'a Effort,
}

impl<'a> State<'a> {
    fn new(sheet: &'a Sheet<'a>, scope: Scope, tips: Vec<Tip>, snap: f64, effort: &'a Effort) -> Self {
        let mut vertices = sheet.network.nodes.clone();
        let mut keys: Vec<Option<Key>> = vec![None; vertices.len()];
        let mut ids = FxHashMap::default();
        for (joint, tip) in sheet.fans.joints.iter().zip(&tips) {
            let key = key_of(joint.left, joint.right, tip.partner);
            if tip.r > 0.0 {
                ids.insert(key, vertices.len() as VertexId);
            }
            keys.push((tip.r > 0.0).then_some(key));
            vertices.push(tip.point);
        }
        Self { sheet, scope, snap, tips, vertices, keys, ids, effort }
    }

    fn tip_vertex(&self, joint: u32) -> VertexId {
        self.sheet.network.nodes.len() as VertexId + joint
    }

    /// The ends of a facet's range.
    fn begin(&self, f: FacetId, covered: &[bool]) -> Boundary {
        let facet = self.sheet.facet(f);
        let hidden = twin_strip(self.sheet, f);
        let ends = match facet.kind {
            Kind::Strip(h) => [self.sheet.network.origin(h), self.sheet.network.target(h)],
            Kind::Sector(node) => [node, node],
        };
        let at = |i: usize| -> (VertexId, FacetId) {
            let node = ends[i];
            match facet.lateral[i] {
                Lateral::Crease(other) if !covered[node as usize] => (node, other),
                Lateral::Joint(j) if !covered[node as usize] && self.tips[j as usize].r > 0.0 => {
                    (self.tip_vertex(j), self.tips[j as usize].partner)
                }
                _ => (node, hidden),
            }
        };
        let (first, last) = (at(0), at(1));
        let mut knots = vec![
            Knot { tau: 0.0, vertex: first.0, left: first.1, right: first.1 },
            Knot { tau: facet.tau_max, vertex: last.0, left: last.1, right: last.1 },
        ];
        if !facet.is_strip() && !covered[ends[0] as usize] {
            let count = (facet.tau_max / SECTOR_STEP).ceil() as usize;
            for i in 1..count {
                self.insert_hint(f, facet.tau_max * i as f64 / count as f64, &mut knots);
            }
        }
        Boundary { knots, stuck: false }
    }

    /// Looks along ruling `τ` and notes the partner.
    fn insert_hint(&self, f: FacetId, tau: f64, knots: &mut Vec<Knot>) {
        let at = knots.partition_point(|k| k.tau < tau);
        if at == 0 || at == knots.len() {
            return;
        }
        let partner = self.look(f, tau);
        knots.insert(at, Knot { tau, vertex: HINT, left: partner, right: partner });
    }

    /// The partner of ruling `τ`.
    fn look(&self, f: FacetId, tau: f64) -> FacetId {
        if self.effort.is_spent() {
            return END;
        }
        let tip = self.sheet.trim_facet(f, tau);
        self.effort.compare(tip.compared);
        if tip.r <= 0.0 { twin_strip(self.sheet, f) } else { tip.partner }
    }

    /// One round: closes the pending facets, numbers what they found and collects who has yet to hear of it.
    fn round(&mut self, boundaries: &mut [Boundary], pending: Vec<(FacetId, Vec<VertexId>)>) -> Vec<(FacetId, Vec<VertexId>)> {
        let work: Vec<(FacetId, Vec<VertexId>, Boundary)> =
            pending.into_iter().map(|(f, mates)| (f, mates, std::mem::take(&mut boundaries[f as usize]))).collect();
        let this = &*self;
        let done: Vec<(FacetId, Boundary, Vec<Found>)> = work
            .into_par_iter()
            .map(|(f, mates, mut boundary)| {
                this.insert_mates(f, &mates, &mut boundary.knots);
                let found = this.close_facet(f, &mut boundary);
                (f, boundary, found)
            })
            .collect();
        let mut fresh: Vec<VertexId> = Vec::new();
        let mut finders: Vec<FacetId> = Vec::new();
        for (f, mut boundary, found) in done {
            for item in found {
                let next = self.vertices.len() as VertexId;
                let id = *self.ids.entry(item.key).or_insert(next);
                if id == next {
                    self.vertices.push(item.point);
                    self.keys.push(Some(item.key));
                    fresh.push(id);
                    finders.push(f);
                }
                boundary.knots[item.knot].vertex = id;
            }
            boundaries[f as usize] = boundary;
        }
        let mut tell: Vec<(FacetId, VertexId)> = Vec::new();
        for (&id, &finder) in fresh.iter().zip(&finders) {
            let meet = self.keys[id as usize].into_iter().flatten();
            let wanted = |f: FacetId| f != END && (self.scope == Scope::All || self.sheet.facet(f).wanted);
            tell.extend(meet.filter(|&f| f != finder && wanted(f)).map(|f| (f, id)));
        }
        tell.sort_unstable();
        let mut next: Vec<(FacetId, Vec<VertexId>)> = Vec::new();
        let mut known: Vec<VertexId> = Vec::new();
        for told in tell.chunk_by(|a, b| a.0 == b.0) {
            let f = told[0].0;
            known.clear();
            known.extend(boundaries[f as usize].knots.iter().map(|k| k.vertex));
            known.sort_unstable();
            let new: Vec<VertexId> = told.iter().map(|t| t.1).filter(|id| known.binary_search(id).is_err()).collect();
            if !new.is_empty() {
                next.push((f, new));
            }
        }
        next
    }

    /// Puts vertices that other facets found into the boundary of `f`, unless what stands there speaks for them.
    fn insert_mates(&self, f: FacetId, mates: &[VertexId], knots: &mut Vec<Knot>) {
        let facet = self.sheet.facet(f);
        let knot = |&vertex: &VertexId| {
            let (left, right) = self.keys[vertex as usize].and_then(|key| sides_of(f, key))?;
            let (tau, _) = facet.parameters(self.vertices[vertex as usize].truncate());
            Some(Knot { tau: tau.clamp(0.0, facet.tau_max), vertex, left, right })
        };
        let mut mates: Vec<Knot> = mates.iter().filter_map(knot).collect();
        mates.sort_by(|a, b| a.tau.total_cmp(&b.tau).then(a.vertex.cmp(&b.vertex)));
        let mut gap = Gap::new(knots);
        for mate in mates {
            self.effort.step();
            gap.go_to(mate.tau);
            if !self.speaks_for(&gap, &mate) {
                gap.ahead.push(mate);
            }
        }
    }

    /// Whether a knot beside the gap at the place of `mate` speaks for it as well, because the boundary is consistent there.
    fn speaks_for(&self, gap: &Gap, mate: &Knot) -> bool {
        let point = self.vertices[mate.vertex as usize];
        let same = |k: &Knot| k.vertex != HINT && self.vertices[k.vertex as usize].distance(point) <= self.snap;
        let joins = |a: &Knot, b: &Knot| a.right == b.left;
        let (Some(left), Some(right)) = (gap.behind.last(), gap.ahead.last()) else { return false };
        (same(left) || same(right))
            && joins(left, right)
            && gap.behind.windows(2).next_back().is_none_or(|w| joins(&w[0], &w[1]))
            && gap.ahead.windows(2).next_back().is_none_or(|w| joins(&w[1], &w[0]))
    }

    /// Closes the boundary of `f`; returns the junctions it found, knots numbered in the final list.
    fn close_facet(&self, f: FacetId, boundary: &mut Boundary) -> Vec<Found> {
        let mut found: Vec<(Key, DVec3)> = Vec::new();
        if boundary.stuck {
            return Vec::new();
        }
        let budget = MAX_STEPS[0] + MAX_STEPS[1] * self.sheet.network.edges.len();
        let mut steps = 0;
        let mut gap = Gap::new(&mut boundary.knots);
        while let (Some(&a), Some(&b)) = (gap.behind.last(), gap.ahead.last()) {
            if a.right == b.left {
                gap.step();
                continue;
            }
            steps += 1;
            self.effort.step();
            let between = if steps > budget || self.effort.is_spent() { Between::Stuck } else { self.between(f, &a, &b) };
            gap.ahead.push(match between {
                Between::Junction { tau, left, right, point } => {
                    let key = key_of(f, right, left);
                    let vertex = match self.ids.get(&key) {
                        Some(&id) => id,
                        None => {
                            found.push((key, point));
                            FRESH + found.len() as VertexId - 1
                        }
                    };
                    Knot { tau, vertex, left, right }
                }
                Between::Vertex { tau, left, right, vertex } => Knot { tau, vertex, left, right },
                Between::Hint { tau, partner } => Knot { tau, vertex: HINT, left: partner, right: partner },
                Between::Stuck => {
                    boundary.stuck = true;
                    break;
                }
            });
        }
        drop(gap);
        let knots = &mut boundary.knots;
        knots.retain(|k| k.vertex != HINT);
        let fresh = knots.iter().enumerate().filter(|(_, k)| k.vertex >= FRESH);
        fresh
            .map(|(knot, k)| {
                let (key, point) = found[(k.vertex - FRESH) as usize];
                Found { knot, key, point }
            })
            .collect()
    }
}
