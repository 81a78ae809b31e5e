//! DXF drawings: every kind of entity against closed forms, drawings of another program, damaged and hostile files.

use proptest::prelude::*;
use slopegen::model::{LengthUnit, Note};
use slopegen::read::terrain::{RawFaces, RawGround, RawTerrain, TerrainOptions, parse_terrain};
use slopegen::read::{self, InputFormat, Pick, RawInput, RawLine, ReadOptions};
use slopegen::validate;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Pairs of code and value, all separated by blanks, as the text of a file.
fn text(pairs: &str) -> String {
    let mut tokens = pairs.split_whitespace();
    let mut text = String::new();
    while let Some(code) = tokens.next() {
        text.push_str(&format!("{code:>3}\n{}\n", tokens.next().unwrap()));
    }
    text
}

/// A drawing of these entities.
fn drawing(entities: &str) -> String {
    text(&format!("0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF"))
}

/// A drawing with blocks.
fn with_blocks(blocks: &str, entities: &str) -> String {
    text(&format!("0 SECTION 2 BLOCKS {blocks} 0 ENDSEC 0 SECTION 2 ENTITIES {entities} 0 ENDSEC 0 EOF"))
}

fn options() -> ReadOptions {
    ReadOptions { chord: 0.01, ..ReadOptions::of(InputFormat::Dxf) }
}

fn pick(layers: &[&str], features: &[&str]) -> ReadOptions {
    let names = |list: &[&str]| list.iter().map(|&name| name.to_owned()).collect();
    ReadOptions { pick: Pick { layers: names(layers), features: names(features), ..Pick::default() }, ..options() }
}

fn read_with(text: impl AsRef<[u8]>, options: &ReadOptions) -> Result<RawInput, String> {
    read::parse_line("a.dxf", text.as_ref(), options).map_err(|e| e.to_string())
}

fn lines(text: impl AsRef<[u8]>) -> Vec<RawLine> {
    read_with(text, &options()).unwrap().lines
}

fn error(text: impl AsRef<[u8]>) -> String {
    read_with(text, &options()).unwrap_err()
}

fn ground(text: impl AsRef<[u8]>) -> Result<RawTerrain, String> {
    parse_terrain("a.dxf", text.as_ref(), &TerrainOptions::of(InputFormat::Dxf)).map_err(|e| e.to_string())
}

fn places(line: &RawLine) -> Vec<[f64; 3]> {
    line.vertices.iter().map(|v| [v.x, v.y, v.z.unwrap_or(f64::NAN)]).collect()
}

/// All coordinates within `bound`.
fn close(found: &[[f64; 3]], wanted: &[[f64; 3]], bound: f64) {
    assert_eq!(found.len(), wanted.len(), "{found:?}");
    for (a, b) in found.iter().zip(wanted) {
        assert!((0..3).all(|i| (a[i] - b[i]).abs() <= bound), "{a:?} {b:?}");
    }
}

fn codes(notes: &[Note]) -> Vec<&'static str> {
    notes.iter().map(|note| note.code).collect()
}

fn fixture(name: &str) -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures/dxf").join(name)
}

const POLYLINE: &str = "0 POLYLINE 8 CL 66 1 70 8 0 VERTEX 8 CL 10 1 20 2 30 3 70 32 0 VERTEX 10 4.5 20 -5 30 1e2 70 32 0 VERTEX 10 7 \
                        20 8 30 9 70 32 0 SEQEND 8 CL";

mod polylines {
    use super::*;

    #[test]
    fn of_three_dimensions() {
        let read = lines(drawing(POLYLINE));
        assert_eq!(places(&read[0]), [[1.0, 2.0, 3.0], [4.5, -5.0, 100.0], [7.0, 8.0, 9.0]]);
        assert_eq!(read[0].name.as_deref(), Some("CL"));
        // Section 4 lines, head 8, VERTEX and its layer 4: x stands under line 17.
        assert_eq!(read[0].vertices[0].row, Some(17));
        let closed = lines(drawing(&POLYLINE.replace("70 8 ", "70 9 ")));
        assert_eq!(places(&closed[0]), [[1.0, 2.0, 3.0], [4.5, -5.0, 100.0], [7.0, 8.0, 9.0], [1.0, 2.0, 3.0]]);
        // Control points of a spline (16) are not on it, its points (8) are; bulges mean nothing here.
        let spline = lines(drawing(&POLYLINE.replacen("70 32", "70 48 42 1", 1).replacen("70 32", "70 40 42 1", 1)));
        assert_eq!(places(&spline[0]), [[4.5, -5.0, 100.0], [7.0, 8.0, 9.0]]);
    }

    #[test]
    fn light_ones_have_one_elevation() {
        let read = lines(drawing("0 LWPOLYLINE 8 PAD 90 3 70 1 43 0 38 412.25 10 0 20 0 10 10 20 0 40 1 41 1 10 10 20 10"));
        let z = 412.25;
        assert_eq!(places(&read[0]), [[0.0, 0.0, z], [10.0, 0.0, z], [10.0, 10.0, z], [0.0, 0.0, z]]);
    }

