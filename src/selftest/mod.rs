//! Cases whose figures are known in closed form, run by the program itself: `slopegen selftest`.
//!
//! A case is data: files in memory, jobs, and what must come out, each figure with its formula and its bound. The jobs go through
//! the pipeline that `build`, `sample` and `volume` use, readers and writers included.

pub mod cases;
pub mod formulas;
mod jobs;
mod outcome;

pub use outcome::Outcome;

use crate::pipeline::{Bench, BuildJob, Desk, SampleJob, VolumeJob, build_at, sample_at, volume_at};
use crate::report::{CaseRow, FigureRow, HashRow, SELFTEST_SCHEMA, SelftestReport, Tool, platform};
use sha2::{Digest as _, Sha256};
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A case: jobs, and what must come out.
pub struct Case {
    /// What it is about, with others.
    pub group: &'static str,
    /// What is computed.
    pub name: &'static str,
    /// The inputs: names and contents. Outputs of a job are inputs of those after it.
    pub files: Vec<(&'static str, String)>,
    /// What is done, in this order.
    pub jobs: Vec<Task>,
    /// Whether no more than + − × ÷ √ goes into what comes out: no cone, no angle. It is the same on all systems then.
    pub exact: bool,
    /// What must come out.
    pub rows: Vec<Row>,
}

/// Something to be done.
pub enum Task {
    /// As `slopegen build`.
    Build(Box<BuildJob>),
    /// As `slopegen sample`.
    Sample(Box<SampleJob>),
    /// As `slopegen volume`.
    Volume(Box<VolumeJob>),
    /// The same on a single thread.
    OneThread(Box<Task>),
}

/// A figure of a case.
pub struct Row {
    /// What: a key of the report, or in words.
    pub figure: String,
    /// The formula of what is expected.
    pub formula: String,
    /// What is expected.
    pub expected: Expected,
}

/// What is expected.
pub enum Expected {
    /// A number.
    Number {
        /// Its value.
        value: f64,
        /// How far off the figure may be.
        bound: Bound,
        /// Finds the figure in what came out of the jobs.
        got: Figure,
    },
    /// That the job with this number is refused, with these words.
    Refusal {
        /// Number of the job, from 0.
        job: usize,
        /// Words of the message.
        words: &'static str,
    },
}

/// Finds a figure in what came out of the jobs of a case.
pub type Figure = Box<dyn Fn(&[Outcome]) -> Option<f64>>;

/// How far a figure may be off.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Bound {
    /// This far.
    Fixed(f64),
    /// This many times the bound that the report of the first job gives for its volumes, and rounding of the value.
    Reported(f64),
}

/// Rounding of figures that are sums of some hundred terms, relative.
pub const ROUNDING: f64 = 1e-9;

/// Hashes of the results of this version; `cargo run --example selftest_hashes` writes the file.
const HASHES: &str = include_str!("hashes.txt");

/// Where the hash of all results in [`HASHES`] was taken.
const REFERENCE: &str = "x86_64-linux";

/// Runs cases and compares. `tell` learns the name of each that is done, and the seconds it took.
pub fn run(cases: &[Case], mut tell: impl FnMut(&str, f64)) -> SelftestReport {
    let mut report = SelftestReport {
        schema: SELFTEST_SCHEMA,
        tool: Tool::default(),
        platform: platform(),
        threads: rayon::current_num_threads(),
        cases: Vec::new(),
        figures: 0,
        failed: 0,
        hashes: Vec::new(),
        passed: false,
    };
    let (mut exact, mut all) = (Sha256::new(), Sha256::new());
    for case in cases {
        let begun = std::time::Instant::now();
        let outcomes = work(case);
        let row = compare(case, &outcomes);
        for outcome in &outcomes {
            let bytes = format!("{} {}\n", case.name, outcome.hash());
            all.update(&bytes);
            if case.exact {
                exact.update(&bytes);
            }
        }
        report.figures += row.rows.len();
        report.failed += row.rows.iter().filter(|row| !row.passed).count();
        report.cases.push(row);
        tell(case.name, begun.elapsed().as_secs_f64());
    }
    let here = report.platform == REFERENCE && cfg!(target_env = "gnu");
    for (of, hash, known, required) in [("exact", exact, true, true), ("all", all, here, false)] {
        let sha256 = crate::kernel::hash::hex(&hash.finalize());
        let expected = known_hash(of).filter(|_| known).map(str::to_owned);
        let same = expected.as_ref().map(|expected| *expected == sha256);
        report.hashes.push(HashRow { of, sha256, expected, same, required });
    }
    report.passed = report.failures().is_empty();
    report
}

/// The hash that stands in [`HASHES`] under a name.
fn known_hash(of: &str) -> Option<&'static str> {
    HASHES.lines().filter_map(|line| line.split_once(' ')).find(|(name, _)| *name == of).map(|(_, hash)| hash)
}

/// Does the jobs of a case.
fn work(case: &Case) -> Vec<Outcome> {
    let mut files: BTreeMap<PathBuf, Vec<u8>> =
        case.files.iter().map(|(name, content)| (PathBuf::from(name), content.clone().into_bytes())).collect();
    let mut outcomes = Vec::new();
    for task in &case.jobs {
        let bench = Bench::new(files.clone());
        let done = task.run(&bench);
        let outputs = bench.into_outputs();
        files.extend(outputs.clone());
        outcomes.push(Outcome::new(done, outputs));
    }
    outcomes
}

impl Task {
    fn run(&self, bench: &Bench) -> Result<(), String> {
        let desk = Desk::Memory(bench);
        let done = match self {
            Self::Build(job) => build_at(desk, job, &()).map(drop),
            Self::Sample(job) => sample_at(desk, job, &()).map(drop),
            Self::Volume(job) => volume_at(desk, job, &()).map(drop),
            Self::OneThread(task) => {
                let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().map_err(|error| error.to_string())?;
                return pool.install(|| task.run(bench));
            }
        };
        done.map_err(|error| error.to_string())
    }
}

/// Holds what came out of a case against what must.
fn compare(case: &Case, outcomes: &[Outcome]) -> CaseRow {
    let reported = outcomes.first().and_then(|outcome| outcome.number("volumes.error_bound"));
    let mut refusals = Vec::new();
    let row = |row: &Row| match &row.expected {
        Expected::Number { value, bound, got } => {
            let got = got(outcomes).filter(|got| got.is_finite());
            let bound = match bound {
                Bound::Fixed(bound) => Some(*bound),
                Bound::Reported(times) => reported.map(|reported| times * reported + ROUNDING * value.abs()),
            };
            let passed = got.zip(bound).is_some_and(|(got, bound)| (got - value).abs() <= bound);
            let (figure, formula) = (row.figure.clone(), row.formula.clone());
            FigureRow { figure, formula, expected: Some(*value), got, bound, message: None, passed }
        }
        Expected::Refusal { job, words } => {
            refusals.push(*job);
            let message = outcomes.get(*job).and_then(|outcome| outcome.error.clone());
            let passed = message.as_ref().is_some_and(|message| message.contains(words));
            let message = message.and_then(|message| message.lines().next().map(str::to_owned));
            let (figure, formula) = (row.figure.clone(), row.formula.clone());
            FigureRow { figure, formula, expected: None, got: None, bound: None, message, passed }
        }
    };
    let rows = case.rows.iter().map(row).collect();
    let mut unexpected = (0..outcomes.len()).filter(|job| !refusals.contains(job)).filter_map(|job| outcomes[job].error.clone());
    CaseRow { group: case.group, case: case.name, rows, error: unexpected.next() }
}

#[cfg(test)]
mod tests;
