//! `slopegen volume`: arguments and job.

use super::exit_code::Code;
use super::help;
use super::number::Rule;
use super::running::{Run, Running};
use super::usage::{Checks, UsageErrors};
use crate::pipeline::{self, Against, VolumeJob};
use crate::read::{InputFormat, Pick};
use crate::report::{Options, RunRecord, write_between};
use clap::Args;
use std::ffi::OsString;
use std::path::PathBuf;

#[derive(Debug, Args)]
pub(super) struct VolumeArgs {
    /// The surface after the works: .obj, .ply, .xml (LandXML), .dxf, .asc, .tif, or points as .las, .laz, .csv, .txt, .xyz; with
    /// --to-elevation the surface before
    #[arg(value_name = "DESIGN")]
    pub(super) design: PathBuf,
    /// The surface before the works, in any of these formats
    #[arg(value_name = "EXISTING", required_unless_present = "to_elevation", conflicts_with = "to_elevation")]
    pub(super) existing: Option<PathBuf>,
    /// Bring the one surface given to elevation Z: cut is what lies above, fill what is missing below
    #[arg(long, value_name = "Z", allow_negative_numbers = true, help_heading = help::SURFACE)]
    pub(super) to_elevation: Option<String>,
    /// Only inside the rings or polygons of this file: .geojson, .json, or a text file
    #[arg(long, value_name = "FILE", help_heading = help::SURFACE)]
    pub(super) within: Option<PathBuf>,
    /// Columns of a text file of rings without a header, such as xy
    #[arg(long, value_name = "ORDER", requires = "within", help_heading = help::SURFACE)]
    pub(super) within_order: Option<String>,
    /// Columns of text files of points without a header, such as xyz or pnezd
    #[arg(long, value_name = "ORDER", help_heading = help::INPUT)]
    pub(super) csv_order: Option<String>,
    /// Which surface of a LandXML file with several of them is the first one given
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) surface: Option<String>,
    /// Which surface of a LandXML file with several of them is the one before the works
    #[arg(long, value_name = "NAME", conflicts_with = "to_elevation", help_heading = help::INPUT)]
    pub(super) existing_surface: Option<String>,
    /// Unit of the figures, and of files that declare none: m, ft (0.3048 m) or us-ft (1200/3937 m) [default: that of the first
    /// file, else m]
    #[arg(long, value_name = "UNIT", help_heading = help::INPUT)]
    pub(super) units: Option<String>,
    /// Points of these classes of LAS and LAZ files are the surface, such as 2 or 2,8 [default: 2]
    #[arg(long, value_name = "N", value_delimiter = ',', help_heading = help::INPUT)]
    pub(super) class: Vec<u8>,

    /// Write the report; .json, .txt, .md or .html, may be repeated. As text to standard output as well, unless --quiet
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,

    #[command(flatten)]
    pub(super) running: Running,

    /// What was given, for the report.
    #[arg(skip)]
    pub(super) options: Options,
}

/// Compares.
pub(super) fn run(args: &VolumeArgs) -> anyhow::Result<Code> {
    let mut job = job(args)?;
    let run = Run::begin(&args.running, &mut job.reports)?;
    let compared = pipeline::volume(&job, &run.console)?;
    run.show(|out| write_between(out, &compared.report))?;
    run.wrote(&compared.written);
    Ok(Code::Done)
}

/// The job of `slopegen volume`.
///
/// # Errors
/// Everything wrong with the arguments.
pub(super) fn job(args: &VolumeArgs) -> Result<VolumeJob, UsageErrors> {
    let mut checks = Checks::default();
    let against = match &args.existing {
        Some(existing) => Some(Against::Existing { design: args.design.clone(), existing: existing.clone() }),
        None => checks
            .number("--to-elevation", args.to_elevation.as_ref(), Rule::Coordinate)
            .map(|elevation| Against::Elevation { existing: args.design.clone(), elevation }),
    };
    let csv_order = checks.order("--csv-order", args.csv_order.as_ref());
    let reports = checks.reports(&args.report, args.running.quiet);
    let within = args.within.clone();
    let within_order = checks.order("--within-order", args.within_order.as_ref());
    let run = Some(RunRecord::new("volume", args.options.clone()));
    let unit = checks.unit(args.units.as_ref());
    // A surface that is brought to a level is the first one given, and the existing one.
    let existing = if args.existing.is_some() { &args.existing_surface } else { &args.surface };
    let paths = [Some(&args.design), args.existing.as_ref()];
    // Classes are meant for the clouds among the files.
    let cloud = |path: &PathBuf| InputFormat::from_path(path).is_none_or(|format| format == InputFormat::Las);
    let no_cloud = !paths.iter().flatten().any(|path| cloud(path));
    let pick = |surface: &Option<String>, path: Option<&PathBuf>| Pick {
        surface: surface.clone(),
        classes: if no_cloud || path.is_some_and(cloud) { args.class.clone() } else { Vec::new() },
        ..Pick::default()
    };
    let picks = [pick(&args.surface, paths[0]), pick(existing, paths[1].or(paths[0]))];
    checks.finish(against.map(|against| VolumeJob { against, csv_order, picks, unit, within, within_order, reports, run }))
}
