//! Rows → records: splits them into fields, reads the numbers and collects what is wrong.

use crate::model::{Defect, Defects};
use crate::read::ReadError;
use crate::read::columns::Columns;
use crate::read::error::{clip, refuse};
use crate::read::number::{self, Field, Mark};
use crate::read::sniff::Delimiter;
use std::collections::HashMap;

/// One row as read.
pub(super) struct Record {
    pub(super) row: u32,
    /// Counts the blank lines between rows.
    pub(super) block: u32,
    /// Index into [`Table::ids`].
    pub(super) id: u32,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) z: Option<f64>,
}

/// All rows of a file.
#[derive(Default)]
pub(super) struct Table {
    pub(super) records: Vec<Record>,
    /// Texts of the line-id column; empty without one.
    pub(super) ids: Vec<String>,
}

/// Parses cleaned rows. Also says whether decimal commas were used.
pub(super) fn parse(
    clean: &str,
    places: &[(u32, u32)],
    columns: &Columns,
    delimiter: Delimiter,
    label: &str,
) -> Result<(Table, bool), ReadError> {
    let mut reader =
        ::csv::ReaderBuilder::new().has_headers(false).flexible(true).delimiter(delimiter.byte()).from_reader(clean.as_bytes());
    let mut record = ::csv::ByteRecord::new();
    let mut table = Table { records: Vec::with_capacity(places.len()), ids: Vec::new() };
    let mut known: HashMap<String, u32> = HashMap::new();
    let mut checks = Checks { label, columns, delimiter, defects: Defects::default(), point: None, comma: None };
    for &(row, block) in places {
        match reader.read_byte_record(&mut record) {
            Ok(true) => {}
            // Fewer records than rows: a quoted field ran on; it was reported where it began.
            Ok(false) => break,
            Err(cause) => {
                let at = format!("{label}, row {row}");
                return Err(refuse("the row cannot be split into fields", at, cause.to_string(), "correct the row"));
            }
        }
        if record.as_slice().contains(&b'\n') {
            let at = format!("{label}, row {row}");
            let help = "close the quotes, or take them out";
            return Err(refuse("a quoted field runs over the end of its row", at, "quotes are not closed", help));
        }
        let Some((x, y, z)) = checks.read(&record, row) else { continue };
        let mut id = 0;
        if let Some(column) = columns.id {
            let text = text_of(&record, column);
            let same = table.records.last().and_then(|last| table.ids.get(last.id as usize).map(|t| (last.id, t == text)));
            id = match same {
                Some((last, true)) => last,
                _ => match known.get(text) {
                    Some(&id) => id,
                    None => {
                        let id = table.ids.len() as u32;
                        known.insert(text.to_owned(), id);
                        table.ids.push(text.to_owned());
                        id
                    }
                },
            };
        }
        table.records.push(Record { row, block, id, x, y, z });
    }
    if let (Some((row, a)), Some((other, b))) = (&checks.point, &checks.comma) {
        let (figures, at) = (format!("`{a}` in row {row}, `{b}` in row {other}"), format!("{label}, row {}", row.max(other)));
        return Err(refuse("decimal points and decimal commas are mixed", at, figures, "write all numbers with one mark"));
    }
    let comma = checks.comma.is_some();
    checks.defects.into_result().map_err(ReadError::Records)?;
    Ok((table, comma))
}

fn text_of(record: &::csv::ByteRecord, column: usize) -> &str {
    // The file is valid UTF-8 and is split at ASCII bytes, so every field is valid too.
    record.get(column).and_then(|field| std::str::from_utf8(field).ok()).unwrap_or("").trim()
}

/// Reads rows and collects what is wrong with them.
struct Checks<'a> {
    label: &'a str,
    columns: &'a Columns,
    delimiter: Delimiter,
    defects: Defects,
    /// First number with a decimal point, and its row.
    point: Option<(u32, String)>,
    /// First number with a decimal comma, and its row.
    comma: Option<(u32, String)>,
}

