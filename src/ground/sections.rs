//! Cross-sections: end areas at stations and half-way, and the volumes worked out from them.
//!
//! A section is the vertical plane through a point of the axis, perpendicular to the axis in plan (at a vertex, to the mean of
//! both directions). It crosses the pieces of its own axis, and counts as far as they reach from the axis without a gap.
//!
//! On a grade the rulings of a slope do not run perpendicular to the axis but lean by `φ`, `sin φ = γ/k`. So a section also
//! crosses slopes whose foot is at other stations, and the volume between two sections is not that of the slopes that stand on
//! the stretch between them, even where both are exact: at the ends of a line, at bends, and wherever the ground changes across
//! the lean. The exact figures of [`Tally`](super::Tally) go by foot point.

mod chord;
mod fan;

use super::end_areas::{averaged, by_prismoids};
use super::stations::place;
use super::{CutFill, Piece, Stations};
use crate::kernel::sum::Sum;
use crate::model::Part;
use chord::{Chord, chord, outward};
use fan::{Fan, Plane};

/// One cross-section.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Section {
    /// Where it stands.
    pub station: f64,
    /// End areas.
    pub area: CutFill,
    /// How far the works reach to the left, seen along the axis.
    pub left: f64,
    /// How far to the right.
    pub right: f64,
}

/// An interval between two stations as sections see it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sectioned {
    /// The sections where it begins, half-way, and where it ends.
    pub sections: [Section; 3],
    /// Volumes by [`average_end_area`](super::average_end_area).
    pub average_end_area: CutFill,
    /// Volumes by the [`prismoidal`](super::prismoidal) formula.
    pub prismoidal: CutFill,
}

/// All intervals as sections see them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SectionFigures {
    /// Of each axis, the intervals between stations, as in [`Tallied::axes`](super::Tallied::axes).
    pub axes: Vec<Vec<Sectioned>>,
    /// Sum over all intervals by average end area.
    pub average_end_area: CutFill,
    /// Sum over all intervals by the prismoidal formula.
    pub prismoidal: CutFill,
}

/// Gathers what sections cross.
///
/// Platforms without an axis belong to no section. A section ends where the works end, and where they go on with slopes whose
/// foot is further along the axis than the section has come: there another part of the line has taken over, across a valley or a
/// ridge. Spacing has no part in it.
#[derive(Debug)]
pub struct Sections<'a> {
    stations: &'a Stations,
    axes: Vec<Fan>,
    /// Chords of each section of each axis.
    chords: Vec<Vec<Vec<Chord>>>,
}

impl<'a> Sections<'a> {
    /// Sections at the ends and in the middle of every interval.
    pub fn new(stations: &'a Stations) -> Self {
        let fan = |(i, axis)| {
            let breaks = stations.breaks(i);
            let middles = breaks.windows(2).map(|ends| 0.5 * (ends[0] + ends[1]));
            let mut at: Vec<f64> = breaks.iter().copied().zip(middles).flat_map(<[f64; 2]>::from).collect();
            at.extend(breaks.last());
            let planes =
                at.into_iter().filter_map(|station| place(axis, station).map(|(point, along)| Plane { point, along, station }));
            Fan::new(planes.collect())
        };
        let axes: Vec<Fan> = stations.axes().iter().enumerate().map(fan).collect();
        let chords = axes.iter().map(|fan| vec![Vec::new(); fan.planes().len()]).collect();
        Self { stations, axes, chords }
    }

    /// Adds a piece: sections of its axis that cross it take note.
    pub fn add(&mut self, piece: &Piece<'_>) {
        let Some(axis) = piece.axis.map(|axis| axis as usize) else { return };
        let (Some(fan), Some(chords)) = (self.axes.get(axis), self.chords.get_mut(axis)) else { return };
        if piece.corners.len() < 3 || piece.part == Part::Ground {
            return;
        }
        fan.near(piece.corners, |i, plane| chords[i].extend(chord(plane, piece)));
    }

    /// The figures.
    pub fn finish(mut self) -> SectionFigures {
        let mut figures = SectionFigures::default();
        let mut sums = [Sum::default(); 4];
        for (i, axis) in self.stations.axes().iter().enumerate() {
            let breaks = self.stations.breaks(i);
            let slack = self.stations.slack();
            let ring = axis.closed.then_some(axis.length);
            let planes = self.axes[i].planes();
            let sections: Vec<Section> =
                planes.iter().zip(&mut self.chords[i]).map(|(plane, chords)| section(plane, chords, slack, ring)).collect();
            let mut intervals = Vec::with_capacity(breaks.len());
            for (k, ends) in breaks.windows(2).enumerate() {
                // An axis without length has no sections.
                let at = |j: usize| sections.get(2 * k + j).copied().unwrap_or_default();
                let three = [at(0), at(1), at(2)];
                let [from, middle, to] = three.map(|section| section.area);
                let length = ends[1] - ends[0];
                let average_end_area = averaged(length, from, to);
                let prismoidal = by_prismoids(length, from, middle, to);
                let terms = [average_end_area.cut, average_end_area.fill, prismoidal.cut, prismoidal.fill];
                sums.iter_mut().zip(terms).for_each(|(sum, term)| sum.add(term));
                intervals.push(Sectioned { sections: three, average_end_area, prismoidal });
            }
            figures.axes.push(intervals);
        }
        let [a, b, c, d] = sums.map(|sum| sum.value());
        figures.average_end_area = CutFill { cut: a, fill: b };
        figures.prismoidal = CutFill { cut: c, fill: d };
        figures
    }
}

/// Cross-sections of one axis at chosen stations, in their order: the figures of [`Sections`] at any station.
pub fn sections_at<'a>(pieces: impl Iterator<Item = Piece<'a>>, stations: &Stations, axis: usize, at: &[f64]) -> Vec<Section> {
    let Some(course) = stations.axes().get(axis) else { return Vec::new() };
    let plane = |station: &f64| place(course, *station).map(|(point, along)| Plane { point, along, station: *station });
    let fan = Fan::new(at.iter().filter_map(plane).collect());
    let mut chords = vec![Vec::new(); fan.planes().len()];
    for piece in pieces.filter(|p| p.axis == u32::try_from(axis).ok() && p.corners.len() > 2 && p.part != Part::Ground) {
        fan.near(piece.corners, |i, plane| chords[i].extend(chord(plane, &piece)));
    }
    let slack = stations.slack();
    let ring = course.closed.then_some(course.length);
    fan.planes().iter().zip(&mut chords).map(|(plane, chords)| section(plane, chords, slack, ring)).collect()
}

/// The section in a plane from what it crosses.
fn section(plane: &Plane, chords: &mut [Chord], slack: f64, ring: Option<f64>) -> Section {
    let (left, left_area) = outward(chords, plane.station, slack, ring);
    chords.iter_mut().for_each(Chord::mirror);
    let (right, right_area) = outward(chords, plane.station, slack, ring);
    let area = CutFill { cut: left_area.cut + right_area.cut, fill: left_area.fill + right_area.fill };
    Section { station: plane.station, area, left, right }
}

#[cfg(test)]
mod tests;
