//! A line on existing ground: read → reach → designs → works → report.

use super::build::{BuildJob, Product, Survey, missed_levels};
use super::watch::Stopwatch;
use super::{Desk, Error, Wishes, check_steepness, figures, ground, room, systems};
use crate::ground::{Options, Site};
use crate::model::{Design, Extent, LengthUnit, Line, Sheet, Side, Terrain};
use crate::read::Source;
use crate::read::terrain::TerrainOptions;
use crate::report::TerrainFigures;
use crate::surface::Watch as _;
use crate::terrain;
use std::path::PathBuf;

/// The file the existing ground comes from, and what is wanted of it.
#[derive(Clone, Debug)]
pub struct GroundInput {
    /// Its path.
    pub path: PathBuf,
    /// What is known about its format.
    pub options: TerrainOptions,
    /// Accept slopes that end without meeting the ground.
    pub allow_open: bool,
}

/// Builds on existing ground.
pub(super) fn build(
    desk: Desk<'_>,
    job: &BuildJob,
    input: &GroundInput,
    line: &Line,
    source: &Source,
    unit: LengthUnit,
    watch: &Stopwatch<'_>,
) -> Result<Product, Error> {
    let (terrain, ground_source) =
        ground::read_ground_at(desk, &input.path, &input.options, Some(unit), watch).map_err(|error| match error {
            // The columns of the ground have an option of their own.
            Error::Read(error) => error.with_option("--csv-order", "--terrain-order").into(),
            other => other,
        })?;
    watch.holds(room::of_ground(&terrain));
    systems::compare(watch, [("line", source), ("ground", &ground_source)]);
    terrain::check_overlap(&terrain, &ground_source.label, line, &source.label)?;
    for wishes in &job.wishes {
        check_steepness(line, source, wishes.slope)?;
    }
    let mut site = Site::new(line, terrain, &ground_source.label);
    let designs = designs(&job.wishes, &mut site, line, &source.label, watch)?;
    let options =
        Options { allow_open: input.allow_open, finished: job.wants_finished(), stations: job.stations, keep: job.draws() };
    let (terrain, area) = (terrain_figures(site.terrain()), site.area());
    room::for_works(job, site.terrain(), &ground_source.label, &watch.memory())?;
    let built = site.build(&designs, &options, watch).map_err(|cause| Error::Ground {
        label: source.label.clone(),
        ground: ground_source.label.clone(),
        cause: Box::new(cause),
    })?;
    built.notes.iter().for_each(|note| watch.note(note));
    missed_levels(&job.wishes, &built.levels).iter().for_each(|note| watch.note(note));
    let inputs = figures::Inputs { line, source, ground: &ground_source, terrain, area };
    let report = figures::ground_report(&inputs, job, &designs, &built, &watch.notes());
    let survey = built.terrain.zip(built.pieces).map(|(terrain, pieces)| Survey {
        terrain,
        pieces,
        stations: built.stations,
        tallied: built.tallied,
    });
    Ok(Product {
        design: built.design,
        finished: built.finished,
        lines: built.lines,
        survey,
        ground: Some(ground_source),
        report,
    })
}

/// One design for each sheet, as deep as it can reach ground.
fn designs(all: &[Wishes], site: &mut Site<'_>, line: &Line, label: &str, watch: &Stopwatch<'_>) -> Result<Vec<Design>, Error> {
    let (low, high) = line.elevation_range();
    let mut chosen = Vec::new();
    let mut designs = Vec::new();
    for wishes in all {
        if wishes.side == Some(Side::Inside) {
            // A pit or a mound ends at its floor, not at the ground.
            designs.push(wishes.settle(line, label, &mut chosen)?);
            continue;
        }
        let end = site.end(wishes.slope, wishes.sheet, wishes.tolerance);
        let applies = |extent: &Extent| match (*extent, wishes.sheet) {
            (Extent::Elevation(z), Sheet::Falling) => z < high,
            (Extent::Elevation(z), Sheet::Rising) => z > low,
            _ => true,
        };
        let extent = wishes.extent.filter(applies).unwrap_or(Extent::Elevation(end));
        designs.push(Wishes { extent: Some(extent), ..wishes.clone() }.settle(line, label, &mut chosen)?);
    }
    chosen.dedup();
    chosen.iter().for_each(|note| watch.note(note));
    Ok(designs)
}

/// Figures of the ground as given.
fn terrain_figures(terrain: &Terrain) -> TerrainFigures {
    let (z_min, z_max) = terrain.height_range();
    TerrainFigures { vertices: terrain.vertices.len(), triangles: terrain.triangles.len(), triangles_used: 0, z_min, z_max }
}
