//! Reading existing ground.

use super::{Desk, Error, Observer, room, units, watch};
use crate::model::{LengthUnit, Terrain};
use crate::read::Source;
use crate::read::terrain::TerrainOptions;
use crate::terrain;
use std::path::Path;

/// Reads ground and makes it ready for use, in `unit` if there is one; what is worth knowing goes to `observer`.
///
/// # Errors
/// When the file cannot be read, or is no ground: see [`crate::read::terrain::read_terrain`] and [`terrain::prepare`].
pub fn read_ground(
    path: &Path,
    options: &TerrainOptions,
    unit: Option<LengthUnit>,
    observer: &dyn Observer,
) -> Result<(Terrain, Source), Error> {
    read_ground_at(Desk::Disk, path, options, unit, observer)
}

/// The same from wherever the file is.
pub(super) fn read_ground_at(
    desk: Desk<'_>,
    path: &Path,
    options: &TerrainOptions,
    unit: Option<LengthUnit>,
    observer: &dyn Observer,
) -> Result<(Terrain, Source), Error> {
    observer.stage(watch::READING_GROUND);
    let mut raw = desk.terrain(path, &TerrainOptions { memory: observer.memory(), ..options.clone() })?;
    if let Some(unit) = unit {
        let note = units::convert_ground(&mut raw, unit);
        raw.notes.extend(note);
    }
    let source = raw.source.clone();
    observer.stage(watch::PREPARING);
    room::for_preparing(&raw.ground, &source.label, &observer.memory())?;
    let prepared = terrain::prepare(raw)?;
    prepared.notes.iter().for_each(|note| observer.note(note));
    Ok((prepared.terrain, source))
}
