//! Cut and fill on existing ground.

use super::{exact, from_segment, greatest, key, row};
use crate::model::Side;
use crate::selftest::formulas::{parallel_area, parallel_volume, pit_volume, section_slope, segment_volume};
use crate::selftest::jobs::{Build, FINISHED, GROUND, LINE, Shape, TOLERANCE, between, features, open, plane, rectangle, volume};
use crate::selftest::{Bound, Case, ROUNDING, Row};
use std::f64::consts::TAU;

const GROUP: &str = "On existing ground";

/// Far enough for all slopes.
const REACH: f64 = 200.0;

fn case(name: &'static str, exact: bool, lines: &[Shape], ground: String, build: Build, rows: Vec<Row>) -> Case {
    Case { group: GROUP, name, files: vec![(LINE, features(lines)), (GROUND, ground)], jobs: vec![build.task()], exact, rows }
}

pub(super) fn cases() -> Vec<Case> {
    vec![pad(), road(), road_with_gradient(), road_along_a_slope(), from_cut_to_fill(), tilted(), half_dug(), pit(), finished()]
}

fn level(_: f64, _: f64) -> f64 {
    0.0
}

/// A pad on level ground, with stations along its edge.
fn pad() -> Case {
    let (l, w, h, k) = (30.0, 20.0, 4.0, 0.5);
    let (n, a, p) = (1.0 / k, l * w, 2.0 * (l + w));
    // A chord at sagitta s = (tolerance/3)/k is short of its arc by s/3r of 2πr in all.
    let short = TAU / 3.0 * TOLERANCE / (3.0 * k);
    let rows = vec![
        key("volumes.fill", "a·h + p·n·h²/2 + π·n²·h³/3", parallel_volume(a, p, n, h), Bound::Reported(1.0)),
        key("volumes.cut", "0", 0.0, Bound::Fixed(0.0)),
        key("areas.fill", "a + p·n·h + π·n²·h²", parallel_area(a, p, n * h), Bound::Reported(n)),
        key("daylight.length", "p + 2·π·n·h", p + TAU * n * h, Bound::Fixed(short)),
        row("stations and platform less the whole", "0", 0.0, Bound::Fixed(1e-9), |outcomes| {
            let outcome = outcomes.first()?;
            Some(outcome.total("stations", "fill")? + outcome.number("pads.fill")? - outcome.number("volumes.fill")?)
        }),
    ];
    case(
        "pad 4 above level ground",
        false,
        &[rectangle([-15.0, -10.0, h], l, w)],
        plane([0.0; 2], REACH, level),
        Build::on_ground(k).stations(7.0),
        rows,
    )
}

/// A level road on level ground: away from its ends a prism.
fn road() -> Case {
    let (w, h, k, step) = (8.0, 5.0, 0.5, 20.0);
    let section = w * h + h * h / k;
    let rows = vec![
        exact("stations.2.fill", "20·(w·h + n·h²), w = 8, h = 5, 1:n = 1:2", step * section),
        exact("stations.2.section.from.fill", "w·h + n·h²", section),
        exact("stations.2.average_end_area.fill", "20·(w·h + n·h²)", step * section),
        exact("stations.2.prismoidal.fill", "20·(w·h + n·h²)", step * section),
        row("stations less the whole", "0", 0.0, Bound::Fixed(1e-8), |outcomes| {
            Some(outcomes.first()?.total("stations", "fill")? - outcomes.first()?.number("volumes.fill")?)
        }),
    ];
    let line = open(&[[-50.0, 0.0, h], [50.0, 0.0, h]]);
    case(
        "level road on level ground",
        false,
        &[line],
        plane([0.0; 2], REACH, level),
        Build::on_ground(k).width(w).stations(step),
        rows,
    )
}

