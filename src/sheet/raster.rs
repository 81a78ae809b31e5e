//! Heights on a grid: blocks of nodes share a short list of segments.
//!
//! All sheets fall by at most `k` per distance. So a segment that is more than `2kρ` below the sheet at the middle of a
//! block of half diagonal `ρ` is nowhere the highest in it: so the index finds a list for a large block. It is thinned out
//! further by tangent planes, and for the quarters of the block again, down to a few segments or nodes.

use std::ops::Range;

use glam::DVec2;
use rayon::prelude::*;

use super::Index;

/// A grid of points. Values stand at the nodes: what an ESRI raster calls cell centres, to be written with `xllcenter` and
/// `yllcenter`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    /// The south-western node.
    pub xll: f64,
    /// The south-western node.
    pub yll: f64,
    /// Distance of neighbouring nodes, both ways; positive.
    pub cell: f64,
    /// Nodes from west to east.
    pub ncols: usize,
    /// Nodes from south to north.
    pub nrows: usize,
}

impl Grid {
    /// The node in column `col`, counted from the west, and row `row`, counted from the north.
    #[inline]
    pub fn node(&self, col: usize, row: usize) -> DVec2 {
        DVec2::new(self.xll + col as f64 * self.cell, self.yll + (self.nrows - 1 - row) as f64 * self.cell)
    }
}

/// Nodes along the side of the blocks to start with.
const BLOCK: usize = 64;
/// A query of the index costs about as much as this many heights of segments: lists longer than that per node do not pay.
const QUERY: usize = 32;
/// A list of this length is not thinned out any further, nor for a block of this many nodes.
const SHORT: usize = 4;

/// The longest list for a block of `nodes`: each of its segments is tried at all of them, or at the middles of four quarters.
fn longest(nodes: usize) -> usize {
    QUERY * nodes / nodes.clamp(1, 4)
}

/// Heights of the falling sheet at the nodes of some rows of a grid, row by row, each from west to east. `origin` is what
/// the index's local frame takes off the grid's coordinates. Exactly [`Index::height`] at each node, whatever the threads.
pub(super) fn rows(index: &Index, grid: &Grid, origin: DVec2, rows: Range<usize>) -> Vec<f64> {
    let mut heights = vec![0.0; grid.ncols * rows.len()];
    heights.par_chunks_mut((BLOCK * grid.ncols).max(1)).enumerate().for_each(|(band, out)| {
        let from = rows.start + band * BLOCK;
        let count = out.len() / grid.ncols;
        let mut band = Band { index, grid, origin, from, out, slots: Vec::new(), planes: Vec::new(), hint: None };
        for col in (0..grid.ncols).step_by(BLOCK) {
            band.start(Block { cols: (col, (col + BLOCK).min(grid.ncols)), rows: (from, from + count) });
        }
    });
    heights
}

/// Some columns and rows of the grid, from and to.
#[derive(Clone, Copy)]
struct Block {
    cols: (usize, usize),
    rows: (usize, usize),
}

impl Block {
    fn nodes(&self) -> usize {
        (self.cols.1 - self.cols.0) * (self.rows.1 - self.rows.0)
    }

    fn quarters(&self) -> [Self; 4] {
        let ((w, e), (n, s)) = (self.cols, self.rows);
        let (x, y) = (w.midpoint(e), n.midpoint(s));
        [((w, x), (n, y)), ((x, e), (n, y)), ((w, x), (y, s)), ((x, e), (y, s))].map(|(cols, rows)| Self { cols, rows })
    }
}

/// A band of rows in work.
struct Band<'a> {
    index: &'a Index,
    grid: &'a Grid,
    origin: DVec2,
    /// First row.
    from: usize,
    out: &'a mut [f64],
    /// Lists of segments, a block's behind that of the block around it.
    slots: Vec<u32>,
    /// Heights and gradients of a list's segments at the middle of their block.
    planes: Vec<(f64, DVec2)>,
    hint: Option<u32>,
}

