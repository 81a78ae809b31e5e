//! Cut and fill of pieces, over all, by part and by station.

mod clip;

pub(super) use clip::split;

use super::stations::interval_of;
use super::{Corner, Piece, Stations};
use crate::kernel::sum::Sum;
use crate::mesh::volume::{positive_part, positive_share};
use crate::model::Part;
use glam::DVec2;

/// Volumes and plan areas; none negative.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Amounts {
    /// Volume to be dug away.
    pub cut: f64,
    /// Volume to be brought.
    pub fill: f64,
    /// Plan area of cut.
    pub cut_area: f64,
    /// Plan area of fill.
    pub fill_area: f64,
    /// Plan area where design and ground are the same.
    pub level_area: f64,
}

impl Amounts {
    /// Cut − fill: positive is left over, negative is lacking.
    pub fn net(&self) -> f64 {
        self.cut - self.fill
    }

    /// Plan area of all of it.
    pub fn plan_area(&self) -> f64 {
        self.cut_area + self.fill_area + self.level_area
    }

    /// The sum of some, compensated.
    pub fn sum<'a>(amounts: impl IntoIterator<Item = &'a Self>) -> Self {
        let mut sums = Sums::default();
        for a in amounts {
            sums.add([a.cut, a.fill, a.cut_area, a.fill_area, a.level_area]);
        }
        sums.value()
    }
}

/// What is found between two stations of an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Interval {
    /// Station where it begins.
    pub from: f64,
    /// Station where it ends.
    pub to: f64,
    /// Its amounts.
    pub amounts: Amounts,
}

/// The greatest depth of cut or of fill.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deepest {
    /// The depth, vertical; positive.
    pub depth: f64,
    /// Where, in plan, in the local frame.
    pub at: DVec2,
    /// The part it is found in.
    pub part: Part,
    /// Axis and station; `None` on a platform without an axis.
    pub station: Option<(u32, f64)>,
}

/// All figures of a build.
#[derive(Clone, Debug, PartialEq)]
pub struct Tallied {
    /// Of everything: the sum of all intervals and of `pads`.
    pub total: Amounts,
    /// Of the platform, with and without axis.
    pub platform: Amounts,
    /// Of the fill slopes.
    pub fill_slope: Amounts,
    /// Of the cut slopes.
    pub cut_slope: Amounts,
    /// Of each axis, the intervals between stations, ascending, without gaps from 0 to its length.
    pub axes: Vec<Vec<Interval>>,
    /// Of platforms without an axis.
    pub pads: Amounts,
    /// Greatest depth of cut, where there is cut; of equal ones the first.
    pub deepest_cut: Option<Deepest>,
    /// Greatest depth of fill likewise.
    pub deepest_fill: Option<Deepest>,
}

/// Sums up pieces.
///
/// A piece that reaches over a station is cut there, along the straight line on which its stations are those of the break: the
/// shares are exact, and add up to the piece. A piece with one station all over (of a cone sector) goes to one interval, at a
/// break to the one that begins there, at the very end to the last.
///
/// # Accuracy
/// Rounding of each piece relative to itself; sums are compensated. Intervals and pads add up to the total to a few units in the
/// last place. When all heights change sign, cut and fill change places bit for bit.
#[derive(Debug)]
pub struct Tally<'a> {
    stations: &'a Stations,
    /// Rows of all axes one after the other, each by part, and last the one of platforms without an axis.
    rows: Vec<[Sums; 3]>,
    /// First row of each axis.
    first: Vec<usize>,
    /// Deepest cut and fill so far.
    deepest: [Option<Deepest>; 2],
    /// Room for clipping: what lies before a station, what lies behind, what is left to be cut.
    scratch: [Vec<Corner>; 3],
}

impl<'a> Tally<'a> {
    /// Nothing yet.
    pub fn new(stations: &'a Stations) -> Self {
        let mut first = Vec::with_capacity(stations.axes().len());
        let mut count = 0;
        for axis in 0..stations.axes().len() {
            first.push(count);
            count += stations.breaks(axis).len() - 1;
        }
        Self { stations, rows: vec![Default::default(); count + 1], first, deepest: [None; 2], scratch: Default::default() }
    }

