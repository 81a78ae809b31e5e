//! Which rings lie around a point.

use super::orientation::{Turn, turn};
use super::segment_tree::SegmentTree;
use glam::DVec2;
use std::collections::BTreeSet;

/// The sides of rings in a tree, each with the number of its ring.
#[derive(Debug)]
pub struct RingIndex {
    sides: Vec<(usize, DVec2, DVec2)>,
    tree: SegmentTree,
}

impl RingIndex {
    /// An index over all sides of rings: number of the ring, and both ends. Sides of one ring stand together.
    pub fn new(sides: Vec<(usize, DVec2, DVec2)>) -> Self {
        let ends: Vec<_> = sides.iter().map(|&(_, a, b)| (a, b)).collect();
        Self { sides, tree: SegmentTree::new(&ends) }
    }

    /// The tree over the sides, in the order given.
    pub fn tree(&self) -> &SegmentTree {
        &self.tree
    }

    /// The rings around `p`, in ascending order: those of which an odd number of sides crosses the ray towards +x. Exact. A
    /// ring that `p` lies on may be among them or not.
    pub fn around(&self, p: DVec2) -> BTreeSet<usize> {
        let mut odd = BTreeSet::new();
        self.tree.ray(p, |i| {
            let (ring, a, b) = self.sides[i];
            let crosses = (a.y > p.y) != (b.y > p.y) && (turn(a, b, p) == Turn::Left) == (b.y > a.y);
            if crosses && !odd.remove(&ring) {
                odd.insert(ring);
            }
        });
        odd
    }
}

/// Twice the area inside of a ring, positive when counter-clockwise; summed about its first vertex.
pub fn doubled_area(vertices: impl ExactSizeIterator<Item = DVec2> + Clone) -> f64 {
    let Some(origin) = vertices.clone().next() else { return 0.0 };
    let next = vertices.clone().skip(1);
    vertices.zip(next).map(|(a, b)| (a - origin).perp_dot(b - origin)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The sides of a ring.
    fn sides(ring: usize, points: &[DVec2]) -> Vec<(usize, DVec2, DVec2)> {
        (0..points.len()).map(|i| (ring, points[i], points[(i + 1) % points.len()])).collect()
    }

    #[test]
    fn rays_through_vertices_count_once() {
        let diamond = |r: f64| [(0.0, -r), (r, 0.0), (0.0, r), (-r, 0.0)].map(DVec2::from);
        let index = RingIndex::new([sides(0, &diamond(4.0)), sides(1, &diamond(2.0)), sides(2, &diamond(1.0))].concat());
        let around = |x: f64, y: f64| index.around(DVec2::new(x, y)).into_iter().collect::<Vec<_>>();
        assert_eq!((around(0.0, 0.0), around(-1.5, 0.0), around(-3.0, 0.0)), (vec![0, 1, 2], vec![0, 1], vec![0]));
        assert_eq!(
            (around(-5.0, 0.0), around(5.0, 0.0), around(-2.0, 4.0), around(-0.5, 1.0)),
            (vec![], vec![], vec![], vec![0, 1])
        );
        let square = [(1.0, 1.0), (4.0, 1.0), (4.0, 3.0), (1.0, 3.0)].map(DVec2::from);
        assert_eq!(doubled_area(square.iter().copied()), 12.0);
        assert_eq!(doubled_area(square.iter().rev().copied()), -12.0);
    }

    proptest! {
        /// The angle under which a ring is seen from inside is a whole turn: its winding number, odd for those around.
        #[test]
        fn agrees_with_the_angles_seen(
            rings in prop::collection::vec(prop::collection::vec((-9.0..9.0_f64, -9.0..9.0_f64), 3..12), 1..6),
            p in (-9.0..9.0_f64, -9.0..9.0_f64),
        ) {
            let rings: Vec<Vec<DVec2>> = rings.into_iter().map(|ring| ring.into_iter().map(DVec2::from).collect()).collect();
            let p = DVec2::from(p);
            let index = RingIndex::new((0..).zip(&rings).flat_map(|(i, ring)| sides(i, ring)).collect());
            let turns = |ring: &[DVec2]| {
                let angle = sides(0, ring).iter().map(|&(_, a, b)| (a - p).angle_to(b - p)).sum::<f64>();
                (angle / std::f64::consts::TAU).round() as i64
            };
            let expected = (0..).zip(&rings).filter(|(_, ring)| turns(ring) % 2 != 0).map(|(i, _)| i).collect();
            prop_assert_eq!(index.around(p), expected);
        }
    }
}
