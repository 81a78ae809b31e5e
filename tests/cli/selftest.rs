//! `slopegen selftest`: cases with known figures.

use super::Site;
use serde_json::Value;
use std::fmt::Write as _;
use std::path::Path;

/// All passes, the table and the report say so, and nothing is left behind.
#[test]
fn all_passes() {
    let site = Site::new();
    let run = site.run("selftest --threads 2 --report s.json --verbose");
    let table = run.done();
    assert!(table.contains("threads: 2\n") && table.contains(": all passed\n") && !table.contains("FAILED"), "{table}");
    assert!(run.stderr.contains(" s  level pad 30 × 20, 4 high, 1:2\n"), "times on the terminal: {}", run.stderr);
    assert_eq!(site.new_files(), ["s.json"]);
    let report: Value = serde_json::from_str(&site.read("s.json")).unwrap();
    assert_eq!((&report["passed"], &report["failed"], &report["threads"]), (&true.into(), &0.into(), &2.into()));
    assert_eq!(report["hashes"][0]["same"], true, "cases without cones are the same on all systems");
    pinned(&report);
    // No times in it: the same bytes again.
    let before = site.read("s.json");
    site.run("selftest --threads 2 --report s.json --quiet").done();
    assert_eq!(site.read("s.json"), before);
}

/// What is computed, from which formula, and within which bound. Figures found have their last digits from the system.
fn pinned(report: &Value) {
    let mut text = String::new();
    for case in report["cases"].as_array().unwrap() {
        let _ = writeln!(text, "{}: {}", case["group"].as_str().unwrap(), case["case"].as_str().unwrap());
        for row in case["rows"].as_array().unwrap() {
            assert_eq!(row["passed"], true);
            let number = |key: &str| row[key].as_f64();
            let expected = number("expected").map_or("refused".to_owned(), |value| format!("{value:.4}"));
            let bound = number("bound").map_or(String::new(), |bound| format!(" ± {bound:.0e}"));
            let (figure, formula) = (row["figure"].as_str().unwrap(), row["formula"].as_str().unwrap());
            let _ = writeln!(text, "  {figure} = {expected}{bound}: {formula}");
        }
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/selftest_cases.txt");
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(path, text).unwrap();
    } else {
        let golden = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        assert_eq!(text, golden, "{}; after a change that is meant run the test with UPDATE_GOLDEN=1", path.display());
    }
}

#[test]
fn reports_are_json_or_text() {
    let site = Site::new();
    let run = site.run("selftest --report s.html");
    assert_eq!((run.code, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("s.html"), "{}", run.stderr);
}
