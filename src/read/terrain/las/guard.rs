//! Calls into the unpacker, which may panic on damaged files.

use std::cell::Cell;
use std::panic::{UnwindSafe, catch_unwind, set_hook, take_hook};
use std::sync::Once;

thread_local! {
    /// Whether a panic of this thread is expected, and not to be told.
    static QUIET: Cell<bool> = const { Cell::new(false) };
}

static HOOK: Once = Once::new();

/// What `work` returns, or `None` if it panicked.
///
/// The arithmetic decoder of `laz` trusts its input: damaged bytes lead it to table rows that are not there and to divisions by
/// nought, and no check of ours could tell such bytes from sound ones without decoding them. Everything that can be checked
/// before (sizes, counts, layers) is. What panics in here has borrowed the bytes and owns the rest: nothing is left half done.
/// Panics of other threads are told as ever.
pub(super) fn guarded<T>(work: impl FnOnce() -> T + UnwindSafe) -> Option<T> {
    HOOK.call_once(|| {
        let before = take_hook();
        set_hook(Box::new(move |info| {
            if !QUIET.get() {
                before(info);
            }
        }));
    });
    let outer = QUIET.replace(true);
    let result = catch_unwind(work);
    QUIET.set(outer);
    result.ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_ends_here() {
        let nothing: [u8; 0] = [];
        assert_eq!(guarded(|| nothing.iter().position(|_| true).map_or(7, |i| i)), Some(7));
        let index = std::hint::black_box(3);
        assert_eq!(guarded(|| nothing[index]), None);
        assert!(!QUIET.get());
    }
}
