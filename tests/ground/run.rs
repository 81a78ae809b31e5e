//! Runs of the program, and what they leave.

use crate::common::schema::check_folder;
use crate::figures::Figures;
use crate::site::Site;
use crate::tin::Ground;
use serde_json::Value;
use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Duration;
use tempfile::TempDir;

/// Longer than any job here takes on a slow machine; a hang fails the test instead of holding it up.
const PATIENCE: Duration = Duration::from_secs(120);

/// A working folder.
pub(crate) struct Folder(TempDir);

/// How a run ended.
#[derive(Debug)]
pub(crate) struct Run {
    pub(crate) code: i32,
    pub(crate) stderr: String,
}

impl Folder {
    pub(crate) fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// A folder with line and ground of a site, as `line.geojson` and `ground.obj`.
    pub(crate) fn of(site: &Site) -> Self {
        Self::new().with("line.geojson", site.geojson()).with("ground.obj", site.ground.obj())
    }

    pub(crate) fn with(self, name: &str, content: impl AsRef<[u8]>) -> Self {
        std::fs::write(self.path(name), content).unwrap();
        self
    }

    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub(crate) fn read(&self, name: &str) -> String {
        std::fs::read_to_string(self.path(name)).unwrap_or_else(|e| panic!("{name}: {e}"))
    }

    /// Names of all files, sorted.
    pub(crate) fn files(&self) -> Vec<String> {
        let mut names: Vec<String> =
            std::fs::read_dir(self.0.path()).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    pub(crate) fn run(&self, arguments: &str) -> Run {
        let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
            .args(arguments.split_whitespace())
            .current_dir(self.0.path())
            .env("NO_COLOR", "1")
            .timeout(PATIENCE)
            .output()
            .unwrap();
        let stderr = String::from_utf8_lossy(&output.stderr).into_owned();
        // A panic is 101, a hang or a signal −1: neither is an answer.
        let code = output.status.code().unwrap_or(-1);
        assert!((0..=5).contains(&code) && !stderr.contains("panicked"), "{arguments}: exit code {code}\n{stderr}");
        check_folder(self.0.path());
        Run { code, stderr }
    }
}

impl Run {
    #[track_caller]
    pub(crate) fn done(self) -> Self {
        assert_eq!(self.code, 0, "{}", self.stderr);
        self
    }
}

/// The options of a site.
pub(crate) fn options(site: &Site) -> String {
    let percent = |k: f64| format!("{}%", 100.0 * k);
    format!("--cut-slope {} --fill-slope {} --tolerance {}", percent(site.cut_slope), percent(site.fill_slope), site.tolerance)
}

/// What a finished run has left.
#[derive(Debug)]
pub(crate) struct Built {
    pub(crate) report: Value,
    pub(crate) design: Mesh,
    pub(crate) finished: Mesh,
    pub(crate) lines: Vec<Feature>,
}

/// Builds a site with all outputs.
#[track_caller]
pub(crate) fn build(site: &Site, more: &str) -> Built {
    let folder = Folder::of(site);
    build_in(&folder, &format!("line.geojson --terrain ground.obj {} {more}", options(site)))
}

/// `slopegen build` in a folder, with all outputs.
#[track_caller]
pub(crate) fn build_in(folder: &Folder, arguments: &str) -> Built {
    let outputs = "-o design.obj --finished finished.obj --lines lines.geojson --report report.json --quiet";
    folder.run(&format!("build {arguments} {outputs}")).done();
    Built {
        report: serde_json::from_str(&folder.read("report.json")).unwrap(),
        design: Mesh::from_obj(&folder.read("design.obj")),
        finished: Mesh::from_obj(&folder.read("finished.obj")),
        lines: features(&folder.read("lines.geojson")),
    }
}

impl Built {
    /// A number of the report, `a.b.c`.
    #[track_caller]
    pub(crate) fn number(&self, key: &str) -> f64 {
        let found = key.split('.').fold(&self.report, |value, part| &value[part]);
        found.as_f64().unwrap_or_else(|| panic!("{key}: {found}"))
    }

    pub(crate) fn figures(&self) -> Figures {
        Figures {
            cut: self.number("volumes.cut"),
            fill: self.number("volumes.fill"),
            cut_area: self.number("areas.cut"),
            fill_area: self.number("areas.fill"),
        }
    }

    /// Lines of a kind.
    pub(crate) fn of_kind(&self, kind: &str) -> impl Iterator<Item = &Feature> {
        self.lines.iter().filter(move |f| f.kind == kind)
    }
}

/// A mesh with the part of every triangle.
#[derive(Clone, Debug, Default)]
pub(crate) struct Mesh {
    pub(crate) tin: Ground,
    pub(crate) parts: Vec<String>,
}

impl Mesh {
    pub(crate) fn from_obj(text: &str) -> Self {
        let (mut mesh, mut part) = (Self::default(), String::new());
        for line in text.lines() {
            let mut words = line.split_whitespace();
            let kind = words.next();
            let words: Vec<&str> = words.collect();
            match kind {
                Some("v") => mesh.tin.vertices.push(std::array::from_fn(|i| words[i].parse().unwrap())),
                Some("g") => part = words[0].to_owned(),
                Some("f") => {
                    assert_eq!(words.len(), 3, "{line}");
                    mesh.tin.triangles.push(std::array::from_fn(|i| words[i].parse::<usize>().unwrap() - 1));
                    mesh.parts.push(part.clone());
                }
                _ => {}
            }
        }
        mesh
    }

    /// The mesh without the triangles of a part.
    pub(crate) fn without(&self, part: &str) -> Self {
        let kept: Vec<usize> = (0..self.parts.len()).filter(|&t| self.parts[t] != part).collect();
        Self {
            tin: Ground { vertices: self.tin.vertices.clone(), triangles: kept.iter().map(|&t| self.tin.triangles[t]).collect() },
            parts: kept.iter().map(|&t| self.parts[t].clone()).collect(),
        }
    }

    /// Directed edges with the number of their triangle; fails where one occurs twice.
    #[track_caller]
    pub(crate) fn edges(&self) -> BTreeMap<[usize; 2], usize> {
        let mut edges = BTreeMap::new();
        for (t, &[a, b, c]) in self.tin.triangles.iter().enumerate() {
            for edge in [[a, b], [b, c], [c, a]] {
                assert!(edges.insert(edge, t).is_none(), "edge {edge:?} twice in one direction");
            }
        }
        edges
    }
}

/// A line of the line work.
#[derive(Clone, Debug)]
pub(crate) struct Feature {
    pub(crate) kind: String,
    pub(crate) points: Vec<[f64; 3]>,
}

fn features(text: &str) -> Vec<Feature> {
    let value: Value = serde_json::from_str(text).unwrap();
    let feature = |f: &Value| {
        let geometry = &f["geometry"];
        assert_eq!(geometry["type"], "LineString");
        Feature {
            kind: f["properties"]["kind"].as_str().unwrap().to_owned(),
            points: serde_json::from_value(geometry["coordinates"].clone()).unwrap(),
        }
    };
    value["features"].as_array().unwrap().iter().map(feature).collect()
}
