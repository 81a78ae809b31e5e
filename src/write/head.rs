//! What files hold beside the mesh and the lines themselves.

use super::EncodeError;
use crate::model::{LengthUnit, LineFeature};
use glam::DVec3;
use std::borrow::Cow;

/// What the head of a file tells; each format takes what it can hold. [`Default`] is a nameless thing in metres.
#[derive(Clone, Copy, Debug, Default)]
pub struct Head<'a> {
    /// Coordinate reference system, as the input names it.
    pub crs: Option<&'a str>,
    /// Unit of all lengths.
    pub unit: LengthUnit,
    /// Name of the surface.
    pub name: &'a str,
    /// Line work that belongs to the mesh, in world coordinates.
    pub lines: &'a [LineFeature],
    /// Cut and fill against existing ground, where they are known.
    pub earthworks: Option<Earthworks<'a>>,
    /// Point that formats for viewers count coordinates from. `None`: zero, or the [`super::origin::around`] of the mesh where
    /// the format holds no doubles.
    pub origin: Option<DVec3>,
    /// Height over existing ground of each vertex, negative in cut, NaN where it is not known.
    pub depths: Option<&'a [f64]>,
}

/// Cut and fill between existing ground and a design, not negative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Earthworks<'a> {
    /// Name of the existing ground.
    pub ground: &'a str,
    /// Volume to be dug away.
    pub cut: f64,
    /// Volume to be brought.
    pub fill: f64,
}

/// Text from an input on one line: whatever would end a line, or is no character of XML, becomes a blank.
pub(super) fn plain(text: &str) -> Cow<'_, str> {
    let breaks = |c: char| c.is_control() || matches!(c, '\u{2028}' | '\u{2029}' | '\u{FFFE}' | '\u{FFFF}');
    if text.contains(breaks) { Cow::Owned(text.replace(breaks, " ")) } else { Cow::Borrowed(text) }
}

/// A number proved finite; `what` and `index` (counted from 1) say in the error what carries it.
pub(super) fn finite(value: f64, what: &'static str, index: usize) -> Result<f64, EncodeError> {
    if value.is_finite() { Ok(value) } else { Err(EncodeError::NotFinite { what, index, value }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stay_on_their_line() {
        assert_eq!(plain("EPSG:25832"), "EPSG:25832");
        assert_eq!(plain("a\r\nv 1 2 3\u{85}b\u{2028}\0\u{FFFF}"), "a  v 1 2 3 b   ");
    }
}
