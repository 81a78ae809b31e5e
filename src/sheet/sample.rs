//! Exact heights of the sheet of the given line, nothing simplified, at points and on grids.

use std::ops::Range;

use glam::{DVec2, DVec3};
use rayon::prelude::*;

use super::{Grid, Index, Segment, raster};
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
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
        let PlanBox { lo, hi } = line.plan_box();
        let frame = Frame::around(lo, hi);
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

    /// Heights at all nodes of a grid, row by row from the north, each from west to east: the order of an ESRI raster. The
    /// same figures as [`Self::at`]. Runs on all threads.
    pub fn raster(&self, grid: &Grid) -> Vec<f64> {
        self.rows(grid, 0..grid.nrows)
    }

    /// Heights at the nodes of some rows of a grid, counted from the north: a large raster can be written in bands.
    pub fn rows(&self, grid: &Grid, rows: Range<usize>) -> Vec<f64> {
        let mut heights = raster::rows(&self.index, grid, self.frame.origin(), rows);
        for height in &mut heights {
            *height *= self.mirror;
        }
        heights
    }
}

#[cfg(test)]
mod tests {
    use std::f64::consts::TAU;

    use super::*;
    use crate::model::{Chain, Place, Role};
    use crate::sheet::testing::Random;

    fn chain(role: Role, vertices: Vec<DVec3>) -> Chain {
        Chain { name: "line".into(), role, places: vec![Place::default(); vertices.len()], vertices, axis: None }
    }

    /// A wavy ring and a road across it (so that stretches lie buried), far from the origin.
    fn ring_and_road(random: &mut Random, count: u32) -> Line {
        let far = DVec3::new(500_000.0, 5_000_000.0, 100.0);
        let mut ring = Vec::new();
        for i in 0..count {
            let w = TAU * f64::from(i) / f64::from(count);
            let p = ((100.0 + 20.0 * (3.0 * w).sin()) * DVec2::from_angle(w)).extend(3.0 * (2.0 * w).sin());
            let noise = DVec3::new(random.between(-0.02, 0.02), random.between(-0.02, 0.02), random.between(-0.02, 0.02));
            ring.push(far + p + if count > 1000 { 0.1 } else { 1.0 } * noise);
        }
        let mut road = Vec::new();
        for i in 0..60 {
            road.push(far + DVec3::new(5.0 * f64::from(i) - 150.0, random.between(-2.0, 2.0), 0.02 * f64::from(i)));
        }
        Line { chains: vec![chain(Role::Outer { polygon: 0 }, ring), chain(Role::Open, road)], ..Line::default() }
    }

    /// The definition with no index and no frame: the best of 200 points of each segment. Too low by `k` times a hundredth
    /// of the segment at most.
    fn sampled(line: &Line, k: f64, x: DVec2) -> f64 {
        let mut best = f64::NEG_INFINITY;
        for chain in &line.chains {
            for (a, b) in (0..chain.segment_count()).map(|i| chain.segment(i)) {
                for j in 0..=200 {
                    let p = a.lerp(b, f64::from(j) / 200.0);
                    best = best.max(p.z - k * p.truncate().distance(x));
                }
            }
        }
        best
    }

    fn mirrored(line: &Line) -> Line {
        let mut line = line.clone();
        line.chains.iter_mut().flat_map(|chain| &mut chain.vertices).for_each(|v| v.z = -v.z);
        line
    }

    #[test]
    fn follows_the_definition_and_mirrors() {
        let mut random = Random::new(11);
        let line = ring_and_road(&mut random, 120);
        let slope = Slope::from_ratio(0.5).expect("positive");
        let falling = Heights::new(&line, slope, Sheet::Falling);
        let rising = Heights::new(&mirrored(&line), slope, Sheet::Rising);
        for _ in 0..100 {
            let x = DVec2::new(500_000.0 + random.between(-200.0, 200.0), 5_000_000.0 + random.between(-200.0, 200.0));
            let (found, sampled) = (falling.at(x), sampled(&line, 0.5, x));
            assert!(found >= sampled - 1e-9 && found <= sampled + 0.5 * 7.0 / 200.0, "{found} for {sampled} at {x}");
            assert_eq!(rising.at(x), -found);
        }
        // On the line of the upper road the sheet is the road; a pit's rising sheet is above its rim everywhere outside.
        let v = line.chains[1].vertices[59];
        assert!((falling.at(v.truncate()) - v.z).abs() <= 1e-12);
    }

    #[test]
    fn many_and_raster_give_the_same_bits_on_any_number_of_threads() {
        let mut random = Random::new(12);
        for (count, cell) in [(40, 3.0), (3000, 3.0), (3000, 0.01), (500, 5000.0), (3, 7.0)] {
            let line = ring_and_road(&mut random, count);
            let heights = Heights::new(&line, Slope::from_ratio(0.7).expect("positive"), Sheet::Rising);
            let grid = Grid { xll: 499_873.3, yll: 4_999_900.1, cell, ncols: 77, nrows: 45 };
            let points: Vec<DVec2> = (0..grid.nrows).flat_map(|r| (0..grid.ncols).map(move |c| grid.node(c, r))).collect();
            let expected: Vec<f64> = points.iter().map(|&x| heights.at(x)).collect();
            for threads in [1, 2, 3] {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
                pool.install(|| {
                    assert_eq!(heights.many(&points), expected);
                    assert_eq!(heights.raster(&grid), expected);
                    assert_eq!(heights.rows(&grid, 5..41), expected[5 * 77..41 * 77]);
                });
            }
        }
    }

    #[test]
    fn grid_counts_rows_from_the_north() {
        let grid = Grid { xll: 10.0, yll: 20.0, cell: 2.0, ncols: 3, nrows: 4 };
        assert_eq!(grid.node(0, 3), DVec2::new(10.0, 20.0));
        assert_eq!(grid.node(2, 0), DVec2::new(14.0, 26.0));
        let line = Line {
            chains: vec![chain(Role::Open, vec![DVec3::new(0.0, 26.0, 1.0), DVec3::new(10.0, 26.0, 1.0)])],
            ..Line::default()
        };
        let heights = Heights::new(&line, Slope::from_ratio(0.5).expect("positive"), Sheet::Falling).raster(&grid);
        // The first row lies along the line, the last six off it: 1 − 6/2; the columns stand 0, 2 and 4 beyond its end.
        assert_eq!(heights[..3], [1.0, 0.0, -1.0]);
        assert_eq!(heights[9], -2.0);
        assert_eq!(heights.len(), 12);
        assert!(
            Heights::new(&line, Slope::from_ratio(0.5).expect("positive"), Sheet::Falling)
                .raster(&Grid { ncols: 0, ..grid })
                .is_empty()
        );
    }
}