    /// Adds a piece. An axis that is not in the list counts as none; existing ground is no work and counts for nothing.
    pub fn add(&mut self, piece: &Piece<'_>) {
        let corners = piece.corners;
        if corners.len() < 3 || piece.part == Part::Ground {
            return;
        }
        self.look_deep(piece);
        let part = piece.part;
        let axis = piece.axis.map(|axis| axis as usize).filter(|axis| *axis < self.first.len());
        let Some(axis) = axis else {
            if let Some(pads) = self.rows.last_mut() {
                put(pads, part, corners);
            }
            return;
        };
        let breaks = self.stations.breaks(axis);
        let (low, high) =
            corners.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), c| (low.min(c.station), high.max(c.station)));
        let mut row = interval_of(breaks, low);
        let first = self.first[axis];
        let ends = |row: usize| breaks.get(row + 1).filter(|_| row + 2 < breaks.len()).copied();
        let [before, behind, rest] = &mut self.scratch;
        let mut whole = true;
        while let Some(end) = ends(row).filter(|end| *end < high) {
            clip::split(if whole { corners } else { rest }, end, before, behind);
            put(&mut self.rows[first + row], part, before);
            std::mem::swap(behind, rest);
            whole = false;
            row += 1;
        }
        put(&mut self.rows[first + row], part, if whole { corners } else { rest });
    }

    fn look_deep(&mut self, piece: &Piece<'_>) {
        for corner in piece.corners {
            let height = corner.height;
            let (deepest, depth) = if height < 0.0 { (&mut self.deepest[0], -height) } else { (&mut self.deepest[1], height) };
            if depth > deepest.map_or(0.0, |deepest| deepest.depth) {
                let station = piece.axis.map(|axis| (axis, corner.station));
                *deepest = Some(Deepest { depth, at: corner.at, part: piece.part, station });
            }
        }
    }

    /// The figures.
    pub fn finish(self) -> Tallied {
        let all = |part: Part| Amounts::sum(&self.rows.iter().map(|row| row[part as usize].value()).collect::<Vec<_>>());
        let row = |row: &[Sums; 3]| Amounts::sum(&row.map(|sums| sums.value()));
        let rows: Vec<Amounts> = self.rows.iter().map(row).collect();
        let axes = (0..self.first.len()).map(|axis| {
            let ends = self.stations.breaks(axis).windows(2);
            ends.zip(&rows[self.first[axis]..]).map(|(ends, a)| Interval { from: ends[0], to: ends[1], amounts: *a }).collect()
        });
        Tallied {
            total: Amounts::sum(&rows),
            platform: all(Part::Platform),
            fill_slope: all(Part::FillSlope),
            cut_slope: all(Part::CutSlope),
            axes: axes.collect(),
            pads: rows.last().copied().unwrap_or_default(),
            deepest_cut: self.deepest[0],
            deepest_fill: self.deepest[1],
        }
    }
}

/// Running sums of [`Amounts`].
#[derive(Clone, Copy, Debug, Default)]
struct Sums([Sum; 5]);

impl Sums {
    fn add(&mut self, terms: [f64; 5]) {
        for (sum, term) in self.0.iter_mut().zip(terms) {
            sum.add(term);
        }
    }

    fn value(&self) -> Amounts {
        // Rounding can leave a hair less than nothing.
        let [cut, fill, cut_area, fill_area, level_area] = self.0.map(|sum| sum.value().max(0.0));
        Amounts { cut, fill, cut_area, fill_area, level_area }
    }
}

/// Adds a convex polygon to the sums of its part in a row.
fn put(row: &mut [Sums; 3], part: Part, corners: &[Corner]) {
    let Some(sums) = row.get_mut(part as usize) else { return };
    let Some((apex, others)) = corners.split_first() else { return };
    let h0 = apex.height;
    for pair in others.windows(2) {
        // About the first corner: what is far from the origin loses nothing.
        let area = 0.5 * (pair[0].at - apex.at).perp_dot(pair[1].at - apex.at);
        let h = [h0, pair[0].height, pair[1].height];
        let minus = h.map(|v| -v);
        let level = if h == [0.0; 3] { area } else { 0.0 };
        sums.add([
            positive_part(area, minus),
            positive_part(area, h),
            area * positive_share(minus),
            area * positive_share(h),
            level,
        ]);
    }
}

#[cfg(test)]
mod tests;
