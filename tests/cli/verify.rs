//! `slopegen verify`: a report held against a second run.

use super::{Site, on_ground};
use serde_json::{Value, json};
use std::fs;

const PAD: &str =
    "build pad.geojson --slope 1:2 --to-elevation 405 -o m.obj -o m.ply --lines l.geojson --report r.json --report r.txt -q";

/// A pad without ground, with its report.
fn pad() -> Site {
    let site = Site::new();
    site.run(PAD).done();
    site
}

fn report(site: &Site) -> Value {
    serde_json::from_str(&site.read("r.json")).unwrap()
}

/// Name of the report after it was changed: no longer one that its schema must allow.
const TAMPERED: &str = "r.report";

/// The report as it was changed last.
fn last(site: &Site) -> &'static str {
    if site.path(TAMPERED).exists() { TAMPERED } else { "r.json" }
}

/// Changes the report.
fn tamper(site: &Site, change: impl FnOnce(&mut Value)) {
    let mut value = serde_json::from_str(&site.read(last(site))).unwrap();
    change(&mut value);
    // The schema comes first in every report.
    let text = serde_json::to_string(&value).unwrap();
    let schema = value["schema"].to_string();
    let text = text.replacen(&format!("\"schema\":{schema},"), "", 1).replacen('{', &format!("{{\"schema\":{schema},"), 1);
    fs::write(site.path(TAMPERED), text).unwrap();
}

/// The report does not agree, for these reasons.
#[track_caller]
fn differs(site: &Site, words: &[&str]) {
    let before = site.new_files();
    let run = site.run(&format!("verify {}", last(site)));
    assert_eq!(run.code, 5, "{}{}", run.stdout, run.stderr);
    let begins = format!("error: the report does not agree with what it was made from\n  --> {}\n", last(site));
    assert!(run.stderr.starts_with(&begins), "{}", run.stderr);
    for word in words {
        assert!(run.stderr.contains(word), "{word} in {}", run.stderr);
    }
    assert_eq!(site.new_files(), before, "nothing is written");
}

/// A typed message, no panic, and nothing on standard output.
#[track_caller]
fn refused(site: &Site, arguments: &str, code: i32, words: &[&str]) {
    let run = site.run(arguments);
    assert_eq!((run.code, run.stdout.as_str()), (code, ""), "{}", run.stderr);
    assert!(run.stderr.contains("\n  --> ") || code == 2, "{}", run.stderr);
    for word in words {
        assert!(run.stderr.contains(word), "{word} in {}", run.stderr);
    }
}

#[test]
fn a_report_agrees_with_its_run() {
    let site = pad();
    let files = site.new_files();
    let run = site.run("verify r.json");
    let table = run.done();
    for word in
        ["line        pad.geojson", "same bytes", "output      m.ply", "output      r.txt", "all the same", "The report agrees"]
    {
        assert!(table.contains(word), "{word} in {table}");
    }
    assert_eq!(site.new_files(), files, "nothing is written");
    // From any number of threads.
    site.run("verify r.json --threads 1 --quiet").done();
    // Outputs may be gone.
    fs::remove_file(site.path("m.ply")).unwrap();
    assert!(site.run("verify r.json").done().contains("not there"));
}

#[test]
fn the_report_holds_hashes_of_its_outputs() {
    let site = pad();
    let result = &report(&site)["result"];
    let paths: Vec<&str> = result["outputs"].as_array().unwrap().iter().map(|output| output["path"].as_str().unwrap()).collect();
    assert_eq!(paths, ["m.obj", "m.ply", "l.geojson", "r.txt"]);
    for output in result["outputs"].as_array().unwrap() {
        let bytes = fs::read(site.path(output["path"].as_str().unwrap())).unwrap();
        assert_eq!(output["bytes"], bytes.len());
        assert_eq!(output["sha256"], slopegen::kernel::hash::sha256(&bytes).as_str());
    }
    let run = &report(&site)["run"];
    assert_eq!((&run["command"], &run["folder"]), (&json!("build"), &json!(".")));
    assert_eq!(run["options"]["slope"], json!(["1:2"]));
    assert!(run["options"].get("quiet").is_none(), "{run}");
}

