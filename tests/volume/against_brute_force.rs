//! Every triangle against every other, in plain coordinates, with code of its own.

use super::*;
use proptest::prelude::*;

/// Plane through three points, as a function of plan coordinates.
fn plane([a, b, c]: [DVec3; 3]) -> impl Fn(DVec2) -> f64 {
    let normal = (b - a).cross(c - a);
    move |p| a.z - (normal.x * (p.x - a.x) + normal.y * (p.y - a.y)) / normal.z
}

/// The part of a convex polygon on which a linear function is not negative.
fn keep(polygon: &[DVec2], f: &dyn Fn(DVec2) -> f64) -> Vec<DVec2> {
    let mut out = Vec::new();
    for i in 0..polygon.len() {
        let (p, q) = (polygon[i], polygon[(i + 1) % polygon.len()]);
        let (a, b) = (f(p), f(q));
        if a >= 0.0 {
            out.push(p);
        }
        if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
            out.push(p + (q - p) * (a / (a - b)));
        }
    }
    out
}

/// Integral of a linear function over a polygon.
fn over(polygon: &[DVec2], f: &dyn Fn(DVec2) -> f64) -> f64 {
    (2..polygon.len())
        .map(|i| {
            let t = [polygon[0], polygon[i - 1], polygon[i]];
            0.5 * (t[1] - t[0]).perp_dot(t[2] - t[0]) * f((t[0] + t[1] + t[2]) / 3.0)
        })
        .sum()
}

/// Cut, fill and common area.
fn brute(design: &Terrain, existing: &Terrain) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for s in 0..design.triangles.len() {
        for t in 0..existing.triangles.len() {
            let (d, e) = (design.corners(s), existing.corners(t));
            let mut cell: Vec<DVec2> = d.map(|p| p.truncate()).to_vec();
            for i in 0..3 {
                let (a, b) = (e[i].truncate(), e[(i + 1) % 3].truncate());
                cell = keep(&cell, &|p| (b - a).perp_dot(p - a));
            }
            let (f, g) = (plane(d), plane(e));
            let h = |p: DVec2| f(p) - g(p);
            sums[0] += over(&keep(&cell, &|p| -h(p)), &|p| -h(p));
            sums[1] += over(&keep(&cell, &h), &h);
            sums[2] += over(&cell, &|_| 1.0);
        }
    }
    sums
}

#[track_caller]
fn check(design: &Terrain, existing: &Terrain) {
    let [cut, fill, common] = brute(design, existing);
    // Rounding of the brute force itself: heights of about 10 over areas of about 100.
    const ROUNDING: f64 = 1e-10;
    match between(design, existing, None) {
        Ok(found) => {
            assert!((found.cut - cut).abs() < ROUNDING, "cut {} {cut}", found.cut);
            assert!((found.fill - fill).abs() < ROUNDING, "fill {} {fill}", found.fill);
            assert!((found.common_area() - common).abs() < ROUNDING, "area {} {common}", found.common_area());
            let beside = area(design) - common;
            assert!((found.areas.design_uncovered - beside).abs() < 1e-7, "{} {beside}", found.areas.design_uncovered);
        }
        Err(error) => assert!(common < ROUNDING, "{error}"),
    }
}

/// A TIN over points of a small grid: everything coincides with something.
fn gridded() -> impl Strategy<Value = Terrain> {
    let point = (0..7_i32, 0..7_i32, -3..4_i32);
    (proptest::collection::vec(point, 4..24), any::<u64>()).prop_filter_map("on a line", |(points, drop)| {
        let plan = points.iter().map(|p| DVec2::new(f64::from(p.0), f64::from(p.1)));
        let height =
            |p: DVec2| points.iter().find(|q| (f64::from(q.0), f64::from(q.1)) == (p.x, p.y)).map_or(0.0, |q| f64::from(q.2));
        let mut mesh = delaunay(plan, height);
        // Some triangles are missing: holes, notches, several pieces.
        let mut i = 0;
        mesh.triangles.retain(|_| {
            i += 1;
            drop >> (i % 64) & 7 != 0
        });
        (!mesh.triangles.is_empty()).then_some(mesh)
    })
}

/// A TIN over random points, moved and scaled against the grid.
fn anywhere() -> impl Strategy<Value = Terrain> {
    (any::<u64>(), 0..20_usize, 0.1..9.0_f64, -3.0..6.0_f64, -3.0..6.0_f64).prop_map(|(seed, count, side, x, y)| {
        random(seed, count, DVec2::new(x, y), side, |p| (p.x * 1.7).sin() + (p.y * 1.3).cos())
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, rng_seed: proptest::test_runner::RngSeed::Fixed(3), ..ProptestConfig::default() })]

    #[test]
    fn on_a_grid(design in gridded(), existing in gridded()) {
        check(&design, &existing);
    }

    #[test]
    fn off_the_grid(design in gridded(), existing in anywhere()) {
        check(&design, &existing);
        check(&existing, &design);
    }

    #[test]
    fn in_general_position(design in anywhere(), existing in anywhere()) {
        check(&design, &existing);
    }
}
