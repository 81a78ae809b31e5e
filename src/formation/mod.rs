//! The formation: what lies between the slopes. Centre lines are widened to roads, and lines inside rings are put in their place.

mod breaklines;
mod crossfall;
mod edge;
mod error;
mod nodes;
mod notes;
mod steps;
mod widen;

pub use breaklines::place;
pub use crossfall::{Crossfall, CrossfallError};
pub use edge::{LONGEST_MITRE, SHARPEST};
pub use error::FormationError;
pub use widen::widen;

use crate::model::{Line, Note};

/// The cross-section of a road.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Formation {
    /// Width from edge to edge, perpendicular to the centre line; positive, in the length unit.
    pub width: f64,
    /// How the edges lie against the centre line.
    pub crossfall: Crossfall,
    /// Where the outside of a sharp corner is rounded, chords lie within this distance of the arc.
    pub chord: f64,
}

/// A line with its roads, and what is worth knowing about them.
#[derive(Clone, Debug, PartialEq)]
pub struct Formed {
    /// The line: roads are rings.
    pub line: Line,
    /// What was done on the way.
    pub notes: Vec<Note>,
}
