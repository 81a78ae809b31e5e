//! Strips: the region between two lines that run beside each other, triangulated from one to the other.

use crate::kernel::orientation::{Turn, turn};
use glam::{DVec2, DVec3};

/// A vertex of a side of a strip: its number, and how far along the strip it stands.
pub type Beside = (u32, f64);

/// Lower triangles (length units) count as degenerate: their corners lie on one line but for rounding.
const LEAST_HEIGHT: f64 = 1e-8;

/// Triangulates the region between `right` and `left`, two sides that run in the same direction from a common first vertex to a
/// common last one, by going up both at the same pace; where stations tie, by the shorter diagonal.
///
/// `None` where a triangle would turn over or be degenerate both ways: the sides do not run beside each other then. All triangles
/// are counter-clockwise, and their outer edges are the two sides; so where the two sides together form a simple polygon they
/// cover it exactly once. Linear in the number of vertices.
pub fn between(points: &[DVec3], right: &[Beside], left: &[Beside]) -> Option<Vec<[u32; 3]>> {
    let (m, n) = (right.len().checked_sub(1)?, left.len().checked_sub(1)?);
    if m < 2 || n < 2 || right[0].0 != left[0].0 || right[m].0 != left[n].0 {
        return None;
    }
    let plan = |v: u32| -> DVec2 { points[v as usize].truncate() };
    let sound = |t: &[u32; 3]| {
        let [a, b, c] = t.map(plan);
        let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
        turn(a, b, c) == Turn::Left && (b - a).perp_dot(c - a) > LEAST_HEIGHT * longest
    };
    let mut triangles = Vec::with_capacity(m + n - 2);
    // The common vertices have one triangle each: the other vertices at the ends may lie on one line with them.
    triangles.push([right[0].0, right[1].0, left[1].0]);
    let (mut i, mut j) = (1, 1);
    while (i, j) != (m - 1, n - 1) {
        let (a, b) = (right[i].0, left[j].0);
        let along_right = (i + 1 < m).then(|| [a, right[i + 1].0, b]).filter(sound);
        let along_left = (j + 1 < n).then(|| [a, left[j + 1].0, b]).filter(sound);
        let on_right = match (along_right, along_left) {
            (Some(_), Some(_)) => {
                // Half way along the step: so both sides share the vertices of the other at a bend that cuts one of them off.
                let (s, t) = (right[i].1 + right[i + 1].1, left[j].1 + left[j + 1].1);
                let diagonals =
                    || plan(right[i + 1].0).distance_squared(plan(b)) <= plan(left[j + 1].0).distance_squared(plan(a));
                s < t || (s == t && diagonals())
            }
            (Some(_), None) => true,
            (None, Some(_)) => false,
            (None, None) => return None,
        };
        if on_right {
            triangles.extend(along_right);
            i += 1;
        } else {
            triangles.extend(along_left);
            j += 1;
        }
    }
    triangles.push([right[m - 1].0, right[m].0, left[n - 1].0]);
    let ends_sound = [triangles.first(), triangles.last()].into_iter().flatten().all(sound);
    ends_sound.then_some(triangles)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(points: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
        let of = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| points[v as usize].truncate());
            0.5 * (b - a).perp_dot(c - a)
        };
        assert!(triangles.iter().all(|t| of(t) > 0.0), "{triangles:?}");
        triangles.iter().map(of).sum()
    }

    fn points(plan: &[(f64, f64)]) -> Vec<DVec3> {
        plan.iter().map(|&(x, y)| DVec3::new(x, y, 0.0)).collect()
    }

    #[test]
    fn a_rectangle_with_vertices_on_all_sides() {
        // Along y = 0 from (0, 0) to (8, 0); around by (0, 2) and (8, 2), with a vertex on each end.
        let p = points(&[(0., 0.), (3., 0.), (8., 0.), (0., 1.), (0., 2.), (1., 2.), (7., 2.), (8., 2.), (8., 1.)]);
        let right = [(0, 0.0), (1, 3.0), (2, 8.0)];
        let left = [(0, 0.0), (3, 0.0), (4, 0.0), (5, 1.0), (6, 7.0), (7, 8.0), (8, 8.0), (2, 8.0)];
        let triangles = between(&p, &right, &left).unwrap();
        assert_eq!(triangles.len(), 7);
        assert_eq!(area(&p, &triangles), 16.0);
    }

    #[test]
    fn a_side_cut_off_in_a_bend() {
        // Half a turn of radius 1 about (0, 0); its inside ends at (−0.1, 0) between two legs.
        let mut plan = vec![(-5.0, -1.0)];
        plan.extend((0..=16).map(|i| (std::f64::consts::PI * (f64::from(i) / 16.0 - 0.5)).sin_cos()).map(|(s, c)| (c, s)));
        plan.extend([(-5.0, 1.0), (-5.0, -0.2), (-0.1, 0.0), (-5.0, 0.2)]);
        let p = points(&plan);
        let right: Vec<Beside> = (0..19).map(|i| (i, f64::from(i))).collect();
        let left = [(0, 0.0), (19, 0.0), (20, 9.0), (21, 18.0), (18, 18.0)];
        let triangles = between(&p, &right, &left).unwrap();
        let polygon: Vec<DVec2> = (0..19).chain([21, 20, 19]).map(|v: usize| p[v].truncate()).collect();
        let twice: f64 = (0..polygon.len()).map(|i| polygon[i].perp_dot(polygon[(i + 1) % polygon.len()])).sum();
        assert!((area(&p, &triangles) - 0.5 * twice).abs() < 1e-12);
    }

    #[test]
    fn refuses_what_is_no_strip() {
        // The left side lies on the right.
        let p = points(&[(0., 0.), (4., 0.), (2., -1.)]);
        let p = [p, points(&[(2., 0.), (2., 1.), (0., 5.)])].concat();
        assert_eq!(between(&p, &[(0, 0.0), (3, 2.0), (1, 4.0)], &[(0, 0.0), (2, 2.0), (1, 4.0)]), None);
        assert!(between(&p, &[(0, 0.0), (3, 2.0), (1, 4.0)], &[(0, 0.0), (4, 2.0), (1, 4.0)]).is_some());
        // No common end.
        assert_eq!(between(&p, &[(0, 0.0), (3, 2.0), (1, 4.0)], &[(0, 0.0), (4, 2.0), (5, 4.0)]), None);
        assert_eq!(between(&p, &[(0, 0.0), (1, 4.0)], &[(0, 0.0), (1, 4.0)]), None);
        assert_eq!(between(&p, &[(0, 0.0)], &[]), None);
    }
}
