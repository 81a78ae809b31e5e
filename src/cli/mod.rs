//! The command line: arguments → checked job → pipeline → messages and exit code.

mod args;
mod batch;
mod check;
mod checks;
mod console;
mod diff;
mod exit_code;
mod generate;
mod help;
mod info;
mod interrupt;
mod job;
mod job_file;
mod memory;
mod number;
mod record;
mod selftest;
mod verify;

pub use args::command;
pub use memory::out_of_memory;

use crate::model::Memory;
use crate::pipeline::{Error, NotPassed};
use crate::write::{MeshFormat, Target, WriteError};
use args::{Command, Running};
use checks::Checks;
use console::{Console, Screen};
use exit_code::Code;
use job_file::Stop;
use std::ffi::OsString;
use std::process::ExitCode;
use std::sync::Mutex;

/// Runs the program with its arguments, the first of which is its own name. Results go to files and standard output, all else
/// to standard error. Returns what the process should exit with.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    console::choose(console::asked(&arguments));
    let (outcome, file) = match job_file::parse(&arguments) {
        Ok((arguments, file)) => {
            console::choose(arguments.color);
            (dispatch(arguments.command), file)
        }
        Err(Stop::File(error)) => (Err(error), None),
        // Help and version go to standard output and are no error; a closed pipe is none either.
        Err(Stop::Parser(error)) => {
            let shown = error.print();
            let refused = shown.is_err_and(|cause| cause.kind() != std::io::ErrorKind::BrokenPipe);
            return if refused { Code::Output } else { Code::of_clap(&error) }.into();
        }
    };
    match outcome {
        Ok(code) => code.into(),
        Err(error) => {
            console::error(&file.map_or_else(|| format!("{error:#}"), |file| file.located(&error)));
            Code::of(&error).into()
        }
    }
}

/// Reads arguments as [`run`] does, with the job file they may name, and carries nothing out.
///
/// # Errors
/// What [`run`] would say before it looks at any other file; also the text of help and version.
pub fn understand(arguments: impl IntoIterator<Item = OsString>) -> Result<(), String> {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let (arguments, file) = match job_file::parse(&arguments) {
        Ok(parsed) => parsed,
        Err(Stop::File(error)) => return Err(format!("{error:#}")),
        Err(Stop::Parser(error)) => return Err(error.to_string()),
    };
    let understood = match &arguments.command {
        Command::Build(wanted) => job::build_job(wanted).map(drop),
        Command::Check(wanted) => check::check_job(wanted).map(drop),
        Command::Volume(wanted) => job::volume_job(wanted).map(drop),
        Command::Sample(wanted) => job::sample_job(wanted).map(drop),
        // These look at files at once, or have nothing to look at.
        Command::Batch(_) | Command::Diff(_) | Command::Info(_) | Command::Verify(_) => Ok(()),
        Command::Selftest(_) | Command::Completions(_) | Command::Man(_) => Ok(()),
    };
    understood.map_err(|error| match file {
        Some(file) => file.located(&error.into()),
        None => error.to_string(),
    })
}

fn dispatch(command: Command) -> anyhow::Result<Code> {
    interrupt::install()?;
    match command {
        Command::Build(wanted) => build(&wanted),
        Command::Check(wanted) => check(&wanted),
        Command::Volume(wanted) => volume(&wanted),
        Command::Sample(wanted) => sample(&wanted),
        Command::Batch(wanted) => batch::run(&wanted),
        Command::Diff(wanted) => diff::run(&wanted),
        Command::Info(wanted) => info::run(&wanted),
        Command::Verify(wanted) => verify::run(&wanted),
        Command::Selftest(wanted) => selftest::run(&wanted),
        Command::Completions(wanted) => Ok(generate::completions(&wanted).map(|()| Code::Done)?),
        Command::Man(wanted) => generate::man(&wanted).map(|()| Code::Done),
    }
}

fn build(wanted: &args::BuildArgs) -> anyhow::Result<Code> {
    let mut job = job::build_job(wanted)?;
    let memory = start(&wanted.running)?;
    let to_terminal = job.reports.iter().any(|(target, _)| console::is_terminal(target));
    let all = job.footprint().outputs;
    let screen = Screen::take(&mut job.reports, &all);
    let console = Console::new(&wanted.running, memory, to_terminal);
    let built = crate::pipeline::build(&job, &console)?;
    console.finish();
    show(screen, |out| crate::report::write_text(out, &built.report))?;
    let size = |vertices: usize, triangles: usize| format!("{vertices} vertices, {triangles} triangles");
    let design = size(built.report.surface.vertices, built.report.surface.triangles);
    let finished = built.report.finished.map_or_else(String::new, |finished| size(finished.vertices, finished.triangles));
    for target in &built.written {
        let is_among = |meshes: &[(Target, MeshFormat)]| meshes.iter().any(|(mesh, _)| mesh == target);
        let sizes = [(is_among(&job.meshes), design.as_str()), (is_among(&job.finished), finished.as_str())];
        let size = sizes.iter().find(|(is_it, _)| *is_it).map_or("", |(_, size)| size);
        console.wrote(target, size);
    }
    Ok(Code::Done)
}

