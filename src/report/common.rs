//! What reports have in common: the program, the files read, units, slopes, and what the reader should know.
//!
//! Plain structures that the pipeline fills; keys, their order and their meaning are described in `docs/report.md`. Lengths are
//! in the unit of the input, areas and volumes in its square and cube. A key that does not apply is left out, never `null`.

use crate::model::{LengthUnit, Note, Slope};
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// Name of the schema of `build` and `volume`, first key of their reports.
pub const SCHEMA: &str = "slopegen-report/1";

/// The program that made the report.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Tool {
    /// Name of the program.
    #[schemars(extend("const" = "slopegen"))]
    pub name: &'static str,
    /// Version of the program.
    pub version: &'static str,
}

impl Default for Tool {
    /// This program.
    fn default() -> Self {
        Self { name: env!("CARGO_PKG_NAME"), version: env!("CARGO_PKG_VERSION") }
    }
}

/// A file read.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Input {
    /// What it was read for: `line` or `terrain`; of volumes `design`, `existing` or `within`; of a check `mesh`.
    pub role: String,
    /// Its path as given; `-` for standard input.
    pub path: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 of its bytes, 64 lower-case hexadecimal digits.
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub sha256: String,
    /// Format, such as `geojson`, `csv`, `obj`.
    pub format: String,
    /// Name of its coordinate system, where it gives one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crs: Option<String>,
}

/// Units of the figures. Angles are in degrees, times in seconds.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Units {
    /// Unit of coordinates, lengths, heights and stations: `m`, `ft` (international foot) or `us-ft` (US survey foot).
    #[schemars(extend("enum" = LengthUnit::ALL.map(LengthUnit::label)))]
    pub length: &'static str,
    /// Metres in one unit of length: 1, 0.3048, or 1200/3937.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub metres: f64,
    /// Unit of areas, the square of the unit of length.
    #[schemars(extend("enum" = LengthUnit::ALL.map(|unit| format!("{unit}²"))))]
    pub area: String,
    /// Unit of volumes, the cube of the unit of length.
    #[schemars(extend("enum" = LengthUnit::ALL.map(|unit| format!("{unit}³"))))]
    pub volume: String,
}

impl Default for Units {
    /// Metres.
    fn default() -> Self {
        LengthUnit::default().into()
    }
}

impl From<LengthUnit> for Units {
    fn from(unit: LengthUnit) -> Self {
        Self { length: unit.label(), metres: unit.metres(), area: format!("{unit}²"), volume: format!("{unit}³") }
    }
}

/// One slope in its four forms.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SlopeFigures {
    /// Rise per run: 0.5 is 1V:2H.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub ratio: f64,
    /// Run per unit of rise: the *n* of 1V:*n*H.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub one_in: f64,
    /// Rise per run in percent.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub percent: f64,
    /// Angle against the horizontal, in degrees.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 90))]
    pub degrees: f64,
}

impl SlopeFigures {
    /// The four forms in words.
    pub fn forms(self) -> String {
        self.as_slope(Slope::forms)
    }

    /// As `1V:1.5H`.
    pub fn short(self) -> String {
        self.as_slope(Slope::short)
    }

    fn as_slope(self, words: fn(Slope) -> String) -> String {
        Slope::from_ratio(self.ratio).map_or_else(|| self.ratio.to_string(), words)
    }
}

impl From<Slope> for SlopeFigures {
    fn from(slope: Slope) -> Self {
        Self { ratio: slope.ratio(), one_in: slope.one_in(), percent: slope.percent(), degrees: slope.degrees() }
    }
}

/// Something the reader should know.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Warning {
    /// Stable name, listed in `docs/cli.md`.
    #[schemars(regex(pattern = r"^[a-z0-9]+(-[a-z0-9]+)*$"))]
    pub code: String,
    /// `warning` where it is about the result itself, `note` where about how the input was read.
    pub kind: WarningKind,
    /// The warning in words.
    pub message: String,
    /// Figures beside the message, under keys of their own. `code`, `kind` and `message` are taken.
    #[serde(flatten)]
    pub details: BTreeMap<&'static str, Detail>,
}

impl Warning {
    /// What a note says.
    pub fn plain(note: &Note) -> Self {
        Self::of(note, BTreeMap::new())
    }

    /// What notes say.
    pub fn all(notes: &[Note]) -> Vec<Self> {
        notes.iter().map(Self::plain).collect()
    }

    /// What a note says, with figures beside it.
    pub fn of(note: &Note, details: BTreeMap<&'static str, Detail>) -> Self {
        let kind = if note.is_warning() { WarningKind::Warning } else { WarningKind::Note };
        Self { code: note.code.to_owned(), kind, message: note.message.clone(), details }
    }
}

/// How much a warning weighs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum WarningKind {
    /// It is about the result itself.
    Warning,
    /// It tells how the input was read, or what was chosen.
    Note,
}

/// A figure of a warning.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[serde(untagged)]
pub enum Detail {
    /// A whole number.
    Count(u64),
    /// Any other number.
    Number(f64),
    /// A name.
    Text(String),
}
