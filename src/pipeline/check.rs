//! A mesh from anywhere, looked at as it is.

use super::watch::{CHECKING, Observer, READING, Stopwatch, WRITING};
use super::{Error, desk, figures, room};
use crate::mesh::quality::{self, Bound, Kind, Mesh, Options};
use crate::model::digits::in_percent;
use crate::model::{Defect, Defects, Note, Part, Slope};
use crate::read::ReadError;
use crate::read::terrain::{RawFaces, RawMesh, read_mesh};
use crate::read::{InputFormat, Pick};
use crate::report::{CheckReport, Checked, ReportFormat, Warning};
use crate::surface::Watch as _;
use crate::terrain;
use crate::write::{Outputs, Target};
use std::fmt;
use std::path::PathBuf;

/// A mesh to be looked at, and where to put what is found.
#[derive(Clone, Debug)]
pub struct CheckJob {
    /// The mesh; `-` is standard input.
    pub path: PathBuf,
    /// Its format; `None`: from its name, else from its content.
    pub format: Option<InputFormat>,
    /// Which surface is meant of several.
    pub pick: Pick,
    /// A slope to be kept.
    pub slope: Option<SlopeWish>,
    /// Plan distance within which vertices and edges should be joined; `None`: see [`Options::gap`].
    pub gap: Option<f64>,
    /// Places told of each kind of finding.
    pub places: usize,
    /// Where reports go.
    pub reports: Vec<(Target, ReportFormat)>,
}

/// A slope that a mesh is to keep.
#[derive(Clone, Debug, PartialEq)]
pub struct SlopeWish {
    /// The slope.
    pub slope: Slope,
    /// Deviation within which a triangle is on it, in degrees.
    pub tolerance_deg: f64,
    /// Greatest share of the area that may be off it, 0 to 1.
    pub most_off: f64,
    /// Names of the parts it is asked of. Empty: the slopes, if the mesh has parts of these names, else all that is not level.
    pub parts: Vec<String>,
}

/// What was found.
#[derive(Clone, Debug)]
pub struct Looked {
    /// The report.
    pub report: CheckReport,
    /// The files that have appeared, in the order of the job; streams are not among them.
    pub written: Vec<Target>,
}

/// Looks at a mesh and writes what is found. A mesh that is not sound is no error here: see [`CheckReport::verdict`].
///
/// # Errors
/// [`Error`] if the file cannot be read, has no part of a name asked for, or a report cannot be written.
pub fn check(job: &CheckJob, observer: &dyn Observer) -> Result<Looked, Error> {
    let watch = Stopwatch::new(observer);
    let targets: Vec<Target> = job.reports.iter().map(|(target, _)| target.clone()).collect();
    let outputs = Outputs::open(&targets, std::slice::from_ref(&job.path))?;
    watch.stage_of(READING);
    let raw = read_mesh(&job.path, job.format, &job.pick, &watch.memory())?;
    let corners = match &raw.faces {
        RawFaces::Triangles(triangles) => 3 * triangles.len(),
        RawFaces::Polygons { corners, .. } => 3 * corners.len(),
    };
    room::for_checking(raw.vertices.len(), corners, &raw.source.label, &watch.memory())?;
    raw.notes.iter().for_each(|note| watch.note(note));
    let bound = job.slope.as_ref().map(|wish| bound(wish, &raw)).transpose()?;
    watch.stage_of(CHECKING);
    let options = Options { gap: job.gap, places: job.places, bound };
    let unit = raw.source.unit.unwrap_or_default();
    let mut report = look(raw, &options, &watch);
    report.units = unit.into();
    watch.stage_of(WRITING);
    let written = desk::write_reports(outputs, &job.reports, |format, out| format.write_check(out, &report))?;
    Ok(Looked { report, written })
}

fn look(raw: RawMesh, options: &Options, watch: &Stopwatch<'_>) -> CheckReport {
    let input = figures::input("mesh", &raw.source);
    let units = raw.source.unit.unwrap_or_default().into();
    let count = raw.faces.len();
    let (triangles, faces) = match raw.faces {
        RawFaces::Triangles(triangles) => (triangles, Vec::new()),
        RawFaces::Polygons { corners, ends } => {
            let (triangles, faces) = split(&raw.vertices, &corners, &ends);
            let message = format!("faces of more than three corners were split: {count} faces, {} triangles", triangles.len());
            watch.note(&Note::new("faces-split", message));
            (triangles, faces)
        }
    };
    let groups: Vec<u32> = match (raw.groups.is_empty(), faces.is_empty()) {
        (false, false) => faces.iter().map(|&face| raw.groups.get(face as usize).copied().unwrap_or(0)).collect(),
        _ => raw.groups,
    };
    let mesh = Mesh { vertices: &raw.vertices, triangles: &triangles, faces: &faces, groups: &groups, names: &raw.names };
    let quality = quality::examine(&mesh, options);
    let warnings = Warning::all(&watch.notes());
    let size = (raw.vertices.len(), count, triangles.len());
    let checked = Checked { vertices: size.0, faces: size.1, triangles: size.2, names: &raw.names, options };
    CheckReport { units, ..CheckReport::new(input, &checked, &quality, warnings) }
}

