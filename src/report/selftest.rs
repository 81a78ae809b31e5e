//! What `slopegen selftest` has to tell.

use super::common::Tool;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;

/// Version of the keys.
pub const SELFTEST_SCHEMA: &str = "slopegen-selftest/1";

/// What the program computed of cases whose figures are known, on the machine it runs on. There are no times in it: the same
/// program on the same machine gives the same bytes.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SelftestReport {
    /// Name and version of this schema.
    #[schemars(extend("const" = SELFTEST_SCHEMA))]
    pub schema: &'static str,
    /// The program.
    pub tool: Tool,
    /// Processor and system it was built for, such as `x86_64-linux`.
    pub platform: String,
    /// Threads it ran on.
    pub threads: usize,
    /// The cases in the order they were run.
    pub cases: Vec<CaseRow>,
    /// How many figures were compared.
    pub figures: usize,
    /// How many of them are beyond their bounds.
    pub failed: usize,
    /// The bytes that came out.
    pub hashes: Vec<HashRow>,
    /// Whether all figures are within their bounds, and the bytes those expected where that is certain.
    pub passed: bool,
}

/// A case.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CaseRow {
    /// What it is about, with others.
    pub group: &'static str,
    /// What is computed.
    pub case: &'static str,
    /// What is compared.
    pub rows: Vec<FigureRow>,
    /// Why a job of the case was not done that should have been.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub error: Option<String>,
}

/// A figure, or a refusal.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FigureRow {
    /// What: a key of the report, or in words.
    pub figure: String,
    /// The formula of what is expected; of a refusal what must be said.
    pub formula: String,
    /// Its value.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub expected: Option<f64>,
    /// What the program says; left out where it says nothing.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub got: Option<f64>,
    /// How far the two may be apart.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub bound: Option<f64>,
    /// First line of the message of a refusal.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub message: Option<String>,
    /// Whether it is within the bound; of a refusal, whether it was made for this reason.
    pub passed: bool,
}

/// A hash of what came out.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct HashRow {
    /// `exact`: of the cases that need no more than + − × ÷ √, which are the same on all systems; `all`: of all.
    #[schemars(extend("enum" = ["exact", "all"]))]
    pub of: &'static str,
    /// SHA-256 of what was made of them.
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub sha256: String,
    /// That of this version, where one is known for this platform.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub expected: Option<String>,
    /// Whether they are the same; left out where none is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub same: Option<bool>,
    /// Whether they must be.
    pub required: bool,
}

impl SelftestReport {
    /// What failed: group, case and figure, with both values; hashes that must be the same and are not.
    pub fn failures(&self) -> Vec<String> {
        let mut failures = Vec::new();
        for case in &self.cases {
            for row in case.rows.iter().filter(|row| !row.passed) {
                let got = match (row.got, &row.message) {
                    (Some(got), _) => number(got),
                    (None, Some(message)) => format!("`{message}`"),
                    (None, None) => "nothing".to_owned(),
                };
                let expected = match (row.expected, row.bound) {
                    (Some(expected), Some(bound)) => format!("{} within {bound:.1e}", number(expected)),
                    _ => row.formula.clone(),
                };
                failures.push(format!("{}, {}: {} is {got}, expected {expected}", case.group, case.case, row.figure));
            }
            failures.extend(
                case.error
                    .iter()
                    .map(|error| format!("{}, {}: {}", case.group, case.case, error.lines().next().unwrap_or_default())),
            );
        }
        for hash in self.hashes.iter().filter(|hash| hash.required && hash.same == Some(false)) {
            let expected = hash.expected.as_deref().unwrap_or_default();
            failures.push(format!("bytes of the {} cases: {}, expected {expected}", hash.of, hash.sha256));
        }
        failures
    }
}

/// Width of the names of figures.
const FIGURE: usize = 34;

