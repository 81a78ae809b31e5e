//! Text files: one vertex per row.

mod parse;
mod plain;
mod rows;

use super::columns::{self, ColumnOrder, Columns, HeaderProblem};
use super::error::{clip, refuse};
use super::number::{self, Field};
use super::sniff::{self, Delimiter};
use super::{CoordinateKind, PointRow, RawLine, RawShape, RawVertex, ReadError, Source};
use crate::model::{Defect, Defects, Note};
use glam::DVec3;
use parse::Table;
use rows::{is_blank, is_comment};
use std::collections::HashMap;

/// The lines of a text file; `want_z`: whether they need elevations.
pub(super) fn lines(
    text: &str,
    source: &mut Source,
    order: Option<&ColumnOrder>,
    want_z: bool,
    notes: &mut Vec<Note>,
) -> Result<Vec<RawLine>, ReadError> {
    let mut table = table(text, source, order, want_z, notes)?;
    let count = table.records.len();
    if count > 1 && table.ids.len() + closings(&table) == count {
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

/// How many rows close a ring by repeating its first row, id and place alike: the last of a run of four and more.
fn closings(table: &Table) -> usize {
    let place = |r: &parse::Record| (r.id, r.x, r.y, r.z);
    let closes = |run: &&[parse::Record]| run.len() > 3 && run.first().map(place) == run.last().map(place);
    table.records.chunk_by(|a, b| a.block == b.block).filter(closes).count()
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

/// How a text file is laid out.
pub(super) struct Layout {
    pub(super) columns: Columns,
    pub(super) delimiter: Delimiter,
    /// Row of the header, counted from 1; 0 without one.
    pub(super) header: u32,
    /// The first row with data or the header, in words.
    at: String,
}

/// Finds the layout; `by_name` are the columns of a file without header whose name says them.
fn layout(
    text: &str,
    source: &mut Source,
    (order, by_name): (Option<&ColumnOrder>, Option<&ColumnOrder>),
    want_z: bool,
    notes: &mut Vec<Note>,
) -> Result<Layout, ReadError> {
    let candidates = rows::rows(text).map(|(_, row)| row).filter(|row| !row.trim().is_empty() && !is_comment(row, None));
    let delimiter = sniff::delimiter(candidates);
    let mut last_comment = None;
    let mut first = None;
    for (number, row) in rows::rows(text) {
        if is_comment(row, Some(delimiter)) {
            last_comment = Some(row);
        } else if !is_blank(row, delimiter) {
            first = Some((number, row));
            break;
        }
    }
    let Some((first_number, first_row)) = first else {
        return Err(refuse("the file is empty", source.label.as_str(), "no row with data", "give at least two rows of x, y, z"));
    };
    let fields = sniff::split(first_row, delimiter);
    let numbers = |f: &&&str| matches!(number::field(f, delimiter.decimal_comma()), Field::Number(..) | Field::Grouped);
    let has_header = !fields.iter().any(|f| numbers(&f)) && fields.iter().any(|f| number::field(f, true) == Field::Text);
    let at = format!("{}, row {first_number}", source.label);
    let no_z = |order: &ColumnOrder| {
        let help = "add `z` where the elevation stands";
        refuse("the column order has no elevation", source.label.as_str(), format!("`{order}`"), help)
    };
    let columns = match order {
        Some(order) => {
            if has_header {
                let message = format!("row {first_number} is a header; the columns are taken from the order `{order}` instead");
                notes.push(Note::new("header-ignored", message));
            }
            order.columns(want_z).ok_or_else(|| no_z(order))?
        }
        None if has_header => {
            let fields = merge_units(&fields);
            let columns = columns::from_header(&fields, want_z).map_err(|problem| header_error(problem, &at, &fields))?;
            if let Some(order) = columns::y_as_easting(&fields, &columns) {
                let message = format!(
                    "Y stands before X in the header: by their names X is taken as easting and Y as northing. If Y is the easting, \
                     as in lists of Gauss-Krüger coordinates, give `--csv-order {order}` (for ground `--terrain-order`)"
                );
                notes.push(Note::new("header-y-first", message));
            }
            columns
        }
        None => match last_comment.and_then(|c| header_in_comment(c, delimiter, fields.len(), want_z)) {
            Some(columns) => {
                notes.push(Note::new("header-in-comment", "the columns are taken from the comment above the first row"));
                columns
            }
            None => match by_name {
                Some(order) => order.columns(want_z).ok_or_else(|| no_z(order))?,
                None => return Err(no_header(first_row, &at, want_z)),
            },
        },
    };
    source.kind = columns.kind;
    if columns.kind == CoordinateKind::Degrees {
        source.crs = Some("longitude and latitude, by the column headings".into());
    }
    Ok(Layout { columns, delimiter, header: if has_header { first_number } else { 0 }, at })
}

fn table(
    text: &str,
    source: &mut Source,
    order: Option<&ColumnOrder>,
    want_z: bool,
    notes: &mut Vec<Note>,
) -> Result<Table, ReadError> {
    let layout = layout(text, source, (order, None), want_z, notes)?;
    read_table(text, &source.label, &layout, notes)
}

fn read_table(text: &str, label: &str, layout: &Layout, notes: &mut Vec<Note>) -> Result<Table, ReadError> {
    let (clean, places) = rows::clean(text, layout.delimiter, layout.header);
    if places.is_empty() {
        return Err(refuse("the file has a header but no data", layout.at.as_str(), "no row follows", "give at least two rows"));
    }
    let (table, comma) = parse::parse(&clean, &places, &layout.columns, layout.delimiter, label)?;
    notes.push(dialect(table.records.len(), layout, comma));
    Ok(table)
}

fn dialect(rows: usize, layout: &Layout, comma: bool) -> Note {
    let mark = if comma { "comma" } else { "point" };
    let header = if layout.header > 0 { "with header" } else { "without header" };
    let message = format!("{rows} rows {header}, separated by {}, decimal {mark}", layout.delimiter.name());
    Note::new("csv-dialect", message)
}

/// The points of a text file with elevations, all of them finite.
///
/// Rows of plain numbers, of which ground has millions, are read in one pass; if a single row is anything else, the file is
/// read again with all care.
pub(super) fn ground(
    text: &str,
    source: &mut Source,
    orders: (Option<&ColumnOrder>, Option<&ColumnOrder>),
    notes: &mut Vec<Note>,
) -> Result<Vec<DVec3>, ReadError> {
    let layout = layout(text, source, orders, true, notes)?;
    if let Some(points) = plain::points(text, &layout) {
        notes.push(dialect(points.len(), &layout, false));
        return Ok(points);
    }
    let table = read_table(text, &source.label, &layout, notes)?;
    let mut defects = Defects::default();
    let mut points = Vec::with_capacity(table.records.len());
    for record in &table.records {
        let point = DVec3::new(record.x, record.y, record.z.unwrap_or(f64::NAN));
        if !point.is_finite() {
            const HELP: &str = "correct the row or take it out";
            let (code, what) = match record.z {
                None => ("no-elevation", "a point of the ground has no elevation"),
                Some(_) => ("not-finite", "a coordinate is not finite"),
            };
            defects.push(code, || Defect {
                code,
                what: what.into(),
                at: format!("{}, row {}", source.label, record.row),
                figures: Some(format!("({}, {}, {})", point.x, point.y, point.z)),
                help: HELP.into(),
            });
        }
        points.push(point);
    }
    defects.into_result().map_err(ReadError::Records)?;
    Ok(points)
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

fn header_error(problem: HeaderProblem, at: &str, headings: &[&str]) -> ReadError {
    let found = clip(headings.join(" | "));
    match problem {
        HeaderProblem::Lacks(what) => {
            let help = "name the columns e.g. `x,y,z`, `easting,northing,elevation`, `Rechtswert;Hochwert;Höhe`, or give \
                        `--csv-order`";
            refuse(&format!("the header has no column for the {what}"), at, format!("columns: {found}"), help)
        }
        HeaderProblem::Ambiguous(what, names) => {
            let names: Vec<String> = names.iter().map(|name| format!("`{}`", clip(name))).collect();
            let help = "rename the columns not meant, or give `--csv-order` with `_` for columns to skip";
            let what = format!("the header has several columns for the {what}");
            refuse(&what, at, format!("{} could all be meant", clip(names.join(", "))), help)
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
    refuse(what, at, format!("first row: `{}`", clip(row.trim())), help)
}
