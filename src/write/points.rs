//! Points as CSV.

use super::EncodeError;
use super::number::push_f64;
use super::obj::flush_if_full;
use glam::DVec3;
use std::io::Write;

/// Writes points as CSV: a header `x,y,z`, then a row per point in world coordinates, in the order given, with the shortest
/// digits that read back to the same bits.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a point with a coordinate that is no number.
pub fn write_points(out: &mut (impl Write + ?Sized), points: impl IntoIterator<Item = DVec3>) -> Result<(), EncodeError> {
    let mut bytes = b"x,y,z\n".to_vec();
    for (i, point) in points.into_iter().enumerate() {
        for (k, value) in point.to_array().into_iter().enumerate() {
            if !value.is_finite() {
                return Err(EncodeError::NotFinite { what: "point", index: i + 1, value });
            }
            push_f64(&mut bytes, value);
            bytes.push(if k < 2 { b',' } else { b'\n' });
        }
        flush_if_full(out, &mut bytes)?;
    }
    out.write_all(&bytes)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_are_as_documented() {
        let mut bytes = Vec::new();
        write_points(&mut bytes, [DVec3::new(500_000.1, -2.0, 0.1 + 0.2), DVec3::ZERO]).unwrap();
        assert_eq!(String::from_utf8(bytes).unwrap(), "x,y,z\n500000.1,-2,0.30000000000000004\n0,0,0\n");
    }

    #[test]
    fn a_number_that_is_none_is_refused() {
        let points = [DVec3::ZERO, DVec3::NAN];
        assert!(matches!(write_points(&mut Vec::new(), points), Err(EncodeError::NotFinite { what: "point", index: 2, .. })));
    }
}
