//! The works: what lies between the design and the ground and is connected to the line, found cell by cell from the line on.

use super::cell::{Corner, Label, Side, cell, class};
use super::clip::{clip, sense, split_sides};
use super::patch::{NONE, Patch};
use super::shape::Shape;
use crate::kernel::box_tree::BoxTree;
use crate::kernel::plan_box::PlanBox;
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// A directed piece of the boundary of the works, works on the left.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Border {
    pub(crate) from: Label,
    pub(crate) to: Label,
    /// Triangle of the design.
    pub(crate) a: u32,
    /// Triangle of the ground.
    pub(crate) b: u32,
    /// What it lies on.
    pub(crate) side: Side,
    /// Its ends, on the design, local frame.
    pub(crate) points: [DVec3; 2],
    /// Greatest height between design and ground on it.
    pub(crate) height: f64,
}

impl Border {
    fn new((a, b): (u32, u32), from: &Corner, to: &Corner) -> Self {
        let points = [from, to].map(|c| c.at.extend(c.z));
        let height = from.h.abs().max(to.h.abs());
        Self { from: from.label, to: to.label, a, b, side: from.side, points, height }
    }
}

/// Where the works stop although the design has not met the ground.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum End {
    /// At the edge of the ground.
    Ground,
    /// Where the slope was asked to end.
    Slope,
}

/// A piece of an open end.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Open {
    pub(crate) end: End,
    /// Its ends, on the design, local frame.
    pub(crate) points: [DVec3; 2],
    /// Greatest height between design and ground there.
    pub(crate) height: f64,
}

/// What a flood over the cells has found.
pub(crate) struct Works {
    /// Cells with a part in the works.
    pub(crate) cells: Vec<(u32, u32)>,
    /// Boundary through the inside of cells: design and ground meet.
    pub(crate) daylight: Vec<Border>,
    /// Boundary along edges of the design or of the ground. Where the design is not on the ground there, it stands in the air or
    /// below ground: a wall.
    pub(crate) borders: Vec<Border>,
    /// Sides of cells that may bound the works, until their counterpart is found.
    loose: FxHashMap<(Label, Label), Border>,
    /// Where a platform changes from cut to fill.
    pub(crate) zero: FxHashMap<(Label, Label), (u32, u32)>,
    /// Points at which design and ground meet.
    pub(crate) points: FxHashMap<Label, DVec3>,
    /// Vertices of the design that lie on a vertex of the ground.
    pub(crate) twins: Vec<[u32; 2]>,
    /// Such points on edges of the design and of the ground.
    pub(crate) on_design: FxHashMap<[u32; 2], Vec<Label>>,
    pub(crate) on_ground: FxHashMap<[u32; 2], Vec<Label>>,
    /// Triangles of the design that are in the works but not with all their area, or with points on their sides.
    pub(crate) mixed: Vec<bool>,
    /// Triangles of the design with a part in the works.
    pub(crate) seen: Vec<bool>,
    /// Ends that did not meet the ground.
    pub(crate) open: Vec<Open>,
    /// Works cut off at the edge of the ground: that edge, works on the left.
    pub(crate) rims: Vec<Border>,
    /// Points of the design on the edge of the ground that become vertices, although design and ground do not meet there.
    /// Each with the vertex of the design there, if there is one.
    pub(crate) above_rim: FxHashMap<Label, (DVec3, u32)>,
    /// Length of every edge of the line, and how much of it has ground below.
    pub(crate) over_ground: FxHashMap<[u32; 2], [f64; 2]>,
}

impl Works {
    /// Whether a triangle of the design that the ground does not cut off goes beyond its edge.
    pub(crate) fn hangs_over(&self, a: u32) -> bool {
        self.mixed[a as usize] || !self.seen[a as usize]
    }
}

/// What takes the pieces of the works, one by one: a cell's part in the works, counter-clockwise, with its triangle of the design.
pub(crate) trait Sink {
    fn take(&mut self, a: u32, corners: &[Corner]);
}

/// Floods the works of all parts from the line on.
pub(crate) struct Flood<'a, S> {
    shape: &'a Shape,
    patch: &'a Patch,
    /// Platform and slopes alike count with both signs and whatever their height.
    whole: bool,
    sink: &'a mut S,
    works: Works,
    /// Cells that are or were pending, both numbers in one: that is what the flood looks up most.
    visited: FxHashSet<u64>,
    pending: Vec<(u32, u32)>,
    corners: Vec<Corner>,
    kept: Vec<Corner>,
}

