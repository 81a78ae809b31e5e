//! Surfaces whose figures are known in closed form. Every expected value is a formula, with its derivation beside it.
//!
//! Where cone sectors are part of a surface the mesh has chords: vertices on the cone, triangles below it (falling). Figures
//! are then one-sided, and short of the formula by no more than the error bound that is reported. Without cones they are exact.
//!
//! `n = 1/k` is the run per unit of rise; a figure holds for both sheets, the rising one seen in the mirror.

#[path = "../common/mod.rs"]
mod common;

mod buried;
mod extents;
mod profiles;
mod rings;
mod sides;
mod ties;
