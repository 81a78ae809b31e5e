//! The report of `build`: schema `slopegen-report/1`.

use super::common::{Input, SCHEMA, SlopeFigures, Tool, Units, Warning};
use super::ground::{Daylight, FinishedFigures, GroundAreas, PadRow, SectionSlopes, StationRow, TerrainFigures};
use super::result::{ResultFigures, RunRecord};
use super::volumes::{Depths, Volumes};
use crate::model::{Design, Extent};
use schemars::JsonSchema;
use serde::Serialize;

/// The report of `slopegen build`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(rename = "BuildReport")]
pub struct Report {
    /// Name of the schema.
    #[schemars(extend("const" = SCHEMA))]
    pub schema: &'static str,
    /// The program.
    pub tool: Tool,
    /// The files read.
    pub inputs: Vec<Input>,
    /// Units of the figures.
    pub units: Units,
    /// How exactly the surface was built.
    pub design: DesignFigures,
    /// The side slopes.
    pub slopes: Slopes,
    /// The given line.
    pub line: LineFigures,
    /// Where the slope ends.
    pub extent: ExtentFigures,
    /// Elevations of the level curves, ascending.
    pub levels: Vec<f64>,
    /// The mesh written.
    pub surface: SurfaceFigures,
    /// What was measured on the mesh written.
    pub certificate: Certificate,
    /// Cut and fill.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volumes: Option<Volumes>,
    /// Plan areas of the existing ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub areas: Option<GroundAreas>,
    /// Greatest depths of cut and fill.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub depths: Option<Depths>,
    /// Where the slopes meet the existing ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub daylight: Option<Daylight>,
    /// Cut and fill by station.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stations: Option<Vec<StationRow>>,
    /// Cut and fill of platforms without stations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub pads: Option<PadRow>,
    /// The slopes as seen in sections perpendicular to the line.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub section_slope: Option<SectionSlopes>,
    /// The existing ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub terrain: Option<TerrainFigures>,
    /// The finished ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub finished: Option<FinishedFigures>,
    /// What the reader should know.
    pub warnings: Vec<Warning>,
    /// What was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<RunRecord>,
    /// Hashes of what came out.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub result: Option<ResultFigures>,
    /// Seconds spent. The one part that differs from run to run.
    pub timing: Timing,
}

impl Report {
    /// Whether the works are complete, and what that means here.
    pub(super) fn completeness(&self) -> (bool, &'static str) {
        let told = |code: &str| self.warnings.iter().any(|warning| warning.code == code);
        let complete = self.volumes.as_ref().is_some_and(|volumes| volumes.complete);
        let words = match (self.daylight, complete) {
            (None, true) => "all slopes reach their end",
            (None, false) => "the slopes do not reach their end everywhere",
            (Some(_), false) if told("open-ends") => "some slopes end without meeting the ground",
            (Some(_), false) => "there is no ground below a part of the works",
            (Some(_), true) if told("walls") => "no slope stops short; where there is none stand upright walls",
            (Some(daylight), true) if daylight.loops == 0 => "all slopes reach their end",
            (Some(_), true) => "all slopes meet the ground",
        };
        (complete, words)
    }
}

/// How exactly the surface was built.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct DesignFigures {
    /// Bound for the height error of the whole mesh against the closed form of the given line.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: f64,
    /// Height between level curves, where one was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub interval: Option<f64>,
}

impl DesignFigures {
    /// Of a design, or of the two for the same line: they differ in slope and sheet.
    pub fn of<'a>(designs: impl IntoIterator<Item = &'a Design>, interval: Option<f64>) -> Self {
        Self { tolerance: designs.into_iter().map(|design| design.tolerance).fold(0.0, f64::max), interval }
    }
}

/// The side slopes, each where it occurs.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Slopes {
    /// How the slopes are measured.
    pub measure: SlopeMeasure,
    /// Side slope of cut: of the rising sheet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<SlopeFigures>,
    /// Side slope of fill: of the falling sheet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill: Option<SlopeFigures>,
}

/// How a side slope is measured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum SlopeMeasure {
    /// As the true steepness of the surface, along its lines of steepest descent. On a gradient a section perpendicular to the
    /// line shows a flatter slope: see `section_slope`.
    #[default]
    Steepest,
}

/// The given line.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct LineFigures {
    /// Polylines and rings.
    pub chains: usize,
    /// Vertices as given, repetitions merged; of a road those of its edge.
    pub vertices: usize,
    /// Vertices the engine left out of its own copy of the line; the mesh has them all.
    pub simplified: usize,
    /// Greatest distance of a vertex left out from that copy.
    #[schemars(range(min = 0))]
    pub simplified_max: f64,
    /// Plan length of all chains; of a road that of its centre line.
    #[schemars(range(min = 0))]
    pub length: f64,
    /// Width of the roads made of open lines.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub width: Option<f64>,
    /// Crossfall of the roads.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crossfall: Option<CrossfallFigures>,
    /// Breaklines and spot heights on platforms; left out if there are none.
    #[serde(skip_serializing_if = "is_zero")]
    pub breaklines: usize,
    /// Lowest elevation.
    pub z_min: f64,
    /// Highest elevation.
    pub z_max: f64,
    /// Greatest gradient along the line, rise per run, absolute.
    #[schemars(range(min = 0))]
    pub gradient_max: f64,
    /// Stretches that lie under the sheet of another part of the line.
    pub buried: Vec<BuriedStretch>,
}

