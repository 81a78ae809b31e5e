//! Vertices at exactly the same place are one.

use glam::{DVec2, DVec3};

/// A place nobody has taken.
const FREE: u32 = u32::MAX;

/// For each point the first one with the same coordinates; nought and minus nought are the same. At most 2³² − 1 points.
pub(super) fn first_at_same_place(count: usize, key: impl Fn(usize) -> [u64; 3]) -> Vec<u32> {
    let slots = (count.max(1) * 2).next_power_of_two();
    let mut table = vec![FREE; slots];
    let mut first = Vec::with_capacity(count);
    for i in 0..count {
        let own = key(i);
        let mut slot = scattered(own) as usize & (slots - 1);
        // Half of the slots are free, so the search ends.
        let found = loop {
            match table[slot] {
                FREE => {
                    table[slot] = i as u32;
                    break i as u32;
                }
                other if key(other as usize) == own => break other,
                _ => slot = (slot + 1) & (slots - 1),
            }
        };
        first.push(found);
    }
    first
}

/// The key of a point in space.
pub(super) fn in_space(p: DVec3) -> [u64; 3] {
    [bits(p.x), bits(p.y), bits(p.z)]
}

/// The key of a point in plan.
pub(super) fn in_plan(p: DVec2) -> [u64; 3] {
    [bits(p.x), bits(p.y), 0]
}

fn bits(value: f64) -> u64 {
    // Minus nought becomes nought.
    (value + 0.0).to_bits()
}

/// Spreads keys over all bits: the finalizer of MurmurHash3.
fn scattered(key: [u64; 3]) -> u64 {
    key.into_iter().fold(0, |hash, word| {
        let mut h = (hash ^ word).wrapping_add(0x9E37_79B9_7F4A_7C15);
        h = (h ^ (h >> 33)).wrapping_mul(0xFF51_AFD7_ED55_8CCD);
        h = (h ^ (h >> 33)).wrapping_mul(0xC4CE_B9FE_1A85_EC53);
        h ^ (h >> 33)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exact_places_only() {
        let points = [(0.0, 1.0, 2.0), (0.0, 1.0, 2.0f64.next_up()), (-0.0, 1.0, 2.0), (0.0, 1.0, 2.0f64.next_up())];
        let points: Vec<DVec3> = points.into_iter().map(DVec3::from).collect();
        assert_eq!(first_at_same_place(4, |i| in_space(points[i])), [0, 1, 0, 1]);
        assert_eq!(first_at_same_place(4, |i| in_plan(points[i].truncate())), [0, 0, 0, 0]);
        assert!(first_at_same_place(0, |_| [0; 3]).is_empty());
    }
}
