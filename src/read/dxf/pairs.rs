//! Pairs of group code and value, from text and from binary files.

use crate::read::ReadError;
use crate::read::decimal;
use crate::read::error::{clip, refuse};
use std::borrow::Cow;

/// First bytes of a binary drawing.
pub(in crate::read) const SENTINEL: &[u8] = b"AutoCAD Binary DXF\r\n\x1a\0";

/// Where a pair stands, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Place {
    /// Line of the group code in a text file.
    Line(u64),
    /// Byte in a binary file.
    Byte(u64),
}

impl Place {
    /// The line, as the row of a vertex; `None` in binary files.
    pub(super) fn row(self) -> Option<u32> {
        match self {
            Self::Line(line) => u32::try_from(line).ok(),
            Self::Byte(_) => None,
        }
    }

    /// In messages: `road.dxf, line 17`.
    pub(super) fn of(self, label: &str) -> String {
        match self {
            Self::Line(line) => format!("{label}, line {line}"),
            Self::Byte(byte) => format!("{label}, byte {byte}"),
        }
    }
}

/// A value. Text files hold text only; what it stands for is asked later, so that no other value of a drawing needs to be sound.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Value<'a> {
    Text(&'a [u8]),
    Real(f64),
    Whole(i64),
    /// Pieces of pictures and the like.
    Chunk,
}

/// A group code and its value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Pair<'a> {
    pub(super) code: i32,
    value: Value<'a>,
    pub(super) place: Place,
}

impl<'a> Pair<'a> {
    /// The value as text; empty if it is none.
    pub(super) fn text(&self) -> &'a [u8] {
        match self.value {
            Value::Text(text) => text,
            _ => b"",
        }
    }

    /// The value as it stands, for messages.
    fn show(&self) -> Cow<'static, str> {
        match self.value {
            Value::Text(text) => clip(text).into(),
            Value::Real(value) => value.to_string().into(),
            Value::Whole(value) => value.to_string().into(),
            Value::Chunk => "bytes".into(),
        }
    }
}

/// How a file is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Form {
    /// A line for the code and one for the value; the byte that ends them.
    Text(u8),
    /// Codes of two bytes, or one as before release 13, then the value in a form the code stands for.
    Binary { wide: bool },
}

/// Reads pair by pair; a copy reads on from the same place.
#[derive(Clone, Copy, Debug)]
pub(super) struct Pairs<'a> {
    pub(super) label: &'a str,
    bytes: &'a [u8],
    form: Form,
    at: usize,
    /// Lines read.
    line: u64,
}

impl<'a> Pairs<'a> {
    pub(super) fn new(label: &'a str, bytes: &'a [u8]) -> Self {
        if bytes.starts_with(SENTINEL) {
            // The first pair is code 0 and `SECTION`.
            let wide = bytes.get(SENTINEL.len() + 1) == Some(&0);
            return Self { label, bytes, form: Form::Binary { wide }, at: SENTINEL.len(), line: 0 };
        }
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        let end = if memchr::memchr(b'\n', bytes).is_some() { b'\n' } else { b'\r' };
        Self { label, bytes, form: Form::Text(end), at: 0, line: 0 }
    }

    /// Where the next pair begins.
    fn place(&self) -> Place {
        match self.form {
            Form::Text(_) => Place::Line(self.line + 1),
            Form::Binary { .. } => Place::Byte(self.at as u64 + 1),
        }
    }

