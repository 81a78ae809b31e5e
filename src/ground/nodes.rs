//! Numbers and places of everything that can become a vertex: of the design, of the ground, and where the two meet.

use super::cell::Label;
use super::patch::{NONE, Patch};
use super::shape::Shape;
use super::works::{Works, remember};
use crate::kernel::segment_tree::SegmentTree;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Vertices closer than this in plan (length units) where design and ground meet become one.
pub(super) const WELD: f64 = 2e-8;

/// Vertex numbers: first those of the design, then those of the patch of ground, then the new ones.
pub(crate) struct Nodes {
    /// Places in the local frame, rounded to what a file can hold in world coordinates.
    pub(crate) places: Vec<DVec3>,
    /// What each number stands for in the end: itself, or the vertex it was joined with.
    alias: Vec<u32>,
    /// Numbers of the points where design and ground meet.
    of: FxHashMap<Label, u32>,
    /// Vertices on pieces of the boundary of the works that run past them, by the ends of the piece, lower number first.
    splits: FxHashMap<[u32; 2], Vec<u32>>,
    ground: u32,
}

/// Design and ground, and where they meet: all that the one is cut with at the other.
#[derive(Clone, Copy)]
pub(crate) struct Meeting<'a> {
    pub(crate) shape: &'a Shape,
    pub(crate) patch: &'a Patch,
    pub(crate) works: &'a Works,
    pub(crate) nodes: &'a Nodes,
}

impl Nodes {
    /// Numbers the points of the works.
    pub(crate) fn new(shape: &Shape, patch: &Patch, works: &Works) -> Self {
        let places: Vec<DVec3> = shape.vertices.iter().chain(&patch.vertices).copied().collect();
        let ground = shape.vertices.len() as u32;
        let alias = (0..places.len() as u32).collect();
        let mut nodes = Self { places, alias, of: FxHashMap::default(), splits: FxHashMap::default(), ground };
        for &[design, of_ground] in &works.twins {
            nodes.alias[design as usize] = ground + of_ground;
        }
        // Ground first, then design, then the rest: what comes first stays where it is.
        let mut labels: Vec<(Label, DVec3)> = works.points.iter().map(|(&label, &p)| (label, p)).collect();
        labels.sort_unstable_by_key(|(label, _)| *label);
        let mut near = Near::default();
        for (label, p) in labels {
            let p = shape.frame.to_local(shape.frame.to_world(p));
            let own = match label {
                Label::Ground(v) => Some(ground + v),
                Label::Design(v) => Some(nodes.alias[v as usize]),
                _ => nodes.end(label, p),
            };
            let at_vertex = nodes.vertex_of_ground(patch, p);
            let own = match (own, at_vertex) {
                (Some(v), Some(at)) if v < ground => {
                    nodes.alias[v as usize] = at;
                    Some(at)
                }
                (own, at) => own.or(at),
            };
            let id = match (near.find(&nodes.places, p), own) {
                (Some(id), Some(own)) if own < ground => {
                    nodes.alias[own as usize] = id;
                    id
                }
                // Two vertices of the ground stay two.
                (_, Some(own)) => own,
                (Some(id), None) => id,
                (None, None) => {
                    nodes.places.push(p);
                    nodes.alias.push(nodes.alias.len() as u32);
                    nodes.places.len() as u32 - 1
                }
            };
            near.add(id, p);
            nodes.of.insert(label, id);
        }
        nodes.add_rim(shape, works);
        nodes
    }

