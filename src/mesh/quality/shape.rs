//! Slopes and angles of triangles.

use super::faces::{Faces, Facing};
use super::finding::{Collector, Kind, Place};
use super::{NEEDLE_DEG, THIN};
use crate::kernel::sum::Sum;
use glam::DVec3;

/// Flatter triangles count as level, in degrees.
pub const LEVEL_DEG: f64 = 0.1;
/// Steeper triangles count as upright, in degrees.
pub const UPRIGHT_DEG: f64 = 89.9;
/// Upper ends of the bins of smallest angles, in degrees.
pub const ANGLE_BINS: [f64; 6] = [1.0, 5.0, 10.0, 20.0, 30.0, 60.0];
/// Bins of one degree for slopes.
pub const SLOPE_BINS: usize = 90;
/// Finer bins, in which common slopes are looked for, to a degree.
const FINE: usize = 10;
/// How many common slopes are told at most.
const MOST_COMMON: usize = 3;
/// Smaller shares are not common.
const COMMON_SHARE: f64 = 0.02;

/// What is measured on one triangle.
#[derive(Clone, Copy, Debug)]
pub(super) struct Shape {
    /// Area in space.
    pub(super) area: f64,
    /// Area in plan.
    pub(super) plan_area: f64,
    /// Height over the longest side.
    pub(super) height: f64,
    /// Angle against the horizontal in degrees.
    pub(super) slope: f64,
    /// Smallest angle in degrees.
    pub(super) smallest: f64,
}

impl Shape {
    /// Measures a triangle with an area.
    pub(super) fn of([a, b, c]: [DVec3; 3]) -> Self {
        let normal = (b - a).cross(c - a);
        let twice = normal.length();
        let mut sides = [b - a, c - b, a - c];
        sides.sort_by(|s, t| s.length_squared().total_cmp(&t.length_squared()));
        // The smallest angle is that between the two longer sides, which form a path: turn one round.
        let dot = -sides[1].dot(sides[2]);
        Self {
            area: 0.5 * twice,
            plan_area: 0.5 * normal.z.abs(),
            // No number for a triangle whose squares vanish: nought then.
            height: (twice / sides[2].length()).max(0.0),
            slope: normal.truncate().length().atan2(normal.z.abs()).to_degrees(),
            smallest: twice.atan2(dot).to_degrees(),
        }
    }

    /// Whether it is too low for its slope to mean anything.
    pub(super) fn thin(&self) -> bool {
        self.height < THIN
    }
}

/// Number and area of some triangles.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Share {
    /// How many.
    pub triangles: usize,
    /// Their area in space.
    pub area: f64,
}

/// The same while it is added up.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Tally {
    triangles: usize,
    area: Sum,
}

impl Tally {
    pub(super) fn add(&mut self, area: f64) {
        self.triangles += 1;
        self.area.add(area);
    }

    pub(super) fn share(&self) -> Share {
        Share { triangles: self.triangles, area: self.area.value() }
    }
}

/// A slope that much of the surface has.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Common {
    /// Angle against the horizontal in degrees: the mean over area.
    pub degrees: f64,
    /// Share of the area within 0.15° or so.
    pub share: f64,
}

/// Slopes of a surface or a part of it. Angles against the horizontal in degrees.
#[derive(Clone, Debug, PartialEq)]
pub struct Slopes {
    /// All triangles with an area.
    pub all: Share,
    /// Their area in plan.
    pub plan_area: f64,
    /// Those too low for a slope to be told; all that follows is about the others.
    pub thin: Share,
    /// Flatter than [`LEVEL_DEG`].
    pub level: Share,
    /// Steeper than [`UPRIGHT_DEG`].
    pub upright: Share,
    /// Mean over area.
    pub mean: f64,
    /// Flattest triangle, if there is any.
    pub flattest: Option<(f64, Place)>,
    /// Steepest triangle.
    pub steepest: Option<(f64, Place)>,
    /// Bins of one degree, from 0; [`SLOPE_BINS`] of them.
    pub bins: Vec<Share>,
    /// The most common slopes above [`LEVEL_DEG`], that with the largest share first.
    pub common: Vec<Common>,
}

/// Slopes while they are added up.
pub(super) struct Spread {
    all: Tally,
    plan_area: Sum,
    thin: Tally,
    level: Tally,
    upright: Tally,
    weighted: Sum,
    flattest: Option<(f64, usize)>,
    steepest: Option<(f64, usize)>,
    fine: Vec<(Tally, Sum)>,
}

impl Default for Spread {
    fn default() -> Self {
        Self {
            all: Tally::default(),
            plan_area: Sum::default(),
            thin: Tally::default(),
            level: Tally::default(),
            upright: Tally::default(),
            weighted: Sum::default(),
            flattest: None,
            steepest: None,
            fine: vec![Default::default(); SLOPE_BINS * FINE],
        }
    }
}

