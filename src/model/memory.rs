//! How much memory a run may take, and what is said where it would take more.

use std::fmt;

/// Bytes of a megabyte.
const MB: f64 = 1e6;

/// What the program takes before it has read anything, with its threads (measured: 7 MB), and a reserve.
pub const BASE: u64 = 10_000_000;

/// Where a limit comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LimitedBy {
    /// The command line.
    Option,
    /// What the machine has free, swap space included.
    Machine,
    /// The control group of the process, as containers and batch systems set it.
    Group,
    /// The shell or whoever started the program.
    Shell,
}

impl fmt::Display for LimitedBy {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Option => "by `--max-memory`",
            Self::Machine => "by what this machine has free",
            Self::Group => "by the control group (container) of the process",
            Self::Shell => "by the shell (`ulimit`)",
        })
    }
}

/// How much memory a run may take.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Memory {
    /// Bytes and why; `None`: as much as there is.
    limit: Option<(u64, LimitedBy)>,
    /// What is held already and stays.
    held: u64,
}

impl Memory {
    /// A limit for the whole process.
    pub fn limited(bytes: u64, by: LimitedBy) -> Self {
        Self { limit: Some((bytes, by)), held: 0 }
    }

    /// The limit in bytes, and where it comes from.
    pub fn limit(&self) -> Option<(u64, LimitedBy)> {
        self.limit
    }

    /// The share of each of `jobs` that run at once in this process: of what there is beside [`BASE`], which the process takes
    /// once, and [`BASE`].
    #[must_use]
    pub fn shared(self, jobs: usize) -> Self {
        let share = |bytes: u64| bytes.min(BASE) + bytes.saturating_sub(BASE) / jobs.max(1) as u64;
        Self { limit: self.limit.map(|(bytes, by)| (share(bytes), by)), ..self }
    }

    /// The same with `bytes` that are held already, beside [`BASE`].
    #[must_use]
    pub fn holding(self, bytes: u64) -> Self {
        Self { held: bytes, ..self }
    }

    /// Whether `more` bytes are allowed beside [`BASE`] and what is held, as far as can be told before they are taken.
    ///
    /// # Errors
    /// [`TooLarge`] with what `of` says of it.
    pub fn room(&self, more: u64, of: impl FnOnce() -> Need) -> Result<(), TooLarge> {
        let need = BASE.saturating_add(self.held).saturating_add(more);
        match self.limit {
            Some((allowed, by)) if need > allowed => Err(TooLarge { need: Box::new(of()), bytes: need, allowed, by }),
            _ => Ok(()),
        }
    }
}

/// What memory is needed for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Need {
    /// What cannot be done, such as `read the ground`.
    pub what: &'static str,
    /// Where: a file or an output; may be empty.
    pub at: String,
    /// What makes it large, such as `8000000 points`.
    pub figures: String,
    /// What would need less.
    pub help: &'static str,
}

/// Work that would take more memory than it may.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct TooLarge {
    /// What needs it.
    pub need: Box<Need>,
    /// About how many bytes the process would take.
    pub bytes: u64,
    /// How many it may.
    pub allowed: u64,
    /// Who says so.
    pub by: LimitedBy,
}

impl fmt::Display for TooLarge {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Need { what, at, figures, help } = &*self.need;
        write!(f, "there is not enough memory to {what}")?;
        if !at.is_empty() {
            write!(f, "\n  --> {at}")?;
        }
        let [need, allowed] = [self.bytes, self.allowed].map(megabytes);
        write!(f, "\n   = {figures} would take about {need}; {allowed} are allowed, {}", self.by)?;
        match self.by {
            LimitedBy::Option => write!(f, "\n   = help: {help}, or raise `--max-memory`"),
            _ => write!(f, "\n   = help: {help}; `--max-memory {}MB` would try it all the same", (self.bytes as f64 / MB).ceil()),
        }
    }
}

impl std::error::Error for TooLarge {}

/// With a decimal below 100 MB: figures that differ look different.
fn megabytes(bytes: u64) -> String {
    const LARGE: f64 = 99.95;
    let megabytes = bytes as f64 / MB;
    if megabytes < LARGE { format!("{megabytes:.1} MB") } else { format!("{megabytes:.0} MB") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn need() -> Need {
        Need { what: "read the ground", at: "a.ply".into(), figures: "a file of 5 MB".into(), help: "take a smaller part" }
    }

    #[test]
    fn limits() {
        assert_eq!(Memory::default().room(u64::MAX, need), Ok(()));
        let memory = Memory::limited(12_400_000, LimitedBy::Option);
        assert_eq!(memory.room(12_400_000 - BASE, need), Ok(()));
        assert_eq!(
            memory.holding(1_600_000).room(2_000_000, need).unwrap_err().to_string(),
            "there is not enough memory to read the ground\n  --> a.ply\n   \
             = a file of 5 MB would take about 13.6 MB; 12.4 MB are allowed, by `--max-memory`\n   \
             = help: take a smaller part, or raise `--max-memory`"
        );
        // The program itself is there once: what is shared is the 2.4 MB beside it.
        assert!(memory.shared(2).room(1_200_000, need).is_ok() && memory.shared(2).room(1_200_001, need).is_err());
        assert!(memory.shared(0).room(2_400_000, need).is_ok() && memory.shared(usize::MAX).room(0, need).is_ok());
        assert!(Memory::limited(4, LimitedBy::Option).shared(2).room(0, need).is_err());
        assert_eq!([99_949_999, 99_950_000, 12_345_678_900].map(megabytes), ["99.9 MB", "100 MB", "12346 MB"]);
        let by = LimitedBy::Machine;
        assert!(Memory::limited(1, by).room(2_000_001, need).unwrap_err().to_string().ends_with(
            "12.0 MB; 0.0 MB are allowed, by what this machine has free\n   = help: take a smaller part; `--max-memory 13MB` would try it all the same"
        ));
    }
}
