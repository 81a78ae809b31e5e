//! What a run says must agree with itself: inputs with each other, words with figures, files with what lies beside them.

use super::{Run, Site, on_ground};
use serde_json::Value;
use std::fs;

fn json(site: &Site, name: &str) -> Value {
    serde_json::from_str(&site.read(name)).unwrap()
}

/// A square of 40 about the origin, level at 0.
const LEVEL: &str = "v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3\nf 1 3 4\n";

/// A pad of 4 by 4 at an elevation.
fn pad(z: f64) -> String {
    format!("x,y,z\n-2,-2,{z}\n2,-2,{z}\n2,2,{z}\n-2,2,{z}\n-2,-2,{z}\n")
}

fn level() -> Site {
    let site = Site::with("level.obj", LEVEL);
    fs::write(site.path("up.csv"), pad(2.0)).unwrap();
    fs::write(site.path("rim.csv"), pad(0.004)).unwrap();
    fs::write(site.path("low.csv"), pad(-2.0)).unwrap();
    site
}

#[track_caller]
fn says(run: &Run, words: &str) {
    run.done();
    assert!(run.stderr.contains(words), "{words} in {}", run.stderr);
}

/// Inputs in different reference systems are combined, and that is told; names of one system are no contradiction.
#[test]
fn reference_systems_that_differ_are_told() {
    let site = on_ground();
    let road = site.read("hill_road.geojson");
    let named = |name: &str| {
        let member = format!("{{\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"{name}\"}}}},");
        fs::write(site.path("hill_road.geojson"), road.replacen('{', &member, 1)).unwrap();
    };
    let ground = site.read("ground.obj");
    fs::write(site.path("ground.obj"), format!("# crs: EPSG:25832\n{ground}")).unwrap();
    let build = "build hill_road.geojson --width 7 --terrain ground.obj --slope 1:1.5 -o m.obj --report r.json --quiet";
    named("EPSG:25833");
    let loud = build.replace(" --quiet", "");
    says(
        &site.run(&loud),
        "warning[crs-differ]: the line is in the reference system `EPSG:25833`, the ground in `EPSG:25832`: their coordinates were \
         taken as if they were in one\n",
    );
    assert!(site.read("r.json").contains("\"crs-differ\""));
    named("urn:ogc:def:crs:EPSG::25832");
    site.run(build).done();
    assert!(!site.read("r.json").contains("crs-differ"));

    let (a, b) = (format!("# crs: EPSG:25832\n{LEVEL}"), format!("# crs: EPSG:31467\n{LEVEL}"));
    fs::write(site.path("a.obj"), a).unwrap();
    fs::write(site.path("b.obj"), b).unwrap();
    says(
        &site.run("volume a.obj b.obj"),
        "warning[crs-differ]: the design is in the reference system `EPSG:25832`, the existing",
    );
    says(&site.run("diff a.obj b.obj"), "warning[crs-differ]: the first is in the reference system `EPSG:25832`, the second in");
    assert!(!site.run("volume a.obj a.obj").stderr.contains("crs-differ"));
}

/// A name goes with coordinates it describes: not with those brought to another unit, nor with lengths where it is of degrees.
#[test]
fn names_of_reference_systems_go_with_their_coordinates() {
    let site = Site::new();
    let fixture = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/landxml/site.xml");
    fs::copy(fixture, site.path("site.xml")).unwrap();
    let outputs = "-o m.obj -o m.xml --lines l.geojson --plot plan.svg --quiet";
    let heads = [("m.obj", "# crs: "), ("m.xml", "<CoordinateSystem"), ("l.geojson", "\"crs\""), ("plan.svg", "EPSG")];
    for (units, kept) in [("m", true), ("ft", false)] {
        site.run(&format!("build site.xml --feature axis --slope 1:2 --units {units} {outputs}")).done();
        for (file, head) in heads {
            assert_eq!(site.read(file).contains(head), kept, "{file} in {units}");
        }
    }
    let road = site.read("road.geojson").replace("25832", "4326");
    fs::write(site.path("road.geojson"), road).unwrap();
    site.run(&format!("build road.geojson --slope 1:2 {outputs}")).done();
    for (file, head) in heads {
        assert!(!site.read(file).contains(head), "{file}");
    }
}

