//! Single vertices and their neighbours: elevations, magnitudes, repetitions, closing.

use super::place::Locator;
use super::{INPUT_LIMIT, MERGE_DISTANCE, Options};
use crate::kernel::range::range;
use crate::model::{Breakline, Chain, Defect, Defects, Line, Note, Place, Role};
use crate::read::terrain::NO_HEIGHT;
use crate::read::{InputFormat, RawInput, RawLine, RawShape, RawVertex};
use glam::DVec3;

/// Values programs write where there is no elevation.
const NO_DATA: [f64; 10] = [-9999.0, -999.999, -999.0, -999.9, -9999.9, -9999.99, -99_999.0, -32_768.0, -32_767.0, -999_999.0];

/// A marker is only suspicious this far below or above all other elevations, in the input's length unit: a mine may lie at
/// −999.
const NO_DATA_GAP: f64 = 100.0;

/// What happened to the vertices of all lines.
#[derive(Default)]
struct Tally {
    merged: usize,
    rings: usize,
    closed: usize,
    open_polygon_rings: usize,
    polygons: u32,
    last_polygon: Option<u32>,
}

/// The chains and breaklines of all lines whose vertices are sound.
pub(super) fn lines(raw: &RawInput, options: Options, defects: &mut Defects, notes: &mut Vec<Note>) -> Line {
    let features: Vec<_> = raw.lines.iter().map(|line| line.feature).collect();
    let locators = Locator::of_features(&raw.source.label, &features);
    if no_elevation_at_all(raw, defects) {
        return Line::default();
    }
    let range = elevation_range(raw);
    let mut tally = Tally::default();
    let mut lines = Line::default();
    for (i, (line, locator)) in raw.lines.iter().zip(&locators).enumerate() {
        let mut unsound = Vec::new();
        for (j, vertex) in line.vertices.iter().enumerate() {
            if !check_vertex(vertex, place(line, j), locator, range, raw.source.format, defects) {
                unsound.push(j);
            }
        }
        let name = line.name.clone().unwrap_or_else(|| format!("line {}", i + 1));
        let before = defects.count();
        let (vertices, places) = distinct(line, &unsound, locator, &mut tally, defects);
        if line.shape != RawShape::Breakline {
            lines.chains.extend(chain(line, vertices, places, before, &unsound, name, options, locator, &mut tally, defects));
        } else if defects.count() == before && unsound.is_empty() {
            lines.breaklines.push(Breakline { name, vertices, places, stations: None, of: None });
        }
    }
    tally.notes(notes);
    lines
}

fn place(line: &RawLine, vertex: usize) -> Place {
    let number = u32::try_from(vertex + 1).unwrap_or(u32::MAX);
    Place { feature: line.feature, vertex: number, row: line.vertices[vertex].row }
}

/// A number in messages: shortest text that reads back the same, in scientific notation where it would be long.
pub(super) fn show(value: f64) -> String {
    if value != 0.0 && !(1e-5..1e15).contains(&value.abs()) { format!("{value:e}") } else { format!("{value}") }
}

fn no_elevation_at_all(raw: &RawInput, defects: &mut Defects) -> bool {
    let count: usize = raw.lines.iter().map(|line| line.vertices.len()).sum();
    let any = raw.lines.iter().flat_map(|line| &line.vertices).any(|vertex| vertex.z.is_some());
    if count == 0 || any {
        return false;
    }
    defects.push("no-elevation", || Defect {
        code: "no-elevation",
        what: "the line has no elevations".into(),
        at: raw.source.label.clone(),
        figures: Some(format!("{count} vertices, none of them with z")),
        help: no_elevation_help(raw.source.format).into(),
    });
    true
}

fn no_elevation_help(format: InputFormat) -> &'static str {
    match format {
        InputFormat::GeoJson => "give every vertex as [x, y, z]; drape the line on a terrain first if it has no heights",
        InputFormat::Dxf => {
            "give the polyline an elevation, or make it a 3D polyline with the heights of its vertices; a plane one at 0 has none"
        }
        _ => "fill in the elevation, or take the row out",
    }
}

/// Lowest and highest elevation that is no marker.
fn elevation_range(raw: &RawInput) -> (f64, f64) {
    range_of(raw.lines.iter().flat_map(|line| &line.vertices).filter_map(|vertex| vertex.z))
}

