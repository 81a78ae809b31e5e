//! Single LINEs and ARCs that meet end to end → polylines.

use super::layers::LayerId;
use crate::read::RawVertex;
use rustc_hash::{FxHashMap, FxHashSet};

/// Ends this close are one place, in the length unit: coordinates and angles written with six decimals put the end of an arc of
/// a hundred metres within two millionths of its neighbour's.
pub(super) const JOIN: f64 = 1e-5;

/// Beyond this coordinates must be the same to be joined; none on Earth are.
const FARTHEST: f64 = 1e9;

/// A LINE of two vertices, or an ARC of an odd number. All have heights.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Piece {
    pub(super) vertices: Vec<RawVertex>,
    pub(super) layer: LayerId,
    /// Number in the order of the drawing.
    pub(super) order: usize,
}

/// The numbers of places on layers.
#[derive(Default)]
struct Nodes {
    places: Vec<[f64; 3]>,
    /// The last place in each cell of the size of [`JOIN`].
    cells: FxHashMap<(LayerId, [i64; 3]), usize>,
    /// For each place, the one before it in the same cell. Places lie further apart than [`JOIN`], so that a cell has few.
    before: Vec<Option<usize>>,
}

impl Nodes {
    /// The place of a vertex: the nearest one known within [`JOIN`], else a new one.
    fn at(&mut self, layer: LayerId, vertex: &RawVertex) -> usize {
        // Zero has two signs.
        let at = [vertex.x, vertex.y, vertex.z.unwrap_or(0.0)].map(|v| v + 0.0);
        let near = at.iter().all(|v| v.abs() <= FARTHEST);
        let cell = if near { at.map(|v| (v / JOIN).floor() as i64) } else { at.map(|v| v.to_bits() as i64) };
        let mut best: Option<(f64, usize)> = None;
        let mut look = |cell: [i64; 3]| {
            let mut place = self.cells.get(&(layer, cell)).copied();
            while let Some(i) = place {
                let p = self.places[i];
                let same = (0..3).all(|k| p[k].to_bits() == at[k].to_bits());
                let square: f64 = if same { 0.0 } else { (0..3).map(|k| (p[k] - at[k]).powi(2)).sum() };
                if square <= JOIN * JOIN && best.is_none_or(|best| (square, i) < best) {
                    best = Some((square, i));
                }
                place = self.before[i];
            }
            best
        };
        let exact = look(cell).is_some_and(|(square, _)| square == 0.0);
        if near && !exact {
            for k in (0..27).filter(|&k| k != 13) {
                look([cell[0] + k / 9 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k % 3 - 1]);
            }
        }
        match best {
            Some((_, place)) => place,
            None => {
                let place = self.places.len();
                self.places.push(at);
                self.before.push(self.cells.insert((layer, cell), place));
                place
            }
        }
    }
}

/// Joins pieces of one layer where the ends of just two lie within [`JOIN`] of each other. Where three and more meet they stay
/// apart. Each chain runs as its first piece is drawn, and has its order; the first vertex is repeated if it is a ring. Pieces
/// without length and those drawn before, in either direction, are left out: the second result is how many.
pub(super) fn join(mut pieces: Vec<Piece>) -> (Vec<Piece>, usize) {
    let given = pieces.len();
    let mut nodes = Nodes::default();
    let mut drawn = FxHashSet::default();
    let mut ends = Vec::with_capacity(given);
    pieces.retain(|piece| {
        let [first, inner @ .., last] = piece.vertices.as_slice() else { return false };
        let (a, b) = (nodes.at(piece.layer, first), nodes.at(piece.layer, last));
        // A line and an arc may have the same ends.
        let middle = inner.get(inner.len() / 2).map(|v| nodes.at(piece.layer, v));
        let new = (a != b || middle.is_some()) && drawn.insert((a.min(b), a.max(b), middle));
        if new {
            ends.push([a, b]);
        }
        new
    });
    drop(drawn);
    // The ends at each place, as long as they are just two.
    let mut at: Vec<(usize, [(usize, usize); 2])> = vec![(0, [(0, 0); 2]); nodes.places.len()];
    for (i, ends) in ends.iter().enumerate() {
        for (end, &place) in ends.iter().enumerate() {
            let (count, list) = &mut at[place];
            if let Some(slot) = list.get_mut(*count) {
                *slot = (i, end);
            }
            *count += 1;
        }
    }
    // The other piece at an end, and which of its ends that is.
    let next = |(i, end): (usize, usize)| match at[ends[i][end]] {
        (2, [a, b]) => Some(if a == (i, end) { b } else { a }),
        _ => None,
    };
    let mut used = vec![false; pieces.len()];
    let mut chains = Vec::new();
    for first in 0..pieces.len() {
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
                let piece = &pieces[other].vertices;
                if near == 0 {
                    vertices.extend(piece.iter().skip(1).copied());
                } else {
                    vertices.extend(piece.iter().rev().skip(1).copied());
                }
            }
            (vertices, end)
        };
        let (after, last) = walk(1);
        let (before, begin) = walk(0);
        let mut vertices = before;
        vertices.reverse();
        vertices.extend_from_slice(&pieces[first].vertices);
        vertices.extend(after);
        let ring = ends[begin.0][begin.1] == ends[last.0][last.1];
        if let (true, [begin, .., last]) = (ring, vertices.as_mut_slice()) {
            *last = *begin;
        }
        chains.push(Piece { vertices, layer: pieces[first].layer, order: pieces[first].order });
    }
    (chains, given - pieces.len())
}

