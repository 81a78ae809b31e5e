//! Lines with slopes on one side or both, without ground.

use super::{exact, from_segment, greatest, key, row};
use crate::model::{Extent, Side};
use crate::selftest::formulas::{section_slope, segment_area, segment_volume};
use crate::selftest::jobs::{Build, LINE, Shape, TOLERANCE, features, open};
use crate::selftest::{Bound, Case, Row};
use std::f64::consts::PI;

const GROUP: &str = "Slopes of lines";

fn case(name: &'static str, exact: bool, lines: &[Shape], build: Build, rows: Vec<Row>) -> Case {
    Case { group: GROUP, name, files: vec![(LINE, features(lines))], jobs: vec![build.task()], exact, rows }
}

pub(super) fn cases() -> Vec<Case> {
    vec![cone(), wedge(), sloping_segment(), inside_corner(), sag(), saddle(), lines_of_two_heights(), crossing()]
}

/// A segment so short that its slopes are all but a cone.
fn cone() -> Case {
    let (l, h, k) = (0.001, 6.0, 0.5);
    let n = 1.0 / k;
    let volume = "n·l·h² + π·n²·h³/3, l = 0.001, h = 6, 1:n = 1:2";
    let rows = vec![
        key("volumes.fill", volume, segment_volume(l, [h, h], k), Bound::Reported(1.0)),
        key("surface.plan_area", "2·n·h·l + π·n²·h²", 2.0 * n * h * l + PI * n * n * h * h, Bound::Reported(n)),
        exact("depths.fill_max", "h", h),
    ];
    case("cone", false, &[open(&[[0.0, 0.0, h], [l, 0.0, h]])], Build::new(k, Extent::Elevation(0.0)), rows)
}

/// A level segment sloped on one side only is a wedge: a triangle `h` high and `n·h` wide along `l`.
fn wedge() -> Case {
    let (l, h, k) = (35.0, 5.0, 0.8);
    let n = 1.0 / k;
    let line = open(&[[3.0, 4.0, 1.0 + h], [3.0 + 0.6 * l, 4.0 + 0.8 * l, 1.0 + h]]);
    let rows = vec![
        exact("volumes.fill", "l·n·h²/2, l = 35, h = 5, 1:n = 1:1.25", l * n * h * h / 2.0),
        exact("surface.plan_area", "l·n·h", l * n * h),
        exact("surface.fill_slope_area", "l·n·h·√(1 + k²)", l * n * h * (1.0 + k * k).sqrt()),
    ];
    case("wedge on one side of a level line", true, &[line], Build::new(k, Extent::Elevation(1.0)).side(Side::Left), rows)
}

fn sloping_segment() -> Case {
    let (l, z, k) = (24.0, [14.0, 5.0], 0.5);
    let line = open(&[[-2.0, 6.0, z[0]], [-2.0 + 0.6 * l, 6.0 + 0.8 * l, z[1]]]);
    let volume = "n·l·cos φ·(z1² + z1·z2 + z2²)/3 + n²/3·(z1³(π/2 + φ) + z2³(π/2 − φ)), sin φ = γ/k";
    let area = "n·(z1 + z2)·l·cos φ + n²·(z1²(π/2 + φ) + z2²(π/2 − φ))";
    let rows = vec![
        key("volumes.fill", volume, segment_volume(l, z, k), Bound::Reported(1.0)),
        key("surface.plan_area", area, segment_area(l, z, k), Bound::Reported(1.0 / k)),
        exact("line.gradient_max", "(z1 − z2)/l", (z[0] - z[1]) / l),
    ];
    case("line that falls from 14 to 5", false, &[line], Build::new(k, Extent::Elevation(0.0)), rows)
}

/// At an inside corner the planes of both legs meet over the bisector, falling by `k·sin(θ/2)`.
fn inside_corner() -> Case {
    let (h, k) = (10.0, 0.5);
    let (a, b) = ([-30.0, 0.0], [18.0, 24.0]);
    // Between the legs: cos θ = −0.6.
    let half = ((1.0 + 0.6) / 2.0_f64).sqrt();
    let line = open(&[[a[0], a[1], h], [0.0, 0.0, h], [b[0], b[1], h]]);
    let rows = vec![
        row("ridge off the bisector", "0: as far from one leg as from the other", 0.0, Bound::Fixed(1e-9), move |outcomes| {
            greatest(outcomes.first()?, "valley", |p| (from_segment(p, a, [0.0; 2]) - from_segment(p, [0.0; 2], b)).abs())
        }),
        row("ridge off the planes", "0: h − k·d from the legs", 0.0, Bound::Fixed(1e-9), move |outcomes| {
            greatest(outcomes.first()?, "valley", |p| (h - k * from_segment(p, a, [0.0; 2]) - p[2]).abs())
        }),
        row("slope of the ridge", "k·sin(θ/2), cos θ = −0.6", k * half, Bound::Fixed(1e-9), move |outcomes| {
            greatest(
                outcomes.first()?,
                "valley",
                |[x, y, z]| if x == 0.0 && y == 0.0 { 0.0 } else { (h - z) / (x * x + y * y).sqrt() },
            )
        }),
    ];
    case("inside corner of a level line", true, &[line], Build::new(k, Extent::Elevation(4.0)).side(Side::Left), rows)
}

