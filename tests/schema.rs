//! The published schemas: they are those of the program, documented key by key, and refuse what is no report.

mod common;

use common::schema::faults;
use serde_json::{Value, json};
use slopegen::report::schema::PUBLISHED;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn read(path: &str) -> String {
    fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

fn golden(name: &str) -> Value {
    serde_json::from_str(&read(&format!("tests/golden/{name}.json"))).unwrap()
}

#[test]
fn the_files_are_those_of_the_program() {
    for published in PUBLISHED {
        let path = format!("docs/{}", published.file());
        assert!(read(&path) == published.text(), "{path} is not that of the program: run `cargo run --example schema`");
        let schema = published.schema();
        jsonschema::draft202012::meta::validate(&schema).unwrap();
    }
}

#[test]
fn every_golden_report_is_valid() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    assert!(common::schema::check_folder(&folder) >= 4);
}

/// The value under a path such as `/volumes/net`.
#[track_caller]
fn at<'a>(report: &'a mut Value, path: &str) -> &'a mut Value {
    report.pointer_mut(path).unwrap_or_else(|| panic!("no {path}"))
}

/// Every required key left out in turn, in every object, is missed; every object refuses a key it does not know.
#[test]
fn a_missing_key_and_one_too_many_are_refused() {
    /// Objects with figures under names of their own take any key.
    fn open(path: &str) -> bool {
        let last = path.trim_end_matches(|c: char| c.is_ascii_digit() || c == '/');
        ["/warnings", "/options", "/places", "/worst", "/flattest", "/steepest", "/smallest"]
            .iter()
            .any(|end| last.ends_with(end))
    }
    fn objects(value: &Value, path: &str, found: &mut Vec<String>) {
        match value {
            Value::Object(keys) => {
                found.push(path.to_owned());
                keys.iter().for_each(|(key, value)| objects(value, &format!("{path}/{key}"), found));
            }
            Value::Array(items) => (0..).zip(items).for_each(|(i, item)| objects(item, &format!("{path}/{i}"), found)),
            _ => {}
        }
    }
    // Keys that the text of docs/report.md marks with a question mark are those that may be left out of these reports.
    let optional = BTreeSet::from([
        "crs",
        "cut",
        "fill",
        "volumes",
        "areas",
        "depths",
        "daylight",
        "stations",
        "pads",
        "section_slope",
        "terrain",
        "finished",
        "parts",
        "bulking",
        "end_area",
        "prismoidal",
        "elevation",
        "path",
        "cut_mean",
        "fill_mean",
        "cut_max_at",
        "fill_max_at",
        "z",
        "chain",
        "station",
        "interval",
        "value",
        "free_slope",
        "net_cumulative_compacted",
        "cells",
        "within",
        "slope_kept",
        "slope_bound",
        "min",
        "max",
        "flattest",
        "steepest",
        "smallest",
        "triangles",
        "vertices",
        "section",
        "average_end_area",
        "breaklines",
        "run",
        "result",
        "folder",
        "mesh_sha256",
        "finished_sha256",
        "message",
        "expected",
        "got",
        "bound",
        "error",
        "same",
        "width",
        "crossfall",
    ]);
    for name in ["report", "report_ground", "between", "check", "selftest"] {
        let report = golden(name);
        assert_eq!(faults(&report), [""; 0], "{name}");
        let mut paths = Vec::new();
        objects(&report, "", &mut paths);
        assert!(paths.len() > 10, "{name}");
        // Options have names of their own.
        for path in paths.into_iter().filter(|path| !path.ends_with("/options")) {
            let mut more = report.clone();
            at(&mut more, &path)["another"] = json!([]);
            assert_ne!(faults(&more), [""; 0], "{name}: {path} takes a key that is a list");
            if !open(&path) {
                at(&mut more, &path)["another"] = json!(1);
                assert_ne!(faults(&more), [""; 0], "{name}: {path} takes any key");
            }
            let keys: Vec<String> = report.pointer(&path).and_then(Value::as_object).unwrap().keys().cloned().collect();
            for key in keys {
                let mut less = report.clone();
                at(&mut less, &path).as_object_mut().unwrap().remove(&key);
                let figure = open(&path) && !["code", "message", "at", "degrees"].contains(&key.as_str());
                if !optional.contains(key.as_str()) && !figure {
                    assert_ne!(faults(&less), [""; 0], "{name}: {path}/{key} may be left out");
                }
            }
        }
    }
}

