//! Slope stakes: from the hinge of every station to where its slope meets the ground.

use super::hinge::{Edges, Hinge, MeshLine, Ruling};
use super::{STRIP_RATE, in_steps};
use crate::ground::{Stations, place};
use crate::mesh::drape::{Drape, Run};
use crate::model::{Line, LineFeature, Part, Slope, Terrain, Tin};
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// A slope begins within this distance of its hinge, in the length unit: slivers beside a vertex, and rounding.
const START: f64 = 1e-4;

/// Share of a ray that a run takes up if it goes on beyond its end, but for rounding.
const WHOLE: f64 = 1.0 - 1e-9;

/// The same as [`STRIP_RATE`] for cones, which are drawn as wedges: half a wedge of 0.115 rad changes the fall by 1 − cos 0.0575.
const CONE_RATE: f64 = 2e-3;

/// Side of the axis, seen along it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hand {
    /// Left.
    Left,
    /// Right.
    Right,
}

impl Hand {
    /// Normal of a direction on this side.
    pub(super) fn outward(self, along: DVec2) -> DVec2 {
        match self {
            Self::Left => along.perp(),
            Self::Right => -along.perp(),
        }
    }

    /// The word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Left => "left",
            Self::Right => "right",
        }
    }
}

/// Which way a stake is measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Along {
    /// Down (up) the line of steepest descent: the slope is the one asked for.
    Ruling,
    /// Perpendicular to the axis, as a section shows it: on a grade the slope is flatter.
    Perpendicular,
}

impl Along {
    /// The word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ruling => "ruling",
            Self::Perpendicular => "perpendicular",
        }
    }
}

/// What ends a slope on its way from the hinge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ends {
    /// It meets the ground.
    Ground,
    /// It ends without meeting ground: where it was asked to, or at the edge of the ground.
    End,
    /// The slope of another part of the line takes over, at a ridge or a valley. Rulings only.
    Crease,
    /// It runs into a platform.
    Platform,
}

impl Ends {
    /// The word.
    pub fn word(self) -> &'static str {
        match self {
            Self::Ground => "ground",
            Self::End => "end",
            Self::Crease => "crease",
            Self::Platform => "platform",
        }
    }
}

/// One measurement from a hinge point to the end of its slope. Points in world coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Stake {
    /// Name of the axis.
    pub chain: String,
    /// Station on the axis.
    pub station: f64,
    /// Side of the axis.
    pub hand: Hand,
    /// Which way it is measured.
    pub along: Along,
    /// Distance of the hinge from the axis, in plan.
    pub offset: f64,
    /// Where the slope leaves the line.
    pub hinge: DVec3,
    /// Fill or cut; `None` where the hinge is on the ground and there is no slope.
    pub part: Option<Part>,
    /// Where the slope ends.
    pub catch: DVec3,
    /// Distance of the catch point from the axis, perpendicular to it.
    pub catch_offset: f64,
    /// How far the catch point lies ahead of the station (behind: negative), along the axis' direction there.
    pub catch_ahead: f64,
    /// What ends the slope.
    pub ends: Ends,
}

impl Stake {
    /// Distance from hinge to catch point in plan.
    pub fn distance(&self) -> f64 {
        self.hinge.truncate().distance(self.catch.truncate())
    }

    /// Height of the catch point above the hinge; negative below.
    pub fn height(&self) -> f64 {
        self.catch.z - self.hinge.z
    }

    /// Distance from hinge to catch point in space.
    pub fn slope_distance(&self) -> f64 {
        self.hinge.distance(self.catch)
    }

    /// Run per unit of rise, positive; `None` where there is no rise.
    pub fn one_in(&self) -> Option<f64> {
        let ratio = self.distance() / self.height().abs();
        ratio.is_finite().then_some(ratio).filter(|r| *r > 0.0)
    }

    /// Direction from hinge to catch point, in degrees clockwise from grid north, 0 to 360; `None` where they are one.
    pub fn bearing(&self) -> Option<f64> {
        let way = (self.catch - self.hinge).truncate();
        (way != DVec2::ZERO).then(|| way.x.atan2(way.y).to_degrees().rem_euclid(360.0))
    }
}

/// The slopes that were asked for.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Slopes {
    /// Of falling slopes, where they were built.
    pub fill: Option<Slope>,
    /// Of rising slopes.
    pub cut: Option<Slope>,
}

