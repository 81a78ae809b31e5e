//! The line as a plane graph: nodes, edges with two sides, and what meets at each node.

use super::simplify::{self, Chord};
use crate::kernel::frame::Frame;
use crate::model::{Design, Line, Role, Sheet, Side};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// Vertices closer than this (length units, 3D) are one vertex.
pub const WELD_DISTANCE: f64 = 1e-6;

/// Vertices along a chord keep at least this distance (length units).
const CHORD_SPACING: f64 = 1e-6;

/// A vertex displaced by less than this (length units) keeps its given coordinates: it counts as collinear, not as simplified.
pub const COLLINEAR: f64 = 1e-9;

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
    /// Given vertices at its ends. An edge runs along its chain; the end of a ring's last segment counts on past the last
    /// vertex. Where several chains share an edge, the first.
    pub given: [Given; 2],
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
    interior: [bool; 2],
    /// The segment of the line it is.
    given: Given,
}

impl Network {
    /// Builds the graph of `line` and simplifies it within `bound` (height error in the metric `|Δz| + k·|Δplan|`).
    ///
    /// Expects a validated line, every segment flatter than the slope.
    pub fn new(line: &Line, design: &Design, bound: f64) -> Self {
        let (min, max) = plan_box(line);
        let frame = Frame::around(min, max);
        let sign = if design.sheet == Sheet::Rising { -1.0 } else { 1.0 };
        let (points, of_vertex) = weld(line, &frame, sign);
        let pieces = pieces(line, design, &of_vertex);
        Self { frame, sign, nodes: points, edges: Vec::new(), simplified: 0, collinear: 0, simplified_max: 0.0 }.with_edges(
            &pieces,
            design.slope.ratio(),
            bound,
        )
    }

    /// Height in the world of a height of the falling sheet.
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

    /// Half-edges leaving each node, as ranges of one list: `list[start[n]..start[n + 1]]`.
    pub fn outgoing(&self) -> (Vec<u32>, Vec<HalfEdge>) {
        let mut start = vec![0_u32; self.nodes.len() + 1];
        for edge in &self.edges {
            start[edge.a as usize + 1] += 1;
            start[edge.b as usize + 1] += 1;
        }
        for n in 0..self.nodes.len() {
            start[n + 1] += start[n];
        }
        let mut next = start.clone();
        let mut list = vec![0; 2 * self.edges.len()];
        for (e, edge) in self.edges.iter().enumerate() {
            for (node, h) in [(edge.a, 2 * e), (edge.b, 2 * e + 1)] {
                list[next[node as usize] as usize] = h as u32;
                next[node as usize] += 1;
            }
        }
        (start, list)
    }

    /// Cuts the pieces into runs between fixed nodes, simplifies each and drops the nodes no edge uses.
    fn with_edges(mut self, pieces: &[Piece], slope: f64, bound: f64) -> Self {
        let runs = Runs::new(self.nodes.len(), pieces);
        let mut used = FxHashMap::default();
        for run in runs.all(&self.nodes) {
            let points: Vec<DVec3> = run.nodes.iter().map(|&n| self.nodes[n as usize]).collect();
            let steepest = points
                .windows(2)
                .map(|w| (w[1].z - w[0].z).abs() / w[0].truncate().distance(w[1].truncate()))
                .fold(slope * STEEPEST_CHORD, f64::max);
            for chord in simplify::simplify(&points, slope, bound, steepest, CHORD_SPACING) {
                self.add_chord(&run, &points, &chord, &mut used);
            }
        }
        self.compact();
        self
    }

    fn add_chord(&mut self, run: &Run, points: &[DVec3], chord: &Chord, used: &mut FxHashMap<[u32; 2], ()>) {
        let (a, b) = (run.nodes[chord.from], run.nodes[chord.to]);
        let pair = [a.min(b), a.max(b)];
        if chord.to - chord.from > 1 && used.contains_key(&pair) {
            // Two runs between the same nodes, closer together than the bound: keep them apart by a vertex of this one.
            let middle = usize::midpoint(chord.from, chord.to);
            for (from, to) in [(chord.from, middle), (middle, chord.to)] {
                let part = simplify::foot_points(points, from, to);
                self.add_chord(run, points, &Chord { from, to, dropped: part }, used);
            }
            return;
        }
        used.insert(pair, ());
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
        let given = [run.given[chord.from], run.given[chord.to]];
        self.edges.push(Edge { a, b, given, wanted: run.wanted, interior: run.interior, inner });
    }

    /// Renumbers nodes so that only those with an edge remain, in their old order.
    fn compact(&mut self) {
        let mut new_id = vec![u32::MAX; self.nodes.len()];
        for edge in &self.edges {
            new_id[edge.a as usize] = 0;
            new_id[edge.b as usize] = 0;
        }
        let mut kept = 0;
        for id in new_id.iter_mut().filter(|id| **id == 0) {
            *id = kept;
            kept += 1;
        }
        let keep = |i: usize| new_id[i] != u32::MAX;
        self.nodes = self.nodes.iter().enumerate().filter(|&(i, _)| keep(i)).map(|(_, &p)| p).collect();
        for edge in &mut self.edges {
            edge.a = new_id[edge.a as usize];
            edge.b = new_id[edge.b as usize];
        }
    }
}

/// Plan box of all vertices, world coordinates.
fn plan_box(line: &Line) -> (DVec2, DVec2) {
    line.chains
        .iter()
        .flat_map(|c| &c.vertices)
        .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(lo, hi), v| (lo.min(v.truncate()), hi.max(v.truncate())))
}

