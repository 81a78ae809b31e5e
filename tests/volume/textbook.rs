//! Cases from textbooks and manuals whose ground and design are plane or triangulated.

use super::*;
use std::f64::consts::TAU;

/// Cubic feet in a cubic yard.
const YARD: f64 = 27.0;

fn level(x0: f64, y0: f64, x1: f64, y1: f64, z: f64) -> Terrain {
    let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)].map(|(x, y)| DVec3::new(x, y, z));
    terrain(corners.to_vec(), vec![[0, 1, 2], [0, 2, 3]])
}

/// A pit with a level bottom `a × b` at `−depth` and sides of 2H:1V that meet in mitres, up to level nought.
fn pit(a: f64, b: f64, depth: f64) -> Terrain {
    let w = 2.0 * depth;
    let at = |x: f64, y: f64, z: f64| DVec3::new(x, y, z);
    let bottom = [at(0.0, 0.0, -depth), at(a, 0.0, -depth), at(a, b, -depth), at(0.0, b, -depth)];
    let top = [at(-w, -w, 0.0), at(a + w, -w, 0.0), at(a + w, b + w, 0.0), at(-w, b + w, 0.0)];
    let mut triangles = vec![[0, 1, 2], [0, 2, 3]];
    for i in 0..4 {
        let j = (i + 1) % 4;
        triangles.extend([[4 + i, 4 + j, i], [4 + j, j, i]]);
    }
    terrain(bottom.into_iter().chain(top).collect(), triangles)
}

/// Ponds with sides of 2H:1V, by the prismoidal formula `h/6·(A₀ + 4Aₘ + A₁)`, exact for plane sides: rim 100 × 70, 12 deep
/// (University of Regina, Math Central QQ.09.07: 44,256 ft³); bottom 40 × 100, 12 deep (USDA Agriculture Handbook 590:
/// 3,612 yd³).
#[test]
fn ponds() {
    for (a, b, printed) in [(52.0, 22.0, 44_256.0), (40.0, 100.0, 97_536.0)] {
        let (depth, w) = (12.0, 24.0);
        let section = |grown: f64| (a + 2.0 * grown) * (b + 2.0 * grown);
        let expected = depth / 6.0 * (section(0.0) + 4.0 * section(w / 2.0) + section(w));
        assert_eq!(expected, printed);
        let found = volume(&pit(a, b, depth), &level(-50.0, -50.0, 200.0, 200.0, 0.0));
        near(found.cut, expected, 1e-13);
        assert!(found.fill < 1e-20, "the rim lies on the ground: {}", found.fill);
    }
    near(97_536.0 / YARD, 3612.0, 2e-4);
}

/// One triangle of legs 1, ground above design by 1, −1, −1 at its corners. The positive part is a similar triangle of half the
/// size and mean height 1/3: `cut = ½·¼·⅓ = 1/24`; the sum is `½·(1 − 1 − 1)/3 = −1/6`, so `fill = 5/24` (test case of the
/// program tin-earthwork).
#[test]
fn one_triangle() {
    let at = |heights: [f64; 3]| {
        let plan = [(0.0, 0.0), (1.0, 0.0), (0.0, 1.0)];
        terrain(plan.iter().zip(heights).map(|(&(x, y), z)| DVec3::new(x, y, z)).collect(), vec![[0, 1, 2]])
    };
    let found = volume(&at([7.0, 8.0, 9.0]), &at([8.0, 7.0, 8.0]));
    near(found.cut, 1.0 / 24.0, 1e-15);
    near(found.fill, 5.0 / 24.0, 1e-15);
    near(found.net(), -1.0 / 6.0, 1e-15);
}

/// A pad of radius 50 at height 50 with slopes of 1V:2H on level ground (manual of GRASS r.earthworks), as a frustum of an
/// `n`-sided pyramid: `h/3·(A + √(A·B) + B)` with `A = n/2·sin(2π/n)·r²`. For n → ∞ that is π·50/3·(150² + 150·50 + 50²).
#[test]
fn circular_pad() {
    for n in [6_u32, 97, 720] {
        let ring =
            |r: f64, z: f64| (0..n).map(move |i| (DVec2::from_angle(TAU * f64::from(i) / f64::from(n)) * r + 250.0).extend(z));
        let mut vertices: Vec<DVec3> = ring(50.0, 50.0).chain(ring(150.0, 0.0)).collect();
        vertices.push(DVec3::new(250.0, 250.0, 50.0));
        let triangles = (0..n).flat_map(|i| {
            let j = (i + 1) % n;
            [[2 * n, i, j], [i, n + i, n + j], [i, n + j, j]]
        });
        let pad = terrain(vertices, triangles.collect());
        let found = volume(&pad, &random(n.into(), 300, DVec2::ZERO, 500.0, |_| 0.0));
        let unit = 0.5 * f64::from(n) * (TAU / f64::from(n)).sin();
        let expected = unit * 50.0 / 3.0 * (150.0 * 150.0 + 150.0 * 50.0 + 50.0 * 50.0);
        near(found.fill, expected, 1e-12);
        assert!(found.cut < 1e-9);
        if n == 720 {
            near(found.fill, 1_701_696.02, 2e-5);
        }
    }
}

/// Fill in one square cell, cut along either diagonal.
fn cell(side: f64, ground: [f64; 4], design: f64) -> [f64; 2] {
    let corners = [(0.0, 0.0), (side, 0.0), (side, side), (0.0, side)];
    let vertices: Vec<DVec3> = corners.iter().zip(ground).map(|(&(x, y), z)| DVec3::new(x, y, z)).collect();
    [vec![[0, 1, 2], [0, 2, 3]], vec![[0, 1, 3], [1, 2, 3]]]
        .map(|triangles| -volume(&level(0.0, 0.0, side, side, design), &terrain(vertices.clone(), triangles)).net())
}

/// Borrow cells. The books take the mean of four corners, which is the mean of the two diagonals of a square: each is the mean of
/// its triangles' corners.
#[test]
fn borrow_cells() {
    // 50 × 50 ft, corners 87.6, 87.6, 87.6, 88.6, pad at 90: heights 2.4 (three times) and 1.4. Across the odd corner both
    // triangles have it: 2500·6.2/3; beside it one has: 1250·(7.2 + 6.2)/3.
    let [along, across] = cell(50.0, [87.6, 87.6, 87.6, 88.6], 90.0);
    near(along, 1250.0 * (7.2 + 6.2) / 3.0, 1e-13);
    near(across, 2500.0 * 6.2 / 3.0, 1e-13);
    near(along / YARD, 206.79, 1e-5);
    near(across / YARD, 191.36, 2e-5);
    near((along + across) / 2.0 / YARD, 199.07, 3e-5);
    // 2000 ft², corners 75.4, 77.5, 74.6, 80.5, proposed 83 (HeavyCalc 4320 guide): 444.44 yd³.
    let [along, across] = cell(2000.0_f64.sqrt(), [75.4, 77.5, 74.6, 80.5], 83.0);
    near((along + across) / 2.0, 2000.0 * (83.0 - 77.0), 1e-13);
    near((along + across) / 2.0 / YARD, 444.44, 2e-5);
    // 2500 ft², cuts 1.4, 1.4, 1.2, 1.3 (Peterson, Construction Estimating, example 9-8): 3313 ft³.
    let [along, across] = cell(50.0, [1.4, 1.4, 1.2, 1.3], 0.0);
    near(-(along + across) / 2.0, 3312.5, 1e-13);
}
