//! Where a job finds its inputs and leaves its outputs: files as a rule, memory for those who run jobs to learn what comes out.

use super::Error;
use crate::read::terrain::{RawTerrain, TerrainOptions, parse_named_terrain, read_terrain};
use crate::read::{self, InputFormat, RawInput, RawPoints, ReadError, ReadOptions};
use crate::report::{OutputFile, ReportFormat, RunRecord};
use crate::write::{EncodeError, Outputs, Target, WriteError};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Where a job finds its inputs and leaves its outputs.
#[derive(Clone, Copy, Debug)]
pub enum Desk<'a> {
    /// Files.
    Disk,
    /// Inputs are files, found where the map says by the paths of the job; outputs are made for their hashes, and not kept.
    Rehearsal(&'a BTreeMap<PathBuf, PathBuf>),
    /// Both in memory.
    Memory(&'a Bench),
}

/// Files in memory, by their paths.
#[derive(Debug, Default)]
pub struct Bench {
    inputs: BTreeMap<PathBuf, Vec<u8>>,
    outputs: Mutex<BTreeMap<PathBuf, Vec<u8>>>,
}

impl Bench {
    /// A bench with these inputs.
    pub fn new(inputs: BTreeMap<PathBuf, Vec<u8>>) -> Self {
        Self { inputs, outputs: Mutex::default() }
    }

    /// What was left on it.
    pub fn into_outputs(self) -> BTreeMap<PathBuf, Vec<u8>> {
        self.outputs.into_inner().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Desk<'_> {
    /// The bytes of an input that is not read from its path.
    fn elsewhere(&self, path: &Path) -> Result<Option<Vec<u8>>, ReadError> {
        let open = |cause| ReadError::Open { label: path.display().to_string(), cause };
        let missing = || open(std::io::ErrorKind::NotFound.into());
        match self {
            Self::Disk => Ok(None),
            Self::Rehearsal(places) => std::fs::read(places.get(path).ok_or_else(missing)?).map(Some).map_err(open),
            Self::Memory(bench) => bench.inputs.get(path).cloned().map(Some).ok_or_else(missing),
        }
    }

    /// As [`read::read_line`].
    pub(super) fn line(&self, path: &Path, options: &ReadOptions) -> Result<RawInput, ReadError> {
        let Some(bytes) = self.elsewhere(path)? else { return read::read_line(path, options) };
        let label = path.display().to_string();
        let format = options.format.or_else(|| InputFormat::from_path(path));
        let format = format.ok_or_else(|| ReadError::unknown_format(label.clone()))?;
        read::parse_line(&label, &bytes, &ReadOptions { format: Some(format), ..options.clone() })
    }

    /// As [`read_terrain`].
    pub(super) fn terrain(&self, path: &Path, options: &TerrainOptions) -> Result<RawTerrain, ReadError> {
        match self.elsewhere(path)? {
            None => read_terrain(path, options),
            Some(bytes) => parse_named_terrain(path, &bytes, options),
        }
    }

    /// As [`read::read_points`].
    pub(super) fn points(&self, path: &Path, options: &ReadOptions) -> Result<RawPoints, ReadError> {
        match self.elsewhere(path)? {
            None => read::read_points(path, options),
            Some(bytes) => read::parse_points(&path.display().to_string(), &bytes, options.csv_order.as_ref()),
        }
    }

    /// Opens the outputs of a job; `record`: whether it keeps a record of what comes out.
    pub(super) fn open<P: AsRef<Path>>(&self, targets: &[Target], inputs: &[P], record: bool) -> Result<Outputs, WriteError> {
        let outputs = match self {
            Self::Disk => Outputs::open(targets, inputs)?,
            Self::Rehearsal(_) => Outputs::nowhere(targets),
            Self::Memory(_) => Outputs::in_memory(targets),
        };
        Ok(if record { outputs.hashed() } else { outputs })
    }

    /// Makes the outputs appear.
    pub(super) fn commit(&self, outputs: Outputs) -> Result<(), WriteError> {
        let Self::Memory(bench) = self else { return outputs.commit() };
        let mut kept = bench.outputs.lock().unwrap_or_else(PoisonError::into_inner);
        for (target, bytes) in outputs.into_memory() {
            if let Target::File(path) = target {
                kept.insert(path, bytes);
            }
        }
        Ok(())
    }

    /// Whether hashes are taken for a job with these reports: only those in JSON hold them.
    pub(super) fn records(&self, reports: &[(Target, ReportFormat)]) -> bool {
        !matches!(self, Self::Disk) || reports.iter().any(|(_, format)| *format == ReportFormat::Json)
    }
}

/// The order in which outputs are written. Files first, because they can still be taken back; standard output last; of each kind
/// reports last, because they tell how long the rest took, those in JSON behind the others, because they tell of them.
pub(super) fn in_order(targets: &[Target], is_report: impl Fn(usize) -> bool, is_json: impl Fn(usize) -> bool) -> Vec<usize> {
    let mut order: Vec<usize> = (0..targets.len()).collect();
    order.sort_by_key(|&i| (targets[i] == Target::Stdout, targets[i].is_stream(), is_report(i), is_json(i)));
    order
}

/// Writes the same report in all its formats, files before standard output, and makes the files appear. Returns the files, in the order of `reports`.
///
/// # Errors
/// As [`Outputs::write`] and [`Outputs::commit`], as an error of the job.
pub fn write_reports(
    mut outputs: Outputs,
    reports: &[(Target, ReportFormat)],
    encode: impl Fn(ReportFormat, &mut dyn Write) -> Result<(), EncodeError>,
) -> Result<Vec<Target>, Error> {
    let targets: Vec<Target> = reports.iter().map(|(target, _)| target.clone()).collect();
    for index in in_order(&targets, |_| true, |index| reports[index].1 == ReportFormat::Json) {
        outputs.write(index, |out| encode(reports[index].1, out))?;
    }
    outputs.commit()?;
    Ok(reports.iter().map(|(target, _)| target).filter(|target| !target.is_stream()).cloned().collect())
}

/// The record of a run as a report at a target tells it; nothing for other outputs.
pub(super) fn run_at(run: &Option<RunRecord>, target: &Target, is_json: bool) -> Option<RunRecord> {
    match (run, target) {
        (Some(run), Target::File(path)) if is_json => Some(run.seen_from(path)),
        _ => None,
    }
}

/// Why there is no record.
pub(super) fn no_record(cause: EncodeError) -> WriteError {
    WriteError::Write { target: Target::Stdout, cause }
}

/// The files among outputs, those in JSON reports aside, as far as they are written.
pub(super) fn files(outputs: &Outputs, targets: &[Target], is_json: impl Fn(usize) -> bool) -> Vec<OutputFile> {
    let file = |(index, target): (usize, &Target)| {
        let digest = outputs.digest(index).filter(|_| !target.is_stream() && !is_json(index))?;
        Some(OutputFile { path: target.to_string(), bytes: digest.bytes, sha256: digest.sha256.clone() })
    };
    targets.iter().enumerate().filter_map(file).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_taken_back_is_written_last() {
        let file = |name: &str| Target::File(name.into());
        let targets = [Target::Stdout, file("r.json"), file("/dev/null"), file("r.txt"), file("m.obj")];
        let is_report = |i: usize| i != 2 && i != 4;
        let expected = if cfg!(unix) { [4, 3, 1, 2, 0] } else { [2, 4, 3, 1, 0] };
        assert_eq!(in_order(&targets, is_report, |i| i == 1), expected);
    }
}
