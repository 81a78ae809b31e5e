//! Which triangles lie beside each other.
//!
//! Half-edge `3t + e` runs from corner `e` of triangle `t` to the next one.

use crate::kernel::buckets::Buckets;

/// No neighbour, no number.
pub(crate) const NONE: u32 = u32::MAX;

/// Around a vertex with more edges than this they are sorted before they are matched.
const MANY: usize = 24;

/// The half-edge on the other side of each, one that runs against it; [`NONE`] on the rim. Edges that have more than two triangles
/// pair up in the order of those, as far as they run against each other.
pub(crate) fn opposites(vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let upwards = |half: u32| {
        let (t, e) = (triangles[half as usize / 3], half as usize % 3);
        t[e] < t[if e == 2 { 0 } else { e + 1 }]
    };
    let sides = (0..).step_by(3).zip(triangles).flat_map(|(n, &[a, b, c])| [(n, a, b), (n + 1, b, c), (n + 2, c, a)]);
    // By their lesser end: half-edge, greater end.
    let mut halves = Buckets::new(vertices, sides.map(|(half, u, v): (u32, u32, u32)| (u.min(v), (half, u.max(v)))));
    let mut opposite = vec![NONE; 3 * triangles.len()];
    for around in halves.each_mut() {
        if around.len() > MANY {
            around.sort_unstable_by_key(|&(half, far)| (far, half));
            // In the order of their numbers, as below, but many that are alike are not all compared with each other.
            for same in around.chunk_by(|one, other| one.1 == other.1) {
                let of = |up| same.iter().map(|o| o.0).filter(move |&half| upwards(half) == up);
                for (one, other) in of(true).zip(of(false)) {
                    (opposite[one as usize], opposite[other as usize]) = (other, one);
                }
            }
            continue;
        }
        for i in 0..around.len() {
            let (half, far) = around[i];
            if opposite[half as usize] != NONE {
                continue;
            }
            let open = |o: &&(u32, u32)| o.1 == far && opposite[o.0 as usize] == NONE && upwards(o.0) != upwards(half);
            if let Some(partner) = around[i + 1..].iter().find(open).map(|o| o.0) {
                opposite[half as usize] = partner;
                opposite[partner as usize] = half;
            }
        }
    }
    opposite
}

/// The triangle across each side, as [`opposites`] has them.
pub(crate) fn neighbours(vertices: usize, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let opposites = opposites(vertices, triangles);
    let (sides, _) = opposites.as_chunks::<3>();
    sides.iter().map(|side| side.map(|half| if half == NONE { NONE } else { half / 3 })).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// A fan of a hundred thousand triangles about vertex 0: each has the ones before and after it beside it. Comparing all sides
    /// of the tip with each other would take minutes.
    #[test]
    fn a_fan_has_its_neighbours() {
        let count = 100_000;
        let fan: Vec<[u32; 3]> = (0..count).map(|i| [0, i + 1, i + 2]).collect();
        let found = neighbours(count as usize + 2, &fan);
        for (i, sides) in (0..count).zip(&found) {
            let before = if i == 0 { NONE } else { i - 1 };
            let after = if i + 1 == count { NONE } else { i + 1 };
            assert_eq!(*sides, [before, NONE, after]);
        }
    }

    /// Each half-edge in its turn takes the first later one that is free and runs against it.
    fn one_by_one(triangles: &[[u32; 3]]) -> Vec<u32> {
        let ends = |half: usize| (triangles[half / 3][half % 3], triangles[half / 3][(half % 3 + 1) % 3]);
        let mut opposite = vec![NONE; 3 * triangles.len()];
        for half in 0..opposite.len() {
            let (u, v) = ends(half);
            let free = |other: &usize| opposite[*other] == NONE && u != v && ends(*other) == (v, u);
            if opposite[half] == NONE
                && let Some(other) = (half + 1..opposite.len()).find(free)
            {
                opposite[half] = other as u32;
                opposite[other] = half as u32;
            }
        }
        opposite
    }

    proptest! {
        /// Triangles at random: edges of many triangles, corners used twice, vertices with few edges and with many.
        #[test]
        fn halves_pair_up_in_order(
            vertices in 3..12_u32,
            given in prop::collection::vec([0..u32::MAX, 0..u32::MAX, 0..u32::MAX], 0..80),
        ) {
            let triangles: Vec<[u32; 3]> = given.into_iter().map(|t| t.map(|v| v % vertices)).collect();
            prop_assert_eq!(opposites(vertices as usize, &triangles), one_by_one(&triangles));
        }
    }
}
