//! `slopegen info`: arguments, and job files, which only the command line knows.

use super::build;
use super::console;
use super::exit_code::Code;
use super::help;
use super::job_file;
use super::running::{self, Run, Running};
use super::usage::{Checks, UsageErrors};
use crate::pipeline;
use crate::read::{Pick, ReadOptions};
use crate::report::info::{InfoReport, Setting, render_info};
use crate::write::Outputs;
use clap::Args;
use std::ffi::OsString;
use std::io::Write as _;
use std::path::{Path, PathBuf};

#[derive(Debug, Args)]
pub(super) struct InfoArgs {
    /// Any file: a line, ground, a job file, a JSON report of this program
    #[arg(value_name = "FILE")]
    pub(super) file: PathBuf,
    /// Columns of a text file without a header, such as xyz or pnezd
    #[arg(long, value_name = "ORDER", help_heading = help::INPUT)]
    pub(super) csv_order: Option<String>,
    /// Which surface of a LandXML file with several of them is looked at as ground
    #[arg(long, value_name = "NAME", help_heading = help::INPUT)]
    pub(super) surface: Option<String>,
    /// Unit of files that declare none: m, ft (0.3048 m) or us-ft (1200/3937 m)
    #[arg(long, value_name = "UNIT", help_heading = help::INPUT)]
    pub(super) units: Option<String>,
    /// Exit with 5 if there are defects
    #[arg(long, help_heading = help::CHECKS)]
    pub(super) strict: bool,

    /// Write what is found; .json or .txt, may be repeated. As text to standard output as well, unless --quiet
    #[arg(long, value_name = "FILE", help_heading = help::OUTPUT)]
    pub(super) report: Vec<OsString>,

    #[command(flatten)]
    pub(super) running: Running,
}

/// Looks at a file.
pub(super) fn run(args: &InfoArgs) -> anyhow::Result<Code> {
    let mut checks = Checks::default();
    let csv_order = checks.order("--csv-order", args.csv_order.as_ref());
    let unit = checks.unit(args.units.as_ref());
    let reports = checks.plain_reports(&args.report, args.running.quiet);
    let mut reports = checks.finish(Some(reports))?;
    let run = Run::begin(&args.running, &mut reports)?;
    let outputs = Outputs::open(&console::targets(&reports), std::slice::from_ref(&args.file)).map_err(pipeline::Error::from)?;
    let pick = Pick { surface: args.surface.clone(), ..Pick::default() };
    let report = if job_file::is_job(&args.file) {
        job(&args.file)?
    } else {
        pipeline::info(&args.file, &ReadOptions { csv_order, pick, unit, ..ReadOptions::default() }, &run.console)?
    };
    let written =
        pipeline::write_reports(outputs, &reports, |format, out| format.write_plain(out, &report, || render_info(&report)))?;
    run.show(|out| Ok(out.write_all(render_info(&report).as_bytes())?))?;
    run.wrote(&written);
    Ok(if args.strict && !report.is_sound() { Code::Check } else { Code::Done })
}

/// A job file: its options, what is wrong with them, and which of its inputs are not there.
fn job(path: &Path) -> anyhow::Result<InfoReport> {
    let bytes = job_file::read_short(path)?;
    let checked = job_file::load(path).and_then(|(args, file)| {
        let locate = |errors: UsageErrors| UsageErrors::one(file.locate(&errors.to_string()));
        let job = build::job(&args).map_err(locate)?;
        running::asked(&args.running).map_err(locate)?;
        Ok((job, file))
    });
    let (settings, defects) = match checked {
        Ok((job, file)) => {
            let settings = file.settings().map(|(key, values)| Setting { key: key.to_owned(), values }).collect();
            let missing = job.footprint().inputs.into_iter().filter(|path| path != Path::new("-") && !path.is_file());
            let defect = |path: PathBuf| {
                let what = format!("an input is not there\n  --> {}", path.display());
                file.locate(&format!("{what}\n   = help: paths are relative to the folder of the job file"))
            };
            (settings, missing.map(defect).collect())
        }
        Err(error) if error.is::<UsageErrors>() => (Vec::new(), vec![error.to_string()]),
        Err(error) => return Err(error),
    };
    Ok(pipeline::job_info(path, &bytes, settings, defects))
}
