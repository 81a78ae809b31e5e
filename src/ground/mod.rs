//! Existing ground and the design together: where the slopes meet the ground, the finished ground, cut and fill.

pub mod piece;

pub use piece::{Axis, Corner, Piece};