impl<'a, S: Sink> Flood<'a, S> {
    /// Finds the works. With `whole`, everything of the design counts, above the ground or below it.
    pub(crate) fn run(shape: &'a Shape, patch: &'a Patch, whole: bool, sink: &'a mut S) -> Works {
        let works = Works {
            cells: Vec::new(),
            daylight: Vec::new(),
            borders: Vec::new(),
            loose: FxHashMap::default(),
            zero: FxHashMap::default(),
            points: FxHashMap::default(),
            twins: Vec::new(),
            on_design: FxHashMap::default(),
            on_ground: FxHashMap::default(),
            mixed: vec![false; shape.triangles.len()],
            seen: vec![false; shape.triangles.len()],
            open: Vec::new(),
            rims: Vec::new(),
            above_rim: FxHashMap::default(),
            over_ground: FxHashMap::default(),
        };
        let mut flood = Self {
            shape,
            patch,
            whole,
            sink,
            works,
            visited: FxHashSet::default(),
            pending: Vec::new(),
            corners: Vec::new(),
            kept: Vec::new(),
        };
        flood.seed();
        flood.spread();
        flood.seed_at_rim();
        flood.spread();
        let mut works = flood.works;
        works.borders.extend(works.loose.values().copied());
        works.borders.sort_unstable_by_key(|border| (border.from, border.to));
        works.loose = FxHashMap::default();
        for labels in works.on_design.values_mut().chain(works.on_ground.values_mut()) {
            labels.sort_unstable();
            labels.dedup();
        }
        works
    }

    fn spread(&mut self) {
        while let Some((a, b)) = self.pending.pop() {
            self.visit(a, b);
        }
    }

    fn push(&mut self, a: u32, b: u32) {
        if self.visited.insert(u64::from(a) << 32 | u64::from(b)) {
            self.pending.push((a, b));
        }
    }

    /// Starts at all cells that have a corner on the line where the design is not on the wrong side of the ground.
    fn seed(&mut self) {
        let shape = self.shape;
        let mut on_line = vec![false; shape.vertices.len()];
        shape.hinge.iter().flatten().for_each(|&v| on_line[v as usize] = true);
        let mut near = Vec::new();
        for a in 0..shape.triangles.len() as u32 {
            let plan = shape.plan(a);
            let t = shape.triangles[a as usize];
            let sides = (0..3_u8).filter(|&i| shape.hinge.contains(&shape.edge(a, i))).map(|i| 1 << i).sum::<u8>();
            if sides == 0 && !t.iter().any(|&v| on_line[v as usize]) {
                continue;
            }
            near.clear();
            for i in 0..3 {
                let to = if sides & 1 << i != 0 { plan[(i + 1) % 3] } else { plan[i] };
                if sides & 1 << i != 0 || on_line[t[i] as usize] {
                    self.patch.near(plan[i], to, |b| {
                        if self.patch.meets_box(b, plan[i], to) {
                            near.push(b);
                        }
                    });
                }
            }
            near.sort_unstable();
            near.dedup();
            let sense = self.sense(a);
            let mut corners = std::mem::take(&mut self.corners);
            let mut lengths = [0.0; 3];
            for &b in &near {
                cell(shape, self.patch, a, b, &mut corners);
                for (n, corner) in corners.iter().enumerate() {
                    if let Some(i) = corner.side.design {
                        lengths[i as usize] += corner.at.distance(corners[(n + 1) % corners.len()].at);
                    }
                }
                let touches = |c: &Corner| c.on_design & sides != 0 || c.vertex != NONE && on_line[c.vertex as usize];
                if corners.iter().any(|c| touches(c) && sense.is_none_or(|sense| class(sense * c.h) >= 0)) {
                    self.push(a, b);
                }
            }
            self.corners = corners;
            for i in (0..3).filter(|i| sides & 1 << i != 0) {
                // Along the edge of the ground only one side of the line has any.
                let known = self.works.over_ground.entry(shape.edge(a, i as u8)).or_default();
                *known = [plan[i].distance(plan[(i + 1) % 3]), lengths[i].max(known[1])];
            }
        }
    }

