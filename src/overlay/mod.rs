//! Two triangulated surfaces over each other: exact volumes over their common refinement.
//!
//! Every triangle of one mesh is laid over the other: from one place inside, a flood through the neighbours meets each triangle
//! that shares plan area with it, clips it, and never looks at the rest. So the cost follows the cells of the common refinement,
//! however uneven the meshes are. See `docs/theory.md`, "Between two meshes".

mod boxes;
mod cell;
mod fabric;
mod hilbert;
mod layers;
mod pieces;
mod tally;
pub mod volume;
mod walker;

pub use volume::{AREA_ROUNDING, Areas, Between, Depth, MOST_DOUBLE, OverlayError, SAME_HEIGHT, Surface, between, to_elevation};
