//! What makes a run repeatable: what was asked for, and hashes of what came out.

use crate::kernel::hash::sha256;
use crate::write::EncodeError;
use schemars::JsonSchema;
use serde::Serialize;
use serde_json::{Map, Value};
use std::collections::BTreeMap;
use std::path::{Component, Path};

/// Options by their long names without hyphens in front, each with its values; those without a value are switches. Files given by
/// position are under `input`, `design` and `existing`.
pub type Options = BTreeMap<String, Vec<String>>;

/// What was asked for: enough to run it again.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct RunRecord {
    /// The command.
    #[schemars(extend("enum" = ["build", "volume"]))]
    pub command: &'static str,
    /// Processor and system of the program, such as `x86_64-linux`: elsewhere last digits may differ.
    pub platform: String,
    /// The way from the folder of the report to the folder that paths are relative to; left out where the names given do not
    /// tell.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(regex(pattern = r"^\.(\.(/\.\.)*)?$"))]
    pub folder: Option<String>,
    /// Options as given, by their long names, each with its values; a switch has none. Those that change no result (threads,
    /// colours) are not among them.
    pub options: Options,
}

impl RunRecord {
    /// A run of a command of this program.
    pub fn new(command: &'static str, options: Options) -> Self {
        Self { command, platform: platform(), folder: None, options }
    }

    /// The same, for a report at `path`.
    #[must_use]
    pub fn seen_from(&self, path: &Path) -> Self {
        Self { folder: way_back(path), ..self.clone() }
    }
}

/// Processor and system the program was built for.
pub fn platform() -> String {
    format!("{}-{}", std::env::consts::ARCH, std::env::consts::OS)
}

/// From the folder of a path back to the folder it is relative to. `None` where that would take names the path does not have.
fn way_back(path: &Path) -> Option<String> {
    let mut depth = 0;
    for component in path.parent()?.components() {
        match component {
            Component::Normal(_) => depth += 1,
            Component::CurDir => {}
            Component::ParentDir | Component::RootDir | Component::Prefix(_) => return None,
        }
    }
    Some(if depth == 0 { ".".to_owned() } else { vec![".."; depth].join("/") })
}

/// Hashes of what came out. They do not depend on the number of threads, nor on the order of the lines in the file.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct ResultFigures {
    /// SHA-256 of the result, whatever the formats it was written in: see docs/report.md.
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub sha256: String,
    /// SHA-256 of the mesh of the works, as a set of triangles.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub mesh_sha256: Option<String>,
    /// SHA-256 of the finished ground, as a set of triangles, where it was written.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub finished_sha256: Option<String>,
    /// SHA-256 of the figures.
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub figures_sha256: String,
    /// The files written, reports in JSON aside.
    pub outputs: Vec<OutputFile>,
}

/// A file written.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct OutputFile {
    /// Its path as given.
    pub path: String,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 of its bytes, 64 lower-case hexadecimal digits.
    #[schemars(regex(pattern = r"^[0-9a-f]{64}$"))]
    pub sha256: String,
}

/// The beginning of a hash, for people.
pub(super) fn short(hash: &str) -> &str {
    hash.get(..12).unwrap_or(hash)
}

/// Keys of a report that are figures of the result. Angles are not among them: they come from functions whose last digit differs
/// between systems.
const FIGURES: [&str; 14] = [
    "units", "meshes", "design", "extent", "levels", "surface", "volumes", "areas", "depths", "daylight", "stations", "pads",
    "terrain", "finished",
];

/// Keys within them that say where something is along a line or in which file, which the order of the file decides.
const NAMES: [&str; 3] = ["chain", "path", "station"];

/// First line of what the hash of the result is taken of.
const HEAD: &str = "slopegen-result/1\n";

impl ResultFigures {
    /// Of meshes by their [fingerprints](crate::mesh::fingerprint::fingerprint), and the figures of a report.
    ///
    /// # Errors
    /// [`EncodeError::Report`] if the report cannot be turned into JSON.
    pub fn of(mesh: Option<String>, finished: Option<String>, report: &impl Serialize) -> Result<Self, EncodeError> {
        let figures_sha256 = sha256(figures(&serde_json::to_value(report)?).as_bytes());
        let mut text = HEAD.to_owned();
        let lines = [("mesh", mesh.as_ref()), ("finished", finished.as_ref()), ("figures", Some(&figures_sha256))];
        for (name, hash) in lines {
            text.extend(hash.map(|hash| format!("{name} {hash}\n")));
        }
        let sha256 = sha256(text.as_bytes());
        Ok(Self { sha256, mesh_sha256: mesh, finished_sha256: finished, figures_sha256, outputs: Vec::new() })
    }
}

