//! Wavefront OBJ.

use super::head::plain;
use super::number::{push_f64, push_u64};
use super::origin::push_point;
use super::{EncodeError, GENERATOR, Head};
use crate::model::{LengthUnit, Part, Tin};
use glam::DVec3;
use std::io::Write;

/// Bytes gathered before they go to the sink.
const CHUNK: usize = 1 << 16;
/// More than the longest line: three numbers of at most 24 characters, three indices of at most 20.
const LONGEST_LINE: usize = 128;

/// Writes a mesh as OBJ text: `v x y z` in world coordinates with the shortest digits that read back to the same bits, then
/// one group per part that occurs (`g platform`, `g fill_slope`, …) with its triangles `f a b c`, in the order of the mesh.
///
/// Comments tell the reference system (`# crs: …`), a unit that is not the metre (`# unit: ft`) and, where there is one, the
/// local origin that the coordinates are counted from.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a vertex with a coordinate that is no number.
pub fn write_obj(out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
    writeln!(out, "# {GENERATOR}")?;
    if let Some(crs) = head.crs {
        // A backslash at its end would join the next line to the comment.
        writeln!(out, "# crs: {}", plain(crs).trim_end_matches(['\\', ' ']))?;
    }
    if head.unit != LengthUnit::Metre {
        writeln!(out, "# unit: {}", head.unit)?;
    }
    let mut bytes = Vec::with_capacity(CHUNK + LONGEST_LINE);
    if let Some(origin) = head.origin {
        bytes.extend_from_slice(b"# local origin: ");
        push_point(&mut bytes, origin, b" ");
        bytes.extend_from_slice(b" (add it to get world coordinates)\n");
    }
    bytes.extend_from_slice(format!("# {} vertices, {} triangles\n", tin.vertices.len(), tin.triangles.len()).as_bytes());
    let origin = head.origin.unwrap_or_default();
    for i in 0..tin.vertices.len() {
        bytes.push(b'v');
        for value in finite_vertex(tin, i, origin)? {
            bytes.push(b' ');
            push_f64(&mut bytes, value);
        }
        bytes.push(b'\n');
        flush_if_full(out, &mut bytes)?;
    }
    for part in Part::ALL {
        let mut group_open = false;
        for (triangle, _) in tin.triangles.iter().zip(&tin.parts).filter(|(_, p)| **p == part) {
            if !group_open {
                bytes.extend_from_slice(b"g ");
                bytes.extend_from_slice(part.name().as_bytes());
                bytes.push(b'\n');
                group_open = true;
            }
            bytes.push(b'f');
            for &corner in triangle {
                bytes.push(b' ');
                push_u64(&mut bytes, u64::from(corner) + 1);
            }
            bytes.push(b'\n');
            flush_if_full(out, &mut bytes)?;
        }
    }
    out.write_all(&bytes)?;
    Ok(())
}

/// Vertex `i` about an origin given in world coordinates, proved finite.
pub(super) fn finite_vertex(tin: &Tin, i: usize, origin: DVec3) -> Result<[f64; 3], EncodeError> {
    let p = tin.world(i) - origin;
    if p.is_finite() {
        return Ok(p.to_array());
    }
    let value = p.to_array().into_iter().find(|v| !v.is_finite()).unwrap_or(f64::NAN);
    Err(EncodeError::NotFinite { what: "vertex", index: i + 1, value })
}

/// Hands the buffer to the sink once it holds a chunk.
pub(super) fn flush_if_full(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>) -> std::io::Result<()> {
    if bytes.len() >= CHUNK {
        out.write_all(bytes)?;
        bytes.clear();
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::testing::{awkward_tin, read_obj};

    #[test]
    fn text_is_as_documented() {
        let mut tin = awkward_tin(2);
        tin.frame = crate::kernel::frame::Frame::WORLD;
        tin.vertices = [[0.0, 0.0, 100.0], [1.5, 0.0, 1e21], [0.0, 0.1, -0.25], [5e-324, 7.0, 1.0]].map(Into::into).to_vec();
        tin.triangles = vec![[0, 1, 2], [3, 2, 1], [0, 2, 3]];
        tin.parts = vec![Part::FillSlope, Part::Platform, Part::FillSlope];
        let mut bytes = Vec::new();
        write_obj(&mut bytes, &tin, &Head::default()).unwrap();
        let expected = format!(
            "# {GENERATOR}\n# 4 vertices, 3 triangles\nv 0 0 100\nv 1.5 0 1e+21\nv 0 0.1 -0.25\nv 5e-324 7 1\n\
             g platform\nf 4 3 2\ng fill_slope\nf 1 2 3\nf 1 3 4\n"
        );
        assert_eq!(String::from_utf8(bytes).unwrap(), expected);
    }

    #[test]
    fn round_trip_is_bit_exact() {
        // Large enough for several chunks.
        let tin = awkward_tin(120);
        let mut bytes = Vec::new();
        write_obj(&mut bytes, &tin, &Head::default()).unwrap();
        assert!(bytes.len() > 3 * CHUNK);
        let (vertices, faces) = read_obj(&bytes);
        let expected: Vec<[u64; 3]> = (0..tin.vertices.len()).map(|i| tin.world(i).to_array().map(f64::to_bits)).collect();
        assert_eq!(vertices, expected);
        let mut sorted: Vec<_> = tin.triangles.iter().zip(&tin.parts).map(|(t, p)| (*p as u8, *t)).collect();
        sorted.sort_by_key(|(p, _)| *p);
        assert_eq!(faces, sorted);
    }

    #[test]
    fn a_number_that_is_none_is_refused() {
        let mut tin = awkward_tin(3);
        tin.vertices[4].z = f64::NAN;
        let error = write_obj(&mut Vec::new(), &tin, &Head::default()).unwrap_err();
        assert!(matches!(error, EncodeError::NotFinite { what: "vertex", index: 5, .. }), "{error}");
    }
}
