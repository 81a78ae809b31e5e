//! How much memory the engine takes, told before it takes it.
//!
//! The factors were measured and rounded up: see "Memory" in `docs/performance.md`.

use crate::model::{Line, Memory, Need, TooLarge};

/// Of a vertex of the line: as read, in the network, its facets and their boundaries.
const PER_VERTEX: u64 = 480;

/// Of a triangle: its cell, the mesh, its edges for the checks, line work.
const PER_TRIANGLE: u64 = 165;

/// Whether there is room for the facets of a line.
pub(super) fn for_line(line: &Line, memory: &Memory) -> Result<(), TooLarge> {
    let count = vertices(line);
    memory.room(PER_VERTEX * count, || {
        let help = "split the line, or simplify it";
        Need { what: "build the surface", at: String::new(), figures: format!("{count} vertices of the line"), help }
    })
}

/// Whether there is room for so many triangles.
pub(super) fn for_mesh(line: &Line, triangles: u64, memory: &Memory) -> Result<(), TooLarge> {
    memory.room(PER_VERTEX * vertices(line) + PER_TRIANGLE * triangles, || {
        let help = "raise `--interval` or `--tolerance`, end the slopes sooner, or split the line";
        Need { what: "build the surface", at: String::new(), figures: format!("{triangles} triangles or more"), help }
    })
}

fn vertices(line: &Line) -> u64 {
    line.chains.iter().map(|chain| chain.vertices.len() as u64).sum()
}
