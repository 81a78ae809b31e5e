//! Existing ground: bytes → raw meshes, points and grids, in world coordinates and in the order of the file.

mod asc;
mod comments;
#[cfg(any(feature = "geotiff", feature = "las"))]
mod geokeys;
mod geotiff;
pub(super) mod kind;
mod las;
mod mesh;
mod obj;
mod ply;
mod points;
mod single;

pub use mesh::{RawMesh, read_mesh};

use super::error::refuse;
use super::room;
use super::{ColumnOrder, InputFormat, Pick, ReadError, Source};
use crate::model::{LengthUnit, Memory, Note};
use glam::{DVec2, DVec3};
use std::path::Path;

/// Magnitude from which a height is none, in any unit: markers such as 10³⁰ and −3.4·10³⁸, which files do not always name and often
/// print with fewer digits than they have.
pub const NO_HEIGHT: f64 = 1e20;

/// What the caller knows about a ground file.
#[derive(Clone, Debug, Default)]
pub struct TerrainOptions {
    /// Its format; `None`: from the extension, else from the content. [`InputFormat::GeoJson`] is no format of ground.
    pub format: Option<InputFormat>,
    /// The columns of a text file without header; for LandXML `enz`, if easting comes first in it.
    pub csv_order: Option<ColumnOrder>,
    /// What is meant of a file that holds several things.
    pub pick: Pick,
    /// Unit of files that should declare one and do not.
    pub unit: Option<LengthUnit>,
    /// How much memory the run may take.
    pub memory: Memory,
}

impl TerrainOptions {
    /// Nothing known but the format.
    pub fn of(format: InputFormat) -> Self {
        Self { format: Some(format), ..Self::default() }
    }
}

/// Faces of a mesh, corners as vertex indices, all of them below the number of vertices.
#[derive(Clone, Debug, PartialEq)]
pub enum RawFaces {
    /// Nothing but triangles.
    Triangles(Vec<[u32; 3]>),
    /// Faces of three and more corners.
    Polygons {
        /// Corners of all faces, one after the other.
        corners: Vec<u32>,
        /// Where each face ends in `corners`.
        ends: Vec<usize>,
    },
}

impl RawFaces {
    /// Number of faces.
    pub fn len(&self) -> usize {
        match self {
            Self::Triangles(triangles) => triangles.len(),
            Self::Polygons { ends, .. } => ends.len(),
        }
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }
}

/// Heights at the nodes of an upright grid.
#[derive(Clone, Debug, PartialEq)]
pub struct RawGrid {
    /// Nodes from west to east.
    pub columns: usize,
    /// Nodes from north to south.
    pub rows: usize,
    /// The south-west node.
    pub origin: DVec2,
    /// Distance of the nodes, both positive.
    pub step: DVec2,
    /// Heights row by row, the northernmost first, each from the west; NaN where there is none.
    pub heights: Vec<f64>,
}

impl RawGrid {
    /// The north-east node.
    fn far(&self) -> DVec2 {
        self.origin + DVec2::new(self.columns.saturating_sub(1) as f64, self.rows.saturating_sub(1) as f64) * self.step
    }

    /// Refuses nodes so far away that there is no number for their place.
    fn within_numbers(&self, label: &str) -> Result<(), ReadError> {
        let far = self.far();
        if self.origin.is_finite() && far.is_finite() {
            return Ok(());
        }
        let [step, from, to] = [self.step, self.origin, far].map(|p| format!("({:e}, {:e})", p.x, p.y));
        let figures = format!("{} × {} nodes, {step} apart, from {from} to {to}", self.columns, self.rows);
        let help = "correct the size of its cells, or export the file again";
        Err(refuse("the grid reaches beyond all numbers", label, figures, help))
    }
}

/// The shape of ground as a file gives it. All coordinates are finite.
#[derive(Clone, Debug, PartialEq)]
pub enum RawGround {
    /// Vertices and faces.
    Mesh {
        /// The vertices in the order of the file.
        vertices: Vec<DVec3>,
        /// At least one face.
        faces: RawFaces,
    },
    /// Points without faces.
    Points(Vec<DVec3>),
    /// A grid.
    Grid(RawGrid),
}

/// Ground as read.
#[derive(Clone, Debug, PartialEq)]
pub struct RawTerrain {
    /// Where it came from.
    pub source: Source,
    /// What it is.
    pub ground: RawGround,
    /// What was seen on the way.
    pub notes: Vec<Note>,
}

/// Reads existing ground from a file: OBJ, PLY, LandXML, DXF, points as text, ESRI ASCII grid, GeoTIFF, LAS and LAZ.
///
/// # Errors
/// [`ReadError`] when the file cannot be opened, when its content is not what its name says, or when it is damaged: the
/// message names line or element. Whether the ground is sound is left to [`crate::terrain`].
pub fn read_terrain(path: &Path, options: &TerrainOptions) -> Result<RawTerrain, ReadError> {
    let label = path.display().to_string();
    if path == Path::new("-") {
        let help = "write the ground to a file first; only the line can come from standard input";
        return Err(refuse("the ground cannot be read from standard input", "<stdin>", "it is given as `-`", help));
    }
    let bytes = room::load(&label, path, &options.memory)?;
    parse_named_terrain(path, &bytes, options)
}

