//! Triangles to look at: cut to a box, thinned to a number a page can carry. Figures never come from here.

use crate::kernel::plan_box::PlanBox;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;

/// Triangles with a value at each vertex, for colours; no values: one colour.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Soup {
    pub(super) vertices: Vec<DVec3>,
    pub(super) values: Vec<f64>,
    pub(super) triangles: Vec<[u32; 3]>,
}

/// More triangles than a page should hold; a box that grows by this factor takes half as many.
const COARSER: f64 = std::f64::consts::SQRT_2;

/// Steps after which every mesh has become one cell.
const MOST_STEPS: usize = 200;

impl Soup {
    /// The part of a mesh inside a plan box. Triangles across its edge are cut there.
    pub(super) fn clipped(vertices: &[DVec3], triangles: &[[u32; 3]], PlanBox { lo, hi }: PlanBox) -> Self {
        let mut soup = Self::default();
        let mut numbers: FxHashMap<u32, u32> = FxHashMap::default();
        for triangle in triangles {
            let corners = triangle.map(|v| vertices[v as usize]);
            let PlanBox { lo: least, hi: most } = PlanBox::of(corners.map(|c| c.truncate()));
            if most.cmplt(lo).any() || least.cmpgt(hi).any() {
                continue;
            }
            if least.cmpge(lo).all() && most.cmple(hi).all() {
                soup.triangles.push(triangle.map(|v| {
                    *numbers.entry(v).or_insert_with(|| {
                        soup.vertices.push(vertices[v as usize]);
                        (soup.vertices.len() - 1) as u32
                    })
                }));
                continue;
            }
            let mut outline = corners.to_vec();
            for (axis, sign, bound) in [(0, 1.0, lo.x), (0, -1.0, hi.x), (1, 1.0, lo.y), (1, -1.0, hi.y)] {
                outline = half(&outline, |p| sign * (p[axis] - bound));
            }
            soup.fan(&outline);
        }
        soup
    }

    /// Adds a convex outline.
    fn fan(&mut self, outline: &[DVec3]) {
        let first = self.vertices.len() as u32;
        self.vertices.extend_from_slice(outline);
        self.triangles.extend((2..outline.len() as u32).map(|i| [first, first + i - 1, first + i]));
    }

    /// At most `most` triangles: of all vertices in one cell of a grid the first speaks for all, and triangles that shrink to an
    /// edge go. Returns the side of the cells, if there had to be any.
    pub(super) fn thin(&mut self, most: usize) -> Option<f64> {
        if self.triangles.len() <= most {
            return None;
        }
        let PlanBox { lo, hi } = PlanBox::of(self.vertices.iter().map(|v| v.truncate()));
        let size = hi - lo;
        // A grid of cells has two triangles for each.
        let mut cell = (2.0 * size.x * size.y / most.max(1) as f64).sqrt().max(size.max_element() / most.max(1) as f64);
        for _ in 0..MOST_STEPS {
            let merged = self.merged(lo, cell);
            let kept =
                self.triangles.iter().map(|t| t.map(|v| merged[v as usize])).filter(|[a, b, c]| a != b && b != c && c != a);
            if kept.clone().count() <= most {
                self.triangles = kept.collect();
                self.pack();
                return Some(cell);
            }
            cell *= COARSER;
        }
        *self = Self::default();
        Some(size.max_element())
    }

    /// For every vertex the first one in its cell.
    fn merged(&self, lo: DVec2, cell: f64) -> Vec<u32> {
        let mut first: FxHashMap<(i64, i64), u32> = FxHashMap::default();
        let key = |v: &DVec3| {
            let at = (v.truncate() - lo) / cell;
            (at.x.floor() as i64, at.y.floor() as i64)
        };
        self.vertices.iter().zip(0..).map(|(v, i)| *first.entry(key(v)).or_insert(i)).collect()
    }

    /// Drops vertices no triangle uses.
    fn pack(&mut self) {
        let mut numbers = vec![u32::MAX; self.vertices.len()];
        let (mut vertices, mut values) = (Vec::new(), Vec::new());
        for v in self.triangles.iter_mut().flatten() {
            let number = &mut numbers[*v as usize];
            if *number == u32::MAX {
                *number = vertices.len() as u32;
                vertices.push(self.vertices[*v as usize]);
                values.extend(self.values.get(*v as usize));
            }
            *v = *number;
        }
        (self.vertices, self.values) = (vertices, values);
    }
}

