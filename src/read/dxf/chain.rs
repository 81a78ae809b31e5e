//! Single LINEs that meet end to end → polylines.

use super::layers::LayerId;
use super::pairs::Place;
use glam::DVec3;
use rustc_hash::FxHashMap;

/// A LINE in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Segment {
    pub(super) ends: [DVec3; 2],
    pub(super) layer: LayerId,
    pub(super) place: Place,
    /// Number in the order of the drawing.
    pub(super) order: usize,
}

/// LINEs joined to one; the first vertex is repeated if it is a ring.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Chain {
    pub(super) vertices: Vec<(DVec3, Place)>,
    pub(super) layer: LayerId,
    /// That of its first LINE.
    pub(super) order: usize,
}

/// A layer and a place on it.
type Node = (LayerId, [u64; 3]);

fn node(segment: &Segment, end: usize) -> Node {
    // Zero has two signs.
    (segment.layer, (segment.ends[end] + 0.0).to_array().map(f64::to_bits))
}

/// Joins LINEs of one layer where the ends of just two have the same coordinates: what is left of an exploded polyline has them
/// to the last digit. Where three and more meet they stay apart. Each chain runs as the first of its LINEs is drawn. Those
/// without length and those drawn before, in either direction, are left out: the second result is how many.
pub(super) fn join(mut segments: Vec<Segment>) -> (Vec<Chain>, usize) {
    let given = segments.len();
    let mut drawn = rustc_hash::FxHashSet::default();
    segments.retain(|segment| {
        let (a, b) = (node(segment, 0), node(segment, 1));
        a != b && drawn.insert((a.min(b), a.max(b)))
    });
    drop(drawn);
    // Two ends for each node that has just two, else none.
    let mut at: FxHashMap<Node, (usize, [(usize, usize); 2])> = FxHashMap::default();
    for (i, segment) in segments.iter().enumerate() {
        for end in 0..2 {
            let (count, ends) = at.entry(node(segment, end)).or_insert((0, [(0, 0); 2]));
            if let Some(slot) = ends.get_mut(*count) {
                *slot = (i, end);
            }
            *count += 1;
        }
    }
    // The other LINE at an end, and which of its ends that is.
    let next = |(i, end): (usize, usize)| match at.get(&node(&segments[i], end)) {
        Some(&(2, [a, b])) => Some(if a == (i, end) { b } else { a }),
        _ => None,
    };
    let mut used = vec![false; segments.len()];
    let mut chains = Vec::new();
    for first in 0..segments.len() {
        if std::mem::replace(&mut used[first], true) {
            continue;
        }
        // Forwards from its end, then backwards from its beginning.
        let mut walk = |from: usize| {
            let mut vertices = Vec::new();
            let mut end = (first, from);
            while let Some((other, near)) = next(end).filter(|&(other, _)| !used[other]) {
                used[other] = true;
                end = (other, 1 - near);
                vertices.push((segments[other].ends[1 - near], segments[other].place));
            }
            vertices
        };
        let after = walk(1);
        let before = walk(0);
        let segment = segments[first];
        let own = segment.ends.map(|at| (at, segment.place));
        let vertices = before.into_iter().rev().chain(own).chain(after).collect();
        chains.push(Chain { vertices, layer: segment.layer, order: segment.order });
    }
    (chains, given - segments.len())
}

#[cfg(test)]
mod tests {
    use super::super::layers::Layers;
    use super::*;

    fn join_plain(lines: &[(f64, f64)]) -> (Vec<Vec<f64>>, usize) {
        let layer = Layers::new(&[]).id(b"0");
        let at = |x: f64| DVec3::new(x, -x, 1.0);
        let segment =
            |(order, &(a, b)): (usize, &(f64, f64))| Segment { ends: [at(a), at(b)], layer, place: Place::Line(1), order };
        let (chains, dropped) = join(lines.iter().enumerate().map(segment).collect());
        (chains.into_iter().map(|chain| chain.vertices.iter().map(|v| v.0.x).collect()).collect(), dropped)
    }

    #[test]
    fn chains_run_as_their_first_line() {
        assert_eq!(join_plain(&[(1.0, 2.0), (2.0, 3.0), (3.0, 4.0)]).0, [vec![1.0, 2.0, 3.0, 4.0]]);
        // Out of order, and turned round.
        assert_eq!(join_plain(&[(3.0, 2.0), (3.0, 4.0), (1.0, 2.0)]).0, [vec![4.0, 3.0, 2.0, 1.0]]);
        // Two that do not meet.
        assert_eq!(join_plain(&[(1.0, 2.0), (5.0, 6.0), (2.0, 3.0)]).0, [vec![1.0, 2.0, 3.0], vec![5.0, 6.0]]);
    }

    #[test]
    fn rings_repeat_their_first_vertex() {
        assert_eq!(join_plain(&[(2.0, 3.0), (1.0, 2.0), (3.0, 1.0)]).0, [vec![2.0, 3.0, 1.0, 2.0]]);
        assert_eq!(join_plain(&[(1.0, 2.0), (2.0, 1.0), (1.0, 1.0)]), (vec![vec![1.0, 2.0]], 2));
    }

    #[test]
    fn forks_stay_apart() {
        let (chains, _) = join_plain(&[(1.0, 2.0), (2.0, 3.0), (2.0, 4.0), (4.0, 5.0)]);
        assert_eq!(chains, [vec![1.0, 2.0], vec![2.0, 3.0], vec![2.0, 4.0, 5.0]]);
        // A ring with a tail: the ring begins and ends at the fork, wherever its first line is.
        let (chains, _) = join_plain(&[(3.0, 4.0), (2.0, 3.0), (4.0, 2.0), (2.0, 9.0)]);
        assert_eq!(chains, [vec![2.0, 3.0, 4.0, 2.0], vec![2.0, 9.0]]);
    }

    #[test]
    fn zero_has_no_sign() {
        assert_eq!(join_plain(&[(-1.0, 0.0), (-0.0, 1.0)]).0.len(), 1);
    }
}
