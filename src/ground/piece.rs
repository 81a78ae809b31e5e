//! What the ground engine hands over: pieces of the works, each with the station it belongs to.

use crate::model::Part;
use glam::DVec2;

/// A corner of a [`Piece`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Corner {
    /// Plan position in the local frame.
    pub at: DVec2,
    /// Design minus ground height there: positive is fill, negative is cut.
    pub height: f64,
    /// Station of its foot point on the axis: plan distance from the axis' first point.
    pub station: f64,
}

/// A convex piece of the works over one ground triangle, corners counter-clockwise; `height` and `station` are linear over it.
///
/// Pieces of one build do not overlap in plan. Fill slopes have no negative heights, cut slopes no positive ones, except inside
/// rings: there, as on platforms, both signs count. On a cone sector the station is the same all over.
#[derive(Clone, Copy, Debug)]
pub struct Piece<'a> {
    /// What it is a piece of: platform, fill slope or cut slope.
    pub part: Part,
    /// The axis it belongs to, as an index into the list of axes; `None`: a platform without an axis, such as a pad.
    pub axis: Option<u32>,
    /// Its corners. Fewer than three make a piece without area, which counts for nothing.
    pub corners: &'a [Corner],
}

/// Pieces that were kept, one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Pieces {
    heads: Vec<(Part, Option<u32>, usize)>,
    corners: Vec<Corner>,
}

impl Pieces {
    /// Keeps a copy of a piece.
    pub fn add(&mut self, piece: &Piece<'_>) {
        self.corners.extend_from_slice(piece.corners);
        self.heads.push((piece.part, piece.axis, self.corners.len()));
    }

    /// The pieces in the order in which they were added.
    pub fn iter(&self) -> impl Iterator<Item = Piece<'_>> {
        let from = std::iter::once(0).chain(self.heads.iter().map(|head| head.2));
        let piece = |(from, &(part, axis, to)): (usize, &(Part, Option<u32>, usize))| Piece {
            part,
            axis,
            corners: &self.corners[from..to],
        };
        from.zip(&self.heads).map(piece)
    }
}

/// A line along which stations are counted: a chain of the given line, or the centre line of a road.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name in reports.
    pub name: String,
    /// Its plan length, station of its end.
    pub length: f64,
    /// Whether it is a ring.
    pub closed: bool,
    /// Its points in plan, in the local frame, each with its station; stations ascend from 0. A ring repeats its first point at
    /// the end, with the station `length`.
    pub line: Vec<(DVec2, f64)>,
}