/// At a sag the strips lean into each other: a crease where both planes are equally high,
/// `−g1·s − t·√(k² − g1²) = g2·s − t·√(k² − g2²)`.
fn sag() -> Case {
    let (low, k, g1, g2) = (9.0, 0.5, 0.3, 0.1);
    let (side1, side2) = (section_slope(k, g1), section_slope(k, g2));
    let aside = (side2 - side1) / (g1 + g2);
    let line = open(&[[-50.0, 0.0, low + 50.0 * g1], [0.0, 0.0, low], [50.0, 0.0, low + 50.0 * g2]]);
    let rows = vec![
        row(
            "crease off the place",
            "0: s = t·(√(k² − g2²) − √(k² − g1²))/(g1 + g2)",
            0.0,
            Bound::Fixed(1e-9),
            move |outcomes| greatest(outcomes.first()?, "valley", |[x, y, _]| (x - aside * y.abs()).abs()),
        ),
        row("crease off the planes", "0: z = z0 + g2·s − t·√(k² − g2²)", 0.0, Bound::Fixed(1e-9), move |outcomes| {
            greatest(outcomes.first()?, "valley", |[x, y, z]| (low + g2 * x - y.abs() * side2 - z).abs())
        }),
    ];
    case("sag between gradients of 30 % and 10 %", false, &[line], Build::new(k, Extent::Elevation(0.0)), rows)
}

/// Between two level lines of one height the slopes meet half-way, in a saddle.
fn saddle() -> Case {
    let (l, d, h, k) = (40.0, 12.0, 10.0, 0.75);
    let lines = [open(&[[0.0, 0.0, h], [l, 0.0, h]]), open(&[[l, d, h], [0.0, d, h]])];
    let rows = vec![
        row("saddle off half-way", "0: y = d/2", 0.0, Bound::Fixed(1e-9), move |outcomes| {
            greatest(outcomes.first()?, "valley", |p| (p[1] - d / 2.0).abs())
        }),
        row("greatest height of the saddle", "h − k·d/2", h - k * d / 2.0, Bound::Fixed(1e-9), |outcomes| {
            greatest(outcomes.first()?, "valley", |p| p[2])
        }),
    ];
    case("saddle between two level lines", false, &lines, Build::new(k, Extent::Elevation(-4.0)), rows)
}

/// Lines `d` apart at different heights meet where `z1 − k·t = z2 − k·(d − t)`; beyond their ends where the distances differ by
/// `(z2 − z1)/k`, a branch of a hyperbola.
fn lines_of_two_heights() -> Case {
    let (l, d, z1, z2, k) = (40.0, 12.0, 10.0, 13.0, 0.75);
    let lines = [open(&[[0.0, 0.0, z1], [l, 0.0, z1]]), open(&[[l, d, z2], [0.0, d, z2]])];
    let apart = move |p: [f64; 3]| from_segment(p, [0.0, 0.0], [l, 0.0]) - from_segment(p, [0.0, d], [l, d]) - (z1 - z2) / k;
    let rows = vec![
        row("crease off the hyperbola", "0: d1 − d2 = (z1 − z2)/k", 0.0, Bound::Fixed(1e-9), move |outcomes| {
            greatest(outcomes.first()?, "valley", |p| apart(p).abs())
        }),
        row("crease off the cones", "0: z = z1 − k·d1", 0.0, Bound::Fixed(1e-9), move |outcomes| {
            greatest(outcomes.first()?, "valley", |p| (z1 - k * from_segment(p, [0.0, 0.0], [l, 0.0]) - p[2]).abs())
        }),
    ];
    case("crease between lines of two heights", false, &lines, Build::new(k, Extent::Elevation(-4.0)), rows)
}

/// A level line `h` above another at right angles buries it as far as its slope reaches.
fn crossing() -> Case {
    let (a, b, h, k) = (50.0, 40.0, 6.0, 0.5);
    let lines = [open(&[[-a, 0.0, 0.0], [a, 0.0, 0.0]]), open(&[[0.0, -b, h], [0.0, b, h]])];
    let rows = vec![
        exact("line.buried.0.from", "a − n·h", a - h / k),
        exact("line.buried.0.to", "a + n·h", a + h / k),
        key("line.buried.0.depth", "h", h, Bound::Fixed(TOLERANCE)),
    ];
    case("line buried under another", false, &lines, Build::new(k, Extent::Elevation(-30.0)), rows)
}
