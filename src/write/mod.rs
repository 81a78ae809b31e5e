//! Meshes, line work, grids and points to bytes; bytes to files that appear whole or not at all.
//!
//! The format modules write to any [`std::io::Write`] and know nothing of files; [`atomic`] knows files and nothing of formats.

pub mod atomic;
mod clash;
mod crs;
mod digest;
pub mod dxf;
pub mod error;
mod fields;
#[cfg(feature = "geotiff")]
pub mod geotiff;
pub mod glb;
pub mod head;
pub mod landxml;
pub mod lines;
pub mod number;
pub mod obj;
pub mod origin;
mod palette;
pub mod ply;
pub mod points;
pub mod raster;
mod single;
pub mod stakes;
pub mod stl;
mod target;

pub use atomic::{Delivery, Outputs, Target, discard_unfinished, discard_unfinished_within};
pub use clash::{Clash, Footprint, first_clash};
pub use crs::SystemName;
pub use digest::Digest;
pub use dxf::{write_dxf, write_dxf_lines};
pub use error::{EncodeError, WriteError};
pub use fields::{push_field, push_figure};
#[cfg(feature = "geotiff")]
pub use geotiff::write_geotiff;
pub use glb::write_glb;
pub use head::{Earthworks, Head};
pub use landxml::{write_landxml, write_landxml_lines};
pub use lines::write_lines;
pub use obj::write_obj;
pub use origin::write_origin;
pub use ply::write_ply;
pub use points::write_points;
pub use raster::{Anchor, GridLayout, RasterFormat, Reference, write_raster};
pub use single::ROUNDING;
pub(crate) use single::bytes as single_precision;
#[cfg(test)]
pub(crate) use single::value as from_single_precision;
pub use stakes::{STAKE_COLUMNS, write_stakes};
pub use stl::write_stl;

#[cfg(test)]
pub(crate) mod testing;

use crate::model::Tin;
use std::io::Write;
use std::path::{Path, PathBuf};

/// Name and version of the program, as in the heads of the files it writes.
pub const GENERATOR: &str = concat!(env!("CARGO_PKG_NAME"), " ", env!("CARGO_PKG_VERSION"));

/// A file name whose ending names no known format.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}\n  --> {}\n   = help: end the name of a {what} in {known}", describe_ending(.path), .path.display())]
pub struct UnknownFormat {
    /// What was to be written, such as `mesh`.
    pub what: &'static str,
    /// The name given.
    pub path: PathBuf,
    /// The endings known, as a phrase.
    pub known: &'static str,
}

/// First line of the message: the ending found, or that there is none.
fn describe_ending(path: &Path) -> String {
    match path.extension() {
        Some(ending) => format!("no format is known for the ending `.{}`", ending.display()),
        None => "the name has no ending that tells the format".to_owned(),
    }
}

/// Lower-case ending of a path, without its dot.
pub(crate) fn ending(path: &Path) -> Option<String> {
    path.extension().and_then(|e| e.to_str()).map(str::to_ascii_lowercase)
}

/// The formats a mesh can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshFormat {
    /// Wavefront OBJ, text, one group per part.
    Obj,
    /// Stanford PLY, binary little-endian, double coordinates, face property `part`.
    Ply,
    /// LandXML 1.2: a TIN surface with breaklines, outline and volumes.
    LandXml,
    /// DXF: faces and 3D polylines on layers.
    Dxf,
    /// STL, binary, single precision.
    Stl,
    /// Binary glTF 2.0, single precision.
    Glb,
}

impl MeshFormat {
    /// The format of a target: by the ending of its name, upper or lower case. Standard output and existing devices and pipes
    /// whose names end in none of them take OBJ.
    ///
    /// # Errors
    /// [`UnknownFormat`] for any other ending, or none.
    pub fn of(target: &Target) -> Result<Self, UnknownFormat> {
        let Target::File(path) = target else { return Ok(Self::Obj) };
        match ending(path).as_deref() {
            Some("obj") => Ok(Self::Obj),
            Some("ply") => Ok(Self::Ply),
            Some("xml" | "landxml") => Ok(Self::LandXml),
            Some("dxf") => Ok(Self::Dxf),
            Some("stl") => Ok(Self::Stl),
            Some("glb") => Ok(Self::Glb),
            _ if target.is_stream() => Ok(Self::Obj),
            _ => Err(UnknownFormat { what: "mesh", path: path.clone(), known: MESH_ENDINGS }),
        }
    }

    /// Whether coordinates are in single precision, and so about a local origin always.
    pub fn is_single(self) -> bool {
        matches!(self, Self::Stl | Self::Glb)
    }

    /// Whether coordinates can be about a local origin. LandXML and DXF go to machines and instruments that want the world's.
    pub fn takes_origin(self) -> bool {
        matches!(self, Self::Obj | Self::Ply | Self::Stl | Self::Glb)
    }

    /// Writes a mesh in this format.
    ///
    /// # Errors
    /// As [`write_obj`], [`write_ply`], [`write_landxml`], [`write_dxf`], [`write_stl`] and [`write_glb`].
    pub fn write(self, out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
        match self {
            Self::Obj => write_obj(out, tin, head),
            Self::Ply => write_ply(out, tin, head),
            Self::LandXml => write_landxml(out, tin, head),
            Self::Dxf => write_dxf(out, tin, head),
            Self::Stl => write_stl(out, tin, head),
            Self::Glb => write_glb(out, tin, head),
        }
    }
}

/// The formats line work can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineFormat {
    /// GeoJSON with the properties of each line.
    GeoJson,
    /// LandXML 1.2: plan features.
    LandXml,
    /// DXF: 3D polylines on layers.
    Dxf,
}

