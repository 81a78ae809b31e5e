//! Ranges of numbers.

/// Least and greatest of some numbers; both infinite the wrong way round for none. What is no number is passed over.
#[inline]
pub fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

/// A number brought into a range. Of a range the wrong way round, as a flaw may leave one, the end: what comes of it is for the checks to
/// find ([`f64::clamp`] would panic).
#[inline]
pub fn held(value: f64, [low, high]: [f64; 2]) -> f64 {
    value.max(low).min(high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_held_in_ranges() {
        for (value, range, expected) in
            [(2.0, [1.0, 3.0], 2.0), (0.0, [1.0, 3.0], 1.0), (4.0, [1.0, 3.0], 3.0), (2.0, [3.0, 1.0], 1.0)]
        {
            assert_eq!(held(value, range), expected);
        }
    }

    #[test]
    fn ranges_of_numbers() {
        assert_eq!(range([3.0, -1.0, f64::NAN, 2.0]), (-1.0, 3.0));
        assert_eq!(range([]), (f64::INFINITY, f64::NEG_INFINITY));
    }
}
