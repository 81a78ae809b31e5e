//! Numbers as text: the shortest digits that read back to the same bits, and integers, appended to a byte buffer.

/// Appends a finite number in the fewest digits that read back to the same bits. Whole numbers lose their `.0`.
///
/// The text is a JSON number as well as a number of OBJ, CSV and ASCII grid files: `12.5`, `-0`, `1e+21`, `5e-324`.
/// The caller has made sure that the number is finite; anything else gives `NaN` or `inf`.
pub fn push_f64(bytes: &mut Vec<u8>, value: f64) {
    let mut buffer = zmij::Buffer::new();
    let text = buffer.format(value).as_bytes();
    bytes.extend_from_slice(text.strip_suffix(b".0").unwrap_or(text));
}

/// Appends a whole number in decimal digits.
pub fn push_u64(bytes: &mut Vec<u8>, mut value: u64) {
    /// Digits of the largest value.
    const MOST: usize = 20;
    let mut digits = [0_u8; MOST];
    let mut at = MOST;
    loop {
        at -= 1;
        digits[at] = b'0' + (value % 10) as u8;
        value /= 10;
        if value == 0 {
            break;
        }
    }
    bytes.extend_from_slice(&digits[at..]);
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(value: f64) -> String {
        let mut bytes = Vec::new();
        push_f64(&mut bytes, value);
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn shortest_digits() {
        for (value, expected) in [
            (100.0, "100"),
            (-0.0, "-0"),
            (0.1, "0.1"),
            (4_649_776.22, "4649776.22"),
            (1e21, "1e+21"),
            (5e-324, "5e-324"),
            (0.1 + 0.2, "0.30000000000000004"),
            (f64::MAX, "1.7976931348623157e+308"),
        ] {
            assert_eq!(text(value), expected);
        }
    }

    #[test]
    fn every_number_reads_back_and_is_json() {
        // A fixed walk over bit patterns (Weyl sequence, step 2^64 / golden ratio) visits all exponents.
        let mut bits = 1_u64;
        for _ in 0..20_000 {
            bits = bits.wrapping_add(0x9E37_79B9_7F4A_7C15);
            let value = f64::from_bits(bits);
            if value.is_finite() {
                let text = text(value);
                assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
                assert!(serde_json::from_str::<serde_json::Number>(&text).is_ok(), "{text}");
            }
        }
    }

    #[test]
    fn integers_match_the_standard_library() {
        for value in [0, 9, 10, 99, 100, 4_294_967_295, u64::MAX] {
            let mut bytes = Vec::new();
            push_u64(&mut bytes, value);
            assert_eq!(bytes, value.to_string().as_bytes());
        }
    }
}
