//! Why a job was not done.

use super::DesignError;
use super::diff::DiffError;
use super::volume::ComparisonError;
use crate::formation::FormationError;
use crate::ground::{GroundError, TooManyStations};
use crate::model::message::placed;
use crate::model::{Defects, Slope, TooLarge};
use crate::read::ReadError;
use crate::report::BuriedStretch;
use crate::surface::SurfaceError;
use crate::write::WriteError;
use std::fmt;

/// Why a job was not done. `Display` gives the whole message with places and cures, without the leading `error: `.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// An input could not be read.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The line is not one a surface can be built on.
    #[error(transparent)]
    Invalid(#[from] Defects),
    /// The line has no formation: no road about a centre line, no place for a breakline.
    #[error(transparent)]
    Formation(#[from] FormationError),
    /// The line and what is wanted do not go together.
    #[error(transparent)]
    Design(#[from] DesignError),
    /// The engine refused.
    #[error("{}", placed(&.cause.to_string(), [.label]))]
    Surface {
        /// The input.
        label: String,
        /// Why.
        cause: SurfaceError,
    },
    /// Two surfaces cannot be compared.
    #[error(transparent)]
    Overlay(#[from] ComparisonError),
    /// Two files cannot be compared.
    #[error(transparent)]
    Diff(#[from] DiffError),
    /// Line and ground do not go together.
    #[error("{}", placed_on(.label, .ground, .cause))]
    Ground {
        /// The line.
        label: String,
        /// The ground.
        ground: String,
        /// Why.
        cause: Box<GroundError>,
    },
    /// Stations too close together.
    #[error(transparent)]
    Stations(#[from] TooManyStations),
    /// A cross-section was asked for where there is no line.
    #[error(transparent)]
    NoStation(#[from] NoStation),
    /// Stretches of the line are buried, and that was not to be.
    #[error(transparent)]
    Buried(#[from] BuriedError),
    /// The work would take more memory than it may.
    #[error(transparent)]
    TooLarge(#[from] TooLarge),
    /// An output could not be opened or written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// The message of `ground` with the inputs, which it does not know.
fn placed_on(label: &str, ground: &str, cause: &GroundError) -> String {
    if let GroundError::Terrain(defects) = cause {
        return defects.to_string();
    }
    placed(&cause.to_string(), [format!("{label} on {ground}")])
}

/// A station that is on none of the lines.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[error(
    "there is no station {station}\n  --> --section {station}\n   = stations run from 0 to {longest:.3} on the longest line\n   \
     = help: choose stations in that range"
)]
pub struct NoStation {
    /// The station.
    pub station: f64,
    /// Length of the longest line.
    pub longest: f64,
}

/// All buried stretches of a line that was to have none.
#[derive(Clone, Debug, PartialEq)]
pub struct BuriedError {
    /// The input.
    pub label: String,
    /// The stretches; at least one.
    pub stretches: Vec<BuriedStretch>,
}

impl fmt::Display for BuriedError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (noun, verb) = if self.stretches.len() == 1 { ("a stretch", "lies") } else { ("stretches", "lie") };
        write!(f, "{noun} of the line {verb} buried under the slope of another part")?;
        for s in &self.stretches {
            write!(f, "\n  --> {}, `{}`, stations {:.3} to {:.3}", self.label, s.chain, s.from, s.to)?;
            write!(f, "\n   = up to {:.3} deep, under `{}` at station {:.3}; ", s.depth, s.by_chain, s.by_station)?;
            match s.free_slope.and_then(Slope::from_ratio) {
                Some(slope) => write!(f, "free from {}", slope.not_flatter())?,
                None => f.write_str("no slope sets it free")?,
            }
        }
        f.write_str(
            "\n   = help: move the line, ask for a steeper slope, or leave out `--strict`: the rest of the surface is right",
        )
    }
}

impl std::error::Error for BuriedError {}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_engine_learns_the_place() {
        let of = |cause| Error::Surface { label: "a.csv".into(), cause }.to_string();
        assert_eq!(
            of(SurfaceError::NoSide),
            "there is no side to build on\n  --> a.csv\n   = `inside` and `outside` need a ring\n   \
             = help: close the line (`--closed`), or choose `--side left`, `right` or `both`"
        );
        assert_eq!(of(SurfaceError::Cancelled), "interrupted\n  --> a.csv");
    }
}
