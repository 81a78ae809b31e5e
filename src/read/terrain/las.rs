//! LAS and LAZ point clouds: versions 1.0 to 1.4, point formats 0 to 10.
//!
//! Header, records and reference system are read by own code, which looks at nothing but places and classes; chunks of LAZ
//! files are unpacked by the package `laz`.

use super::{RawGround, Said};
use crate::model::{Memory, Note};
use crate::read::{Pick, ReadError};

#[cfg(feature = "las")]
mod cloud;
#[cfg(feature = "las")]
mod guard;
#[cfg(feature = "las")]
mod header;
#[cfg(feature = "las")]
mod packed;
#[cfg(feature = "las")]
mod wkt;

/// What is asked for, and how much memory that may take.
type Asked<'a> = (&'a Pick, &'a Memory);

/// Reads ground.
#[cfg(feature = "las")]
pub(super) fn read(label: &str, bytes: &[u8], asked: Asked<'_>, notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    cloud::read(label, bytes, asked, notes)
}

/// Refuses: the reader was left out.
#[cfg(not(feature = "las"))]
pub(super) fn read(label: &str, _: &[u8], _: Asked<'_>, _: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let help = format!("use a program with it, or write the ground points as text, e.g. `pdal translate {label} ground.csv`");
    Err(crate::read::error::refuse("this program was built without LAS and LAZ", label, "format: las", &help))
}
