//! Cut and fill between two surfaces that are given.

use super::ground::read_ground_at;
use super::watch::{CHECKING, Named, Observer, Stopwatch, WRITING};
use super::{Desk, Error, desk, figures, room, systems, units};
use crate::kernel::range::range;
use crate::mesh::inside::inside;
use crate::mesh::volume::MeshAreas;
use crate::model::message::placed;
use crate::model::{Chain, Defect, Defects, LengthUnit, Note, Role, Terrain};
use crate::overlay::{self, Between, OverlayError, Surface};
use crate::read::terrain::TerrainOptions;
use crate::read::{ColumnOrder, InputFormat, Pick, ReadOptions, Source};
use crate::report::between::{BetweenDepths, BetweenReference, BetweenReport, BetweenTiming, BetweenVolumes, MeshFigures};
use crate::report::{
    Balance, Detail, Input, METHOD, METHOD_TEXT, ReportFormat, ResultFigures, RunRecord, SCHEMA, SIGN_RULE, Tool, Warning,
};
use crate::surface::Watch as _;
use crate::validate;
use crate::write::Target;
use glam::DVec2;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

/// Stage in which volumes are computed.
const VOLUMES: &str = "volumes";

/// Metres in a foot; the guess at a wrong unit needs no more digits.
const FOOT: f64 = 0.3048;

/// Two surfaces to be compared, and where the figures go.
#[derive(Clone, Debug)]
pub struct VolumeJob {
    /// What is compared.
    pub against: Against,
    /// Columns of text files of points without a header.
    pub csv_order: Option<ColumnOrder>,
    /// What is meant of the design, and of the existing surface, where a file holds several.
    pub picks: [Pick; 2],
    /// Unit of the run, if asked for; `None`: that of the design, else of the existing surface, else metres.
    pub unit: Option<LengthUnit>,
    /// A file of rings; only what lies inside counts.
    pub within: Option<PathBuf>,
    /// Columns of the file of rings, if it is text without a header.
    pub within_order: Option<ColumnOrder>,
    /// Where reports go.
    pub reports: Vec<(Target, ReportFormat)>,
    /// What was asked for, for reports in JSON.
    pub run: Option<RunRecord>,
}

impl VolumeJob {
    /// The files it reads.
    pub(super) fn inputs(&self) -> Vec<PathBuf> {
        let (design, existing) = self.against.paths();
        design.into_iter().chain([existing]).chain(&self.within).cloned().collect()
    }
}

/// What is compared.
#[derive(Clone, Debug)]
pub enum Against {
    /// Two meshes.
    Existing {
        /// The surface after the works.
        design: PathBuf,
        /// The surface before.
        existing: PathBuf,
    },
    /// A mesh that is brought to one level.
    Elevation {
        /// The surface before.
        existing: PathBuf,
        /// The level.
        elevation: f64,
    },
}

impl Against {
    /// The design, if there is one, and the existing surface.
    fn paths(&self) -> (Option<&PathBuf>, &PathBuf) {
        match self {
            Self::Existing { design, existing } => (Some(design), existing),
            Self::Elevation { existing, .. } => (None, existing),
        }
    }
}

/// What came out.
#[derive(Clone, Debug)]
pub struct Compared {
    /// The report.
    pub report: BetweenReport,
    /// The files that have appeared, in the order of the job; streams are not among them.
    pub written: Vec<Target>,
}

/// Why two surfaces could not be compared.
#[derive(Clone, Debug, PartialEq)]
pub struct ComparisonError {
    /// The files.
    pub labels: Vec<String>,
    /// Why.
    pub cause: OverlayError,
}

impl fmt::Display for ComparisonError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let help = match &self.cause {
            OverlayError::Empty(_) => "give a surface with faces, or with points that are not all on one line",
            OverlayError::Apart { design, existing } => apart(design, existing),
            OverlayError::Outside { .. } => "check the coordinates of the rings: they must be those of the meshes",
            OverlayError::Double { .. } => "keep one surface: delete the faces that lie below or above others",
        };
        write!(f, "{}\n   = help: {help}", placed(&self.cause.to_string(), &self.labels))
    }
}

impl std::error::Error for ComparisonError {}

