//! What the process exits with.

use super::job::UsageErrors;
use crate::pipeline::Error;
use crate::read::ReadError;
use crate::slope::SurfaceError;
use std::process::ExitCode;

/// What the process exits with. The numbers are documented in `docs/cli.md` and do not change.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Code {
    /// Everything asked for was done.
    Done = 0,
    /// The work could not be done: the geometry does not allow it.
    Work = 1,
    /// The command line is wrong.
    Usage = 2,
    /// An input could not be read.
    Input = 3,
    /// An output could not be written.
    Output = 4,
    /// The result did not pass its checks.
    Check = 5,
    /// Ended from outside; 128 and the number of the signal, as shells have it.
    Interrupted = 130,
}

impl Code {
    /// The code for a failure.
    pub(super) fn of(error: &anyhow::Error) -> Self {
        if error.is::<UsageErrors>() {
            return Self::Usage;
        }
        match error.downcast_ref::<Error>() {
            // Seen from the arguments alone, without opening a file.
            Some(Error::Read(ReadError::StdinFormat | ReadError::UnknownFormat { .. })) => Self::Usage,
            Some(Error::Read(_)) => Self::Input,
            Some(Error::Write(error)) if error.is_usage() => Self::Usage,
            Some(Error::Write(_)) => Self::Output,
            Some(Error::Certificate { .. }) => Self::Check,
            Some(Error::Surface(SurfaceError::Cancelled)) => Self::Interrupted,
            Some(Error::Invalid(_) | Error::Design(_) | Error::Surface(_) | Error::Buried(_)) | None => Self::Work,
        }
    }

    /// The code for what the argument parser returns instead of arguments.
    pub(super) fn of_clap(error: &clap::Error) -> Self {
        if error.use_stderr() { Self::Usage } else { Self::Done }
    }
}

impl From<Code> for ExitCode {
    fn from(code: Code) -> Self {
        Self::from(code as u8)
    }
}
