//! How much memory a run may take: as asked for, or what there is. And what happens when that was not enough.

mod available;

use super::exit_code::Code;
use crate::model::{LimitedBy, Memory};
use crate::write::discard_unfinished_within;
use std::cell::Cell;
use std::io::{IsTerminal as _, Write as _};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock};
use std::time::Duration;

/// Less than the program takes to begin with: a slip of the keyboard.
const LEAST: f64 = 1e6;

/// Units of memory, and their bytes. Those with an `i` count in powers of two; a bare letter does as `ulimit` and containers do.
const UNITS: [(&str, f64); 13] = [
    ("kb", 1e3),
    ("mb", 1e6),
    ("gb", 1e9),
    ("tb", 1e12),
    ("kib", 1024.0),
    ("mib", 1_048_576.0),
    ("gib", 1_073_741_824.0),
    ("tib", 1_099_511_627_776.0),
    ("k", 1024.0),
    ("m", 1_048_576.0),
    ("g", 1_073_741_824.0),
    ("t", 1_099_511_627_776.0),
    ("b", 1.0),
];

/// Reads the value of `--max-memory`.
///
/// # Errors
/// What is wrong with it.
pub(super) fn read(text: &str) -> Result<Memory, String> {
    let refuse = |what: &str, help: &str| Err(format!("{what}\n  --> --max-memory {text}\n   = help: {help}"));
    const HOW: &str = "give a number and a unit, such as `2GB` or `1500MiB`";
    let text = text.trim();
    let split = text.find(|c: char| c.is_ascii_alphabetic()).unwrap_or(text.len());
    let (number, unit) = (text[..split].trim(), text[split..].to_ascii_lowercase());
    let plain = number.bytes().all(|b| b.is_ascii_digit() || b == b'.');
    let Some(number) = number.parse::<f64>().ok().filter(|number| plain && number.is_finite()) else {
        return refuse(&format!("`{text}` is not an amount of memory"), HOW);
    };
    let Some((_, bytes)) = UNITS.iter().find(|(name, _)| *name == unit) else {
        let what = if unit.is_empty() {
            "an amount of memory needs a unit".to_owned()
        } else {
            format!("`{text}` has no unit of memory")
        };
        return refuse(&what, HOW);
    };
    let bytes = number * bytes;
    if bytes < LEAST {
        return refuse(&format!("`{text}` is too little memory"), "give 1MB or more; small jobs take 20MB");
    }
    // More than any machine has is no limit; the conversion saturates.
    Ok(Memory::limited(bytes as u64, LimitedBy::Option))
}

/// The limit of this process, for the message when memory runs out.
static LIMIT: OnceLock<Memory> = OnceLock::new();

/// Given back when memory runs out, so that files can be removed.
static RESERVE: Mutex<Vec<u8>> = Mutex::new(Vec::new());

/// Bytes of the reserve: for a few paths.
const RESERVED: usize = 1 << 16;

/// Settles how much memory the run may take, `asked` or else what there is, and has the system see to it where it can.
pub(super) fn limit(asked: Option<Memory>) -> Memory {
    let memory = *LIMIT.get_or_init(|| asked.unwrap_or_else(available::memory));
    if let Some((bytes, _)) = memory.limit() {
        enforce(bytes);
    }
    if let Ok(mut reserve) = RESERVE.try_lock() {
        *reserve = vec![1; RESERVED];
    }
    memory
}

/// How many threads of `wanted` the limits have room for, at least one.
#[cfg(unix)]
pub(super) fn threads(wanted: usize) -> usize {
    use rustix::process::{Resource, getrlimit};
    /// What a thread takes of addresses, most of which are never used, and of memory: its stack.
    const PER_THREAD: [(Resource, u64); 2] = [(Resource::As, 1 << 26), (Resource::Data, 1 << 22)];
    let most = PER_THREAD.iter().filter_map(|&(resource, bytes)| Some(getrlimit(resource).current? / bytes)).min();
    most.map_or(wanted, |most| wanted.min(most as usize)).max(1)
}

#[cfg(not(unix))]
pub(super) fn threads(wanted: usize) -> usize {
    wanted
}

