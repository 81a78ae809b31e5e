//! The part of the ground that the works can touch, with neighbours.

use super::GroundError;
use crate::kernel::buckets::Buckets;
use crate::kernel::plan_box::PlanBox;
pub(super) use crate::mesh::neighbours::NONE;
use crate::mesh::neighbours::neighbours;
use crate::mesh::volume::plan_area;
use crate::model::{Note, Terrain};
use crate::terrain;
use glam::{DVec2, DVec3};

/// Triangles with their neighbours: side `i` runs from corner `i` to the next.
pub(crate) struct Patch {
    /// Vertices in the local frame.
    pub(crate) vertices: Vec<DVec3>,
    /// The number of each vertex in the whole ground.
    pub(crate) vertex_of: Vec<u32>,
    /// Counter-clockwise triangles.
    pub(crate) triangles: Vec<[u32; 3]>,
    /// The number of each triangle in the whole ground, ascending.
    pub(crate) triangle_of: Vec<u32>,
    /// Neighbours across the sides; [`NONE`] at the edge.
    pub(crate) neighbours: Vec<[u32; 3]>,
    bins: Bins,
}

impl Patch {
    /// The triangles `chosen` of a ground.
    pub(crate) fn new(terrain: &Terrain, chosen: Vec<u32>) -> Self {
        // From 1: memory that is nought costs nothing where the works do not come.
        let mut number = vec![0_u32; terrain.vertices.len()];
        let mut vertex_of = Vec::new();
        let triangles: Vec<[u32; 3]> = chosen
            .iter()
            .map(|&t| {
                terrain.triangles[t as usize].map(|v| {
                    let id = &mut number[v as usize];
                    if *id == 0 {
                        vertex_of.push(v);
                        *id = vertex_of.len() as u32;
                    }
                    *id - 1
                })
            })
            .collect();
        let vertices: Vec<DVec3> = vertex_of.iter().map(|&v| terrain.vertices[v as usize]).collect();
        let neighbours = neighbours(vertices.len(), &triangles);
        let bins = Bins::new(&vertices, &triangles);
        Self { vertices, vertex_of, triangles, triangle_of: chosen, neighbours, bins }
    }

    /// Looks at how the triangles lie together; `ground` is what the patch was taken from, `label` its name in messages.
    ///
    /// # Errors
    /// [`GroundError::Terrain`] with all that is wrong.
    pub(crate) fn inspect(&self, ground: &Terrain, label: &str) -> Result<Vec<Note>, GroundError> {
        let near = Terrain { frame: ground.frame, vertices: self.vertices.clone(), triangles: self.triangles.clone() };
        let findings = terrain::inspect(label, &near);
        if findings.defects.list.is_empty() { Ok(findings.notes) } else { Err(GroundError::Terrain(findings.defects)) }
    }

    /// Ends of side `j` of triangle `t`, lower vertex first.
    pub(crate) fn edge(&self, t: u32, j: u8) -> [u32; 2] {
        let t = self.triangles[t as usize];
        let (v, w) = (t[j as usize], t[(j as usize + 1) % 3]);
        [v.min(w), v.max(w)]
    }

    /// Calls `visit` with every triangle whose box comes near the segment from `a` to `b`; some come more than once.
    pub(crate) fn near(&self, a: DVec2, b: DVec2, mut visit: impl FnMut(u32)) {
        self.bins.along(a, b, |bin| {
            self.bins.triangles.of(bin).iter().for_each(|&t| visit(t));
        });
    }

    /// Whether the boxes of triangle `t` and of the segment from `a` to `b` meet, their edges included.
    pub(crate) fn meets_box(&self, t: u32, a: DVec2, b: DVec2) -> bool {
        let [p, q, r] = self.triangles[t as usize].map(|v| self.vertices[v as usize].truncate());
        p.min(q).min(r).cmple(a.max(b)).all() && a.min(b).cmple(p.max(q).max(r)).all()
    }
}

/// Triangles by the bins their boxes overlap.
struct Bins {
    origin: DVec2,
    cell: f64,
    size: [usize; 2],
    /// Row by row, and after the last one the large triangles.
    triangles: Buckets<u32>,
}

/// Triangles of mean area that a bin has room for.
const TRIANGLES_PER_BIN: f64 = 4.0;

