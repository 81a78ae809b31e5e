//! Stations of places on the line that are known by given vertices.

use crate::model::{Chain, Line};
use crate::slope::network::{Edge, Given};

/// Stations of the vertices of each chain.
pub(super) struct Stations {
    of_vertices: Vec<Vec<f64>>,
    /// Length of rings whose stations are their own.
    rings: Vec<Option<f64>>,
}

impl Stations {
    /// Distances along the chains.
    pub(super) fn along(line: &Line) -> Self {
        let of_vertices: Vec<Vec<f64>> = line.chains.iter().map(Chain::stations).collect();
        let length = |(chain, own): (&Chain, &Vec<f64>)| own.last().copied().filter(|_| chain.closed());
        let rings = line.chains.iter().zip(&of_vertices).map(length).collect();
        Self { of_vertices, rings }
    }

    /// Stations on the centre line where a chain has one, else along the chain.
    pub(super) fn on_axes(line: &Line) -> Self {
        let mut stations = Self::along(line);
        for (c, axis) in line.chains.iter().enumerate().filter_map(|(c, chain)| Some((c, chain.axis.as_ref()?))) {
            stations.of_vertices[c].clone_from(&axis.stations);
            stations.rings[c] = None;
        }
        stations
    }

    /// Station of a place on the line; of a ring's first vertex after its last one, the ring's length.
    pub(super) fn at(&self, given: Given) -> f64 {
        let stations = &self.of_vertices[given.chain as usize];
        let from = stations[given.vertex as usize];
        let to = stations.get(given.vertex as usize + 1).copied().unwrap_or(from);
        from + given.part * (to - from)
    }

    /// A station from the length of a ring on, as one from nought: there the ring begins.
    pub(super) fn on_ring(&self, edge: &Edge, station: f64) -> f64 {
        let ring = self.rings[edge.given[0].chain as usize];
        ring.filter(|length| station >= *length).map_or(station, |length| station - length)
    }

    /// Stations of two places on an edge, in its direction. Where it runs over the first vertex of a ring between them, the later
    /// one counts on past the length of the ring.
    pub(super) fn counting_on(&self, edge: &Edge, [first, second]: [f64; 2]) -> [f64; 2] {
        let length = self.rings[edge.given[0].chain as usize].unwrap_or(0.0);
        match edge.against {
            false if second < first => [first, second + length],
            true if first < second => [first + length, second],
            _ => [first, second],
        }
    }
}
