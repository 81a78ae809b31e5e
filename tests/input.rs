//! What each file under `fixtures/input` must give: the same line, another line, or a pinned refusal.

use slopegen::model::{Line, Note, Role};
use slopegen::read::{self, CoordinateKind, RawInput, ReadOptions};
use slopegen::validate::{self, Options};
use std::path::PathBuf;

fn read(name: &str, order: Option<&str>) -> Result<RawInput, String> {
    let path = PathBuf::from("fixtures/input").join(name);
    let options = ReadOptions { csv_order: order.map(|o| o.parse().unwrap()), ..ReadOptions::default() };
    read::read_line(&path, &options).map_err(|e| e.to_string())
}

fn check(raw: &RawInput, closed: bool) -> Result<(Line, Vec<Note>), String> {
    validate::check(raw, &Options { closed }).map(|c| (c.line, c.notes)).map_err(|e| e.to_string())
}

fn line(name: &str) -> (Line, Vec<Note>) {
    check(&read(name, None).unwrap_or_else(|e| panic!("{name}: {e}")), false).unwrap_or_else(|e| panic!("{name}: {e}"))
}

fn refusal(name: &str) -> String {
    match read(name, None).and_then(|raw| check(&raw, false)) {
        Ok(_) => panic!("{name} was accepted"),
        Err(message) => message.replace('\\', "/"),
    }
}

/// The line most fixtures hold.
const LINE: [[f64; 3]; 4] = [
    [500_100.5, 5_400_200.25, 310.5],
    [500_130.125, 5_400_212.75, 311.25],
    [500_155.75, 5_400_240.5, 310.875],
    [500_160.25, 5_400_275.0, 309.125],
];

fn coordinates(line: &Line) -> Vec<Vec<[f64; 3]>> {
    line.chains.iter().map(|chain| chain.vertices.iter().map(|v| v.to_array()).collect()).collect()
}

#[test]
fn every_dialect_reads_alike() {
    let with_order = [("blanks.txt", "xyz"), ("no_header.csv", "enz"), ("pnezd.csv", "pnezd")];
    let with_header = [
        "line.csv",
        "bom_crlf.csv",
        "cr_only.csv",
        "no_final_newline.csv",
        "utf16le.csv",
        "utf16be.csv",
        "latin1_german.csv",
        "decimal_comma.csv",
        "decimal_comma_blanks.txt",
        "tab.txt",
        "blanks_header.txt",
        "comment_header.txt",
        "header_nez.csv",
        "quoted.csv",
        "comments.csv",
        "scientific.csv",
        "duplicates.csv",
        "double_spaced.csv",
        "point_number_as_id.csv",
        "geometry.geojson",
        "feature.geojson",
        "collection.geojson",
        "crs.geojson",
        "json_fg.geojson",
        "bom.geojson",
        "xyzm.geojson",
        "null_and_points.geojson",
        "geometry_collection.geojson",
    ];
    let all = with_order.map(|(name, order)| (name, Some(order))).into_iter().chain(with_header.map(|name| (name, None)));
    for (name, order) in all {
        let raw = read(name, order).unwrap_or_else(|e| panic!("{name}: {e}"));
        let (line, _) = check(&raw, false).unwrap_or_else(|e| panic!("{name}: {e}"));
        assert_eq!(coordinates(&line), [LINE.to_vec()], "{name}");
        assert_eq!(line.chains[0].role, Role::Open, "{name}");
    }
}

#[test]
fn sources_say_where_they_come_from() {
    let raw = read("crs.geojson", None).unwrap();
    assert_eq!(raw.source.crs.as_deref(), Some("urn:ogc:def:crs:EPSG::25832"));
    assert_eq!(raw.source.kind, CoordinateKind::Lengths);
    assert_eq!(read("json_fg.geojson", None).unwrap().source.crs.as_deref(), Some("[EPSG:25832]"));
    assert_eq!(read("header_nez.csv", None).unwrap().source.kind, CoordinateKind::Lengths);
    // The digest of no bytes at all is in FIPS 180-4's test vectors.
    let points = read::parse_points("a", b"x,y\n1,2\n", None).unwrap();
    assert_eq!(points.source.sha256.len(), 64);
    assert_eq!(line("feature.geojson").0.chains[0].name, "axis 7");
    assert_eq!(line("line.csv").0.chains[0].name, "line 1");
}

