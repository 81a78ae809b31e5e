//! Writes the hashes that `slopegen selftest` expects of this version: `cargo run --example selftest_hashes`, on x86_64 Linux
//! with glibc.

use slopegen::selftest;
use std::path::Path;

fn main() -> std::io::Result<()> {
    let report = selftest::run(&selftest::cases::all(), |_, _| ());
    let lines: String = report.hashes.iter().map(|hash| format!("{} {}\n", hash.of, hash.sha256)).collect();
    std::fs::write(Path::new(env!("CARGO_MANIFEST_DIR")).join("src/selftest/hashes.txt"), lines)
}