    /// The next pair; `None` at the end of the file.
    #[inline]
    pub(super) fn next(&mut self) -> Result<Option<Pair<'a>>, ReadError> {
        match self.form {
            Form::Text(end) => self.next_text(end),
            Form::Binary { wide } => self.next_binary(wide),
        }
    }

    /// The next pair of the entity at hand; `None`, and nothing read, where the next one begins or the file ends.
    #[inline]
    pub(super) fn field(&mut self) -> Result<Option<Pair<'a>>, ReadError> {
        let before = *self;
        let pair = self.next()?;
        if pair.is_some_and(|pair| pair.code == 0) {
            *self = before;
            return Ok(None);
        }
        Ok(pair)
    }

    /// The next pair of the file, which must be there.
    #[inline]
    pub(super) fn required(&mut self) -> Result<Pair<'a>, ReadError> {
        let place = self.place();
        match self.next()? {
            Some(pair) => Ok(pair),
            None => Err(self.cut_off(place)),
        }
    }

    fn cut_off(&self, place: Place) -> ReadError {
        let figures = "it ends without the mark `EOF` of a whole drawing";
        refuse("the drawing is cut off", place.of(self.label), figures, "write or copy the file again")
    }

    #[inline]
    fn next_text(&mut self, end: u8) -> Result<Option<Pair<'a>>, ReadError> {
        let place = self.place();
        let Some(code) = self.take_line(end) else { return Ok(None) };
        let Some(number) = code_of(code) else {
            if self.at == self.bytes.len() && code.is_empty() {
                return Ok(None);
            }
            let figures = format!("`{}` where a group code, a whole number, should stand", clip(code));
            let help = "the lines are out of step before this place: write or copy the file again";
            return Err(refuse("the drawing is damaged", place.of(self.label), figures, help));
        };
        match self.take_line(end) {
            Some(value) => Ok(Some(Pair { code: number, value: Value::Text(value), place })),
            None => Err(self.cut_off(self.place())),
        }
    }

    /// A line without the blanks around it.
    #[inline]
    fn take_line(&mut self, end: u8) -> Option<&'a [u8]> {
        let rest = self.bytes.get(self.at..).filter(|rest| !rest.is_empty())?;
        let length = memchr::memchr(end, rest).unwrap_or(rest.len());
        self.at += (length + 1).min(rest.len());
        self.line += 1;
        Some(rest[..length].trim_ascii())
    }

    fn next_binary(&mut self, wide: bool) -> Result<Option<Pair<'a>>, ReadError> {
        if self.at >= self.bytes.len() {
            return Ok(None);
        }
        let place = self.place();
        let read = self.code(wide).and_then(|code| {
            let value = self.value(code)?;
            Some(Pair { code, value, place })
        });
        match read {
            Some(pair) => Ok(Some(pair)),
            None => Err(self.cut_off(place)),
        }
    }

    fn bytes<const N: usize>(&mut self) -> Option<[u8; N]> {
        let (bytes, _) = self.bytes.get(self.at..)?.split_first_chunk::<N>()?;
        self.at += N;
        Some(*bytes)
    }

    fn code(&mut self, wide: bool) -> Option<i32> {
        if wide {
            return self.bytes().map(i16::from_le_bytes).map(i32::from);
        }
        match self.bytes::<1>()? {
            // Codes of extended data do not fit one byte.
            [255] => self.bytes().map(i16::from_le_bytes).map(i32::from),
            [code] => Some(i32::from(code)),
        }
    }

    /// Forms by code: Autodesk, "DXF Reference", group code value types.
    fn value(&mut self, code: i32) -> Option<Value<'a>> {
        Some(match code {
            10..=59 | 110..=149 | 210..=239 | 460..=469 | 1010..=1059 => Value::Real(f64::from_le_bytes(self.bytes()?)),
            60..=79 | 170..=179 | 270..=289 | 370..=389 | 400..=409 | 1060..=1070 => {
                Value::Whole(i16::from_le_bytes(self.bytes()?).into())
            }
            90..=99 | 420..=429 | 440..=459 | 1071 => Value::Whole(i32::from_le_bytes(self.bytes()?).into()),
            160..=169 => Value::Whole(i64::from_le_bytes(self.bytes()?)),
            290..=299 => Value::Whole(i64::from(self.bytes::<1>()?[0])),
            310..=319 | 1004 => {
                let [length] = self.bytes()?;
                let end = self.at.checked_add(length.into()).filter(|&end| end <= self.bytes.len())?;
                self.at = end;
                Value::Chunk
            }
            _ => {
                let rest = self.bytes.get(self.at..)?;
                let length = memchr::memchr(0, rest)?;
                self.at += length + 1;
                Value::Text(rest[..length].trim_ascii())
            }
        })
    }

    /// The value as a finite number.
    #[inline]
    pub(super) fn number(&self, pair: &Pair<'a>) -> Result<f64, ReadError> {
        let number = match pair.value {
            Value::Text(text) => decimal::number(text),
            Value::Real(value) => Some(value),
            Value::Whole(value) => Some(value as f64),
            Value::Chunk => None,
        };
        match number {
            Some(number) if number.is_finite() => Ok(number),
            _ => Err(self.wrong(pair, "a finite number", "correct the value; decimals stand behind a point")),
        }
    }

    /// The value as a whole number.
    pub(super) fn whole(&self, pair: &Pair<'a>) -> Result<i64, ReadError> {
        let number = match pair.value {
            Value::Text(text) => std::str::from_utf8(text).ok().and_then(|text| text.parse().ok()),
            Value::Whole(value) => Some(value),
            Value::Real(_) | Value::Chunk => None,
        };
        number.ok_or_else(|| self.wrong(pair, "a whole number", "correct the value"))
    }

    fn wrong(&self, pair: &Pair<'a>, wanted: &str, help: &str) -> ReadError {
        let figures = format!("group code {}: `{}`", pair.code, pair.show());
        // In text the value stands on the line after its code.
        let place = match pair.place {
            Place::Line(line) => Place::Line(line + 1),
            byte @ Place::Byte(_) => byte,
        };
        refuse(&format!("a value of the drawing is not {wanted}"), place.of(self.label), figures, help)
    }
}