/// How the design lies.
#[derive(Clone, Copy, Debug)]
pub struct Lie<'a> {
    /// The given line.
    pub line: &'a Line,
    /// Platform and slopes; with ground cut off at it.
    pub design: &'a Tin,
    /// The line work of the design: its hinges are where the slopes begin.
    pub lines: &'a [LineFeature],
    /// The ground, in the frame of the design.
    pub ground: Option<&'a Terrain>,
    /// The axes with their stations, in that frame.
    pub stations: &'a Stations,
    /// The slopes asked for.
    pub slopes: Slopes,
    /// How far heights may differ and still be the same, in the length unit.
    pub tolerance: f64,
}

/// The stakes of a design.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Staked {
    /// By axis, station, side and way.
    pub stakes: Vec<Stake>,
    /// Sides of stations that have a slope but not both of its stakes.
    pub missing: usize,
}

/// The slope stakes of every station and side: along the ruling, then perpendicular. Sides without a slope have none.
///
/// Hinges are those of the mesh, which is built from a simplified line; heights are its own, so catch points lie on the daylight
/// line of the mesh as written. The same on any number of threads.
pub fn stakes(lie: &Lie<'_>) -> Staked {
    let bounds = lie.design.plan_box();
    let frame = &lie.design.frame;
    let flattest = [lie.slopes.fill, lie.slopes.cut].into_iter().flatten().map(Slope::ratio).fold(f64::INFINITY, f64::min);
    let walk = Walk {
        lie,
        design: Drape::new(&lie.design.vertices, &lie.design.triangles, None),
        ground: lie.ground.map(|ground| Drape::new(&ground.vertices, &ground.triangles, Some(bounds))),
        line: MeshLine::new(lie.lines, frame),
        // A part of the tolerance is for the line, in height as the slopes see it.
        slack: lie.tolerance / flattest + START,
        // Farther than the mesh is wide.
        far: 2.0 * bounds.size().length().max(1.0),
    };
    let mut all = Staked::default();
    for (i, axis) in lie.stations.axes().iter().enumerate() {
        let Some(chain) = lie.line.chains.get(i) else { continue };
        let edges = Edges::of(chain, frame);
        let breaks = lie.stations.breaks(i);
        // Both ends of a ring are one place.
        let breaks = if axis.closed { &breaks[..breaks.len().saturating_sub(1)] } else { breaks };
        let at = |&station: &f64| {
            let mut found = Staked::default();
            let Some((point, along)) = place(axis, station) else { return found };
            for hand in [Hand::Left, Hand::Right] {
                let outward = hand.outward(along);
                let Some(given) = edges.hinge(axis, station, hand, (point, outward), walk.far) else { continue };
                let hinge = walk.line.built(given, walk.slack);
                let both = walk.both(&hinge, hand, outward);
                found.missing += usize::from(both.as_ref().is_some_and(|ways| ways.len() < 2));
                for (way, reached) in both.into_iter().flatten() {
                    let off = reached.catch.truncate() - point;
                    found.stakes.push(Stake {
                        chain: axis.name.clone(),
                        station,
                        hand,
                        along: way,
                        offset: (hinge.at.truncate() - point).length(),
                        hinge: frame.to_world(hinge.at),
                        part: reached.part,
                        catch: frame.to_world(reached.catch),
                        catch_offset: off.dot(outward),
                        catch_ahead: off.dot(along),
                        ends: reached.ends,
                    });
                }
            }
            found
        };
        for found in breaks.par_iter().map(at).collect::<Vec<_>>() {
            all.stakes.extend(found.stakes);
            all.missing += found.missing;
        }
    }
    all
}

/// Where a walk down a slope ended, in the local frame.
struct Reached {
    part: Option<Part>,
    catch: DVec3,
    ends: Ends,
}

/// Walks on the design.
struct Walk<'a> {
    lie: &'a Lie<'a>,
    design: Drape<'a>,
    ground: Option<Drape<'a>>,
    line: MeshLine,
    /// How far the line of the mesh may stand off the given one, in plan.
    slack: f64,
    far: f64,
}