/// Whether the works are complete, in words that are true of them.
#[test]
fn complete_in_words() {
    let site = level();
    let complete = |arguments: &str| {
        let run =
            site.run(&format!("build {arguments} --terrain level.obj --slope 1:1 --report r.json --report r.html -o m.obj"));
        let text = run.done();
        let line = text.lines().find(|line| line.starts_with("  complete")).unwrap().trim_start_matches("  complete").trim();
        let page = site.read("r.html");
        let (word, words) = line.split_once(", ").unwrap();
        assert_eq!(word == "yes", json(&site, "r.json")["volumes"]["complete"].as_bool().unwrap());
        let marked = if word == "yes" { "Complete: " } else { "NOT complete: " };
        assert!(page.contains(&format!("{marked}{words}<")), "{marked}{words}");
        line.to_owned()
    };
    assert_eq!(complete("up.csv"), "yes, all slopes meet the ground");
    // The rim is within the tolerance of the ground, and does not meet it.
    assert_eq!(complete("rim.csv --side inside --direction down --height 1"), "yes, all slopes reach their end");
    for walls in ["up.csv --direction up", "low.csv --side inside --direction down --height 1"] {
        assert_eq!(complete(walls), "yes, no slope stops short; where there is none stand upright walls", "{walls}");
    }
    // The end is asked for, and no edge of the ground: the length is that of the note.
    assert_eq!(complete("up.csv --height 1 --allow-open"), "NO, some slopes end without meeting the ground");
    let report = json(&site, "r.json");
    let open = report["daylight"]["open_length"].as_f64().unwrap();
    let warning = report["warnings"].as_array().unwrap().iter().find(|w| w["code"] == "open-ends").unwrap();
    assert_eq!(warning["kind"], "warning");
    let told = format!("on a length of {open:.3}: up to 1.000");
    assert!(warning["message"].as_str().unwrap().contains(&told), "{warning}");
}

/// Notes do not stand among warnings.
#[test]
fn warnings_and_notes_are_told_apart() {
    let site = level();
    site.run("build up.csv --terrain level.obj --slope 1:1 --height 1 --allow-open --report r.txt --report r.md -o m.obj -q")
        .done();
    for (name, marks) in [("r.txt", ["\nWarnings\n", "\nNotes\n"]), ("r.md", ["\n## Warnings\n", "\n## Notes\n"])] {
        let text = site.read(name);
        let [warnings, notes] = marks.map(|mark| text.find(mark).unwrap_or_else(|| panic!("{mark} in\n{text}")));
        let [open, ring] = ["open-ends: ", "ring-detected: "].map(|code| text.find(code).unwrap());
        assert!(warnings < open && open < notes && notes < ring, "{text}");
    }
    assert!(site.read("r.txt").contains(": works of constant slope on existing ground\n"));
}

/// An origin that is left over from another run does not hold for a mesh in world coordinates.
#[test]
fn origins_left_over_are_told() {
    let site = Site::new();
    site.run("build road.geojson --slope 1:2 -o a.obj --local-origin -q").done();
    let run = site.run("build road.geojson --slope 1:2 -o a.obj --report r.json");
    says(&run, "warning[origin-stale]: `a.obj.origin.json` is of an earlier run: the mesh beside it is in world coordinates now");
    // What lies about on the disk is no part of the result.
    assert!(!site.read("r.json").contains("origin-stale") && site.path("a.obj.origin.json").exists());
    assert!(!site.run("build road.geojson --slope 1:2 -o a.obj --local-origin").stderr.contains("origin-stale"));
    assert!(!site.run("build road.geojson --slope 1:2 -o b.obj").stderr.contains("origin-stale"));
}

/// Options that would change nothing are refused.
#[test]
fn options_that_change_nothing_are_refused() {
    let site = level();
    site.run("build road.geojson --slope 1:2 --local-origin=1,2,3 -o w.xml --lines l.dxf").refused(
        2,
        "error: no output counts from a local origin\n  --> --local-origin=1,2,3\n   \
         = help: name an output that ends in `.obj`, `.ply`, `.stl` or `.glb`, or leave out `--local-origin`",
    );
    site.run("build road.geojson --slope 1:2 --local-origin -o w.stl -q").done();
    let order = |name: &str, format: &str| {
        format!(
            "error: only text and LandXML files have an order of columns to be told\n  --> {name}\n   = its format is `{format}`\n   \
             = help: leave out the order of columns"
        )
    };
    site.run("build road.geojson --csv-order xyz --slope 1:2").refused(3, &order("road.geojson", "geojson"));
    site.run("build up.csv --terrain level.obj --terrain-order xyz --slope 1:2").refused(3, &order("level.obj", "obj"));
    site.run("volume level.obj level.obj --csv-order xyz").refused(3, &order("level.obj", "obj"));
    // It is meant for those of several files that have columns.
    fs::write(site.path("points.txt"), "-9,-9,1\n9,-9,1\n9,9,1\n-9,9,1\n").unwrap();
    site.run("volume points.txt level.obj --csv-order xyz").done();
    site.run("diff level.obj points.txt --csv-order xyz").done();
}

