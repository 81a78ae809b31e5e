//! A report for people as sections of named figures, tables and remarks: built once, written as plain text or as Markdown. So
//! both say the same.

mod markdown;
mod plain;

use super::{Input, Units, WarningKind};
use crate::model::digits;
use crate::model::message::printable;

/// Width of the names before the figures in plain text.
pub(super) const NAME: usize = 20;
/// Width of a number before its unit in plain text.
pub(super) const NUMBER: usize = 16;

/// What the figures of every report are, and are not.
pub(super) const NOTE: &str = "Geometric quantities computed from the inputs named below; not a survey certificate.";

/// How long the unit of length is; of metres there is nothing to say.
pub(super) fn in_metres(units: &Units) -> Option<String> {
    match units.length {
        "m" => None,
        "us-ft" => Some("1 us-ft = 1200/3937 m (US survey foot)".to_owned()),
        length => Some(format!("1 {length} = {} m", units.metres)),
    }
}

/// A report for people.
pub(super) struct Page {
    /// First line.
    title: String,
    /// Lines below the title.
    lead: Vec<String>,
    /// A line that stands out.
    verdict: Option<String>,
    sections: Vec<Section>,
    units: Units,
}

struct Section {
    title: String,
    items: Vec<Item>,
}

enum Item {
    /// A name, and words for it. Names that begin with blanks belong to the one above.
    Words { name: String, words: String },
    /// A name and a number with its unit.
    Figure { name: String, number: String, unit: String },
    /// Rows and columns.
    Table(Table),
    /// A remark, and lines that belong to it.
    Remark { words: String, below: Vec<String> },
}

/// Rows and columns.
pub(super) struct Table {
    /// Columns that belong together; what the rows are about comes first.
    pub(super) groups: Vec<Group>,
    pub(super) rows: Vec<Row>,
}

/// Columns that belong together.
pub(super) struct Group {
    /// Title above the names of the columns; empty where there is none.
    pub(super) title: &'static str,
    pub(super) columns: Vec<Column>,
}

/// One column.
pub(super) struct Column {
    pub(super) name: &'static str,
    /// Words stand to the left, numbers to the right.
    pub(super) left: bool,
    /// Least width in plain text.
    pub(super) least: usize,
}

/// One row.
pub(super) enum Row {
    /// A cell for each column; those missing at the end are empty.
    Cells(Vec<String>),
    /// The same with a label in the stead of the cells of the first group.
    Labelled(&'static str, Vec<String>),
    /// What the rows below are about.
    Heading(String),
}

impl Group {
    /// Columns of numbers.
    pub(super) fn numbers(title: &'static str, names: &[&'static str], least: usize) -> Self {
        Self { title, columns: names.iter().map(|&name| Column { name, left: false, least }).collect() }
    }
}

impl Column {
    /// A column of words.
    pub(super) fn words(name: &'static str) -> Self {
        Self { name, left: true, least: 0 }
    }

    /// A column of numbers.
    pub(super) fn numbers(name: &'static str, least: usize) -> Self {
        Self { name, left: false, least }
    }
}

impl Page {
    /// A page without sections. `about` is what the report is of; `volumes` whether there are any in it.
    pub(super) fn new(tool: &super::Tool, about: &str, units: &Units, volumes: bool) -> Self {
        let Units { length, area, volume, .. } = units;
        let volumes = if volumes { format!(", volumes in {volume}") } else { String::new() };
        let metres = in_metres(units).map_or_else(String::new, |metres| format!("; {metres}"));
        Self {
            title: format!("{} {}: {about}", tool.name, tool.version),
            lead: vec![format!("Lengths in {length}, areas in {area}{volumes}{metres}"), NOTE.to_owned()],
            verdict: None,
            sections: Vec::new(),
            units: units.clone(),
        }
    }

    /// The result in a line.
    pub(super) fn verdict(&mut self, words: String) {
        self.verdict = Some(words);
    }

    pub(super) fn section(&mut self, title: &str) {
        self.sections.push(Section { title: printable(title), items: Vec::new() });
    }

    fn push(&mut self, item: Item) {
        // Every item follows a section; one that did not would stand in a section without a title.
        if self.sections.is_empty() {
            self.section("");
        }
        if let Some(section) = self.sections.last_mut() {
            section.items.push(item);
        }
    }

    pub(super) fn words(&mut self, name: &str, words: &str) {
        self.push(Item::Words { name: printable(name), words: printable(words) });
    }

    pub(super) fn figure(&mut self, name: &str, number: &str, unit: &str) {
        self.push(Item::Figure { name: name.to_owned(), number: number.to_owned(), unit: unit.to_owned() });
    }

    pub(super) fn count(&mut self, name: &str, count: usize) {
        self.figure(name, &count.to_string(), "");
    }

    /// A small length with as many digits as are worth it.
    pub(super) fn small(&mut self, name: &str, number: &str) {
        self.figure(name, number, self.units.length);
    }

    pub(super) fn length(&mut self, name: &str, value: f64) {
        self.figure(name, &digits::plain(value, 3), self.units.length);
    }

    pub(super) fn area(&mut self, name: &str, value: f64) {
        let unit = self.units.area.clone();
        self.figure(name, &digits::plain(value, 2), &unit);
    }

    pub(super) fn volume(&mut self, name: &str, value: f64, remark: &str) {
        let unit = format!("{}{remark}", self.units.volume);
        self.figure(name, &digits::plain(value, 2), &unit);
    }

    /// Label of the unit of volumes.
    pub(super) fn unit_of_volume(&self) -> &str {
        &self.units.volume
    }

    pub(super) fn table(&mut self, groups: Vec<Group>, rows: Vec<Row>) {
        self.push(Item::Table(Table { groups, rows }));
    }

    pub(super) fn remark(&mut self, words: &str, below: Vec<String>) {
        self.push(Item::Remark { words: printable(words), below: below.iter().map(|line| printable(line)).collect() });
    }

    /// The files read, with their hashes.
    pub(super) fn inputs(&mut self, inputs: &[Input]) {
        for input in inputs {
            self.words(&input.role, &format!("{} ({}, {} bytes)", input.path, input.format, input.bytes));
            self.words("  sha256", &input.sha256);
            if let Some(crs) = &input.crs {
                self.words("  coordinate system", crs);
            }
        }
    }

    /// What the reader should know: of the result, and of how the input was read.
    pub(super) fn warnings(&mut self, warnings: &[super::Warning]) {
        for (title, kind) in [("Warnings", WarningKind::Warning), ("Notes", WarningKind::Note)] {
            let mut first = true;
            for warning in warnings.iter().filter(|warning| warning.kind == kind) {
                if std::mem::take(&mut first) {
                    self.section(title);
                }
                let mut lines = warning.message.lines();
                let first = lines.next().unwrap_or_default();
                self.remark(&format!("{}: {first}", warning.code), lines.map(|line| line.trim().to_owned()).collect());
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::LengthUnit;
    use crate::report::Tool;

    #[test]
    fn units_are_explained_where_they_are_not_metres() {
        let lead = |unit: LengthUnit, volumes| Page::new(&Tool::default(), "x", &unit.into(), volumes).lead[0].clone();
        assert_eq!(lead(LengthUnit::Metre, true), "Lengths in m, areas in m², volumes in m³");
        assert_eq!(lead(LengthUnit::Foot, false), "Lengths in ft, areas in ft²; 1 ft = 0.3048 m");
        assert_eq!(
            lead(LengthUnit::UsSurveyFoot, true),
            "Lengths in us-ft, areas in us-ft², volumes in us-ft³; 1 us-ft = 1200/3937 m (US survey foot)"
        );
    }
}
