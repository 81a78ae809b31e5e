//! How fast meshes of a million triangles become bytes, for each format, and files; see docs/performance.md. Files are written as
//! the program writes them, into the cache of the system: what the disk takes is its own affair. *Plain* is what the system takes
//! to write the same bytes to a file when they are there already.
//!
//! `cargo bench --bench writing`

#![allow(clippy::print_stdout, reason = "the table is the product")]

use glam::{DVec2, DVec3};
use slopegen::kernel::frame::Frame;
use slopegen::model::{Part, Tin};
use slopegen::write::{EncodeError, Head, MeshFormat, Outputs, Target};
use std::io::{self, Write};
use std::time::{Duration, Instant};

/// Squares along a side of the grid: twice its square in triangles.
const SIDE: u32 = 707;

/// Runs of which the fastest counts.
const RUNS: usize = 5;

/// Counts bytes and forgets them.
#[derive(Default)]
struct Count(usize);

impl Write for Count {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0 += bytes.len();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// Rolling ground with all digits of a double, far from zero, all parts in turn.
fn mesh() -> Tin {
    let min = DVec2::new(500_000.0, 5_400_000.0);
    let frame = Frame::around(min, min + 2.0 * f64::from(SIDE));
    let places = (0..=SIDE).flat_map(|i| (0..=SIDE).map(move |j| (f64::from(i), f64::from(j))));
    let vertices = places
        .map(|(i, j)| {
            let (x, y) = (2.0 * i + 0.3 * (7.0 * j).sin(), 2.0 * j + 0.3 * (5.0 * i).cos());
            frame.to_local(DVec3::new(min.x + x, min.y + y, 400.0 + 10.0 * (x / 70.0).sin() * (y / 90.0).cos()))
        })
        .collect();
    let (mut triangles, mut parts) = (Vec::new(), Vec::new());
    for i in 0..SIDE {
        for j in 0..SIDE {
            let a = i * (SIDE + 1) + j;
            let b = a + SIDE + 1;
            triangles.extend([[a, b, b + 1], [a, b + 1, a + 1]]);
            parts.extend([Part::ALL[(j % 4) as usize]; 2]);
        }
    }
    Tin { frame, vertices, triangles, parts }
}

fn main() -> Result<(), EncodeError> {
    let tin = mesh();
    println!("{} vertices, {} triangles; the fastest of {RUNS}", tin.vertices.len(), tin.triangles.len());
    println!("{:>8} {:>8} {:>8} {:>8} {:>9} {:>9} {:>9}", "format", "MB", "ms", "MB/s", "file ms", "file MB/s", "plain ms");
    let folder = tempfile::tempdir()?;
    let all = [MeshFormat::Ply, MeshFormat::Obj, MeshFormat::LandXml, MeshFormat::Dxf, MeshFormat::Stl, MeshFormat::Glb];
    for format in all {
        let mut best = (Duration::MAX, 0);
        let (mut to_file, mut plain) = (Duration::MAX, Duration::MAX);
        let mut bytes = Vec::new();
        format.write(&mut bytes, &tin, &Head::default())?;
        for _ in 0..RUNS {
            let (mut count, start) = (Count::default(), Instant::now());
            format.write(&mut count, &tin, &Head::default())?;
            best = best.min((start.elapsed(), count.0));
            // A new file each time: pages that are there already are cheaper.
            let target = Target::File(folder.path().join("mesh"));
            let mut outputs = Outputs::open::<&str>(&[target], &[]).map_err(io::Error::other)?;
            let start = Instant::now();
            outputs.write(0, |out| format.write(out, &tin, &Head::default())).map_err(io::Error::other)?;
            to_file = to_file.min(start.elapsed());
            drop(outputs);
            let start = Instant::now();
            std::fs::write(folder.path().join("plain"), &bytes)?;
            plain = plain.min(start.elapsed());
            std::fs::remove_file(folder.path().join("plain"))?;
        }
        let (megabytes, seconds) = (best.1 as f64 / 1e6, best.0.as_secs_f64());
        println!(
            "{:>8} {megabytes:>8.1} {:>8.1} {:>8.0} {:>9.1} {:>9.0} {:>9.1}",
            format!("{format:?}"),
            1e3 * seconds,
            megabytes / seconds,
            1e3 * to_file.as_secs_f64(),
            megabytes / to_file.as_secs_f64(),
            1e3 * plain.as_secs_f64()
        );
    }
    Ok(())
}
