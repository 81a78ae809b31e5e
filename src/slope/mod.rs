//! The surface of constant slope: network, facets, trimming, closure, emission.

pub mod arcs;
pub mod closure;
pub mod facet;
pub mod fan;
pub mod network;
pub mod simplify;
pub mod trim;
