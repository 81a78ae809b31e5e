//! What separates the fields of a text file.

use super::number::{self, Field};

/// Separator between fields.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Delimiter {
    Tab,
    Semicolon,
    Comma,
    Blanks,
}

impl Delimiter {
    const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Blanks];

    /// Name for messages.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Tab => "tab",
            Self::Semicolon => "semicolon",
            Self::Comma => "comma",
            Self::Blanks => "blanks",
        }
    }

    /// The byte the CSV parser splits at; runs of blanks are turned into one tab before.
    pub(super) fn byte(self) -> u8 {
        match self {
            Self::Tab | Self::Blanks => b'\t',
            Self::Semicolon => b';',
            Self::Comma => b',',
        }
    }

    /// Whether a comma can be a decimal comma.
    pub(super) fn decimal_comma(self) -> bool {
        self != Self::Comma
    }
}

/// How many rows are looked at.
const SAMPLE: usize = 50;

/// The delimiter of a file, from its first rows (blank and comment lines left out).
///
/// The one that yields most numbers wins; of several the one that leaves least else, then tab, semicolon, comma, blanks.
/// Numbers are what the file is read for, so descriptions, headings and decimal commas do not mislead it.
pub(super) fn delimiter<'a>(rows: impl Iterator<Item = &'a str>) -> Delimiter {
    let sample: Vec<&str> = rows.take(SAMPLE).collect();
    let mut best = (0, 0, Delimiter::Comma);
    for candidate in Delimiter::ALL {
        let (mut numbers, mut others) = (0, 0);
        for row in &sample {
            for text in split(row, candidate) {
                match number::field(text, candidate.decimal_comma()) {
                    Field::Number(..) | Field::Grouped => numbers += 1,
                    Field::Missing => {}
                    Field::Text => others += 1,
                }
            }
        }
        if numbers > best.0 || (numbers == best.0 && numbers > 0 && others < best.1) {
            best = (numbers, others, candidate);
        }
    }
    if best.0 == 0 {
        // No numbers at all, e.g. a lone header: the one that splits it into most fields.
        let fields = |d: Delimiter| sample.iter().map(|row| split(row, d).len()).sum::<usize>();
        return Delimiter::ALL.into_iter().rev().max_by_key(|&d| fields(d)).unwrap_or(Delimiter::Comma);
    }
    best.2
}

/// Fields of one row, roughly: quotes are honoured, doubled quotes are not undone.
pub(super) fn split(row: &str, delimiter: Delimiter) -> Vec<&str> {
    let mut quoted = false;
    let mut fields: Vec<&str> = row
        .split(|c: char| {
            quoted ^= c == '"';
            !quoted
                && match delimiter {
                    Delimiter::Tab => c == '\t',
                    Delimiter::Semicolon => c == ';',
                    Delimiter::Comma => c == ',',
                    Delimiter::Blanks => c == ' ' || c == '\t',
                }
        })
        .map(|field| {
            let field = field.trim();
            field.strip_prefix('"').and_then(|f| f.strip_suffix('"')).unwrap_or(field)
        })
        .collect();
    if delimiter == Delimiter::Blanks {
        fields.retain(|field| !field.is_empty());
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn usual_dialects() {
        for (text, expected) in [
            ("x,y,z\n1,2,3", Delimiter::Comma),
            ("x, y, z\n1, 2, 3", Delimiter::Comma),
            ("x;y;z\n1,5;2,5;3,5", Delimiter::Semicolon),
            ("x;y;z\n1.5;2.5;3.5", Delimiter::Semicolon),
            ("1\t2\t3", Delimiter::Tab),
            ("1,5\t2,5\t3,5", Delimiter::Tab),
            ("1 2 3", Delimiter::Blanks),
            ("1,5 2,5 3,5", Delimiter::Blanks),
            ("1,5 2,5", Delimiter::Blanks),
            ("1 \t 2   3", Delimiter::Blanks),
            ("1,5.5,2.5,3.5,\"CL, begin\"", Delimiter::Comma),
            ("\"1,757.1\",\"5,917.2\",\"138.4\"", Delimiter::Comma),
            ("x;y;z", Delimiter::Semicolon),
            ("easting northing z", Delimiter::Blanks),
        ] {
            assert_eq!(delimiter(text.lines()), expected, "{text}");
        }
    }
}
