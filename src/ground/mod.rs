//! Existing ground and the design together: where the slopes meet the ground, the finished ground, cut and fill.

pub mod end_areas;
pub mod haul;
pub mod piece;
pub mod section_slope;
pub mod sections;
pub mod stations;
pub mod tally;

#[cfg(test)]
mod testing;

pub use end_areas::{CutFill, average_end_area, prismoidal};
pub use haul::{Haul, mass_haul};
pub use piece::{Axis, Corner, Piece};
pub use section_slope::{SectionSlope, section_slope};
pub use sections::{Section, SectionFigures, Sectioned, Sections};
pub use stations::{MOST_STATIONS, Stations, TooManyStations};
pub use tally::{Amounts, Deepest, Interval, Tallied, Tally};
