//! Nothing a file can contain may panic, hang or be taken for a line it is not.

#[allow(dead_code, reason = "shared, and used in part")]
#[path = "../src/kernel/testing.rs"]
mod random;

use proptest::prelude::*;
use random::Random;
use slopegen::model::{Role, Slope};
use slopegen::read::{self, InputFormat, ReadOptions};
use slopegen::validate::{self, Options};
use std::fmt::Write as _;

/// Reads and checks; what comes through must meet the invariants of a line.
fn run(bytes: &[u8], format: InputFormat, order: Option<&str>, closed: bool) -> Result<usize, String> {
    let order = order.map(|o| o.parse().unwrap());
    let raw =
        read::parse_line("a", bytes, &ReadOptions { csv_order: order, ..ReadOptions::of(format) }).map_err(|e| e.to_string())?;
    let checked = validate::check(&raw, &Options { closed }).map_err(|e| e.to_string())?;
    for chain in &checked.line.chains {
        let n = chain.vertices.len();
        assert!(n >= if chain.closed() { 3 } else { 2 });
        assert_eq!(n, chain.places.len());
        assert!(chain.vertices.iter().all(|v| v.is_finite() && v.abs().max_element() <= validate::INPUT_LIMIT));
        for i in 0..chain.segment_count() {
            let (a, b) = chain.segment(i);
            assert!(a.truncate().distance(b.truncate()) > 0.99 * validate::MERGE_DISTANCE, "{a} {b}");
        }
    }
    for ratio in [0.01, 1.0, 100.0] {
        if let Err(defects) = validate::check_steepness(&checked.line, "a", Slope::from_ratio(ratio).unwrap()) {
            assert!(defects.to_string().contains("or steeper"));
        }
    }
    Ok(checked.line.vertex_count())
}

/// Pieces that matter to the readers, so that random sequences of them get past the first byte.
const PIECES: [&str; 44] = [
    "x,y,z\n",
    "x;y;z\n",
    "easting northing z\n",
    "line,x,y,z\n",
    "1",
    "2.5",
    "-3",
    "1,5",
    "1e308",
    "inf",
    "nan",
    "-9999",
    ",",
    ";",
    "\t",
    " ",
    "\n",
    "\r",
    "\r\n",
    "\"",
    "#",
    "//",
    "%",
    "\u{feff}",
    "é",
    "{",
    "}",
    "[",
    "]",
    ":",
    "\"type\"",
    "\"LineString\"",
    "\"Polygon\"",
    "\"coordinates\"",
    "\"FeatureCollection\"",
    "\"features\"",
    "\"Feature\"",
    "\"geometry\"",
    "null",
    "[1,2,3]",
    "[4,5,6]",
    "[[0,0,0],[9,0,0],[9,9,0]]",
    "\"geometries\"",
    "\"GeometryCollection\"",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes(bytes in prop::collection::vec(any::<u8>(), 0..300), closed: bool) {
        let _ = run(&bytes, InputFormat::Csv, None, closed);
        let _ = run(&bytes, InputFormat::Csv, Some("xyz"), closed);
        let _ = run(&bytes, InputFormat::GeoJson, None, closed);
        let _ = read::parse_points("a", &bytes, None);
    }

    #[test]
    fn random_pieces(pieces in prop::collection::vec(prop::sample::select(&PIECES[..]), 0..60), closed: bool) {
        let bytes = pieces.concat().into_bytes();
        let _ = run(&bytes, InputFormat::Csv, None, closed);
        let _ = run(&bytes, InputFormat::Csv, Some("xyz"), closed);
        let _ = run(&bytes, InputFormat::Csv, Some("lpnezd"), closed);
        let _ = run(&bytes, InputFormat::GeoJson, None, closed);
        let _ = read::parse_points("a", &bytes, Some(&"xy".parse().unwrap()));
    }

    #[test]
    fn random_small_grids(points in prop::collection::vec((0..6i32, 0..6i32, 0..3i32), 0..12), closed: bool) {
        let mut text = String::from("x,y,z\n");
        for (x, y, z) in points {
            writeln!(text, "{x},{y},{z}").unwrap();
        }
        let _ = run(text.as_bytes(), InputFormat::Csv, None, closed);
    }

    /// A document with one byte changed, cut off anywhere.
    #[test]
    fn damaged_documents(at in 0..400usize, byte: u8, cut in 0..400usize) {
        for name in ["multi_polygon.geojson", "json_fg.geojson", "quoted.csv", "line_ids.csv", "utf16le.csv"] {
            let mut bytes = std::fs::read(format!("fixtures/input/{name}")).unwrap();
            if let Some(old) = bytes.get_mut(at) {
                *old = byte;
            }
            bytes.truncate(cut.max(1));
            let format = if name.ends_with("json") { InputFormat::GeoJson } else { InputFormat::Csv };
            let _ = run(&bytes, format, None, true);
        }
    }

    /// Numbers survive unchanged, whatever their digits.
    #[test]
    fn numbers_are_exact(x in -1e9..1e9f64, y in -1e9..1e9f64, z in -1e3..1e3f64) {
        let csv = format!("x,y,z\n{x},{y},{z}\n{},{y},{z}\n", x + 1.0);
        let json = format!("{{\"type\":\"LineString\",\"coordinates\":[[{x:?},{y:?},{z:?}],[0.5,0.25,1]]}}");
        for (text, format) in [(csv, InputFormat::Csv), (json, InputFormat::GeoJson)] {
            let raw = read::parse_line("a", text.as_bytes(), &ReadOptions::of(format)).unwrap();
            let v = raw.lines[0].vertices[0];
            prop_assert_eq!((v.x, v.y, v.z), (x, y, Some(z)));
        }
    }
}