impl Checks<'_> {
    fn read(&mut self, record: &::csv::ByteRecord, row: u32) -> Option<(f64, f64, Option<f64>)> {
        let columns = *self.columns;
        // A comment may end the row.
        let extra = (columns.named..record.len()).map(|i| text_of(record, i)).take_while(|text| !text.starts_with('#'));
        let extra = extra.into_iter().any(|text| !text.is_empty());
        if extra && !columns.open_ended {
            self.push("too-many-fields", row, "the row has more fields than there are columns", || {
                let figures = format!("{} fields, {} columns: `{}`", record.len(), columns.named, show(record));
                (
                    figures,
                    "decimal commas or thousands separators beside a comma as delimiter? Write decimal points, or \
                           separate by semicolons; put texts with commas in quotes; name columns to skip with `_`",
                )
            });
            return None;
        }
        if columns.id.is_some_and(|column| column >= record.len()) {
            self.push("too-few-fields", row, "the row is too short: it has no line id", || {
                (format!("{} fields: `{}`", record.len(), show(record)), "complete the row or take it out")
            });
            return None;
        }
        let x = self.number(record, columns.x, row, "easting");
        let y = self.number(record, columns.y, row, "northing");
        let z = match columns.z {
            Some(column) => self.number(record, column, row, "elevation"),
            None => Some(None),
        };
        // An elevation may be missing (validation reports it), a plan coordinate may not.
        for (value, name) in [(x, "easting"), (y, "northing")] {
            if value == Some(None) {
                self.push("missing-coordinate", row, &format!("the {name} is missing"), || {
                    (format!("`{}`", show(record)), "complete the row or take it out")
                });
            }
        }
        Some((x??, y??, z?))
    }

    /// `None`: a defect was noted; `Some(None)`: missing.
    fn number(&mut self, record: &::csv::ByteRecord, column: usize, row: u32, name: &str) -> Option<Option<f64>> {
        if column >= record.len() {
            self.push("too-few-fields", row, &format!("the row is too short: it has no {name}"), || {
                let figures = format!("{} fields, {name} is field {}: `{}`", record.len(), column + 1, show(record));
                (figures, "complete the row or take it out")
            });
            return None;
        }
        let text = text_of(record, column);
        let mut field = number::field(text, self.delimiter.decimal_comma());
        if field == Field::Text
            && let Some((before, _comment)) = text.split_once('#')
            && !before.is_empty()
        {
            field = number::field(before, self.delimiter.decimal_comma());
        }
        match field {
            Field::Number(value, mark) => {
                let seen = match mark {
                    Mark::Point => Some(&mut self.point),
                    Mark::Comma => Some(&mut self.comma),
                    Mark::None => None,
                };
                if let Some(seen) = seen {
                    seen.get_or_insert_with(|| (row, text.to_owned()));
                }
                Some(Some(value))
            }
            Field::Missing => Some(None),
            Field::Grouped => {
                let what = format!("the {name} has thousands separators, or a decimal comma beside a comma as delimiter");
                self.push("thousands", row, &what, || {
                    (format!("`{}`", clip(text)), "write numbers without separators, and decimal commas only with semicolons")
                });
                None
            }
            Field::Text => {
                self.push("not-a-number", row, &format!("the {name} is not a number"), || {
                    (format!("`{}`", clip(text)), "correct the row, or comment it out with `#`")
                });
                None
            }
        }
    }

    fn push(&mut self, code: &'static str, row: u32, what: &str, figures: impl FnOnce() -> (String, &'static str)) {
        let label = self.label;
        self.defects.push(code, || {
            let (figures, help) = figures();
            let at = format!("{label}, row {row}");
            Defect { code, what: what.to_owned(), at, figures: Some(figures), help: help.into() }
        });
    }
}

fn show(record: &::csv::ByteRecord) -> String {
    let fields: Vec<&str> = (0..record.len().min(12)).map(|i| text_of(record, i)).collect();
    clip(fields.join(" | "))
}
