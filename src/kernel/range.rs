//! Ranges of numbers.

/// Least and greatest of some numbers; both infinite the wrong way round for none. What is no number is passed over.
#[inline]
pub fn range(values: impl IntoIterator<Item = f64>) -> (f64, f64) {
    values.into_iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranges_of_numbers() {
        assert_eq!(range([3.0, -1.0, f64::NAN, 2.0]), (-1.0, 3.0));
        assert_eq!(range([]), (f64::INFINITY, f64::NEG_INFINITY));
    }
}
