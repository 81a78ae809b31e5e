//! What lies on platforms, in mesh numbers: breaklines, and the roads between their edges.

use crate::kernel::plan_box::PlanBox;
use crate::kernel::segment;
use crate::mesh::strip::{self, Beside};
use crate::model::{Breakline, Chain, Line};
use crate::slope::emit::Slopes;
use crate::slope::network::{Given, Network};
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};

/// Breaklines as mesh vertices.
#[derive(Default)]
pub(super) struct Threads {
    /// Vertices and ring of each breakline.
    pub(super) lines: Vec<(Vec<u32>, Option<usize>)>,
    /// Vertices of breaklines that are none of a ring, with the ring: place on the breakline they were first met on.
    fresh: Vec<(u32, usize, usize)>,
    /// World position in plan of every fresh vertex.
    plan: Vec<DVec2>,
}

impl Threads {
    /// Numbers the vertices of all breaklines; those of rings have theirs already, the others are added to the points.
    pub(super) fn new(line: &Line, network: &Network, slopes: &mut Slopes) -> Self {
        let key = |v: DVec3| [v.x + 0.0, v.y + 0.0].map(f64::to_bits);
        let mut known: FxHashMap<[u64; 2], u32> = FxHashMap::default();
        let mut learn = |given: Given, id: u32| {
            let chain = &line.chains[given.chain as usize];
            if given.part == 0.0 {
                known.entry(key(chain.vertices[given.vertex as usize % chain.vertices.len()])).or_insert(id);
            }
        };
        for (edge, inner) in network.edges.iter().zip(&slopes.edge_points) {
            learn(edge.given[0], edge.a);
            learn(edge.given[1], edge.b);
            inner.iter().filter_map(|p| p.given.map(|given| (given, p.id))).for_each(|(given, id)| learn(given, id));
        }
        let mut threads = Self::default();
        for (index, breakline) in line.breaklines.iter().enumerate() {
            let mut ids = Vec::with_capacity(breakline.vertices.len());
            for (i, &v) in breakline.vertices.iter().enumerate() {
                let id = *known.entry(key(v)).or_insert_with(|| {
                    let p = network.frame.to_local(v);
                    slopes.points.push(DVec3::new(p.x, p.y, network.sign * p.z));
                    let id = (slopes.points.len() - 1) as u32;
                    threads.fresh.push((id, index, i));
                    threads.plan.push(v.truncate());
                    id
                });
                ids.push(id);
            }
            threads.lines.push((ids, breakline.of));
        }
        threads
    }
}

/// A point of the edge of a road: vertex, station.
type Along = Vec<Beside>;

/// An edge of the network along a road.
struct RoadEdge {
    /// Its number.
    edge: usize,
    /// Its points from start to end.
    along: Along,
    /// Whether each of them is a vertex of the road: others lie on levels.
    given: Vec<bool>,
}

/// The edges of all roads with their stations.
pub(super) struct Roads<'a> {
    line: &'a Line,
    /// By chain: edges in the order of the ring.
    edges: Vec<Vec<RoadEdge>>,
}

impl<'a> Roads<'a> {
    pub(super) fn new(line: &'a Line, network: &Network, slopes: &Slopes) -> Self {
        let mut edges: Vec<Vec<RoadEdge>> = line.chains.iter().map(|_| Vec::new()).collect();
        let mut order: Vec<usize> = (0..network.edges.len()).collect();
        let start = |e: usize| network.edges[e].given[0];
        order.sort_by(|&a, &b| {
            let (a, b) = (start(a), start(b));
            (a.chain, a.vertex).cmp(&(b.chain, b.vertex)).then(a.part.total_cmp(&b.part))
        });
        for e in order {
            let (edge, inner) = (&network.edges[e], &slopes.edge_points[e]);
            let chain = &line.chains[edge.given[0].chain as usize];
            if chain.axis.is_none() || edge.given[0].chain != edge.given[1].chain {
                continue;
            }
            let length = network.length(edge);
            // Points whose station is known, by distance from the start.
            let mut marks: Vec<(f64, f64)> = Vec::new();
            let ends = [(0.0, Some(edge.given[0])), (length, Some(edge.given[1]))];
            let all = ends[..1].iter().copied().chain(inner.iter().map(|p| (p.s, p.given))).chain(ends[1..].iter().copied());
            marks.extend(all.filter_map(|(s, given)| Some((s, station(chain, given?)?))));
            let at = |s: f64| {
                let i = marks.partition_point(|m| m.0 < s).clamp(1, marks.len().max(2) - 1);
                let ((s0, a), (s1, b)) = (marks[i - 1], marks[i]);
                if s == s1 { b } else { a + (b - a) * ((s - s0) / (s1 - s0)).clamp(0.0, 1.0) }
            };
            if marks.len() < 2 {
                continue;
            }
            let mut along = vec![(edge.a, marks[0].1)];
            along.extend(inner.iter().map(|p| (p.id, at(p.s))));
            along.push((edge.b, marks[marks.len() - 1].1));
            let ends = std::iter::once(true);
            let given = ends.clone().chain(inner.iter().map(|p| p.given.is_some())).chain(ends).collect();
            edges[edge.given[0].chain as usize].push(RoadEdge { edge: e, along, given });
        }
        Self { line, edges }
    }

