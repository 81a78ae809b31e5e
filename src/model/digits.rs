//! Numbers in messages: as many digits as are worth reading.

/// More decimals than any number in a message needs.
pub(crate) const MOST_DECIMALS: i32 = 17;

/// Digits of a number before the decimal point, from its decimal exponent.
pub(crate) fn digits_before_point(value: f64) -> i32 {
    (value.log10().floor() as i32).saturating_add(1)
}

/// A positive number rounded to `digits` significant ones, digits before the point always kept, no zeros at the end.
pub(crate) fn rounded(value: f64, digits: i32) -> String {
    let decimals = digits.saturating_sub(digits_before_point(value)).clamp(0, MOST_DECIMALS);
    fixed(value, decimals as usize)
}

/// A number with so many decimals at most, no zeros at the end, no sign before nought.
pub(crate) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let short = if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.') } else { &text };
    if short == "-0" { "0".to_owned() } else { short.to_owned() }
}

/// A number with so many decimals, no sign before nought.
pub(crate) fn plain(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    let nought = !text.bytes().any(|b| b.is_ascii_alphabetic() || (b'1'..=b'9').contains(&b));
    match text.strip_prefix('-') {
        Some(text) if nought => text.to_owned(),
        _ => text,
    }
}

/// The same with a true minus sign, as in drawings and on pages.
pub(crate) fn typeset(value: f64, decimals: usize) -> String {
    plain(value, decimals).replace('-', "−")
}

/// A share in percent, with the digits it was typed with.
pub(crate) fn in_percent(share: f64) -> f64 {
    /// Digits that a share is typed with.
    const DIGITS: f64 = 1e10;
    (100.0 * share * DIGITS).round() / DIGITS
}

/// `1 vertex`, `2 vertices`.
pub(crate) fn counted(count: usize, one: &str, many: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { many })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 0.07 is 0.07000000000000000666…; 100 times it is 7.000000000000001 in doubles.
    #[test]
    fn percent_has_the_digits_it_was_typed_with() {
        for (share, percent) in [(0.07, "7"), (0.29, "29"), (0.005, "0.5"), (-0.14, "-14"), (1e-9, "0.0000001")] {
            assert_eq!(in_percent(share).to_string(), percent);
        }
    }

    #[test]
    fn nought_has_no_sign() {
        for (value, decimals, text) in
            [(-0.004, 2, "0.00"), (-0.0, 0, "0"), (-0.005_1, 2, "-0.01"), (-1200.0, 1, "-1200.0"), (7.0, 3, "7.000")]
        {
            assert_eq!(plain(value, decimals), text);
            assert_eq!(typeset(value, decimals), text.replace('-', "−"));
        }
        assert_eq!((plain(f64::NEG_INFINITY, 2).as_str(), plain(f64::NAN, 2).as_str()), ("-inf", "NaN"));
    }

    #[test]
    fn no_digit_that_says_nothing() {
        for (value, decimals, text) in
            [(1.5, 3, "1.5"), (-0.0001, 3, "0"), (-2.0, 3, "-2"), (100.0, 0, "100"), (1200.0, 2, "1200"), (0.125, 2, "0.12")]
        {
            assert_eq!(fixed(value, decimals), text);
        }
        for (value, digits, text) in [(1234.56, 3, "1235"), (0.012_345, 3, "0.0123"), (2.0, 4, "2"), (5e-324, 4, "0")] {
            assert_eq!(rounded(value, digits), text);
        }
    }
}
