//! `slopegen build` where all is well.

use super::{Site, on_ground};

/// A mesh as OBJ: whether it has vertices and faces.
fn is_mesh(text: &str) -> bool {
    text.lines().any(|l| l.starts_with("v ")) && text.lines().any(|l| l.starts_with("f "))
}

/// The figure of a key of the JSON report, given as a pointer such as `/volumes/cut`.
#[track_caller]
fn figure(json: &str, pointer: &str) -> f64 {
    let value: serde_json::Value = serde_json::from_str(json).unwrap();
    value.pointer(pointer).and_then(serde_json::Value::as_f64).unwrap_or_else(|| panic!("{pointer} in {json}"))
}

#[test]
fn defaults() {
    let site = Site::new();
    let run = site.run("build road.geojson --slope 1:1.5");
    let report = run.done();
    assert!(report.contains("road.geojson") && report.contains("1V:1.5H · 1.5H:1V · 66.7 % · 33.69°"), "{report}");
    // The lowest vertex of the road is at 412.4.
    assert!(report.contains("to elevation                 402.400 m"), "{report}");
    assert!(run.stderr.contains("note[default-end]: the slopes end at elevation 402.4, 10 beyond the line"), "{}", run.stderr);
    assert!(run.stderr.contains("wrote road.obj: "), "{}", run.stderr);
    assert_eq!(site.new_files(), ["road.obj"]);
    assert!(is_mesh(&site.read("road.obj")));
}

#[test]
fn all_outputs_at_once() {
    let site = Site::new();
    let run = site.run(
        "build pad.geojson --slope 1:2 --to-elevation 405 -o a.obj -o b.ply --lines c.geojson --report d.json --report e.txt",
    );
    let report = run.done();
    assert_eq!(site.new_files(), ["a.obj", "b.ply", "c.geojson", "d.json", "e.txt"]);
    assert!(is_mesh(&site.read("a.obj")));
    let lines: serde_json::Value = serde_json::from_str(&site.read("c.geojson")).unwrap();
    let kinds: Vec<&str> =
        lines["features"].as_array().unwrap().iter().map(|f| f["properties"]["kind"].as_str().unwrap()).collect();
    assert!(kinds.contains(&"hinge"), "{kinds:?}");
    let json = site.read("d.json");
    assert_eq!(figure(&json, "/extent/value"), 405.0);
    assert_eq!(figure(&json, "/slopes/fill/one_in"), 2.0);
    assert!(json.contains("\"kind\": \"elevation\"") && !json.contains("\"cut\": {"));
    // The file says what standard output says.
    assert_eq!(site.read("e.txt"), report);
}

#[test]
fn a_road_about_a_centre_line() {
    let site = Site::with("road.csv", "x,y,z\n0,0,10\n60,0,10\n60,40,10\n");
    let report = site.run(
        "build road.csv --slope 1:2 --width 6 --crossfall 2%,-2% --to-elevation 5 --report a.json --lines b.json --report -",
    );
    let report = report.done();
    for line in ["width of roads                 6.000 m", "crossfall                2.00, -2.00 %"] {
        assert!(report.contains(line), "{report}");
    }
    let json = site.read("a.json");
    // 100 long, 6 wide, each half on a plane of 2 %.
    let area = 600.0 * 0.02_f64.hypot(1.0);
    assert!((figure(&json, "/surface/platform_area") - area).abs() < 1e-6, "{json}");
    assert_eq!(figure(&json, "/line/length"), 100.0);
    assert_eq!((figure(&json, "/line/crossfall/left"), figure(&json, "/line/crossfall/right")), (0.02, -0.02));
    assert!(site.read("b.json").contains("\"breakline\""));
    // The sheet of the edges: 4 outside of the left edge it has fallen by 2 from 10 − 0.06.
    let run = site.run_with("sample road.csv --slope 1:2 --width 6 --crossfall 2% --at - --at-order xy", "30,7\n");
    let height: f64 = run.done().trim().strip_prefix("x,y,z\n30,7,").unwrap().parse().unwrap();
    assert!((height - 7.94).abs() < 1e-9, "{height}");
}

