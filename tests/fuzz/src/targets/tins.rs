//! Small triangulations drawn from choices.

use super::choices::Choices;
use glam::{DVec2, DVec3};
use slopegen::kernel::frame::Frame;
use slopegen::model::Terrain;
use spade::{DelaunayTriangulation, Point2, Triangulation as _};

/// A triangulation of whole numbers.
#[derive(Clone, Debug, Default)]
pub(crate) struct Whole {
    pub(crate) vertices: Vec<[i64; 3]>,
    /// Counter-clockwise, all with an area.
    pub(crate) triangles: Vec<[usize; 3]>,
}

/// A ground as an OBJ file.
pub(crate) fn obj(terrain: &Terrain) -> String {
    let vertices = terrain.vertices.iter().map(|v| format!("v {} {} {}\n", v.x, v.y, v.z));
    let faces = terrain.triangles.iter().map(|t| format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1));
    vertices.chain(faces).collect()
}

/// Twice the area of a triangle in plan.
pub(crate) fn twice([a, b, c]: [[i64; 3]; 3]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

impl Whole {
    pub(crate) fn corners(&self, t: usize) -> [[i64; 3]; 3] {
        self.triangles[t].map(|v| self.vertices[v])
    }

    /// The Delaunay triangulation of some points of a grid of `side` squares; some triangles may be missing.
    pub(crate) fn drawn(choices: &mut Choices<'_>, side: i64, rise: i64) -> Self {
        let n = 3 + choices.below(12);
        let mut vertices: Vec<[i64; 3]> = Vec::new();
        for _ in 0..n {
            let [x, y] = [0, 1].map(|_| choices.byte());
            let [x, y] = [x, y].map(|v| i64::from(v) % (side + 1));
            let z = i64::from(choices.byte()) % (2 * rise + 1) - rise;
            if !vertices.iter().any(|v| v[0] == x && v[1] == y) {
                vertices.push([x, y, z]);
            }
        }
        let triangles = match choices.below(4) {
            // Any three: they may lie on each other.
            0 => (0..1 + choices.below(4)).map(|_| [0; 3].map(|_| choices.below(vertices.len()))).collect(),
            _ => delaunay(&vertices),
        };
        let dropped = if choices.below(2) == 0 { 0 } else { choices.byte() };
        let mut whole = Self { vertices, triangles: Vec::new() };
        for (i, mut t) in triangles.into_iter().enumerate() {
            let area = twice(t.map(|v| whole.vertices[v]));
            if area < 0 {
                t.swap(1, 2);
            }
            if area != 0 && dropped >> (i % 8) & 1 == 0 {
                whole.triangles.push(t);
            }
        }
        whole
    }

    /// The same plan with other heights.
    pub(crate) fn other_heights(&self, choices: &mut Choices<'_>, rise: i64) -> Self {
        let mut other = self.clone();
        for v in &mut other.vertices {
            v[2] += i64::from(choices.byte()) % (2 * rise + 1) - rise;
        }
        other
    }

    /// The triangles whose boxes meet the box of another.
    pub(crate) fn near(&self, other: &Self) -> Self {
        let bound = |corners: &mut dyn Iterator<Item = [i64; 3]>| {
            corners.fold([i64::MAX, i64::MAX, i64::MIN, i64::MIN], |b, v| {
                [b[0].min(v[0]), b[1].min(v[1]), b[2].max(v[0]), b[3].max(v[1])]
            })
        };
        let all = bound(&mut (0..other.triangles.len()).flat_map(|t| other.corners(t)));
        let meets = |t: &[usize; 3]| {
            let own = bound(&mut t.iter().map(|&v| self.vertices[v]));
            own[0] <= all[2] && own[1] <= all[3] && own[2] >= all[0] && own[3] >= all[1]
        };
        Self { vertices: self.vertices.clone(), triangles: self.triangles.iter().copied().filter(meets).collect() }
    }

    /// In coordinates of the program; `far` from zero.
    pub(crate) fn terrain(&self, far: bool) -> Terrain {
        let (dx, dy) = if far { (500_000.0, 5_400_000.0) } else { (0.0, 0.0) };
        let vertices: Vec<DVec3> =
            self.vertices.iter().map(|v| DVec3::new(v[0] as f64 + dx, v[1] as f64 + dy, v[2] as f64)).collect();
        let (lo, hi) = vertices
            .iter()
            .fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(lo, hi), v| (lo.min(v.truncate()), hi.max(v.truncate())));
        let frame = if vertices.is_empty() { Frame::WORLD } else { Frame::around(lo, hi) };
        let vertices = vertices.into_iter().map(|v| frame.to_local(v)).collect();
        Terrain { frame, vertices, triangles: self.triangles.iter().map(|t| t.map(|v| v as u32)).collect() }
    }
}

fn delaunay(vertices: &[[i64; 3]]) -> Vec<[usize; 3]> {
    let mut mesh = DelaunayTriangulation::<Point2<f64>>::new();
    let mut number = vec![0; vertices.len()];
    for (i, v) in vertices.iter().enumerate() {
        let handle = mesh.insert(Point2::new(v[0] as f64, v[1] as f64)).expect("numbers are small");
        number[handle.index()] = i;
    }
    mesh.inner_faces().map(|f| f.vertices().map(|v| number[v.fix().index()])).collect()
}
