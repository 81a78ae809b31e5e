//! The whole engine on random lines, against formulas of its own and a brute force that shares no code with it.

mod common;

use common::lines::{Case, Random, case};
use common::oracle;
use glam::{DVec2, DVec3};
use slopegen::model::{Chain, CurveKind, Design, Extent, Line, Part, Place, Role, Sheet, Side, Slope};
use slopegen::surface::{self, Surface};
use std::collections::HashMap;

/// The library's line for a case.
fn line_of(case: &Case) -> Line {
    let chains = case.lines.iter().enumerate().map(|(i, l)| Chain {
        name: format!("line {}", i + 1),
        role: if l.closed { Role::Outer { polygon: i as u32 } } else { Role::Open },
        vertices: l.points.iter().map(|&p| DVec3::from(p)).collect(),
        places: vec![Place::default(); l.points.len()],
    });
    Line { chains: chains.collect() }
}

fn design(k: f64, sheet: Sheet, side: Side, extent: Extent, tolerance: f64) -> Design {
    Design {
        slope: Slope::from_ratio(k).unwrap(),
        sheet,
        side_of_lines: side,
        side_of_rings: side,
        extent,
        interval: None,
        tolerance,
    }
}

/// A random extent for a line, 1 to 30 below (above) it, as an elevation, a height or a distance.
fn extent_of(random: &mut Random, line: &Line, k: f64, sheet: Sheet) -> Extent {
    let (low, high) = line.elevation_range();
    let depth = random.between(1.0, 12.0);
    match (random.below(3), sheet) {
        (0, Sheet::Falling) => Extent::Elevation(low - depth),
        (0, Sheet::Rising) => Extent::Elevation(high + depth),
        (1, _) => Extent::Height(depth),
        _ => Extent::Distance(depth / k),
    }
}

/// Checks a surface with nothing but its triangles, the case and the brute force.
fn examine(name: &str, case: &Case, design: &Design, surface: &Surface) {
    let (k, rising) = (case.k, design.sheet == Sheet::Rising);
    let tin = &surface.tin;
    assert!(!tin.triangles.is_empty(), "{name}: no triangles");
    // An oriented surface: each directed edge once, counter-clockwise triangles only.
    let mut edges = HashMap::new();
    let mut random = Random::new(99);
    for (t, ids) in tin.triangles.iter().enumerate() {
        let [a, b, c] = ids.map(|v| tin.world(v as usize));
        let area = (b - a).truncate().perp_dot((c - a).truncate());
        assert!(area > 0.0, "{name}: triangle {t} has plan area {area}");
        for (v, w) in [(ids[0], ids[1]), (ids[1], ids[2]), (ids[2], ids[0])] {
            assert!(edges.insert((v, w), t).is_none(), "{name}: edge {v}-{w} twice in one direction");
        }
        if tin.parts[t] == Part::Platform {
            continue;
        }
        let normal = (b - a).cross(c - a);
        let drop = a.z.max(b.z).max(c.z) - a.z.min(b.z).min(c.z);
        let off = (normal.truncate().length().atan2(normal.z) - k.atan()).to_degrees().abs();
        assert!(drop < 1e-4 || off < 0.1, "{name}: triangle {t} is {off}° off, drop {drop}");
        // Heights at a corner and inside.
        if random.below(1 + tin.triangles.len() / 400) == 0 {
            let (u, v) = (random.between(0.0, 1.0), random.between(0.0, 1.0));
            let (u, v) = if u + v > 1.0 { (1.0 - u, 1.0 - v) } else { (u, v) };
            for p in [a, a + (b - a) * u + (c - a) * v] {
                let f = oracle::height(&case.lines, k, rising, p.x, p.y);
                let bound = design.tolerance + 1e-12 * p.abs().max_element();
                assert!((f - p.z).abs() <= bound, "{name}: triangle {t} at {p}: the sheet is at {f}");
            }
        }
    }
    let certificate = surface.certificate;
    assert!(certificate.paired && certificate.manifold && certificate.input_edges_kept, "{name}: {certificate:?}");
    assert_eq!((certificate.overlaps, certificate.triangles_beyond_0_1deg), (0, 0), "{name}");
    assert!(certificate.strip_max_deviation_deg < 0.01, "{name}: {certificate:?}");
    // Level curves lie on the boundary of the union of tapered capsules.
    for curve in surface.lines.iter().filter(|l| l.kind == CurveKind::LevelCurve) {
        let c = curve.elevation.unwrap();
        let p = curve.points[random.below(curve.points.len())];
        assert!((p.z - c).abs() <= 1e-6, "{name}: level {c} has a point at {}", p.z);
        let distance = oracle::capsule_distance(&case.lines, k, rising, c, p.x, p.y);
        assert!(distance.abs() <= (design.tolerance + 1e-6) / k, "{name}: level {c}: {distance} from the capsules at {p}");
    }
}

fn scope(seed: u64, size: usize, tolerance: f64) -> Result<(), String> {
    let case = case(seed, size);
    let mut random = Random::new(seed ^ 0xABCD);
    let line = line_of(&case);
    let sheet = if random.below(2) == 0 { Sheet::Falling } else { Sheet::Rising };
    let side = [Side::Both, Side::Both, Side::Left, Side::Right][random.below(4)];
    let side = if case.lines.iter().any(|l| l.closed) { Side::Both } else { side };
    let extent = extent_of(&mut random, &line, case.k, sheet);
    let design = design(case.k, sheet, side, extent, tolerance);
    let name = format!("seed {seed} ({}) {side:?} {sheet:?} {extent:?}", case.name);
    match surface::build(&line, &design, None, &()) {
        Err(e) => Err(format!("{name}: {e}")),
        Ok(surface) => std::panic::catch_unwind(|| examine(&name, &case, &design, &surface)).map_err(|p| {
            p.downcast_ref::<String>().cloned().unwrap_or_else(|| name.clone())
        }),
    }
}

#[test]
fn explore() {
    std::panic::set_hook(Box::new(|_| {}));
    let from: u64 = std::env::var("FROM").ok().and_then(|v| v.parse().ok()).unwrap_or(0);
    let count: u64 = std::env::var("COUNT").ok().and_then(|v| v.parse().ok()).unwrap_or(100);
    let mut bad = 0;
    for seed in from..from + count {
        for (size, tol) in [(12, 0.01), (60, 0.01), (60, 1e-6)] {
            let t = std::time::Instant::now();
            if let Err(e) = scope(seed, size, tol) {
                bad += 1;
                println!("size {size} tol {tol}: {}", e.replace('\n', " | "));
            }
            if t.elapsed().as_secs_f64() > 3.0 { println!("slow {seed} {size} {tol} {:?}", t.elapsed()); }
        }
    }
    println!("bad {bad}");
    let _ = DVec2::ZERO;
}
