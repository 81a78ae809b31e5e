//! Meshes, line work, grids and points to bytes; bytes to files that appear whole or not at all.
//!
//! The format modules write to any [`std::io::Write`] and know nothing of files; [`atomic`] knows files and nothing of formats.

pub mod atomic;
pub mod error;
pub mod lines;
pub mod number;
pub mod obj;
pub mod ply;
pub mod points;
pub mod raster;
pub mod stakes;
mod target;

pub use atomic::{Delivery, Outputs, Target, discard_unfinished};
pub use error::{EncodeError, WriteError};
pub use lines::write_lines;
pub use obj::write_obj;
pub use ply::write_ply;
pub use points::write_points;
pub use raster::{Anchor, GridLayout, write_raster};
pub use stakes::{STAKE_COLUMNS, write_stakes};

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
}

impl MeshFormat {
    /// The format of a target: by the ending of its name, upper or lower case. Standard output and existing devices and pipes
    /// whose names end in neither take OBJ.
    ///
    /// # Errors
    /// [`UnknownFormat`] for any other ending, or none.
    pub fn of(target: &Target) -> Result<Self, UnknownFormat> {
        let Target::File(path) = target else { return Ok(Self::Obj) };
        match ending(path).as_deref() {
            Some("obj") => Ok(Self::Obj),
            Some("ply") => Ok(Self::Ply),
            _ if target.is_stream() => Ok(Self::Obj),
            _ => Err(UnknownFormat { what: "mesh", path: path.clone(), known: "`.obj` or `.ply`" }),
        }
    }

    /// Writes a mesh in this format.
    ///
    /// # Errors
    /// As [`write_obj`] and [`write_ply`].
    pub fn write(self, out: &mut (impl Write + ?Sized), tin: &Tin) -> Result<(), EncodeError> {
        match self {
            Self::Obj => write_obj(out, tin),
            Self::Ply => write_ply(out, tin),
        }
    }
}

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
        assert_eq!(MeshFormat::of(&Target::Stdout), Ok(MeshFormat::Obj));
    }

    #[test]
    fn unknown_endings_list_the_known_ones() {
        assert_eq!(
            format_of("out/a.stl").unwrap_err().to_string(),
            "no format is known for the ending `.stl`\n  --> out/a.stl\n   = help: end the name of a mesh in `.obj` or `.ply`"
        );
        assert_eq!(
            format_of("ply").unwrap_err().to_string(),
            "the name has no ending that tells the format\n  --> ply\n   = help: end the name of a mesh in `.obj` or `.ply`"
        );
    }
}
