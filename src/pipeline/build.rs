//! The main job: a line to a surface, its files and its report.

mod contents;

pub(super) use contents::targets;

use super::error::NoStation;
use super::heads::{LocalOrigin, Names, coarse, has_colours, heights_over, local_origin, stale_origins};
use super::watch::{CHECKING, Observer, PREPARING, READING, READING_GROUND, Stopwatch, WRITING};
use super::{
    BuriedError, Desk, Error, Given, GroundInput, LineInput, Rasters, Wishes, check_steepness, desk, figures, on_ground, rasters,
    read_line, room, systems,
};
use crate::ground::{Pieces, Stations, Tallied, axes};
use crate::kernel::frame::Frame;
use crate::mesh::fingerprint::fingerprint;
use crate::model::{Bulking, Line, LineFeature, Note, Sheet, Terrain, Tin};
use crate::plot::{Drawing, OnGround, Scene};
use crate::read::Source;
use crate::report::{CrossfallFigures, Report, ReportFormat, ResultFigures, RunRecord, Warning};
use crate::setout::{self, Staked};
use crate::slope::levels::LEVEL_SNAP;
use crate::surface::{self, Watch as _};
use crate::write::{Earthworks, LineFormat, MeshFormat, RasterFormat, Target};
use contents::{Made, contents};
use std::path::Path;

/// A surface to be built, and where to put it.
#[derive(Clone, Debug)]
pub struct BuildJob {
    /// The line.
    pub input: LineInput,
    /// What is wanted; with existing ground one for each sheet, at most two. Never empty.
    pub wishes: Vec<Wishes>,
    /// The existing ground.
    pub ground: Option<GroundInput>,
    /// Elevation of the plane the volumes are taken against; `None`: where the slopes end.
    pub reference: Option<f64>,
    /// Spacing of the stations that volumes are told apart by, with existing ground, and of slope stakes.
    pub stations: Option<f64>,
    /// How the soil changes its volume, if that is to be reckoned with; with existing ground only.
    pub bulking: Option<Bulking>,
    /// Refuse lines with buried stretches.
    pub strict: bool,
    /// Where meshes go.
    pub meshes: Vec<(Target, MeshFormat)>,
    /// Where the finished ground goes; needs existing ground.
    pub finished: Vec<(Target, MeshFormat)>,
    /// Where rasters of both go.
    pub rasters: Rasters,
    /// Where line work goes.
    pub lines: Vec<(Target, LineFormat)>,
    /// Where slope stakes go; they need stations.
    pub stakes: Vec<Target>,
    /// Where drawings go.
    pub plots: Vec<(Target, Drawing)>,
    /// Stations of the cross-sections to be drawn; none: all of `stations`, in a report some.
    pub sections: Vec<f64>,
    /// Where tables of the stations go, as CSV; needs stations.
    pub station_tables: Vec<Target>,
    /// Origin of the meshes for viewers. `None`: world coordinates in the formats that hold doubles.
    pub local_origin: Option<LocalOrigin>,
    /// Where reports go.
    pub reports: Vec<(Target, ReportFormat)>,
    /// What was asked for, for reports in JSON.
    pub run: Option<RunRecord>,
}

/// What was built.
#[derive(Clone, Debug)]
pub struct Built {
    /// The report.
    pub report: Report,
    /// The files that have appeared, in the order of the job; streams are not among them.
    pub written: Vec<Target>,
}

/// Builds a surface and writes it. The outputs are opened first, and appear together at the end or not at all.
///
/// # Errors
/// [`Error`]; nothing has been written then, except what already went down a stream.
pub fn build(job: &BuildJob, observer: &dyn Observer) -> Result<Built, Error> {
    build_at(Desk::Disk, job, observer)
}

