//! Cut and fill by brute force: heights at the middles of the cells of a fine raster, the sheets by loops over all segments.
//!
//! `G = min(max(T, f⁻), f⁺)` outside the platform, where only what hangs together with the line counts, by flood fill over the
//! raster; the platform is the plane of its ring. What is summed is continuous with kinks along a few curves, so the sums
//! converge with the square of the cell.

use crate::common::oracle::{Polyline, height};
use crate::figures::Figures;
use crate::site::Site;
use crate::tin::{Box2, Cells};

/// What a cell of the raster is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    Nothing,
    Platform,
    Fill,
    Cut,
}

/// Sums over `n` by `n` cells of a box, which must hold all works.
pub(crate) fn sample(site: &Site, [lo, hi]: Box2, n: usize) -> Figures {
    let cell = [(hi[0] - lo[0]) / n as f64, (hi[1] - lo[1]) / n as f64];
    let at = |i: usize| [lo[0] + cell[0] * ((i % n) as f64 + 0.5), lo[1] + cell[1] * ((i / n) as f64 + 0.5)];
    let cells = Cells::new(&site.ground);
    let planes: Vec<Plane> = site.lines.iter().filter(|l| l.closed).map(|l| Plane::of_ring(&l.points)).collect();
    // Height of the design less that of the ground, and what makes it.
    let look = |i: usize| {
        let [x, y] = at(i);
        let Some(ground) = cells.height(&site.ground, x, y, 1e-9) else { return (0.0, State::Nothing) };
        let inside: Vec<usize> =
            site.lines.iter().filter(|l| l.closed).enumerate().filter(|(_, l)| contains(l, x, y)).map(|(i, _)| i).collect();
        if inside.len() % 2 == 1 {
            return (planes[inside[0]].height(x, y) - ground, State::Platform);
        }
        let cut = height(&site.lines, site.cut_slope, true, x, y) - ground;
        let fill = height(&site.lines, site.fill_slope, false, x, y) - ground;
        match (cut < 0.0, fill > 0.0) {
            (true, _) => (cut, State::Cut),
            (false, true) => (fill, State::Fill),
            (false, false) => (0.0, State::Nothing),
        }
    };
    let field: Vec<(f64, State)> = (0..n * n).map(look).collect();
    let connected = flood(&field, &seeds(site, [lo, hi], n, &field), n);
    let mut sums = Figures::default();
    let size = cell[0] * cell[1];
    for (&(height, state), connected) in field.iter().zip(connected) {
        if state == State::Platform || connected {
            sums.fill += size * height.max(0.0);
            sums.cut += size * (-height).max(0.0);
            sums.fill_area += if height > 0.0 { size } else { 0.0 };
            sums.cut_area += if height < 0.0 { size } else { 0.0 };
        }
    }
    sums
}

/// Cells beside the platform or within a cell of a line.
fn seeds(site: &Site, [lo, hi]: Box2, n: usize, field: &[(f64, State)]) -> Vec<usize> {
    let mut seeds: Vec<usize> = (0..n * n).filter(|&i| field[i].1 == State::Platform).flat_map(|i| neighbours(i, n)).collect();
    for (a, b) in site.lines.iter().flat_map(Polyline::segments) {
        let steps = (4.0 * n as f64 * ((b[0] - a[0]) / (hi[0] - lo[0])).hypot((b[1] - a[1]) / (hi[1] - lo[1]))) as usize + 1;
        for s in 0..=steps {
            let w = s as f64 / steps as f64;
            let [i, j] = [0, 1].map(|c| {
                let at = ((a[c] + w * (b[c] - a[c]) - lo[c]) / (hi[c] - lo[c]) * n as f64).max(0.0);
                (at as usize).min(n - 1)
            });
            seeds.push(j * n + i);
            seeds.extend(neighbours(j * n + i, n));
        }
    }
    seeds
}

/// The cells that share a side with cell `i`.
fn neighbours(i: usize, n: usize) -> impl Iterator<Item = usize> {
    let (x, y) = (i % n, i / n);
    let sides = [(x > 0, i.wrapping_sub(1)), (x + 1 < n, i + 1), (y > 0, i.wrapping_sub(n)), (y + 1 < n, i + n)];
    sides.into_iter().filter(|(there, _)| *there).map(|(_, i)| i)
}

/// Cells of cut and of fill that are joined to a seed by cells of their own kind.
fn flood(field: &[(f64, State)], seeds: &[usize], n: usize) -> Vec<bool> {
    let earth = |i: usize| matches!(field[i].1, State::Cut | State::Fill);
    let mut seen = vec![false; field.len()];
    let mut open: Vec<usize> = seeds.iter().copied().filter(|&i| earth(i)).collect();
    while let Some(i) = open.pop() {
        if !seen[i] {
            seen[i] = true;
            open.extend(neighbours(i, n).filter(|&j| field[j].1 == field[i].1 && !seen[j]));
        }
    }
    seen
}

/// Whether a point lies inside a ring: a ray to the right crosses it an odd number of times.
fn contains(ring: &Polyline, x: f64, y: f64) -> bool {
    let crossed =
        |(a, b): &([f64; 3], [f64; 3])| (a[1] > y) != (b[1] > y) && x < a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    ring.segments().filter(crossed).count() % 2 == 1
}

/// The plane through a ring, which must be planar.
pub(crate) struct Plane {
    origin: [f64; 3],
    gradient: [f64; 2],
}

impl Plane {
    /// Its normal by Newell's sums of products of neighbours, about the first vertex.
    pub(crate) fn of_ring(points: &[[f64; 3]]) -> Self {
        let origin = points[0];
        let local: Vec<[f64; 3]> = points.iter().map(|p| std::array::from_fn(|i| p[i] - origin[i])).collect();
        let mut normal = [0.0; 3];
        for (i, p) in local.iter().enumerate() {
            let q = local[(i + 1) % local.len()];
            for (c, value) in normal.iter_mut().enumerate() {
                let (d, e) = ((c + 1) % 3, (c + 2) % 3);
                *value += p[d] * q[e] - p[e] * q[d];
            }
        }
        let plane = Self { origin, gradient: [-normal[0] / normal[2], -normal[1] / normal[2]] };
        // To the millimetre, as rings of surveyors are.
        assert!(points.iter().all(|p| (plane.height(p[0], p[1]) - p[2]).abs() < 2e-3), "the ring is not planar");
        plane
    }

    pub(crate) fn height(&self, x: f64, y: f64) -> f64 {
        self.origin[2] + self.gradient[0] * (x - self.origin[0]) + self.gradient[1] * (y - self.origin[1])
    }
}