/// The part of a convex outline where `inside` is not negative; it is linear.
fn half(outline: &[DVec3], inside: impl Fn(DVec3) -> f64) -> Vec<DVec3> {
    let mut kept = Vec::with_capacity(outline.len() + 1);
    for (i, &p) in outline.iter().enumerate() {
        let q = outline[(i + 1) % outline.len()];
        let (a, b) = (inside(p), inside(q));
        if a >= 0.0 {
            kept.push(p);
        }
        if (a > 0.0 && b < 0.0) || (a < 0.0 && b > 0.0) {
            kept.push(p.lerp(q, a / (a - b)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area(soup: &Soup) -> f64 {
        let plan = |i: u32| soup.vertices[i as usize].truncate();
        soup.triangles.iter().map(|&[a, b, c]| 0.5 * (plan(b) - plan(a)).perp_dot(plan(c) - plan(a))).sum()
    }

    /// A grid of `n` × `n` squares of side 1, heights x + 2y.
    fn grid(n: u32) -> (Vec<DVec3>, Vec<[u32; 3]>) {
        let at = |i: u32, j: u32| i * (n + 1) + j;
        let place = |k: u32| DVec2::new(f64::from(k / (n + 1)), f64::from(k % (n + 1)));
        let vertices = (0..(n + 1) * (n + 1)).map(place).map(|p| p.extend(p.x + 2.0 * p.y)).collect();
        let squares = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
        let triangles =
            squares.flat_map(|(i, j)| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]]);
        (vertices, triangles.collect())
    }

    #[test]
    fn a_box_cuts_a_mesh_to_its_own_area_and_plane() {
        let (vertices, triangles) = grid(10);
        let within = PlanBox { lo: DVec2::new(2.25, 3.5), hi: DVec2::new(7.75, 8.125) };
        let soup = Soup::clipped(&vertices, &triangles, within);
        assert!((area(&soup) - 5.5 * 4.625).abs() < 1e-12);
        assert!(soup.vertices.iter().all(|v| PlanBox::of([v.truncate()]).meets(&within)));
        assert!(soup.vertices.iter().all(|v| (v.z - v.x - 2.0 * v.y).abs() < 1e-12));
        // One triangle around the whole box becomes the box.
        let around = [DVec3::new(-100.0, -100.0, 5.0), DVec3::new(300.0, -100.0, 5.0), DVec3::new(0.0, 300.0, 5.0)];
        assert!((area(&Soup::clipped(&around, &[[0, 1, 2]], within)) - 5.5 * 4.625).abs() < 1e-9);
        assert_eq!(
            Soup::clipped(&vertices, &triangles, PlanBox { lo: DVec2::splat(20.0), hi: DVec2::splat(30.0) }),
            Soup::default()
        );
    }

    #[test]
    fn few_triangles_stay_and_many_are_thinned() {
        let (vertices, triangles) = grid(60);
        let values: Vec<f64> = vertices.iter().map(|v| v.z).collect();
        let whole = Soup { vertices, values, triangles };
        let mut soup = whole.clone();
        assert_eq!(soup.thin(7200), None);
        assert_eq!(soup, whole);
        for most in [7199, 1000, 50, 2, 0] {
            let mut soup = whole.clone();
            let cell = soup.thin(most).unwrap();
            assert!(soup.triangles.len() <= most && cell > 0.0, "{most}: {}", soup.triangles.len());
            assert!(soup.triangles.iter().flatten().all(|&v| (v as usize) < soup.vertices.len()));
            assert_eq!(soup.vertices.len(), soup.values.len());
            // What is left are vertices of the mesh, with their values.
            assert!(soup.vertices.iter().zip(&soup.values).all(|(v, value)| v.z == *value));
            if most >= 1000 {
                assert!(soup.triangles.len() * 4 > most && area(&soup) > 0.8 * 3600.0, "{most}: {}", area(&soup));
            }
        }
        // All on one line in plan: nothing to divide by.
        let mut line =
            Soup { vertices: vec![DVec3::ZERO, DVec3::Z, DVec3::NEG_Z], values: vec![], triangles: vec![[0, 1, 2]; 9] };
        assert!(line.thin(3).is_some() && line.triangles.is_empty());
    }
}
