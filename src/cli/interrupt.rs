//! What happens on Ctrl-C, and on other signals that ask the program to end.

use super::exit_code::Code;
#[cfg(unix)]
use super::running::NoThreads;
use crate::write::discard_unfinished;
use anyhow::Context as _;

/// What is said where signals cannot be caught.
const NOT_INSTALLED: &str = "the handler for interrupts could not be installed";

/// What a shell adds to the number of a signal.
const SIGNALLED: i32 = 128;

/// On an interrupt, or when asked to end: removes files not yet finished and ends the process with 128 and the number of the
/// signal. Signals the caller has switched off, as `nohup` does, stay so. A file that grows beyond what the shell allows becomes
/// an error of the write like a full disk.
#[cfg(unix)]
pub(super) fn install() -> anyhow::Result<()> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGXFSZ};
    let ignored = ignored();
    let asking = [SIGINT, SIGTERM, SIGHUP].into_iter().filter(|signal| ignored & (1 << (signal - 1)) == 0);
    let signals = signal_hook::iterator::Signals::new(asking).context(NOT_INSTALLED)?;
    // Caught, so that it does not end the process; nobody looks at the flag.
    signal_hook::flag::register(SIGXFSZ, std::sync::Arc::default()).context(NOT_INSTALLED)?;
    let waiting =
        no_abort(Code::Memory, || std::thread::Builder::new().name("signals".to_owned()).spawn(move || attend(signals)));
    waiting.map(drop).map_err(|_| NoThreads.into())
}

/// Does `work`, during which an abort becomes an exit with `code`: where memory is short, the system's library aborts a process
/// that starts threads. Nothing must be open yet that an exit would leave behind.
#[cfg(unix)]
pub(super) fn no_abort<T>(code: Code, work: impl FnOnce() -> T) -> T {
    use std::sync::Arc;
    use std::sync::atomic::{AtomicBool, Ordering};
    let working = Arc::new(AtomicBool::new(true));
    let caught =
        signal_hook::flag::register_conditional_shutdown(signal_hook::consts::SIGABRT, code as i32, Arc::clone(&working));
    let done = work();
    working.store(false, Ordering::SeqCst);
    // Uncaught again, or never caught, which is no worse.
    let _ = caught.map(signal_hook::low_level::unregister);
    done
}

/// Does `work`.
#[cfg(not(unix))]
pub(super) fn no_abort<T>(_: Code, work: impl FnOnce() -> T) -> T {
    work()
}

/// Waits for signals.
#[cfg(unix)]
fn attend(mut signals: signal_hook::iterator::Signals) {
    use std::time::{Duration, Instant};
    /// Some senders send twice at once, as `timeout` does to a process and its group. Whoever sends once more after this has
    /// waited, and means it.
    const IMPATIENT: Duration = Duration::from_millis(500);
    let mut first: Option<Instant> = None;
    for signal in signals.forever() {
        let end = move || {
            discard_unfinished();
            std::process::exit(SIGNALLED + signal);
        };
        match first {
            // On a thread of its own: a file system that hangs must not keep a second signal from being heard.
            None if std::thread::Builder::new().spawn(end).is_err() => end(),
            None => first = Some(Instant::now()),
            Some(begun) if begun.elapsed() > IMPATIENT => signal_hook::low_level::exit(SIGNALLED + signal),
            Some(_) => {}
        }
    }
}

/// Signals that were switched off before the program began, as bits; none where the system does not tell.
#[cfg(unix)]
fn ignored() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok()).unwrap_or(0)
}

/// On an interrupt: removes files not yet finished and ends the process.
#[cfg(not(unix))]
pub(super) fn install() -> anyhow::Result<()> {
    /// Number of the interrupt on other systems.
    const INTERRUPT: i32 = 2;
    let end = || {
        discard_unfinished();
        std::process::exit(SIGNALLED + INTERRUPT);
    };
    ctrlc::set_handler(end).context(NOT_INSTALLED)
}
