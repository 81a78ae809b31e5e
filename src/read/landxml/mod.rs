//! LandXML.

use super::terrain::{RawGround, Said, refuse};
use super::{Pick, RawLine, ReadError, ReadOptions, Source};
use crate::model::Note;

/// Lines of a LandXML file.
pub(super) fn lines(
    _bytes: &[u8],
    source: &mut Source,
    _options: &ReadOptions,
    _notes: &mut Vec<Note>,
) -> Result<Vec<RawLine>, ReadError> {
    Err(refuse("LandXML is not read", source.label.clone(), "", ""))
}

/// Ground of a LandXML file.
pub(super) fn ground(label: &str, _bytes: &[u8], _pick: &Pick, _notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    Err(refuse("LandXML is not read", label, "", ""))
}
