//! Numbers in text, fast.

/// Powers of ten that are doubles.
const POWERS: [f64; 23] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21,
    1e22,
];

/// Whole numbers up to this are doubles.
const WHOLE: u64 = 1 << 53;

/// Reads a decimal number, correctly rounded; also the words of [`f64::from_str`] for infinity and no number.
///
/// Numbers of few digits without exponent are one whole number divided by one power of ten, both of them doubles: one rounding
/// (W. D. Clinger, "How to read floating point numbers accurately", PLDI 1990). All others go through the standard library.
///
/// [`f64::from_str`]: std::str::FromStr::from_str
#[inline]
pub(super) fn number(text: &[u8]) -> Option<f64> {
    plain(text).or_else(|| std::str::from_utf8(text).ok()?.parse().ok())
}

/// Reads a plain decimal number at the beginning of a text that goes on with a blank, or ends there: the number and its length.
/// `None` for all that [`number`] has another way for.
#[inline]
pub(super) fn leading(text: &[u8]) -> Option<(f64, usize)> {
    let digit = |at: usize| text.get(at).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10);
    let negative = text.first() == Some(&b'-');
    let begin = usize::from(negative);
    let mut at = begin;
    let mut mantissa = 0_u64;
    while let Some(digit) = digit(at) {
        mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        at += 1;
    }
    let mut count = at - begin;
    let mut decimals = 0;
    if text.get(at) == Some(&b'.') {
        at += 1;
        let from = at;
        while let Some(digit) = digit(at) {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
            at += 1;
        }
        decimals = at - from;
        count += decimals;
    }
    if text.get(at).is_some_and(|b| *b > b' ') || count == 0 || count > 19 || mantissa > WHOLE {
        return None;
    }
    let value = mantissa as f64 / POWERS[decimals];
    Some((if negative { -value } else { value }, at))
}

#[inline]
fn plain(text: &[u8]) -> Option<f64> {
    let (negative, digits) = match text {
        [b'-', rest @ ..] => (true, rest),
        _ => (false, text),
    };
    // Nineteen digits cannot overflow; one more byte for the point.
    if digits.len() > 20 {
        return None;
    }
    let mut mantissa = 0_u64;
    let mut point = None;
    for (i, &byte) in digits.iter().enumerate() {
        let digit = byte.wrapping_sub(b'0');
        if digit < 10 {
            mantissa = mantissa.wrapping_mul(10).wrapping_add(u64::from(digit));
        } else if byte == b'.' && point.is_none() {
            point = Some(i);
        } else {
            return None;
        }
    }
    let count = digits.len() - usize::from(point.is_some());
    let decimals = point.map_or(0, |at| digits.len() - at - 1);
    if count == 0 || count > 19 || mantissa > WHOLE {
        return None;
    }
    let value = mantissa as f64 / POWERS[decimals];
    Some(if negative { -value } else { value })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_standard_library_to_the_bit() {
        let mut texts: Vec<String> = ["0", "-0", "-0.0", ".5", "5.", "+1.5", "1e5", "-1.25E-3", "9007199254740993", "inf", "NaN"]
            .map(String::from)
            .to_vec();
        texts.extend(
            ["9007199254740992.0", "0.1", "123456789012345678901234567890", "1234567890.123456789", "4.35"].map(String::from),
        );
        texts.extend((0..20_000_i64).map(|i| format!("{}.{:04}", 1_757_000 + i * 7, (i * 6007) % 10_000)));
        texts.extend((0..2000).map(|i| format!("{}", f64::from(i) * 0.1 + 1e-7)));
        for text in texts {
            let (ours, theirs) = (number(text.as_bytes()).unwrap(), text.parse::<f64>().unwrap());
            assert_eq!(ours.to_bits(), theirs.to_bits(), "{text}");
            for after in ["", " 7", "\n"] {
                if let Some((value, length)) = leading(format!("{text}{after}").as_bytes()) {
                    assert_eq!((value.to_bits(), length), (theirs.to_bits(), text.len()), "{text}");
                }
            }
        }
        assert_eq!(leading(b"-12.50 3"), Some((-12.5, 6)));
        for text in ["", ".", "-", "1,5", "1.2.3", "0x10", "1 2", "é", "--1"] {
            assert_eq!(number(text.as_bytes()), None, "{text}");
            assert!(leading(text.as_bytes()).is_none_or(|(_, length)| length < text.len()), "{text}");
        }
    }
}