impl LineFormat {
    /// The format of a target: by the ending of its name, upper or lower case. Streams of other names take GeoJSON.
    ///
    /// # Errors
    /// [`UnknownFormat`] for any other ending, or none.
    pub fn of(target: &Target) -> Result<Self, UnknownFormat> {
        let Target::File(path) = target else { return Ok(Self::GeoJson) };
        match ending(path).as_deref() {
            Some("geojson" | "json") => Ok(Self::GeoJson),
            Some("xml" | "landxml") => Ok(Self::LandXml),
            Some("dxf") => Ok(Self::Dxf),
            _ if target.is_stream() => Ok(Self::GeoJson),
            _ => Err(UnknownFormat { what: "line-work file", path: path.clone(), known: LINE_ENDINGS }),
        }
    }

    /// Writes the line work of a head in this format.
    ///
    /// # Errors
    /// As [`write_lines`], [`write_landxml_lines`] and [`write_dxf_lines`].
    pub fn write(self, out: &mut (impl Write + ?Sized), head: &Head<'_>) -> Result<(), EncodeError> {
        match self {
            Self::GeoJson => write_lines(out, head.lines, head.crs).map(drop),
            Self::LandXml => write_landxml_lines(out, head),
            Self::Dxf => write_dxf_lines(out, head),
        }
    }
}

const MESH_ENDINGS: &str = "`.obj`, `.ply`, `.xml` (LandXML), `.dxf`, `.stl` or `.glb`";
const LINE_ENDINGS: &str = "`.geojson`, `.json`, `.xml` (LandXML) or `.dxf`";

#[cfg(test)]
mod tests {
    use super::*;

    fn format_of(name: &str) -> Result<MeshFormat, UnknownFormat> {
        MeshFormat::of(&Target::File(name.into()))
    }

    #[test]
    fn the_ending_names_the_format() {
        assert_eq!(format_of("a.obj"), Ok(MeshFormat::Obj));
        assert_eq!(format_of("dir.ply/a.OBJ"), Ok(MeshFormat::Obj));
        assert_eq!(format_of("a.b.Ply"), Ok(MeshFormat::Ply));
        for (name, format) in [("a.xml", MeshFormat::LandXml), ("a.LandXML", MeshFormat::LandXml), ("a.dxf", MeshFormat::Dxf)] {
            assert_eq!(format_of(name), Ok(format));
        }
        assert_eq!((format_of("a.stl"), format_of("a.GLB")), (Ok(MeshFormat::Stl), Ok(MeshFormat::Glb)));
        assert_eq!(MeshFormat::of(&Target::Stdout), Ok(MeshFormat::Obj));
        let lines = |name: &str| LineFormat::of(&Target::File(name.into())).ok();
        assert_eq!(
            ["a.json", "a.DXF", "a.xml"].map(lines),
            [LineFormat::GeoJson, LineFormat::Dxf, LineFormat::LandXml].map(Some)
        );
        assert_eq!(LineFormat::of(&Target::Stdout), Ok(LineFormat::GeoJson));
    }

    #[test]
    fn unknown_endings_list_the_known_ones() {
        let known = "`.obj`, `.ply`, `.xml` (LandXML), `.dxf`, `.stl` or `.glb`";
        assert_eq!(
            format_of("out/a.step").unwrap_err().to_string(),
            format!("no format is known for the ending `.step`\n  --> out/a.step\n   = help: end the name of a mesh in {known}")
        );
        assert_eq!(
            format_of("ply").unwrap_err().to_string(),
            format!("the name has no ending that tells the format\n  --> ply\n   = help: end the name of a mesh in {known}")
        );
        assert!(LineFormat::of(&Target::File("a.obj".into())).is_err());
    }

    proptest::proptest! {
        /// Whatever an input calls its reference system, the files stay files.
        #[test]
        fn any_name_of_a_reference_system_is_carried(crs: String, name: String) {
            let tin = testing::awkward_tin(2);
            let head = Head { crs: Some(&crs), name: &name, ..Head::default() };
            let written = |format: MeshFormat| {
                let mut bytes = Vec::new();
                format.write(&mut bytes, &tin, &head).unwrap();
                bytes
            };
            assert_eq!(testing::read_obj(&written(MeshFormat::Obj)).1.len(), tin.triangles.len());
            assert_eq!(testing::read_ply(&written(MeshFormat::Ply)).1.len(), tin.triangles.len());
            let drawing = String::from_utf8(written(MeshFormat::Dxf)).unwrap();
            let codes: Vec<u32> = drawing.lines().step_by(2).map(|line| line.parse().unwrap()).collect();
            // Both corners of the box, then a point of each face.
            assert_eq!(codes.iter().filter(|code| **code == 10).count(), 2 + tin.triangles.len());
            let document = String::from_utf8(written(MeshFormat::LandXml)).unwrap();
            let mut reader = quick_xml::Reader::from_str(&document);
            let (mut faces, mut names) = (0, Vec::new());
            loop {
                match reader.read_event().unwrap() {
                    quick_xml::events::Event::Start(e) if e.name().as_ref() == "Surface" => {
                        let attribute = e.attributes().next().unwrap().unwrap();
                        names.push(quick_xml::escape::unescape(&attribute.value).unwrap().into_owned());
                    }
                    quick_xml::events::Event::Start(e) => faces += usize::from(e.name().as_ref() == "F"),
                    quick_xml::events::Event::Eof => break,
                    _ => {}
                }
            }
            assert_eq!((faces, names), (tin.triangles.len(), vec![head::plain(&name).into_owned()]));
        }
    }
}
