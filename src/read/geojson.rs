//! GeoJSON: lines and polygons of a geometry, a feature or a collection.

mod crs;
mod diagnose;

pub(in crate::read) use crs::kind_of;

use super::error::refuse;
use super::{CoordinateKind, RawLine, RawShape, RawVertex, ReadError, Source};
use crate::model::{Defect, Defects, Note};
use ::geojson::{Feature, FeatureCollection, Geometry, GeometryValue, JsonValue, Position};
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
            crs::read(geometry.foreign_members.as_ref(), source);
            let mut collector = Collector::new(&source.label);
            collector.geometry(&geometry, None, None);
            return collector.finish(notes);
        }
        other => {
            let help = "give GeoJSON; TopoJSON and Esri JSON can be converted with `ogr2ogr -f GeoJSON out.geojson in.json`";
            let figures = format!("type `{}`; known: {TYPES}", other.chars().take(40).collect::<String>());
            return Err(refuse("the document is not GeoJSON", source.label.clone(), figures, help));
        }
    };
    crs::read(foreign.as_ref(), source);
    let json_fg = foreign.as_ref().is_some_and(|f| f.contains_key("coordRefSys"));
    let mut collector = Collector::new(&source.label);
    for (i, feature) in features.iter().enumerate() {
        collector.feature(feature, u32::try_from(i + 1).unwrap_or(u32::MAX), json_fg);
    }
    let beside_place = collector.beside_place;
    let lines = collector.finish(notes)?;
    if beside_place {
        // `geometry` should then be in degrees, whatever `coordRefSys` says: the figures must decide.
        source.kind = CoordinateKind::Unknown;
    }
    Ok(lines)
}

fn parse<T: serde::de::DeserializeOwned>(text: &str) -> Result<T, ::geojson::Error> {
    serde_json::from_str(text).map_err(::geojson::Error::MalformedGeoJson)
}

fn root_type(text: &str, label: &str) -> Result<String, ReadError> {
    if text.trim().is_empty() {
        return Err(refuse("the file is empty", label.to_owned(), "no JSON in it", "give a GeoJSON document"));
    }
    match serde_json::from_str::<Root<'_>>(text) {
        Ok(Root { kind: Some(kind) }) => Ok(kind.into_owned()),
        Ok(Root { kind: None }) => {
            let help = "give GeoJSON; Esri JSON can be converted with `ogr2ogr -f GeoJSON out.geojson in.json`";
            Err(refuse("the document is not GeoJSON", label.to_owned(), "it has no member `type`", help))
        }
        Err(error) if error.is_data() => {
            let at = place(label, &error);
            let figures = "the root must be an object with a text member `type`";
            Err(refuse("the document is not GeoJSON", at, figures, &format!("give one of: {TYPES}")))
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
    refuse(what, place(label, error), figures, help)
}

/// Turns geometries into raw lines, counting what it passes over.
struct Collector<'a> {
    label: &'a str,
    lines: Vec<RawLine>,
    polygons: u32,
    features: usize,
    empty: usize,
    points: usize,
    /// Whether the feature at hand calls itself a breakline.
    breakline: bool,
    /// Whether a JSON-FG document gave `geometry` instead of `place`.
    beside_place: bool,
    defects: Defects,
}

impl<'a> Collector<'a> {
    fn new(label: &'a str) -> Self {
        Self {
            label,
            lines: Vec::new(),
            polygons: 0,
            features: 0,
            empty: 0,
            points: 0,
            breakline: false,
            beside_place: false,
            defects: Defects::default(),
        }
    }

