//! The command line from outside: the program is run as people run it.

mod agree;
mod batch;
mod build;
mod check;
mod colours;
#[path = "../common/mod.rs"]
mod common;
mod diff;
mod formats;
mod generate;
mod golden;
mod ground;
mod help;
mod info;
mod job_file;
mod landxml;
mod messages;
mod plots;
mod sample;
mod selftest;
mod streams;
#[cfg(unix)]
mod unix;
mod verify;
mod volume;

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;
use tempfile::TempDir;

/// Longer than any job here takes on a slow machine; a hang fails the test instead of holding it up.
const PATIENCE: Duration = Duration::from_secs(120);

/// Whether this process was started with SIGINT ignored, as in the background of a shell without job control: what it starts ignores
/// it as well, as it should, and cannot be interrupted. Says so.
#[cfg(unix)]
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn interrupts_are_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask =
        status.lines().find_map(|line| line.strip_prefix("SigIgn:")).and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    // SIGINT is 2, the second bit.
    let ignored = mask.is_some_and(|mask| mask & 2 != 0);
    if ignored {
        eprintln!("SKIPPED: SIGINT is ignored here, and interrupts are not tested");
    }
    ignored
}

/// A working folder with the shipped examples in it.
struct Site {
    folder: TempDir,
}

/// How a run ended.
#[derive(Debug)]
struct Run {
    code: i32,
    stdout: String,
    stderr: String,
}

/// A site with the shipped example on existing ground, too.
fn on_ground() -> Site {
    let site = Site::new();
    for name in ["hill_road.geojson", "ground.obj"] {
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name), site.path(name)).unwrap();
    }
    site
}

impl Site {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        for name in ["road.geojson", "pad.geojson", "pit.csv"] {
            fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name), folder.path().join(name)).unwrap();
        }
        Self { folder }
    }

    /// A site with one more file.
    fn with(name: &str, content: impl AsRef<[u8]>) -> Self {
        let site = Self::new();
        fs::write(site.path(name), content).unwrap();
        site
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Names of the files that have appeared.
    fn new_files(&self) -> Vec<String> {
        let mut names: Vec<String> =
            fs::read_dir(self.folder.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.retain(|name| !["road.geojson", "pad.geojson", "pit.csv"].contains(&name.as_str()));
        names.sort();
        names
    }

    fn run_with(&self, arguments: &str, stdin: impl Into<Vec<u8>>) -> Run {
        self.run_args(&arguments.split_whitespace().collect::<Vec<_>>(), stdin)
    }

    fn run(&self, arguments: &str) -> Run {
        self.run_with(arguments, "")
    }

    fn run_args(&self, arguments: &[&str], stdin: impl Into<Vec<u8>>) -> Run {
        let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
            .args(arguments)
            .current_dir(self.folder.path())
            .env("NO_COLOR", "1")
            .write_stdin(stdin)
            .timeout(PATIENCE)
            .output()
            .unwrap();
        common::schema::check_folder(self.folder.path());
        Run {
            code: output.status.code().unwrap_or(-1),
            stdout: String::from_utf8_lossy(&output.stdout).into_owned(),
            stderr: String::from_utf8_lossy(&output.stderr).into_owned(),
        }
    }
}

impl Run {
    /// The run has ended well; gives standard output.
    #[track_caller]
    fn done(&self) -> &str {
        assert_eq!(self.code, 0, "{}", self.stderr);
        assert!(!self.stderr.contains("error"), "{}", self.stderr);
        &self.stdout
    }

    /// The run has ended with this code and, but for notes, this on standard error, and nothing on standard output.
    #[track_caller]
    fn refused(&self, code: i32, message: &str) {
        let errors: Vec<&str> = self.stderr.lines().filter(|l| !l.starts_with("note[") && !l.starts_with("warning[")).collect();
        assert_eq!(errors.join("\n"), message.trim_end());
        assert_eq!(self.code, code, "{}", self.stderr);
        assert_eq!(self.stdout, "");
    }
}
