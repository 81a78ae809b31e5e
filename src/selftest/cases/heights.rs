//! Heights at points: `slopegen sample`.

use super::{from_segment, row};
use crate::model::Sheet;
use crate::pipeline::{Area, Lattice, Where};
use crate::selftest::formulas::section_slope;
use crate::selftest::jobs::{LINE, POINTS, features, open, points, sample, sample_raster};
use crate::selftest::{Bound, Case, Row};
use crate::write::RasterFormat;
use glam::DVec2;

const GROUP: &str = "Heights at points";

/// Heights are found by a few operations each: some units in the last place.
const FEW: Bound = Bound::Fixed(1e-12);

pub(super) fn cases() -> Vec<Case> {
    vec![level_line(), gradient(Sheet::Falling), gradient(Sheet::Rising), grid()]
}

fn height(number: usize, formula: &str, value: f64) -> Row {
    row(&format!("height of point {}", number + 1), formula, value, FEW, move |outcomes| {
        outcomes.first()?.heights()?.get(number).copied()
    })
}

fn level_line() -> Case {
    let (h, k) = (8.0, 0.5);
    let lines = [open(&[[0.0, 0.0, h], [10.0, 0.0, h]]), open(&[[0.0, 20.0, h + 1.0], [10.0, 20.0, h + 1.0]])];
    let places = [[13.0, 4.0], [5.0, 6.0], [-5.0, -12.0], [4.0, 11.0], [7.0, 0.0]];
    let rows = vec![
        height(0, "h − k·√(3² + 4²): beyond an end", h - k * 5.0),
        height(1, "h − k·6: beside the line", h - k * 6.0),
        height(2, "h − k·√(5² + 12²): beyond the other end", h - k * 13.0),
        height(3, "h + 1 − k·9: below the higher line", h + 1.0 - k * 9.0),
        height(4, "h: on the line", h),
    ];
    Case {
        group: GROUP,
        name: "about two level lines",
        files: vec![(LINE, features(&lines)), (POINTS, points(&places))],
        jobs: vec![sample(k, Sheet::Falling)],
        exact: true,
        rows,
    }
}

/// In a section perpendicular to a line of gradient g the slope k shows as √(k² − g²).
fn gradient(sheet: Sheet) -> Case {
    let (k, g, z0, t) = (0.5, 0.2, 10.0, 6.0);
    let side = section_slope(k, g);
    let line = open(&[[0.0, 0.0, z0], [24.0, 32.0, z0 + 40.0 * g]]);
    // Half-way, t to the left and to the right.
    let places = [[12.0 - 0.8 * t, 16.0 + 0.6 * t], [12.0 + 0.8 * t, 16.0 - 0.6 * t]];
    let (name, sign, formula) = match sheet {
        Sheet::Falling => ("line of gradient 20 %, falling slope", -1.0, "z − t·√(k² − g²), k = 0.5, g = 0.2"),
        Sheet::Rising => ("line of gradient 20 %, rising slope", 1.0, "z + t·√(k² − g²), k = 0.5, g = 0.2"),
    };
    let expected = z0 + 20.0 * g + sign * t * side;
    let slope = row("slope seen in the section", "√(k² − g²)", side, FEW, move |outcomes| {
        let height = *outcomes.first()?.heights()?.first()?;
        Some(sign * (height - z0 - 20.0 * g) / t)
    });
    Case {
        group: GROUP,
        name,
        files: vec![(LINE, features(&[line])), (POINTS, points(&places))],
        jobs: vec![sample(k, sheet)],
        exact: true,
        rows: vec![height(0, formula, expected), height(1, formula, expected), slope],
    }
}

/// Every node of a grid about a line with a bend.
fn grid() -> Case {
    let (h, k, size) = (20.0, 0.4, 41);
    let bend = [[-15.0, -5.0], [0.0, 5.0], [12.0, -8.0]];
    let line = open(&bend.map(|[x, y]| [x, y, h]));
    let area = Area { min: DVec2::splat(-20.0), max: DVec2::splat(20.0) };
    let at = Where::Raster(Lattice { cell: 1.0, area: Some(area) }, RasterFormat::Asc);
    let node = move |i: usize| [(i % size) as f64 - 20.0, 20.0 - (i / size) as f64, 0.0];
    let expected = move |i: usize| h - k * from_segment(node(i), bend[0], bend[1]).min(from_segment(node(i), bend[1], bend[2]));
    let rows = vec![
        row("greatest error of all nodes", "0: h − k·d from the line", 0.0, FEW, move |outcomes| {
            let heights = outcomes.first()?.raster()?;
            Some(heights.iter().enumerate().map(|(i, z)| (z - expected(i)).abs()).fold(0.0, f64::max))
        }),
        row("nodes", "41²", (size * size) as f64, Bound::Fixed(0.0), |outcomes| Some(outcomes.first()?.raster()?.len() as f64)),
    ];
    let jobs = vec![sample_raster(k, at)];
    Case { group: GROUP, name: "grid about a bend", files: vec![(LINE, features(&[line]))], jobs, exact: true, rows }
}