    /// Starts where the edge of the ground runs under what counts whatever its height: ground may lie under a platform without coming
    /// to its edge.
    fn seed_at_rim(&mut self) {
        let (shape, patch) = (self.shape, self.patch);
        let flats = (0..shape.triangles.len() as u32).filter(|&a| self.sense(a).is_none());
        let boxes: Vec<(u32, PlanBox)> = flats.map(|a| (a, PlanBox::of(shape.plan(a)))).collect();
        let all = boxes.iter().fold(PlanBox::EMPTY, |all, (_, one)| all.join(*one));
        let plan = |b: u32| PlanBox::of(patch.triangles[b as usize].map(|v| patch.vertices[v as usize].truncate()));
        let at_rim = (0..patch.triangles.len() as u32).filter(|&b| patch.neighbours[b as usize].contains(&NONE));
        let near: Vec<(u32, PlanBox)> = at_rim.map(|b| (b, plan(b))).filter(|(_, one)| one.meets(&all)).collect();
        if near.is_empty() {
            return;
        }
        let tree = BoxTree::new(&boxes);
        for (b, one) in near {
            tree.meeting(&one, |a| self.push(a, b));
        }
    }

    /// See [`sense`].
    fn sense(&self, a: u32) -> Option<f64> {
        sense(self.shape.parts[a as usize], self.whole)
    }

    fn visit(&mut self, a: u32, b: u32) {
        let mut corners = std::mem::take(&mut self.corners);
        cell(self.shape, self.patch, a, b, &mut corners);
        if !corners.is_empty() {
            match self.sense(a) {
                Some(sense) => self.slope(a, b, &corners, sense),
                None => self.flat(a, b, &corners),
            }
        }
        self.corners = corners;
    }

    /// A cell of a slope: its part above the ground (`sense` 1) or below it (−1).
    fn slope(&mut self, a: u32, b: u32, corners: &[Corner], sense: f64) {
        let signs = |c: &Corner| class(sense * c.h);
        if corners.iter().any(|c| signs(c) <= 0) {
            self.works.mixed[a as usize] = true;
        }
        let mut kept = std::mem::take(&mut self.kept);
        clip(self.shape, self.patch, (a, b), corners, sense, &mut kept);
        if !kept.is_empty() {
            self.works.cells.push((a, b));
            self.works.seen[a as usize] = true;
            self.sink.take(a, &kept);
            self.go_on(a, b, &kept, sense);
        }
        self.kept = kept;
    }

    /// Takes down what bounds the piece `kept` of the cell, and goes on to the neighbours across its sides.
    fn go_on(&mut self, a: u32, b: u32, kept: &[Corner], sense: f64) {
        for (n, corner) in kept.iter().enumerate() {
            let next = &kept[(n + 1) % kept.len()];
            let flat = [corner, next].map(|c| class(sense * c.h) <= 0);
            if flat[0] {
                self.note(a, b, corner);
            }
            let border = Border::new((a, b), corner, next);
            if corner.side == Side::INSIDE {
                self.works.daylight.push(border);
            } else if flat == [true, true] {
                self.loose(border);
            } else {
                self.cross(&border, [corner, next]);
            }
        }
    }

    /// Goes on across a side of a cell that has works on it.
    fn cross(&mut self, border: &Border, ends: [&Corner; 2]) {
        let (a, b, side) = (border.a, border.b, border.side);
        let across = |neighbours: [u32; 3], side: Option<u8>, own: u32| side.map_or(own, |i| neighbours[i as usize]);
        let next_a = across(self.shape.neighbours[a as usize], side.design, a);
        let next_b = across(self.patch.neighbours[b as usize], side.ground, b);
        if next_b == NONE {
            self.works.mixed[a as usize] = true;
            self.rim(border, ends);
        } else if next_a == NONE {
            let edge = side.design.map(|i| self.shape.edge(a, i));
            if edge.is_some_and(|edge| self.shape.hinge.contains(&edge)) || self.whole {
                self.loose(*border);
            } else {
                self.open(End::Slope, ends);
            }
        } else {
            self.push(next_a, next_b);
        }
    }

