//! `slopegen diff`: two reports, two surfaces.

use super::Site;
use serde_json::Value;
use std::fs;

/// Level ground at 3 over [0, 20]², and a roof over it: ridge at x = 10 and height 6, eaves at 0.
const GROUND: &str = "v 0 0 3\nv 20 0 3\nv 20 20 3\nv 0 20 3\nf 1 2 3\nf 1 3 4\n";
const ROOF: &str = "v 0 0 0\nv 10 0 6\nv 20 0 0\nv 0 20 0\nv 10 20 6\nv 20 20 0\nf 1 2 5\nf 1 5 4\nf 2 3 6\nf 2 6 5\n";

fn surfaces() -> Site {
    let site = Site::with("ground.obj", GROUND);
    fs::write(site.path("roof.obj"), ROOF).unwrap();
    // The ground moved by 10 to the east and up by a quarter.
    fs::write(
        site.path("moved.obj"),
        GROUND.replace("v 0", "v 10").replace("v 20", "v 30").replace(" 3\n", " 3.25\n").replacen("f 1 2 3.25", "f 1 2 3", 1),
    )
    .unwrap();
    site
}

fn json(site: &Site, name: &str) -> Value {
    serde_json::from_str(&site.read(name)).unwrap()
}

#[track_caller]
fn close(report: &Value, path: &str, expected: f64) {
    let figure =
        path.split('.').fold(report, |value, key| &value[key]).as_f64().unwrap_or_else(|| panic!("no {path} in {report}"));
    assert!((figure - expected).abs() < 1e-9, "{path}: {figure}, not {expected}");
}

/// The roof lies above 3 for 5 < x < 15: a prism of triangles 10 wide and 3 high, `10·3/2·20 = 300`; below as much.
#[test]
fn a_roof_and_a_plane() {
    let site = surfaces();
    let run = site.run("diff ground.obj roof.obj --report d.json --report -");
    assert!(run.done().contains("highest above                        +3.0000 m at 10.000, "), "{}", run.stdout);
    let report = json(&site, "d.json");
    for (path, expected) in [
        ("surfaces.height_max", 3.0),
        ("surfaces.highest.height", 3.0),
        ("surfaces.highest.at.x", 10.0),
        ("surfaces.highest.at.z", 6.0),
        ("surfaces.lowest.height", -3.0),
        ("surfaces.lowest.at.z", 0.0),
        ("surfaces.above", 300.0),
        ("surfaces.below", 300.0),
        ("surfaces.height_mean", 0.0),
        ("surfaces.height_mean_absolute", 600.0 / 400.0),
        ("surfaces.common_area", 400.0),
        ("surfaces.same_area", 0.0),
    ] {
        close(&report, path, expected);
    }
    assert_eq!((report["schema"].as_str(), report["same"].as_bool()), (Some("slopegen-diff/1"), Some(false)));
}

/// Half of each lies over the other, a quarter apart.
#[test]
fn what_only_one_covers() {
    let site = surfaces();
    site.run("diff ground.obj moved.obj --report d.json --quiet").done();
    let report = json(&site, "d.json");
    for (path, expected) in [
        ("surfaces.common_area", 200.0),
        ("surfaces.first_only", 200.0),
        ("surfaces.second_only", 200.0),
        ("surfaces.height_mean", 0.25),
        ("surfaces.above", 50.0),
        ("surfaces.below", 0.0),
    ] {
        close(&report, path, expected);
    }
    // The other way round all signs change.
    site.run("diff moved.obj ground.obj --report d.json --quiet").done();
    close(&json(&site, "d.json"), "surfaces.height_mean", -0.25);
}

#[test]
fn bounds_on_surfaces() {
    let site = surfaces();
    for (bound, code) in [
        ("--max-height 3", 0),
        ("--max-height 2.999", 5),
        ("--max-volume 600", 0),
        ("--max-volume 599.9", 5),
        ("--max-area 0", 0),
        ("--exact", 5),
        ("--max-height 3 --max-volume 1", 5),
    ] {
        assert_eq!(site.run(&format!("diff ground.obj roof.obj --quiet {bound}")).code, code, "{bound}");
    }
    assert_eq!(site.run("diff ground.obj ground.obj --quiet --exact --max-height 0 --max-volume 0 --max-area 0%").code, 0);
    assert_eq!(site.run("diff ground.obj moved.obj --quiet --max-area 399").code, 5);
    assert_eq!(site.run("diff ground.obj moved.obj --quiet --max-area 66.7%").code, 5);
    assert_eq!(site.run("diff ground.obj moved.obj --quiet --max-area 400").code, 0);
    let run = site.run("diff ground.obj roof.obj --quiet --max-height 1 --report d.json");
    assert_eq!(
        run.stderr,
        "error: the two differ by more than they may\n  --> ground.obj\n  --> roof.obj\n   = height: 3 against 1\n   \
         = help: the report tells what differs\n"
    );
    // The report is written all the same.
    let report = json(&site, "d.json");
    assert_eq!((report["passed"].as_bool(), report["bounds"][0]["passed"].as_bool()), (Some(false), Some(false)));
}

/// Two reports of the pad, one with a steeper slope.
fn reports() -> Site {
    let site = Site::new();
    for (name, slope) in [("a", "1:2"), ("b", "1:1.5"), ("again", "1:2")] {
        site.run(&format!("build pad.geojson --slope {slope} --to-elevation 405 -o {name}.obj --report {name}.json --quiet"))
            .done();
    }
    site
}

