//! The `slopegen` program: parse, run, report, exit code.

mod heap;

use std::process::ExitCode;

/// Running out of memory ends in a message.
#[global_allocator]
static HEAP: heap::Heap = heap::Heap;

fn main() -> ExitCode {
    slopegen::cli::run(std::env::args_os())
}
