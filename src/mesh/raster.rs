//! Heights of a mesh at the nodes of a grid.

use crate::kernel::orientation::doubled_area;
use crate::kernel::plan_box::PlanBox;
use crate::model::Tin;
use crate::sheet::Grid;
use glam::{DVec2, DVec3};
use rayon::prelude::*;

/// Rows of one task.
const ROWS: usize = 64;

/// A mesh that reaches into a cell by less than this share of it does not need it: what is left of decimal fractions. Centres
/// lie half a cell away.
const ON_EDGE: f64 = 1e-6;

/// The grid whose cells, with edges at whole multiples of their side, cover a mesh; its nodes are their centres. `None` for a
/// mesh without vertices, and beyond `most` nodes: with the counts that there would be.
///
/// # Errors
/// Columns and rows, if there would be more than `most` nodes.
pub fn cover(tin: &Tin, cell: f64, most: f64) -> Result<Option<Grid>, DVec2> {
    let bounds = PlanBox::of(tin.vertices.iter().map(|v| tin.frame.to_world(*v).truncate()));
    if bounds.is_empty() {
        return Ok(None);
    }
    let first = (bounds.lo / cell + ON_EDGE).floor();
    let count = (bounds.hi / cell - ON_EDGE).ceil() - first;
    // Of a cell far below the last digit of the coordinates there is no count.
    if !count.is_finite() {
        return Err(count);
    }
    let count = count.max(DVec2::ONE);
    if count.x * count.y <= most {
        let node = first * cell + 0.5 * cell;
        return Ok(Some(Grid { xll: node.x, yll: node.y, cell, ncols: count.x as usize, nrows: count.y as usize }));
    }
    Err(count)
}

/// Heights of the mesh at the nodes of `grid`, row by row from the north, each row from the west; NaN where the mesh is not.
///
/// A node belongs to the first triangle, in the order of the mesh, that contains it or has it on its edge: decided exactly, so
/// that no node falls between two triangles and the result does not depend on the number of threads. Its height is that of the
/// plane through the corners, right to a few units in the last place, and exact at corners and on level triangles.
pub fn heights(tin: &Tin, grid: &Grid) -> Vec<f64> {
    let mut values = vec![f64::NAN; grid.ncols * grid.nrows];
    if values.is_empty() {
        return values;
    }
    let nodes = Nodes::new(tin, grid);
    let mut tasks: Vec<Vec<u32>> = vec![Vec::new(); grid.nrows.div_ceil(ROWS)];
    for t in 0..tin.triangles.len() {
        if let Some((first, last)) = nodes.rows(&tin.corners(t)) {
            tasks[first / ROWS..=last / ROWS].iter_mut().for_each(|task| task.push(t as u32));
        }
    }
    values.par_chunks_mut(ROWS * grid.ncols).zip(&tasks).enumerate().for_each(|(task, (rows, triangles))| {
        for t in triangles {
            nodes.fill(&tin.corners(*t as usize), task * ROWS, rows);
        }
    });
    values
}

/// Nodes of a grid in the frame of a mesh.
struct Nodes {
    /// Eastings by column.
    x: Vec<f64>,
    /// Northings by row, from the north.
    y: Vec<f64>,
    cell: f64,
}

impl Nodes {
    fn new(tin: &Tin, grid: &Grid) -> Self {
        let origin = tin.frame.origin();
        let x = (0..grid.ncols).map(|column| grid.node(column, 0).x - origin.x).collect();
        let y = (0..grid.nrows).map(|row| grid.node(0, row).y - origin.y).collect();
        Self { x, y, cell: grid.cell }
    }

    /// First and last row that a triangle may reach.
    fn rows(&self, corners: &[DVec3; 3]) -> Option<(usize, usize)> {
        let north = self.y.first().copied()?;
        let (lo, hi) = (corners[0].min(corners[1]).min(corners[2]).y, corners[0].max(corners[1]).max(corners[2]).y);
        span((north - hi) / self.cell, (north - lo) / self.cell, self.y.len())
    }

    /// Gives the nodes of a triangle their heights; `rows` begin at row `from`.
    fn fill(&self, corners: &[DVec3; 3], from: usize, rows: &mut [f64]) {
        let [a, b, c] = corners.map(DVec3::truncate);
        let (Some((first, last)), Some(west)) = (self.rows(corners), self.x.first()) else { return };
        let columns = self.x.len();
        for (row, values) in
            rows.chunks_exact_mut(columns).enumerate().take((last + 1).saturating_sub(from)).skip(first.max(from) - from)
        {
            let y = self.y[from + row];
            let (lo, hi) = cut([a, b, c], y);
            let Some((first, last)) = span((lo - west) / self.cell, (hi - west) / self.cell, columns) else { continue };
            for (x, value) in self.x[first..=last].iter().zip(&mut values[first..=last]) {
                if value.is_nan()
                    && let Some(z) = height(corners, DVec2::new(*x, y))
                {
                    *value = z;
                }
            }
        }
    }
}

/// Whole numbers from `lo` to `hi` below `count`, and one more on each side for what was rounded.
fn span(lo: f64, hi: f64, count: usize) -> Option<(usize, usize)> {
    let first = (lo.floor() - 1.0).max(0.0);
    let last = (hi.ceil() + 1.0).min(count as f64 - 1.0);
    (first <= last).then_some((first as usize, last as usize))
}

