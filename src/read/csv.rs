//! Text files: one vertex per row.

use super::columns::{self, ColumnOrder, Columns, HeaderProblem};
use super::number::{self, Field, Mark};
use super::sniff::{self, Delimiter};
use super::{CoordinateKind, PointRow, RawLine, RawShape, RawVertex, ReadError, Source};
use crate::model::{Defect, Defects, Note};
use std::collections::HashMap;

/// One row as read.
struct Record {
    row: u32,
    /// Counts the blank lines between rows.
    block: u32,
    /// Index into [`Table::ids`].
    id: u32,
    x: f64,
    y: f64,
    z: Option<f64>,
}

/// All rows of a file.
#[derive(Default)]
struct Table {
    records: Vec<Record>,
    /// Texts of the line-id column; empty without one.
    ids: Vec<String>,
}

/// The lines of a text file.
pub(super) fn lines(
    text: &str,
    source: &mut Source,
    order: Option<&ColumnOrder>,
    notes: &mut Vec<Note>,
) -> Result<Vec<RawLine>, ReadError> {
    let mut table = table(text, source, order, true, notes)?;
    let count = table.records.len();
    if count > 1 && table.ids.len() == count {
        notes.push(Note::new(
            "id-is-point-number",
            "the id column differs in every row: it is taken as a point number, not as a line id",
        ));
        table.ids.clear();
        table.records.iter_mut().for_each(|record| record.id = 0);
    }
    // A blank line after every single row is spacing (or a line end written as CR CR LF), not a split.
    if count > 1 && table.records.windows(2).all(|pair| pair[0].block != pair[1].block) {
        notes.push(Note::new("blank-lines-ignored", "a blank line follows every row: blank lines do not split lines here"));
        table.records.iter_mut().for_each(|record| record.block = 0);
    }
    Ok(group(&table, notes))
}

/// Rows of one id between two blank lines make one line.
fn group(table: &Table, notes: &mut Vec<Note>) -> Vec<RawLine> {
    let mut lines: Vec<RawLine> = Vec::new();
    let mut line_of = HashMap::new();
    let mut current: Option<((u32, u32), usize)> = None;
    let mut resumed = 0;
    for record in &table.records {
        let key = (record.block, record.id);
        let at = match current {
            Some((k, at)) if k == key => at,
            _ => {
                let next = lines.len();
                let at = *line_of.entry(key).or_insert(next);
                if at == next {
                    let name = table.ids.get(record.id as usize).filter(|id| !id.is_empty()).cloned();
                    lines.push(RawLine { name, feature: None, shape: RawShape::Line, vertices: Vec::new() });
                } else {
                    resumed += 1;
                }
                at
            }
        };
        current = Some((key, at));
        lines[at].vertices.push(RawVertex { x: record.x, y: record.y, z: record.z, row: Some(record.row) });
    }
    if resumed > 0 {
        let message = format!("rows of one line id do not stand together: {resumed} runs were appended to an earlier line");
        notes.push(Note::new("line-resumed", message));
    }
    lines
}

/// The points of a text file.
pub(super) fn points(
    text: &str,
    source: &mut Source,
    order: Option<&ColumnOrder>,
    notes: &mut Vec<Note>,
) -> Result<Vec<PointRow>, ReadError> {
    let table = table(text, source, order, false, notes)?;
    let mut defects = Defects::default();
    for record in table.records.iter().filter(|r| !r.x.is_finite() || !r.y.is_finite()) {
        defects.push("not-finite", || Defect {
            code: "not-finite",
            what: "a coordinate is not finite".into(),
            at: format!("{}, row {}", source.label, record.row),
            figures: Some(format!("({}, {})", record.x, record.y)),
            help: "correct the row or take it out".into(),
        });
    }
    defects.into_result().map_err(ReadError::Records)?;
    Ok(table.records.iter().map(|r| PointRow { x: r.x, y: r.y, row: r.row }).collect())
}

/// Rows of a text with their numbers from 1; ends at CR, LF or CR LF.
fn rows(text: &str) -> impl Iterator<Item = (u32, &str)> {
    let mut rest = Some(text);
    let mut number = 0;
    std::iter::from_fn(move || {
        let text = rest?;
        number += 1;
        match text.bytes().position(|b| b == b'\n' || b == b'\r') {
            Some(at) => {
                let width = if text[at..].starts_with("\r\n") { 2 } else { 1 };
                rest = Some(&text[at + width..]);
                Some((number, &text[..at]))
            }
            None => {
                rest = None;
                Some((number, text))
            }
        }
    })
}

