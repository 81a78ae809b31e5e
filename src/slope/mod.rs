//! The surface of constant slope: network, facets, trimming, closure, emission.

pub mod arcs;
pub mod closure;
pub mod emit;
pub mod facet;
pub mod fan;
pub mod levels;
pub mod network;
pub mod polygon;
pub mod refine;
pub mod simplify;
pub mod trim;
