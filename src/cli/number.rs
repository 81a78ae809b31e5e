//! Numbers typed in as options.

use crate::model::Share;
use crate::validate::INPUT_LIMIT;
use std::ops::RangeInclusive;

/// What a number must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Rule {
    /// Any elevation or coordinate.
    Coordinate,
    /// A length above zero.
    Positive,
    /// A length not less than this.
    AtLeast(f64),
}

/// Reads a number for `option`.
///
/// # Errors
/// What is wrong, where, and what mends it, without the leading `error: `.
pub(super) fn read(option: &str, text: &str, rule: Rule) -> Result<f64, String> {
    let refuse = |what: String, help: &str| Err(format!("{what}\n  --> {option} {text}\n   = help: {help}"));
    let Ok(value) = text.trim().parse::<f64>() else {
        let help = if text.contains(',') { "write the decimals behind a point" } else { "give a number such as 12.5" };
        return refuse(format!("`{text}` is not a number"), help);
    };
    if !value.is_finite() {
        return refuse(format!("`{text}` is not a finite number"), "give a number such as 12.5");
    }
    if value.abs() > INPUT_LIMIT {
        return refuse(format!("`{text}` is too large"), &format!("give a number up to {INPUT_LIMIT:e}"));
    }
    match rule {
        Rule::Positive if value <= 0.0 => refuse(format!("`{text}` is not above zero"), "give a positive number"),
        Rule::AtLeast(least) if value < least => refuse(format!("`{text}` is too small"), &format!("give {least} or more")),
        _ => Ok(value),
    }
}

/// Reads a whole number of `things` for `option`, within a range.
///
/// # Errors
/// As [`read`].
pub(super) fn whole(option: &str, text: &str, things: &str, range: RangeInclusive<usize>) -> Result<usize, String> {
    text.trim().parse::<usize>().ok().filter(|number| range.contains(number)).ok_or_else(|| {
        let (least, most) = range.into_inner();
        format!(
            "`{text}` is not a number of {things}\n  --> {option} {text}\n   = help: give a whole number from {least} to {most}"
        )
    })
}

/// Reads a share such as `25%` for `option`, within limits.
///
/// # Errors
/// As [`read`].
pub(super) fn share(option: &str, text: &str, limits: &RangeInclusive<f64>) -> Result<f64, String> {
    let Share(value) = text.parse::<Share>().map_err(|e| format!("{}\n  --> {option} {text}\n   = help: {}", e.what, e.help))?;
    if limits.contains(&value) {
        return Ok(value);
    }
    let (least, most) = (100.0 * limits.start(), 100.0 * limits.end());
    Err(format!("`{text}` is out of range\n  --> {option} {text}\n   = help: give {least}% to {most}%"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers() {
        assert_eq!(read("--x", " -12.5 ", Rule::Coordinate), Ok(-12.5));
        assert_eq!(read("--x", "1e-3", Rule::Positive), Ok(0.001));
        assert_eq!(read("--x", "1e-6", Rule::AtLeast(1e-6)), Ok(1e-6));
        for (text, rule, what) in [
            ("twelve", Rule::Coordinate, "is not a number\n  --> --x twelve\n   = help: give a number such as 12.5"),
            ("", Rule::Coordinate, "is not a number"),
            ("0,5", Rule::Coordinate, "is not a number\n  --> --x 0,5\n   = help: write the decimals behind a point"),
            ("nan", Rule::Coordinate, "is not a finite number"),
            ("inf", Rule::Positive, "is not a finite number"),
            ("1e999", Rule::Positive, "is not a finite number"),
            ("1e10", Rule::Coordinate, "is too large"),
            ("-1e10", Rule::Coordinate, "is too large"),
            ("0", Rule::Positive, "is not above zero"),
            ("-0", Rule::Positive, "is not above zero"),
            ("-1", Rule::Positive, "is not above zero"),
            ("1e-7", Rule::AtLeast(1e-6), "is too small\n  --> --x 1e-7\n   = help: give 0.000001 or more"),
        ] {
            let error = read("--x", text, rule).unwrap_err();
            assert!(error.starts_with(&format!("`{text}` {what}")), "{error}");
        }
    }

    #[test]
    fn whole_numbers() {
        assert_eq!(whole("--threads", "4", "threads", 1..=8), Ok(4));
        for text in ["0", "9", "-1", "2.5", "four", "", "99999999999999999999999"] {
            let expected = format!(
                "`{text}` is not a number of threads\n  --> --threads {text}\n   = help: give a whole number from 1 to 8"
            );
            assert_eq!(whole("--threads", text, "threads", 1..=8), Err(expected));
        }
    }

    #[test]
    fn shares() {
        let limits = -1.0..=0.9;
        assert_eq!(share("--shrink", "10%", &limits), Ok(0.1));
        assert_eq!(share("--shrink", "-0.3", &limits), Ok(-0.3));
        for (text, expected) in [
            ("95%", "`95%` is out of range\n  --> --shrink 95%\n   = help: give -100% to 90%"),
            (
                "0.9",
                "`0.9` can be read in two ways\n  --> --shrink 0.9\n   = help: write `10%` if 0.9 is a factor, `90%` if it is a share",
            ),
            ("x", "`x` is not a share\n  --> --shrink x\n   = help: write `25%` or `0.25`"),
        ] {
            assert_eq!(share("--shrink", text, &limits), Err(expected.to_owned()));
        }
    }
}
