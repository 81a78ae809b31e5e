//! The same input gives the same bytes: on any number of threads, however often, and in whatever order the file has its lines.

#[path = "../common/mod.rs"]
mod common;

mod order;
mod threads;
