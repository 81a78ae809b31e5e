//! Why an output could not be made.

use super::target::{Target, folder_of};
use std::io::{self, ErrorKind};

/// Why content could not be turned into bytes of a format.
#[derive(Debug, thiserror::Error)]
pub enum EncodeError {
    /// The sink refused the bytes.
    #[error("{0}")]
    Io(#[from] io::Error),
    /// A number that no file may contain. The engine never makes one from valid input.
    #[error("{what} {index} is not a finite number ({value}); this is a bug in the program")]
    NotFinite {
        /// What carries the number, such as `vertex`.
        what: &'static str,
        /// Which one, counted from 1.
        index: usize,
        /// The number.
        value: f64,
    },
    /// A coordinate too large for a format of single precision.
    #[error("vertex {index} lies too far out for the format ({value}, which holds numbers up to 3.4e38)")]
    BeyondSingle {
        /// The vertex, counted from 1.
        index: usize,
        /// Its coordinate, about the local origin.
        value: f64,
    },
    /// More items than the format can count.
    #[error("{count} {what} are more than the format can hold ({most})")]
    TooMany {
        /// What there is too much of.
        what: &'static str,
        /// How many there are.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// A grid whose values do not fill its columns and rows.
    #[error("{values} values do not fill a grid of {columns} columns and {rows} rows; this is a bug in the program")]
    GridSize {
        /// Columns of the grid.
        columns: usize,
        /// Rows of the grid.
        rows: usize,
        /// Values given.
        values: usize,
    },
    /// A report could not be serialised.
    #[error("{0}")]
    Report(#[from] serde_json::Error),
    /// A report figure that is not a finite number. The engine never makes one from valid input.
    #[error("report figure `{0}` is not a finite number; this is a bug in the program")]
    ReportNotFinite(String),
}

impl EncodeError {
    /// Whether the reader at the other end of a pipe has left.
    pub fn is_closed_pipe(&self) -> bool {
        match self {
            Self::Io(error) => error.kind() == io::ErrorKind::BrokenPipe,
            Self::Report(error) => error.io_error_kind() == Some(io::ErrorKind::BrokenPipe),
            _ => false,
        }
    }
}

/// Why an output could not be opened or written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// It could not be created or opened.
    #[error("the output cannot be created\n  --> {target}\n   = {}\n   = help: {}", plain(.cause), open_help(.target, .cause))]
    Open {
        /// The output.
        target: Target,
        /// What the system said.
        cause: io::Error,
    },
    /// It could not be written to the end.
    #[error("the output could not be written\n  --> {target}\n   = {cause}\n   = help: {}", write_help(.target, .cause))]
    Write {
        /// The output.
        target: Target,
        /// What the system said, or what could not be put into the format.
        cause: EncodeError,
    },
    /// Two outputs would overwrite one another.
    #[error("two outputs go to the same place\n  --> {first}\n  --> {second}\n   = help: give each output a name of its own")]
    SameFile {
        /// The output named first.
        first: Target,
        /// The other.
        second: Target,
    },
    /// An output would overwrite an input.
    #[error("the output would overwrite an input\n  --> {0}\n   = help: give the output another name")]
    IsInput(Target),
    /// The name is that of a folder.
    #[error("the output is a folder\n  --> {0}\n   = help: name a file in it")]
    IsFolder(Target),
}

impl WriteError {
    /// Whether the command line alone is at fault, not the system.
    pub fn is_usage(&self) -> bool {
        matches!(self, Self::SameFile { .. } | Self::IsInput(_) | Self::IsFolder(_))
    }
}

/// What the system said, without the random name of a temporary file.
fn plain(cause: &io::Error) -> String {
    let text = cause.to_string();
    text.split(" at path ").next().unwrap_or(&text).to_owned()
}

fn open_help(target: &Target, cause: &io::Error) -> String {
    let folder = match target {
        Target::File(path) => folder_of(path).display().to_string(),
        Target::Stdout => ".".to_owned(),
    };
    match cause.kind() {
        ErrorKind::NotFound | ErrorKind::NotADirectory => format!("make sure that the folder `{folder}` exists"),
        ErrorKind::PermissionDenied => format!("make the file and its folder `{folder}` writable, or name another place"),
        _ => "name another place".to_owned(),
    }
}

fn write_help(target: &Target, cause: &EncodeError) -> &'static str {
    match cause {
        EncodeError::Io(_) if target.is_stream() => "what came out is not complete; make room or name another place",
        EncodeError::Io(_) => "no part of the file was left behind; make room or name another place",
        EncodeError::BeyondSingle { .. } => "write a format of double precision, such as `.ply`",
        EncodeError::TooMany { .. } => "write another format, or raise `--tolerance`",
        _ => "please report it with the input that shows it",
    }
}
