//! `slopegen check`.

use super::Site;
use serde_json::Value;

/// A square of two triangles that rises 1 in 2.
const RAMP: &str = "v 100 200 1\nv 104 200 1\nv 104 204 3\nv 100 204 3\n";

fn json(site: &Site, arguments: &str, code: i32) -> Value {
    let run = site.run(&format!("check {arguments} -q --report r.json"));
    assert_eq!(run.code, code, "{}", run.stderr);
    serde_json::from_str(&site.read("r.json")).unwrap()
}

fn codes(report: &Value) -> Vec<(String, u64)> {
    let findings = report["findings"].as_array().unwrap();
    findings.iter().map(|f| (f["code"].as_str().unwrap().to_owned(), f["count"].as_u64().unwrap())).collect()
}

#[test]
fn own_surfaces_pass() {
    let site = Site::new();
    for (line, slope, ending) in [
        ("road.geojson", "1:1.5", ""),
        ("road.geojson", "1:2", "--direction up --distance 20 --side left"),
        ("pad.geojson", "1:2", "--to-elevation 405"),
        ("pit.csv", "45deg", "--closed --side inside --height 6"),
    ] {
        site.run(&format!("build {line} --slope {slope} {ending} -o m.obj -o m.ply")).done();
        for mesh in ["m.obj", "m.ply"] {
            let report = json(&site, &format!("{mesh} --slope {slope}"), 0);
            assert_eq!(report["verdict"]["passed"], true);
            assert_eq!(report["slope_bound"]["off"]["triangles"], 0);
            assert!(report["slope_bound"]["within"]["triangles"].as_u64().unwrap() > 0);
            assert!(codes(&report).iter().all(|(code, _)| ["needle", "thin", "hole"].contains(&code.as_str())), "{report}");
        }
        std::fs::remove_file(site.path("m.obj")).unwrap();
    }
}

#[test]
fn another_slope_fails() {
    let site = Site::new();
    site.run("build road.geojson --slope 1:1.5 -o m.obj -q").done();
    let run = site.run("check m.obj --slope 1:2");
    assert_eq!(run.code, 5);
    assert!(run.stdout.contains("\nFAILED: the surface is sound but does not keep the slope\n"), "{}", run.stdout);
    assert!(run.stderr.starts_with("error: the mesh did not pass its check\n  --> m.obj\n   = "), "{}", run.stderr);
    assert!(run.stderr.contains("triangles are off the slope, 100.000 % of the area against 0 %"), "{}", run.stderr);
    // atan(1/1.5) - atan(1/2) = 7.125°.
    assert_eq!(site.run("check m.obj --slope 1:2 --tolerance-deg 7.2 -q").code, 0);
    assert_eq!(site.run("check m.obj --slope 1:2 --tolerance-deg 7.1 -q").code, 5);
}

#[test]
fn what_is_wrong_has_its_place() {
    let site = Site::with("m.obj", format!("{RAMP}f 1 2 3\nf 1 4 3\n"));
    let run = site.run("check m.obj");
    assert_eq!(run.code, 5);
    assert!(
        run.stdout.contains("  1 triangle that is clockwise in plan [clockwise]\n    at (101.333, 202.667, 2.333)  triangle 2")
    );
    site.run("check m.obj -q").refused(
        5,
        "error: the mesh did not pass its check\n  --> m.obj\n   = 1 triangle that is clockwise in plan\n   \
         = 1 edge whose two triangles face opposite ways\n   = help: the report names the places",
    );
}

#[test]
fn polygons_are_split_and_keep_their_numbers() {
    let site = Site::with("m.obj", format!("{RAMP}v 100 208 3\nv 104 208 3\nf 1 2 3 4\nf 6 4 3\nf 5 6 4\n"));
    let report = json(&site, "m.obj", 5);
    assert_eq!(codes(&report), [("clockwise".to_owned(), 1), ("orientation".to_owned(), 1)]);
    assert_eq!(report["mesh"]["faces"], 3);
    assert_eq!(report["mesh"]["triangles"], 4);
    assert_eq!(report["findings"][0]["places"][0]["triangles"][0], 3);
    assert_eq!(report["warnings"][0]["code"], "faces-split");
}

