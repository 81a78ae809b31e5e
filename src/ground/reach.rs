//! How far the slopes can possibly reach: coarse bounds of the ground against a bound of the sheet.

use crate::kernel::frame::Frame;
use crate::kernel::sum::Sum;
use crate::mesh::volume::plan_area;
use crate::model::{Line, Sheet, Slope, Terrain};
use crate::sheet::Heights;
use glam::DVec2;

/// Triangles per cell of the coarse grid, on average.
const TRIANGLES_PER_CELL: f64 = 16.0;

/// Most cells along one side of the grid; their numbers fit into 16 bits.
const MOST_CELLS: f64 = 512.0;

/// Triangles whose areas are added up plainly, before the sum goes to one that is compensated: a chain of compensated additions
/// waits for every single one of them. A block of so few loses no more than a few units in the last place of itself.
const BLOCK: usize = 32;

/// Rows and columns are taken wider by this part of a cell, so that rounding loses none.
const WIDER: f64 = 1e-6;

/// Lowest and highest ground over the cells of a coarse grid.
///
/// Grounds have millions of triangles of which the works touch few, so the two passes over all of them decide the time: both look
/// at columns and rows of vertices, found once, and nearly all triangles have their vertices in one cell or two.
pub(crate) struct Bounds {
    origin: DVec2,
    cell: DVec2,
    size: [usize; 2],
    /// Lowest and highest ground of each cell; the wrong way round where there is none.
    range: Vec<[f64; 2]>,
    /// Column and row of each vertex of the ground.
    places: Vec<[u16; 2]>,
    /// Plan area of the ground.
    pub(crate) area: f64,
}

/// The cells of the grid that slopes can reach.
pub(crate) struct Reach {
    inside: Vec<bool>,
    /// Lowest and highest ground in them; the wrong way round where no cell is reached.
    pub(crate) lowest: f64,
    pub(crate) highest: f64,
}

impl Bounds {
    /// The bounds of a ground.
    pub(crate) fn new(terrain: &Terrain) -> Self {
        let (lo, hi) = terrain.plan_box();
        let extent = (hi - lo).max(DVec2::splat(f64::MIN_POSITIVE));
        let cells = (terrain.triangles.len() as f64 / TRIANGLES_PER_CELL).clamp(1.0, MOST_CELLS * MOST_CELLS);
        let across = |a: f64, b: f64| (cells * a / b).sqrt().ceil().clamp(1.0, MOST_CELLS);
        let size = [across(extent.x, extent.y) as usize, across(extent.y, extent.x) as usize];
        let cell = extent / DVec2::new(size[0] as f64, size[1] as f64);
        let range = vec![[f64::INFINITY, f64::NEG_INFINITY]; size[0] * size[1]];
        let mut bounds = Self { origin: lo, cell, size, range, places: Vec::new(), area: 0.0 };
        bounds.places = terrain.vertices.iter().map(|v| [bounds.index(v.x, 0) as u16, bounds.index(v.y, 1) as u16]).collect();
        let mut range = std::mem::take(&mut bounds.range);
        let mut area = Sum::default();
        for block in terrain.triangles.chunks(BLOCK) {
            let mut of_block = 0.0;
            for t in block {
                let corners = t.map(|v| terrain.vertices[v as usize]);
                of_block += plan_area(corners);
                let z = corners.map(|p| p.z);
                let (low, high) = (z[0].min(z[1]).min(z[2]), z[0].max(z[1]).max(z[2]));
                bounds.cells_of_ground(terrain, t, |c| {
                    range[c][0] = range[c][0].min(low);
                    range[c][1] = range[c][1].max(high);
                });
            }
            area.add(of_block);
        }
        bounds.range = range;
        bounds.area = area.value();
        bounds
    }

    /// Cells reached by slopes of `sheet` from the line, cell after cell from those under the line.
    ///
    /// A sheet of slope `k` lies nowhere in a cell above its height at the centre plus `k` times half the diagonal: where that is
    /// below the lowest ground of the cell, no slope comes into it (rising: the other way round). What lies beyond such cells
    /// only is not connected to the line.
    pub(crate) fn reach(&self, frame: &Frame, line: &Line, slope: Slope, sheet: Sheet) -> Reach {
        let heights = Heights::new(line, slope, sheet);
        let slack = slope.ratio() * 0.5 * self.cell.length();
        let mut reach = Reach { inside: vec![false; self.range.len()], lowest: f64::INFINITY, highest: f64::NEG_INFINITY };
        let mut pending = Vec::new();
        for chain in &line.chains {
            for (a, b) in (0..chain.segment_count()).map(|i| chain.segment(i)) {
                let ends = [a, b].map(|p| frame.to_local(p).truncate());
                self.cells_of(&[ends[0], ends[1], ends[1]], |c| pending.push(c));
            }
        }
        while let Some(c) = pending.pop() {
            let [low, high] = self.range[c];
            if reach.inside[c] || low > high {
                continue;
            }
            let (i, j) = (c % self.size[0], c / self.size[0]);
            let centre = self.origin + self.cell * DVec2::new(i as f64 + 0.5, j as f64 + 0.5);
            let height = heights.at(frame.to_world(centre.extend(0.0)).truncate());
            let reached = match sheet {
                Sheet::Falling => height + slack >= low,
                Sheet::Rising => height - slack <= high,
            };
            if !reached {
                continue;
            }
            reach.inside[c] = true;
            reach.lowest = reach.lowest.min(low);
            reach.highest = reach.highest.max(high);
            for y in j.saturating_sub(1)..(j + 2).min(self.size[1]) {
                pending.extend((i.saturating_sub(1)..(i + 2).min(self.size[0])).map(|x| y * self.size[0] + x));
            }
        }
        reach
    }

