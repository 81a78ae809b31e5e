//! Breaklines in their place: which ring they lie in, and common vertices wherever they meet rings and each other.

use super::FormationError;
use super::nodes::Nodes;
use crate::kernel::ring_index::{RingIndex, doubled_area};
use crate::kernel::segment::{self, meeting};
use crate::kernel::segment_tree::SegmentTree;
use crate::model::{Breakline, Chain, Defect, Defects, Line, Role};
use crate::validate::Locator;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashSet;

/// A ring or a breakline, vertex by vertex.
struct Strand<'a> {
    closed: bool,
    /// Number among the chains or the breaklines.
    index: usize,
    vertices: &'a [DVec3],
    nodes: Vec<u32>,
    /// Nodes found between the ends of each segment: part of the way, node.
    between: Vec<Vec<(f64, u32)>>,
}

/// A strand as it will be: node, the vertex at or before it, part of the way to the next.
type Stop = (u32, usize, f64);

/// Gives every breakline its ring and common vertices with what it meets: rings gain vertices where breaklines end on them or
/// cross them, breaklines where they cross each other. Vertices of breaklines within `tolerance` of a ring are moved onto it, to
/// its height; pieces that run along a ring are dropped.
///
/// Expects a validated line, roads already widened; `label` names the input.
///
/// # Errors
/// [`FormationError::Invalid`]: breaklines outside of all rings; lines that meet in plan at heights that differ by more than
/// `tolerance`.
pub fn place(line: Line, label: &str, tolerance: f64) -> Result<Line, FormationError> {
    if line.breaklines.iter().all(|b| b.of.is_some()) {
        return Ok(line);
    }
    let mut work =
        Work { label, line: &line, tolerance, nodes: Nodes::default(), strands: Vec::new(), defects: Defects::default() };
    work.gather();
    work.cross();
    work.placed()
}

struct Work<'a> {
    label: &'a str,
    line: &'a Line,
    tolerance: f64,
    nodes: Nodes,
    /// Rings first, then breaklines.
    strands: Vec<Strand<'a>>,
    defects: Defects,
}

impl<'a> Work<'a> {
    /// Numbers all vertices; those of breaklines near a ring go onto it.
    fn gather(&mut self) {
        for (index, chain) in self.line.chains.iter().enumerate().filter(|(_, chain)| chain.closed()) {
            let nodes = chain.vertices.iter().map(|&v| self.nodes.at(v)).collect();
            let between = vec![Vec::new(); chain.vertices.len()];
            self.strands.push(Strand { closed: true, index, vertices: &chain.vertices, nodes, between });
        }
        let rings = self.segments();
        let squares = self.line.breaklines.iter().flat_map(|b| &b.vertices).flat_map(|v| {
            let (p, d) = (v.truncate(), self.tolerance);
            [(p - d, p + d), (p + DVec2::new(-d, d), p + DVec2::new(d, -d))]
        });
        let mut ends: Vec<(DVec2, DVec2)> = squares.collect();
        let first = ends.len();
        ends.extend(rings.iter().map(|&(s, i)| self.ends(s, i)));
        // The nearest ring segment of each vertex, by distance.
        let mut nearest = vec![(f64::INFINITY, (0, 0)); first / 2];
        let vertices: Vec<DVec3> = self.line.breaklines.iter().flat_map(|b| b.vertices.iter().copied()).collect();
        SegmentTree::new(&ends).pairs(|i, j| {
            let (square, segment) = (i.min(j), i.max(j));
            if square < first && segment >= first {
                let v = square / 2;
                let (a, b) = ends[segment];
                let distance = segment::distance(vertices[v].truncate(), [a, b]);
                if distance <= self.tolerance && distance < nearest[v].0 {
                    nearest[v] = (distance, rings[segment - first]);
                }
            }
            true
        });
        let mut number = 0;
        for (index, breakline) in self.line.breaklines.iter().enumerate() {
            let mut nodes = Vec::new();
            for (i, &v) in breakline.vertices.iter().enumerate() {
                let (distance, (strand, segment)) = nearest[number];
                number += 1;
                nodes.push(if distance.is_finite() { self.onto(strand, segment, v, [index, i]) } else { self.nodes.at(v) });
            }
            let between = vec![Vec::new(); nodes.len().saturating_sub(1)];
            self.strands.push(Strand { closed: false, index, vertices: &breakline.vertices, nodes, between });
        }
    }

