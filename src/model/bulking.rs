//! Soil takes more room when it is dug, less when it is compacted.

use super::digits::rounded;
use std::fmt;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// How the volume of soil changes: against its volume in the ground (*bank*), dug soil is larger by `swell` (*loose*), compacted
/// soil smaller by `shrink`. Both are shares: 0.25 is 25 %.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Bulking {
    swell: f64,
    shrink: f64,
}

impl Bulking {
    /// Swell that soil and rock can have.
    pub const SWELL: RangeInclusive<f64> = 0.0..=2.0;
    /// Shrink that they can have. Rock may take more room compacted than in the ground: its shrink is negative.
    pub const SHRINK: RangeInclusive<f64> = -1.0..=0.9;

    /// From shares; `None` unless they lie within [`Self::SWELL`] and [`Self::SHRINK`].
    pub fn new(swell: f64, shrink: f64) -> Option<Self> {
        (Self::SWELL.contains(&swell) && Self::SHRINK.contains(&shrink)).then_some(Self { swell, shrink })
    }

    /// Gain in volume when dug, as a share of the bank volume.
    pub fn swell(self) -> f64 {
        self.swell
    }

    /// Loss in volume when compacted, as a share of the bank volume.
    pub fn shrink(self) -> f64 {
        self.shrink
    }

    /// Loose volume of a bank volume.
    pub fn loose(self, bank: f64) -> f64 {
        bank * (1.0 + self.swell)
    }

    /// Compacted volume of a bank volume.
    pub fn compacted(self, bank: f64) -> f64 {
        bank * (1.0 - self.shrink)
    }

    /// Bank volume that gives a compacted one.
    pub fn bank_for(self, compacted: f64) -> f64 {
        compacted / (1.0 - self.shrink)
    }
}

/// A share as typed: `25%`, `0.25`.
///
/// A plain number of 1 or more may be meant as a factor, a share or percent, and is refused; so is one from 0.5 to 1, which may
/// be the factor that is left of a volume.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
pub struct Share(pub f64);

/// Why a text is no share, in two lines: what is wrong, and what to write instead.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ShareError {
    /// What is wrong.
    pub what: String,
    /// What to write instead.
    pub help: String,
}

impl fmt::Display for ShareError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}\n   = help: {}", self.what, self.help)
    }
}

impl std::error::Error for ShareError {}

/// Plain numbers from here on may be factors.
const AMBIGUOUS: f64 = 0.5;
/// Plain numbers from here on are no factors of soil: percent was meant.
const PERCENT: f64 = 3.0;

impl FromStr for Share {
    type Err = ShareError;

    fn from_str(text: &str) -> Result<Self, ShareError> {
        let trimmed = text.trim();
        let (digits, percent) = match trimmed.strip_suffix('%') {
            Some(digits) => (digits.trim_end(), true),
            None => (trimmed, false),
        };
        let plain = digits.bytes().all(|b| b.is_ascii_digit() || b"+-.".contains(&b));
        let Some(value) = digits.parse::<f64>().ok().filter(|value| plain && value.is_finite()) else {
            let help =
                if text.contains(',') { "write the decimals behind a point, such as 12.5%" } else { "write `25%` or `0.25`" };
            return Err(ShareError { what: format!("`{text}` is not a share"), help: help.to_owned() });
        };
        if percent {
            return Ok(Self(value / 100.0));
        }
        if value.abs() < AMBIGUOUS {
            return Ok(Self(value));
        }
        let what = format!("`{text}` can be read in two ways");
        let number = |value: f64| format!("{}{}", if value < 0.0 { "-" } else { "" }, rounded(value.abs(), 4));
        let help = if value.abs() >= PERCENT {
            format!("write `{0}%`, or `{1}%` for {0} times the volume", number(value), number(100.0 * value))
        } else {
            let factor = 100.0 * (value.abs() - 1.0).abs();
            let factor = if factor > 0.0 { rounded(factor, 4) } else { "0".to_owned() };
            format!("write `{factor}%` if {trimmed} is a factor, `{}%` if it is a share", number(100.0 * value))
        };
        Err(ShareError { what, help })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 100 bank at 25 % swell are 125 loose; at 10 % shrink they give 90 compacted, so 90 compacted need 100 bank.
    #[test]
    fn bank_loose_compacted() {
        let soil = Bulking::new(0.25, 0.1).unwrap();
        assert_eq!((soil.loose(100.0), soil.compacted(100.0)), (125.0, 90.0));
        assert!((soil.bank_for(90.0) - 100.0).abs() < 1e-13);
        // Rock at −30 % shrink: 100 bank give 130 compacted.
        assert_eq!(Bulking::new(0.6, -0.3).unwrap().compacted(100.0), 130.0);
        let none = Bulking::default();
        assert_eq!((none.loose(7.0), none.compacted(7.0), none.bank_for(7.0)), (7.0, 7.0, 7.0));
        for (swell, shrink) in [(-0.1, 0.1), (0.1, 1.0), (2.1, 0.0), (0.0, -1.1), (f64::NAN, 0.0), (0.0, f64::NAN)] {
            assert_eq!(Bulking::new(swell, shrink), None, "{swell} {shrink}");
        }
    }

    #[test]
    fn shares_as_typed() {
        for (text, share) in [
            ("25%", 0.25),
            (" 12.5 % ", 0.125),
            ("0.25", 0.25),
            (".1", 0.1),
            ("0", 0.0),
            ("0%", 0.0),
            ("120%", 1.2),
            ("90%", 0.9),
            ("-30%", -0.3),
            ("-0.3", -0.3),
        ] {
            assert_eq!(text.parse(), Ok(Share(share)), "{text}");
        }
    }

    #[test]
    fn what_can_be_read_in_two_ways_is_refused() {
        let refused = |text: &str| text.parse::<Share>().unwrap_err().to_string();
        for (text, help) in [
            ("1.25", "write `25%` if 1.25 is a factor, `125%` if it is a share"),
            ("0.9", "write `10%` if 0.9 is a factor, `90%` if it is a share"),
            ("1", "write `0%` if 1 is a factor, `100%` if it is a share"),
            ("25", "write `25%`, or `2500%` for 25 times the volume"),
            ("1e9999", ""),
        ] {
            let message = refused(text);
            if help.is_empty() {
                assert!(message.starts_with(&format!("`{text}` is not a share")), "{message}");
            } else {
                assert_eq!(message, format!("`{text}` can be read in two ways\n   = help: {help}"));
            }
        }
        assert_eq!(refused("12,5%"), "`12,5%` is not a share\n   = help: write the decimals behind a point, such as 12.5%");
        for text in ["", "%", "25%%", "nan", "inf", "1e-3", "ten", "--5", "25 percent"] {
            assert_eq!(refused(text), format!("`{text}` is not a share\n   = help: write `25%` or `0.25`"));
        }
    }

    proptest::proptest! {
        #[test]
        fn any_text_gets_an_answer(text in "\\PC*") {
            let _ = text.parse::<Share>();
        }

        #[test]
        fn any_number_gets_an_answer(value: f64) {
            let _ = format!("{value}").parse::<Share>();
            let _ = format!("{value}%").parse::<Share>();
        }
    }
}
