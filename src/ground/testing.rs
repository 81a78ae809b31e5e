//! For tests: axes and pieces made by hand.

use super::{Axis, Corner};
use glam::DVec2;

/// An open axis along +x from the origin.
pub(super) fn straight_axis(length: f64) -> Axis {
    let line = vec![(DVec2::ZERO, 0.0), (DVec2::new(length, 0.0), length)];
    Axis { name: "road".into(), length, closed: false, line }
}

/// A ring through points.
pub(super) fn closed_axis(points: &[(f64, f64)]) -> Axis {
    let mut axis = open_axis(&[points, &points[..1]].concat());
    axis.closed = true;
    axis
}

/// An open axis through points.
pub(super) fn open_axis(points: &[(f64, f64)]) -> Axis {
    let mut line: Vec<(DVec2, f64)> = Vec::new();
    for &p in points {
        let at = DVec2::from(p);
        let station = line.last().map_or(0.0, |(from, station)| station + from.distance(at));
        line.push((at, station));
    }
    Axis { name: "line".into(), length: line[line.len() - 1].1, closed: false, line }
}

/// A corner whose station is its x.
pub(super) fn corner(x: f64, y: f64, height: f64) -> Corner {
    Corner { at: DVec2::new(x, y), height, station: x }
}

/// A generator of numbers in [0, 1): Weyl's sequence scrambled as in SplitMix64.
pub(super) struct Random(pub(super) u64);

impl Random {
    pub(super) fn unit(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 53) as f64
    }

    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}
