//! Design on ground, from the library: whatever line and ground, the finished ground must be whole and the volumes add up.

mod common;

use common::build::{design, line, open, rectangle, ring};
use common::lines::Random;
use common::oracle::Polyline;
use glam::DVec3;
use slopegen::ground::{Ground, GroundError, Options, Site};
use slopegen::kernel::frame::Frame;
use slopegen::model::{CurveKind, Design, Extent, Sheet, Slope, Terrain, Tin};

/// A grid of `n × n` cells over a square of half-width `half` about the origin, inner vertices shifted by up to `jitter` cells,
/// heights from `z`.
fn ground(n: usize, half: f64, jitter: f64, seed: u64, z: impl Fn(f64, f64) -> f64) -> Terrain {
    let mut random = Random::new(seed);
    let cell = 2.0 * half / n as f64;
    let mut vertices = Vec::new();
    for j in 0..=n {
        for i in 0..=n {
            let inner = |k: usize| k > 0 && k < n;
            let mut shift = |k| if inner(k) && jitter > 0.0 { cell * random.between(-jitter, jitter) } else { 0.0 };
            let (x, y) = (i as f64 * cell - half + shift(i), j as f64 * cell - half + shift(j));
            vertices.push(DVec3::new(x, y, z(x, y)));
        }
    }
    let mut triangles = Vec::new();
    let at = |i: usize, j: usize| (j * (n + 1) + i) as u32;
    for j in 0..n {
        for i in 0..n {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            triangles.extend(if random.below(2) == 0 { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
        }
    }
    Terrain { frame: Frame::WORLD, vertices, triangles }
}

/// Rolling ground: three waves.
fn rolling(seed: u64, height: f64, length: f64) -> impl Fn(f64, f64) -> f64 {
    let mut random = Random::new(seed);
    let waves: Vec<[f64; 4]> = (0..3)
        .map(|_| {
            let (angle, l) = (random.between(0.0, std::f64::consts::TAU), length * random.between(0.6, 1.6));
            [angle.cos() / l, angle.sin() / l, random.between(0.0, 6.0), height * random.between(0.3, 1.0)]
        })
        .collect();
    move |x, y| waves.iter().map(|w| w[3] * (6.0 * (w[0] * x + w[1] * y) + w[2]).sin()).sum()
}

fn build(lines: &[Polyline], cut: f64, fill: f64, terrain: &Terrain, options: &Options) -> Result<Ground, GroundError> {
    let line = line(lines);
    let mut site = Site::new(&line, terrain.clone(), "ground");
    let slope = |k: f64| Slope::from_ratio(k).unwrap();
    let down = site.end(slope(fill), Sheet::Falling, 1e-3);
    let up = site.end(slope(cut), Sheet::Rising, 1e-3);
    let designs = [design(fill, Extent::Elevation(down)), Design { sheet: Sheet::Rising, ..design(cut, Extent::Elevation(up)) }];
    site.build(&designs, options, &())
}

const FINISHED: Options = Options { allow_open: false, finished: true, stations: None, keep: false };

fn plan_area([a, b, c]: [DVec3; 3]) -> f64 {
    0.5 * (b - a).truncate().perp_dot((c - a).truncate())
}

/// ∫ z over all triangles, about height `z0`.
fn moment(triangles: impl Iterator<Item = [DVec3; 3]>, z0: f64) -> f64 {
    triangles.map(|t| plan_area(t) * ((t[0].z + t[1].z + t[2].z) / 3.0 - z0)).sum()
}

fn corners(tin: &Tin) -> impl Iterator<Item = [DVec3; 3]> + '_ {
    (0..tin.triangles.len()).map(|t| tin.corners(t))
}

/// What must hold for any finished ground: its plan area is that of the given ground, and what it gained in volume is fill less
/// cut. Both by sums of their own over the meshes.
fn examine(built: &Ground, terrain: &Terrain) -> Result<(), String> {
    let finished = built.finished.as_ref().unwrap();
    let given = || (0..terrain.triangles.len()).map(|t| terrain.corners(t));
    let (before, after): (f64, f64) = (given().map(plan_area).sum(), corners(finished).map(plan_area).sum());
    if (before - after).abs() > 1e-9 * before {
        return Err(format!("plan area {before} became {after}"));
    }
    let gained = moment(corners(finished), 0.0) - moment(given(), 0.0);
    let total = &built.tallied.total;
    // Heights below 1e-8 count as none for the mesh.
    let bound = 1e-9 * (total.cut + total.fill) + 1e-8 * before;
    if (gained - (total.fill - total.cut)).abs() > bound {
        return Err(format!("gained {gained}, fill {} cut {}", total.fill, total.cut));
    }
    // All of the border is where design and ground meet: there are slopes on both sides, and the finished ground has no walls.
    if let Some(line) = built.lines.iter().find(|line| line.kind == CurveKind::Boundary) {
        return Err(format!("{} points of boundary, from {}", line.points.len(), line.points[0]));
    }
    Ok(())
}

/// Allowing open ends changes nothing where there are none.
fn same_with_open_ends(lines: &[Polyline], [cut, fill]: [f64; 2], terrain: &Terrain, built: &Ground) -> Result<(), String> {
    let with = build(lines, cut, fill, terrain, &Options { allow_open: true, ..FINISHED }).map_err(|e| e.to_string())?;
    let mesh = |tin: &Tin| (tin.vertices.clone(), tin.triangles.clone(), tin.parts.clone());
    let parts = |ground: &Ground| {
        (mesh(&ground.design), ground.finished.as_ref().map(mesh), ground.daylight, ground.tallied.total, ground.notes.clone())
    };
    let same = parts(&with) == parts(built) && with.complete;
    if same { Ok(()) } else { Err("other results with open ends allowed".to_owned()) }
}

#[test]
fn a_pad_half_in_cut_half_in_fill() {
    let terrain = ground(20, 100.0, 0.0, 1, |x, _| 0.2 * x);
    let built = build(&[rectangle([-10.0, -10.0, 0.0], 20.0, 20.0)], 1.0, 0.5, &terrain, &FINISHED).unwrap();
    examine(&built, &terrain).unwrap();
    assert_eq!(built.daylight.loops, 1);
    let t = &built.tallied;
    // Platform: ∫ 0.2 x over x from 0 to 10, width 20.
    assert!((t.platform.cut - 200.0).abs() < 1e-9 && (t.platform.fill - 200.0).abs() < 1e-9, "{t:?}");
}

/// A square yard of side 10, 1 above level ground, with slopes 1:1: along each side a prism of volume 10/2, at each corner a
/// quarter of a cone, π/12. Wherever the ring begins, and whichever way it runs, each interval of 10 has one side and one corner.
#[test]
fn stations_of_a_ring_do_not_depend_on_its_first_vertex() {
    let terrain = ground(10, 50.0, 0.0, 1, |_, _| 0.0);
    let corners = [[0.0, 0.0, 1.0], [10.0, 0.0, 1.0], [10.0, 10.0, 1.0], [0.0, 10.0, 1.0]];
    let mut rings = Vec::new();
    for first in 0..4 {
        let mut points = corners.to_vec();
        points.rotate_left(first);
        // The first vertex on a side, where simplifying drops it.
        let middle = [0.5 * (points[0][0] + points[3][0]), 0.5 * (points[0][1] + points[3][1]), 1.0];
        rings.push(points.clone());
        rings.push([vec![middle], points].concat());
    }
    let backwards: Vec<_> = rings.iter().map(|points| points.iter().rev().copied().collect()).collect();
    for points in [rings, backwards].concat() {
        let options = Options { stations: Some(10.0), ..FINISHED };
        let built = build(&[ring(&points)], 1.0, 1.0, &terrain, &options).unwrap();
        for interval in &built.tallied.axes[0] {
            let expected = 5.0 + std::f64::consts::PI / 12.0;
            assert!((interval.amounts.fill - expected).abs() < 2e-3, "{points:?}: {interval:?}");
        }
    }
}

#[test]
fn rolling_ground() {
    let mut failures = Vec::new();
    for seed in 0..400 {
        let mut random = Random::new(1000 + seed);
        let jitter = [0.0, 0.2][random.below(2)];
        let z = rolling(seed, 4.0, 60.0);
        let terrain = ground(20 + random.below(40), 150.0, jitter, seed, &z);
        let at = |random: &mut Random, r: f64| [random.between(-r, r), random.between(-r, r)];
        let lines = match random.below(3) {
            0 => {
                let [x, y] = at(&mut random, 20.0);
                let h = z(x, y) + random.between(-3.0, 3.0);
                vec![rectangle([x, y, h], random.between(5.0, 40.0), random.between(5.0, 40.0))]
            }
            1 => {
                let (mut p, h) = (at(&mut random, 10.0), random.between(-2.0, 2.0));
                p[0] -= 40.0;
                let mut points = Vec::new();
                let mut a = random.between(-0.5, 0.5);
                let mut height = h;
                for _ in 0..12 {
                    points.push([p[0], p[1], height]);
                    a += random.between(-0.4, 0.4);
                    p = [p[0] + 7.0 * f64::cos(a), p[1] + 7.0 * f64::sin(a)];
                    height += random.between(-0.7, 0.7);
                }
                vec![open(&points)]
            }
            _ => {
                let n = 3 + random.below(9);
                let (r, h) = (random.between(6.0, 25.0), random.between(-3.0, 3.0));
                let tilt = random.between(-0.1, 0.1);
                vec![ring(
                    &(0..n)
                        .map(|i| {
                            let (s, c) = (std::f64::consts::TAU * i as f64 / n as f64).sin_cos();
                            let r = r * random.between(0.6, 1.0);
                            [r * c, r * s, h + tilt * r * c]
                        })
                        .collect::<Vec<_>>(),
                )]
            }
        };
        let what = format!("seed {seed}");
        match build(&lines, 1.0, 0.6, &terrain, &FINISHED) {
            Ok(built) => {
                failures.extend(examine(&built, &terrain).err().map(|e| format!("{what}: {e}")));
                if seed % 8 == 0 {
                    let same = same_with_open_ends(&lines, [1.0, 0.6], &terrain, &built);
                    failures.extend(same.err().map(|e| format!("{what}: {e}")));
                }
            }
            Err(e) => failures.push(format!("{what}: {e}")),
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures[..failures.len().min(12)].join("\n"));
}

/// Ground and lines on whole numbers: vertices on vertices, edges along edges, slopes in the plane of the ground, platforms level
/// with it.
#[test]
fn everything_on_whole_numbers() {
    let mut failures = Vec::new();
    for seed in 0..600 {
        let mut random = Random::new(5000 + seed);
        let n = 8 + 2 * random.below(5);
        let heights: Vec<f64> = (0..64).map(|_| random.below(4) as f64).collect();
        let kind = random.below(4);
        let z = |x: f64, y: f64| match kind {
            0 => 0.0,
            1 => x.abs().min(6.0),
            2 => x - 2.0 * (y / 4.0).floor(),
            _ => heights[((x.rem_euclid(8.0)) as usize) * 8 + y.rem_euclid(8.0) as usize],
        };
        let half = n as f64 * [1.0, 2.0][random.below(2)];
        let terrain = ground(n, 2.0 * half, 0.0, seed, z);
        let whole = |random: &mut Random, r: usize| random.below(2 * r + 1) as f64 - r as f64;
        let h = whole(&mut random, 3);
        let lines = match random.below(3) {
            0 => {
                let [x, y] = [whole(&mut random, 3), whole(&mut random, 3)];
                vec![rectangle([x, y, h], 1.0 + random.below(5) as f64, 1.0 + random.below(5) as f64)]
            }
            1 => vec![ring(&[[-3.0, 0.0, h], [0.0, -3.0, h], [3.0, 0.0, h], [0.0, 3.0, h]])],
            _ => {
                let dx = 1.0 + random.below(3) as f64;
                let g = whole(&mut random, 1) * 0.25 * dx;
                let dy = whole(&mut random, 1);
                vec![open(&(0..4).map(|i| f64::from(i) - 2.0).map(|t| [dx * t, dy * t, h + g * t]).collect::<Vec<_>>())]
            }
        };
        let k = [1.0, 0.5][random.below(2)];
        let what = format!("seed {seed}");
        match build(&lines, 1.0, k, &terrain, &FINISHED) {
            Ok(built) => {
                failures.extend(examine(&built, &terrain).err().map(|e| format!("{what}: {e}")));
                if seed % 8 == 0 {
                    let same = same_with_open_ends(&lines, [1.0, k], &terrain, &built);
                    failures.extend(same.err().map(|e| format!("{what}: {e}")));
                }
            }
            Err(GroundError::Open { .. }) if kind == 2 || half < 12.0 => {}
            Err(e) => failures.push(format!("{what}: {e}")),
        }
    }
    assert!(failures.is_empty(), "{} failures\n{}", failures.len(), failures[..failures.len().min(12)].join("\n"));
}