/// Faces as triangles, and the face each is of. Faces that cannot be split properly, because their outline crosses itself, are
/// fanned out all the same: what is wrong with them then shows.
fn split(vertices: &[glam::DVec3], corners: &[u32], ends: &[usize]) -> (Vec<[u32; 3]>, Vec<u32>) {
    let (mut triangles, mut faces) = (Vec::with_capacity(corners.len()), Vec::new());
    let mut begin = 0;
    for (number, &end) in (0..).zip(ends) {
        let face = &corners[begin..end];
        begin = end;
        match *face {
            [a, b, c] => triangles.push([a, b, c]),
            _ if terrain::split_polygon(vertices, face, &mut triangles) => {}
            _ => triangles.extend((2..face.len()).map(|i| [face[0], face[i - 1], face[i]])),
        }
        faces.resize(triangles.len(), number);
    }
    (triangles, faces)
}

/// The bound for the groups of a mesh.
///
/// # Errors
/// That the file has no part of a name asked for: a name in an input, as that of a layer or surface is.
fn bound(wish: &SlopeWish, raw: &RawMesh) -> Result<Bound, ReadError> {
    let of = |names: &[&str]| (0..).zip(&raw.names).filter(|(_, name)| names.contains(&name.as_str())).map(|(i, _)| i).collect();
    let groups: Vec<u32> = if wish.parts.is_empty() {
        of(&[Part::FillSlope.name(), Part::CutSlope.name()])
    } else {
        let mut defects = Defects::default();
        for name in wish.parts.iter().filter(|name| !raw.names.contains(name)) {
            defects.push("no-such-part", || Defect {
                code: "no-such-part",
                what: format!("the mesh has no part `{name}`"),
                at: raw.source.label.clone(),
                figures: None,
                help: match raw.names.as_slice() {
                    [] => "leave out `--part`: the file has no groups".to_owned(),
                    names => format!("its parts are {}", listed(names)),
                },
            });
        }
        defects.into_result().map_err(ReadError::Records)?;
        of(&wish.parts.iter().map(String::as_str).collect::<Vec<_>>())
    };
    let groups = (!groups.is_empty()).then_some(groups);
    Ok(Bound { slope: wish.slope, tolerance_deg: wish.tolerance_deg, most_off: wish.most_off, groups })
}

/// Names in a message; of very many the first.
fn listed(names: &[String]) -> String {
    const MOST: usize = 12;
    let more = if names.len() > MOST { format!(" and {} more", names.len() - MOST) } else { String::new() };
    format!("`{}`{more}", names[..names.len().min(MOST)].join("`, `"))
}

/// A mesh that did not pass.
#[derive(Clone, Debug, PartialEq)]
pub struct NotPassed {
    /// The mesh.
    pub label: String,
    /// What is wrong with it; at least one line.
    pub figures: Vec<String>,
}

impl NotPassed {
    /// What is wrong, if anything is.
    pub fn of(report: &CheckReport) -> Option<Self> {
        if report.verdict.passed {
            return None;
        }
        let mut figures: Vec<String> = Vec::new();
        // Two remarks say why there are errors.
        let telling = [Kind::Closed, Kind::Standing].map(Kind::code);
        for finding in report.findings.iter().filter(|f| f.severity == "error" || telling.contains(&f.code)) {
            let least = if finding.at_least { "at least " } else { "" };
            figures.push(format!("{least}{} {}", finding.count, finding.message));
        }
        if let Some(bound) = report.slope_bound.as_ref().filter(|bound| !bound.passed) {
            figures.push(if bound.within.triangles == 0 && bound.off.triangles == 0 {
                "there is no triangle the slope could be asked of".to_owned()
            } else {
                let (share, allowed) = (100.0 * bound.off.share, in_percent(bound.max_off));
                format!("{} triangles are off the slope, {share:.3} % of the area against {allowed} %", bound.off.triangles)
            });
        }
        let label = report.inputs.first().map_or_else(String::new, |input| input.path.clone());
        Some(Self { label, figures })
    }
}

impl fmt::Display for NotPassed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the mesh did not pass its check\n  --> {}", self.label)?;
        self.figures.iter().try_for_each(|line| write!(f, "\n   = {line}"))?;
        f.write_str("\n   = help: the report names the places")
    }
}

impl std::error::Error for NotPassed {}
