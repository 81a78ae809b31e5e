//! Rows of a text file: data, comments, blank lines.

use crate::read::sniff::Delimiter;

/// Rows of a text with their numbers from 1; ends at CR, LF or CR LF.
pub(super) fn rows(text: &str) -> impl Iterator<Item = (u32, &str)> {
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

/// What spreadsheets write for a missing or broken value, in English and German: a field, not a comment.
const BROKEN: [&str; 12] =
    ["#N/A", "#NA", "#NV", "#REF!", "#NUM!", "#VALUE!", "#DIV/0!", "#NAME?", "#NULL!", "#BEZUG!", "#ZAHL!", "#WERT!"];

/// Whether a row is a comment. A semicolon starts one only where it is not the delimiter.
pub(super) fn is_comment(row: &str, delimiter: Option<Delimiter>) -> bool {
    let row = row.trim_start();
    if row.starts_with('#') {
        let end = |c: char| match delimiter {
            Some(Delimiter::Blanks) => c == ' ' || c == '\t',
            Some(delimiter) => c == char::from(delimiter.byte()),
            None => matches!(c, ',' | ';' | '\t' | ' '),
        };
        let field = row.split(end).next().unwrap_or(row).trim_end();
        return !BROKEN.iter().any(|word| word.eq_ignore_ascii_case(field));
    }
    row.starts_with("//") || row.starts_with('%') || (row.starts_with(';') && delimiter != Some(Delimiter::Semicolon))
}

/// Whether a row has nothing but blanks of any kind (form feeds, no-break spaces, byte order marks of files put together) and
/// delimiters.
pub(super) fn is_blank(row: &str, delimiter: Delimiter) -> bool {
    row.chars().all(|c| c.is_whitespace() || c == '\u{feff}' || c == char::from(delimiter.byte()))
}

/// The rows with data, one per line, with row number and block of each. Runs of blanks become one tab where blanks separate.
pub(super) fn clean(text: &str, delimiter: Delimiter, header: u32) -> (String, Vec<(u32, u32)>) {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_and_broken_values() {
        for comment in [
            "#REFERENCE: mark 12",
            "#Num 1,2,3",
            "#Values in m",
            "#Divided",
            "# N/A",
            "#N/A values follow",
            "#3,1,2,3",
            " %",
            "//1",
        ] {
            assert!(is_comment(comment, Some(Delimiter::Comma)), "{comment}");
        }
        for (row, delimiter) in [
            ("#REF!,1,2", Delimiter::Comma),
            ("#value!;1;2", Delimiter::Semicolon),
            ("  #N/A 1 2", Delimiter::Blanks),
            ("#DIV/0!\t1\t2", Delimiter::Tab),
            ("#NUM! ,1", Delimiter::Comma),
            ("#na", Delimiter::Comma),
        ] {
            assert!(!is_comment(row, Some(delimiter)) && !is_comment(row, None), "{row}");
        }
        assert!(is_comment(";1;2", Some(Delimiter::Comma)) && !is_comment(";1;2", Some(Delimiter::Semicolon)));
    }

    /// Page breaks and no-break spaces stand alone in rows of printed lists and of web pages.
    #[test]
    fn rows_of_any_blanks_are_blank() {
        let text = "1 2 3\n\u{a0}\n4 5 6\n\u{c}\r\n7 8 9\n \u{85}\u{b}";
        let (clean, places) = clean(text, Delimiter::Blanks, 0);
        assert_eq!(clean, "1\t2\t3\n4\t5\t6\n7\t8\t9\n");
        assert_eq!(places, [(1, 0), (3, 1), (5, 2)]);
        assert!(is_blank(", \t,", Delimiter::Comma) && !is_blank(",", Delimiter::Semicolon));
    }

    #[test]
    fn a_row_of_a_byte_order_mark_alone_is_blank() {
        assert!(is_blank("\u{feff}", Delimiter::Comma) && !is_blank("\u{feff}1", Delimiter::Comma));
        assert_eq!(clean("x,y,z\n\u{feff}\n", Delimiter::Comma, 1), (String::new(), Vec::new()));
    }
}
