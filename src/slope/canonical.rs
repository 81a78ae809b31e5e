//! The line in an order of its own, so that nothing depends on the order of the file: chains by place, each from its first end by
//! place, rings from their first vertex by place towards the nearer neighbour in that order.

use super::network::Given;
use crate::model::{Chain, Line};
use glam::DVec3;
use std::borrow::Cow;
use std::cmp::Ordering;

/// Where the chains of a line in canonical order stand in the line as given.
pub(super) struct Order(Vec<Turn>);

/// Where a chain stands in the line as given.
#[derive(Clone, Copy)]
struct Turn {
    chain: u32,
    /// The vertex it begins with.
    first: u32,
    /// Whether it runs the other way.
    against: bool,
    /// Number of vertices.
    count: u32,
}

impl Order {
    /// Whether a chain runs against the one given.
    pub(super) fn against(&self, chain: u32) -> bool {
        self.0[chain as usize].against
    }

    /// The ends of a piece between two neighbours, or less, in the line as given. The end of a ring's last segment counts on past
    /// the last vertex.
    pub(super) fn as_given(&self, [from, to]: [Given; 2]) -> [Given; 2] {
        let Turn { chain, first, against, count } = self.0[from.chain as usize];
        // The segment of the line as given, by its earlier end.
        let segment = match against {
            false => (from.vertex + first) % count,
            true => (first + 2 * count - 1 - from.vertex) % count,
        };
        let at = |given: Given| {
            let part = f64::from(given.vertex - from.vertex) + given.part;
            let part = if against { 1.0 - part } else { part };
            let (vertex, part) = if part >= 1.0 { (segment + 1, 0.0) } else { (segment, part) };
            Given { chain, vertex, part }
        };
        [at(from), at(to)]
    }
}

/// The line in canonical order; it depends on where the chains are alone. Roads keep their direction, which their stations go by.
/// Chains of the same vertices keep the order they have.
pub(super) fn line(line: &Line) -> (Cow<'_, Line>, Order) {
    let outlines: Vec<Outline> = line.chains.iter().map(Outline::of).collect();
    let mut order: Vec<usize> = (0..line.chains.len()).collect();
    order.sort_by(|&a, &b| {
        let by_vertices = || by_vertices(&line.chains[a], &line.chains[b]);
        outlines[a].compare(&outlines[b]).then_with(by_vertices)
    });
    let turns: Vec<Turn> = order.iter().map(|&chain| turn(&line.chains[chain], chain, outlines[chain].first)).collect();
    if turns.iter().enumerate().all(|(i, turn)| turn.chain as usize == i && turn.first == 0 && !turn.against) {
        return (Cow::Borrowed(line), Order(turns));
    }
    let chains = turns.iter().map(|turn| {
        let given = &line.chains[turn.chain as usize];
        let n = given.vertices.len();
        let at = |i: usize| if turn.against { (turn.first as usize + n - i) % n } else { (turn.first as usize + i) % n };
        Chain {
            name: given.name.clone(),
            role: given.role,
            vertices: (0..n).map(|i| given.vertices[at(i)]).collect(),
            places: (0..n).map(|i| given.places[at(i)]).collect(),
            // Stations are asked of the line as given.
            axis: None,
        }
    });
    (Cow::Owned(Line { chains: chains.collect(), breaklines: Vec::new() }), Order(turns))
}

/// How a chain is turned; `first` is its first vertex by place.
fn turn(chain: &Chain, number: usize, first: usize) -> Turn {
    let n = chain.vertices.len();
    let before = |a: usize, b: usize| by_place(&chain.vertices[a], &chain.vertices[b]).is_lt();
    let (first, against) = match (chain.closed(), chain.axis.is_some()) {
        (true, true) => (first, false),
        (true, false) => (first, before((first + n - 1) % n, (first + 1) % n)),
        (false, _) if before(n - 1, 0) => (n - 1, true),
        (false, _) => (0, false),
    };
    Turn { chain: number as u32, first: first as u32, against, count: n as u32 }
}

fn by_place(a: &DVec3, b: &DVec3) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

/// What chains are ordered by.
struct Outline {
    /// The vertex that comes first by place.
    first: usize,
    /// Where the first vertex and the last are.
    ends: [DVec3; 2],
    vertices: usize,
}

