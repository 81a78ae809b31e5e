//! ESRI ASCII grid.

use super::{NO_HEIGHT, RawGrid, RawGround, Said};
use crate::model::Note;
use crate::read::error::{clip, refuse};
use crate::read::{ReadError, decimal};
use glam::DVec2;

/// Elevation that stands for none in a grid that does not say which: the default of the format.
const NO_DATA: f64 = -9999.0;

pub(super) fn read(label: &str, bytes: &[u8], notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let mut tokens = Tokens { label, bytes, at: 0, point: false, comma: false };
    let header = Header::read(&mut tokens)?;
    let (columns, rows) = (header.columns, header.rows);
    let figures = || format!("{columns} columns and {rows} rows");
    // Every value but the last takes two bytes.
    let room = (bytes.len() - tokens.at) / 2 + 1;
    let Some(count) = columns.checked_mul(rows).filter(|&count| count <= room) else {
        let figures = format!("{}, but only {} bytes of values", figures(), bytes.len() - tokens.at);
        return Err(refuse("the grid is shorter than its header says", label, figures, "copy or export the file again"));
    };
    let width = tokens.in_line();
    if width == rows && !columns.is_multiple_of(width) && width != columns {
        let figures = format!("{}, but {width} values in the first row", figures());
        return Err(refuse("columns and rows of the grid are exchanged", label, figures, "exchange `ncols` and `nrows`"));
    }
    let mut heights = Vec::with_capacity(count);
    while let Some(token) = tokens.next() {
        if heights.len() == count {
            let figures = format!("{}: {count} values, and more follow", figures());
            return Err(refuse("the grid is longer than its header says", label, figures, "copy or export the file again"));
        }
        let value = tokens.number(token)?;
        let none = value.is_nan() || value == header.no_data || value.abs() >= NO_HEIGHT;
        heights.push(if none { f64::NAN } else { value });
    }
    if heights.len() < count {
        let figures = format!("{}: {count} values; {} are there", figures(), heights.len());
        return Err(refuse("the grid is shorter than its header says", label, figures, "copy or export the file again"));
    }
    if tokens.point && tokens.comma {
        let help = "write all numbers with decimal points";
        return Err(refuse("decimal points and decimal commas are mixed", label, "both are in the grid", help));
    }
    if tokens.comma {
        notes.push(Note::new("decimal-comma", "the grid is written with decimal commas"));
    }
    let grid = RawGrid { columns, rows, origin: header.origin, step: header.step, heights };
    Ok((RawGround::Grid(grid), Said::default()))
}

/// Words separated by blanks and line ends.
struct Tokens<'a> {
    label: &'a str,
    bytes: &'a [u8],
    at: usize,
    /// Whether numbers with decimal points were met, and with decimal commas.
    point: bool,
    comma: bool,
}

impl<'a> Tokens<'a> {
    fn next(&mut self) -> Option<&'a [u8]> {
        let rest = &self.bytes[self.at..];
        let begin = rest.iter().position(|b| !b.is_ascii_whitespace())?;
        let word = &rest[begin..];
        let end = word.iter().position(u8::is_ascii_whitespace).unwrap_or(word.len());
        self.at += begin + end;
        Some(&word[..end])
    }

    /// Words before the next line end.
    fn in_line(&self) -> usize {
        let rest = self.bytes[self.at..].trim_ascii_start();
        let end = rest.iter().position(|&b| b == b'\n' || b == b'\r').unwrap_or(rest.len());
        rest[..end].split(u8::is_ascii_whitespace).filter(|word| !word.is_empty()).count()
    }

    fn number(&mut self, token: &[u8]) -> Result<f64, ReadError> {
        if let Some(value) = decimal::number(token) {
            self.point |= token.contains(&b'.');
            return Ok(value);
        }
        let commas = token.iter().filter(|&&b| b == b',').count();
        if commas == 1 && !token.contains(&b'.') {
            let pointed: Vec<u8> = token.iter().map(|&b| if b == b',' { b'.' } else { b }).collect();
            if let Some(value) = decimal::number(&pointed) {
                self.comma = true;
                return Ok(value);
            }
        }
        let line = memchr::memchr_iter(b'\n', &self.bytes[..self.at]).count() + 1;
        let at = format!("{}, line {line}", self.label);
        Err(refuse("a value of the grid is not a number", at, format!("`{}`", clip(token)), "correct the file"))
    }
}

struct Header {
    columns: usize,
    rows: usize,
    origin: DVec2,
    step: DVec2,
    no_data: f64,
}

