//! Volumes between two meshes: time, memory and error of `overlay::between`. `just bench` prints the table of
//! `docs/performance.md`.
//!
//! Every case runs in a process of its own, so that the peak of memory is its own as well.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use glam::DVec2;
use slopegen::kernel::frame::Frame;
use slopegen::model::{Part, Terrain, Tin};
use slopegen::overlay::{Between, between};
use slopegen::write::{Head, write_ply};
use spade::{DelaunayTriangulation, Point2, Triangulation as _};
use std::time::Instant;

/// Side of the square all meshes cover.
const SIDE: f64 = 2000.0;
/// World coordinates of its south-west corner in the cases far from the origin: multiples of all units in the last place that
/// occur, so that nothing is rounded.
const FAR: DVec2 = DVec2::new(524_288.0, 5_242_880.0);

const CASES: [(&str, usize); 9] = [
    ("rough", 50_000),
    ("rough", 500_000),
    ("rough-far", 500_000),
    ("noise", 500_000),
    ("wedge", 500_000),
    ("wedge-far", 500_000),
    ("same", 500_000),
    ("giants", 500_000),
    ("slivers", 50_000),
];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    if let [design, existing, report] = &arguments[..] {
        return program([design, existing, report]);
    }
    if let [name, count] = &arguments[..] {
        run(name, count.parse().expect("a number of vertices"));
        return;
    }
    println!(
        "{:>16} {:>10} {:>10} {:>8} {:>8} {:>8} {:>20} {:>20}",
        "case", "triangles", "cells", "CPU s", "wall s", "MB", "cut", "fill"
    );
    let this = std::env::current_exe().expect("own path");
    for (name, count) in CASES {
        let out = std::process::Command::new(&this).args([name, &count.to_string()]).output().expect("a run of one case");
        print!("{}", String::from_utf8_lossy(&out.stdout));
    }
    for name in ["rough", "rough-far", "noise"] {
        let folder = tempfile::tempdir().expect("a folder");
        let (a, b) = pair(name, 500_000);
        let paths = ["a.ply", "b.ply", "report.json"].map(|file| folder.path().join(file));
        for (mesh, path) in [a, b].into_iter().zip(&paths) {
            let parts = vec![Part::Ground; mesh.triangles.len()];
            let tin = Tin { frame: mesh.frame, vertices: mesh.vertices, triangles: mesh.triangles, parts };
            write_ply(&mut std::fs::File::create(path).expect("a file"), &tin, &Head::default()).expect("a mesh");
        }
        let out = std::process::Command::new(&this).args(&paths).output().expect("a run of the program");
        print!("{:>16}, whole program: {}", name, String::from_utf8_lossy(&out.stdout));
    }
}

/// `slopegen volume` on two files: the whole process, its reading included.
fn program([design, existing, report]: [&String; 3]) {
    let start = Instant::now();
    let arguments = ["slopegen", "volume", design, existing, "--quiet", "--report", report];
    let code = slopegen::cli::run(arguments.into_iter().map(Into::into));
    assert_eq!(code, std::process::ExitCode::SUCCESS);
    let report = std::fs::read_to_string(report).expect("a report");
    let report: serde_json::Value = serde_json::from_str(&report).expect("JSON");
    println!(
        "CPU {:.2} s, wall {:.2} s, {:.0} MB; timing {}",
        cpu(),
        start.elapsed().as_secs_f64(),
        peak_memory(),
        report["timing"]
    );
}

/// Pseudo-random numbers in [0, 1), the same on every machine.
struct Random(u64);

impl Random {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Random points of the square with its corners, triangulated; heights by `z`. Coordinates are multiples of 2⁻²⁰.
fn mesh(count: usize, seed: u64, place: impl Fn(f64, f64) -> DVec2, z: impl Fn(DVec2) -> f64) -> Terrain {
    let mut random = Random(seed);
    for _ in 0..8 {
        random.next();
    }
    let grid = |v: f64| (v * 1_048_576.0).round() / 1_048_576.0;
    let corners = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0), (1.0, 1.0)].map(|(u, v)| DVec2::new(u, v) * SIDE);
    let points: Vec<Point2<f64>> = corners
        .into_iter()
        .chain((4..count).map(|_| place(random.next(), random.next()) * SIDE))
        .map(|p| Point2::new(grid(p.x), grid(p.y)))
        .collect();
    let triangulation = DelaunayTriangulation::<Point2<f64>>::bulk_load(points).expect("finite points");
    let vertices = triangulation.vertices().map(|v| v.position()).map(|p| DVec2::new(p.x, p.y)).map(|p| p.extend(z(p))).collect();
    let triangles = triangulation.inner_faces().map(|f| f.vertices().map(|v| v.index() as u32)).collect();
    Terrain { frame: Frame::WORLD, vertices, triangles }
}

