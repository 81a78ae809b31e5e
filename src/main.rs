//! The `slopegen` program: parse, run, report, exit code.

use std::process::ExitCode;

fn main() -> ExitCode {
    slopegen::cli::run(std::env::args_os())
}
