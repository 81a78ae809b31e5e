//! The line as a plane graph: nodes, edges with two sides, and what meets at each node.

use super::canonical;
use super::noding::{Segments, weld};
use super::simplify::{self, Chord};
use crate::kernel::buckets::Buckets;
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::model::{Design, Extent, Joggle, Line, Role, Sheet, Side};
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};
use std::hash::Hash;

/// Vertices closer than this (length units, 3D) are one vertex.
pub const WELD_DISTANCE: f64 = 1e-6;

/// Vertices along a chord keep at least this distance (length units).
const CHORD_SPACING: f64 = 1e-6;

/// A vertex displaced by less than this (length units) keeps its given coordinates: it counts as collinear, not as simplified.
pub const COLLINEAR: f64 = 1e-9;

/// A joggle may use at most this part of what an edge lacks to the steepest chord.
const JOGGLE_SHARE: f64 = 0.25;

/// Chords may be as steep as this part of the slope, unless the given segments are steeper.
const STEEPEST_CHORD: f64 = 1.0 - 1e-9;

/// A directed edge: `2e` runs from `a` to `b` of edge `e`, `2e + 1` back. Its facet lies on its left.
pub type HalfEdge = u32;

/// The half-edge in the other direction.
pub fn twin(h: HalfEdge) -> HalfEdge {
    h ^ 1
}

/// Where a point of the network stands on the given line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// Chain of the line.
    pub chain: u32,
    /// Vertex within the chain.
    pub vertex: u32,
    /// Part of the way to the next vertex, from 0 up to 1: not 0 only where lines meet between vertices.
    pub part: f64,
}

/// A vertex between the ends of an edge, on the chord.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inner {
    /// Plan distance from the edge's node `a`.
    pub s: f64,
    /// Position in the mesh, local frame, heights of the falling sheet.
    pub point: DVec3,
    /// The given vertex.
    pub given: Given,
}

/// An edge: a chord of the simplified line.
#[derive(Clone, Debug, PartialEq)]
pub struct Edge {
    /// Start node.
    pub a: u32,
    /// End node.
    pub b: u32,
    /// Whether a slope is wanted on the left (0) and on the right (1).
    pub wanted: [bool; 2],
    /// Whether the inside of a ring lies on the left (0) and on the right (1).
    pub interior: [bool; 2],
    /// Given vertices at its ends; the end of a ring's last segment counts on past the last vertex. An edge of a simplified ring
    /// may run over the first vertex: it then ends at a lesser one than it begins, or a greater one where it runs against its
    /// chain. Where several chains share an edge, one of them.
    pub given: [Given; 2],
    /// Whether it runs against its chain.
    pub against: bool,
    /// Vertices between the ends.
    pub inner: Vec<Inner>,
}

/// The simplified line.
#[derive(Clone, Debug)]
pub struct Network {
    /// Local frame of all coordinates.
    pub frame: Frame,
    /// `-1` when heights are mirrored (rising sheet), else `1`.
    pub sign: f64,
    /// Nodes: plan position and height of the falling sheet.
    pub nodes: Vec<DVec3>,
    /// Edges.
    pub edges: Vec<Edge>,
    /// Vertices that were moved onto a chord.
    pub simplified: usize,
    /// Collinear vertices: dropped without being moved.
    pub collinear: usize,
    /// Largest displacement of a simplified vertex in the metric `|Δz| + k·|Δplan|`.
    pub simplified_max: f64,
}

/// One given segment between welded vertices.
struct Piece {
    ends: [u32; 2],
    wanted: [bool; 2],
    /// Wishes of rings that slope outwards, where there are any: outside of two polygons is outside of both.
    outside: Option<[bool; 2]>,
    /// Wishes of all others: what one of them wants holds.
    others: [bool; 2],
    interior: [bool; 2],
    /// The places of its ends on the line.
    given: [Given; 2],
    /// Whether it runs against its chain.
    against: bool,
}

