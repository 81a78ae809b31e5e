//! Lines drawn on a grid: equal legs, right angles and equal heights make many events coincide.

mod common;

use common::build::{design, line, open, rectangle, regular, ring};
use common::lines::Random;
use common::measure::curves;
use common::oracle::Polyline;
use slopegen::model::{CurveKind, Design, Extent, Side};
use slopegen::surface;

/// Builds; says whether the heights had to be joggled for it.
fn built(failed: &mut Vec<String>, lines: &[Polyline], wanted: &Design) -> bool {
    match surface::build(&line(lines), wanted, None, &()) {
        Ok(surface) => surface.notes.iter().any(|note| note.code == "line-joggled"),
        Err(e) => {
            failed.push(format!("{:?} {:?} {:?}: {}", lines[0].points, wanted.extent, wanted.side_of_rings, e));
            false
        }
    }
}

#[track_caller]
fn none(failed: &[String]) {
    assert!(failed.is_empty(), "{} failed, first:\n{}", failed.len(), failed[..failed.len().min(5)].join("\n"));
}

/// Equal legs at a right angle.
#[test]
fn square_corners() {
    let mut failed = Vec::new();
    for extent in [Extent::Elevation(-3.0), Extent::Height(2.0), Extent::Distance(4.0)] {
        for leg in [2.0, 4.0, 8.0] {
            built(&mut failed, &[open(&[[0.0; 3], [-leg, 0.0, 0.0], [-leg, -leg, 0.0]])], &design(0.5, extent));
        }
    }
    none(&failed);
}

/// Two roads that cross at right angles in their middles.
#[test]
fn square_crossings() {
    let mut failed = Vec::new();
    for (g, c) in [(0.0, 0.0), (0.2, 0.0), (0.25, -0.1)] {
        for end in [-30.0, -10.0, -5.0] {
            let (a, b, h) = (50.0, 40.0, 6.0);
            let lines = [open(&[[-a, 0.0, -a * c], [a, 0.0, a * c]]), open(&[[0.0, -b, h - b * g], [0.0, b, h + b * g]])];
            built(&mut failed, &lines, &Design { tolerance: 0.01, ..design(0.5, Extent::Elevation(end)) });
        }
    }
    none(&failed);
}

/// Hairpins with square bends, close to the limit of burial.
#[test]
fn square_hairpins() {
    let mut failed = Vec::new();
    for slack in [0.5, 0.3, 0.1, 1e-2, 1e-5] {
        let (d, g, c, k) = (10.0, 0.1, 0.2, 0.5);
        let l = ((1.0 - slack * 0.5) * k * d - c * d) / (2.0 * g);
        let points = [[0.0; 3], [l, 0.0, g * l], [l, d, g * l + c * d], [0.0, d, 2.0 * g * l + c * d]];
        built(&mut failed, &[open(&points)], &design(k, Extent::Elevation(-3.0)));
    }
    none(&failed);
}

/// The floor of a pit shrinks to a line, or to a point.
#[test]
fn floors_that_just_vanish() {
    let mut failed = Vec::new();
    for lines in [rectangle([0.0; 3], 10.0, 4.0), rectangle([0.0; 3], 4.0, 4.0), regular(6, 4.0 / 3.0_f64.sqrt(), 0.0)] {
        let wanted = Design { side_of_rings: Side::Inside, ..design(1.0, Extent::Elevation(-2.0)) };
        built(&mut failed, &[lines], &wanted);
    }
    none(&failed);
}

