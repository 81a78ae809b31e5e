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

/// The code of a reference system named after the EPSG register: `EPSG:25832`, `urn:ogc:def:crs:EPSG::25832`,
/// `http://www.opengis.net/def/crs/EPSG/0/25832`.
pub(super) fn epsg(crs: &str) -> Option<&str> {
    let upper = crs.trim().to_ascii_uppercase();
    let named =
        ["EPSG:", "URN:OGC:DEF:CRS:EPSG:", "HTTP://WWW.OPENGIS.NET/DEF/CRS/EPSG/", "HTTPS://WWW.OPENGIS.NET/DEF/CRS/EPSG/"];
    let code = crs.trim().rsplit([':', '/']).next().unwrap_or("");
    let fits = named.iter().any(|prefix| upper.starts_with(prefix));
    (fits && !code.is_empty() && code.bytes().all(|b| b.is_ascii_digit())).then_some(code)
}

/// Whether a reference system is given as well-known text (WKT).
pub(super) fn is_wkt(crs: &str) -> bool {
    const KEYWORDS: [&str; 8] = ["PROJC", "GEOGC", "GEODC", "COMPD_CS", "COMPOUNDCRS", "BOUNDCRS", "LOCAL_CS", "ENGCRS"];
    let upper = crs.trim_start().to_ascii_uppercase();
    upper.contains('[') && KEYWORDS.iter().any(|keyword| upper.starts_with(keyword))
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

    #[test]
    fn codes_of_the_register() {
        for crs in [
            "EPSG:25832",
            " epsg:25832",
            "urn:ogc:def:crs:EPSG::25832",
            "urn:ogc:def:crs:EPSG:9.8.1:25832",
            "http://www.opengis.net/def/crs/EPSG/0/25832",
        ] {
            assert_eq!(epsg(crs), Some("25832"), "{crs}");
        }
        for crs in ["", "EPSG:", "EPSG:25832+7837", "EPSG:25832;", "ESRI:102100", "UTM 32", "EPSG:abc"] {
            assert_eq!(epsg(crs), None, "{crs}");
        }
    }

    #[test]
    fn well_known_text_is_told() {
        assert!(is_wkt("PROJCS[\"ETRS89 / UTM zone 32N\",GEOGCS[…]]"));
        assert!(is_wkt(" PROJCRS[\"x\"]"));
        assert!(!is_wkt("EPSG:25832"));
        assert!(!is_wkt("PROJCS without brackets"));
    }
}
