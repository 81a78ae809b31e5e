//! `slopegen info`.

use super::Site;
use glam::DVec3;
use serde_json::Value;
use sha2::{Digest, Sha256};
use slopegen::read::{Held, InputFormat, Inventory, ReadError, ReadOptions, inventory};
use std::fs;

/// The report on a file; it must be readable.
#[track_caller]
fn info(site: &Site, file: &str) -> Value {
    let run = site.run(&format!("info {file} --report i.json --quiet"));
    assert_eq!((run.code, run.stderr.as_str(), run.stdout.as_str()), (0, "", ""), "{file}");
    let report: Value = serde_json::from_str(&site.read("i.json")).unwrap();
    assert_eq!(report["schema"], "slopegen-info/1");
    report
}

fn used<'a>(report: &'a Value, purpose: &str) -> &'a Value {
    report["uses"].as_array().unwrap().iter().find(|row| row["use"] == purpose).unwrap_or_else(|| panic!("{purpose}: {report}"))
}

#[test]
fn a_mesh() {
    // A square of 10 × 10, one half of which rises at 45°: its area is 50 + 50·√2.
    let site = Site::with("g.obj", "v 0 0 5\nv 10 0 5\nv 10 10 15\nv 0 10 5\nv 0 0 15\nf 1 2 4\nf 2 3 4\n");
    let report = info(&site, "g.obj");
    let bytes = fs::read(site.path("g.obj")).unwrap();
    let sha256: String = Sha256::digest(&bytes).iter().map(|byte| format!("{byte:02x}")).collect();
    assert_eq!(report["file"]["sha256"], Value::from(sha256));
    assert_eq!((&report["file"]["bytes"], &report["file"]["format"]), (&Value::from(bytes.len()), &Value::from("obj")));
    assert_eq!(report["box"]["min"], serde_json::json!([0.0, 0.0, 5.0]));
    assert_eq!(report["box"]["max"], serde_json::json!([10.0, 10.0, 15.0]));
    let surface = &report["surfaces"][0];
    assert_eq!((&surface["vertices"], &surface["faces"], &surface["triangles"]), (&5.into(), &2.into(), &2.into()));
    assert_eq!(surface["plan_area"], 100.0);
    // The second face has the gradient (1, 1).
    let expected = 50.0 + 50.0 * 3.0_f64.sqrt();
    assert!((surface["surface_area"].as_f64().unwrap() - expected).abs() < 1e-9, "{surface}");
    let ground = used(&report, "ground");
    assert_eq!((&ground["sound"], &ground["notes"][0]["code"]), (&true.into(), &"ground-vertices-unused".into()));
    assert!(surface.get("parts").is_none());
    site.run("build pad.geojson --slope 1:2 -o pad.ply --quiet").done();
    let parts = info(&site, "pad.ply")["surfaces"][0]["parts"].clone();
    let names: Vec<&str> = parts.as_array().unwrap().iter().filter_map(|part| part["name"].as_str()).collect();
    assert!(names.contains(&"platform") && names.contains(&"fill_slope"), "{parts}");
    let text = site.run("info g.obj");
    assert!(text.done().contains("\nAs ground: nothing against it\n"), "{}", text.stdout);
}

/// Of a drawing with faces on several layers each is told, those that are off aside.
#[test]
fn layers_of_a_drawing() {
    let face = |layer: &str, x: u32| {
        let corners = [(0, 0), (1, 0), (1, 1), (1, 1)].iter().zip(0..);
        let corners = corners.map(|((u, v), i)| format!("1{i}\n{}\n2{i}\n{v}\n3{i}\n5\n", x + u)).collect::<String>();
        format!("0\n3DFACE\n8\n{layer}\n{corners}")
    };
    let layers = "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nLAYER\n0\nLAYER\n2\nOFF\n62\n-7\n70\n0\n0\nENDTAB\n0\nENDSEC\n";
    let faces = [face("NORTH", 0), face("SOUTH", 1), face("NORTH", 2), face("OFF", 3)].concat();
    let site = Site::with("g.dxf", format!("{layers}0\nSECTION\n2\nENTITIES\n{faces}0\nENDSEC\n0\nEOF\n"));
    let report = info(&site, "g.dxf");
    let parts = serde_json::json!([{"name": "NORTH", "faces": 2}, {"name": "SOUTH", "faces": 1}]);
    assert_eq!((&report["surfaces"][0]["faces"], &report["surfaces"][0]["parts"]), (&3.into(), &parts));
}

