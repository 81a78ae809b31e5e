//! Rolling ground, roads through cut and fill, pads on steep hillsides: the exact figures against sums over rasters.

use crate::common::lines::Random;
use crate::common::oracle::Polyline;
use crate::oracle::sample;
use crate::run::build;
use crate::site::Site;
use crate::tin::{Box2, Cells, Ground};
use std::f64::consts::TAU;

/// A smooth hillside: a plane and four waves. Waves are `steep` times their length high, a share of each.
fn hills(random: &mut Random, tilt: f64, steep: f64) -> impl Fn(f64, f64) -> f64 + use<> {
    let direction = random.between(0.0, TAU);
    let waves: Vec<[f64; 4]> = (0..4)
        .map(|i| {
            let length = 70.0 / f64::from(i + 1) * random.between(0.8, 1.2);
            let (sin, cos) = random.between(0.0, TAU).sin_cos();
            [TAU * cos / length, TAU * sin / length, random.between(0.0, TAU), steep * length / TAU / 2.0]
        })
        .collect();
    move |x, y| {
        let plane = 300.0 + tilt * (x * direction.cos() + y * direction.sin());
        plane + waves.iter().map(|&[a, b, phase, height]| height * (a * x + b * y + phase).sin()).sum::<f64>()
    }
}

/// A road without width over rolling ground, in and out of it: `n` segments of 9 each that bend by up to 15°, at the height of
/// the ground plus a wave of the road, gradients up to 0.15.
pub(crate) fn road(seed: u64, n: usize) -> Site {
    let random = &mut Random::new(seed);
    let height = hills(random, 0.05, 0.12);
    let half = 4.5 * n as f64 + 45.0;
    let ground = Ground::jittered(random, [[-half, -half], [half, half]], 40, &height);
    let mut heading = random.between(0.0, TAU);
    let mut at = [-4.5 * n as f64 * heading.cos(), -4.5 * n as f64 * heading.sin()];
    let cells = Cells::new(&ground);
    let on = |at: [f64; 2]| cells.height(&ground, at[0], at[1], 1e-9).expect("the ground is large enough");
    let mut z = on(at) + random.between(-1.0, 1.0);
    let phase = random.between(0.0, TAU);
    let mut points = vec![[at[0], at[1], z]];
    for i in 0..n {
        heading += random.between(-0.26, 0.26);
        at = [at[0] + 9.0 * heading.cos(), at[1] + 9.0 * heading.sin()];
        let wanted = on(at) + 3.0 * (phase + 0.7 * i as f64).sin();
        z += (wanted - z).clamp(-1.35, 1.35);
        points.push([at[0], at[1], z]);
    }
    Site::new(vec![Polyline { points, closed: false }], 0.5, ground).cut_slope(0.8).tolerance(1e-3)
}

/// A pad of `n` corners with a fall on a hillside of slope `tilt`, about its middle height. Some corners are re-entrant.
pub(crate) fn pad(seed: u64, n: usize, tilt: f64) -> Site {
    let random = &mut Random::new(seed);
    let height = hills(random, tilt, 0.08);
    let half = 90.0;
    let ground = Ground::jittered(random, [[-half, -half], [half, half]], 36, &height);
    let middle = height(0.0, 0.0) + random.between(-1.0, 1.0);
    let fall = [random.between(-0.03, 0.03), random.between(-0.03, 0.03)];
    let corner = |i: usize| {
        let (sin, cos) = (TAU * (i as f64 + random.between(-0.3, 0.3)) / n as f64).sin_cos();
        let radius = random.between(9.0, 17.0);
        let (x, y) = (radius * cos, radius * sin);
        [x, y, middle + fall[0] * x + fall[1] * y]
    };
    let points = (0..n).map(corner).collect();
    Site::new(vec![Polyline { points, closed: true }], 0.6, ground).cut_slope(1.0).tolerance(1e-3)
}

/// The box of the works with a margin that holds all slopes.
pub(crate) fn works(site: &Site, margin: f64) -> Box2 {
    let all = || site.lines.iter().flat_map(|l| &l.points);
    let bound = |axis: usize, most: fn(f64, f64) -> f64, start: f64| all().map(|p| p[axis]).fold(start, most);
    let lo = [0, 1].map(|axis| bound(axis, f64::min, f64::INFINITY) - margin);
    [lo, [0, 1].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY) + margin)]
}

/// The raster's own error, from what it is with half as many cells each way: sums converge with the square of the cell, so the
/// difference is three times the error of the finer one; it is taken whole, and a grain of noise beside it.
#[track_caller]
fn agrees(name: &str, site: &Site, margin: f64, n: usize) {
    let area = works(site, margin);
    let (coarse, fine) = (sample(site, area, n / 2), sample(site, area, n));
    let built = build(site, "");
    let found = built.figures();
    let earth = found.cut + found.fill;
    assert!(earth > 50.0, "{name}: {found:?}");
    let bound = built.number("volumes.error_bound");
    for (what, found, fine, coarse) in [("cut", found.cut, fine.cut, coarse.cut), ("fill", found.fill, fine.fill, coarse.fill)] {
        let allowed = ((fine - coarse).abs() + 3e-4 * earth).min(2e-3 * earth) + bound;
        assert!((found - fine).abs() <= allowed, "{name}: {what} {found}, by brute force {fine}, before {coarse}");
    }
    found.areas_near(&fine, 1e-2, name);
    assert_eq!(built.report["volumes"]["complete"], true, "{name}");
}

/// Both kinds of earth occur in most, or the sites test nothing.
#[test]
fn sites_have_cut_and_fill() {
    let figures: Vec<_> = (1..=8)
        .map(|seed| {
            let site = if seed % 2 == 0 { road(seed, 14) } else { pad(seed, 7, 0.3) };
            (seed, sample(&site, works(&site, 40.0), 120))
        })
        .collect();
    assert!(figures.iter().all(|(_, f)| f.cut + f.fill > 50.0), "{figures:?}");
    assert!(figures.iter().filter(|(_, f)| f.cut.min(f.fill) > 0.1 * f.cut.max(f.fill)).count() > 5, "{figures:?}");
}

/// Sums over rasters converge: with cells half as wide they move by less than the bar they are used for.
#[test]
fn brute_force_converges() {
    for site in [road(2, 14), pad(3, 7, 0.3)] {
        let area = works(&site, 40.0);
        let [coarse, fine] = [240, 480].map(|n| sample(&site, area, n));
        coarse.roughly(&fine, 3e-3, "coarse and fine");
    }
}

#[test]
fn roads() {
    for seed in 1..=8 {
        agrees(&format!("road {seed}"), &road(seed, 8 + seed as usize), 40.0, 480);
    }
}

#[test]
fn pads_on_hillsides() {
    for seed in 1..=8 {
        let tilt = [0.0, 0.15, 0.3, 0.38][seed as usize % 4];
        agrees(&format!("pad {seed} on {tilt}"), &pad(seed, 4 + seed as usize, tilt), 60.0, 480);
    }
}
