//! `slopegen check`: arguments and job.

use super::exit_code::Code;
use super::help;
use super::number::{self, Rule};
use super::running::{Run, Running};
use super::usage::{Checks, LEAST_LENGTH, UsageErrors};
use crate::pipeline::{self, CheckJob, NotPassed, SlopeWish};
use crate::read::{InputFormat, Pick};
use crate::report::ReportFormat;
use clap::{Args, ValueEnum};
use std::ffi::OsString;
use std::path::PathBuf;

/// More places than anybody reads.
const MOST_PLACES: usize = 10_000;

#[derive(Debug, Args)]
pub(super) struct CheckArgs {
    /// The mesh: .obj, .ply, LandXML or .dxf; - is standard input
    #[arg(value_name = "MESH")]
    pub(super) mesh: PathBuf,
    /// Format of the mesh [default: by its extension, else by its content]
    #[arg(long, value_enum, value_name = "FORMAT", help_heading = help::INPUT)]
    pub(super) input_format: Option<MeshFormatArg>,
    /// Which surface of a LandXML file with several of them is looked at
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) surface: Option<String>,

    /// Look only at the faces on this layer of a drawing; may be repeated [default: all that are on]
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) layer: Vec<String>,

    /// A slope to be kept: 1:1.5, 2H:1V, 1in2, 50% or 26.57deg
    ///
    /// Asked of the parts `fill_slope` and `cut_slope` if the mesh has such groups, else of all triangles that are not level.
    #[arg(short, long, value_name = "S", allow_hyphen_values = true, help_heading = help::CHECKS)]
    pub(super) slope: Option<String>,
    /// Triangles within D degrees are on the slope
    #[arg(long, value_name = "D", default_value = "0.1", requires = "slope", allow_negative_numbers = true, help_heading = help::CHECKS)]
    pub(super) tolerance_deg: String,
    /// Share of the area in percent that may be off the slope
    #[arg(long, value_name = "P", default_value = "0", requires = "slope", allow_negative_numbers = true, help_heading = help::CHECKS)]
    pub(super) max_off: String,
    /// Ask the slope of this group of the mesh only; may be repeated
    #[arg(long, value_name = "NAME", requires = "slope", help_heading = help::CHECKS)]
    pub(super) part: Vec<String>,
    /// Distance within which vertices and edges should be joined [default: 0.001, or a hundredth of the median side if less]
    #[arg(long, value_name = "G", allow_negative_numbers = true, help_heading = help::CHECKS)]
    pub(super) gap: Option<String>,

    /// Places told of each kind of finding
    #[arg(long, value_name = "N", default_value = "3", allow_negative_numbers = true, help_heading = help::OUTPUT)]
    pub(super) places: String,
    /// Write the report; .json, .txt, .md or .html, may be repeated. As text to standard output as well, unless --quiet
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,

    #[command(flatten)]
    pub(super) running: Running,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub(super) enum MeshFormatArg {
    Obj,
    Ply,
    Landxml,
    Dxf,
}

impl MeshFormatArg {
    fn format(self) -> InputFormat {
        match self {
            Self::Obj => InputFormat::Obj,
            Self::Ply => InputFormat::Ply,
            Self::Landxml => InputFormat::LandXml,
            Self::Dxf => InputFormat::Dxf,
        }
    }
}

/// Looks at the mesh; one that does not pass is an error.
pub(super) fn run(args: &CheckArgs) -> anyhow::Result<Code> {
    let mut job = job(args)?;
    let run = Run::begin(&args.running, &mut job.reports)?;
    let looked = pipeline::check(&job, &run.console)?;
    run.show(|out| ReportFormat::Text.write_check(out, &looked.report))?;
    run.wrote(&looked.written);
    match NotPassed::of(&looked.report) {
        Some(failed) => Err(failed.into()),
        None => Ok(Code::Done),
    }
}

/// The job of `slopegen check`.
///
/// # Errors
/// Everything wrong with the arguments.
pub(super) fn job(args: &CheckArgs) -> Result<CheckJob, UsageErrors> {
    let mut checks = Checks::default();
    let slope = checks.slope("--slope", args.slope.as_ref());
    let tolerance = checks.number("--tolerance-deg", Some(&args.tolerance_deg), Rule::Positive);
    let most_off = checks.take(share("--max-off", &args.max_off));
    let gap = checks.number("--gap", args.gap.as_ref(), Rule::AtLeast(LEAST_LENGTH));
    let places = checks.whole("--places", Some(&args.places), "places", 0..=MOST_PLACES);
    let reports = checks.reports(&args.report, args.running.quiet);
    let job = tolerance.zip(most_off).zip(places).map(|((tolerance_deg, most_off), places)| CheckJob {
        path: args.mesh.clone(),
        format: args.input_format.map(MeshFormatArg::format),
        pick: Pick { surface: args.surface.clone(), layers: args.layer.clone(), ..Pick::default() },
        slope: slope.map(|slope| SlopeWish { slope, tolerance_deg, most_off, parts: args.part.clone() }),
        gap,
        places,
        reports,
    });
    checks.finish(job)
}

/// A share given in percent, with or without its sign.
fn share(option: &str, text: &str) -> Result<f64, String> {
    let percent = number::read(option, text.trim().trim_end_matches('%'), Rule::AtLeast(0.0))?;
    if percent > 100.0 {
        return Err(format!("`{text}` is more than all\n  --> {option} {text}\n   = help: give a percentage from 0 to 100"));
    }
    Ok(percent / 100.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares() {
        for (text, expected) in [("0", 0.0), ("5", 0.05), ("2.5%", 0.025), ("100 %", 1.0)] {
            assert_eq!(share("--max-off", text), Ok(expected), "{text}");
        }
        for text in ["-1", "101", "x", "%", "nan"] {
            assert!(share("--max-off", text).is_err(), "{text}");
        }
    }
}