#[test]
fn notes_tell_what_was_done() {
    let notes = |name: &str| {
        let raw = read(name, None).unwrap();
        let checked = check(&raw, name == "ring_open.csv").unwrap();
        raw.notes.into_iter().chain(checked.1).map(|n| format!("{}: {}", n.code, n.message)).collect::<Vec<_>>()
    };
    assert_eq!(notes("decimal_comma.csv"), ["csv-dialect: 4 rows with header, separated by semicolon, decimal comma"]);
    assert_eq!(notes("duplicates.csv")[1], "duplicates-merged: vertices that repeat the one before within 0.000001 merged: 8");
    assert_eq!(
        notes("null_and_points.geojson"),
        [
            "null-geometry: features and parts without geometry passed over: 1",
            "points-ignored: points passed over: 1 (only lines are used)"
        ]
    );
    assert_eq!(notes("ring.csv")[1], "ring-detected: lines that end where they begin taken as rings: 1");
    assert_eq!(notes("ring_open.csv")[1], "ring-closed: open lines closed to rings, as asked: 1");
    assert_eq!(
        notes("polygon_open.geojson"),
        ["polygon-ring-open: polygon rings that do not repeat their first vertex closed: 1"]
    );
    assert!(notes("point_number_as_id.csv")[1].starts_with("id-is-point-number: "));
    assert!(notes("double_spaced.csv")[1].starts_with("blank-lines-ignored: "));
    assert!(notes("comment_header.txt")[0].starts_with("header-in-comment: "));
    assert!(notes("latin1_german.csv")[0].starts_with("encoding: "));
}

#[test]
fn several_lines() {
    let halves = vec![LINE[..2].to_vec(), LINE[2..].to_vec()];
    for name in ["line_ids.csv", "blank_separated.txt", "multi_line.geojson"] {
        assert_eq!(coordinates(&line(name).0), halves, "{name}");
    }
    assert_eq!(coordinates(&line("line_ids_mixed.csv").0), [vec![LINE[0], LINE[2]], vec![LINE[1], LINE[3]]]);
    let names = |name: &str| line(name).0.chains.iter().map(|c| c.name.clone()).collect::<Vec<_>>();
    assert_eq!(names("line_ids.csv"), ["a", "b"]);
    assert_eq!(names("multi_line.geojson"), ["line 1", "line 2"]);
}

#[test]
fn rings_and_holes() {
    let roles = |name: &str| line(name).0.chains.iter().map(|c| (c.role, c.vertices.len())).collect::<Vec<_>>();
    let outer = |polygon| Role::Outer { polygon };
    for name in ["ring.csv", "ring_closed_twice.csv", "polygon_open.geojson"] {
        assert_eq!(roles(name), [(outer(0), 4)], "{name}");
    }
    assert_eq!(roles("ring_open.csv"), [(Role::Open, 4)]);
    assert_eq!(roles("out_and_back.csv"), [(Role::Open, 3)]);
    assert_eq!(roles("polygon_hole.geojson"), [(outer(0), 4), (Role::Hole { polygon: 0 }, 4)]);
    assert_eq!(roles("multi_polygon.geojson"), [(outer(0), 4), (outer(1), 4), (Role::Hole { polygon: 1 }, 4)]);
    let raw = read("ring_open.csv", None).unwrap();
    assert_eq!(check(&raw, true).unwrap().0.chains[0].role, outer(0));
}

#[test]
fn points_need_no_elevation() {
    let raw = read::read_points("fixtures/input/points.csv".as_ref(), &ReadOptions::default()).unwrap();
    let points: Vec<_> = raw.points.iter().map(|p| (p.x, p.y, p.row)).collect();
    assert_eq!(points, [(500_100.5, 5_400_200.25, 2), (500_130.125, 5_400_212.75, 3)]);
    assert!(read::parse_points("a", b"x,y\n1,inf\n", None).unwrap_err().to_string().contains("not finite"));
    assert!(read::parse_points("a", b"1,2\n", None).unwrap_err().to_string().contains("--csv-order xy"));
}

/// Reads a text with the given order and checks it.
fn text(text: &str, order: Option<&str>) -> Result<(Line, Vec<Note>), String> {
    let order = order.map(|o| o.parse().unwrap());
    let format = if text.starts_with('{') { read::InputFormat::GeoJson } else { read::InputFormat::Csv };
    let raw = read::parse_line("a", text.as_bytes(), &ReadOptions { csv_order: order, ..ReadOptions::of(format) })
        .map_err(|e| e.to_string())?;
    check(&raw, false).map(|(line, notes)| (line, raw.notes.into_iter().chain(notes).collect()))
}