#[test]
fn every_way_to_end_and_side() {
    let site = Site::new();
    for arguments in [
        "build road.geojson --slope 50% --height 5",
        "build road.geojson --slope 50% --distance 12.5 --side left",
        "build road.geojson --slope 50% --to-elevation 405 --side right",
        "build road.geojson --direction up --cut-slope 1:1 --height 4 --side both --interval 0.5",
        "build pad.geojson --slope 1:2 --side inside --height 3",
        "build pad.geojson --slope 1:2 --side outside --height 3 --reference 400",
        "build pit.csv --closed --side inside --slope 45deg --height 6 --tolerance 0.001 --threads 1",
    ] {
        let run = site.run(&format!("{arguments} -o m.obj --report r.json"));
        run.done();
        assert!(is_mesh(&site.read("m.obj")), "{arguments}");
        std::fs::remove_file(site.path("m.obj")).unwrap();
    }
}

#[test]
fn slopes_of_their_own_come_first() {
    let site = Site::new();
    let ratio = |arguments: &str, key: &str| {
        site.run(&format!("build road.geojson {arguments} --height 2 -o m.obj --report r.json")).done();
        figure(&site.read("r.json"), key)
    };
    assert_eq!(ratio("--cut-slope 1:4 --direction up", "/slopes/cut/ratio"), 0.25);
    assert_eq!(ratio("--fill-slope 1:4", "/slopes/fill/ratio"), 0.25);
}

/// A slope that no surface has is refused, by `build` and by `sample`.
#[test]
fn slopes_without_a_surface_are_refused() {
    let site = on_ground();
    let rises = "error: no surface rises that could have the slope\n  --> --cut-slope 1:1\n   \
                 = help: choose `--direction up`, or leave it out";
    site.run("build road.geojson --slope 1:2 --cut-slope 1:1").refused(2, rises);
    site.run("sample road.geojson --slope 1:2 --cut-slope 1:1 --at -").refused(2, rises);
    site.run("build hill_road.geojson --terrain ground.obj --slope 1:2 --cut-slope 1:1 --direction down").refused(2, rises);
    site.run("build road.geojson --slope 1:2 --fill-slope 1:1 --direction up").refused(
        2,
        "error: no surface falls that could have the slope\n  --> --fill-slope 1:1\n   \
         = help: choose `--direction down`, or leave it out",
    );
    let left = "error: no surface is left that could have the slope\n  --> --slope 1:2\n   \
                = help: leave out `--slope`, or the slope in its place";
    site.run("build road.geojson --slope 1:2 --fill-slope 1:4").refused(2, left);
    site.run("build hill_road.geojson --terrain ground.obj --slope 1:2 --cut-slope 1:1 --fill-slope 1:4").refused(2, left);
    assert_eq!(site.new_files(), ["ground.obj", "hill_road.geojson"]);
}

#[test]
fn the_reference_is_reported() {
    let site = Site::new();
    site.run("build pad.geojson --slope 1:2 --height 3 --reference -12.5 -o m.obj --report r.json").done();
    assert_eq!(figure(&site.read("r.json"), "/volumes/reference/elevation"), -12.5);
}

#[test]
fn the_same_bytes_on_any_number_of_threads() {
    let site = Site::new();
    for threads in ["1", "2"] {
        let outputs = format!("-o {threads}.obj -o {threads}.ply --lines {threads}.geojson --report {threads}.txt");
        site.run(&format!("build road.geojson --slope 1:1.5 --threads {threads} {outputs}")).done();
    }
    for ending in ["obj", "ply", "geojson", "txt"] {
        let bytes = |threads| std::fs::read(site.path(&format!("{threads}.{ending}"))).unwrap();
        assert!(bytes(1) == bytes(2), "{ending}");
    }
}

