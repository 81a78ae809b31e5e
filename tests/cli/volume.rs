//! `slopegen volume`: two surfaces, a level, rings.

use super::Site;
use std::fs;
use std::path::Path;

/// A roof over the square [0, 20]², ridge at x = 10 and height 6, eaves at 0.
const ROOF: &str = "v 0 0 0\nv 10 0 6\nv 20 0 0\nv 0 20 0\nv 10 20 6\nv 20 20 0\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n";

/// Level ground at 3 over [−5, 25]².
const GROUND: &str = "v -5 -5 3\nv 25 -5 3\nv 25 25 3\nv -5 25 3\nf 1 2 3\nf 1 3 4\n";

fn site() -> Site {
    let site = Site::with("roof.obj", ROOF);
    fs::write(site.path("ground.obj"), GROUND).unwrap();
    site
}

/// A figure of a JSON report by its dotted path; members of lists by their number.
fn figure(report: &serde_json::Value, path: &str) -> f64 {
    let found = report.pointer(&format!("/{}", path.replace('.', "/")));
    found.and_then(serde_json::Value::as_f64).unwrap_or_else(|| panic!("no {path} in {report}"))
}

/// The roof is above 3 for 5 < x < 15: a prism of triangles 10 wide and 3 high, `10·3/2·20 = 300`; below as much, two halves.
#[test]
fn a_roof_over_ground() {
    let site = site();
    let run = site.run("volume roof.obj ground.obj --report v.json --report v.txt --report -");
    let text = run.done();
    assert_eq!(site.read("v.txt"), text);
    assert!(text.contains("  fill                          300.00 m³\n") && text.contains("m³ balanced\n"), "{text}");
    let report: serde_json::Value = serde_json::from_str(&site.read("v.json")).unwrap();
    for (path, expected) in [
        ("volumes.cut", 300.0),
        ("volumes.fill", 300.0),
        ("volumes.net", 0.0),
        ("areas.cut", 200.0),
        ("areas.fill", 200.0),
        ("areas.unaffected", 0.0),
        ("areas.uncovered", 0.0),
        ("areas.existing_uncovered", 500.0),
        ("depths.cut_max", 3.0),
        ("depths.fill_max", 3.0),
        ("depths.fill_max_at.x", 10.0),
        ("depths.fill_max_at.z", 6.0),
    ] {
        assert!((figure(&report, path) - expected).abs() < 1e-9, "{path} {report}");
    }
    assert_eq!(report["volumes"]["balance"], "balanced");
    assert_eq!(report["volumes"]["reference"]["kind"], "terrain");
    assert_eq!(report["inputs"][0]["role"], "design");
    assert_eq!(site.run("volume roof.obj ground.obj --quiet --report v.md").done(), "");
    assert!(site.read("v.md").contains("| net (cut − fill) | 0.00 m³ balanced |"), "{}", site.read("v.md"));
    // The roof: two faces of 20 by √(10² + 6²).
    assert!((figure(&report, "meshes.0.surface_area") - 40.0 * 136_f64.sqrt()).abs() < 1e-9, "{report}");
    assert_eq!(figure(&report, "meshes.1.z_min"), 3.0);
    // 300 over 200.
    assert!((figure(&report, "depths.fill_mean") - 1.5).abs() < 1e-12, "{report}");
    assert_eq!(figure(&report, "inputs.1.bytes"), GROUND.len() as f64);
}

/// Above 4.5 is a similar roof of half the size: `300·(1.5/3)² = 75`; below as much as a box of 4.5 less the rest.
#[test]
fn to_an_elevation() {
    let site = site();
    site.run("volume roof.obj --to-elevation 4.5 --report v.json --quiet").done();
    let report: serde_json::Value = serde_json::from_str(&site.read("v.json")).unwrap();
    assert!((figure(&report, "volumes.cut") - 75.0).abs() < 1e-9, "{report}");
    assert!((figure(&report, "volumes.fill") - (4.5 * 400.0 - 1200.0 + 75.0)).abs() < 1e-9, "{report}");
    assert_eq!(
        (report["volumes"]["reference"]["kind"].as_str(), report["inputs"][0]["role"].as_str()),
        (Some("plane"), Some("existing"))
    );
}

