//! geotiff.

use super::{RawGround, Said, refuse};

use crate::model::Note;
use crate::read::ReadError;

/// Reads ground.
pub(super) fn read(label: &str, _bytes: &[u8], _notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    Err(refuse("geotiff is not read", label, "", ""))
}