#[test]
fn random_lines() {
    let (mut failed, mut joggled) = (Vec::new(), 0);
    for seed in 0..1500 {
        let r = &mut Random::new(seed);
        let k = [0.5, 1.0][r.below(2)];
        let level = r.below(3) == 0;
        let (mut p, mut direction) = ([0.0; 3], r.below(4));
        let mut points = vec![p];
        for _ in 0..1 + r.below(4) {
            let length = 2.0 * (1 + r.below(8)) as f64;
            let g = if level { 0.0 } else { [-0.4, -0.2, 0.0, 0.2, 0.4][r.below(5)] * k };
            let (x, y) = [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][direction];
            p = [p[0] + x * length, p[1] + y * length, p[2] + g * length];
            points.push(p);
            direction = (direction + [1, 3][r.below(2)]) % 4;
        }
        let low = points.iter().fold(0.0_f64, |m, p| m.min(p[2]));
        let extent = [Extent::Elevation(low - 3.0), Extent::Distance(4.0), Extent::Height(2.0)][r.below(3)];
        joggled += usize::from(built(&mut failed, &[open(&points)], &Design { tolerance: 0.01, ..design(k, extent) }));
    }
    none(&failed);
    // Lines that just touch the slope of another part of themselves, between buried and free.
    assert!((1..=3).contains(&joggled), "{joggled} lines were joggled");
}

/// Skylines: columns of whole widths and heights on a base line.
#[test]
fn random_rings() {
    let mut failed = Vec::new();
    for seed in 0..1500 {
        let r = &mut Random::new(seed);
        let k = [0.5, 1.0][r.below(2)];
        let (mut x, mut last) = (0.0, 0.0);
        let mut top = Vec::new();
        for _ in 0..1 + r.below(4) {
            let mut height = 2.0 * (1 + r.below(8)) as f64;
            height += if height == last { 2.0 } else { 0.0 };
            top.push([x, height, 0.0]);
            x += 2.0 * (1 + r.below(6)) as f64;
            top.push([x, height, 0.0]);
            last = height;
        }
        let mut points = vec![[0.0; 3], [x, 0.0, 0.0]];
        points.extend(top.iter().rev());
        if r.below(3) == 1 {
            points.iter_mut().for_each(|p| p[2] = 0.2 * k * p[0]);
        }
        let extent = [Extent::Elevation(-2.0), Extent::Elevation(-50.0), Extent::Distance(4.0), Extent::Height(2.0)][r.below(4)];
        let side_of_rings = [Side::Inside, Side::Outside, Side::Both][r.below(3)];
        built(&mut failed, &[ring(&points)], &Design { tolerance: 0.01, side_of_rings, ..design(k, extent) });
    }
    none(&failed);
}

/// Where both sides are built down to an elevation, level curves are closed.
#[test]
fn level_curves_are_closed() {
    for seed in 0..60 {
        let case = common::lines::case(seed, 40);
        let given = line(&case.lines);
        let (low, _) = given.elevation_range();
        let wanted = Design { side_of_rings: Side::Both, tolerance: 0.01, ..design(case.k, Extent::Elevation(low - 5.0)) };
        let surface = common::build::build(&given, &wanted);
        let mut ends = std::collections::HashMap::new();
        for curve in curves(&surface, CurveKind::LevelCurve) {
            for p in curve.points.windows(2).flatten() {
                *ends.entry(p.to_array().map(f64::to_bits)).or_insert(0_usize) += 1;
            }
        }
        let loose = ends.values().filter(|&&n| n % 2 == 1).count();
        assert_eq!(loose, 0, "{}: level curves have {loose} loose ends", case.name);
    }
}

/// A bend lies exactly on the slope of the beginning of the line. What is built on joggled heights is within the tolerance of the
/// line as given.
#[test]
fn a_joggled_line_keeps_the_tolerance() {
    let (k, most) = (0.5, 1e-3);
    let points = [[0.0; 3], [2.0, 0.0, -0.4], [2.0, -2.0, -0.8], [-14.0, -2.0, -0.8 - 1.6], [-14.0, 12.0, -0.8 - 1.6]];
    let lines = [open(&points)];
    let wanted = Design { tolerance: 0.01, ..design(k, Extent::Distance(4.0)) };
    let surface = common::build::build(&line(&lines), &wanted);
    assert!(surface.notes.iter().any(|note| note.code == "line-joggled"), "nothing touches");
    assert!(surface.simplified_max > 0.0 && surface.simplified_max <= most, "{}", surface.simplified_max);
    for p in &surface.tin.vertices {
        let p = surface.tin.frame.to_world(*p);
        let height = common::oracle::height(&lines, k, false, p.x, p.y);
        assert!((p.z - height).abs() <= wanted.tolerance, "{p}: {height}");
    }
}
