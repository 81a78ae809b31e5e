//! Numbers only: local frame, sums, higher precision, orientation.

pub mod box_tree;
pub mod dd;
pub mod frame;
pub mod orientation;
pub mod segment_tree;
pub mod sum;