impl Band<'_> {
    fn local(&self, col: usize, row: usize) -> DVec2 {
        self.grid.node(col, row) - self.origin
    }

    /// Middle of a block and half its sides.
    fn extent(&self, block: Block) -> (DVec2, DVec2) {
        let first = self.local(block.cols.0, block.rows.0);
        let last = self.local(block.cols.1 - 1, block.rows.1 - 1);
        (0.5 * (first + last), 0.5 * (first - last).abs())
    }

    /// Fills a block from the index.
    fn start(&mut self, block: Block) {
        let (middle, half) = self.extent(block);
        let (height, winner) = self.index.height(middle, self.hint);
        self.hint = Some(winner);
        self.slots.clear();
        let floor = height - 2.0 * self.index.k() * half.length();
        let (most, slots) = (longest(block.nodes()), &mut self.slots);
        self.index.visit_slots_above(middle, floor, |slot| {
            slots.push(slot);
            slots.len() <= most
        });
        if self.slots.len() > most { self.query(block) } else { self.fill(block, 0) }
    }

    /// Fills a block with segments out of `slots[list..]`.
    fn fill(&mut self, block: Block, list: usize) {
        let (end, nodes) = (self.slots.len(), block.nodes());
        if end - list <= SHORT || nodes <= SHORT {
            return self.evaluate(block, list);
        }
        self.thin(block, list);
        let length = self.slots.len() - end;
        if length > longest(nodes) {
            self.query(block);
        } else if length <= SHORT {
            self.evaluate(block, end);
        } else {
            for quarter in block.quarters().into_iter().filter(|quarter| quarter.nodes() > 0) {
                self.fill(quarter, end);
            }
        }
        self.slots.truncate(end);
    }

    /// Adds those of `slots[list..]` that can be highest somewhere in the block.
    ///
    /// A sheet is concave: it lies below its tangent plane, and that of the highest segment at the middle lies above the
    /// four triangles from the middle to the corners. So a segment whose plane is below those at the corners is out.
    fn thin(&mut self, block: Block, list: usize) {
        let (middle, half) = self.extent(block);
        let k = self.index.k();
        self.planes.clear();
        let mut highest = (f64::NEG_INFINITY, 0);
        for &slot in &self.slots[list..] {
            let (height, gradient) = self.index.stored(slot).tangent(middle, k);
            if height > highest.0 {
                highest = (height, slot);
            }
            self.planes.push((height, gradient));
        }
        let corners = [half, -half, half * DVec2::new(-1.0, 1.0), half * DVec2::new(1.0, -1.0)];
        // The second term covers the way to the corners.
        let slack = self.index.rounding(middle) + self.index.rounding(half);
        let floors = corners.map(|corner| self.index.stored(highest.1).height(middle + corner, k) - slack);
        for (i, &(height, gradient)) in self.planes.iter().enumerate() {
            let (rise, twist) = (gradient.dot(half), gradient.dot(corners[3]));
            let planes = [height + rise, height - rise, height - twist, height + twist];
            if planes.iter().zip(floors).any(|(plane, floor)| *plane >= floor) {
                self.slots.push(self.slots[list + i]);
            }
        }
    }

    /// Fills a block with the greatest height of the listed segments.
    fn evaluate(&mut self, block: Block, list: usize) {
        for row in block.rows.0..block.rows.1 {
            for col in block.cols.0..block.cols.1 {
                let x = self.local(col, row);
                let heights = self.slots[list..].iter().map(|&slot| self.index.stored(slot).height(x, self.index.k()));
                let height = heights.fold(f64::NEG_INFINITY, f64::max);
                self.out[(row - self.from) * self.grid.ncols + col] = height;
            }
        }
    }

    /// Fills a block node by node from the index.
    fn query(&mut self, block: Block) {
        for row in block.rows.0..block.rows.1 {
            for col in block.cols.0..block.cols.1 {
                let (height, winner) = self.index.height(self.local(col, row), self.hint);
                self.hint = Some(winner);
                self.out[(row - self.from) * self.grid.ncols + col] = height;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sheet::testing::{Random, sets};

    #[test]
    fn blocks_change_no_bit() {
        let mut random = Random::new(9);
        for (k, segments) in sets(&mut random) {
            let index = Index::new(&segments, k);
            for cell in [1e-5, 0.02, 1.5, 300.0] {
                let near = segments[segments.len() / 2].a - 40.0 * cell;
                let grid = Grid { xll: near.x, yll: near.y, cell, ncols: 83, nrows: 70 };
                let found = rows(&index, &grid, DVec2::ZERO, 3..70);
                for (i, height) in found.iter().enumerate() {
                    let x = grid.node(i % 83, 3 + i / 83);
                    assert_eq!(*height, index.height(x, None).0, "{} segments, cell {cell}, at {x}", segments.len());
                }
            }
        }
    }
}
