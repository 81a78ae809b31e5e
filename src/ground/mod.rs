//! Existing ground and the design together: where the slopes meet the ground, the finished ground, cut and fill.

mod build;
mod cell;
mod certificate;
mod clip;
pub mod depths;
pub mod end_areas;
mod error;
mod feeder;
mod figures;
mod finished;
mod found;
pub mod haul;
mod nodes;
mod open_ends;
mod patch;
mod patchwork;
pub mod piece;
mod reach;
pub mod section_slope;
pub mod sections;
mod shape;
pub mod stations;
pub mod tally;
mod thinned;
mod trimmed;
mod uncovered;
mod works;

#[cfg(test)]
mod testing;

pub use build::{Options, Site};
pub use depths::depths;
pub use end_areas::{CutFill, average_end_area, prismoidal};
pub use error::GroundError;
pub use figures::{Daylight, Ground};
pub use haul::{Haul, mass_haul};
pub use piece::{Axis, Corner, Piece, Pieces};
pub use section_slope::{SectionSlope, section_slope};
pub use sections::{Section, SectionFigures, Sectioned, Sections, sections_at};
pub use stations::{MOST_STATIONS, Spot, Stations, TooManyStations, axes, place};
pub use tally::{Amounts, Deepest, Interval, Tallied, Tally};
