//! Heights on a grid: blocks of nodes share a short list of segments.
//!
//! All sheets fall by at most `k` per distance. So a segment that is more than `2kρ` below the sheet at the middle of a
//! block of half diagonal `ρ` is nowhere the highest in it, and neither in a part of the block. The list for a block is
//! thinned out from that of the block around it, down to a few nodes.

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
const BLOCK: usize = 32;
/// A query of the index costs about as much as this many heights of segments: lists longer than that per node do not pay.
const QUERY: usize = 64;
/// A list of this length is not thinned out any further, nor for a block of this many nodes.
const SHORT: usize = 4;

/// The longest list for a block of `nodes`: each of its segments is tried at all of them, or at the middles of four quarters.
fn longest(nodes: usize) -> usize {
    QUERY * nodes / nodes.clamp(1, 4)
}

/// Heights of the falling sheet at the nodes of some rows of a grid, row by row, each from west to east. `origin` is what
/// the index's local frame takes off the grid's coordinates. Exactly [`Index::height`] at each node.
pub(super) fn rows(index: &Index, grid: &Grid, origin: DVec2, rows: Range<usize>) -> Vec<f64> {
    let mut heights = vec![0.0; grid.ncols * rows.len()];
    heights.par_chunks_mut((BLOCK * grid.ncols).max(1)).enumerate().for_each(|(band, out)| {
        let from = rows.start + band * BLOCK;
        let count = out.len() / grid.ncols;
        let mut band = Band { index, grid, origin, from, out, slots: Vec::new(), heights: Vec::new(), hint: None };
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
    heights: Vec<f64>,
    hint: Option<u32>,
}

impl Band<'_> {
    fn local(&self, col: usize, row: usize) -> DVec2 {
        self.grid.node(col, row) - self.origin
    }

    /// Middle and half diagonal of a block.
    fn disc(&self, block: Block) -> (DVec2, f64) {
        let first = self.local(block.cols.0, block.rows.0);
        let last = self.local(block.cols.1 - 1, block.rows.1 - 1);
        (0.5 * (first + last), 0.5 * first.distance(last))
    }

    /// Fills a block from the index.
    fn start(&mut self, block: Block) {
        let (middle, radius) = self.disc(block);
        let (height, winner) = self.index.height(middle, self.hint);
        self.hint = Some(winner);
        self.slots.clear();
        let floor = height - 2.0 * self.index.k() * radius;
        let (most, slots) = (longest(block.nodes()), &mut self.slots);
        self.index.visit_slots_above(middle, floor, |slot| {
            slots.push(slot);
            slots.len() <= most
        });
        self.fill(block, 0);
    }

    /// Fills a block whose segments are `slots[list..]`.
    fn fill(&mut self, block: Block, list: usize) {
        let (end, nodes) = (self.slots.len(), block.nodes());
        let length = end - list;
        if length > longest(nodes) {
            return self.query(block);
        }
        if length <= SHORT || nodes <= SHORT {
            return self.evaluate(block, list);
        }
        for quarter in block.quarters().into_iter().filter(|quarter| quarter.nodes() > 0) {
            let (middle, radius) = self.disc(quarter);
            self.heights.clear();
            let heights = self.slots[list..].iter().map(|&slot| self.index.height_of_slot(slot, middle));
            self.heights.extend(heights);
            let top = self.heights.iter().fold(f64::NEG_INFINITY, |top, &h| top.max(h));
            let floor = top - 2.0 * self.index.k() * radius - self.index.rounding(middle);
            for i in 0..length {
                if self.heights[i] >= floor {
                    self.slots.push(self.slots[list + i]);
                }
            }
            self.fill(quarter, end);
            self.slots.truncate(end);
        }
    }

    /// Fills a block with the greatest height of the listed segments.
    fn evaluate(&mut self, block: Block, list: usize) {
        for row in block.rows.0..block.rows.1 {
            for col in block.cols.0..block.cols.1 {
                let x = self.local(col, row);
                let heights = self.slots[list..].iter().map(|&slot| self.index.height_of_slot(slot, x));
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
