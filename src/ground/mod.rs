//! Existing ground and the design together: where the slopes meet the ground, the finished ground, cut and fill.

mod build;
mod cell;
mod error;
mod figures;
mod finished;
mod nodes;
mod patch;
pub mod piece;
mod reach;
mod shape;
pub mod stations;
pub mod tally;
mod trimmed;
mod works;

#[cfg(test)]
mod testing;

pub use build::{Options, Site};
pub use error::GroundError;
pub use figures::{Daylight, Ground};
pub use piece::{Axis, Corner, Piece};
pub use stations::{MOST_STATIONS, Stations, TooManyStations};
pub use tally::{Amounts, Deepest, Interval, Tallied, Tally};
