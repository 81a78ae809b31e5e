//! Meshes to be looked at as they are, with whatever is wrong with them.

use super::{InputFormat, Pick, RawFaces, ReadError, Said, Source, kind, obj, ply};
use crate::model::{LengthUnit, Memory, Note, Part};
use crate::read::error::refuse;
use crate::read::landxml::{self, Known};
use crate::read::{dxf, room};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::io::Read as _;
use std::path::Path;

/// A mesh as a file gives it.
#[derive(Clone, Debug, PartialEq)]
pub struct RawMesh {
    /// Where it came from.
    pub source: Source,
    /// The vertices in the order of the file. Coordinates may be no numbers.
    pub vertices: Vec<DVec3>,
    /// The faces in the order of the file; their corners are there. There may be none.
    pub faces: RawFaces,
    /// The group of each face, an index into `names`; empty if there are no groups.
    pub groups: Vec<u32>,
    /// Names of the groups, in the order of their first faces: groups or else objects of an OBJ file, the property `part` of a
    /// PLY file under the names of [`Part`], layers of a drawing.
    pub names: Vec<String>,
    /// What was seen on the way.
    pub notes: Vec<Note>,
}

/// Reads a mesh from an OBJ, PLY, LandXML or DXF file; `-` is standard input. `pick` says which surface or layers are
/// meant of several, `memory` how much the run may take.
///
/// # Errors
/// [`ReadError`] when the file cannot be opened, is no mesh, or is damaged: cut off, text where numbers should be, corners that
/// are not there. What is wrong with the mesh as such is no matter here.
pub fn read_mesh(path: &Path, format: Option<InputFormat>, pick: &Pick, memory: &Memory) -> Result<RawMesh, ReadError> {
    let from_stdin = path == Path::new("-");
    let label = if from_stdin { "<stdin>".to_owned() } else { path.display().to_string() };
    let bytes = if from_stdin {
        let mut bytes = Vec::new();
        let read = std::io::stdin().lock().read_to_end(&mut bytes);
        read.map(|_| bytes).map_err(|cause| ReadError::Open { label: label.clone(), cause })?
    } else {
        room::load(&label, path, memory)?
    };
    let format = match format.or_else(|| InputFormat::from_path(path)) {
        Some(format) => format,
        None => kind::only_by_content(&label, &bytes)?,
    };
    room::for_content(&label, format, &bytes, memory)?;
    parse_mesh(&label, &bytes, format, pick)
}

/// Reads a mesh from bytes; `label` names them in messages.
///
/// # Errors
/// As [`read_mesh`].
pub(super) fn parse_mesh(label: &str, bytes: &[u8], format: InputFormat, pick: &Pick) -> Result<RawMesh, ReadError> {
    if !matches!(format, InputFormat::Obj | InputFormat::Ply | InputFormat::LandXml | InputFormat::Dxf) {
        let figures = format!("its format is `{format}`");
        return Err(refuse("the file is no mesh", label, figures, "give a mesh as OBJ, PLY, LandXML or DXF"));
    }
    kind::check(label, bytes, format)?;
    pick.fits(label, format)?;
    // The checksum takes as long as the fast formats themselves.
    let (mut source, read) = rayon::join(
        || crate::read::source(label, format, bytes),
        || {
            let (mut notes, mut said) = (Vec::new(), Said::default());
            let read = match format {
                InputFormat::Ply => ply::load(label, bytes, &mut notes).map(|loaded| {
                    let named = loaded.parts.iter().map(|&part| part_name(part)).collect::<Vec<_>>();
                    said = loaded.spoken.said();
                    (loaded.vertices, loaded.faces, numbered(named.into_iter()))
                }),
                InputFormat::LandXml => {
                    // Units do not matter for what is looked at.
                    let known = Known { pick, order: None, unit: Some(LengthUnit::default()) };
                    let read = landxml::mesh(label, bytes, known, &mut notes);
                    read.map(|(vertices, faces, of_file)| {
                        said = of_file;
                        (vertices, Some(faces), (Vec::new(), Vec::new()))
                    })
                }
                InputFormat::Dxf => {
                    dxf::mesh(label, bytes, pick, &mut notes).map(|((vertices, faces, groups, names), of_file)| {
                        said = of_file;
                        (vertices, Some(faces), (groups, names.into_iter().map(layer_name).collect()))
                    })
                }
                _ => obj::load(label, bytes, &mut notes).map(|loaded| {
                    let count = loaded.faces.as_ref().map_or(0, RawFaces::len);
                    let groups = by_face(&loaded.groups, count);
                    said = loaded.spoken.said();
                    (loaded.vertices, loaded.faces, groups)
                }),
            };
            read.map(|read| (read, said, notes))
        },
    );
    let ((vertices, faces, (groups, names)), said, notes) = read?;
    source.crs = said.crs;
    source.unit = said.unit;
    let faces = faces.unwrap_or(RawFaces::Triangles(Vec::new()));
    Ok(RawMesh { source, vertices, faces, groups, names, notes })
}

/// Name of a part by its number in PLY files.
fn part_name(number: f64) -> String {
    let known = Part::ALL.into_iter().find(|part| f64::from(*part as u8) == number);
    known.map_or_else(|| format!("part {number}"), |part| part.name().to_owned())
}