/// The same with files from elsewhere.
///
/// # Errors
/// As [`build`].
pub fn build_at(desk: Desk<'_>, job: &BuildJob, observer: &dyn Observer) -> Result<Built, Error> {
    let watch = Stopwatch::new(observer);
    let (targets, contents): (Vec<Target>, Vec<_>) = contents(job).into_iter().unzip();
    let ground_path = job.ground.as_ref().map(|ground| ground.path.as_path());
    let inputs: Vec<&Path> = std::iter::once(job.input.path.as_path()).chain(ground_path).collect();
    let record = desk.records(&job.reports);
    let mut outputs = desk.open(&targets, &inputs, record)?;

    let Given { line, source, unit } = read_line(&job.input, desk, &watch)?;
    check_sections(job, &line)?;
    let Product { design, finished, lines, survey, ground, mut report } = match &job.ground {
        Some(ground) => on_ground::build(desk, job, ground, &line, &source, unit, &watch)?,
        None => alone(job, &line, &source, &watch)?,
    };
    report.units = unit.into();
    if let Some(road) = &job.input.formation {
        report.line.width = Some(road.width);
        report.line.crossfall = Some(CrossfallFigures { left: road.crossfall.left, right: road.crossfall.right });
    }

    let Staked { stakes, missing } = match job.stakes.is_empty() {
        true => Staked::default(),
        false => staked(job, &line, &design, &lines, survey.as_ref())?,
    };
    if missing > 0 {
        let message = format!(
            "{missing} sides of stations have a slope that leaves the line otherwise than expected; stakes are missing there"
        );
        let note = Note::new("stakes-missing", message);
        watch.note(&note);
        report.warnings.push(Warning::plain(&note));
    }

    // The ground itself is held on for drawings only.
    let drawn = survey.as_ref().map_or(0, |survey| room::of_ground(&survey.terrain));
    watch.holds(drawn + room::of_tin(&design) + finished.as_ref().map_or(0, room::of_tin));
    let grid = |wanted: &[(Target, RasterFormat)], tin: &Tin| match wanted.is_empty() {
        true => Ok(None),
        false => rasters::sample(tin, job.rasters.cell, wanted, &source.label, &watch.memory()).map(Some),
    };
    let raster = grid(&job.rasters.design, &design)?;
    let finished_raster = finished.as_ref().map(|tin| grid(&job.rasters.finished, tin)).transpose()?.flatten();

    watch.stage_of(WRITING);
    let local = local_origin(job, &design, finished.as_ref());
    if let Some(note) = coarse(job, &design, finished.as_ref(), local) {
        watch.note(&note);
        report.warnings.push(Warning::plain(&note));
    }
    let names = Names::of(job);
    let earthworks = report.volumes.as_ref().filter(|_| job.ground.is_some());
    let earthworks = earthworks.map(|v| Earthworks { ground: &names.ground, cut: v.cut, fill: v.fill });
    let reference = systems::reference(&source, ground.as_ref(), job.input.unit, unit);
    let over_ground = |tin: &Tin| survey.as_ref().filter(|_| has_colours(job)).and_then(|s| heights_over(tin, &s.terrain));
    let made = Made {
        job,
        targets: &targets,
        contents: &contents,
        scene: Scene {
            title: &source.label,
            unit,
            crs: reference.crs,
            line: &line,
            design: &design,
            lines: &lines,
            bulking: job.bulking,
            ground: survey.as_ref().map(Survey::scene),
        },
        names: &names,
        earthworks,
        local,
        depths: over_ground(&design),
        raster,
        finished: finished.as_ref(),
        finished_depths: finished.as_ref().and_then(over_ground),
        finished_raster,
        reference,
        stakes: &stakes,
    };
    if !job.plots.is_empty() || job.reports.iter().any(|(_, format)| format.draws()) {
        room::for_drawings(&design, &source.label, &watch.memory())?;
    }
    // What a report in JSON tells of the others is known when they are written; hashes of meshes are taken meanwhile.
    let (before, after) = made.in_order();
    let mut hashes = (None, None);
    rayon::in_place_scope(|scope| {
        if record {
            let hashes = &mut hashes;
            let (design, finished) = (&design, finished.as_ref());
            scope.spawn(move |_| *hashes = (Some(fingerprint(design)), finished.map(fingerprint)));
        }
        before.into_iter().try_for_each(|index| {
            stamp(&mut report, &watch);
            made.put(&mut outputs, index, &report).map(drop)
        })
    })?;
    if record {
        report.run = job.run.clone();
        let mut result = ResultFigures::of(hashes.0, hashes.1, &report).map_err(desk::no_record)?;
        result.outputs = desk::files(&outputs, &targets, |index| made.is_json(index));
        report.result = Some(result);
    }
    for index in after {
        stamp(&mut report, &watch);
        made.put(&mut outputs, index, &report)?;
    }
    desk.commit(outputs)?;
    if matches!(desk, Desk::Disk) {
        // What lies about on the disk is no part of the result.
        stale_origins(job).for_each(|note| observer.note(&note));
    }
    stamp(&mut report, &watch);
    let written = targets.into_iter().filter(|target| !target.is_stream()).collect();
    Ok(Built { report, written })
}

/// Refuses cross-sections where there is no line.
fn check_sections(job: &BuildJob, line: &Line) -> Result<(), NoStation> {
    let longest = axes(line, &Frame::WORLD).iter().map(|axis| axis.length).fold(0.0, f64::max);
    let beside = job.sections.iter().copied().find(|station| !(0.0..=longest).contains(station));
    beside.map_or(Ok(()), |station| Err(NoStation { station, longest }))
}

/// The note about elevations that were asked for and have no level curve.
pub(super) fn missed_levels(wishes: &[Wishes], levels: &[f64]) -> Option<Note> {
    let asked = wishes.first().map_or(&[][..], |wishes| &wishes.levels);
    let met = |z: f64| levels.iter().any(|level| (level - z).abs() <= LEVEL_SNAP);
    let missed: Vec<String> = asked.iter().filter(|z| !met(**z)).map(f64::to_string).collect();
    let message = || format!("there is no level curve at {}: the slopes do not cross this height", missed.join(", "));
    (!missed.is_empty()).then(|| Note::new("level-missed", message()))
}

