//! GeoJSON: lines and polygons of a geometry, a feature or a collection.

mod diagnose;

use super::{CoordinateKind, RawLine, RawShape, RawVertex, ReadError, Source};
use crate::model::{Defects, Note};
use ::geojson::{Feature, FeatureCollection, Geometry, GeometryValue, JsonObject, JsonValue, Position};
use serde::Deserialize;
use std::borrow::Cow;

/// Types a document may have at its root.
const TYPES: &str = "FeatureCollection, Feature, LineString, MultiLineString, Polygon, MultiPolygon, GeometryCollection";

/// The `type` at the root, which decides what is parsed: trying one after the other gives misleading messages.
#[derive(Deserialize)]
struct Root<'a> {
    #[serde(rename = "type", borrow)]
    kind: Option<Cow<'a, str>>,
}

/// The lines of a GeoJSON text.
pub(super) fn lines(text: &str, source: &mut Source, notes: &mut Vec<Note>) -> Result<Vec<RawLine>, ReadError> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let kind = root_type(text, &source.label)?;
    let malformed = |error: ::geojson::Error| diagnose::explain(text, &source.label, &error);
    let (features, foreign) = match kind.as_str() {
        "FeatureCollection" => {
            let FeatureCollection { features, foreign_members, .. } = parse(text).map_err(malformed)?;
            (features, foreign_members)
        }
        "Feature" => {
            let feature: Feature = parse(text).map_err(malformed)?;
            let foreign = feature.foreign_members.clone();
            (vec![feature], foreign)
        }
        "Point" | "MultiPoint" | "LineString" | "MultiLineString" | "Polygon" | "MultiPolygon" | "GeometryCollection" => {
            let geometry: Geometry = parse(text).map_err(malformed)?;
            read_crs(geometry.foreign_members.as_ref(), source);
            let mut collector = Collector::new(&source.label);
            collector.geometry(&geometry, None, None);
            return collector.finish(notes);
        }
        other => {
            let help = "give GeoJSON; TopoJSON and Esri JSON can be converted with `ogr2ogr -f GeoJSON out.geojson in.json`";
            let figures = format!("type `{}`; known: {TYPES}", other.chars().take(40).collect::<String>());
            return Err(content("the document is not GeoJSON", source.label.clone(), figures, help));
        }
    };
    read_crs(foreign.as_ref(), source);
    let json_fg = foreign.as_ref().is_some_and(|f| f.contains_key("coordRefSys"));
    let mut collector = Collector::new(&source.label);
    for (i, feature) in features.iter().enumerate() {
        collector.feature(feature, u32::try_from(i + 1).unwrap_or(u32::MAX), json_fg);
    }
    collector.finish(notes)
}

fn parse<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, ::geojson::Error> {
    serde_json::from_str(text).map_err(::geojson::Error::MalformedGeoJson)
}

fn root_type(text: &str, label: &str) -> Result<String, ReadError> {
    if text.trim().is_empty() {
        return Err(content("the file is empty", label.to_owned(), "no JSON in it".into(), "give a GeoJSON document"));
    }
    match serde_json::from_str::<Root<'_>>(text) {
        Ok(Root { kind: Some(kind) }) => Ok(kind.into_owned()),
        Ok(Root { kind: None }) => {
            let help = "give GeoJSON; Esri JSON can be converted with `ogr2ogr -f GeoJSON out.geojson in.json`";
            Err(content("the document is not GeoJSON", label.to_owned(), "it has no member `type`".into(), help))
        }
        Err(error) if error.is_data() => {
            let at = place(label, &error);
            let figures = "the root must be an object with a text member `type`".into();
            Err(content("the document is not GeoJSON", at, figures, &format!("give one of: {TYPES}")))
        }
        Err(error) => Err(syntax(label, &error)),
    }
}

/// `path:line:column`, or the path alone where the place is not known.
fn place(label: &str, error: &serde_json::Error) -> String {
    if error.line() == 0 { label.to_owned() } else { format!("{label}:{}:{}", error.line(), error.column()) }
}

