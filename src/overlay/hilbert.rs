//! Points in an order in which neighbours in the list are neighbours in plan.

use crate::kernel::plan_box::PlanBox;
use glam::DVec3;

/// Points of one cell of the curve that are not worth a finer curve.
const FEW: usize = 8;

/// Orders `ids` of `points` along a Hilbert curve: 65 536 cells to a side, and within a crowded cell again as many. Points that
/// coincide come next to each other. The order depends on coordinates and ids only.
pub(super) fn sort(points: &[DVec3], ids: &mut [u32]) {
    let PlanBox { lo, hi } = PlanBox::of(ids.iter().map(|&i| points[i as usize].truncate()));
    let scale = CELLS / (hi - lo).max_element();
    if ids.len() <= FEW || !scale.is_finite() {
        let key = |i: u32| points[i as usize];
        ids.sort_unstable_by(|&i, &j| {
            let (p, q) = (key(i), key(j));
            p.x.total_cmp(&q.x).then(p.y.total_cmp(&q.y)).then(p.z.total_cmp(&q.z)).then(i.cmp(&j))
        });
        return;
    }
    let key = |i: u32| {
        let q = (points[i as usize].truncate() - lo) * scale;
        u64::from(index(q.x as u32, q.y as u32)) << 32 | u64::from(i)
    };
    let mut keys: Vec<u64> = ids.iter().map(|&i| key(i)).collect();
    sort_by_place(&mut keys);
    for (id, key) in ids.iter_mut().zip(&keys) {
        *id = *key as u32;
    }
    let mut from = 0;
    for run in keys.chunk_by(|a, b| a >> 32 == b >> 32) {
        if run.len() > 1 {
            sort(points, &mut ids[from..from + run.len()]);
        }
        from += run.len();
    }
}

/// Sorts keys whose lower halves ascend by their upper halves: three stable rounds of eleven bits.
fn sort_by_place(keys: &mut Vec<u64>) {
    const BITS: u32 = 11;
    // The rounds cost as much as their counters; the lower half holds the id, so the result is the same.
    if keys.len() < 1 << BITS {
        return keys.sort_unstable();
    }
    let mut spare = vec![0; keys.len()];
    for shift in [32, 32 + BITS, 32 + 2 * BITS] {
        let digit = |key: u64| (key >> shift) as usize & ((1 << BITS) - 1);
        let mut next = [0_u32; 1 << BITS];
        keys.iter().for_each(|&key| next[digit(key)] += 1);
        let mut from = 0;
        for slot in &mut next {
            from += std::mem::replace(slot, from);
        }
        for &key in keys.iter() {
            let slot = &mut next[digit(key)];
            spare[*slot as usize] = key;
            *slot += 1;
        }
        std::mem::swap(keys, &mut spare);
    }
}

/// Cells to a side, a hair less, so that the far edge falls into the last one.
const CELLS: f64 = 65_535.999;

/// Place of the cell `(x, y)` on the Hilbert curve of 16 levels, all levels at once by a parallel prefix scan over the bits.
///
/// Reference: H. S. Warren, Hacker's Delight, 2nd ed., section 16-2; the same with the scan over both coordinates.
fn index(x: u32, y: u32) -> u32 {
    const ALL: u32 = 0xFFFF;
    let mut a = x ^ y;
    let mut b = ALL ^ a;
    let mut c = ALL ^ (x | y);
    let mut d = x & (y ^ ALL);
    let (mut a1, mut b1) = (a | (b >> 1), (a >> 1) ^ a);
    let mut c1 = ((c >> 1) ^ (b & (d >> 1))) ^ c;
    let mut d1 = ((a & (c >> 1)) ^ (d >> 1)) ^ d;
    for shift in [2, 4, 8] {
        (a, b, c, d) = (a1, b1, c1, d1);
        a1 = (a & (a >> shift)) ^ (b & (b >> shift));
        b1 = (a & (b >> shift)) ^ (b & ((a ^ b) >> shift));
        c1 ^= (a & (c >> shift)) ^ (b & (d >> shift));
        d1 ^= (b & (c >> shift)) ^ ((a ^ b) & (d >> shift));
    }
    let (a, b) = (c1 ^ (c1 >> 1), d1 ^ (d1 >> 1));
    let low = x ^ y;
    let high = b | (ALL ^ (low | a));
    spread(high) << 1 | spread(low)
}

/// The low sixteen bits, each followed by a free one above it.
fn spread(mut x: u32) -> u32 {
    for (shift, mask) in [(8, 0x00FF_00FF), (4, 0x0F0F_0F0F), (2, 0x3333_3333), (1, 0x5555_5555)] {
        x = (x | x << shift) & mask;
    }
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_curve_is_connected() {
        // In each corner of the square: places that follow each other lie side by side.
        for (x0, y0) in [(0, 0), (65_472, 0), (0, 65_472), (65_472, 65_472), (12_352, 51_200)] {
            let mut cells: Vec<(u32, u32, u32)> =
                (0..64).flat_map(|x| (0..64).map(move |y| (index(x0 + x, y0 + y), x, y))).collect();
            cells.sort_unstable();
            assert!(cells.windows(2).all(|w| w[1].0 == w[0].0 + 1), "one stretch of the curve");
            assert!(cells.windows(2).all(|w| w[0].1.abs_diff(w[1].1) + w[0].2.abs_diff(w[1].2) == 1));
        }
    }

    #[test]
    fn equal_points_come_together_also_in_a_crowd() {
        let mut points = vec![DVec3::new(1e9, 1e9, 0.0), DVec3::ZERO];
        for i in 0..1000 {
            let p = DVec3::new(f64::from(i % 25) * 0.1, f64::from(i * 7 % 40) * 0.1, f64::from(i % 3));
            points.extend([p, p]);
        }
        points.rotate_left(777);
        let mut ids: Vec<u32> = (0..points.len() as u32).collect();
        sort(&points, &mut ids);
        let mut seen = rustc_hash::FxHashSet::default();
        for run in ids.chunk_by(|&i, &j| points[i as usize] == points[j as usize]) {
            assert!(seen.insert(points[run[0] as usize].to_array().map(f64::to_bits)));
        }
        let mut all = ids.clone();
        all.sort_unstable();
        assert!(all.into_iter().eq(0..points.len() as u32));
    }
}
