//! A hash of a mesh as a surface: the same for the same triangles, in whatever order and numbering.

use crate::kernel::buckets::Buckets;
use crate::kernel::hash::hex;
use crate::kernel::range::range;
use crate::model::Tin;
use glam::DVec3;
use sha2::{Digest, Sha256};
use std::cmp::Ordering;

/// First bytes of what is hashed: name and version of the form.
const HEAD: &[u8] = b"slopegen-mesh/1\n";

/// SHA-256 of a mesh in its canonical form, in lower-case hexadecimal digits.
///
/// The form, all numbers little-endian: the text `slopegen-mesh/1` and a line feed; the number of vertices and the number of
/// triangles (64-bit whole numbers); the vertices some triangle uses, in world coordinates (three doubles each, −0 as 0), ascending by
/// x, then y, then z, each place once; the triangles as three numbers of vertices in that order, counted from 0 (32-bit whole
/// numbers), each beginning with its least and turning as given, then its part (one byte), ascending by the three numbers and the
/// part.
pub fn fingerprint(tin: &Tin) -> String {
    let places = places(tin);
    let (rank, distinct) = ranks(tin, &places);
    let mut hash = Sha256::new();
    hash.update(HEAD);
    hash.update((distinct as u64).to_le_bytes());
    hash.update((tin.triangles.len() as u64).to_le_bytes());
    in_blocks(&mut hash, each_place(&places), |bytes, same| {
        same[0].0.to_array().iter().for_each(|c| bytes.extend(c.to_le_bytes()));
    });
    drop(places);
    let triangles = triangles(tin, &rank, distinct);
    in_blocks(&mut hash, triangles.iter(), |bytes, triangle| {
        for digits in [96, 64, 32] {
            bytes.extend(((triangle >> digits) as u32).to_le_bytes());
        }
        bytes.push(*triangle as u8);
    });
    hex(&hash.finalize())
}

/// The vertices in use, in world coordinates, ascending, each with its number.
fn places(tin: &Tin) -> Vec<(DVec3, u32)> {
    let mut used = vec![false; tin.vertices.len()];
    tin.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    let used: Vec<u32> = (0..tin.vertices.len() as u32).filter(|&v| used[v as usize]).collect();
    // Adding nought makes 0 of −0.
    let place = |v: u32| tin.world(v as usize) + DVec3::ZERO;
    let (lo, hi) = range(used.iter().map(|&v| place(v).x));
    // Ascends with x, whatever the rounding. Where all have the same x it is not a number, and all go into the first strip.
    let strips = used.len() / BUCKET + 1;
    let strip = |p: DVec3| ((strips as f64 * ((p.x - lo) / (hi - lo))) as usize).min(strips - 1);
    sorted(strips, used.iter().map(|&v| (place(v), v)), |&(p, _)| strip(p), |(a, _), (b, _)| compare(*a, *b))
}

/// The vertices of `places` in groups of the same place.
fn each_place(places: &[(DVec3, u32)]) -> impl Iterator<Item = &[(DVec3, u32)]> {
    places.chunk_by(|(a, _), (b, _)| compare(*a, *b).is_eq())
}

/// Of each vertex the number of its place, of those not in use any; and how many places there are.
fn ranks(tin: &Tin, places: &[(DVec3, u32)]) -> (Vec<u32>, usize) {
    let mut rank = vec![0; tin.vertices.len()];
    let mut count = 0;
    for same in each_place(places) {
        same.iter().for_each(|&(_, v)| rank[v as usize] = count as u32);
        count += 1;
    }
    (rank, count)
}

/// The triangles, ascending, each as one number: the three numbers of its places (32 bits each), 24 bits of nought, its part.
fn triangles(tin: &Tin, rank: &[u32], places: usize) -> Vec<u128> {
    let numbered = tin.triangles.iter().zip(&tin.parts).map(|(corners, part)| {
        let corners = least_first(corners.map(|v| rank[v as usize])).into_iter();
        corners.fold(0, |number, v| (number << 32) | u128::from(v)) << 32 | *part as u128
    });
    sorted(places / BUCKET + 1, numbered, |number| (number >> 96) as usize / BUCKET, u128::cmp)
}

/// Items in a bucket, on average: few enough to be sorted within the cache.
const BUCKET: usize = 1 << 12;

/// Items in order. `bucket` gives each a number below `buckets`, which ascends in that order: they are put into their buckets first,
/// and then each bucket is sorted, which takes half the time of sorting all at once.
fn sorted<T: Copy + Default + Send>(
    buckets: usize,
    items: impl Iterator<Item = T> + Clone,
    bucket: impl Fn(&T) -> usize,
    compare: impl Fn(&T, &T) -> Ordering + Sync,
) -> Vec<T> {
    let mut sorted = Buckets::new(buckets, items.map(|item| (bucket(&item) as u32, item)));
    sorted.sort_each(compare);
    sorted.into_things()
}

