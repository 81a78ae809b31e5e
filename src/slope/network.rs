//! The line as a plane graph: nodes, edges with two sides, and what meets at each node.

use super::canonical;
use super::noding::{Segments, weld};
use super::pieces::{Piece, pieces};
use super::runs::{Run, Runs};
use super::simplify::{self, Chord};
use crate::kernel::buckets::Buckets;
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::model::{Design, Extent, Joggle, Line, Sheet};
use glam::DVec3;
use rustc_hash::FxHashSet;

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
        let pieces = pieces(&line, design, &segments, &order);
        let slopes = [design.slope, design.companion.unwrap_or(design.slope)].map(|slope| slope.ratio());
        let mut network =
            Self { frame, sign, nodes: points, edges: Vec::new(), simplified: 0, collinear: 0, simplified_max: 0.0 }
                .with_edges(&pieces, slopes, bound);
        if let Some(joggle) = design.joggle {
            // Two sheets through one line share its points. A sheet alone is to be the mirror image of that of the mirrored line.
            let up = if design.companion.is_some() { sign } else { 1.0 };
            network.joggle(joggle, up, slopes[0].min(slopes[1]), design.extent);
        }
        network
    }

    /// Length of an edge in plan.
    pub fn length(&self, edge: &Edge) -> f64 {
        self.nodes[edge.a as usize].truncate().distance(self.nodes[edge.b as usize].truncate())
    }

    /// Moves the nodes in height, so little that every edge stays flatter than `flattest`; `up`: the sign of a shift up. Nodes
    /// where the slope is to end stay.
    fn joggle(&mut self, joggle: Joggle, up: f64, flattest: f64, extent: Extent) {
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
            .map(|(p, most)| if fixed(p.z) { 0.0 } else { up * Joggle { most, ..joggle }.shift(p.x, p.y) })
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
