//! Interrupts and resources: whatever ends a run early, the outputs of a job are all there or none, and the exit code says why.
#![cfg(unix)]
#![allow(clippy::print_stderr, reason = "tells what was skipped")]

mod disk;
mod interrupts;
mod memory;
mod threads;

use std::fmt::Write as _;
use std::fs;
use std::os::unix::process::ExitStatusExt as _;
use std::path::PathBuf;
use std::process::{Command, ExitStatus, Stdio};
use std::time::Duration;
use tempfile::TempDir;

/// Longer than any job here takes on a slow machine.
const PATIENCE: Duration = Duration::from_secs(120);

/// The inputs of a site.
const INPUTS: [&str; 3] = ["ground.ply", "road.csv", "ring.csv"];

/// A working folder with rolling ground, a road on it and a ring.
struct Site {
    folder: TempDir,
}

/// How a run ended.
#[derive(Debug)]
struct Run {
    status: ExitStatus,
    stdout: String,
    stderr: String,
}

impl Site {
    /// Ground of `n` × `n` vertices, 2 apart.
    fn new(n: u32) -> Self {
        let site = Self { folder: tempfile::tempdir().unwrap() };
        let height = |x: f64, y: f64| 100.0 + 3.0 * (x / 31.0).sin() + 2.0 * (y / 23.0).cos();
        let mut bytes = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
             element face {}\nproperty list uchar int vertex_indices\nend_header\n",
            n * n,
            2 * (n - 1) * (n - 1)
        )
        .into_bytes();
        for (i, j) in (0..n * n).map(|v| (f64::from(v % n), f64::from(v / n))) {
            let (x, y) = (2.0 * i, 2.0 * j);
            [1000.0 + x, 2000.0 + y, height(x, y)].iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        }
        for c in 0..(n - 1) * (n - 1) {
            let a = c / (n - 1) * n + c % (n - 1);
            for t in [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]] {
                bytes.push(3);
                t.iter().for_each(|v| bytes.extend(v.to_le_bytes()));
            }
        }
        fs::write(site.path("ground.ply"), bytes).unwrap();
        let size = 2.0 * f64::from(n - 1);
        let mut road = String::from("x,y,z\n");
        for i in 0..=20 {
            let t = f64::from(i) / 20.0;
            let (x, y) = (size * (0.3 + 0.4 * t), size * (0.5 + 0.05 * (6.0 * t).sin()));
            let _ = writeln!(road, "{},{},{}", 1000.0 + x, 2000.0 + y, height(x, y) + 0.01 * size * (9.0 * t).sin());
        }
        fs::write(site.path("road.csv"), road).unwrap();
        let mut ring = String::from("x,y,z\n");
        for i in 0..200 {
            let a = f64::from(i) * std::f64::consts::TAU / 200.0;
            let _ = writeln!(ring, "{},{},{}", 30.0 * a.cos(), 20.0 * a.sin(), 10.0 + (2.0 * a).sin());
        }
        fs::write(site.path("ring.csv"), ring).unwrap();
        site
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Names of all files but the inputs, hidden ones too.
    fn files(&self) -> Vec<String> {
        let entries = fs::read_dir(self.folder.path()).unwrap();
        let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
        names.retain(|name| !INPUTS.contains(&name.as_str()));
        names.sort();
        names
    }

    fn clear(&self) {
        self.files().iter().for_each(|name| fs::remove_file(self.path(name)).unwrap());
    }

    /// The program in the folder.
    fn program(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_slopegen"));
        command.args(arguments.split_whitespace());
        self.here(command)
    }

    /// The program behind a line of shell, such as `ulimit -f 1`.
    fn behind(&self, shell: &str, arguments: &str) -> Command {
        let mut command = Command::new("bash");
        command.args(["-c", &format!("{shell}; exec {} {arguments}", env!("CARGO_BIN_EXE_slopegen"))]);
        self.here(command)
    }

    fn here(&self, mut command: Command) -> Command {
        command.current_dir(self.folder.path()).stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
        command
    }

    fn run(&self, arguments: &str) -> Run {
        Run::of(self.program(arguments))
    }
}

impl Run {
    fn of(mut command: Command) -> Self {
        let output = command.output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8_lossy(&bytes).into_owned();
        Self { status: output.status, stdout: text(output.stdout), stderr: text(output.stderr) }
    }

    /// The exit code; a signal fails the test.
    #[track_caller]
    fn code(&self) -> i32 {
        assert_eq!(self.status.signal(), None, "{self:?}");
        assert!(!self.stderr.contains("panicked"), "{self:?}");
        self.status.code().unwrap()
    }
}
