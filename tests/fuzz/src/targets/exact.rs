//! Volumes between triangles of whole numbers, clipped in exact fractions.
//!
//! Every corner of a cell is a given vertex or the crossing of two given edges, a fraction of small numbers. Areas, heights and
//! differences of heights are exact; only the last products and the sums are rounded.

use super::tins::{Whole, twice};

/// A point of the plan: `x/w`, `y/w`, with `w` positive.
#[derive(Clone, Copy, Debug)]
struct Point {
    x: i128,
    y: i128,
    w: i128,
}

/// What lies between two surfaces.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Sums {
    pub(crate) cut: f64,
    pub(crate) fill: f64,
    pub(crate) common: f64,
    /// Greatest height of the one and the other.
    pub(crate) deepest_cut: f64,
    pub(crate) deepest_fill: f64,
}

type Triangle = [[i64; 3]; 3];

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs() } else { gcd(b, a % b) }
}

fn reduced(x: i128, y: i128, w: i128) -> Point {
    let g = gcd(gcd(x, y), w);
    Point { x: x / g, y: y / g, w: w / g }
}

/// The part of a convex polygon over a triangle.
fn clipped(mut polygon: Vec<Point>, triangle: Triangle) -> Vec<Point> {
    for i in 0..3 {
        let [a, b] = [triangle[i], triangle[(i + 1) % 3]].map(|p| [i128::from(p[0]), i128::from(p[1])]);
        let side = |p: &Point| (b[0] - a[0]) * (p.y - a[1] * p.w) - (b[1] - a[1]) * (p.x - a[0] * p.w);
        let mut kept = Vec::new();
        for (j, p) in polygon.iter().enumerate() {
            let q = &polygon[(j + 1) % polygon.len()];
            let (s, t) = (side(p), side(q));
            if s >= 0 {
                kept.push(*p);
            }
            if (s > 0 && t < 0) || (s < 0 && t > 0) {
                let sign = if s > 0 { 1 } else { -1 };
                let of = |p: i128, q: i128| sign * (q * s - p * t);
                kept.push(reduced(of(p.x, q.x), of(p.y, q.y), of(p.w, q.w)));
            }
        }
        polygon = kept;
    }
    polygon
}

fn points(triangle: Triangle) -> Vec<Point> {
    triangle.iter().map(|p| Point { x: p[0].into(), y: p[1].into(), w: 1 }).collect()
}

/// Height of the plane of a triangle at a point, times `w` and twice the area of the triangle.
fn height(triangle: Triangle, p: &Point) -> i128 {
    let [a, b, c] = triangle.map(|v| v.map(i128::from));
    let (u, v) = ([b[0] - a[0], b[1] - a[1], b[2] - a[2]], [c[0] - a[0], c[1] - a[1], c[2] - a[2]]);
    let (dx, dy) = (p.x - a[0] * p.w, p.y - a[1] * p.w);
    let area = u[0] * v[1] - u[1] * v[0];
    a[2] * area * p.w + (u[2] * v[1] - u[1] * v[2]) * dx + (u[0] * v[2] - u[2] * v[0]) * dy
}

/// Twice the area of a triangle times all three `w`.
fn cross([a, b, c]: [Point; 3]) -> i128 {
    a.x * (b.y * c.w - c.y * b.w) - a.y * (b.x * c.w - c.x * b.w) + a.w * (b.x * c.y - c.x * b.y)
}

/// Height of one point and the differences to the two others, each rounded once.
struct Corner {
    h: f64,
    less: [f64; 2],
}

impl Sums {
    /// Adds a cell; `h` times `w` and `unit` is the height of design over existing.
    fn cell(&mut self, polygon: &[Point], h: &[i128], unit: i128) {
        // Those that only touch have no depth.
        if !(2..polygon.len()).any(|i| cross([0, i - 1, i].map(|i| polygon[i])) > 0) {
            return;
        }
        let value = |i: usize| h[i] as f64 / (polygon[i].w * unit) as f64;
        for i in 0..polygon.len() {
            self.deepest_fill = self.deepest_fill.max(value(i));
            self.deepest_cut = self.deepest_cut.max(-value(i));
        }
        for i in 2..polygon.len() {
            let t = [0, i - 1, i];
            let [a, b, c] = t.map(|i| polygon[i]);
            let cross = cross([a, b, c]);
            assert!(cross >= 0, "a cell is convex");
            let area = cross as f64 / (a.w * b.w * c.w) as f64 / 2.0;
            self.common += area;
            let difference = |i: usize, j: usize| {
                let (p, q) = (polygon[i].w, polygon[j].w);
                (h[i] * q - h[j] * p) as f64 / (p * q * unit) as f64
            };
            let corner = |i: usize| Corner { h: value(t[i]), less: [1, 2].map(|d| difference(t[i], t[(i + d) % 3])) };
            self.fill += positive(area, [0, 1, 2].map(corner), 1.0);
            self.cut += positive(area, [0, 1, 2].map(corner), -1.0);
        }
    }
}

/// Integral of `max(sign·h, 0)` over a triangle: pyramids over the corners that stand alone.
fn positive(area: f64, corners: [Corner; 3], sign: f64) -> f64 {
    let up: Vec<usize> = (0..3).filter(|&i| sign * corners[i].h > 0.0).collect();
    let whole = area * sign * (corners[0].h + corners[1].h + corners[2].h) / 3.0;
    let alone = |c: &Corner| area * c.h / 3.0 * (c.h / c.less[0]) * (c.h / c.less[1]);
    match up[..] {
        [] => 0.0,
        [i] => sign * alone(&corners[i]),
        [i, j] => {
            let k = 3 - i - j;
            if corners[k].h == 0.0 { whole } else { whole - sign * alone(&corners[k]) }
        }
        _ => whole,
    }
}

/// Cut and fill between two surfaces, within a third if there is one.
pub(crate) fn between(design: &Whole, existing: &Whole, within: Option<&Whole>) -> Sums {
    let mut sums = Sums::default();
    for d in (0..design.triangles.len()).map(|t| design.corners(t)) {
        for e in (0..existing.triangles.len()).map(|t| existing.corners(t)) {
            let cell = clipped(points(d), e);
            let (of_d, of_e) = (i128::from(twice(d)), i128::from(twice(e)));
            let mut add = |cell: &[Point]| {
                let h: Vec<i128> = cell.iter().map(|p| height(d, p) * of_e - height(e, p) * of_d).collect();
                sums.cell(cell, &h, of_d * of_e);
            };
            match within {
                None => add(&cell),
                Some(area) => (0..area.triangles.len()).for_each(|t| add(&clipped(cell.clone(), area.corners(t)))),
            }
        }
    }
    sums
}

/// Plan area in which triangles lie on each other, each pair for itself.
pub(crate) fn double(mesh: &Whole) -> f64 {
    let mut area = 0.0;
    for i in 0..mesh.triangles.len() {
        for j in 0..i {
            let cell = clipped(points(mesh.corners(i)), mesh.corners(j));
            let mut sums = Sums::default();
            sums.cell(&cell, &vec![0; cell.len()], 1);
            area += sums.common;
        }
    }
    area
}

/// Plan area of all triangles.
pub(crate) fn area(mesh: &Whole) -> f64 {
    (0..mesh.triangles.len()).map(|t| twice(mesh.corners(t)) as f64 / 2.0).sum()
}
