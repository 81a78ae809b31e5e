//! Volumes from cross-sections, as they are worked out by hand: beside the exact ones, never in their stead.

/// A figure for cut and one for fill; not negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct CutFill {
    /// Of cut.
    pub cut: f64,
    /// Of fill.
    pub fill: f64,
}

impl CutFill {
    /// Both by a rule for one.
    fn each(self, others: [Self; 2], rule: impl Fn(f64, [f64; 2]) -> f64) -> Self {
        Self { cut: rule(self.cut, others.map(|o| o.cut)), fill: rule(self.fill, others.map(|o| o.fill)) }
    }
}

/// Average end area: `L (A₀ + A₁)/2`. Exact where the area changes linearly; too large for a wedge or a pyramid.
pub fn average_end_area(length: f64, ends: [f64; 2]) -> f64 {
    0.5 * length * (ends[0] + ends[1])
}

/// Prismoidal formula: `L/6 (A₀ + 4 Aₘ + A₁)`, with the area half-way. Exact where the area is a polynomial of degree three in
/// the station, so for all bodies with plane sides and straight edges that run through from end to end.
pub fn prismoidal(length: f64, ends: [f64; 2], middle: f64) -> f64 {
    length / 6.0 * (ends[0] + 4.0 * middle + ends[1])
}

/// [`average_end_area`] of cut and fill.
pub(super) fn averaged(length: f64, from: CutFill, to: CutFill) -> CutFill {
    from.each([to, to], |from, [to, _]| average_end_area(length, [from, to]))
}

/// [`prismoidal`] of cut and fill.
pub(super) fn by_prismoids(length: f64, from: CutFill, middle: CutFill, to: CutFill) -> CutFill {
    from.each([middle, to], |from, [middle, to]| prismoidal(length, [from, to], middle))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Cubic feet in a cubic yard.
    const YARD: f64 = 27.0;

    /// Textbook: end areas of 0, 580, 2100, 4650, 5870 ft² at 100 ft give 1074.074, 4962.963, 12500, 19481.48 yd³.
    #[test]
    fn end_areas_in_a_row() {
        let areas = [0.0, 580.0, 2100.0, 4650.0, 5870.0];
        let expected = [1074.074, 4962.963, 12_500.0, 19_481.48];
        for (ends, expected) in areas.windows(2).zip(expected) {
            let found = average_end_area(100.0, [ends[0], ends[1]]) / YARD;
            assert!((found - expected).abs() < 0.005, "{found} for {expected}");
        }
    }

    /// Textbook: 80 and 140 ft², 100 ft apart, hold 11 000 ft³.
    #[test]
    fn two_end_areas() {
        assert_eq!(average_end_area(100.0, [80.0, 140.0]), 11_000.0);
    }

    /// An embankment 11 wide, 2H:1V, 0.5 to 2.5 high over 150: areas h(11 + 2h) = 6, 21, 40.
    #[test]
    fn prismoidal_is_exact_where_end_areas_are_not() {
        let area = |h: f64| h * (11.0 + 2.0 * h);
        let (ends, middle) = ([area(0.5), area(2.5)], area(1.5));
        // 150 ∫ (11 h + 2 h²) dh / 2 from 0.5 to 2.5 = 75 (11·3 + 2/3 · 15.5) = 3250.
        assert!((prismoidal(150.0, ends, middle) - 3250.0).abs() < 1e-12 * 3250.0);
        assert_eq!(average_end_area(150.0, ends), 3450.0);
        // A pyramid: area ∝ x². The end areas give half its prism, the prismoidal formula the third it has.
        assert_eq!(prismoidal(6.0, [0.0, 9.0], 2.25), 18.0);
    }
}
