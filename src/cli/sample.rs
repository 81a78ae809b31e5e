//! `slopegen sample`: arguments and job.

use super::exit_code::Code;
use super::help;
use super::line::{InputArgs, SlopeArgs};
use super::number::{self, Rule};
use super::running::{Run, Running};
use super::usage::{Checks, LEAST_LENGTH, UsageErrors, ending};
use crate::pipeline::{self, Area, Lattice, SampleJob, Where};
use crate::read::ReadOptions;
use crate::write::{RasterFormat, Target};
use clap::{ArgGroup, Args};
use glam::DVec2;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
#[command(group = ArgGroup::new("where").args(["at", "raster"]).required(true))]
pub(super) struct SampleArgs {
    #[command(flatten)]
    pub(super) input: InputArgs,
    #[command(flatten)]
    pub(super) slope: SlopeArgs,

    /// Heights at the points of a text file with columns x and y; - is standard input
    #[arg(long, value_name = "POINTS", help_heading = help::PLACES)]
    pub(super) at: Option<PathBuf>,
    /// Columns of POINTS without a header, such as xy or pen
    #[arg(long, value_name = "ORDER", requires = "at", conflicts_with = "raster", help_heading = help::PLACES)]
    pub(super) at_order: Option<String>,
    /// Heights at the nodes of a grid, written as a raster, .tif or .asc; - is standard output, .asc
    #[arg(long, value_name = "FILE", requires = "cell", conflicts_with = "output", help_heading = help::PLACES)]
    pub(super) raster: Option<OsString>,
    /// Distance of the nodes of the grid
    #[arg(long, value_name = "C", requires = "raster", conflicts_with = "at", allow_negative_numbers = true, help_heading = help::PLACES)]
    pub(super) cell: Option<String>,
    /// Box of the grid [default: that of the line, grown by a tenth of its longer side or by 5 cells]
    #[arg(
        long = "box",
        value_name = "XMIN,YMIN,XMAX,YMAX",
        requires = "raster",
        conflicts_with = "at",
        allow_hyphen_values = true,
        help_heading = help::PLACES
    )]
    pub(super) area: Option<String>,

    /// Write the points to a .csv file instead of standard output
    #[arg(short, long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) output: Option<OsString>,

    #[command(flatten)]
    pub(super) running: Running,
}

/// Takes the heights.
pub(super) fn run(args: &SampleArgs) -> anyhow::Result<Code> {
    let job = job(args)?;
    let run = Run::begin(&args.running, &mut Vec::new())?;
    let sampled = pipeline::sample(&job, &run.console)?;
    run.console.finish();
    if !job.output.is_stream() {
        run.console.wrote(&job.output, &format!("{} heights", sampled.heights));
    }
    Ok(Code::Done)
}

/// The job of `slopegen sample`.
///
/// # Errors
/// Everything wrong with the arguments.
pub(super) fn job(args: &SampleArgs) -> Result<SampleJob, UsageErrors> {
    let mut checks = Checks::default();
    let input = checks.input(&args.input);
    let slope = checks.slopes(&args.slope, false).into_iter().next();
    let place = match (&args.at, &args.raster) {
        (Some(path), _) => {
            let csv_order = checks.order("--at-order", args.at_order.as_ref());
            if path == Path::new("-") && args.input.input == Path::new("-") {
                let help = "give a file for one of them";
                checks.refuse(format!("line and points cannot both come from standard input\n  --> --at -\n   = help: {help}"));
            }
            let output = args.output.as_deref().map_or(Target::Stdout, Target::from_arg);
            checks.format(ending(&output, "file of points", &["csv", "txt", "xyz"], "`.csv`, `.txt` or `.xyz`"));
            Some((Where::Points { path: path.clone(), options: ReadOptions { csv_order, ..ReadOptions::default() } }, output))
        }
        (None, Some(raster)) => {
            let output = Target::from_arg(raster);
            let format = checks.format(RasterFormat::of(&output));
            let cell = checks.number("--cell", args.cell.as_ref(), Rule::AtLeast(LEAST_LENGTH));
            let area = args.area.as_ref().map(|text| checks.take(area(text)));
            // An area that was given and cannot be read leaves no grid.
            let area = area.map_or(Some(None), |area| area.map(Some));
            match (cell, area, format) {
                (Some(cell), Some(area), Some(format)) => Some((Where::Raster(Lattice { cell, area }, format), output)),
                _ => None,
            }
        }
        // The parser asks for one of them.
        (None, None) => None,
    };
    let job = slope.zip(place).map(|((slope, sheet), (at, output))| SampleJob { input, slope, sheet, at, output });
    checks.finish(job)
}

/// Reads `XMIN,YMIN,XMAX,YMAX`.
fn area(text: &str) -> Result<Area, String> {
    let refuse = |what: &str, help: &str| Err(format!("{what}\n  --> --box {text}\n   = help: {help}"));
    let fields: Vec<&str> = text.split(',').collect();
    if fields.len() != 4 {
        return refuse("a box has four numbers", "give `--box XMIN,YMIN,XMAX,YMAX`, decimals behind a point");
    }
    let numbers = fields.iter().map(|field| number::read("--box", field, Rule::Coordinate)).collect::<Result<Vec<f64>, _>>()?;
    let (min, max) = (DVec2::new(numbers[0], numbers[1]), DVec2::new(numbers[2], numbers[3]));
    if !(min.cmplt(max).all()) {
        return refuse("the box is empty", "give the south-west corner first: XMIN below XMAX, YMIN below YMAX");
    }
    Ok(Area { min, max })
}
