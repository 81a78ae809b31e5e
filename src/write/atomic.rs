//! Outputs that appear whole or not at all.

use super::EncodeError;
use super::digest::{self, Digest};
use super::target::{Identity, folder_of, follow_links};
use std::fs::{File, OpenOptions, Permissions};
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError, TryLockError};
use std::time::{Duration, Instant};
use tempfile::TempPath;

pub use super::error::WriteError;
pub use super::target::Target;

/// Temporary files that are not yet outputs, so that an interrupt can remove them. Nothing is allocated while it is locked: who
/// runs out of memory must be able to lock it, too.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The list with room for one more.
fn unfinished_with_room() -> MutexGuard<'static, Vec<PathBuf>> {
    loop {
        let list = unfinished();
        if list.len() < list.capacity() {
            return list;
        }
        let mut larger = Vec::with_capacity(2 * list.len() + 8);
        drop(list);
        // Taken before what it held is dropped, and so unlocked first.
        let mut list = unfinished();
        if list.len() < larger.capacity() {
            larger.append(&mut list);
            std::mem::swap(&mut *list, &mut larger);
        }
        drop(list);
    }
}

/// Removes the temporary files of all [`Outputs`] still open, for those who end the process right after: no output can be opened
/// or committed any more. Waits until a commit that has begun is done, so that the outputs of a job are all there or none.
pub fn discard_unfinished() {
    discard(unfinished());
}

/// The same where nothing can be waited for: gives up when the list stays locked for `patience`.
pub fn discard_unfinished_within(patience: Duration) {
    /// Between two attempts.
    const PAUSE: Duration = Duration::from_millis(5);
    let begun = Instant::now();
    loop {
        match UNFINISHED.try_lock() {
            Ok(list) => return discard(list),
            Err(TryLockError::Poisoned(list)) => return discard(list.into_inner()),
            Err(TryLockError::WouldBlock) if begun.elapsed() < patience => std::thread::sleep(PAUSE),
            Err(TryLockError::WouldBlock) => return,
        }
    }
}

fn discard(list: MutexGuard<'static, Vec<PathBuf>>) {
    for path in list.iter() {
        // Nothing can be done about a file that will not go, and nobody is left to be told.
        let _ = std::fs::remove_file(path);
    }
    // Locked for good: no other job opens or commits an output before the process ends.
    std::mem::forget(list);
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
/// bytes at once and cannot be taken back. A new file gets the permissions a plain create would give, a replaced one keeps its
/// own.
#[derive(Debug)]
pub struct Outputs {
    slots: Vec<Slot>,
    /// Whether hashes are taken.
    hashed: bool,
}

#[derive(Debug)]
struct Slot {
    target: Target,
    sink: Sink,
    /// Content has been written to the end.
    written: bool,
    /// Of what was written, where that is wanted.
    digest: Option<Digest>,
}

#[derive(Debug)]
enum Sink {
    Stdout,
    Stream(File),
    File { temporary: Pending<File>, path: PathBuf, permissions: Option<Permissions> },
    Memory(Vec<u8>),
    Nowhere,
}

/// A file under a temporary name, listed in [`UNFINISHED`] for as long as it has that name.
#[derive(Debug)]
struct Pending<F> {
    file: F,
    /// `None` once it has its final name.
    name: Option<TempPath>,
}

impl Pending<File> {
    /// A new file in the folder of `path`.
    fn beside(path: &Path) -> io::Result<Self> {
        let mut options = OpenOptions::new();
        options.read(true).write(true).create_new(true);
        #[cfg(unix)]
        {
            use std::os::unix::fs::OpenOptionsExt;
            // What a plain create asks for; the system takes away what the umask forbids.
            options.mode(0o666);
        }
        Self::made(path, |name| options.open(name))
    }
}

impl Pending<()> {
    /// Another name for the file at `path`.
    fn link(path: &Path) -> io::Result<Self> {
        Self::made(path, |name| std::fs::hard_link(path, name))
    }
}

impl<F> Pending<F> {
    fn made(path: &Path, make: impl Fn(&Path) -> io::Result<F>) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".slopegen-").suffix(".part");
        let listed = |name: &Path| {
            let owned = name.to_path_buf();
            // Made and listed under one lock: an interrupt comes before both or after both.
            let mut list = unfinished_with_room();
            let file = make(name)?;
            list.push(owned);
            Ok(file)
        };
        let (file, name) = builder.make_in(folder_of(path), listed)?.into_parts();
        Ok(Self { file, name: Some(name) })
    }

    /// Gives the file its final name. `list`: the locked list.
    fn persist(&mut self, path: &Path, list: &mut Vec<PathBuf>) -> io::Result<()> {
        let Some(name) = self.name.take() else { return Err(ErrorKind::NotFound.into()) };
        let place = list.iter().position(|listed| *listed == *name);
        match name.persist(path) {
            Ok(()) => {
                place.map(|place| list.swap_remove(place));
                Ok(())
            }
            Err(failed) => {
                self.name = Some(failed.path);
                Err(failed.error)
            }
        }
    }
}