/// The hash of the mesh by its definition in docs/report.md, from the OBJ file.
#[test]
fn the_hash_of_the_mesh_is_the_one_described() {
    let site = pad();
    let text = site.read("m.obj");
    let (mut vertices, mut faces, mut part) = (Vec::new(), Vec::new(), 0);
    for line in text.lines() {
        let words: Vec<&str> = line.split_whitespace().collect();
        match words.first() {
            Some(&"v") => vertices.push([1, 2, 3].map(|i| words[i].parse::<f64>().unwrap() + 0.0)),
            Some(&"g") => {
                part = ["platform", "fill_slope", "cut_slope", "ground"].iter().position(|name| *name == words[1]).unwrap()
            }
            Some(&"f") => {
                faces.push(([1, 2, 3].map(|i| words[i].split('/').next().unwrap().parse::<usize>().unwrap() - 1), part))
            }
            _ => {}
        }
    }
    let mut places: Vec<[f64; 3]> = faces.iter().flat_map(|(face, _)| face.map(|v| vertices[v])).collect();
    places.sort_by(|a, b| a.partial_cmp(b).unwrap());
    places.dedup();
    let rank = |v: usize| places.binary_search_by(|place| place.partial_cmp(&vertices[v]).unwrap()).unwrap() as u32;
    let mut rows: Vec<([u32; 3], u8)> = Vec::new();
    for (face, part) in faces {
        let mut corners = face.map(rank);
        while corners[0] != *corners.iter().min().unwrap() {
            corners.rotate_left(1);
        }
        rows.push((corners, part as u8));
    }
    rows.sort_unstable();
    let mut bytes = b"slopegen-mesh/1\n".to_vec();
    bytes.extend((places.len() as u64).to_le_bytes());
    bytes.extend((rows.len() as u64).to_le_bytes());
    places.iter().flatten().for_each(|c| bytes.extend(c.to_le_bytes()));
    for (corners, part) in rows {
        corners.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        bytes.push(part);
    }
    assert_eq!(report(&site)["result"]["mesh_sha256"], slopegen::kernel::hash::sha256(&bytes).as_str());
}

#[test]
fn on_ground_from_a_job_file_in_another_folder() {
    let site = on_ground();
    fs::create_dir(site.path("out")).unwrap();
    let job = "input = 'hill_road.geojson'\nterrain = 'ground.obj'\nwidth = 7\nslope = '1:1.5'\nstations = 20\n\
               output = ['out/w.xml', 'out/w.stl']\nfinished = 'out/f.ply'\nreport = ['out/r.json', 'out/r.html']\n";
    fs::write(site.path("job.toml"), job).unwrap();
    site.run("build job.toml --quiet").done();
    let run = site.run("verify out/r.json");
    let table = run.done();
    for word in ["terrain     ground.obj", "out/f.ply", "out/w.stl.origin.json", "out/r.html"] {
        assert!(table.contains(word), "{word} in {table}");
    }
    let report: Value = serde_json::from_str(&site.read("out/r.json")).unwrap();
    assert_eq!(report["run"]["folder"], "..");
    // A figure of one station.
    let text = site.read("out/r.json");
    let cut = report["stations"][3]["cut"].to_string();
    assert_eq!(text.matches(&format!("\"cut\": {cut},")).count(), 1, "{cut}");
    fs::write(site.path("out/r.json"), text.replace(&format!("\"cut\": {cut},"), "\"cut\": 1234.5,")).unwrap();
    let run = site.run("verify out/r.json");
    assert_eq!(run.code, 5);
    assert!(run.stderr.contains(&format!("1234.5 stated, {cut} found")), "{}", run.stderr);
}

