//! Exact heights of the sheet of the given line, at points or on a grid.

use super::watch::{Observer, Stopwatch, WRITING};
use super::{Desk, Error, Given, LineInput, check_steepness, rasters, read_line, room, systems};
use crate::model::{Defect, Defects, Line, Sheet, Slope};
use crate::read::{RawPoints, ReadOptions};
use crate::sheet::{Grid, Heights};
use crate::surface::Watch as _;
use crate::validate::INPUT_LIMIT;
use crate::write::{Anchor, GridLayout, RasterFormat, Target, write_points};
use glam::DVec2;
use std::path::PathBuf;

/// Most nodes of a grid: their heights are held in memory, eight bytes each.
pub const MOST_NODES: f64 = 1e8;

/// Margin around the line of a grid without a given box, as a share of the longer side of the line's box.
pub const MARGIN: f64 = 0.1;

/// The least margin, in cells.
pub const LEAST_MARGIN_CELLS: f64 = 5.0;

/// A last column or row that misses the edge of the box by this share of a cell counts as on it: what is left of decimal
/// fractions.
const ON_EDGE: f64 = 1e-6;

/// Heights to be found, and where to put them.
#[derive(Clone, Debug)]
pub struct SampleJob {
    /// The line.
    pub input: LineInput,
    /// The side slope.
    pub slope: Slope,
    /// Falling or rising.
    pub sheet: Sheet,
    /// Where the heights are wanted.
    pub at: Where,
    /// Where they go: CSV for points, a raster for a grid.
    pub output: Target,
}

/// Where heights are wanted.
#[derive(Clone, Debug)]
pub enum Where {
    /// At the points of a text file; `-` is standard input.
    Points {
        /// The file.
        path: PathBuf,
        /// What is known about its format.
        options: ReadOptions,
    },
    /// On a grid, which is written in a format.
    Raster(Lattice, RasterFormat),
}

/// A grid as asked for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lattice {
    /// Distance of the nodes; positive.
    pub cell: f64,
    /// Box of the nodes; `None`: the line's box and a margin, see [`lattice`].
    pub area: Option<Area>,
}

/// A box in plan, not empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Area {
    /// South-west corner.
    pub min: DVec2,
    /// North-east corner.
    pub max: DVec2,
}

/// What was sampled.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampled {
    /// Number of heights.
    pub heights: usize,
}

/// Finds heights and writes them. The output is opened first.
///
/// # Errors
/// [`Error`]; nothing has been written then, except what already went down a stream.
pub fn sample(job: &SampleJob, observer: &dyn Observer) -> Result<Sampled, Error> {
    sample_at(Desk::Disk, job, observer)
}

/// The same with files from elsewhere.
///
/// # Errors
/// As [`sample`].
pub fn sample_at(desk: Desk<'_>, job: &SampleJob, observer: &dyn Observer) -> Result<Sampled, Error> {
    let watch = Stopwatch::new(observer);
    let mut inputs = vec![job.input.path.clone()];
    if let Where::Points { path, .. } = &job.at {
        inputs.push(path.clone());
    }
    let mut outputs = desk.open(std::slice::from_ref(&job.output), &inputs, false)?;
    let Given { line, source, unit } = read_line(&job.input, desk, &watch)?;
    check_steepness(&line, &source, job.slope)?;
    let heights = match &job.at {
        Where::Points { path, options } => {
            let options = ReadOptions { memory: watch.memory(), ..options.clone() };
            let points = desk.points(path, &options).map_err(|error| error.with_option("--csv-order", "--at-order"))?;
            room::for_points(points.points.len(), points.source.bytes, &points.source.label, &watch.memory())?;
            points.notes.iter().for_each(|note| watch.note(note));
            check_points(&points)?;
            let points: Vec<DVec2> = points.points.iter().map(|p| DVec2::new(p.x, p.y)).collect();
            watch.stage_of("index");
            let sheet = Heights::new(&line, job.slope, job.sheet);
            watch.stage_of("heights");
            let heights = sheet.many(&points);
            watch.stage_of(WRITING);
            let rows = points.iter().zip(&heights).map(|(p, &z)| p.extend(z));
            outputs.write(0, |out| write_points(out, rows))?;
            heights.len()
        }
        Where::Raster(wanted, format) => {
            let grid = lattice(&line, wanted, &source.label)?;
            room::for_raster(grid.ncols as u64 * grid.nrows as u64, &[*format], &source.label, &watch.memory())?;
            watch.stage_of("index");
            let sheet = Heights::new(&line, job.slope, job.sheet);
            watch.stage_of("heights");
            let heights = sheet.raster(&grid);
            watch.stage_of(WRITING);
            let Grid { xll: x, yll: y, cell, ncols: columns, nrows: rows } = grid;
            let layout = GridLayout { columns, rows, x, y, anchor: Anchor::Center, cell };
            let reference = systems::reference(&source, None, job.input.unit, unit);
            outputs.write(0, |out| format.write(out, &layout, &heights, &reference))?;
            heights.len()
        }
    };
    desk.commit(outputs)?;
    Ok(Sampled { heights })
}