/// Reads existing ground from the bytes of a file of this name.
///
/// # Errors
/// As [`read_terrain`].
pub fn parse_named_terrain(path: &Path, bytes: &[u8], options: &TerrainOptions) -> Result<RawTerrain, ReadError> {
    let label = path.display().to_string();
    let extension = path.extension().and_then(|e| e.to_str()).unwrap_or("").to_ascii_lowercase();
    let format = match options.format.or_else(|| InputFormat::from_path(path)) {
        Some(format) => format,
        None => kind::only_by_content(&label, bytes)?,
    };
    // Files named `.xyz` have these columns by their name; other text files have to say.
    let by_name: Option<ColumnOrder> = if extension == "xyz" { "xyz".parse().ok() } else { None };
    parse(&label, bytes, &TerrainOptions { format: Some(format), ..options.clone() }, by_name.as_ref())
}

/// Reads existing ground from bytes; `label` names them in messages. Without a format the content tells it.
///
/// # Errors
/// As [`read_terrain`].
pub fn parse_terrain(label: &str, bytes: &[u8], options: &TerrainOptions) -> Result<RawTerrain, ReadError> {
    parse(label, bytes, options, None)
}

/// `by_name`: the columns of text without header, where the name of the file says them.
fn parse(label: &str, bytes: &[u8], options: &TerrainOptions, by_name: Option<&ColumnOrder>) -> Result<RawTerrain, ReadError> {
    let format = match options.format {
        Some(format) => format,
        None => kind::only_by_content(label, bytes)?,
    };
    kind::check(label, bytes, format)?;
    let pick = &options.pick;
    pick.fits(label, format)?;
    super::pick::order_fits(options.csv_order.as_ref(), label, format)?;
    room::for_content(label, format, bytes, &options.memory)?;
    let known = super::landxml::Known { pick, order: options.csv_order.as_ref(), unit: options.unit };
    // The checksum takes as long as the fast formats themselves.
    let (mut source, read) = rayon::join(
        || super::source(label, format, bytes),
        || {
            let mut notes = Vec::new();
            let ground = match format {
                InputFormat::Obj => obj::read(label, bytes, &mut notes),
                InputFormat::Ply => ply::read(label, bytes, &mut notes),
                InputFormat::Asc => asc::read(label, bytes, &mut notes),
                InputFormat::LandXml => super::landxml::ground(label, bytes, known, &mut notes),
                InputFormat::Dxf => super::dxf::ground(label, bytes, pick, &mut notes),
                InputFormat::GeoTiff => geotiff::read(label, bytes, &options.memory, &mut notes),
                InputFormat::Las => las::read(label, bytes, (pick, &options.memory), &mut notes),
                InputFormat::Csv | InputFormat::GeoJson | InputFormat::Gpx => {
                    points::read(label, bytes, options.csv_order.as_ref(), by_name, &mut notes)
                }
            };
            ground.map(|(ground, said)| (ground, said, notes))
        },
    );
    let (ground, said, notes) = read?;
    if let RawGround::Grid(grid) = &ground {
        grid.within_numbers(label)?;
    }
    source.kind = said.kind;
    source.crs = said.crs;
    source.unit = said.unit;
    Ok(RawTerrain { source, ground, notes })
}

/// What a ground file says about its coordinates.
#[derive(Debug, Default)]
pub(in crate::read) struct Said {
    pub(in crate::read) kind: super::CoordinateKind,
    pub(in crate::read) crs: Option<String>,
    pub(in crate::read) unit: Option<LengthUnit>,
}

/// Collects faces; stays with plain triangles as long as there is nothing else.
#[derive(Default)]
pub(in crate::read) struct Faces {
    triangles: Vec<[u32; 3]>,
    corners: Vec<u32>,
    ends: Vec<usize>,
    mixed: bool,
}

impl Faces {
    pub(in crate::read) fn with_capacity(count: usize) -> Self {
        Self { triangles: Vec::with_capacity(count), corners: Vec::new(), ends: Vec::new(), mixed: false }
    }

    #[inline]
    pub(in crate::read) fn triangle(&mut self, t: [u32; 3]) {
        if self.mixed { self.polygon(&t) } else { self.triangles.push(t) }
    }

    pub(in crate::read) fn polygon(&mut self, corners: &[u32]) {
        if !std::mem::replace(&mut self.mixed, true) {
            let triangles = std::mem::take(&mut self.triangles);
            self.ends = (1..=triangles.len()).map(|i| 3 * i).collect();
            self.corners = triangles.into_flattened();
        }
        self.corners.extend_from_slice(corners);
        self.ends.push(self.corners.len());
    }

    /// Number of all corners.
    fn corner_count(&self) -> usize {
        if self.mixed { self.corners.len() } else { 3 * self.triangles.len() }
    }

    /// All corners, one after the other.
    fn corners_mut(&mut self) -> &mut [u32] {
        if self.mixed { &mut self.corners } else { self.triangles.as_flattened_mut() }
    }

    /// Adds the faces of another.
    fn append(&mut self, mut other: Self) {
        if !self.mixed && !other.mixed {
            self.triangles.append(&mut other.triangles);
            return;
        }
        other.triangles.iter().for_each(|t| self.triangle(*t));
        let begins = std::iter::once(0).chain(other.ends.iter().copied());
        begins.zip(&other.ends).for_each(|(from, &to)| self.polygon(&other.corners[from..to]));
    }

    pub(in crate::read) fn len(&self) -> usize {
        if self.mixed { self.ends.len() } else { self.triangles.len() }
    }

    pub(in crate::read) fn finish(self) -> RawFaces {
        if self.mixed {
            RawFaces::Polygons { corners: self.corners, ends: self.ends }
        } else {
            RawFaces::Triangles(self.triangles)
        }
    }
}
