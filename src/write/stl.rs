//! STL, binary.

use super::obj::{finite_vertex, flush_if_full};
use super::origin::{around, push_point};
use super::{EncodeError, GENERATOR, Head, palette, single};
use crate::model::{Part, Tin};
use glam::DVec3;
use std::io::Write;

/// Bytes before the number of triangles.
const HEADER: usize = 80;

/// Writes a mesh as binary STL, in its order: per triangle its normal and three corners in single precision, about
/// [`Head::origin`] or else [`around`] the mesh; the header tells that origin. The two bytes after each triangle hold the
/// colour of its part the way VisCAM and SolidView do: a set bit, then 5 bits each of red, green and blue.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a vertex with a coordinate that is no number,
/// [`EncodeError::BeyondSingle`] for one too large for the format, [`EncodeError::TooMany`] for more triangles than it counts.
pub fn write_stl(out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
    let count = tin.triangles.len();
    let Ok(short) = u32::try_from(count) else {
        return Err(EncodeError::TooMany { what: "triangles", count, most: u32::MAX as usize });
    };
    let origin = head.origin.unwrap_or_else(|| around([tin]));
    let mut bytes = header(head, origin);
    bytes.extend_from_slice(&short.to_le_bytes());
    let colours = Part::ALL.map(|part| colour(palette::of_part(part)).to_le_bytes());
    for (triangle, part) in tin.triangles.iter().zip(&tin.parts) {
        let mut corners = [DVec3::ZERO; 3];
        for (corner, &v) in corners.iter_mut().zip(triangle) {
            *corner = finite_vertex(tin, v as usize, origin)?.into();
        }
        let [a, b, c] = corners;
        let normal = (b - a).cross(c - a).normalize_or_zero();
        for (k, point) in [normal, a, b, c].into_iter().enumerate() {
            let vertex = triangle[k.saturating_sub(1)] as usize + 1;
            for value in point.to_array() {
                bytes.extend_from_slice(&single::bytes(value, vertex)?);
            }
        }
        bytes.extend_from_slice(&colours[*part as usize]);
        flush_if_full(out, &mut bytes)?;
    }
    out.write_all(&bytes)?;
    Ok(())
}

/// The header: program, unit and origin, filled with blanks. It must not begin with `solid`, the first word of STL as text. An
/// origin that does not fit is left out, not cut short.
fn header(head: &Head<'_>, origin: DVec3) -> Vec<u8> {
    let mut bytes = format!("{GENERATOR} binary STL").into_bytes();
    let mut place = format!(", unit {}, local origin ", head.unit).into_bytes();
    push_point(&mut place, origin, b" ");
    if bytes.len() + place.len() <= HEADER {
        bytes.append(&mut place);
    }
    bytes.resize(HEADER, b' ');
    bytes
}

/// A colour in 15 bits, the sixteenth set.
fn colour([red, green, blue]: palette::Rgb) -> u16 {
    let five = |value: u8| u16::from(value >> 3);
    0x8000 | five(red) << 10 | five(green) << 5 | five(blue)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;

    fn square() -> Tin {
        let vertices = [[500_012.3, 5_400_100.7, 401.0], [500_112.3, 5_400_100.7, 401.0], [500_112.3, 5_400_200.7, 402.5]];
        Tin {
            frame: Frame::WORLD,
            vertices: vertices.map(DVec3::from).to_vec(),
            triangles: vec![[0, 1, 2]],
            parts: vec![Part::CutSlope],
        }
    }

    /// The header's text, and the twelve numbers and the colour of each triangle.
    fn read(bytes: &[u8]) -> (String, Vec<([f64; 12], u16)>) {
        let count = u32::from_le_bytes(bytes[80..84].try_into().unwrap()) as usize;
        assert_eq!(bytes.len(), 84 + 50 * count);
        let records = bytes[84..].chunks_exact(50).map(|record| {
            let number = |k: usize| single::value(record[4 * k..4 * k + 4].try_into().unwrap());
            (std::array::from_fn(number), u16::from_le_bytes(record[48..].try_into().unwrap()))
        });
        (String::from_utf8(bytes[..80].to_vec()).unwrap(), records.collect())
    }

    #[test]
    fn triangles_about_the_origin_that_the_header_tells() {
        let mut bytes = Vec::new();
        write_stl(&mut bytes, &square(), &Head::default()).unwrap();
        let (header, triangles) = read(&bytes);
        assert_eq!(header.trim_end(), format!("{GENERATOR} binary STL, unit m, local origin 500000 5400100 0"));
        let (numbers, colour) = triangles[0];
        // The plane rises 1.5 over 100 towards the north.
        let normal = DVec3::new(0.0, -1.5, 100.0).normalize();
        let expected = [normal.to_array(), [12.3, 0.7, 401.0], [112.3, 0.7, 401.0], [112.3, 100.7, 402.5]].concat();
        for (found, expected) in numbers.iter().zip(expected) {
            assert!((found - expected).abs() < 3e-5, "{numbers:?}");
        }
        assert_eq!(colour, 0x8000 | 25 << 10 | 9 << 5 | 7);
    }

    #[test]
    fn an_origin_that_does_not_fit_is_not_cut_short() {
        let origin = DVec3::new(-500_000.123_456_789, 0.1 + 0.2, 1e-300);
        let mut bytes = Vec::new();
        write_stl(&mut bytes, &square(), &Head { origin: Some(origin), ..Head::default() }).unwrap();
        assert_eq!(read(&bytes).0.trim_end(), format!("{GENERATOR} binary STL"));
    }

    #[test]
    fn numbers_the_format_cannot_hold_are_refused() {
        let mut tin = square();
        tin.vertices[1].z = 1e39;
        let error = write_stl(&mut Vec::new(), &tin, &Head::default()).unwrap_err();
        assert!(matches!(error, EncodeError::BeyondSingle { index: 2, .. }), "{error}");
        tin.vertices[1].z = f64::NAN;
        let error = write_stl(&mut Vec::new(), &tin, &Head::default()).unwrap_err();
        assert!(matches!(error, EncodeError::NotFinite { index: 2, .. }), "{error}");
    }
}