fn even(u: f64, v: f64) -> DVec2 {
    DVec2::new(u, v)
}

/// Hills of several sizes.
fn hills(p: DVec2, phase: f64) -> f64 {
    let wave = |length: f64, height: f64| height * (p.x / length + phase).sin() * (p.y / length - 0.7 * phase).cos();
    100.0 + wave(200.0, 30.0) + wave(70.0, 8.0) + wave(21.0, 2.0) + wave(6.0, 0.5)
}

fn moved(mut mesh: Terrain, by: DVec2) -> Terrain {
    let lo = by;
    mesh.vertices.iter_mut().for_each(|v| *v += by.extend(0.0));
    let frame = Frame::around(lo, lo + SIDE);
    mesh.frame = frame;
    mesh.vertices.iter_mut().for_each(|v| *v = frame.to_local(*v));
    mesh
}

fn pair(name: &str, count: usize) -> (Terrain, Terrain) {
    let plane = |p: DVec2| 100.0 + 0.01 * p.x - 0.02 * p.y;
    let (a, b) = match name.trim_end_matches("-far") {
        "rough" => (mesh(count, 1, even, |p| hills(p, 0.0)), mesh(count, 2, even, |p| hills(p, 1.3))),
        // Two surveys of the same hills: the sign changes in nearly every triangle.
        "noise" => {
            let noise = |p: DVec2| 0.05 * ((p.x * 12.9898 + p.y * 78.233).sin() * 43_758.545).fract();
            (mesh(count, 1, even, |p| hills(p, 0.0) + noise(p)), mesh(count, 2, even, |p| hills(p, 0.0) + noise(p)))
        }
        "wedge" => (mesh(count, 1, even, |_| 100.0), mesh(count, 2, even, |p| 100.0 + (p.x - 500.0) / 16.0)),
        "same" => (mesh(count, 1, even, |p| hills(p, 0.0)), mesh(count, 1, even, |p| hills(p, 0.0))),
        // Two triangles over all the others, which crowd in a corner.
        "giants" => {
            let crowd = |u: f64, v: f64| DVec2::new(u, v) * u.powi(6);
            (mesh(4, 1, even, plane), mesh(count, 2, crowd, |p| hills(p, 0.0)))
        }
        // Long strips along a diagonal, as far as points on two lines give them.
        "slivers" => {
            let strip = |u: f64, v: f64| {
                if v < 0.5 { DVec2::new(0.4 * u, 0.4 - 0.4 * u) } else { DVec2::new(0.6 + 0.4 * u, 1.0 - 0.4 * u) }
            };
            (mesh(count / 10, 1, strip, plane), mesh(count, 2, even, |p| hills(p, 0.0)))
        }
        other => panic!("no case {other}"),
    };
    if name.ends_with("-far") { (moved(a, FAR), moved(b, FAR)) } else { (a, b) }
}

/// Seconds of processor time this process has used, where the system tells.
fn cpu() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(") ").next().unwrap_or("").split(' ').collect();
    let ticks = |i: usize| fields.get(i).and_then(|f| f.parse::<f64>().ok()).unwrap_or(f64::NAN);
    (ticks(11) + ticks(12)) / 100.0
}

fn run(name: &str, count: usize) {
    let (a, b) = pair(name, count);
    let (before, start) = (cpu(), Instant::now());
    let found = between(&a, &b, None).expect("two meshes over each other");
    let (wall, used) = (start.elapsed().as_secs_f64(), cpu() - before);
    println!(
        "{:>16} {:>10} {:>10} {used:>8.2} {wall:>8.3} {:>8.0} {:>20.6} {:>20.6} {}",
        format!("{name} {count}"),
        a.triangles.len() + b.triangles.len(),
        found.cells,
        peak_memory(),
        found.cut,
        found.fill,
        error(name, &found)
    );
}

/// Relative error against the closed form, where there is one.
fn error(name: &str, found: &Between) -> String {
    if !name.starts_with("wedge") {
        return String::new();
    }
    // The existing plane rises by 1/16 from x = 500: the design of height 100 is above it before, below it beyond.
    let (before, beyond) = (500.0_f64, SIDE - 500.0);
    let fill = SIDE * before * before / 32.0;
    let cut = SIDE * beyond * beyond / 32.0;
    format!("error {:.1e}, {:.1e}", found.cut / cut - 1.0, found.fill / fill - 1.0)
}

/// Peak of resident memory in megabytes, where the system tells.
fn peak_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|l| l.strip_prefix("VmHWM:")?.split_whitespace().next()?.parse::<f64>().ok());
    peak.map_or(f64::NAN, |kilobytes| kilobytes / 1e3)
}