fn syntax(label: &str, error: &serde_json::Error) -> ReadError {
    let text = error.to_string();
    let figures = text.split(" at line ").next().unwrap_or("").to_owned();
    let (what, help) = if error.is_eof() {
        ("the JSON ends too early", "the file is cut off: write or copy it again")
    } else {
        ("the file is not valid JSON", "correct the place; NaN, Infinity and comments are not JSON")
    };
    content(what, place(label, error), figures, help)
}

fn content(what: &str, at: String, figures: String, help: &str) -> ReadError {
    ReadError::Content { what: what.into(), at, figures, help: help.into() }
}

/// Name of the reference system: the old `crs` member or the JSON-FG `coordRefSys`.
fn read_crs(foreign: Option<&JsonObject>, source: &mut Source) {
    let Some(foreign) = foreign else { return };
    let text = |value: &JsonValue| match value {
        JsonValue::String(text) => Some(text.clone()),
        JsonValue::Null => None,
        other => Some(other.to_string()),
    };
    let old = foreign.get("crs").and_then(|crs| {
        let properties = crs.get("properties");
        properties.and_then(|p| p.get("name").or_else(|| p.get("href")).or_else(|| p.get("code"))).and_then(text)
    });
    source.crs = foreign.get("coordRefSys").and_then(text).or(old);
    source.kind = match &source.crs {
        None => CoordinateKind::Unknown,
        Some(name) if is_geographic(name) => CoordinateKind::Degrees,
        Some(_) => CoordinateKind::Lengths,
    };
}

/// Whether a reference system is known to count in degrees: CRS84 and its kin, and the EPSG codes from 4001 to 4999 and of
/// newer geographic systems, which hold geographic systems (and a few geocentric ones, no plan coordinates either).
fn is_geographic(name: &str) -> bool {
    const NEWER: [u32; 12] = [6318, 6319, 6322, 6325, 6783, 7843, 7844, 8237, 8246, 8860, 9000, 10414];
    const SHORTEST_CODE: usize = 4;
    let upper = name.to_ascii_uppercase();
    if ["CRS84", "CRS83", "CRS27"].iter().any(|known| upper.contains(known)) || upper.starts_with("GCS_") {
        return true;
    }
    if ["WGS84", "WGS 84", "WGS1984"].contains(&upper.trim()) {
        return true;
    }
    // The first code: a second one is the vertical part. Shorter numbers are versions.
    let code = upper.split(|c: char| !c.is_ascii_digit()).find(|digits| digits.len() >= SHORTEST_CODE);
    let code = code.and_then(|digits| digits.parse::<u32>().ok());
    upper.contains("EPSG") && code.is_some_and(|code| (4001..=4999).contains(&code) || NEWER.contains(&code))
}

/// Turns geometries into raw lines, counting what it passes over.
struct Collector<'a> {
    label: &'a str,
    lines: Vec<RawLine>,
    polygons: u32,
    features: usize,
    without_geometry: usize,
    points: usize,
    defects: Defects,
}

impl<'a> Collector<'a> {
    fn new(label: &'a str) -> Self {
        Self { label, lines: Vec::new(), polygons: 0, features: 0, without_geometry: 0, points: 0, defects: Defects::default() }
    }

    fn feature(&mut self, feature: &Feature, number: u32, json_fg: bool) {
        self.features += 1;
        let name = name(feature);
        // JSON-FG: `place` holds the geometry in `coordRefSys`, `geometry` at most a copy in degrees.
        let place = feature.foreign_members.as_ref().filter(|_| json_fg).and_then(|members| members.get("place"));
        let place = place.and_then(|value| serde_json::from_value::<Geometry>(value.clone()).ok());
        match place.as_ref().or(feature.geometry.as_ref()) {
            Some(geometry) => self.geometry(geometry, Some(number), name.as_deref()),
            None => self.without_geometry += 1,
        }
    }

