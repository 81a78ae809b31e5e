//! What the process exits with.

use super::running::NoThreads;
use super::selftest::SelftestFailed;
use super::usage::UsageErrors;
use crate::ground::GroundError;
use crate::pipeline::{Beyond, Error, NotPassed, NotVerified};
use crate::read::ReadError;
use crate::surface::SurfaceError;
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
    /// There is not enough memory.
    Memory = 6,
    /// Ended from outside; 128 and the number of the signal, as shells have it.
    Interrupted = 130,
}

impl Code {
    /// The code for a failure.
    pub(super) fn of(error: &anyhow::Error) -> Self {
        if error.is::<UsageErrors>() {
            return Self::Usage;
        }
        if error.is::<NotPassed>() || error.is::<Beyond>() || error.is::<SelftestFailed>() || error.is::<NotVerified>() {
            return Self::Check;
        }
        if error.is::<NoThreads>() {
            return Self::Memory;
        }
        match error.downcast_ref::<Error>() {
            // Seen from the arguments alone, without opening a file.
            Some(Error::Read(ReadError::StdinFormat | ReadError::UnknownFormat { .. })) => Self::Usage,
            Some(Error::TooLarge(_) | Error::Read(ReadError::TooLarge(_))) => Self::Memory,
            Some(Error::Read(_)) => Self::Input,
            Some(Error::Write(error)) if error.is_usage() => Self::Usage,
            Some(Error::Write(_)) => Self::Output,
            Some(Error::Surface { cause, .. }) => Self::of_surface(cause),
            Some(Error::Ground { cause, .. }) => match cause.as_ref() {
                GroundError::Surface(cause) => Self::of_surface(cause),
                GroundError::Unsound { .. } | GroundError::Cut { .. } => Self::Check,
                _ => Self::Work,
            },
            Some(
                Error::Invalid(_)
                | Error::Formation(_)
                | Error::Design(_)
                | Error::Overlay(_)
                | Error::Stations(_)
                | Error::NoStation(_)
                | Error::Diff(_)
                | Error::Buried(_),
            )
            | None => Self::Work,
        }
    }

    fn of_surface(cause: &SurfaceError) -> Self {
        match cause {
            SurfaceError::Cancelled => Self::Interrupted,
            SurfaceError::TooLarge(_) => Self::Memory,
            SurfaceError::Unclosed { .. } | SurfaceError::Crowded | SurfaceError::Unsound { .. } | SurfaceError::Flat { .. } => {
                Self::Check
            }
            _ => Self::Work,
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Defects;
    use crate::pipeline::{BuriedError, DesignError};
    use crate::write::{EncodeError, Target, WriteError};

    fn code(error: impl Into<Error>) -> Code {
        Code::of(&anyhow::Error::new(error.into()))
    }

    #[test]
    fn failures_have_their_codes() {
        assert_eq!(code(ReadError::StdinFormat), Code::Usage);
        assert_eq!(code(ReadError::UnknownFormat { label: "a".into(), help: "b" }), Code::Usage);
        assert_eq!(code(ReadError::Open { label: "a".into(), cause: std::io::ErrorKind::NotFound.into() }), Code::Input);
        assert_eq!(code(ReadError::Records(Defects::default())), Code::Input);
        assert_eq!(code(Defects::default()), Code::Work);
        assert_eq!(code(DesignError::TooFar { label: "a".into(), reach: 1.0, height: 1.0 }), Code::Work);
        assert_eq!(code(BuriedError { label: "a".into(), stretches: Vec::new() }), Code::Work);
        let surface = |cause| code(Error::Surface { label: "a".into(), cause });
        assert_eq!(surface(SurfaceError::Cancelled), Code::Interrupted);
        assert_eq!(surface(SurfaceError::NoSide), Code::Work);
        assert_eq!(surface(SurfaceError::Unsound { what: "a".into() }), Code::Check);
        assert_eq!(code(WriteError::IsFolder(Target::Stdout)), Code::Usage);
        let cause = EncodeError::ReportNotFinite("a".into());
        assert_eq!(code(WriteError::Write { target: Target::Stdout, cause }), Code::Output);
        assert_eq!(Code::of(&NoThreads.into()), Code::Memory);
        assert_eq!(Code::of(&anyhow::anyhow!("something else")), Code::Work);
    }

    #[test]
    fn the_numbers_do_not_change() {
        let codes =
            [Code::Done, Code::Work, Code::Usage, Code::Input, Code::Output, Code::Check, Code::Memory, Code::Interrupted];
        assert_eq!(codes.map(|code| code as u8), [0, 1, 2, 3, 4, 5, 6, 130]);
    }
}