    #[test]
    fn bulges_are_arcs() {
        // Half a circle of radius 5 about (5, 0), from west through south to east, then straight back.
        let read = lines(drawing("0 LWPOLYLINE 8 PAD 70 1 38 7 10 0 20 0 42 1 10 10 20 0"));
        let found = places(&read[0]);
        assert_eq!((found[0], found[found.len() - 1]), ([0.0, 0.0, 7.0], [0.0, 0.0, 7.0]));
        let arc = &found[..found.len() - 1];
        assert_eq!(arc[arc.len() - 1], [10.0, 0.0, 7.0]);
        assert!(arc.iter().all(|p| ((p[0] - 5.0).hypot(p[1]) - 5.0).abs() < 1e-14 && p[1] <= 0.0 && p[2] == 7.0));
        // Chords of angle β lie off by 5·(1 − cos(β/2)) ≤ 0.01: β ≤ 0.12652, so 25 of them.
        assert_eq!(arc.len(), 26);
        let turns: Vec<f64> = arc.iter().map(|p| p[1].atan2(p[0] - 5.0)).collect();
        assert!(turns.windows(2).skip(1).all(|w| (w[1] - w[0] - std::f64::consts::PI / 25.0).abs() < 1e-12));
        // The same as POLYLINE, clockwise: through the north; the arc is that of the closing segment.
        let old = "0 POLYLINE 8 PAD 66 1 70 1 10 0 20 0 30 7 0 VERTEX 10 0 20 0 0 VERTEX 10 10 20 0 42 1 0 SEQEND";
        let north = places(&lines(drawing(old))[0]);
        assert_eq!(north.len(), 27);
        assert!(north[2..26].iter().all(|p| ((p[0] - 5.0).hypot(p[1]) - 5.0).abs() < 1e-14 && p[1] > 0.0 && p[2] == 7.0));
        // A finer chord.
        let fine = ReadOptions { chord: 0.001, ..options() };
        assert_eq!(read_with(drawing(old), &fine).unwrap().lines[0].vertices.len(), 81);
    }

    /// The bound on chords is in the unit of the run: 0.01 ft of a drawing in metres are 0.003048 m.
    #[test]
    fn arcs_of_another_unit() {
        let arc = "0 LWPOLYLINE 8 PAD 70 1 38 7 10 0 20 0 42 1 10 10 20 0";
        let head = |units: u32| text(&format!("0 SECTION 2 HEADER 9 $INSUNITS 70 {units} 0 ENDSEC"));
        let count = |units: u32, unit: Option<LengthUnit>| {
            let read = read_with(head(units) + &drawing(arc), &ReadOptions { unit, ..options() }).unwrap();
            assert_eq!(codes(&read.notes), [""; 0]);
            read.lines[0].vertices.len() - 2
        };
        // 5·(1 − cos(β/2)) ≤ 0.003048: β ≤ 0.069838, 45 chords. The other way round 0.01 m are 0.0328 ft: β ≤ 0.229205, 14 chords.
        assert_eq!((count(6, None), count(6, Some(LengthUnit::Metre)), count(6, Some(LengthUnit::Foot))), (25, 25, 45));
        assert_eq!((count(2, None), count(2, Some(LengthUnit::Metre)), count(0, Some(LengthUnit::Foot))), (25, 14, 25));
    }

    #[test]
    fn seen_from_below() {
        // With the extrusion 0,0,−1 the x of the system runs west and its z down; the bulge turns the other way.
        let read = lines(drawing("0 LWPOLYLINE 8 PAD 70 0 38 -7 10 0 20 0 42 1 10 -10 20 0 210 0 220 0 230 -1"));
        let found = places(&read[0]);
        assert_eq!((found[0], found[25]), ([0.0, 0.0, 7.0], [10.0, 0.0, 7.0]));
        // In its system counter-clockwise from east to west: through the north.
        assert!(found[1..25].iter().all(|p| ((p[0] - 5.0).hypot(p[1]) - 5.0).abs() < 1e-14 && p[1] > 0.0));
    }

    #[test]
    fn in_a_tilted_plane() {
        // Extrusion (0, −s, s) with s = 1/√2: the axes are (1, 0, 0) and (0, s, s). Elevation 10·√2 lifts by (0, −10, 10).
        let read = lines(drawing(&format!("0 LWPOLYLINE 38 {} 10 0 20 0 42 1 10 10 20 0 210 0 220 -3 230 3", 200_f64.sqrt())));
        let found = places(&read[0]);
        close(&[found[0], found[25]], &[[0.0, -10.0, 10.0], [10.0, -10.0, 10.0]], 1e-14);
        for [x, y, z] in found {
            let radius = (x - 5.0).hypot((z - 10.0) * 2_f64.sqrt());
            assert!((radius - 5.0).abs() < 1e-14 && (z - y - 20.0).abs() < 1e-14 && z <= 10.0 + 1e-14, "{x} {y} {z}");
        }
    }

    #[test]
    fn heights_of_two_dimensional_ones() {
        let old = |elevation: &str, z: [&str; 2]| {
            let [a, b] = z;
            drawing(&format!(
                "0 POLYLINE 8 A 66 1 10 0 20 0 30 {elevation} 0 VERTEX 10 1 20 1 30 {a} 0 VERTEX 10 2 20 1 30 {b} 0 SEQEND"
            ))
        };
        let heights = |text: String| lines(text)[0].vertices.iter().map(|v| v.z).collect::<Vec<_>>();
        assert_eq!(heights(old("5", ["0", "0"])), [Some(5.0); 2]);
        assert_eq!(heights(old("5", ["5", "0"])), [Some(5.0); 2]);
        assert_eq!(heights(old("0", ["3", "4"])), [Some(3.0), Some(4.0)]);
        assert_eq!(codes(&read_with(old("0", ["3", "4"]), &options()).unwrap().notes), ["dxf-heights"]);
        // Two elevations, and none.
        let message = error(old("5", ["5", "6"]));
        assert!(message.contains("a.dxf, line 27\n   = elevation of the polyline 5, of this vertex 6"), "{message}");
        assert_eq!(heights(old("0", ["0", "0"])), [None; 2]);
        for flat in ["0 LWPOLYLINE 10 0 20 0 10 1 20 1", "0 LWPOLYLINE 38 0.0 10 0 20 0 10 1 20 1"] {
            let raw = read_with(drawing(flat), &options()).unwrap();
            let message = validate::check(&raw, &validate::Options::default()).unwrap_err().to_string();
            assert!(message.contains("no elevation") && message.contains("3D polyline"), "{message}");
        }
        // A 3D polyline at 0 says so, and is believed.
        let zero = read_with(drawing("0 LINE 10 0 20 0 30 0 11 1 21 1 31 0"), &options()).unwrap();
        assert_eq!((zero.lines[0].vertices[0].z, codes(&zero.notes)), (Some(0.0), vec!["dxf-zero"]));
    }

