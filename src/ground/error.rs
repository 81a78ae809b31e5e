//! Why line and ground do not go together.

use super::TooManyStations;
use crate::mesh::region::RegionError;
use crate::model::Defects;
use crate::surface::SurfaceError;

/// Why there is no finished ground. Places are plan coordinates in the world.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum GroundError {
    /// A sheet through the line could not be built.
    #[error("{0}")]
    Surface(#[from] SurfaceError),
    /// The ground near the works has no single height everywhere.
    #[error("{0}")]
    Terrain(Defects),
    /// A part of the line lies in the slope of another: platforms and slopes contradict each other.
    #[error(
        "`{chain}` from station {from:.3} to {to:.3} lies up to {depth:.3} inside the slope of `{by_chain}` near ({x:.3}, {y:.3})\n   \
         = no slopes this flat fit between the two\n   = help: {cure}"
    )]
    Buried {
        /// Name of the chain.
        chain: String,
        /// First station of the stretch.
        from: f64,
        /// Last station.
        to: f64,
        /// Greatest depth.
        depth: f64,
        /// Name of the other chain.
        by_chain: String,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// What helps.
        cure: String,
    },
    /// Slopes end at the edge of the ground, or at the end asked for, without having met the ground.
    #[error(
        "the slopes do not meet the ground over {length:.3}, furthest off near ({x:.3}, {y:.3})\n   = {at}: they are still up to \
         {height:.3} above or below it there\n   = help: {cure}, or accept open ends with `--allow-open`"
    )]
    Open {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// Length of all open ends.
        length: f64,
        /// Greatest height left.
        height: f64,
        /// Where they end.
        at: &'static str,
        /// What helps.
        cure: &'static str,
    },
    /// There is no ground below a part of the platform.
    #[error(
        "there is no ground under {area:.3} square units of the platform, most of it near ({x:.3}, {y:.3})\n   = the platform has {all:.3}\n   \
         = help: use a ground without holes that reaches beyond the works, or accept open ends with `--allow-open`"
    )]
    Uncovered {
        /// Area without ground, in plan.
        area: f64,
        /// Area of the platform, in plan.
        all: f64,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
    },
    /// There is no ground below a part of the line.
    #[error(
        "there is no ground under {length:.3} of the line, most of it near ({x:.3}, {y:.3})\n   = the line has {all:.3}\n   \
         = help: use a ground without holes that reaches beyond the works, or accept open ends with `--allow-open`"
    )]
    LineUncovered {
        /// Length without ground, in plan.
        length: f64,
        /// Length of all edges with slopes, in plan.
        all: f64,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
    },
    /// The line is not on the ground where slopes stand on one side of it only.
    #[error(
        "the finished ground would have upright walls {length:.3} long, the highest near ({x:.3}, {y:.3})\n   = the line lies up to \
         {height:.3} off the ground there, and no slope leads from it to the ground\n   = help: build slopes on both sides \
         (`--direction auto`, without `--side`), or leave out `--finished`"
    )]
    Walls {
        /// Length of the walls.
        length: f64,
        /// Their greatest height.
        height: f64,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
    },
    /// Slopes end off the ground where it goes on.
    #[error(
        "the finished ground would have upright walls {length:.3} long, the highest near ({x:.3}, {y:.3})\n   = {at}: the slopes are \
         still up to {height:.3} above or below the ground there\n   = help: {cure}, or leave out `--finished`"
    )]
    WallsAtEnds {
        /// Length of the walls.
        length: f64,
        /// Their greatest height.
        height: f64,
        /// Place.
        x: f64,
        /// Place.
        y: f64,
        /// Where the slopes end.
        at: &'static str,
        /// What helps.
        cure: &'static str,
    },
    /// The meshes could not be put together along open ends.
    #[error(
        "no sound mesh could be made where the works end at the edge of the ground, first near ({x:.3}, {y:.3})\n   = slopes or platform \
         hang over that edge\n   = help: use a ground without holes that reaches beyond the works, or leave out `--finished`"
    )]
    OpenMesh {
        /// Place.
        x: f64,
        /// Place.
        y: f64,
    },
    /// A triangle could not be cut.
    #[error(
        "{what} could not be cut: {cause}\n   = help: try another `--tolerance`; this is a limit of the program, please report line and ground"
    )]
    Cut {
        /// Design or ground.
        what: &'static str,
        /// What is wrong.
        cause: RegionError,
    },
    /// A mesh failed its own check.
    #[error(
        "the {mesh} failed its check: {what}\n   = help: try another `--tolerance`; this is a limit of the program, please report line and ground"
    )]
    Unsound {
        /// Design or finished ground.
        mesh: &'static str,
        /// What is wrong.
        what: String,
    },
    /// Too many stations.
    #[error("{0}")]
    Stations(#[from] TooManyStations),
}

impl GroundError {
    /// Whether moving the line a little may help.
    pub(crate) fn is_flaw(&self) -> bool {
        match self {
            Self::Surface(error) => error.is_flaw(),
            Self::Cut { .. } | Self::Unsound { .. } | Self::OpenMesh { .. } => true,
            _ => false,
        }
    }
}