/// A road of constant gradient on level ground. Rulings lean by φ, sin φ = g/k, and are n·h long: over dx of the line the slope
/// holds cos φ·n·h²/2 dx.
fn road_with_gradient() -> Case {
    let (w, g, k, z0, step) = (8.0, 0.05, 0.5, 2.0, 20.0);
    let (n, h1, h2) = (1.0 / k, z0 + 80.0 * g, z0 + 100.0 * g);
    let cosine = section_slope(k, g) / k;
    let platform = w * (h1 + h2) / 2.0 * step;
    let slopes = cosine * n * (h1 * h1 + h1 * h2 + h2 * h2) / 3.0 * step;
    let rows = vec![
        exact("stations.4.fill", "∫ (w·h + cos φ·n·h²) dx, sin φ = g/k, g = 5 %", platform + slopes),
        exact("section_slope.fill.min.ratio", "√(k² − g²)", section_slope(k, g)),
        exact("stations.4.section.from.fill", "w·h + h²/√(k² − g²)", w * h1 + h1 * h1 / section_slope(k, g)),
    ];
    let line = open(&[[-100.0, 0.0, z0], [100.0, 0.0, z0 + 200.0 * g]]);
    let build = Build::on_ground(k).width(w).stations(step);
    case("road of gradient 5 % on level ground", false, &[line], plane([0.0; 2], REACH, level), build, rows)
}

/// A level road along a hillside of slope c, half in cut and half in fill.
fn road_along_a_slope() -> Case {
    let (w, k, c, step) = (8.0, 0.5, 0.2, 20.0);
    let edge = c * w / 2.0;
    let section = c * w * w / 8.0 + edge * edge / (2.0 * (k - c));
    let formula = "20·(c·w²/8 + (c·w/2)²/(2·(k − c))), w = 8, k = 0.5, c = 0.2";
    let rows = vec![
        exact("stations.2.cut", formula, step * section),
        exact("stations.2.fill", formula, step * section),
        exact("stations.2.section.from.cut", "c·w²/8 + (c·w/2)²/(2·(k − c))", section),
    ];
    let line = open(&[[-50.0, 0.0, 0.0], [50.0, 0.0, 0.0]]);
    let build = Build::on_ground(k).width(w).stations(step);
    case("level road along a hillside", false, &[line], plane([0.0; 2], REACH, |_, y| c * y), build, rows)
}

/// A line that rises through level ground: what is cut on one half is filled on the other.
fn from_cut_to_fill() -> Case {
    let (half, h, k) = (40.0, 6.0, 0.5);
    let amount = segment_volume(half, [h, 0.0], k);
    let formula = "n·l·cos φ·h²/3 + n²/3·h³·(π/2 + φ), sin φ = h/(l·k), of half the line";
    let rows = vec![
        key("volumes.cut", formula, amount, Bound::Reported(1.0)),
        key("volumes.fill", formula, amount, Bound::Reported(1.0)),
        key("volumes.net", "0", 0.0, Bound::Reported(1.0)),
    ];
    let line = open(&[[-half, 0.0, -h], [half, 0.0, h]]);
    case("line from cut to fill on level ground", false, &[line], plane([0.0; 2], REACH, level), Build::on_ground(k), rows)
}

