//! Setting out: what a crew needs to build the design.

mod hinge;
mod stake;

pub use stake::{Along, Ends, Hand, Lie, Slopes, Stake, stakes};
