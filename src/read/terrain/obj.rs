//! Wavefront OBJ, through `tobj`.
//!
//! `tobj` numbers the vertices of each object anew in the order of their use, drops those no face uses, takes polylines (`l`) for
//! faces, divides by a fourth coordinate, passes over lines it does not know, and names no line in its errors. So it is fed
//! ([`feed`]) with vertices and faces only, and first with one face made up of all vertices in their order: then its numbering
//! is that of the file. Where it refuses, the line is looked up afterwards ([`diagnose`]).

mod diagnose;
mod feed;

use super::comments::Spoken;
use super::{Faces, RawFaces, RawGround, Said, refuse};
use crate::model::Note;
use crate::read::ReadError;
use feed::Feed;
use glam::DVec3;

pub(super) fn read(label: &str, bytes: &[u8], notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let Loaded { vertices, faces, spoken, .. } = load(label, bytes, notes)?;
    if let Some(at) = vertices.iter().position(|p| !p.is_finite()) {
        return Err(diagnose::not_finite(label, &feed::with_line_ends(bytes), at));
    }
    let ground = match faces {
        Some(faces) => RawGround::Mesh { vertices, faces },
        None => RawGround::Points(vertices),
    };
    Ok((ground, spoken.said()))
}

/// An OBJ file as it is.
pub(super) struct Loaded {
    /// Coordinates may be no numbers.
    pub(super) vertices: Vec<DVec3>,
    pub(super) faces: Option<RawFaces>,
    /// Groups, or else objects: how many faces stand before each, and its name.
    pub(super) groups: Vec<(usize, String)>,
    /// What the comments say; the vertices are in world coordinates already.
    pub(super) spoken: Spoken,
}