/// Whether a row is a comment. A semicolon starts one only where it is not the delimiter.
fn is_comment(row: &str, delimiter: Option<Delimiter>) -> bool {
    let row = row.trim_start();
    if let Some(rest) = row.strip_prefix('#') {
        // What spreadsheets write for a missing or broken value is a field, not a comment.
        let word = rest.get(..3).unwrap_or(rest).to_ascii_uppercase();
        return !["N/A", "NA,", "NA;", "VAL", "REF", "DIV", "NUM"].contains(&word.as_str());
    }
    row.starts_with("//") || row.starts_with('%') || (row.starts_with(';') && delimiter != Some(Delimiter::Semicolon))
}

fn is_blank(row: &str, delimiter: Delimiter) -> bool {
    row.bytes().all(|b| b == b' ' || b == delimiter.byte() || b == b'\t')
}

fn table(
    text: &str,
    source: &mut Source,
    order: Option<&ColumnOrder>,
    want_z: bool,
    notes: &mut Vec<Note>,
) -> Result<Table, ReadError> {
    let candidates = rows(text).map(|(_, row)| row).filter(|row| !row.trim().is_empty() && !is_comment(row, None));
    let delimiter = sniff::delimiter(candidates);
    let mut last_comment = None;
    let mut first = None;
    for (number, row) in rows(text) {
        if is_comment(row, Some(delimiter)) {
            last_comment = Some(row);
        } else if !is_blank(row, delimiter) {
            first = Some((number, row));
            break;
        }
    }
    let Some((first_number, first_row)) = first else {
        return Err(content("the file is empty", &source.label, "no row with data", "give at least two rows of x, y, z"));
    };
    let fields = sniff::split(first_row, delimiter);
    let numbers = |f: &&&str| matches!(number::field(f, delimiter.decimal_comma()), Field::Number(..) | Field::Grouped);
    let has_header = !fields.iter().any(|f| numbers(&f)) && fields.iter().any(|f| number::field(f, true) == Field::Text);
    let at = format!("{}, row {first_number}", source.label);
    let columns = match order {
        Some(order) => {
            if has_header {
                let message = format!("row {first_number} is a header; the columns are taken from the order `{order}` instead");
                notes.push(Note::new("header-ignored", message));
            }
            order.columns(want_z).ok_or_else(|| {
                let help = "add `z` where the elevation stands";
                content("the column order has no elevation", &source.label, &format!("`{order}`"), help)
            })?
        }
        None if has_header => {
            let fields = merge_units(&fields);
            columns::from_header(&fields, want_z).map_err(|problem| header_error(problem, &at, &fields))?
        }
        None => match last_comment.and_then(|c| header_in_comment(c, delimiter, fields.len(), want_z)) {
            Some(columns) => {
                notes.push(Note::new("header-in-comment", "the columns are taken from the comment above the first row"));
                columns
            }
            None => return Err(no_header(first_row, &at, want_z)),
        },
    };
    source.kind = columns.kind;
    let (clean, places) = clean(text, delimiter, if has_header { first_number } else { 0 });
    if places.is_empty() {
        return Err(content("the file has a header but no data", &at, "no row follows", "give at least two rows"));
    }
    let (table, comma) = parse(&clean, &places, &columns, delimiter, &source.label)?;
    let mark = if comma { "comma" } else { "point" };
    let header = if has_header { "with header" } else { "without header" };
    let message = format!("{} rows {header}, separated by {}, decimal {mark}", table.records.len(), delimiter.name());
    notes.push(Note::new("csv-dialect", message));
    if columns.kind == CoordinateKind::Degrees {
        source.crs = Some("longitude and latitude, by the column headings".into());
    }
    Ok(table)
}

/// Blank-separated headings like `x [m]`: a bracket belongs to the heading before it.
fn merge_units<'a>(fields: &[&'a str]) -> Vec<&'a str> {
    fields.iter().copied().filter(|field| !field.starts_with(['[', '('])).collect()
}