    #[test]
    fn counts_are_not_believed() {
        for count in ["2", "4", "-1", "1000000000", "9223372036854775807"] {
            let text = drawing(&format!("0 LWPOLYLINE 90 {count} 38 1 10 0 20 0 10 1 20 0 10 2 20 5"));
            let read = read_with(text, &options()).unwrap();
            assert_eq!((read.lines[0].vertices.len(), codes(&read.notes)), (3, vec!["dxf-count"]));
        }
    }
}

mod single_lines {
    use super::*;

    #[test]
    fn are_joined() {
        let read = read_with(
            drawing(
                "0 LINE 8 A 10 1 20 0 30 5 11 2 21 0 31 6 0 LINE 8 B 10 2 20 0 30 6 11 2 21 2 31 7 0 LINE 8 A 10 3 20 0 30 7 11 2 21 0 \
                 31 6 0 LINE 8 A 10 3 20 0 30 7.001 11 9 21 0 31 6",
            ),
            &options(),
        )
        .unwrap();
        let names: Vec<_> = read.lines.iter().map(|line| line.name.clone().unwrap()).collect();
        // Another layer, and another height: no joint.
        assert_eq!(names, ["A 1", "B", "A 2"]);
        assert_eq!(places(&read.lines[0]), [[1.0, 0.0, 5.0], [2.0, 0.0, 6.0], [3.0, 0.0, 7.0]]);
        assert_eq!(codes(&read.notes), ["dxf-lines-joined", "dxf-layers"]);
    }

    #[test]
    fn a_long_line_in_any_order() {
        // Every seventh, modulo a prime: neighbours are far from each other in the file.
        const N: usize = 1009;
        let line = |i: usize| {
            let (a, b) = (i, i + 1);
            format!("0 LINE 8 A 10 {a} 20 {} 30 {b} 11 {b} 21 {} 31 {} ", a * a, b * b, b + 1)
        };
        let text: String = (0..N).map(|i| line(i * 7 % N)).collect();
        let read = lines(drawing(&text));
        assert_eq!(read.len(), 1);
        assert!(read[0].vertices.iter().enumerate().all(|(i, v)| v.x == i as f64) && read[0].vertices.len() == N + 1);
    }
}

mod arcs {
    use super::*;

    #[test]
    fn between_lines() {
        // An exploded line: west, a quarter circle of radius 10 about (10, 20), counter-clockwise from south to east, north.
        let read = read_with(
            drawing(
                "0 LINE 8 A 10 0 20 10 30 7 11 10 21 10 31 7 0 ARC 8 A 10 10 20 20 30 7 40 10 50 270 51 0 0 LINE 8 A 10 20.000001 20 20 30 7 \
                 11 20 21 30 31 9",
            ),
            &options(),
        )
        .unwrap();
        assert_eq!(codes(&read.notes), ["dxf-lines-joined"]);
        let found = places(&read.lines[0]);
        let n = found.len();
        close(
            &[found[0], found[1], found[n - 2], found[n - 1]],
            &[[0.0, 10.0, 7.0], [10.0, 10.0, 7.0], [20.0, 20.0, 7.0], [20.0, 30.0, 9.0]],
            1e-14,
        );
        assert!(found[1..n - 1].iter().all(|p| ((p[0] - 10.0).hypot(p[1] - 20.0) - 10.0).abs() < 1e-13 && p[2] == 7.0));
        // Halves of 45°, chords of β with 10·(1 − cos(β/2)) ≤ 0.01, β ≤ 0.08945: nine each.
        assert_eq!(n, 21);
    }

    #[test]
    fn of_all_angles() {
        let ends = |start: &str, end: &str| {
            let found = places(&lines(drawing(&format!("0 ARC 10 0 20 0 30 1 40 1 50 {start} 51 {end}")))[0]);
            let length: f64 = found.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
            ([found[0][0], found[0][1], found[found.len() - 1][0], found[found.len() - 1][1]], length)
        };
        let half = 0.5_f64.sqrt();
        for (start, end, wanted, degrees) in [
            ("0", "90", [1.0, 0.0, 0.0, 1.0], 90.0),
            ("315", "45", [half, -half, half, half], 90.0),
            ("-45", "-315", [half, -half, half, half], 90.0),
            ("90", "0", [0.0, 1.0, 1.0, 0.0], 270.0),
            ("0", "360", [1.0, 0.0, 1.0, 0.0], 360.0),
            ("10", "9.999", [0.984807753012208, 0.17364817766693036, 0.9848107838, 0.1736309897], 359.999),
        ] {
            let (found, length) = ends(start, end);
            assert!((0..4).all(|i| (found[i] - wanted[i]).abs() < 1e-9), "{start} {end}: {found:?}");
            // Chords are shorter than the arc, by less than a hundredth here.
            let arc = f64::to_radians(degrees);
            assert!(length < arc && length > 0.99 * arc, "{start} {end}: {length} {arc}");
        }
        // Seen from below, the angles run clockwise from west.
        let below = places(&lines(drawing("0 ARC 10 0 20 0 30 -1 40 1 50 0 51 90 210 0 220 0 230 -1"))[0]);
        close(&[below[0], below[below.len() - 1]], &[[-1.0, 0.0, 1.0], [0.0, 1.0, 1.0]], 1e-15);
    }
}

mod layers {
    use super::*;

    fn table() -> String {
        let layers = "0 SECTION 2 TABLES 0 TABLE 2 LAYER 70 3 0 LAYER 2 Achse 70 0 62 7 0 LAYER 2 ALT 70 0 62 -7 0 LAYER 2 EIS 70 1 62 \
                      7 0 ENDTAB 0 ENDSEC";
        let line = |layer: &str, more: &str| format!("0 LINE 8 {layer} {more} 10 0 20 0 30 1 11 1 21 1 31 2 ");
        let all = [("ACHSE", ""), ("alt", ""), ("EIS", ""), ("Neu", ""), ("Neu", "67 1"), ("Achse", "60 1")];
        let entities: String = all
            .iter()
            .enumerate()
            .map(|(i, (l, more))| line(l, more).replace("30 1", &format!("30 {i}")).replace("11 1", &format!("11 {i}")))
            .collect();
        text(&format!(
            "{layers} 0 SECTION 2 ENTITIES {entities} 0 CIRCLE 8 Neu 40 1 0 TEXT 8 Neu 1 x 0 CIRCLE 8 ALT 0 ENDSEC 0 EOF"
        ))
    }

