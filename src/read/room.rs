//! How much memory reading a file takes, told before it is taken.
//!
//! The factors were measured: see "Memory" in `docs/performance.md`.

use super::{InputFormat, ReadError};
use crate::model::{Memory, Need, TooLarge};
use memchr::memchr_iter;
use std::path::Path;

/// What a smaller input is.
const SMALLER: &str = "cut out the part around the works";

/// Reads a whole file, if there is room for it.
pub(super) fn load(label: &str, path: &Path, memory: &Memory) -> Result<Vec<u8>, ReadError> {
    let open = |cause| ReadError::Open { label: label.to_owned(), cause };
    let metadata = std::fs::metadata(path).map_err(open)?;
    memory.room(metadata.len(), || need(label, metadata.len()))?;
    std::fs::read(path).map_err(open)
}

/// Whether there is room for what a file of `bytes` becomes while it is read.
pub(super) fn for_content(label: &str, format: InputFormat, bytes: &[u8], memory: &Memory) -> Result<(), TooLarge> {
    if memory.limit().is_none() {
        return Ok(());
    }
    let length = bytes.len() as u64;
    let content = content(format, bytes);
    memory.room(length + content, || match format {
        InputFormat::Obj => Need {
            help: "write it as `.ply`, which takes half of that, or cut out the part around the works",
            ..need(label, length)
        },
        InputFormat::Dxf => Need {
            help: "write it as `.ply` or LandXML, which take a third of that, or cut out the part around the works",
            ..need(label, length)
        },
        _ => need(label, length),
    })
}

/// Whether there is room for the cells of a raster that is unpacked.
#[cfg(feature = "geotiff")]
pub(super) fn for_cells(label: &str, bytes: usize, cells: u64, memory: &Memory) -> Result<(), TooLarge> {
    /// A double, and a share of what is being unpacked.
    const PER_CELL: u64 = 9;
    let figures = format!("{cells} cells");
    memory.room(bytes as u64 + PER_CELL * cells, || Need { figures, ..need(label, 0) })
}

/// Whether there is room for points taken out of a cloud.
#[cfg(feature = "las")]
pub(super) fn for_points(label: &str, bytes: usize, points: u64, memory: &Memory) -> Result<(), TooLarge> {
    /// Three doubles in its stretch of the file, and in the whole.
    const PER_POINT: u64 = 48;
    let figures = format!("up to {points} points");
    let help = "cut out the part around the works, or thin the points, e.g. with `pdal translate`";
    memory.room((bytes as u64).saturating_add(PER_POINT.saturating_mul(points)), || Need { figures, help, ..need(label, 0) })
}

fn need(label: &str, bytes: u64) -> Need {
    Need { what: "read the file", at: label.to_owned(), figures: format!("its {:.1} MB", bytes as f64 / 1e6), help: SMALLER }
}

/// Bytes beside those of the file.
fn content(format: InputFormat, bytes: &[u8]) -> u64 {
    let count = |byte: u8| memchr_iter(byte, bytes).count() as u64;
    match format {
        // Coordinates in doubles, corners in 32 bits; files of single precision grow most.
        InputFormat::Ply => 13 * bytes.len() as u64 / 10,
        // A vertex or a triangle, each a line, in its stretch of the file and in the whole.
        InputFormat::Obj => 40 * count(b'\n'),
        // A face has 28 lines.
        InputFormat::Dxf => 3 * count(b'\n'),
        InputFormat::LandXml => 12 * count(b'<'),
        // A height for each number.
        InputFormat::Asc => 8 * (count(b' ') + count(b'\n')),
        InputFormat::Csv => 48 * count(b'\n'),
        InputFormat::GeoJson => 100 * count(b'['),
        // Told by their heads, or by what is found.
        InputFormat::GeoTiff | InputFormat::Las | InputFormat::Gpx => 0,
    }
}