#[test]
fn two_reports() {
    let site = reports();
    let run = site.run("diff a.json b.json --report d.json --report -");
    let text = run.done();
    for part in ["slopes.fill.one_in", "volumes.fill", "surface.plan_area"] {
        assert!(text.contains(&format!("\n  {part} ")), "{part} in\n{text}");
    }
    let (a, b, report) = (json(&site, "a.json"), json(&site, "b.json"), json(&site, "d.json"));
    let changes = report["changes"].as_array().unwrap();
    let fill = changes.iter().find(|change| change["key"] == "volumes.fill").unwrap();
    assert_eq!((&fill["first"], &fill["second"]), (&a["volumes"]["fill"], &b["volumes"]["fill"]));
    let (a, b) = (fill["first"].as_f64().unwrap(), fill["second"].as_f64().unwrap());
    close(fill, "difference", b - a);
    close(fill, "relative", (b - a) / a);
    // Times differ and do not count.
    site.run("diff a.json again.json --exact --report d.json --quiet").done();
    let report = json(&site, "d.json");
    assert_eq!(report["same"].as_bool(), Some(true));
    assert!(report["changes"].as_array().unwrap().iter().all(|change| change["counts"] == false), "{report}");
}

#[test]
fn bounds_on_reports() {
    let site = reports();
    let fill = |name: &str| json(&site, name)["volumes"]["fill"].as_f64().unwrap();
    let (a, b) = (fill("a.json"), fill("b.json"));
    let share = 100.0 * (a - b) / a;
    for (bound, code) in [
        (format!("--max-volume {}", a - b + 0.001), 0),
        (format!("--max-volume {}", a - b - 0.001), 5),
        (format!("--max-volume {}%", share + 0.001), 0),
        (format!("--max-volume {}%", share - 0.001), 5),
        ("--max-height 0.000001".to_owned(), 0),
        ("--exact".to_owned(), 5),
    ] {
        let run = site.run(&format!("diff a.json b.json --quiet {bound}"));
        assert_eq!(run.code, code, "{bound}: {}", run.stderr);
    }
    // Without ground there are no areas of cut and fill.
    let run = site.run("diff a.json b.json --max-area 1");
    assert_eq!(run.code, 1);
    assert!(
        run.stderr.contains("error: `--max-area` needs reports with these figures\n  --> a.json\n  --> b.json\n"),
        "{}",
        run.stderr
    );
    let feet = site.read("b.json").replace("\"length\": \"m\"", "\"length\": \"ft\"");
    fs::write(site.path("feet.json"), feet).unwrap();
    assert!(site.run("diff a.json feet.json").stderr.contains("warning[units-differ]"));
    assert_eq!(site.run("diff a.json feet.json --max-volume 1").code, 1);
}

/// Rows of stations are matched by line and stations, also where one report has more of them.
#[test]
fn stations_are_matched() {
    let site = super::on_ground();
    for (name, slope) in [("a", "1:1.5"), ("b", "1:1.4")] {
        site.run(&format!(
            "build hill_road.geojson --terrain ground.obj --width 7 --cut-slope 1:1 --fill-slope {slope} --stations 20 -o {name}.obj \
             --report {name}.json --quiet"
        ))
        .done();
    }
    let run = site.run("diff a.json b.json --max-area 10% --max-volume 10% --max-height 0.5");
    assert!(run.done().contains("\n  stations[hill road 140.0 to 160.0].fill "), "{}", run.stdout);
    assert!(!run.stdout.contains("].cut "), "the cut slope is the same:\n{}", run.stdout);
}

#[test]
fn what_cannot_be_compared() {
    let site = reports();
    fs::write(site.path("far.obj"), GROUND.replace("v 0", "v 5000").replace("v 20", "v 5020")).unwrap();
    fs::write(site.path("ground.obj"), GROUND).unwrap();
    let run = site.run("diff a.json ground.obj");
    assert!(run.code == 1 && run.stderr.starts_with("error: a report cannot be compared with something else\n"), "{run:?}");
    // Reports of other commands; options of surfaces beside reports.
    site.run("check ground.obj --report c.json -q").done();
    for pair in ["c.json c.json", "a.json c.json"] {
        site.run(&format!("diff {pair}")).refused(
            1,
            "error: a report of this kind cannot be compared\n  --> c.json\n   = its schema is `slopegen-check/1`, not \
             `slopegen-report/1`\n   = help: give two reports that `slopegen build` or `volume` wrote",
        );
    }
    for option in ["--units ft", "--surface X", "--csv-order xyz"] {
        let name = option.split(' ').next().unwrap();
        site.run(&format!("diff a.json b.json {option}")).refused(
            1,
            &format!(
                "error: `{name}` is for surfaces, and these are reports\n  --> a.json\n  --> b.json\n   = help: leave it out"
            ),
        );
    }
    let run = site.run("diff ground.obj far.obj");
    assert_eq!(run.code, 1);
    assert!(run.stderr.contains("--> ground.obj\n  --> far.obj\n   = second: x 5000.000 to 5020.000"), "{}", run.stderr);
    assert_eq!(site.run("diff ground.obj far.obj --max-volume 1%").code, 1);
    assert_eq!(site.run("diff a.json nothing.json").code, 3);
    fs::write(site.path("cut.json"), &site.read("a.json")[..400]).unwrap();
    assert_eq!(site.run("diff a.json cut.json").code, 3);
    for arguments in [
        "diff a.json",
        "diff a.json b.json --max-volume x",
        "diff a.json b.json --max-height 1%",
        "diff a.json b.json --report a.html",
    ] {
        assert_eq!(site.run(arguments).code, 2, "{arguments}");
    }
    // No output over an input.
    assert_eq!(site.run("diff a.json b.json --report b.json").code, 2);
}