/// Points must be where coordinates of lines may be.
fn check_points(points: &RawPoints) -> Result<(), Defects> {
    let mut defects = Defects::default();
    for point in &points.points {
        let largest = point.x.abs().max(point.y.abs());
        if largest > INPUT_LIMIT {
            defects.push("too-large", || Defect {
                code: "too-large",
                what: "a coordinate is too large".to_owned(),
                at: format!("{}, row {}", points.source.label, point.row),
                figures: Some(format!("{largest:e}, against a limit of {INPUT_LIMIT:e}")),
                help: "check the columns; projected coordinates stay far below".to_owned(),
            });
        }
    }
    defects.into_result()
}

/// The grid for a line. Without a box: that of the line, grown on each side by [`MARGIN`] of its longer side or by
/// [`LEAST_MARGIN_CELLS`], whichever is more, out to whole multiples of the cell. With a box: from its south-west corner in
/// whole cells, as far as they fit.
///
/// # Errors
/// [`Defects`] if it has more than [`MOST_NODES`] nodes.
pub fn lattice(line: &Line, wanted: &Lattice, label: &str) -> Result<Grid, Defects> {
    let cell = wanted.cell;
    let area = wanted.area.unwrap_or_else(|| {
        let bounds = line.plan_box();
        let margin = (MARGIN * bounds.size().max_element()).max(LEAST_MARGIN_CELLS * cell);
        Area { min: ((bounds.lo - margin) / cell).floor() * cell, max: ((bounds.hi + margin) / cell).ceil() * cell }
    });
    let size = area.max - area.min;
    let count = (size / cell + ON_EDGE).floor() + 1.0;
    let nodes = count.x * count.y;
    // Written so that a count that is no number is refused as well.
    if nodes <= MOST_NODES {
        return Ok(Grid { xll: area.min.x, yll: area.min.y, cell, ncols: count.x as usize, nrows: count.y as usize });
    }
    Err(rasters::too_many_nodes(count, cell, label, "give a larger `--cell`, or a smaller `--box`"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Chain, Place, Role};
    use glam::DVec3;

    fn line() -> Line {
        let vertices = vec![DVec3::new(1003.0, 2004.0, 10.0), DVec3::new(1103.0, 2054.0, 12.0)];
        Line {
            chains: vec![Chain { name: "a".into(), role: Role::Open, vertices, places: vec![Place::default(); 2], axis: None }],
            ..Line::default()
        }
    }

    #[test]
    fn the_default_box_has_a_margin_and_round_nodes() {
        // 10 % of 100 is 10: from 993 and 1994 down to multiples of 2, from 1113 and 2064 up.
        let grid = lattice(&line(), &Lattice { cell: 2.0, area: None }, "a").unwrap();
        assert_eq!(grid, Grid { xll: 992.0, yll: 1994.0, cell: 2.0, ncols: 62, nrows: 36 });
        // Five cells of 20 are more than 10 %.
        let grid = lattice(&line(), &Lattice { cell: 20.0, area: None }, "a").unwrap();
        assert_eq!((grid.xll, grid.yll, grid.ncols, grid.nrows), (900.0, 1900.0, 17, 14));
    }

    #[test]
    fn a_given_box_is_kept() {
        let area = Area { min: DVec2::new(0.5, 1.5), max: DVec2::new(0.5 + 0.3, 1.5 + 0.25) };
        let grid = lattice(&line(), &Lattice { cell: 0.1, area: Some(area) }, "a").unwrap();
        assert_eq!(grid, Grid { xll: 0.5, yll: 1.5, cell: 0.1, ncols: 4, nrows: 3 });
    }

    #[test]
    fn too_many_nodes() {
        for cell in [1e-3, 1e-300, 5e-324] {
            let text = lattice(&line(), &Lattice { cell, area: None }, "a").unwrap_err().to_string();
            assert!(text.starts_with("the raster would have too many nodes\n  --> a\n   = "), "{text}");
        }
    }
}
