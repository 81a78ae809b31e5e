//! `slopegen batch`: many job files, one summary.

use super::build;
use super::console::{self, Screen};
use super::exit_code::Code;
use super::help;
use super::job_file::{self, JobFile};
use super::running::{self, Running};
use super::usage::{Checks, UsageErrors};
use crate::model::{Memory, Note};
use crate::pipeline::{self, Batch, BuildJob, Built, Error, Observer};
use crate::read::ReadError;
use crate::report::{BatchReport, JobResult, JobRow, JobVolumes, Warning, render_batch};
use crate::surface::Watch;
use crate::write::{Clash, Footprint, Outputs, Target, first_clash};
use clap::Args;
use std::ffi::OsString;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

/// More jobs at once than any machine has memory for.
const MOST_AT_ONCE: usize = 1024;

#[derive(Debug, Args)]
pub(super) struct BatchArgs {
    /// Job files (.toml), or folders: all job files in them
    #[arg(value_name = "JOB", required_unless_present = "list")]
    pub(super) job: Vec<PathBuf>,
    /// Also the job files named in this text file, one a line, relative to its folder; # begins a comment
    #[arg(long, value_name = "FILE", help_heading = help::INPUT)]
    pub(super) list: Option<PathBuf>,

    /// Jobs at once [default: one for each processor]
    #[arg(short, long, value_name = "N", allow_negative_numbers = true, help_heading = help::RUNNING)]
    pub(super) jobs: Option<String>,
    /// Do all jobs whatever becomes of the others; the default
    #[arg(short, long, help_heading = help::RUNNING)]
    pub(super) keep_going: bool,
    /// Begin no further job after one has failed
    #[arg(long, conflicts_with = "keep_going", help_heading = help::RUNNING)]
    pub(super) fail_fast: bool,

    /// Write the summary; .json or .txt, may be repeated. As text to standard output as well, unless --quiet
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,

    #[command(flatten)]
    pub(super) running: Running,
}

/// One job of a batch.
struct Task {
    label: String,
    /// The job with its file, or why there is none.
    job: anyhow::Result<(BuildJob, JobFile)>,
}

/// What became of a job, and what was said on the way.
struct Outcome {
    row: JobRow,
    code: Code,
    notes: Vec<Note>,
}

/// Runs many jobs, and exits with the gravest of their codes.
pub(super) fn run(args: &BatchArgs) -> anyhow::Result<Code> {
    let mut checks = Checks::default();
    let at_once = checks.whole("--jobs", args.jobs.as_ref(), "jobs", 1..=MOST_AT_ONCE);
    let mut reports = checks.plain_reports(&args.report, args.running.quiet);
    checks.finish(Some(()))?;
    let at_once = at_once.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let tasks: Vec<Task> = paths(args)?.iter().map(|path| task(path)).collect();
    let mut inputs: Vec<PathBuf> = tasks.iter().map(|task| PathBuf::from(&task.label)).collect();
    inputs.extend(args.list.clone());
    apart(&tasks, Footprint { outputs: console::targets(&reports), inputs: inputs.clone() })?;
    let memory = running::start(&args.running)?;
    let all = console::targets(&reports);
    let screen = Screen::take(&mut reports, &all);
    let outputs = Outputs::open(&console::targets(&reports), &inputs).map_err(Error::from)?;

    let begun = Instant::now();
    let batch = Batch { at_once: at_once.min(tasks.len()), fail_fast: args.fail_fast };
    // Whatever the others take, so that what is refused does not depend on who is first.
    let share = memory.shared(batch.at_once);
    let refused = args.fail_fast && tasks.iter().any(|task| task.job.is_err());
    let work = |index: usize| {
        let outcome = work(&tasks[index], refused, share);
        // Where nothing is run, all files that are wrong are told.
        (refused || outcome.as_ref().is_some_and(|outcome| outcome.code == Code::Done), outcome)
    };
    let broken = |index: usize| Some(failed(&tasks[index].label, Code::Check, BROKEN.to_owned(), 0.0));
    let tell = |_: usize, outcome: &Option<Outcome>| outcome.iter().for_each(|outcome| tell(outcome, &args.running));
    let outcomes = pipeline::run_batch(tasks.len(), batch, work, broken, tell);
    let code = gravest(outcomes.iter().flatten().flatten().map(|outcome| outcome.code));
    let rows =
        tasks.iter().zip(outcomes).map(|(task, outcome)| outcome.flatten().map_or_else(|| not_run(&task.label), |o| o.row));
    let report = BatchReport::new(rows.collect(), code as u8, begun.elapsed().as_secs_f64());

    pipeline::write_reports(outputs, &reports, |format, out| format.write_plain(out, &report, || render_batch(&report)))?;
    running::show(screen, |out| Ok(out.write_all(render_batch(&report).as_bytes())?))?;
    Ok(code)
}

