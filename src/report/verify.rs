//! What `slopegen verify` has to tell.

use super::diff::Change;
use super::result::short;
use crate::model::message::printable;
use serde_json::Value;
use std::fmt::Write as _;

/// A report held against a second run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verified {
    /// Path of the report.
    pub report: String,
    /// What the reader should know.
    pub notes: Vec<String>,
    /// The inputs, as they are now.
    pub inputs: Vec<VerifiedFile>,
    /// The outputs, as they are now.
    pub outputs: Vec<VerifiedFile>,
    /// Outputs that came out of the second run with other bytes than stated.
    pub made: Vec<VerifiedFile>,
    /// The hash of the result.
    pub result: Option<VerifiedFile>,
    /// How many figures the report has; nought where they were not compared.
    pub figures: usize,
    /// Figures and words that differ.
    pub changes: Vec<Change>,
    /// Why the run was refused this time.
    pub refused: Option<String>,
}

/// A hash stated, and the one found.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct VerifiedFile {
    /// What it is.
    pub role: String,
    /// Path as stated.
    pub name: String,
    /// The hash in the report; empty where there is none.
    pub stated: String,
    /// The hash found; empty where there is none.
    pub found: String,
    /// What came of it.
    pub verdict: Verdict,
    /// Whether a difference counts.
    pub decides: bool,
}

/// What came of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// The same.
    Same,
    /// Something else.
    Differs,
    /// There is nothing to compare.
    NotThere,
}

impl VerifiedFile {
    /// Compares.
    pub(crate) fn of(role: &str, name: &str, stated: &str, found: &str) -> Self {
        let verdict = if stated == found { Verdict::Same } else { Verdict::Differs };
        let [role, name, stated, found] = [role, name, stated, found].map(str::to_owned);
        Self { role, name, stated, found, verdict, decides: true }
    }

    /// Whether nothing stands against it.
    pub fn agrees(&self) -> bool {
        self.verdict != Verdict::Differs || !self.decides
    }

    fn hashes(&self) -> String {
        let shown = |hash: &str| if hash.is_empty() { "none".to_owned() } else { printable(hash) };
        format!("sha256 {} stated, {} found", shown(&self.stated), shown(&self.found))
    }
}

impl Verified {
    /// All that does not agree, in words.
    pub fn differences(&self) -> Vec<String> {
        let files = self.inputs.iter().chain(&self.outputs).chain(&self.made).chain(&self.result);
        let file = |file: &VerifiedFile| format!("{} {}: {}", file.role, printable(&file.name), file.hashes());
        let mut differences: Vec<String> = files.filter(|file| !file.agrees()).map(file).collect();
        differences.extend(
            self.refused.iter().map(|refused| format!("the run is refused this time: {}", refused.replace('\n', "\n     "))),
        );
        differences.extend(self.changes.iter().map(|change| {
            format!(
                "{}: {} stated, {} found",
                printable(&change.key),
                shown(change.first.as_ref()),
                shown(change.second.as_ref())
            )
        }));
        differences
    }
}

/// A value of a report on a line.
fn shown(value: Option<&Value>) -> String {
    /// Longer values say no more.
    const LONGEST: usize = 80;
    let text = value.map_or_else(|| "nothing".to_owned(), |value| printable(&value.to_string()));
    if text.chars().count() > LONGEST { text.chars().take(LONGEST).chain(['…']).collect() } else { text }
}

/// Rows of differences that are shown.
const SHOWN: usize = 200;

/// The table as plain text.
pub fn render_verified(verified: &Verified) -> String {
    let mut text = format!("{}: run again\n\n", printable(&verified.report));
    let mut row = |what: &str, name: &str, verdict: &str| {
        let _ = writeln!(text, "  {what:<12}{:<40} {verdict}", printable(name));
    };
    let words = |file: &VerifiedFile| match (file.verdict, file.decides) {
        (Verdict::Same, _) => format!("same bytes ({})", short(&file.found)),
        (Verdict::Differs, true) => format!("DIFFERS ({} stated, {} found)", short(&file.stated), short(&file.found)),
        (Verdict::Differs, false) => "other bytes, as may be there".to_owned(),
        (Verdict::NotThere, _) => "not there".to_owned(),
    };
    for file in verified.inputs.iter().chain(&verified.outputs).chain(&verified.made) {
        row(&file.role, &file.name, &words(file));
    }
    if let Some(result) = &verified.result {
        row("result", "", &words(result).replace("bytes", "result"));
    }
    match (verified.figures, verified.changes.len()) {
        (0, _) => row("figures", "", "not compared"),
        (figures, 0) => row("figures", &figures.to_string(), "all the same"),
        (figures, changes) => row("figures", &figures.to_string(), &format!("{changes} DIFFER")),
    }
    for note in &verified.notes {
        let _ = writeln!(text, "  note: {}", printable(note));
    }
    let differences = verified.differences();
    match differences.len() {
        0 => text.push_str("\nThe report agrees with what it was made from\n"),
        count => {
            let _ = writeln!(text, "\nDifferences: {count}");
            text.extend(differences.iter().take(SHOWN).map(|difference| format!("  {difference}\n")));
        }
    }
    text
}
