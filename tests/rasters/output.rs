//! The works as rasters: heights of the mesh, in files that other programs and this one read back.

use crate::ground;
use slopegen::model::LengthUnit;
use slopegen::read::InputFormat;
use slopegen::read::terrain::{RawGrid, RawGround};
use std::path::Path;
use tempfile::TempDir;

struct Run {
    code: i32,
    stderr: String,
}

/// Runs the program in a folder with the shipped examples.
fn run(folder: &TempDir, arguments: &str) -> Run {
    for name in ["road.geojson", "pad.geojson", "hill_pad.geojson", "ground.obj"] {
        std::fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name), folder.path().join(name)).unwrap();
    }
    let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
        .args(arguments.split_whitespace())
        .current_dir(folder.path())
        .output()
        .unwrap();
    Run { code: output.status.code().unwrap_or(-1), stderr: String::from_utf8_lossy(&output.stderr).into_owned() }
}

fn grid(folder: &TempDir, name: &str) -> RawGrid {
    let bytes = std::fs::read(folder.path().join(name)).unwrap();
    let format = if name.ends_with("asc") { InputFormat::Asc } else { InputFormat::GeoTiff };
    let RawGround::Grid(grid) = ground(format, &bytes, &[]).unwrap().ground else { panic!("no grid") };
    grid
}

fn same(a: &RawGrid, b: &RawGrid) {
    assert_eq!((a.columns, a.rows, a.origin, a.step), (b.columns, b.rows, b.origin, b.step));
    let bits = |grid: &RawGrid| grid.heights.iter().map(|z| z.to_bits()).collect::<Vec<_>>();
    assert_eq!(bits(a), bits(b));
}

/// A pad of elevation 412 with slopes of 1:2 down to 405: the heights are those of the closed form, within the tolerance.
#[test]
fn the_design_is_a_raster_of_its_heights() {
    let folder = tempfile::tempdir().unwrap();
    let end = "--slope 1:2 --to-elevation 405";
    let done = run(&folder, &format!("build pad.geojson {end} --cell 0.5 -o d.tif -o d.asc -o d.obj --tolerance 0.002 -q"));
    assert_eq!(done.code, 0, "{}", done.stderr);
    let (tif, asc) = (grid(&folder, "d.tif"), grid(&folder, "d.asc"));
    same(&tif, &asc);
    // The exact heights at the same nodes.
    let lo = tif.origin;
    let hi = lo + tif.step * glam::DVec2::new((tif.columns - 1) as f64, (tif.rows - 1) as f64);
    let at = format!("--raster s.tif --cell 0.5 --box {},{},{},{}", lo.x, lo.y, hi.x, hi.y);
    let done = run(&folder, &format!("sample pad.geojson --slope 1:2 {at} -q"));
    assert_eq!(done.code, 0, "{}", done.stderr);
    let exact = grid(&folder, "s.tif");
    assert_eq!((exact.origin, exact.columns, exact.rows), (tif.origin, tif.columns, tif.rows));
    // Nodes on the platform are higher than the sheet, which has a valley there.
    let mut on_slope = 0;
    for (z, sheet) in tif.heights.iter().zip(&exact.heights) {
        if z.is_nan() {
            assert!(*sheet < 405.0 + 0.01, "{sheet}");
        } else if (z - sheet).abs() <= 0.002 {
            on_slope += 1;
        } else {
            assert!(z > sheet, "{z} {sheet}");
        }
    }
    assert!(on_slope > tif.heights.len() / 10, "{on_slope} of {}", tif.heights.len());
}

/// Read by the package `tiff`: another hand than ours.
#[test]
fn another_decoder_reads_the_same_heights() {
    let folder = tempfile::tempdir().unwrap();
    let done = run(&folder, "build road.geojson --slope 1:1.5 --cell 0.4 -o d.tif -q");
    assert_eq!(done.code, 0, "{}", done.stderr);
    let ours = grid(&folder, "d.tif");
    let file = std::fs::File::open(folder.path().join("d.tif")).unwrap();
    let mut decoder = tiff::decoder::Decoder::new(std::io::BufReader::new(file)).unwrap();
    let tiff::decoder::DecodingResult::F64(theirs) = decoder.read_image().unwrap() else { panic!("no doubles") };
    assert_eq!(decoder.dimensions().unwrap(), (ours.columns as u32, ours.rows as u32));
    assert!(theirs.len() > 100_000);
    assert!(theirs.iter().zip(&ours.heights).all(|(a, b)| a.to_bits() == b.to_bits()));
    assert!(ours.heights.iter().any(|z| z.is_nan()) && ours.heights.iter().any(|z| !z.is_nan()));
}