    fn geometry(&mut self, geometry: &Geometry, feature: Option<u32>, name: Option<&str>) {
        match &geometry.value {
            GeometryValue::Point { .. } => self.points += 1,
            GeometryValue::MultiPoint { coordinates } => self.points += coordinates.len(),
            GeometryValue::LineString { coordinates } => self.line(coordinates, feature, name, RawShape::Line),
            GeometryValue::MultiLineString { coordinates } => {
                for line in coordinates {
                    self.line(line, feature, name, RawShape::Line);
                }
            }
            GeometryValue::Polygon { coordinates } => self.polygon(coordinates, feature, name),
            GeometryValue::MultiPolygon { coordinates } => {
                for polygon in coordinates {
                    self.polygon(polygon, feature, name);
                }
            }
            GeometryValue::GeometryCollection { geometries } => {
                for geometry in geometries {
                    self.geometry(geometry, feature, name);
                }
            }
        }
    }

    fn polygon(&mut self, rings: &[Vec<Position>], feature: Option<u32>, name: Option<&str>) {
        for (i, ring) in rings.iter().enumerate() {
            self.line(ring, feature, name, RawShape::Ring { polygon: self.polygons, hole: i > 0 });
        }
        self.polygons += u32::from(!rings.is_empty());
    }

    fn line(&mut self, positions: &[Position], feature: Option<u32>, name: Option<&str>, shape: RawShape) {
        let mut vertices = Vec::with_capacity(positions.len());
        for (i, position) in positions.iter().enumerate() {
            match *position.as_slice() {
                [x, y, ref rest @ ..] => vertices.push(RawVertex { x, y, z: rest.first().copied(), row: None }),
                ref short => {
                    let at = diagnose::at(self.label, feature, i + 1);
                    let count = short.len();
                    self.defects.push("short-position", || diagnose::short_position(at, count));
                }
            }
        }
        self.lines.push(RawLine { name: name.map(str::to_owned), feature, shape, vertices });
    }

    fn finish(self, notes: &mut Vec<Note>) -> Result<Vec<RawLine>, ReadError> {
        self.defects.into_result().map_err(ReadError::Records)?;
        if self.lines.is_empty() {
            let (what, figures) = if self.points > 0 {
                ("the file holds points, but no line", format!("{} points, 0 lines, 0 polygons", self.points))
            } else {
                (
                    "the file holds no line",
                    format!("{} features, {} of them without geometry", self.features, self.without_geometry),
                )
            };
            let help = "give a LineString or Polygon; points can be joined to a line in CSV, one row per vertex";
            return Err(content(what, self.label.to_owned(), figures, help));
        }
        if self.without_geometry > 0 {
            let message = format!("features without geometry passed over: {}", self.without_geometry);
            notes.push(Note::new("null-geometry", message));
        }
        if self.points > 0 {
            notes.push(Note::new("points-ignored", format!("points passed over: {} (only lines are used)", self.points)));
        }
        Ok(self.lines)
    }
}

/// Name of a feature for messages: the property `name`, else its id.
fn name(feature: &Feature) -> Option<String> {
    let text = |value: &JsonValue| match value {
        JsonValue::String(text) if !text.trim().is_empty() => Some(text.trim().to_owned()),
        JsonValue::Number(number) => Some(number.to_string()),
        _ => None,
    };
    let property = |key: &str| feature.properties.as_ref().and_then(|p| p.get(key)).and_then(text);
    let id = || match &feature.id {
        Some(::geojson::feature::Id::String(id)) => Some(id.clone()),
        Some(::geojson::feature::Id::Number(id)) => Some(id.to_string()),
        None => None,
    };
    property("name").or_else(|| property("Name")).or_else(id).or_else(|| property("id"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn reference_systems_in_degrees() {
        for name in [
            "urn:ogc:def:crs:OGC:1.3:CRS84",
            "urn:ogc:def:crs:EPSG::4326",
            "urn:ogc:def:crs:EPSG:9.8.15:4258",
            "EPSG:4326",
            "EPSG:4326+5773",
            "[OGC:CRS84]",
            "http://www.opengis.net/def/crs/EPSG/0/7844",
            "WGS 84",
        ] {
            assert!(is_geographic(name), "{name}");
        }
        for name in ["urn:ogc:def:crs:EPSG::25832", "EPSG:2193+4440", "WGS 84 / UTM zone 32N", "EPSG:31467", "local", ""] {
            assert!(!is_geographic(name), "{name}");
        }
    }
}
