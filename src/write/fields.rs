//! Fields of CSV files (RFC 4180, but with plain line feeds).

use super::number::push_f64;

/// Appends a figure with the shortest digits that read back to the same bits; nought has no sign.
pub fn push_figure(bytes: &mut Vec<u8>, value: f64) {
    push_f64(bytes, value + 0.0);
}

/// Appends text, in quotes where it must be, or where blanks at its ends would be lost.
pub fn push_field(bytes: &mut Vec<u8>, text: &str) {
    if text.contains(['"', ',', '\n', '\r']) || text.trim().len() < text.len() {
        bytes.push(b'"');
        bytes.extend_from_slice(text.replace('"', "\"\"").as_bytes());
        bytes.push(b'"');
    } else {
        bytes.extend_from_slice(text.as_bytes());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn fields_read_back() {
        for (text, expected) in [
            ("a", "a"),
            ("", ""),
            ("a b", "a b"),
            (" a", "\" a\""),
            ("a\t", "\"a\t\""),
            ("a\"b", "\"a\"\"b\""),
            ("a,b\n", "\"a,b\n\""),
        ] {
            let mut bytes = Vec::new();
            push_field(&mut bytes, text);
            assert_eq!(String::from_utf8(bytes).unwrap(), expected);
        }
        let mut bytes = Vec::new();
        push_figure(&mut bytes, -0.0);
        assert_eq!(bytes, b"0");
    }
}
