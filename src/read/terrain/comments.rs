//! What the comments at the head of a mesh file say about its coordinates, in the words of [`crate::write`]'s OBJ and PLY files.

use super::Said;
use crate::model::{LengthUnit, Note};
use glam::DVec3;

/// Comment lines looked at; what a program says of a file stands in its first lines.
const MOST_LINES: usize = 100;

/// Furthest origin believed, in the length unit: coordinates beyond are refused everywhere.
const FURTHEST: f64 = 1e9;

/// What was said.
#[derive(Default)]
pub(super) struct Spoken {
    pub(super) crs: Option<String>,
    pub(super) unit: Option<LengthUnit>,
    /// Point that the coordinates are counted from.
    origin: Option<DVec3>,
}

impl Spoken {
    /// The comments that an OBJ file begins with.
    pub(super) fn of_obj(bytes: &[u8]) -> Self {
        let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
        Self::of(bytes.split(|b| matches!(b, b'\n')).map_while(|line| line.strip_prefix(b"#")))
    }

    /// The comments in the header of a PLY file.
    pub(super) fn of_ply(header: &[u8]) -> Self {
        Self::of(header.split(|b| matches!(b, b'\n' | b'\r')).filter_map(|line| line.strip_prefix(b"comment ")))
    }

    fn of<'a>(comments: impl Iterator<Item = &'a [u8]>) -> Self {
        let mut spoken = Self::default();
        for comment in comments.take(MOST_LINES) {
            let Ok(comment) = std::str::from_utf8(comment) else { continue };
            let after = |word: &str| comment.trim().strip_prefix(word).map(|rest| rest.strip_prefix(':').unwrap_or(rest));
            // A word on its own, not the beginning of another.
            let after =
                |word: &str| after(word).filter(|rest| rest.starts_with(' ')).map(str::trim).filter(|rest| !rest.is_empty());
            if let Some(crs) = after("crs") {
                spoken.crs = Some(crs.to_owned());
            } else if let Some(unit) = after("unit") {
                spoken.unit = unit.parse().ok();
            } else if let Some(numbers) = after("local origin") {
                let number = |word: &str| word.parse().ok().filter(|n: &f64| n.abs() <= FURTHEST);
                let mut numbers = numbers.split_whitespace().map_while(number);
                let origin = [numbers.next(), numbers.next(), numbers.next()];
                spoken.origin = if let [Some(x), Some(y), Some(z)] = origin { Some(DVec3::new(x, y, z)) } else { None };
            }
        }
        spoken
    }

    /// Brings vertices to world coordinates, and tells that it was done.
    pub(super) fn place(&self, vertices: &mut [DVec3], notes: &mut Vec<Note>) {
        let Some(origin) = self.origin.filter(|origin| *origin != DVec3::ZERO) else { return };
        vertices.iter_mut().for_each(|v| *v += origin);
        let message = format!(
            "the mesh counts its coordinates from ({}, {}, {}), as its head says; that was added to them",
            origin.x, origin.y, origin.z
        );
        notes.push(Note::new("local-origin", message));
    }

    /// The rest of it.
    pub(super) fn said(self) -> Said {
        Said { crs: self.crs, unit: self.unit, ..Said::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_both_formats() {
        let obj = Spoken::of_obj(
            b"# slopegen 1\r\n#\n# crs: EPSG:25832\r\n# unit: us-ft\n# local origin: 1e5 -2 0 (add)\nv 1 2 3\n# crs: no\n",
        );
        let ply =
            Spoken::of_ply(b"ply\nformat ascii 1.0\ncomment crs EPSG:25832\ncomment unit us-ft\ncomment local origin 1e5 -2 0\n");
        for spoken in [obj, ply] {
            assert_eq!(spoken.origin, Some(DVec3::new(1e5, -2.0, 0.0)));
            assert_eq!((spoken.crs.as_deref(), spoken.unit), (Some("EPSG:25832"), Some(LengthUnit::UsSurveyFoot)));
        }
    }

    #[test]
    fn other_words_say_nothing() {
        for text in [
            "# crsx: a",
            "# crs:",
            "# crs",
            "# unit: meters",
            "# units: ft",
            "# local origin: 1 2",
            "# local origin: 1 x 3",
            "# local origin: 1 inf 3",
            "# local origin: 1e300 2 3",
        ] {
            let spoken = Spoken::of_obj(text.as_bytes());
            assert!(spoken.crs.is_none() && spoken.unit.is_none() && spoken.origin.is_none(), "{text}");
        }
    }

    #[test]
    fn vertices_come_back_to_the_world() {
        let spoken = Spoken::of_obj(b"# local origin: 500000 5400000 0\n");
        let (mut vertices, mut notes) = (vec![DVec3::new(0.125, 1.5, 3.0)], Vec::new());
        spoken.place(&mut vertices, &mut notes);
        assert_eq!(vertices, [DVec3::new(500_000.125, 5_400_001.5, 3.0)]);
        assert_eq!(notes[0].code, "local-origin");
        Spoken::of_obj(b"# local origin: 0 0 0\n").place(&mut vertices, &mut notes);
        assert_eq!((vertices[0].x, notes.len()), (500_000.125, 1));
    }
}
