//! For tests: axes and pieces made by hand.

use super::{Axis, Corner};
pub(super) use crate::kernel::testing::Random;
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