#[test]
fn orders_name_the_columns() {
    for (order, rows) in [
        ("xyz", "1,2,3\n4,5,6"),
        ("nez", "2,1,3\n5,4,6"),
        ("penzd", "7,1,2,3,a,b\n8,4,5,6"),
        ("x_yz", "1,old,2,3\n4,new,5,6"),
        ("zyx", "3 2 1\n6 5 4"),
        ("XYZD", "1;2;3;kerb\n4;5;6;kerb"),
        // A header gives way to the order.
        ("xyz_", "x,y,z,level\n1,2,3,9\n4,5,6,9"),
    ] {
        let (line, _) = text(rows, Some(order)).unwrap_or_else(|e| panic!("{order}: {e}"));
        assert_eq!(coordinates(&line), [vec![[1., 2., 3.], [4., 5., 6.]]], "{order}");
    }
    let (line, _) = text("a,1,2,3\nb,7,8,9\na,4,5,6\nb,9,9,9\n", Some("lxyz")).unwrap();
    assert_eq!(line.chains.len(), 2);
    let error = text("1,2,3,4\n5,6,7,8\n", Some("xyz")).unwrap_err();
    assert!(error.contains("more fields than there are columns"), "{error}");
    let error = text("1,2\n5,6\n", Some("xy")).unwrap_err();
    assert!(error.contains("the column order has no elevation"), "{error}");
    let error = text("x,y,z,line\n1,2,3,a\n5,6,7\n", None).unwrap_err();
    assert!(error.contains("it has no line id"), "{error}");
}

#[test]
fn sloppy_geojson_is_read() {
    let geometry = "{\"type\":\"LineString\",\"bbox\":[1,2,7,8],\"coordinates\":[[1,2,3],[7,8,100000000000e-10]]}";
    for document in [
        format!("{{\"type\":\"Feature\",\"geometry\":{geometry}}}"),
        format!("{{\"geometry\":{geometry},\"type\":\"Feature\",\"properties\":null,\"id\":7,\"extra\":{{}}}}"),
        format!(
            "{{\"features\":[{{\"type\":\"Feature\",\"properties\":{{}},\"geometry\":{geometry}}}],\"type\":\"FeatureCollection\"}}"
        ),
        geometry.replace("{\"type\":\"LineString\",", "{").replace("]}", "],\"type\":\"LineString\"}"),
    ] {
        let (line, _) = text(&document, None).unwrap_or_else(|e| panic!("{document}: {e}"));
        assert_eq!(coordinates(&line), [vec![[1., 2., 3.], [7., 8., 10.]]]);
    }
    for (document, message) in [
        ("{\"type\":\"LineString\"}", "the document is not valid GeoJSON"),
        ("{\"type\":\"LineString\",\"coordinates\":[]}", "the file holds no line"),
        ("{\"type\":\"LineString\",\"coordinates\":[1,2,3]}", "a position is not an array of numbers"),
        ("{\"type\":\"Polygon\",\"coordinates\":[[]]}", "the file holds no line"),
        ("{\"type\":\"Polygon\",\"coordinates\":[]}", "the file holds no line"),
        ("{\"type\":\"Polygon\",\"coordinates\":[[],[[0,0,1],[9,0,1],[9,9,1]]]}", "a ring needs at least 3 distinct vertices"),
        (
            "{\"type\":\"Feature\",\"coordRefSys\":\"[EPSG:25832]\",\"properties\":{},\"geometry\":null,\"place\":{\"type\":\"Prism\"}}",
            "the member `place` is no geometry known here",
        ),
        (
            "{\"type\":\"Feature\",\"coordRefSys\":\"[EPSG:25832]\",\"properties\":{},\"geometry\":{\"type\":\"LineString\",\
             \"coordinates\":[[8.54,47.37,1],[8.55,47.38,2]]}}",
            "the coordinates are longitude and latitude",
        ),
        ("{\"type\":\"Polygon\",\"coordinates\":[[1,2,3],[4,5,6]]}", "a position is not an array of numbers"),
        ("{\"type\":\"FeatureCollection\"}", "the document is not valid GeoJSON"),
        ("{\"type\":\"FeatureCollection\",\"features\":[7]}", "the document is not valid GeoJSON"),
        ("{\"type\":7}", "the document is not GeoJSON"),
        ("{}", "the document is not GeoJSON"),
    ] {
        let error = text(document, None).map(|_| ()).unwrap_err();
        assert!(error.starts_with(message), "{document}: {error}");
    }
}

#[test]
fn broken_spreadsheet_values_are_no_comments() {
    let error = text("x,y,z\n1,2,3\n#N/A,5,6\n7,8,9\n", None).unwrap_err();
    assert!(error.contains("the easting is missing") && error.contains("row 3"), "{error}");
}