/// A comment that names the columns, such as `//X Y Z`, counts as a header if it fits the rows.
fn header_in_comment(comment: &str, delimiter: Delimiter, width: usize, want_z: bool) -> Option<Columns> {
    let bare = comment.trim().trim_start_matches(['#', '/', '%', ';']);
    let split = sniff::split(bare, delimiter);
    let fields = merge_units(&split);
    if fields.len() != width {
        return None;
    }
    columns::from_header(&fields, want_z).ok()
}

/// The rows with data, one per line, with row number and block of each. Runs of blanks become one tab where blanks separate.
fn clean(text: &str, delimiter: Delimiter, header: u32) -> (String, Vec<(u32, u32)>) {
    let mut clean = String::with_capacity(text.len() + 1);
    let mut places = Vec::new();
    let mut block = 0;
    let mut blank_before = false;
    for (number, row) in rows(text).skip(header as usize) {
        if is_blank(row, delimiter) {
            blank_before = true;
        } else if !is_comment(row, Some(delimiter)) {
            if std::mem::take(&mut blank_before) && !places.is_empty() {
                block += 1;
            }
            places.push((number, block));
            if delimiter == Delimiter::Blanks {
                let mut quoted = false;
                let mut pending = false;
                for c in row.trim().chars() {
                    quoted ^= c == '"';
                    if (c == ' ' || c == '\t') && !quoted {
                        pending = true;
                    } else {
                        if std::mem::take(&mut pending) {
                            clean.push('\t');
                        }
                        clean.push(c);
                    }
                }
            } else {
                clean.push_str(row);
            }
            clean.push('\n');
        }
    }
    (clean, places)
}

/// Parses cleaned rows. Also says whether decimal commas were used.
fn parse(
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
                return Err(content("the row cannot be split into fields", &at, &cause.to_string(), "correct the row"));
            }
        }
        if record.as_slice().contains(&b'\n') {
            let at = format!("{label}, row {row}");
            let help = "close the quotes, or take them out";
            return Err(content("a quoted field runs over the end of its row", &at, "quotes are not closed", help));
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
        return Err(content("decimal points and decimal commas are mixed", &at, &figures, "write all numbers with one mark"));
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

/// A text short enough for a message.
fn clip(text: &str) -> String {
    const LONGEST: usize = 60;
    match text.char_indices().nth(LONGEST) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text.to_owned(),
    }
}

fn show(record: &::csv::ByteRecord) -> String {
    let fields: Vec<&str> = (0..record.len().min(12)).map(|i| text_of(record, i)).collect();
    clip(&fields.join(" | "))
}

fn content(what: &str, at: &str, figures: &str, help: &str) -> ReadError {
    ReadError::Content { what: what.into(), at: at.into(), figures: figures.into(), help: help.into() }
}

fn header_error(problem: HeaderProblem, at: &str, headings: &[&str]) -> ReadError {
    let found = clip(&headings.join(" | "));
    match problem {
        HeaderProblem::Lacks(what) => {
            let help = "name the columns e.g. `x,y,z`, `easting,northing,elevation`, `Rechtswert;Hochwert;Höhe`, or give \
                        `--csv-order`";
            content(&format!("the header has no column for the {what}"), at, &format!("columns: {found}"), help)
        }
        HeaderProblem::Ambiguous(what, names) => {
            let names: Vec<String> = names.iter().map(|name| format!("`{}`", clip(name))).collect();
            let help = "rename the columns not meant, or give `--csv-order` with `_` for columns to skip";
            let what = format!("the header has several columns for the {what}");
            content(&what, at, &format!("{} could all be meant", clip(&names.join(", "))), help)
        }
    }
}

fn no_header(row: &str, at: &str, want_z: bool) -> ReadError {
    let what = "the file has no header, and which column is northing and which easting is not guessed";
    let help = if want_z {
        "name the columns: `--csv-order xyz` if easting comes first, `nez` if northing does, `pnezd` with point number and \
         description; `_` skips a column, `l` is a line id"
    } else {
        "name the columns: `--csv-order xy` if easting comes first, `yx` if northing does; `_` skips a column"
    };
    content(what, at, &format!("first row: `{}`", clip(row.trim())), help)
}