/// Inside [0, 10] × [5, 10]: half a roof of 5 long.
#[test]
fn inside_rings() {
    let site = site();
    let ring = r#"{"type":"Polygon","coordinates":[[[0,5],[10,5],[10,10],[0,10],[0,5]]]}"#;
    fs::write(site.path("lot.geojson"), ring).unwrap();
    site.run("volume roof.obj ground.obj --within lot.geojson --report v.json --quiet").done();
    let report: serde_json::Value = serde_json::from_str(&site.read("v.json")).unwrap();
    assert!((figure(&report, "volumes.fill") - 37.5).abs() < 1e-9, "{report}");
    assert!((figure(&report, "areas.within") - 50.0).abs() < 1e-9, "{report}");
    assert_eq!(report["inputs"][2]["role"], "within");
    fs::write(site.path("open.csv"), "x,y,z\n0,0,0\n9,0,0\n9,9,0\n").unwrap();
    site.run("volume roof.obj ground.obj --within open.csv").refused(
        1,
        "error: `line 1` is not a ring\n  --> open.csv\n   = it begins at 0, 0 and ends at 9, 9\n   \
         = help: give polygons, or lines that end where they begin",
    );
    fs::write(site.path("lot.geojson"), ring.replace("5]", "500]").replace("10]", "1000]")).unwrap();
    site.run("volume roof.obj ground.obj --within lot.geojson").refused(
        1,
        "error: the design mesh has no area inside the rings\n  --> roof.obj\n  --> ground.obj\n   \
         = mesh: x 0.000 to 20.000, y 0.000 to 20.000\n   = rings: x 0.000 to 10.000, y 500.000 to 1000.000\n   \
         = help: check the coordinates of the rings: they must be those of the meshes",
    );
}

#[test]
fn uncovered_design_is_told() {
    let site = site();
    let run = site.run("volume ground.obj roof.obj --report v.json --quiet");
    assert_eq!(run.code, 0, "{}", run.stderr);
    let report: serde_json::Value = serde_json::from_str(&site.read("v.json")).unwrap();
    assert!((figure(&report, "areas.uncovered") - 500.0).abs() < 1e-9, "{report}");
    assert_eq!(report["volumes"]["complete"], false);
    let codes: Vec<&str> = report["warnings"].as_array().unwrap().iter().filter_map(|w| w["code"].as_str()).collect();
    assert!(codes.contains(&"design-uncovered") && codes.contains(&"meshes-swapped"), "{codes:?}");
    let run = site.run("volume ground.obj roof.obj --report v.json");
    assert!(run.stderr.contains("warning[design-uncovered]: 500.000 square units of the design (55.556 %)"), "{}", run.stderr);
}

#[test]
fn meshes_that_do_not_meet() {
    let site = site();
    let moved = |change: fn(f64, f64) -> (f64, f64)| {
        let row = |(x, y): (f64, f64)| {
            let (x, y) = change(x, y);
            format!("v {x} {y} 3\n")
        };
        let rows: String = [(600.0, 200.0), (650.0, 200.0), (650.0, 230.0), (600.0, 230.0)].into_iter().map(row).collect();
        format!("{rows}f 1 2 3\nf 1 3 4\n")
    };
    fs::write(site.path("a.obj"), moved(|x, y| (x, y))).unwrap();
    for (change, help) in [
        (moved(|x, y| (y, x)), "easting and northing of one of them look swapped"),
        (moved(|x, y| (x / 0.3048, y / 0.3048)), "one of them looks as if it were in feet, the other in metres"),
        (moved(|x, y| (x + 5000.0, y)), "give two surfaces of the same place, in the same coordinates"),
    ] {
        fs::write(site.path("b.obj"), change).unwrap();
        let run = site.run("volume a.obj b.obj");
        assert_eq!((run.code, run.stdout.as_str()), (1, ""));
        assert!(run.stderr.contains("error: the two meshes share no area in plan\n  --> a.obj\n  --> b.obj\n"), "{}", run.stderr);
        assert!(run.stderr.contains("= design: x 600.000 to 650.000, y 200.000 to 230.000\n"), "{}", run.stderr);
        assert!(run.stderr.ends_with(&format!("   = help: {help}\n")), "{}", run.stderr);
    }
}

#[test]
fn wrong_usage() {
    let site = site();
    for arguments in [
        "volume roof.obj",
        "volume roof.obj ground.obj --to-elevation 3",
        "volume roof.obj --to-elevation high",
        "volume roof.obj ground.obj --report v.pdf",
        "volume roof.obj ground.obj --csv-order xyq",
    ] {
        assert_eq!(site.run(arguments).code, 2, "{arguments}");
    }
    assert_eq!(site.run("volume roof.obj nothing.ply").code, 3);
    assert_eq!(site.run("volume roof.obj ground.obj --within nothing.geojson").code, 3);
    // Nothing appears where the work fails.
    assert_eq!(site.run("volume roof.obj nothing.ply --report v.json").code, 3);
    assert!(!site.path("v.json").exists());
}

/// The report is pinned, and the same on any number of threads.
#[test]
fn report_is_pinned() {
    let site = site();
    let run = |threads| site.run(&format!("volume roof.obj ground.obj --threads {threads}")).done().to_owned();
    let report = run(1);
    assert_eq!(run(2), report, "on two threads");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/volume.txt");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        fs::write(path, report).unwrap();
    } else {
        let golden = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        assert_eq!(report, golden, "{}; after a change that is meant run the test with UPDATE_GOLDEN=1", path.display());
    }
}
