//! Small polygons to triangles: ear by ear, with exact signs.

use super::region::{self, RegionError};
use crate::kernel::orientation::{Turn, turn};
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// Polygons with more corners are triangulated with spade, which is slow where most of them lie on one line. So stretches of more
/// than this many edges that are straight are triangulated as one, and the triangle there is fanned out.
const MOST_CORNERS: usize = 24;

/// Vertices no further (length units) from the edge between two others than this, which is more than rounding of places far from the
/// origin, may be taken to lie on it.
const STRAIGHT: f64 = 1e-8;

/// Triangulates the region on the left of directed closed `edges` between vertices of `points`; edges that run against each
/// other cancel. `keep` tells corners from mere places on a straight edge, which are left out.
///
/// # Errors
/// [`RegionError`] if the edges do not bound a region.
pub fn fill(points: &[DVec3], edges: &[[u32; 2]], keep: impl Fn(u32) -> bool) -> Result<Vec<[u32; 3]>, RegionError> {
    let mut loops = Vec::new();
    let (rings, open) = self::loops(edges);
    if let Some(&v) = open.first() {
        return Err(RegionError::Open(points.get(v as usize).copied().unwrap_or(DVec3::NAN)));
    }
    for mut ring in rings {
        ring.retain(|&v| keep(v));
        ring.dedup();
        while ring.len() > 1 && ring[0] == ring[ring.len() - 1] {
            ring.pop();
        }
        if ring.len() > 2 {
            loops.push(ring);
        }
    }
    if let [ring] = &loops[..]
        && let Some(triangles) = ears(points, ring)
    {
        return Ok(triangles);
    }
    let mut outline: Vec<[u32; 2]> =
        loops.iter().flat_map(|ring| (0..ring.len()).map(move |i| [ring[i], ring[(i + 1) % ring.len()]])).collect();
    let given = outline.len();
    cancel(&mut outline);
    if outline.is_empty() {
        return Ok(Vec::new());
    }
    if outline.len() == given && given > MOST_CORNERS {
        let plan = |v: u32| points[v as usize].truncate();
        let stretches: Vec<Vec<u32>> = loops.iter().flat_map(|ring| stretches(points, ring)).collect();
        // What is straight but for rounding may not be good for a fan, or have another part of the outline that close.
        if stretches.len() < given
            && let Ok(triangles) = region::fill(points, &stretches)
            && triangles.iter().all(|&[a, b, c]| turn(plan(a), plan(b), plan(c)) == Turn::Left)
        {
            return Ok(triangles);
        }
    }
    region::fill(points, &outline.into_iter().map(|e| e.to_vec()).collect::<Vec<_>>())
}

/// A ring as edges, and straight stretches of more than [`MOST_CORNERS`] of them as one, with all its vertices from end to end.
fn stretches(points: &[DVec3], ring: &[u32]) -> Vec<Vec<u32>> {
    let plan = |v: u32| points[v as usize].truncate();
    let before = |p: DVec2, q: DVec2| p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y));
    // Always a corner.
    let first = (0..ring.len()).min_by(|&i, &j| before(plan(ring[i]), plan(ring[j]))).unwrap_or(0);
    let mut all = Vec::new();
    let mut stretch: Vec<u32> = Vec::new();
    let mut aim = Aim::new(DVec2::ZERO, DVec2::ZERO);
    for n in 0..=ring.len() {
        let v = ring[(first + n) % ring.len()];
        match stretch[..] {
            [] => {}
            [start] => aim = Aim::new(plan(start), plan(v)),
            _ if aim.take(plan(v)) => {}
            [.., last] => {
                end(&mut stretch, &mut all);
                stretch.push(last);
                aim = Aim::new(plan(last), plan(v));
            }
        }
        stretch.push(v);
    }
    end(&mut stretch, &mut all);
    all
}

/// Takes down a stretch: as one if that is worth while, else edge by edge.
fn end(stretch: &mut Vec<u32>, all: &mut Vec<Vec<u32>>) {
    let stretch = std::mem::take(stretch);
    if stretch.len() > MOST_CORNERS + 1 {
        all.push(stretch);
    } else {
        all.extend(stretch.windows(2).map(<[u32]>::to_vec));
    }
}

/// Straight lines from one point that pass all points taken so far, in order and no further off than [`STRAIGHT`].
struct Aim {
    from: DVec2,
    along: DVec2,
    /// How far the last point is away.
    reached: f64,
    /// Sidewards per length: from, to.
    range: [f64; 2],
}

