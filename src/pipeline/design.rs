//! What is wanted and the line together: the design, or why they do not fit.

mod error;

pub use error::DesignError;

use crate::model::{Chain, Design, Extent, Line, Note, Role, Sheet, Side, Slope};
use crate::validate::MERGE_DISTANCE;

/// How far beyond the lowest (highest) vertex a slope goes for which no end was given, in the length unit.
pub const DEFAULT_REACH: f64 = 10.0;

/// Most level curves of one surface. A mesh has vertices on each of them all the way round: more than this is a slip of the
/// keyboard, and would fill the memory before anyone can look at it.
pub const MOST_LEVELS: f64 = 10_000.0;

/// Least distance of level curves in height, in the length unit: closer ones are one among the errors of coordinates.
pub const LEAST_INTERVAL: f64 = 1e-5;

/// Least height of a slope, in the length unit: one less high is the line itself.
pub const LEAST_DEPTH: f64 = 1e-4;

/// Furthest a slope may reach, in plan and in height, in the length unit: beyond it the line is a dot, and coordinates lose
/// their digits.
pub const FURTHEST_REACH: f64 = 1e7;

/// Most points that the arcs of level curves round a single corner or end may come to, all of them together.
pub const MOST_ARC_POINTS: f64 = 2e7;

/// Tolerances above this share of the width of a ring are lowered to it: a coarser mesh would lose the ring.
pub const COARSEST: f64 = 0.05;

/// Level curves to reckon with where no interval is given: the most that the engine chooses.
const CHOSEN_LEVELS: f64 = 25.0;

/// What is wanted, before the line is known.
#[derive(Clone, Debug, PartialEq)]
pub struct Wishes {
    /// The side slope.
    pub slope: Slope,
    /// Falling or rising.
    pub sheet: Sheet,
    /// On which side; `None`: both sides of lines, outside of rings.
    pub side: Option<Side>,
    /// Where the slope ends; `None`: [`DEFAULT_REACH`] beyond the line.
    pub extent: Option<Extent>,
    /// Spacing of the level curves; positive.
    pub interval: Option<f64>,
    /// Elevations of further level curves.
    pub levels: Vec<f64>,
    /// Bound for the height error; positive.
    pub tolerance: f64,
}

impl Wishes {
    /// The design for a line; `label` names the input. What was chosen for the caller goes to `notes`.
    ///
    /// # Errors
    /// [`DesignError`] when the line and what is wanted do not go together.
    pub fn settle(&self, line: &Line, label: &str, notes: &mut Vec<Note>) -> Result<Design, DesignError> {
        let (side_of_lines, side_of_rings) = self.sides(line, label)?;
        let (z_min, z_max) = line.elevation_range();
        let extent = self.extent.unwrap_or_else(|| {
            let end = match self.sheet {
                Sheet::Falling => millimetres(z_min - DEFAULT_REACH),
                Sheet::Rising => millimetres(z_max + DEFAULT_REACH),
            };
            notes.push(Note::new(
                "default-end",
                format!(
                    "the slopes end at elevation {end}, {DEFAULT_REACH} beyond the line: give `--to-elevation`, `--height` or \
                     `--distance` for another end"
                ),
            ));
            Extent::Elevation(end)
        });
        let k = self.slope.ratio();
        let relief = z_max - z_min;
        // Height of the whole surface, and its greatest height over one foot.
        let (height, deepest) = match (extent, self.sheet) {
            (Extent::Elevation(end), Sheet::Falling) => (z_max - end, z_max - end),
            (Extent::Elevation(end), Sheet::Rising) => (end - z_min, end - z_min),
            (Extent::Height(height), _) => (relief + height, height),
            (Extent::Distance(distance), _) => (relief + k * distance, k * distance),
        };
        if let Extent::Elevation(end) = extent {
            self.check_end(line, label, end)?;
        }
        if deepest < LEAST_DEPTH {
            return Err(DesignError::TooLow { label: label.to_owned(), depth: deepest });
        }
        // Along the ruling, which is the shortest way: no ruling is longer in plan.
        let reach = deepest / k;
        if reach.max(deepest) > FURTHEST_REACH {
            return Err(DesignError::TooFar { label: label.to_owned(), reach, height: deepest });
        }
        if let Some(interval) = self.interval.filter(|&interval| height / interval > MOST_LEVELS || interval < LEAST_INTERVAL) {
            let smallest = smallest_interval(height);
            return Err(DesignError::IntervalTooSmall {
                label: label.to_owned(),
                interval,
                height: millimetres(height),
                smallest,
            });
        }
        let levels = match self.interval {
            Some(interval) => height / interval + self.levels.len() as f64,
            None if self.levels.is_empty() => CHOSEN_LEVELS,
            None => self.levels.len() as f64,
        };
        let tolerance = self.tolerance(line, notes);
        let points = levels * arc_points(deepest, tolerance);
        if points > MOST_ARC_POINTS {
            return Err(DesignError::TooFine { label: label.to_owned(), points, tolerance });
        }
        Ok(Design {
            slope: self.slope,
            sheet: self.sheet,
            side_of_lines,
            side_of_rings,
            extent,
            interval: self.interval,
            tolerance,
            levels: self.levels.clone(),
            companion: None,
            frame: None,
            joggle: None,
        })
    }

