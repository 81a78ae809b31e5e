//! Why an input could not be read.

use crate::model::{Defects, TooLarge};
use thiserror::Error;

/// Why an input could not be read. `Display` gives the whole message with place and cure, without the leading `error: `.
#[derive(Debug, Error)]
pub enum ReadError {
    /// The file could not be opened or read.
    #[error("the input cannot be read\n  --> {label}\n   = {cause}")]
    Open {
        /// The file.
        label: String,
        /// What the system says.
        cause: std::io::Error,
    },
    /// The extension does not name a format.
    #[error(
        "the extension does not say what format this is\n  --> {label}\n   = known: .geojson .json .csv .txt .tsv .xyz .xml .landxml .dxf\n   \
         = help: {help}"
    )]
    UnknownFormat {
        /// The file.
        label: String,
        /// What mends it.
        help: &'static str,
    },
    /// Standard input without a format.
    #[error(
        "standard input has no extension that says its format\n  --> <stdin>\n   = help: give `--input-format geojson`, `csv`, \
         `landxml` or `dxf`"
    )]
    StdinFormat,
    /// The file as a whole is not what it should be.
    #[error("{what}\n  --> {at}\n   = {figures}\n   = help: {help}")]
    Content {
        /// What is wrong.
        what: String,
        /// File, with line and column where known.
        at: String,
        /// What was found.
        figures: String,
        /// What mends it.
        help: String,
    },
    /// Reading it would take more memory than there may be.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// Single records are wrong: all of them.
    #[error("{0}")]
    Records(Defects),
}

impl ReadError {
    /// A line of unknown format.
    pub(crate) fn unknown_format(label: String) -> Self {
        Self::UnknownFormat { label, help: "give `--input-format geojson`, `csv`, `landxml` or `dxf`" }
    }

    /// The same with the help for a command that has none of these options: what speaks of them is left out.
    #[must_use]
    pub fn without_options(self, options: &[&str]) -> Self {
        match self {
            Self::Content { what, at, figures, help } => Self::Content { what, at, figures, help: without(&help, options) },
            Self::UnknownFormat { label, .. } if options.contains(&"--input-format") => {
                Self::UnknownFormat { label, help: "give the file a name that ends in one of these" }
            }
            other => other,
        }
    }

    /// The same with the help in the words of a file that has an option of its own.
    #[must_use]
    pub fn with_option(self, of_line: &str, own: &str) -> Self {
        match self {
            Self::Content { what, at, figures, help } => Self::Content { what, at, figures, help: help.replace(of_line, own) },
            other => other,
        }
    }
}

/// A help without the clauses that speak of one of these options.
fn without(help: &str, options: &[&str]) -> String {
    /// What stands between clauses.
    const BETWEEN: [&str; 3] = ["; ", ", or ", ", such as "];
    let (mut kept, mut joint, mut rest) = (String::new(), "", help);
    while !rest.is_empty() {
        let between = BETWEEN.iter().filter_map(|between| rest.find(between).map(|at| (at, between.len())));
        let (end, gap) = between.min().unwrap_or((rest.len(), 0));
        let clause = &rest[..end];
        if !options.iter().any(|option| clause.contains(&format!("`{option}"))) {
            if !kept.is_empty() {
                kept.push_str(joint);
            }
            kept.push_str(clause);
        }
        joint = &rest[end..end + gap];
        rest = &rest[end + gap..];
    }
    if kept.is_empty() { "give a file of which all is meant".to_owned() } else { kept }
}

/// A file refused as a whole.
pub(super) fn refuse(what: &str, at: impl Into<String>, figures: impl Into<String>, help: &str) -> ReadError {
    ReadError::Content { what: what.into(), at: at.into(), figures: figures.into(), help: help.into() }
}

/// A piece of a file short enough for a message, with what cannot be printed replaced.
pub(super) fn clip(text: impl AsRef<[u8]>) -> String {
    const LONGEST: usize = 60;
    /// Bytes of a letter, at most.
    const WIDEST: usize = 4;
    let bytes = text.as_ref();
    let text = String::from_utf8_lossy(&bytes[..bytes.len().min(WIDEST * (LONGEST + 1))]);
    let shown = |c: char| if c.is_control() && c != '\t' { '·' } else { c };
    let short: String = text.chars().take(LONGEST).map(shown).collect();
    let cut = text.chars().nth(LONGEST).is_some();
    format!("{}{}", short.trim(), if cut { "…" } else { "" })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_a_command_lacks_are_left_out() {
        let layer = "give a drawing with faces on layers that are on, or name a layer with `--terrain-layer`; contours have to be \
                     triangulated first";
        assert_eq!(
            without(layer, &["--terrain-layer", "--class"]),
            "give a drawing with faces on layers that are on; contours have to be triangulated first"
        );
        assert_eq!(without(layer, &["--layer"]), layer);
        let class = "give the classes that are ground with `--class`, such as `--class 2,8`";
        assert_eq!(without(class, &["--class"]), "give a file of which all is meant");
        assert_eq!(without("do `--class 1`; or that", &["--class"]), "or that");
    }

    #[test]
    fn pieces_of_files_in_messages() {
        let long = "ä".repeat(61);
        assert_eq!(clip(&long), "ä".repeat(60) + "…");
        assert_eq!((clip(&long[..120]), clip(" a\tb\u{1}c\n")), ("ä".repeat(60), "a\tb·c·".to_owned()));
        assert_eq!(clip(b"\xFF\0x"), "\u{fffd}·x");
        assert_eq!(clip("𝄞".repeat(1000)), "𝄞".repeat(60) + "…");
    }
}
