//! `--plot`: what concerns the command line, and drawings of two small sites, pinned. After a change that is meant, run the tests
//! with `UPDATE_GOLDEN=1`, and look at the drawings in a browser.

use super::Site;
use std::path::Path;

/// A road on a ramp with a hump, over ground in cells of 10.
pub(super) fn site() -> Site {
    let z = |x: f64, y: f64| 100.0 + 0.06 * x + 3.0 * (x / 13.0).sin() + 0.08 * y;
    let row = |i: i32, j: i32| {
        let (x, y) = (f64::from(10 * i), f64::from(10 * j) - 40.0);
        format!("{},{},{:.3}\n", 600_000.0 + x, 5_300_000.0 + y, z(x, y))
    };
    let rows: String = (0..=12).flat_map(|i| (0..=8).map(move |j| row(i, j))).collect();
    let site = Site::with("ground.csv", format!("x,y,z\n{rows}"));
    let line = r#"{"type":"Feature","properties":{"name":"Weg <1> & Süd"},"geometry":{"type":"LineString","coordinates":
        [[600020,5299998,101.5],[600060,5299995,104],[600100,5300008,106]]}}"#;
    std::fs::write(site.path("way.geojson"), line).unwrap();
    site
}

const WAY: &str =
    "build way.geojson --width 5 --terrain ground.csv --slope 1:1.5 --tolerance 0.05 --interval 1 --stations 20 -o m.obj -q";

#[track_caller]
fn pinned(site: &Site, name: &str) {
    let found = site.read(name);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/plots").join(name);
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(path, found).unwrap();
    } else {
        let golden = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        assert!(found == golden, "{} is another; after a change that is meant run the test with UPDATE_GOLDEN=1", path.display());
    }
}

#[test]
fn drawings_of_a_road_on_ground() {
    let site = site();
    let plots =
        "--plot way_plan.svg --plot way_profile.svg --plot way_sections.svg --plot way_haul.svg --section 20,50 --shrink 10%";
    site.run(&format!("{WAY} {plots} --threads 1")).done();
    for name in ["way_plan.svg", "way_profile.svg", "way_sections.svg", "way_haul.svg"] {
        pinned(&site, name);
    }
    let first = site.read("way_plan.svg");
    site.run(&format!("{WAY} {plots} --threads 2")).done();
    assert_eq!(site.read("way_plan.svg"), first, "on two threads");
}

#[test]
fn drawings_without_ground() {
    let site = Site::new();
    site.run(
        "build pit.csv --closed --side inside --slope 45deg --height 6 -o m.obj -q --plot pit_plan.svg --plot pit-profile.svg",
    )
    .done();
    pinned(&site, "pit_plan.svg");
    assert!(site.read("pit-profile.svg").contains("Long profile"));
}

#[test]
fn several_lines_are_drawn_below_each_other() {
    let site = Site::new();
    let lines = r#"{"type":"MultiLineString","coordinates":[[[0,0,10],[50,0,12]],[[0,60,10],[50,60,12]]]}"#;
    std::fs::write(site.path("two.geojson"), lines).unwrap();
    site.run("build two.geojson --slope 1:2 --to-elevation 5 -o m.obj -q --plot profile.svg").done();
    assert_eq!(site.read("profile.svg").matches("Long profile: ").count(), 4, "a title and a heading each");
}

#[test]
fn what_cannot_be_drawn_is_refused() {
    let site = site();
    let refused = |options: &str, code: i32, words: &str| {
        let run = site.run(options);
        assert_eq!(run.code, code, "{options}: {}", run.stderr);
        assert!(run.stderr.contains(words), "{options}: {}", run.stderr);
        assert!(!site.path("m.obj").exists(), "{options}");
    };
    for name in ["floorplan.svg", "plan.png", "drawing.svg"] {
        refused(&format!("{WAY} --plot {name}"), 2, "the name does not say what is to be drawn");
    }
    refused("build way.geojson --slope 1:2 -o m.obj --plot haul.svg", 2, "the mass haul needs stations on existing ground");
    refused("build way.geojson --slope 1:2 -o m.obj --plot sections.svg", 2, "cross-sections need stations");
    refused(&format!("{WAY} --section 20"), 2, "`--section` says where cross-sections are drawn");
    refused(&format!("{WAY} --plot sections.svg --section 20,x"), 2, "`x` is not a number");
    refused(&format!("{WAY} --plot sections.svg --section 20,500"), 1, "there is no station 500");
    refused(&format!("{WAY} --plot sections.svg --section=-1"), 1, "there is no station -1");
    // Whole or not at all.
    refused(&format!("{WAY} --plot plan.svg --plot nowhere/profile.svg"), 4, "nowhere");
    assert!(!site.path("plan.svg").exists());
}

/// Of each line as many cross-sections are drawn as one reads, and those left out are told: of the stations on that line.
#[test]
fn cross_sections_left_out_are_told() {
    let site = Site::with("two.csv", "line,x,y,z\nshort,0,0,5\nshort,50,0,5\nlong,0,900,5\nlong,500,900,5\n");
    // 30 on both lines, 40 more on the long one.
    let stations: Vec<String> = (1..=30).chain((1..=40).map(|i| 60 + 10 * i)).map(|s| s.to_string()).collect();
    let outputs = "-o m.obj --plot sections.svg --report r.html --quiet";
    site.run(&format!("build two.csv --slope 1:2 --height 3 --section {} {outputs}", stations.join(","))).done();
    let drawing = site.read("sections.svg");
    let told: Vec<&str> = drawing.match_indices(" more stations are not drawn").map(|(at, _)| &drawing[at - 3..at]).collect();
    assert_eq!(told.len(), 1, "{told:?}");
    assert!(told[0].ends_with("10"), "{told:?}");
    let page = site.read("r.html");
    let drawn = |name: &str| page.matches(&format!("aria-label=\"Cross-section of {name} at station")).count();
    assert_eq!((drawn("short"), drawn("long")), (30, 60));
    assert_eq!(page.matches("Of 70 stations asked for the first 60 are drawn; choose others with `--section`.").count(), 1);
}
