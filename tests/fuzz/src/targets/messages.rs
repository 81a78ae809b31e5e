//! What every refusal must say.

/// Longest message: twenty defects of each kind are listed, with names of limited length.
const LONGEST: usize = 100_000;

/// Checks that a message has the place and the cure. Control characters of a file may stand in it: the console replaces them.
#[track_caller]
pub(crate) fn telling(message: &str) {
    assert!(message.contains("\n  --> "), "no place: {message}");
    assert!(message.contains("\n   = help: "), "no cure: {message}");
    assert!(message.len() < LONGEST, "a message of {} bytes", message.len());
}
