//! Triangles as such: filling regions between edges, checking a mesh, measuring it.

pub mod check;
pub mod drape;
pub mod fingerprint;
pub mod inside;
pub(crate) mod neighbours;
pub mod polygon;
pub mod quality;
pub mod raster;
pub mod region;
pub mod strip;
pub mod volume;
