//! ESRI ASCII grid.

use super::{RawGround, Said, refuse};
use crate::model::Note;
use crate::read::ReadError;

pub(super) fn read(label: &str, _bytes: &[u8], _notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    Err(refuse("ESRI ASCII grids are not read yet", label, "format: asc", "convert it to points"))
}
