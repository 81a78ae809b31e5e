//! Numbers of single precision in binary files.

/// A number of single precision (IEEE 754 binary32) from its bits, as the same number in double precision.
pub(super) fn single(bits: u32) -> f64 {
    /// Smallest positive single number, 2⁻¹⁴⁹.
    const SMALLEST: f64 = f64::from_bits((1023 - 149) << 52);
    let fraction = bits & 0x7F_FFFF;
    let magnitude = match (bits >> 23) & 0xFF {
        0 => f64::from(fraction) * SMALLEST,
        255 if fraction == 0 => f64::INFINITY,
        255 => f64::NAN,
        // The exponent is biased by 127 there and by 1023 here.
        exponent => f64::from_bits((u64::from(exponent) + 1023 - 127) << 52 | u64::from(fraction) << 29),
    };
    if bits >> 31 == 1 { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn single_precision_is_widened_exactly() {
        // Bits from IEEE 754: sign, 8 bits of exponent biased by 127, 23 bits of fraction.
        for (bits, expected) in [
            (0, 0.0),
            (0x3F80_0000, 1.0),
            (0xC020_0000, -2.5),
            // 13 421 773 / 2²⁷, the nearest to 0.1.
            (0x3DCC_CCCD, 13_421_773.0 / 134_217_728.0),
            (0x4AB4_7D38, 5_914_268.0),
            (1, 2.0_f64.powi(-149)),
            (0x7F7F_FFFF, (2.0 - 2.0_f64.powi(-23)) * 2.0_f64.powi(127)),
            (0xFF80_0000, f64::NEG_INFINITY),
        ] {
            assert_eq!(single(bits), expected, "{bits:#x}");
        }
        assert!(single(0x7FC0_0000).is_nan());
        assert_eq!(single(0x8000_0000).to_bits(), (-0.0_f64).to_bits());
    }
}
