//! The command line: arguments → checked job → pipeline → messages and exit code.

mod args;
mod check;
mod console;
mod exit_code;
mod help;
mod interrupt;
mod job;
mod number;

pub use args::command;

use crate::pipeline::NotPassed;
use anyhow::Context as _;
use args::{Arguments, Command, Running};
use clap::{CommandFactory as _, FromArgMatches as _};
use console::Console;
use exit_code::Code;
use std::ffi::OsString;
use std::process::ExitCode;

/// Runs the program with its arguments, the first of which is its own name. Results go to files and standard output, all else
/// to standard error. Returns what the process should exit with.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    let parsed = Arguments::command().try_get_matches_from(arguments).and_then(|matches| Arguments::from_arg_matches(&matches));
    let outcome = match parsed {
        Ok(arguments) => dispatch(&arguments),
        // Help and version go to standard output and are no error; a closed pipe is none either.
        Err(error) => {
            let shown = error.print();
            let refused = shown.is_err_and(|cause| cause.kind() != std::io::ErrorKind::BrokenPipe);
            return if refused { Code::Output } else { Code::of_clap(&error) }.into();
        }
    };
    match outcome {
        Ok(()) => Code::Done.into(),
        Err(error) => {
            console::error(&format!("{error:#}"));
            Code::of(&error).into()
        }
    }
}

fn dispatch(arguments: &Arguments) -> anyhow::Result<()> {
    match &arguments.command {
        Command::Build(wanted) => {
            let job = job::build_job(wanted)?;
            start(&wanted.running)?;
            let to_terminal = job.reports.iter().any(|(target, _)| console::is_terminal(target));
            let console = Console::new(&wanted.running, to_terminal);
            let built = crate::pipeline::build(&job, &console)?;
            console.finish();
            let size = format!("{} vertices, {} triangles", built.report.surface.vertices, built.report.surface.triangles);
            for target in &built.written {
                let is_mesh = job.meshes.iter().any(|(mesh, _)| mesh == target);
                console.wrote(target, if is_mesh { &size } else { "" });
            }
        }
        Command::Check(wanted) => {
            let job = check::check_job(wanted)?;
            start(&wanted.running)?;
            // The report shows the notes on the same terminal.
            let to_terminal = job.reports.iter().any(|(target, _)| console::is_terminal(target));
            let console = Console::new(&wanted.running, to_terminal);
            let looked = crate::pipeline::check(&job, &console)?;
            console.finish();
            looked.written.iter().for_each(|target| console.wrote(target, ""));
            if let Some(failed) = NotPassed::of(&looked.report) {
                return Err(failed.into());
            }
        }
        Command::Volume(wanted) => {
            let job = job::volume_job(wanted)?;
            start(&wanted.running)?;
            let to_terminal = job.reports.iter().any(|(target, _)| console::is_terminal(target));
            let console = Console::new(&wanted.running, to_terminal);
            let compared = crate::pipeline::volume(&job, &console)?;
            console.finish();
            compared.written.iter().for_each(|target| console.wrote(target, ""));
        }
        Command::Sample(wanted) => {
            let job = job::sample_job(wanted)?;
            start(&wanted.running)?;
            let console = Console::new(&wanted.running, false);
            let sampled = crate::pipeline::sample(&job, &console)?;
            console.finish();
            if !job.output.is_stream() {
                console.wrote(&job.output, &format!("{} heights", sampled.heights));
            }
        }
    }
    Ok(())
}

/// What must stand before the work begins.
fn start(running: &Running) -> anyhow::Result<()> {
    interrupt::install().context("the handler for interrupts could not be installed")?;
    if let Some(threads) = job::threads(running)? {
        rayon::ThreadPoolBuilder::new().num_threads(threads).build_global().context("the threads could not be started")?;
    }
    Ok(())
}
