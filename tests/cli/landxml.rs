//! LandXML on the command line: ground and alignment of one file, choice of surfaces, units.

use super::Site;
use std::fs;
use std::path::Path;

/// The fixture, under the name it has there.
fn site() -> Site {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/landxml/site.xml");
    Site::with("site.xml", fs::read(path).unwrap())
}

/// Standard error of a run that ended with `code` and wrote nothing to standard output.
#[track_caller]
fn failed(site: &Site, arguments: &str, code: i32) -> String {
    let run = site.run(arguments);
    assert_eq!((run.code, run.stdout.as_str()), (code, ""), "{}", run.stderr);
    run.stderr
}

fn json(site: &Site, name: &str) -> serde_json::Value {
    serde_json::from_str(&site.read(name)).unwrap()
}

#[test]
fn a_road_along_an_alignment_on_a_surface() {
    let site = site();
    let run = site.run(
        "build site.xml --width 7 --terrain site.xml --surface EG --slope 1:1.5 --stations 20 --finished f.obj --report r.json -o m.obj",
    );
    run.done();
    let report = json(&site, "r.json");
    assert_eq!(
        (report["inputs"][0]["format"].as_str(), report["inputs"][0]["crs"].as_str()),
        (Some("landxml"), Some("EPSG:25832"))
    );
    assert_eq!(report["units"]["length"], "m");
    assert_eq!(report["volumes"]["complete"], true);
    assert!(
        run.stderr.contains("note[landxml-taken]: taken from the file: alignment `axis`; left: 2 surfaces"),
        "{}",
        run.stderr
    );
    // The finished ground against the ground of the file: the same works, by another way.
    site.run("volume f.obj site.xml --existing-surface EG --report v.json").done();
    let of_mesh = json(&site, "v.json");
    for key in ["cut", "fill"] {
        let (a, b) = (report["volumes"][key].as_f64().unwrap(), of_mesh["volumes"][key].as_f64().unwrap());
        assert!(a > 10.0 && (a - b).abs() < 1e-6 * a, "{key}: {a} and {b}");
    }
}

/// FG is EG, half a metre lower: 360 by 360.
#[test]
fn two_surfaces_of_one_file() {
    let site = site();
    site.run("volume site.xml site.xml --surface FG --existing-surface EG --report v.json").done();
    let report = json(&site, "v.json");
    assert!((report["volumes"]["cut"].as_f64().unwrap() - 0.5 * 360.0 * 360.0).abs() < 1e-6);
    let message = failed(&site, "volume site.xml site.xml --surface FG", 3);
    assert!(message.contains("`EG` (361 vertices, 648 faces)") && message.contains("--existing-surface NAME"), "{message}");
    let message = failed(&site, "volume site.xml site.xml --existing-surface EG", 3);
    assert!(message.contains("with `--surface NAME`"), "{message}");
    site.run("volume site.xml --surface EG --to-elevation 400").done();
    let message = failed(&site, "volume site.xml --existing-surface EG --to-elevation 400", 2);
    assert!(message.contains("--existing-surface") && message.contains("--to-elevation"), "{message}");
}

#[test]
fn check_looks_at_surfaces() {
    let site = site();
    let run = site.run("check site.xml --surface FG");
    let text = run.done();
    assert!(text.contains("PASSED") && text.contains("361 vertices, 648 triangles"), "{text}");
    let message = failed(&site, "check site.xml", 3);
    assert!(message.contains("several surfaces"), "{message}");
    let feet = site.read("site.xml").replace("Metric linearUnit=\"meter\"", "Imperial linearUnit=\"foot\"");
    fs::write(site.path("feet.xml"), feet).unwrap();
    assert!(site.run("check feet.xml --surface EG").done().contains("Lengths in ft"));
    site.run_with("check - --input-format landxml --surface EG", fs::read(site.path("site.xml")).unwrap()).done();
}

#[test]
fn units_that_are_missing() {
    let site = site();
    let text = site.read("site.xml");
    let units = &text[text.find("<Units>").unwrap()..text.find("</Units>").unwrap() + "</Units>".len()];
    fs::write(site.path("none.xml"), text.replace(units, "")).unwrap();
    for command in ["build none.xml --slope 1:2 -o m.obj", "volume none.xml --surface EG --to-elevation 400"] {
        let message = failed(&site, command, 3);
        assert!(message.contains("does not say its unit of length") && message.contains("--units us-ft"), "{message}");
        site.run(&format!("{command} --units us-ft --report r.json")).done();
        assert_eq!(json(&site, "r.json")["units"]["length"], "us-ft");
    }
    // The ground of a line that has a unit does not get it by guess.
    let message = failed(&site, "build site.xml --slope 1:2 --terrain none.xml --surface EG -o m.obj", 3);
    assert!(message.contains("none.xml") && message.contains("does not say its unit"), "{message}");
}

/// Ground with easting first lies elsewhere; the message says so and names the cure.
#[test]
fn easting_before_northing() {
    let site = site();
    let swapped: String = site
        .read("site.xml")
        .lines()
        .map(|line| match line.split_once('>').filter(|_| line.starts_with("<P id")) {
            Some((tag, rest)) => {
                let fields: Vec<&str> = rest.split([' ', '<']).collect();
                format!("{tag}>{} {} {}</P>\n", fields[1], fields[0], fields[2])
            }
            None => format!("{line}\n"),
        })
        .collect();
    fs::write(site.path("swapped.xml"), swapped).unwrap();
    let command = "build site.xml --width 7 --slope 1:1.5 --terrain swapped.xml --surface EG -o m.obj";
    let message = failed(&site, command, 1);
    assert!(message.contains("seem to be exchanged") && message.contains("--terrain-order enz"), "{message}");
    site.run(&format!("{command} --terrain-order enz")).done();
}
