//! The design before the ground cuts it: platform, falling and rising slopes in one numbering.

use super::patch::NONE;
use crate::kernel::frame::Frame;
use crate::mesh::neighbours::neighbours;
use crate::model::Part;
use crate::surface::{Foot, Mark, Surface};
use glam::{DVec2, DVec3};
use rustc_hash::{FxHashMap, FxHashSet};

/// Platform and slopes. Triangles of different parts are neighbours of none but their own; they share the vertices of the line.
pub(crate) struct Shape {
    pub(crate) frame: Frame,
    /// Vertices in the local frame, rounded to what a file can hold in world coordinates.
    pub(crate) vertices: Vec<DVec3>,
    /// Counter-clockwise triangles.
    pub(crate) triangles: Vec<[u32; 3]>,
    pub(crate) parts: Vec<Part>,
    /// Neighbours of the same part across the sides.
    pub(crate) neighbours: Vec<[u32; 3]>,
    /// Facets of the slopes.
    pub(crate) feet: Vec<Foot>,
    /// Facet of each triangle, [`NONE`] for platforms.
    pub(crate) foot_of: Vec<u32>,
    /// Stations of the vertices of a road's platform on its centre line, by vertex and chain.
    pub(crate) stations: FxHashMap<(u32, u32), f64>,
    /// The road each platform triangle belongs to; [`NONE`] for pads and slopes.
    pub(crate) road_of: Vec<u32>,
    /// Mesh edges of the line, lower vertex first.
    pub(crate) hinge: FxHashSet<[u32; 2]>,
    /// Mesh edges with a meaning, lower vertex first; levels are numbered as in `levels`.
    pub(crate) marks: Vec<(Mark, [u32; 2])>,
    /// Elevations of the level curves, from the top down.
    pub(crate) levels: Vec<f64>,
}

impl Shape {
    /// Joins the surfaces of one line, given in one frame. With `whole`, triangles of all parts are neighbours.
    /// `None` if they do not have the points of the line in common.
    pub(crate) fn new(surfaces: &[&Surface], whole: bool) -> Option<Self> {
        let frame = surfaces.first()?.tin.frame;
        let mut levels: Vec<f64> = surfaces.iter().flat_map(|s| s.levels.iter().copied()).collect();
        levels.sort_by(|a, b| b.total_cmp(a));
        levels.dedup();
        let mut shape = Self {
            frame,
            vertices: Vec::new(),
            triangles: Vec::new(),
            parts: Vec::new(),
            neighbours: Vec::new(),
            feet: Vec::new(),
            foot_of: Vec::new(),
            stations: FxHashMap::default(),
            road_of: Vec::new(),
            hinge: FxHashSet::default(),
            marks: Vec::new(),
            levels,
        };
        let mut on_line: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        for (n, surface) in surfaces.iter().enumerate() {
            let number = shape.take_vertices(surface, &mut on_line, n == 0)?;
            shape.take_triangles(surface, &number, n == 0);
            if n == 0 {
                let stations = surface.platform_stations.iter();
                shape.stations = stations.map(|s| ((number[s.vertex as usize], s.chain), s.station)).collect();
            }
            shape.take_marks(surface, &number);
        }
        if whole {
            shape.join(|_| true);
        } else {
            for part in [Part::Platform, Part::FillSlope, Part::CutSlope] {
                shape.join(|p| p == part);
            }
        }
        shape.find_roads(surfaces);
        shape.marks.sort_unstable();
        shape.marks.dedup();
        Some(shape)
    }

    /// Numbers of the vertices of `surface`: those on the line are shared with the first surface.
    fn take_vertices(&mut self, surface: &Surface, on_line: &mut FxHashMap<[u64; 3], u32>, first: bool) -> Option<Vec<u32>> {
        let mut hinge = vec![false; surface.tin.vertices.len()];
        for (mark, ends) in &surface.marks {
            if matches!(mark, Mark::Hinge(_)) {
                ends.iter().for_each(|&v| hinge[v as usize] = true);
            }
        }
        let mut number = Vec::with_capacity(hinge.len());
        for (&p, on_hinge) in surface.tin.vertices.iter().zip(hinge) {
            let key = p.to_array().map(|c| (c + 0.0).to_bits());
            let known = if on_hinge && !first { Some(*on_line.get(&key)?) } else { None };
            let id = known.unwrap_or(self.vertices.len() as u32);
            if known.is_none() {
                self.vertices.push(self.frame.to_local(self.frame.to_world(p)));
            }
            if on_hinge && first {
                on_line.insert(key, id);
            }
            number.push(id);
        }
        Some(number)
    }