    /// The node of vertex `v` of a breakline on a segment of a ring.
    fn onto(&mut self, strand: usize, segment: usize, v: DVec3, [breakline, vertex]: [usize; 2]) -> u32 {
        let s = &self.strands[strand];
        let (a, b) = (s.vertices[segment], s.vertices[(segment + 1) % s.vertices.len()]);
        let (from, to) = (s.nodes[segment], s.nodes[(segment + 1) % s.nodes.len()]);
        let p = v.truncate();
        let near = |q: DVec3| p.distance(q.truncate());
        let (node, z) = if near(a).min(near(b)) <= self.tolerance {
            if near(a) <= near(b) { (from, a.z) } else { (to, b.z) }
        } else {
            let part = segment::foot(p, [a.truncate(), b.truncate()]);
            let on = a.lerp(b, part);
            let node = self.nodes.at(on);
            if node != from && node != to {
                self.strands[strand].between[segment].push((part, node));
            }
            (node, on.z)
        };
        self.compare(v.z, z, breakline, vertex, p);
        node
    }

    /// Lines that meet in plan must meet in height.
    fn compare(&mut self, z: f64, other: f64, breakline: usize, vertex: usize, at: DVec2) {
        if (z - other).abs() <= self.tolerance {
            return;
        }
        let b = &self.line.breaklines[breakline];
        let (label, tolerance) = (self.label, self.tolerance);
        self.defects.push("breakline-height", || Defect {
            code: "breakline-height",
            what: format!("breakline `{}` meets another line at a different height", b.name),
            at: locator(label, &b.places[0]).vertex(b.places[vertex]),
            figures: Some(format!("at x {:.3}, y {:.3}: {z:.3} against {other:.3}; tolerance {tolerance}", at.x, at.y)),
            help: "lines that cross in plan must have one height there: correct the heights, or end the breakline before".into(),
        });
    }

    /// All segments: strand, number.
    fn segments(&self) -> Vec<(usize, usize)> {
        self.strands.iter().enumerate().flat_map(|(s, strand)| (0..strand.between.len()).map(move |i| (s, i))).collect()
    }

    /// Node numbers of the ends of a segment.
    fn pair(&self, strand: usize, i: usize) -> [u32; 2] {
        let nodes = &self.strands[strand].nodes;
        [nodes[i], nodes[(i + 1) % nodes.len()]]
    }

    fn ends(&self, strand: usize, i: usize) -> (DVec2, DVec2) {
        let [a, b] = self.pair(strand, i);
        (self.nodes.plan(a), self.nodes.plan(b))
    }

    /// Nodes where breaklines cross rings and each other, and vertices of rings that breaklines pass.
    fn cross(&mut self) {
        let rings = self.strands.iter().filter(|s| s.closed).count();
        let segments = self.segments();
        let passed: Vec<u32> = self.strands[..rings].iter().flat_map(|s| s.nodes.iter().copied()).collect();
        let squares = passed.iter().flat_map(|&n| {
            let (p, d) = (self.nodes.plan(n), self.tolerance);
            [(p - d, p + d), (p + DVec2::new(-d, d), p + DVec2::new(d, -d))]
        });
        let mut ends: Vec<(DVec2, DVec2)> = squares.collect();
        let first = ends.len();
        ends.extend(segments.iter().map(|&(s, i)| self.ends(s, i)));
        let tree = SegmentTree::new(&ends);
        let mut found: Vec<(usize, usize)> = Vec::new();
        tree.pairs(|i, j| {
            let (i, j) = (i.min(j), i.max(j));
            if j >= first && segments[j - first].0 >= rings {
                found.push((i, j));
            }
            true
        });
        // Vertices first: a crossing next to one is that vertex.
        found.sort_unstable();
        for (i, j) in found {
            let (t, l) = segments[j - first];
            if i < first {
                if i % 2 == 0 {
                    self.pass(passed[i / 2], t, l);
                }
                continue;
            }
            let (s, k) = segments[i - first];
            for at in meeting(ends[i].into(), ends[j].into()).points() {
                self.join([(s, k), (t, l)], at);
            }
        }
    }

