//! Grounds made by rule, and points on them.

use crate::common::lines::Random;
use std::fmt::Write as _;

/// A triangulated ground, or any mesh. Triangles are counter-clockwise in plan.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ground {
    pub(crate) vertices: Vec<[f64; 3]>,
    pub(crate) triangles: Vec<[usize; 3]>,
}

/// A box in plan: lower left and upper right.
pub(crate) type Box2 = [[f64; 2]; 2];

/// The square of half width `half` about the origin.
pub(crate) fn about(half: f64) -> Box2 {
    [[-half, -half], [half, half]]
}

/// Twice the signed plan area of a triangle.
pub(crate) fn twice_area(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

impl Ground {
    /// A grid of `nx` by `ny` cells. Diagonals run through the nodes whose numbers add up to an even sum: a single such node
    /// that sticks out is a pyramid over the square of its eight neighbours.
    pub(crate) fn grid([lo, hi]: Box2, nx: usize, ny: usize, height: impl Fn(f64, f64) -> f64) -> Self {
        let at = |i: usize, n: usize, axis: usize| lo[axis] + (hi[axis] - lo[axis]) * i as f64 / n as f64;
        let mut ground = Self::default();
        for j in 0..=ny {
            for i in 0..=nx {
                let (x, y) = (at(i, nx, 0), at(j, ny, 1));
                ground.vertices.push([x, y, height(x, y)]);
            }
        }
        ground.add_cells(nx, ny, |i, j| (i + j) % 2 == 0);
        ground
    }

    /// The same with the inner nodes moved by up to a quarter of a cell and random diagonals. Heights are taken there, so that
    /// no vertex lies off the surface `height`.
    pub(crate) fn jittered(random: &mut Random, [lo, hi]: Box2, n: usize, height: impl Fn(f64, f64) -> f64) -> Self {
        let cell = [(hi[0] - lo[0]) / n as f64, (hi[1] - lo[1]) / n as f64];
        let mut ground = Self::default();
        for j in 0..=n {
            for i in 0..=n {
                let mut at = [lo[0] + cell[0] * i as f64, lo[1] + cell[1] * j as f64];
                for (axis, index) in [i, j].into_iter().enumerate() {
                    let shift = random.between(-0.25, 0.25);
                    if index > 0 && index < n {
                        at[axis] += shift * cell[axis];
                    }
                }
                ground.vertices.push([at[0], at[1], height(at[0], at[1])]);
            }
        }
        let diagonals: Vec<bool> = (0..n * n).map(|_| random.bits() & 1 == 0).collect();
        ground.add_cells(n, n, |i, j| diagonals[j * n + i]);
        ground
    }

    /// Triangles of all cells; `rising` tells whether the diagonal runs from the lower left corner.
    fn add_cells(&mut self, nx: usize, ny: usize, rising: impl Fn(usize, usize) -> bool) {
        for j in 0..ny {
            for i in 0..nx {
                let (a, b) = (j * (nx + 1) + i, j * (nx + 1) + i + 1);
                let (d, c) = (a + nx + 1, b + nx + 1);
                self.triangles.extend(if rising(i, j) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] });
            }
        }
    }

    /// Corners of a triangle.
    pub(crate) fn corners(&self, t: usize) -> [[f64; 3]; 3] {
        self.triangles[t].map(|v| self.vertices[v])
    }

    /// Plan area.
    pub(crate) fn plan_area(&self) -> f64 {
        let Some(&[x, y, _]) = self.vertices.first() else { return 0.0 };
        let about = |[px, py, z]: [f64; 3]| [px - x, py - y, z];
        (0..self.triangles.len()).map(|t| self.corners(t).map(about)).map(|[a, b, c]| 0.5 * twice_area(a, b, c)).sum()
    }

    /// Every vertex moved by a rule; triangles turned where the rule mirrors.
    pub(crate) fn map(&self, rule: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let mut ground = self.clone();
        ground.vertices.iter_mut().for_each(|v| *v = rule(*v));
        for t in 0..ground.triangles.len() {
            let [a, b, c] = ground.corners(t);
            if twice_area(a, b, c) < 0.0 {
                ground.triangles[t].swap(1, 2);
            }
        }
        ground
    }

    /// Every triangle split into six by its centroid and the midpoints of its edges: the same surface, up to the last digit.
    pub(crate) fn refined(&self) -> Self {
        let mut ground = Self { vertices: self.vertices.clone(), triangles: Vec::new() };
        let mut middles = std::collections::BTreeMap::new();
        for t in 0..self.triangles.len() {
            let (ids, [a, b, c]) = (self.triangles[t], self.corners(t));
            let centre = ground.vertices.len();
            ground.vertices.push(std::array::from_fn(|i| (a[i] + b[i] + c[i]) / 3.0));
            for i in 0..3 {
                let (v, w) = (ids[i], ids[(i + 1) % 3]);
                let middle = *middles.entry((v.min(w), v.max(w))).or_insert_with(|| {
                    let (p, q) = (self.vertices[v], self.vertices[w]);
                    ground.vertices.push(std::array::from_fn(|i| 0.5 * (p[i] + q[i])));
                    ground.vertices.len() - 1
                });
                ground.triangles.extend([[v, middle, centre], [middle, w, centre]]);
            }
        }
        ground
    }

    /// The triangles a test keeps; all vertices stay.
    pub(crate) fn only(&self, keep: impl Fn([[f64; 3]; 3]) -> bool) -> Self {
        let triangles = (0..self.triangles.len()).filter(|&t| keep(self.corners(t))).map(|t| self.triangles[t]).collect();
        Self { vertices: self.vertices.clone(), triangles }
    }

    /// Without the vertices no triangle uses.
    pub(crate) fn compact(&self) -> Self {
        let mut numbers = vec![None; self.vertices.len()];
        let mut compact = Self { vertices: Vec::new(), triangles: Vec::new() };
        for triangle in &self.triangles {
            compact.triangles.push(triangle.map(|v| {
                *numbers[v].get_or_insert_with(|| {
                    compact.vertices.push(self.vertices[v]);
                    compact.vertices.len() - 1
                })
            }));
        }
        compact
    }

    /// As OBJ text, numbers with all their digits.
    pub(crate) fn obj(&self) -> String {
        let mut text = String::from("# made by rule\n");
        for [x, y, z] in &self.vertices {
            writeln!(text, "v {x} {y} {z}").unwrap();
        }
        for [a, b, c] in &self.triangles {
            writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
        }
        text
    }

    /// As binary PLY with doubles.
    pub(crate) fn ply(&self) -> Vec<u8> {
        let mut bytes = format!(
            "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\n\
             element face {}\nproperty list uchar int vertex_indices\nend_header\n",
            self.vertices.len(),
            self.triangles.len()
        )
        .into_bytes();
        self.vertices.iter().flatten().for_each(|v| bytes.extend(v.to_le_bytes()));
        for t in &self.triangles {
            bytes.push(3);
            t.iter().for_each(|&v| bytes.extend((v as u32).to_le_bytes()));
        }
        bytes
    }
}