    /// The cells that one of `reaches` or one of the triangles of `covers` comes into.
    pub(crate) fn inside(&self, reaches: &[Reach], covers: impl Iterator<Item = [DVec2; 3]>) -> Vec<bool> {
        let mut inside = vec![false; self.range.len()];
        for reach in reaches {
            inside.iter_mut().zip(&reach.inside).for_each(|(all, one)| *all |= one);
        }
        for corners in covers {
            self.cells_of(&corners, |c| inside[c] = true);
        }
        inside
    }

    /// Triangles of the ground with a part in one of the cells `inside`, ascending.
    pub(crate) fn touched(&self, terrain: &Terrain, inside: &[bool]) -> Vec<u32> {
        let mut touched = Vec::new();
        for (t, corners) in terrain.triangles.iter().enumerate() {
            let mut found = false;
            self.cells_of_ground(terrain, corners, |c| found |= inside[c]);
            if found {
                touched.push(t as u32);
            }
        }
        touched
    }

    /// The same cells as [`Self::cells_of`], for a triangle of the ground.
    #[inline]
    fn cells_of_ground(&self, terrain: &Terrain, t: &[u32; 3], mut visit: impl FnMut(usize)) {
        let [a, b, c] = t.map(|v| self.places[v as usize]);
        let cell = |p: [u16; 2]| usize::from(p[1]) * self.size[0] + usize::from(p[0]);
        if a == b && b == c {
            visit(cell(a));
            return;
        }
        let (x0, x1) = (a[0].min(b[0]).min(c[0]), a[0].max(b[0]).max(c[0]));
        let (y0, y1) = (a[1].min(b[1]).min(c[1]), a[1].max(b[1]).max(c[1]));
        if x1 - x0 < 2 || y0 == y1 {
            for y in y0..=y1 {
                (cell([x0, y])..=cell([x1, y])).for_each(&mut visit);
            }
        } else {
            self.cells_of(&t.map(|v| terrain.vertices[v as usize].truncate()), visit);
        }
    }

    /// Column or row of a coordinate, within the grid.
    fn index(&self, value: f64, axis: usize) -> usize {
        let (origin, cell) = ([self.origin.x, self.origin.y][axis], [self.cell.x, self.cell.y][axis]);
        // The cast cuts off towards nought, and makes nought of what is negative.
        (((value - origin) / cell) as usize).min(self.size[axis] - 1)
    }

    /// All cells a triangle has a part in, and perhaps some beside it: row by row between the smallest and greatest x there.
    fn cells_of(&self, corners: &[DVec2; 3], mut visit: impl FnMut(usize)) {
        let [a, b, c] = *corners;
        let (lo, hi) = (a.min(b).min(c), a.max(b).max(c));
        let far = self.origin + self.cell * DVec2::new(self.size[0] as f64, self.size[1] as f64);
        if hi.cmplt(self.origin).any() || lo.cmpgt(far).any() {
            return;
        }
        let (x0, x1) = (self.index(lo.x, 0), self.index(hi.x, 0));
        let (y0, y1) = (self.index(lo.y, 1), self.index(hi.y, 1));
        if x1 - x0 < 2 || y0 == y1 {
            for y in y0..=y1 {
                (x0..=x1).for_each(|x| visit(y * self.size[0] + x));
            }
            return;
        }
        for y in y0..=y1 {
            let bottom = self.origin.y + self.cell.y * (y as f64 - WIDER);
            let top = self.origin.y + self.cell.y * (y as f64 + 1.0 + WIDER);
            let (mut left, mut right) = (f64::INFINITY, f64::NEG_INFINITY);
            for (p, q) in [(a, b), (b, c), (c, a)] {
                let (p, q) = if p.y <= q.y { (p, q) } else { (q, p) };
                if q.y < bottom || p.y > top {
                    continue;
                }
                for limit in [bottom.max(p.y), top.min(q.y)] {
                    let t = if q.y > p.y { ((limit - p.y) / (q.y - p.y)).clamp(0.0, 1.0) } else { 0.0 };
                    let (x, other) = if q.y > p.y { (p.x + t * (q.x - p.x), None) } else { (p.x, Some(q.x)) };
                    for x in [x, other.unwrap_or(x)] {
                        left = left.min(x);
                        right = right.max(x);
                    }
                }
            }
            if left <= right {
                let slack = WIDER * self.cell.x;
                (self.index(left - slack, 0)..=self.index(right + slack, 0)).for_each(|x| visit(y * self.size[0] + x));
            }
        }
    }
}
