//! The files under `fixtures/fuzz`, each through its fuzz target: what fuzzers went through once, and what they found.

#![allow(clippy::print_stderr, clippy::print_stdout, reason = "tells which file, and what it is, when one fails")]

#[path = "fuzz/src/targets/mod.rs"]
mod targets;

use std::path::{Path, PathBuf};

fn files(folder: &Path) -> Vec<PathBuf> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    files
}

/// A panic inside tells the file by the line printed before. Files whose names begin with `limit_` show known limits of the program,
/// others have none.
#[test]
fn every_file_passes() {
    let root = Path::new("fixtures/fuzz");
    for (name, target) in targets::TARGETS {
        let files = files(&root.join(name));
        assert!(!files.is_empty(), "`{name}` has no files");
        for file in files {
            println!("{}", file.display());
            let before = targets::limits::noted();
            target(&std::fs::read(&file).unwrap());
            let limited = targets::limits::noted() > before;
            let known = file.file_name().is_some_and(|name| name.to_string_lossy().starts_with("limit_"));
            assert_eq!(limited, known, "{}", file.display());
        }
    }
    let known = |folder: &PathBuf| targets::TARGETS.iter().any(|(name, _)| folder.ends_with(name));
    assert!(files(root).iter().all(known), "a folder belongs to no target");
}

/// Every target has its program for the fuzzer.
#[test]
fn every_target_has_a_program() {
    let manifest = std::fs::read_to_string("tests/fuzz/Cargo.toml").unwrap();
    for (name, _) in targets::TARGETS {
        let program = std::fs::read_to_string(format!("tests/fuzz/fuzz_targets/{name}.rs")).unwrap();
        assert!(program.contains(&format!("run(\"{name}\", bytes)")), "{name}");
        assert!(manifest.contains(&format!("path = \"fuzz_targets/{name}.rs\"")), "{name}");
    }
}
