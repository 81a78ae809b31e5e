//! The main job: a line to a surface, its files and its report.

use super::error::NoStation;
use super::heads::{LocalOrigin, Names, coarse, has_colours, heights_over, is_local, local_origin};
use super::watch::{CHECKING, Observer, PREPARING, READING, READING_GROUND, Stopwatch, WRITING};
use super::{
    BuriedError, Desk, Error, Given, GroundInput, LineInput, Rasters, Wishes, check_steepness, desk, figures, on_ground, rasters,
    read_line, room,
};
use crate::ground::{Pieces, Stations, Tallied, axes};
use crate::kernel::frame::Frame;
use crate::mesh::fingerprint::fingerprint;
use crate::model::{Bulking, Line, LineFeature, Note, Sheet, Terrain, Tin};
use crate::plot::{self, Drawing, OnGround, Scene};
use crate::read::Source;
use crate::report::{CrossfallFigures, Report, ReportFormat, ResultFigures, RunRecord, Warning, write_station_table};
use crate::setout::{self, Stake};
use crate::slope::levels::LEVEL_SNAP;
use crate::surface::{self, Watch as _};
use crate::write::{
    Delivery, Earthworks, Head, LineFormat, MeshFormat, Outputs, RasterFormat, Target, WriteError, origin, write_origin,
    write_stakes,
};
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

/// What one output holds.
#[derive(Clone, Copy)]
enum Content {
    Mesh(MeshFormat),
    Finished(MeshFormat),
    Raster(RasterFormat),
    FinishedRaster(RasterFormat),
    Lines(LineFormat),
    Stakes,
    Plot(Drawing),
    Stations,
    /// Origin of the mesh of the output with this number.
    Origin(usize),
    Report(ReportFormat),
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
    let (targets, contents): (Vec<Target>, Vec<Content>) = wanted(job).into_iter().unzip();
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

    let stakes = match job.stakes.is_empty() {
        true => Vec::new(),
        false => staked(job, &line, &design, survey.as_ref())?,
    };

    // The ground itself is held on for drawings only.
    let drawn = survey.as_ref().map_or(0, |survey| room::of_ground(&survey.terrain));
    watch.holds(drawn + room::of_tin(&design) + finished.as_ref().map_or(0, room::of_tin));
    let grid = |wanted: &[(Target, RasterFormat)], tin: &Tin| match wanted.is_empty() {
        true => Ok(None),
        false => rasters::sample(tin, job.rasters.cell, wanted, &source.label, &watch.memory()).map(Some),
    };
    let raster = grid(&job.rasters.design, &design)?;
    let finished_raster = finished.as_ref().map(|tin| grid(&job.rasters.finished, tin)).transpose()?.flatten();
    let reference = rasters::reference(&source, ground.as_ref(), job.input.unit, unit);