/// Fall from the centre line of a road to its edges, rise per run; positive where the edge lies lower.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CrossfallFigures {
    /// Fall to the left edge.
    pub left: f64,
    /// Fall to the right edge.
    pub right: f64,
}

#[allow(clippy::trivially_copy_pass_by_ref, reason = "the shape serde asks for")]
fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// A stretch of the line that does not appear in the surface because another part's sheet lies over it (or under it, for the
/// rising sheet).
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BuriedStretch {
    /// Name of its chain.
    pub chain: String,
    /// Station where it begins.
    pub from: f64,
    /// Station where it ends.
    pub to: f64,
    /// Greatest height of the sheet over it (under it, for the rising sheet); positive.
    #[schemars(range(min = 0))]
    pub depth: f64,
    /// Name of the chain that buries it.
    pub by_chain: String,
    /// Station on that chain whose ruling passes over the deepest point.
    pub by_station: f64,
    /// Flattest slope, rise per run, that would leave it free; none where two parts meet in plan at different heights.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub free_slope: Option<f64>,
}

/// Where the slope ends.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ExtentFigures {
    /// Where the slopes end, and what the value is.
    pub kind: ExtentKind,
    /// The elevation, height or distance, where the kind has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub value: Option<f64>,
}

impl ExtentFigures {
    /// The slopes end at the existing ground.
    pub const GROUND: Self = Self { kind: ExtentKind::Ground, value: None };
}

/// What the value of an extent is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ExtentKind {
    /// An absolute elevation.
    Elevation,
    /// A height difference from the line.
    Height,
    /// A plan distance from the line.
    Distance,
    /// The existing ground; without a value.
    Ground,
}

impl From<Extent> for ExtentFigures {
    fn from(extent: Extent) -> Self {
        let (kind, value) = match extent {
            Extent::Elevation(value) => (ExtentKind::Elevation, value),
            Extent::Height(value) => (ExtentKind::Height, value),
            Extent::Distance(value) => (ExtentKind::Distance, value),
        };
        Self { kind, value: Some(value) }
    }
}

/// The mesh written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct SurfaceFigures {
    /// Vertices of the mesh.
    pub vertices: usize,
    /// Triangles of the mesh.
    pub triangles: usize,
    /// Area of its projection onto the horizontal.
    #[schemars(range(min = 0))]
    pub plan_area: f64,
    /// Area of the slopes, measured in them.
    #[schemars(range(min = 0))]
    pub slope_area: f64,
    /// The falling part of `slope_area`.
    #[schemars(range(min = 0))]
    pub fill_slope_area: f64,
    /// The rising part of `slope_area`.
    #[schemars(range(min = 0))]
    pub cut_slope_area: f64,
    /// Area of the platform, measured in it.
    #[schemars(range(min = 0))]
    pub platform_area: f64,
}

/// What was measured on the mesh written.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Certificate {
    /// Every ridge arc of a facet with a partner is an arc of the partner with that facet. On existing ground: before it cuts the
    /// sheets.
    pub paired: bool,
    /// Greatest deviation of a slope triangle from the slope asked for, in degrees.
    #[schemars(range(min = 0))]
    pub slope_max_deviation_deg: f64,
    /// Greatest deviation over planar strips, in degrees.
    #[schemars(range(min = 0))]
    pub strip_max_deviation_deg: f64,
    /// Greatest deviation over cone sectors, in degrees.
    #[schemars(range(min = 0))]
    pub sector_max_deviation_deg: f64,
    /// Slope triangles that deviate by more than 0.1°.
    pub triangles_beyond_0_1deg: usize,
    /// Greatest deviation of a sampled height from the closed form.
    #[schemars(range(min = 0))]
    pub height_max_deviation: f64,
    /// Every edge has at most two triangles, one on each side, no vertex is unused, all triangles face up. Vertices at which the
    /// surface hangs together by a point alone are allowed.
    pub manifold: bool,
    /// Places where edges of the boundary cross in plan; where none do, loops of it with no or several layers of triangles
    /// within. 0: no two triangles overlap.
    pub overlaps: usize,
    /// Every segment of the given line is a chain of mesh edges. On existing ground: before it cuts the sheets.
    pub input_edges_kept: bool,
}

/// Seconds spent.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Timing {
    /// Reading and validation.
    #[schemars(range(min = 0))]
    pub read: f64,
    /// Reading and checking the existing ground.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(range(min = 0))]
    pub terrain: Option<f64>,
    /// The surface and its certificate.
    #[schemars(range(min = 0))]
    pub surface: f64,
    /// Areas and volumes; with existing ground the daylight line and the finished ground, too.
    #[schemars(range(min = 0))]
    pub volume: f64,
    /// Meshes and line work, up to the report.
    #[schemars(range(min = 0))]
    pub write: f64,
    /// All of the run.
    #[schemars(range(min = 0))]
    pub total: f64,
}
