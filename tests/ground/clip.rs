//! Volume between two meshes, triangle by triangle: every pair is clipped in plan and split where the difference changes sign.

use crate::figures::Figures;
use crate::planar::above;
use crate::tin::{Cells, Ground, plan_box, twice_area};

/// Where heights differ by less there is no area: the program takes 1e-8 for none, and rounding of corners comes on top.
const SAME: f64 = 1e-7;

/// Cut (where `existing` is above) and fill (where `design` is), with the plan area the two have in common.
pub(crate) fn between(design: &Ground, existing: &Ground) -> (Figures, f64) {
    let Some(&[ox, oy, _]) = existing.vertices.first() else { return Default::default() };
    // Exact up to the digits of the given coordinates: neighbours in magnitude.
    let local = |[x, y, z]: [f64; 3]| [x - ox, y - oy, z];
    let (design, existing) = (design.map(local), existing.map(local));
    let cells = Cells::new(&existing);
    let (mut sums, mut common) = (Figures::default(), 0.0);
    for d in 0..design.triangles.len() {
        let top = design.corners(d);
        for e in cells.near(plan_box(top)) {
            let base = existing.corners(e);
            let piece = clipped(top, base);
            let heights: Vec<[f64; 3]> = piece.iter().map(|&[x, y, z]| [x, y, z - plane(base, x, y)]).collect();
            common += (2..piece.len()).map(|i| 0.5 * twice_area(piece[0], piece[i - 1], piece[i])).sum::<f64>();
            let (fill_area, fill) = above(&heights);
            let (cut_area, cut) = above(&heights.iter().map(|&[x, y, h]| [x, y, -h]).collect::<Vec<_>>());
            sums.fill += fill;
            sums.cut += cut;
            if heights.iter().any(|h| h[2].abs() > SAME) {
                sums.fill_area += fill_area;
                sums.cut_area += cut_area;
            }
        }
    }
    (sums, common)
}

/// Height of the plane through a triangle.
pub(crate) fn plane([a, b, c]: [[f64; 3]; 3], x: f64, y: f64) -> f64 {
    let whole = twice_area(a, b, c);
    let (v, w) = (twice_area(a, [x, y, 0.0], c) / whole, twice_area(a, b, [x, y, 0.0]) / whole);
    a[2] + v * (b[2] - a[2]) + w * (c[2] - a[2])
}

/// The part of a triangle over another one (Sutherland and Hodgman), with the heights of the first.
fn clipped(top: [[f64; 3]; 3], base: [[f64; 3]; 3]) -> Vec<[f64; 3]> {
    let mut piece = top.to_vec();
    for i in 0..3 {
        let side = |p: [f64; 3]| twice_area(base[i], base[(i + 1) % 3], p);
        let mut kept = Vec::with_capacity(piece.len() + 1);
        for (j, &p) in piece.iter().enumerate() {
            let q = piece[(j + 1) % piece.len()];
            let (s, t) = (side(p), side(q));
            if s >= 0.0 {
                kept.push(p);
            }
            if (s > 0.0 && t < 0.0) || (s < 0.0 && t > 0.0) {
                let w = s / (s - t);
                kept.push(std::array::from_fn(|c| p[c] + w * (q[c] - p[c])));
            }
        }
        piece = kept;
    }
    piece
}

/// A roof over a plane that cuts it at half its height, on other triangles: of the volume under the roof, `a²·h/3` for a pyramid
/// over the side `a`, an eighth is left above.
#[test]
fn a_pyramid_and_a_plane() {
    let design = Ground::grid([[-4.0, -4.0], [4.0, 4.0]], 2, 2, |x, y| 6.0 - 1.5 * x.abs().max(y.abs()));
    let existing = Ground::grid([[-7.0, -6.0], [9.0, 8.0]], 5, 3, |_, _| 3.0);
    let (found, common) = between(&design, &existing);
    let whole = 64.0 * 6.0 / 3.0;
    let (fill, fill_area) = (whole / 8.0, 16.0);
    let expected = Figures { cut: 64.0 * 3.0 - whole + fill, fill, cut_area: 48.0, fill_area };
    found.near(&expected, 1e-13, "pyramid");
    assert!((common - 64.0).abs() < 1e-12);
}
