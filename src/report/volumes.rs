//! Volumes and depths in the report.

use serde::Serialize;

/// Cut and fill.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Volumes {
    /// How they were computed, such as `prisms`.
    pub method: String,
    /// Volume to be dug away; not negative.
    pub cut: f64,
    /// Volume to be brought; not negative.
    pub fill: f64,
    /// `cut − fill`.
    pub net: f64,
    /// The sign of `net` in a word.
    pub balance: Balance,
    /// Bound for the error of cut and of fill through simplification and cone chords.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct CutFillFigures {
    /// Of cut.
    pub cut: f64,
    /// Of fill.
    pub fill: f64,
}

/// Volumes by part.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct VolumeParts {
    /// Under and above the platform.
    pub platform: CutFillFigures,
    /// Under and above the slopes.
    pub slopes: CutFillFigures,
}

/// Volumes with the change in volume of the soil.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct BulkingFigures {
    /// Gain in volume when dug, as a share of the volume in the ground.
    pub swell: f64,
    /// Loss in volume when compacted, as a share of the volume in the ground.
    pub shrink: f64,
    /// The cut in the ground, as measured.
    pub cut_bank: f64,
    /// The cut when dug.
    pub cut_loose: f64,
    /// What the cut gives when compacted.
    pub cut_compacted: f64,
    /// The fill when compacted, as measured.
    pub fill_compacted: f64,
    /// Volume in the ground that gives the fill.
    pub fill_bank: f64,
    /// The same when dug.
    pub fill_loose: f64,
    /// `cut_bank − fill_bank`.
    pub net_bank: f64,
    /// The sign of `net_bank` in a word.
    pub balance: Balance,
}

/// What is left over, or lacking.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
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
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Reference {
    /// `plane`: horizontal; `terrain`: existing ground.
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
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Depths {
    /// Of cut.
    pub cut_max: f64,
    /// Of fill.
    pub fill_max: f64,
    /// Where that of cut is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut_max_at: Option<DepthPlace>,
    /// Where that of fill is found.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill_max_at: Option<DepthPlace>,
}

/// Where a depth is found, in world coordinates.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
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
