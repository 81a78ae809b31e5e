//! Units of length that survey files declare.

use std::fmt;
use std::str::FromStr;

/// A unit of length.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum LengthUnit {
    /// Metre.
    #[default]
    Metre,
    /// International foot: 0.3048 m exactly.
    Foot,
    /// US survey foot: 1200/3937 m exactly (Mendenhall order of 1893).
    UsSurveyFoot,
}

impl LengthUnit {
    /// All units, as offered on the command line.
    pub const ALL: [Self; 3] = [Self::Metre, Self::Foot, Self::UsSurveyFoot];

    /// Metres in one unit.
    pub fn metres(self) -> f64 {
        match self {
            Self::Metre => 1.0,
            Self::Foot => 0.3048,
            Self::UsSurveyFoot => 1200.0 / 3937.0,
        }
    }

    /// Label in reports and on the command line: `m`, `ft`, `us-ft`.
    pub fn label(self) -> &'static str {
        match self {
            Self::Metre => "m",
            Self::Foot => "ft",
            Self::UsSurveyFoot => "us-ft",
        }
    }

    /// Name in messages, plural.
    pub fn plural(self) -> &'static str {
        match self {
            Self::Metre => "metres",
            Self::Foot => "international feet",
            Self::UsSurveyFoot => "US survey feet",
        }
    }

    /// How many of `other` one of this unit is. Exactly 1 for the same unit.
    pub fn per(self, other: Self) -> f64 {
        if self == other { 1.0 } else { self.metres() / other.metres() }
    }
}

impl fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.label())
    }
}

impl FromStr for LengthUnit {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let known = Self::ALL.into_iter().find(|unit| unit.label() == text);
        known.ok_or_else(|| format!("`{text}` is no unit of length that is known; give m, ft (0.3048 m) or us-ft (1200/3937 m)"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn factors_are_those_of_the_definitions() {
        assert_eq!(LengthUnit::Metre.per(LengthUnit::Foot), 1.0 / 0.3048);
        // 3937 US survey feet are 1200 m.
        assert!((3937.0 * LengthUnit::UsSurveyFoot.metres() - 1200.0).abs() < 1e-12);
        // Two parts in a million lie between the feet (NIST SP 811, B.6).
        assert!((LengthUnit::UsSurveyFoot.per(LengthUnit::Foot) - 1.000_002).abs() < 1e-8);
        for unit in LengthUnit::ALL {
            assert_eq!(unit.label().parse(), Ok(unit));
            assert_eq!(unit.per(unit), 1.0);
        }
        assert!("feet".parse::<LengthUnit>().is_err());
    }
}