/// Where the slopes of a pad meet a tilted plane: points of both.
fn tilted() -> Case {
    let (h, k) = (12.0, 0.5);
    let ground = |x: f64, y: f64| 0.1 * x + 0.05 * y;
    let corners = [[-15.0, -10.0], [15.0, -10.0], [15.0, 10.0], [-15.0, 10.0]];
    let from_pad =
        move |p: [f64; 3]| (0..4).map(|i| from_segment(p, corners[i], corners[(i + 1) % 4])).fold(f64::INFINITY, f64::min);
    let rows = vec![
        row("daylight off the ground", "0: z = 0.1·x + 0.05·y", 0.0, Bound::Fixed(1e-9), move |outcomes| {
            greatest(outcomes.first()?, "daylight", |p| (ground(p[0], p[1]) - p[2]).abs())
        }),
        row("daylight off the slopes", "0: z = h − k·d from the pad", 0.0, Bound::Fixed(TOLERANCE), move |outcomes| {
            greatest(outcomes.first()?, "daylight", |p| (h - k * from_pad(p) - p[2]).abs())
        }),
        // Beside the long edge, away from the corners, daylight is straight: h − k·t = 0.1·x + 0.05·(10 + t).
        row(
            "daylight off its straight part",
            "0: t = (h − 0.1·x − 0.5)/(k + 0.05)",
            0.0,
            Bound::Fixed(1e-9),
            move |outcomes| {
                let beside = |p: &[f64; 3]| p[0].abs() <= 15.0 && p[1] > 10.0;
                let lines = outcomes.first()?.lines("daylight")?;
                let off = |p: [f64; 3]| (p[1] - 10.0 - (h - 0.1 * p[0] - 0.5) / (k + 0.05)).abs();
                let all: Vec<f64> = lines.into_iter().flatten().filter(beside).map(off).collect();
                (!all.is_empty()).then(|| all.into_iter().fold(0.0, f64::max))
            },
        ),
        key("daylight.loops", "1", 1.0, Bound::Fixed(0.0)),
    ];
    let pad = rectangle([-15.0, -10.0, h], 30.0, 20.0);
    case("pad above a tilted plane", false, &[pad], plane([0.0; 2], REACH, ground), Build::on_ground(k), rows)
}

/// A pad in a tilted plane through its middle: turned by half a turn about it, cut is fill.
fn half_dug() -> Case {
    let (l, w, k) = (30.0, 20.0, 0.5);
    let platform = |c: f64| l * c * w * w / 8.0;
    let rows = vec![
        key("volumes.net", "0: the same seen upside down", 0.0, Bound::Reported(1.0)),
        exact("pads.cut", "l·c·w²/8, c = 0.1", platform(0.1)),
        exact("pads.fill", "l·c·w²/8", platform(0.1)),
    ];
    let pad = rectangle([-15.0, -10.0, 3.0], l, w);
    let build = Build::on_ground(k).stations(10.0);
    case("pad half dug into a slope", false, &[pad], plane([0.0; 2], REACH, |_, y| 3.0 + 0.1 * y), build, rows)
}

/// Down from its rim, which lies on the ground.
fn pit() -> Case {
    let (l, w, d, k) = (60.0, 35.0, 6.0, 0.5);
    let rows = vec![
        exact("volumes.cut", "l·w·d − (l + w)·n·d² + 4/3·n²·d³", pit_volume(l, w, 1.0 / k, d)),
        exact("areas.cut", "l·w", l * w),
        key("volumes.fill", "0", 0.0, Bound::Fixed(ROUNDING)),
    ];
    let ring = rectangle([-30.0, -17.5, 0.0], l, w);
    let build = Build::on_ground(k).side(Side::Inside).down_to(-d);
    case("pit in level ground", true, &[ring], plane([0.0; 2], REACH, level), build, rows)
}

/// What was built, written, and read again by `volume`: the same volumes by other code.
fn finished() -> Case {
    let (k, h) = (0.5, 4.0);
    let difference = |name: &'static str| {
        let figure = format!("{name}: volume less build");
        row(&figure, "0: finished ground against existing ground", 0.0, Bound::Fixed(1e-6), move |outcomes| {
            Some(outcomes.get(1)?.number(name)? - outcomes.first()?.number(name)?)
        })
    };
    let rows = vec![difference("volumes.cut"), difference("volumes.fill"), difference("areas.cut"), difference("areas.fill")];
    let pad = rectangle([-15.0, -10.0, h], 30.0, 20.0);
    let ground = plane([0.0; 2], REACH, |x, y| h + 0.05 * x + 0.1 * y);
    Case {
        group: GROUP,
        name: "finished ground, measured again",
        files: vec![(LINE, features(&[pad])), (GROUND, ground)],
        jobs: vec![Build::on_ground(k).finished().task(), volume(between(FINISHED, GROUND), None)],
        exact: false,
        rows,
    }
}
