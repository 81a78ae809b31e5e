//! Things in buckets: a counting sort.

use rayon::join;
use std::cmp::Ordering;

/// Things that are sorted at one go.
const RUN: usize = 1 << 13;

/// Things by the number of their bucket; within a bucket they stay in the order in which they were given.
#[derive(Clone, Debug)]
pub struct Buckets<T> {
    /// Where each bucket begins, and where the last one ends.
    start: Vec<u32>,
    things: Vec<T>,
}

impl<T: Copy + Default> Buckets<T> {
    /// Puts things into `count` buckets; each comes with the number of its own, below `count`. They are gone through twice: counted
    /// first, so that no bucket has to grow.
    #[inline]
    pub fn new(count: usize, things: impl Iterator<Item = (u32, T)> + Clone) -> Self {
        // Two buckets further on, so that each entry has grown to the end of its bucket, the start of the next one, when all are in.
        let mut start = vec![0_u32; count + 2];
        things.clone().for_each(|(bucket, _)| start[bucket as usize + 2] += 1);
        for bucket in 2..start.len() {
            start[bucket] += start[bucket - 1];
        }
        let mut sorted = vec![T::default(); start[count + 1] as usize];
        things.for_each(|(bucket, thing)| {
            let slot = &mut start[bucket as usize + 1];
            sorted[*slot as usize] = thing;
            *slot += 1;
        });
        start.pop();
        Self { start, things: sorted }
    }

    /// How many buckets there are.
    pub fn count(&self) -> usize {
        self.start.len() - 1
    }

    /// The things of a bucket.
    #[inline]
    pub fn of(&self, bucket: u32) -> &[T] {
        &self.things[self.start[bucket as usize] as usize..self.start[bucket as usize + 1] as usize]
    }

    /// The buckets in their order.
    pub fn each_mut(&mut self) -> impl Iterator<Item = &mut [T]> {
        let mut rest = &mut self.things[..];
        self.start.windows(2).map(move |ends| {
            let (bucket, after) = std::mem::take(&mut rest).split_at_mut((ends[1] - ends[0]) as usize);
            rest = after;
            bucket
        })
    }

    /// Sorts every bucket by itself. Which of things that compare equal comes first is not told.
    pub fn sort_each(&mut self, compare: impl Fn(&T, &T) -> Ordering + Sync)
    where
        T: Send,
    {
        sort(&self.start, &mut self.things, &compare);
    }

    /// All things, bucket after bucket.
    pub fn into_things(self) -> Vec<T> {
        self.things
    }
}

/// Sorts the buckets between `start`, each by itself.
fn sort<T: Send>(start: &[u32], things: &mut [T], compare: &(impl Fn(&T, &T) -> Ordering + Sync)) {
    if start.len() > 2 && things.len() > RUN {
        let middle = start.len() / 2;
        let (before, after) = things.split_at_mut((start[middle] - start[0]) as usize);
        join(|| sort(&start[..=middle], before, compare), || sort(&start[middle..], after, compare));
        return;
    }
    for ends in start.windows(2) {
        things[(ends[0] - start[0]) as usize..(ends[1] - start[0]) as usize].sort_unstable_by(compare);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        /// Against a stable sort by bucket.
        #[test]
        fn things_lie_in_their_buckets(given in prop::collection::vec((0..20_u32, 0..5_u32), 0..200)) {
            let numbered: Vec<(u32, (u32, usize))> = given.iter().enumerate().map(|(n, &(b, v))| (b, (v, n))).collect();
            let mut expected = numbered.clone();
            expected.sort_by_key(|(bucket, _)| *bucket);
            let mut buckets = Buckets::new(20, numbered.iter().copied());
            let of = |expected: &[(u32, (u32, usize))], b| -> Vec<(u32, usize)> {
                expected.iter().filter(|(bucket, _)| *bucket == b).map(|(_, thing)| *thing).collect()
            };
            prop_assert_eq!(buckets.count(), 20);
            prop_assert!((0..20).all(|b| buckets.of(b) == of(&expected, b)));
            prop_assert!(buckets.each_mut().zip(0..).all(|(bucket, b)| *bucket == of(&expected, b)));
            prop_assert_eq!(buckets.each_mut().count(), 20);
            prop_assert_eq!(buckets.clone().into_things(), expected.iter().map(|(_, thing)| *thing).collect::<Vec<_>>());
            buckets.sort_each(Ord::cmp);
            expected.sort();
            prop_assert!((0..20).all(|b| buckets.of(b) == of(&expected, b)));
        }
    }

    /// More than are sorted at one go, in many buckets, with one that has most of them.
    #[test]
    fn many_are_sorted_each_in_its_bucket() {
        let count = 20 * RUN as u32;
        let bucket = |v: u32| if v.is_multiple_of(3) { v % 1000 } else { 500 };
        let mixed = |n: u32| n.wrapping_mul(2_654_435_761);
        let mut buckets = Buckets::new(1000, (0..count).map(|n| (bucket(mixed(n)), mixed(n))));
        buckets.sort_each(u32::cmp);
        let mut expected: Vec<(u32, u32)> = (0..count).map(|n| (bucket(mixed(n)), mixed(n))).collect();
        expected.sort_unstable();
        assert!(buckets.into_things().into_iter().eq(expected.into_iter().map(|(_, v)| v)));
    }

    #[test]
    fn nothing_in_no_bucket() {
        let mut none = Buckets::<u32>::new(0, std::iter::empty());
        none.sort_each(u32::cmp);
        assert_eq!((none.count(), none.each_mut().count()), (0, 0));
        assert!(none.into_things().is_empty());
    }
}