/// A guess why two meshes do not meet.
fn apart(design: &[DVec2; 2], existing: &[DVec2; 2]) -> &'static str {
    let meets = |lo: DVec2, hi: DVec2| lo.cmple(existing[1]).all() && existing[0].cmple(hi).all();
    let [lo, hi] = *design;
    if meets(DVec2::new(lo.y, lo.x), DVec2::new(hi.y, hi.x)) {
        return "easting and northing of one of them look swapped";
    }
    if meets(lo * FOOT, hi * FOOT) || meets(lo / FOOT, hi / FOOT) {
        return "one of them looks as if it were in feet, the other in metres";
    }
    "give two surfaces of the same place, in the same coordinates"
}

/// Compares two surfaces. The outputs are opened first, and appear together at the end or not at all.
///
/// # Errors
/// [`Error`]; nothing has been written then, except what already went down a stream.
pub fn volume(job: &VolumeJob, observer: &dyn Observer) -> Result<Compared, Error> {
    volume_at(Desk::Disk, job, observer)
}

/// The same with files from elsewhere.
///
/// # Errors
/// As [`volume`].
pub fn volume_at(desk: Desk<'_>, job: &VolumeJob, observer: &dyn Observer) -> Result<Compared, Error> {
    let watch = Stopwatch::new(observer);
    let targets: Vec<Target> = job.reports.iter().map(|(target, _)| target.clone()).collect();
    let record = desk.records(&job.reports);
    let mut outputs = desk.open(&targets, &job.inputs(), record)?;

    let Surfaces { design, existing, unit } = read(desk, job, &watch)?;
    let area = job.within.as_ref().map(|path| rings(desk, path, job.within_order.as_ref(), unit, &watch)).transpose()?;

    watch.stage_of(VOLUMES);
    let within = area.as_ref().map(|(area, _)| area);
    let found = match (&job.against, &design) {
        (Against::Elevation { elevation, .. }, _) => overlay::to_elevation(&existing.0, *elevation, within),
        (Against::Existing { .. }, Some(design)) => overlay::between(&design.0, &existing.0, within),
        // The parser of jobs gives a design with an existing surface; there is nothing to compare without.
        (Against::Existing { .. }, None) => Err(OverlayError::Empty(Surface::Design)),
    };
    let sources = || design.iter().map(|d| &d.1).chain([&existing.1]);
    let surfaces = design.iter().map(|d| ("design", &d.1)).chain([("existing surface", &existing.1)]);
    systems::compare(&watch, surfaces.chain(area.iter().map(|(_, source)| ("file of rings", source))));
    let found = found.map_err(|cause| ComparisonError { labels: sources().map(|s| s.label.clone()).collect(), cause })?;
    notes(&found).iter().for_each(|note| Stopwatch::note(&watch, note));

    let roles = design.is_some().then_some("design").into_iter().chain(["existing"]);
    let mut inputs: Vec<Input> = roles.zip(sources()).map(|(role, source)| figures::input(role, source)).collect();
    inputs.extend(area.iter().map(|(_, source)| figures::input("within", source)));
    let meshes = design.iter().map(|d| ("design", &d.0)).chain([("existing", &existing.0)]);
    let mut report = BetweenReport {
        schema: SCHEMA,
        tool: Tool::default(),
        inputs,
        units: unit.into(),
        meshes: meshes.map(|(role, mesh)| mesh_figures(role, mesh)).collect(),
        volumes: volumes(&found, &job.against, &existing.1),
        areas: found.areas.into(),
        depths: BetweenDepths::from(&found),
        warnings: warnings(&watch.notes(), &found),
        run: None,
        result: None,
        timing: BetweenTiming::default(),
    };
    watch.stage_of(WRITING);
    report.timing = BetweenTiming {
        read: watch.seconds(|stage| stage != VOLUMES && stage != WRITING),
        volume: watch.seconds(|stage| stage == VOLUMES),
        total: watch.total(),
    };
    if record {
        report.run = job.run.clone();
        report.result = Some(ResultFigures::of(None, None, &report).map_err(desk::no_record)?);
    }
    let is_json = |index: usize| job.reports[index].1 == ReportFormat::Json;
    for index in desk::in_order(&targets, |_| true, is_json) {
        if let (true, Some(result)) = (is_json(index), &mut report.result) {
            result.outputs = desk::files(&outputs, &targets, is_json);
        }
        let own = desk::run_at(&report.run, &targets[index], is_json(index))
            .map(|run| BetweenReport { run: Some(run), ..report.clone() });
        outputs.write(index, |out| job.reports[index].1.write_between(out, own.as_ref().unwrap_or(&report)))?;
    }
    if let Some(result) = &mut report.result {
        result.outputs = desk::files(&outputs, &targets, is_json);
    }
    desk.commit(outputs)?;
    Ok(Compared { report, written: targets.into_iter().filter(|target| !target.is_stream()).collect() })
}

