//! Times of reading existing ground in every format: 1 million vertices (or the number given) with 2 million triangles, or as
//! points. `just bench` prints the table of `docs/performance.md`.
//!
//! Every case writes its own file and runs in a process of its own, so that the peak of memory is its own as well. *Bare* is what
//! the shortest reader takes that we can think of, which checks nothing and keeps to what the file of the case looks like: what
//! is beyond it is the price of the check sum, of all the dialects, and of saying what is wrong and where.
#![allow(clippy::print_stdout, reason = "the table is the product")]

use slopegen::read::terrain::{TerrainOptions, read_terrain};
use slopegen::terrain;
use std::fmt::Write as _;
use std::path::Path;
use std::time::Instant;
use tiff::encoder::colortype::Gray64Float;
use tiff::encoder::{Compression, TiffEncoder};
use tiff::tags::Tag;

const CASES: [&str; 10] = ["ply", "obj", "dxf", "asc", "csv", "xyz", "xml", "tif", "las", "laz"];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| !a.starts_with("--")).collect();
    if let [bare, path] = &arguments[..]
        && bare == "bare"
    {
        println!("{}", timed(|| bare_sum(Path::new(path))).1);
        return;
    }
    if let [path] = &arguments[..]
        && path.contains('.')
    {
        run(Path::new(path));
        return;
    }
    let count: usize = arguments.first().map_or(1_000_000, |n| n.parse().expect("a number of vertices"));
    println!("milliseconds, wall and (CPU); ground of {count} vertices, coordinates to 0.0001");
    println!(
        "{:>5} {:>7} {:>13} {:>13} {:>13} {:>13} {:>10} {:>6}",
        "case", "file MB", "bare", "read", "prepare", "inspect", "triangles", "MB"
    );
    let this = std::env::current_exe().expect("own path");
    let folder = tempfile::tempdir().expect("a temporary folder");
    for case in CASES {
        let path = folder.path().join(format!("ground.{case}"));
        write(case, count, &path);
        let run = |arguments: &[&std::ffi::OsStr]| {
            let out = std::process::Command::new(&this).args(arguments).output().expect("a run of one case");
            String::from_utf8_lossy(&out.stdout).into_owned()
        };
        let bare = ["ply", "obj", "csv", "xyz"].contains(&case).then(|| run(&["bare".as_ref(), path.as_os_str()]));
        print!("{}", run(&[path.as_os_str()]).replace("BARE", &format!("{:>13}", bare.unwrap_or_default().trim())));
        std::fs::remove_file(path).expect("the file of the case");
    }
}

fn height(x: f64, y: f64) -> f64 {
    100.0 + 20.0 * (x / 173.0).sin() + 15.0 * (y / 131.0).cos() + 0.7 * (x / 7.0).sin() * (y / 9.0).sin()
}