impl Network {
    /// Builds the graph of `line` and simplifies it within `bound` (height error in the metric `|Δz| + k·|Δplan|`).
    ///
    /// Expects a validated line, every segment flatter than the slope.
    pub fn new(line: &Line, design: &Design, bound: f64) -> Self {
        let frame = design.frame.unwrap_or_else(|| {
            let PlanBox { lo: min, hi: max } = line.plan_box();
            Frame::around(min, max)
        });
        let sign = if design.sheet == Sheet::Rising { -1.0 } else { 1.0 };
        let (line, order) = canonical::line(line);
        let (mut points, of_vertex) = weld(&line, &frame, sign);
        let segments = Segments::new(&line, &of_vertex).noded(&mut points, &line);
        let mut pieces = pieces(&line, design, &segments, &order);
        for piece in &mut pieces {
            piece.against = order.against(piece.given[0].chain);
            piece.given = order.as_given(piece.given);
        }
        let slopes = [design.slope, design.companion.unwrap_or(design.slope)].map(|slope| slope.ratio());
        let mut network =
            Self { frame, sign, nodes: points, edges: Vec::new(), simplified: 0, collinear: 0, simplified_max: 0.0 }
                .with_edges(&pieces, slopes, bound);
        if let Some(joggle) = design.joggle {
            network.joggle(joggle, slopes[0].min(slopes[1]), design.extent);
        }
        network
    }

    /// Length of an edge in plan.
    pub fn length(&self, edge: &Edge) -> f64 {
        self.nodes[edge.a as usize].truncate().distance(self.nodes[edge.b as usize].truncate())
    }

    /// Moves the nodes in height, so little that every edge stays flatter than `flattest`. Nodes where the slope is to end stay.
    fn joggle(&mut self, joggle: Joggle, flattest: f64, extent: Extent) {
        let mut most = vec![joggle.most; self.nodes.len()];
        for edge in &self.edges {
            let (a, b) = (self.nodes[edge.a as usize], self.nodes[edge.b as usize]);
            let room = flattest * a.truncate().distance(b.truncate()) - (b.z - a.z).abs();
            for node in [edge.a, edge.b] {
                most[node as usize] = most[node as usize].min(JOGGLE_SHARE * room.max(0.0));
            }
        }
        let fixed = |z: f64| matches!(extent, Extent::Elevation(end) if (self.sign * z - end).abs() <= joggle.most);
        let shifts: Vec<f64> = self
            .nodes
            .iter()
            .zip(most)
            .map(|(p, most)| if fixed(p.z) { 0.0 } else { self.sign * Joggle { most, ..joggle }.shift(p.x, p.y) })
            .collect();
        for (node, shift) in self.nodes.iter_mut().zip(&shifts) {
            node.z += shift;
        }
        for edge in &mut self.edges {
            let [a, b] = [edge.a, edge.b].map(|n| (self.nodes[n as usize].truncate(), shifts[n as usize]));
            let length = a.0.distance(b.0);
            for inner in &mut edge.inner {
                inner.point.z += a.1 + (b.1 - a.1) * (inner.s / length);
            }
        }
        self.simplified += shifts.iter().filter(|&&shift| shift != 0.0).count();
        self.simplified_max += shifts.iter().fold(0.0, |most, shift| f64::max(most, shift.abs()));
    }

    /// The place in the world of a point of the falling sheet.
    pub fn world(&self, p: DVec3) -> DVec3 {
        self.frame.to_world(DVec3::new(p.x, p.y, self.sign * p.z))
    }

    /// Start node of a half-edge.
    pub fn origin(&self, h: HalfEdge) -> u32 {
        let edge = &self.edges[(h / 2) as usize];
        if h & 1 == 0 { edge.a } else { edge.b }
    }

    /// End node of a half-edge.
    pub fn target(&self, h: HalfEdge) -> u32 {
        self.origin(twin(h))
    }

    /// Half-edges leaving each node.
    pub fn outgoing(&self) -> Buckets<HalfEdge> {
        let both = |(e, edge): (u32, &Edge)| [(edge.a, 2 * e), (edge.b, 2 * e + 1)];
        Buckets::new(self.nodes.len(), (0..).zip(&self.edges).flat_map(both))
    }

    /// Cuts the pieces into runs between fixed nodes, simplifies each and drops the nodes no edge uses.
    ///
    /// With two slopes the error is measured with the steeper one and chords are bounded by the flatter one, so that the same
    /// vertices stay for both.
    fn with_edges(mut self, pieces: &[Piece], slopes: [f64; 2], bound: f64) -> Self {
        let (flatter, steeper) = (slopes[0].min(slopes[1]), slopes[0].max(slopes[1]));
        let runs = Runs::new(self.nodes.len(), pieces);
        let mut used = FxHashSet::default();
        for run in runs.all(&self.nodes) {
            let points: Vec<DVec3> = run.nodes.iter().map(|&n| self.nodes[n as usize]).collect();
            let steepest = points
                .windows(2)
                .map(|w| (w[1].z - w[0].z).abs() / w[0].truncate().distance(w[1].truncate()))
                .fold(flatter * STEEPEST_CHORD, f64::max);
            let kept = runs.kept_ends(&run);
            for chord in simplify::simplify(&points, kept, steeper, bound, steepest, CHORD_SPACING) {
                self.add_chord(&run, &points, &chord, steeper, &mut used);
            }
        }
        self.compact();
        self
    }

