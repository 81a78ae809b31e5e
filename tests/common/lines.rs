//! Lines and rings made from a seed. Every segment is flatter than 0.98 of the slope they are made for.

use std::f64::consts::{PI, TAU};

use super::oracle::Polyline;
pub(crate) use super::random::Random;

/// Steepest segments, in slopes.
const STEEPEST: f64 = 0.98;

/// A test case.
#[derive(Clone, Debug)]
pub(crate) struct Case {
    /// What it is, for messages.
    pub(crate) name: String,
    /// Slope, rise per run.
    pub(crate) k: f64,
    /// The lines.
    pub(crate) lines: Vec<Polyline>,
    /// Whether parts of the line may lie buried under the sheet of others. `false`: certainly not.
    pub(crate) may_be_buried: bool,
}

/// Draws heights together about their mean until the steepest segment is flat enough.
fn flatten(mut line: Polyline, k: f64) -> Polyline {
    let (mean, steepest) = (line.points.iter().map(|p| p[2]).sum::<f64>() / line.points.len() as f64, line.steepest());
    let factor = (STEEPEST * k / steepest).min(1.0) * 0.999_999;
    line.points.iter_mut().for_each(|p| p[2] = mean + factor * (p[2] - mean));
    line
}

/// A line from steps: plan length, direction, and gradient in slopes (−1 to 1, of which 0.98 is taken).
fn walk(start: [f64; 3], k: f64, steps: impl Iterator<Item = (f64, f64, f64)>) -> Polyline {
    let mut points = vec![start];
    let mut p = start;
    for (length, direction, gradient) in steps {
        let rise = length * gradient.clamp(-1.0, 1.0) * STEEPEST * 0.999_999 * k;
        p = [p[0] + length * direction.cos(), p[1] + length * direction.sin(), p[2] + rise];
        points.push(p);
    }
    Polyline { points, closed: false }
}

/// A star-shaped ring of `n` vertices (at least 3) and mean radius `radius`, counter-clockwise, with waves in plan and
/// height and radial noise. Never crosses itself.
pub(crate) fn star(random: &mut Random, n: usize, radius: f64, wave_z: f64, noise: f64, k: f64) -> Polyline {
    let (lobes, phase) = ((2 + random.below(4)) as f64, random.between(0.0, TAU));
    let depth = random.between(0.0, 0.35);
    let points = (0..n).map(|i| {
        let w = TAU * i as f64 / n as f64;
        let r = radius * (1.0 + depth * (lobes * w + phase).sin() + 0.03 * (11.0 * w).sin()) + random.between(-noise, noise);
        [r * w.cos(), r * w.sin(), wave_z * (2.0 * w + phase).sin() + 0.2 * random.between(-noise, noise)]
    });
    let points = points.collect();
    flatten(Polyline { points, closed: true }, k)
}

/// A road of `n` segments that wanders with slowly changing direction; gradients change from segment to segment (`rough`) or
/// in long waves.
pub(crate) fn road(random: &mut Random, n: usize, step: f64, rough: bool, k: f64) -> Polyline {
    let (mut direction, mut bend) = (random.between(0.0, TAU), 0.0);
    let (wave, phase) = (random.between(0.05, 0.4), random.between(0.0, TAU));
    walk(
        [0.0, 0.0, 10.0],
        k,
        (0..n).map(|i| {
            bend = 0.8 * bend + random.between(-0.1, 0.1);
            direction += bend;
            let gradient = if rough { random.between(-1.0, 1.0) } else { (wave * i as f64 + phase).sin() };
            (step * random.between(0.5, 1.5), direction, gradient)
        }),
    )
}

/// A hairpin: up, around a half circle of `arc` segments and radius `radius`, and back, all at `gradient` slopes.
pub(crate) fn hairpin(leg: f64, radius: f64, arc: usize, gradient: f64, k: f64) -> Polyline {
    let chord = 2.0 * radius * (PI / (2.0 * arc as f64)).sin();
    let turn = (0..arc).map(|i| (chord, PI * (i as f64 + 0.5) / arc as f64, gradient));
    let steps = std::iter::once((leg, 0.0, gradient)).chain(turn).chain(std::iter::once((leg, PI, gradient)));
    walk([0.0, 0.0, 5.0], k, steps)
}