/// Most bins for each triangle: the box of a long bent strip is nearly empty.
const BINS_PER_TRIANGLE: f64 = 4.0;

/// Bins are taken wider by this part when a segment is followed, so that rounding loses none.
const WIDER: f64 = 0.01;

/// A triangle is listed in at most this many bins one by one; larger ones go to a list of their own.
const MOST_BINS: usize = 256;

impl Bins {
    fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let bounds = PlanBox::of(vertices.iter().map(|v| v.truncate()));
        if triangles.is_empty() {
            return Self { origin: DVec2::ZERO, cell: 1.0, size: [0, 0], triangles: Buckets::new(0, std::iter::empty()) };
        }
        let extent = bounds.size();
        let count = triangles.len() as f64;
        let area: f64 = triangles.iter().map(|t| plan_area(t.map(|v| vertices[v as usize]))).sum();
        let most = (BINS_PER_TRIANGLE * count).max(1.0);
        let roomy = (TRIANGLES_PER_BIN * area / count).sqrt();
        let cell = roomy.max((extent.x * extent.y / most).sqrt()).max(extent.max_element() / most).max(f64::MIN_POSITIVE);
        let size = [(extent.x / cell) as usize + 1, (extent.y / cell) as usize + 1];
        let mut bins = Self { origin: bounds.lo, cell, size, triangles: Buckets::new(0, std::iter::empty()) };
        // First and last column and row of each triangle.
        let reach = |t: &[u32; 3]| {
            let p = t.map(|v| vertices[v as usize].truncate());
            let (lo, hi) = (bins.place(p[0].min(p[1]).min(p[2])), bins.place(p[0].max(p[1]).max(p[2])));
            let large = (hi[0] - lo[0] + 1) * (hi[1] - lo[1] + 1) > MOST_BINS;
            if large { [0, 0, size[1], size[1]] } else { [lo[0], hi[0], lo[1], hi[1]] }.map(|i| i as u32)
        };
        let reaches: Vec<[u32; 4]> = triangles.iter().map(reach).collect();
        let columns = size[0] as u32;
        let bins_of =
            |[left, right, low, high]: [u32; 4]| (low..high + 1).flat_map(move |y| y * columns + left..y * columns + right + 1);
        let numbered = (0..).zip(&reaches).flat_map(|(n, &reach)| bins_of(reach).map(move |bin| (bin, n)));
        bins.triangles = Buckets::new(size[0] * size[1] + 1, numbered);
        bins
    }

    /// Column and row of a place, within the grid.
    fn place(&self, p: DVec2) -> [usize; 2] {
        let at = (p - self.origin) / self.cell;
        let clamp = |v: f64, size: usize| (v.max(0.0) as usize).min(size - 1);
        [clamp(at.x, self.size[0]), clamp(at.y, self.size[1])]
    }

    /// Bins that the segment comes into, one row after the other, and the list of the large triangles.
    fn along(&self, a: DVec2, b: DVec2, mut visit: impl FnMut(u32)) {
        if self.size == [0, 0] {
            return;
        }
        visit((self.size[0] * self.size[1]) as u32);
        let (a, b) = if a.y <= b.y { (a, b) } else { (b, a) };
        let far = self.origin + self.cell * DVec2::new(self.size[0] as f64, self.size[1] as f64);
        if b.y < self.origin.y || a.y > far.y || a.x.max(b.x) < self.origin.x || a.x.min(b.x) > far.x {
            return;
        }
        let x_at = |y: f64| if b.y > a.y { a.x + (b.x - a.x) * ((y - a.y) / (b.y - a.y)).clamp(0.0, 1.0) } else { b.x };
        for y in self.place(a)[1]..=self.place(b)[1] {
            let bottom = self.origin.y + self.cell * (y as f64 - WIDER);
            let (p, q) = (x_at(bottom), x_at(bottom + (1.0 + 2.0 * WIDER) * self.cell));
            let (p, q) = if b.y > a.y { (p.min(q), p.max(q)) } else { (a.x.min(b.x), a.x.max(b.x)) };
            let slack = WIDER * self.cell;
            let from = self.place(DVec2::new(p - slack, bottom))[0];
            let to = self.place(DVec2::new(q + slack, bottom))[0];
            (from..=to).for_each(|x| visit((y * self.size[0] + x) as u32));
        }
    }
}
