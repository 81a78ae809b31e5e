//! The sheet as a function of place: closed form of one segment, an index over many, heights at points and on grids.
//!
//! Everything here speaks of the falling sheet, the upper envelope of the segments' cones; for the rising one the line is
//! mirrored in z by the caller ([`Heights`] does it itself).

mod focus;
pub mod index;
mod node;
pub mod raster;
pub mod sample;
pub mod segment;
#[cfg(test)]
mod testing;

pub use index::Index;
pub use raster::Grid;
pub use sample::Heights;
pub use segment::{Ruling, Segment};
