//! Meshes as rasters.

use super::{Error, MOST_NODES, room};
use crate::mesh::raster;
use crate::model::{Defect, Defects, Memory, Tin};
use crate::write::{Anchor, GridLayout, RasterFormat, Target};
use glam::DVec2;

/// Rasters to be written.
#[derive(Clone, Debug, Default)]
pub struct Rasters {
    /// Side of their cells; positive.
    pub cell: f64,
    /// Where the design goes.
    pub design: Vec<(Target, RasterFormat)>,
    /// Where the finished ground goes; needs existing ground.
    pub finished: Vec<(Target, RasterFormat)>,
}

/// A raster: where it lies, and its heights.
pub(super) type Raster = (GridLayout, Vec<f64>);

/// Samples a mesh at the centres of cells; their edges are whole multiples of their side.
///
/// # Errors
/// If it has more than [`MOST_NODES`] nodes, or none that the mesh lies under, or takes too much memory.
pub(super) fn sample(
    tin: &Tin,
    cell: f64,
    wanted: &[(Target, RasterFormat)],
    label: &str,
    memory: &Memory,
) -> Result<Raster, Error> {
    let grid = raster::cover(tin, cell, MOST_NODES);
    let grid = grid.map_err(|count| too_many_nodes(count, cell, label, "give a larger `--cell`"))?;
    if let Some(grid) = &grid {
        let formats: Vec<RasterFormat> = wanted.iter().map(|(_, format)| *format).collect();
        room::for_raster(grid.ncols as u64 * grid.nrows as u64, &formats, label, memory)?;
    }
    let values = grid.as_ref().map_or_else(Vec::new, |grid| raster::heights(tin, grid));
    let Some(grid) = grid.filter(|_| values.iter().any(|value| !value.is_nan())) else {
        let figures = format!("no centre of a cell of {cell} lies on the surface");
        return Err(refused("raster-empty", "the raster would be empty", label, figures, "give a smaller `--cell`").into());
    };
    let (x, y) = (grid.xll - 0.5 * cell, grid.yll - 0.5 * cell);
    let layout = GridLayout { columns: grid.ncols, rows: grid.nrows, x, y, anchor: Anchor::Corner, cell };
    Ok((layout, values))
}

/// A grid of more than [`MOST_NODES`]; `count`: its columns and rows.
pub(super) fn too_many_nodes(count: DVec2, cell: f64, label: &str, help: &str) -> Defects {
    let figures = format!("{} by {} at a cell of {cell}; at most {MOST_NODES:e} in all", count.x, count.y);
    refused("too-many-nodes", "the raster would have too many nodes", label, figures, help)
}

fn refused(code: &'static str, what: &str, label: &str, figures: String, help: &str) -> Defects {
    let mut defects = Defects::default();
    defects.push(code, || Defect {
        code,
        what: what.to_owned(),
        at: label.to_owned(),
        figures: Some(figures),
        help: help.to_owned(),
    });
    defects
}
