//! How far the slopes can possibly reach: coarse bounds of the ground against a bound of the sheet.

use super::thinned::thinned;
use crate::kernel::frame::Frame;
use crate::kernel::sum::Sum;
use crate::mesh::volume::plan_area;
use crate::model::{Line, Sheet, Slope, Terrain};
use crate::sheet::Heights;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Triangles per cell of the coarse grid, on average.
const TRIANGLES_PER_CELL: f64 = 16.0;

/// Most cells along one side of the grid; their numbers fit into 16 bits.
const MOST_CELLS: f64 = 512.0;

/// Triangles whose areas are added up plainly, before the sum goes to one that is compensated: a chain of compensated additions
/// waits for every single one of them. A block of so few loses no more than a few units in the last place of itself.
const FEW: usize = 32;

/// Triangles of which the columns and rows are known together; a multiple of [`FEW`].
const BLOCK: usize = 256;

/// Parts of the ground that are bounded by themselves, each with a grid of its own: the same number on any number of threads, so
/// that sums are the same, too.
const PARTS: usize = 8;

/// Rows and columns are taken wider by this part of a cell, so that rounding loses none.
const WIDER: f64 = 1e-6;

/// Lowest and highest ground over the cells of a coarse grid.
///
/// Grounds have millions of triangles of which the works touch few, so the pass over all of them decides the time. It looks at
/// columns and rows of vertices, found once, and nearly all triangles have their vertices in one cell or two. Later ones leave
/// out whole blocks of triangles by the box of their cells.
pub(crate) struct Bounds {
    /// Lower left corner of the ground.
    origin: DVec2,
    /// Upper right corner: what lies on it is on the ground, wherever rounding puts the last cell.
    far: DVec2,
    cell: DVec2,
    size: [usize; 2],
    /// Lowest and highest ground of each cell; the wrong way round where there is none.
    range: Vec<[f64; 2]>,
    /// Column and row of each vertex of the ground.
    places: Vec<[u16; 2]>,
    /// First column and row and last column and row of each [`BLOCK`] of triangles.
    boxes: Vec<[u16; 4]>,
    /// Plan area of the ground.
    pub(crate) area: f64,
}

/// Lowest and highest ground of a cell without any.
const NOWHERE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

