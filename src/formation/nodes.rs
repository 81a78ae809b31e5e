//! Points that several lines share: one number and one position for all within the merge distance.

use crate::validate::MERGE_DISTANCE;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// Points no two of which lie within [`MERGE_DISTANCE`] in plan.
#[derive(Default)]
pub(super) struct Nodes {
    pub(super) points: Vec<DVec3>,
    cells: FxHashMap<[i64; 2], Vec<u32>>,
}

impl Nodes {
    fn cell(p: DVec2) -> [i64; 2] {
        // Coordinates are below 1e9 in magnitude, so cells fit with room to spare.
        (p / MERGE_DISTANCE).floor().as_i64vec2().to_array()
    }

    /// The node at a place, if there is one.
    pub(super) fn find(&self, p: DVec2) -> Option<u32> {
        let [x, y] = Self::cell(p);
        let around = (-1..=1).flat_map(|i| (-1..=1).map(move |j| [x + i, y + j]));
        around
            .filter_map(|cell| self.cells.get(&cell))
            .flatten()
            .copied()
            .find(|&n| self.points[n as usize].truncate().distance(p) <= MERGE_DISTANCE)
    }

    /// The node at a place, a new one if need be; the height of one that is there stays.
    pub(super) fn at(&mut self, p: DVec3) -> u32 {
        self.find(p.truncate()).unwrap_or_else(|| {
            let n = self.points.len() as u32;
            self.points.push(p);
            self.cells.entry(Self::cell(p.truncate())).or_default().push(n);
            n
        })
    }

    /// Plan position.
    pub(super) fn plan(&self, n: u32) -> DVec2 {
        self.points[n as usize].truncate()
    }
}
