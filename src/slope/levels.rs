//! The scan plane: which levels it stops at, and where a height stands among them.

/// A vertex closer to a level than this (height, length units) lies on it.
pub const LEVEL_SNAP: f64 = 1e-6;

/// Least and greatest number of levels a default interval gives.
const COUNT: (f64, f64) = (10.0, 25.0);

/// More levels than this are refused.
pub const MAX_LEVELS: usize = 10_000;

/// Position of a height among the levels: `2u` between level `u − 1` and level `u`, `2u + 1` on level `u`. Grows downwards.
pub type Code = u32;

/// Heights at which the surface is cut, falling.
#[derive(Clone, Debug, PartialEq)]
pub struct Levels {
    /// Heights of the falling sheet, descending.
    pub heights: Vec<f64>,
}

/// A round number (1, 2 or 5 times a power of ten) that divides `range` into 10 to 25 parts.
pub fn round_interval(range: f64) -> f64 {
    let power = 10_f64.powf((range / COUNT.1).log10().floor());
    [1.0, 2.0, 5.0].into_iter().map(|m| m * power).find(|step| range / step <= COUNT.1).unwrap_or(10.0 * power)
}

impl Levels {
    /// Whole multiples of `interval` strictly between `end` and `top`.
    pub fn between(end: f64, top: f64, interval: f64) -> Self {
        let mut i = ((top - LEVEL_SNAP) / interval).floor();
        let mut heights = Vec::new();
        while i * interval > end + LEVEL_SNAP && heights.len() <= MAX_LEVELS {
            heights.push(i * interval);
            i -= 1.0;
        }
        Self { heights }
    }

    /// The same with further heights, where they lie strictly between `end` and `top`. Of heights within [`LEVEL_SNAP`] of each
    /// other one remains: a further one before one that was there.
    pub fn with(self, further: &[f64], end: f64, top: f64) -> Self {
        let inside = |c: &f64| *c > end + LEVEL_SNAP && *c < top - LEVEL_SNAP;
        let mut all: Vec<(f64, bool)> = further.iter().copied().filter(inside).map(|c| (c, true)).collect();
        all.extend(self.heights.into_iter().map(|c| (c, false)));
        all.sort_by(|a, b| b.0.total_cmp(&a.0));
        let mut heights: Vec<(f64, bool)> = Vec::with_capacity(all.len());
        for level in all {
            match heights.last_mut() {
                Some(last) if last.0 - level.0 <= LEVEL_SNAP => {
                    if level.1 && !last.1 {
                        *last = level;
                    }
                }
                _ => heights.push(level),
            }
        }
        Self { heights: heights.into_iter().map(|(c, _)| c).collect() }
    }

    /// Where `z` stands.
    pub fn code(&self, z: f64) -> Code {
        let above = self.heights.partition_point(|&c| c > z + LEVEL_SNAP);
        let on = self.heights.get(above).is_some_and(|&c| c >= z - LEVEL_SNAP);
        2 * above as Code + Code::from(on)
    }

    /// Indices of the levels strictly between two heights, in the order from `from` to `to`.
    pub fn crossed(&self, from: f64, to: f64) -> Crossed {
        let (high, low) = (from.max(to), from.min(to));
        // Strictly below `high` and strictly above `low`.
        let first = self.code(high).div_ceil(2) as usize;
        let last = (self.code(low) / 2) as usize;
        Crossed { first, last: last.max(first), down: from >= to }
    }
}

/// A run of level indices, walked downwards or upwards.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Crossed {
    first: usize,
    last: usize,
    down: bool,
}

impl Iterator for Crossed {
    type Item = usize;

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.last - self.first, Some(self.last - self.first))
    }

    fn next(&mut self) -> Option<usize> {
        if self.first >= self.last {
            return None;
        }
        if self.down {
            self.first += 1;
            Some(self.first - 1)
        } else {
            self.last -= 1;
            Some(self.last)
        }
    }
}

impl ExactSizeIterator for Crossed {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn codes_and_crossings() {
        let levels = Levels::between(-1.0, 3.0, 1.0);
        assert_eq!(levels.heights, [2.0, 1.0, 0.0]);
        assert_eq!([2.5, 2.0, 1.5, 0.0, -0.5].map(|z| levels.code(z)), [0, 1, 2, 5, 6]);
        assert_eq!(levels.crossed(2.5, 0.5).collect::<Vec<_>>(), [0, 1]);
        assert_eq!(levels.crossed(0.5, 2.5).collect::<Vec<_>>(), [1, 0]);
        assert_eq!(levels.crossed(2.0, 1.0).count(), 0);
        assert_eq!(levels.crossed(2.0 + 1e-7, 0.0).collect::<Vec<_>>(), [1]);
        assert_eq!(levels.crossed(1.4, 1.6).count(), 0);
    }

    #[test]
    fn further_heights_stand_among_the_others() {
        let levels = |further: &[f64]| Levels::between(-1.0, 3.0, 1.0).with(further, -1.0, 3.0).heights;
        assert_eq!(levels(&[1.25, 2.5]), [2.5, 2.0, 1.25, 1.0, 0.0]);
        // The end, the top and what lies beyond are no levels; one within rounding of another takes its place.
        assert_eq!(levels(&[3.0, -1.0, 7.0, 1.0 + 1e-7, 0.0 - 1e-7]), [2.0, 1.0 + 1e-7, -1e-7]);
        assert_eq!(Levels { heights: vec![] }.with(&[0.5, 0.5, 0.75], 0.0, 1.0).heights, [0.75, 0.5]);
    }

    #[test]
    fn intervals_are_round() {
        for (range, step) in [(10.0, 0.5), (24.9, 1.0), (25.1, 2.0), (60.0, 5.0), (0.37, 0.02), (1234.0, 50.0)] {
            assert!((round_interval(range) / step - 1.0).abs() < 1e-12, "{range}: {}", round_interval(range));
            assert!((10.0..=25.0).contains(&(range / step)), "{range} in steps of {step}");
        }
    }
}