impl Aim {
    fn new(from: DVec2, to: DVec2) -> Self {
        let reached = from.distance(to);
        let off = STRAIGHT / reached;
        Self { from, along: (to - from) / reached, reached, range: [-off, off] }
    }

    /// Takes a point if one of the lines ends in it.
    fn take(&mut self, p: DVec2) -> bool {
        let (away, aside) = (self.along.dot(p - self.from), self.along.perp_dot(p - self.from));
        let [low, high] = self.range;
        let fits = away > self.reached && aside >= low * away && aside <= high * away;
        if fits {
            self.reached = away;
            self.range = [low.max((aside - STRAIGHT) / away), high.min((aside + STRAIGHT) / away)];
        }
        fits
    }
}

/// Drops edges without length, and pairs that run against each other.
fn cancel(edges: &mut Vec<[u32; 2]>) {
    let mut count: FxHashMap<[u32; 2], i32> = FxHashMap::default();
    for &[a, b] in edges.iter() {
        *count.entry([a.min(b), a.max(b)]).or_insert(0) += if a < b { 1 } else { -1 };
    }
    edges.retain(|&[a, b]| {
        let left = count.get_mut(&[a.min(b), a.max(b)]);
        let direction = if a < b { 1 } else { -1 };
        match left {
            Some(left) if a != b && *left * direction > 0 => {
                *left -= direction;
                true
            }
            _ => false,
        }
    });
}

/// Simple loops of directed edges, and the vertices where paths end that do not close. Edges that run against each other cancel.
pub fn loops(edges: &[[u32; 2]]) -> (Vec<Vec<u32>>, Vec<u32>) {
    let mut edges = edges.to_vec();
    cancel(&mut edges);
    let mut used = vec![false; edges.len()];
    let mut order: Vec<usize> = (0..edges.len()).collect();
    order.sort_by_key(|&i| edges[i]);
    let (mut loops, mut open) = (Vec::new(), Vec::new());
    let mut place: FxHashMap<u32, usize> = FxHashMap::default();
    for first in 0..edges.len() {
        if used[first] {
            continue;
        }
        used[first] = true;
        place.clear();
        place.insert(edges[first][0], 0);
        let mut ring = vec![edges[first][0]];
        let mut at = edges[first][1];
        let closed = loop {
            if at == edges[first][0] {
                break true;
            }
            // A loop that comes back to a vertex of its own is cut off there, so that every loop is simple.
            if let Some(&n) = place.get(&at) {
                let cut_off = ring.split_off(n);
                for v in &cut_off {
                    place.remove(v);
                }
                loops.push(cut_off);
            }
            place.insert(at, ring.len());
            ring.push(at);
            let from = order.partition_point(|&i| edges[i][0] < at);
            let next = order[from..].iter().copied().take_while(|&i| edges[i][0] == at).find(|&i| !used[i]);
            let Some(next) = next else { break false };
            used[next] = true;
            at = edges[next][1];
        };
        if closed {
            loops.push(ring);
        } else {
            open.push(at);
        }
    }
    (loops, open)
}

/// Cuts ears off a simple polygon, the best shaped first; `None` if it has too many corners or no ear is left to cut.
fn ears(points: &[DVec3], ring: &[u32]) -> Option<Vec<[u32; 3]>> {
    if ring.len() > MOST_CORNERS {
        return None;
    }
    let plan = |v: u32| points[v as usize].truncate();
    let mut ring = ring.to_vec();
    let mut triangles = Vec::with_capacity(ring.len() - 2);
    while ring.len() > 3 {
        let count = ring.len();
        let mut best: Option<(f64, usize)> = None;
        for i in 0..count {
            let t = [ring[(i + count - 1) % count], ring[i], ring[(i + 1) % count]];
            let p = t.map(plan);
            let shape = quality(p);
            if best.is_some_and(|(q, _)| q >= shape) || turn(p[0], p[1], p[2]) != Turn::Left {
                continue;
            }
            let blocked = ring.iter().any(|&v| !t.contains(&v) && covers(p, plan(v)));
            if !blocked {
                best = Some((shape, i));
            }
        }
        let (_, i) = best?;
        triangles.push([ring[(i + count - 1) % count], ring[i], ring[(i + 1) % count]]);
        ring.remove(i);
    }
    let p = [ring[0], ring[1], ring[2]];
    let [a, b, c] = p.map(plan);
    if turn(a, b, c) != Turn::Left {
        return None;
    }
    triangles.push(p);
    Some(triangles)
}

