//! What is wrong with a GeoJSON document the parser refused: looked up in a second, slower pass over plain JSON, so that
//! the message can name features and vertices, and all of them at once.

use super::{ReadError, place, refuse, syntax};
use crate::model::{Defect, Defects};
use serde_json::Value;

/// `path, feature 2, vertex 7`.
pub(super) fn at(label: &str, feature: Option<u32>, vertex: usize) -> String {
    match feature {
        Some(feature) => format!("{label}, feature {feature}, vertex {vertex}"),
        None => format!("{label}, vertex {vertex}"),
    }
}

pub(super) fn short_position(at: String, count: usize) -> Defect {
    Defect {
        code: "short-position",
        what: "a position has too few numbers".into(),
        at,
        figures: Some(format!("{count} of 3: x, y, z")),
        help: "write every position as [x, y, z]".into(),
    }
}

/// Explains a refusal.
pub(super) fn explain(text: &str, label: &str, error: &geojson::Error) -> ReadError {
    let root: Value = match serde_json::from_str(text) {
        Ok(root) => root,
        Err(error) => return syntax(label, &error),
    };
    let mut defects = Defects::default();
    match root.get("features") {
        Some(Value::Array(features)) => {
            for (i, feature) in features.iter().enumerate() {
                let number = u32::try_from(i + 1).unwrap_or(u32::MAX);
                geometry(feature.get("geometry").unwrap_or(&Value::Null), label, Some(number), &mut defects);
            }
        }
        _ => match root.get("geometry") {
            Some(value) => geometry(value, label, Some(1), &mut defects),
            None => geometry(&root, label, None, &mut defects),
        },
    }
    if !defects.is_empty() {
        return ReadError::Records(defects);
    }
    let (at, figures) = match error {
        geojson::Error::MalformedGeoJson(cause) => (place(label, cause), cause.to_string()),
        other => (label.to_owned(), other.to_string()),
    };
    let figures = figures.split(" at line ").next().unwrap_or("").to_owned();
    refuse("the document is not valid GeoJSON", at, figures, "correct the place, or write the file again with `ogr2ogr`")
}

fn geometry(value: &Value, label: &str, feature: Option<u32>, defects: &mut Defects) {
    if let Some(Value::Array(parts)) = value.get("geometries") {
        // Nesting is bounded: the JSON parser refuses documents deeper than 128 levels.
        parts.iter().for_each(|part| geometry(part, label, feature, defects));
        return;
    }
    let depth = match value.get("type").and_then(Value::as_str) {
        Some("LineString" | "MultiPoint") => 1,
        Some("MultiLineString" | "Polygon") => 2,
        Some("MultiPolygon") => 3,
        _ => return,
    };
    if let Some(coordinates) = value.get("coordinates") {
        arrays(coordinates, depth, label, feature, defects);
    }
}

fn arrays(value: &Value, depth: usize, label: &str, feature: Option<u32>, defects: &mut Defects) {
    let Value::Array(items) = value else { return };
    for (i, item) in items.iter().enumerate() {
        if depth > 1 {
            arrays(item, depth - 1, label, feature, defects);
        } else {
            position(item, &at(label, feature, i + 1), defects);
        }
    }
}

fn position(value: &Value, at: &str, defects: &mut Defects) {
    let Value::Array(ordinates) = value else {
        defects.push("not-a-position", || Defect {
            code: "not-a-position",
            what: "a position is not an array of numbers".into(),
            at: at.to_owned(),
            figures: Some(show(value)),
            help: "write every position as [x, y, z]".into(),
        });
        return;
    };
    if ordinates.len() < 2 {
        defects.push("short-position", || short_position(at.to_owned(), ordinates.len()));
        return;
    }
    for (ordinate, name) in ordinates.iter().zip(["x", "y", "z"]) {
        let (code, what, help) = match ordinate {
            Value::Number(_) => continue,
            Value::Null => ("null-ordinate", "is null", "give the missing number, or take the vertex out"),
            Value::String(_) => ("text-ordinate", "is a text, not a number", "write numbers without quotes"),
            _ => ("not-a-number", "is not a number", "write every position as [x, y, z]"),
        };
        defects.push(code, || Defect {
            code,
            what: format!("{name} {what}"),
            at: at.to_owned(),
            figures: Some(show(value)),
            help: help.into(),
        });
        // One defect per vertex is enough.
        return;
    }
}

fn show(value: &Value) -> String {
    const LONGEST: usize = 60;
    let text = value.to_string();
    match text.char_indices().nth(LONGEST) {
        Some((at, _)) => format!("{}…", &text[..at]),
        None => text,
    }
}
