//! Exact heights of the sheet of the given line, nothing simplified, at points and on grids.

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{Grid, Index, Segment, raster};
use crate::kernel::frame::Frame;
use crate::model::{Line, Sheet, Slope};

/// Points handled together: enough to repay the start of a task, few enough to share among threads.
const BLOCK: usize = 1024;

/// The sheet of a line as a function of place.
#[derive(Clone, Debug)]
pub struct Heights {
    index: Index,
    frame: Frame,
    /// 1 for the falling sheet, −1 for the rising one, which is the falling sheet of the line mirrored in z.
    mirror: f64,
}

impl Heights {
    /// The sheet of the given kind through `line`.
    ///
    /// Where a part of the line lies buried under the sheet of another, the height is that of the other: the envelope of
    /// all. Precondition: every segment is flatter than the slope (see [`Segment::new`]), and the line has one.
    pub fn new(line: &Line, slope: Slope, sheet: Sheet) -> Self {
        let vertices = || line.chains.iter().flat_map(|chain| &chain.vertices).map(|v| v.truncate());
        let min = vertices().fold(DVec2::INFINITY, DVec2::min);
        let max = vertices().fold(DVec2::NEG_INFINITY, DVec2::max);
        let frame = Frame::around(min, max);
        let mirror = match sheet {
            Sheet::Falling => 1.0,
            Sheet::Rising => -1.0,
        };
        let place = |p: DVec3| frame.to_local(p) * DVec3::new(1.0, 1.0, mirror);
        let segments: Vec<Segment> = line
            .chains
            .iter()
            .flat_map(|chain| (0..chain.segment_count()).map(|i| chain.segment(i)))
            .map(|(a, b)| Segment::new(place(a), place(b), slope.ratio()))
            .collect();
        Self { index: Index::new(&segments, slope.ratio()), frame, mirror }
    }

    /// Height at a point in world coordinates. Error: see [`Segment::height`].
    pub fn at(&self, world: DVec2) -> f64 {
        self.mirror * self.index.height(world - self.frame.origin(), None).0
    }

    /// Heights at points in world coordinates, in their order; the same figures as [`Self::at`]. Fastest where neighbours in
    /// the list are neighbours in plan. Runs on all threads.
    pub fn many(&self, points: &[DVec2]) -> Vec<f64> {
        let blocks = points.par_chunks(BLOCK).flat_map_iter(|block| {
            let mut hint = None;
            block.iter().map(move |&world| {
                let (height, segment) = self.index.height(world - self.frame.origin(), hint);
                hint = Some(segment);
                self.mirror * height
            })
        });
        blocks.collect()
    }

    /// Heights at the nodes of a grid, row by row from the south-west; the same figures as [`Self::at`]. Runs on all threads.
    pub fn raster(&self, grid: &Grid) -> Vec<f64> {
        let mut heights = raster::raster(&self.index, &grid.shifted(-self.frame.origin()));
        for height in &mut heights {
            *height *= self.mirror;
        }
        heights
    }
}
