//! The hash of an output, taken while it is written.

use super::EncodeError;
use crate::kernel::hash::hex;
use sha2::{Digest as _, Sha256};
use std::io::{self, Write};
use std::sync::mpsc::{SyncSender, sync_channel};

/// What is known of the bytes of an output.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Digest {
    /// How many.
    pub bytes: u64,
    /// SHA-256, in lower-case hexadecimal digits.
    pub sha256: String,
}

/// Blocks that may wait for the hash before the writer waits too.
const WAITING: usize = 16;

/// Writes by `fill` to `sink`, and takes the hash of what is written on a thread of its own: it would cost a fast format a
/// quarter of its speed, and more on processors without instructions for it.
///
/// Blocks are those `fill` writes: it should gather small ones before.
///
/// # Errors
/// What `fill` returns.
pub(super) fn hashed<S: Write>(
    sink: S,
    fill: impl FnOnce(Tee<S>) -> Result<(), EncodeError>,
) -> Result<Option<Digest>, EncodeError> {
    std::thread::scope(|scope| {
        let (blocks, received) = sync_channel::<Vec<u8>>(WAITING);
        let hash = std::thread::Builder::new().spawn_scoped(scope, move || {
            let mut hash = Sha256::new();
            let mut bytes = 0;
            for block in received {
                hash.update(&block);
                bytes += block.len() as u64;
            }
            Digest { bytes, sha256: hex(&hash.finalize()) }
        })?;
        let filled = fill(Tee { sink, blocks });
        // The hash ends with the writer.
        let digest = hash.join().ok();
        filled.map(|()| digest)
    })
}

/// Writes to a sink, and passes what it took on to the hash.
pub(super) struct Tee<S> {
    sink: S,
    blocks: SyncSender<Vec<u8>>,
}

impl<S: Write> Write for Tee<S> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let taken = self.sink.write(bytes)?;
        let gone = |_| io::Error::other("the hash of an output could not be taken");
        self.blocks.send(bytes[..taken].to_vec()).map_err(gone)?;
        Ok(taken)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.sink.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Takes at most three bytes at once.
    struct Slow(Vec<u8>);

    impl Write for Slow {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let n = bytes.len().min(3);
            self.0.extend(&bytes[..n]);
            Ok(n)
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn what_arrives_is_hashed() {
        let mut slow = Slow(Vec::new());
        let digest = hashed(&mut slow as &mut dyn Write, |mut out| {
            (0..1000).try_for_each(|i| writeln!(out, "{i}"))?;
            Ok(())
        });
        let text: String = (0..1000).map(|i| format!("{i}\n")).collect();
        let expected = Digest { bytes: text.len() as u64, sha256: crate::kernel::hash::sha256(text.as_bytes()) };
        assert_eq!((digest.unwrap(), slow.0), (Some(expected), text.into_bytes()));
        let nothing = hashed(io::sink(), |_| Ok(())).unwrap().unwrap();
        // FIPS 180-4 has this value for no bytes.
        assert_eq!(nothing.sha256, "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    }
}