/// The report as plain text.
pub fn render_selftest(report: &SelftestReport) -> String {
    let SelftestReport { tool, platform, threads, .. } = report;
    let mut text = format!("{} {}: self-test on {platform}, threads: {threads}\n", tool.name, tool.version);
    let _ = writeln!(text, "\n{:<width$}{:>17}{:>17}{:>10}", "", "expected", "got", "bound", width = FIGURE + 4);
    let mut group = "";
    for case in &report.cases {
        if case.group != group {
            group = case.group;
            let _ = writeln!(text, "\n{group}");
        }
        let _ = writeln!(text, "  {}", case.case);
        for row in &case.rows {
            let verdict = if row.passed { "passed" } else { "FAILED" };
            let name = &row.figure;
            let _ = match (row.expected, row.got, row.bound) {
                (Some(expected), got, bound) => {
                    let got = got.map_or_else(|| "nothing".to_owned(), number);
                    let bound = bound.map_or_else(String::new, |bound| format!("{bound:.1e}"));
                    writeln!(
                        text,
                        "    {name:<FIGURE$}{:>17}{got:>17}{bound:>10}  {verdict}\n      = {}",
                        number(expected),
                        row.formula
                    )
                }
                _ => {
                    let message = row.message.as_deref().unwrap_or("not refused");
                    writeln!(text, "    {name:<FIGURE$}{:>44}  {verdict}\n      = {message}", "refused")
                }
            };
        }
        if let Some(error) = &case.error {
            let _ = writeln!(text, "    not done: {}", error.lines().next().unwrap_or_default());
        }
    }
    text.push_str("\nBytes (SHA-256 of all results)\n");
    for hash in &report.hashes {
        let what = match hash.of {
            "exact" => "cases without cones",
            _ => "all cases",
        };
        let verdict = match (hash.same, hash.required) {
            (Some(true), _) => "as expected of this version",
            (Some(false), true) => "FAILED: not those of this version",
            (Some(false), false) => "not those of the reference system: last digits of its sin, cos and atan2 differ",
            (None, _) => "not compared: none is known for this platform",
        };
        let _ = writeln!(text, "  {what:<22}{}\n  {:<22}{verdict}", hash.sha256, "");
    }
    let _ = match report.failed {
        0 if report.passed => writeln!(text, "\n{} figures: all passed", report.figures),
        0 => writeln!(text, "\n{} figures: all passed; what FAILED is", report.figures),
        failed => writeln!(text, "\n{} figures: {failed} FAILED", report.figures),
    };
    for failure in report.failures() {
        let _ = writeln!(text, "  {failure}");
    }
    text
}

/// A number with nine digits at most behind the point; what is smaller with its power of ten.
fn number(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if size < 1e-6 => format!("{value:.1e}"),
        _ => format!("{value:.6}"),
    }
}

#[cfg(test)]
pub(crate) mod testing {
    use super::*;

    /// A report with every key.
    pub(crate) fn full() -> SelftestReport {
        let row = |figure: &str, got: Option<f64>, passed| FigureRow {
            figure: figure.into(),
            formula: "a·h + p·n·h²/2 + π·n²·h³/3".into(),
            expected: Some(4321.125),
            got,
            bound: Some(0.002),
            message: None,
            passed,
        };
        let refusal = |message: &str, passed| FigureRow {
            figure: "a segment steeper than the slope".into(),
            formula: "`as steep as the slope`".into(),
            expected: None,
            got: None,
            bound: None,
            message: Some(message.into()),
            passed,
        };
        let hash = |of, same: Option<bool>, required| HashRow {
            of,
            sha256: "1".repeat(64),
            expected: same.map(|same| if same { "1" } else { "2" }.repeat(64)),
            same,
            required,
        };
        SelftestReport {
            schema: SELFTEST_SCHEMA,
            tool: Tool { name: "slopegen", version: "0.0.0" },
            platform: "x86_64-linux".into(),
            threads: 2,
            cases: vec![
                CaseRow {
                    group: "Slopes without ground",
                    case: "level pad",
                    rows: vec![row("volumes.fill", Some(4321.1242), true), row("surface.plan_area", Some(4300.0), false)],
                    error: None,
                },
                CaseRow {
                    group: "Refusals",
                    case: "what must be refused",
                    rows: vec![refusal("segment 1 is as steep as the slope asked for", true), row("volumes.cut", None, false)],
                    error: Some("the ring crosses itself\n  --> line.geojson".into()),
                },
            ],
            figures: 4,
            failed: 2,
            hashes: vec![hash("exact", Some(true), true), hash("all", Some(false), false), hash("all", None, false)],
            passed: false,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::compare;

    #[test]
    fn a_full_report_is_pinned() {
        let report = testing::full();
        compare(&render_selftest(&report), include_str!("../../tests/golden/selftest.txt"), "selftest.txt");
        let mut json = Vec::new();
        crate::report::write_json(&mut json, &report).unwrap();
        let json = String::from_utf8(json).unwrap();
        compare(&json, include_str!("../../tests/golden/selftest.json"), "selftest.json");
    }

    /// Bytes may differ where no figure does.
    #[test]
    fn bytes_alone_can_fail() {
        let mut report = testing::full();
        report.cases.clear();
        (report.failed, report.hashes[0].same) = (0, Some(false));
        let text = render_selftest(&report);
        assert!(text.contains("\n4 figures: all passed; what FAILED is\n  bytes of the exact cases: "), "{text}");
        assert!(!text.contains("0 FAILED"), "{text}");
    }

    #[test]
    fn failures_are_named_with_both_values() {
        assert_eq!(
            testing::full().failures(),
            [
                "Slopes without ground, level pad: surface.plan_area is 4300.000000, expected 4321.125000 within 2.0e-3",
                "Refusals, what must be refused: volumes.cut is nothing, expected 4321.125000 within 2.0e-3",
                "Refusals, what must be refused: the ring crosses itself",
            ]
        );
    }
}