    /// The tolerance, lowered where a ring is too narrow for it.
    fn tolerance(&self, line: &Line, notes: &mut Vec<Note>) -> f64 {
        let rings = line.chains.iter().filter(|chain| chain.closed());
        let coarsest = COARSEST * rings.map(width).fold(f64::INFINITY, f64::min);
        if self.tolerance <= coarsest {
            return self.tolerance;
        }
        let lowered = two_digits(coarsest.max(MERGE_DISTANCE));
        let asked = self.tolerance;
        notes.push(Note::new(
            "tolerance-lowered",
            format!(
                "the tolerance is {lowered:.2e} instead of {asked}: the narrowest ring is only {:.2e} wide",
                coarsest / COARSEST
            ),
        ));
        lowered
    }

    /// Sides for open lines and for rings.
    fn sides(&self, line: &Line, label: &str) -> Result<(Side, Side), DesignError> {
        let Some(side) = self.side else { return Ok((Side::Both, Side::Outside)) };
        let name = match side {
            Side::Left | Side::Right | Side::Both => return Ok((side, side)),
            Side::Inside => "inside",
            Side::Outside => "outside",
        };
        match line.chains.iter().find(|chain| chain.role == Role::Open) {
            None => Ok((Side::Both, side)),
            Some(open) => {
                let feature = open.places.first().and_then(|place| place.feature);
                let at = feature.map_or_else(|| label.to_owned(), |feature| format!("{label}, feature {feature}"));
                Err(DesignError::OpenLine { side: name, chain: open.name.clone(), at })
            }
        }
    }

    /// An end at an elevation must leave something of the slope.
    fn check_end(&self, line: &Line, label: &str, end: f64) -> Result<(), DesignError> {
        let (z_min, z_max) = line.elevation_range();
        let (nearest, before) = match self.sheet {
            Sheet::Falling => (z_max, end < z_max),
            Sheet::Rising => (z_min, end > z_min),
        };
        if !before {
            return Err(DesignError::WrongSide { label: label.to_owned(), sheet: self.sheet, nearest, end });
        }
        Ok(())
    }
}

/// Mean width of a ring: twice its area over its length, which is the width of a long rectangle.
fn width(ring: &Chain) -> f64 {
    let origin = ring.vertices[0].truncate();
    let (mut twice_area, mut length) = (0.0, 0.0);
    for (a, b) in (0..ring.segment_count()).map(|i| ring.segment(i)) {
        let (a, b) = (a.truncate() - origin, b.truncate() - origin);
        twice_area += a.perp_dot(b);
        length += a.distance(b);
    }
    twice_area.abs() / length
}

/// Points of the outermost level curve round an open end, half a turn. A chord over the angle `w` of a cone lies `h w²/8` off it
/// in height, `h` below its top; a third of the tolerance is spent on that.
fn arc_points(deepest: f64, tolerance: f64) -> f64 {
    std::f64::consts::PI / (8.0 * tolerance / (3.0 * deepest)).sqrt()
}

/// A number rounded to two digits.
fn two_digits(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}

