//! Triangles as such: filling regions between edges, checking a mesh, measuring it.

pub mod check;
pub mod polygon;
pub mod region;
pub mod volume;
