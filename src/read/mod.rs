//! Bytes → raw records with positions. Nothing is judged here beyond what a record needs to be read.

mod alignment;
mod columns;
mod csv;
mod decimal;
mod decode;
mod document;
mod dxf;
mod error;
mod geojson;
mod gpx;
mod inventory;
mod landxml;
mod number;
mod pick;
mod room;
mod sniff;
pub mod terrain;

pub use columns::ColumnOrder;
pub use document::{Document, parse_document, read_document};
pub use error::ReadError;
pub use inventory::{Held, Inventory, inventory};
pub use pick::Pick;

use crate::kernel::hash::sha256;
use crate::model::{LengthUnit, Memory, Note};
use std::fmt;
use std::io::Read;
use std::path::Path;

/// Formats a line or points can be read from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum InputFormat {
    /// GeoJSON, RFC 7946 or older.
    GeoJson,
    /// Rows of text: comma, semicolon, tab or blanks between the fields.
    Csv,
    /// Wavefront OBJ: ground only.
    Obj,
    /// Stanford PLY: ground only.
    Ply,
    /// ESRI ASCII grid: ground only.
    Asc,
    /// LandXML 1.0 to 2.0 and InfraModel: lines and ground.
    LandXml,
    /// AutoCAD DXF: lines and ground.
    Dxf,
    /// GeoTIFF elevation model: ground only.
    GeoTiff,
    /// LAS or LAZ point cloud: ground only.
    Las,
    /// GPS track: known, and always refused.
    Gpx,
}

impl InputFormat {
    /// Name in reports and for `--input-format`.
    pub fn name(self) -> &'static str {
        match self {
            Self::GeoJson => "geojson",
            Self::Csv => "csv",
            Self::Obj => "obj",
            Self::Ply => "ply",
            Self::Asc => "asc",
            Self::LandXml => "landxml",
            Self::Dxf => "dxf",
            Self::GeoTiff => "geotiff",
            Self::Las => "las",
            Self::Gpx => "gpx",
        }
    }

    /// Whether files of this name may have an order of columns or coordinates to be told.
    pub fn may_have_order(path: &Path) -> bool {
        Self::from_path(path).is_none_or(|format| matches!(format, Self::Csv | Self::LandXml))
    }

    /// The format a file name stands for; `None` if its extension says nothing.
    pub fn from_path(path: &Path) -> Option<Self> {
        let extension = path.extension()?.to_str()?.to_ascii_lowercase();
        match extension.as_str() {
            "geojson" | "json" => Some(Self::GeoJson),
            "csv" | "txt" | "tsv" | "xyz" => Some(Self::Csv),
            "obj" => Some(Self::Obj),
            "ply" => Some(Self::Ply),
            "asc" => Some(Self::Asc),
            "xml" | "landxml" => Some(Self::LandXml),
            "dxf" => Some(Self::Dxf),
            "tif" | "tiff" => Some(Self::GeoTiff),
            "las" | "laz" => Some(Self::Las),
            "gpx" => Some(Self::Gpx),
            _ => None,
        }
    }
}

impl fmt::Display for InputFormat {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What the input says about its own coordinates.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CoordinateKind {
    /// Nothing.
    #[default]
    Unknown,
    /// Longitude and latitude in degrees (by its CRS or by its column headings).
    Degrees,
    /// Plan coordinates as lengths (by its CRS or by headings like `easting`).
    Lengths,
}

/// Where an input came from.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Source {
    /// Path as given, or `<stdin>`.
    pub label: String,
    /// Its format.
    pub format: InputFormat,
    /// Size in bytes.
    pub bytes: u64,
    /// SHA-256 of the bytes, in lower-case hexadecimal digits.
    pub sha256: String,
    /// Name of the coordinate reference system as the file gives it.
    pub crs: Option<String>,
    /// What the file says about its coordinates.
    pub kind: CoordinateKind,
    /// Unit of length the file declares, of plan and height alike.
    pub unit: Option<LengthUnit>,
}

