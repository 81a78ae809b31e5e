//! Round numbers: steps of scales, and figures with as many digits as their steps ask for.

pub(super) use crate::model::digits::typeset as figure;

/// The least of 1, 2, 5 × 10ⁿ that is not less than `least`; 1 for what is no positive number.
pub fn round_step(least: f64) -> f64 {
    if !(least > 0.0 && least.is_finite()) {
        return 1.0;
    }
    let power = least.log10().floor() as i32;
    // Divided, not multiplied, below 1: 1/10 is nearer to 0.1 than any product is.
    let of = |digit: f64, power: i32| if power < 0 { digit / 10f64.powi(-power) } else { digit * 10f64.powi(power) };
    let steps = [(1.0, power), (2.0, power), (5.0, power), (1.0, power + 1)];
    // A hair of tolerance, so that a step asked for exactly is not missed by its logarithm.
    let enough = |step: &f64| *step >= least * (1.0 - 1e-12);
    steps.into_iter().map(|(digit, power)| of(digit, power)).find(enough).unwrap_or(of(1.0, power + 1))
}

/// Decimals that multiples of a step have.
pub(super) fn decimals(step: f64) -> usize {
    if step >= 1.0 { usize::from(step.fract() != 0.0) } else { (-step.log10() - 1e-9).ceil().clamp(0.0, 9.0) as usize }
}

/// Most multiples asked for at once.
const MOST: f64 = 2000.0;

/// Whole multiples of a step from `from` to `to`, both included up to rounding; none where there would be too many.
pub(super) fn multiples(from: f64, to: f64, step: f64) -> Vec<f64> {
    /// Share of a step that counts as rounding.
    const SLACK: f64 = 1e-9;
    let (first, last) = ((from / step - SLACK).ceil(), (to / step + SLACK).floor());
    if !(last >= first && last - first <= MOST && first.abs().max(last.abs()) < 2f64.powi(53)) {
        return Vec::new();
    }
    (0..=(last - first) as u32).map(|i| (first + f64::from(i)) * step).collect()
}

/// Whether a number is a multiple of a step, up to rounding.
pub(super) fn is_multiple(value: f64, step: f64) -> bool {
    /// Share of a step that counts as rounding.
    const SLACK: f64 = 1e-6;
    let share = value / step;
    (share - share.round()).abs() < SLACK
}

/// A number with its sign, plus too.
pub(super) fn signed(value: f64, decimals: usize) -> String {
    let text = figure(value, decimals);
    if value > 0.0 && text.chars().any(|c| c.is_ascii_digit() && c != '0') { format!("+{text}") } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn steps_are_round() {
        for (least, step) in
            [(0.03, 0.05), (0.1, 0.1), (1.0, 1.0), (1.1, 2.0), (20.0, 20.0), (501.0, 1000.0), (0.0, 1.0), (f64::NAN, 1.0)]
        {
            assert_eq!(round_step(least), step, "{least}");
        }
        for (step, digits) in [(0.05, 2), (0.1, 1), (1.0, 0), (20.0, 0), (0.002, 3)] {
            assert_eq!(decimals(step), digits, "{step}");
        }
    }

    #[test]
    fn multiples_are_within() {
        assert_eq!(multiples(-0.5, 1.0, 0.5), [-0.5, 0.0, 0.5, 1.0]);
        assert_eq!(multiples(0.1, 0.3, 0.1).len(), 3);
        assert!(multiples(0.0, 1e9, 1e-3).is_empty());
        assert!(multiples(1.0, 0.0, 0.5).is_empty());
    }

    #[test]
    fn figures_have_signs_that_mean_something() {
        assert_eq!((figure(-0.001, 2), figure(-1.25, 1)), ("0.00".to_owned(), "−1.2".to_owned()));
        assert_eq!((signed(0.0, 1), signed(2.0, 1), signed(-2.0, 1)), ("0.0".to_owned(), "+2.0".to_owned(), "−2.0".to_owned()));
    }
}
