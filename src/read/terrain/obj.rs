//! Wavefront OBJ: vertices and faces in the order of the file, by own code.
//!
//! Lines are read ([`lines`]) by several threads, stretch by stretch; vertex numbers that count back get their meaning when the
//! stretches are put together. A line that is wrong is looked at again ([`diagnose`]).

mod diagnose;
mod lines;
mod text;

use super::comments::Spoken;
use super::{Faces, RawFaces, RawGround, Said};
use crate::model::Note;
use crate::read::ReadError;
use crate::read::error::refuse;
use glam::DVec3;
use std::borrow::Cow;

pub(super) fn read(label: &str, bytes: &[u8], notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let Loaded { vertices, faces, spoken, .. } = load(label, bytes, notes)?;
    if let Some(at) = vertices.iter().position(|p| !p.is_finite()) {
        return Err(diagnose::not_finite(label, &text::with_line_ends(bytes), at));
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
    let mut bytes = Cow::Borrowed(bytes);
    let mut parts = lines::read(&bytes);
    // Lines that end in other ways, or go on in the next: hardly any file has them, and none without a sign of it.
    let odd =
        parts.as_ref().map_or(true, |parts| parts.iter().any(|part| part.odd) || parts.iter().all(|p| p.vertices.is_empty()));
    if odd && let Cow::Owned(text) = text::with_line_ends(&bytes) {
        parts = lines::read(&text);
        bytes = Cow::Owned(text);
    }
    let parts = parts.map_err(|at| diagnose::wrong_line(label, &bytes, at))?;
    let count: usize = parts.iter().map(|part| part.vertices.len()).sum();
    if count == 0 {
        let figures = "no line begins with `v`";
        return Err(refuse("the OBJ file has no vertices", label, figures, "give a mesh, or points with elevations"));
    }
    if u32::try_from(count).is_err() {
        return Err(refuse("the OBJ file has too many vertices", label, format!("{count}"), "cut the ground down to the site"));
    }
    let skipped: usize = parts.iter().map(|part| part.skipped).sum();
    if skipped > 0 {
        let message = format!("{skipped} lines with points or polylines (`p`, `l`) were passed over: they are no faces");
        notes.push(Note::new("obj-lines-ignored", message));
    }
    let mut vertices: Vec<DVec3> = Vec::with_capacity(count);
    let mut faces = Faces::with_capacity(parts.iter().map(|part| part.faces.len()).sum());
    let mut groups = [Vec::new(), Vec::new()];
    for mut part in parts {
        let there = part.place_relative(vertices.len());
        if !there || part.missing || part.highest as usize >= count {
            return Err(diagnose::missing(label, &bytes));
        }
        for (all, some) in groups.iter_mut().zip(part.groups) {
            all.extend(some.into_iter().map(|(before, name)| (faces.len() + before, name)));
        }
        vertices.append(&mut part.vertices);
        faces.append(part.faces);
    }
    let spoken = Spoken::of_obj(&bytes);
    spoken.place(&mut vertices, notes);
    let [groups, objects] = groups;
    let groups = if groups.is_empty() { objects } else { groups };
    Ok(Loaded { vertices, faces: Some(faces).filter(|faces| faces.len() > 0).map(Faces::finish), groups, spoken })
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

    /// The corners of all faces as `tobj` reads them, as bits: it numbers vertices anew.
    fn by_tobj(text: &str) -> Vec<Vec<[u64; 3]>> {
        let options = tobj::LoadOptions { single_index: false, triangulate: false, ignore_points: true, ignore_lines: true };
        let (models, _) = tobj::load_obj_buf(&mut text.as_bytes(), &options, |_| Ok(Default::default())).unwrap();
        let of_mesh = |mesh: &tobj::Mesh| {
            let (points, _) = mesh.positions.as_chunks::<3>();
            let mut rest = mesh.indices.as_slice();
            let mut faces = Vec::new();
            while !rest.is_empty() {
                let corners = mesh.face_arities.get(faces.len()).map_or(3, |&n| n as usize);
                let (face, after) = rest.split_at(corners);
                faces.push(face.iter().map(|&v| points[v as usize].map(f64::to_bits)).collect());
                rest = after;
            }
            faces
        };
        models.iter().flat_map(|model| of_mesh(&model.mesh)).collect()
    }

    /// The same from our reader.
    fn by_us(text: &str) -> Vec<Vec<[u64; 3]>> {
        let (vertices, faces) = ok(text);
        let of_face = |face: &[u32]| face.iter().map(|&v| vertices[v as usize].to_array().map(f64::to_bits)).collect();
        match faces {
            RawFaces::Triangles(triangles) => triangles.iter().map(|t| of_face(t)).collect(),
            RawFaces::Polygons { corners, ends } => {
                let begins = std::iter::once(0).chain(ends.iter().copied());
                begins.zip(&ends).map(|(from, &to)| of_face(&corners[from..to])).collect()
            }
        }
    }

    /// Several stretches of lines with all spellings of numbers and corners, counted forwards and back across the borders of the
    /// stretches; `tobj` is of another opinion nowhere.
    #[test]
    fn another_reader_reads_the_same() {
        use std::fmt::Write as _;
        let mut text = String::new();
        let mut state = 1_u64;
        let mut random = |n: u64| {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (state >> 33) % n
        };
        let mut count = 0_u64;
        for i in 0..60_000 {
            let [x, y, z] = [random(1 << 40), random(1 << 50), random(1 << 20)].map(|v| v as f64 / 1e4 - 1e5);
            let _ = match random(6) {
                0 => writeln!(text, "v {x} {y} {z}"),
                1 => writeln!(text, "v {x:.3} {y:e} {z:.1}"),
                2 => writeln!(text, "v  {x:+}\t{y:.0} {z:.17}  "),
                _ => writeln!(text, "v {x:.4} {y:.4} {z:.4}"),
            };
            count += 1;
            if i % 1000 == 0 {
                let _ = writeln!(text, "# {i}\nvn 0 0 1\nvt 0.5 0.5\nusemtl a{i}\no b{i}");
            }
            if count > 5 {
                let corners = if random(20) == 0 { 4 + random(2) } else { 3 };
                text.push('f');
                for _ in 0..corners {
                    let v = random(count) + 1;
                    let back = (count - v + 1) as i64;
                    let _ = match random(5) {
                        0 => write!(text, " -{back}"),
                        1 => write!(text, " {v}/1/1"),
                        2 => write!(text, " {v}//1"),
                        _ => write!(text, " {v}"),
                    };
                }
                text.push('\n');
            }
        }
        assert!(text.len() > 2 << 20, "several stretches");
        let (ours, theirs) = (by_us(&text), by_tobj(&text));
        assert_eq!(ours.len(), theirs.len());
        assert!(ours == theirs);
        let text = std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/fixtures/ground.obj")).unwrap();
        assert!(by_us(&text) == by_tobj(&text), "ground.obj");
    }

    #[test]
    fn odd_lines_are_seen_wherever_they_are() {
        let plain = ok(&format!("{FOUR}f 1 2 3\nf 1 3 4\n"));
        for text in [
            format!("# a \\\nb\n{FOUR}f 1 2 3\nf 1 3 4\n"),
            format!("# a\r{FOUR}f 1 2 3\rf 1 3 4\r"),
            format!("g a \\\nb\n{FOUR}f 1 2 3\nf 1 \\\n3\\\n4"),
            format!("{FOUR}f 1 2 3\rf 1 3 4\n"),
            format!("{FOUR}f 1 2 3\n# a\rf 1 3 4\n"),
            format!("{FOUR}f 1 2 3#a\nf 1// 3/ 4/1#\n"),
            format!("{FOUR}f +1 2 3\nf 1 3 4 \r\n"),
        ] {
            assert_eq!(ok(&text), plain, "{text:?}");
        }
        // Line numbers are those of the file.
        assert!(error(&format!("{FOUR}f 1 \\\n2 3\nf 1 3 9\n")).contains("line 7"));
    }

    #[test]
    fn numbers_beyond_all_bounds() {
        for text in ["4294967296", "4294967297", "99999999999999999999999", "-2147483649", "-99999999999999999999999"] {
            let message = error(&format!("{FOUR}f 1 2 3\nf 1 2 {text}\n"));
            assert!(message.contains("line 6") && message.contains(&format!("vertex {text}")), "{message}");
        }
        for text in ["-", "1/-", "1/2/3/4", "1/x", "1e0", "0x1", "1 2 3 é", ""] {
            let message = error(&format!("{FOUR}f {text}\n"));
            assert!(message.contains("a.obj, line 5"), "{text}: {message}");
        }
    }
}
