//! The line in pieces between nodes, with the sides on which slopes are wanted.

use super::canonical::Order;
use super::network::Given;
use super::noding::Segments;
use crate::model::{Design, Line, Role, Side};
use glam::DVec3;
use rustc_hash::FxHashMap;
use std::hash::Hash;

/// One given segment between welded vertices.
pub(super) struct Piece {
    pub(super) ends: [u32; 2],
    pub(super) wanted: [bool; 2],
    /// Wishes of rings that slope outwards, where there are any: outside of two polygons is outside of both.
    outside: Option<[bool; 2]>,
    /// Wishes of all others: what one of them wants holds.
    others: [bool; 2],
    pub(super) interior: [bool; 2],
    /// Where the inside of a ring that slopes outwards lies: no slope begins there, whatever another line wants.
    platform: [bool; 2],
    /// The places of its ends on the line.
    pub(super) given: [Given; 2],
    /// Whether it runs against its chain.
    pub(super) against: bool,
}

impl Piece {
    /// The wishes of another line that runs here too (for slopes outside, for others), its inside and its platform, as seen from
    /// this one.
    fn seen(&self, other: &Self) -> (Option<[bool; 2]>, [[bool; 2]; 3]) {
        let same = self.ends == other.ends;
        let turned = |sides: [bool; 2]| if same { sides } else { [sides[1], sides[0]] };
        (other.outside.map(turned), [other.others, other.interior, other.platform].map(turned))
    }

    /// Takes over another ring of the same polygon that runs here too, as where a hole reaches the edge of its polygon: the inside of
    /// the polygon has no width here, and no slopes inside.
    fn join_ring(&mut self, other: &Self, side: Side) {
        let (outside, [others, interior, platform]) = self.seen(other);
        for s in 0..2 {
            self.interior[s] &= interior[s];
            self.platform[s] &= platform[s];
            if let (Some(mine), Some(its)) = (&mut self.outside, outside) {
                mine[s] |= its[s];
            }
            self.others[s] = if side == Side::Inside { self.others[s] && others[s] } else { self.others[s] || others[s] };
        }
        self.settle();
    }

    /// Takes over the wishes of another line that runs here too, whichever comes first.
    fn join(&mut self, other: &Self) {
        let (outside, [others, interior, platform]) = self.seen(other);
        self.outside = match (self.outside, outside) {
            (Some([a, b]), Some([c, d])) => Some([a && c, b && d]),
            (one, other) => one.or(other),
        };
        for s in 0..2 {
            self.interior[s] |= interior[s];
            self.platform[s] |= platform[s];
            self.others[s] |= others[s];
        }
        self.settle();
    }

    /// Where slopes are wanted after all.
    fn settle(&mut self) {
        for s in 0..2 {
            // A platform has no slopes on it: lines along its edge have theirs on the other side only.
            self.wanted[s] = !self.platform[s] && (self.others[s] || self.outside.is_some_and(|outside| outside[s]));
        }
    }
}

/// Pieces, each once.
struct Pieces<K> {
    list: Vec<(K, Piece)>,
    known: FxHashMap<(K, [u32; 2]), usize>,
}

impl<K: Copy + Eq + Hash> Pieces<K> {
    fn new() -> Self {
        Self { list: Vec::new(), known: FxHashMap::default() }
    }

    /// Adds a piece, or joins it to the one of the same key that runs between the same nodes.
    fn add(&mut self, key: K, piece: Piece, join: impl Fn(&mut Piece, &Piece)) {
        let pair = [piece.ends[0].min(piece.ends[1]), piece.ends[0].max(piece.ends[1])];
        match self.known.get(&(key, pair)) {
            Some(&p) => join(&mut self.list[p].1, &piece),
            None => {
                self.known.insert((key, pair), self.list.len());
                self.list.push((key, piece));
            }
        }
    }
}

/// The pieces of line between nodes, each once, with the sides on which a slope is wanted. `line` is in `order`, the places of the
/// pieces are those on the line as given.
pub(super) fn pieces(line: &Line, design: &Design, segments: &Segments, order: &Order) -> Vec<Piece> {
    let mut of_polygons: Pieces<Option<u32>> = Pieces::new();
    for (c, chain) in line.chains.iter().enumerate() {
        let (side, interior_left, polygon) = match chain.role {
            Role::Open => (design.side_of_lines, false, None),
            Role::Outer { polygon } => (design.side_of_rings, signed_area(&chain.vertices) > 0.0, Some(polygon)),
            Role::Hole { polygon } => (design.side_of_rings, signed_area(&chain.vertices) < 0.0, Some(polygon)),
        };
        let against = order.against(c as u32);
        let side = match side {
            Side::Left | Side::Right if chain.closed() => {
                let left = (side == Side::Left) != against;
                if left == interior_left { Side::Inside } else { Side::Outside }
            }
            side => side,
        };
        let wanted = match side {
            Side::Left => [!against, against],
            Side::Right => [against, !against],
            Side::Both => [true, true],
            Side::Inside => [interior_left, !interior_left],
            Side::Outside => [!interior_left, interior_left],
        };
        let interior = [chain.closed() && interior_left, chain.closed() && !interior_left];
        for (i, marks) in segments.by_chain[c].iter().enumerate() {
            for w in marks.windows(2) {
                let ends = [w[0].1, w[1].1];
                if ends[0] == ends[1] {
                    continue;
                }
                let place = |t: f64| {
                    let vertex = i as u32 + u32::from(t >= 1.0);
                    Given { chain: c as u32, vertex, part: if t >= 1.0 { 0.0 } else { t } }
                };
                let (outside, others, platform) =
                    if side == Side::Outside { (Some(wanted), [false; 2], interior) } else { (None, wanted, [false; 2]) };
                let given = [place(w[0].0), place(w[1].0)];
                let piece = Piece { ends, wanted, outside, others, interior, platform, given, against };
                of_polygons.add(polygon, piece, |one, other| match polygon {
                    Some(_) => one.join_ring(other, side),
                    None => one.join(other),
                });
            }
        }
    }
    let mut pieces: Pieces<()> = Pieces::new();
    for (_, piece) in of_polygons.list {
        pieces.add((), piece, Piece::join);
    }
    pieces.list.into_iter().map(|(_, piece)| Piece { given: order.as_given(piece.given), ..piece }).collect()
}

/// Twice the signed plan area of a ring, about its first vertex; positive counter-clockwise.
fn signed_area(ring: &[DVec3]) -> f64 {
    let origin = ring[0].truncate();
    ring.windows(2).map(|w| (w[0].truncate() - origin).perp_dot(w[1].truncate() - origin)).sum()
}