/// The surfaces of a job as read, in one unit.
struct Surfaces {
    design: Option<(Terrain, Source)>,
    existing: (Terrain, Source),
    unit: LengthUnit,
}

fn read(desk: Desk<'_>, job: &VolumeJob, watch: &Stopwatch<'_>) -> Result<Surfaces, Error> {
    let (design, existing) = job.against.paths();
    let [of_design, of_existing] = &job.picks;
    // The order is meant for the files that may have one.
    let no_order = !design.into_iter().chain([existing]).any(|path| InputFormat::may_have_order(path));
    let read = |path: &Path, pick: &Pick, unit, surface: Surface| {
        let csv_order = job.csv_order.clone().filter(|_| no_order || InputFormat::may_have_order(path));
        let options = TerrainOptions { csv_order, pick: pick.clone(), unit: job.unit, ..TerrainOptions::default() };
        read_ground_at(desk, path, &options, unit, &Named { watch, name: surface.name() }).map_err(|error| match error {
            Error::Read(error) => error.without_options(&["--terrain-layer"]).into(),
            other => other,
        })
    };
    let design = design.map(|path| read(path, of_design, job.unit, Surface::Design)).transpose()?;
    watch.holds(design.as_ref().map_or(0, |(ground, _)| room::of_ground(ground)));
    let declared = job.unit.or(design.as_ref().and_then(|(_, source)| source.unit));
    let existing = read(existing, of_existing, declared, Surface::Existing).map_err(|error| match error {
        // With a design beside it, the existing surface has an option of its own.
        Error::Read(error) if design.is_some() => error.with_option("--surface", "--existing-surface").into(),
        other => other,
    })?;
    let unit = declared.or(existing.1.unit).unwrap_or_default();
    let triangles = existing.0.triangles.len() + design.as_ref().map_or(0, |(ground, _)| ground.triangles.len());
    watch.holds(room::of_ground(&existing.0) + design.as_ref().map_or(0, |(ground, _)| room::of_ground(ground)));
    room::for_overlay(triangles, &existing.1.label, &watch.memory())?;
    Ok(Surfaces { design, existing, unit })
}

fn volumes(found: &Between, against: &Against, existing: &Source) -> BetweenVolumes {
    let reference = match against {
        Against::Existing { .. } => BetweenReference::Terrain { path: existing.label.clone() },
        Against::Elevation { elevation, .. } => BetweenReference::Plane { elevation: *elevation },
    };
    BetweenVolumes {
        method: METHOD,
        method_text: METHOD_TEXT,
        cut: found.cut,
        fill: found.fill,
        net: found.net(),
        sign_rule: SIGN_RULE,
        balance: Balance::of(found.cut, found.fill),
        complete: found.areas.design_uncovered == 0.0,
        cells: (found.cells > 0).then_some(found.cells),
        reference,
    }
}

/// Triangles that are measured together.
const PART: usize = 1 << 15;

/// Size, heights and areas of a mesh as it takes part.
fn mesh_figures(role: &'static str, mesh: &Terrain) -> MeshFigures {
    let of_some = |some: &[[u32; 3]]| {
        let corners = || some.iter().map(|t| t.map(|v| mesh.vertices[v as usize]));
        (MeshAreas::of(corners()), range(corners().flatten().map(|p| p.z)))
    };
    // In parts of fixed size, so that the sums are the same on any number of threads.
    let parts: Vec<(MeshAreas, (f64, f64))> = mesh.triangles.par_chunks(PART).map(of_some).collect();
    let (z_min, z_max) = range(parts.iter().flat_map(|(_, (low, high))| [*low, *high]));
    let mut areas = MeshAreas::default();
    parts.into_iter().for_each(|(part, _)| areas.join(part));
    MeshFigures {
        role,
        vertices: mesh.vertices.len(),
        triangles: mesh.triangles.len(),
        z_min,
        z_max,
        plan_area: areas.plan(),
        surface_area: areas.surface(),
    }
}