impl Outline {
    fn of(chain: &Chain) -> Self {
        let (mut first, mut last) = (0, 0);
        let at = |i: usize| &chain.vertices[i];
        for i in 1..chain.vertices.len() {
            if by_place(at(i), at(first)).is_lt() {
                first = i;
            }
            if by_place(at(i), at(last)).is_gt() {
                last = i;
            }
        }
        Self { first, ends: [*at(first), *at(last)], vertices: chain.vertices.len() }
    }

    fn compare(&self, other: &Self) -> Ordering {
        by_place(&self.ends[0], &other.ends[0])
            .then(by_place(&self.ends[1], &other.ends[1]))
            .then(self.vertices.cmp(&other.vertices))
    }
}

/// Compares all vertices of two chains, by place. Chains that have both ends in common are rare.
fn by_vertices(a: &Chain, b: &Chain) -> Ordering {
    let sorted = |chain: &Chain| {
        let mut vertices = chain.vertices.clone();
        vertices.sort_by(by_place);
        vertices
    };
    let pairs = sorted(a).into_iter().zip(sorted(b));
    pairs.map(|(a, b)| by_place(&a, &b)).find(|order| order.is_ne()).unwrap_or(Ordering::Equal)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Place, Role};

    fn chain(role: Role, vertices: &[[f64; 2]]) -> Chain {
        let vertices: Vec<DVec3> = vertices.iter().map(|&[x, y]| DVec3::new(x, y, x + y)).collect();
        Chain { name: "a".into(), role, places: vec![Place::default(); vertices.len()], vertices, axis: None }
    }

    const RING: [[f64; 2]; 4] = [[2.0, 1.0], [0.0, 3.0], [0.0, 0.0], [3.0, 0.0]];

    /// Where a place on the canonical line is, by either way to say it.
    #[test]
    fn places_are_found_in_the_line_as_given() {
        for start in 0..4 {
            for back in [false, true] {
                let mut ring = RING.to_vec();
                ring.rotate_left(start);
                if back {
                    ring.reverse();
                }
                let given = Line {
                    chains: vec![
                        chain(Role::Open, &[[9.0, 9.0], [8.0, 8.0], [7.0, 9.0]]),
                        chain(Role::Outer { polygon: 0 }, &ring),
                    ],
                    ..Line::default()
                };
                let (canonical, order) = line(&given);
                assert_eq!(canonical.chains[0].vertices[0], DVec3::ZERO);
                assert_eq!(canonical.chains[0].vertices[1].truncate().to_array(), [0.0, 3.0], "{start} {back}");
                assert_eq!(canonical.chains[1].vertices[0].truncate().to_array(), [7.0, 9.0]);
                for (c, chain) in canonical.chains.iter().enumerate() {
                    for i in 0..chain.segment_count() as u32 {
                        let at = |vertex, part| Given { chain: c as u32, vertex, part };
                        for ends in [[at(i, 0.0), at(i + 1, 0.0)], [at(i, 0.25), at(i, 0.5)], [at(i, 0.5), at(i + 1, 0.0)]] {
                            let found = order.as_given(ends);
                            let ascends = found[0].vertex as f64 + found[0].part < found[1].vertex as f64 + found[1].part;
                            assert_ne!(ascends, order.against(c as u32), "{found:?}");
                            for (own, theirs) in ends.iter().zip(found) {
                                let place = |line: &Line, g: &Given| {
                                    let vertices = &line.chains[g.chain as usize].vertices;
                                    let at = |v: u32| vertices[v as usize % vertices.len()];
                                    at(g.vertex).lerp(at(g.vertex + 1), g.part)
                                };
                                assert!(place(&canonical, own).distance(place(&given, &theirs)) < 1e-12, "{own:?} {theirs:?}");
                            }
                        }
                    }
                }
            }
        }
    }

    #[test]
    fn a_line_in_order_is_left_alone() {
        let given = Line { chains: vec![chain(Role::Open, &[[0.0, 0.0], [1.0, 0.0]])], ..Line::default() };
        assert!(matches!(line(&given).0, Cow::Borrowed(_)));
    }
}
