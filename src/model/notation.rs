//! How slopes are typed in.

use super::Slope;
use super::digits::rounded;
use std::str::FromStr;

/// Why a typed slope was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SlopeError {
    /// Nothing was given.
    #[error("the slope is empty\n   = help: write `1:1.5`, `2H:1V`, `1in2`, `50%` or `26.57deg`")]
    Empty,
    /// Not one of the notations.
    #[error("`{0}` is not a slope\n   = help: write `1:1.5`, `2H:1V`, `1in2`, `50%` or `26.57deg`")]
    NotUnderstood(String),
    /// A number that does not say what it is.
    #[error("`{0}` does not say which kind of slope it is\n   = help: write {spelt}", spelt = spellings(.0))]
    BareNumber(String),
    /// A ratio that the trades read in opposite ways.
    #[error(
        "`{given}` is ambiguous\n   = it may mean {0}° or {1}°\n   = help: write `{a}V:{b}H` or `{a}H:{b}V`",
        angle(.a, .b),
        angle(.b, .a)
    )]
    Ambiguous {
        /// As typed.
        given: String,
        /// First number of the ratio.
        a: f64,
        /// Second number of the ratio.
        b: f64,
    },
    /// Zero or less.
    #[error("`{0}` is not a positive slope\n   = help: give the steepness; `--direction` says whether it falls or rises")]
    NotPositive(String),
    /// A right angle or more.
    #[error("`{0}` is not less than a right angle\n   = help: give an angle against the horizontal between 0.006° and 89.994°")]
    Vertical(String),
    /// Steeper or flatter than [`Slope::ACCEPTED`].
    #[error(
        "`{given}` is a slope of {ratio} rise per run, outside the limits\n   \
         = help: give one between 1V:10000H and 10000V:1H"
    )]
    OutOfRange {
        /// As typed.
        given: String,
        /// What it means: rise per run.
        ratio: f64,
    },
}

/// What a bare number may mean, as far as that is a slope.
fn spellings(number: &str) -> String {
    let all = [format!("{number}V:1H"), format!("{number}H:1V"), format!("{number}%"), format!("{number}deg")];
    let some: Vec<String> = all.iter().filter(|text| text.parse::<Slope>().is_ok()).map(|text| format!("`{text}`")).collect();
    match some.as_slice() {
        [] => "a slope between 1V:10000H and 10000V:1H, such as `1:1.5`".to_owned(),
        [one] => one.clone(),
        [before @ .., last] => format!("{} or {last}", before.join(", ")),
    }
}

fn angle(rise: &f64, run: &f64) -> String {
    rounded((rise / run).atan().to_degrees(), 4)
}

impl FromStr for Slope {
    type Err = SlopeError;

    /// Reads a slope: `1:n` with n ≥ 1 is vertical to horizontal and `n:1` with n > 1 horizontal to vertical, as both are
    /// written in practice; `1V:2H`, `2H:1V`, `1in2`, `50%`, `26.565deg`, `26.565°` say what they are. Blanks and case do not
    /// matter, a comma may stand for the decimal point.
    ///
    /// # Errors
    /// [`SlopeError`], in words for the person who typed it.
    fn from_str(given: &str) -> Result<Self, SlopeError> {
        let ratio = read(given)?;
        if Self::ACCEPTED.contains(&ratio) {
            Self::from_ratio(ratio).ok_or_else(|| SlopeError::NotPositive(given.trim().into()))
        } else {
            Err(SlopeError::OutOfRange { given: given.trim().into(), ratio })
        }
    }
}