fn check(wanted: &check::CheckArgs) -> anyhow::Result<Code> {
    let mut job = check::check_job(wanted)?;
    let memory = start(&wanted.running)?;
    // The report shows the notes on the same terminal.
    let to_terminal = job.reports.iter().any(|(target, _)| console::is_terminal(target));
    let all = console::targets(&job.reports);
    let screen = Screen::take(&mut job.reports, &all);
    let console = Console::new(&wanted.running, memory, to_terminal);
    let looked = crate::pipeline::check(&job, &console)?;
    console.finish();
    show(screen, |out| crate::report::ReportFormat::Text.write_check(out, &looked.report))?;
    looked.written.iter().for_each(|target| console.wrote(target, ""));
    match NotPassed::of(&looked.report) {
        Some(failed) => Err(failed.into()),
        None => Ok(Code::Done),
    }
}

fn volume(wanted: &args::VolumeArgs) -> anyhow::Result<Code> {
    let mut job = job::volume_job(wanted)?;
    let memory = start(&wanted.running)?;
    let to_terminal = job.reports.iter().any(|(target, _)| console::is_terminal(target));
    let all = console::targets(&job.reports);
    let screen = Screen::take(&mut job.reports, &all);
    let console = Console::new(&wanted.running, memory, to_terminal);
    let compared = crate::pipeline::volume(&job, &console)?;
    console.finish();
    show(screen, |out| crate::report::write_between(out, &compared.report))?;
    compared.written.iter().for_each(|target| console.wrote(target, ""));
    Ok(Code::Done)
}

fn sample(wanted: &args::SampleArgs) -> anyhow::Result<Code> {
    let job = job::sample_job(wanted)?;
    let memory = start(&wanted.running)?;
    let console = Console::new(&wanted.running, memory, false);
    let sampled = crate::pipeline::sample(&job, &console)?;
    console.finish();
    if !job.output.is_stream() {
        console.wrote(&job.output, &format!("{} heights", sampled.heights));
    }
    Ok(Code::Done)
}

/// Shows a report that was kept for the terminal.
fn show(screen: Option<Screen>, write: impl FnOnce(&mut Vec<u8>) -> Result<(), crate::write::EncodeError>) -> Result<(), Error> {
    let failed = |cause| WriteError::Write { target: Target::Stdout, cause }.into();
    screen.map_or(Ok(()), |screen| screen.show(write)).map_err(failed)
}

/// What must stand before the work begins; tells how much memory it may take.
fn start(running: &Running) -> anyhow::Result<Memory> {
    let mut checks = Checks::default();
    let threads = running.threads.as_ref().and_then(|text| checks.take(job::threads(text)));
    let asked = running.max_memory.as_ref().and_then(|text| checks.take(memory::read(text)));
    checks.finish(Some(()))?;
    let memory = memory::limit(asked);
    // Always a number of our own: what RAYON_NUM_THREADS says does not matter.
    let wanted = threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let begun = interrupt::no_abort(Code::Memory, || match startable(memory::threads(wanted)) {
        0 => Err(NoThreads),
        count => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build_global();
            // Until each of them runs.
            pool.map(|()| drop(rayon::broadcast(|_| ()))).map_err(|_| NoThreads)
        }
    });
    begun?;
    Ok(memory)
}

/// How many threads of `wanted` can be had at once. Limits of the system refuse some or all of them, and a pool cannot be tried
/// twice.
fn startable(wanted: usize) -> usize {
    let gate = Mutex::new(());
    std::thread::scope(|scope| {
        // Held until all have begun: a thread that ended would make room for the next.
        let _closed = gate.lock();
        let wait = || drop(gate.lock());
        (0..wanted).take_while(|_| std::thread::Builder::new().spawn_scoped(scope, wait).is_ok()).count()
    })
}

/// Not a single thread could be had.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error(
    "no thread could be started\n   = the system refused: too little memory, or too many processes\n   \
     = help: raise what `--max-memory`, `ulimit -v` or `ulimit -u` allow, or end other programs"
)]
struct NoThreads;