/// The figures of a report in one form: JSON without blanks, keys in the order of their bytes, rows of lists in the order of the
/// bytes of their JSON, names left out.
fn figures(report: &Value) -> String {
    let kept = FIGURES.iter().filter_map(|key| Some(((*key).to_owned(), canonical(report.get(*key)?))));
    Value::Object(kept.collect::<Map<String, Value>>()).to_string()
}

fn canonical(value: &Value) -> Value {
    match value {
        // Maps of this kind keep their keys in order.
        Value::Object(keys) => {
            let kept = keys.iter().filter(|(key, _)| !NAMES.contains(&key.as_str()));
            Value::Object(kept.map(|(key, value)| (key.clone(), canonical(value))).collect())
        }
        Value::Array(items) => {
            let mut items: Vec<(String, Value)> = items.iter().map(canonical).map(|item| (item.to_string(), item)).collect();
            if items.iter().any(|(_, item)| item.is_object()) {
                items.sort_by(|a, b| a.0.cmp(&b.0));
            }
            Value::Array(items.into_iter().map(|(_, item)| item).collect())
        }
        other => other.clone(),
    }
}

#[cfg(test)]
pub(super) mod testing {
    use super::*;

    pub(in super::super) fn run(command: &'static str) -> RunRecord {
        let options = [("input", vec!["site/road.geojson"]), ("slope", vec!["1:1.5"]), ("closed", vec![])];
        let options = options.map(|(key, values)| (key.to_owned(), values.into_iter().map(str::to_owned).collect()));
        RunRecord { command, platform: "x86_64-linux".into(), folder: Some("..".into()), options: options.into_iter().collect() }
    }

    pub(in super::super) fn result(mesh: bool) -> ResultFigures {
        let hash = |digit: &str| digit.repeat(64);
        ResultFigures {
            sha256: hash("1"),
            mesh_sha256: mesh.then(|| hash("2")),
            finished_sha256: mesh.then(|| hash("3")),
            figures_sha256: hash("4"),
            outputs: vec![OutputFile { path: "out/road.obj".into(), bytes: 1_234_567, sha256: hash("5") }],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn the_way_back_names_no_folder() {
        for (path, expected) in [
            ("r.json", Some(".")),
            ("./r.json", Some(".")),
            ("out/r.json", Some("..")),
            ("a/./b/r.json", Some("../..")),
            ("../r.json", None),
            ("a/../r.json", None),
            ("/tmp/r.json", None),
        ] {
            assert_eq!(way_back(Path::new(path)).as_deref(), expected, "{path}");
        }
    }

    #[test]
    fn the_form_of_figures() {
        let report = json!({
            "volumes": {"net": -1.5, "cut": 0.5, "fill": 2, "reference": {"path": "a.obj", "kind": "terrain"}},
            "stations": [{"chain": "b", "from": 20.0, "cut": 1e-7}, {"chain": "a", "from": 0.0, "cut": 3.0}],
            "levels": [2.0, 1.0],
            "timing": {"total": 1.0},
            "slopes": {"fill": {"degrees": 26.5}},
        });
        assert_eq!(
            figures(&report),
            r#"{"levels":[2.0,1.0],"stations":[{"cut":1e-7,"from":20.0},{"cut":3.0,"from":0.0}],"volumes":{"cut":0.5,"fill":2,"net":-1.5,"reference":{"kind":"terrain"}}}"#
        );
    }

    /// `printf 'slopegen-result/1\nmesh m\nfigures …\n' | sha256sum`, with the hash of `{"levels":[]}`.
    #[test]
    fn the_hash_of_a_result() {
        let result = ResultFigures::of(Some("m".into()), None, &json!({"levels": []})).unwrap();
        assert_eq!(result.figures_sha256, sha256(br#"{"levels":[]}"#));
        let text = format!("slopegen-result/1\nmesh m\nfigures {}\n", result.figures_sha256);
        assert_eq!(result.sha256, sha256(text.as_bytes()));
        let other = ResultFigures::of(None, Some("m".into()), &json!({"levels": []})).unwrap();
        assert_ne!(other.sha256, result.sha256);
    }
}