/// What a raw line is in its file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RawShape {
    /// A polyline; a ring if its last vertex repeats the first.
    Line,
    /// Ring of a polygon.
    Ring {
        /// Polygon, counted from 0 over the whole input.
        polygon: u32,
        /// Whether it is a hole.
        hole: bool,
    },
    /// A line inside rings that shapes their platform (property `role` = `breakline`); of one vertex, a spot height.
    Breakline,
}

/// One vertex as read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RawVertex {
    /// Easting.
    pub x: f64,
    /// Northing.
    pub y: f64,
    /// Elevation; `None` where there is none, or a word for none such as `NaN` or `#N/A`.
    pub z: Option<f64>,
    /// Row of a text file, counted from 1.
    pub row: Option<u32>,
}

/// One line as read, closing vertices and repetitions included.
#[derive(Clone, Debug, PartialEq)]
pub struct RawLine {
    /// Feature id, name property or line-id column.
    pub name: Option<String>,
    /// Position of the feature in its collection, counted from 1.
    pub feature: Option<u32>,
    /// Polyline or polygon ring.
    pub shape: RawShape,
    /// The vertices in the order of the file.
    pub vertices: Vec<RawVertex>,
}

/// A line input as read.
#[derive(Clone, Debug, PartialEq)]
pub struct RawInput {
    /// Where it came from.
    pub source: Source,
    /// The lines in the order of the file; at least one that is no breakline.
    pub lines: Vec<RawLine>,
    /// What was seen on the way (dialect of a text file, features skipped).
    pub notes: Vec<Note>,
}

/// A point to sample the surface at.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PointRow {
    /// Easting.
    pub x: f64,
    /// Northing.
    pub y: f64,
    /// Row of the file, counted from 1.
    pub row: u32,
}

/// Points as read.
#[derive(Clone, Debug, PartialEq)]
pub struct RawPoints {
    /// Where they came from.
    pub source: Source,
    /// The points in the order of the file; at least one, all coordinates finite.
    pub points: Vec<PointRow>,
    /// What was seen on the way.
    pub notes: Vec<Note>,
}

/// What the caller knows about a file.
#[derive(Clone, Debug)]
pub struct ReadOptions {
    /// Its format; `None`: from the extension. Needed for standard input.
    pub format: Option<InputFormat>,
    /// The columns of a text file without header; for LandXML `enz`, if easting comes first in it.
    pub csv_order: Option<ColumnOrder>,
    /// What is meant of a file that holds several things.
    pub pick: Pick,
    /// How far the chords of arcs, clothoids and vertical curves may lie off them; positive. In `unit`, else in that of the file.
    pub chord: f64,
    /// Unit that was asked for: that of files that should declare one and do not.
    pub unit: Option<LengthUnit>,
    /// Elevations do not matter: text files need no column for them.
    pub flat: bool,
    /// How much memory the run may take.
    pub memory: Memory,
}

impl Default for ReadOptions {
    /// Nothing known, everything taken, chords within [`DEFAULT_CHORD`].
    fn default() -> Self {
        Self {
            format: None,
            csv_order: None,
            pick: Pick::default(),
            chord: DEFAULT_CHORD,
            unit: None,
            flat: false,
            memory: Memory::default(),
        }
    }
}

impl ReadOptions {
    /// Nothing known but the format.
    pub fn of(format: InputFormat) -> Self {
        Self { format: Some(format), ..Self::default() }
    }
}

/// Chord of curves where the caller says nothing: a third of the usual tolerance of 0.01, in the length unit.
pub const DEFAULT_CHORD: f64 = 0.01 / 3.0;

/// Reads a line from a file, or from standard input when the path is `-`.
///
/// # Errors
/// [`ReadError`] when the file cannot be opened, its format is not known, or its content cannot be understood. Missing
/// elevations and everything about the shape are left to validation.
pub fn read_line(path: &Path, options: &ReadOptions) -> Result<RawInput, ReadError> {
    let (label, format, bytes) = load(path, options)?;
    parse_line(&label, &bytes, &ReadOptions { format: Some(format), ..options.clone() })
}

