//! A stated slope and how much of the surface keeps it.

use super::faces::Faces;
use super::finding::{Collector, Kind, Place};
use super::shape::{LEVEL_DEG, Shape, Share, Tally};
use crate::model::Slope;

/// A slope that triangles are to have.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The slope.
    pub slope: Slope,
    /// Triangles whose angle deviates by no more are on it, in degrees.
    pub tolerance_deg: f64,
    /// Greatest share of the area that may be off it, 0 to 1.
    pub most_off: f64,
    /// Groups it is about; `None`: all triangles that are not level, that is flatter than [`LEVEL_DEG`] and off the slope.
    pub groups: Option<Vec<u32>>,
}

/// How much of the surface keeps a [`Bound`].
#[derive(Clone, Debug, PartialEq)]
pub struct Kept {
    /// Triangles on the slope.
    pub within: Share,
    /// Triangles off it.
    pub off: Share,
    /// Their share of the area of both, 0 to 1.
    pub off_share: f64,
    /// Triangles too low for an angle to be told; they are neither.
    pub thin: Share,
    /// Level triangles left out.
    pub level: Share,
    /// Whether the bound is kept: something is on the slope, and no more off it than may be.
    pub passed: bool,
    /// Triangles off the slope that deviate most, worst first, with `slope_deg` and `deviation_deg`.
    pub worst: Vec<Place>,
}

/// A bound while triangles are compared with it.
pub(super) struct Measured<'a> {
    bound: &'a Bound,
    wanted: f64,
    within: Tally,
    off: Tally,
    thin: Tally,
    level: Tally,
    worst: Collector,
}

impl<'a> Measured<'a> {
    pub(super) fn new(bound: &'a Bound, keep: usize) -> Self {
        let [within, off, thin, level] = [Tally::default(); 4];
        // The collector's kind is not used: its places are.
        Self { bound, wanted: bound.slope.degrees(), within, off, thin, level, worst: Collector::new(Kind::Thin, keep) }
    }

    /// Compares triangle `f` of the given group.
    pub(super) fn add(&mut self, faces: &Faces<'_>, f: usize, group: u32, shape: &Shape) {
        if self.bound.groups.as_ref().is_some_and(|groups| !groups.contains(&group)) {
            return;
        }
        let deviation = (shape.slope - self.wanted).abs();
        if shape.thin() {
            self.thin.add(shape.area);
        } else if deviation <= self.bound.tolerance_deg {
            self.within.add(shape.area);
        } else if self.bound.groups.is_none() && shape.slope < LEVEL_DEG {
            self.level.add(shape.area);
        } else {
            self.off.add(shape.area);
            self.worst.add(deviation, || {
                let mut place = faces.place(faces.centre(f), &[f], &[]);
                place.figures = vec![("slope_deg", shape.slope), ("deviation_deg", deviation)];
                place
            });
        }
    }

    pub(super) fn finish(self) -> Kept {
        let [within, off, thin, level] = [self.within, self.off, self.thin, self.level].map(|tally| tally.share());
        let both = within.area + off.area;
        let off_share = if both > 0.0 { off.area / both } else { 0.0 };
        let passed =
            within.triangles > 0 && (off.triangles == 0 || off_share <= self.bound.most_off && self.bound.most_off > 0.0);
        Kept { within, off, off_share, thin, level, passed, worst: self.worst.places() }
    }
}