/// Rise per run of a typed slope, positive.
fn read(given: &str) -> Result<f64, SlopeError> {
    let text: String = given.chars().filter(|c| !c.is_whitespace()).collect::<String>().to_lowercase();
    let given = given.trim().to_owned();
    if text.is_empty() {
        return Err(SlopeError::Empty);
    }
    if let Some(percent) = text.strip_suffix('%') {
        return Ok(positive(percent, &given)? / 100.0);
    }
    if let Some(degrees) = text.strip_suffix("deg").or_else(|| text.strip_suffix('°')) {
        let degrees = positive(degrees, &given)?;
        return if degrees < 90.0 { Ok(degrees.to_radians().tan()) } else { Err(SlopeError::Vertical(given)) };
    }
    if let Some((rise, run)) = text.split_once("in") {
        return Ok(positive(rise, &given)? / positive(run, &given)?);
    }
    let Some((first, second)) = text.split_once(':') else {
        let number = positive(&text, &given)?;
        return Err(SlopeError::BareNumber(number.to_string()));
    };
    if let (Some(rise), Some(run)) = (first.strip_suffix('v'), second.strip_suffix('h')) {
        return Ok(positive(rise, &given)? / positive(run, &given)?);
    }
    if let (Some(run), Some(rise)) = (first.strip_suffix('h'), second.strip_suffix('v')) {
        return Ok(positive(rise, &given)? / positive(run, &given)?);
    }
    let (a, b) = (positive(first, &given)?, positive(second, &given)?);
    if a == 1.0 && b >= 1.0 {
        Ok(1.0 / b)
    } else if b == 1.0 && a > 1.0 {
        Ok(1.0 / a)
    } else {
        Err(SlopeError::Ambiguous { given, a, b })
    }
}

