//! `slopegen diff`: arguments and job.

use super::exit_code::Code;
use super::help;
use super::number::{self, Rule};
use super::running::{Run, Running};
use super::usage::{Checks, UsageErrors};
use crate::pipeline::{self, Beyond, Bounds, DiffJob, Most};
use crate::read::Pick;
use crate::read::terrain::TerrainOptions;
use crate::report::render_diff;
use clap::Args;
use std::ffi::OsString;
use std::io::Write as _;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct DiffArgs {
    /// The first: a JSON report of `build` or `volume`, or a surface in any format of ground
    #[arg(value_name = "A")]
    pub(super) first: PathBuf,
    /// The second, of the same kind; differences are the second less the first
    #[arg(value_name = "B")]
    pub(super) second: PathBuf,
    /// Columns of surfaces given as points without a header, such as xyz or pnezd
    #[arg(long, value_name = "ORDER", help_heading = help::INPUT)]
    pub(super) csv_order: Option<String>,
    /// Which surface of LandXML files with several of them
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) surface: Option<String>,
    /// Unit of files that declare none: m, ft (0.3048 m) or us-ft (1200/3937 m)
    #[arg(long, value_name = "UNIT", help_heading = help::INPUT)]
    pub(super) units: Option<String>,

    /// Exit with 5 if cut or fill differ by more: a volume, or a share such as 0.5% of the greater; of surfaces the volume
    /// between
    #[arg(long, value_name = "V", allow_negative_numbers = true, help_heading = help::CHECKS)]
    pub(super) max_volume: Option<String>,
    /// Exit with 5 if areas of cut or fill differ by more, or more area is covered by only one surface: an area, or a share
    #[arg(long, value_name = "A", allow_negative_numbers = true, help_heading = help::CHECKS)]
    pub(super) max_area: Option<String>,
    /// Exit with 5 if greatest depths, or heights of surfaces, differ by more
    #[arg(long, value_name = "H", allow_negative_numbers = true, help_heading = help::CHECKS)]
    pub(super) max_height: Option<String>,
    /// Exit with 5 if anything differs but times, paths, options, hashes of results, messages and the version of the
    /// program; heights of surfaces by more than 0.000001
    #[arg(long, help_heading = help::CHECKS)]
    pub(super) exact: bool,

    /// Write the differences; .json or .txt, may be repeated. As text to standard output as well, unless --quiet
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,

    #[command(flatten)]
    pub(super) running: Running,
}

/// Compares, and fails beyond a bound.
pub(super) fn run(args: &DiffArgs) -> anyhow::Result<Code> {
    let mut job = job(args)?;
    let run = Run::begin(&args.running, &mut job.reports)?;
    let differed = pipeline::diff(&job, &run.console)?;
    run.show(|out| Ok(out.write_all(render_diff(&differed.report).as_bytes())?))?;
    run.wrote(&differed.written);
    match Beyond::of(&differed.report) {
        Some(beyond) => Err(beyond.into()),
        None => Ok(Code::Done),
    }
}

fn job(args: &DiffArgs) -> Result<DiffJob, UsageErrors> {
    let mut checks = Checks::default();
    let mut most = |option, text: Option<&String>| text.and_then(|text| checks.take(most(option, text)));
    let (volume, area) = (most("--max-volume", args.max_volume.as_ref()), most("--max-area", args.max_area.as_ref()));
    let height = checks.number("--max-height", args.max_height.as_ref(), Rule::AtLeast(0.0));
    let csv_order = checks.order("--csv-order", args.csv_order.as_ref());
    let unit = checks.unit(args.units.as_ref());
    let reports = checks.plain_reports(&args.report, args.running.quiet);
    let pick = Pick { surface: args.surface.clone(), ..Pick::default() };
    checks.finish(Some(DiffJob {
        first: args.first.clone(),
        second: args.second.clone(),
        options: TerrainOptions { csv_order, pick, unit, ..TerrainOptions::default() },
        bounds: Bounds { volume, area, height, exact: args.exact },
        reports,
    }))
}

/// A figure, or with a percent sign a share.
fn most(option: &str, text: &str) -> Result<Most, String> {
    match text.trim().strip_suffix('%') {
        Some(percent) => {
            let refuse = |error: String| error.replacen(&format!("`{}`", percent.trim()), &format!("`{text}`"), 1);
            number::read(option, percent.trim(), Rule::AtLeast(0.0)).map(|p| Most::Share(p / 100.0)).map_err(refuse)
        }
        None => number::read(option, text, Rule::AtLeast(0.0)).map(Most::Figure),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_and_shares() {
        for (text, expected) in
            [("0", Most::Figure(0.0)), ("12.5", Most::Figure(12.5)), ("0.5%", Most::Share(0.005)), ("1 %", Most::Share(0.01))]
        {
            assert_eq!(most("--max-volume", text), Ok(expected), "{text}");
        }
        for text in ["-1", "x", "%", "nan", "-2%"] {
            assert!(most("--max-volume", text).is_err(), "{text}");
        }
    }
}
