//! Real ground with figures found by other means, in a folder named by the environment variable `SLOPEGEN_DATA`. Without it
//! nothing is tested here.

#![allow(clippy::print_stderr, reason = "tells what was skipped, and how near the figures are")]

use crate::common::oracle::Polyline;
use crate::oracle::sample;
use crate::random::works;
use crate::run::{Folder, Mesh, build};
use crate::site::Site;
use crate::tin::twice_area;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("SLOPEGEN_DATA").map(PathBuf::from);
    if folder.is_none() {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
    }
    folder
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&std::fs::read_to_string(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))).unwrap()
}

/// A run over files of the data folder; gives the report.
fn report(line: &Path, ground: &Path, more: &str) -> Value {
    let scratch = Folder::new();
    let arguments =
        format!("build {} --terrain {} {more} --finished f.ply -o d.ply --report r.json", line.display(), ground.display());
    scratch.run(&arguments).done();
    json(&scratch.path("r.json"))
}

/// Sums over rasters of 2, 1 or 0.5 m: coarse and fine differ by about the error of the coarse one. Beside that platforms are
/// counted there by whole cells, which makes them wider by up to half a cell, and triangulated in another way: `platform` is the
/// share of all earth for that.
#[track_caller]
fn near(name: &str, report: &Value, reference: &Value, platform: f64) {
    let [coarse, fine] = [&reference[0], &reference[1]];
    let of = |value: &Value, key: &str| value[key].as_f64().unwrap();
    let earth = of(fine, "cut") + of(fine, "fill");
    for key in ["cut", "fill"] {
        let (found, wanted) = (of(&report["volumes"], key), of(fine, key));
        let allowed = 2.0 * (wanted - of(coarse, key)).abs() + platform * earth;
        eprintln!("{name}: {key} {found:.2}, reference {wanted:.2}, {:.3} % of all", 100.0 * (found - wanted) / earth);
        assert!((found - wanted).abs() <= allowed, "{name}: {key} {found} for {wanted}, allowed {allowed}");
    }
    assert_eq!(report["volumes"]["complete"], true, "{name}");
    let area = of(&report["areas"], "cut") + of(&report["areas"], "fill");
    assert!((area - of(fine, "footprint")).abs() < 0.02 * area, "{name}: area {area} for {}", of(fine, "footprint"));
}

#[test]
fn pairs() {
    let Some(folder) = folder() else { return };
    let mut count = 0;
    for name in ["autzen", "landfill", "volcano", "volcano_s"] {
        let pair = folder.join("pairs").join(name);
        let reference = json(&pair.join("reference.json"));
        let road = &reference["road"];
        let percent = |key: &str| 100.0 * road[key].as_f64().unwrap();
        let slopes = format!("--cut-slope {}% --fill-slope {}%", percent("cut_slope"), percent("fill_slope"));
        let ground = pair.join("terrain.obj");
        let pad = report(&pair.join("pad.geojson"), &ground, &slopes);
        near(&format!("{name}, pad"), &pad, &reference["pad"]["reference"], 1.2e-2);
        let platform = report(&pair.join("road_platform.geojson"), &ground, &slopes);
        near(&format!("{name}, road as a ring"), &platform, &road["reference"], 2e-3);
        let width = format!("{slopes} --width {}", road["width"]);
        let centre = report(&pair.join("road_centerline.geojson"), &ground, &width);
        near(&format!("{name}, road with a width"), &centre, &road["reference"], 2e-3);
        count += 3;
    }
    assert_eq!(count, 12);
}

/// The pads by the brute force of these tests, on cells of an eighth of a metre or so.
#[test]
fn pads_by_brute_force() {
    let Some(folder) = folder() else { return };
    for (name, margin) in [("autzen", 20.0), ("landfill", 30.0), ("volcano", 70.0), ("volcano_s", 40.0)] {
        let pair = folder.join("pairs").join(name);
        let road = &json(&pair.join("reference.json"))["road"];
        let mut ground = Mesh::from_obj(&std::fs::read_to_string(pair.join("terrain.obj")).unwrap()).tin;
        let clockwise = |t: &[usize; 3]| twice_area(ground.vertices[t[0]], ground.vertices[t[1]], ground.vertices[t[2]]) < 0.0;
        let turned = ground.triangles.iter().map(|t| if clockwise(t) { [t[1], t[0], t[2]] } else { *t }).collect();
        ground.triangles = turned;
        let pad = json(&pair.join("pad.geojson"));
        let ring = &pad["features"][0]["geometry"]["coordinates"][0];
        let mut points: Vec<[f64; 3]> = serde_json::from_value(ring.clone()).unwrap();
        points.pop();
        let slope = |key: &str| road[key].as_f64().unwrap();
        let site = Site::new(vec![Polyline { points, closed: true }], slope("fill_slope"), ground).cut_slope(slope("cut_slope"));
        let found = build(&site, "").figures();
        let wanted = sample(&site, works(&site, margin), 800);
        eprintln!("{name}, pad: {found:?}, by brute force {wanted:?}");
        found.roughly(&wanted, 1e-3, name);
    }
}