    /// Puts a vertex of a ring into a segment of a breakline that passes within the tolerance.
    fn pass(&mut self, node: u32, strand: usize, i: usize) {
        let (a, b) = self.ends(strand, i);
        let at = self.nodes.plan(node);
        let (distance, part) = (segment::distance(at, [a, b]), segment::foot(at, [a, b]));
        if distance <= self.tolerance && !self.pair(strand, i).contains(&node) && part > 0.0 && part < 1.0 {
            self.insert(strand, i, node);
        }
    }

    /// A common node of two segments, the second one of a breakline.
    fn join(&mut self, pair: [(usize, usize); 2], at: DVec2) {
        let [(s, k), (t, l)] = pair;
        let height = |work: &Self, strand: usize, i: usize| {
            let (a, b) = work.ends(strand, i);
            let [from, to] = work.pair(strand, i).map(|n| work.nodes.points[n as usize].z);
            from + (to - from) * segment::foot(at, [a, b])
        };
        let (z, other) = (height(self, s, k), height(self, t, l));
        let node = self.nodes.at(at.extend(z));
        self.compare(other, z, self.strands[t].index, l, at);
        for (strand, i) in pair {
            if !self.pair(strand, i).contains(&node) {
                self.insert(strand, i, node);
            }
        }
    }

    fn insert(&mut self, strand: usize, i: usize, node: u32) {
        let (a, b) = self.ends(strand, i);
        let part = segment::foot(self.nodes.plan(node), [a, b]);
        let between = &mut self.strands[strand].between[i];
        if between.iter().all(|(_, n)| *n != node) {
            between.push((part, node));
        }
    }

    /// The strand with all its nodes.
    fn stops(&self, strand: &Strand) -> Vec<Stop> {
        let mut stops = Vec::new();
        for (i, &node) in strand.nodes.iter().enumerate() {
            stops.push((node, i, 0.0));
            let mut between = strand.between.get(i).cloned().unwrap_or_default();
            between.sort_by(|a, b| a.0.total_cmp(&b.0));
            stops.extend(between.into_iter().map(|(part, node)| (node, i, part)));
        }
        stops.dedup_by_key(|stop| stop.0);
        stops
    }

    fn placed(mut self) -> Result<Line, FormationError> {
        let mut line = Line { chains: self.line.chains.clone(), breaklines: Vec::new() };
        let mut edges: FxHashSet<[u32; 2]> = FxHashSet::default();
        let mut on_ring: FxHashSet<u32> = FxHashSet::default();
        for strand in self.strands.iter().filter(|s| s.closed) {
            let stops = self.stops(strand);
            for (i, stop) in stops.iter().enumerate() {
                let next = stops[(i + 1) % stops.len()].0;
                edges.extend([[stop.0, next], [next, stop.0]]);
                on_ring.insert(stop.0);
            }
            self.rebuild(&mut line.chains[strand.index], &stops);
        }
        let inside = Inside::new(&line.chains);
        let mut outside = Vec::new();
        for strand in self.strands.iter().filter(|s| !s.closed) {
            let given = &self.line.breaklines[strand.index];
            let stops = self.stops(strand);
            if let [only] = stops[..] {
                if !on_ring.contains(&only.0) {
                    match inside.ring_at(self.nodes.plan(only.0)) {
                        Some(ring) => line.breaklines.push(self.piece(given, &stops, ring)),
                        None => outside.push((strand.index, 0, 0, self.nodes.plan(only.0))),
                    }
                }
                continue;
            }
            // Runs between nodes on rings: each lies inside one ring, or outside.
            let mut from = 0;
            for to in 1..stops.len() {
                if to + 1 < stops.len() && !on_ring.contains(&stops[to].0) {
                    continue;
                }
                let run = &stops[from..=to];
                from = to;
                if run.len() == 2 && edges.contains(&[run[0].0, run[1].0]) {
                    continue;
                }
                let middle = 0.5 * (self.nodes.plan(run[0].0) + self.nodes.plan(run[1].0));
                match given.of.or_else(|| inside.ring_at(middle)) {
                    Some(ring) => line.breaklines.push(self.piece(given, run, ring)),
                    None => outside.push((strand.index, run[0].1, run[run.len() - 1].1, middle)),
                }
            }
        }
        for (index, from, to, at) in outside {
            let b = &self.line.breaklines[index];
            let label = self.label;
            self.defects.push("breakline-outside", || {
                let locator = locator(label, &b.places[from]);
                let to = (to.max(from + 1)).min(b.places.len() - 1);
                let at_place =
                    if b.places.len() == 1 { locator.vertex(b.places[0]) } else { locator.pair(b.places[from], b.places[to]) };
                Defect {
                    code: "breakline-outside",
                    what: format!("breakline `{}` lies outside of every ring", b.name),
                    at: at_place,
                    figures: Some(format!("at x {:.3}, y {:.3}", at.x, at.y)),
                    help: "breaklines shape platforms: end them at the ring, take them out, or leave `role` out where the line \
                           carries slopes itself"
                        .into(),
                }
            });
        }
        self.defects.into_result()?;
        Ok(line)
    }

