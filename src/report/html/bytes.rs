//! Numbers as the viewer reads them: little-endian single precision and indices, in base64.

use base64::Engine as _;
use base64::engine::general_purpose::STANDARD;
use glam::DVec3;

/// The one place where doubles lose digits: graphics cards take no others. Figures never come from here.
fn single(value: f64) -> [u8; 4] {
    (value as f32).to_le_bytes()
}

/// Numbers in single precision.
pub(super) fn numbers(values: impl IntoIterator<Item = f64>) -> String {
    let bytes: Vec<u8> = values.into_iter().flat_map(single).collect();
    STANDARD.encode(bytes)
}

/// Points about `origin` in single precision, east, north, up one after the other.
pub(super) fn points<'a>(points: impl IntoIterator<Item = &'a DVec3>, origin: DVec3) -> String {
    numbers(points.into_iter().flat_map(|p| (*p - origin).to_array()))
}

/// Corners of triangles.
pub(super) fn indices(triangles: &[[u32; 3]]) -> String {
    let bytes: Vec<u8> = triangles.iter().flatten().flat_map(|i| i.to_le_bytes()).collect();
    STANDARD.encode(bytes)
}

/// For tests: the number of four bytes.
#[cfg(test)]
pub(super) fn double(bytes: [u8; 4]) -> f64 {
    f64::from(f32::from_le_bytes(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_are_little_endian() {
        // 1.5 is 0x3fc00000, -2 is 0xc0000000.
        assert_eq!(STANDARD.decode(numbers([1.5, -2.0])).unwrap(), [0, 0, 0xc0, 0x3f, 0, 0, 0, 0xc0]);
        assert_eq!(STANDARD.decode(indices(&[[1, 256, 65536]])).unwrap(), [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0]);
    }

    #[test]
    fn millions_of_metres_lose_nothing_that_shows() {
        let origin = DVec3::new(500_000.0, 5_400_000.0, 400.0);
        let bytes = STANDARD.decode(points(&[origin + DVec3::new(0.125, -250.5, 31.75)], origin)).unwrap();
        let read: Vec<f64> = bytes.chunks_exact(4).map(|b| double(b.try_into().unwrap())).collect();
        assert_eq!(read, [0.125, -250.5, 31.75]);
    }
}
