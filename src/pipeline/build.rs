//! The main job: a line to a surface, its files and its report.

use super::watch::{CHECKING, Observer, READING, Stopwatch, WRITING};
use super::{BuriedError, Error, LineInput, Wishes, check_steepness, figures, read_line};
use crate::report::{Report, ReportFormat};
use crate::surface;
use crate::write::{Delivery, MeshFormat, Outputs, Target, WriteError, write_lines};

/// A surface to be built, and where to put it.
#[derive(Clone, Debug)]
pub struct BuildJob {
    /// The line.
    pub input: LineInput,
    /// What is wanted.
    pub wishes: Wishes,
    /// Elevation of the plane the volumes are taken against; `None`: where the slopes end.
    pub reference: Option<f64>,
    /// Refuse lines with buried stretches.
    pub strict: bool,
    /// Where meshes go.
    pub meshes: Vec<(Target, MeshFormat)>,
    /// Where line work goes.
    pub lines: Vec<Target>,
    /// Where reports go.
    pub reports: Vec<(Target, ReportFormat)>,
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
    Lines,
    Report(ReportFormat),
}

/// Builds a surface and writes it. The outputs are opened first, and appear together at the end or not at all.
///
/// # Errors
/// [`Error`]; nothing has been written then, except what already went down a stream.
pub fn build(job: &BuildJob, observer: &dyn Observer) -> Result<Built, Error> {
    let watch = Stopwatch::new(observer);
    let (targets, contents): (Vec<Target>, Vec<Content>) = wanted(job).into_iter().unzip();
    let mut outputs = Outputs::open(&targets, &[&job.input.path])?;

    let (line, source) = read_line(&job.input, &watch)?;
    let mut chosen = Vec::new();
    let design = job.wishes.settle(&line, &source.label, &mut chosen)?;
    chosen.iter().for_each(|note| watch.note(note));
    check_steepness(&line, &source, design.slope)?;
    let surface = surface::build(&line, &design, job.reference, &watch)
        .map_err(|cause| Error::Surface { label: source.label.clone(), cause })?;
    surface.notes.iter().for_each(|note| watch.note(note));
    let buried = figures::buried(&line, &surface);
    if job.strict && !buried.is_empty() {
        return Err(BuriedError { label: source.label, stretches: buried }.into());
    }
    if let Some(note) = figures::buried_note(&buried) {
        watch.note(&note);
    }
    let mut report = figures::report(&line, job.input.formation.as_ref(), &source, &design, &surface, &watch.notes());

    watch.stage_of(WRITING);
    let crs = source.crs.as_deref();
    let mut put = |index: usize, report: &Report| -> Result<Delivery, WriteError> {
        outputs.write(index, |out| match contents[index] {
            Content::Mesh(format) => format.write(out, &surface.tin),
            Content::Lines => write_lines(out, &surface.lines, crs).map(drop),
            Content::Report(format) => format.write(out, report),
        })
    };
    for index in in_order(&targets, &contents) {
        if matches!(contents[index], Content::Report(_)) {
            stamp(&mut report, &watch);
        }
        put(index, &report)?;
    }
    outputs.commit()?;
    stamp(&mut report, &watch);
    let written = targets.into_iter().filter(|target| !target.is_stream()).collect();
    Ok(Built { report, written })
}

fn wanted(job: &BuildJob) -> Vec<(Target, Content)> {
    let meshes = job.meshes.iter().map(|(target, format)| (target.clone(), Content::Mesh(*format)));
    let lines = job.lines.iter().map(|target| (target.clone(), Content::Lines));
    let reports = job.reports.iter().map(|(target, format)| (target.clone(), Content::Report(*format)));
    meshes.chain(lines).chain(reports).collect()
}

/// The order in which outputs are written. Files first, because they can still be taken back; standard output last; of each kind
/// reports last, because they tell how long the rest took.
fn in_order(targets: &[Target], contents: &[Content]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..targets.len()).collect();
    order.sort_by_key(|&i| {
        let stdout = targets[i] == Target::Stdout;
        (stdout, targets[i].is_stream(), matches!(contents[i], Content::Report(_)))
    });
    order
}

/// Writes the times into the report.
fn stamp(report: &mut Report, watch: &Stopwatch<'_>) {
    /// The engine's stage of areas and volumes.
    const VOLUMES: &str = "volumes";
    /// All but the surface itself; whatever other stages there are, are its own.
    const AROUND: [&str; 4] = [READING, CHECKING, VOLUMES, WRITING];
    let timing = &mut report.timing;
    timing.read = watch.seconds(|stage| stage == READING || stage == CHECKING);
    timing.surface = watch.seconds(|stage| !AROUND.contains(&stage));
    timing.volume = watch.seconds(|stage| stage == VOLUMES);
    timing.write = watch.seconds(|stage| stage == WRITING);
    timing.total = watch.total();
}
