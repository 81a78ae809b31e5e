//! A report held against a second run with the options it states.

use super::{BuildJob, Desk, Error, Observer, VolumeJob, build_at, volume_at};
use crate::kernel::hash::hex;
use crate::read::{Document, ReadError};
use crate::report::diff::compare;
use crate::report::verify::{Verdict, Verified, VerifiedFile};
use crate::report::{OutputFile, ReportFormat, Tool, platform};
use crate::surface::SurfaceError;
use crate::write::MeshFormat;
use serde_json::Value;
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::fmt;
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// A report, and what it was made by.
#[derive(Clone, Debug)]
pub struct VerifyJob {
    /// The report.
    pub document: Document,
    /// The run it states.
    pub rerun: Rerun,
    /// Where the inputs of that run are, by their paths in it.
    pub inputs: BTreeMap<PathBuf, PathBuf>,
    /// Where the files are that the run wrote, by their paths in it; those that are not known are not looked for.
    pub outputs: BTreeMap<PathBuf, PathBuf>,
}

/// A run that is done once more.
#[derive(Clone, Debug)]
pub enum Rerun {
    /// Of `slopegen build`.
    Build(Box<BuildJob>),
    /// Of `slopegen volume`.
    Volume(Box<VolumeJob>),
}

impl Rerun {
    /// The paths it reads.
    pub fn inputs(&self) -> Vec<PathBuf> {
        match self {
            Self::Build(job) => job.footprint().inputs,
            Self::Volume(job) => job.inputs(),
        }
    }

    /// The outputs that hold nothing but the mesh, line work of it and figures that the hash of the result is over: no angles, which
    /// differ between systems, and no powers.
    fn exact_outputs(&self) -> Vec<String> {
        let Self::Build(job) = self else { return Vec::new() };
        // Colours of GLB files are powers.
        let meshes =
            job.meshes.iter().chain(&job.finished).filter(|(_, format)| *format != MeshFormat::Glb).map(|(target, _)| target);
        let rasters = job.rasters.design.iter().chain(&job.rasters.finished).map(|(target, _)| target);
        let lines = job.lines.iter().map(|(target, _)| target);
        meshes.chain(rasters).chain(lines).chain(&job.station_tables).map(ToString::to_string).collect()
    }
}

/// A report that does not agree with what it was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct NotVerified {
    label: String,
    differences: Vec<String>,
}

impl NotVerified {
    /// What does not agree, if anything does not.
    pub fn of(verified: &Verified) -> Option<Self> {
        let differences = verified.differences();
        (!differences.is_empty()).then(|| Self { label: verified.report.clone(), differences })
    }
}

impl fmt::Display for NotVerified {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        /// As many as one reads; the table has all.
        const SHOWN: usize = 20;
        write!(f, "the report does not agree with what it was made from\n  --> {}", self.label)?;
        self.differences.iter().take(SHOWN).try_for_each(|difference| write!(f, "\n   = {difference}"))?;
        match self.differences.len().saturating_sub(SHOWN) {
            0 => Ok(()),
            more => write!(f, "\n   = and {more} more"),
        }?;
        f.write_str(
            "\n   = help: the report, an input or an output was changed after the run; build again from the inputs you trust",
        )
    }
}

impl std::error::Error for NotVerified {}

/// Part of a figure by which it may differ between versions and systems.
const OTHERWISE: f64 = 1e-9;

/// Runs the job of a report once more, in memory, and compares. Nothing is written.
///
/// # Errors
/// [`Error`] when an input cannot be read, or the run is interrupted. That things do not agree is no error: see
/// [`NotVerified::of`].
pub fn verify(job: &VerifyJob, observer: &dyn Observer) -> Result<Verified, Error> {
    let report = &job.document.value;
    let text = |path: &str| report.pointer(path).and_then(Value::as_str).unwrap_or("").to_owned();
    let (version, made_on) = (text("/tool/version"), text("/run/platform"));
    let own = Tool::default().version;
    let mut verified = Verified { report: job.document.label.clone(), ..Verified::default() };
    if version != own {
        verified.notes.push(format!("made by version {version}, run again by {own}: figures are compared within rounding"));
    }
    if made_on != platform() {
        verified.notes.push(format!("made on {made_on}, run again on {}: figures are compared within rounding", platform()));
    }
    let elsewhere = !verified.notes.is_empty();

    observer.stage("read");
    verified.inputs = inputs(job)?;
    verified.outputs = outputs(job)?;
    if verified.inputs.iter().any(|input| !input.agrees()) {
        return Ok(verified);
    }

    let desk = Desk::Rehearsal(&job.inputs);
    let done = match &job.rerun {
        Rerun::Build(build) => {
            let mut build = build.clone();
            build.reports.retain(|(_, format)| *format != ReportFormat::Json);
            build_at(desk, &build, observer).map(|built| (serde_json::to_value(&built.report), built.report.result))
        }
        Rerun::Volume(volume) => {
            let mut volume = volume.clone();
            volume.reports.retain(|(_, format)| *format != ReportFormat::Json);
            volume_at(desk, &volume, observer).map(|done| (serde_json::to_value(&done.report), done.report.result))
        }
    };
    let (again, result) = match done {
        Ok((again, result)) => (again.unwrap_or_default(), result.unwrap_or_default()),
        Err(Error::Surface { label, cause: SurfaceError::Cancelled }) => {
            return Err(Error::Surface { label, cause: SurfaceError::Cancelled });
        }
        Err(refused) => {
            verified.refused = Some(refused.to_string());
            return Ok(verified);
        }
    };
    let stated = text("/result/sha256");
    // What is made of mesh and figures alone is the same bytes where these are, on any platform.
    let exact = if version == own && stated == result.sha256 { job.rerun.exact_outputs() } else { Vec::new() };
    made_again(&mut verified, &result.outputs, |path| !elsewhere || exact.iter().any(|exact| exact == path));
    verified.result = Some(VerifiedFile::of("result", "", &stated, &result.sha256));
    verified.figures = numbers(report);
    // What is compared above, what differs from run to run, and what the report says of itself.
    let aside = |key: &str| {
        let top = key.split(['.', '[']).next().unwrap_or(key);
        ["timing", "tool", "run"].contains(&top) || key.starts_with("result.outputs") || key == "result.sha256"
    };
    let rounding = |change: &crate::report::diff::Change| {
        let small = change.relative.is_some_and(|relative| relative.abs() <= OTHERWISE);
        let tiny = change.difference.is_some_and(|difference| difference.abs() <= OTHERWISE);
        elsewhere && (small || tiny || change.key.ends_with("_sha256") || change.key.ends_with(".message"))
    };
    let changes = compare(report, &again).into_iter();
    verified.changes = changes.filter(|change| !aside(&change.key) && !rounding(change)).collect();
    if elsewhere && let Some(result) = &mut verified.result {
        result.decides = false;
    }
    Ok(verified)
}

