//! Roads on large ground: time and memory of `slopegen build --terrain`. `just bench` prints the table of `docs/performance.md`.
//!
//! Every run is a process of its own, so that processor time and peak of memory are its own as well. Reading is measured in
//! processes that do nothing else, and taken off.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use slopegen::read::terrain::{TerrainOptions, read_terrain};
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

/// Side of the square of ground, and its lower left corner.
const SIDE: f64 = 2000.0;
const CORNER: [f64; 2] = [500_000.0, 5_200_000.0];

/// Vertices of the road.
const ROAD: usize = 1000;

/// Runs of each case; the system counts processor time in steps of 10 ms.
const RUNS: usize = 5;

const CASES: [(&str, usize, &[&str]); 4] = [
    ("line", 1000, &[]),
    ("road 8 wide, stations", 1000, &["--width", "8", "--stations", "20"]),
    ("line, finished ground", 1000, &["--finished", "finished.ply"]),
    ("line, finished ground", 2000, &["--finished", "finished.ply"]),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    match arguments.first().map(String::as_str) {
        Some("read") => {
            let ground = read_terrain(Path::new(&arguments[1]), &TerrainOptions::default()).expect("sound ground");
            println!("{} {}", cpu(), ground.notes.len());
        }
        Some("build") => {
            let code = slopegen::cli::run(std::iter::once("slopegen".to_owned()).chain(arguments).map(Into::into));
            assert_eq!(code, std::process::ExitCode::SUCCESS);
            println!("{} {}", cpu(), peak_memory());
        }
        _ => table(),
    }
}

fn table() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |file: &str| folder.path().join(file).to_string_lossy().into_owned();
    std::fs::write(path("road.csv"), road()).expect("a road");
    println!("{:>24} {:>10} {:>8} {:>8} {:>8}  stages on one thread, s", "case", "triangles", "read", "after", "MB");
    let mut written = 0;
    for (name, side, more) in CASES {
        if written != side {
            std::fs::write(path("ground.ply"), ground(side)).expect("a ground");
            written = side;
        }
        let read = mean(|| run(&["read", &path("ground.ply")]).0[0]);
        let (line, terrain, design, report) = (path("road.csv"), path("ground.ply"), path("design.ply"), path("report.json"));
        let mut job = vec!["build", &line, "--slope", "1:1.5", "--cut-slope", "1:1", "--terrain", &terrain];
        job.extend(["-o", &design, "--report", &report]);
        let more: Vec<String> = more.iter().map(|a| if a.ends_with(".ply") { path(a) } else { (*a).to_owned() }).collect();
        job.extend(more.iter().map(String::as_str));
        let mut peak = 0.0;
        let whole = mean(|| {
            let ([cpu, memory], _) = run(&[&job[..], &["--quiet"]].concat());
            peak = memory;
            cpu
        });
        let (_, told) = run(&[&job[..], &["--verbose", "--threads", "1"]].concat());
        let count = 2 * (side - 1) * (side - 1);
        println!("{name:>24} {count:>10} {read:>8.3} {:>8.3} {peak:>8.0}  {}", whole - read, stages(&told));
    }
}

fn mean(run: impl FnMut() -> f64) -> f64 {
    std::iter::repeat_with(run).take(RUNS).sum::<f64>() / RUNS as f64
}

/// Runs this program again: the two numbers it prints, and what it says besides.
fn run(arguments: &[&str]) -> ([f64; 2], String) {
    let out = Command::new(std::env::current_exe().expect("own path")).args(arguments).output().expect("a run");
    let (said, told) = (String::from_utf8_lossy(&out.stdout), String::from_utf8_lossy(&out.stderr));
    let last = said.lines().last().unwrap_or_else(|| panic!("no result: {told}"));
    let mut numbers = last.split(' ').map(|n| n.parse().expect("a number"));
    ([numbers.next(), numbers.next()].map(|n| n.expect("two numbers")), told.into_owned())
}

/// Sums of the times by stage, in the order of their first appearance, from lines such as `0.012 s  mesh`.
fn stages(told: &str) -> String {
    let mut sums: Vec<(&str, f64)> = Vec::new();
    for (time, stage) in told.lines().filter_map(|line| line.trim().split_once(" s  ")) {
        let Ok(time) = time.parse::<f64>() else { continue };
        match sums.iter_mut().find(|(name, _)| *name == stage) {
            Some((_, sum)) => *sum += time,
            None => sums.push((stage, time)),
        }
    }
    let mut text = String::new();
    for (stage, time) in sums.iter().filter(|(_, time)| *time >= 0.001) {
        let _ = write!(text, "{stage} {time:.3}; ");
    }
    text
}

/// Rolling ground with bumps of all sizes.
fn height(x: f64, y: f64) -> f64 {
    100.0
        + 20.0 * (x / 230.0 + 0.3).sin() * (y / 190.0).cos()
        + 8.0 * (x / 70.0 + y / 90.0).sin()
        + 1.5 * (x / 17.0).sin() * (y / 19.0).sin()
        + 0.2 * (x / 3.1 + y / 2.7).sin()
}

/// A binary PLY file of `n` by `n` vertices, each moved by up to a fifth of a step.
fn ground(n: usize) -> Vec<u8> {
    let step = SIDE / (n - 1) as f64;
    let mut state = 7_u64;
    let mut jitter = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        0.4 * ((state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5)
    };
    let (vertices, faces) = (n * n, 2 * (n - 1) * (n - 1));
    let mut bytes = format!(
        "ply\nformat binary_little_endian 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double \
         z\nelement face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    .into_bytes();
    for i in 0..vertices {
        let inner = |k: usize| if k == 0 || k == n - 1 { 0.0 } else { 1.0 };
        let (x, y) = ((i % n) as f64 + inner(i % n) * jitter(), (i / n) as f64 + inner(i / n) * jitter());
        let (x, y) = (step * x, step * y);
        for value in [x + CORNER[0], y + CORNER[1], height(x, y)] {
            bytes.extend(value.to_le_bytes());
        }
    }
    for i in 0..(n - 1) * (n - 1) {
        let a = i / (n - 1) * n + i % (n - 1);
        for t in [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]] {
            bytes.push(3);
            t.into_iter().for_each(|v| bytes.extend((v as u32).to_le_bytes()));
        }
    }
    bytes
}

/// A winding road from west to east, at the mean height of the ground over a sixth of its length.
fn road() -> String {
    let place = |i: usize| {
        let x = 150.0 + 1700.0 * i as f64 / (ROAD - 1) as f64;
        [x, 1000.0 + 350.0 * (x / 260.0).sin() + 60.0 * (x / 90.0).sin()]
    };
    let mut text = "x,y,z\n".to_owned();
    for i in 0..ROAD {
        let near = (0..161).map(|k| place((i + k).saturating_sub(80).min(ROAD - 1)));
        let mean = near.map(|[x, y]| height(x, y)).sum::<f64>() / 161.0;
        let [x, y] = place(i);
        let _ = writeln!(text, "{:.4},{:.4},{mean:.4}", x + CORNER[0], y + CORNER[1]);
    }
    text
}

/// Seconds of processor time this process has used, where the system tells.
fn cpu() -> f64 {
    /// Clock ticks in a second, the same on all Linux systems in use.
    const TICKS: f64 = 100.0;
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let after = stat.rsplit(") ").next().unwrap_or("");
    after.split(' ').skip(11).take(2).filter_map(|n| n.parse::<f64>().ok()).sum::<f64>() / TICKS
}

/// Peak of resident memory in megabytes, where the system tells.
fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok()).map_or(f64::NAN, |kb| kb / 1e3)
}