/// What is to be said about the result.
fn notes(found: &Between) -> Vec<Note> {
    let mut notes = Vec::new();
    let Between { areas, double, .. } = found;
    let whole = areas.design_uncovered + found.common_area();
    if areas.design_uncovered > 0.0 {
        let (area, percent) = (areas.design_uncovered, 100.0 * areas.design_uncovered / whole);
        // Where a plane is the design, what was asked for is the inside of rings.
        let level = found.cells == 0;
        let of = if level { "the area inside the rings" } else { "the design" };
        notes.push(Note::new(
            "design-uncovered",
            format!("{area:.3} square units of {of} ({percent:.3} %) do not lie over the existing surface; they have no volume"),
        ));
        if areas.existing_uncovered == 0.0 && !level {
            let message = "the existing surface lies wholly under the design, and is smaller: are the two swapped?";
            notes.push(Note::new("meshes-swapped", message));
        }
    }
    for (area, name) in double.iter().zip(["design", "existing"]) {
        if *area > 0.0 {
            let message =
                format!("{area:.3e} square units of the {name} mesh lie double, as slivers along seams; they may count twice");
            notes.push(Note::new("lies-double", message));
        }
    }
    notes
}

fn warnings(notes: &[Note], found: &Between) -> Vec<Warning> {
    let details = |code: &str| match code {
        "design-uncovered" => BTreeMap::from([("area", Detail::Number(found.areas.design_uncovered))]),
        _ => BTreeMap::new(),
    };
    notes.iter().map(|note| Warning::of(note, details(note.code))).collect()
}

/// The area inside the rings of a file. Elevations do not matter.
fn rings(
    desk: Desk<'_>,
    path: &Path,
    order: Option<&ColumnOrder>,
    unit: LengthUnit,
    watch: &Stopwatch<'_>,
) -> Result<(Terrain, Source), Error> {
    watch.stage_of(CHECKING);
    let (csv_order, memory) = (order.cloned(), watch.memory());
    let options = ReadOptions { unit: Some(unit), csv_order, flat: true, memory, ..ReadOptions::default() };
    let mut raw = desk.line(path, &options).map_err(|error| {
        error.with_option("--csv-order", "--within-order").without_options(&["--feature", "--layer", "--input-format"])
    })?;
    if let Some(note) = units::convert_line(&mut raw, unit) {
        watch.note(&note);
    }
    raw.lines.iter_mut().flat_map(|line| &mut line.vertices).for_each(|v| v.z = Some(0.0));
    let checked = validate::check(&raw, &validate::Options::default())?;
    let label = &raw.source.label;
    let mut defects = Defects::default();
    for chain in checked.line.chains.iter().filter(|chain| chain.role == Role::Open) {
        defects.push("not-a-ring", || Defect {
            code: "not-a-ring",
            what: format!("`{}` is not a ring", chain.name),
            at: label.clone(),
            figures: Some(ends(chain)),
            help: "give polygons, or lines that end where they begin".to_owned(),
        });
    }
    defects.into_result()?;
    let plan = |chain: &Chain| chain.vertices.iter().map(|v| v.truncate()).collect();
    let rings: Vec<Vec<DVec2>> = checked.line.chains.iter().map(plan).collect();
    let area = inside(&rings).map_err(|cause| {
        let mut defects = Defects::default();
        defects.push("rings-cross", || Defect {
            code: "rings-cross",
            what: "the area inside the rings cannot be found".to_owned(),
            at: label.clone(),
            figures: Some(cause.to_string()),
            help: "give rings that do not cross each other".to_owned(),
        });
        defects
    })?;
    Ok((area, raw.source))
}

fn ends(chain: &Chain) -> String {
    let show = |p: Option<&glam::DVec3>| p.map_or_else(String::new, |p| format!("{}, {}", p.x, p.y));
    format!("it begins at {} and ends at {}", show(chain.vertices.first()), show(chain.vertices.last()))
}