impl<F> Drop for Pending<F> {
    fn drop(&mut self) {
        if let Some(name) = self.name.take() {
            let path = name.to_path_buf();
            drop(name);
            unfinished().retain(|listed| *listed != path);
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
            Ok(Slot { target: target.clone(), sink, written: false, digest: None })
        };
        Ok(Self { slots: targets.iter().map(open).collect::<Result<_, _>>()?, hashed: false })
    }

    /// Outputs that are kept in memory; whatever has their names stays as it is.
    pub fn in_memory(targets: &[Target]) -> Self {
        Self::without_files(targets, || Sink::Memory(Vec::new()))
    }

    /// Outputs that are made and not kept. Their hashes may be of use.
    pub fn nowhere(targets: &[Target]) -> Self {
        Self::without_files(targets, || Sink::Nowhere)
    }

    fn without_files(targets: &[Target], sink: impl Fn() -> Sink) -> Self {
        let slot = |target: &Target| Slot { target: target.clone(), sink: sink(), written: false, digest: None };
        Self { slots: targets.iter().map(slot).collect(), hashed: false }
    }

    /// The same, with hashes of what is written from now on.
    pub fn hashed(self) -> Self {
        Self { hashed: true, ..self }
    }

    /// Length and hash of output `index`, where it was written to the end and hashes are taken.
    pub fn digest(&self, index: usize) -> Option<&Digest> {
        self.slots.get(index).and_then(|slot| slot.digest.as_ref())
    }

    /// What was written into memory, with the targets.
    pub fn into_memory(self) -> Vec<(Target, Vec<u8>)> {
        let held = |slot: Slot| match slot.sink {
            Sink::Memory(bytes) if slot.written => Some((slot.target, bytes)),
            _ => None,
        };
        self.slots.into_iter().filter_map(held).collect()
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
        match slot.sink.fill(self.hashed, encode) {
            Ok(digest) => {
                slot.written = true;
                slot.digest = digest;
                Ok(Delivery::Complete)
            }
            Err(cause) if cause.is_closed_pipe() && !matches!(slot.sink, Sink::File { .. }) => Ok(Delivery::PipeClosed),
            Err(cause) => Err(WriteError::Write { target: slot.target.clone(), cause }),
        }
    }

    /// Gives all files their final names, after everything written has reached the disk: all of them, or none. An output never
    /// written, or not to the end, does not appear. An interrupt waits until all have their names.
    ///
    /// # Errors
    /// [`WriteError::Write`] if the disk refuses, [`WriteError::Open`] if a file cannot get its name. No file appears then, and
    /// those that were to be replaced are what they were; only where the file system knows no links, files replaced before the
    /// one that failed stay replaced.
    pub fn commit(mut self) -> Result<(), WriteError> {
        self.slots.retain(|slot| slot.written);
        for Slot { target, sink, .. } in &mut self.slots {
            sink.settle().map_err(|cause| WriteError::Write { target: target.clone(), cause: cause.into() })?;
        }
        let mut files: Vec<Naming<'_>> = self.slots.iter_mut().filter_map(Naming::of).collect();
        // The last one either gets its name or fails: nothing would ever be taken back for it.
        let all_but_last = files.len().saturating_sub(1);
        for file in &mut files[..all_but_last] {
            file.keep_old();
        }
        let mut list = unfinished();
        let failed = files.iter_mut().position(|file| {
            file.refused = file.temporary.persist(file.path, &mut list).err();
            file.refused.is_some()
        });
        let Some(failed) = failed else { return Ok(()) };
        for file in &mut files[..failed] {
            file.take_back(&mut list);
        }
        drop(list);
        let cause = files[failed].refused.take().unwrap_or_else(|| ErrorKind::Other.into());
        Err(WriteError::Open { target: files[failed].target.clone(), cause })
    }
}

/// A file about to get its final name.
struct Naming<'a> {
    target: &'a Target,
    temporary: &'a mut Pending<File>,
    path: &'a Path,
    /// Whether it takes the place of another.
    replaces: bool,
    /// That other one, until all files have their names.
    old: Option<Pending<()>>,
    /// Why it did not get its name.
    refused: Option<io::Error>,
}

impl<'a> Naming<'a> {
    fn of(slot: &'a mut Slot) -> Option<Self> {
        let Sink::File { temporary, path, .. } = &mut slot.sink else { return None };
        Some(Self { target: &slot.target, temporary, path, replaces: false, old: None, refused: None })
    }

    /// Keeps what is there under another name.
    fn keep_old(&mut self) {
        self.replaces = self.path.symlink_metadata().is_ok();
        self.old = if self.replaces { Pending::link(self.path).ok() } else { None };
    }

