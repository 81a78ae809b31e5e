//! Fuzz targets of slopegen. See docs/testing.md.

mod memory;
mod targets;

/// Runs a target on the bytes of a fuzzer.
///
/// # Panics
/// If there is none of that name, or if it finds something.
pub fn run(name: &str, bytes: &[u8]) {
    let target = targets::TARGETS.iter().find(|(known, _)| *known == name);
    if matches!(name, "engine" | "ground") {
        memory::allow_surfaces();
    }
    target.unwrap_or_else(|| panic!("there is no target `{name}`")).1(bytes);
}