#[test]
fn lines() {
    let site = Site::new();
    let report = info(&site, "road.geojson");
    assert_eq!((report["lines"].as_array().unwrap().len(), &used(&report, "line")["sound"]), (1, &true.into()));
    assert!(report.get("surfaces").is_none());
    let report = info(&site, "pit.csv");
    assert_eq!(report["lines"][0]["vertices"], 14);
    // Text may be the one or the other.
    assert_eq!((&used(&report, "line")["readable"], &used(&report, "ground")["readable"]), (&true.into(), &true.into()));
}

#[test]
fn defects_are_listed_and_no_failure() {
    let line = "x,y,z\n0,0,1\n10,0,\n20,5,\n";
    let site = Site::with("l.csv", line);
    let report = info(&site, "l.csv");
    let row = used(&report, "line");
    assert_eq!((&row["readable"], &row["sound"]), (&true.into(), &false.into()));
    assert_eq!(report["lines"][0]["without_elevation"], 2);
    let strict = site.run("info l.csv --strict");
    assert_eq!(strict.code, 5);
    assert!(strict.stdout.contains("\nAs line: defects\n"), "{}", strict.stdout);
    // An overhang: no build takes this ground.
    fs::write(site.path("g.obj"), "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 5\nv 1 1 7\nf 1 2 3\nf 1 2 5\n").unwrap();
    let row = used(&info(&site, "g.obj"), "ground").clone();
    assert!(row["sound"] == false && row["defects"].as_array().is_some_and(|list| !list.is_empty()), "{row}");
    assert_eq!(site.run("info pit.csv --strict").code, 0);
    // A straight line is no ground, and need not be.
    fs::write(site.path("s.csv"), "x,y,z\n0,0,1\n10,0,2\n20,0,3\n").unwrap();
    let run = site.run("info s.csv --strict");
    assert!(run.done().contains("\nAs ground: defects\n"), "{}", run.stdout);
}

/// A LandXML file with several surfaces and alignments: all are listed, and each surface is looked at.
#[test]
fn landxml() {
    let site = Site::new();
    let from = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/landxml/site.xml");
    fs::copy(from, site.path("site.xml")).unwrap();
    let report = info(&site, "site.xml");
    let surfaces = report["surfaces"].as_array().unwrap();
    let names: Vec<&str> = surfaces.iter().filter_map(|row| row["name"].as_str()).collect();
    assert!(names.contains(&"EG") && names.contains(&"FG"), "{names:?}");
    for row in surfaces {
        assert!(row["vertices"].as_u64().unwrap() > 0 && row["plan_area"].as_f64().unwrap() > 0.0, "{row}");
        let as_ground = report["uses"].as_array().unwrap().iter().find(|used| used["name"] == row["name"]).unwrap();
        assert_eq!((&as_ground["use"], &as_ground["readable"]), (&"ground".into(), &true.into()));
    }
    assert_eq!(report["unit"], "m");
    let one = info(&site, "site.xml --surface FG");
    let uses: Vec<&Value> = one["uses"].as_array().unwrap().iter().filter(|row| row["use"] == "ground").collect();
    assert_eq!((uses.len(), &uses[0]["name"]), (1, &"FG".into()));
}

