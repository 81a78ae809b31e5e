//! The surface of constant slope: network, facets, trimming, closure, emission.

pub mod arcs;
mod canonical;
pub mod clear;
pub mod closure;
pub mod cover;
pub mod emit;
pub mod facet;
pub mod fan;
mod junction;
pub mod levels;
pub mod network;
mod noding;
mod pieces;
pub mod polygon;
pub mod refine;
mod runs;
pub mod simplify;
pub mod size;
pub mod trim;