impl Walk<'_> {
    /// From a hinge along its ruling, and perpendicular; `None` where there is no slope, unless the hinge is on the ground.
    fn both(&self, hinge: &Hinge, hand: Hand, outward: DVec2) -> Option<Vec<(Along, Reached)>> {
        let Some((part, slope)) = self.part_at(hinge, outward) else {
            let here = |way| (way, Reached { part: None, catch: hinge.at, ends: Ends::Ground });
            return self.on_ground(hinge.at).then(|| [Along::Ruling, Along::Perpendicular].map(here).into());
        };
        let ruling = match hinge.ruling(hand, part, slope) {
            Some(Ruling::Goes { direction, cone }) => {
                let share = if cone { CONE_RATE } else { STRIP_RATE };
                let fall = if part == Part::CutSlope { slope.ratio() } else { -slope.ratio() };
                self.down(hinge.at, direction, part, Some((fall, share * slope.ratio())))
            }
            Some(Ruling::Closed) => Some(Reached { part: Some(part), catch: hinge.at, ends: Ends::Crease }),
            None => None,
        };
        let across = self.down(hinge.at, outward, part, None);
        let ways = [(Along::Ruling, ruling), (Along::Perpendicular, across)];
        Some(ways.into_iter().filter_map(|(way, reached)| Some((way, reached?))).collect())
    }

    /// The part of the slope that leaves a hinge outwards.
    fn part_at(&self, hinge: &Hinge, outward: DVec2) -> Option<(Part, Slope)> {
        let run = self.run(hinge.at, outward)?;
        let part = stretches(&run).find(|(_, to, _)| to.x > START).map(|(.., t)| self.lie.design.parts[t as usize])?;
        let slope = match part {
            Part::FillSlope => self.lie.slopes.fill,
            Part::CutSlope => self.lie.slopes.cut,
            _ => None,
        };
        Some((part, slope?))
    }

    /// The design from a hinge on in a direction, where it begins there.
    fn run(&self, hinge: DVec3, direction: DVec2) -> Option<Run> {
        let from = hinge.truncate();
        in_steps(self.far, |reach| {
            let first = self.design.along(from, from + direction * reach).into_iter().next();
            let run = first.filter(|run| run.points.first().is_some_and(|p| p.x <= START));
            // One that is as long as was looked may go on.
            let last = run.as_ref().and_then(|run| run.points.last());
            let goes_on = reach < self.far && last.is_some_and(|p| p.x >= WHOLE * reach);
            (!goes_on).then_some(run)
        })
        .flatten()
    }

    /// From a hinge over one part until it ends; with `fall`, height per distance and how much it may vary, no farther than that
    /// goes on.
    fn down(&self, hinge: DVec3, direction: DVec2, part: Part, fall: Option<(f64, f64)>) -> Option<Reached> {
        let run = self.run(hinge, direction)?;
        let at = |p: DVec2| (hinge.truncate() + direction * p.x).extend(p.y);
        let mut last = run.points[0];
        for (from, to, t) in stretches(&run).filter(|(from, to, _)| to.x > START && to.x > from.x) {
            if self.lie.design.parts[t as usize] != part {
                let ends = if from.x <= START { return None } else { Ends::Platform };
                return Some(Reached { part: Some(part), catch: at(last), ends });
            }
            let rate = (to.y - from.y) / (to.x - from.x);
            // Stretches shorter than the start have no slope that could be told.
            if fall.is_some_and(|(fall, slack)| to.x - from.x > START && (rate - fall).abs() > slack) {
                return Some(Reached { part: Some(part), catch: at(last), ends: Ends::Crease });
            }
            last = to;
        }
        let catch = at(last);
        let ends = if self.on_ground(catch) { Ends::Ground } else { Ends::End };
        Some(Reached { part: Some(part), catch, ends })
    }

    /// Whether a point lies on the ground.
    fn on_ground(&self, p: DVec3) -> bool {
        let height = self.ground.as_ref().and_then(|ground| ground.at(p.truncate()));
        height.is_some_and(|(z, _)| (z - p.z).abs() <= self.lie.tolerance)
    }
}

/// Ends and triangle of every stretch of a run.
fn stretches(run: &Run) -> impl Iterator<Item = (DVec2, DVec2, u32)> {
    run.points.windows(2).zip(&run.triangles).map(|(ends, &t)| (ends[0], ends[1], t))
}
