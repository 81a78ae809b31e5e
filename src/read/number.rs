//! One field → one number.

/// What a field of a text file holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Field {
    /// A number with the decimal mark it was written with. May be infinite, never NaN.
    Number(f64, Mark),
    /// Nothing, or a word for nothing.
    Missing,
    /// A number with thousands separators.
    Grouped,
    /// Something else.
    Text,
}

/// Decimal mark of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// None: a whole number.
    None,
    /// Point.
    Point,
    /// Comma.
    Comma,
}

/// Words that stand for "no value", in lower case.
const MISSING: [&str; 14] = ["nan", "-nan", "null", "none", "nil", "na", "n/a", "#n/a", "#na", "#value!", "-", "--", "---", "?"];

/// Longest text a number may have; longer ones are not looked at as decimal commas or missing words.
const LONGEST: usize = 64;

/// Reads a field. A decimal comma is only looked for when `comma` allows it (it is no delimiter then).
pub(super) fn field(text: &str, comma: bool) -> Field {
    let text = text.trim();
    if let Ok(value) = text.parse::<f64>() {
        if value.is_nan() {
            return Field::Missing;
        }
        let mark = if text.as_bytes().contains(&b'.') { Mark::Point } else { Mark::None };
        return Field::Number(value, mark);
    }
    if text.is_empty() {
        return Field::Missing;
    }
    if text.len() > LONGEST {
        return Field::Text;
    }
    if MISSING.contains(&text.to_lowercase().as_str()) {
        return Field::Missing;
    }
    let commas = text.bytes().filter(|&b| b == b',').count();
    if comma
        && commas == 1
        && !text.contains('.')
        && let Ok(value) = text.replacen(',', ".", 1).parse::<f64>()
    {
        return Field::Number(value, Mark::Comma);
    }
    if grouped(text) { Field::Grouped } else { Field::Text }
}

/// Whether a text is a number with thousands separators: groups of three digits after the first, all of one separator, and
/// at most one other mark for the decimals.
fn grouped(text: &str) -> bool {
    let text = text.strip_prefix(['+', '-']).unwrap_or(text);
    let is_separator = |c: char| matches!(c, ',' | '.' | '\'' | '’' | ' ' | '\u{a0}' | '\u{202f}' | '\u{2009}');
    let Some(separator) = text.chars().find(|&c| is_separator(c)) else { return false };
    let whole = match text.rfind(|c| c != separator && matches!(c, ',' | '.')) {
        Some(at) => &text[..at],
        None => text,
    };
    let fraction = text[whole.len()..].get(1..).unwrap_or("");
    let digits = |s: &str| s.bytes().all(|b| b.is_ascii_digit());
    let mut groups = whole.split(separator);
    let first = groups.next().unwrap_or("");
    let mut rest = 0;
    for group in groups {
        if group.len() != 3 || !digits(group) {
            return false;
        }
        rest += 1;
    }
    (1..=3).contains(&first.len()) && digits(first) && rest > 0 && digits(fraction)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_their_marks() {
        assert_eq!(field(" 12.5 ", false), Field::Number(12.5, Mark::Point));
        assert_eq!(field("1.7573928000e+06", true), Field::Number(1_757_392.8, Mark::Point));
        assert_eq!(field("-7", true), Field::Number(-7.0, Mark::None));
        assert_eq!(field("138,440", true), Field::Number(138.44, Mark::Comma));
        assert_eq!(field("138,440", false), Field::Grouped);
        assert_eq!(field("inf", false), Field::Number(f64::INFINITY, Mark::None));
    }

    #[test]
    fn words_for_nothing() {
        for text in ["", "  ", "nan", "NaN", "-NaN", "null", "NULL", "#N/A", "n/a", "--", "-", "None"] {
            assert_eq!(field(text, true), Field::Missing, "{text}");
        }
    }

    #[test]
    fn thousands_separators_are_seen() {
        for text in ["1,757,392.800", "1.757.392,8", "1'757'392.8", "1 757 392", "-1,757", "5’917’442,40"] {
            assert_eq!(field(text, false), Field::Grouped, "{text}");
        }
        for text in ["12.3m", "1,2,3", "abc", "1,75,392", ",", ".", "1..2", "0x10", "é,123"] {
            assert_eq!(field(text, true), Field::Text, "{text}");
        }
    }
}
