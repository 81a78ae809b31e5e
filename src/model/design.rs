//! What is to be built on the line.

use super::{Line, Slope};
use crate::kernel::frame::Frame;

/// Which of the two sheets through the line.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Sheet {
    /// Falls away from the line (fill, embankment): `f⁻`, upper envelope of cones.
    Falling,
    /// Rises away from the line (cut, excavation): `f⁺`, lower envelope of cones.
    Rising,
}

/// On which side of the line the slope is wanted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// Left of an open line, in the order of its vertices; left of a ring in the order given.
    Left,
    /// Right likewise.
    Right,
    /// Both.
    Both,
    /// Inside the polygon a ring bounds.
    Inside,
    /// Outside the polygon a ring bounds.
    Outside,
}

/// Where the slope ends away from the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Extent {
    /// At an absolute elevation.
    Elevation(f64),
    /// At a height difference from the foot point on the line; positive.
    Height(f64),
    /// At a plan distance from the foot point on the line, along the ruling; positive.
    Distance(f64),
}

/// Everything the engine needs to know beside the line.
#[derive(Clone, Debug, PartialEq)]
pub struct Design {
    /// The side slope.
    pub slope: Slope,
    /// Falling or rising.
    pub sheet: Sheet,
    /// Where wanted, for open lines.
    pub side_of_lines: Side,
    /// Where wanted, for rings.
    pub side_of_rings: Side,
    /// Where the slope ends.
    pub extent: Extent,
    /// Spacing of the level curves; levels are its whole multiples. `None`: a round number that gives 10 to 25 levels, or none
    /// beside those of `levels`.
    pub interval: Option<f64>,
    /// Elevations of further level curves, in any order.
    pub levels: Vec<f64>,
    /// Bound for the height error of the whole mesh against the given line, in the length unit.
    pub tolerance: f64,
    /// The slope of another surface through the same line that is to share every point of it: the line is then simplified
    /// for both alike.
    pub companion: Option<Slope>,
    /// The local frame to work in; `None`: one chosen for the line.
    pub frame: Option<Frame>,
    /// Whether the line's heights are moved a little, so that parts of it that just touch no longer do.
    pub joggle: Option<Joggle>,
}

impl Design {
    /// Whether slopes are wanted inside rings alone: a pit or a mound, with a floor.
    pub fn only_inside(&self, line: &Line) -> bool {
        self.side_of_rings == Side::Inside && line.chains.iter().all(|c| c.closed())
    }

    /// Whether open lines have slopes on one of their sides alone.
    pub fn one_sided(&self, line: &Line) -> bool {
        self.side_of_lines != Side::Both && line.chains.iter().any(|c| !c.closed())
    }

    /// The tightest of the tolerances of designs; infinite for none.
    pub fn least_tolerance(designs: &[Self]) -> f64 {
        designs.iter().map(|design| design.tolerance).fold(f64::INFINITY, f64::min)
    }
}

/// Small shifts of the line's vertices in height, each of its own but the same in every run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Joggle {
    /// The greatest shift, up or down (length units).
    pub most: f64,
    /// Which of many sets of shifts.
    pub set: u64,
}

impl Joggle {
    /// The shift of a vertex at a place, between `-most` and `most`: a hash of its bits, so it depends on nothing else.
    pub fn shift(self, x: f64, y: f64) -> f64 {
        let mut hash = self.set;
        for bits in [x.to_bits(), y.to_bits()] {
            // The finalizer of SplitMix64 (Steele, Lea, Flood 2014, "Fast splittable pseudorandom number generators").
            hash = (hash ^ bits).wrapping_add(0x9e37_79b9_7f4a_7c15);
            hash = (hash ^ (hash >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            hash = (hash ^ (hash >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            hash ^= hash >> 31;
        }
        // 53 bits, as many as a double holds.
        let unit = (hash >> 11) as f64 / (1_u64 << 53) as f64;
        self.most * (2.0 * unit - 1.0)
    }
}