#[test]
fn a_file_of_the_same_name_is_replaced() {
    let site = Site::with("road.obj", "old");
    site.run("build road.geojson --slope 1:1.5").done();
    assert!(is_mesh(&site.read("road.obj")));
}

#[test]
fn beyond_the_end_there_is_no_slope() {
    let site = Site::new();
    let run = site.run("build road.geojson --slope 1:1.5 --to-elevation 420 -o m.obj");
    run.done();
    // Vertex 10, at station 180 and 419.1, lies below 420; at 6 % the line is up there 15 further on.
    let text = "warning[line-beyond-end]: 195.00";
    assert!(run.stderr.contains(text), "{}", run.stderr);
}

/// Two level lines that cross in plan, one 3 above the other.
const CROSSING: &str = "line,x,y,z\nlow,1000,1050,10.03\nlow,1100,1050,10.03\nhigh,1050,1000,13.03\nhigh,1050,1100,13.03\n";

#[test]
fn buried_stretches_are_told() {
    let site = Site::with("crossing.csv", CROSSING);
    let run = site.run("build crossing.csv --slope 1:2 --height 4 -o m.obj --report r.json --report -");
    assert!(run.done().contains("Buried stretches"), "{}", run.stdout);
    assert!(run.stderr.contains("warning[buried]: a stretch of the line lies under the slope of another part, up to 3.000 deep"));
    let json = site.read("r.json");
    // The high line buries the low one by 3 - d/2 at plan distance d: from 44 to 56 on its 100.
    for (pointer, expected) in [("from", 44.0), ("to", 56.0), ("depth", 3.0), ("by_station", 50.0)] {
        let found = figure(&json, &format!("/line/buried/0/{pointer}"));
        assert!((found - expected).abs() < 1e-6, "{pointer}: {found}");
    }
    assert!(json.contains("\"code\": \"buried\""));
}

#[test]
fn strict_refuses_buried_stretches() {
    let site = Site::with("crossing.csv", CROSSING);
    site.run("build crossing.csv --slope 1:2 --height 4 -o m.obj --strict").refused(
        1,
        "error: a stretch of the line lies buried under the slope of another part\n  \
         --> crossing.csv, `low`, stations 44.000 to 56.000\n   \
         = up to 3.000 deep, under `high` at station 50.000; no slope sets it free\n   \
         = help: move the line, ask for a steeper slope, or leave out `--strict`: the rest of the surface is right",
    );
    assert_eq!(site.new_files(), ["crossing.csv"]);
}

/// Labels are those of the unit asked for, everywhere; feet are explained.
#[test]
fn units_are_named() {
    for (unit, metres, words) in
        [("ft", 0.3048, "1 ft = 0.3048 m"), ("us-ft", 1200.0 / 3937.0, "1 us-ft = 1200/3937 m (US survey foot)")]
    {
        let site = Site::new();
        let run = site.run(&format!("build road.geojson --slope 1:1.5 --units {unit} --report r.json --report r.md --report -"));
        let text = run.done();
        let lead = format!("\nLengths in {unit}, areas in {unit}², volumes in {unit}³; {words}\n");
        assert!(text.contains(&lead) && text.contains(&format!(" {unit}³ deficit\n")), "{text}");
        let rest = text.replace(words, "");
        for metre in [" m\n", " m²", " m³"] {
            assert!(!rest.contains(metre), "{metre}: {text}");
        }
        assert!(site.read("r.md").contains(&format!(" {unit}³ deficit |\n")), "{}", site.read("r.md"));
        let report: serde_json::Value = serde_json::from_str(&site.read("r.json")).unwrap();
        let expected = serde_json::json!({
            "length": unit, "metres": metres, "area": format!("{unit}²"), "volume": format!("{unit}³")
        });
        assert_eq!(report["units"], expected);
    }
}
