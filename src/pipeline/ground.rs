//! Reading existing ground.

use super::{Error, Observer, watch};
use crate::model::Terrain;
use crate::read::Source;
use crate::read::terrain::{TerrainOptions, read_terrain};
use crate::terrain;
use std::path::Path;

/// Reads ground and makes it ready for use; what is worth knowing goes to `observer`.
///
/// # Errors
/// When the file cannot be read, or is no ground: see [`read_terrain`] and [`terrain::prepare`].
pub fn read_ground(path: &Path, options: &TerrainOptions, observer: &dyn Observer) -> Result<(Terrain, Source), Error> {
    observer.stage(watch::READING_GROUND);
    let raw = read_terrain(path, options)?;
    let source = raw.source.clone();
    observer.stage(watch::PREPARING);
    let prepared = terrain::prepare(raw)?;
    prepared.notes.iter().for_each(|note| observer.note(note));
    Ok((prepared.terrain, source))
}