/// Cures name options that the command has, and that reach the file.
#[test]
fn cures_name_options_that_are_there() {
    let site = level();
    fs::write(site.path("empty.dxf"), "0\nSECTION\n2\nENTITIES\n0\nENDSEC\n0\nEOF\n").unwrap();
    let cure = |arguments: &str| {
        let run = site.run(arguments);
        assert_eq!(run.code, 3, "{}", run.stderr);
        run.stderr.split("= help: ").nth(1).unwrap().trim_end().to_owned()
    };
    let begins = "give a drawing with 3DFACEs, meshes or POINTs on layers that are on";
    let ends = "; contours have to be triangulated first";
    let with = |option: &str| format!("{begins}, or name a layer with `{option}`{ends}");
    assert_eq!(cure("build up.csv --slope 1:1 --terrain empty.dxf"), with("--terrain-layer"));
    assert_eq!(cure("check empty.dxf"), with("--layer"));
    assert_eq!(cure("volume empty.dxf level.obj"), format!("{begins}{ends}"));
    assert_eq!(cure("diff empty.dxf level.obj"), format!("{begins}{ends}"));

    // Elevations of rings do not matter.
    fs::write(site.path("ring.csv"), "x,y\n0,0\n10,0\n10,10\n0,10\n0,0\n").unwrap();
    site.run("volume level.obj --to-elevation 1 --within ring.csv --report v.json -q").done();
    let fill = json(&site, "v.json")["volumes"]["fill"].as_f64().unwrap();
    assert!((fill - 100.0).abs() < 1e-9, "10 · 10 · 1: {fill}");
    fs::write(site.path("bare.csv"), "0,0\n10,0\n10,10\n0,10\n0,0\n").unwrap();
    let message = cure("volume level.obj --to-elevation 1 --within bare.csv");
    assert!(message.starts_with("name the columns: `--within-order xy` if easting comes first"), "{message}");
    site.run("volume level.obj --to-elevation 1 --within bare.csv --within-order xy").done();
    assert_eq!(site.run("volume level.obj --to-elevation 1 --within-order xy").code, 2);
    fs::copy(site.path("ring.csv"), site.path("ring.dat")).unwrap();
    let run = site.run("volume level.obj --to-elevation 1 --within ring.dat");
    assert!(run.code == 2 && run.stderr.ends_with("help: give the file a name that ends in one of these\n"), "{}", run.stderr);
}

/// Standard output gets its bytes when all files are written: those can be taken back.
#[cfg(target_os = "linux")]
#[test]
fn standard_output_comes_last() {
    let site = level();
    std::os::unix::fs::symlink("/dev/full", site.path("full")).unwrap();
    std::os::unix::fs::symlink("/dev/full", site.path("full.json")).unwrap();
    for command in ["volume level.obj level.obj", "build road.geojson --slope 1:2 -o m.obj", "diff level.obj level.obj"] {
        for report in ["full", "full.json"] {
            let run = site.run(&format!("{command} --report {report}"));
            assert_eq!((run.code, run.stdout.as_str()), (4, ""), "{command} {report}: {}", run.stderr);
        }
    }
}

/// A share of 7 % is told as such: 100 · 0.07 is 7.000000000000001 in doubles.
#[test]
fn shares_have_the_digits_they_were_typed_with() {
    let site = level();
    for (name, z) in [("a", "2"), ("b", "4")] {
        fs::write(site.path("up.csv"), pad(z.parse().unwrap())).unwrap();
        site.run(&format!("build up.csv --terrain level.obj --slope 1:1 -o {name}.obj --report {name}.json -q")).done();
    }
    let run = site.run("diff a.json b.json --max-volume 7%");
    assert!(run.code == 5 && run.stderr.contains(" % against 7 %\n"), "{}", run.stderr);
    fs::write(site.path("steep.obj"), "v 0 0 0\nv 9 0 0\nv 9 9 9\nv 0 9 9\nf 1 2 3\nf 1 3 4\n").unwrap();
    let run = site.run("check steep.obj --slope 1:2 --max-off 7%");
    assert!(run.code == 5 && run.stderr.contains("100.000 % of the area against 7 %\n"), "{}", run.stderr);
}

/// What rounds to nought is neither a surplus nor a deficit.
#[test]
fn nought_is_balanced() {
    let site = level();
    // 40 · 40 · 10⁻⁶ = 0.0016.
    fs::write(site.path("hair.obj"), LEVEL.replace(" 0\n", " -0.000001\n")).unwrap();
    let run = site.run("volume level.obj hair.obj --report v.html --report v.json --report -");
    let text = run.done();
    let net = text.lines().find(|line| line.contains("net (cut − fill)")).unwrap();
    assert_eq!(net.split_whitespace().rev().take(3).collect::<Vec<_>>(), ["balanced", "m³", "0.00"]);
    assert_eq!(json(&site, "v.json")["volumes"]["balance"], "deficit");
    let page = site.read("v.html");
    assert!(page.contains("<strong>balanced</strong>") && !page.contains("deficit of"), "{page}");
}