#[test]
fn a_report_of_volumes() {
    let site = Site::with("a.obj", "v 0 0 3\nv 20 0 3\nv 20 20 3\nv 0 20 3\nf 1 2 3\nf 1 3 4\n");
    fs::write(site.path("b.obj"), "v 0 0 1\nv 20 0 2\nv 20 20 5\nv 0 20 3\nf 1 2 3\nf 1 3 4\n").unwrap();
    site.run("volume a.obj b.obj --report r.json --report v.md --quiet").done();
    assert!(site.run("verify r.json").done().contains("design      a.obj"));
    tamper(&site, |report| report["volumes"]["cut"] = json!(1.0));
    differs(&site, &["volumes.cut: 1.0 stated, "]);
}

#[test]
fn a_changed_figure_is_found() {
    let site = pad();
    let fill = report(&site)["volumes"]["fill"].as_f64().unwrap();
    tamper(&site, |report| report["volumes"]["fill"] = json!(f64::from_bits(fill.to_bits() + 1)));
    differs(&site, &["volumes.fill: "]);
    for (key, value) in
        [("/surface/triangles", json!(7)), ("/line/length", json!("long")), ("/certificate/overlaps", json!(null))]
    {
        let site = pad();
        tamper(&site, |report| *report.pointer_mut(key).unwrap() = value);
        differs(&site, &[&key[1..].replace('/', ".")]);
    }
    let site = pad();
    tamper(&site, |report| drop(report.as_object_mut().unwrap().remove("volumes")));
    differs(&site, &["volumes.fill: nothing stated, "]);
    let site = pad();
    tamper(&site, |report| report["result"]["mesh_sha256"] = json!("0".repeat(64)));
    differs(&site, &["result.mesh_sha256"]);
    let site = pad();
    tamper(&site, |report| report["result"]["sha256"] = json!("0".repeat(64)));
    differs(&site, &["result : sha256 0000"]);
}

#[test]
fn a_changed_option_is_found() {
    let site = pad();
    tamper(&site, |report| report["run"]["options"]["slope"] = json!(["1:2.5"]));
    differs(&site, &["volumes.fill", "made again m.obj", "slopes.fill.one_in"]);
    // One with which the run is refused.
    let site = pad();
    tamper(&site, |report| report["run"]["options"]["to-elevation"] = json!(["900"]));
    differs(&site, &["the run is refused this time: "]);
    // Another output: nothing is written, and its hash is not stated.
    let site = pad();
    tamper(&site, |report| report["run"]["options"]["output"] = json!(["elsewhere.obj"]));
    differs(&site, &["output elsewhere.obj: sha256 none stated", "made again m.obj"]);
    assert!(!site.path("elsewhere.obj").exists());
}

#[test]
fn a_changed_file_is_found() {
    let site = pad();
    let stated = report(&site)["inputs"][0]["sha256"].as_str().unwrap().to_owned();
    let line = site.read("pad.geojson").replacen("0,", "0 ,", 1);
    fs::write(site.path("pad.geojson"), &line).unwrap();
    let found = slopegen::kernel::hash::sha256(line.as_bytes());
    differs(&site, &[&format!("line pad.geojson: sha256 {stated} stated, {found} found")]);

    let site = pad();
    let mesh = site.read("m.obj").replacen("v ", "v  ", 1);
    fs::write(site.path("m.obj"), mesh).unwrap();
    differs(&site, &["output m.obj: sha256 "]);

    // An input that is not there cannot be read; in another folder it is found.
    let site = pad();
    fs::create_dir(site.path("inputs")).unwrap();
    fs::rename(site.path("pad.geojson"), site.path("inputs/pad.geojson")).unwrap();
    refused(&site, "verify r.json", 3, &["pad.geojson"]);
    site.run("verify r.json --input-dir inputs").done();
    refused(&site, "verify r.json --input-dir nowhere", 3, &["nowhere"]);
}

/// Of another version figures are compared within rounding, and told as such.
#[test]
fn reports_of_other_versions() {
    let site = pad();
    let fill = report(&site)["volumes"]["fill"].as_f64().unwrap();
    tamper(&site, |report| {
        report["tool"]["version"] = json!("0.0.9");
        report["volumes"]["fill"] = json!(fill * (1.0 + 1e-12));
        report["result"]["sha256"] = json!("0".repeat(64));
    });
    let run = site.run(&format!("verify {TAMPERED}"));
    assert!(run.done().contains("note: made by version 0.0.9, run again by "), "{}", run.stdout);
    tamper(&site, |report| report["volumes"]["fill"] = json!(fill * (1.0 + 1e-6)));
    differs(&site, &["volumes.fill"]);
}