/// Reads a line from bytes; `label` names them in messages. Without a format they are GeoJSON.
///
/// # Errors
/// As [`read_line`].
pub fn parse_line(label: &str, bytes: &[u8], options: &ReadOptions) -> Result<RawInput, ReadError> {
    let format = options.format.unwrap_or(InputFormat::GeoJson);
    // A surface, where the file is also ground, is no matter of its lines.
    Pick { surface: None, ..options.pick.clone() }.fits(label, format)?;
    pick::order_fits(options.csv_order.as_ref(), label, format)?;
    room::for_content(label, format, bytes, &options.memory)?;
    let mut notes = Vec::new();
    let mut source = source(label, format, bytes);
    let mut lines = match format {
        InputFormat::GeoJson => geojson::lines(&decode::text(label, bytes, &mut notes)?, &mut source, &mut notes)?,
        InputFormat::Csv => {
            let text = decode::text(label, bytes, &mut notes)?;
            csv::lines(&text, &mut source, options.csv_order.as_ref(), !options.flat, &mut notes)?
        }
        InputFormat::LandXml => landxml::lines(bytes, &mut source, options, &mut notes)?,
        InputFormat::Dxf => dxf::lines(bytes, &mut source, options, &mut notes)?,
        InputFormat::Gpx => return Err(gpx::refuse(label, bytes)),
        InputFormat::Obj | InputFormat::Ply | InputFormat::Asc | InputFormat::GeoTiff | InputFormat::Las => {
            return Err(no_line(label, format));
        }
    };
    if matches!(format, InputFormat::GeoJson | InputFormat::Csv) {
        lines = options.pick.named(label, lines)?;
    }
    Ok(RawInput { source, lines, notes })
}

fn no_line(label: &str, format: InputFormat) -> ReadError {
    ReadError::Content {
        what: "no line can be read from a ground file".into(),
        at: label.to_owned(),
        figures: format!("format: {format}"),
        help: "give the line as GeoJSON or text, and the ground with `--terrain`".into(),
    }
}

/// Reads points from a text file, or from standard input when the path is `-`. Elevations are not needed.
///
/// # Errors
/// As [`read_line`]; also for coordinates that are missing or not finite.
pub fn read_points(path: &Path, options: &ReadOptions) -> Result<RawPoints, ReadError> {
    let with_default = ReadOptions { format: options.format.or(Some(InputFormat::Csv)), ..options.clone() };
    let (label, format, bytes) = load(path, &with_default)?;
    room::for_content(&label, format, &bytes, &options.memory)?;
    parse_points(&label, &bytes, options.csv_order.as_ref())
}

/// Reads points from the bytes of a text file; `label` names them in messages.
///
/// # Errors
/// As [`read_points`].
pub fn parse_points(label: &str, bytes: &[u8], order: Option<&ColumnOrder>) -> Result<RawPoints, ReadError> {
    let mut notes = Vec::new();
    let text = decode::text(label, bytes, &mut notes)?;
    let mut source = source(label, InputFormat::Csv, bytes);
    let points = csv::points(&text, &mut source, order, &mut notes)?;
    Ok(RawPoints { source, points, notes })
}

/// Opens and reads the whole input.
fn load(path: &Path, options: &ReadOptions) -> Result<(String, InputFormat, Vec<u8>), ReadError> {
    if path == Path::new("-") {
        let label = "<stdin>".to_owned();
        let format = options.format.ok_or(ReadError::StdinFormat)?;
        let mut bytes = Vec::new();
        match std::io::stdin().lock().read_to_end(&mut bytes) {
            Ok(_) => Ok((label, format, bytes)),
            Err(cause) => Err(ReadError::Open { label, cause }),
        }
    } else {
        let label = path.display().to_string();
        let format = options.format.or_else(|| InputFormat::from_path(path));
        let format = format.ok_or_else(|| ReadError::unknown_format(label.clone()))?;
        let bytes = room::load(&label, path, &options.memory)?;
        Ok((label, format, bytes))
    }
}

fn source(label: &str, format: InputFormat, bytes: &[u8]) -> Source {
    let size = bytes.len() as u64;
    let sha256 = sha256(bytes);
    Source { label: label.to_owned(), format, bytes: size, sha256, crs: None, kind: CoordinateKind::Unknown, unit: None }
}