    /// Every vertex of a road with its chain and station; by vertex, each once per chain.
    pub(super) fn stations(&self, threads: &Threads) -> Vec<(u32, u32, f64)> {
        let mut found: Vec<(u32, u32, f64)> = Vec::new();
        for (chain, edges) in self.edges.iter().enumerate() {
            found.extend(edges.iter().flat_map(|edge| &edge.along).map(|&(v, station)| (v, chain as u32, station)));
        }
        for (&(v, index, i), &plan) in threads.fresh.iter().zip(&threads.plan) {
            let breakline = &self.line.breaklines[index];
            let Some(chain) = breakline.of.filter(|&of| self.line.chains[of].axis.is_some()) else { continue };
            let station = match &breakline.stations {
                Some(stations) => stations.get(i).copied(),
                None => self.axis_of(chain).and_then(|axis| nearest(axis, plan)),
            };
            found.extend(station.map(|station| (v, chain as u32, station)));
        }
        found.sort_by(|a, b| (a.0, a.1).cmp(&(b.0, b.1)).then(a.2.total_cmp(&b.2)));
        found.dedup_by_key(|f| (f.0, f.1));
        found
    }

    /// The centre line of a road.
    fn axis_of(&self, chain: usize) -> Option<&Breakline> {
        self.line.breaklines.iter().find(|b| b.of == Some(chain) && b.stations.is_some())
    }

    /// The platform of a road from cross-section to cross-section; `None` where it is more than a road (lines or rings lie in it,
    /// its edge is shared) or is too crooked for that. `outline` are the edges with a platform.
    ///
    /// Made of the vertices of the road, so that its shape is the same with whatever levels; then its edge gets those of the slopes.
    pub(super) fn strip(
        &self,
        chain: usize,
        threads: &Threads,
        points: &[DVec3],
        outline: &FxHashSet<usize>,
    ) -> Option<Vec<[u32; 3]>> {
        self.line.chains[chain].axis.as_ref()?;
        let mut own = (0..threads.lines.len()).filter(|&b| threads.lines[b].1 == Some(chain));
        let (axis, None) = (own.next()?, own.next()) else { return None };
        let stations = self.line.breaklines[axis].stations.as_ref()?;
        let ids = &threads.lines[axis].0;
        let centre: Along = ids.iter().copied().zip(stations.iter().copied()).collect();
        let edges = &self.edges[chain];
        let id = |p: Option<&Beside>| p.map(|p| p.0);
        let joined = |i: usize| id(edges[i].along.last()) == id(edges[(i + 1) % edges.len()].along.first());
        if edges.is_empty()
            || !(0..edges.len()).all(|i| joined(i) && outline.contains(&edges[i].edge))
            || self.holds_others(chain)
        {
            return None;
        }
        let (ring, between) = corners(edges);
        let find = |id: u32| ring.iter().position(|p| p.0 == id);
        let (first, last) = (find(*ids.first()?)?, find(*ids.last()?)?);
        let run = |from: usize, to: usize| -> Along {
            let count = (to + ring.len() - from) % ring.len();
            (0..=count).map(|i| ring[(from + i) % ring.len()]).collect()
        };
        let left = run(first, last);
        let mut right = run(last, first);
        right.reverse();
        let mut triangles = strip::between(points, &centre, &left)?;
        triangles.extend(strip::between(points, &right, &centre)?);
        Some(fanned(triangles, &between))
    }

