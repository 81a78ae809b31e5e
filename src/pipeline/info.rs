//! What a file holds, and what a build would say of it.

use super::watch::{CHECKING, Observer, PREPARING, READING};
use super::{Error, room};
use crate::mesh::volume::MeshAreas;
use crate::model::{Defects, LengthUnit, Note};
use crate::read::terrain::{RawTerrain, TerrainOptions, read_terrain};
use crate::read::{Document, Held, Inventory, Pick, RawInput, RawShape, ReadError, ReadOptions, inventory, read_document};
use crate::report::info::{BoxFigures, FileFigures, INFO_SCHEMA, InfoReport, LineRow, PartRow, Setting, SurfaceRow, UseRow};
use crate::report::{Tool, Warning};
use crate::{terrain, validate};
use serde_json::Value;
use std::path::Path;

/// Looks at a file: a line, ground, or a report of this program.
///
/// # Errors
/// [`Error::Read`] if the file cannot be opened or can be read as nothing. Defects of what can be read stand in the answer.
pub fn info(path: &Path, options: &ReadOptions, observer: &dyn Observer) -> Result<InfoReport, Error> {
    observer.stage(READING);
    if let Some(document) = read_document(path)? {
        return Ok(of_document(path, &document));
    }
    let options = &ReadOptions { memory: observer.memory(), ..options.clone() };
    let found = inventory(path, options)?;
    let source = found.source().cloned();
    let mut report = InfoReport {
        file: FileFigures {
            path: path.display().to_string(),
            format: found.format.to_string(),
            bytes: found.bytes,
            sha256: source.as_ref().map(|source| source.sha256.clone()),
        },
        unit: source.as_ref().and_then(|source| source.unit).map(|unit: LengthUnit| unit.label().to_owned()),
        crs: source.and_then(|source| source.crs),
        bounds: found.bounds.map(|[lo, hi]| BoxFigures { min: lo.to_array(), max: hi.to_array() }),
        ..empty(path)
    };
    found.held.iter().for_each(|held| hold(held, &mut report));
    let Inventory { line, ground, .. } = found;
    if let Some(Ok(ground)) = &ground {
        let points = line.iter().flatten().flat_map(|raw| &raw.lines).map(|line| line.vertices.len()).sum();
        room::for_inspecting(&ground.ground, points, &ground.source.label, &observer.memory())?;
    }
    let mut unread: Vec<ReadError> = Vec::new();
    if let Some(line) = line {
        observer.stage(CHECKING);
        let row = match line {
            Ok(raw) => as_line(&raw),
            Err(error) => not_read("line", error, &mut unread),
        };
        report.uses.push(row);
    }
    if let Some(ground) = ground {
        observer.stage(PREPARING);
        let name = options.pick.surface.clone();
        let several: Vec<String> = match (&ground, &name) {
            (Err(_), None) => report.surfaces.iter().filter(|row| row.vertices > 0).filter_map(|row| row.name.clone()).collect(),
            _ => Vec::new(),
        };
        if several.len() < 2 {
            let row = match ground {
                Ok(raw) => as_ground(raw, name, &mut report),
                Err(error) => not_read("ground", error, &mut unread),
            };
            report.uses.push(row);
        }
        // Each of several surfaces may be ground.
        for name in several.into_iter().take(MOST_SURFACES) {
            let pick = Pick { surface: Some(name.clone()), ..options.pick.clone() };
            let known = TerrainOptions {
                format: None,
                csv_order: options.csv_order.clone(),
                pick,
                unit: options.unit,
                memory: options.memory,
            };
            let row = match read_terrain(path, &known) {
                Ok(raw) => as_ground(raw, Some(name), &mut report),
                Err(error) => UseRow { name: Some(name), ..not_read("ground", error, &mut unread) },
            };
            report.uses.push(row);
        }
    }
    match unread.into_iter().next() {
        Some(error) if !report.is_readable() => Err(error.into()),
        _ => Ok(report),
    }
}

/// Surfaces of one file that are looked at as ground: each takes as long as the whole file.
const MOST_SURFACES: usize = 20;

/// A report about nothing yet.
fn empty(path: &Path) -> InfoReport {
    let file = FileFigures { path: path.display().to_string(), format: String::new(), bytes: 0, sha256: None };
    InfoReport {
        schema: INFO_SCHEMA,
        tool: Tool::default(),
        file,
        unit: None,
        crs: None,
        bounds: None,
        lines: Vec::new(),
        surfaces: Vec::new(),
        settings: Vec::new(),
        report: Vec::new(),
        uses: Vec::new(),
    }
}

fn hold(held: &Held, report: &mut InfoReport) {
    match held {
        Held::Line { name, shape, vertices, without_elevation, length, closed, z } => report.lines.push(LineRow {
            name: name.clone(),
            kind: match shape {
                RawShape::Line => "line",
                RawShape::Ring { hole: false, .. } => "ring",
                RawShape::Ring { hole: true, .. } => "hole",
                RawShape::Breakline => "breakline",
            },
            vertices: *vertices,
            without_elevation: *without_elevation,
            length: *length,
            closed: *closed,
            z_min: z.map(|[lo, _]| lo),
            z_max: z.map(|[_, hi]| hi),
        }),
        Held::Surface { name, vertices, faces, parts } => report.surfaces.push(SurfaceRow {
            name: name.clone(),
            kind: "mesh",
            vertices: *vertices,
            faces: Some(*faces),
            parts: parts.iter().map(|(name, faces)| PartRow { name: name.clone(), faces: *faces }).collect(),
            ..SurfaceRow::default()
        }),
        Held::Points { name, count } => {
            report.surfaces.push(SurfaceRow { name: name.clone(), kind: "points", vertices: *count, ..SurfaceRow::default() });
        }
        Held::Grid { columns, rows, step, missing } => report.surfaces.push(SurfaceRow {
            kind: "grid",
            vertices: columns.saturating_mul(*rows).saturating_sub(*missing),
            columns: Some(*columns),
            rows: Some(*rows),
            step: Some(*step),
            ..SurfaceRow::default()
        }),
    }
}