/// Writes ground of about `count` vertices on a jittered grid of steps of 2 (a plain grid as `asc` and `tif`, points of class 2
/// as `las` and `laz`).
fn write(case: &str, count: usize, path: &Path) {
    let n = (count as f64).sqrt().round() as usize;
    let mut state = 7_u64;
    let mut jitter = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 33) as f64 / f64::from(1_u32 << 31) - 0.5
    };
    let points: Vec<[f64; 3]> = (0..n * n)
        .map(|i| {
            let (x, y) = (2.0 * (i % n) as f64 + jitter(), 2.0 * (i / n) as f64 + jitter());
            [500_000.0 + x, 5_400_000.0 + y, height(x, y)].map(|v| (v * 1e4).round() / 1e4)
        })
        .collect();
    let triangles = (0..(n - 1) * (n - 1)).flat_map(|i| {
        let a = i / (n - 1) * n + i % (n - 1);
        [[a, a + 1, a + n + 1], [a, a + n + 1, a + n]]
    });
    let mut text = String::new();
    let mut bytes = Vec::new();
    match case {
        "ply" => {
            let _ = write!(
                text,
                "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double \
                 z\nelement face {}\nproperty list uchar int vertex_indices\nend_header\n",
                n * n,
                2 * (n - 1) * (n - 1)
            );
            bytes.extend(text.bytes());
            points.iter().flatten().for_each(|v| bytes.extend(v.to_le_bytes()));
            for t in triangles {
                bytes.push(3);
                t.into_iter().for_each(|v| bytes.extend((v as u32).to_le_bytes()));
            }
        }
        "obj" => {
            for [x, y, z] in points {
                let _ = writeln!(text, "v {x:.4} {y:.4} {z:.4}");
            }
            for [a, b, c] in triangles {
                let _ = writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1);
            }
        }
        "xml" => {
            text.push_str(
                "<?xml version=\"1.0\"?>\n<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\" version=\"1.2\">\n<Units><Metric \
                 linearUnit=\"meter\"/></Units>\n<Surfaces><Surface name=\"ground\"><Definition surfType=\"TIN\">\n<Pnts>\n",
            );
            for (i, [x, y, z]) in points.iter().enumerate() {
                let _ = writeln!(text, "<P id=\"{}\">{y:.4} {x:.4} {z:.4}</P>", i + 1);
            }
            text.push_str("</Pnts>\n<Faces>\n");
            for [a, b, c] in triangles {
                let _ = writeln!(text, "<F>{} {} {}</F>", a + 1, b + 1, c + 1);
            }
            text.push_str("</Faces></Definition></Surface></Surfaces></LandXML>\n");
        }
        "dxf" => {
            text.push_str("  0\nSECTION\n  2\nENTITIES\n");
            for [a, b, c] in triangles {
                text.push_str("  0\n3DFACE\n  8\nDGM\n");
                for (i, v) in [a, b, c, c].into_iter().enumerate() {
                    let [x, y, z] = points[v];
                    let _ = write!(text, " 1{i}\n{x:.4}\n 2{i}\n{y:.4}\n 3{i}\n{z:.4}\n");
                }
            }
            text.push_str("  0\nENDSEC\n  0\nEOF\n");
        }
        "asc" => {
            let _ = write!(text, "ncols {n}\nnrows {n}\nxllcorner 500000\nyllcorner 5400000\ncellsize 2\n");
            for row in points.chunks(n) {
                for [_, _, z] in row {
                    let _ = write!(text, "{z:.4} ");
                }
                text.push('\n');
            }
        }
        "tif" => {
            let heights: Vec<f64> = points.iter().map(|p| p[2]).collect();
            let mut file = std::io::Cursor::new(&mut bytes);
            let mut encoder = TiffEncoder::new(&mut file)
                .expect("a header")
                .with_compression(Compression::Deflate(tiff::encoder::compression::DeflateLevel::Balanced));
            let mut image = encoder.new_image::<Gray64Float>(n as u32, n as u32).expect("an image");
            let tags = image.encoder();
            tags.write_tag(Tag::ModelPixelScaleTag, &[2.0, 2.0, 0.0][..]).expect("a tag");
            tags.write_tag(Tag::ModelTiepointTag, &[0.0, 0.0, 0.0, 500_000.0, 5_402_000.0, 0.0][..]).expect("a tag");
            image.write_data(&heights).expect("the heights");
        }
        "las" | "laz" => {
            let mut builder = las::Builder::from((1, 4));
            builder.point_format = las::point::Format::new(6).expect("a point format");
            builder.point_format.is_compressed = case == "laz";
            let axis = |offset| las::Transform { scale: 1e-4, offset };
            builder.transforms = las::Vector { x: axis(500_000.0), y: axis(5_400_000.0), z: axis(0.0) };
            let file = std::io::Cursor::new(Vec::new());
            let mut writer = las::Writer::new(file, builder.into_header().expect("a header")).expect("a writer");
            for [x, y, z] in points {
                let classification = las::point::Classification::Ground;
                let point = las::Point { x, y, z, classification, gps_time: Some(0.0), ..Default::default() };
                writer.write_point(point).expect("a point");
            }
            bytes = writer.into_inner().expect("the cloud").into_inner();
        }
        _ => {
            let separator = if case == "csv" { ',' } else { ' ' };
            text.push_str(if case == "csv" { "x,y,z\n" } else { "" });
            for [x, y, z] in points {
                let _ = writeln!(text, "{x:.4}{separator}{y:.4}{separator}{z:.4}");
            }
        }
    }
    std::fs::write(path, if bytes.is_empty() { text.into_bytes() } else { bytes }).expect("room for the file");
}

/// Milliseconds of wall clock, and of all threads.
fn timed<T>(work: impl FnOnce() -> T) -> (T, String) {
    let (begun, cpu) = (Instant::now(), cpu_ms());
    let result = work();
    (result, format!("{:.0} ({:.0})", begun.elapsed().as_secs_f64() * 1e3, cpu_ms() - cpu))
}

