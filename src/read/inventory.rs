//! Everything a file holds, whatever it would be used for.

use super::terrain::{RawGround, RawTerrain, TerrainOptions, kind, read_mesh, read_terrain};
use super::{InputFormat, Pick, RawInput, RawLine, RawShape, ReadError, ReadOptions, Source, landxml, read_line};
use crate::model::Memory;
use glam::DVec3;
use std::io::Read as _;
use std::path::Path;

/// One thing a file holds. Coordinates and lengths are in the unit of the file.
#[derive(Clone, Debug, PartialEq)]
pub enum Held {
    /// A line or ring.
    Line {
        /// Its name, if it has one.
        name: Option<String>,
        /// What it is.
        shape: RawShape,
        /// Vertices as given.
        vertices: usize,
        /// How many of them have no elevation.
        without_elevation: usize,
        /// Length in plan.
        length: f64,
        /// Whether it ends where it begins.
        closed: bool,
        /// Lowest and highest elevation.
        z: Option<[f64; 2]>,
    },
    /// A mesh.
    Surface {
        /// Its name, if it has one.
        name: Option<String>,
        /// Its vertices.
        vertices: usize,
        /// Its faces.
        faces: usize,
        /// Its groups, parts or layers, each with the number of its faces; none if it has no groups.
        parts: Vec<(String, usize)>,
    },
    /// Points without faces.
    Points {
        /// Name of their layer or class, if they have one.
        name: Option<String>,
        /// How many.
        count: usize,
    },
    /// Heights at the nodes of a grid.
    Grid {
        /// Nodes from west to east.
        columns: usize,
        /// Nodes from north to south.
        rows: usize,
        /// Distance of the nodes to the east and to the north.
        step: [f64; 2],
        /// Nodes without a height.
        missing: usize,
    },
}

/// A file as it can be used.
#[derive(Debug)]
pub struct Inventory {
    /// Its format.
    pub format: InputFormat,
    /// Its length in bytes.
    pub bytes: u64,
    /// What it holds.
    pub held: Vec<Held>,
    /// The smallest box around all of it, lower and upper corner.
    pub bounds: Option<[DVec3; 2]>,
    /// What it is as a line; `None`: never one, by its format.
    pub line: Option<Result<RawInput, ReadError>>,
    /// What it is as ground; `None`: never ground, by its format.
    pub ground: Option<Result<RawTerrain, ReadError>>,
}

impl Inventory {
    /// What the file says about itself, from whatever could be read.
    pub fn source(&self) -> Option<&Source> {
        let line = self.line.as_ref().and_then(|line| line.as_ref().ok()).map(|line| &line.source);
        let ground = self.ground.as_ref().and_then(|ground| ground.as_ref().ok()).map(|ground| &ground.source);
        line.into_iter().chain(ground).max_by_key(|source| (source.unit.is_some(), source.crs.is_some()))
    }
}

/// Reads a file as everything it may be.
///
/// # Errors
/// [`ReadError`] when the file cannot be opened, or nothing says what it is. What is wrong with it as a line or as ground stands
/// in the answer.
pub fn inventory(path: &Path, options: &ReadOptions) -> Result<Inventory, ReadError> {
    let open = |cause| ReadError::Open { label: path.display().to_string(), cause };
    let bytes = std::fs::metadata(path).map_err(open)?.len();
    let format = match options.format.or_else(|| InputFormat::from_path(path)) {
        Some(format) => format,
        None => by_content(path)?,
    };
    let [as_line, as_ground] = uses(format);
    let line = as_line.then(|| read_line(path, &ReadOptions { format: Some(format), ..options.clone() }));
    let ground = as_ground.then(|| {
        let format = Some(format).filter(|_| InputFormat::from_path(path).is_none());
        let (csv_order, pick) = (options.csv_order.clone(), options.pick.clone());
        read_terrain(path, &TerrainOptions { format, csv_order, pick, unit: options.unit, memory: options.memory })
    });
    let raw_line = line.as_ref().and_then(|line| line.as_ref().ok());
    let raw_ground = ground.as_ref().and_then(|ground| ground.as_ref().ok());
    let mut held: Vec<Held> = raw_line.into_iter().flat_map(|line| line.lines.iter().map(held_line)).collect();
    match format {
        // There may be several of them, of which only one can be ground.
        InputFormat::LandXml => held.extend(landxml::surfaces(&path.display().to_string(), &std::fs::read(path).map_err(open)?)?),
        _ => held.extend(raw_ground.map(|ground| held_ground(&ground.ground))),
    }
    let grouped = matches!(format, InputFormat::Obj | InputFormat::Ply | InputFormat::Dxf);
    if let Some(Held::Surface { vertices, faces, parts, .. }) = held.last_mut().filter(|_| grouped) {
        /// Of a vertex and of a triangle: the mesh that was read is held.
        const HELD: [usize; 2] = [24, 12];
        let bytes = HELD[0] * *vertices + HELD[1] * *faces;
        *parts = groups(path, format, &options.memory.holding(bytes as u64))?;
    }
    let mut bounds = None;
    raw_line.into_iter().for_each(|line| around_line(line, &mut bounds));
    raw_ground.into_iter().for_each(|ground| around_ground(&ground.ground, &mut bounds));
    Ok(Inventory { format, bytes, held, bounds, line, ground })
}

