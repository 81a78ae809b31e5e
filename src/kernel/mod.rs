//! Numbers only: local frame, sums, higher precision, orientation.

pub mod frame;
pub mod sum;
