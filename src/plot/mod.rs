//! Drawings of a design: plan, profile, cross-sections, mass haul.

mod scene;

pub use scene::{OnGround, Scene};