    /// Slopes of each surface; platforms of the first only.
    fn take_triangles(&mut self, surface: &Surface, number: &[u32], first: bool) {
        let base = self.feet.len() as u32;
        self.feet.extend_from_slice(&surface.feet);
        for (n, (t, &part)) in surface.tin.triangles.iter().zip(&surface.tin.parts).enumerate() {
            if first || part != Part::Platform {
                self.triangles.push(t.map(|v| number[v as usize]));
                self.parts.push(part);
                self.foot_of.push(surface.foot_of.get(n).map_or(NONE, |f| base + f));
            }
        }
    }

    fn take_marks(&mut self, surface: &Surface, number: &[u32]) {
        let level = |u: u32| {
            let height = surface.levels[u as usize];
            self.levels.partition_point(|&c| c > height) as u32
        };
        for &(mark, ends) in &surface.marks {
            let mark = match mark {
                Mark::Level(u) => Mark::Level(level(u)),
                other => other,
            };
            let [a, b] = ends.map(|v| number[v as usize]);
            let ends = [a.min(b), a.max(b)];
            self.marks.push((mark, ends));
            if matches!(mark, Mark::Hinge(_)) {
                self.hinge.insert(ends);
            }
        }
    }

    /// A triangle belongs to the road that all its corners have a station on.
    fn find_roads(&mut self, surfaces: &[&Surface]) {
        let mut chains: Vec<u32> = surfaces.iter().take(1).flat_map(|s| s.platform_stations.iter().map(|p| p.chain)).collect();
        chains.sort_unstable();
        chains.dedup();
        let road = |(t, part): (&[u32; 3], &Part)| {
            let on = |chain: &&u32| t.iter().all(|&v| self.stations.contains_key(&(v, **chain)));
            if *part == Part::Platform { chains.iter().find(on).copied().unwrap_or(NONE) } else { NONE }
        };
        self.road_of = self.triangles.iter().zip(&self.parts).map(road).collect();
    }

    /// The road a platform triangle belongs to, and the stations of its corners.
    pub(crate) fn road(&self, t: u32) -> Option<(u32, [f64; 3])> {
        let chain = self.road_of[t as usize];
        let station = |v: u32| self.stations.get(&(v, chain)).copied().unwrap_or(0.0);
        (chain != NONE).then(|| (chain, self.triangles[t as usize].map(station)))
    }

    /// Makes neighbours of the triangles of some parts.
    fn join(&mut self, of: impl Fn(Part) -> bool) {
        self.neighbours.resize(self.triangles.len(), [NONE; 3]);
        let own: Vec<u32> = (0..self.triangles.len() as u32).filter(|&t| of(self.parts[t as usize])).collect();
        let triangles: Vec<[u32; 3]> = own.iter().map(|&t| self.triangles[t as usize]).collect();
        for (&t, found) in own.iter().zip(neighbours(self.vertices.len(), &triangles)) {
            self.neighbours[t as usize] = found.map(|n| if n == NONE { NONE } else { own[n as usize] });
        }
    }

    /// Corners of triangle `t` in plan.
    pub(crate) fn plan(&self, t: u32) -> [DVec2; 3] {
        self.triangles[t as usize].map(|v| self.vertices[v as usize].truncate())
    }

    /// Ends of side `i` of triangle `t`, lower vertex first.
    pub(crate) fn edge(&self, t: u32, i: u8) -> [u32; 2] {
        let t = self.triangles[t as usize];
        let (v, w) = (t[i as usize], t[(i as usize + 1) % 3]);
        [v.min(w), v.max(w)]
    }
}