    fn first_heights(options: &ReadOptions) -> Result<Vec<f64>, String> {
        read_with(table(), options).map(|read| read.lines.iter().map(|line| line.vertices[0].z.unwrap()).collect())
    }

    #[test]
    fn that_are_on() {
        // Not what is off, frozen, on a sheet or invisible.
        assert_eq!(first_heights(&options()), Ok(vec![0.0, 3.0]));
        let notes = read_with(table(), &options()).unwrap().notes;
        assert_eq!(codes(&notes), ["dxf-layers", "dxf-hidden", "dxf-ignored"]);
        assert!(notes[0].message.contains("`Achse`: 1; `Neu`: 1"), "{}", notes[0].message);
        assert!(notes[1].message.contains("3 entities"), "{}", notes[1].message);
        assert!(notes[2].message.ends_with("1 CIRCLE; 1 TEXT"), "{}", notes[2].message);
    }

    #[test]
    fn by_name() {
        assert_eq!(first_heights(&pick(&["aLt", "eis"], &[])), Ok(vec![1.0, 2.0]));
        assert_eq!(first_heights(&pick(&["Achse"], &[])), Ok(vec![0.0, 5.0]));
        assert_eq!(first_heights(&pick(&["Achse"], &["achse 2"])), Ok(vec![5.0]));
        let message = first_heights(&pick(&["axis"], &[])).unwrap_err();
        assert!(message.contains("no layer `axis`") && message.contains("`ALT` (off): 1 line, 1 other entity"), "{message}");
        let message = first_heights(&pick(&[], &["axis"])).unwrap_err();
        assert!(message.contains("no line `axis`") && message.contains("`Achse`; `Neu`"), "{message}");
    }

    #[test]
    fn of_another_alphabet() {
        let line = "0 LINE 8 NAME 10 0 20 0 30 1 11 1 21 1 31 2";
        for name in ["Böschung".as_bytes(), b"B\xF6schung", b"B\\U+00F6schung"] {
            let text = drawing(line).into_bytes();
            let at = text.windows(4).position(|w| w == b"NAME").unwrap();
            let text = [&text[..at], name, &text[at + 4..]].concat();
            let read = read_with(&text, &pick(&["BÖSCHUNG"], &[])).unwrap();
            assert_eq!(read.lines[0].name.as_deref(), Some("Böschung"));
        }
    }
}

mod blocks {
    use super::*;

    #[test]
    fn lie_where_another_program_puts_them() {
        let table = std::fs::read_to_string(fixture("blocks.csv")).unwrap();
        let wanted: Vec<(String, [f64; 3])> = table
            .lines()
            .skip(1)
            .map(|row| {
                let fields: Vec<_> = row.split(',').collect();
                (fields[0].to_owned(), [1, 2, 3].map(|i| fields[i].parse().unwrap()))
            })
            .collect();
        let read = read::read_line(&fixture("blocks.dxf"), &options()).unwrap();
        let found: Vec<(String, [f64; 3])> = read
            .lines
            .iter()
            .flat_map(|line| {
                let layer = line.name.as_deref().unwrap().split(' ').next().unwrap().to_owned();
                places(line).into_iter().map(move |p| (layer.clone(), p))
            })
            .collect();
        assert!(wanted.len() > 90);
        assert_eq!(found.iter().map(|f| &f.0).collect::<Vec<_>>(), wanted.iter().map(|w| &w.0).collect::<Vec<_>>());
        let bare = |list: &[(String, [f64; 3])]| list.iter().map(|(_, p)| *p).collect::<Vec<_>>();
        // Coordinates of 5·10⁶ resolve 10⁻⁹.
        close(&bare(&found), &bare(&wanted), 4e-9);
    }

    const LINE: &str = "0 LINE 8 0 10 3 20 1 30 2 11 4 21 1 31 2";

    #[test]
    fn turned_scaled_repeated() {
        let block = format!("0 BLOCK 2 B 10 1 20 1 30 0 {LINE} 0 ENDBLK");
        let read =
            lines(with_blocks(&block, "0 INSERT 8 CL 2 b 10 100 20 200 30 10 41 2 42 3 43 0.5 50 90 70 2 71 2 44 10 45 20"));
        // (x − 1, y − 1) is scaled and turned by a right angle: the line runs north. Columns go north, rows west.
        let at = |x: f64, y: f64| [[x, y + 4.0, 11.0], [x, y + 6.0, 11.0]];
        let wanted = [at(100.0, 200.0), at(100.0, 210.0), at(80.0, 200.0), at(80.0, 210.0)];
        assert_eq!(read.iter().map(places).collect::<Vec<_>>(), wanted.map(|line| line.to_vec()));
        // On layer 0 of the block: that of the insert.
        assert_eq!(read[3].name.as_deref(), Some("CL 4"));
    }

    #[test]
    fn arcs_in_scaled_blocks_keep_the_chord() {
        let block = "0 BLOCK 2 B 0 LWPOLYLINE 8 0 38 1 10 0 20 0 42 1 10 1 20 0 0 ENDBLK";
        let read = lines(with_blocks(block, "0 INSERT 2 B 41 10 42 10 43 10"));
        // As large as the half circle of radius 5 above.
        assert_eq!(read[0].vertices.len(), 26);
    }

    #[test]
    fn elevations_of_their_inserts_count() {
        let block = "0 BLOCK 2 B 0 LWPOLYLINE 8 0 10 0 20 0 10 1 20 0 0 ENDBLK";
        assert_eq!(lines(with_blocks(block, "0 INSERT 2 B 30 12.5"))[0].vertices[1].z, Some(12.5));
        assert_eq!(lines(with_blocks(block, "0 INSERT 2 B"))[0].vertices[1].z, None);
    }

