//! Numbers as the viewer reads them: little-endian single precision and indices, in base64.

use crate::write::{EncodeError, single_precision};
use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;

/// Numbers in single precision. Graphics cards take no others; figures never come from here.
///
/// # Errors
/// [`EncodeError::BeyondSingle`].
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> Result<String, EncodeError> {
    let mut bytes = Vec::new();
    for (i, value) in values.into_iter().enumerate() {
        bytes.extend(single_precision(value, i + 1)?);
    }
    Ok(STANDARD.encode(bytes))
}

/// Points about `origin` in single precision, east, north, up one after the other.
///
/// # Errors
/// [`EncodeError::BeyondSingle`].
pub(super) fn points<'a>(points: impl IntoIterator<Item = &'a DVec3>, origin: DVec3) -> Result<String, EncodeError> {
    numbers(points.into_iter().flat_map(|p| (*p - origin).to_array()))
}

/// Corners of triangles.
pub(super) fn indices(triangles: &[[u32; 3]]) -> String {
    let bytes: Vec<u8> = triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
    STANDARD.encode(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::write::from_single_precision;

    #[test]
    fn bytes_are_little_endian() {
        // 1.5 is 0x3fc00000, -2 is 0xc0000000.
        assert_eq!(STANDARD.decode(numbers([1.5, -2.0]).unwrap()).unwrap(), [0, 0, 0xc0, 0x3f, 0, 0, 0, 0xc0]);
        assert_eq!(STANDARD.decode(indices(&[[1, 256, 65536]])).unwrap(), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
        assert!(numbers([1e39]).is_err());
    }

    #[test]
    fn millions_of_metres_lose_nothing_that_shows() {
        let origin = DVec3::new(500_000.0, 5_400_000.0, 400.0);
        let bytes = STANDARD.decode(points(&[origin + DVec3::new(0.125, -250.5, 31.75)], origin).unwrap()).unwrap();
        let read: Vec<f64> = bytes.chunks_exact(4).map(|b| from_single_precision(b.try_into().unwrap())).collect();
        assert_eq!(read, [0.125, -250.5, 31.75]);
    }
}
