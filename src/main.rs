//! The `slopegen` program: parse, run, report, exit code.

fn main() {}
