//! The summary of `slopegen batch`.

use super::common::{Tool, Warning};
use crate::kernel::sum::Sum;
use crate::model::digits;
use crate::model::message::printable;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;

/// Version of the summary's keys.
pub const BATCH_SCHEMA: &str = "slopegen-batch/1";

/// What became of many jobs.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BatchReport {
    /// Name and version of this schema.
    #[schemars(extend("const" = BATCH_SCHEMA))]
    pub schema: &'static str,
    /// The program.
    pub tool: Tool,
    /// The jobs in the order they were given.
    pub jobs: Vec<JobRow>,
    /// How many are done.
    pub done: usize,
    /// How many failed.
    pub failed: usize,
    /// How many were not run, because another failed.
    pub not_run: usize,
    /// What the program exits with: the gravest of the codes.
    pub code: u8,
    /// Sums of the jobs that are done, where all have volumes in the same unit.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub total: Option<JobVolumes>,
    /// Seconds spent.
    pub seconds: f64,
}

/// What became of one job.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JobRow {
    /// The job file as given.
    pub job: String,
    /// How it ended.
    pub result: JobResult,
    /// What `slopegen build` would have exited with.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub code: Option<u8>,
    /// The files that have appeared.
    pub outputs: Vec<String>,
    /// Its volumes.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub volumes: Option<JobVolumes>,
    /// What the reader should know.
    pub warnings: Vec<Warning>,
    /// Why it failed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
    /// Seconds spent on it; differs from run to run.
    pub seconds: f64,
}

/// How a job ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum JobResult {
    /// All its outputs are there.
    Done,
    /// None of them is.
    Failed,
    /// It was not begun.
    NotRun,
}

impl JobResult {
    /// The word in the table.
    pub fn word(self) -> &'static str {
        match self {
            Self::Done => "done",
            Self::Failed => "failed",
            Self::NotRun => "not run",
        }
    }
}

/// Cut and fill of a job.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct JobVolumes {
    /// Volume to be dug away.
    pub cut: f64,
    /// Volume to be brought.
    pub fill: f64,
    /// `cut − fill`.
    pub net: f64,
    /// Whether they are complete, as in the report of the job; of sums, whether all are.
    pub complete: bool,
    /// Unit of length; volumes are in its cube.
    pub unit: String,
}

impl BatchReport {
    /// Sums up jobs; `code` is what the program exits with.
    pub fn new(jobs: Vec<JobRow>, code: u8, seconds: f64) -> Self {
        let count = |result| jobs.iter().filter(|row| row.result == result).count();
        let (done, failed, not_run) = (count(JobResult::Done), count(JobResult::Failed), count(JobResult::NotRun));
        let total = total(&jobs);
        Self { schema: BATCH_SCHEMA, tool: Tool::default(), jobs, done, failed, not_run, code, total, seconds }
    }
}

/// Sums of all jobs that are done, if they can be added.
fn total(jobs: &[JobRow]) -> Option<JobVolumes> {
    let done = || jobs.iter().filter(|row| row.result == JobResult::Done);
    let volumes: Vec<&JobVolumes> = done().filter_map(|row| row.volumes.as_ref()).collect();
    let unit = &volumes.first()?.unit;
    let same = volumes.len() == done().count() && volumes.iter().all(|v| v.unit == *unit);
    let sum = |of: fn(&JobVolumes) -> f64| {
        let mut sum = Sum::default();
        volumes.iter().for_each(|v| sum.add(of(v)));
        sum.value()
    };
    let complete = volumes.iter().all(|v| v.complete);
    same.then(|| JobVolumes { cut: sum(|v| v.cut), fill: sum(|v| v.fill), net: sum(|v| v.net), complete, unit: unit.clone() })
}