fn json(positions: &str) -> Vec<u8> {
    format!("{{\"type\":\"LineString\",\"coordinates\":[{positions}]}}").into_bytes()
}

#[test]
fn absurd_numbers_are_named() {
    let error = run(&json("[1e308,-1e308,1],[1,2,3],[5,6,1e308]"), InputFormat::GeoJson, None, false).unwrap_err();
    assert!(error.contains("absurdly large") && error.contains("vertex 1"), "{error}");
    assert!(error.contains("no-data value") && error.contains("vertex 3"), "{error}");
    let error = run(b"x,y,z\n1,2,3\n1e999,2,3\n", InputFormat::Csv, None, false).unwrap_err();
    assert!(error.contains("not a finite number") && error.contains("row 3"), "{error}");
}

#[test]
fn deep_nesting_is_refused() {
    let deep = format!("{{\"type\":\"LineString\",\"coordinates\":{}", "[".repeat(100_000));
    assert!(run(deep.as_bytes(), InputFormat::GeoJson, None, false).is_err());
    let collection = "{\"type\":\"GeometryCollection\",\"geometries\":[".repeat(50_000);
    assert!(run(collection.as_bytes(), InputFormat::GeoJson, None, false).is_err());
}

#[test]
fn a_million_identical_vertices() {
    let text = "x,y,z\n".to_owned() + &"500000.25,5400000.5,310\n".repeat(1_000_000);
    let error = run(text.as_bytes(), InputFormat::Csv, None, true).unwrap_err();
    assert!(error.contains("`line 1` has 1 (1000000 given)"), "{error}");
}

#[test]
fn a_million_defects_are_counted() {
    let text = "x,y,z\n".to_owned() + &"500000.25,5400000.5,\n1,2,3\n".repeat(500_000);
    let error = run(text.as_bytes(), InputFormat::Csv, None, false).unwrap_err();
    assert!(error.contains("and 499980 more of this kind"), "{}", &error[..200]);
    assert!(error.len() < 3000);
}

#[test]
fn a_million_quotes_and_empty_lines() {
    for piece in ["\"", "\n", "\r", ",", ";", "#\n", "\t", "\"\n", "1,2\n", "[", "x,"] {
        let text = piece.repeat(1_000_000);
        assert!(run(text.as_bytes(), InputFormat::Csv, None, false).is_err());
        assert!(run(text.as_bytes(), InputFormat::GeoJson, None, false).is_err());
    }
}

#[test]
fn tiny_steps_do_not_creep_together() {
    // Steps of 0.6 µm: every second vertex stays, none of the 600 µm is lost.
    let mut text = String::from("x,y,z\n");
    for i in 0..1000 {
        writeln!(text, "{},100,5", f64::from(i) * 0.6e-6).unwrap();
    }
    let raw = read::parse_line("a", text.as_bytes(), &ReadOptions::of(InputFormat::Csv)).unwrap();
    let checked = validate::check(&raw, &Options::default()).unwrap();
    assert_eq!(checked.line.vertex_count(), 500);
}

#[test]
fn a_scribble_of_a_ring_ends_soon() {
    let mut text = String::from("x,y,z\n");
    let mut random = Random::new(1);
    for _ in 0..100_000 {
        writeln!(text, "{},{},5", random.below(100_003), random.below(100_019)).unwrap();
    }
    let error = run(text.as_bytes(), InputFormat::Csv, None, true).unwrap_err();
    assert!(error.contains("crosses itself"), "{error}");
}

/// Hatching: long parallel strokes at an angle, whose boxes all overlap.
#[test]
fn a_hatched_ring_is_checked_in_time() {
    let n = 50_000;
    let (sin, cos) = 0.35f64.sin_cos();
    let mut points: Vec<(f64, f64)> = Vec::new();
    for i in 0..n {
        let y = f64::from(i) * 0.05;
        let ends = if i % 2 == 0 { [0.0, 1000.0] } else { [1000.0, 0.0] };
        points.extend(ends.map(|x| (x, y)));
    }
    points.extend([(-5.0, f64::from(n) * 0.05), (-5.0, -1.0)]);
    let mut text = String::from("x,y,z\n");
    for (x, y) in points {
        writeln!(text, "{},{},5", cos * x - sin * y, sin * x + cos * y).unwrap();
    }
    let raw = read::parse_line("a", text.as_bytes(), &ReadOptions::of(InputFormat::Csv)).unwrap();
    let checked = validate::check(&raw, &Options { closed: true }).unwrap();
    assert_eq!(checked.line.chains[0].role, Role::Outer { polygon: 0 });
}