fn compare(a: DVec3, b: DVec3) -> Ordering {
    a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)).then(a.z.total_cmp(&b.z))
}

fn least_first([a, b, c]: [u32; 3]) -> [u32; 3] {
    if a <= b && a <= c {
        [a, b, c]
    } else if b <= c {
        [b, c, a]
    } else {
        [c, a, b]
    }
}

/// Feeds items to a hash through a buffer: one update for each number would take longer than the hash.
fn in_blocks<T>(hash: &mut Sha256, items: impl Iterator<Item = T>, mut put: impl FnMut(&mut Vec<u8>, T)) {
    /// Bytes in a block.
    const BLOCK: usize = 1 << 16;
    let mut bytes = Vec::new();
    for item in items {
        put(&mut bytes, item);
        if bytes.len() >= BLOCK {
            hash.update(&bytes);
            bytes.clear();
        }
    }
    hash.update(&bytes);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;
    use crate::model::Part;

    fn tin(vertices: &[[f64; 3]], triangles: &[[u32; 3]], parts: &[Part]) -> Tin {
        let vertices = vertices.iter().map(|&v| DVec3::from(v)).collect();
        Tin { frame: Frame::WORLD, vertices, triangles: triangles.to_vec(), parts: parts.to_vec() }
    }

    const CORNERS: [[f64; 3]; 4] = [[0.0, 0.0, 1.0], [2.0, 0.0, 1.5], [2.0, 2.0, -0.0], [0.0, 2.0, 3.0]];

    fn square() -> Tin {
        tin(&CORNERS, &[[0, 1, 2], [0, 2, 3]], &[Part::Platform, Part::CutSlope])
    }

    /// What the doc comment says, byte by byte.
    #[test]
    fn the_form_is_the_one_described() {
        let mut bytes = b"slopegen-mesh/1\n".to_vec();
        bytes.extend([4, 0, 0, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0, 0, 0, 0]);
        // Places ascending: corners 0, 3, 1, 2, but (2, 0) before (2, 2).
        for place in [[0.0, 0.0, 1.0], [0.0, 2.0, 3.0], [2.0, 0.0, 1.5], [2.0, 2.0, 0.0_f64]] {
            place.iter().for_each(|c| bytes.extend(c.to_bits().to_le_bytes()));
        }
        for (corners, part) in [([0_u32, 2, 3], 0_u8), ([0, 3, 1], 2)] {
            corners.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
            bytes.push(part);
        }
        assert_eq!(fingerprint(&square()), hex(&Sha256::digest(&bytes)));
    }

    #[test]
    fn order_and_numbering_do_not_matter() {
        let expected = fingerprint(&square());
        let turned = tin(&CORNERS, &[[2, 3, 0], [2, 0, 1]], &[Part::CutSlope, Part::Platform]);
        // Other numbers, a vertex nobody uses, and one that is there twice.
        let others = [[9.0, 9.0, 9.0], CORNERS[2], CORNERS[0], CORNERS[3], CORNERS[1], CORNERS[2]];
        let renumbered = tin(&others, &[[5, 3, 2], [4, 1, 2]], &[Part::CutSlope, Part::Platform]);
        let frame = Frame::around(glam::DVec2::new(1e6, 1e6), glam::DVec2::new(1e6 + 1.0, 1e6 + 1.0));
        let mut shifted = square();
        shifted.frame = frame;
        shifted.vertices.iter_mut().for_each(|v| *v = frame.to_local(*v));
        for (name, same) in [("turned", turned), ("renumbered", renumbered), ("shifted", shifted)] {
            assert_eq!(fingerprint(&same), expected, "{name}");
        }
    }

    #[test]
    fn whatever_differs_shows() {
        let expected = fingerprint(&square());
        let mut moved = square();
        moved.vertices[1].z = f64::from_bits(moved.vertices[1].z.to_bits() + 1);
        let mut other_part = square();
        other_part.parts[0] = Part::FillSlope;
        let mut other_diagonal = square();
        other_diagonal.triangles = vec![[0, 1, 3], [1, 2, 3]];
        let mut turned_over = square();
        turned_over.triangles[0] = [0, 2, 1];
        let mut missing = square();
        missing.triangles.pop();
        missing.parts.pop();
        for (name, other) in [
            ("a bit of a height", moved),
            ("a part", other_part),
            ("a diagonal", other_diagonal),
            ("a side", turned_over),
            ("a triangle less", missing),
        ] {
            assert_ne!(fingerprint(&other), expected, "{name}");
        }
    }
}
