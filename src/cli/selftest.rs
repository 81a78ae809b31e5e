//! `slopegen selftest`: the cases with known figures, run on this machine.

use super::args::Running;
use super::checks::Checks;
use super::console::{self, Console, Screen};
use super::exit_code::Code;
use super::help;
use crate::pipeline;
use crate::report::{SelftestReport, render_selftest};
use crate::selftest;
use crate::write::Outputs;
use clap::Args;
use std::ffi::OsString;
use std::fmt;
use std::io::Write as _;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct SelftestArgs {
    /// Write the table; .json or .txt, may be repeated [default: as text to standard output]
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,

    #[command(flatten)]
    pub(super) running: Running,
}

/// What did not come out as it must.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct SelftestFailed(Vec<String>);

impl fmt::Display for SelftestFailed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the self-test did not pass")?;
        self.0.iter().try_for_each(|failure| write!(f, "\n   = {failure}"))?;
        f.write_str("\n   = help: do not rely on figures of this program on this machine, and tell its makers with the report")
    }
}

impl std::error::Error for SelftestFailed {}

/// Runs all cases.
pub(super) fn run(args: &SelftestArgs) -> anyhow::Result<Code> {
    let mut checks = Checks::default();
    let reports = checks.plain_reports(&args.report, args.running.quiet);
    let mut reports = checks.finish(Some(reports))?;
    let memory = super::start(&args.running)?;
    let to_terminal = reports.iter().any(|(target, _)| console::is_terminal(target));
    let all = console::targets(&reports);
    let screen = Screen::take(&mut reports, &all);
    let targets = console::targets(&reports);
    let mut outputs = Outputs::open::<PathBuf>(&targets, &[]).map_err(pipeline::Error::from)?;
    let console = Console::new(&args.running, memory, to_terminal);
    let verbose = args.running.verbose;
    let report = selftest::run(&selftest::cases::all(), |name, seconds| {
        if verbose {
            console::tell(&format!("{seconds:8.3} s  {name}"));
        }
    });
    for (index, (_, format)) in reports.iter().enumerate() {
        outputs
            .write(index, |out| format.write_plain(out, &report, || render_selftest(&report)))
            .map_err(pipeline::Error::from)?;
    }
    outputs.commit().map_err(pipeline::Error::from)?;
    console.finish();
    super::show(screen, |out| Ok(out.write_all(render_selftest(&report).as_bytes())?))?;
    targets.iter().filter(|target| !target.is_stream()).for_each(|target| console.wrote(target, ""));
    verdict(&report)
}

/// What the program exits with.
fn verdict(report: &SelftestReport) -> anyhow::Result<Code> {
    match report.passed {
        true => Ok(Code::Done),
        false => Err(SelftestFailed(report.failures()).into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::selftest::{Expected, cases};

    /// A figure that is wrong is named, and the program exits with 5.
    #[test]
    fn a_wrong_figure_is_an_error() {
        let mut cases: Vec<_> = cases::all().into_iter().filter(|case| case.name == "wedges between two planes").collect();
        let Expected::Number { value, .. } = &mut cases[0].rows[1].expected else { panic!("a number") };
        *value = 100.5;
        let error = verdict(&selftest::run(&cases, |_, _| ())).unwrap_err();
        assert_eq!(Code::of(&error), Code::Check);
        let text = error.to_string();
        let row = "Between surfaces, wedges between two planes: volumes.fill is 100.000000, expected 100.500000 within 1.0e-7";
        assert!(text.contains(row), "{text}");
    }
}
