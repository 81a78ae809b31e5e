//! What is meant of a file that holds several things.

/// Classification of ground points in LAS files (ASPRS LAS 1.4, table 9).
#[allow(dead_code, reason = "used with the feature `las`")]
pub(super) const GROUND_CLASS: u8 = 2;

/// What is meant of a file that holds several things.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Pick {
    /// Names of lines (features, alignments, breaklines); empty: all.
    pub features: Vec<String>,
    /// Names of layers of drawings; empty: all that are on.
    pub layers: Vec<String>,
    /// Name of the surface; needed where there are several.
    pub surface: Option<String>,
    /// Classes of points of a cloud; empty: [`GROUND_CLASS`].
    pub classes: Vec<u8>,
}