/// A positive number with a decimal point or comma; `given` is the whole slope, for the message.
fn positive(text: &str, given: &str) -> Result<f64, SlopeError> {
    let not_understood = || SlopeError::NotUnderstood(given.to_owned());
    // The words `inf` and `nan`, and digit grouping such as 1,234.5, are not taken for numbers.
    let plausible = text.chars().all(|c| c.is_ascii_digit() || ".,+-e".contains(c));
    if !plausible || text.matches(['.', ',']).count() > 1 {
        return Err(not_understood());
    }
    let number: f64 = text.replace(',', ".").parse().map_err(|_| not_understood())?;
    if !number.is_finite() {
        return Err(not_understood());
    }
    if number <= 0.0 {
        return Err(SlopeError::NotPositive(given.to_owned()));
    }
    Ok(number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Result<f64, SlopeError> {
        text.parse::<Slope>().map(Slope::ratio)
    }

    #[test]
    fn all_notations() {
        let atan_half = 0.5_f64.atan().to_degrees();
        for (text, expected) in [
            ("1:1.5", 1.0 / 1.5),
            ("1:1,5", 1.0 / 1.5),
            ("1:1", 1.0),
            ("1:2", 0.5),
            ("2:1", 0.5),
            ("1.5:1", 1.0 / 1.5),
            (" 1 : 2 ", 0.5),
            ("1V:2H", 0.5),
            ("2v:1h", 2.0),
            ("2H:1V", 0.5),
            ("1H:2V", 2.0),
            ("1V:0.5H", 2.0),
            ("0,5V:1H", 0.5),
            ("3V:2H", 1.5),
            ("1in2", 0.5),
            ("1 in 2", 0.5),
            ("1 IN 0.5", 2.0),
            ("50%", 0.5),
            ("66,7 %", 0.667),
            ("200%", 2.0),
            ("45°", 45_f64.to_radians().tan()),
            ("45 deg", 45_f64.to_radians().tan()),
            ("1:10000", 1e-4),
            ("10000V:1H", 1e4),
        ] {
            assert_eq!(read(text), Ok(expected), "{text}");
        }
        for text in [format!("{atan_half}deg"), format!("{atan_half}°")] {
            assert!((read(&text).unwrap() - 0.5).abs() < 1e-15, "{text}");
        }
    }

    #[test]
    fn refusals() {
        type Kind = fn(&SlopeError) -> bool;
        let cases: [(Kind, &[&str]); 6] = [
            (|e| matches!(e, SlopeError::Empty), &["", "  "]),
            (
                |e| matches!(e, SlopeError::NotUnderstood(_)),
                &[
                    "steep", "nan", "inf", "infdeg", "nan%", "1:nan", "1:inf", "1:", ":2", ":", "1:2:3", "1V:2", "1:2H", "1V:2V",
                    "V:H", "%", "deg", "°", "in", "in2", "1in", "1,234.5%", "1..5%", "50%%", "2rad", "1/2", "1e999%", "1;2",
                ],
            ),
            (|e| matches!(e, SlopeError::BareNumber(_)), &["0.5", "2", "0,5", "1"]),
            (|e| matches!(e, SlopeError::Ambiguous { .. }), &["1:0.5", "0.5:1", "2:3", "3:2", "1:0,99"]),
            (
                |e| matches!(e, SlopeError::NotPositive(_)),
                &["0", "-1", "0%", "-50%", "1:0", "0:1", "-1:2", "1:-2", "0deg", "-45°", "1in0", "0V:1H"],
            ),
            (|e| matches!(e, SlopeError::Vertical(_)), &["90deg", "90°", "135deg"]),
        ];
        for (kind, texts) in cases {
            for text in texts {
                let error = read(text).unwrap_err();
                assert!(kind(&error), "{text}: {error:?}");
            }
        }
        for text in ["1:10001", "10001V:1H", "0.001%", "89.999deg", "1e-300%", "1V:1e-300H", "1e-300V:1e300H", "1e300V:1e-300H"] {
            assert!(matches!(read(text), Err(SlopeError::OutOfRange { .. })), "{text}");
        }
    }

    #[test]
    fn messages() {
        let message = |text: &str| read(text).unwrap_err().to_string();
        // atan(2) = 63.435°, atan(1/2) = 26.565°.
        assert_eq!(
            message("1:0.5"),
            "`1:0.5` is ambiguous\n   = it may mean 63.43° or 26.57°\n   = help: write `1V:0.5H` or `1H:0.5V`"
        );
        assert_eq!(
            message("0,5:1"),
            "`0,5:1` is ambiguous\n   = it may mean 26.57° or 63.43°\n   = help: write `0.5V:1H` or `0.5H:1V`"
        );
        assert_eq!(
            message("0.5"),
            "`0.5` does not say which kind of slope it is\n   = help: write `0.5V:1H`, `0.5H:1V`, `0.5%` or `0.5deg`"
        );
        assert_eq!(
            message("0%"),
            "`0%` is not a positive slope\n   = help: give the steepness; `--direction` says whether it falls or rises"
        );
    }

    #[test]
    fn suggestions_can_be_typed() {
        for text in ["1:0.5", "0.5:1", "2:3", "0.5", "2"] {
            let message = read(text).unwrap_err().to_string();
            let help = message.split("help: ").nth(1).unwrap();
            for suggestion in help.split('`').skip(1).step_by(2) {
                assert!(read(suggestion).is_ok(), "{suggestion}");
            }
        }
    }

    proptest! {
        #[test]
        fn own_forms_read_back(ratio in 1e-3..1e3_f64) {
            let slope = Slope::from_ratio(ratio).unwrap();
            for (form, digits) in slope.forms().split(" · ").zip([4, 4, 3, 4]) {
                let back = read(form).unwrap();
                // Half a unit of the last digit shown; degrees near the vertical are coarser: d tan = (1 + tan²) dα.
                let coarse = if form.ends_with('°') { (ratio + 1.0 / ratio) * slope.degrees().to_radians() } else { 1.0 };
                let relative = 0.5 * 10_f64.powi(1 - digits) * coarse.max(1.0);
                prop_assert!(relative > 0.1 || (back / ratio - 1.0).abs() < 1.2 * relative, "{form}");
            }
        }

        #[test]
        fn any_text_gets_an_answer(text in "\\PC*") {
            let _ = read(&text);
        }
    }
}