/// Brings all vertices into the local frame of the falling sheet and makes one node of those that coincide.
///
/// Returns the nodes and the node of every vertex by chain.
fn weld(line: &Line, frame: &Frame, sign: f64) -> (Vec<DVec3>, Vec<Vec<u32>>) {
    let mut points: Vec<DVec3> = Vec::with_capacity(line.vertex_count());
    let mut of_vertex = Vec::with_capacity(line.chains.len());
    let mut cells: FxHashMap<[i64; 3], Vec<u32>> = FxHashMap::default();
    // A simple ring cannot meet itself, so a single one needs no search.
    let search = line.chains.len() > 1 || !line.chains[0].closed();
    for chain in &line.chains {
        let mut nodes = Vec::with_capacity(chain.vertices.len());
        for &vertex in &chain.vertices {
            let local = frame.to_local(vertex);
            let p = DVec3::new(local.x, local.y, sign * local.z);
            let found = if search { find_near(&cells, &points, p) } else { None };
            let node = found.unwrap_or_else(|| {
                points.push(p);
                let id = points.len() as u32 - 1;
                if search {
                    cells.entry(cell(p)).or_default().push(id);
                }
                id
            });
            nodes.push(node);
        }
        of_vertex.push(nodes);
    }
    (points, of_vertex)
}

/// Side of the cells of the weld grid: wide against the weld distance, so that a point seldom needs a neighbour.
const WELD_CELL: f64 = 64.0 * WELD_DISTANCE;

fn cell(p: DVec3) -> [i64; 3] {
    [p.x, p.y, p.z].map(|v| (v / WELD_CELL).floor() as i64)
}

fn find_near(cells: &FxHashMap<[i64; 3], Vec<u32>>, points: &[DVec3], p: DVec3) -> Option<u32> {
    let (lo, hi) = (cell(p - WELD_DISTANCE), cell(p + WELD_DISTANCE));
    for x in lo[0]..=hi[0] {
        for y in lo[1]..=hi[1] {
            for z in lo[2]..=hi[2] {
                if let Some(ids) = cells.get(&[x, y, z])
                    && let Some(&id) = ids.iter().find(|&&id| points[id as usize].distance(p) <= WELD_DISTANCE)
                {
                    return Some(id);
                }
            }
        }
    }
    None
}

/// The given segments between nodes, each once, with the sides on which a slope is wanted.
fn pieces(line: &Line, design: &Design, of_vertex: &[Vec<u32>]) -> Vec<Piece> {
    let mut pieces: Vec<Piece> = Vec::new();
    let mut known: FxHashMap<[u32; 2], usize> = FxHashMap::default();
    for (c, chain) in line.chains.iter().enumerate() {
        let (side, interior_left) = match chain.role {
            Role::Open => (design.side_of_lines, false),
            Role::Outer { .. } => (design.side_of_rings, signed_area(&chain.vertices) > 0.0),
            Role::Hole { .. } => (design.side_of_rings, signed_area(&chain.vertices) < 0.0),
        };
        let wanted = match side {
            Side::Left => [true, false],
            Side::Right => [false, true],
            Side::Both => [true, true],
            Side::Inside => [interior_left, !interior_left],
            Side::Outside => [!interior_left, interior_left],
        };
        let interior = [chain.closed() && interior_left, chain.closed() && !interior_left];
        for i in 0..chain.segment_count() {
            let a = of_vertex[c][i];
            let b = of_vertex[c][(i + 1) % of_vertex[c].len()];
            if a == b {
                continue;
            }
            let pair = [a.min(b), a.max(b)];
            if let Some(&p) = known.get(&pair) {
                let same = pieces[p].ends == [a, b];
                let turned = |sides: [bool; 2]| if same { sides } else { [sides[1], sides[0]] };
                let (here, inside) = (turned(wanted), turned(interior));
                for s in 0..2 {
                    pieces[p].interior[s] |= inside[s];
                    // Outside of two polygons is outside of both; any other wish holds where one line has it.
                    let there = pieces[p].wanted[s];
                    pieces[p].wanted[s] = if side == Side::Outside { there && here[s] } else { there || here[s] };
                }
            } else {
                known.insert(pair, pieces.len());
                pieces.push(Piece { ends: [a, b], wanted, interior, given: Given { chain: c as u32, vertex: i as u32 } });
            }
        }
    }
    pieces
}

/// Twice the signed plan area of a ring, about its first vertex; positive counter-clockwise.
fn signed_area(ring: &[DVec3]) -> f64 {
    let origin = ring[0].truncate();
    ring.windows(2).map(|w| (w[0].truncate() - origin).perp_dot(w[1].truncate() - origin)).sum()
}

/// A maximal path of pieces that agree in chain and sides, without a branch.
struct Run {
    nodes: Vec<u32>,
    /// The given vertex at each node.
    given: Vec<Given>,
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
        !through || p.given.chain != q.given.chain || p.wanted != q.wanted || p.interior != q.interior
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
        let after = |g: Given| Given { vertex: g.vertex + 1, ..g };
        let mut run = Run {
            nodes: vec![piece.ends[0], piece.ends[1]],
            given: vec![piece.given, after(piece.given)],
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
            at = self.pieces[next as usize].ends[1];
            run.nodes.push(at);
            run.given.push(after(self.pieces[next as usize].given));
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
            // The last vertex is the one after the one before it: on a ring it may be the first again.
            let last = Given { vertex: run.given[at[count - 1]].vertex + 1, ..run.given[0] };
            Run {
                nodes: at.iter().map(|&i| ring[i]).collect(),
                given: at[..count].iter().map(|&i| run.given[i]).chain([last]).collect(),
                wanted: run.wanted,
                interior: run.interior,
            }
        };
        vec![part(first, second), part(second, first)]
    }
}