    #[test]
    fn that_are_not_there() {
        let read = read_with(
            with_blocks("0 BLOCK 2 X 70 4 1 other.dwg 0 ENDBLK", &format!("{POLYLINE} 0 INSERT 2 no 0 INSERT 2 X")),
            &options(),
        );
        let notes = read.unwrap().notes;
        assert_eq!(codes(&notes), ["dxf-blocks-missing"]);
        assert!(notes[0].message.contains("2 inserts") && notes[0].message.contains("`no`"));
    }

    #[test]
    fn inside_themselves() {
        let own = with_blocks(&format!("0 BLOCK 2 A {LINE} 0 INSERT 2 a 0 ENDBLK"), "0 INSERT 2 A");
        let message = error(own);
        assert!(
            message.contains("contains itself") && message.contains("a.dxf, line 25") && message.contains("help"),
            "{message}"
        );
        let two = "0 BLOCK 2 A 0 INSERT 2 B 0 ENDBLK 0 BLOCK 2 B 0 INSERT 2 A 0 ENDBLK";
        assert!(error(with_blocks(two, "0 INSERT 2 A")).contains("through 2 blocks"));
        // Never inserted: no matter.
        assert_eq!(lines(with_blocks(two, LINE)).len(), 1);
        let deep: String = (0..200).map(|i| format!("0 BLOCK 2 B{i} {LINE} 0 INSERT 2 B{} 0 ENDBLK ", i + 1)).collect();
        assert!(error(with_blocks(&deep, "0 INSERT 2 B0")).contains("inside 32 others"));
    }

    #[test]
    fn bombs() {
        let start = Instant::now();
        let huge = "0 INSERT 2 A 70 32767 71 32767 44 1 45 1";
        for (blocks, insert) in [
            (format!("0 BLOCK 2 A {LINE} 0 ENDBLK"), huge),
            ("0 BLOCK 2 A 0 ENDBLK".to_owned(), huge),
            (format!("0 BLOCK 2 A {LINE} 0 ENDBLK"), "0 INSERT 2 A 70 9223372036854775807 71 9223372036854775807"),
            (
                // Ten of the next, nine times over.
                (0..9)
                    .map(|i| {
                        format!(
                            "0 BLOCK 2 {} {} 0 ENDBLK ",
                            "A".repeat(i + 1),
                            format!("0 INSERT 2 {} ", "A".repeat(i + 2)).repeat(10)
                        )
                    })
                    .chain([format!("0 BLOCK 2 {} {LINE} 0 ENDBLK", "A".repeat(10))])
                    .collect(),
                "0 INSERT 2 A",
            ),
        ] {
            let message = error(with_blocks(&blocks, insert));
            assert!(message.contains("expand to too much"), "{message}");
            assert!(ground(with_blocks(&blocks, insert)).unwrap_err().contains("expand to too much"));
        }
        // Symbols at every point are no bomb: a hundred pairs each.
        let symbol = "0 CIRCLE 10 1 20 1 40 1 ".repeat(24);
        let inserts: String = (0..25_000).map(|i| format!("0 INSERT 2 S 10 {i} 20 {} ", i % 100)).collect();
        let points = ground(with_blocks(&format!("0 BLOCK 2 S {symbol} 0 POINT 10 0 20 0 30 7 0 ENDBLK"), &inserts)).unwrap();
        assert!(matches!(&points.ground, RawGround::Points(list) if list.len() == 25_000));
        // No copies, or fewer, are one.
        assert_eq!(lines(with_blocks(&format!("0 BLOCK 2 A {LINE} 0 ENDBLK"), "0 INSERT 2 A 70 0 71 -5")).len(), 1);
        assert!(start.elapsed() < Duration::from_secs(60), "{:?}", start.elapsed());
    }

    #[test]
    fn arcs_of_too_many_points() {
        let start = Instant::now();
        for bulge in ["1e300", "1e7", "-1e12", "1"] {
            let message = error(drawing(&format!("0 LWPOLYLINE 38 1 10 0 20 0 42 {bulge} 10 1e300 20 0")));
            assert!(message.contains("too many points"), "{message}");
        }
        assert!(start.elapsed() < Duration::from_secs(10));
    }
}

mod of_ground {
    use super::*;

    fn face(corners: [[f64; 3]; 4]) -> String {
        let pairs = corners.iter().enumerate().map(|(i, [x, y, z])| format!("1{i} {x} 2{i} {y} 3{i} {z}"));
        format!("0 3DFACE 8 DGM {} ", pairs.collect::<Vec<_>>().join(" "))
    }

    const A: [f64; 3] = [0.0, 0.0, 1.0];
    const B: [f64; 3] = [10.0, 0.0, 2.0];
    const C: [f64; 3] = [10.0, 10.0, 3.0];
    const D: [f64; 3] = [0.0, 10.0, 4.0];

