//! What `slopegen info` has to tell.

use super::common::{Tool, Warning};
use crate::model::message::printable;
use schemars::JsonSchema;
use serde::Serialize;
use std::fmt::Write as _;

/// Version of the keys.
pub const INFO_SCHEMA: &str = "slopegen-info/1";

/// Things of one kind that the text shows; the JSON report has all.
const SHOWN: usize = 40;

/// Width of names before what they name.
const NAME: usize = 20;

/// What a file holds, and what is wrong with it.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct InfoReport {
    /// Name and version of this schema.
    #[schemars(extend("const" = INFO_SCHEMA))]
    pub schema: &'static str,
    /// The program.
    pub tool: Tool,
    /// The file.
    pub file: FileFigures,
    /// Unit of length it declares: `m`, `ft`, `us-ft`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub unit: Option<String>,
    /// Its coordinate reference system, as it says.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crs: Option<String>,
    /// The smallest box around its coordinates.
    #[serde(rename = "box", skip_serializing_if = "Option::is_none")]
    pub bounds: Option<BoxFigures>,
    /// Its lines.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub lines: Vec<LineRow>,
    /// Its surfaces, points and grids.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub surfaces: Vec<SurfaceRow>,
    /// The options of a job file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub settings: Vec<Setting>,
    /// What a report of this program says of itself.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub report: Vec<Setting>,
    /// What the file can be used for, and what stands against it.
    pub uses: Vec<UseRow>,
}

/// A file.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FileFigures {
    /// Path as given.
    pub path: String,
    /// Its format.
    pub format: String,
    /// Its length.
    pub bytes: u64,
    /// SHA-256 in lower-case hexadecimal digits, if it could be read.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub sha256: Option<String>,
}

/// A box.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BoxFigures {
    /// Least easting, northing, elevation.
    pub min: [f64; 3],
    /// Greatest.
    pub max: [f64; 3],
}

/// A line as given.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LineRow {
    /// Its name, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// `line`, `ring`, `hole`, `breakline`.
    pub kind: &'static str,
    /// Its vertices.
    pub vertices: usize,
    /// How many of them have no elevation.
    pub without_elevation: usize,
    /// Length in plan.
    pub length: f64,
    /// Whether it ends where it begins.
    pub closed: bool,
    /// Lowest elevation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_min: Option<f64>,
    /// Highest elevation.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z_max: Option<f64>,
}

/// A surface, points or a grid.
#[derive(Clone, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct SurfaceRow {
    /// Its name, if it has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// `mesh`, `points`, `grid`.
    pub kind: &'static str,
    /// Vertices, points, or nodes with a height.
    pub vertices: usize,
    /// Faces as given, of a mesh.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<usize>,
    /// Groups, parts or layers of a mesh, each with the number of its faces.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub parts: Vec<PartRow>,
    /// Nodes from west to east, of a grid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub columns: Option<usize>,
    /// Nodes from north to south, of a grid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rows: Option<usize>,
    /// Distance of the nodes to the east and to the north.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<[f64; 2]>,
    /// Triangles as used.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub triangles: Option<usize>,
    /// Area of the triangles in plan.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub plan_area: Option<f64>,
    /// Area of the triangles as they lie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub surface_area: Option<f64>,
}

/// A group, part or layer of a mesh.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PartRow {
    /// Its name.
    pub name: String,
    /// Its faces.
    pub faces: usize,
}

/// A word or figure with its name.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct Setting {
    /// Its name.
    pub key: String,
    /// Its values.
    pub values: Vec<String>,
}

/// A use of the file: `line`, `ground`, `job`, `report`.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct UseRow {
    /// What for.
    #[serde(rename = "use")]
    pub purpose: &'static str,
    /// The surface it is about, where a file has several.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Whether there is nothing against it.
    pub sound: bool,
    /// Whether it could be read as such.
    pub readable: bool,
    /// What stands against it, each with place, figures and cure.
    pub defects: Vec<String>,
    /// What would be said on the way.
    pub notes: Vec<Warning>,
}

impl InfoReport {
    /// Whether the file can be used for something.
    pub fn is_readable(&self) -> bool {
        self.uses.iter().any(|row| row.readable)
    }

    /// Whether it is sound for everything it can be read as. Text is one of them, line or points: what it is sound as.
    pub fn is_sound(&self) -> bool {
        let mut readable = self.uses.iter().filter(|row| row.readable);
        let sound = if self.file.format == "csv" { readable.any(|row| row.sound) } else { readable.all(|row| row.sound) };
        sound && self.is_readable()
    }
}