fn run(path: &Path) {
    let (raw, read) = timed(|| read_terrain(path, &TerrainOptions::default()).expect("sound ground"));
    let (prepared, prepare) = timed(|| terrain::prepare(raw).expect("sound ground"));
    let peak = peak_mb();
    let (findings, inspect) = timed(|| terrain::inspect("ground", &prepared.terrain));
    assert!(findings.defects.is_empty(), "{}", findings.defects);
    let case = path.extension().and_then(|e| e.to_str()).unwrap_or("");
    let size = std::fs::metadata(path).map_or(0, |m| m.len()) as f64 / 1e6;
    let count = prepared.terrain.triangles.len();
    println!("{case:>5} {size:>7.1} BARE {read:>13} {prepare:>13} {inspect:>13} {count:>10} {peak:>6.0}");
}

/// Reads a file of [`write`] and nothing else, and checks nothing. The sum keeps the compiler from leaving it out.
fn bare_sum(path: &Path) -> (f64, u64) {
    let bytes = std::fs::read(path).expect("the file of the case");
    let mut vertices: Vec<[f64; 3]> = Vec::new();
    let mut triangles: Vec<[u32; 3]> = Vec::new();
    match path.extension().and_then(|e| e.to_str()) {
        Some("ply") => {
            let text = String::from_utf8_lossy(&bytes[..400]);
            let count = |name: &str| -> usize {
                let from = text.find(name).expect("an element") + name.len();
                text[from..].split_whitespace().next().and_then(|n| n.parse().ok()).expect("a count")
            };
            let end = "end_header\n";
            let body = &bytes[text.find(end).expect("an end") + end.len()..];
            let (points, faces) = body.split_at(24 * count("element vertex"));
            let number = |r: &[u8], i: usize| f64::from_le_bytes(r[8 * i..8 * i + 8].try_into().expect("8 bytes"));
            vertices.extend(points.chunks_exact(24).map(|r| [number(r, 0), number(r, 1), number(r, 2)]));
            let corner = |r: &[u8], i: usize| u32::from_le_bytes(r[4 * i + 1..4 * i + 5].try_into().expect("4 bytes"));
            triangles.extend(faces.chunks_exact(13).map(|r| [corner(r, 0), corner(r, 1), corner(r, 2)]));
        }
        _ => {
            let mut at = 0;
            while at < bytes.len() {
                match bytes[at] {
                    b'f' => triangles.push([0; 3].map(|_: u32| bare_number(&bytes, &mut at).0 as u32)),
                    b'x' => at += 5,
                    _ => vertices.push([0.0; 3].map(|_: f64| {
                        let (mantissa, scale) = bare_number(&bytes, &mut at);
                        mantissa as f64 / scale
                    })),
                }
                at += 1;
            }
        }
    }
    (vertices.as_flattened().iter().sum(), triangles.as_flattened().iter().map(|v| u64::from(*v)).sum())
}

/// The next number at or after `at` that has no sign: its digits, and what they are to be divided by.
#[inline]
fn bare_number(bytes: &[u8], at: &mut usize) -> (u64, f64) {
    while !bytes[*at].is_ascii_digit() {
        *at += 1;
    }
    let (mut value, mut scale, mut point) = (0_u64, 1.0, false);
    while let Some(&byte) = bytes.get(*at).filter(|b| b.is_ascii_digit() || **b == b'.') {
        if byte == b'.' {
            point = true;
        } else {
            value = 10 * value + u64::from(byte - b'0');
            scale *= if point { 10.0 } else { 1.0 };
        }
        *at += 1;
    }
    (value, scale)
}

/// CPU time of all threads so far (Linux; elsewhere 0).
fn cpu_ms() -> f64 {
    let Ok(threads) = std::fs::read_dir("/proc/self/task") else { return 0.0 };
    let of_thread = |path: &Path| std::fs::read_to_string(path.join("schedstat")).ok();
    let nanoseconds = threads.flatten().filter_map(|thread| of_thread(&thread.path())?.split(' ').next()?.parse::<f64>().ok());
    nanoseconds.sum::<f64>() / 1e6
}

/// Peak of resident memory (Linux; elsewhere 0).
fn peak_mb() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find(|line| line.starts_with("VmHWM"));
    line.and_then(|line| line.split_whitespace().nth(1)?.parse::<f64>().ok()).map_or(0.0, |kb| kb / 1e3)
}