/// What is said of a job that ended in a panic.
const BROKEN: &str = "the program failed\n   = help: please report it with the input that shows it";

/// All job files named: by themselves, by folder, in a list.
fn paths(args: &BatchArgs) -> anyhow::Result<Vec<PathBuf>> {
    let mut paths = Vec::new();
    let unreadable = |path: &Path| {
        let label = path.display().to_string();
        move |cause| Error::from(ReadError::Open { label, cause })
    };
    for path in &args.job {
        if !path.is_dir() {
            paths.push(path.clone());
            continue;
        }
        let entries = std::fs::read_dir(path).and_then(Iterator::collect::<Result<Vec<_>, _>>).map_err(unreadable(path))?;
        let mut jobs: Vec<PathBuf> = entries.iter().map(std::fs::DirEntry::path).filter(|path| job_file::is_job(path)).collect();
        if jobs.is_empty() {
            return Err(none(path, "there are no job files in this folder", "job files end in `.toml`").into());
        }
        jobs.sort();
        paths.append(&mut jobs);
    }
    if let Some(list) = &args.list {
        let text = job_file::read_short(list)?;
        let text = String::from_utf8_lossy(&text);
        let folder = list.parent().unwrap_or(Path::new(""));
        let name = |line: &str| line.split('#').next().unwrap_or("").trim().to_owned();
        paths.extend(
            text.trim_start_matches('\u{feff}').lines().map(name).filter(|name| !name.is_empty()).map(|name| folder.join(name)),
        );
        if paths.is_empty() {
            return Err(none(list, "there are no job files in this list", "name one job file a line").into());
        }
    }
    Ok(paths)
}

fn none(path: &Path, what: &str, help: &str) -> UsageErrors {
    UsageErrors::one(format!("{what}\n  --> {}\n   = help: {help}", path.display()))
}

/// Reads a job file and checks it.
fn task(path: &Path) -> Task {
    let job = job_file::load(path).and_then(|(mut args, file)| {
        // Standard output is for the summary.
        args.running.quiet = true;
        let job = build::job(&args).map_err(|errors| UsageErrors::one(file.locate(&errors.to_string())))?;
        let Footprint { outputs, inputs } = job.footprint();
        for (stream, used) in
            [("output", outputs.contains(&Target::Stdout)), ("input", inputs.iter().any(|path| path == Path::new("-")))]
        {
            if used {
                let what = format!("standard {stream} cannot be shared by the jobs of a batch");
                let help = "name a file, or run `slopegen build` for this job";
                return Err(UsageErrors::one(format!("{what}\n  --> {}\n   = help: {help}", file.label())).into());
            }
        }
        Ok((job, file))
    });
    Task { label: path.display().to_string(), job }
}

/// Refuses jobs that get in each other's way, or in that of the batch, which writes the summary and reads job files and list.
fn apart(tasks: &[Task], batch: Footprint) -> Result<(), UsageErrors> {
    let footprint = |task: &Task| task.job.as_ref().map(|(job, _)| job.footprint()).unwrap_or_default();
    let mut footprints: Vec<Footprint> = tasks.iter().map(footprint).collect();
    footprints.push(batch);
    let name = |index: usize| tasks.get(index).map_or("the summary", |task| &task.label);
    let message = match first_clash(&footprints) {
        None => return Ok(()),
        Some(Clash::Outputs { first, second }) => format!(
            "two jobs write the same file\n  --> {}: {}\n  --> {}: {}\n   = help: give each output a name of its own",
            name(first.0),
            first.1,
            name(second.0),
            second.1
        ),
        Some(Clash::Input { writer, reader }) if reader.0 == tasks.len() => format!(
            "a job writes a job file, or the list of them\n  --> {}: writes {}\n   = help: give the output a name of its own",
            name(writer.0),
            writer.1
        ),
        Some(Clash::Input { writer, reader }) => format!(
            "a job writes what another reads\n  --> {}: writes {}\n  --> {}: reads {}\n   \
             = help: the jobs of a batch are done in any order: run one after the other",
            name(writer.0),
            writer.1,
            name(reader.0),
            reader.1.display()
        ),
    };
    Err(UsageErrors::one(message))
}

