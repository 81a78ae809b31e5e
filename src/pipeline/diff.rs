//! What differs between two reports, or between two surfaces.

use super::watch::{Named, Observer, Stopwatch, WRITING};
use super::{Error, desk, figures, read_ground, room, systems};
use crate::model::digits::in_percent;
use crate::model::message::{placed, printable};
use crate::overlay::{self, AREA_ROUNDING, Between, Depth, OverlayError, SAME_HEIGHT};
use crate::read::terrain::TerrainOptions;
use crate::read::{Document, InputFormat, Source, read_document};
use crate::report::between::Spot;
use crate::report::diff::{BoundRow, DIFF_SCHEMA, DiffReport, Step, SurfaceChange, compare, render_diff};
use crate::report::{Input, ReportFormat, SCHEMA, Tool, Warning};
use crate::surface::Watch;
use crate::write::{Outputs, Target};
use serde_json::Value;
use std::fmt;
use std::path::{Path, PathBuf};

/// Two files to be compared, and where the figures go.
#[derive(Clone, Debug)]
pub struct DiffJob {
    /// The first: a report of this program as JSON, or a surface.
    pub first: PathBuf,
    /// The second, of the same kind.
    pub second: PathBuf,
    /// What is known about surfaces.
    pub options: TerrainOptions,
    /// Greatest differences allowed.
    pub bounds: Bounds,
    /// Where reports go.
    pub reports: Vec<(Target, ReportFormat)>,
}

/// Greatest differences allowed; without any, no difference is too great.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bounds {
    /// Of cut and of fill; between surfaces of all volume between them.
    pub volume: Option<Most>,
    /// Of the areas of cut and of fill; of surfaces the area that only one of them covers.
    pub area: Option<Most>,
    /// Of the greatest depths; between surfaces of heights.
    pub height: Option<f64>,
    /// Nothing that counts may differ.
    pub exact: bool,
}

/// A greatest difference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Most {
    /// In the unit of the figure.
    Figure(f64),
    /// As a share of the greater of the two figures, 0 to 1.
    Share(f64),
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Differed {
    /// The report.
    pub report: DiffReport,
    /// The files that have appeared; streams are not among them.
    pub written: Vec<Target>,
}

/// Why two files could not be compared.
#[derive(Clone, Debug, PartialEq)]
pub struct DiffError(String);

impl fmt::Display for DiffError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for DiffError {}

/// Two files that differ by more than they may.
#[derive(Clone, Debug, PartialEq)]
pub struct Beyond {
    labels: Vec<String>,
    figures: Vec<String>,
}

impl Beyond {
    /// What is beyond its bound, if anything is.
    pub fn of(report: &DiffReport) -> Option<Self> {
        let figure = |row: &BoundRow| match row.bound {
            "exact" => format!("{} figures or words differ", row.found),
            _ if row.share => format!("{}: {:.4} % against {} %", row.on, 100.0 * row.found, in_percent(row.most)),
            _ => format!("{}: {} against {}", row.on, row.found, row.most),
        };
        let figures = report.bounds.iter().filter(|row| !row.passed).map(figure).collect();
        let labels = report.inputs.iter().map(|input| input.path.clone()).collect();
        (!report.passed).then_some(Self { labels, figures })
    }
}

impl fmt::Display for Beyond {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the two differ by more than they may")?;
        self.labels.iter().try_for_each(|label| write!(f, "\n  --> {label}"))?;
        self.figures.iter().try_for_each(|figures| write!(f, "\n   = {figures}"))?;
        f.write_str("\n   = help: the report tells what differs")
    }
}

impl std::error::Error for Beyond {}

/// Compares two files. That they differ is no error: see [`Beyond::of`].
///
/// # Errors
/// [`Error`] if a file cannot be read, if the two are not of one kind or share no area, if a bound is on figures they do not
/// have, or if a report cannot be written.
pub fn diff(job: &DiffJob, observer: &dyn Observer) -> Result<Differed, Error> {
    let watch = Stopwatch::new(observer);
    let targets: Vec<Target> = job.reports.iter().map(|(target, _)| target.clone()).collect();
    let outputs = Outputs::open(&targets, &[&job.first, &job.second])?;
    let documents = (read_document(&job.first)?, read_document(&job.second)?);
    for document in [&documents.0, &documents.1].into_iter().flatten() {
        check_schema(document)?;
    }
    let mut report = match documents {
        (Some(first), Some(second)) => {
            no_choice(job)?;
            reports(&first, &second, &job.bounds, &watch)?
        }
        (None, None) => surfaces(job, &watch)?,
        (first, _) => {
            let (report, other) = if first.is_some() { (&job.first, &job.second) } else { (&job.second, &job.first) };
            let message = format!(
                "a report cannot be compared with something else\n  --> {}\n  --> {}\n   \
                 = the first of these is a report of this program, the other is not\n   = help: give two reports, or two surfaces",
                report.display(),
                other.display()
            );
            return Err(DiffError(message).into());
        }
    };
    report.warnings = Warning::all(&watch.notes());
    report.passed = report.bounds.iter().all(|row| row.passed);
    watch.stage_of(WRITING);
    let text = || render_diff(&report);
    let written = desk::write_reports(outputs, &job.reports, |format, out| format.write_plain(out, &report, text))?;
    Ok(Differed { report, written })
}