    fn rebuild(&self, chain: &mut Chain, stops: &[Stop]) {
        let places = stops.iter().map(|&(_, i, _)| chain.places[i]).collect();
        // Given vertices stay bit for bit.
        let vertex = |&(node, i, part): &Stop| if part == 0.0 { chain.vertices[i] } else { self.nodes.points[node as usize] };
        let vertices = stops.iter().map(vertex).collect();
        if let Some(axis) = &mut chain.axis {
            let at = |&(_, i, part): &Stop| axis.stations[i] + part * (axis.stations[i + 1] - axis.stations[i]);
            let mut stations: Vec<f64> = stops.iter().map(at).collect();
            stations.extend(axis.stations.last());
            axis.stations = stations;
        }
        chain.vertices = vertices;
        chain.places = places;
    }

    fn piece(&self, given: &Breakline, stops: &[Stop], ring: usize) -> Breakline {
        let station = |stations: &Vec<f64>| {
            let at = |&(_, i, part): &Stop| {
                let from = stations[i];
                from + part * (stations.get(i + 1).copied().unwrap_or(from) - from)
            };
            stops.iter().map(at).collect()
        };
        Breakline {
            name: given.name.clone(),
            vertices: stops.iter().map(|&(node, _, _)| self.nodes.points[node as usize]).collect(),
            places: stops.iter().map(|&(_, i, _)| given.places[i]).collect(),
            stations: given.stations.as_ref().map(station),
            of: Some(ring),
        }
    }
}

fn locator<'a>(label: &'a str, place: &crate::model::Place) -> Locator<'a> {
    // One line alone: parts of features are not told apart here.
    Locator::of_features(label, &[place.feature])[0]
}

/// Which ring's platform a place belongs to.
struct Inside<'a> {
    chains: &'a [Chain],
    index: RingIndex,
    /// Area of each ring, twice; nought of lines that are open.
    sizes: Vec<f64>,
}

impl<'a> Inside<'a> {
    fn new(chains: &'a [Chain]) -> Self {
        let rings = chains.iter().enumerate().filter(|(_, chain)| chain.closed());
        let sides = rings.flat_map(|(c, chain)| {
            (0..chain.segment_count()).map(move |i| {
                let (a, b) = chain.segment(i);
                (c, a.truncate(), b.truncate())
            })
        });
        let index = RingIndex::new(sides.collect());
        let size =
            |chain: &Chain| if chain.closed() { doubled_area(chain.vertices.iter().map(|v| v.truncate())).abs() } else { 0.0 };
        Self { chains, index, sizes: chains.iter().map(size).collect() }
    }

    /// The smallest polygon with `p` inside: its outer ring.
    fn ring_at(&self, p: DVec2) -> Option<usize> {
        let around = self.index.around(p);
        let in_hole = |of: u32| around.iter().any(|&c| self.chains[c].role == (Role::Hole { polygon: of }));
        let outer = |&c: &usize| matches!(self.chains[c].role, Role::Outer { polygon } if !in_hole(polygon));
        around.iter().copied().filter(outer).min_by(|&a, &b| self.sizes[a].total_cmp(&self.sizes[b]))
    }
}
