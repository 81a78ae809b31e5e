//! Outputs that appear whole or not at all.

use super::EncodeError;
use super::target::{Identity, folder_of, follow_links};
use std::collections::BTreeSet;
use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};
use tempfile::NamedTempFile;

pub use super::error::WriteError;
pub use super::target::Target;

/// Temporary files that are not yet outputs, so that an interrupt can remove them.
static UNFINISHED: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn unfinished() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes the temporary files of all [`Outputs`] still open. For an interrupt handler that ends the process right after:
/// outputs not yet committed can no longer be.
pub fn discard_unfinished() {
    for path in std::mem::take(&mut *unfinished()) {
        // Nothing can be done about a file that will not go, and nobody is left to be told.
        let _ = std::fs::remove_file(path);
    }
}

/// How an output arrived.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delivery {
    /// All of it.
    Complete,
    /// The reader at the other end of a pipe left before the end, as `head` does. Not an error.
    PipeClosed,
}

/// All outputs of a run: opened before the long work, written in any order, made visible together.
///
/// A file is written under a temporary name in the folder of its final one and renamed by [`Outputs::commit`]; dropping
/// `Outputs` without a commit leaves nothing behind and touches no existing file. Streams ([`Target::is_stream`]) get their
/// bytes at once and cannot be taken back. A new file gets the permissions a plain create would give, a replaced one keeps its own.
#[derive(Debug)]
pub struct Outputs {
    slots: Vec<Slot>,
}

#[derive(Debug)]
struct Slot {
    target: Target,
    sink: Sink,
    /// Content has been written to the end.
    written: bool,
}

#[derive(Debug)]
enum Sink {
    Stdout,
    Stream(File),
    File { temporary: Pending, path: PathBuf, permissions: Option<Permissions> },
}

/// A temporary file, listed in [`UNFINISHED`] for as long as it exists.
#[derive(Debug)]
struct Pending(Option<NamedTempFile>);

impl Pending {
    fn beside(path: &Path) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".slopegen-").suffix(".part");
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // What a plain create asks for; the system takes away what the umask forbids.
            builder.permissions(Permissions::from_mode(0o666));
        }
        let mut list = unfinished();
        let file = builder.tempfile_in(folder_of(path))?;
        list.insert(file.path().to_path_buf());
        Ok(Self(Some(file)))
    }

    fn file(&mut self) -> io::Result<&mut File> {
        self.0.as_mut().map(NamedTempFile::as_file_mut).ok_or_else(|| io::Error::from(ErrorKind::NotFound))
    }

    /// Gives the file its final name.
    fn persist(mut self, path: &Path) -> io::Result<()> {
        let Some(file) = self.0.take() else { return Err(ErrorKind::NotFound.into()) };
        let mut list = unfinished();
        list.remove(file.path());
        // On failure the error holds the file, and dropping it removes it.
        file.persist(path).map(drop).map_err(|e| e.error)
    }
}

impl Drop for Pending {
    fn drop(&mut self) {
        if let Some(file) = self.0.take() {
            let path = file.path().to_path_buf();
            drop(file);
            unfinished().remove(&path);
        }
    }
}

impl Outputs {
    /// Opens all targets, so that a missing folder or missing permission shows before the long work. `inputs` are files that
    /// no output may overwrite. Nothing that exists is changed.
    ///
    /// # Errors
    /// The first of: [`WriteError::IsFolder`], [`WriteError::SameFile`], [`WriteError::IsInput`], [`WriteError::Open`].
    /// Outputs opened until then are gone again.
    pub fn open<P: AsRef<Path>>(targets: &[Target], inputs: &[P]) -> Result<Self, WriteError> {
        let inputs: Vec<Identity> =
            inputs.iter().map(AsRef::as_ref).filter(|p| p.is_file()).filter_map(|p| Identity::of(p).ok()).collect();
        let mut taken: Vec<(Identity, &Target)> = Vec::new();
        for target in targets {
            let identity = match target {
                Target::Stdout => Identity::of_stdout(),
                Target::File(path) if path.is_dir() => return Err(WriteError::IsFolder(target.clone())),
                Target::File(path) => Identity::of(&follow_links_unless_stream(target, path))
                    .map_err(|cause| WriteError::Open { target: target.clone(), cause })?,
            };
            let twice = matches!(target, Target::Stdout) && taken.iter().any(|(_, t)| **t == Target::Stdout);
            if let Some((_, first)) = taken.iter().find(|(t, first)| t.clashes(&identity) || (twice && **first == Target::Stdout))
            {
                return Err(WriteError::SameFile { first: (*first).clone(), second: target.clone() });
            }
            if inputs.iter().any(|input| input.clashes(&identity)) {
                return Err(WriteError::IsInput(target.clone()));
            }
            taken.push((identity, target));
        }
        let open = |target: &Target| {
            let sink = Sink::open(target).map_err(|cause| WriteError::Open { target: target.clone(), cause })?;
            Ok(Slot { target: target.clone(), sink, written: false })
        };
        Ok(Self { slots: targets.iter().map(open).collect::<Result<_, _>>()? })
    }