    fn add_chord(&mut self, run: &Run, points: &[DVec3], chord: &Chord, slope: f64, used: &mut FxHashSet<[u32; 2]>) {
        let (a, b) = (run.nodes[chord.from], run.nodes[chord.to]);
        let pair = [a.min(b), a.max(b)];
        if chord.to - chord.from > 1 && used.contains(&pair) {
            // Two runs between the same nodes, closer together than the bound: keep them apart by a vertex of this one.
            let middle = usize::midpoint(chord.from, chord.to);
            for (from, to) in [(chord.from, middle), (middle, chord.to)] {
                let part = simplify::foot_points(points, from, to, slope);
                self.add_chord(run, points, &Chord { from, to, dropped: part }, slope, used);
            }
            return;
        }
        used.insert(pair);
        let (pa, pb) = (points[chord.from], points[chord.to]);
        let length = pa.truncate().distance(pb.truncate());
        let mut inner = Vec::with_capacity(chord.dropped.len());
        for d in &chord.dropped {
            let exact = d.error <= COLLINEAR;
            if exact {
                self.collinear += 1;
            } else {
                self.simplified += 1;
                self.simplified_max = self.simplified_max.max(d.error);
            }
            let point = if exact { points[d.index] } else { pa.lerp(pb, d.along) };
            inner.push(Inner { s: d.along * length, point, given: run.given[d.index] });
        }
        let given = [run.given[chord.from], run.arriving[chord.to]];
        let against = run.against;
        self.edges.push(Edge { a, b, given, against, wanted: run.wanted, interior: run.interior, inner });
    }

    /// Renumbers nodes so that only those with an edge remain, in their old order.
    fn compact(&mut self) {
        let mut new_id = vec![u32::MAX; self.nodes.len()];
        for edge in &self.edges {
            new_id[edge.a as usize] = 0;
            new_id[edge.b as usize] = 0;
        }
        for (kept, id) in new_id.iter_mut().filter(|id| **id == 0).enumerate() {
            *id = kept as u32;
        }
        let keep = |i: usize| new_id[i] != u32::MAX;
        self.nodes = self.nodes.iter().enumerate().filter(|&(i, _)| keep(i)).map(|(_, &p)| p).collect();
        for edge in &mut self.edges {
            edge.a = new_id[edge.a as usize];
            edge.b = new_id[edge.b as usize];
        }
    }
}

/// Pieces, each once.
struct Pieces<K> {
    list: Vec<(K, Piece)>,
    known: FxHashMap<(K, [u32; 2]), usize>,
}

impl<K: Copy + Eq + Hash> Pieces<K> {
    fn new() -> Self {
        Self { list: Vec::new(), known: FxHashMap::default() }
    }

    /// Adds a piece, or joins it to the one of the same key that runs between the same nodes.
    fn add(&mut self, key: K, piece: Piece, join: impl Fn(&mut Piece, &Piece)) {
        let pair = [piece.ends[0].min(piece.ends[1]), piece.ends[0].max(piece.ends[1])];
        match self.known.get(&(key, pair)) {
            Some(&p) => join(&mut self.list[p].1, &piece),
            None => {
                self.known.insert((key, pair), self.list.len());
                self.list.push((key, piece));
            }
        }
    }
}