/// Name of a layer, or of the part it stands for: release 12 of DXF has capitals only.
fn layer_name(layer: String) -> String {
    let part = Part::ALL.into_iter().find(|part| part.name().eq_ignore_ascii_case(&layer));
    part.map_or(layer, |part| part.name().to_owned())
}

/// The groups of faces from where each begins; none if no group begins.
fn by_face(begins: &[(usize, String)], count: usize) -> (Vec<u32>, Vec<String>) {
    if begins.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let ends = begins.iter().skip(1).map(|(at, _)| *at).chain([count]);
    let mut runs: Vec<(&str, usize)> = vec![("", begins[0].0)];
    runs.extend(begins.iter().zip(ends).map(|((at, name), end)| (name.as_str(), end.saturating_sub(*at))));
    let mut numbers: FxHashMap<String, u32> = FxHashMap::default();
    let (mut groups, mut names) = (Vec::with_capacity(count), Vec::new());
    for (name, faces) in runs.into_iter().filter(|(_, faces)| *faces > 0) {
        let name = if name.is_empty() { "(unnamed)" } else { name };
        let number = number_of(name, &mut numbers, &mut names);
        groups.extend(std::iter::repeat_n(number, faces));
    }
    (groups, names)
}

/// Numbers names in the order of their first occurrence.
fn numbered(list: impl Iterator<Item = String>) -> (Vec<u32>, Vec<String>) {
    let mut numbers = FxHashMap::default();
    let mut names = Vec::new();
    let groups = list.map(|name| number_of(&name, &mut numbers, &mut names)).collect();
    (groups, names)
}

fn number_of(name: &str, numbers: &mut FxHashMap<String, u32>, names: &mut Vec<String>) -> u32 {
    if let Some(&number) = numbers.get(name) {
        return number;
    }
    let number = names.len() as u32;
    numbers.insert(name.to_owned(), number);
    names.push(name.to_owned());
    number
}

#[cfg(test)]
mod tests {
    use super::*;

    const FOUR: &str = "v 0 0 1\nv 1 0 2\nv 1 1 3\nv 0 1 nan\n";

    fn obj(text: &str) -> RawMesh {
        parse_mesh("a.obj", text.as_bytes(), InputFormat::Obj, &Pick::default()).unwrap()
    }

    #[test]
    fn groups_of_an_obj_file() {
        let mesh = obj(&format!("o all\n{FOUR}f 1 2 3\ng a\nf 1 3 4 # x\nf 1 2 4\ng b c\ng a\nf 2 3 4\ng d\nf 1 2 3 4\n"));
        assert_eq!(mesh.names, ["(unnamed)", "a", "d"]);
        assert_eq!(mesh.groups, [0, 1, 1, 1, 2]);
        assert!(mesh.vertices[3].z.is_nan());
        let mesh = obj(&format!("o one\n{FOUR}f 1 2 3\no two\nf 1 3 4\n"));
        assert_eq!((mesh.names, mesh.groups), (vec!["one".to_owned(), "two".to_owned()], vec![0, 1]));
        let mesh = obj(&format!("{FOUR}f 1 2 3\n"));
        assert!(mesh.names.is_empty() && mesh.groups.is_empty());
        let mesh = obj(&format!("{FOUR}g a\n"));
        assert!(mesh.names.is_empty() && mesh.faces == RawFaces::Triangles(vec![]));
    }

    #[test]
    fn parts_of_a_ply_file() {
        let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n\
                      element face 4\nproperty list uchar int vertex_indices\nproperty uchar part\nend_header\n";
        let text = format!("{header}0 0 1\n1 0 2\n1 1 3\n0 1 nan\n3 0 1 2 1\n3 0 2 3 0\n3 0 1 3 9\n4 0 1 2 3 1\n");
        let mesh = parse_mesh("a.ply", text.as_bytes(), InputFormat::Ply, &Pick::default()).unwrap();
        assert_eq!(mesh.names, ["fill_slope", "platform", "part 9"]);
        assert_eq!(mesh.groups, [0, 1, 2, 0]);
    }

    #[test]
    fn unit_and_system_are_those_of_the_comments() {
        let obj = obj(&format!("# crs: EPSG:2263\n# unit: us-ft\n{FOUR}f 1 2 3\n"));
        let header = "ply\nformat ascii 1.0\ncomment crs EPSG:2263\ncomment unit us-ft\nelement vertex 3\nproperty double x\n\
                      property double y\nproperty double z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
        let text = format!("{header}0 0 1\n1 0 2\n1 1 3\n3 0 1 2\n");
        let ply = parse_mesh("a.ply", text.as_bytes(), InputFormat::Ply, &Pick::default()).unwrap();
        for mesh in [obj, ply] {
            assert_eq!(mesh.source.unit, Some(LengthUnit::UsSurveyFoot));
            assert_eq!(mesh.source.crs.as_deref(), Some("EPSG:2263"));
        }
    }

    #[test]
    fn what_is_no_mesh_is_refused() {
        let error = parse_mesh("a.csv", b"1 2 3", InputFormat::Csv, &Pick::default()).unwrap_err().to_string();
        assert_eq!(
            error,
            "the file is no mesh\n  --> a.csv\n   = its format is `csv`\n   = help: give a mesh as OBJ, PLY, LandXML or DXF"
        );
        let error = parse_mesh("a.obj", b"v 0 0 0\nf 1 1 2\n", InputFormat::Obj, &Pick::default()).unwrap_err().to_string();
        assert!(error.contains("line 2"));
    }
}