    fn feature(&mut self, feature: &Feature, number: u32, json_fg: bool) {
        self.features += 1;
        let name = name(feature);
        self.breakline = is_breakline(feature);
        // JSON-FG: `place` holds the geometry in `coordRefSys`, `geometry` at most a copy in degrees.
        let place = feature.foreign_members.as_ref().filter(|_| json_fg).and_then(|members| members.get("place"));
        if let Some(place) = place.filter(|place| !place.is_null()) {
            match serde_json::from_value::<Geometry>(place.clone()) {
                Ok(geometry) => self.geometry(&geometry, Some(number), name.as_deref()),
                Err(cause) => self.defects.push("place", || Defect {
                    code: "place",
                    what: "the member `place` is no geometry known here".into(),
                    at: format!("{}, feature {number}", self.label),
                    figures: Some(cause.to_string()),
                    help: "write it as LineString or Polygon with [x, y, z] positions".into(),
                }),
            }
            return;
        }
        match &feature.geometry {
            Some(geometry) => {
                self.beside_place = json_fg;
                self.geometry(geometry, Some(number), name.as_deref());
            }
            None => self.empty += 1,
        }
    }

    fn geometry(&mut self, geometry: &Geometry, feature: Option<u32>, name: Option<&str>) {
        match &geometry.value {
            GeometryValue::Point { coordinates } if self.breakline => {
                self.line(std::slice::from_ref(coordinates), feature, name, RawShape::Breakline);
            }
            GeometryValue::MultiPoint { coordinates } if self.breakline => {
                for point in coordinates {
                    self.line(std::slice::from_ref(point), feature, name, RawShape::Breakline);
                }
            }
            GeometryValue::Polygon { coordinates } if self.breakline => {
                for ring in coordinates {
                    self.line(ring, feature, name, RawShape::Breakline);
                }
            }
            GeometryValue::MultiPolygon { coordinates } if self.breakline => {
                for ring in coordinates.iter().flatten() {
                    self.line(ring, feature, name, RawShape::Breakline);
                }
            }
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
            let shape = RawShape::Ring { polygon: self.polygons, hole: i > 0 };
            if i == 0 && ring.is_empty() && rings.len() > 1 {
                // Holes without an outer ring: validation must see that it is missing.
                self.lines.push(RawLine { name: name.map(str::to_owned), feature, shape, vertices: Vec::new() });
            } else {
                self.line(ring, feature, name, shape);
            }
        }
        self.polygons += u32::from(!rings.is_empty());
    }

    fn line(&mut self, positions: &[Position], feature: Option<u32>, name: Option<&str>, shape: RawShape) {
        if positions.is_empty() {
            self.empty += 1;
            return;
        }
        let shape = if self.breakline { RawShape::Breakline } else { shape };
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
        if self.lines.iter().all(|line| line.shape == RawShape::Breakline) {
            if !self.lines.is_empty() {
                let figures = format!("breaklines and spot heights: {}, lines: 0, polygons: 0", self.lines.len());
                let help = "add the ring they lie in, or the centre line, without the property `role`";
                return Err(refuse("the file holds breaklines, but no line", self.label.to_owned(), figures, help));
            }
            let (what, figures) = if self.points > 0 {
                ("the file holds points, but no line", format!("points: {}, lines: 0, polygons: 0", self.points))
            } else {
                ("the file holds no line", format!("features: {}, empty geometries: {}", self.features, self.empty))
            };
            let help = "give a LineString or Polygon; points can be joined to a line in CSV, one row per vertex";
            return Err(refuse(what, self.label.to_owned(), figures, help));
        }
        if self.empty > 0 {
            let message = format!("features and parts without geometry passed over: {}", self.empty);
            notes.push(Note::new("null-geometry", message));
        }
        if self.points > 0 {
            notes.push(Note::new("points-ignored", format!("points passed over: {} (only lines are used)", self.points)));
        }
        Ok(self.lines)
    }
}

/// Whether the property `role` says `breakline`.
fn is_breakline(feature: &Feature) -> bool {
    let role = feature.properties.as_ref().and_then(|p| p.get("role").or_else(|| p.get("Role")));
    role.and_then(JsonValue::as_str).is_some_and(|role| role.trim().eq_ignore_ascii_case("breakline"))
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
