//! Stanford PLY, binary little-endian.

use super::head::plain;
use super::obj::{finite_vertex, flush_if_full};
use super::origin::push_point;
use super::{EncodeError, GENERATOR, Head};
use crate::model::{LengthUnit, Part, Tin};
use std::io::Write;

/// Writes a mesh as binary little-endian PLY: vertices as three doubles in world coordinates, faces as a list of three `int`
/// indices followed by the `uchar` property `part`, in the order of the mesh. Comments name the parts, the
/// reference system (`comment crs …`), a unit that is not the metre and, where there is one, the local origin.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a vertex with a coordinate that is no number,
/// [`EncodeError::TooMany`] when the indices do not fit the format's `int`.
pub fn write_ply(out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
    let most = i32::MAX as usize;
    if tin.vertices.len() > most {
        return Err(EncodeError::TooMany { what: "vertices", count: tin.vertices.len(), most });
    }
    let mut bytes = header(tin, head);
    let origin = head.origin.unwrap_or_default();
    for i in 0..tin.vertices.len() {
        let [x, y, z] = finite_vertex(tin, i, origin)?;
        let mut record = [0_u8; 24];
        record[..8].copy_from_slice(&x.to_le_bytes());
        record[8..16].copy_from_slice(&y.to_le_bytes());
        record[16..].copy_from_slice(&z.to_le_bytes());
        bytes.extend_from_slice(&record);
        flush_if_full(out, &mut bytes)?;
    }
    for (triangle, part) in tin.triangles.iter().zip(&tin.parts) {
        let mut record = [3_u8; 14];
        record[1..5].copy_from_slice(&triangle[0].to_le_bytes());
        record[5..9].copy_from_slice(&triangle[1].to_le_bytes());
        record[9..13].copy_from_slice(&triangle[2].to_le_bytes());
        record[13] = *part as u8;
        bytes.extend_from_slice(&record);
        flush_if_full(out, &mut bytes)?;
    }
    out.write_all(&bytes)?;
    Ok(())
}

/// Everything up to and including the `end_header` line.
fn header(tin: &Tin, head: &Head<'_>) -> Vec<u8> {
    let mut bytes = format!("ply\nformat binary_little_endian 1.0\ncomment {GENERATOR}\n").into_bytes();
    if let Some(crs) = head.crs {
        // Some readers look for the word that ends the header wherever it stands.
        bytes.extend_from_slice(format!("comment crs {}\n", plain(crs).replace("end_header", "end header")).as_bytes());
    }
    if head.unit != LengthUnit::Metre {
        bytes.extend_from_slice(format!("comment unit {}\n", head.unit).as_bytes());
    }
    if let Some(origin) = head.origin {
        bytes.extend_from_slice(b"comment local origin ");
        push_point(&mut bytes, origin, b" ");
        bytes.push(b'\n');
    }
    let parts: String = Part::ALL.iter().map(|p| format!("comment part {} {}\n", *p as u8, p.name())).collect();
    let elements = format!(
        "{parts}element vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
         element face {}\nproperty list uchar int vertex_indices\nproperty uchar part\nend_header\n",
        tin.vertices.len(),
        tin.triangles.len(),
    );
    bytes.extend_from_slice(elements.as_bytes());
    bytes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::testing::{awkward_tin, read_ply};

    #[test]
    fn round_trip_is_bit_exact() {
        let tin = awkward_tin(120);
        let mut bytes = Vec::new();
        write_ply(&mut bytes, &tin, &Head::default()).unwrap();
        let (vertices, faces) = read_ply(&bytes);
        let expected: Vec<[u64; 3]> = (0..tin.vertices.len()).map(|i| tin.world(i).to_array().map(f64::to_bits)).collect();
        assert_eq!(vertices, expected);
        assert_eq!(faces, tin.triangles.iter().zip(&tin.parts).map(|(t, p)| (*p as u8, *t)).collect::<Vec<_>>());
    }

    #[test]
    fn header_names_program_and_parts() {
        let mut bytes = Vec::new();
        write_ply(&mut bytes, &awkward_tin(1), &Head::default()).unwrap();
        let expected = format!(
            "ply\nformat binary_little_endian 1.0\ncomment {GENERATOR}\ncomment part 0 platform\ncomment part 1 fill_slope\n\
             comment part 2 cut_slope\ncomment part 3 ground\nelement vertex 4\n"
        );
        assert!(bytes.starts_with(expected.as_bytes()));
    }

    #[test]
    fn a_number_that_is_none_is_refused() {
        let mut tin = awkward_tin(3);
        tin.vertices[0].x = f64::INFINITY;
        assert!(matches!(write_ply(&mut Vec::new(), &tin, &Head::default()), Err(EncodeError::NotFinite { index: 1, .. })));
    }
}
