//! Fuzz targets of slopegen. See docs/testing.md.

mod memory;
mod targets;

/// Runs a target on the bytes of a fuzzer.
pub fn run(name: &str, bytes: &[u8]) {
    targets::run(name, bytes);
}