/// Elevations among these that stand for none, such as −9999 far below all others.
pub fn no_data_markers(elevations: impl Iterator<Item = f64> + Clone) -> Vec<f64> {
    let listed = |z: &f64| z.abs() >= NO_HEIGHT || NO_DATA.contains(z);
    let mut found: Vec<f64> = Vec::new();
    for z in elevations.clone().filter(listed) {
        if !found.contains(&z) && found.len() < NO_DATA.len() {
            found.push(z);
        }
    }
    if !found.is_empty() {
        let range = range_of(elevations);
        found.retain(|&z| is_no_data(z, range));
    }
    found
}

fn range_of(elevations: impl Iterator<Item = f64>) -> (f64, f64) {
    range(elevations.filter(|z| z.abs() < NO_HEIGHT && !NO_DATA.contains(z)))
}

fn is_no_data(z: f64, (lo, hi): (f64, f64)) -> bool {
    z.abs() >= NO_HEIGHT || (NO_DATA.contains(&z) && (z < lo - NO_DATA_GAP || z > hi + NO_DATA_GAP))
}

/// Whether a vertex is sound by itself.
fn check_vertex(
    vertex: &RawVertex,
    place: Place,
    locator: &Locator<'_>,
    range: (f64, f64),
    format: InputFormat,
    defects: &mut Defects,
) -> bool {
    let mut push = |code: &'static str, what: &str, figures: String, help: &str| {
        defects.push(code, || Defect {
            code,
            what: what.into(),
            at: locator.vertex(place),
            figures: Some(figures),
            help: help.into(),
        });
    };
    let Some(z) = vertex.z else {
        let figures = format!("x {}, y {}, no z", show(vertex.x), show(vertex.y));
        push("no-elevation", "the vertex has no elevation", figures, no_elevation_help(format));
        return false;
    };
    let figures = || format!("x {}, y {}, z {}", show(vertex.x), show(vertex.y), show(z));
    let ordinates = [vertex.x, vertex.y, z];
    if ordinates.iter().any(|v| !v.is_finite()) {
        push("not-finite", "a coordinate is not a finite number", figures(), "correct the vertex or take it out");
    } else if is_no_data(z, range) {
        let help = "a marker for a missing elevation: fill in the elevation, or take the vertex out";
        push("no-data", "the elevation is a no-data value", figures(), help);
    } else if ordinates.iter().any(|v| v.abs() > INPUT_LIMIT) {
        let help = format!("coordinates must lie within ±{}: check the units and the columns", show(INPUT_LIMIT));
        push("too-large", "a coordinate is absurdly large", figures(), &help);
    } else {
        return true;
    }
    false
}

fn same_plan(a: DVec3, b: DVec3) -> bool {
    a.truncate().distance_squared(b.truncate()) <= MERGE_DISTANCE * MERGE_DISTANCE
}

fn same(a: DVec3, b: DVec3) -> bool {
    same_plan(a, b) && (a.z - b.z).abs() <= MERGE_DISTANCE
}

/// The sound vertices of a line without repetitions. Vertical steps between neighbours are defects.
fn distinct(
    line: &RawLine,
    unsound: &[usize],
    locator: &Locator<'_>,
    tally: &mut Tally,
    defects: &mut Defects,
) -> (Vec<DVec3>, Vec<Place>) {
    let mut vertices: Vec<DVec3> = Vec::with_capacity(line.vertices.len());
    let mut places: Vec<Place> = Vec::with_capacity(line.vertices.len());
    let mut unsound_ahead = unsound.iter().peekable();
    for (i, raw) in line.vertices.iter().enumerate() {
        if unsound_ahead.next_if_eq(&&i).is_some() {
            continue;
        }
        let vertex = DVec3::new(raw.x, raw.y, raw.z.unwrap_or(f64::NAN));
        let place = place(line, i);
        match (vertices.last(), places.last()) {
            (Some(&last), _) if same(last, vertex) => tally.merged += 1,
            (Some(&last), Some(&at)) if same_plan(last, vertex) => defects.push("vertical-step", || Defect {
                code: "vertical-step",
                what: "two vertices stand above each other".into(),
                at: locator.pair(at, place),
                figures: Some(format!("x {}, y {}: z {} and z {}", show(vertex.x), show(vertex.y), show(last.z), show(vertex.z))),
                help: "no slope passes through a vertical step: take one of the two out, or move them apart in plan".into(),
            }),
            _ => {
                vertices.push(vertex);
                places.push(place);
            }
        }
    }
    (vertices, places)
}

