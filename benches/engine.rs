//! Times of the engine, stage by stage, on lines as they occur. `just bench` prints the table of `docs/performance.md`.
//!
//! Every case runs in a process of its own, so that the peak of memory is its own as well.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use slopegen::model::{Design, Extent, Line, Sheet, Side, Slope};
use slopegen::sheet::{Grid, Heights};
use slopegen::surface::{self, Watch};
use slopegen::{read, validate, write};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::sync::Mutex;
use std::time::{Duration, Instant};

/// Side slope of all cases.
const SLOPE: f64 = 0.5;

const CASES: [(&str, usize); 13] = [
    ("smooth", 1_000),
    ("smooth", 10_000),
    ("smooth", 100_000),
    ("smooth", 1_000_000),
    ("noisy", 1_000),
    ("noisy", 10_000),
    ("noisy", 100_000),
    ("road", 10_000),
    ("road", 1_000_000),
    ("circle", 16_000),
    ("all-of-circle", 16_000),
    ("all-of-waves", 16_000),
    ("raster", 10_000),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    if let [name, count] = &arguments[..] {
        run(name, count.parse().expect("a number of vertices"));
        return;
    }
    println!(
        "milliseconds; slope 1V:2H, tolerance 0.01 (all-of: 0.000001), to 10 below the lowest vertex (circles: inside, 400)"
    );
    println!(
        "{:>14} {:>7} {:>7} {:>7} {:>9} {:>7} {:>7} {:>8} {:>10} {:>7} {:>9} {:>9} {:>6}",
        "case",
        "read",
        "line",
        "index",
        "creases",
        "mesh",
        "certificate",
        "total",
        "triangles",
        "M/s",
        "PLY MB/s",
        "OBJ MB/s",
        "MB"
    );
    let this = std::env::current_exe().expect("own path");
    for (name, count) in CASES {
        let out = std::process::Command::new(&this).args([name, &count.to_string()]).output().expect("a run of one case");
        print!("{}", String::from_utf8_lossy(&out.stdout));
    }
}

/// Whether the slopes of a case lie inside its ring, a circle: all facets meet in the middle.
fn is_inside(name: &str) -> bool {
    ["circle", "all-of-circle", "all-of-waves"].contains(&name)
}

/// The line of a case as a text file.
fn text(name: &str, count: usize) -> String {
    let mut text = String::from("x,y,z\n");
    let inside = is_inside(name);
    let mut row = |x: f64, y: f64, z: f64| {
        let (x, y) = (500_000.0 + x, 5_400_000.0 + y);
        let _ = if inside { writeln!(text, "{x:.6},{y:.6},{z:.6}") } else { writeln!(text, "{x:.4},{y:.4},{z:.4}") };
    };
    if name == "road" {
        let (mut x, mut y, mut z) = (0.0, 0.0, 100.0);
        for i in 0..count {
            row(x, y, z);
            let w = i as f64;
            let direction: f64 = 0.9 * (w / 700.0).sin() + 0.6 * (w / 170.0).sin();
            x += 0.5 * direction.cos();
            y += 0.5 * direction.sin();
            z += 0.025 * (w / 900.0).sin();
        }
        return text;
    }
    let mut state = 1_u64;
    let mut noise = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        0.02 * ((state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0)
    };
    for i in 0..count {
        let w = TAU * i as f64 / count as f64;
        if inside {
            row(500.0 * w.cos(), 500.0 * w.sin(), if name == "all-of-waves" { 100.0 + 12.0 * (w + 0.5).sin() } else { 100.0 });
            continue;
        }
        let waves = (3.0 * w + 0.3).sin() + 0.6 * (5.0 * w + 1.1).sin() + 0.5 * (7.0 * w + 2.9).sin();
        let radius = 500.0 + 40.0 * waves + if name == "noisy" { noise() } else { 0.0 };
        let height = 100.0 + 12.0 * (w + 0.5).sin() + 6.0 * (2.0 * w + 1.0).sin() + 4.0 * (3.0 * w).sin();
        row(radius * w.cos(), radius * w.sin(), height);
    }
    // Closed by repeating the first row.
    let first = text.lines().nth(1).unwrap_or_default().to_owned();
    text + &first + "\n"
}

