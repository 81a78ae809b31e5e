//! Stations: where along the axes figures are told apart.

use super::Axis;
use crate::kernel::frame::Frame;
use crate::model::{Chain, Line};
use glam::{DVec2, DVec3};
use std::fmt;

/// Most breaks inside the axes, all together. Each begins a row of the report; a road of 1000 km has as many at 10 m.
pub const MOST_STATIONS: usize = 100_000;

/// A last interval shorter than this, in the length unit, is rounding of the length: it belongs to the one before.
const SHORTEST: f64 = 1e-6;

/// A station this near a vertex of the axis, in the length unit, is at the vertex.
const AT_VERTEX: f64 = 1e-6;

/// The axes and their intervals, the same for volumes and cross-sections.
#[derive(Clone, Debug, PartialEq)]
pub struct Stations {
    axes: Vec<Axis>,
    spacing: Option<f64>,
    slack: f64,
    /// Of each axis: ends of its intervals, ascending, from 0 to its length; at least two.
    breaks: Vec<Vec<f64>>,
}

/// A spacing that would give more than [`MOST_STATIONS`] breaks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TooManyStations {
    /// The spacing asked for.
    pub spacing: f64,
    /// Length of all axes.
    pub length: f64,
}

impl fmt::Display for TooManyStations {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let least = 2.0 * self.length / MOST_STATIONS as f64;
        // Rounded up to one digit, so that following the advice helps.
        let digit = 10f64.powf(least.log10().floor());
        write!(
            f,
            "there would be too many stations\n  --> --stations {}\n   = axes of length {:.3} in all; at most {MOST_STATIONS} \
             breaks\n   = help: give a spacing of {} or more",
            self.spacing,
            self.length,
            (least / digit).ceil() * digit
        )
    }
}

impl std::error::Error for TooManyStations {}

impl Stations {
    /// Breaks at the whole multiples of `spacing` along every axis, the last interval shorter; without a spacing each axis is one
    /// interval. A spacing that is not positive counts as none.
    ///
    /// # Errors
    /// [`TooManyStations`].
    pub fn new(axes: Vec<Axis>, spacing: Option<f64>) -> Result<Self, TooManyStations> {
        let spacing = spacing.filter(|d| *d > 0.0);
        if let Some(spacing) = spacing {
            let length: f64 = axes.iter().map(|axis| axis.length).sum();
            let inside = |axis: &Axis| if axis.length > spacing { (axis.length / spacing).ceil() - 1.0 } else { 0.0 };
            let count: f64 = axes.iter().map(inside).sum();
            if count > MOST_STATIONS as f64 {
                return Err(TooManyStations { spacing, length });
            }
        }
        let breaks = axes.iter().map(|axis| breaks(axis.length, spacing)).collect();
        Ok(Self { axes, spacing, slack: 0.0, breaks })
    }

    /// The same for works that stand off the axes by up to `slack`, in plan: the line they are built from is a simplified one.
    #[must_use]
    pub fn standing_off(self, slack: f64) -> Self {
        Self { slack, ..self }
    }

    /// How far the works may stand off the axes, in plan.
    pub fn slack(&self) -> f64 {
        self.slack
    }

    /// The axes.
    pub fn axes(&self) -> &[Axis] {
        &self.axes
    }

    /// The spacing asked for.
    pub fn spacing(&self) -> Option<f64> {
        self.spacing
    }

    /// Ends of the intervals of an axis, ascending, one more than there are intervals; empty for an axis there is not.
    pub fn breaks(&self, axis: usize) -> &[f64] {
        self.breaks.get(axis).map_or(&[], Vec::as_slice)
    }
}

fn breaks(length: f64, spacing: Option<f64>) -> Vec<f64> {
    let mut breaks = vec![0.0];
    if let Some(spacing) = spacing {
        let inner = (1..).map(|i: u32| f64::from(i) * spacing).take_while(|s| *s < length - SHORTEST);
        breaks.extend(inner);
    }
    breaks.push(length);
    breaks
}

/// The chains of a line as axes, in a frame: of a road its centre line.
pub fn axes(line: &Line, frame: &Frame) -> Vec<Axis> {
    let local = |p: &DVec3| frame.to_local(*p).truncate();
    let own = |chain: &Chain| {
        let stations = chain.stations();
        let closing = chain.closed().then(|| &chain.vertices[0]);
        let line = chain.vertices.iter().chain(closing).map(local).zip(stations.iter().copied()).collect();
        Axis { name: chain.name.clone(), length: stations.last().copied().unwrap_or(0.0), closed: chain.closed(), line }
    };
    let of_road = |(index, chain): (usize, &Chain)| {
        let axis = chain.axis.as_ref()?;
        let centre = line.breaklines.iter().find(|b| b.of == Some(index) && b.stations.is_some())?;
        let stations = centre.stations.iter().flatten().copied();
        let line = centre.vertices.iter().map(local).zip(stations).collect();
        Some(Axis { name: axis.name.clone(), length: axis.length, closed: false, line })
    };
    line.chains.iter().enumerate().map(|(i, chain)| of_road((i, chain)).unwrap_or_else(|| own(chain))).collect()
}

/// The interval a station lies in: at a break the one that begins there, except at the very end.
pub(super) fn interval_of(breaks: &[f64], station: f64) -> usize {
    let begun = breaks.partition_point(|b| *b <= station);
    begun.saturating_sub(1).min(breaks.len().saturating_sub(2))
}

