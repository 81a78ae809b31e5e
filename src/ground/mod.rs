//! Existing ground and the design together: where the slopes meet the ground, the finished ground, cut and fill.

pub mod piece;
pub mod stations;
pub mod tally;

#[cfg(test)]
mod testing;

pub use piece::{Axis, Corner, Piece};
pub use stations::{MOST_STATIONS, Stations, TooManyStations};
pub use tally::{Amounts, Deepest, Interval, Tallied, Tally};
