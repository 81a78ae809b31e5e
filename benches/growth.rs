//! How processor time grows: one line `panel/name n seconds` for each case, for `cargo run --example growth` to draw.
//!
//! `just growth` draws `docs/growth.svg` from it. Every case runs in a process of its own, several times where it is short, and
//! the shortest run counts. Seconds are those of all threads together, so that they do not depend on the number of cores.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use glam::DVec3;
use slopegen::kernel::frame::Frame;
use slopegen::model::{Design, Extent, Part, Sheet, Side, Slope, Terrain, Tin};
use slopegen::read::terrain::{TerrainOptions, read_terrain};
use slopegen::write::{Head, MeshFormat};
use slopegen::{overlay, read, surface, validate};
use std::f64::consts::TAU;
use std::fmt::Write as _;
use std::path::Path;
use std::process::Command;

/// Cases and their sizes: vertices of the line, or of the ground.
const CASES: [(&str, &[usize]); 10] = [
    ("engine/smooth ring", &[1_000, 4_000, 16_000, 64_000, 256_000, 1_000_000]),
    ("engine/noisy ring", &[1_000, 4_000, 16_000, 64_000, 128_000]),
    ("engine/road", &[1_000, 4_000, 16_000, 64_000, 256_000, 1_000_000]),
    ("engine/inside of a circle", &[1_000, 4_000, 16_000]),
    ("ground and files/road on ground, finished", &[10_000, 40_000, 160_000, 640_000, 2_560_000]),
    ("ground and files/volumes between two", &[10_000, 40_000, 160_000, 640_000, 2_560_000]),
    ("ground and files/reading OBJ", &[10_000, 40_000, 160_000, 640_000, 2_560_000]),
    ("ground and files/reading PLY", &[10_000, 40_000, 160_000, 640_000, 2_560_000]),
    ("ground and files/writing OBJ", &[10_000, 40_000, 160_000, 640_000, 2_560_000]),
    ("ground and files/writing PLY", &[10_000, 40_000, 160_000, 640_000, 2_560_000]),
];

/// Seconds after which a case is not run once more.
const ENOUGH: f64 = 0.5;

/// Most runs of a case.
const RUNS: usize = 5;

/// Step of the grid that ground is made of, and its south-west corner.
const STEP: f64 = 2.0;
const CORNER: [f64; 2] = [500_000.0, 5_200_000.0];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    if let [name, count] = &arguments[..] {
        println!("{}", run(name, count.parse().expect("a number of vertices")));
        return;
    }
    let this = std::env::current_exe().expect("own path");
    for (name, counts) in CASES {
        for count in counts {
            let (mut best, mut spent, mut runs) = (f64::INFINITY, 0.0, 0);
            while spent < ENOUGH && runs < RUNS {
                let out = Command::new(&this).args([name, &count.to_string()]).output().expect("a run of one case");
                let said = String::from_utf8_lossy(&out.stdout);
                let told = String::from_utf8_lossy(&out.stderr);
                let seconds: f64 = said.trim().parse().unwrap_or_else(|_| panic!("no result of {name} {count}: {told}"));
                (best, spent, runs) = (seconds.min(best), spent + seconds, runs + 1);
            }
            println!("{name} {count} {best:.6}");
        }
    }
}

fn run(name: &str, count: usize) -> f64 {
    match name.split_once('/').expect("panel/name") {
        ("engine", shape) => engine(shape, count),
        (_, "road on ground, finished") => on_ground(count),
        (_, "volumes between two") => {
            let (a, b) = (ground(count, 0.0), ground(count, 0.37));
            timed(|| overlay::between(&a, &b, None).expect("two meshes over each other"))
        }
        (_, job) => {
            let (verb, format) = job.split_once(' ').expect("reading or writing of a format");
            let format = if format == "OBJ" { MeshFormat::Obj } else { MeshFormat::Ply };
            let folder = tempfile::tempdir().expect("a folder");
            let path = folder.path().join(if format == MeshFormat::Obj { "ground.obj" } else { "ground.ply" });
            let writing = write(&ground(count, 0.0), format, &path);
            if verb == "writing" {
                return writing;
            }
            timed(|| read_terrain(&path, &TerrainOptions::default()).expect("own ground"))
        }
    }
}

/// The surface of a line, from the checked line on.
fn engine(shape: &str, count: usize) -> f64 {
    let inside = shape == "inside of a circle";
    let text = line(shape, count);
    let options = read::ReadOptions::of(read::InputFormat::Csv);
    let raw = read::parse_line("growth", text.as_bytes(), &options).expect("own text");
    let line = validate::check(&raw, &validate::Options::default()).expect("own line").line;
    let (low, high) = line.elevation_range();
    let design = Design {
        slope: Slope::from_ratio(0.5).expect("a slope"),
        sheet: if inside { Sheet::Rising } else { Sheet::Falling },
        side_of_lines: Side::Both,
        side_of_rings: if inside { Side::Inside } else { Side::Outside },
        // Rulings inside a circle of 100 all meet in its centre, 50 above it.
        extent: Extent::Elevation(if inside { high + 60.0 } else { low - 10.0 }),
        interval: None,
        tolerance: 0.01,
        levels: Vec::new(),
        companion: None,
        frame: None,
        joggle: None,
    };
    timed(|| surface::build(&line, &design, None, &()).expect("a surface"))
}