/// A length without the digits that subtraction leaves behind.
fn millimetres(value: f64) -> f64 {
    /// Per length unit.
    const MILLI: f64 = 1000.0;
    // Large values have no thousandths to round to.
    let rounded = (value * MILLI).round() / MILLI;
    if (rounded - value).abs() <= 1.0 / MILLI { rounded } else { value }
}

/// The smallest interval of two digits that gives no more than [`MOST_LEVELS`] level curves over a height, but
/// [`LEAST_INTERVAL`] at least.
fn smallest_interval(height: f64) -> f64 {
    let least = (height / MOST_LEVELS).max(LEAST_INTERVAL);
    let exponent = least.log10().floor() as i32 - 1;
    // Through the decimal text, so that the suggestion is a number of two digits.
    let mut digits = (least / 10_f64.powi(exponent)).floor();
    loop {
        let interval: f64 = format!("{digits}e{exponent}").parse().unwrap_or(least * 2.0);
        if (interval >= LEAST_INTERVAL && height / interval <= MOST_LEVELS) || digits > 1000.0 {
            return interval;
        }
        digits += 1.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::Place;
    use glam::DVec3;

    fn line(role: Role) -> Line {
        let vertices = vec![DVec3::new(0.0, 0.0, 400.0), DVec3::new(50.0, 0.0, 402.3), DVec3::new(50.0, 50.0, 401.0)];
        let places = vec![Place { feature: Some(3), vertex: 1, row: None }; 3];
        Line { chains: vec![Chain { name: "rim".into(), role, vertices, places, axis: None }], ..Line::default() }
    }

    const OPEN: Role = Role::Open;
    const RING: Role = Role::Outer { polygon: 0 };

    fn wishes() -> Wishes {
        let slope = Slope::from_ratio(0.5).unwrap();
        Wishes { slope, sheet: Sheet::Falling, side: None, extent: None, interval: None, levels: Vec::new(), tolerance: 0.01 }
    }

    #[test]
    fn what_is_not_said_is_chosen() {
        let mut notes = Vec::new();
        let design = wishes().settle(&line(OPEN), "a.csv", &mut notes).unwrap();
        assert_eq!((design.side_of_lines, design.side_of_rings), (Side::Both, Side::Outside));
        assert_eq!(design.extent, Extent::Elevation(390.0));
        assert_eq!(notes.len(), 1);
        assert_eq!(notes[0].code, "default-end");
        let rising = Wishes { sheet: Sheet::Rising, ..wishes() };
        // 402.3 + 10, as typed and not as added.
        assert_eq!(rising.settle(&line(OPEN), "a.csv", &mut notes).unwrap().extent, Extent::Elevation(412.3));
    }

    #[test]
    fn sides() {
        let of = |side, role| {
            let wishes = Wishes { side: Some(side), ..wishes() };
            wishes.settle(&line(role), "a.json", &mut Vec::new()).map(|d| (d.side_of_lines, d.side_of_rings))
        };
        assert_eq!(of(Side::Left, RING), Ok((Side::Left, Side::Left)));
        assert_eq!(of(Side::Both, OPEN), Ok((Side::Both, Side::Both)));
        assert_eq!(of(Side::Inside, RING), Ok((Side::Both, Side::Inside)));
        assert_eq!(
            of(Side::Inside, OPEN).unwrap_err().to_string(),
            "`--side inside` needs rings, and `rim` is open\n  --> a.json, feature 3\n   \
             = help: ask for `left`, `right` or `both`, or close the line with `--closed`"
        );
    }

    #[test]
    fn ends_on_the_wrong_side() {
        let to = |sheet, end| {
            let wishes = Wishes { sheet, extent: Some(Extent::Elevation(end)), ..wishes() };
            wishes.settle(&line(OPEN), "a.csv", &mut Vec::new()).map(drop)
        };
        assert_eq!(
            to(Sheet::Falling, 402.3).unwrap_err().to_string(),
            "the slope would end before it begins\n  --> a.csv\n   = highest vertex at 402.3; `--to-elevation` 402.3\n   \
             = help: a falling slope ends below 402.3; for one that rises give `--direction up`"
        );
        assert!(matches!(to(Sheet::Rising, 400.0), Err(DesignError::WrongSide { nearest: 400.0, .. })));
        assert_eq!(to(Sheet::Falling, 400.5), Ok(()));
        assert_eq!(to(Sheet::Rising, 400.5), Ok(()));
    }

    #[test]
    fn small_intervals() {
        // 12.3 high (402.3 to 390): at most 10 000 levels are 0.00123 apart or more.
        let with = |interval| {
            let wishes = Wishes { interval: Some(interval), extent: Some(Extent::Elevation(390.0)), ..wishes() };
            wishes.settle(&line(OPEN), "a.csv", &mut Vec::new())
        };
        assert_eq!(
            with(1e-9).unwrap_err().to_string(),
            "the interval 0.000000001 is too small\n  --> a.csv\n   = 12.3 from the highest to the lowest; at most 10000 level \
             curves, at least 0.00001 apart\n   = help: give `--interval 0.0013` or more"
        );
        assert!(with(0.0013).is_ok() && with(0.00122).is_err() && with(5e-324).is_err() && with(1e300).is_ok());
        assert_eq!(smallest_interval(1e-3), LEAST_INTERVAL);
        for height in [0.1, 0.123, 1.0, 99_999.0, 1e5, 1e9, 3e9] {
            let interval = smallest_interval(height);
            assert!(height / interval <= MOST_LEVELS && interval <= height / MOST_LEVELS * 1.1 + 1e-300, "{height}: {interval}");
        }
    }

    #[test]
    fn too_low() {
        for extent in [Extent::Height(1e-5), Extent::Distance(1e-4), Extent::Elevation(402.299_99)] {
            let error = Wishes { extent: Some(extent), ..wishes() }.settle(&line(OPEN), "a", &mut Vec::new()).unwrap_err();
            assert!(matches!(error, DesignError::TooLow { .. }), "{error}");
        }
    }

    #[test]
    fn too_far() {
        // 1e8 along a slope of 1 in 2.
        for extent in [Extent::Height(5e7), Extent::Distance(1e8), Extent::Elevation(402.3 - 5e7)] {
            let error = Wishes { extent: Some(extent), ..wishes() }.settle(&line(OPEN), "a", &mut Vec::new()).unwrap_err();
            assert!(
                error.to_string().contains("100000000 in plan and 50000000 in height, against a limit of 10000000"),
                "{error}"
            );
        }
        // Steep: near in plan, but deep.
        let steep = Wishes { slope: Slope::from_ratio(1e4).unwrap(), extent: Some(Extent::Distance(1e4)), ..wishes() };
        assert!(matches!(steep.settle(&line(OPEN), "a", &mut Vec::new()), Err(DesignError::TooFar { .. })));
    }

    #[test]
    fn coarse_tolerances_are_lowered_for_rings() {
        let with = |tolerance, role| {
            let mut notes = Vec::new();
            let design = Wishes { tolerance, ..wishes() }.settle(&line(role), "a", &mut notes).unwrap();
            (design.tolerance, notes.iter().any(|note| note.code == "tolerance-lowered"))
        };
        // A right triangle with legs of 50: area 1250, length 50 (2 + √2).
        let coarsest = COARSEST * 2500.0 / (50.0 * (2.0 + 2.0_f64.sqrt()));
        let (lowered, noted) = with(1000.0, RING);
        assert!((lowered / coarsest - 1.0).abs() <= 0.05 && noted, "{lowered}");
        assert_eq!(with(0.5, RING), (0.5, false));
        assert_eq!(with(1000.0, OPEN), (1000.0, false));
    }

    #[test]
    fn too_fine() {
        let with = |tolerance, interval, height| {
            let wishes = Wishes { tolerance, interval, extent: Some(Extent::Height(height)), ..wishes() };
            wishes.settle(&line(OPEN), "a.csv", &mut Vec::new()).map(drop)
        };
        assert_eq!(with(1e-6, None, 10.0), Ok(()));
        assert_eq!(with(0.01, Some(0.01), 90.0), Ok(()));
        // π √(3 · 1e6 / (8 · 1e-6)) = 1.9e6 points on each of 25 level curves.
        assert_eq!(
            with(1e-6, None, 1e6).unwrap_err().to_string(),
            "the surface would have too many points\n  --> a.csv\n   = about 5e7 round a single corner, against a limit of 2e7\n   \
             = help: raise `--tolerance` (0.000001) or `--interval`, or end the slope sooner"
        );
    }
}
