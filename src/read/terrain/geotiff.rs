//! GeoTIFF elevation models: classic and BigTIFF, strips and tiles, band 1.
//!
//! Read by own code down to the compressions: every size in the file is checked against the bytes that are there before room
//! is made for it, and nothing is unpacked beyond what the image needs.

use super::{RawGround, Said};
use crate::model::{Memory, Note};
use crate::read::ReadError;
#[cfg(not(feature = "geotiff"))]
use crate::read::error::refuse;

#[cfg(feature = "geotiff")]
mod directory;
#[cfg(feature = "geotiff")]
mod grid;
#[cfg(feature = "geotiff")]
mod image;
#[cfg(feature = "geotiff")]
mod metadata;
#[cfg(feature = "geotiff")]
mod place;
#[cfg(feature = "geotiff")]
mod unpack;

/// Reads ground.
#[cfg(feature = "geotiff")]
pub(super) fn read(label: &str, bytes: &[u8], memory: &Memory, notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    grid::read(label, bytes, memory, notes)
}

/// Refuses: the reader was left out.
#[cfg(not(feature = "geotiff"))]
pub(super) fn read(label: &str, _: &[u8], _: &Memory, _: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let help = format!("use a program with it, or convert the file, e.g. `gdal_translate -of AAIGrid {label} ground.asc`");
    Err(refuse("this program was built without GeoTIFF", label, "format: geotiff", &help))
}
