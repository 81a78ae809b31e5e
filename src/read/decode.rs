//! Bytes → text.

use super::ReadError;
use crate::model::Note;
use std::borrow::Cow;

/// Letters of Windows-1252 at 0x80 to 0x9F, where ISO-8859-1 has control characters (mapping of the Unicode Consortium,
/// VENDORS/MICSFT/WINDOWS/CP1252.TXT). Bytes without a letter stay what they are.
const WINDOWS_1252: [char; 32] = [
    '€', '\u{81}', '‚', 'ƒ', '„', '…', '†', '‡', 'ˆ', '‰', 'Š', '‹', 'Œ', '\u{8d}', 'Ž', '\u{8f}', '\u{90}', '‘', '’', '“', '”',
    '•', '–', '—', '˜', '™', 'š', '›', 'œ', '\u{9d}', 'ž', 'Ÿ',
];

/// The letter of a byte in Windows-1252, which is ISO-8859-1 with more letters.
pub(super) fn windows_1252(byte: u8) -> char {
    match byte {
        0x80..=0x9F => WINDOWS_1252[usize::from(byte - 0x80)],
        _ => char::from(byte),
    }
}

/// The text of a file: UTF-8 (with or without byte order mark), UTF-16 with byte order mark, else ISO-8859-1.
///
/// ISO-8859-1 is only a guess, but one that cannot spoil figures: they are ASCII. So it is taken with a note.
///
/// # Errors
/// When the bytes cannot be text: zero bytes, broken UTF-16.
pub(super) fn text<'a>(label: &str, bytes: &'a [u8], notes: &mut Vec<Note>) -> Result<Cow<'a, str>, ReadError> {
    let text = match bytes {
        [0xEF, 0xBB, 0xBF, rest @ ..] => utf8_or_latin1(rest, notes),
        [0xFF, 0xFE, rest @ ..] => utf16(label, rest, u16::from_le_bytes)?,
        [0xFE, 0xFF, rest @ ..] => utf16(label, rest, u16::from_be_bytes)?,
        _ => utf8_or_latin1(bytes, notes),
    };
    if memchr::memchr(0, text.as_bytes()).is_some() {
        // Where it stands in the file: marks and letters may take other bytes there.
        let at = match bytes {
            [0xFF, 0xFE, ..] | [0xFE, 0xFF, ..] => 2 * bytes.chunks(2).position(|pair| pair == [0, 0]).unwrap_or(0),
            _ => memchr::memchr(0, bytes).unwrap_or(0),
        };
        return Err(ReadError::Content {
            what: "the file is not text".into(),
            at: label.to_owned(),
            figures: format!("byte {} is zero", at + 1),
            help: "give a text file in UTF-8, or in UTF-16 with a byte order mark".into(),
        });
    }
    Ok(text)
}

fn utf8_or_latin1<'a>(bytes: &'a [u8], notes: &mut Vec<Note>) -> Cow<'a, str> {
    match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => {
            notes.push(Note::new("encoding", "the file is not UTF-8: its letters are read as ISO-8859-1"));
            Cow::Owned(bytes.iter().map(|&byte| char::from(byte)).collect())
        }
    }
}

fn utf16<'a>(label: &str, bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<Cow<'a, str>, ReadError> {
    let broken = |figures: &str| ReadError::Content {
        what: "the file is not valid UTF-16, which its byte order mark promises".into(),
        at: label.to_owned(),
        figures: figures.to_owned(),
        help: "save the file as UTF-8".into(),
    };
    let (pairs, rest) = bytes.as_chunks::<2>();
    if !rest.is_empty() {
        return Err(broken("odd number of bytes"));
    }
    let units = pairs.iter().map(|&pair| unit(pair));
    let text: Result<String, _> = char::decode_utf16(units).collect();
    text.map(Cow::Owned).map_err(|_| broken("unpaired surrogate"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn encodings() {
        let read = |bytes: &[u8]| {
            let mut notes = Vec::new();
            let text = text("a", bytes, &mut notes).map(Cow::into_owned).map_err(|e| e.to_string());
            (text, notes.len())
        };
        assert_eq!(read("Höhe".as_bytes()), (Ok("Höhe".into()), 0));
        assert_eq!(read(b"\xEF\xBB\xBFx"), (Ok("x".into()), 0));
        assert_eq!(read(b"H\xF6he"), (Ok("Höhe".into()), 1));
        assert_eq!(read(b"\xFF\xFEx\0\xF6\0"), (Ok("xö".into()), 0));
        assert_eq!(read(b"\xFE\xFF\0x\0\xF6"), (Ok("xö".into()), 0));
        assert!(read(b"\xFF\xFEx").0.unwrap_err().contains("odd number of bytes"));
        assert!(read(b"\xFF\xFE\0\xD8").0.unwrap_err().contains("unpaired surrogate"));
        let zero = |bytes: &[u8]| read(bytes).0.unwrap_err();
        assert!(zero(b"x\0y\0").contains("byte 2 is zero") && zero(b"\xEF\xBB\xBFx\0").contains("byte 5 is zero"));
        assert!(zero(b"\xF6\xF6\0").contains("byte 3 is zero"));
        assert!(zero(b"\xFF\xFEx\0\0\0").contains("byte 5 is zero") && zero(b"\xFE\xFF\x01\0\0\0").contains("byte 5 is zero"));
    }
}