/// The inputs of the run, held against their hashes in the report.
fn inputs(job: &VerifyJob) -> Result<Vec<VerifiedFile>, Error> {
    let stated = job.document.value.get("inputs").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let word = |input: &Value, key: &str| input.get(key).and_then(Value::as_str).unwrap_or("").to_owned();
    let mut files = Vec::new();
    for path in job.rerun.inputs() {
        let name = path.display().to_string();
        let place = job.inputs.get(&path).unwrap_or(&path);
        let found = file_hash(place).map_err(|cause| ReadError::Open { label: place.display().to_string(), cause })?;
        // A file may be read for two things.
        let of_path: Vec<&Value> = stated.iter().filter(|input| word(input, "path") == name).collect();
        if of_path.is_empty() {
            files.push(VerifiedFile::of("input", &name, "", &found.0));
        }
        files.extend(
            of_path.into_iter().map(|input| VerifiedFile::of(&word(input, "role"), &name, &word(input, "sha256"), &found.0)),
        );
    }
    files.dedup();
    Ok(files)
}

/// The outputs that are there, held against their hashes in the report.
fn outputs(job: &VerifyJob) -> Result<Vec<VerifiedFile>, Error> {
    let stated = job.document.value.pointer("/result/outputs").and_then(Value::as_array).map_or(&[][..], Vec::as_slice);
    let mut files = Vec::new();
    for output in stated {
        let word = |key: &str| output.get(key).and_then(Value::as_str).unwrap_or("").to_owned();
        let (path, sha256) = (word("path"), word("sha256"));
        let place = job.outputs.get(Path::new(&path)).filter(|place| place.is_file());
        let found =
            place.map(|place| file_hash(place).map_err(|cause| ReadError::Open { label: place.display().to_string(), cause }));
        files.push(match found.transpose()? {
            Some((found, _)) => VerifiedFile::of("output", &path, &sha256, &found),
            None => VerifiedFile { verdict: Verdict::NotThere, ..VerifiedFile::of("output", &path, &sha256, &sha256) },
        });
    }
    Ok(files)
}

/// Adds what came out of the second run to the outputs; `decides`: whether an output must be the same bytes.
fn made_again(verified: &mut Verified, made: &[OutputFile], decides: impl Fn(&str) -> bool) {
    let stated = |verified: &Verified, path: &str| verified.outputs.iter().any(|file| file.name == path);
    for file in made.iter().filter(|file| !stated(verified, &file.path)).collect::<Vec<_>>() {
        verified.outputs.push(VerifiedFile::of("output", &file.path, "", &file.sha256));
    }
    for output in &mut verified.outputs {
        let again = made.iter().find(|file| file.path == output.name).map_or("", |file| file.sha256.as_str());
        if again != output.stated {
            let again = VerifiedFile::of("made again", &output.name, &output.stated, again);
            verified.made.push(VerifiedFile { decides: decides(&output.name), ..again });
        }
    }
}

/// SHA-256 and length of a file. Devices and pipes, which might never end, are no files.
fn file_hash(path: &Path) -> std::io::Result<(String, u64)> {
    const BLOCK: usize = 1 << 16;
    if !std::fs::metadata(path)?.is_file() {
        return Err(std::io::Error::other("it is not a file"));
    }
    let mut file = std::fs::File::open(path)?;
    let mut hash = Sha256::new();
    let (mut block, mut bytes) = (vec![0; BLOCK], 0);
    loop {
        match file.read(&mut block)? {
            0 => return Ok((hex(&hash.finalize()), bytes)),
            n => {
                hash.update(&block[..n]);
                bytes += n as u64;
            }
        }
    }
}

/// How many numbers a report has.
fn numbers(value: &Value) -> usize {
    match value {
        Value::Number(_) => 1,
        Value::Array(items) => items.iter().map(numbers).sum(),
        Value::Object(keys) => keys.iter().filter(|(key, _)| *key != "timing").map(|(_, value)| numbers(value)).sum(),
        _ => 0,
    }
}