    /// Puts points where design and ground meet onto all edges that run past them closer than [`WELD`].
    ///
    /// Where design and ground all but touch, rounding can carry a vertex across an edge nearby, and outlines would cross.
    /// With the vertex on the edge they touch instead.
    pub(crate) fn snap(&mut self, shape: &Shape, patch: &Patch, works: &mut Works) {
        self.open_slivers(shape, patch, works);
        let mut points: Vec<(Label, u32)> =
            works.points.keys().filter_map(|&label| Some((label, *self.of.get(&label)?))).collect();
        points.sort_unstable();
        let plan = |places: &[DVec3], v: u32| places[v as usize].truncate();
        let borders: Vec<[u32; 2]> = works
            .daylight
            .iter()
            .chain(&works.borders)
            .chain(&works.rims)
            .filter_map(|border| Some([*self.of.get(&border.from)?, *self.of.get(&border.to)?]))
            .filter(|e| e[0] != e[1])
            .map(|[a, b]| [a.min(b), a.max(b)])
            .collect();
        let mut edges: Vec<[u32; 2]> = Vec::new();
        for a in (0..shape.triangles.len() as u32).filter(|&a| works.seen[a as usize]) {
            edges.extend((0..3).map(|i| shape.edge(a, i)));
        }
        edges.sort_unstable();
        edges.dedup();
        let ends =
            |list: &[[u32; 2]]| list.iter().map(|e| (plan(&self.places, e[0]), plan(&self.places, e[1]))).collect::<Vec<_>>();
        let (near_border, near_edge) = (SegmentTree::new(&ends(&borders)), SegmentTree::new(&ends(&edges)));
        for (label, id) in points {
            let p = plan(&self.places, id);
            let past = |e: [u32; 2]| {
                let (a, b) = (plan(&self.places, e[0]), plan(&self.places, e[1]));
                let t = (p - a).dot(b - a) / (b - a).length_squared();
                !e.contains(&id) && t > 0.0 && t < 1.0 && a.lerp(b, t).distance(p) <= WELD
            };
            near_border.near(p, WELD, |i| {
                if past(borders[i]) {
                    let list = self.splits.entry(borders[i]).or_default();
                    if !list.contains(&id) {
                        list.push(id);
                    }
                }
            });
            near_edge.near(p, WELD, |i| {
                if past(edges[i].map(|v| self.alias[v as usize])) {
                    remember(&mut works.on_design, edges[i], label);
                }
            });
            patch.near(p, p, |t| {
                for edge in (0..3).map(|j| patch.edge(t, j)).filter(|e| past(e.map(|v| self.ground + v))) {
                    remember(&mut works.on_ground, edge, label);
                }
            });
        }
    }

    /// Puts the corner of a triangle that lies on its opposite side, but for rounding, onto that side: nothing is left of the
    /// triangle then, and its neighbour gets the corner.
    fn open_slivers(&mut self, shape: &Shape, patch: &Patch, works: &mut Works) {
        let flat = |[a, b, p]: [DVec3; 3]| {
            let (d, w) = ((b - a).truncate(), (p - a).truncate());
            let t = w.dot(d) / d.length_squared();
            t > 0.0 && t < 1.0 && d.perp_dot(w).abs() <= WELD * d.length()
        };
        for &(a, b) in &works.cells {
            let (on_design, on_ground) = (shape.triangles[a as usize], patch.triangles[b as usize]);
            for i in 0..3_u8 {
                let turned = |t: [u32; 3]| [0, 1, 2].map(|n| t[(n + i as usize) % 3]);
                let [_, _, apex] = turned(on_ground);
                if flat(turned(on_ground).map(|v| patch.vertices[v as usize])) {
                    self.of.insert(Label::Ground(apex), self.ground + apex);
                    remember(&mut works.on_ground, patch.edge(b, i), Label::Ground(apex));
                }
                let [_, _, apex] = turned(on_design);
                if flat(turned(on_design).map(|v| shape.vertices[v as usize])) {
                    self.of.entry(Label::Design(apex)).or_insert(self.alias[apex as usize]);
                    remember(&mut works.on_design, shape.edge(a, i), Label::Design(apex));
                }
            }
        }
    }

    /// The pieces of an edge of the boundary of the works, from vertex to vertex.
    pub(crate) fn pieces(&self, [from, to]: [u32; 2]) -> Vec<[u32; 2]> {
        match self.splits.get(&[from.min(to), from.max(to)]) {
            None => vec![[from, to]],
            Some(list) => self.along([from, to], list.iter().copied()).windows(2).map(|w| [w[0], w[1]]).collect(),
        }
    }

    /// The vertices from one end of a straight edge to the other with those of `between`, in order.
    pub(crate) fn along(&self, [from, to]: [u32; 2], between: impl Iterator<Item = u32>) -> Vec<u32> {
        let plan = |v: u32| self.places[v as usize].truncate();
        let (a, d) = (plan(from), plan(to) - plan(from));
        let place = |v: u32| (plan(v) - a).dot(d) / d.length_squared();
        let mut inner: Vec<(f64, u32)> = between.filter(|&v| v != from && v != to).map(|v| (place(v), v)).collect();
        inner.sort_by(|p, q| p.0.total_cmp(&q.0).then(p.1.cmp(&q.1)));
        inner.dedup_by_key(|p| p.1);
        std::iter::once(from).chain(inner.into_iter().map(|p| p.1)).chain([to]).collect()
    }