/// The chain of one line from its distinct vertices; `None` if it has a defect (more of them than `before`).
#[allow(clippy::too_many_arguments, reason = "one step of a sequence, parted from it for its length")]
fn chain(
    line: &RawLine,
    mut vertices: Vec<DVec3>,
    mut places: Vec<Place>,
    before: usize,
    unsound: &[usize],
    name: String,
    options: Options,
    locator: &Locator<'_>,
    tally: &mut Tally,
    defects: &mut Defects,
) -> Option<Chain> {
    let polygon_ring = matches!(line.shape, RawShape::Ring { .. });
    let mut repeats_first = false;
    // Closing vertices go; at least three must be left, else an out-and-back of two vertices stays an open line.
    let least = if polygon_ring { 1 } else { 3 };
    while vertices.len() > least && same(vertices[0], vertices[vertices.len() - 1]) {
        vertices.pop();
        places.pop();
        repeats_first = true;
    }
    if let (Some(&first), Some(&last), Some(&a), Some(&b)) = (vertices.first(), vertices.last(), places.first(), places.last())
        && vertices.len() > 1
        && same_plan(first, last)
        && !same(first, last)
    {
        defects.push("closing-step", || Defect {
            code: "closing-step",
            what: "the line ends above or below its first vertex".into(),
            at: locator.pair(a, b),
            figures: Some(format!("x {}, y {}: z {} and z {}", show(first.x), show(first.y), show(first.z), show(last.z))),
            help: "give both the same elevation to close the ring, or move one of them in plan".into(),
        });
    }
    if defects.count() > before || !unsound.is_empty() {
        return None;
    }
    let wanted_ring = polygon_ring || repeats_first || options.closed;
    let (needed, noun) = if wanted_ring { (3, "ring") } else { (2, "line") };
    if vertices.len() < needed {
        defects.push("too-few-vertices", || {
            let at = match line.vertices.len() {
                0 => locator.line(line.feature),
                1 => locator.vertex(place(line, 0)),
                n => locator.pair(place(line, 0), place(line, n - 1)),
            };
            Defect {
                code: "too-few-vertices",
                what: format!("a {noun} needs at least {needed} distinct vertices"),
                at,
                figures: Some(format!("`{name}` has {} ({} given)", vertices.len(), line.vertices.len())),
                help: "add vertices, or take the line out".into(),
            }
        });
        return None;
    }
    let role = tally.role(line.shape, repeats_first, options);
    Some(Chain { name, role, vertices, places, axis: None })
}

impl Tally {
    fn role(&mut self, shape: RawShape, repeats_first: bool, options: Options) -> Role {
        match shape {
            RawShape::Ring { polygon, hole } => {
                self.open_polygon_rings += usize::from(!repeats_first);
                if self.last_polygon != Some(polygon) {
                    self.last_polygon = Some(polygon);
                    self.polygons += 1;
                }
                let polygon = self.polygons - 1;
                if hole { Role::Hole { polygon } } else { Role::Outer { polygon } }
            }
            RawShape::Line if repeats_first || options.closed => {
                self.rings += usize::from(repeats_first);
                self.closed += usize::from(!repeats_first);
                self.last_polygon = None;
                self.polygons += 1;
                Role::Outer { polygon: self.polygons - 1 }
            }
            RawShape::Line | RawShape::Breakline => Role::Open,
        }
    }

    fn notes(&self, notes: &mut Vec<Note>) {
        let mut note = |count: usize, code, text: &str| {
            if count > 0 {
                notes.push(Note::new(code, format!("{text}: {count}")));
            }
        };
        let merged = format!("vertices that repeat the one before within {MERGE_DISTANCE} merged");
        note(self.merged, "duplicates-merged", &merged);
        note(self.rings, "ring-detected", "lines that end where they begin taken as rings");
        note(self.closed, "ring-closed", "open lines closed to rings, as asked");
        note(self.open_polygon_rings, "polygon-ring-open", "polygon rings that do not repeat their first vertex closed");
    }
}
