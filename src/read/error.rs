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
         = help: give `--input-format geojson` or `--input-format csv`"
    )]
    UnknownFormat {
        /// The file.
        label: String,
    },
    /// Standard input without a format.
    #[error(
        "standard input has no extension that says its format\n  --> <stdin>\n   = help: give `--input-format geojson` or \
         `--input-format csv`"
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
    /// The same with the help in the words of a file that has an option of its own.
    #[must_use]
    pub fn with_option(self, of_line: &str, own: &str) -> Self {
        match self {
            Self::Content { what, at, figures, help } => Self::Content { what, at, figures, help: help.replace(of_line, own) },
            other => other,
        }
    }
}