/// Does a job; `None`: not begun, because the file of another is wrong.
fn work(task: &Task, refused: bool, memory: Memory) -> Option<Outcome> {
    let (job, file) = match &task.job {
        Ok(_) if refused => return None,
        Ok(job) => job,
        Err(error) => return Some(failed(&task.label, Code::of(error), format!("{error:#}"), 0.0)),
    };
    let begun = Instant::now();
    let listener = Listener { memory, notes: Mutex::default() };
    let built = pipeline::build(job, &listener);
    let seconds = begun.elapsed().as_secs_f64();
    let notes = listener.notes.into_inner().unwrap_or_else(PoisonError::into_inner);
    let outcome = match built {
        Ok(built) => Outcome { row: done(&task.label, &built, seconds), code: Code::Done, notes: Vec::new() },
        Err(error) => {
            let error = anyhow::Error::new(error);
            failed(&task.label, Code::of(&error), file.located(&error), seconds)
        }
    };
    Some(Outcome { notes, ..outcome })
}

fn done(label: &str, built: &Built, seconds: f64) -> JobRow {
    let unit = &built.report.units.length;
    let volumes = built.report.volumes.as_ref();
    JobRow {
        job: label.to_owned(),
        result: JobResult::Done,
        code: Some(Code::Done as u8),
        outputs: built.written.iter().map(ToString::to_string).collect(),
        volumes: volumes.map(|v| JobVolumes {
            cut: v.cut,
            fill: v.fill,
            net: v.net,
            complete: v.complete,
            unit: (*unit).to_owned(),
        }),
        warnings: built.report.warnings.clone(),
        error: None,
        seconds,
    }
}

fn failed(label: &str, code: Code, error: String, seconds: f64) -> Outcome {
    let row = JobRow { result: JobResult::Failed, code: Some(code as u8), error: Some(error), seconds, ..not_run(label) };
    Outcome { row, code, notes: Vec::new() }
}

fn not_run(label: &str) -> JobRow {
    JobRow {
        job: label.to_owned(),
        result: JobResult::NotRun,
        code: None,
        outputs: Vec::new(),
        volumes: None,
        warnings: Vec::<Warning>::new(),
        error: None,
        seconds: 0.0,
    }
}

/// Tells what became of a job.
fn tell(outcome: &Outcome, running: &Running) {
    let Outcome { row, notes, .. } = outcome;
    if !running.quiet {
        for note in notes {
            // Notes on how inputs were read would hide the warnings of a long list.
            if running.verbose || console::kind(note) == "warning" {
                console::tell(&format!("{}[{}]: {}: {}", console::kind(note), note.code, row.job, note.message));
            }
        }
        row.outputs.iter().for_each(|output| console::tell(&format!("wrote {output}")));
    }
    if let Some(error) = &row.error {
        console::error(&format!("{error}\n   = job: {}, exit code {}", row.job, row.code.unwrap_or_default()));
    }
}

/// The gravest of some codes: what may concern all jobs before what concerns one.
fn gravest(codes: impl Iterator<Item = Code>) -> Code {
    const ORDER: [Code; 8] =
        [Code::Done, Code::Work, Code::Check, Code::Usage, Code::Input, Code::Output, Code::Memory, Code::Interrupted];
    let rank = |code: &Code| ORDER.iter().position(|other| other == code);
    codes.max_by_key(rank).unwrap_or(Code::Done)
}

/// Keeps what is said.
struct Listener {
    memory: Memory,
    notes: Mutex<Vec<Note>>,
}

impl Watch for Listener {
    fn stage(&self, _: &'static str) {}

    fn memory(&self) -> Memory {
        self.memory
    }
}

impl Observer for Listener {
    fn note(&self, note: &Note) {
        self.notes.lock().unwrap_or_else(PoisonError::into_inner).push(note.clone());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gravest_code() {
        let of = |codes: &[Code]| gravest(codes.iter().copied());
        assert_eq!(of(&[]), Code::Done);
        assert_eq!(of(&[Code::Done, Code::Work, Code::Done]), Code::Work);
        assert_eq!(of(&[Code::Check, Code::Work]), Code::Check);
        assert_eq!(of(&[Code::Usage, Code::Input, Code::Check]), Code::Input);
        assert_eq!(of(&[Code::Output, Code::Input, Code::Usage]), Code::Output);
        assert_eq!(of(&[Code::Interrupted, Code::Output]), Code::Interrupted);
    }
}