#[test]
fn job_files_and_reports() {
    let site = Site::with("job.toml", "input = 'road.geojson'\nslope = '1:1.5'\nreport = 'r.json'\n");
    let report = info(&site, "job.toml");
    assert_eq!((&report["file"]["format"], &used(&report, "job")["sound"]), (&"job".into(), &true.into()));
    assert_eq!(report["settings"][1], serde_json::json!({"key": "slope", "values": ["1:1.5"]}));
    site.run("build job.toml --quiet").done();
    let report = info(&site, "r.json");
    assert_eq!((&report["file"]["format"], &report["unit"]), (&"slopegen-report/1".into(), &"m".into()));
    assert!(report["report"].as_array().unwrap().iter().any(|row| row["key"] == "volumes.fill"), "{report}");
    // By content, whatever the name.
    fs::copy(site.path("r.json"), site.path("r.dat")).unwrap();
    assert_eq!(info(&site, "r.dat")["file"]["format"], "slopegen-report/1");
    fs::write(site.path("bad.toml"), "input = 'nothing.csv'\nslope = '1:1'\n").unwrap();
    let defects = used(&info(&site, "bad.toml"), "job")["defects"].clone();
    assert!(defects[0].as_str().unwrap().contains("--> nothing.csv\n  --> bad.toml, line 1, column 9\n"), "{defects}");
    // What says how the program runs is looked at as well.
    for (key, told) in [("threads = 0", "--threads 0"), ("max-memory = 'abc'", "--max-memory abc")] {
        fs::write(site.path("run.toml"), format!("input = 'road.geojson'\nslope = '1:1.5'\n{key}\n")).unwrap();
        let defects = used(&info(&site, "run.toml"), "job")["defects"].clone();
        let place = format!("--> run.toml, line 3, column {}: {told}\n", key.find('=').unwrap() + 3);
        assert!(defects[0].as_str().unwrap().contains(&place), "{defects}");
        assert_eq!(site.run("info run.toml --strict --quiet").code, 5);
        assert_eq!(site.run("build run.toml --quiet").code, 2);
    }
    fs::write(site.path("bad.toml"), "inputt = 'a'\n").unwrap();
    assert_eq!(site.run("info bad.toml --strict --quiet").code, 5);
}

#[test]
fn what_cannot_be_read() {
    let site = Site::with("x.obj", "v 0 0 0\nv 1 x 0\nf 1 2 3\n");
    for file in ["nothing.csv", "x.obj", "."] {
        let run = site.run(&format!("info {file} --report i.json"));
        assert_eq!((run.code, run.stdout.as_str()), (3, ""), "{file}: {}", run.stderr);
        assert!(run.stderr.starts_with("error: "), "{}", run.stderr);
    }
    fs::write(site.path("noise"), [0_u8, 159, 146, 150]).unwrap();
    assert_eq!(site.run("info noise").code, 3);
    assert_eq!(site.run("info road.geojson --csv-order q").code, 2);
    assert!(!site.path("i.json").exists());
}

/// The inventory of a file as the library gives it.
fn of(name: &str, content: &str) -> Result<Inventory, ReadError> {
    let site = Site::with(name, content);
    inventory(&site.path(name), &ReadOptions::default())
}

#[test]
fn held_lines() {
    let found = of("a.geojson", r#"{"type":"LineString","coordinates":[[0,0,5],[3,4,7],[3,4,6]]}"#).unwrap();
    assert!(found.ground.is_none() && found.line.as_ref().is_some_and(Result::is_ok));
    let [Held::Line { vertices: 3, without_elevation: 0, length, closed: false, z: Some(z), .. }] = &found.held[..] else {
        panic!("{:?}", found.held)
    };
    assert_eq!((*length, *z), (5.0, [5.0, 7.0]));
    assert_eq!(found.bounds, Some([DVec3::new(0.0, 0.0, 5.0), DVec3::new(3.0, 4.0, 7.0)]));
}

#[test]
fn held_text_may_be_line_and_ground() {
    let found = of("a.csv", "x,y,z\n0,0,1\n10,0,2\n0,10,3\n").unwrap();
    assert!(matches!(found.held[..], [Held::Line { vertices: 3, .. }, Held::Points { count: 3, .. }]), "{:?}", found.held);
}

#[test]
fn a_held_grid() {
    let text = "ncols 3\nnrows 2\nxllcenter 100\nyllcenter 200\ncellsize 5\nNODATA_value -9999\n1 2 3\n4 -9999 6\n";
    let found = of("a.asc", text).unwrap();
    assert_eq!(found.held, [Held::Grid { columns: 3, rows: 2, step: [5.0, 5.0], missing: 1 }]);
    assert_eq!(found.bounds, Some([DVec3::new(100.0, 200.0, 1.0), DVec3::new(110.0, 205.0, 6.0)]));
}

#[test]
fn by_content_where_the_name_says_nothing() {
    assert_eq!(of("a.dat", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap().format, InputFormat::Obj);
    assert_eq!(of("a", " {\"type\":\"Point\"}").unwrap().format, InputFormat::GeoJson);
    assert!(of("a.dat", "nothing known\n").is_err());
}
