//! `slopegen verify`: arguments, the run a report states, and where its files are.

use super::args::Command;
use super::console::Console;
use super::exit_code::Code;
use super::running::{self, Running};
use super::usage::UsageErrors;
use super::{build, help, job_file, record, volume};
use crate::pipeline::{self, Error, NotVerified, Rerun, VerifyJob};
use crate::read::{Document, ReadError, read_document};
use crate::report::{Options, SCHEMA, render_verified};
use crate::write::{Outputs, Target};
use clap::Args;
use serde_json::Value;
use std::collections::BTreeMap;
use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};

/// No report has this many bytes: rows of 100 000 stations take a tenth.
const LONGEST: u64 = 1 << 29;

#[derive(Debug, Args)]
pub(super) struct VerifyArgs {
    /// A report of build or volume, .json
    #[arg(value_name = "REPORT")]
    pub(super) report: PathBuf,
    /// Look for the inputs in this folder, by their paths as given or by their names [default: where the report says]
    #[arg(long, value_name = "DIR", help_heading = help::INPUT)]
    pub(super) input_dir: Option<PathBuf>,

    #[command(flatten)]
    pub(super) running: Running,
}

/// Runs a report again; nothing is written.
pub(super) fn run(args: &VerifyArgs) -> anyhow::Result<Code> {
    let document = document(&args.report)?;
    let job = verify_job(args, document)?;
    let memory = running::start(&args.running)?;
    // The text tells the notes.
    let console = Console::new(&args.running, memory, true);
    let verified = pipeline::verify(&job, &console)?;
    console.finish();
    if !args.running.quiet {
        let mut outputs = Outputs::open::<PathBuf>(&[Target::Stdout], &[]).map_err(Error::from)?;
        outputs.write(0, |out| Ok(out.write_all(render_verified(&verified).as_bytes())?)).map_err(Error::from)?;
    }
    match NotVerified::of(&verified) {
        Some(differs) => Err(differs.into()),
        None => Ok(Code::Done),
    }
}

/// Reads the report.
fn document(path: &Path) -> anyhow::Result<Document> {
    let open = |cause| Error::from(ReadError::Open { label: path.display().to_string(), cause });
    let metadata = std::fs::metadata(path).map_err(open)?;
    if !metadata.is_file() {
        return Err(refuse(
            path,
            "this is not a file",
            "a device, a pipe or a folder",
            "give a report as `--report FILE.json` writes it",
        ));
    }
    if metadata.len() > LONGEST {
        let figures = format!("{} bytes; it may have {LONGEST}", metadata.len());
        return Err(refuse(
            path,
            "the file is too long for a report",
            &figures,
            "give a report as `--report FILE.json` writes it",
        ));
    }
    let help = "give a report that `slopegen build` or `volume` wrote with `--report FILE.json`";
    match read_document(path).map_err(Error::from)? {
        Some(document) if document.schema == SCHEMA => Ok(document),
        Some(document) => {
            let figures = format!("its schema is `{}`, not `{SCHEMA}`", document.schema);
            Err(refuse(path, "a report of this kind cannot be run again", &figures, help))
        }
        None => Err(refuse(path, "this is no report of this program", "it does not begin with a schema", help)),
    }
}

/// A message about the report.
fn refuse(path: &Path, what: &str, figures: &str, help: &str) -> anyhow::Error {
    let at = path.display().to_string();
    let (what, figures, help) = (what.to_owned(), figures.to_owned(), help.to_owned());
    Error::from(ReadError::Content { what, at, figures, help }).into()
}

