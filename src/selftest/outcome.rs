//! What came out of a job.

use crate::kernel::hash::sha256;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// What came out of a job: outputs in memory, or why it was refused.
#[derive(Clone, Debug, Default)]
pub struct Outcome {
    /// The message, where it was not done.
    pub error: Option<String>,
    report: Value,
    outputs: BTreeMap<PathBuf, Vec<u8>>,
}

impl Outcome {
    pub(super) fn new(done: Result<(), String>, outputs: BTreeMap<PathBuf, Vec<u8>>) -> Self {
        let report = outputs.get(Path::new(super::jobs::REPORT)).and_then(|bytes| serde_json::from_slice(bytes).ok());
        Self { error: done.err(), report: report.unwrap_or_default(), outputs }
    }

    /// A figure of the report by its place, such as `volumes.cut` or `stations.2.fill`.
    pub fn number(&self, key: &str) -> Option<f64> {
        self.report.pointer(&format!("/{}", key.replace('.', "/")))?.as_f64()
    }

    /// Sum of a figure over all rows of a list of the report.
    pub(super) fn total(&self, list: &str, key: &str) -> Option<f64> {
        let rows = self.report.get(list)?.as_array()?;
        rows.iter().map(|row| row.get(key)?.as_f64()).sum()
    }

    /// The hash of the result.
    pub(super) fn result(&self) -> Option<&str> {
        self.report.pointer("/result/sha256")?.as_str()
    }

    /// The last column of an output that is a table of points.
    pub(super) fn heights(&self) -> Option<Vec<f64>> {
        let text = std::str::from_utf8(self.outputs.get(Path::new(super::jobs::HEIGHTS))?).ok()?;
        text.lines().skip(1).map(|line| line.rsplit(',').next()?.parse().ok()).collect()
    }

    /// The values of an output that is an ESRI ASCII grid, row by row from the north.
    pub(super) fn raster(&self) -> Option<Vec<f64>> {
        let text = std::str::from_utf8(self.outputs.get(Path::new(super::jobs::RASTER))?).ok()?;
        let rows = text.lines().filter(|line| !line.starts_with(|c: char| c.is_ascii_alphabetic()));
        rows.flat_map(str::split_whitespace).map(|word| word.parse().ok()).collect()
    }

    /// The lines of one kind in the line work.
    pub(super) fn lines(&self, kind: &str) -> Option<Vec<Vec<[f64; 3]>>> {
        let value: Value = serde_json::from_slice(self.outputs.get(Path::new(super::jobs::LINES))?).ok()?;
        let of_kind = |feature: &&Value| feature.pointer("/properties/kind").and_then(Value::as_str) == Some(kind);
        let points = |feature: &Value| serde_json::from_value(feature.pointer("/geometry/coordinates")?.clone()).ok();
        value.get("features")?.as_array()?.iter().filter(of_kind).map(points).collect()
    }

    /// SHA-256 of all there is: of the result and of every output, reports aside.
    pub(super) fn hash(&self) -> String {
        let mut text = self.result().unwrap_or_default().to_owned();
        for (path, bytes) in self.outputs.iter().filter(|(path, _)| *path != Path::new(super::jobs::REPORT)) {
            text.push_str(&format!("\n{} {}", path.display(), sha256(bytes)));
        }
        text.extend(self.error.iter().map(|error| format!("\n{error}")));
        sha256(text.as_bytes())
    }
}