    /// Cuts the design off at the edge of the ground.
    fn rim(&mut self, border: &Border, ends: [&Corner; 2]) {
        for corner in ends {
            if class(corner.h) == 0 {
                self.note(border.a, border.b, corner);
                continue;
            }
            self.works.above_rim.entry(corner.label).or_insert_with(|| (corner.at.extend(corner.z), corner.vertex));
            for i in (0..3).filter(|i| corner.on_design & 1 << i != 0) {
                remember(&mut self.works.on_design, self.shape.edge(border.a, i), corner.label);
            }
        }
        if class(border.height) != 0 {
            self.open(End::Ground, ends);
        }
        self.works.rims.push(*border);
    }

    fn open(&mut self, end: End, ends: [&Corner; 2]) {
        let points = ends.map(|c| c.at.extend(c.z));
        self.works.open.push(Open { end, points, height: ends[0].h.abs().max(ends[1].h.abs()) });
    }

    /// Two loose pieces that run against each other are inside the works.
    fn loose(&mut self, border: Border) {
        if self.works.loose.remove(&(border.to, border.from)).is_none() {
            self.works.loose.insert((border.from, border.to), border);
        }
    }

    /// Takes down the point of a corner where design and ground meet, and the edges it lies on.
    fn note(&mut self, a: u32, b: u32, corner: &Corner) {
        self.works.points.entry(corner.label).or_insert_with(|| corner.at.extend(corner.z));
        if let (Label::Ground(v), true) = (corner.label, corner.vertex != NONE) {
            self.works.twins.push([corner.vertex, v]);
        }
        for i in (0..3).filter(|i| corner.on_design & 1 << i != 0) {
            remember(&mut self.works.on_design, self.shape.edge(a, i), corner.label);
        }
        for j in (0..3).filter(|j| corner.on_ground & 1 << j != 0) {
            remember(&mut self.works.on_ground, self.patch.edge(b, j), corner.label);
        }
    }

    /// A cell that counts whatever its height: of the platform.
    fn flat(&mut self, a: u32, b: u32, corners: &[Corner]) {
        self.works.cells.push((a, b));
        self.works.seen[a as usize] = true;
        self.sink.take(a, corners);
        let mut split = std::mem::take(&mut self.kept);
        split_sides(self.shape, self.patch, (a, b), corners, &mut split);
        for (n, corner) in split.iter().enumerate() {
            let next = &split[(n + 1) % split.len()];
            let border = Border::new((a, b), corner, next);
            let outer = |i: usize| corner.on_design & 1 << i != 0 && self.shape.neighbours[a as usize][i] == NONE;
            if class(corner.h) == 0 && (0..3).any(outer) {
                self.note(a, b, corner);
            }
            self.cross(&border, [corner, next]);
        }
        self.zero_line(a, b, &split);
        self.kept = split;
    }

    /// Takes down where a cell of a platform changes from cut to fill: through its inside, or along a side (then told by the
    /// cell that is filled, unless its neighbour is as well).
    fn zero_line(&mut self, a: u32, b: u32, split: &[Corner]) {
        let count = split.len();
        let zero = |n: usize| class(split[n % count].h) == 0;
        let filled = |n: usize| class(split[n % count].h) > 0;
        for n in (0..count).filter(|&n| zero(n)) {
            // The next zero corner, with filled ones between.
            let Some(m) = (n + 1..n + count).find(|&m| !filled(m)) else { continue };
            if !zero(m) || m == n + 1 && !(0..count).any(filled) {
                continue;
            }
            let (p, q) = (&split[n], &split[m % count]);
            let (p, q) = if m == n + 1 { (p, q) } else { (q, p) };
            let along = m == n + 1 || (m + 1) % count == n;
            if along || (0..count).any(|i| class(split[i].h) < 0) {
                for c in [p, q] {
                    self.works.points.entry(c.label).or_insert_with(|| c.at.extend(c.z));
                }
                if self.works.zero.remove(&(q.label, p.label)).is_none() {
                    self.works.zero.insert((p.label, q.label), (a, b));
                }
            }
        }
    }
}

/// Takes down a point on an edge. The same point may be there several times, once for each cell around it.
pub(crate) fn remember(edges: &mut FxHashMap<[u32; 2], Vec<Label>>, edge: [u32; 2], label: Label) {
    edges.entry(edge).or_default().push(label);
}
