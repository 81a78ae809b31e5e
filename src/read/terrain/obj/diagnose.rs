//! Which line of an OBJ file is wrong, and how.

use super::text::{line_at, without_comment};
use crate::read::error::{clip, refuse};
use crate::read::{ReadError, decimal};

fn at_line(label: &str, bytes: &[u8], at: usize, what: &str, figures: impl FnOnce(&str) -> String, help: &str) -> ReadError {
    let (number, line) = line_at(bytes, at);
    refuse(what, format!("{label}, line {number}"), figures(&clip(line)), help)
}

/// A line that is no statement of OBJ.
fn unknown(label: &str, bytes: &[u8], at: usize) -> ReadError {
    let help = "is this an OBJ file? If so, take the line out, or comment it out with `#`";
    at_line(label, bytes, at, "a line is not a statement of OBJ", |line| format!("`{line}`"), help)
}

/// A vertex with a fourth coordinate.
fn weight(label: &str, bytes: &[u8], at: usize) -> ReadError {
    let help = "write three coordinates; a weight, which has a meaning for curves only, must be 1";
    at_line(label, bytes, at, "a vertex has a weight", |line| format!("`{line}`: the fourth number is not 1"), help)
}

/// A vertex with a number of fields that has no meaning.
fn wrong_fields(label: &str, bytes: &[u8], at: usize) -> ReadError {
    let count = |line: &str| line.split_whitespace().count() - 1;
    let help = "write three coordinates, or three and a colour of three";
    at_line(label, bytes, at, "a vertex has a wrong number of fields", |line| format!("{} fields: `{line}`", count(line)), help)
}

/// Statements `word` of the file: where each begins, and its fields.
fn statements<'a>(bytes: &'a [u8], word: &'static [u8]) -> impl Iterator<Item = (usize, Vec<&'a [u8]>)> {
    let mut begin = 0;
    bytes.split_inclusive(|&b| b == b'\n').filter_map(move |line| {
        let at = begin;
        begin += line.len();
        let line = line.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(line);
        let mut fields = without_comment(line).split(u8::is_ascii_whitespace).filter(|f| !f.is_empty());
        (fields.next() == Some(word)).then(|| (at, fields.collect()))
    })
}

/// Vertex `index`, which is not finite.
pub(super) fn not_finite(label: &str, bytes: &[u8], index: usize) -> ReadError {
    let at = statements(bytes, b"v").nth(index).map_or(0, |(at, _)| at);
    let what = "a vertex is not finite";
    let figures = |line: &str| format!("vertex {}: `{line}`", index + 1);
    at_line(label, bytes, at, what, figures, "correct it, or take the vertex and its faces out")
}

/// The line that begins at `at`, which is wrong.
pub(super) fn wrong_line(label: &str, bytes: &[u8], at: usize) -> ReadError {
    let (_, line) = line_at(bytes, at);
    let mut fields = without_comment(line).split(u8::is_ascii_whitespace).filter(|f| !f.is_empty());
    let word = fields.next();
    let fields: Vec<&[u8]> = fields.collect();
    match word {
        Some(b"v") => vertex(label, bytes, at, &fields),
        Some(b"f") => {
            let before = statements(bytes, b"v").take_while(|(vertex, _)| *vertex < at).count();
            bad_face(label, bytes, at, &fields, [statements(bytes, b"v").count(), before])
        }
        _ => None,
    }
    .unwrap_or_else(|| unknown(label, bytes, at))
}

/// The first face that names a vertex that is not there.
pub(super) fn missing(label: &str, bytes: &[u8]) -> ReadError {
    let count = statements(bytes, b"v").count();
    // Faces count backwards from the vertices before them.
    let mut before = statements(bytes, b"v").map(|(at, _)| at).peekable();
    let mut seen = 0;
    let first = statements(bytes, b"f").find_map(|(at, fields)| {
        while before.next_if(|&vertex| vertex < at).is_some() {
            seen += 1;
        }
        bad_face(label, bytes, at, &fields, [count, seen])
    });
    first.unwrap_or_else(|| refuse("a face names a vertex that is not there", label, format!("the file has {count}"), NOT_THERE))
}

const NOT_THERE: &str = "was the file cut off, or put together wrongly?";

/// What is wrong with a vertex, if anything is.
fn vertex(label: &str, bytes: &[u8], at: usize, fields: &[&[u8]]) -> Option<ReadError> {
    let figures = |line: &str| format!("`{line}`");
    if fields.len() < 3 {
        let what = "a vertex does not have three numbers";
        return Some(at_line(label, bytes, at, what, figures, "complete the line; was the file cut off?"));
    }
    if let Some(bad) = fields.iter().take(3).find(|field| decimal::number(field).is_none()) {
        let help = if bad.contains(&b',') { "write decimal points instead of commas" } else { "correct the number" };
        let what =
            if bad.contains(&b',') { "a coordinate has no decimal point but a comma" } else { "a coordinate is not a number" };
        return Some(at_line(label, bytes, at, what, |line| format!("`{}` in `{line}`", clip(bad)), help));
    }
    match fields.len() {
        4 => Some(weight(label, bytes, at)),
        3 | 6 | 7 => None,
        _ => Some(wrong_fields(label, bytes, at)),
    }
}

/// What is wrong with a face, if anything is. `counts`: the vertices of the file, and those before the face.
fn bad_face(label: &str, bytes: &[u8], at: usize, fields: &[&[u8]], counts: [usize; 2]) -> Option<ReadError> {
    let [count, seen] = counts.map(|n| n as i128);
    let refused = |what: &str, figures: String, help: &str| {
        Some(at_line(label, bytes, at, what, |line| format!("{figures}: `{line}`"), help))
    };
    for field in fields {
        let parts: Vec<Option<i128>> = field
            .split(|&b| b == b'/')
            .enumerate()
            .map(|(i, part)| if i > 0 && part.is_empty() { Some(1) } else { std::str::from_utf8(part).ok()?.parse().ok() })
            .collect();
        let help = "write vertex numbers counted from 1, or from -1 backwards, e.g. `f 1 2 3` or `f 1/1/1 2/2/2 3/3/3`";
        let index = match parts.as_slice() {
            [Some(index)] | [Some(index), Some(_)] | [Some(index), Some(_), Some(_)] => *index,
            _ => return refused("a corner of a face is not a whole number", format!("`{}`", clip(field)), help),
        };
        if index == 0 || index > count || -index > seen {
            let figures = match index {
                0 => "vertex 0, and they are counted from 1".to_owned(),
                1.. => format!("vertex {index}, the file has {count}"),
                _ => format!("vertex {index}, counted back from the {seen} before it"),
            };
            return refused("a face names a vertex that is not there", figures, NOT_THERE);
        }
    }
    let figures = |line: &str| format!("`{line}`");
    let few = || at_line(label, bytes, at, "a face has fewer than three corners", figures, "take the face out");
    (fields.len() < 3).then(few)
}