/// A zig-zag of `n` legs with sharp bends, up and down at random.
pub(crate) fn zigzag(random: &mut Random, n: usize, leg: f64, k: f64) -> Polyline {
    let swing = random.between(0.8, 1.5);
    let steps = (0..n).map(|i| {
        let direction = if i % 2 == 0 { swing } else { -swing };
        (leg * random.between(0.7, 1.3), direction, random.between(-0.5, 0.5))
    });
    walk([0.0, 0.0, 0.0], k, steps)
}

/// Separate small rings and lines at random heights. `apart`: far enough that none buries another.
pub(crate) fn islands(random: &mut Random, count: usize, apart: bool, k: f64) -> Vec<Polyline> {
    let columns = (count as f64).sqrt().ceil() as usize;
    let mut lines = Vec::new();
    for i in 0..count {
        let n = 3 + random.below(8);
        let line = if random.below(3) == 0 {
            road(random, n, 2.0, false, 0.3 * k)
        } else {
            star(random, n, random_radius(i), 0.2, 0.0, 0.5 * k)
        };
        // Two islands differ by less than `2·spread` in height and stand at least 20 apart.
        let spread = if apart { 4.0 * k } else { 30.0 * k };
        let z = random.between(-spread, spread) - line.points[0][2];
        let (x, y) = (90.0 * (i % columns) as f64, 90.0 * (i / columns) as f64);
        let moved = line.points.iter().map(|p| [p[0] + x, p[1] + y, p[2] + z]).collect();
        lines.push(Polyline { points: moved, closed: line.closed });
    }
    lines
}

fn random_radius(i: usize) -> f64 {
    5.0 + (i % 7) as f64
}

/// Two roads that cross in plan, one `over` higher at the crossing.
pub(crate) fn crossing_roads(random: &mut Random, n: usize, over: f64, k: f64) -> Vec<Polyline> {
    let mut lines = Vec::new();
    for (i, direction) in [0.2, 1.4].into_iter().enumerate() {
        let mut line = walk([0.0; 3], k, (0..n).map(|_| (5.0, direction + random.between(-0.1, 0.1), random.between(-0.3, 0.3))));
        let middle = line.points[n / 2];
        let z = if i == 0 { 0.0 } else { over };
        line.points.iter_mut().for_each(|p| *p = [p[0] - middle[0], p[1] - middle[1], p[2] - middle[2] + z]);
        lines.push(line);
    }
    lines
}

/// Segments of a tenth of a millimetre beside some of a kilometre.
pub(crate) fn tiny_beside_huge(random: &mut Random, n: usize, k: f64) -> Polyline {
    let mut direction = 0.0;
    walk(
        [0.0; 3],
        k,
        (0..n).map(|i| {
            direction += random.between(-0.3, 0.3);
            (if i % 4 == 0 { 1e3 } else { 1e-4 }, direction, random.between(-0.5, 0.5))
        }),
    )
}

/// A case of any kind, with up to about `size` vertices; the same for the same seed.
pub(crate) fn case(seed: u64, size: usize) -> Case {
    let random = &mut Random::new(seed);
    let k = [0.5, 2.0 / 3.0, 1.0, 2.0, random.between(0.1, 3.0)][random.below(5)];
    let n = (3.0 + (size.max(4) as f64 - 3.0) * random.between(0.0, 1.0).powi(2)) as usize;
    let (name, lines, may_be_buried) = match seed % 10 {
        0 => ("level star", vec![star(random, n, 40.0, 0.0, 0.0, k)], false),
        1 => ("smooth star", vec![star(random, n, 40.0, 3.0, 0.0, k)], true),
        2 => ("noisy star", vec![star(random, n, 40.0, 3.0, 0.02, k)], true),
        3 => ("road", vec![road(random, n, 4.0, false, k)], true),
        4 => ("rough road", vec![road(random, n, 4.0, true, k)], true),
        5 => {
            let gradient = random.between(0.0, 1.0);
            ("hairpin", vec![hairpin(60.0, random.between(3.0, 20.0), n.min(40), gradient, k)], true)
        }
        6 => ("zig-zag", vec![zigzag(random, n.min(60), 30.0, k)], true),
        7 => ("islands apart", islands(random, 1 + n / 10, true, k), false),
        8 => {
            let over = random.between(-5.0, 5.0);
            ("crossing roads", crossing_roads(random, 3 + n / 2, over, k), true)
        }
        _ => ("tiny beside huge", vec![tiny_beside_huge(random, n.min(40), k)], true),
    };
    Case { name: format!("{name}, seed {seed}, slope {k}, {n} asked"), k, lines, may_be_buried }
}