/// Bounds of a part of the triangles.
struct Bounded {
    range: Vec<[f64; 2]>,
    boxes: Vec<[u16; 4]>,
    area: Sum,
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
        let bounds = terrain.plan_box();
        let extent = bounds.size().max(DVec2::splat(f64::MIN_POSITIVE));
        let cells = (terrain.triangles.len() as f64 / TRIANGLES_PER_CELL).clamp(1.0, MOST_CELLS * MOST_CELLS);
        let across = |a: f64, b: f64| (cells * a / b).sqrt().ceil().clamp(1.0, MOST_CELLS);
        let size = [across(extent.x, extent.y) as usize, across(extent.y, extent.x) as usize];
        let cell = extent / DVec2::new(size[0] as f64, size[1] as f64);
        let mut bounds = Self {
            origin: bounds.lo,
            far: bounds.hi,
            cell,
            size,
            range: Vec::new(),
            places: Vec::new(),
            boxes: Vec::new(),
            area: 0.0,
        };
        let place = |v: &DVec3| [bounds.index(v.x, 0) as u16, bounds.index(v.y, 1) as u16];
        bounds.places = terrain.vertices.par_iter().map(place).collect();
        let length = terrain.triangles.len().div_ceil(PARTS).next_multiple_of(BLOCK);
        let parts: Vec<Bounded> = terrain.triangles.par_chunks(length.max(1)).map(|part| bounds.bounded(terrain, part)).collect();
        let mut area = Sum::default();
        for part in parts {
            area.join(part.area);
            bounds.boxes.extend(part.boxes);
            if bounds.range.is_empty() {
                bounds.range = part.range;
            } else {
                for (all, one) in bounds.range.iter_mut().zip(part.range) {
                    *all = [all[0].min(one[0]), all[1].max(one[1])];
                }
            }
        }
        bounds.range.resize(size[0] * size[1], NOWHERE);
        bounds.area = area.value();
        bounds
    }

    /// Bounds of a part of the triangles.
    fn bounded(&self, terrain: &Terrain, part: &[[u32; 3]]) -> Bounded {
        let mut range = vec![NOWHERE; self.size[0] * self.size[1]];
        let mut area = Sum::default();
        let mut boxes = Vec::with_capacity(part.len().div_ceil(BLOCK));
        for block in part.chunks(BLOCK) {
            let mut cells = [u16::MAX, u16::MAX, 0, 0];
            for few in block.chunks(FEW) {
                let mut of_few = 0.0;
                for t in few {
                    // One by one: closures over arrays are not always inlined, and this is done for millions.
                    let [a, b, c] = [t[0] as usize, t[1] as usize, t[2] as usize];
                    let [p, q, r] = [terrain.vertices[a], terrain.vertices[b], terrain.vertices[c]];
                    of_few += plan_area([p, q, r]);
                    let (low, high) = (p.z.min(q.z).min(r.z), p.z.max(q.z).max(r.z));
                    for [x, y] in [self.places[a], self.places[b], self.places[c]] {
                        cells = [cells[0].min(x), cells[1].min(y), cells[2].max(x), cells[3].max(y)];
                    }
                    self.cells_of_ground(terrain, t, |c| {
                        range[c][0] = range[c][0].min(low);
                        range[c][1] = range[c][1].max(high);
                    });
                }
                area.add(of_few);
            }
            boxes.push(cells);
        }
        Bounded { range, boxes, area }
    }

    /// Cells reached by slopes of `sheet` from the line, cell after cell from those under the line.
    ///
    /// A sheet of slope `k` lies nowhere in a cell above its height at the centre plus `k` times half the diagonal: where that is
    /// below the lowest ground of the cell, no slope comes into it (rising: the other way round). What lies beyond such cells
    /// only is not connected to the line. The sheet is known to `tolerance` at best.
    pub(crate) fn reach(&self, frame: &Frame, line: &Line, slope: Slope, sheet: Sheet, tolerance: f64) -> Reach {
        let step = 0.5 * tolerance / slope.ratio();
        let thin = thinned(line, step);
        let heights = Heights::new(thin.as_ref().unwrap_or(line), slope, sheet);
        let off = if thin.is_some() { tolerance } else { 0.0 };
        let slack = slope.ratio() * 0.5 * self.cell.length() + off;
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
        let counts = self.counts(inside);
        let width = self.size[0] + 1;
        let of_block = |(block, (triangles, cells)): (usize, (&[[u32; 3]], &[u16; 4]))| {
            let [x0, y0, x1, y1] = cells.map(usize::from);
            let count = |x: usize, y: usize| counts[y * width + x];
            let mut touched = Vec::new();
            if count(x1 + 1, y1 + 1) + count(x0, y0) == count(x0, y1 + 1) + count(x1 + 1, y0) {
                return touched;
            }
            for (i, t) in triangles.iter().enumerate() {
                let mut found = false;
                self.cells_of_ground(terrain, t, |c| found |= inside[c]);
                if found {
                    touched.push((BLOCK * block + i) as u32);
                }
            }
            touched
        };
        let blocks = terrain.triangles.par_chunks(BLOCK).zip(&self.boxes).enumerate();
        blocks.map(of_block).collect::<Vec<_>>().concat()
    }

    /// How many cells are `inside` of all below and to the left of each corner of the grid.
    fn counts(&self, inside: &[bool]) -> Vec<u32> {
        let width = self.size[0] + 1;
        let mut counts = vec![0_u32; width * (self.size[1] + 1)];
        for (y, row) in inside.chunks(self.size[0]).enumerate() {
            let mut of_row = 0;
            for (x, &is_inside) in row.iter().enumerate() {
                of_row += u32::from(is_inside);
                counts[(y + 1) * width + x + 1] = counts[y * width + x + 1] + of_row;
            }
        }
        counts
    }

    /// The same cells as [`Self::cells_of`], for a triangle of the ground.
    #[inline]
    fn cells_of_ground(&self, terrain: &Terrain, t: &[u32; 3], mut visit: impl FnMut(usize)) {
        let [a, b, c] = [self.places[t[0] as usize], self.places[t[1] as usize], self.places[t[2] as usize]];
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
        if hi.cmplt(self.origin).any() || lo.cmpgt(self.far).any() {
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