/// Whether a counter-clockwise triangle has a point in it or on it.
fn covers(p: [DVec2; 3], v: DVec2) -> bool {
    (0..3).all(|i| turn(p[i], p[(i + 1) % 3], v) != Turn::Right)
}

/// Height of a triangle over its longest side, relative to that side.
fn quality([a, b, c]: [DVec2; 3]) -> f64 {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a));
    (b - a).perp_dot(c - a) / longest
}

#[cfg(test)]
mod tests {
    use super::*;

    fn points(list: &[(f64, f64)]) -> Vec<DVec3> {
        list.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
    }

    fn area(points: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
        let plan = |v: u32| points[v as usize].truncate();
        triangles.iter().map(|t| 0.5 * (plan(t[1]) - plan(t[0])).perp_dot(plan(t[2]) - plan(t[0]))).sum()
    }

    /// An L with a place on one of its sides that is no corner, and one that is.
    #[test]
    fn an_l_shape() {
        let p = points(&[(0.0, 0.0), (2.0, 0.0), (4.0, 0.0), (4.0, 1.0), (1.0, 1.0), (1.0, 3.0), (0.0, 3.0), (0.0, 2.0)]);
        let edges: Vec<[u32; 2]> = (0..8).map(|i| [i, (i + 1) % 8]).collect();
        let triangles = fill(&p, &edges, |v| v != 7).unwrap();
        assert_eq!((triangles.len(), area(&p, &triangles)), (5, 6.0));
        assert!(triangles.as_flattened().contains(&1) && !triangles.as_flattened().contains(&7));
    }

    /// Thousands of vertices on two sides of a rectangle, straight but for rounding: each of them an edge of one triangle.
    #[test]
    fn many_vertices_on_a_straight_line() {
        let n = 20_000_u32;
        let at = |x: f64, y: f64| {
            let (sin, cos) = 0.3_f64.sin_cos();
            DVec3::new(640_000.0 + cos * x - sin * y, 5_200_000.0 + sin * x + cos * y, 0.0)
        };
        let mut p: Vec<DVec3> = (0..=n).map(|i| at(f64::from(i), 0.0)).collect();
        p.extend((0..=n).rev().map(|i| at(f64::from(i), 2.0)));
        let count = p.len() as u32;
        let edges: Vec<[u32; 2]> = (0..count).map(|i| [i, (i + 1) % count]).collect();
        let began = std::time::Instant::now();
        let triangles = fill(&p, &edges, |_| true).unwrap();
        assert_eq!(triangles.len() as u32, count - 2);
        assert!((area(&p, &triangles) - 2.0 * f64::from(n)).abs() < 1e-3 * f64::from(n));
        // A hundredth of a second, or many seconds where each vertex looks at all others.
        assert!(began.elapsed().as_secs_f64() < 5.0, "{:?}", began.elapsed());
        // Bent outwards and inwards in every vertex, it is no straight line; a wave of 1 in 100 is none either.
        for bend in [1e-6, -1e-6] {
            let bow = |i: u32| at(f64::from(i), bend * f64::from(i * (40 - i)));
            let mut p: Vec<DVec3> = (0..=40).map(bow).collect();
            p.extend([at(40.0, 2.0), at(0.0, 2.0)]);
            let edges: Vec<[u32; 2]> = (0..43).map(|i| [i, (i + 1) % 43]).collect();
            assert_eq!(stretches(&p, &(0..43).collect::<Vec<_>>()).len(), 43);
            assert_eq!(fill(&p, &edges, |_| true).unwrap().len(), 41);
        }
    }

    /// A square with a square hole, an edge there and back between them, and a loop that touches itself in a corner.
    #[test]
    fn holes_spikes_and_touching_corners() {
        let p = points(&[(0.0, 0.0), (9.0, 0.0), (9.0, 9.0), (0.0, 9.0), (3.0, 3.0), (6.0, 3.0), (6.0, 6.0), (3.0, 6.0)]);
        let mut edges = vec![[0, 1], [1, 2], [2, 3], [3, 0], [4, 7], [7, 6], [6, 5], [5, 4], [0, 4], [4, 0]];
        assert_eq!(area(&p, &fill(&p, &edges, |_| true).unwrap()), 72.0);
        edges.truncate(4);
        let p = points(&[(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (1.0, 1.0), (0.0, 2.0)]);
        let bow = [[0, 1], [1, 3], [3, 2], [2, 3], [3, 4], [4, 0]];
        assert_eq!(area(&p, &fill(&p, &bow, |_| true).unwrap()), 2.0);
        assert!(fill(&p, &[[0, 1], [1, 2]], |_| true).is_err());
    }
}