/// Refuses reports of other commands: what of them says how a run went, and what is a result, is not known here.
fn check_schema(document: &Document) -> Result<(), DiffError> {
    if document.schema == SCHEMA {
        return Ok(());
    }
    let figures = format!("its schema is `{}`, not `{SCHEMA}`", printable(&document.schema));
    let help = "give two reports that `slopegen build` or `volume` wrote";
    Err(DiffError(format!(
        "a report of this kind cannot be compared\n  --> {}\n   = {figures}\n   = help: {help}",
        document.label
    )))
}

/// Refuses options of surfaces beside reports: they would change nothing.
fn no_choice(job: &DiffJob) -> Result<(), DiffError> {
    let TerrainOptions { csv_order, pick, unit, .. } = &job.options;
    let given = [("--csv-order", csv_order.is_some()), ("--surface", pick.surface.is_some()), ("--units", unit.is_some())];
    let Some((option, _)) = given.into_iter().find(|(_, given)| *given) else { return Ok(()) };
    Err(DiffError(format!(
        "`{option}` is for surfaces, and these are reports\n  --> {}\n  --> {}\n   = help: leave it out",
        job.first.display(),
        job.second.display()
    )))
}

fn empty(inputs: Vec<Input>, unit: String) -> DiffReport {
    DiffReport {
        schema: DIFF_SCHEMA,
        tool: Tool::default(),
        inputs,
        unit,
        same: false,
        changes: None,
        surfaces: None,
        bounds: Vec::new(),
        passed: true,
        warnings: Vec::new(),
    }
}

/// Figures of reports that a bound is on: as many of them as one of the two has, at least one.
const VOLUMES: &[&str] = &["volumes.cut", "volumes.fill"];
const AREAS: &[&str] = &["areas.cut", "areas.fill"];
const DEPTHS: &[&str] = &["depths.cut_max", "depths.fill_max"];

fn reports(first: &Document, second: &Document, bounds: &Bounds, watch: &Stopwatch<'_>) -> Result<DiffReport, Error> {
    let input = |role: &str, document: &Document| Input {
        role: role.to_owned(),
        path: document.label.clone(),
        bytes: document.bytes,
        sha256: document.sha256.clone(),
        format: document.schema.clone(),
        crs: None,
    };
    let unit = |document: &Document| document.value["units"]["length"].as_str().unwrap_or("").to_owned();
    let (a, b) = (unit(first), unit(second));
    if a != b {
        let message = format!("the first report is in {a}, the second in {b}: differences of figures mean nothing");
        watch.note(&crate::model::Note::new("units-differ", message));
    }
    let mut report = empty(vec![input("first", first), input("second", second)], a.clone());
    let changes = compare(&first.value, &second.value);
    let most = [
        ("max_volume", VOLUMES, bounds.volume),
        ("max_area", AREAS, bounds.area),
        ("max_height", DEPTHS, bounds.height.map(Most::Figure)),
    ];
    for (bound, keys, most) in most {
        let Some(most) = most else { continue };
        let place = || format!("{}\n  --> {}", first.label, second.label);
        let refuse = |what: &str, figures: &str, help: &str| {
            let option = bound.replace('_', "-");
            DiffError(format!("`--{option}` {what}\n  --> {}\n   = {figures}\n   = help: {help}", place()))
        };
        if a != b {
            let figures = format!("the first report is in {a}, the second in {b}");
            return Err(refuse("needs reports in the same unit", &figures, "run both with the same `--units`").into());
        }
        let pairs = keys.iter().map(|key| (*key, figure(&first.value, key), figure(&second.value, key)));
        let known: Vec<_> = pairs.filter_map(|(key, a, b)| a.zip(b).map(|(a, b)| (key, a, b))).collect();
        if known.len() < keys.len() {
            let figures = format!("{} are not in both of them", keys.join(" and "));
            return Err(refuse("needs reports with these figures", &figures, "leave the bound out").into());
        }
        report.bounds.extend(known.into_iter().map(|(key, a, b)| row(bound, key, most, (b - a).abs(), a.abs().max(b.abs()))));
    }
    let count = changes.iter().filter(|change| change.counts).count();
    if bounds.exact {
        report.bounds.push(row("exact", "all figures and words", Most::Figure(0.0), count as f64, 0.0));
    }
    report.same = count == 0;
    report.changes = Some(changes);
    Ok(report)
}

/// A figure of a report by its dotted path.
fn figure(value: &Value, path: &str) -> Option<f64> {
    path.split('.').try_fold(value, |value, key| value.get(key))?.as_f64()
}

fn row(bound: &'static str, on: &str, most: Most, found: f64, greater: f64) -> BoundRow {
    let (most, share, found) = match most {
        Most::Figure(most) => (most, false, found),
        Most::Share(most) => (most, true, if greater > 0.0 { found / greater } else { 0.0 }),
    };
    BoundRow { bound, on: on.to_owned(), most, share, found, passed: found <= most }
}

