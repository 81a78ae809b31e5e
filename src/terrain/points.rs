//! Points and grids → triangles.

use super::place::{counted, defect, point, short};
use crate::model::{Defects, Note, Terrain};
use crate::read::terrain::RawGrid;
use glam::{DVec2, DVec3};
use rustc_hash::FxHashMap;
use spade::{DelaunayTriangulation, HasPosition, Point2, Triangulation};

/// A point for the triangulation.
struct Vertex {
    position: Point2<f64>,
    id: u32,
}

impl HasPosition for Vertex {
    type Scalar = f64;

    fn position(&self) -> Point2<f64> {
        self.position
    }
}

/// The Delaunay triangulation of the vertices of `terrain`, in a fixed order. Of points at one place the first is used.
/// Coordinates so small that the triangulation refuses them, far below any resolution, become nought.
pub(super) fn triangulate(label: &str, terrain: &mut Terrain, notes: &mut Vec<Note>) -> Result<Vec<[u32; 3]>, Defects> {
    for value in terrain.vertices.iter_mut().flat_map(|p| [&mut p.x, &mut p.y]) {
        // Minus nought too: points are compared by their bits.
        if value.abs() < spade::MIN_ALLOWED_VALUE {
            *value = 0.0;
        }
    }
    let terrain = &*terrain;
    let points = &terrain.vertices;
    let vertices: Vec<Vertex> =
        points.iter().enumerate().map(|(i, p)| Vertex { position: Point2::new(p.x, p.y), id: i as u32 }).collect();
    let triangulation = DelaunayTriangulation::<Vertex>::bulk_load(vertices).map_err(|cause| {
        let help = "correct the coordinates";
        defect("ground-points", "the points of the ground cannot be triangulated", label.into(), cause.to_string(), help)
    })?;
    let first = if triangulation.num_vertices() < points.len() { Some(firsts(terrain, notes)) } else { None };
    let number = |v: u32| first.as_ref().map_or(v, |first| first[v as usize]);
    let mut longest = (0.0, DVec3::ZERO);
    let mut triangles = Vec::with_capacity(triangulation.num_inner_faces());
    for face in triangulation.inner_faces() {
        let t = face.vertices().map(|v| number(v.data().id));
        for i in 0..3 {
            let (a, b) = (points[t[i] as usize], points[t[(i + 1) % 3] as usize]);
            let length = a.truncate().distance_squared(b.truncate());
            if length > longest.0 {
                longest = (length, 0.5 * (a + b));
            }
        }
        triangles.push(t);
    }
    if triangles.is_empty() {
        let figures = format!("{}, all on one line", counted(triangulation.num_vertices(), "place", "places"));
        let help = "give at least three points that are not on one line";
        return Err(defect("ground-points", "the points of the ground make no surface", label.into(), figures, help));
    }
    let message = format!(
        "{} were triangulated (Delaunay) as far as their outer hull; the longest edge is {}, at {}",
        counted(points.len(), "point", "points"),
        short(longest.0.sqrt()),
        point(terrain.frame.to_world(longest.1))
    );
    notes.push(Note::new("ground-triangulated", message));
    Ok(triangles)
}

/// For each point the first at its place; tells of the others.
fn firsts(terrain: &Terrain, notes: &mut Vec<Note>) -> Vec<u32> {
    let mut places: FxHashMap<[u64; 2], u32> = FxHashMap::default();
    let (mut same, mut other) = (0, 0);
    let mut worst = (0.0, 0, 0);
    let mut first = Vec::with_capacity(terrain.vertices.len());
    for (i, p) in terrain.vertices.iter().enumerate() {
        let key = [p.x, p.y].map(f64::to_bits);
        let at = *places.entry(key).or_insert(i as u32);
        first.push(at);
        if at as usize != i {
            let gap = (p.z - terrain.vertices[at as usize].z).abs();
            if gap > 0.0 {
                other += 1;
                if gap > worst.0 {
                    worst = (gap, at as usize, i);
                }
            } else {
                same += 1;
            }
        }
    }
    if same > 0 {
        notes.push(Note::new(
            "ground-points-repeated",
            format!("left out {} that had been given before", counted(same, "point", "points")),
        ));
    }
    if other > 0 {
        let (gap, a, b) = worst;
        let message = format!(
            "left out {} at the place of an earlier one but at another height, by up to {}: at {}, points {} and {}",
            counted(other, "point", "points"),
            short(gap),
            point(terrain.frame.to_world(terrain.vertices[a])),
            a + 1,
            b + 1
        );
        notes.push(Note::new("ground-points-conflict", message));
    }
    first
}