    watch.stage_of(WRITING);
    let local = local_origin(job, &design, finished.as_ref());
    if let Some(note) = coarse(job, &design, finished.as_ref(), local) {
        watch.note(&note);
        report.warnings.push(Warning::plain(&note));
    }
    let names = Names::of(job);
    let earthworks = report.volumes.as_ref().filter(|_| job.ground.is_some());
    let earthworks = earthworks.map(|v| Earthworks { ground: &names.ground, cut: v.cut, fill: v.fill });
    // Of the line, else of the ground.
    let crs = report.inputs.iter().find_map(|input| input.crs.clone());
    let crs = crs.as_deref();
    let scene = Scene {
        title: &source.label,
        unit,
        crs,
        line: &line,
        design: &design,
        lines: &lines,
        bulking: job.bulking,
        ground: survey.as_ref().map(Survey::scene),
    };
    let head = Head { crs, unit, name: &names.design, lines: &lines, earthworks, origin: None, depths: None };
    let about = |format: MeshFormat| Head { origin: Some(local).filter(|_| is_local(job, format)), ..head };
    let over_ground = |tin: &Tin| survey.as_ref().filter(|_| has_colours(job)).and_then(|s| heights_over(tin, &s.terrain));
    let (depths, finished_depths) = (over_ground(&design), finished.as_ref().and_then(over_ground));
    if !job.plots.is_empty() || job.reports.iter().any(|(_, format)| format.draws()) {
        room::for_drawings(&design, &source.label, &watch.memory())?;
    }
    let is_json = |index: usize| matches!(contents[index], Content::Report(ReportFormat::Json));
    let put = |outputs: &mut Outputs, index: usize, report: &Report| -> Result<Delivery, WriteError> {
        outputs.write(index, |out| match contents[index] {
            Content::Mesh(format) => format.write(out, &design, &Head { depths: depths.as_deref(), ..about(format) }),
            Content::Finished(format) => {
                let head = Head { name: &names.finished, depths: finished_depths.as_deref(), ..about(format) };
                finished.as_ref().map_or(Ok(()), |tin| format.write(out, tin, &head))
            }
            Content::Lines(format) => format.write(out, &head),
            Content::Origin(mesh) => match &targets[mesh] {
                Target::File(path) => write_origin(out, path, &Head { origin: Some(local), ..head }),
                Target::Stdout => Ok(()),
            },
            Content::Raster(format) => match &raster {
                Some((layout, values)) => format.write(out, layout, values, &reference),
                None => Ok(()),
            },
            Content::FinishedRaster(format) => match &finished_raster {
                Some((layout, values)) => format.write(out, layout, values, &reference),
                None => Ok(()),
            },
            Content::Stakes => write_stakes(out, &stakes),
            Content::Stations => write_station_table(out, report),
            Content::Plot(drawing) => Ok(out.write_all(plot::file(&scene, drawing, &job.sections).as_bytes())?),
            Content::Report(format) => {
                let own = desk::run_at(&report.run, &targets[index], is_json(index));
                let own = own.map(|run| Report { run: Some(run), ..report.clone() });
                format.write(out, own.as_ref().unwrap_or(report), &scene, &job.sections)
            }
        })
    };
    // What a report in JSON tells of the others is known when they are written; hashes of meshes are taken meanwhile.
    let (before, after) = in_order(&targets, &contents);
    let mut hashes = (None, None);
    rayon::in_place_scope(|scope| {
        if record {
            let hashes = &mut hashes;
            let (design, finished) = (&design, finished.as_ref());
            scope.spawn(move |_| *hashes = (Some(fingerprint(design)), finished.map(fingerprint)));
        }
        before.into_iter().try_for_each(|index| {
            stamp(&mut report, &watch);
            put(&mut outputs, index, &report).map(drop)
        })
    })?;
    if record {
        report.run = job.run.clone();
        let mut result = ResultFigures::of(hashes.0, hashes.1, &report).map_err(desk::no_record)?;
        result.outputs = desk::files(&outputs, &targets, is_json);
        report.result = Some(result);
    }
    for index in after {
        stamp(&mut report, &watch);
        put(&mut outputs, index, &report)?;
    }
    desk.commit(outputs)?;
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
fn staked(job: &BuildJob, line: &Line, design: &Tin, survey: Option<&Survey>) -> Result<Vec<Stake>, Error> {
    let slope = |sheet| job.wishes.iter().find(|wishes| wishes.sheet == sheet).map(|wishes| wishes.slope);
    let own = match survey {
        Some(_) => None,
        None => Some(Stations::new(axes(line, &design.frame), job.stations)?),
    };
    let Some(stations) = survey.map(|survey| &survey.stations).or(own.as_ref()) else { return Ok(Vec::new()) };
    Ok(setout::stakes(&setout::Lie {
        line,
        design,
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

/// All outputs of a job.
pub(super) fn targets(job: &BuildJob) -> Vec<Target> {
    wanted(job).into_iter().map(|(target, _)| target).collect()
}

fn wanted(job: &BuildJob) -> Vec<(Target, Content)> {
    let meshes = job.meshes.iter().map(|(target, format)| (target.clone(), Content::Mesh(*format)));
    let finished = job.finished.iter().map(|(target, format)| (target.clone(), Content::Finished(*format)));
    let rasters = job.rasters.design.iter().map(|(target, format)| (target.clone(), Content::Raster(*format)));
    let finished_rasters = job.rasters.finished.iter();
    let finished_rasters = finished_rasters.map(|(target, format)| (target.clone(), Content::FinishedRaster(*format)));
    let lines = job.lines.iter().map(|(target, format)| (target.clone(), Content::Lines(*format)));
    let reports = job.reports.iter().map(|(target, format)| (target.clone(), Content::Report(*format)));
    let tables = job.station_tables.iter().map(|target| (target.clone(), Content::Stations));
    let stakes = job.stakes.iter().map(|target| (target.clone(), Content::Stakes));
    let plots = job.plots.iter().map(|(target, drawing)| (target.clone(), Content::Plot(*drawing)));
    let mut all: Vec<(Target, Content)> = meshes.chain(finished).collect();
    // Beside every file that does not hold world coordinates stands one that tells its origin.
    for mesh in 0..all.len() {
        if let (Target::File(path), Content::Mesh(format) | Content::Finished(format)) = &all[mesh]
            && is_local(job, *format)
            && !all[mesh].0.is_stream()
        {
            all.push((Target::File(origin::sidecar(path)), Content::Origin(mesh)));
        }
    }
    all.extend(rasters.chain(finished_rasters).chain(lines).chain(stakes).chain(tables).chain(plots).chain(reports));
    all
}

/// The order in which outputs are written, up to the first report in JSON and from there. Files first, because they can still be
/// taken back; standard output last; of each kind reports last, because they tell how long the rest took, those in JSON behind
/// the others.
fn in_order(targets: &[Target], contents: &[Content]) -> (Vec<usize>, Vec<usize>) {
    let is_json = |i: usize| matches!(contents[i], Content::Report(ReportFormat::Json));
    let mut order: Vec<usize> = (0..targets.len()).collect();
    order.sort_by_key(|&i| {
        let stdout = targets[i] == Target::Stdout;
        (stdout, targets[i].is_stream(), matches!(contents[i], Content::Report(_)), is_json(i))
    });
    let first = order.iter().position(|&i| is_json(i)).unwrap_or(order.len());
    let after = order.split_off(first);
    (order, after)
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