#[test]
fn parts_to_ask_the_slope_of() {
    let groups = "g batter\nf 1 2 3\nf 1 3 4\ng berm\nv 100 208 3\nv 104 208 3\nf 4 3 6\nf 4 6 5\ng wall\nv 100 208 9\nf 5 6 7\n";
    let site = Site::with("m.obj", format!("{RAMP}{groups}"));
    let passed = |arguments: &str, code: i32| json(&site, &format!("m.obj {arguments}"), code)["slope_bound"]["passed"].clone();
    // The wall is upright, so the surface is not sound: exit 5 all the same.
    assert_eq!(passed("--slope 1:2 --part batter", 5), true);
    assert_eq!(passed("--slope 1:2", 5), false);
    assert_eq!(passed("--slope 1:2 --part batter --part berm", 5), false);
    // Areas: 16 times √1.25 and 16.
    assert_eq!(passed("--slope 1:2 --part batter --part berm --max-off 47.3%", 5), true);
    assert_eq!(passed("--slope 1:2 --part batter --part berm --max-off 47.2", 5), false);
    site.run("check m.obj --slope 1:2 --part batte")
        .refused(3, "error: the mesh has no part `batte`\n  --> m.obj\n   = help: its parts are `batter`, `berm`, `wall`");
}

#[test]
fn refusals() {
    let site = Site::with("m.obj", format!("{RAMP}f 1 2 9\n"));
    assert_eq!(site.run("check m.obj").code, 3);
    assert_eq!(site.run("check missing.obj").code, 3);
    assert_eq!(site.run("check road.geojson").code, 3);
    for arguments in [
        "check",
        "check m.obj --slope 1:0.5",
        "check m.obj --tolerance-deg 0",
        "check m.obj --slope 1:2 --max-off 101",
        "check m.obj --gap 0",
        "check m.obj --places x",
        "check m.obj --part a",
        "check m.obj --max-off 5%",
        "check m.obj --tolerance-deg 0.5",
        "check m.obj --report m.obj",
        "check m.obj --report r.pdf",
    ] {
        let run = site.run(arguments);
        assert_eq!((run.code, run.stdout.as_str()), (2, ""), "{arguments}: {}", run.stderr);
    }
    assert_eq!(site.new_files(), ["m.obj"]);
}

#[test]
fn bad_meshes_are_looked_at() {
    let site = Site::new();
    for (name, text, expected) in [
        ("nan.obj", format!("{RAMP}v nan 1 2\nf 1 2 3\nf 1 3 4\nf 1 4 5\n"), vec![("not-finite", 1), ("not-usable", 1)]),
        ("points.obj", RAMP.to_owned(), vec![("empty", 1), ("unused", 4)]),
        ("twice.obj", format!("{RAMP}f 1 2 3\nf 1 3 4\nf 3 1 2\nf 1 1 2\n"), vec![("degenerate", 1), ("duplicate", 1)]),
    ] {
        std::fs::write(site.path(name), text).unwrap();
        let report = json(&site, name, 5);
        let expected: Vec<(String, u64)> = expected.into_iter().map(|(code, n)| (code.to_owned(), n)).collect();
        assert_eq!(codes(&report), expected, "{name}");
    }
}

#[test]
fn standard_input_and_output() {
    let site = Site::new();
    let sound = format!("{RAMP}f 1 2 3\nf 1 3 4\n");
    let run = site.run_with("check - --input-format obj --slope 50%", sound.clone());
    assert!(run.done().contains("PASSED: the surface is sound and keeps the slope"));
    let run = site.run_with("check -", sound);
    assert!(run.done().contains("  mesh                - (obj, "), "{}", run.stdout);
}