/// The pieces of line between nodes, each once, with the sides on which a slope is wanted.
fn pieces(line: &Line, design: &Design, segments: &Segments, order: &canonical::Order) -> Vec<Piece> {
    let mut of_polygons: Pieces<Option<u32>> = Pieces::new();
    for (c, chain) in line.chains.iter().enumerate() {
        let (side, interior_left, polygon) = match chain.role {
            Role::Open => (design.side_of_lines, false, None),
            Role::Outer { polygon } => (design.side_of_rings, signed_area(&chain.vertices) > 0.0, Some(polygon)),
            Role::Hole { polygon } => (design.side_of_rings, signed_area(&chain.vertices) < 0.0, Some(polygon)),
        };
        let against = order.against(c as u32);
        let wanted = match side {
            Side::Left => [!against, against],
            Side::Right => [against, !against],
            Side::Both => [true, true],
            Side::Inside => [interior_left, !interior_left],
            Side::Outside => [!interior_left, interior_left],
        };
        let interior = [chain.closed() && interior_left, chain.closed() && !interior_left];
        for (i, marks) in segments.by_chain[c].iter().enumerate() {
            for w in marks.windows(2) {
                let ends = [w[0].1, w[1].1];
                if ends[0] == ends[1] {
                    continue;
                }
                let place = |t: f64| {
                    let vertex = i as u32 + u32::from(t >= 1.0);
                    Given { chain: c as u32, vertex, part: if t >= 1.0 { 0.0 } else { t } }
                };
                let (outside, others) = if side == Side::Outside { (Some(wanted), [false; 2]) } else { (None, wanted) };
                let given = [place(w[0].0), place(w[1].0)];
                let piece = Piece { ends, wanted, outside, others, interior, given, against: false };
                of_polygons.add(polygon, piece, |one, other| match polygon {
                    Some(_) => one.join_ring(other, side),
                    None => one.join(other),
                });
            }
        }
    }
    let mut pieces: Pieces<()> = Pieces::new();
    for (_, piece) in of_polygons.list {
        pieces.add((), piece, Piece::join);
    }
    pieces.list.into_iter().map(|(_, piece)| piece).collect()
}

impl Piece {
    /// The wishes of another line that runs here too (for slopes outside, for others) and its inside, as seen from this one.
    fn seen(&self, other: &Self) -> (Option<[bool; 2]>, [bool; 2], [bool; 2]) {
        let same = self.ends == other.ends;
        let turned = |sides: [bool; 2]| if same { sides } else { [sides[1], sides[0]] };
        (other.outside.map(turned), turned(other.others), turned(other.interior))
    }

    /// Takes over another ring of the same polygon that runs here too, as where a hole reaches the edge of its polygon: the inside of
    /// the polygon has no width here, and no slopes inside.
    fn join_ring(&mut self, other: &Self, side: Side) {
        let (outside, others, interior) = self.seen(other);
        for s in 0..2 {
            self.interior[s] &= interior[s];
            if let (Some(mine), Some(its)) = (&mut self.outside, outside) {
                mine[s] |= its[s];
            }
            self.others[s] = if side == Side::Inside { self.others[s] && others[s] } else { self.others[s] || others[s] };
        }
        self.settle();
    }

    /// Takes over the wishes of another line that runs here too, whichever comes first.
    fn join(&mut self, other: &Self) {
        let (outside, others, interior) = self.seen(other);
        self.outside = match (self.outside, outside) {
            (Some([a, b]), Some([c, d])) => Some([a && c, b && d]),
            (one, other) => one.or(other),
        };
        for s in 0..2 {
            self.interior[s] |= interior[s];
            self.others[s] |= others[s];
        }
        self.settle();
    }

    /// Where slopes are wanted after all.
    fn settle(&mut self) {
        for s in 0..2 {
            // A platform has no slopes on it: lines along its edge have theirs on the other side only.
            let platform = self.outside.is_some() && self.interior[s];
            self.wanted[s] = !platform && (self.others[s] || self.outside.is_some_and(|outside| outside[s]));
        }
    }
}

/// Twice the signed plan area of a ring, about its first vertex; positive counter-clockwise.
fn signed_area(ring: &[DVec3]) -> f64 {
    let origin = ring[0].truncate();
    ring.windows(2).map(|w| (w[0].truncate() - origin).perp_dot(w[1].truncate() - origin)).sum()
}

/// A maximal path of pieces that agree in chain and sides, without a branch.
struct Run {
    nodes: Vec<u32>,
    /// The given vertex at each node, as the beginning of what follows.
    given: Vec<Given>,
    /// The same as the end of what comes before: a ring's first vertex counts on past the last one there.
    arriving: Vec<Given>,
    /// Whether it runs against its chain.
    against: bool,
    wanted: [bool; 2],
    interior: [bool; 2],
}

/// Pieces by node.
struct Runs<'a> {
    pieces: &'a [Piece],
    at_node: Vec<Vec<u32>>,
}