/// Reads a file with whatever coordinates it has.
pub(super) fn load(label: &str, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Loaded, ReadError> {
    let bytes = feed::with_line_ends(bytes);
    let bytes = bytes.as_ref();
    let mut feed = Feed::new(label, bytes)?;
    let (count, skipped) = (feed.vertices, feed.skipped);
    if count == 0 {
        let figures = "no line begins with `v`";
        return Err(refuse("the OBJ file has no vertices", label, figures, "give a mesh, or points with elevations"));
    }
    if u32::try_from(count).is_err() {
        return Err(refuse("the OBJ file has too many vertices", label, format!("{count}"), "cut the ground down to the site"));
    }
    if skipped > 0 {
        let message = format!("{skipped} lines with points or polylines (`p`, `l`) were passed over: they are no faces");
        notes.push(Note::new("obj-lines-ignored", message));
    }
    let options = tobj::LoadOptions { single_index: false, triangulate: false, ignore_points: false, ignore_lines: false };
    let loaded = tobj::load_obj_buf(&mut feed, &options, |_| Err(tobj::LoadError::OpenFileFailed));
    let [groups, objects] = std::mem::take(&mut feed.groups);
    let groups = if groups.is_empty() { objects } else { groups };
    drop(feed);
    let mesh = match loaded.map(|(mut models, _)| models.pop()) {
        Ok(Some(model)) => model.mesh,
        Ok(None) => return Err(diagnose::explain(label, bytes, tobj::LoadError::GenericFailure)),
        Err(cause) => return Err(diagnose::explain(label, bytes, cause)),
    };
    if mesh.positions.len() != 3 * count || mesh.indices.len() < count {
        // Cannot be: the first face names every vertex once.
        return Err(diagnose::explain(label, bytes, tobj::LoadError::GenericFailure));
    }
    let (points, _) = mesh.positions.as_chunks::<3>();
    let mut vertices: Vec<DVec3> = points.iter().map(|&p| DVec3::from(p)).collect();
    let spoken = Spoken::of_obj(bytes);
    spoken.place(&mut vertices, notes);
    // The face of all vertices is dropped again.
    let corners = &mesh.indices[count..];
    let arities = mesh.face_arities.get(1..).unwrap_or(&[]);
    if corners.is_empty() {
        return Ok(Loaded { vertices, faces: None, groups, spoken });
    }
    let faces = faces(corners, arities).map_err(|face| diagnose::small_face(label, bytes, face))?;
    Ok(Loaded { vertices, faces: Some(faces), groups, spoken })
}

/// Faces of the given numbers of corners; without numbers all are triangles. The error is the first face of fewer than three.
fn faces(corners: &[u32], arities: &[u32]) -> Result<RawFaces, usize> {
    if let Some(at) = arities.iter().position(|&n| n < 3) {
        return Err(at);
    }
    if arities.iter().all(|&n| n == 3) {
        let (triangles, _) = corners.as_chunks::<3>();
        return Ok(RawFaces::Triangles(triangles.to_vec()));
    }
    let mut faces = Faces::with_capacity(0);
    let mut rest = corners;
    for &n in arities {
        let Some((face, after)) = rest.split_at_checked(n as usize) else { break };
        faces.polygon(face);
        rest = after;
    }
    Ok(faces.finish())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ok(text: &str) -> (Vec<DVec3>, RawFaces) {
        let mut notes = Vec::new();
        match read("a.obj", text.as_bytes(), &mut notes) {
            Ok((RawGround::Mesh { vertices, faces }, _)) => (vertices, faces),
            other => panic!("{text}: {:?}", other.map(|(ground, _)| ground).map_err(|e| e.to_string())),
        }
    }

    fn error(text: &str) -> String {
        read("a.obj", text.as_bytes(), &mut Vec::new()).map(|(ground, _)| ground).unwrap_err().to_string()
    }

    const FOUR: &str = "v 0 0 1\nv 1 0 2\nv 1 1 3\nv 0 1 4\n";

    #[test]
    fn order_of_the_file_is_kept() {
        let (vertices, faces) = ok(&format!("v 9 9 9\n{FOUR}g a\nf 5 4 3\ng b\nusemtl c\nf 3 2 5\n"));
        assert_eq!(vertices.iter().map(|v| v.z).collect::<Vec<_>>(), [9.0, 1.0, 2.0, 3.0, 4.0]);
        assert_eq!(faces, RawFaces::Triangles(vec![[4, 3, 2], [2, 1, 4]]));
    }

    #[test]
    fn all_spellings_of_the_same() {
        let plain = ok(&format!("{FOUR}f 1 2 3\nf 1 3 4\n"));
        for text in [
            format!("{FOUR}f -4 -3 -2\nf -4 -2 -1"),
            format!("{FOUR}vt 0 0\nvn 0 0 1\nf 1/1/1 2/1/1 3/1/1\nf 1//1 3//1 4//1\n"),
            format!("{FOUR}f 1/-9999999999/ 2/1/ 3/1/\nf 1 3 4\n"),
            format!("mtllib b.mtl\no x\ns off\n{FOUR}\n\n  f 1 2 3 # first\nl 1 2 3\np 1\nf 1 3 4\n"),
            format!("{FOUR}f 1 2 \\\n 3\nf 1 3 4\n"),
            "# caf\u{e9}\nv 0 0 1 0.5 0.5 0.5\nv 1 0 2\nv\t1 1 3 1.0\nv 0 1 4  # c\nf 1 2 3\nf 1 3 4".into(),
            format!("{FOUR}f 1 2 3\nf 1 3 4\n").replace('\n', "\r\n"),
            format!("{FOUR}f 1 2 3\nf 1 3 4\n").replace('\n', "\r"),
        ] {
            assert_eq!(ok(&text), plain, "{text}");
        }
        let mut latin = b"# H\xF6he\no \xFCber\n".to_vec();
        latin.extend(format!("{FOUR}f 1 2 3\nf 1 3 4\n").bytes());
        assert!(read("a", &latin, &mut Vec::new()).is_ok());
    }

    #[test]
    fn few_vertices() {
        // The made-up first face has 1, 2, 3, 4 corners here.
        for (n, text) in FOUR.lines().enumerate() {
            let all: Vec<&str> = FOUR.lines().take(n + 1).collect();
            let read = read("a", all.join("\n").as_bytes(), &mut Vec::new());
            assert!(matches!(read, Ok((RawGround::Points(p), _)) if p.len() == n + 1), "{text}");
        }
        assert_eq!(ok(&format!("{FOUR}f 4 1 2 3\n")).1, RawFaces::Polygons { corners: vec![3, 0, 1, 2], ends: vec![4] });
        assert_eq!(ok("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 3 1 2\n").1, RawFaces::Triangles(vec![[2, 0, 1]]));
    }

    #[test]
    fn quads_among_triangles() {
        let (_, faces) = ok(&format!("{FOUR}v 2 2 2\nf 1 2 3\nf 1 2 3 4\nf 1 2 3 5 4\n"));
        assert_eq!(faces, RawFaces::Polygons { corners: vec![0, 1, 2, 0, 1, 2, 3, 0, 1, 2, 4, 3], ends: vec![3, 7, 12] });
    }

    #[test]
    fn errors_name_the_line() {
        for (text, line, words) in [
            (format!("{FOUR}f 1 2 3\nf 1 2 99\n"), 6, "vertex 99, the file has 4"),
            (format!("{FOUR}f 1 2 0\n"), 5, "counted from 1"),
            (format!("{FOUR}f 1 2 -5\n"), 5, "-5"),
            (format!("{FOUR}f 1 2\n"), 5, "fewer than three corners"),
            (format!("{FOUR}f 1 2 x\n"), 5, "not a whole number"),
            (format!("{FOUR}f 1.5 2 3\n"), 5, "not a whole number"),
            (format!("{FOUR}v 1 2\nf 1 2 3\n"), 5, "three numbers"),
            (format!("{FOUR}v 1,5 2 3\nf 1 2 3\n"), 5, "decimal point"),
            (format!("{FOUR}v 1 2 nan\nf 1 2 3\n"), 5, "not finite"),
            (format!("{FOUR}v 1 2 3 2.0\nf 1 2 3\n"), 5, "weight"),
            (format!("{FOUR}v 1 2 3 4 5\nf 1 2 3\n"), 5, "5 fields"),
            (format!("{FOUR}V 1 2 3\nf 1 2 3\n"), 5, "not a statement of OBJ"),
            (format!("{FOUR}f 1 2 3\n1 2 3\n"), 6, "not a statement of OBJ"),
        ] {
            let message = error(&text);
            assert!(message.contains(&format!("a.obj, line {line}")), "{text}\n{message}");
            assert!(message.contains(words), "{text}\n{message}");
        }
        assert!(error("vn 0 0 1\n").contains("no vertices"));
    }
}