/// Vertices and triangles of a grid: two in each cell with four heights, cut along the diagonal whose ends differ less in height
/// (the one that rises to the east, where they are equal). Nodes without a height are left out, and so are their cells.
pub(super) fn grid(label: &str, grid: &RawGrid, notes: &mut Vec<Note>) -> Result<(Vec<DVec3>, Vec<[u32; 3]>), Defects> {
    const NONE: u32 = u32::MAX;
    let (columns, rows) = (grid.columns, grid.rows);
    let mut vertices = Vec::with_capacity(grid.heights.len());
    let mut number = Vec::with_capacity(grid.heights.len());
    for (i, &z) in grid.heights.iter().enumerate() {
        if z.is_nan() {
            number.push(NONE);
            continue;
        }
        let (column, row) = (i % columns.max(1), i / columns.max(1));
        number.push(vertices.len() as u32);
        let steps = DVec2::new(column as f64, (rows - 1 - row) as f64);
        vertices.push((grid.origin + steps * grid.step).extend(z));
    }
    let missing = grid.heights.len() - vertices.len();
    let mut triangles = Vec::with_capacity(2 * vertices.len());
    let mut holes = 0;
    for row in 1..rows {
        for column in 1..columns {
            let [nw, ne, sw, se] = [(row - 1, column - 1), (row - 1, column), (row, column - 1), (row, column)]
                .map(|(r, c)| number[r * columns + c]);
            if [nw, ne, sw, se].contains(&NONE) {
                holes += 1;
                continue;
            }
            let z = |v: u32| vertices[v as usize].z;
            if (z(sw) - z(ne)).abs() <= (z(nw) - z(se)).abs() {
                triangles.extend([[sw, se, ne], [sw, ne, nw]]);
            } else {
                triangles.extend([[sw, se, nw], [se, ne, nw]]);
            }
        }
    }
    if triangles.is_empty() {
        let figures = format!("{columns} × {rows} nodes, {missing} of them without a height");
        return Err(defect(
            "ground-points",
            "the grid has no cell with four heights",
            label.into(),
            figures,
            "give a larger grid",
        ));
    }
    let message = format!(
        "{columns} × {rows} nodes at the centres of the cells; each square between four of them was cut along the diagonal whose \
         ends differ less in height"
    );
    notes.push(Note::new("ground-grid", message));
    if missing > 0 {
        let message = format!("{} of the grid have no height: {holes} squares are left out", counted(missing, "node", "nodes"));
        notes.push(Note::new("ground-no-data", message));
    }
    Ok((vertices, triangles))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;
    use crate::kernel::orientation::{Turn, turn};

    #[test]
    fn cells_are_cut_along_the_flatter_diagonal() {
        let of = |heights: [f64; 4]| {
            let grid = RawGrid { columns: 2, rows: 2, origin: DVec2::ZERO, step: DVec2::ONE, heights: heights.to_vec() };
            super::grid("a", &grid, &mut Vec::new()).unwrap()
        };
        // North-west, north-east, south-west, south-east.
        let (vertices, triangles) = of([0.0, 5.0, 5.0, 9.0]);
        assert_eq!(triangles, [[2, 3, 1], [2, 1, 0]]);
        assert_eq!(vertices[2], DVec3::new(0.0, 0.0, 5.0));
        assert_eq!(of([5.0, 0.0, 9.0, 5.0]).1, [[2, 3, 0], [3, 1, 0]]);
        assert_eq!(of([1.0, 1.0, 1.0, 1.0]).1, [[2, 3, 1], [2, 1, 0]]);
    }

    #[test]
    fn of_points_at_one_place_the_first_counts() {
        let vertices = [(0.0, 0.0, 1.0), (4.0, 0.0, 1.0), (0.0, 4.0, 1.0), (4.0, 0.0, 3.5), (0.0, 0.0, 1.0), (-0.0, 0.0, 1.0)];
        let mut terrain = Terrain { frame: Frame::WORLD, vertices: vertices.map(DVec3::from).to_vec(), triangles: Vec::new() };
        let mut notes = Vec::new();
        let mut triangles = triangulate("a.xyz", &mut terrain, &mut notes).unwrap();
        triangles[0].sort_unstable();
        assert_eq!(triangles, [[0, 1, 2]]);
        let text: Vec<&str> = notes.iter().map(|note| note.message.as_str()).collect();
        assert!(text[0].starts_with("left out 2 points"), "{text:?}");
        assert!(text[1].contains("by up to 2.5: at (4, 0, 1), points 2 and 4"), "{text:?}");
    }

    #[test]
    fn coordinates_below_any_resolution_become_nought() {
        let vertices = [(4e-44, 3e-37, 1.0), (1e-38, 9e-39, 2.0), (-0.0, 4e-37, 3.0), (1.0, -1e-300, 4.0)];
        let mut terrain = Terrain { frame: Frame::WORLD, vertices: vertices.map(DVec3::from).to_vec(), triangles: Vec::new() };
        let triangles = triangulate("a.xyz", &mut terrain, &mut Vec::new()).unwrap();
        let [first, _, third, last] = terrain.vertices[..] else { panic!() };
        assert_eq!((first.x, third.x.to_bits(), last.y), (0.0, 0, 0.0));
        // Four places, three of them on the hull or all: no triangle is upside down.
        assert!((2..=3).contains(&triangles.len()), "{triangles:?}");
        for t in triangles {
            let [a, b, c] = t.map(|v| terrain.vertices[v as usize].truncate());
            assert_eq!(turn(a, b, c), Turn::Left, "{t:?}");
        }
    }
}
