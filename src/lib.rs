//! Surfaces of constant slope through a 3D line, for earthworks.
//!
//! Data flows one way: **read → validate → sheet → slope → mesh → ground → write / plot / report**. Each module uses only those
//! that stand before it; `pipeline` alone knows the order. See `docs/architecture.md`.

pub mod cli;
pub mod formation;
pub mod ground;
pub mod kernel;
pub mod mesh;
pub mod model;
pub mod overlay;
pub mod pipeline;
pub mod plot;
pub mod read;
pub mod report;
pub mod selftest;
pub mod setout;
pub mod sheet;
pub mod slope;
pub mod surface;
pub mod terrain;
pub mod validate;
pub mod write;