    /// Whether another chain begins inside of this ring.
    fn holds_others(&self, chain: usize) -> bool {
        let ring = &self.line.chains[chain].vertices;
        let bounds = PlanBox::of(ring.iter().map(|v| v.truncate()));
        let others = self.line.chains.iter().enumerate().filter(|(c, _)| *c != chain);
        others.filter_map(|(_, other)| other.vertices.first()).map(|v| v.truncate()).any(|p| {
            bounds.contains(p) && (0..ring.len()).fold(false, |odd, i| odd ^ crosses_ray(p, ring[i], ring[(i + 1) % ring.len()]))
        })
    }
}

/// The vertices of a road around its ring, and the other points between two that follow each other.
fn corners(edges: &[RoadEdge]) -> (Along, FxHashMap<[u32; 2], Vec<u32>>) {
    let mut corners = Along::new();
    let mut between: FxHashMap<[u32; 2], Vec<u32>> = FxHashMap::default();
    for edge in edges {
        let mut passed = Vec::new();
        let mut from = edge.along[0];
        for (point, given) in edge.along.iter().zip(&edge.given).skip(1) {
            if *given {
                corners.push(from);
                if !passed.is_empty() {
                    between.insert([from.0, point.0], std::mem::take(&mut passed));
                }
                from = *point;
            } else {
                passed.push(point.0);
            }
        }
    }
    (corners, between)
}

/// Triangles with the points `between` two corners in their sides, each side fanned out from the corner opposite.
fn fanned(triangles: Vec<[u32; 3]>, between: &FxHashMap<[u32; 2], Vec<u32>>) -> Vec<[u32; 3]> {
    let mut fanned = Vec::with_capacity(triangles.len());
    let mut rest = triangles;
    rest.reverse();
    while let Some([a, b, c]) = rest.pop() {
        let side = [[a, b, c], [b, c, a], [c, a, b]].into_iter().find_map(|[from, to, apex]| {
            let forward = between.get(&[from, to]).map(|points| points.to_vec());
            let backward = || between.get(&[to, from]).map(|points| points.iter().rev().copied().collect());
            forward.or_else(backward).map(|points| (from, points, to, apex))
        });
        let Some((from, points, to, apex)) = side else {
            fanned.push([a, b, c]);
            continue;
        };
        let along: Vec<u32> = std::iter::once(from).chain(points).chain(std::iter::once(to)).collect();
        // The first and the last may have points in another side.
        rest.extend(along.windows(2).rev().map(|w| [w[0], w[1], apex]));
    }
    fanned
}

/// Whether the ray from `p` towards +x crosses the segment.
fn crosses_ray(p: DVec2, a: DVec3, b: DVec3) -> bool {
    use crate::kernel::orientation::{Turn, turn};
    (a.y > p.y) != (b.y > p.y) && (turn(a.truncate(), b.truncate(), p) == Turn::Left) == (b.y > a.y)
}

/// Station on the centre line of a place on the edge.
fn station(chain: &Chain, given: Given) -> Option<f64> {
    let stations = &chain.axis.as_ref()?.stations;
    let from = *stations.get(given.vertex as usize)?;
    if given.part == 0.0 {
        return Some(from);
    }
    let to = *stations.get(given.vertex as usize + 1)?;
    Some(from + given.part * (to - from))
}

/// Station of the point of a centre line that is nearest to `p`.
fn nearest(axis: &Breakline, p: DVec2) -> Option<f64> {
    let stations = axis.stations.as_ref()?;
    let mut best = (f64::INFINITY, None);
    for (w, s) in axis.vertices.windows(2).zip(stations.windows(2)) {
        let (a, b) = (w[0].truncate(), w[1].truncate());
        let part = segment::foot(p, [a, b]);
        let distance = p.distance_squared(a.lerp(b, part));
        if distance < best.0 {
            best = (distance, Some(s[0] + part * (s[1] - s[0])));
        }
    }
    best.1
}
