//! Refusals that are limits of the program and not of what was asked for.

use std::cell::Cell;
use std::fs;
use std::hash::{DefaultHasher, Hash as _, Hasher as _};
use std::path::Path;

/// Name of a folder in the environment that the inputs are kept in, by kind.
const FOLDER: &str = "SLOPEGEN_FUZZ_LIMITS";

thread_local! {
    static NOTED: Cell<usize> = const { Cell::new(0) };
}

/// How many were noted on this thread.
#[allow(dead_code, reason = "asked by the tests, not by the fuzzers")]
pub(crate) fn noted() -> usize {
    NOTED.get()
}

/// Notes a limit: they are known, rare, and no reason to stop. `case` shows it with the program itself.
pub(crate) fn note(kind: &str, bytes: &[u8], case: &str) {
    NOTED.set(NOTED.get() + 1);
    let Some(folder) = std::env::var_os(FOLDER) else { return };
    let folder = Path::new(&folder).join(kind);
    let mut hasher = DefaultHasher::new();
    bytes.hash(&mut hasher);
    let name = folder.join(format!("{:016x}", hasher.finish()));
    fs::create_dir_all(&folder).expect("the folder can be made");
    fs::write(&name, bytes).expect("the folder can be written to");
    fs::write(name.with_extension("txt"), case).expect("the folder can be written to");
}

/// Shows a case before it is run, where the environment asks for it.
pub(crate) fn show(case: &dyn Fn() -> String) {
    if std::env::var_os("SLOPEGEN_FUZZ_SHOW").is_some() {
        eprintln!("{}", case());
    }
}