/// From where to where a triangle reaches at height `y` of the plan, roughly; its whole width where it is but touched.
fn cut(corners: [DVec2; 3], y: f64) -> (f64, f64) {
    let (mut lo, mut hi) = (f64::INFINITY, f64::NEG_INFINITY);
    for i in 0..3 {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        if (p.y - y) * (q.y - y) <= 0.0 && p.y != q.y {
            let x = p.x + ((y - p.y) / (q.y - p.y)).clamp(0.0, 1.0) * (q.x - p.x);
            lo = lo.min(x);
            hi = hi.max(x);
        }
    }
    let (west, east) = (corners[0].min(corners[1]).min(corners[2]).x, corners[0].max(corners[1]).max(corners[2]).x);
    if lo > hi { (west, east) } else { (lo.max(west), hi.min(east)) }
}

/// Height of a triangle at a point of it; `None` outside.
fn height(corners: &[DVec3; 3], at: DVec2) -> Option<f64> {
    let [a, b, c] = corners.map(DVec3::truncate);
    let shares = [doubled_area(b, c, at), doubled_area(c, a, at), doubled_area(a, b, at)];
    let all = shares[0] + shares[1] + shares[2];
    if shares.iter().any(|share| *share < 0.0) || all <= 0.0 {
        return None;
    }
    // From the corner with the largest share: the others then count least.
    let near = (0..3).fold(0, |near, i| if shares[i] > shares[near] { i } else { near });
    let rise = |i: usize| shares[i] / all * (corners[i].z - corners[near].z);
    Some(corners[near].z + (rise((near + 1) % 3) + rise((near + 2) % 3)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;
    use crate::model::Part;

    fn tin(vertices: &[(f64, f64, f64)], triangles: &[[u32; 3]]) -> Tin {
        let vertices = vertices.iter().copied().map(DVec3::from).collect();
        Tin { frame: Frame::WORLD, vertices, triangles: triangles.to_vec(), parts: vec![Part::Ground; triangles.len()] }
    }

    /// Two triangles of the plane z = 1 + 2x + 3y over a square, and nodes on their edges and corners.
    #[test]
    fn a_plane_is_met_on_edges_and_corners() {
        let plane = |x: f64, y: f64| (x, y, 1.0 + 2.0 * x + 3.0 * y);
        let square = tin(&[plane(0.0, 0.0), plane(4.0, 0.0), plane(4.0, 4.0), plane(0.0, 4.0)], &[[0, 1, 2], [0, 2, 3]]);
        let grid = Grid { xll: -1.0, yll: -1.0, cell: 1.0, ncols: 7, nrows: 7 };
        let values = heights(&square, &grid);
        for row in 0..7 {
            for column in 0..7 {
                let (node, z) = (grid.node(column, row), values[row * 7 + column]);
                let inside = node.cmpge(DVec2::ZERO).all() && node.cmple(DVec2::splat(4.0)).all();
                assert_eq!(z.is_nan(), !inside, "{node}");
                assert!(!inside || (z - plane(node.x, node.y).2).abs() < 1e-14, "{node}: {z}");
            }
        }
    }

    /// Cells cover the mesh with edges at whole multiples of their side.
    #[test]
    fn cells_cover_the_mesh() {
        let one = tin(&[(10.2, -3.5, 0.0), (12.0, -3.0, 0.0), (10.5, -1.9, 0.0)], &[[0, 1, 2]]);
        let grid = cover(&one, 0.5, 1e8).unwrap().unwrap();
        assert_eq!(grid, Grid { xll: 10.25, yll: -3.25, cell: 0.5, ncols: 4, nrows: 4 });
        assert_eq!(cover(&one, 1e-3, 1e6), Err(DVec2::new(1800.0, 1600.0)));
        assert!(cover(&one, 5e-324, 1e8).is_err());
        assert_eq!(cover(&tin(&[], &[]), 1.0, 1e8), Ok(None));
    }

    /// A fan of thin triangles far from the origin, against a search through all triangles for each node.
    #[test]
    fn the_scan_finds_what_a_search_finds() {
        let mut vertices = vec![(0.1, 0.2, 5.0)];
        vertices.extend((0..40).map(|i| {
            let (angle, radius) = (f64::from(i) * std::f64::consts::TAU / 40.0, 20.0 + f64::from(i % 7));
            (radius * angle.cos(), radius * angle.sin(), f64::from(i % 5))
        }));
        let triangles: Vec<[u32; 3]> = (0..40).map(|i| [0, 1 + i, 1 + (i + 1) % 40]).collect();
        let fan = tin(&vertices, &triangles);
        let grid = cover(&fan, 0.37, 1e8).unwrap().unwrap();
        let values = heights(&fan, &grid);
        let mut met = 0;
        for (i, value) in values.iter().enumerate() {
            let node = grid.node(i % grid.ncols, i / grid.ncols);
            let found = (0..40).find_map(|t| height(&fan.corners(t), node));
            assert_eq!(found.map(f64::to_bits), (!value.is_nan()).then_some(value.to_bits()), "{node}");
            met += usize::from(found.is_some());
        }
        // The area of the fan, in cells.
        assert!((9_000..13_000).contains(&met), "{met}");
    }

    /// The result is the same whichever triangle is thinner than a cell, and heights stay within those of the corners.
    #[test]
    fn slivers_stay_within_their_corners() {
        let sliver = tin(&[(0.0, 0.0, 1.0), (10.0, 1e-9, 2.0), (5.0, 1.0, 900.0)], &[[0, 1, 2]]);
        let flat = tin(&[(0.0, 0.0, 405.3), (10.0, 0.1, 405.3), (5.0, 7.0, 405.3)], &[[0, 1, 2]]);
        let grid = Grid { xll: 0.0, yll: 0.0, cell: 0.01, ncols: 1001, nrows: 701 };
        assert!(heights(&sliver, &grid).iter().all(|z| z.is_nan() || (1.0..=900.0).contains(z)));
        assert!(heights(&flat, &grid).iter().all(|z| z.is_nan() || *z == 405.3));
    }
}