/// Where a station lies on an axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spot {
    /// A segment that the station lies on, counted along the axis.
    pub segment: usize,
    /// The share of it before the station; 0 or 1 at a vertex.
    pub share: f64,
    /// The segment that comes in and the one that goes out: between vertices both are the same, at an end of an open axis one is
    /// missing.
    pub segments: [Option<usize>; 2],
}

impl Spot {
    /// The spot of a station; `None` on an axis without segments.
    pub fn of(axis: &Axis, station: f64) -> Option<Self> {
        let line = &axis.line;
        let count = line.len().checked_sub(1).filter(|n| *n > 0)?;
        let i = line.partition_point(|v| v.1 <= station).saturating_sub(1).min(count - 1);
        let (s0, s1) = (line[i].1, line[i + 1].1);
        let before = if i > 0 { Some(i - 1) } else { axis.closed.then_some(count - 1) };
        let after = if i + 1 < count { Some(i + 1) } else { axis.closed.then_some(0) };
        let (share, segments) = if station - s0 <= AT_VERTEX {
            (0.0, [before, Some(i)])
        } else if s1 - station <= AT_VERTEX {
            (1.0, [Some(i), after])
        } else {
            ((station - s0) / (s1 - s0), [Some(i), Some(i)])
        };
        Some(Self { segment: i, share, segments })
    }
}

/// Point and unit direction of an axis at a station. At a vertex the direction is the mean of both neighbours.
pub fn place(axis: &Axis, station: f64) -> Option<(DVec2, DVec2)> {
    let spot = Spot::of(axis, station)?;
    let direction = |i: usize| {
        let ends = axis.line.get(i).zip(axis.line.get(i + 1));
        ends.map_or(DVec2::ZERO, |(a, b)| (b.0 - a.0).normalize_or_zero())
    };
    let (from, to) = (axis.line[spot.segment].0, axis.line[spot.segment + 1].0);
    let at = if spot.share == 1.0 { to } else { from.lerp(to, spot.share) };
    let own = direction(spot.segment);
    let [before, after] = spot.segments.map(|i| i.map_or(DVec2::ZERO, direction));
    // A line that turns back on itself has no mean direction there.
    let mean = (before + after).normalize_or_zero();
    Some((at, if mean == DVec2::ZERO { own } else { mean }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::ground::testing::{closed_axis, straight_axis};

    #[test]
    fn breaks_are_multiples_and_the_last_is_shorter() {
        let of = |length, spacing| Stations::new(vec![straight_axis(length)], spacing).unwrap().breaks(0).to_vec();
        assert_eq!(of(50.0, Some(20.0)), [0.0, 20.0, 40.0, 50.0]);
        assert_eq!(of(40.0 + 1e-9, Some(20.0)), [0.0, 20.0, 40.0 + 1e-9]);
        assert_eq!(of(40.0 - 1e-9, Some(20.0)), [0.0, 20.0, 40.0 - 1e-9]);
        assert_eq!(of(5.0, Some(20.0)), [0.0, 5.0]);
        assert_eq!(of(5.0, None), [0.0, 5.0]);
        assert_eq!(of(5.0, Some(-1.0)), [0.0, 5.0]);
    }

    #[test]
    fn too_many_are_refused_with_a_spacing_that_does() {
        let error = Stations::new(vec![straight_axis(1000.0), straight_axis(1000.0)], Some(1e-3)).unwrap_err();
        assert_eq!(
            error.to_string(),
            "there would be too many stations\n  --> --stations 0.001\n   = axes of length 2000.000 in all; at most 100000 \
             breaks\n   = help: give a spacing of 0.04 or more"
        );
        assert!(Stations::new(vec![straight_axis(1000.0); 2], Some(0.04)).is_ok());
        // Lines without length, or with none that is a number, have one interval.
        for length in [0.0, f64::NAN] {
            assert_eq!(Stations::new(vec![straight_axis(length)], Some(1.0)).unwrap().breaks(0).len(), 2);
        }
        assert!(Stations::new(vec![straight_axis(f64::INFINITY)], Some(1.0)).is_err());
        assert!(Stations::new(vec![straight_axis(1.0)], Some(5e-324)).is_err());
    }

    #[test]
    fn a_break_belongs_to_the_interval_that_begins_there() {
        let breaks = [0.0, 20.0, 40.0, 50.0];
        for (station, interval) in [(-1.0, 0), (0.0, 0), (19.99, 0), (20.0, 1), (40.0, 2), (50.0, 2), (51.0, 2)] {
            assert_eq!(interval_of(&breaks, station), interval, "{station}");
        }
    }

    #[test]
    fn directions_at_vertices_are_means() {
        let square = closed_axis(&[(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]);
        let diagonal = DVec2::splat(0.5f64.sqrt());
        let (at, direction) = place(&square, 10.0).unwrap();
        assert_eq!(at, DVec2::new(10.0, 0.0));
        assert!(direction.distance(diagonal) < 1e-15);
        // Both ends of a ring are one place.
        for station in [0.0, 40.0] {
            let (at, direction) = place(&square, station).unwrap();
            assert_eq!(at, DVec2::ZERO);
            assert!(direction.distance(DVec2::new(diagonal.x, -diagonal.y)) < 1e-15, "{station} {direction}");
        }
        assert_eq!(place(&square, 15.0), Some((DVec2::new(10.0, 5.0), DVec2::Y)));
        let back = Axis { line: vec![(DVec2::ZERO, 0.0), (DVec2::X, 1.0), (DVec2::ZERO, 2.0)], length: 2.0, ..square };
        assert_eq!(place(&back, 1.0).unwrap().1.abs(), DVec2::X);
        assert_eq!(place(&Axis { line: vec![], ..back }, 1.0), None);
    }
}
