//! Pads, pits and roofs: rings without ground.

use super::{exact, key, length, row};
use crate::model::{Extent, Side};
use crate::selftest::formulas::{frustum_volume, parallel_area, parallel_volume, pit_volume, roof_creases, roof_volume};
use crate::selftest::jobs::{Build, LINE, Shape, features, polygon, rectangle, ring};
use crate::selftest::{Bound, Case, Row};
use std::f64::consts::{PI, TAU};

const GROUP: &str = "Slopes of rings";

fn case(name: &'static str, exact: bool, rings: &[Shape], build: Build, rows: Vec<Row>) -> Case {
    Case { group: GROUP, name, files: vec![(LINE, features(rings))], jobs: vec![build.task()], exact, rows }
}

pub(super) fn cases() -> Vec<Case> {
    vec![pad(), steep_pad(), pit(), roof(), circle(), hole()]
}

fn pad() -> Case {
    let (l, w, h, k) = (30.0, 20.0, 4.0, 0.5);
    let (n, a, p) = (1.0 / k, l * w, 2.0 * (l + w));
    let rows = vec![
        key("volumes.fill", "a·h + p·n·h²/2 + π·n²·h³/3", parallel_volume(a, p, n, h), Bound::Reported(1.0)),
        key("surface.plan_area", "a + p·n·h + π·n²·h²", parallel_area(a, p, n * h), Bound::Reported(n)),
        exact("surface.platform_area", "l·w", a),
        exact("depths.fill_max", "h", h),
    ];
    case(
        "level pad 30 × 20, 4 high, 1:2",
        false,
        &[rectangle([10.0, -5.0, h], l, w)],
        Build::new(k, Extent::Elevation(0.0)),
        rows,
    )
}

fn steep_pad() -> Case {
    let (l, w, h, k) = (40.0, 25.0, 3.0, 2.0);
    let (n, a, p) = (1.0 / k, l * w, 2.0 * (l + w));
    let rows = vec![
        key("volumes.fill", "a·h + p·n·h²/2 + π·n²·h³/3", parallel_volume(a, p, n, h), Bound::Reported(1.0)),
        key("surface.plan_area", "a + p·n·h + π·n²·h²", parallel_area(a, p, n * h), Bound::Reported(n)),
    ];
    case("level pad 40 × 25, 3 high, 2:1", false, &[rectangle([0.0, 0.0, h], l, w)], Build::new(k, Extent::Elevation(0.0)), rows)
}

/// Down to a floor: no cone, a prismatoid.
fn pit() -> Case {
    let (l, w, d, k, rim) = (60.0, 35.0, 6.0, 0.5, 50.0);
    let n: f64 = 1.0 / k;
    let floor = (l - 2.0 * n * d) * (w - 2.0 * n * d);
    let creases = 4.0 * (2.0 * n * n + 1.0).sqrt() * d;
    let rows = vec![
        exact("volumes.cut", "l·w·d − (l + w)·n·d² + 4/3·n²·d³", pit_volume(l, w, n, d)),
        exact("surface.platform_area", "(l − 2·n·d)·(w − 2·n·d)", floor),
        exact("surface.plan_area", "l·w", l * w),
        exact("surface.fill_slope_area", "(l·w − floor)·√(1 + k²)", (l * w - floor) * (1.0 + k * k).sqrt()),
        row("length of the creases", "4·d·√(2·n² + 1)", creases, Bound::Fixed(1e-9 * creases), |outcomes| {
            length(outcomes.first()?, "valley")
        }),
        key("volumes.error_bound", "0: there is no cone", 0.0, Bound::Fixed(0.0)),
    ];
    let build = Build::new(k, Extent::Elevation(rim - d)).side(Side::Inside);
    case("pit 60 × 35, 6 deep, with a floor", true, &[rectangle([0.0, 0.0, rim], l, w)], build, rows)
}

/// Inwards with nothing to stop them the slopes meet: a hip roof, upside down.
fn roof() -> Case {
    let (l, w, k) = (40.0, 18.0, 0.6);
    let creases = roof_creases(l, w, k);
    let rows = vec![
        exact("volumes.cut", "k·w²·(3·l − w)/12", roof_volume(l, w, k)),
        exact("depths.cut_max", "k·w/2", k * w / 2.0),
        exact("surface.fill_slope_area", "l·w·√(1 + k²)", l * w * (1.0 + k * k).sqrt()),
        row("length of ridge and hips", "l − w + 2·w·√(2 + k²)", creases, Bound::Fixed(1e-9 * creases), |outcomes| {
            length(outcomes.first()?, "valley")
        }),
    ];
    let build = Build::new(k, Extent::Elevation(-100.0)).side(Side::Inside);
    case("ridge inside a rectangle 40 × 18", true, &[rectangle([-7.0, 3.0, 5.0], l, w)], build, rows)
}

/// A polygon of 90 corners, exactly by Steiner's formula; between the frusta of the circles inside and around it.
fn circle() -> Case {
    let (corners, r, h, k) = (90.0, 12.0, 5.0, 0.5);
    let n = 1.0 / k;
    let corner = |i: u32| {
        let (sin, cos) = (TAU * f64::from(i) / corners).sin_cos();
        [r * cos, r * sin, h]
    };
    let half = PI / corners;
    let (a, p) = (corners * r * r * half.sin() * half.cos(), 2.0 * corners * r * half.sin());
    let frustum = |r: f64| frustum_volume(h, PI * r * r, PI * (r + n * h).powi(2));
    let (inner, outer) = (frustum(r * half.cos()), frustum(r));
    let points: Vec<[f64; 3]> = (0..90).map(corner).collect();
    let rows = vec![
        key("volumes.fill", "a·h + p·n·h²/2 + π·n²·h³/3, 90 corners", parallel_volume(a, p, n, h), Bound::Reported(1.0)),
        key(
            "volumes.fill",
            "π·h/3·(r² + r·R + R²) of the circles inside and around, the mean",
            (inner + outer) / 2.0,
            Bound::Fixed((outer - inner) / 2.0),
        ),
    ];
    case("polygon of 90 corners, a frustum", false, &[ring(&points)], Build::new(k, Extent::Elevation(0.0)), rows)
}

/// Outside of a polygon lie the far side and the hole, a shaft that narrows downwards.
fn hole() -> Case {
    let (l, w, a, b, h, k) = (80.0, 60.0, 30.0, 22.0, 4.0, 0.5);
    let n = 1.0 / k;
    let rings = [rectangle([0.0, 0.0, h], l, w), rectangle([20.0, 15.0, h], a, b)];
    let fill = parallel_volume(l * w, 2.0 * (l + w), n, h) - pit_volume(a, b, n, h);
    let rows = vec![
        key("volumes.fill", "that of the pad less that of a pit in the hole", fill, Bound::Reported(1.0)),
        exact("surface.platform_area", "l·w − a·b", l * w - a * b),
    ];
    let files = vec![(LINE, polygon(&rings))];
    let jobs = vec![Build::new(k, Extent::Elevation(0.0)).task()];
    Case { group: GROUP, name: "pad with a hole", files, jobs, exact: false, rows }
}
