//! What triangles do with their vertices, in one pass over all of them: which vertices are used, which lie on the border, and
//! which triangles may have been given twice.
//!
//! Counting at the vertices is what the time goes into. It is done for one range of vertices after the other, by several threads:
//! each range looks at those blocks of triangles only that have a corner in it, which are few where triangles and vertices come
//! in a similar order, and what it counts stays in the cache where they do not.

use super::coordinates::Coordinates;
use glam::DVec3;
use rayon::prelude::*;
use std::ops::Range;

/// Triangles of which the least and greatest vertex are known together.
pub(super) const BLOCK: usize = 1 << 12;

/// Ranges of vertices that are counted by themselves. Where triangles come in no order, each of them looks at all triangles.
const RANGES: usize = 8;

/// Triangles remembered at a vertex. A triangle is remembered at its corner of middle number, where there are two on average and
/// hardly ever more than four.
const REMEMBERED: usize = 4;

/// No vertex.
const NONE: u32 = u32::MAX;

/// What was found.
pub(super) struct Corners {
    /// Box and precision of the vertices that triangles use.
    pub(super) coordinates: Coordinates,
    /// Vertices that no triangle uses.
    pub(super) unused: usize,
    /// Vertices on the border, ascending.
    pub(super) border: Vec<u32>,
    /// Vertices with two triangles that may have the same corners, ascending: they are in the middle of both.
    pub(super) suspects: Vec<u32>,
}

/// How triangles use a vertex.
#[derive(Clone, Copy, Default)]
struct Use {
    /// Their number, as far as it matters: triangles of the vertex, modulo 2³².
    count: u32,
    /// The sum of (next corner − corner before) over them, modulo 2³².
    balance: u32,
}

impl Corners {
    /// Looks at triangles, all of them counter-clockwise or without area.
    pub(super) fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let ends: Vec<[u32; 2]> = triangles
            .par_chunks(BLOCK)
            .map(|block| block.as_flattened().iter().fold([NONE, 0], |[lo, hi], &v| [lo.min(v), hi.max(v)]))
            .collect();
        let length = vertices.len().div_ceil(RANGES).max(1);
        let ranges: Vec<Range<usize>> =
            (0..vertices.len()).step_by(length).map(|from| from..(from + length).min(vertices.len())).collect();
        let parts: Vec<Self> = ranges.into_par_iter().map(|range| Self::of_range(range, vertices, triangles, &ends)).collect();
        let none = Self { coordinates: Coordinates::default(), unused: 0, border: Vec::new(), suspects: Vec::new() };
        parts.into_iter().fold(none, |mut all, part| {
            all.coordinates.join(&part.coordinates);
            all.unused += part.unused;
            all.border.extend(part.border);
            all.suspects.extend(part.suspects);
            all
        })
    }

    fn of_range(range: Range<usize>, vertices: &[DVec3], triangles: &[[u32; 3]], ends: &[[u32; 2]]) -> Self {
        let first = range.start as u32;
        let mut uses = vec![Use::default(); range.len()];
        let mut after = vec![[NONE; REMEMBERED]; range.len()];
        let mut suspects = Vec::new();
        for (block, &[least, greatest]) in triangles.chunks(BLOCK).zip(ends) {
            if greatest < first || least as usize >= range.end {
                continue;
            }
            for t in block {
                let [a, b, c] = *t;
                for (v, before, next) in [(a, c, b), (b, a, c), (c, b, a)] {
                    // Numbers before the range become large ones.
                    if let Some(found) = uses.get_mut(v.wrapping_sub(first) as usize) {
                        found.count = found.count.wrapping_add(1);
                        found.balance = found.balance.wrapping_add(next).wrapping_sub(before);
                    }
                }
                let [middle, next, _] = from_middle(t);
                if let Some(known) = after.get_mut(middle.wrapping_sub(first) as usize) {
                    match known.iter().position(|&v| v == NONE || v == next) {
                        Some(free) if known[free] == NONE => known[free] = next,
                        // The same edge twice, or more triangles than are remembered.
                        _ => suspects.push(middle),
                    }
                }
            }
        }
        suspects.sort_unstable();
        suspects.dedup();
        let mut coordinates = Coordinates::default();
        let mut unused = 0;
        let mut border = Vec::new();
        for (v, found) in range.zip(&uses) {
            if found.count == 0 {
                unused += 1;
                continue;
            }
            coordinates.take(vertices[v]);
            // Where the triangles at a vertex close a ring around it, each of its neighbours is the next corner of one and the one
            // before of another, so that the sum vanishes; on a border it is the difference of two distinct vertices, which does not.
            if found.balance != 0 {
                border.push(v as u32);
            }
        }
        Self { coordinates, unused, border, suspects }
    }
}

/// The corners of a triangle in their cyclic order, from the one of middle number on.
#[inline]
pub(super) fn from_middle(&[a, b, c]: &[u32; 3]) -> [u32; 3] {
    let middle = a.min(b).max(a.max(b).min(c));
    if middle == a {
        [a, b, c]
    } else if middle == b {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_vertices_are_known() {
        // A fan around vertex 0, and a triangle apart.
        let vertices = vec![DVec3::ZERO; 9];
        let corners = Corners::new(&vertices, &[[0, 1, 2], [0, 2, 3], [3, 4, 0], [4, 1, 0], [5, 6, 7]]);
        assert_eq!(corners.border, [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(corners.unused, 1);
        assert!(corners.suspects.is_empty());
    }

    /// Every triangle twice is suspected at its middle corner, in whatever order vertices and triangles come, and in each range.
    #[test]
    fn repetitions_are_suspected_wherever_they_are() {
        let side = 80_u32;
        let mut grid: Vec<[u32; 3]> = (0..side * side)
            .map(|i| (i / side * (side + 1) + i % side, side + 1))
            .flat_map(|(a, row)| [[a, a + 1, a + row + 1], [a, a + row + 1, a + row]])
            .collect();
        assert!(grid.len() > 2 * BLOCK);
        let count = (side + 1) * (side + 1);
        let vertices = vec![DVec3::ZERO; count as usize];
        let mut state = 1_u64;
        let mut shuffled = |n: u32| {
            let mut order: Vec<u32> = (0..n).collect();
            for i in (1..order.len()).rev() {
                state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
                order.swap(i, (state >> 33) as usize % (i + 1));
            }
            order
        };
        for in_order in [true, false] {
            if !in_order {
                let (numbers, order) = (shuffled(count), shuffled(grid.len() as u32));
                grid = order.into_iter().map(|i| grid[i as usize].map(|v| numbers[v as usize])).collect();
            }
            for at in (0..grid.len()).step_by(997) {
                let [a, b, c] = grid[at];
                let mut twice = grid.clone();
                twice.push([b, c, a]);
                assert!(Corners::new(&vertices, &twice).suspects.contains(&from_middle(&[a, b, c])[0]));
            }
            let few = if in_order { 0 } else { count as usize / 20 };
            assert!(Corners::new(&vertices, &grid).suspects.len() <= few);
        }
    }
}
