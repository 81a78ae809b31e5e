//! All that is known once the works are cut: what figures, certificate and line work are taken from.

use super::cell::class;
use super::feeder::Fed;
use super::finished::Left;
use super::nodes::Nodes;
use super::patch::Patch;
use super::shape::Shape;
use super::stations::Stations;
use super::trimmed::Trimmed;
use super::works::{Border, Works};
use crate::model::{Design, Line, Note, Part, Terrain};
use crate::surface::Surface;

/// All that has been found.
pub(crate) struct Found<'a> {
    pub(crate) line: &'a Line,
    pub(crate) designs: &'a [Design],
    pub(crate) terrain: &'a Terrain,
    pub(crate) surfaces: &'a [Surface],
    pub(crate) shape: &'a Shape,
    pub(crate) patch: &'a Patch,
    pub(crate) works: &'a Works,
    pub(crate) nodes: &'a Nodes,
    pub(crate) trimmed: &'a Trimmed,
    /// The design as it is part of the finished ground: no further than the ground.
    pub(crate) within: &'a Trimmed,
    pub(crate) left: Option<&'a Left>,
    pub(crate) fed: &'a Fed,
    /// Whether there is ground below all of line and platform.
    pub(crate) covered: bool,
    pub(crate) stations: &'a Stations,
    pub(crate) notes: &'a [Note],
}

impl Found<'_> {
    /// The boundary where design and ground meet, from vertex to vertex, as numbers of nodes.
    pub(crate) fn daylight(&self) -> Vec<([u32; 2], Part)> {
        let ends = |border: &Border| {
            if class(border.height) != 0 {
                return None;
            }
            let (from, to) = (self.nodes.meeting(border.from)?, self.nodes.meeting(border.to)?);
            (from != to).then_some(([from, to], self.shape.parts[border.a as usize]))
        };
        let borders = self.works.daylight.iter().chain(&self.works.borders);
        borders.filter_map(ends).flat_map(|(ends, part)| self.nodes.pieces(ends).into_iter().map(move |e| (e, part))).collect()
    }
}