#[test]
fn wrong_values_are_refused() {
    for (name, path, value) in [
        ("report", "/schema", json!("slopegen-report/2")),
        ("report", "/schema", json!("slopegen-check/1")),
        ("report", "/line", json!([])),
        ("report", "/volumes/cut", json!("12")),
        ("report", "/volumes/cut", json!(-1.0)),
        ("report", "/volumes/net", Value::Null),
        ("report", "/volumes/balance", json!("even")),
        ("report", "/volumes/method", json!("grid")),
        ("report", "/volumes/sign_rule", json!("net = fill − cut")),
        ("report", "/volumes/reference/kind", json!("sea")),
        ("report", "/slopes/measure", json!("section")),
        ("report", "/slopes/cut/ratio", json!(0.0)),
        ("report", "/slopes/cut/degrees", json!(90.0)),
        ("report", "/inputs/0/sha256", json!("9f86")),
        ("report", "/inputs/0/sha256", json!("9F86D081884C7D659A2FEAA0C55AD015A3BF4F1B2B0B822CD15D6C15B0F00A08")),
        ("report", "/inputs/0/bytes", json!(1.5)),
        ("report", "/units/length", json!("yd")),
        ("report", "/units/volume", json!("cu m")),
        ("report", "/extent/kind", json!("depth")),
        ("report", "/surface/triangles", json!(-1)),
        ("report", "/certificate/paired", json!("yes")),
        ("report", "/warnings/0/code", json!("Buried Line")),
        ("report", "/warnings/0/count", json!({})),
        ("report", "/design/tolerance", json!(0.0)),
        ("report_ground", "/stations/0/section/from/cut", json!(-0.5)),
        ("report_ground", "/volumes/bulking/shrink", json!(1.0)),
        ("between", "/meshes/0/role", json!("base")),
        ("between", "/volumes/reference", json!({"kind": "plane", "path": "x"})),
        ("between", "/depths/cut_max_at", json!({"x": 1, "y": 2})),
        ("check", "/findings/0/severity", json!("warning")),
        ("check", "/findings/0/code", json!("gap")),
        ("check", "/boundary/loops/0/kind", json!("inner")),
        ("check", "/slopes/level/share", json!(1.5)),
        ("check", "/mesh/min", json!([1.0, 2.0])),
    ] {
        let mut report = golden(name);
        *at(&mut report, path) = value.clone();
        assert_ne!(faults(&report), [""; 0], "{name}: {path} may be {value}");
    }
    // Signs that mean something are taken.
    let mut report = golden("report");
    *at(&mut report, "/volumes/net") = json!(-5.0);
    *at(&mut report, "/line/z_min") = json!(-400.0);
    assert_eq!(faults(&report), [""; 0]);
    // An interval with sections has the volumes worked out from them.
    let mut report = golden("report_ground");
    at(&mut report, "/stations/0").as_object_mut().unwrap().remove("prismoidal");
    assert_ne!(faults(&report), [""; 0]);
}

/// Names of all keys of a schema.
fn keys(value: &Value, found: &mut BTreeSet<String>) {
    match value {
        Value::Object(object) => {
            if let Some(Value::Object(properties)) = object.get("properties") {
                found.extend(properties.keys().cloned());
            }
            object.values().for_each(|value| keys(value, found));
        }
        Value::Array(items) => items.iter().for_each(|item| keys(item, found)),
        _ => {}
    }
}

/// Names in the code spans of a text: `a[].b`, `.c` are `a`, `b`, `c`.
fn names(text: &str) -> BTreeSet<String> {
    let spans = text.split('`').skip(1).step_by(2);
    let parts = spans.flat_map(|span| span.split(['.', '[', ']', '…', ' ', ',', ':', '(', ')']));
    parts.filter(|name| !name.is_empty()).map(str::to_owned).collect()
}

#[test]
fn every_key_is_described_and_no_other() {
    let document = read("docs/report.md");
    for published in PUBLISHED {
        // The part of the document about this schema: from the heading that its file is linked below, to the next of its kind.
        let begin = document.find(&format!("]({})", published.file())).expect("the document links its file");
        let begin = document[..begin].rfind("\n# ").map_or(0, |at| at + 1);
        let end = document[begin..].find("\n# ").map_or(document.len(), |at| begin + at);
        let part = &document[begin..end];
        let mut keys = BTreeSet::new();
        self::keys(&published.schema(), &mut keys);
        // Parts after the first say that what they do not list is as above.
        let described = names(&document[..end]);
        let lacking: Vec<&String> = keys.difference(&described).collect();
        assert!(lacking.is_empty(), "docs/report.md does not describe {lacking:?} of {}", published.name);
        let tables = part.split("\n## Findings").next().unwrap();
        let rows = tables.lines().filter(|line| line.starts_with("| `"));
        let columns: BTreeSet<String> = rows.filter_map(|row| row.split('|').nth(1)).flat_map(names).collect();
        assert!(columns.len() > 15, "only {} names: the search is broken", columns.len());
        let unknown: Vec<&String> = columns.difference(&keys).collect();
        assert!(unknown.is_empty(), "docs/report.md describes {unknown:?}, which {} does not have", published.name);
    }
}