    /// Number of outputs.
    pub fn len(&self) -> usize {
        self.slots.len()
    }

    /// Whether there is no output.
    pub fn is_empty(&self) -> bool {
        self.slots.is_empty()
    }

    /// Writes output `index` (its position among the targets) to the end. A stream whose reader has left is no error.
    ///
    /// # Errors
    /// [`WriteError::Write`] with what the encoder or the system said; the output will then not be committed.
    ///
    /// # Panics
    /// If there is no such output: a bug in the caller.
    pub fn write(
        &mut self,
        index: usize,
        encode: impl FnOnce(&mut dyn Write) -> Result<(), EncodeError>,
    ) -> Result<Delivery, WriteError> {
        let slot = &mut self.slots[index];
        slot.written = false;
        match slot.sink.fill(encode) {
            Ok(()) => {
                slot.written = true;
                Ok(Delivery::Complete)
            }
            Err(cause) if cause.is_closed_pipe() && !matches!(slot.sink, Sink::File { .. }) => Ok(Delivery::PipeClosed),
            Err(cause) => Err(WriteError::Write { target: slot.target.clone(), cause }),
        }
    }

    /// Gives all files their final names, after everything written has reached the disk. An output never written, or not to
    /// the end, does not appear.
    ///
    /// # Errors
    /// [`WriteError::Write`] if the disk refuses; no file appears then. [`WriteError::Open`] if a file cannot get its name;
    /// those before it have theirs, those after it do not appear.
    pub fn commit(mut self) -> Result<(), WriteError> {
        self.slots.retain(|slot| slot.written);
        for Slot { target, sink, .. } in &mut self.slots {
            sink.settle().map_err(|cause| WriteError::Write { target: target.clone(), cause: cause.into() })?;
        }
        for Slot { target, sink, .. } in self.slots {
            if let Sink::File { temporary, path, .. } = sink {
                temporary.persist(&path).map_err(|cause| WriteError::Open { target, cause })?;
            }
        }
        Ok(())
    }
}

/// The path an output is renamed to. Names of streams are not followed: behind `/dev/fd/1` stands no path.
fn follow_links_unless_stream(target: &Target, path: &Path) -> PathBuf {
    if target.is_stream() { path.to_path_buf() } else { follow_links(path) }
}

impl Sink {
    fn open(target: &Target) -> io::Result<Self> {
        let Target::File(path) = target else { return Ok(Self::Stdout) };
        if target.is_stream() {
            return Ok(Self::Stream(OpenOptions::new().append(true).open(path)?));
        }
        let path = follow_links(path);
        let permissions = match std::fs::metadata(&path) {
            Ok(metadata) => {
                // A rename would replace a file its owner protected against writing.
                OpenOptions::new().write(true).open(&path)?;
                Some(metadata.permissions())
            }
            Err(_) => None,
        };
        Ok(Self::File { temporary: Pending::beside(&path)?, path, permissions })
    }

    fn fill(&mut self, encode: impl FnOnce(&mut dyn Write) -> Result<(), EncodeError>) -> Result<(), EncodeError> {
        match self {
            Self::Stdout => fill_buffered(io::stdout().lock(), encode),
            Self::Stream(file) => fill_buffered(file, encode),
            Self::File { temporary, .. } => fill_buffered(temporary.file()?, encode),
        }
    }

    /// Brings a file's content to the disk and gives it its permissions.
    fn settle(&mut self) -> io::Result<()> {
        let Self::File { temporary, permissions, .. } = self else { return Ok(()) };
        let file = temporary.file()?;
        match file.sync_all() {
            // Some network and user-space file systems know no sync.
            Err(e) if matches!(e.kind(), ErrorKind::InvalidInput | ErrorKind::Unsupported) => {}
            result => result?,
        }
        if let Some(permissions) = permissions.take() {
            file.set_permissions(permissions)?;
        }
        Ok(())
    }
}

fn fill_buffered(sink: impl Write, encode: impl FnOnce(&mut dyn Write) -> Result<(), EncodeError>) -> Result<(), EncodeError> {
    /// Bytes gathered from small writes.
    const BUFFER: usize = 1 << 16;
    let mut buffered = BufWriter::with_capacity(BUFFER, sink);
    let result = encode(&mut buffered).and_then(|()| Ok(buffered.flush()?));
    // Dropping it would try to write the rest once more after a failure.
    let _ = buffered.into_parts();
    result
}
