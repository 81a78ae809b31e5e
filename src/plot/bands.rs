//! Exact bands: where a function that is linear on convex pieces lies above each of some levels.
//!
//! Every piece is cut at the levels, and the edges that neighbours share cancel out, so that what is left are the outlines of
//! the bands. Corners are put on a lattice first: neighbours share them up to rounding. The lattice alone moves lines, by half a
//! step at most.

use super::lines::Stroke;
use crate::kernel::range::range;
use glam::DVec2;

/// A corner on the lattice.
type Place = (i32, i32);

/// A corner of a piece, in px, and the value there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Point {
    pub(super) at: DVec2,
    pub(super) value: f64,
}

/// Gathers the edges of what lies above some levels.
#[derive(Debug)]
pub(super) struct Bands {
    /// Ascending.
    levels: Vec<f64>,
    /// Steps of the lattice in 1 px.
    steps: f64,
    /// Of each band, edges from the lesser end to the greater, and how often they are run forwards.
    edges: Vec<Vec<(Place, Place, i32)>>,
    rest: Vec<Point>,
    above: Vec<Point>,
    below: Vec<Point>,
}

/// How far the lattice goes, in steps.
const FARTHEST: f64 = 2e9;

impl Bands {
    /// For some ascending levels; the lowest band begins at the first.
    pub(super) fn new(levels: Vec<f64>, steps: f64) -> Self {
        let edges = vec![Vec::new(); levels.len()];
        Self { levels, steps, edges, rest: Vec::new(), above: Vec::new(), below: Vec::new() }
    }

    /// Adds a convex piece. What lies above a level belongs to the band that begins there.
    pub(super) fn add(&mut self, corners: &[Point]) {
        self.rest.clear();
        self.rest.extend_from_slice(corners);
        let (low, high) = range(corners.iter().map(|corner| corner.value));
        // From the highest band down.
        let top = self.levels.partition_point(|level| *level < high);
        for band in (0..top).rev() {
            let level = self.levels[band];
            if low >= level {
                put(&self.rest, self.steps, &mut self.edges[band]);
                return;
            }
            split(&self.rest, level, &mut self.above, &mut self.below);
            put(&self.above, self.steps, &mut self.edges[band]);
            std::mem::swap(&mut self.rest, &mut self.below);
        }
    }

    /// Outlines of all that lies above each level, holes included, counter-clockwise about what they hold where `y` goes up.
    pub(super) fn outlines(mut self) -> Vec<Vec<Stroke>> {
        let mut all: Vec<(Place, Place, i32)> = Vec::new();
        let mut found = Vec::with_capacity(self.levels.len());
        while let Some(band) = self.edges.pop() {
            all.extend(band);
            cancel(&mut all);
            found.push(chained(&all, self.steps));
        }
        found.reverse();
        found
    }
}

/// Cuts a convex polygon at a level. Corners between are found from the upper end of their edge, so that both neighbours find
/// the same.
fn split(corners: &[Point], level: f64, above: &mut Vec<Point>, below: &mut Vec<Point>) {
    above.clear();
    below.clear();
    for (i, here) in corners.iter().enumerate() {
        let next = corners[(i + 1) % corners.len()];
        if here.value >= level {
            above.push(*here);
        }
        if here.value <= level {
            below.push(*here);
        }
        if (here.value - level) * (next.value - level) < 0.0 {
            let (up, down) = if here.value > next.value { (*here, next) } else { (next, *here) };
            let at = up.at.lerp(down.at, (up.value - level) / (up.value - down.value));
            above.push(Point { at, value: level });
            below.push(Point { at, value: level });
        }
    }
}

fn place(p: DVec2, steps: f64) -> Place {
    let one = |v: f64| (v * steps).round().clamp(-FARTHEST, FARTHEST) as i32;
    (one(p.x), one(p.y))
}

fn put(corners: &[Point], steps: f64, edges: &mut Vec<(Place, Place, i32)>) {
    for (i, here) in corners.iter().enumerate() {
        let (a, b) = (place(here.at, steps), place(corners[(i + 1) % corners.len()].at, steps));
        if a != b {
            edges.push(if a < b { (a, b, 1) } else { (b, a, -1) });
        }
    }
}

/// Sums up edges of the same ends, and drops those run as often one way as the other.
fn cancel(edges: &mut Vec<(Place, Place, i32)>) {
    edges.sort_unstable_by_key(|edge| (edge.0, edge.1));
    edges.dedup_by(|next, kept| {
        let same = (next.0, next.1) == (kept.0, kept.1);
        if same {
            kept.2 += next.2;
        }
        same
    });
    edges.retain(|edge| edge.2 != 0);
}

/// Outlines along the edges. Each place is left as often as it is reached, because outlines of pieces are closed.
fn chained(edges: &[(Place, Place, i32)], steps: f64) -> Vec<Stroke> {
    let directed = |&(a, b, times): &(Place, Place, i32)| {
        let edge = if times > 0 { (a, b) } else { (b, a) };
        std::iter::repeat_n(edge, times.unsigned_abs() as usize)
    };
    let mut edges: Vec<(Place, Place)> = edges.iter().flat_map(directed).collect();
    edges.sort_unstable();
    let mut used = vec![false; edges.len()];
    let mut strokes = Vec::new();
    for first in 0..edges.len() {
        if used[first] {
            continue;
        }
        let begin = edges[first].0;
        let (mut at, mut points) = (first, Vec::new());
        loop {
            used[at] = true;
            points.push(DVec2::new(f64::from(edges[at].0.0), f64::from(edges[at].0.1)) / steps);
            let end = edges[at].1;
            if end == begin {
                break;
            }
            let from = edges.partition_point(|edge| edge.0 < end);
            let next = (from..edges.len()).take_while(|i| edges[*i].0 == end).find(|i| !used[*i]);
            let Some(next) = next else { break };
            at = next;
        }
        strokes.push(Stroke { points, closed: true });
    }
    strokes
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(strokes: &[Stroke]) -> f64 {
        let one =
            |s: &Stroke| (0..s.points.len()).map(|i| 0.5 * s.points[i].perp_dot(s.points[(i + 1) % s.points.len()])).sum::<f64>();
        strokes.iter().map(one).sum()
    }

    /// A pyramid of height 4 over a square of side 8 in triangles of a grid: what lies above `z` is a square of side 8 − 2z.
    #[test]
    fn bands_of_a_pyramid() {
        let value = |p: DVec2| 4.0 - (p - DVec2::splat(4.0)).abs().max_element();
        let mut bands = Bands::new(vec![0.0, 0.7, 1.5, 3.9, 5.0], 1000.0);
        for i in 0..8 {
            for j in 0..8 {
                let corner = |x: i32, y: i32| {
                    let at = DVec2::new(f64::from(i + x), f64::from(j + y));
                    Point { at, value: value(at) }
                };
                // Diagonals through the middle, so that the pyramid is linear on each triangle.
                let quad = [corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)];
                let k = usize::from((i < 4) != (j < 4));
                bands.add(&[quad[k], quad[k + 1], quad[k + 2]]);
                bands.add(&[quad[k], quad[k + 2], quad[(k + 3) % 4]]);
            }
        }
        let outlines = bands.outlines();
        for (strokes, level) in outlines.iter().zip([0.0, 0.7, 1.5, 3.9]) {
            assert_eq!(strokes.len(), 1, "{level}");
            let side = 8.0 - 2.0 * level;
            assert!((area(strokes) - side * side).abs() < 0.02, "{level}: {}", area(strokes));
        }
        assert!(outlines[4].is_empty());
    }
}