impl Header {
    fn read(tokens: &mut Tokens<'_>) -> Result<Self, ReadError> {
        const KEYS: [&str; 10] =
            ["ncols", "nrows", "xllcorner", "yllcorner", "xllcenter", "yllcenter", "cellsize", "dx", "dy", "nodata_value"];
        let mut values = [None; KEYS.len()];
        let label = tokens.label;
        loop {
            let before = tokens.at;
            let Some(word) = tokens.next() else { break };
            if !word[0].is_ascii_alphabetic() || decimal::number(word).is_some() {
                tokens.at = before;
                break;
            }
            let key = word.to_ascii_lowercase();
            let Some(i) = KEYS.iter().position(|k| k.as_bytes() == key) else {
                let figures = format!("`{}`; known: {}", clip(word), KEYS.join(", "));
                return Err(refuse("a line of the grid's header cannot be understood", label, figures, "correct the header"));
            };
            let Some(value) = tokens.next() else { break };
            let value = tokens.number(value)?;
            if values[i].replace(value).is_some() {
                let figures = format!("`{}`", clip(word));
                return Err(refuse("a line of the grid's header is given twice", label, figures, "take one of them out"));
            }
        }
        let of = |key: &str| KEYS.iter().position(|k| *k == key).and_then(|i| values[i]);
        let lacks = |what: &str| {
            let help = "the header needs ncols, nrows, xllcorner or xllcenter, yllcorner or yllcenter, cellsize";
            refuse("the header of the grid is not complete", label, format!("`{what}` is missing"), help)
        };
        let wrong = |what: &str, value: f64, help: &str| {
            refuse("a number in the header of the grid makes no sense", label, format!("{what} {value}"), help)
        };
        let whole = |key: &str| {
            let value = of(key).ok_or_else(|| lacks(key))?;
            let whole = value as u32;
            if whole < 1 || f64::from(whole) != value {
                return Err(wrong(key, value, "give a whole number from 1"));
            }
            Ok(whole as usize)
        };
        let (columns, rows) = (whole("ncols")?, whole("nrows")?);
        let side = |key: &str| {
            let (name, value) = match (of("cellsize"), of(key)) {
                (Some(value), None) => ("cellsize", value),
                (_, Some(value)) => (key, value),
                (None, None) => return Err(lacks("cellsize")),
            };
            if value > 0.0 && value.is_finite() { Ok(value) } else { Err(wrong(name, value, "give the distance of the nodes")) }
        };
        let step = DVec2::new(side("dx")?, side("dy")?);
        // Corners are those of the cells, whose heights stand at their centres.
        let first = |corner: &str, centre: &str, step: f64| {
            let value = match (of(corner), of(centre)) {
                (Some(value), None) => value + 0.5 * step,
                (None, Some(value)) => value,
                (None, None) => return Err(lacks(corner)),
                (Some(value), Some(_)) => return Err(wrong(corner, value, "give the corner or the centre, not both")),
            };
            if value.is_finite() { Ok(value) } else { Err(wrong(corner, value, "give the place of the grid")) }
        };
        let origin = DVec2::new(first("xllcorner", "xllcenter", step.x)?, first("yllcorner", "yllcenter", step.y)?);
        Ok(Self { columns, rows, origin, step, no_data: of("nodata_value").unwrap_or(NO_DATA) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(text: &str) -> Result<RawGrid, String> {
        match read("a.asc", text.as_bytes(), &mut Vec::new()) {
            Ok((RawGround::Grid(grid), _)) => Ok(grid),
            Ok(_) => panic!("no grid"),
            Err(error) => Err(error.to_string()),
        }
    }

    const HEAD: &str = "ncols 3\nnrows 2\nxllcorner 95\nyllcorner 195\ncellsize 10\n";

    #[test]
    fn all_spellings_of_the_same() {
        let expected = RawGrid {
            columns: 3,
            rows: 2,
            origin: DVec2::new(100.0, 200.0),
            step: DVec2::new(10.0, 10.0),
            heights: vec![1.0, 2.0, 3.5, 4.0, 5.0, 6.0],
        };
        for text in [
            format!("{HEAD}1 2 3.5\n4 5 6\n"),
            format!("{HEAD}NODATA_value -1\n1 2 3.5\n4 5 6"),
            format!("{HEAD}1\n2 3.5 4\n5 6\n"),
            format!("{HEAD}1 2 3.5\n4 5 6\n").to_uppercase().replace('\n', "\r\n"),
            format!("{HEAD}1 2 3,5\n4 5 6\n"),
            "ncols 3\nnrows 2\nxllcenter 100\nyllcenter 200\ndx 10\ndy 10\n1 2 3.5 4 5 6".into(),
        ] {
            assert_eq!(grid(&text), Ok(expected.clone()), "{text}");
        }
    }

    #[test]
    fn nodes_without_height() {
        for text in [format!("{HEAD}-9999 nan 3\n4 5 -3.4028235e+38\n"), format!("{HEAD}nodata_value 77\n77 77.0 3\n4 5 7.7e1\n")]
        {
            let none: Vec<bool> = grid(&text).unwrap().heights.iter().map(|z| z.is_nan()).collect();
            assert_eq!(none, [true, true, false, false, false, true], "{text}");
        }
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        for (text, words) in [
            (format!("{HEAD}1 2 3\n"), "shorter than its header"),
            (format!("{HEAD}1.00 2.00 3.00\n"), "6 values; 3 are there"),
            (format!("{HEAD}1 2 3\n4 5 6 7\n"), "longer"),
            (format!("{HEAD}1 2 3\n4 x 6\n"), "line 7"),
            (format!("{HEAD}1,5 2.5 3\n4 5 6\n"), "mixed"),
            (format!("{HEAD}1 2\n3 4\n5 6\n"), "exchanged"),
            (HEAD.replace("ncols 3", "ncols 1000000000"), "bytes of values"),
            (HEAD.replace("ncols 3", "ncols 2.5"), "ncols 2.5"),
            (HEAD.replace("cellsize 10", "cellsize 0"), "cellsize 0"),
            (HEAD.replace("xllcorner 95", ""), "`xllcorner` is missing"),
            (HEAD.replace("xllcorner 95", "xllcorner nan"), "xllcorner NaN"),
            (HEAD.replace("ncols 3", "ncols 3 ncols 3"), "twice"),
            (HEAD.replace("ncols", "columns"), "known: ncols"),
        ] {
            let message = grid(&text).unwrap_err();
            assert!(message.contains(words), "{text}\n{message}");
        }
    }
}
