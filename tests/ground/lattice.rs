//! Everything on a lattice: ground of steps of 1 on cells of 4, lines at whole coordinates and heights, slopes of 1:2 and 1:1.
//! Vertices meet vertices, edges run along edges, slopes lie in the ground, and the works touch themselves.

use crate::common::build::{open, rectangle};
use crate::common::lines::Random;
use crate::finished::{watertight, worth};
use crate::oracle::sample;
use crate::run::build;
use crate::site::Site;
use crate::tin::{Cells, Ground, about};

/// A random site. Ground at the rim is level and low enough for all fill, or high enough for all cut, to end on it.
fn site(seed: u64) -> Site {
    let random = &mut Random::new(seed);
    let steps = [1.0, 2.0, 4.0][random.below(3)];
    let (n, cell) = (14, 4.0);
    let heights: Vec<f64> =
        (0..=n).flat_map(|_| (0..=n).map(|_| (random.between(0.0, steps + 1.0)).floor()).collect::<Vec<_>>()).collect();
    let at = |x: f64, y: f64| {
        let [i, j] = [x, y].map(|v| ((v + 28.0) / cell).round() as usize);
        if i < 2 || j < 2 || i > n - 2 || j > n - 2 { 1.0 } else { heights[j * (n + 1) + i] }
    };
    let ground = Ground::grid(about(28.0), n, n, at);
    let whole = |random: &mut Random, lo: f64, hi: f64| random.between(lo, hi + 1.0).floor();
    let (x, y, z) = (whole(random, -8.0, 0.0), whole(random, -8.0, 0.0), whole(random, 0.0, 3.0));
    let line = match random.below(3) {
        0 => rectangle([x, y, z], whole(random, 2.0, 10.0), whole(random, 2.0, 10.0)),
        1 => rectangle([4.0 * (x / 4.0).round(), 4.0 * (y / 4.0).round(), z], 8.0, 4.0 * whole(random, 1.0, 2.0)),
        _ => {
            let w = x + 4.0 * whole(random, 1.0, 3.0);
            open(&[[x, y, z], [w, y, z], [w, y + 4.0 * whole(random, 1.0, 2.0), whole(random, z, z + 1.0)]])
        }
    };
    Site::new(vec![line], 0.5, ground).cut_slope([0.5, 1.0][random.below(2)]).tolerance(1e-3)
}

#[test]
fn figures_and_meshes_agree() {
    for seed in 0..60 {
        let name = format!("lattice {seed}");
        let site = site(seed);
        let built = build(&site, "");
        watertight(&name, &site, &built);
        worth(&name, &site, &built);
    }
}

/// With the brute force too, but for lines with a vertex exactly in the ground: whether works that touch the line in that point
/// alone belong to it, no raster can tell.
#[test]
fn brute_force_agrees() {
    let mut count = 0;
    for seed in 0..30 {
        let site = site(seed);
        let cells = Cells::new(&site.ground);
        let above = |p: &[f64; 3]| p[2] - cells.height(&site.ground, p[0], p[1], 1e-9).unwrap();
        if site.lines[0].points.iter().all(|p| above(p).abs() > 1e-9) {
            build(&site, "").figures().roughly(&sample(&site, about(28.0), 400), 1e-2, &format!("lattice {seed}"));
            count += 1;
        }
    }
    assert!(count > 10, "{count} sites");
}