/// Lists of triangles by cell, for finding those near a point or a box.
pub(crate) struct Cells {
    lo: [f64; 2],
    size: f64,
    across: [usize; 2],
    cells: Vec<Vec<usize>>,
}

impl Cells {
    pub(crate) fn new(ground: &Ground) -> Self {
        let bound =
            |axis: usize, most: fn(f64, f64) -> f64, start: f64| ground.vertices.iter().map(|v| v[axis]).fold(start, most);
        let lo = [0, 1].map(|axis| bound(axis, f64::min, f64::INFINITY));
        let hi = [0, 1].map(|axis| bound(axis, f64::max, f64::NEG_INFINITY));
        let (w, h) = (hi[0] - lo[0], hi[1] - lo[1]);
        let size = (w * h / (ground.triangles.len() as f64 + 1.0)).sqrt().max(w.max(h) / 2000.0).max(1e-9);
        let across = [w, h].map(|d| (d / size) as usize + 1);
        let mut index = Self { lo, size, across, cells: vec![Vec::new(); across[0] * across[1]] };
        for t in 0..ground.triangles.len() {
            for cell in index.under(plan_box(ground.corners(t))) {
                index.cells[cell].push(t);
            }
        }
        index
    }

    fn cell(&self, axis: usize, value: f64) -> usize {
        (((value - self.lo[axis]) / self.size).max(0.0) as usize).min(self.across[axis] - 1)
    }

