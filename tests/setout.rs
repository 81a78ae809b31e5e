//! Setting out: slope stakes against closed forms, level curves at chosen heights.

#[path = "common/mod.rs"]
mod common;

use common::build::{build, design, line, mirrored_design, open, rectangle, upside_down};
use common::oracle::Polyline;
use glam::DVec3;
use slopegen::formation::{self, Crossfall, Formation};
use slopegen::ground::{Stations, axes};
use slopegen::model::{CurveKind, Design, Extent, Line, Part, Sheet};
use slopegen::setout::{Along, Ends, Hand, Lie, Slopes, Stake, stakes};

/// Stakes of a surface without ground, every `spacing`.
fn staked(line: &Line, design: &Design, spacing: f64) -> Vec<Stake> {
    let surface = build(line, design);
    let (tin, lines) = (&surface.tin, &surface.lines);
    let stations = Stations::new(axes(line, &tin.frame), Some(spacing)).unwrap();
    let slopes = match design.sheet {
        Sheet::Falling => Slopes { fill: Some(design.slope), cut: None },
        Sheet::Rising => Slopes { cut: Some(design.slope), fill: None },
    };
    let found = stakes(&Lie { line, design: tin, lines, ground: None, stations: &stations, slopes, tolerance: design.tolerance });
    assert_eq!(found.missing, 0);
    found.stakes
}

/// Rows of every station: of both ways on the left, of both ways on the right.
fn rows(stakes: &[Stake]) -> Vec<[usize; 2]> {
    let count = |of: &[Stake], hand| of.iter().filter(|s| s.hand == hand).count();
    stakes.chunk_by(|a, b| a.station == b.station).map(|of| [Hand::Left, Hand::Right].map(|hand| count(of, hand))).collect()
}

/// A line with a vertex every 1 m, of which most are left out: at most 8° to the east, curves of 1200 m or more, grades of 2.3 %.
fn winding(length: u32) -> Polyline {
    let at = |x: f64| [x, 100.0 * (x / 800.0).sin() + 0.5 * (x / 37.0).sin(), 10.0 + 2.0 * (x / 90.0).sin()];
    open(&(0..=length).map(|i| at(i.into())).collect::<Vec<_>>())
}

#[track_caller]
fn close(a: f64, b: f64) {
    assert!((a - b).abs() < 1e-7 * b.abs().max(1.0), "{a} is not {b}");
}

/// A straight line of gradient γ at 10 + γs, slope k, down to the level 0: the ruling leans by φ, sin φ = γ/k, and is z/k long in
/// plan; perpendicular the slope is √(k² − γ²), so the catch point is z/√(k² − γ²) away.
#[test]
fn a_straight_line_on_a_grade() {
    let (k, g) = (0.5, 0.08);
    for mirror in [false, true] {
        let mut of = line(&[open(&[[0.0, 0.0, 10.0], [60.0, 0.0, 10.0 + 60.0 * g]])]);
        let mut wanted = design(k, Extent::Elevation(0.0));
        if mirror {
            (of, wanted) = (upside_down(&of), mirrored_design(&wanted));
        }
        let sign = if mirror { -1.0 } else { 1.0 };
        let found = staked(&of, &wanted, 20.0);
        assert_eq!(found.len(), 4 * 2 * 2, "stations × sides × ways");
        for stake in &found {
            let hand = if stake.hand == Hand::Left { 1.0 } else { -1.0 };
            let z = 10.0 + g * stake.station;
            assert!(stake.hinge.distance(DVec3::new(stake.station, 0.0, sign * z)) < 1e-9);
            assert_eq!(stake.part, Some(if mirror { Part::CutSlope } else { Part::FillSlope }));
            assert_eq!((stake.ends, stake.offset), (Ends::End, 0.0));
            close(stake.height(), -sign * z);
            match stake.along {
                Along::Ruling => {
                    let (sine, length) = (g / k, z / k);
                    close(stake.distance(), length);
                    close(stake.one_in().unwrap(), 1.0 / k);
                    // Down-grade on the falling sheet; the mirrored line falls, and its rising sheet leans up-grade: the same
                    // way.
                    close(stake.catch_ahead, -length * sine);
                    close(stake.catch_offset, length * (1.0 - sine * sine).sqrt());
                    close(stake.catch.y, hand * length * (1.0 - sine * sine).sqrt());
                    let bearing = (-sine).atan2(hand * (1.0 - sine * sine).sqrt()).to_degrees().rem_euclid(360.0);
                    close(stake.bearing().unwrap(), bearing);
                }
                // Rulings lean towards the low end: from the high end the perpendicular runs over the cone of the end point.
                Along::Perpendicular if stake.station == 60.0 => assert!((stake.distance() - z / k).abs() < 2e-3),
                Along::Perpendicular => {
                    let section = (k * k - g * g).sqrt();
                    close(stake.distance(), z / section);
                    close(stake.catch_offset, z / section);
                    close(stake.slope_distance(), z * (1.0 + 1.0 / (section * section)).sqrt());
                    assert!(stake.catch_ahead.abs() < 1e-9);
                }
            }
        }
    }
}