/// Written once more, and as ground of another run: the same places and heights.
#[test]
fn finished_ground_comes_back_as_ground() {
    let folder = tempfile::tempdir().unwrap();
    let line = "build hill_pad.geojson --slope 1:1.5 --terrain ground.obj";
    let done = run(&folder, &format!("{line} --cell 1 --finished f.tif --finished f.asc -o d.tif -q"));
    assert_eq!(done.code, 0, "{}", done.stderr);
    same(&grid(&folder, "f.tif"), &grid(&folder, "f.asc"));
    let (finished, design) = (grid(&folder, "f.tif"), grid(&folder, "d.tif"));
    // Where there is design, the finished ground is the design.
    let mut met = 0;
    for (i, z) in design.heights.iter().enumerate().filter(|(_, z)| !z.is_nan()) {
        let node = |grid: &RawGrid, i: usize| {
            grid.origin + grid.step * glam::DVec2::new((i % grid.columns) as f64, (grid.rows - 1 - i / grid.columns) as f64)
        };
        let at = ((node(&design, i) - finished.origin) / finished.step).round();
        let there = finished.heights[(finished.rows - 1 - at.y as usize) * finished.columns + at.x as usize];
        assert!((there - z).abs() < 1e-9, "{there} {z}");
        met += 1;
    }
    assert!(met > 500, "{met}");
    let again = run(&folder, "volume f.tif f.asc --report v.json -q");
    assert_eq!(again.code, 0, "{}", again.stderr);
    let report: serde_json::Value = serde_json::from_slice(&std::fs::read(folder.path().join("v.json")).unwrap()).unwrap();
    assert_eq!((report["volumes"]["cut"].as_f64(), report["volumes"]["fill"].as_f64()), (Some(0.0), Some(0.0)));
}

#[test]
fn the_raster_says_what_is_known_of_its_coordinates() {
    let folder = tempfile::tempdir().unwrap();
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/pad.geojson")).unwrap();
    let crs = "{\"crs\": {\"type\": \"name\", \"properties\": {\"name\": \"urn:ogc:def:crs:EPSG::25832\"}},";
    let text = text.split_once("\"crs\"").map_or_else(|| text.replacen('{', crs, 1), |_| text.clone());
    std::fs::write(folder.path().join("coded.geojson"), text).unwrap();
    for (arguments, unit) in [("", None), ("--units us-ft", Some(LengthUnit::UsSurveyFoot))] {
        let done = run(&folder, &format!("build coded.geojson --slope 1:2 --cell 1 -o d.tif -q {arguments}"));
        assert_eq!(done.code, 0, "{}", done.stderr);
        let bytes = std::fs::read(folder.path().join("d.tif")).unwrap();
        let raw = ground(InputFormat::GeoTiff, &bytes, &[]).unwrap();
        assert_eq!((raw.source.crs.as_deref(), raw.source.unit), (Some("EPSG:25832"), unit));
        assert_eq!(crate::codes(&raw.notes), [] as [&str; 0]);
    }
}

#[test]
fn bytes_are_the_same_on_any_number_of_threads() {
    let folder = tempfile::tempdir().unwrap();
    let bytes = |threads: u32| {
        let done = run(&folder, &format!("build road.geojson --slope 1:1.5 --cell 0.5 -o d.tif -q --threads {threads}"));
        assert_eq!(done.code, 0, "{}", done.stderr);
        std::fs::read(folder.path().join("d.tif")).unwrap()
    };
    assert_eq!(bytes(1), bytes(7));
}

#[test]
fn what_is_wrong_with_the_wish_is_told() {
    let folder = tempfile::tempdir().unwrap();
    for (arguments, code, what) in [
        ("-o d.tif", 2, "a raster needs the side of its cells\n  --> d.tif"),
        ("-o d.obj --cell 1", 2, "there is no raster that cells could be for\n  --> --cell 1"),
        ("-o d.tif --cell 0", 2, "--cell 0"),
        ("-o d.tif --cell x", 2, "--cell x"),
        ("-o d.tif --cell 0.0001", 1, "the raster would have too many nodes\n  --> pad.geojson"),
        ("-o d.tif --cell 1000000000", 1, "the raster would be empty\n  --> pad.geojson"),
    ] {
        let run = run(&folder, &format!("build pad.geojson --slope 1:2 -q {arguments}"));
        assert_eq!(run.code, code, "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains(what), "{arguments}: {}", run.stderr);
        assert!(!folder.path().join("d.tif").exists());
    }
}