    fn under(&self, [lo, hi]: Box2) -> Vec<usize> {
        let [x, y] = [0, 1].map(|axis| self.cell(axis, lo[axis])..=self.cell(axis, hi[axis]));
        y.flat_map(|j| x.clone().map(move |i| (i, j))).map(|(i, j)| j * self.across[0] + i).collect()
    }

    /// Triangles whose cells a box meets, each once, in order.
    pub(crate) fn near(&self, area: Box2) -> Vec<usize> {
        let mut found: Vec<usize> = self.under(area).into_iter().flat_map(|c| self.cells[c].iter().copied()).collect();
        found.sort_unstable();
        found.dedup();
        found
    }

    /// Height of the surface over a point, from the triangle the point is deepest in; `None` beside it by more than `slack`, a
    /// plan length.
    pub(crate) fn height(&self, ground: &Ground, x: f64, y: f64, slack: f64) -> Option<f64> {
        let p = [x, y, 0.0];
        let mut best: Option<(f64, f64)> = None;
        for t in self.near([[x - slack, y - slack], [x + slack, y + slack]]) {
            let corners = ground.corners(t);
            let [a, b, c] = corners;
            let whole = twice_area(a, b, c);
            let parts = [twice_area(p, b, c), twice_area(a, p, c), twice_area(a, b, p)];
            // Distance to the lines of the three sides, negative outside.
            let inside = (0..3)
                .map(|i| {
                    let (q, r) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
                    parts[i] / (q[0] - r[0]).hypot(q[1] - r[1])
                })
                .fold(f64::INFINITY, f64::min);
            if whole > 0.0 && inside >= -slack && best.is_none_or(|(deepest, _)| inside > deepest) {
                best = Some((inside, (parts[0] * a[2] + parts[1] * b[2] + parts[2] * c[2]) / whole));
            }
        }
        best.map(|(_, z)| z)
    }
}

/// Plan box of a triangle.
pub(crate) fn plan_box(corners: [[f64; 3]; 3]) -> Box2 {
    let of = |axis: usize, most: fn(f64, f64) -> f64| corners[1..].iter().map(|c| c[axis]).fold(corners[0][axis], most);
    [[of(0, f64::min), of(1, f64::min)], [of(0, f64::max), of(1, f64::max)]]
}

#[test]
fn grounds_cover_their_box() {
    let random = &mut Random::new(3);
    for ground in [Ground::grid(about(5.0), 4, 6, |x, y| x + y), Ground::jittered(random, about(5.0), 7, |x, y| x + y)] {
        for ground in [ground.refined(), ground.map(|[x, y, z]| [-x, y, z]), ground] {
            assert!((ground.plan_area() - 100.0).abs() < 1e-12);
            assert!((0..ground.triangles.len()).map(|t| ground.corners(t)).all(|[a, b, c]| twice_area(a, b, c) > 0.0));
        }
    }
    let ground = Ground::jittered(random, about(5.0), 9, |x, y| 0.5 * x - 2.0 * y);
    let cells = Cells::new(&ground);
    for _ in 0..500 {
        let (x, y) = (random.between(-5.0, 5.0), random.between(-5.0, 5.0));
        assert!((cells.height(&ground, x, y, 1e-9).unwrap() - (0.5 * x - 2.0 * y)).abs() < 1e-12);
    }
    assert_eq!(cells.height(&ground, 5.1, 0.0, 1e-9), None);
}