fn surfaces(job: &DiffJob, watch: &Stopwatch<'_>) -> Result<DiffReport, Error> {
    if let Some(Most::Share(_)) = job.bounds.volume {
        let what = "`--max-volume` as a share means nothing between surfaces";
        return Err(DiffError(format!(
            "{what}\n  --> {}\n  --> {}\n   = help: give a volume in the unit of the files",
            job.first.display(),
            job.second.display()
        ))
        .into());
    }
    // A surface is meant where there are several: not of meshes beside LandXML.
    let holds = |path: &Path| InputFormat::from_path(path).is_none_or(|format| format == InputFormat::LandXml);
    let chosen = [&job.first, &job.second].into_iter().any(|path| holds(path));
    let no_order = ![&job.first, &job.second].into_iter().any(|path| InputFormat::may_have_order(path));
    let read = |path: &Path, unit, name| {
        let mut options = job.options.clone();
        options.pick.surface = options.pick.surface.filter(|_| holds(path) || !chosen);
        options.csv_order = options.csv_order.filter(|_| no_order || InputFormat::may_have_order(path));
        read_ground(path, &options, unit, &Named { watch, name }).map_err(|error| match error {
            Error::Read(error) => error.without_options(&["--terrain-layer", "--class"]).into(),
            other => other,
        })
    };
    let asked = job.options.unit;
    let first = read(&job.first, asked, "first")?;
    watch.holds(room::of_ground(&first.0));
    let second = read(&job.second, asked.or(first.1.unit), "second")?;
    let unit = asked.or(first.1.unit).or(second.1.unit).unwrap_or_default();
    systems::compare(watch, [("first", &first.1), ("second", &second.1)]);
    watch.holds(room::of_ground(&first.0) + room::of_ground(&second.0));
    room::for_overlay(first.0.triangles.len() + second.0.triangles.len(), &second.1.label, &watch.memory())?;
    watch.stage("compare");
    let found = overlay::between(&second.0, &first.0, None).map_err(|cause| apart(&cause, &first.1, &second.1))?;
    let inputs = vec![figures::input("first", &first.1), figures::input("second", &second.1)];
    let mut report = empty(inputs, unit.label().to_owned());
    let surfaces = change(&found);
    let beside = surfaces.first_only + surfaces.second_only;
    let whole = surfaces.common_area + surfaces.first_only.max(surfaces.second_only);
    let bounds = [
        ("max_volume", "volume between", job.bounds.volume, surfaces.above + surfaces.below, 0.0),
        ("max_area", "area of one only", job.bounds.area, beside, whole),
        ("max_height", "height", job.bounds.height.map(Most::Figure), surfaces.height_max, 0.0),
    ];
    for (bound, on, most, found, greater) in bounds {
        report.bounds.extend(most.map(|most| row(bound, on, most, found, greater)));
    }
    let differ = [surfaces.height_max > SAME_HEIGHT, beside > AREA_ROUNDING * whole].iter().filter(|differs| **differs).count();
    if job.bounds.exact {
        report.bounds.push(row("exact", "heights and extent", Most::Figure(0.0), differ as f64, 0.0));
    }
    report.same = differ == 0;
    report.surfaces = Some(surfaces);
    Ok(report)
}

fn change(found: &Between) -> SurfaceChange {
    let common = found.common_area();
    let step = |depth: Option<Depth>, sign: f64| {
        depth.map(|d| Step { height: sign * d.depth, at: Spot { x: d.place.x, y: d.place.y, z: d.place.z } })
    };
    let (highest, lowest) = (step(found.deepest_fill, 1.0), step(found.deepest_cut, -1.0));
    SurfaceChange {
        highest,
        lowest,
        height_max: [highest, lowest].iter().flatten().map(|step| step.height.abs()).fold(0.0, f64::max),
        height_mean: (found.fill - found.cut) / common,
        height_mean_absolute: (found.cut + found.fill) / common,
        above: found.fill,
        below: found.cut,
        common_area: common,
        same_area: found.areas.unaffected,
        first_only: found.areas.existing_uncovered,
        second_only: found.areas.design_uncovered,
    }
}

/// Why surfaces cannot be compared. The overlay calls the second design and the first existing.
fn apart(cause: &OverlayError, first: &Source, second: &Source) -> DiffError {
    let message = cause.to_string();
    let named = [
        ("the design mesh", "the second surface"),
        ("the existing mesh", "the first surface"),
        ("= design:", "= second:"),
        ("= existing:", "= first:"),
    ];
    let message = named.iter().fold(message, |message, (from, to)| message.replace(from, to));
    let help = match cause {
        OverlayError::Double { .. } => "keep one surface: delete the faces that lie below or above others",
        _ => "give two surfaces of the same place, in the same coordinates",
    };
    DiffError(format!("{}\n   = help: {help}", placed(&message, [&first.label, &second.label])))
}