/// The summary as a table for people.
pub fn render_batch(report: &BatchReport) -> String {
    let mut text = format!("{} {}: {} jobs\n\n", report.tool.name, report.tool.version, report.jobs.len());
    let name = |row: &JobRow| printable(&row.job);
    let width = report.jobs.iter().map(|row| name(row).chars().count()).max().unwrap_or(0).max("total".len());
    // Writing to a String cannot fail.
    let _ = writeln!(
        text,
        "  {:width$}  {:7} {:>4} {:>14} {:>14} {:>14}  {:5} {:8} {:>9}",
        "job", "result", "code", "cut", "fill", "net", "unit", "complete", "seconds"
    );
    let volumes = |v: Option<&JobVolumes>| match v {
        Some(v) => {
            let [cut, fill, net] = [v.cut, v.fill, v.net].map(|volume| digits::plain(volume, 2));
            let complete = if v.complete { "yes" } else { "NO" };
            format!("{cut:>14} {fill:>14} {net:>14}  {:5} {complete:8}", format!("{}³", v.unit))
        }
        None => format!("{:>14} {:>14} {:>14}  {:5} {:8}", "–", "–", "–", "", ""),
    };
    for row in &report.jobs {
        let code = row.code.map_or_else(|| "–".to_owned(), |code| code.to_string());
        let _ = writeln!(
            text,
            "  {:width$}  {:7} {code:>4} {} {:>9.2}",
            name(row),
            row.result.word(),
            volumes(row.volumes.as_ref()),
            row.seconds
        );
    }
    let _ = writeln!(
        text,
        "  {:width$}  {:7} {:>4} {} {:>9.2}",
        "total",
        "",
        report.code,
        volumes(report.total.as_ref()),
        report.seconds
    );
    let not_run = if report.not_run > 0 { format!(", {} not run", report.not_run) } else { String::new() };
    let _ = writeln!(text, "\n{} done, {} failed{not_run}", report.done, report.failed);
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(job: &str, result: JobResult, volumes: Option<(f64, f64, &str)>) -> JobRow {
        JobRow {
            job: job.into(),
            result,
            code: (result != JobResult::NotRun).then_some(if result == JobResult::Done { 0 } else { 3 }),
            outputs: Vec::new(),
            volumes: volumes.map(|(cut, fill, unit)| JobVolumes {
                cut,
                fill,
                net: cut - fill,
                complete: cut != 1.5,
                unit: unit.into(),
            }),
            warnings: Vec::new(),
            error: None,
            seconds: 0.25,
        }
    }

    #[test]
    fn sums_of_like_units_only() {
        let (done, failed) = (JobResult::Done, JobResult::Failed);
        let both = [row("a", done, Some((100.0, 25.0, "m"))), row("b", done, Some((1.5, 2.0, "m"))), row("c", failed, None)];
        let sum = total(&both).unwrap();
        assert_eq!((sum.cut, sum.fill, sum.net), (101.5, 27.0, 74.5));
        assert!(!sum.complete && total(&both[..1]).unwrap().complete);
        assert_eq!(total(&[both[0].clone(), row("d", done, Some((1.0, 1.0, "ft")))]), None);
        assert_eq!(total(&[both[0].clone(), row("d", done, None)]), None);
        assert_eq!(total(&both[2..]), None);
    }

    #[test]
    fn the_table() {
        let jobs = vec![
            row("site/long.toml", JobResult::Done, Some((100.0, 25.0, "m"))),
            row("b\u{1b}", JobResult::Failed, None),
            row("c", JobResult::NotRun, None),
        ];
        let text = render_batch(&BatchReport { tool: Tool { name: "slopegen", version: "0" }, ..BatchReport::new(jobs, 3, 1.5) });
        let expected = "slopegen 0: 3 jobs\n\n\
            \x20 job             result  code            cut           fill            net  unit  complete   seconds\n\
            \x20 site/long.toml  done       0         100.00          25.00          75.00  m³    yes           0.25\n\
            \x20 b               failed     3              –              –              –                      0.25\n\
            \x20 c               not run    –              –              –              –                      0.25\n\
            \x20 total                      3         100.00          25.00          75.00  m³    yes           1.50\n\n\
            1 done, 1 failed, 1 not run\n";
        assert_eq!(text, expected);
    }
}