/// A level right angle to the left, 10 above the end, slope 1 in 2: inside, the strips close up at once and the crease runs along
/// the bisector with k·cos 45°; outside, the cone goes on for 20 in every direction.
#[test]
fn corners_close_up_inside_and_open_outside() {
    let corner = line(&[open(&[[-50.0, 0.0, 10.0], [0.0, 0.0, 10.0], [0.0, 50.0, 10.0]])]);
    let found = staked(&corner, &design(0.5, Extent::Elevation(0.0)), 50.0);
    let at = |hand, along| found.iter().find(|s| s.station == 50.0 && s.hand == hand && s.along == along).unwrap();
    let crease = at(Hand::Left, Along::Ruling);
    assert_eq!((crease.ends, crease.distance()), (Ends::Crease, 0.0));
    let inside = at(Hand::Left, Along::Perpendicular);
    close(inside.distance(), 20.0 * 2.0_f64.sqrt());
    for along in [Along::Ruling, Along::Perpendicular] {
        let outside = at(Hand::Right, along);
        // The cone is drawn in wedges within a third of the tolerance of 1 mm in height, here 2 mm in plan.
        assert!((outside.distance() - 20.0).abs() < 2e-3, "{outside:?}");
        close(outside.bearing().unwrap(), 135.0);
    }
    // Between: a ruling of the inside ends at the crease, where it is as far from both legs.
    let near = staked(&corner, &design(0.5, Extent::Elevation(0.0)), 40.0);
    let ruling = near.iter().find(|s| s.station == 40.0 && s.hand == Hand::Left && s.along == Along::Ruling).unwrap();
    assert_eq!(ruling.ends, Ends::Crease);
    close(ruling.distance(), 10.0);
    close(ruling.height(), -5.0);
}

/// A rectangle has slopes outside only: four sides, none inside.
#[test]
fn rings_have_stakes_on_one_side() {
    let pad = line(&[rectangle([0.0, 0.0, 5.0], 40.0, 20.0)]);
    let found = staked(&pad, &design(1.0, Extent::Elevation(0.0)), 10.0);
    // 120 round, every 10, both ways; counter-clockwise, so outside is on the right.
    assert_eq!(found.len(), 12 * 2);
    for stake in &found {
        assert_eq!(stake.hand, Hand::Right);
        assert!((stake.distance() - 5.0).abs() < 2e-3, "{stake:?}");
    }
}

/// Lines of many vertices, most of them left out of the mesh: two stakes for each station and side with a slope, none on the others;
/// rulings have the slope asked for and reach the end. Depth and gradient are those of the given line.
#[test]
fn simplified_lines_have_all_their_stakes() {
    let given = line(&[winding(900)]);
    let length = given.chains[0].stations()[900];
    let road = Formation { width: 7.0, crossfall: Crossfall::default(), chord: 3e-3 };
    let road = formation::widen(&given, "winding", &road).unwrap().line;
    for (of, offset) in [(&given, 0.0), (&road, 3.5)] {
        let wanted = Design { tolerance: 0.01, ..design(0.5, Extent::Elevation(0.0)) };
        assert!(build(of, &wanted).simplified > 500);
        let found = staked(of, &wanted, 7.0);
        let of_all = rows(&found);
        assert_eq!(of_all.len() as f64, (length / 7.0).ceil() + 1.0);
        assert!(of_all.iter().all(|rows| *rows == [2, 2]), "{of_all:?}");
        for stake in &found {
            let z = stake.hinge.z;
            assert!((stake.offset - offset).abs() < 0.01 && stake.ends == Ends::End, "{stake:?}");
            assert!((stake.height() + z).abs() < 1e-6, "{stake:?}");
            // A grade of 2.3 % flattens a section by 1 − √(1 − 0.046²) = 0.1 %.
            assert!((stake.distance() * 0.5 / z - 1.0).abs() < 3e-3, "{stake:?}");
        }
    }
}

/// Pads with vertices beside the line, on either side and within what the tolerance allows, and with finely rounded corners: on the
/// outside 5 high at 1 in 2, on the inside nothing.
#[test]
fn rings_of_many_vertices_have_stakes_outside_only() {
    let arc = |[x, y]: [f64; 2], from: f64| {
        (0..=64)
            .map(move |i| (from + f64::from(i) / 64.0) * std::f64::consts::FRAC_PI_2)
            .map(move |a| [x + 5.0 * a.cos(), y + 5.0 * a.sin(), 5.0])
    };
    let corners = [([5.0, 5.0], 2.0), ([35.0, 5.0], 3.0), ([35.0, 15.0], 0.0), ([5.0, 15.0], 1.0)];
    let rounded: Vec<[f64; 3]> = corners.into_iter().flat_map(|(at, from)| arc(at, from)).collect();
    let dented =
        |y: f64| vec![[0.0, 0.0, 5.0], [40.0, 0.0, 5.0], [80.0, 0.0, 5.0], [80.0, 40.0, 5.0], [40.0, y, 5.0], [0.0, 40.0, 5.0]];
    for (points, spacing, least) in [(rounded, 1.0, 100), (dented(39.997), 20.0, 12), (dented(40.003), 20.0, 12)] {
        for reversed in [false, true] {
            let mut points = points.clone();
            if reversed {
                points.reverse();
            }
            let wanted = Design { tolerance: 0.01, ..design(0.5, Extent::Elevation(0.0)) };
            let pad = line(&[Polyline { points, closed: true }]);
            assert!(build(&pad, &wanted).simplified > 0);
            let found = staked(&pad, &wanted, spacing);
            let expected = if reversed { [2, 0] } else { [0, 2] };
            let of_all = rows(&found);
            assert!(of_all.len() >= least && of_all.iter().all(|rows| *rows == expected), "{of_all:?}");
            assert!(found.iter().all(|s| s.offset < 7e-3 && s.ends == Ends::End), "{found:?}");
            assert!(found.iter().all(|s| s.station.rem_euclid(40.0) == 0.0 || (s.distance() - 10.0).abs() < 0.02), "{found:?}");
        }
    }
}