impl<'a> Runs<'a> {
    fn new(nodes: usize, pieces: &'a [Piece]) -> Self {
        let mut at_node = vec![Vec::new(); nodes];
        for (p, piece) in pieces.iter().enumerate() {
            for end in piece.ends {
                at_node[end as usize].push(p as u32);
            }
        }
        Self { pieces, at_node }
    }

    /// A node that must stay: an end, a junction, or a place where the wish for sides or the chain changes.
    fn fixed(&self, node: u32) -> bool {
        let [p, q] = self.at_node[node as usize][..] else { return true };
        let (p, q) = (&self.pieces[p as usize], &self.pieces[q as usize]);
        let through = p.ends[1] == q.ends[0] || p.ends[0] == q.ends[1];
        !through || p.given[0].chain != q.given[0].chain || p.wanted != q.wanted || p.interior != q.interior
    }

    /// The ends of a run at which its first or last edge must stay: where a line with a slope on one side ends, or meets another, the
    /// slope may end in the ruling at right angles to that edge, and would turn with it.
    fn kept_ends(&self, run: &Run) -> [bool; 2] {
        let one_sided = run.wanted[0] != run.wanted[1];
        let ends = [run.nodes[0], run.nodes[run.nodes.len() - 1]];
        ends.map(|node| one_sided && self.fixed(node))
    }

    fn all(&self, points: &[DVec3]) -> Vec<Run> {
        let mut done = vec![false; self.pieces.len()];
        let mut runs = Vec::new();
        for p in 0..self.pieces.len() {
            let start = self.pieces[p].ends[0];
            if !done[p] && self.fixed(start) {
                runs.push(self.walk(p, &mut done));
            }
        }
        for p in 0..self.pieces.len() {
            if !done[p] {
                runs.extend(self.cut_ring(self.walk(p, &mut done), points));
            }
        }
        runs
    }

    /// Follows pieces forward from piece `p` up to a fixed node or back to the start.
    fn walk(&self, p: usize, done: &mut [bool]) -> Run {
        let piece = &self.pieces[p];
        let mut run = Run {
            nodes: vec![piece.ends[0], piece.ends[1]],
            given: piece.given.to_vec(),
            arriving: piece.given.to_vec(),
            against: piece.against,
            wanted: piece.wanted,
            interior: piece.interior,
        };
        done[p] = true;
        let mut at = piece.ends[1];
        while !self.fixed(at) {
            let Some(&next) =
                self.at_node[at as usize].iter().find(|&&q| !done[q as usize] && self.pieces[q as usize].ends[0] == at)
            else {
                break;
            };
            done[next as usize] = true;
            let piece = &self.pieces[next as usize];
            at = piece.ends[1];
            run.nodes.push(at);
            // What goes on from a ring's first vertex begins there, and does not count on.
            run.given.pop();
            run.given.extend(piece.given);
            run.arriving.push(piece.given[1]);
        }
        run
    }

    /// Cuts a ring without a fixed node in two at places that depend on its shape alone: the node farthest from the mean of
    /// all, and the node farthest from that one.
    fn cut_ring(&self, run: Run, points: &[DVec3]) -> Vec<Run> {
        let ring = &run.nodes[..run.nodes.len() - 1];
        let at = |i: usize| points[ring[i] as usize].truncate();
        let mean = (0..ring.len()).map(at).sum::<DVec2>() / ring.len() as f64;
        let farthest = |from: DVec2| {
            (0..ring.len()).fold((0, -1.0), |best, i| {
                let d = at(i).distance_squared(from);
                if d > best.1 { (i, d) } else { best }
            })
        };
        let (first, _) = farthest(mean);
        let (second, _) = farthest(at(first));
        let part = |from: usize, to: usize| {
            let count = (to + ring.len() - from - 1) % ring.len() + 1;
            let at: Vec<usize> = (0..=count).map(|i| (from + i) % ring.len()).collect();
            let arriving = at.iter().take(count).map(|&i| run.arriving[i + 1]);
            Run {
                nodes: at.iter().map(|&i| ring[i]).collect(),
                given: at.iter().map(|&i| run.given[i]).collect(),
                arriving: std::iter::once(run.given[from]).chain(arriving).collect(),
                against: run.against,
                wanted: run.wanted,
                interior: run.interior,
            }
        };
        vec![part(first, second), part(second, first)]
    }
}
