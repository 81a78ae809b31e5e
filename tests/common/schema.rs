//! Validation of JSON reports against the published schemas.

use jsonschema::Validator;
use serde_json::Value;
use slopegen::report::schema::PUBLISHED;
use std::collections::BTreeMap;
use std::path::Path;
use std::sync::LazyLock;

/// One for each schema, by its name, from the files under `docs/`.
static VALIDATORS: LazyLock<BTreeMap<&str, Validator>> = LazyLock::new(|| {
    let of = |file: String| {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs").join(file);
        let schema: Value = serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap();
        jsonschema::draft202012::new(&schema).unwrap()
    };
    PUBLISHED.iter().map(|published| (published.name, of(published.file()))).collect()
});

/// What a report has that its schema does not allow, with places; nothing if it is valid.
pub(crate) fn faults(report: &Value) -> Vec<String> {
    let Some(name) = report["schema"].as_str() else { return vec!["there is no key `schema`".to_owned()] };
    let Some(validator) = VALIDATORS.get(name) else { return vec![format!("no schema is published for `{name}`")] };
    validator.iter_errors(report).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

/// Checks every report (`.json` with a key `schema`) in a folder; gives how many there are.
#[track_caller]
pub(crate) fn check_folder(folder: &Path) -> usize {
    let mut count = 0;
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let ending = path.extension().and_then(|e| e.to_str()).unwrap_or_default();
        if !ending.eq_ignore_ascii_case("json") || !path.is_file() {
            continue;
        }
        let Ok(text) = std::fs::read_to_string(&path) else { continue };
        let Ok(report) = serde_json::from_str::<Value>(&text) else { continue };
        if report.get("schema").is_some() {
            let faults = faults(&report);
            assert!(faults.is_empty(), "{}:\n{}\n{text}", path.display(), faults.join("\n"));
            count += 1;
        }
    }
    count
}