    /// Numbers what stands above the edge of the ground: never a vertex of the ground itself.
    fn add_rim(&mut self, shape: &Shape, works: &Works) {
        let mut labels: Vec<(Label, (DVec3, u32))> = works.above_rim.iter().map(|(&label, &at)| (label, at)).collect();
        labels.sort_unstable_by_key(|(label, _)| *label);
        for (label, (p, vertex)) in labels {
            let id = if vertex == NONE {
                self.places.push(shape.frame.to_local(shape.frame.to_world(p)));
                self.alias.push(self.alias.len() as u32);
                self.places.len() as u32 - 1
            } else {
                self.alias[vertex as usize]
            };
            self.of.entry(label).or_insert(id);
        }
    }

    /// The end of the edge that `label` lies on, if it is that close.
    fn end(&self, label: Label, p: DVec3) -> Option<u32> {
        let design = |edge: [u32; 2]| edge;
        let ground = |edge: [u32; 2]| edge.map(|v| self.ground + v);
        let ends = match label {
            Label::DesignMeets(edge, _) => [design(edge), design(edge)],
            Label::GroundMeets(edge, _) => [ground(edge), ground(edge)],
            Label::EdgesMeet(d, g) | Label::Cross(d, g) => [ground(g), design(d)],
            Label::Ground(_) | Label::Design(_) => return None,
        };
        let close = |v: &&u32| self.places[**v as usize].truncate().distance(p.truncate()) <= WELD;
        ends.as_flattened().iter().find(close).map(|&v| self.alias[v as usize])
    }

    /// The vertex of the ground at a place, if there is one that close.
    fn vertex_of_ground(&self, patch: &Patch, p: DVec3) -> Option<u32> {
        let mut found = None;
        patch.near(p.truncate(), p.truncate(), |t| {
            let close = |v: &u32| patch.vertices[*v as usize].truncate().distance(p.truncate()) <= WELD;
            if found.is_none() {
                found = patch.triangles[t as usize].iter().copied().find(close);
            }
        });
        found.map(|v| self.ground + v)
    }

    /// Number of a vertex of the design.
    pub(crate) fn design(&self, v: u32) -> u32 {
        self.alias[v as usize]
    }

    /// Number of a vertex of the ground.
    pub(crate) fn ground(&self, v: u32) -> u32 {
        self.ground + v
    }

    /// The vertex of the ground with this number.
    pub(crate) fn as_ground(&self, id: u32, patch: &Patch) -> Option<u32> {
        let v = id.checked_sub(self.ground)?;
        patch.vertex_of.get(v as usize).copied()
    }

    /// Number of a point where design and ground meet.
    pub(crate) fn meeting(&self, label: Label) -> Option<u32> {
        self.of.get(&label).copied()
    }
}

/// Vertices by squares of the size of [`WELD`].
#[derive(Default)]
struct Near {
    squares: FxHashMap<[i64; 2], Vec<u32>>,
}

impl Near {
    fn square(p: DVec3) -> [i64; 2] {
        [(p.x / WELD).floor() as i64, (p.y / WELD).floor() as i64]
    }

    fn find(&self, places: &[DVec3], p: DVec3) -> Option<u32> {
        let [x, y] = Self::square(p);
        let mut best: Option<(f64, u32)> = None;
        for i in x - 1..=x + 1 {
            for j in y - 1..=y + 1 {
                for &id in self.squares.get(&[i, j]).into_iter().flatten() {
                    let d = places[id as usize].truncate().distance(p.truncate());
                    if d <= WELD && best.is_none_or(|(least, _)| d < least) {
                        best = Some((d, id));
                    }
                }
            }
        }
        best.map(|(_, id)| id)
    }

    fn add(&mut self, id: u32, p: DVec3) {
        let list = self.squares.entry(Self::square(p)).or_default();
        if !list.contains(&id) {
            list.push(id);
        }
    }
}