/// Has the system refuse memory beyond the limit. Without that it is given and, when there is none, the process killed without a
/// word. Where the system cannot, estimates must do.
#[cfg(target_os = "linux")]
fn enforce(bytes: u64) {
    use rustix::process::{Resource, getrlimit, setrlimit};
    // What is written to, not mere addresses: heap and stacks.
    let mut limits = getrlimit(Resource::Data);
    limits.current = Some(limits.current.map_or(bytes, |now| now.min(bytes)));
    // The limit stays what it was; nothing depends on it.
    let _ = setrlimit(Resource::Data, limits);
}

#[cfg(not(target_os = "linux"))]
fn enforce(_: u64) {}

thread_local! {
    /// Whether this thread is the one that ends the process.
    static ENDING: Cell<bool> = const { Cell::new(false) };
}

/// Ends the process because `bytes` of memory were asked for and there are none: removes unfinished files, says so, and exits
/// with the code for it. For the program's allocator; takes no locks that another thread could hold for long, and no memory.
pub fn out_of_memory(bytes: usize) -> ! {
    /// How long another thread may take to give the outputs their names.
    const PATIENCE: Duration = Duration::from_secs(2);
    static BEGUN: AtomicBool = AtomicBool::new(false);
    if ENDING.get() {
        end();
    }
    if BEGUN.swap(true, Ordering::AcqRel) {
        // Another thread ends the process.
        loop {
            std::thread::sleep(PATIENCE);
        }
    }
    ENDING.set(true);
    if let Ok(mut reserve) = RESERVE.try_lock() {
        drop(std::mem::take(&mut *reserve));
    }
    discard_unfinished_within(PATIENCE);
    tell(bytes);
    end()
}

/// Writes the message past all buffers and locks.
fn tell(bytes: usize) {
    /// Bytes of a megabyte.
    const MB: f64 = 1e6;
    let mut text = [0_u8; 512];
    let mut rest = &mut text[..];
    let room = rest.len();
    // The display of progress stands in the line.
    let begin = if std::io::stderr().is_terminal() { "\r\x1b[2K" } else { "" };
    let _ = write!(rest, "{begin}error: out of memory\n   = {bytes} bytes more were asked for");
    match LIMIT.get().and_then(Memory::limit) {
        Some((limit, by)) => {
            let _ = writeln!(rest, "; {:.0} MB are allowed in all, {by}", limit as f64 / MB);
        }
        None => {
            let _ = writeln!(rest, ", and the system gave none");
        }
    }
    let help =
        "give more (`--max-memory`, `ulimit`), fewer `--jobs` of a batch, or work on a smaller part; no file was left behind";
    let _ = writeln!(rest, "   = help: {help}");
    let length = room - rest.len();
    unbuffered(&text[..length]);
}

#[cfg(unix)]
fn unbuffered(text: &[u8]) {
    use std::os::fd::AsFd as _;
    if let Ok(descriptor) = std::io::stderr().as_fd().try_clone_to_owned() {
        let _ = std::fs::File::from(descriptor).write_all(text);
    }
}

#[cfg(not(unix))]
fn unbuffered(text: &[u8]) {
    let _ = std::io::stderr().write_all(text);
}

/// Ends the process at once: what runs at an orderly exit may want memory.
#[cfg(unix)]
fn end() -> ! {
    signal_hook::low_level::exit(Code::Memory as i32)
}

#[cfg(not(unix))]
fn end() -> ! {
    std::process::exit(Code::Memory as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn amounts() {
        let of = |text| read(text).map(|memory| memory.limit().unwrap().0);
        for (text, bytes) in [
            ("2GB", 2_000_000_000),
            ("1500MiB", 1_572_864_000),
            (" 1.5 gb ", 1_500_000_000),
            ("512m", 536_870_912),
            ("2000000b", 2_000_000),
        ] {
            assert_eq!(of(text), Ok(bytes), "{text}");
        }
        assert_eq!(of("99999999999TB"), Ok(u64::MAX));
        for text in ["", "2", "GB", "-2GB", "1e3MB", "2 GB x", "2XB", "nan GB", "inf", "1,5GB", "2GBB", "12B", "0GB", "½GB"] {
            assert!(of(text).is_err_and(|message| message.contains("\n  --> --max-memory ")), "{text}");
        }
    }
}