#[cfg(test)]
mod tests {
    use super::super::layers::Layers;
    use super::*;

    fn vertex(x: f64) -> RawVertex {
        RawVertex { x, y: -x, z: Some(1.0), row: None }
    }

    fn join_all(pieces: Vec<Vec<RawVertex>>) -> (Vec<Vec<f64>>, usize) {
        let layer = Layers::new(&[]).id(b"0");
        let piece = |(order, vertices)| Piece { vertices, layer, order };
        let (chains, dropped) = join(pieces.into_iter().enumerate().map(piece).collect());
        (chains.into_iter().map(|chain| chain.vertices.iter().map(|v| v.x).collect()).collect(), dropped)
    }

    fn join_plain(lines: &[(f64, f64)]) -> (Vec<Vec<f64>>, usize) {
        join_all(lines.iter().map(|&(a, b)| vec![vertex(a), vertex(b)]).collect())
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
        // To the last bit, also where its ends only nearly meet.
        assert_eq!(join_plain(&[(2.0, 3.0), (1.0, 2.0 + 3e-6), (3.0, 1.0)]).0, [vec![2.0, 3.0, 1.0, 2.0]]);
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
    fn near_ends_are_one() {
        assert_eq!(join_plain(&[(-1.0, 0.0), (-0.0, 1.0)]).0.len(), 1);
        // On both sides of the border of a cell; the vertices differ by √2 times these.
        for (off, count) in [(6e-6, 1), (-6e-6, 1), (8e-6, 2), (-8e-6, 2)] {
            for at in [5e6, -3.0, 0.0, 1e-5, 0.99e-5] {
                assert_eq!(join_plain(&[(-9.0, at), (at + off, 9e6)]).0.len(), count, "{at} {off}");
            }
        }
        // Far away to the last bit only.
        assert_eq!(join_plain(&[(1e300, 2e300), (2e300, 3e300)]).0.len(), 1);
        assert_eq!(join_plain(&[(1e300, 2e300), (2e300 * (1.0 + f64::EPSILON), 3e300)]).0.len(), 2);
    }

    #[test]
    fn arcs_between_lines() {
        let arc = |list: &[f64]| list.iter().map(|&x| vertex(x)).collect::<Vec<_>>();
        let (chains, _) = join_all(vec![arc(&[1.0, 2.0]), arc(&[4.0, 3.0, 2.0]), arc(&[4.0, 5.0])]);
        assert_eq!(chains, [[1.0, 2.0, 3.0, 4.0, 5.0]]);
        // A line and an arc over it are a ring; an arc drawn twice is one; one that goes all round is a ring by itself.
        let (chains, dropped) =
            join_all(vec![arc(&[1.0, 2.0]), arc(&[1.0, 7.0, 2.0]), arc(&[1.0, 7.0, 2.0]), arc(&[8.0, 9.0, 8.0])]);
        assert_eq!((chains, dropped), (vec![vec![1.0, 2.0, 7.0, 1.0], vec![8.0, 9.0, 8.0]], 1));
    }
}
