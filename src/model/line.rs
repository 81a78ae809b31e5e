//! The given line: one or more 3D polylines and rings.

use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;
use glam::DVec3;

/// Where a vertex stands in its file, for messages. All numbers count from 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// Feature of a GeoJSON file (its position in the collection).
    pub feature: Option<u32>,
    /// Vertex within its line or ring, as given.
    pub vertex: u32,
    /// Row of a text file.
    pub row: Option<u32>,
}

/// What a chain bounds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// An open polyline.
    Open,
    /// The outer ring of polygon `polygon` (counted from 0 over the whole input).
    Outer {
        /// Polygon index.
        polygon: u32,
    },
    /// A hole in polygon `polygon`.
    Hole {
        /// Polygon index.
        polygon: u32,
    },
}

/// One polyline or ring, as given except that exact repetitions are merged.
///
/// Invariants (kept by validation): at least two vertices, three for rings; all finite; neighbours distinct in plan; a ring
/// does not repeat its first vertex at the end.
#[derive(Clone, Debug, PartialEq)]
pub struct Chain {
    /// Name for messages: the feature's id or name, else `line 1`, `line 2`, …
    pub name: String,
    /// What the chain bounds.
    pub role: Role,
    /// Vertices in world coordinates.
    pub vertices: Vec<DVec3>,
    /// Where each vertex stands in the file; same length as `vertices`.
    pub places: Vec<Place>,
    /// The centre line, where the chain is the edge of a road made from one. Its stations are then those of the chain.
    pub axis: Option<Axis>,
}

/// The centre line a ring was made from.
#[derive(Clone, Debug, PartialEq)]
pub struct Axis {
    /// Name of the centre line, for messages.
    pub name: String,
    /// Its plan length.
    pub length: f64,
    /// Station on the centre line of every vertex of the ring, and of its first vertex once more for the closing segment;
    /// between neighbours linear. The left edge rises from 0 to `length`, the right edge comes back, end caps are constant.
    pub stations: Vec<f64>,
    /// Greatest distance in plan between a rounded corner and its chords; 0 where none is rounded.
    pub sagitta: f64,
}

/// A line inside a ring that shapes the surface of its platform.
///
/// Invariants (kept by validation, and by [`crate::formation`] once `of` is set): finite, neighbours distinct in plan; inside its
/// ring or on it; it meets rings and other breaklines in common vertices only, of the same plan position bit for bit.
#[derive(Clone, Debug, PartialEq)]
pub struct Breakline {
    /// Name for messages.
    pub name: String,
    /// Vertices in world coordinates; one alone is a spot height.
    pub vertices: Vec<DVec3>,
    /// Where each vertex stands in the file; same length as `vertices`.
    pub places: Vec<Place>,
    /// Stations of the vertices, for the centre line of a road.
    pub stations: Option<Vec<f64>>,
    /// The chain whose platform it shapes; `None` until it has been placed.
    pub of: Option<usize>,
}

impl Chain {
    /// Whether the chain is a ring.
    pub fn closed(&self) -> bool {
        self.role != Role::Open
    }

    /// Number of segments.
    pub fn segment_count(&self) -> usize {
        if self.closed() { self.vertices.len() } else { self.vertices.len() - 1 }
    }

    /// End points of segment `i`.
    pub fn segment(&self, i: usize) -> (DVec3, DVec3) {
        (self.vertices[i], self.vertices[(i + 1) % self.vertices.len()])
    }

    /// Stations of the vertices: plan distance along the chain from its first vertex; for rings one more entry, the whole
    /// length. In the input's length unit.
    pub fn stations(&self) -> Vec<f64> {
        let mut station = 0.0;
        let mut stations = vec![0.0];
        for i in 0..self.segment_count() {
            let (a, b) = self.segment(i);
            station += a.truncate().distance(b.truncate());
            stations.push(station);
        }
        stations
    }
}

/// The given line `C`: all chains of one input. Together they carry one surface.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line {
    /// The chains, in the order of the file.
    pub chains: Vec<Chain>,
    /// Lines and points inside rings; the slopes know nothing of them.
    pub breaklines: Vec<Breakline>,
}

impl Line {
    /// Number of vertices over all chains.
    pub fn vertex_count(&self) -> usize {
        self.chains.iter().map(|chain| chain.vertices.len()).sum()
    }

    /// Lowest and highest elevation of the line.
    pub fn elevation_range(&self) -> (f64, f64) {
        range(self.vertices().map(|v| v.z))
    }

    /// Plan box of all vertices.
    pub fn plan_box(&self) -> PlanBox {
        PlanBox::of(self.vertices().map(|v| v.truncate()))
    }

    fn vertices(&self) -> impl Iterator<Item = &DVec3> {
        self.chains.iter().flat_map(|chain| &chain.vertices)
    }
}
