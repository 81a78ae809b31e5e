//! Paths of pieces between the nodes that must stay.

use super::network::Given;
use super::pieces::Piece;
use crate::kernel::buckets::Buckets;
use glam::{DVec2, DVec3};

/// A maximal path of pieces that agree in chain and sides, without a branch.
pub(super) struct Run {
    pub(super) nodes: Vec<u32>,
    /// The given vertex at each node, as the beginning of what follows.
    pub(super) given: Vec<Given>,
    /// The same as the end of what comes before: a ring's first vertex counts on past the last one there.
    pub(super) arriving: Vec<Given>,
    /// Whether it runs against its chain.
    pub(super) against: bool,
    pub(super) wanted: [bool; 2],
    pub(super) interior: [bool; 2],
}

/// Pieces by node.
pub(super) struct Runs<'a> {
    pieces: &'a [Piece],
    at_node: Buckets<u32>,
}

impl<'a> Runs<'a> {
    pub(super) fn new(nodes: usize, pieces: &'a [Piece]) -> Self {
        let ends = (0..).zip(pieces).flat_map(|(p, piece)| piece.ends.map(|end| (end, p)));
        let at_node = Buckets::new(nodes, ends);
        Self { pieces, at_node }
    }

    /// A node that must stay: an end, a junction, or a place where the wish for sides or the chain changes.
    fn fixed(&self, node: u32) -> bool {
        let [p, q] = *self.at_node.of(node) else { return true };
        let (p, q) = (&self.pieces[p as usize], &self.pieces[q as usize]);
        let through = p.ends[1] == q.ends[0] || p.ends[0] == q.ends[1];
        !through || p.given[0].chain != q.given[0].chain || p.wanted != q.wanted || p.interior != q.interior
    }

    /// The ends of a run at which its first or last edge must stay: where a line with a slope on one side ends, or meets another, the
    /// slope may end in the ruling at right angles to that edge, and would turn with it.
    pub(super) fn kept_ends(&self, run: &Run) -> [bool; 2] {
        let one_sided = run.wanted[0] != run.wanted[1];
        let ends = [run.nodes[0], run.nodes[run.nodes.len() - 1]];
        ends.map(|node| one_sided && self.fixed(node))
    }

    pub(super) fn all(&self, points: &[DVec3]) -> Vec<Run> {
        let mut done = vec![false; self.pieces.len()];
        let mut runs = Vec::new();
        for p in 0..self.pieces.len() {
            let start = self.pieces[p].ends[0];
            if !done[p] && self.fixed(start) {
                runs.push(self.walk(p, &mut done));
            }
        }
        for p in 0..self.pieces.len() {
            if !done[p] {
                runs.extend(self.cut_ring(self.walk(p, &mut done), points));
            }
        }
        runs
    }

    /// Follows pieces forward from piece `p` up to a fixed node or back to the start.
    fn walk(&self, p: usize, done: &mut [bool]) -> Run {
        let piece = &self.pieces[p];
        let mut run = Run {
            nodes: vec![piece.ends[0], piece.ends[1]],
            given: piece.given.to_vec(),
            arriving: piece.given.to_vec(),
            against: piece.against,
            wanted: piece.wanted,
            interior: piece.interior,
        };
        done[p] = true;
        let mut at = piece.ends[1];
        while !self.fixed(at) {
            let Some(&next) = self.at_node.of(at).iter().find(|&&q| !done[q as usize] && self.pieces[q as usize].ends[0] == at)
            else {
                break;
            };
            done[next as usize] = true;
            let piece = &self.pieces[next as usize];
            at = piece.ends[1];
            run.nodes.push(at);
            // What goes on from a ring's first vertex begins there, and does not count on.
            run.given.pop();
            run.given.extend(piece.given);
            run.arriving.push(piece.given[1]);
        }
        run
    }

    /// Cuts a ring without a fixed node in two at places that depend on its shape alone: the node farthest from the mean of
    /// all, and the node farthest from that one.
    fn cut_ring(&self, run: Run, points: &[DVec3]) -> Vec<Run> {
        let ring = &run.nodes[..run.nodes.len() - 1];
        let at = |i: usize| points[ring[i] as usize].truncate();
        let mean = (0..ring.len()).map(at).sum::<DVec2>() / ring.len() as f64;
        let farthest = |from: DVec2| {
            (0..ring.len()).fold((0, -1.0), |best, i| {
                let d = at(i).distance_squared(from);
                if d > best.1 { (i, d) } else { best }
            })
        };
        let (first, _) = farthest(mean);
        let (second, _) = farthest(at(first));
        let part = |from: usize, to: usize| {
            let count = (to + ring.len() - from - 1) % ring.len() + 1;
            let at: Vec<usize> = (0..=count).map(|i| (from + i) % ring.len()).collect();
            let arriving = at.iter().take(count).map(|&i| run.arriving[i + 1]);
            Run {
                nodes: at.iter().map(|&i| ring[i]).collect(),
                given: at.iter().map(|&i| run.given[i]).collect(),
                arriving: std::iter::once(run.given[from]).chain(arriving).collect(),
                against: run.against,
                wanted: run.wanted,
                interior: run.interior,
            }
        };
        vec![part(first, second), part(second, first)]
    }
}
