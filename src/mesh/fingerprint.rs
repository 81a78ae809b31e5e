//! A hash of a mesh as a surface: the same for the same triangles, in whatever order and numbering.

use crate::kernel::hash::hex;
use crate::model::Tin;
use glam::DVec3;
use rayon::prelude::*;
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
    let (vertices, rank) = ranked(tin);
    let mut triangles: Vec<([u32; 3], u8)> = tin
        .triangles
        .par_iter()
        .zip(&tin.parts)
        .map(|(corners, part)| (least_first(corners.map(|v| rank[v as usize])), *part as u8))
        .collect();
    triangles.par_sort_unstable();
    let mut hash = Sha256::new();
    hash.update(HEAD);
    hash.update((vertices.len() as u64).to_le_bytes());
    hash.update((triangles.len() as u64).to_le_bytes());
    in_blocks(&mut hash, &vertices, |bytes, v| v.to_array().iter().for_each(|c| bytes.extend(c.to_le_bytes())));
    in_blocks(&mut hash, &triangles, |bytes, (corners, part)| {
        corners.iter().for_each(|c| bytes.extend(c.to_le_bytes()));
        bytes.push(*part);
    });
    hex(&hash.finalize())
}

/// The places of the vertices in use, ascending, and of each vertex the number of its place; of those not in use any.
fn ranked(tin: &Tin) -> (Vec<DVec3>, Vec<u32>) {
    let mut used = vec![false; tin.vertices.len()];
    tin.triangles.iter().flatten().for_each(|&v| used[v as usize] = true);
    // Adding nought makes 0 of −0.
    let place = |v: u32| tin.world(v as usize) + DVec3::ZERO;
    let mut order: Vec<u32> = (0..tin.vertices.len() as u32).filter(|&v| used[v as usize]).collect();
    order.par_sort_unstable_by(|&a, &b| compare(place(a), place(b)));
    let mut places: Vec<DVec3> = Vec::with_capacity(order.len());
    let mut rank = vec![0; tin.vertices.len()];
    for v in order {
        let p = place(v);
        if places.last().is_none_or(|last| compare(*last, p) != Ordering::Equal) {
            places.push(p);
        }
        rank[v as usize] = places.len() as u32 - 1;
    }
    (places, rank)
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
fn in_blocks<T>(hash: &mut Sha256, items: &[T], mut put: impl FnMut(&mut Vec<u8>, &T)) {
    /// Items in a block.
    const BLOCK: usize = 4096;
    let mut bytes = Vec::new();
    for block in items.chunks(BLOCK) {
        bytes.clear();
        block.iter().for_each(|item| put(&mut bytes, item));
        hash.update(&bytes);
    }
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
