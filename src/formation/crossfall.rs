//! How the edges of a road lie against its centre line.

use crate::model::{Slope, SlopeError};
use std::str::FromStr;

/// Fall from the centre line to the edges, rise per run; positive where the edge lies lower.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Crossfall {
    /// To the left edge, seen along the centre line.
    pub left: f64,
    /// To the right edge.
    pub right: f64,
}

/// Steeper than any carriageway: beyond it, `2.5` was typed for `2.5%`.
const STEEPEST: f64 = 1.0;

/// Why a typed crossfall was refused.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum CrossfallError {
    /// One side is not a slope.
    #[error("{0}")]
    Side(SlopeError),
    /// More than two sides.
    #[error(
        "`{0}` has more than two sides\n   = help: give one fall for both, or `LEFT,RIGHT` such as `2.5%,-2.5%`; decimals behind a point"
    )]
    Sides(String),
    /// A comma that may part two sides, or be a decimal one.
    #[error(
        "`{given}` is ambiguous\n   = it may mean `{both}` on both sides, or `{left}` on the left and `{right}` on the right\n   \
         = help: write `{both}` or `{left};{right}`"
    )]
    Ambiguous {
        /// As typed.
        given: String,
        /// With a decimal point.
        both: String,
        /// Before the comma.
        left: String,
        /// Behind it.
        right: String,
    },
    /// A wall.
    #[error(
        "`{given}` is too steep for a crossfall\n   = {fall} fall per length\n   = help: give one below 100%, such as `2.5%`"
    )]
    Steep {
        /// As typed.
        given: String,
        /// What it means.
        fall: f64,
    },
}

impl FromStr for Crossfall {
    type Err = CrossfallError;

    /// Reads `2.5%` (both edges lower), `-2.5%` (both higher), `2.5%,-2.5%` (left, right), in any notation of slopes; `0` is
    /// level. A comma that can be a decimal one is, as in `2,5%`; where it may be either, as in `0,2%`, it is refused. A
    /// semicolon parts the sides too.
    ///
    /// # Errors
    /// [`CrossfallError`], in words for the person who typed it.
    fn from_str(given: &str) -> Result<Self, CrossfallError> {
        let whole = one(given);
        if let Ok(fall) = whole {
            if let Some((left, right)) = given.split_once(',')
                && let (Ok(first), Ok(second)) = (one(left), one(right))
                && (first, second) != (fall, fall)
            {
                let [given, left, right] = [given, left, right].map(|text| text.trim().to_owned());
                return Err(CrossfallError::Ambiguous { both: given.replacen(',', ".", 1), given, left, right });
            }
            return Ok(Self { left: fall, right: fall });
        }
        let sides: Vec<&str> = given.split([',', ';']).collect();
        match sides[..] {
            [left, right] => Ok(Self { left: one(left)?, right: one(right)? }),
            [_] => whole.map(|fall| Self { left: fall, right: fall }),
            _ => Err(CrossfallError::Sides(given.trim().to_owned())),
        }
    }
}

fn one(given: &str) -> Result<f64, CrossfallError> {
    let text = given.trim();
    let (sign, steepness) = match text.strip_prefix(['-', '\u{2212}']) {
        Some(rest) => (-1.0, rest),
        None => (1.0, text.strip_prefix('+').unwrap_or(text)),
    };
    let level = steepness.trim().trim_end_matches('%').trim_end_matches("deg").trim_end_matches('°').replace(',', ".");
    let digits = !level.is_empty() && level.chars().all(|c| c.is_ascii_digit() || c == '.');
    if digits && level.trim().parse::<f64>() == Ok(0.0) {
        return Ok(0.0);
    }
    let fall = steepness.parse::<Slope>().map_err(CrossfallError::Side)?.ratio();
    if fall >= STEEPEST {
        return Err(CrossfallError::Steep { given: text.to_owned(), fall });
    }
    Ok(sign * fall)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_or_two_sides() {
        let both = |fall| Ok(Crossfall { left: fall, right: fall });
        for (text, expected) in [
            ("2.5%", both(0.025)),
            ("2,5%", both(0.025)),
            ("-2.5%", both(-0.025)),
            ("+2%", both(0.02)),
            ("0", both(0.0)),
            ("0%", both(0.0)),
            ("-0.0%", both(0.0)),
            ("1:40", both(1.0 / 40.0)),
            ("2%,-2%", Ok(Crossfall { left: 0.02, right: -0.02 })),
            ("2%;-2%", Ok(Crossfall { left: 0.02, right: -0.02 })),
            (" 2% , 0 ", Ok(Crossfall { left: 0.02, right: 0.0 })),
            // One comma between digits is a decimal one.
            ("1:50,5", both(1.0 / 50.5)),
        ] {
            assert_eq!(text.parse::<Crossfall>(), expected, "{text}");
        }
    }

    #[test]
    fn refusals() {
        let error = |text: &str| text.parse::<Crossfall>().unwrap_err();
        assert!(matches!(error("2.5"), CrossfallError::Side(SlopeError::BareNumber(_))));
        assert!(matches!(error("2%,x"), CrossfallError::Side(SlopeError::NotUnderstood(_))));
        assert!(matches!(error("1%,2%,3%"), CrossfallError::Sides(_)));
        assert!(matches!(error("100%"), CrossfallError::Steep { fall: 1.0, .. }));
        assert_eq!(
            error("0,2%").to_string(),
            "`0,2%` is ambiguous\n   = it may mean `0.2%` on both sides, or `0` on the left and `2%` on the right\n   \
             = help: write `0.2%` or `0;2%`"
        );
        assert!(matches!(error("-0,5%"), CrossfallError::Ambiguous { .. }));
        assert_eq!("0.2%".parse(), Ok(Crossfall { left: 0.002, right: 0.002 }));
        assert_eq!("0;2%".parse(), Ok(Crossfall { left: 0.0, right: 0.02 }));
        assert_eq!("0,0%".parse(), Ok(Crossfall::default()));
        assert!(matches!(error("--2%"), CrossfallError::Side(_)));
        assert!(matches!(error("."), CrossfallError::Side(_)));
        assert!(matches!(error(""), CrossfallError::Side(SlopeError::Empty)));
    }
}
