//! Which vertices triangles use, and which lie on the border.

/// How the triangles use their vertices, in two numbers for each.
pub(super) struct Corners {
    /// Number of triangles at the vertex, and the sum of (next corner − corner before) over them, modulo 2³².
    at: Vec<(u32, u32)>,
}

impl Corners {
    pub(super) fn new(count: usize, triangles: &[[u32; 3]]) -> Self {
        let mut at = vec![(0_u32, 0_u32); count];
        for &[a, b, c] in triangles {
            for (v, before, next) in [(a, c, b), (b, a, c), (c, b, a)] {
                let (n, balance) = &mut at[v as usize];
                *n += 1;
                *balance = balance.wrapping_add(next).wrapping_sub(before);
            }
        }
        Self { at }
    }

    /// Whether a triangle uses the vertex.
    pub(super) fn used(&self, v: usize) -> bool {
        self.at[v].0 > 0
    }

    /// Whether the triangles at the vertex do not close a ring around it. Where they do, each of its neighbours is the next
    /// corner of one triangle and the one before of another, so that the sum vanishes; on a border it is the difference of two
    /// distinct vertices, which does not. (Where triangles wind both ways, an inner vertex may be taken for one of the border.)
    pub(super) fn on_border(&self, v: usize) -> bool {
        let (n, balance) = self.at[v];
        n > 0 && balance != 0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inner_vertices_are_known() {
        // A fan around vertex 0, and a triangle apart.
        let corners = Corners::new(9, &[[0, 1, 2], [0, 2, 3], [3, 4, 0], [4, 1, 0], [5, 6, 7]]);
        let border: Vec<usize> = (0..9).filter(|&v| corners.on_border(v)).collect();
        assert_eq!(border, [1, 2, 3, 4, 5, 6, 7]);
        assert!(corners.used(0) && !corners.used(8));
    }
}
