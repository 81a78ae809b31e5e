//! Colours: cut red, fill blue, as most earthworks programs have them; these two are told apart by the colour-blind too.

use crate::model::Part;

/// Red, green and blue as screens take them (sRGB), 0 to 255.
pub(super) type Rgb = [u8; 3];

/// Colour of a part.
pub(super) fn of_part(part: Part) -> Rgb {
    match part {
        Part::Platform => [158, 158, 158],
        Part::FillSlope => [67, 114, 186],
        Part::CutSlope => [200, 76, 60],
        Part::Ground => [134, 142, 92],
    }
}

/// Ends of the scale of depths and its middle: the scheme `RdBu` of C. Brewer, <https://colorbrewer2.org>, of eleven classes the
/// second from either end, and the middle one.
const DEEP_CUT: Rgb = [178, 24, 43];
const DEEP_FILL: Rgb = [33, 102, 172];
const NO_DEPTH: Rgb = [247, 247, 247];

/// Colour of a height over ground (negative: cut) on a scale that goes as far in cut as in fill. Grey where it is not known.
pub(super) fn of_depth(depth: f64, deepest: f64) -> Rgb {
    if !depth.is_finite() {
        return of_part(Part::Platform);
    }
    let end = if depth < 0.0 { DEEP_CUT } else { DEEP_FILL };
    let share = if deepest > 0.0 { (depth.abs() / deepest).min(1.0) } else { 0.0 };
    let mix = |from: u8, to: u8| (f64::from(from) + (f64::from(to) - f64::from(from)) * share).round() as u8;
    [0, 1, 2].map(|i| mix(NO_DEPTH[i], end[i]))
}

/// Share of light, 0 to 1, for a value as screens take it: the inverse of the transfer function of IEC 61966-2-1.
pub(super) fn linear(value: u8) -> f64 {
    let share = f64::from(value) / 255.0;
    if share <= 0.040_45 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_scale_of_depths_is_symmetric() {
        assert_eq!(of_depth(-4.0, 4.0), DEEP_CUT);
        assert_eq!(of_depth(4.0, 4.0), DEEP_FILL);
        assert_eq!(of_depth(9.0, 4.0), DEEP_FILL);
        assert_eq!(of_depth(0.0, 4.0), NO_DEPTH);
        assert_eq!(of_depth(1.0, 0.0), NO_DEPTH);
        assert_eq!(of_depth(2.0, 4.0), [140, 175, 210]);
        assert_eq!(of_depth(f64::NAN, 4.0), of_part(Part::Platform));
    }

    /// IEC 61966-2-1: black, white, both branches where they meet, and middle grey, 21.404 % of the light.
    #[test]
    fn light_of_screen_values() {
        assert_eq!((linear(0), linear(255)), (0.0, 1.0));
        assert!((linear(10) - 10.0 / 255.0 / 12.92).abs() < 1e-15);
        assert!((linear(11) - 0.003_347).abs() < 1e-6);
        assert!((linear(127) - 0.212_231).abs() < 1e-6);
    }
}
