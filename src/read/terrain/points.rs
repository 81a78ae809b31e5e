//! Points as rows of text.

use super::{RawGround, Said, refuse};
use crate::model::Note;
use crate::read::{ColumnOrder, ReadError};

pub(super) fn read(
    label: &str,
    _bytes: &[u8],
    _order: Option<&ColumnOrder>,
    _by_name: Option<&ColumnOrder>,
    _notes: &mut Vec<Note>,
) -> Result<(RawGround, Said), ReadError> {
    Err(refuse("points are not read yet", label, "format: csv", "convert them"))
}
