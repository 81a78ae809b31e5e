//! Names of layers and blocks: bytes → text.

pub(super) use crate::model::digits::counted;
use crate::read::decode::windows_1252;

/// Longest name, in letters: that of CAD programs.
const LONGEST: usize = 255;

/// UTF-8, as drawings of release 2007 (AC1021) and later are, where the bytes are that; else Windows-1252. `\U+00E4` stands for
/// a letter by its number. Without control characters, and no longer than [`LONGEST`].
pub(super) fn decode(bytes: &[u8]) -> String {
    let text = match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().copied().map(windows_1252).collect(),
    };
    let text = if text.contains("\\U+") { unescape(&text) } else { text };
    let clean = |text: &str| !text.chars().any(char::is_control) && text.len() <= LONGEST;
    if clean(&text) { text } else { text.chars().take(LONGEST).map(|c| if c.is_control() { '·' } else { c }).collect() }
}

fn unescape(text: &str) -> String {
    let mut pieces = text.split("\\U+");
    let mut out = pieces.next().unwrap_or("").to_owned();
    for piece in pieces {
        let digits = piece.get(..4).filter(|digits| digits.bytes().all(|b| b.is_ascii_hexdigit()));
        let letter = digits.and_then(|digits| u32::from_str_radix(digits, 16).ok()).and_then(char::from_u32);
        match letter {
            Some(letter) => {
                out.push(letter);
                out.push_str(&piece[4..]);
            }
            None => {
                out.push_str("\\U+");
                out.push_str(piece);
            }
        }
    }
    out
}

/// What two names have in common that are the same: case does not matter in drawings.
pub(super) fn key(name: &str) -> String {
    name.to_lowercase()
}

/// A list short enough for a message.
pub(super) fn listed(mut items: impl Iterator<Item = String>) -> String {
    const MOST: usize = 20;
    let mut text = items.by_ref().take(MOST).collect::<Vec<_>>().join("; ");
    let more = items.count();
    if more > 0 {
        text.push_str(&format!("; and {more} more"));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn letters() {
        assert_eq!(decode("Böschung".as_bytes()), "Böschung");
        assert_eq!(decode(b"B\xF6schung \x80"), "Böschung €");
        assert_eq!(decode(b"B\\U+00F6schung\\U+00DF"), "Böschungß");
        assert_eq!(decode(b"\\U+D800 \\U+12 \\U+"), "\\U+D800 \\U+12 \\U+");
        assert_eq!(decode(b"a\x1B[31m\\U+0007"), "a·[31m·");
        assert_eq!(decode(&vec![0xE4; 1000]).chars().count(), LONGEST);
        assert_eq!(key(&decode("BÖSCHUNG".as_bytes())), key("böschung"));
    }

    #[test]
    fn lists_end() {
        assert_eq!(listed((0..3).map(|i| i.to_string())), "0; 1; 2");
        assert!(listed((0..23).map(|i| i.to_string())).ends_with("19; and 3 more"));
    }
}