#[test]
fn local_coordinates_are_no_degrees() {
    let line = |points: &str, crs: &str| text(&format!("{{\"type\":\"LineString\",\"coordinates\":[{points}]{crs}}}"), None);
    let crs = |name: &str| format!(",\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"{name}\"}}}}");
    let degrees = |result: Result<(Line, Vec<Note>), String>| result.is_err_and(|e| e.contains("ogr2ogr"));
    // A site of 80 by 40 units, a model of half a unit about its origin, a millimetre beside one a metre away.
    assert!(!degrees(line("[0,0,5],[80,40,6]", "")));
    assert!(!degrees(line("[0,0,5],[0.5,0.25,6]", "")));
    assert!(!degrees(line("[-0.4,0.1,5],[0.5,0.25,6]", "")));
    // Zurich by figures alone; the same figures declared as metres; wide but declared as degrees; declared but beyond.
    assert!(degrees(line("[8.54,47.37,410],[8.541,47.371,411]", "")));
    assert!(!degrees(line("[8.54,47.37,410],[8.541,47.371,411]", &crs("EPSG:2056"))));
    assert!(degrees(line("[0,0,5],[80,40,6]", &crs("urn:ogc:def:crs:OGC:1.3:CRS84"))));
    let (_, notes) = line("[500100,5400200,5],[500180,5400240,6]", &crs("EPSG:4326")).unwrap();
    assert_eq!(notes[0].code, "not-degrees");
    assert!(!degrees(text("easting,northing,z\n8.54,47.37,410\n8.541,47.371,411\n", None)));
    assert!(degrees(text("x,y,z\n8.54,47.37,410\n8.541,47.371,411\n", None)));
}

#[test]
fn markers_count_only_far_from_the_other_elevations() {
    assert!(text("x,y,z\n0,0,-980\n50,0,-999\n90,0,-1010\n", None).is_ok(), "a deep mine");
    assert!(text("x,y,z\n0,0,12\n50,0,-999\n90,0,14\n", None).unwrap_err().contains("no-data value"));
    assert!(text("x,y,z\n0,0,-9999\n50,0,-9999\n90,0,-9999\n", None).unwrap_err().contains("no-data value"));
}

#[test]
fn all_defects_are_reported_at_once() {
    let error = text("line,x,y,z\na,0,0,\na,9,0,1\nb,0,0,inf\nb,5,5,5\nb,5,5,6\nb,7,7,7\nc,3,3,3\nc,3,3,3\n", None).unwrap_err();
    for part in ["no elevation\n  --> a, row 2", "not a finite number\n  --> a, row 4", "above each other\n  --> a, rows 5 to 6"]
    {
        assert!(error.contains(part), "{part}: {error}");
    }
    assert!(error.contains("2 distinct vertices\n  --> a, rows 8 to 9"), "{error}");
}

/// Refusals with their whole text: one block per file in `fixtures/input/refusals.txt`, `== name` above each.
/// `SLOPEGEN_BLESS=1` writes the file anew; read the difference before keeping it.
#[test]
fn refusals_are_pinned() {
    let names = [
        "empty.csv",
        "header_only.csv",
        "one_point.csv",
        "same_point.csv",
        "no_z_column.csv",
        "ambiguous.csv",
        "short_row.csv",
        "long_row.csv",
        "thousands.csv",
        "not_a_number.csv",
        "open_quote.csv",
        "mixed_marks.csv",
        "no_header.csv",
        "z_empty.csv",
        "z_nan.csv",
        "z_na.csv",
        "z_dashes.csv",
        "z_null.csv",
        "z_nodata.csv",
        "z_nodata_large.csv",
        "z_inf.csv",
        "vertical_step.csv",
        "too_large.csv",
        "lonlat.csv",
        "bow_tie.csv",
        "closing_step.csv",
        "hole_outside.geojson",
        "hole_across.geojson",
        "points_only.geojson",
        "no_geometry.geojson",
        "no_features.geojson",
        "no_z.geojson",
        "mixed_dimensions.geojson",
        "null_z.geojson",
        "text_z.geojson",
        "one_number.geojson",
        "truncated.geojson",
        "nan.geojson",
        "overflow.geojson",
        "topology.json",
        "esri.json",
        "lonlat.geojson",
        "lonlat_wide.geojson",
        "track.gpx",
        "missing.csv",
        "README.md",
    ];
    let found: String = names.iter().map(|name| format!("== {name}\nerror: {}\n\n", refusal(name))).collect();
    let path = "fixtures/input/refusals.txt";
    if std::env::var_os("SLOPEGEN_BLESS").is_some() {
        std::fs::write(path, &found).unwrap();
    }
    let expected = std::fs::read_to_string(path).unwrap();
    for (found, expected) in found.split("== ").zip(expected.split("== ")) {
        assert_eq!(found, expected);
    }
    assert_eq!(found, expected);
}