/// The run the report states, checked as its options were when they were typed in.
fn verify_job(args: &VerifyArgs, document: Document) -> anyhow::Result<VerifyJob> {
    let path = &args.report;
    let damaged = |figures: &str| {
        refuse(path, "the report does not say how it was made", figures, "write it again, with the command that made it")
    };
    let run = document.value.get("run").ok_or_else(|| damaged("it has no key `run`"))?;
    let command = run.get("command").and_then(Value::as_str).filter(|command| ["build", "volume"].contains(command));
    let command = command.ok_or_else(|| damaged("`run.command` is neither `build` nor `volume`"))?;
    let options = run.get("options").cloned().and_then(|options| serde_json::from_value::<Options>(options).ok());
    let options = options.ok_or_else(|| damaged("`run.options` is not an object of lists of texts"))?;
    let words = record::words(command, &options).map_err(|key| {
        damaged(&format!(
            "`{}` among `run.options` is no option of `slopegen {command}`, or has values it cannot have",
            clipped(&key)
        ))
    })?;
    let words: Vec<OsString> = std::iter::once(OsString::from("slopegen")).chain(words).collect();
    let parsed = job_file::plain(&words).map_err(|error| {
        let text = error.render().to_string();
        let first = text.lines().next().unwrap_or_default().trim_start_matches("error: ");
        damaged(&format!("`run.options`: {}", clipped(first)))
    })?;
    let wrong = |errors: UsageErrors| {
        let text = errors.to_string();
        damaged(&format!("`run.options`: {}", clipped(text.lines().next().unwrap_or_default())))
    };
    let rerun = match parsed.command {
        Command::Build(args) => Rerun::Build(Box::new(build::job(&args).map_err(wrong)?)),
        Command::Volume(args) => Rerun::Volume(Box::new(volume::job(&args).map_err(wrong)?)),
        _ => return Err(damaged("`run.command` is neither `build` nor `volume`")),
    };
    let base = base(path, run.get("folder").and_then(Value::as_str));
    let mut inputs = BTreeMap::new();
    for input in rerun.inputs() {
        if input == Path::new("-") {
            let help = "write the input to a file, and build from that";
            return Err(refuse(path, "the input came from standard input, and cannot be read again", "its path is `-`", help));
        }
        let place = place(&input, base.as_deref(), args.input_dir.as_deref());
        inputs.insert(input, place);
    }
    let stated = document.value.pointer("/result/outputs").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let outputs = stated.iter().filter_map(|output| output.get("path")?.as_str()).map(PathBuf::from);
    let outputs = outputs.map(|output| (output.clone(), place(&output, base.as_deref(), None))).collect();
    Ok(VerifyJob { document, rerun, inputs, outputs })
}

/// Words from a file, as long as one reads.
fn clipped(text: &str) -> String {
    const LONGEST: usize = 100;
    if text.chars().count() > LONGEST { text.chars().take(LONGEST).chain(['…']).collect() } else { text.to_owned() }
}

/// The folder that the paths of a run are relative to, from that of the report. `None`: the working folder.
fn base(report: &Path, way: Option<&str>) -> Option<PathBuf> {
    let way = Path::new(way?);
    let up = |component: Component<'_>| matches!(component, Component::ParentDir | Component::CurDir);
    way.components().all(up).then(|| report.parent().unwrap_or(Path::new("")).join(way))
}

/// Where a file is that had this path.
fn place(path: &Path, base: Option<&Path>, folder: Option<&Path>) -> PathBuf {
    match folder {
        Some(folder) => {
            let there = folder.join(path);
            if path.is_relative() && there.is_file() { there } else { folder.join(path.file_name().unwrap_or(path.as_os_str())) }
        }
        None => base.map_or_else(|| path.to_owned(), |base| base.join(path)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_files_are() {
        let base_of = |report: &str, way: Option<&str>| base(Path::new(report), way);
        assert_eq!(base_of("out/r.json", Some("..")), Some(PathBuf::from("out/..")));
        assert_eq!(base_of("r.json", Some(".")), Some(PathBuf::from(".")));
        // A way with names, or from the root, is none this program writes.
        assert_eq!((base_of("r.json", Some("../secret")), base_of("r.json", Some("/etc"))), (None, None));
        assert_eq!(place(Path::new("a/b.obj"), Some(Path::new("out/..")), None), PathBuf::from("out/../a/b.obj"));
        assert_eq!(place(Path::new("/a/b.obj"), Some(Path::new("out")), None), PathBuf::from("/a/b.obj"));
        assert_eq!(place(Path::new("a/b.obj"), None, None), PathBuf::from("a/b.obj"));
        assert_eq!(place(Path::new("a/b.obj"), None, Some(Path::new("no such"))), PathBuf::from("no such/b.obj"));
    }
}
