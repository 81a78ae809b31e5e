//! The report of `slopegen check`: schema `slopegen-check/1`, described in `docs/report.md`.

mod figures;
#[cfg(test)]
pub(super) mod tests;
mod text;

pub use figures::*;
pub(super) use text::{percent, place, share, verdict};
pub use text::{render_check, render_check_markdown};

use super::html::write_check_html;
use super::json::write_json;
use super::{Input, ReportFormat, Tool, Units, Warning};
use crate::mesh::quality::{self, ANGLE_BINS, LoopKind, Quality};
use crate::write::EncodeError;
use glam::DVec3;
use schemars::JsonSchema;
use serde::Serialize;
use std::io::Write;

/// Name of the schema, first key of every report of a check.
pub const CHECK_SCHEMA: &str = "slopegen-check/1";

/// The report of `slopegen check`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CheckReport {
    /// Name of the schema.
    #[schemars(extend("const" = CHECK_SCHEMA))]
    pub schema: &'static str,
    /// The program.
    pub tool: Tool,
    /// The file read.
    pub inputs: Vec<Input>,
    /// Units of the figures.
    pub units: Units,
    /// The verdict.
    pub verdict: Verdict,
    /// The mesh as a whole.
    pub mesh: MeshFigures,
    /// What was found: errors first.
    pub findings: Vec<FindingFigures>,
    /// The boundary.
    pub boundary: BoundaryFigures,
    /// Slopes of the whole surface.
    pub slopes: SlopesFigures,
    /// Smallest angles of the triangles.
    pub angles: AngleFigures,
    /// The parts of the surface, where the file has groups.
    pub parts: Vec<PartFigures>,
    /// How the slope asked for is kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slope_bound: Option<BoundFigures>,
    /// What the reader should know.
    pub warnings: Vec<Warning>,
}

/// Whether all is well.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
pub struct Verdict {
    /// The surface is sound, and keeps the slope if one was asked for. Otherwise the program exits with 5.
    pub passed: bool,
    /// There are no findings that are errors.
    pub sound: bool,
    /// The slope asked for is kept.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub slope_kept: Option<bool>,
}

/// The mesh as a whole.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct MeshFigures {
    /// Vertices in the file.
    pub vertices: usize,
    /// Faces in the file.
    pub faces: usize,
    /// Triangles they make.
    pub triangles: usize,
    /// Pieces that share no edge.
    pub pieces: usize,
    /// Area of all triangles in plan.
    pub plan_area: f64,
    /// Their area in space.
    pub surface_area: f64,
    /// Plan distance within which vertices and edges should be joined.
    pub gap: f64,
    /// Lowest coordinates in use.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub min: Option<[f64; 3]>,
    /// Highest coordinates in use.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub max: Option<[f64; 3]>,
}

/// What a check was about.
#[derive(Clone, Copy, Debug)]
pub struct Checked<'a> {
    /// Vertices in the file.
    pub vertices: usize,
    /// Faces in the file.
    pub faces: usize,
    /// Triangles they make.
    pub triangles: usize,
    /// Names of the groups.
    pub names: &'a [String],
    /// How it was looked at.
    pub options: &'a quality::Options,
}

impl CheckReport {
    /// The report of what was found.
    pub fn new(input: Input, checked: &Checked<'_>, quality: &Quality, warnings: Vec<Warning>) -> Self {
        let loops = |kind: LoopKind| quality.loops.iter().filter(|l| l.kind == kind).count();
        let lowest = [0.0].into_iter().chain(ANGLE_BINS);
        let bound = checked.options.bound.as_ref().zip(quality.kept.as_ref());
        Self {
            schema: CHECK_SCHEMA,
            tool: Tool::default(),
            inputs: vec![input],
            units: Units::default(),
            verdict: Verdict {
                passed: quality.passed(),
                sound: quality.sound(),
                slope_kept: quality.kept.as_ref().map(|kept| kept.passed),
            },
            mesh: MeshFigures {
                vertices: checked.vertices,
                faces: checked.faces,
                triangles: checked.triangles,
                pieces: quality.pieces.len(),
                plan_area: quality.slopes.plan_area,
                surface_area: quality.slopes.all.area,
                gap: quality.gap,
                min: quality.extent.map(|(lo, _)| DVec3::to_array(&lo)),
                max: quality.extent.map(|(_, hi)| DVec3::to_array(&hi)),
            },
            findings: quality.findings.iter().map(FindingFigures::from).collect(),
            boundary: BoundaryFigures {
                outer: loops(LoopKind::Outer),
                holes: loops(LoopKind::Hole),
                seams: loops(LoopKind::Seam),
                unclosed: loops(LoopKind::Unclosed),
                length: quality.loops.iter().map(|l| l.length).sum(),
                loops: quality.loops.iter().take(checked.options.places).map(LoopFigures::from).collect(),
            },
            slopes: (&quality.slopes).into(),
            angles: AngleFigures {
                smallest: quality
                    .angles
                    .smallest
                    .as_ref()
                    .map(|(degrees, place)| ExtremeFigures { degrees: *degrees, place: place.into() }),
                histogram: lowest
                    .zip(ANGLE_BINS)
                    .zip(quality.angles.bins)
                    .map(|((from, to), triangles)| AngleBin { from, to, triangles })
                    .collect(),
            },
            parts: checked
                .names
                .iter()
                .zip(&quality.groups)
                .map(|(name, slopes)| PartFigures { name: name.clone(), slopes: slopes.into() })
                .collect(),
            slope_bound: bound.map(|(bound, kept)| BoundFigures::new(bound, kept, checked.names)),
            warnings,
        }
    }
}

impl ReportFormat {
    /// Writes the report of a check in this format.
    ///
    /// # Errors
    /// As [`ReportFormat::write`].
    pub fn write_check(self, out: &mut (impl Write + ?Sized), report: &CheckReport) -> Result<(), EncodeError> {
        match self {
            Self::Json => write_json(out, report),
            Self::Text => Ok(out.write_all(render_check(report).as_bytes())?),
            Self::Html => write_check_html(out, report),
            Self::Markdown => Ok(out.write_all(render_check_markdown(report).as_bytes())?),
        }
    }
}