/// The report as plain text.
pub fn render_info(report: &InfoReport) -> String {
    let mut text = format!("{} {}: what a file holds\n\nFile\n", report.tool.name, report.tool.version);
    // Writing to a String cannot fail.
    let mut words = |name: &str, words: &str| {
        let _ = writeln!(text, "  {name:NAME$}{}", printable(words));
    };
    words("path", &report.file.path);
    words("format", &report.file.format);
    words("size", &format!("{} bytes", report.file.bytes));
    if let Some(sha256) = &report.file.sha256 {
        words("sha256", sha256);
    }
    let has_coordinates = report.bounds.is_some();
    if has_coordinates || report.unit.is_some() {
        words("unit of length", report.unit.as_deref().unwrap_or("not declared"));
        words("coordinate system", report.crs.as_deref().unwrap_or("not declared"));
    }
    if let Some(BoxFigures { min, max }) = report.bounds {
        text.push_str("\nBox\n");
        for (name, i) in [("easting", 0), ("northing", 1), ("elevation", 2)] {
            let _ = writeln!(text, "  {name:NAME$}{:.3} to {:.3}", min[i], max[i]);
        }
    }
    lines(&mut text, &report.lines);
    surfaces(&mut text, &report.surfaces);
    for (title, settings) in [("Options", &report.settings), ("Report", &report.report)] {
        if !settings.is_empty() {
            let _ = writeln!(text, "\n{title}");
        }
        for setting in settings {
            let _ = writeln!(text, "  {}{}", column(&printable(&setting.key)), printable(&setting.values.join(", ")));
        }
    }
    for row in &report.uses {
        let verdict = match (row.readable, row.defects.len()) {
            (false, _) => "cannot be read".to_owned(),
            (true, 0) => "nothing against it".to_owned(),
            (true, _) => "defects".to_owned(),
        };
        let name = row.name.as_deref().map_or_else(String::new, |name| format!(" `{}`", printable(name)));
        let _ = writeln!(text, "\nAs {}{name}: {verdict}", row.purpose);
        for defect in &row.defects {
            let shown: Vec<String> = defect.lines().map(printable).collect();
            let _ = writeln!(text, "  {}", shown.join("\n  "));
        }
        for note in &row.notes {
            let _ = writeln!(text, "  {}: {}", note.code, printable(&note.message));
        }
    }
    text
}

/// A name as wide as its column; two blanks follow one that is wider.
fn column(name: &str) -> String {
    if name.chars().count() < NAME { format!("{name:NAME$}") } else { format!("{name}  ") }
}

fn lines(text: &mut String, lines: &[LineRow]) {
    if lines.is_empty() {
        return;
    }
    let total: usize = lines.iter().map(|line| line.vertices).sum();
    let _ = writeln!(text, "\nLines ({}, {total} vertices)", lines.len());
    for line in lines.iter().take(SHOWN) {
        let name = column(&line.name.as_deref().map_or_else(|| "(no name)".to_owned(), printable));
        let closed = if line.closed && line.kind == "line" { ", closed" } else { "" };
        let missing =
            if line.without_elevation > 0 { format!(", {} without elevation", line.without_elevation) } else { String::new() };
        let z = line.z_min.zip(line.z_max).map_or_else(String::new, |(lo, hi)| format!(", elevations {lo:.3} to {hi:.3}"));
        let _ =
            writeln!(text, "  {name}{}{closed}, {} vertices{missing}, length {:.3}{z}", line.kind, line.vertices, line.length);
    }
    if lines.len() > SHOWN {
        let _ = writeln!(text, "  and {} more", lines.len() - SHOWN);
    }
}

fn surfaces(text: &mut String, surfaces: &[SurfaceRow]) {
    if surfaces.is_empty() {
        return;
    }
    text.push_str("\nSurfaces\n");
    for row in surfaces.iter().take(SHOWN) {
        let name = column(&row.name.as_deref().map_or_else(|| "(no name)".to_owned(), printable));
        let mut said = vec![row.kind.to_owned(), format!("{} vertices", row.vertices)];
        said.extend(row.faces.map(|faces| format!("{faces} faces")));
        said.extend(row.columns.zip(row.rows).map(|(columns, rows)| format!("{columns} columns, {rows} rows")));
        said.extend(row.step.map(|[x, y]| if x == y { format!("step {x}") } else { format!("step {x}, {y}") }));
        said.extend(row.triangles.map(|triangles| format!("{triangles} triangles")));
        let _ = writeln!(text, "  {name}{}", said.join(", "));
        for part in row.parts.iter().take(SHOWN) {
            let name = column(&format!("  {}", printable(&part.name)));
            let _ = writeln!(text, "  {name}{} faces", part.faces);
        }
        if let Some((plan, surface)) = row.plan_area.zip(row.surface_area) {
            let _ = writeln!(text, "  {:NAME$}{plan:.3} in plan, {surface:.3} as it lies", "  area");
        }
    }
    if surfaces.len() > SHOWN {
        let _ = writeln!(text, "  and {} more", surfaces.len() - SHOWN);
    }
}
