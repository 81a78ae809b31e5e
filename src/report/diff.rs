//! What `slopegen diff` has to tell.

pub mod compare;
pub mod text;

pub use compare::{Change, compare};
pub use text::render_diff;

use super::between::Spot;
use super::common::{Input, Tool, Warning};
use schemars::JsonSchema;
use serde::Serialize;

/// Version of the keys.
pub const DIFF_SCHEMA: &str = "slopegen-diff/1";

/// What differs between two reports, or between two surfaces. Differences are the second less the first.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DiffReport {
    /// Name and version of this schema.
    #[schemars(extend("const" = DIFF_SCHEMA))]
    pub schema: &'static str,
    /// The program.
    pub tool: Tool,
    /// The two files: `first` and `second`.
    pub inputs: Vec<Input>,
    /// Unit of length of the figures; areas are in its square, volumes in its cube.
    pub unit: String,
    /// Whether nothing that counts differs: of reports any figure or word but times, paths and the version of the program; of
    /// surfaces heights and extent.
    pub same: bool,
    /// What differs between reports.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub changes: Option<Vec<Change>>,
    /// What differs between surfaces.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surfaces: Option<SurfaceChange>,
    /// The bounds asked for.
    pub bounds: Vec<BoundRow>,
    /// Whether all bounds are kept.
    pub passed: bool,
    /// What the reader should know.
    pub warnings: Vec<Warning>,
}

/// What differs between two surfaces, over the plan area they share.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SurfaceChange {
    /// Where the second lies highest above the first.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub highest: Option<Step>,
    /// Where it lies lowest below.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub lowest: Option<Step>,
    /// Greatest height difference; not negative.
    pub height_max: f64,
    /// Mean height difference.
    pub height_mean: f64,
    /// Mean of the height differences without their signs.
    pub height_mean_absolute: f64,
    /// Volume of the second above the first.
    pub above: f64,
    /// Volume of the second below the first.
    pub below: f64,
    /// Plan area both share.
    pub common_area: f64,
    /// Of it, where the heights are the same within 10⁻⁶.
    pub same_area: f64,
    /// Plan area of the first beside the second.
    pub first_only: f64,
    /// Plan area of the second beside the first.
    pub second_only: f64,
}

/// A height difference and its place.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Step {
    /// The second less the first.
    pub height: f64,
    /// Where, on the second surface.
    pub at: Spot,
}

/// A bound and whether it is kept.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BoundRow {
    /// `max_volume`, `max_area`, `max_height`, `exact`.
    pub bound: &'static str,
    /// The figure it is on, such as `volumes.cut`.
    pub on: String,
    /// Greatest difference allowed: a share of the greater of the two figures, or in their unit.
    pub most: f64,
    /// Whether `most` and `found` are shares, 0 to 1.
    pub share: bool,
    /// The difference, not negative.
    pub found: f64,
    /// Whether it is kept.
    pub passed: bool,
}
