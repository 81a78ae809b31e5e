//! Messages as people see them, on several lines: what is wrong, places (`-->`), figures (`=`), help.

use std::fmt::Display;

/// A message with places below its first line.
pub fn placed<P: Display>(message: &str, places: impl IntoIterator<Item = P>) -> String {
    let (what, rest) = message.split_at(message.find('\n').unwrap_or(message.len()));
    let places: String = places.into_iter().map(|place| format!("\n  --> {place}")).collect();
    format!("{what}{places}{rest}")
}

/// Text that may hold names from files, on one line and without characters that would move the cursor or colour a terminal.
pub fn printable(text: &str) -> String {
    text.replace(char::is_control, " ")
}

/// The same for text of several lines.
pub fn printable_lines(text: &str) -> String {
    text.replace(|c: char| c.is_control() && c != '\n', " ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_stand_below_the_first_line() {
        assert_eq!(placed("what\n   = help: cure", ["a.csv", "b.csv"]), "what\n  --> a.csv\n  --> b.csv\n   = help: cure");
        assert_eq!(placed("what", ["a.csv"]), "what\n  --> a.csv");
        assert_eq!(placed("what\n   = figures", [""; 0]), "what\n   = figures");
    }

    #[test]
    fn names_cannot_harm_a_terminal() {
        assert_eq!(printable("a\u{1b}[31m\r\nb\u{9b}"), "a [31m  b ");
        assert_eq!(printable_lines("a\u{1b}[31m\r\nb\u{9b}"), "a [31m \nb ");
    }
}
