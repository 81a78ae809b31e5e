//! The command line: arguments → checked job → pipeline → messages and exit code.

mod args;
mod batch;
mod build;
mod check;
mod console;
mod diff;
mod exit_code;
mod generate;
mod help;
mod info;
mod interrupt;
mod job_file;
mod line;
mod memory;
mod number;
mod record;
mod running;
mod sample;
mod selftest;
mod usage;
mod verify;
mod volume;

pub use args::command;
pub use memory::out_of_memory;

use args::Command;
use exit_code::Code;
use job_file::Stop;
use std::ffi::OsString;
use std::process::ExitCode;

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
        Command::Build(wanted) => build::job(wanted).map(drop),
        Command::Check(wanted) => check::job(wanted).map(drop),
        Command::Volume(wanted) => volume::job(wanted).map(drop),
        Command::Sample(wanted) => sample::job(wanted).map(drop),
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
        Command::Build(wanted) => build::run(&wanted),
        Command::Check(wanted) => check::run(&wanted),
        Command::Volume(wanted) => volume::run(&wanted),
        Command::Sample(wanted) => sample::run(&wanted),
        Command::Batch(wanted) => batch::run(&wanted),
        Command::Diff(wanted) => diff::run(&wanted),
        Command::Info(wanted) => info::run(&wanted),
        Command::Verify(wanted) => verify::run(&wanted),
        Command::Selftest(wanted) => selftest::run(&wanted),
        Command::Completions(wanted) => Ok(generate::completions(&wanted).map(|()| Code::Done)?),
        Command::Man(wanted) => generate::man(&wanted).map(|()| Code::Done),
    }
}