impl Spread {
    /// Adds triangle `f`.
    pub(super) fn add(&mut self, f: usize, shape: &Shape) {
        self.all.add(shape.area);
        self.plan_area.add(shape.plan_area);
        if shape.thin() {
            self.thin.add(shape.area);
            return;
        }
        let slope = shape.slope;
        if slope < LEVEL_DEG {
            self.level.add(shape.area);
        }
        if slope > UPRIGHT_DEG {
            self.upright.add(shape.area);
        }
        self.weighted.add(shape.area * slope);
        if self.flattest.is_none_or(|(least, _)| slope < least) {
            self.flattest = Some((slope, f));
        }
        if self.steepest.is_none_or(|(most, _)| slope > most) {
            self.steepest = Some((slope, f));
        }
        let bin = ((slope * FINE as f64) as usize).min(self.fine.len() - 1);
        self.fine[bin].0.add(shape.area);
        self.fine[bin].1.add(shape.area * slope);
    }

    pub(super) fn finish(self, faces: &Faces<'_>) -> Slopes {
        let place = |found: Option<(f64, usize)>| found.map(|(slope, f)| (slope, faces.place(faces.centre(f), &[f], &[])));
        let told = self.all.area.value() - self.thin.area.value();
        let bins = self.fine.chunks(FINE).map(|run| Share {
            triangles: run.iter().map(|(tally, _)| tally.triangles).sum(),
            area: run.iter().map(|(tally, _)| tally.area.value()).collect::<Sum>().value(),
        });
        Slopes {
            all: self.all.share(),
            plan_area: self.plan_area.value(),
            thin: self.thin.share(),
            level: self.level.share(),
            upright: self.upright.share(),
            mean: if told > 0.0 { self.weighted.value() / told } else { 0.0 },
            flattest: place(self.flattest),
            steepest: place(self.steepest),
            bins: bins.collect(),
            common: common(&self.fine, told),
        }
    }
}

/// The runs of three fine bins with the largest areas, one after the other.
fn common(fine: &[(Tally, Sum)], told: f64) -> Vec<Common> {
    let mut areas: Vec<f64> = fine.iter().map(|(tally, _)| tally.area.value()).collect();
    areas[0] = 0.0;
    let mut found = Vec::new();
    while found.len() < MOST_COMMON {
        let run = |i: usize| i.saturating_sub(1)..(i + 2).min(fine.len());
        let sum = |i: usize| areas[run(i)].iter().sum::<f64>();
        let Some(best) =
            (0..fine.len()).max_by(|&i, &j| sum(i).total_cmp(&sum(j)).then(areas[i].total_cmp(&areas[j])).then(j.cmp(&i)))
        else {
            break;
        };
        let area = sum(best);
        if area <= COMMON_SHARE * told {
            break;
        }
        let weighted: f64 = run(best).filter(|&i| areas[i] > 0.0).map(|i| fine[i].1.value()).sum();
        found.push(Common { degrees: weighted / area, share: area / told });
        areas[run(best)].fill(0.0);
    }
    found
}

/// Smallest angles of triangles, in degrees.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Angles {
    /// The smallest of all.
    pub smallest: Option<(f64, Place)>,
    /// Numbers of triangles, see [`ANGLE_BINS`].
    pub bins: [usize; ANGLE_BINS.len()],
}

/// Goes through all triangles with an area: `each` gets those that have one, with their shape.
pub(super) fn measure(faces: &Faces<'_>, keep: usize, found: &mut Vec<Collector>, mut each: impl FnMut(usize, &Shape)) -> Angles {
    let [mut thin, mut needle, mut clockwise, mut upright] =
        [Kind::Thin, Kind::Needle, Kind::Clockwise, Kind::Upright].map(|kind| Collector::new(kind, keep));
    let mut bins = [0; ANGLE_BINS.len()];
    let mut smallest: Option<(f64, usize)> = None;
    for f in (0..faces.len()).filter(|&f| faces.facing[f] != Facing::None) {
        let shape = Shape::of(faces.points(f));
        each(f, &shape);
        let place = |figure: (&'static str, f64)| {
            let mut place = faces.place(faces.centre(f), &[f], &[]);
            place.figures.push(figure);
            place
        };
        match faces.facing[f] {
            Facing::Down => clockwise.add(0.0, || place(("area", shape.plan_area))),
            Facing::Upright => upright.add(shape.area, || place(("area", shape.area))),
            _ => {}
        }
        if shape.thin() {
            thin.add(-shape.height, || place(("height", shape.height)));
        }
        if shape.smallest < NEEDLE_DEG {
            needle.add(-shape.smallest, || place(("angle_deg", shape.smallest)));
        }
        bins[ANGLE_BINS.iter().position(|&end| shape.smallest < end).unwrap_or(ANGLE_BINS.len() - 1)] += 1;
        if smallest.is_none_or(|(least, _)| shape.smallest < least) {
            smallest = Some((shape.smallest, f));
        }
    }
    found.extend([upright, clockwise, thin, needle]);
    Angles { smallest: smallest.map(|(angle, f)| (angle, faces.place(faces.centre(f), &[f], &[]))), bins }
}