fn not_read(purpose: &'static str, error: ReadError, unread: &mut Vec<ReadError>) -> UseRow {
    let row = UseRow { purpose, name: None, sound: false, readable: false, defects: vec![error.to_string()], notes: Vec::new() };
    unread.push(error);
    row
}

fn row(purpose: &'static str, defects: &[Defects], notes: &[Note]) -> UseRow {
    let defects: Vec<String> = defects.iter().filter(|defects| !defects.is_empty()).map(ToString::to_string).collect();
    // Each begins a message of its own, as on standard error.
    let defects: Vec<String> = defects.iter().flat_map(|text| text.split("\nerror: ").map(str::to_owned)).collect();
    UseRow { purpose, name: None, sound: defects.is_empty(), readable: true, defects, notes: Warning::all(notes) }
}

fn as_line(raw: &RawInput) -> UseRow {
    let mut notes = raw.notes.clone();
    let mut defects = Vec::new();
    match validate::check(raw, &validate::Options::default()) {
        Ok(checked) => notes.extend(checked.notes),
        Err(found) => defects.push(found),
    }
    row("line", &defects, &notes)
}

fn as_ground(raw: RawTerrain, name: Option<String>, report: &mut InfoReport) -> UseRow {
    let label = raw.source.label.clone();
    let mut notes = raw.notes.clone();
    let mut defects = Vec::new();
    match terrain::prepare(raw) {
        Ok(prepared) => {
            let looked = terrain::inspect(&label, &prepared.terrain);
            notes = prepared.notes;
            notes.extend(looked.notes);
            defects.push(looked.defects);
            let is_it = |row: &&mut SurfaceRow| row.vertices > 0 && (name.is_none() || row.name == name);
            if let Some(row) = report.surfaces.iter_mut().rfind(is_it) {
                let ground = &prepared.terrain;
                let areas = MeshAreas::of((0..ground.triangles.len()).map(|t| ground.corners(t)));
                row.triangles = Some(ground.triangles.len());
                (row.plan_area, row.surface_area) = (Some(areas.plan()), Some(areas.surface()));
            }
        }
        Err(found) => defects.push(found),
    }
    UseRow { name, ..row("ground", &defects, &notes) }
}

/// What a report of this program says of itself.
fn of_document(path: &Path, document: &Document) -> InfoReport {
    let mut said = Vec::new();
    let mut say = |key: &str, values: Vec<String>| {
        if !values.is_empty() {
            said.push(Setting { key: key.to_owned(), values });
        }
    };
    let text = |value: &Value| match value {
        Value::String(text) => text.clone(),
        other => other.to_string(),
    };
    let value = &document.value;
    say("made by", ["name", "version"].iter().filter_map(|key| value["tool"].get(key)).map(text).collect());
    let list = |key: &str| value[key].as_array().cloned().unwrap_or_default();
    for input in list("inputs") {
        let role = input["role"].as_str().unwrap_or("input").to_owned();
        say(&role, ["path", "format", "sha256"].iter().filter_map(|key| input.get(key)).map(text).collect());
    }
    for (section, keys) in
        [("volumes", &["cut", "fill", "net", "balance"][..]), ("verdict", &["passed"]), ("depths", &["cut_max", "fill_max"])]
    {
        for key in keys {
            say(&format!("{section}.{key}"), value[section].get(key).map(text).into_iter().collect());
        }
    }
    say("stations", value["stations"].as_array().map(|rows| rows.len().to_string()).into_iter().collect());
    say("jobs", value["jobs"].as_array().map(|rows| rows.len().to_string()).into_iter().collect());
    let codes = list("warnings").iter().filter_map(|warning| warning.get("code")).map(text).collect();
    say("warnings", codes);
    let unit = value["units"]["length"].as_str().map(str::to_owned);
    InfoReport {
        file: FileFigures {
            path: document.label.clone(),
            format: document.schema.clone(),
            bytes: document.bytes,
            sha256: Some(document.sha256.clone()),
        },
        unit,
        report: said,
        uses: vec![row("report", &[], &[])],
        ..empty(path)
    }
}

/// A job file as its reader tells of it; `defects`: what is wrong with it.
pub fn job_info(path: &Path, bytes: &[u8], settings: Vec<Setting>, defects: Vec<String>) -> InfoReport {
    let (sha256, sound) = (crate::kernel::hash::sha256(bytes), defects.is_empty());
    let path_given = path.display().to_string();
    let file = FileFigures { path: path_given, format: "job".to_owned(), bytes: bytes.len() as u64, sha256: Some(sha256) };
    let uses = vec![UseRow { purpose: "job", name: None, sound, readable: true, defects, notes: Vec::new() }];
    InfoReport { file, settings, uses, ..empty(path) }
}
