//! Numbers only: local frame, sums, higher precision, orientation, boxes and trees of them, buckets.

pub mod box_tree;
pub mod buckets;
pub mod dd;
pub mod frame;
pub mod hash;
pub mod orientation;
pub mod plan_box;
pub mod range;
pub mod ring_index;
pub mod segment;
pub mod segment_tree;
pub mod sum;
#[cfg(test)]
pub(crate) mod testing;
mod tree;
pub mod union;