/// Of another platform as well: where the result is the same, what is made of it alone is the same bytes.
#[test]
fn outputs_from_another_platform() {
    let site = pad();
    tamper(&site, |report| report["run"]["platform"] = json!("riscv64-plan9"));
    site.run(&format!("verify {TAMPERED}")).done();
    // A mesh that was changed, and its hash with it.
    let other = site.read("m.obj").replacen("v 5", "v 6", 1);
    fs::write(site.path("m.obj"), &other).unwrap();
    let hash: String =
        <sha2::Sha256 as sha2::Digest>::digest(other.as_bytes()).iter().map(|byte| format!("{byte:02x}")).collect();
    tamper(&site, |report| {
        let outputs = report["result"]["outputs"].as_array_mut().unwrap();
        let mesh = outputs.iter_mut().find(|output| output["path"] == "m.obj").unwrap();
        mesh["sha256"] = json!(hash);
    });
    differs(&site, &["m.obj"]);
}

#[test]
fn what_is_no_report_is_refused() {
    let site = pad();
    let whole = site.read("r.json");
    let write = |text: &str| fs::write(site.path("h.report"), text).unwrap();
    let begins = r#"{"schema": "slopegen-report/1", "#;
    for (text, words) in [
        ("", "no report of this program"),
        ("garbage", "no report of this program"),
        ("[1, 2, 3]", "no report of this program"),
        (r#"{"schema": "slopegen-check/1"}"#, "cannot be run again"),
        (r#"{"schema": "slopegen-report/2"}"#, "cannot be run again"),
        (&whole[..whole.len() / 2], "damaged"),
        (&format!("{begins}\"volumes\": {{\"cut\": 1e999}}}}"), "damaged"),
        (&format!("{begins}\"x\": {}", "[".repeat(100_000)), "damaged"),
        (&format!("{begins}\"run\": 1}}"), "does not say how it was made"),
        (&format!("{begins}\"x\": 1}}"), "has no key `run`"),
        (&format!("{begins}\"run\": {{\"command\": \"man\", \"options\": {{}}}}}}"), "neither `build` nor `volume`"),
        (&format!("{begins}\"run\": {{\"command\": \"build\", \"options\": {{\"slope\": 1}}}}}}"), "lists of texts"),
        (&format!("{begins}\"run\": {{\"command\": \"build\", \"options\": {{\"help\": []}}}}}}"), "is no option"),
        (&format!("{begins}\"run\": {{\"command\": \"build\", \"options\": {{\"threads\": [\"9\"]}}}}}}"), "is no option"),
        (&format!("{begins}\"run\": {{\"command\": \"build\", \"options\": {{\"slope\": [\"1:2\"]}}}}}}"), "`run.options`: "),
    ] {
        write(text);
        refused(&site, "verify h.report", 3, &[words, "h.report"]);
    }
    for (option, value, words) in [
        ("input", "-", "came from standard input"),
        ("input", "/dev/zero", "it is not a file"),
        ("slope", "steep", "`run.options`: "),
        ("slope", "--help", "`run.options`: "),
        ("tolerance", "1e-300", "`run.options`: "),
    ] {
        let mut value_of = report(&site);
        value_of["run"]["options"][option] = json!([value]);
        value_of["run"]["options"]["input-format"] = json!(["geojson"]);
        let text = value_of.to_string();
        write(&format!("{}{}", r#"{"schema":"slopegen-report/1","#, &text[1..]));
        let run = site.run_with("verify h.report", "garbage");
        assert!(run.code == 3 && run.stderr.contains(words), "{option} {value}: {} {}", run.code, run.stderr);
    }
    refused(&site, "verify no_such.report", 3, &["no_such.report"]);
    refused(&site, "verify .", 3, &["not a file"]);
}
