//! `slopegen selftest`: the cases with known figures, run on this machine.

use super::console;
use super::exit_code::Code;
use super::help;
use super::running::{Run, Running};
use super::usage::Checks;
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
    /// Write the table; .json or .txt, may be repeated. As text to standard output as well, unless --quiet
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
    let run = Run::begin(&args.running, &mut reports)?;
    let outputs = Outputs::open::<PathBuf>(&console::targets(&reports), &[]).map_err(pipeline::Error::from)?;
    let verbose = args.running.verbose;
    let report = selftest::run(&selftest::cases::all(), |name, seconds| {
        if verbose {
            console::tell(&format!("{seconds:8.3} s  {name}"));
        }
    });
    let written =
        pipeline::write_reports(outputs, &reports, |format, out| format.write_plain(out, &report, || render_selftest(&report)))?;
    run.show(|out| Ok(out.write_all(render_selftest(&report).as_bytes())?))?;
    run.wrote(&written);
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