/// Group codes have up to four digits, a few a sign.
#[inline]
fn code_of(text: &[u8]) -> Option<i32> {
    let (negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, text),
    };
    if digits.is_empty() || digits.len() > 5 {
        return None;
    }
    let mut code = 0;
    for &byte in digits {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return None;
        }
        code = code * 10 + i32::from(digit);
    }
    Some(if negative { -code } else { code })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(bytes: &[u8]) -> Result<Vec<(i32, String, Place)>, String> {
        let mut pairs = Pairs::new("a.dxf", bytes);
        let mut list = Vec::new();
        while let Some(pair) = pairs.next().map_err(|e| e.to_string())? {
            list.push((pair.code, pair.show().into_owned(), pair.place));
        }
        Ok(list)
    }

    #[test]
    fn text_with_any_line_ends() {
        let wanted =
            vec![(0, "LINE".into(), Place::Line(1)), (10, "1.5".into(), Place::Line(3)), (-1, "".into(), Place::Line(5))];
        for text in ["  0\nLINE\n 10\n 1.5 \n-1\n\n", "0\r\nLINE\r\n10\r\n1.5\r\n -1\r\n\r\n", "0\rLINE\r10\r1.5\r-1\r\r"] {
            assert_eq!(all(text.as_bytes()), Ok(wanted.clone()), "{text:?}");
        }
        assert!(all(b"0\nLINE\n10").unwrap_err().contains("a.dxf, line 4"));
        assert!(all(b"0\nLINE\nten\n1\n").unwrap_err().contains("line 3\n   = `ten`"));
        assert!(all(b"0\nLINE\n\n\n1\n").unwrap_err().contains("line 3"));
        assert!(all(b"123456\nLINE\n").is_err());
        assert!(all(b"").unwrap().is_empty());
    }

    #[test]
    fn binary_values_by_code() {
        let mut bytes = SENTINEL.to_vec();
        bytes.extend(b"\x00\x00LINE\0");
        bytes.extend(10_i16.to_le_bytes());
        bytes.extend(1.5_f64.to_le_bytes());
        bytes.extend(62_i16.to_le_bytes());
        bytes.extend((-7_i16).to_le_bytes());
        bytes.extend(90_i16.to_le_bytes());
        bytes.extend(70_000_i32.to_le_bytes());
        bytes.extend(b"\x36\x01\x02ab\x23\x01\x01");
        let values: Vec<_> = all(&bytes).unwrap().into_iter().map(|(code, value, _)| (code, value)).collect();
        let wanted = [(0, "LINE"), (10, "1.5"), (62, "-7"), (90, "70000"), (310, "bytes"), (291, "1")];
        assert_eq!(values, wanted.map(|(code, value)| (code, value.to_owned())));
        for length in SENTINEL.len() + 1..bytes.len() {
            // Whole pairs, or an error.
            match all(&bytes[..length]) {
                Ok(list) => assert!(list.len() < wanted.len()),
                Err(error) => assert!(error.contains("cut off"), "{error}"),
            }
        }
        // Before release 13: one byte, 255 before codes of two.
        let mut old = SENTINEL.to_vec();
        old.extend(b"\0SECTION\0\x02ENTITIES\0\xFF\xE8\x03data\0");
        let values: Vec<_> = all(&old).unwrap().into_iter().map(|(code, value, _)| (code, value)).collect();
        assert_eq!(values, [(0, "SECTION"), (2, "ENTITIES"), (1000, "data")].map(|(code, value)| (code, value.to_owned())));
    }

    #[test]
    fn values_are_checked_when_asked_for() {
        let pairs = Pairs::new("a.dxf", b"10\n1,5\n10\nnan\n70\n1.0\n70\n12\n");
        let mut reading = pairs;
        let mut next = || reading.next().unwrap().unwrap();
        let message = |e: ReadError| e.to_string();
        assert!(message(pairs.number(&next()).unwrap_err()).contains("a.dxf, line 2\n   = group code 10: `1,5`"));
        assert!(message(pairs.number(&next()).unwrap_err()).contains("line 4"));
        assert!(message(pairs.whole(&next()).unwrap_err()).contains("`1.0`"));
        assert_eq!(pairs.whole(&next()).unwrap(), 12);
    }
}
