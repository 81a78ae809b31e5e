//! What can go wrong.

use crate::mesh::region::RegionError;
use crate::model::TooLarge;
use crate::slope::levels;

/// Why there is no surface. Places are plan coordinates in the world.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// The whole line lies beyond the end of the slope.
    #[error(
        "no part of the line lies {} elevation {end}\n   = the line lies between {low} and {high}\n   = help: choose an elevation {} {high_or_low}",
        if *.rising { "below" } else { "above" }, if *.rising { "above" } else { "below" }, high_or_low = if *.rising { low } else { high }
    )]
    NothingToBuild {
        /// Where the slope was to end.
        end: f64,
        /// Lowest elevation of the line.
        low: f64,
        /// Highest elevation of the line.
        high: f64,
        /// Whether the slope rises.
        rising: bool,
    },
    /// No side of any line is wanted.
    #[error(
        "there is no side to build on\n   = `inside` and `outside` need a ring\n   = help: close the line (`--closed`), or choose `--side left`, `right` or `both`"
    )]
    NoSide,
    /// The interval asks for too many levels.
    #[error("an interval of {interval} would give {count:.0} levels\n   = at most {limit} are cut\n   = help: use an interval of {least} or more", limit = levels::MAX_LEVELS)]
    TooManyLevels {
        /// The interval asked for.
        interval: f64,
        /// How many levels that would be.
        count: f64,
        /// The least interval that works.
        least: f64,
    },
    /// A platform lies below the slope of another part.
    #[error(
        "the slope of one part covers the platform of another near ({x:.3}, {y:.3})\n   = {what}\n   = help: build the parts one by one, move them apart, or use a steeper slope"
    )]
    PlatformCovered {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// The covered stretch in words.
        what: String,
    },
    /// A line runs over the platform of a ring.
    #[error(
        "`{name}` runs over a platform near ({x:.3}, {y:.3})\n   = its slopes would pass over the platform\n   = help: shape the platform \
         with it (a breakline), or build the two one by one"
    )]
    LineOnPlatform {
        /// The line.
        name: String,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
    },
    /// Slopes inside a ring pass over another place of it, and would go on outside.
    #[error("the slopes inside a ring pass over its own edge near ({x:.3}, {y:.3})\n   = {what}\n   = help: {cure}")]
    RimCovered {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// The covered stretch in words.
        what: String,
        /// What helps.
        cure: String,
    },
    /// The slopes inside a ring end at an elevation that the ring itself goes beyond.
    #[error(
        "the floor would pass over the edge of its ring near ({x:.3}, {y:.3})\n   = {what}\n   = help: end {beyond} {limit}, or at a \
         height or distance from the line"
    )]
    RimBeyondEnd {
        /// Place of the lowest vertex of the ring (highest, of rising slopes).
        x: f64,
        /// Place.
        y: f64,
        /// The stretch in words.
        what: String,
        /// Below or above.
        beyond: &'static str,
        /// Elevation of that vertex.
        limit: f64,
    },
    /// An outline could not be filled.
    #[error(
        "the {part} cannot be triangulated near ({x:.3}, {y:.3}): {cause}\n   = help: try another `--tolerance`; this is a limit of the \
         program, please report the line"
    )]
    Flat {
        /// Platform or floor.
        part: &'static str,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// What is wrong.
        cause: RegionError,
    },
    /// The facets do not glue to one surface.
    #[error(
        "the surface could not be closed near ({x:.3}, {y:.3})\n   = {unpaired} of {arcs} pieces of creases have no counterpart\n   = help: try another `--tolerance`; this is a limit of the program, please report the line"
    )]
    Unclosed {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// Creases without a counterpart.
        unpaired: usize,
        /// All creases.
        arcs: usize,
    },
    /// Too many facets meet in one place, all but tied.
    #[error(
        "too many slopes meet in one place, closer than their heights can be told apart\n   = help: try a larger `--tolerance`: it leaves out vertices that tell nothing"
    )]
    Crowded,
    /// The mesh failed its own check.
    #[error(
        "the mesh failed its check: {what}\n   = help: try another `--tolerance`; this is a limit of the program, please report the line"
    )]
    Unsound {
        /// Which figure is out of bounds.
        what: String,
    },
    /// The mesh would take more memory than it may.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// The caller asked to stop.
    #[error("interrupted")]
    Cancelled,
}
