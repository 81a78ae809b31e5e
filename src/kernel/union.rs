//! Sets that are joined (union–find).

/// Sets of the numbers from nought on, each known by its least member.
#[derive(Clone, Debug)]
pub struct Union(Vec<u32>);

impl Union {
    /// So many sets of one.
    pub fn new(count: usize) -> Self {
        Self((0..count as u32).collect())
    }

    /// The least member of the set of `i`.
    pub fn root(&mut self, mut i: u32) -> u32 {
        while self.0[i as usize] != i {
            let up = self.0[self.0[i as usize] as usize];
            self.0[i as usize] = up;
            i = up;
        }
        i
    }

    /// Joins the sets of `a` and `b`; says whether they were two.
    pub fn join(&mut self, a: u32, b: u32) -> bool {
        let (a, b) = (self.root(a), self.root(b));
        self.0[a.max(b) as usize] = a.min(b);
        a != b
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_member_names_a_set() {
        let mut sets = Union::new(7);
        assert!(sets.join(5, 3) && sets.join(6, 5) && sets.join(4, 1) && !sets.join(3, 6));
        assert_eq!((0..7).map(|i| sets.root(i)).collect::<Vec<_>>(), [0, 1, 2, 3, 1, 3, 3]);
        assert!(sets.join(4, 6));
        assert_eq!((0..7).map(|i| sets.root(i)).collect::<Vec<_>>(), [0, 1, 2, 1, 1, 1, 1]);
    }
}