/// A bend of 0.5°, 10 above the end: on either side its rulings are 20 long and have the slope asked for, as those beside it.
#[test]
fn slight_bends_do_not_close_up() {
    let (sin, cos) = 0.5_f64.to_radians().sin_cos();
    let bend = line(&[open(&[[0.0, 0.0, 10.0], [50.0, 0.0, 10.0], [50.0 + 50.0 * cos, 50.0 * sin, 10.0]])]);
    let found = staked(&bend, &design(0.5, Extent::Elevation(0.0)), 10.0);
    assert_eq!(found.len(), 11 * 4);
    for stake in found {
        assert!((stake.distance() - 20.0).abs() < 2e-3 && stake.ends == Ends::End, "{stake:?}");
    }
}

/// The same site turned, moved, mirrored: the same distances, heights and slopes.
#[test]
fn turning_and_moving_changes_places_only() {
    let bend = [[0.0, 0.0, 12.0], [40.0, 5.0, 13.0], [70.0, 40.0, 11.0], [130.0, 45.0, 12.5]];
    let (sin, cos) = 0.7_f64.sin_cos();
    let moved = bend.map(|[x, y, z]| [500_000.0 + cos * x - sin * y, 5_000_000.0 + sin * x + cos * y, z]);
    let flipped = bend.map(|[x, y, z]| [-x, y, z]);
    let of = |points: [[f64; 3]; 4]| {
        staked(&line(&[Polyline { points: points.to_vec(), closed: false }]), &design(0.6, Extent::Elevation(2.0)), 15.0)
    };
    let (given, moved, mut flipped) = (of(bend), of(moved), of(flipped));
    assert!(given.len() > 30);
    // Left and right change places.
    flipped.sort_by(|a, b| a.station.total_cmp(&b.station).then((b.hand as u8).cmp(&(a.hand as u8))));
    for other in [&moved, &flipped] {
        assert_eq!(given.len(), other.len());
        for (a, b) in given.iter().zip(other) {
            assert_eq!((a.along, a.ends), (b.along, b.ends));
            assert!((a.distance() - b.distance()).abs() < 1e-5 && (a.height() - b.height()).abs() < 1e-5, "{a:?}\n{b:?}");
        }
    }
}

/// Level curves at chosen elevations: these alone, or beside those of an interval; whole mesh edges of exactly that height.
#[test]
fn level_curves_at_chosen_heights() {
    let pad = line(&[rectangle([0.0, 0.0, 5.0], 40.0, 20.0)]);
    let with = |interval, levels: &[f64]| {
        let wanted = Design { interval, levels: levels.to_vec(), ..design(0.5, Extent::Elevation(0.0)) };
        let surface = build(&pad, &wanted);
        for feature in surface.lines.iter().filter(|f| f.kind == CurveKind::LevelCurve) {
            assert!(feature.points.iter().all(|p| (p.z - feature.elevation.unwrap()).abs() < 1e-9));
        }
        (surface.levels, surface.lines)
    };
    let (levels, lines) = with(None, &[1.234, 4.5, 9.0, 5.0, 0.0]);
    assert_eq!(levels, [4.5, 1.234]);
    // A rounded rectangle at distance d: 2 (40 + 20) + 2πd.
    let length = |z: f64| {
        let curve = lines.iter().find(|f| f.elevation == Some(z)).unwrap();
        curve.points.windows(2).map(|w| w[0].distance(w[1])).sum::<f64>()
    };
    for z in [4.5, 1.234] {
        let closed = 120.0 + std::f64::consts::TAU * (5.0 - z) / 0.5;
        assert!((length(z) - closed).abs() < 2e-3 * closed, "{} {closed}", length(z));
    }
    assert_eq!(with(Some(2.0), &[1.5]).0, [4.0, 2.0, 1.5]);
    let rising = Design {
        levels: vec![7.25],
        sheet: Sheet::Rising,
        extent: Extent::Elevation(9.0),
        ..design(0.5, Extent::Elevation(9.0))
    };
    assert_eq!(build(&pad, &rising).levels, [7.25]);
}
