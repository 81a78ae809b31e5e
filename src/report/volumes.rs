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
    /// `plane`: horizontal.
    pub kind: String,
    /// Elevation of the plane.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub elevation: Option<f64>,
}

/// Greatest vertical depths, not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Depths {
    /// Of cut.
    pub cut_max: f64,
    /// Of fill.
    pub fill_max: f64,
}
