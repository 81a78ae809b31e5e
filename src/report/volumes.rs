//! Volumes and depths in the report.

use schemars::JsonSchema;
use serde::Serialize;

/// The one method of volumes there is.
pub const METHOD: &str = "prisms";

/// The method in words.
pub const METHOD_TEXT: &str =
    "exact for the triangles: prisms over each, against another surface over the common refinement; no cells, no sections";

/// What the sign of net says.
pub const SIGN_RULE: &str =
    "net = cut − fill: positive is a surplus (soil is left over), negative a deficit (soil must be brought)";

/// Volumes below this are printed as nought.
const ROUNDED: f64 = 0.005;

/// Mean depth of a volume; none over no area.
pub(super) fn mean(volume: f64, area: f64) -> Option<f64> {
    (area > 0.0 && volume / area < f64::INFINITY).then(|| volume / area)
}

/// Cut and fill.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Volumes {
    /// How they were computed; `prisms`: exact for the triangles of both surfaces.
    #[schemars(extend("const" = METHOD))]
    pub method: &'static str,
    /// The method in words.
    #[schemars(extend("const" = METHOD_TEXT))]
    pub method_text: &'static str,
    /// Volume to be dug away; not negative.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Volume to be brought; not negative.
    #[schemars(range(min = 0))]
    pub fill: f64,
    /// `cut − fill`: see `sign_rule`.
    pub net: f64,
    /// What the sign of `net` says.
    #[schemars(extend("const" = SIGN_RULE))]
    pub sign_rule: &'static str,
    /// The sign of `net` in a word.
    pub balance: Balance,
    /// Bound for the error of cut and of fill through simplification and cone chords.
    #[schemars(range(min = 0))]
    pub error_bound: f64,
    /// Whether the slopes reach their end everywhere.
    pub complete: bool,
    /// What the volumes are taken against.
    pub reference: Reference,
    /// Platform and slopes apart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub parts: Option<VolumeParts>,
    /// With the change in volume of the soil.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bulking: Option<BulkingFigures>,
    /// Sum over the stations by average end area.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub end_area: Option<CutFillFigures>,
    /// Sum over the stations by the prismoidal formula.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub prismoidal: Option<CutFillFigures>,
}

/// A figure for cut and one for fill; not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct CutFillFigures {
    /// Figure of cut.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Figure of fill.
    #[schemars(range(min = 0))]
    pub fill: f64,
}

/// Volumes by part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct VolumeParts {
    /// Under and above the platform.
    pub platform: CutFillFigures,
    /// Under and above the slopes.
    pub slopes: CutFillFigures,
}

/// Volumes with the change in volume of the soil.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BulkingFigures {
    /// Gain in volume when dug, as a share of the volume in the ground: 0.25 is 25 %.
    #[schemars(range(min = 0))]
    pub swell: f64,
    /// Loss in volume when compacted, as a share of the volume in the ground; negative for rock that takes more room.
    #[schemars(extend("exclusiveMaximum" = 1))]
    pub shrink: f64,
    /// The cut in the ground, as measured.
    #[schemars(range(min = 0))]
    pub cut_bank: f64,
    /// The cut when dug.
    #[schemars(range(min = 0))]
    pub cut_loose: f64,
    /// What the cut gives when compacted.
    #[schemars(range(min = 0))]
    pub cut_compacted: f64,
    /// The fill when compacted, as measured.
    #[schemars(range(min = 0))]
    pub fill_compacted: f64,
    /// Volume in the ground that gives the fill.
    #[schemars(range(min = 0))]
    pub fill_bank: f64,
    /// The soil for the fill when dug.
    #[schemars(range(min = 0))]
    pub fill_loose: f64,
    /// `cut_bank − fill_bank`.
    pub net_bank: f64,
    /// The sign of `net_bank` in a word.
    pub balance: Balance,
}

/// What is left over, or lacking.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Balance {
    /// More cut than fill: soil is left over.
    Surplus,
    /// More fill than cut: soil must be brought.
    Deficit,
    /// As much of one as of the other.
    Balanced,
}

impl Balance {
    /// The net as it is printed, with two decimals, and the balance of what is printed: what rounds to nought is balanced.
    pub(super) fn shown(self, net: f64) -> (f64, Self) {
        if net.abs() < ROUNDED { (0.0, Self::Balanced) } else { (net, self) }
    }

    /// Cut and fill that differ by less than this share of the larger one are equal: summation leaves no more.
    const SAME: f64 = 1e-9;

    /// The word for a cut and a fill volume.
    pub fn of(cut: f64, fill: f64) -> Self {
        if (cut - fill).abs() <= Self::SAME * cut.max(fill) {
            Self::Balanced
        } else if cut > fill {
            Self::Surplus
        } else {
            Self::Deficit
        }
    }

    /// The word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Surplus => "surplus",
            Self::Deficit => "deficit",
            Self::Balanced => "balanced",
        }
    }
}

/// What volumes are taken against.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Reference {
    /// `plane`: horizontal; `terrain`: existing ground.
    #[schemars(extend("enum" = ["plane", "terrain"]))]
    pub kind: String,
    /// Elevation of the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elevation: Option<f64>,
    /// Path of the ground as given.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub path: Option<String>,
}

impl Reference {
    /// The plane at an elevation.
    pub fn plane(elevation: f64) -> Self {
        Self { kind: "plane".to_owned(), elevation: Some(elevation), path: None }
    }

    /// The existing ground of a file.
    pub fn terrain(path: &str) -> Self {
        Self { kind: "terrain".to_owned(), elevation: None, path: Some(path.to_owned()) }
    }
}

/// Greatest vertical depths, not negative.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Depths {
    /// Greatest depth of cut.
    #[schemars(range(min = 0))]
    pub cut_max: f64,
    /// Greatest depth of fill.
    #[schemars(range(min = 0))]
    pub fill_max: f64,
    /// Mean depth of cut: its volume over its area; left out where there is no area, or none is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub cut_mean: Option<f64>,
    /// Mean depth of fill: its volume over its area; left out where there is no area, or none is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub fill_mean: Option<f64>,
    /// Where the greatest depth of cut is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut_max_at: Option<DepthPlace>,
    /// Where the greatest depth of fill is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill_max_at: Option<DepthPlace>,
}

/// Where a depth is found, in world coordinates.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct DepthPlace {
    /// Easting.
    pub x: f64,
    /// Northing.
    pub y: f64,
    /// Elevation of the design.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
    /// Name of the line it belongs to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub chain: Option<String>,
    /// Station on that line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub station: Option<f64>,
}