/// Whether a format can hold a line, and ground. Those that are never either are refused as what they are read as.
fn uses(format: InputFormat) -> [bool; 2] {
    match format {
        InputFormat::GeoJson | InputFormat::Gpx => [true, false],
        InputFormat::Csv | InputFormat::LandXml | InputFormat::Dxf => [true, true],
        InputFormat::Obj | InputFormat::Ply | InputFormat::Asc | InputFormat::GeoTiff | InputFormat::Las => [false, true],
    }
}

/// Bytes that tell what a file is: more than any format needs.
const HEAD: u64 = 1 << 16;

fn by_content(path: &Path) -> Result<InputFormat, ReadError> {
    let label = path.display().to_string();
    let mut bytes = Vec::new();
    let read = std::fs::File::open(path).and_then(|file| file.take(HEAD).read_to_end(&mut bytes));
    read.map_err(|cause| ReadError::Open { label: label.clone(), cause })?;
    let text = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(&bytes);
    match text.iter().find(|b| !b.is_ascii_whitespace()) {
        Some(b'{') => Ok(InputFormat::GeoJson),
        _ => kind::only_by_content(&label, &bytes),
    }
}

/// Groups of a mesh in the order of their first faces.
fn groups(path: &Path, format: InputFormat, memory: &Memory) -> Result<Vec<(String, usize)>, ReadError> {
    let mesh = read_mesh(path, Some(format), &Pick::default(), memory)?;
    let mut parts: Vec<(String, usize)> = mesh.names.into_iter().map(|name| (name, 0)).collect();
    for group in mesh.groups {
        parts.get_mut(group as usize).into_iter().for_each(|(_, faces)| *faces += 1);
    }
    Ok(parts)
}

fn held_line(line: &RawLine) -> Held {
    let plan = |i: usize| glam::DVec2::new(line.vertices[i].x, line.vertices[i].y);
    let count = line.vertices.len();
    let heights = line.vertices.iter().filter_map(|v| v.z).filter(|z| z.is_finite());
    let z = heights.fold(None, |range: Option<[f64; 2]>, z| Some(range.map_or([z, z], |[lo, hi]| [lo.min(z), hi.max(z)])));
    let length: f64 = (1..count).map(|i| plan(i).distance(plan(i - 1))).filter(|length| length.is_finite()).sum();
    let ring = matches!(line.shape, RawShape::Ring { .. });
    Held::Line {
        name: line.name.clone(),
        shape: line.shape,
        vertices: count,
        without_elevation: line.vertices.iter().filter(|v| v.z.is_none()).count(),
        length,
        closed: ring || count > 2 && plan(0) == plan(count - 1),
        z,
    }
}

fn held_ground(ground: &RawGround) -> Held {
    match ground {
        RawGround::Mesh { vertices, faces } => {
            Held::Surface { name: None, vertices: vertices.len(), faces: faces.len(), parts: Vec::new() }
        }
        RawGround::Points(points) => Held::Points { name: None, count: points.len() },
        RawGround::Grid(grid) => Held::Grid {
            columns: grid.columns,
            rows: grid.rows,
            step: grid.step.to_array(),
            missing: grid.heights.iter().filter(|z| z.is_nan()).count(),
        },
    }
}

fn grow(bounds: &mut Option<[DVec3; 2]>, p: DVec3) {
    if p.is_finite() {
        *bounds = Some(bounds.map_or([p, p], |[lo, hi]| [lo.min(p), hi.max(p)]));
    }
}

fn around_line(line: &RawInput, bounds: &mut Option<[DVec3; 2]>) {
    for vertex in line.lines.iter().flat_map(|line| &line.vertices) {
        if let Some(z) = vertex.z {
            grow(bounds, DVec3::new(vertex.x, vertex.y, z));
        }
    }
}

fn around_ground(ground: &RawGround, bounds: &mut Option<[DVec3; 2]>) {
    match ground {
        RawGround::Mesh { vertices, .. } | RawGround::Points(vertices) => vertices.iter().for_each(|v| grow(bounds, *v)),
        RawGround::Grid(grid) => {
            let last = glam::DVec2::new(grid.columns.saturating_sub(1) as f64, grid.rows.saturating_sub(1) as f64);
            let far = grid.origin + grid.step * last;
            for z in grid.heights.iter().filter(|z| z.is_finite()) {
                grow(bounds, grid.origin.extend(*z));
                grow(bounds, far.extend(*z));
            }
        }
    }
}