    fn mesh(text: impl AsRef<[u8]>) -> (Vec<[f64; 3]>, RawFaces) {
        match ground(text).unwrap().ground {
            RawGround::Mesh { vertices, faces } => (vertices.iter().map(|v| v.to_array()).collect(), faces),
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn faces_share_their_corners() {
        let (vertices, faces) = mesh(drawing(&format!("{}{}", face([A, B, C, C]), face([A, C, D, D]))));
        assert_eq!(vertices, [A, B, C, D]);
        assert_eq!(faces, RawFaces::Triangles(vec![[0, 1, 2], [0, 2, 3]]));
        // Four corners; the fourth the first; two corners only.
        let (_, faces) = mesh(drawing(&format!("{}{}{}", face([A, B, C, D]), face([A, B, C, A]), face([A, A, B, B]))));
        assert_eq!(faces, RawFaces::Polygons { corners: vec![0, 1, 2, 3, 0, 1, 2, 0, 1, 1], ends: vec![4, 7, 10] });
    }

    /// Few programs leave the fourth corner of triangles out; then it is the third, and not the origin.
    #[test]
    fn faces_without_fourth_corner() {
        let of = |corners: [[f64; 3]; 4]| face(corners).split(" 13 ").next().unwrap().to_owned() + " ";
        let (vertices, faces) = mesh(drawing(&format!("{}{}", of([B, C, D, A]), face([B, D, A, A]))));
        assert_eq!(vertices, [B, C, D, A]);
        assert_eq!(faces, RawFaces::Triangles(vec![[0, 1, 2], [0, 2, 3]]));
        let message = ground(drawing(&(of([B, C, D, A]) + "13 5 33 1"))).unwrap_err();
        assert!(message.contains("a.dxf, line 5\n") && message.contains("no y (group codes 20 to 23)"), "{message}");
        let message = ground(drawing("0 POINT 8 P 30 3")).unwrap_err();
        assert!(message.contains("neither x (group codes 10 to 13) nor y"), "{message}");
    }

    #[test]
    fn meshes_of_polylines() {
        let vertex = |[x, y, z]: [f64; 3], flags: i32| format!("0 VERTEX 10 {x} 20 {y} 30 {z} 70 {flags} ");
        let points = |flags: i32| [A, B, C, D].map(|p| vertex(p, flags)).concat();
        let polyface = |faces: &str| drawing(&format!("0 POLYLINE 8 DGM 66 1 70 64 71 4 72 2 {} {faces} 0 SEQEND", points(192)));
        let record = |corners: &str| format!("0 VERTEX 10 0 20 0 30 0 70 128 {corners} ");
        let wanted = (vec![A, B, C, D], RawFaces::Triangles(vec![[0, 1, 2], [0, 2, 3]]));
        // Negative numbers hide edges.
        assert_eq!(mesh(polyface(&(record("71 1 72 -2 73 3") + &record("71 1 72 3 73 -4 74 0")))), wanted);
        let quad = RawFaces::Polygons { corners: vec![0, 1, 2, 3], ends: vec![4] };
        assert_eq!(mesh(polyface(&record("71 1 72 2 73 3 74 4"))).1, quad);
        for corner in ["5", "-5", "9223372036854775807", "-9223372036854775808"] {
            let message = ground(polyface(&record(&format!("71 1 72 2 73 {corner}")))).unwrap_err();
            assert!(message.contains("corner that is not there") && message.contains("4 points"), "{message}");
        }
        // Two by two points in rows: the second row is D, C.
        let net = |size: &str| {
            let rows = [A, B, D, C].map(|p| vertex(p, 64)).concat();
            drawing(&format!("0 POLYLINE 8 DGM 66 1 70 16 {size} {rows} 0 SEQEND"))
        };
        let (vertices, faces) = mesh(net("71 2 72 2"));
        assert_eq!(vertices, [A, B, D, C]);
        assert_eq!(faces, RawFaces::Polygons { corners: vec![0, 2, 3, 1], ends: vec![4] });
        // Closed in one direction, in both.
        let round = |flags: u32| {
            let rows = [A, B, C, D, [5.0, 5.0, 5.0], [6.0, 6.0, 6.0]].map(|p| vertex(p, 64)).concat();
            mesh(drawing(&format!("0 POLYLINE 66 1 70 {flags} 71 3 72 2 {rows} 0 SEQEND"))).1
        };
        let closed = RawFaces::Polygons { corners: vec![0, 2, 3, 1, 2, 4, 5, 3, 4, 0, 1, 5], ends: vec![4, 8, 12] };
        assert_eq!((round(17), round(49).len(), round(16).len(), round(48).len()), (closed, 6, 2, 4));
        for size in ["71 3 72 2", "71 2000000000 72 2000000000", "71 -2 72 -2", "71 4 72 1", ""] {
            let message = ground(net(size)).unwrap_err();
            assert!(message.contains("polygon mesh of the drawing is damaged") && message.contains("4 are there"), "{message}");
        }
    }

    #[test]
    fn points_where_there_are_no_faces() {
        let points = "0 POINT 8 P 10 1 20 2 30 3 0 POINT 8 P 10 4 20 5 30 6 0 POINT 8 P 10 9 20 2 30 1";
        let read = ground(drawing(points)).unwrap();
        assert!(matches!(&read.ground, RawGround::Points(list) if list.len() == 3 && list[1].to_array() == [4.0, 5.0, 6.0]));
        let both = ground(drawing(&format!("{points} {}", face([A, B, C, C])))).unwrap();
        assert!(matches!(&both.ground, RawGround::Mesh { vertices, .. } if vertices.len() == 3));
        assert_eq!(codes(&both.notes), ["dxf-points-ignored"]);
        let message = ground(drawing(&format!("{POLYLINE} 0 MESH 8 DGM"))).unwrap_err();
        assert!(message.contains("no ground") && message.contains("`CL`: 1 line; `DGM`: 1 other entity"), "{message}");
    }

    #[test]
    fn of_one_layer() {
        let text = drawing(&format!("{}{}", face([A, B, C, C]), face([A, C, D, D]).replace("DGM", "OLD")));
        let pick = Pick { layers: vec!["old".into()], ..Pick::default() };
        let read = parse_terrain("a.dxf", text.as_bytes(), &TerrainOptions { pick, ..TerrainOptions::default() }).unwrap();
        assert!(matches!(&read.ground, RawGround::Mesh { vertices, .. } if vertices[2].to_array() == D));
    }

    #[test]
    fn in_blocks_moved() {
        let block = format!("0 BLOCK 2 B {} 0 ENDBLK", face([A, B, C, C]));
        let (vertices, _) = mesh(with_blocks(&block, "0 INSERT 2 B 10 100 20 200 30 300"));
        assert_eq!(vertices, [[100.0, 200.0, 301.0], [110.0, 200.0, 302.0], [110.0, 210.0, 303.0]]);
        let message = ground(with_blocks(&block, "0 INSERT 2 B 41 1e308 10 1e308")).unwrap_err();
        assert!(message.contains("not finite"), "{message}");
    }
}

mod files {
    use super::*;

    #[test]
    fn units() {
        let with = |code: &str| {
            let text = text(&format!("0 SECTION 2 HEADER 9 $INSUNITS 70 {code} 9 $X 70 21 0 ENDSEC")) + &drawing(POLYLINE);
            let read = read_with(text, &options()).unwrap();
            (read.source.unit, codes(&read.notes))
        };
        assert_eq!(with("6"), (Some(LengthUnit::Metre), vec![]));
        assert_eq!(with("2"), (Some(LengthUnit::Foot), vec![]));
        assert_eq!(with("21"), (Some(LengthUnit::UsSurveyFoot), vec![]));
        assert_eq!(with("0"), (None, vec![]));
        for template in ["1", "4", "5", "-7", "99"] {
            assert_eq!(with(template), (None, vec!["dxf-units"]));
        }
    }

    #[test]
    fn binary_ones_of_another_program() {
        for name in ["binary_r12.dxf", "binary_r2000.dxf"] {
            let read = read::read_line(&fixture(name), &options()).unwrap();
            let wanted = [[500010.0, 5400020.0, 401.5], [500022.25, 5400031.125, 402.0], [500040.5, 5400029.75, 402.875]];
            assert_eq!(read.lines.iter().map(places).collect::<Vec<_>>(), [wanted]);
            assert_eq!(codes(&read.notes), ["dxf-hidden"]);
            // Told by its content.
            let bytes = std::fs::read(fixture(name)).unwrap();
            let read = parse_terrain(name, &bytes, &TerrainOptions::default()).unwrap();
            assert!(matches!(&read.ground, RawGround::Mesh { vertices, faces: RawFaces::Triangles(t) }
                if vertices.len() == 4 && *t == [[0, 1, 2], [0, 2, 3]] && vertices[3].z == 401.25));
            // R12 has no units.
            assert_eq!(read.source.unit, name.contains("2000").then_some(LengthUnit::Metre));
        }
    }

    #[test]
    fn that_are_none() {
        for (bytes, words) in [
            (&b""[..], "the file is empty"),
            (b"\r\n \n", "the file is empty"),
            (b"AC1032\0\0\0", "DWG"),
            (b"x,y,z\n1,2,3\n", "`x,y,z` where a group code"),
            (b"  0\nSECTION\n  2\nHEADER\n", "cut off"),
            (b"  0\nEOF\n", "no lines"),
            (b"AutoCAD Binary DXF\r\n\x1a\0", "cut off"),
        ] {
            let message = error(bytes);
            assert!(message.contains(words) && message.contains("help"), "{message}");
        }
        assert!(error(drawing("0 CIRCLE 8 A 40 1")).contains("`A`: 1 other entity"));
        assert!(error(drawing("0 POLYLINE 8 A 70 8 0 VERTEX 10 1 20 2 0 LINE 10 1")).contains("do not end with SEQEND"));
    }

    #[test]
    fn places_of_wrong_values() {
        for (entity, line, words) in [
            ("0 LINE 8 A 10 1,5 20 0", 10, "group code 10: `1,5`"),
            ("0 LINE 8 A 10 nan 20 0", 10, "finite number"),
            ("0 LWPOLYLINE 8 A 10 1 20 x", 12, "group code 20: `x`"),
            ("0 LWPOLYLINE 70 1.5", 8, "whole number"),
            ("0 LINE 8 A 1x 1", 9, "`1x` where a group code"),
            ("0 LINE 8 A 10 1 20 2 30 3", 5, "lacks coordinates\n  --> a.dxf, line 5\n   = neither x"),
            ("0 LINE 8 A 10 1 20 2 11 3", 5, "no y"),
            ("0 LWPOLYLINE 8 A 10 1 20 2 10 3", 13, "no y"),
            ("0 POLYLINE 70 8 0 VERTEX 10 1 20 2 0 VERTEX 20 3 0 SEQEND", 15, "no x"),
        ] {
            let message = error(drawing(entity));
            assert!(message.contains(&format!("a.dxf, line {line}\n")) && message.contains(words), "{message}");
        }
        // Values nobody needs may be anything.
        assert_eq!(lines(drawing(&format!("0 CIRCLE 10 x 20 y 60 z {POLYLINE} 0 HATCH 210 w"))).len(), 1);
    }

    #[test]
    fn all_spellings_of_the_same() {
        let plain = drawing(POLYLINE);
        let places_of = |text: &[u8]| places(&lines(text)[0]);
        let wanted = places_of(plain.as_bytes());
        let comment = text("999 written 999 SECTION") + &plain;
        for other in [
            plain.replace('\n', "\r\n"),
            plain.replace('\n', "\r"),
            plain.trim_end().to_owned(),
            plain.clone() + "\n\n\u{1a}",
            format!("\u{feff}{plain}"),
            plain.replace("\n ", "\n").replace("VERTEX\n", "VERTEX \n"),
            comment.clone(),
            // Entries of programs and extended data.
            drawing(&POLYLINE.replace("20 2", "102 {ACAD 330 1F 102 } 1001 APP 1010 99 1020 99 1030 99 20 2")),
        ] {
            assert_eq!(places_of(other.as_bytes()), wanted, "{other}");
        }
        let face = drawing("0 3DFACE 10 0 20 0 30 1 11 1 21 0 31 1 12 1 22 1 32 1 13 1 23 1 33 1");
        assert!(parse_terrain("a", (text("999 x") + &face).as_bytes(), &TerrainOptions::default()).is_ok());
    }

    /// Small drawings of all kinds.
    fn samples() -> Vec<Vec<u8>> {
        let mut list = vec![drawing(POLYLINE).into_bytes()];
        let layers = "0 SECTION 2 HEADER 9 $INSUNITS 70 6 0 ENDSEC 0 SECTION 2 TABLES 0 TABLE 2 LAYER 0 LAYER 2 A 70 0 62 -1 0 ENDTAB 0 \
                      ENDSEC";
        let block = "0 BLOCK 2 B 10 1 20 0 30 0 0 LWPOLYLINE 8 0 90 2 70 1 38 4 10 0 20 0 42 1 10 5 20 5 0 LINE 10 0 20 0 30 1 11 1 21 \
                     1 31 1 0 ENDBLK";
        let faces = "0 3DFACE 10 0 20 0 30 1 11 1 21 0 31 1 12 1 22 1 32 1 13 0 23 1 33 1 0 POINT 10 1 20 1 30 1 0 POLYLINE 66 1 70 64 0 \
                     VERTEX 10 0 20 0 30 0 70 192 0 VERTEX 10 9 20 0 30 0 70 192 0 VERTEX 10 9 20 9 30 0 70 192 0 VERTEX 70 128 71 1 72 2 \
                     73 3 0 SEQEND";
        let insert = "0 INSERT 2 B 10 5 20 5 30 5 41 2 50 33 70 2 71 2 44 3 45 3 210 0 220 0.5 230 1";
        list.push((text(layers) + &with_blocks(block, &format!("{insert} {faces}"))).into_bytes());
        list.extend(["binary_r12.dxf", "binary_r2000.dxf"].map(|name| std::fs::read(fixture(name)).unwrap()));
        list
    }

    #[test]
    fn cut_off_anywhere() {
        for whole in samples() {
            assert!(read_with(&whole, &options()).is_ok());
            assert!(!whole.starts_with(b"  0\nSECTION\n  2\nHEADER") || ground(&whole).is_ok());
            let mark = whole.windows(3).rposition(|w| w == b"EOF").unwrap();
            for length in 0..mark + 3 {
                let message = error(&whole[..length]);
                assert!(message.contains("-->") && message.contains("help"), "{message}");
                assert!(ground(&whole[..length]).is_err());
            }
        }
    }

    #[test]
    fn lines_left_out_or_doubled() {
        // No panic, and no endless work; what comes out is up to the line.
        for whole in &samples()[..2] {
            let rows: Vec<&[u8]> = whole.split_inclusive(|&b| b == b'\n').collect();
            for i in 0..rows.len() {
                for piece in [&[][..], &[rows[i], rows[i]], &[rows[i], rows[i], rows[i]], &[b"-1\n"], &[b"99999\n"]] {
                    let text = [&rows[..i], piece, &rows[i + 1..]].concat().concat();
                    let _ = (read_with(&text, &options()), ground(&text));
                }
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

        #[test]
        fn changed_bytes(which in 0..4_usize, changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..8)) {
            let mut bytes = samples().swap_remove(which);
            for (at, byte) in changes {
                let at = at.index(bytes.len());
                bytes[at] = byte;
            }
            let _ = (read_with(&bytes, &options()), ground(&bytes));
        }

        #[test]
        fn any_pairs(pairs in prop::collection::vec((0..80_i32, prop::sample::select(vec![
            "SECTION", "ENTITIES", "BLOCKS", "ENDSEC", "LINE", "LWPOLYLINE", "POLYLINE", "VERTEX", "SEQEND", "INSERT", "BLOCK", "ENDBLK",
            "3DFACE", "EOF", "1", "64", "16", "-3", "1e300", "0.5", "B",
        ])), 0..60)) {
            let mut text = String::from("0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nB\n");
            for (code, value) in pairs {
                let code = if code < 30 { 0 } else { code - 10 };
                text.push_str(&format!("{code}\n{value}\n"));
            }
            text.push_str("0\nEOF\n");
            let _ = (read_with(&text, &options()), ground(&text));
        }
    }
}

mod program {
    use super::*;

    fn run(folder: &std::path::Path, arguments: &str) -> (i32, String) {
        let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
            .args(arguments.split_whitespace())
            .current_dir(folder)
            .env("NO_COLOR", "1")
            .timeout(Duration::from_secs(120))
            .output()
            .unwrap();
        (output.status.code().unwrap_or(-1), String::from_utf8_lossy(&output.stderr).into_owned())
    }

    #[test]
    fn line_and_ground_of_one_drawing() {
        let folder = tempfile::tempdir().unwrap();
        let square = "0 LWPOLYLINE 8 PAD 90 4 70 1 38 105 10 40 20 40 10 60 20 40 10 60 20 60 10 40 20 60";
        let ground = "0 3DFACE 8 DGM 10 0 20 0 30 100 11 100 21 0 31 100 12 100 22 100 32 100 13 0 23 100 33 100";
        std::fs::write(folder.path().join("site.dxf"), drawing(&format!("{square} {ground} 0 CIRCLE 8 TXT 40 3"))).unwrap();
        let (code, errors) = run(
            folder.path(),
            "build site.dxf --layer pad --slope 1:2 --terrain site.dxf --terrain-layer dgm --report r.json -q",
        );
        assert_eq!(code, 0, "{errors}");
        let report: serde_json::Value = serde_json::from_slice(&std::fs::read(folder.path().join("r.json")).unwrap()).unwrap();
        // 20 by 20, 5 above the ground; at the height t below the edge the area is 400 + 80·2t + π·(2t)²: 4000 + 500π/3.
        let fill = 4000.0 + 500.0 * std::f64::consts::PI / 3.0;
        let figure = |name: &str| report["volumes"][name].as_f64().unwrap();
        assert!((figure("fill") - fill).abs() <= figure("error_bound") && figure("error_bound") < 0.001 * fill, "{report}");
        let (code, errors) = run(folder.path(), "build site.dxf --layer axis --slope 1:2");
        assert_eq!(code, 3);
        assert!(errors.starts_with("error: the drawing has no layer `axis`\n  --> site.dxf\n   = `PAD`: 1 line; `DGM`: 1 face; `TXT`: 1 other entity\n   = help: "), "{errors}");
    }

    #[test]
    fn tracks_are_refused() {
        let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
        for arguments in ["build fixtures/input/track.gpx --slope 1:2", "volume fixtures/input/track.gpx fixtures/ground.obj"] {
            let (code, errors) = run(&root, arguments);
            assert_eq!(code, 3, "{errors}");
            let figures = "3 track points, 1 way point; latitude 48.7501 to 48.7515, longitude 8.9987 to 9.0031";
            assert!(errors.contains(figures) && errors.contains("EPSG:32632"), "{errors}");
        }
        // A drawing is no mesh to check, whatever it is called.
        let (code, errors) = run(&root, "check fixtures/dxf/blocks.dxf");
        assert_eq!(code, 3, "{errors}");
    }
}
