//! Single precision: the one place where doubles lose digits, because a format holds no others.

use super::EncodeError;

/// Half the step between neighbouring single-precision numbers, as a share of their size: what rounding to them may lose.
pub const ROUNDING: f64 = 1.0 / 16_777_216.0;

/// The four bytes, little-endian, of the single-precision number nearest to `value`; `index` is the vertex, counted from 1.
///
/// # Errors
/// [`EncodeError::BeyondSingle`] where there is none, at 3.4 · 10³⁸ and beyond.
pub(crate) fn bytes(value: f64, index: usize) -> Result<[u8; 4], EncodeError> {
    let near = value as f32;
    if near.is_finite() { Ok(near.to_le_bytes()) } else { Err(EncodeError::BeyondSingle { index, value }) }
}

/// The number that four bytes made by [`bytes`] stand for.
pub(crate) fn value(bytes: [u8; 4]) -> f64 {
    f64::from(f32::from_le_bytes(bytes))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_number_and_its_error() {
        for number in [0.0, -0.0, 0.1, 1234.567, -98_765.432_1, 16_777_217.0] {
            let read = value(bytes(number, 1).unwrap());
            assert!((read - number).abs() <= ROUNDING * number.abs(), "{number} {read}");
        }
        assert_eq!(value(bytes(0.5, 1).unwrap()), 0.5);
        assert!(matches!(bytes(3.5e38, 7), Err(EncodeError::BeyondSingle { index: 7, .. })));
        assert!(bytes(f64::NAN, 1).is_err());
    }
}