/// The lines of `cargo bench --bench engine`, and a circle.
fn line(shape: &str, count: usize) -> String {
    let mut text = String::from("x,y,z\n");
    let mut row = |x: f64, y: f64, z: f64| {
        let _ = writeln!(text, "{:.4},{:.4},{z:.4}", 500_000.0 + x, 5_400_000.0 + y);
    };
    if shape == "road" {
        let (mut x, mut y, mut z) = (0.0, 0.0, 100.0);
        for i in 0..count {
            row(x, y, z);
            let w = i as f64;
            // Never back over itself, however long.
            let direction: f64 = 0.9 * (w / 700.0).sin() + 0.6 * (w / 170.0).sin();
            x += 0.5 * direction.cos();
            y += 0.5 * direction.sin();
            z += 0.025 * (w / 900.0).sin();
        }
        return text;
    }
    let mut noise = noise(1);
    for i in 0..count {
        let w = TAU * i as f64 / count as f64;
        let waves = (3.0 * w + 0.3).sin() + 0.6 * (5.0 * w + 1.1).sin() + 0.5 * (7.0 * w + 2.9).sin();
        let (radius, height) = match shape {
            "inside of a circle" => (100.0, 100.0),
            _ => (500.0 + 40.0 * waves, 100.0 + 12.0 * (w + 0.5).sin() + 6.0 * (2.0 * w + 1.0).sin() + 4.0 * (3.0 * w).sin()),
        };
        let radius = radius + if shape == "noisy ring" { 0.04 * noise() } else { 0.0 };
        row(radius * w.cos(), radius * w.sin(), height);
    }
    let first = text.lines().nth(1).unwrap_or_default().to_owned();
    text + &first + "\n"
}

/// `slopegen build` with ground and finished ground, as a whole.
fn on_ground(count: usize) -> f64 {
    let folder = tempfile::tempdir().expect("a folder");
    let path = |name: &str| folder.path().join(name).to_string_lossy().into_owned();
    write(&ground(count, 0.0), MeshFormat::Ply, Path::new(&path("ground.ply")));
    let extent = STEP * ((count as f64).sqrt() - 1.0);
    let mut text = String::from("x,y,z\n");
    // The same road whatever the extent: a hundred metres in the middle of the smallest ground.
    for i in 0..=100 {
        let x = 0.5 * extent - 50.0 + f64::from(i);
        let y = 0.5 * extent + 10.0 * (f64::from(i) / 15.0).sin();
        let _ = writeln!(text, "{:.4},{:.4},{:.4}", CORNER[0] + x, CORNER[1] + y, height(x, y) + 2.0);
    }
    std::fs::write(path("road.csv"), text).expect("a road");
    let arguments = ["slopegen", "build", &path("road.csv"), "--slope", "1:1.5", "--terrain", &path("ground.ply"), "--quiet"];
    let arguments = arguments.into_iter().map(str::to_owned);
    let outputs = ["-o".to_owned(), path("design.ply"), "--finished".to_owned(), path("finished.ply")];
    timed(|| {
        let code = slopegen::cli::run(arguments.chain(outputs).map(Into::into));
        assert_eq!(code, std::process::ExitCode::SUCCESS);
    })
}

/// Writes ground to a file, and tells how long that took.
fn write(ground: &Terrain, format: MeshFormat, path: &Path) -> f64 {
    let parts = vec![Part::Ground; ground.triangles.len()];
    let (vertices, triangles) = (ground.vertices.clone(), ground.triangles.clone());
    let tin = Tin { frame: ground.frame, vertices, triangles, parts };
    timed(|| {
        let mut file = std::fs::File::create(path).expect("a file");
        format.write(&mut file, &tin, &Head::default()).expect("room for the file");
    })
}

/// Numbers between −½ and ½, the same on every machine.
fn noise(mut state: u64) -> impl FnMut() -> f64 {
    move || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 53) as f64 - 0.5
    }
}

fn height(x: f64, y: f64) -> f64 {
    100.0 + 20.0 * (x / 173.0).sin() + 15.0 * (y / 131.0).cos() + 0.7 * (x / 7.0).sin() * (y / 9.0).sin()
}

/// Rolling ground of about `count` vertices on a grid, each moved by up to a fifth of a step; `shift` is added to all phases, so
/// that two such grounds have nothing in common.
fn ground(count: usize, shift: f64) -> Terrain {
    let n = (count as f64).sqrt().round() as usize;
    let extent = STEP * (n - 1) as f64;
    let mut noise = noise(7 + (shift * 100.0) as u64);
    let min = glam::DVec2::from(CORNER);
    let frame = Frame::around(min, min + extent);
    let vertices = (0..n * n).map(|i| {
        let mut moved = |k: usize| STEP * (k as f64 + if k == 0 || k == n - 1 { 0.0 } else { 0.4 * noise() });
        let (x, y) = (moved(i % n), moved(i / n));
        frame.to_local(DVec3::new(CORNER[0] + x, CORNER[1] + y, height(x, y) + 5.0 * (x / 40.0 + 9.0 * shift).sin()))
    });
    let triangles = (0..(n - 1) * (n - 1)).flat_map(|i| {
        let a = (i / (n - 1) * n + i % (n - 1)) as u32;
        let n = n as u32;
        [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]]
    });
    Terrain { frame, vertices: vertices.collect(), triangles: triangles.collect() }
}

/// Seconds of processor time that some work takes.
fn timed<T>(work: impl FnOnce() -> T) -> f64 {
    let before = cpu();
    std::hint::black_box(work());
    cpu() - before
}

/// Seconds of processor time of all threads, where the system tells (Linux).
fn cpu() -> f64 {
    let Ok(threads) = std::fs::read_dir("/proc/self/task") else { return f64::NAN };
    let of_thread = |path: &Path| std::fs::read_to_string(path.join("schedstat")).ok();
    let nanoseconds = threads.flatten().filter_map(|thread| of_thread(&thread.path())?.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.sum::<f64>() / 1e9
}
