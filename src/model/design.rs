//! What is to be built on the line.

use super::Slope;
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
}