/// The slope stakes of a design.
fn staked(job: &BuildJob, line: &Line, design: &Tin, lines: &[LineFeature], survey: Option<&Survey>) -> Result<Staked, Error> {
    let slope = |sheet| job.wishes.iter().find(|wishes| wishes.sheet == sheet).map(|wishes| wishes.slope);
    let own = match survey {
        Some(_) => None,
        None => Some(Stations::new(axes(line, &design.frame), job.stations)?),
    };
    let Some(stations) = survey.map(|survey| &survey.stations).or(own.as_ref()) else { return Ok(Staked::default()) };
    Ok(setout::stakes(&setout::Lie {
        line,
        design,
        lines,
        ground: survey.map(|survey| &survey.terrain),
        stations,
        slopes: setout::Slopes { fill: slope(Sheet::Falling), cut: slope(Sheet::Rising) },
        tolerance: job.input.tolerance,
    }))
}

/// What is written.
pub(super) struct Product {
    pub(super) design: Tin,
    pub(super) finished: Option<Tin>,
    pub(super) lines: Vec<LineFeature>,
    /// What drawings and setting out ask of the ground, where the job [`draws`](BuildJob::draws).
    pub(super) survey: Option<Survey>,
    /// Where the ground came from.
    pub(super) ground: Option<Source>,
    pub(super) report: Report,
}

/// The ground, and the works piece by piece.
pub(super) struct Survey {
    pub(super) terrain: Terrain,
    pub(super) pieces: Pieces,
    pub(super) stations: Stations,
    pub(super) tallied: Tallied,
}

impl Survey {
    fn scene(&self) -> OnGround<'_> {
        OnGround { terrain: &self.terrain, pieces: &self.pieces, stations: &self.stations, tallied: &self.tallied }
    }
}

impl BuildJob {
    /// Whether an output holds the finished ground.
    pub(super) fn wants_finished(&self) -> bool {
        !self.finished.is_empty() || !self.rasters.finished.is_empty()
    }

    /// Whether an output needs ground and pieces of the works, beyond meshes, line work and figures.
    pub(super) fn draws(&self) -> bool {
        let pages = self.reports.iter().any(|(_, format)| format.draws());
        !self.stakes.is_empty() || !self.plots.is_empty() || pages || has_colours(self)
    }
}

/// Builds without existing ground.
fn alone(job: &BuildJob, line: &Line, source: &Source, watch: &Stopwatch<'_>) -> Result<Product, Error> {
    let mut chosen = Vec::new();
    let Some(wishes) = job.wishes.first() else { return Err(surface_error(source, surface::SurfaceError::NoSide)) };
    let design = wishes.settle(line, &source.label, &mut chosen)?;
    chosen.iter().for_each(|note| watch.note(note));
    check_steepness(line, source, design.slope)?;
    let surface = surface::build(line, &design, job.reference, watch).map_err(|cause| surface_error(source, cause))?;
    surface.notes.iter().for_each(|note| watch.note(note));
    let buried = figures::buried(line, &surface);
    if job.strict && !buried.is_empty() {
        return Err(BuriedError { label: source.label.clone(), stretches: buried }.into());
    }
    if let Some(note) = figures::buried_note(&buried) {
        watch.note(&note);
    }
    missed_levels(&job.wishes, &surface.levels).iter().for_each(|note| watch.note(note));
    let report = figures::report(line, source, &design, &surface, &watch.notes());
    Ok(Product { design: surface.tin, finished: None, lines: surface.lines, survey: None, ground: None, report })
}

fn surface_error(source: &Source, cause: surface::SurfaceError) -> Error {
    Error::Surface { label: source.label.clone(), cause }
}

/// Writes the times into the report.
fn stamp(report: &mut Report, watch: &Stopwatch<'_>) {
    /// The engine's stages of areas and volumes; with existing ground also of what follows from them.
    const VOLUMES: [&str; 4] = ["volumes", "works", "daylight", "finished ground"];
    const LINE: [&str; 2] = [READING, CHECKING];
    const GROUND: [&str; 2] = [READING_GROUND, PREPARING];
    let timing = &mut report.timing;
    timing.read = watch.seconds(|stage| LINE.contains(&stage));
    timing.terrain = report.terrain.map(|_| watch.seconds(|stage| GROUND.contains(&stage)));
    timing.volume = watch.seconds(|stage| VOLUMES.contains(&stage));
    // Whatever other stages there are, are those of the surface itself.
    let around = |stage: &str| LINE.contains(&stage) || GROUND.contains(&stage) || VOLUMES.contains(&stage) || stage == WRITING;
    timing.surface = watch.seconds(|stage| !around(stage));
    timing.write = watch.seconds(|stage| stage == WRITING);
    timing.total = watch.total();
}
