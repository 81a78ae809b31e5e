//! The fast way through rows of plain numbers.

use super::Layout;
use super::rows::{is_blank, is_comment};
use crate::read::decimal;
use crate::read::sniff::Delimiter;
use glam::DVec3;
use memchr::memchr;

/// The points, if every row has finite numbers with decimal points in the columns wanted, and no fields nobody knows of. Blank
/// rows and comments are passed over.
pub(super) fn points(text: &str, layout: &Layout) -> Option<Vec<DVec3>> {
    let mut rest = text.as_bytes();
    for _ in 0..layout.header {
        let end = memchr(b'\n', rest)?;
        // Rows may end otherwise: then they are counted otherwise too.
        if memchr(b'\r', &rest[..end]).is_some_and(|at| at + 1 < end) {
            return None;
        }
        rest = &rest[end + 1..];
    }
    let wanted = [layout.columns.x, layout.columns.y, layout.columns.z?];
    let last = wanted[0].max(wanted[1]).max(wanted[2]);
    if layout.columns.id.is_some() || last >= MOST_COLUMNS {
        return None;
    }
    let mut points = Vec::new();
    while !rest.is_empty() {
        let end = memchr(b'\n', rest).unwrap_or(rest.len());
        let row = rest[..end].strip_suffix(b"\r").unwrap_or(&rest[..end]);
        rest = rest.get(end + 1..).unwrap_or(&[]);
        let mut fields: [&[u8]; MOST_COLUMNS] = [&[]; MOST_COLUMNS];
        let count = match layout.delimiter {
            Delimiter::Blanks => split_blanks(row, &mut fields),
            other => split(row, other.byte(), &mut fields),
        };
        let values = wanted.map(|column| decimal::number(fields[column].trim_ascii()));
        let known = count <= layout.columns.named || (layout.columns.open_ended && memchr(b'"', row).is_none());
        match values {
            [Some(x), Some(y), Some(z)] if count > last && known => {
                let point = DVec3::new(x, y, z);
                if !point.is_finite() {
                    return None;
                }
                if points.is_empty() {
                    // One row tells how many there will be, nearly.
                    points.reserve(text.len() / (row.len() + 1) + 1);
                }
                points.push(point);
            }
            _ => {
                let row = std::str::from_utf8(row).ok()?;
                if row.contains('\r') || !(is_blank(row, layout.delimiter) || is_comment(row, Some(layout.delimiter))) {
                    return None;
                }
            }
        }
    }
    if points.is_empty() { None } else { Some(points) }
}

/// Columns looked at; files with more are read the other way.
const MOST_COLUMNS: usize = 16;

/// Fields of a row; returns their number, which may be larger than there is room for.
fn split<'a>(row: &'a [u8], delimiter: u8, fields: &mut [&'a [u8]; MOST_COLUMNS]) -> usize {
    let mut count = 0;
    let mut begin = 0;
    for (i, &byte) in row.iter().enumerate() {
        if byte == delimiter {
            if count < MOST_COLUMNS {
                fields[count] = &row[begin..i];
            }
            count += 1;
            begin = i + 1;
        }
    }
    if count < MOST_COLUMNS {
        fields[count] = &row[begin..];
    }
    count + 1
}

/// The same for fields between runs of blanks.
fn split_blanks<'a>(row: &'a [u8], fields: &mut [&'a [u8]; MOST_COLUMNS]) -> usize {
    let mut count = 0;
    let mut begin = None;
    for (i, &byte) in row.iter().enumerate() {
        match (byte == b' ' || byte == b'\t', begin) {
            (false, None) => begin = Some(i),
            (true, Some(from)) => {
                if count < MOST_COLUMNS {
                    fields[count] = &row[from..i];
                }
                count += 1;
                begin = None;
            }
            _ => {}
        }
    }
    if let Some(from) = begin {
        if count < MOST_COLUMNS {
            fields[count] = &row[from..];
        }
        count += 1;
    }
    count
}