    /// Makes undone that the file got its name.
    fn take_back(&mut self, list: &mut Vec<PathBuf>) {
        // What cannot be taken back stays: the error that led here is told in any case.
        let _ = match &mut self.old {
            Some(old) => old.persist(self.path, list),
            None if self.replaces => Ok(()),
            None => std::fs::remove_file(self.path),
        };
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

    fn fill(
        &mut self,
        hashed: bool,
        encode: impl FnOnce(&mut dyn Write) -> Result<(), EncodeError>,
    ) -> Result<Option<Digest>, EncodeError> {
        match self {
            Self::Stdout => fill_buffered(io::stdout().lock(), hashed, encode),
            Self::Stream(file) => fill_buffered(file, hashed, encode),
            Self::File { temporary, .. } => fill_buffered(&temporary.file, hashed, encode),
            Self::Memory(bytes) => {
                bytes.clear();
                fill_buffered(bytes, hashed, encode)
            }
            Self::Nowhere => fill_buffered(io::sink(), hashed, encode),
        }
    }

    /// Brings a file's content to the disk and gives it its permissions.
    fn settle(&mut self) -> io::Result<()> {
        let Self::File { temporary, permissions, .. } = self else { return Ok(()) };
        let file = &temporary.file;
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

fn fill_buffered(
    sink: impl Write,
    hashed: bool,
    encode: impl FnOnce(&mut dyn Write) -> Result<(), EncodeError>,
) -> Result<Option<Digest>, EncodeError> {
    if hashed { digest::hashed(sink, |tee| buffered(tee, encode)) } else { buffered(sink, encode).map(|()| None) }
}

fn buffered(sink: impl Write, encode: impl FnOnce(&mut dyn Write) -> Result<(), EncodeError>) -> Result<(), EncodeError> {
    /// Bytes gathered from small writes.
    const BUFFER: usize = 1 << 16;
    let mut buffered = BufWriter::with_capacity(BUFFER, Counting { sink, written: 0 });
    let result = encode(&mut buffered).and_then(|()| Ok(buffered.flush()?));
    // Dropping it would try to write the rest once more after a failure.
    let (counting, _) = buffered.into_parts();
    result.map_err(|cause| match cause {
        EncodeError::Io(cause) if counting.written > 0 => {
            io::Error::new(cause.kind(), format!("{cause}, after {} bytes", counting.written)).into()
        }
        other => other,
    })
}

/// Counts the bytes a sink has taken.
struct Counting<W> {
    sink: W,
    written: u64,
}

impl<W: Write> Write for Counting<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = self.sink.write(bytes)?;
        self.written += taken as u64;
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.sink.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<String> =
            std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    /// Opens and writes files of these names, each with its name as content.
    fn written(folder: &Path, files: &[&str]) -> Outputs {
        let targets: Vec<Target> = files.iter().map(|name| Target::File(folder.join(name))).collect();
        let mut outputs = Outputs::open::<PathBuf>(&targets, &[]).unwrap();
        for (index, name) in files.iter().enumerate() {
            outputs.write(index, |out| Ok(out.write_all(name.as_bytes())?)).unwrap();
        }
        outputs
    }

    #[test]
    fn all_get_their_names_or_none() {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str| folder.path().join(name);
        std::fs::write(path("old"), "as it was").unwrap();
        let outputs = written(folder.path(), &["new", "old", "taken", "last"]);
        // Meanwhile somebody makes a folder where the third is to be.
        std::fs::create_dir(path("taken")).unwrap();
        let error = outputs.commit().unwrap_err();
        assert!(matches!(&error, WriteError::Open { target: Target::File(path), .. } if path.ends_with("taken")), "{error}");
        assert_eq!(names(folder.path()), ["old", "taken"]);
        assert_eq!(std::fs::read_to_string(path("old")).unwrap(), "as it was");

        std::fs::remove_dir(path("taken")).unwrap();
        written(folder.path(), &["new", "old", "taken", "last"]).commit().unwrap();
        assert_eq!(names(folder.path()), ["last", "new", "old", "taken"]);
        assert_eq!(std::fs::read_to_string(path("old")).unwrap(), "old");
    }

    #[test]
    fn many_are_open_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let files: Vec<String> = (0..100).map(|i| format!("{i:02}")).collect();
        let files: Vec<&str> = files.iter().map(String::as_str).collect();
        let outputs = written(folder.path(), &files);
        assert!(names(folder.path()).iter().all(|name| name.starts_with(".slopegen-") && name.ends_with(".part")));
        let listed = |folder: &Path| unfinished().iter().filter(|path| path.starts_with(folder)).count();
        assert_eq!(listed(folder.path()), 100);
        outputs.commit().unwrap();
        assert_eq!(names(folder.path()), files);
        assert_eq!(listed(folder.path()), 0);
        drop(written(folder.path(), &["more"]));
        assert_eq!((listed(folder.path()), names(folder.path()).len()), (0, 100));
    }
}