#[derive(Default)]
struct Stages(Mutex<Vec<(&'static str, Instant)>>);

impl Watch for Stages {
    fn stage(&self, name: &'static str) {
        self.0.lock().expect("no panic while timing").push((name, Instant::now()));
    }
}

fn line(name: &str, count: usize) -> (Line, Duration) {
    let text = text(name, count);
    let start = Instant::now();
    let raw = read::parse_line("bench", text.as_bytes(), &read::ReadOptions::of(read::InputFormat::Csv)).expect("own text");
    let line = validate::check(&raw, &validate::Options::default()).expect("own line").line;
    (line, start.elapsed())
}

fn run(name: &str, count: usize) {
    if name == "raster" {
        return raster(count);
    }
    let (line, read) = line(name, count);
    let design = Design {
        slope: Slope::from_ratio(SLOPE).expect("a slope"),
        sheet: Sheet::Falling,
        side_of_lines: Side::Both,
        side_of_rings: if is_inside(name) { Side::Inside } else { Side::Outside },
        extent: Extent::Elevation(line.elevation_range().0 - if is_inside(name) { 400.0 } else { 10.0 }),
        interval: None,
        // So small that no vertex of a circle is dropped.
        tolerance: if name.starts_with("all-of-") { 1e-6 } else { 0.01 },
        levels: Vec::new(),
        companion: None,
        frame: None,
        joggle: None,
    };
    let stages = Stages::default();
    let start = Instant::now();
    let surface = surface::build(&line, &design, None, &stages).expect("a surface");
    let end = Instant::now();
    let marks = stages.0.lock().expect("no panic while timing");
    let stage = |wanted: &[&str]| -> Duration {
        let ends = marks.iter().skip(1).map(|m| m.1).chain([end]);
        marks.iter().zip(ends).filter(|(m, _)| wanted.contains(&m.0)).map(|(m, end)| end - m.1).sum()
    };
    let rate = |write: &dyn Fn(&mut Vec<u8>)| {
        let mut bytes = Vec::new();
        let start = Instant::now();
        write(&mut bytes);
        bytes.len() as f64 / 1e6 / start.elapsed().as_secs_f64()
    };
    let memory = peak_memory();
    let ms = |d: Duration| format!("{:.1}", 1e3 * d.as_secs_f64());
    let triangles = surface.tin.triangles.len();
    println!(
        "{:>14} {:>7} {:>7} {:>7} {:>9} {:>7} {:>7} {:>8} {:>10} {:>7.2} {:>9.0} {:>9.0} {:>6.0}",
        format!("{name} {count}"),
        ms(read),
        ms(stage(&["line"])),
        ms(stage(&["index"])),
        ms(stage(&["creases"])),
        ms(stage(&["mesh"])),
        ms(stage(&["certificate", "volumes"])),
        ms(end - start),
        triangles,
        triangles as f64 / (end - start).as_secs_f64() / 1e6,
        rate(&|bytes| write::write_ply(bytes, &surface.tin, &write::Head::default()).expect("memory")),
        rate(&|bytes| write::write_obj(bytes, &surface.tin, &write::Head::default()).expect("memory")),
        memory
    );
}

/// `slopegen sample --raster` on a ring: a million exact heights.
fn raster(count: usize) {
    let (line, _) = line("smooth", count);
    let start = Instant::now();
    let heights = Heights::new(&line, Slope::from_ratio(SLOPE).expect("a slope"), Sheet::Falling);
    let values = heights.raster(&Grid { xll: 499_000.0, yll: 5_399_000.0, cell: 2.0, ncols: 1001, nrows: 1001 });
    println!("{:>14} {} heights in {:.1} ms", format!("raster {count}"), values.len(), 1e3 * start.elapsed().as_secs_f64());
}

/// Peak of resident memory in megabytes, where the system tells.
fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse::<f64>().ok());
    peak.map_or(f64::NAN, |kilobytes| kilobytes / 1e3)
}
