//! Where an output goes, and whether two outputs go to the same place.

use std::ffi::OsStr;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Where an output goes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Target {
    /// Standard output, `-` on the command line.
    Stdout,
    /// A file, or an existing device or named pipe.
    File(PathBuf),
}

impl Target {
    /// The target an argument names: `-` and `/dev/stdout` are standard output, anything else is a path.
    pub fn from_arg(arg: &OsStr) -> Self {
        if arg == "-" || arg == "/dev/stdout" { Self::Stdout } else { Self::File(arg.into()) }
    }

    /// Whether the bytes go straight out as they are made: standard output, devices, named pipes, open descriptors.
    /// All other targets are files that appear whole or not at all.
    pub fn is_stream(&self) -> bool {
        match self {
            Self::Stdout => true,
            // Names of open descriptors: a rename would replace the name, not reach what it stands for.
            Self::File(path) if ["/dev/fd", "/dev/stderr", "/proc"].iter().any(|p| path.starts_with(p)) => true,
            Self::File(path) => std::fs::metadata(path).is_ok_and(|m| !m.is_file() && !m.is_dir()),
        }
    }
}

impl fmt::Display for Target {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stdout => f.write_str("standard output"),
            Self::File(path) => path.display().fmt(f),
        }
    }
}

/// What a path stands for, to tell whether two paths stand for the same.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Identity {
    /// Device and number of something that exists.
    #[cfg_attr(not(unix), allow(dead_code, reason = "inodes are known on unix only"))]
    Inode(u64, u64),
    /// The canonical path something will get, or has where there are no inodes.
    Path(PathBuf),
    /// A character device such as `/dev/null`: any number of outputs may share it.
    Shared,
}

impl Identity {
    /// The identity of a path whose symbolic links have been followed.
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        match std::fs::metadata(path) {
            Ok(metadata) => Self::of_existing(path, &metadata),
            Err(_) => {
                let folder = folder_of(path).canonicalize()?;
                Ok(Self::Path(path.file_name().map_or(folder.clone(), |name| folder.join(name))))
            }
        }
    }

    #[cfg(unix)]
    fn of_existing(_: &Path, metadata: &std::fs::Metadata) -> io::Result<Self> {
        use std::os::unix::fs::{FileTypeExt, MetadataExt};
        let shared = metadata.file_type().is_char_device();
        Ok(if shared { Self::Shared } else { Self::Inode(metadata.dev(), metadata.ino()) })
    }

    #[cfg(not(unix))]
    fn of_existing(path: &Path, _: &std::fs::Metadata) -> io::Result<Self> {
        Ok(Self::Path(path.canonicalize()?))
    }

    /// The identity of standard output: the file or pipe behind it where the system tells.
    pub(super) fn of_stdout() -> Self {
        Self::of(Path::new("/dev/stdout")).unwrap_or_else(|_| Self::Path(PathBuf::from("-")))
    }

    /// Whether two outputs of these identities would overwrite one another.
    pub(super) fn clashes(&self, other: &Self) -> bool {
        *self != Self::Shared && self == other
    }
}

/// The folder a path lies in; the working directory for a bare name.
pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(parent) if parent != Path::new("") => parent,
        _ => Path::new("."),
    }
}

/// Follows symbolic links at the end of a path, also to something that does not exist yet.
pub(super) fn follow_links(path: &Path) -> PathBuf {
    /// As many as Linux follows before it calls a chain of links a loop.
    const MOST_LINKS: usize = 40;
    let mut path = path.to_path_buf();
    for _ in 0..MOST_LINKS {
        match std::fs::read_link(&path) {
            Ok(to) => path = folder_of(&path).join(to),
            Err(_) => break,
        }
    }
    path
}
