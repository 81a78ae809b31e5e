//! The one place that knows the order: read → check → design → surface → certificate → write. A job says what is wanted; all
//! that can be refused without the input has been refused before ([`crate::cli`] does it for the command line).

mod batch;
pub mod build;
pub mod check;
pub mod design;
pub mod desk;
pub mod diff;
pub mod error;
mod figures;
mod ground;
mod heads;
pub mod info;
mod on_ground;
mod rasters;
mod room;
pub mod sample;
mod systems;
mod units;
pub mod verify;
pub mod volume;
mod watch;

pub use batch::{Batch, run_batch};
pub use build::{BuildJob, Built, build, build_at};
pub use check::{CheckJob, Looked, NotPassed, SlopeWish, check};
pub use design::{DesignError, MOST_LEVELS, Wishes};
pub use desk::{Bench, Desk, write_reports};
pub use diff::{Beyond, Bounds, DiffError, DiffJob, Differed, Most, diff};
pub use error::{BuriedError, Error};
pub use ground::read_ground;
pub use heads::LocalOrigin;
pub use info::{info, job_info};
pub use on_ground::GroundInput;
pub use rasters::Rasters;
pub use sample::{Area, Lattice, MOST_NODES, SampleJob, Sampled, Where, lattice, sample, sample_at};
pub use verify::{NotVerified, Rerun, VerifyJob, verify};
pub use volume::{Against, Compared, ComparisonError, VolumeJob, volume, volume_at};
pub use watch::{Observer, WRITING};

use crate::formation::{self, Formation};
use crate::model::{LengthUnit, Line, Slope};
use crate::read::{ReadOptions, Source};
use crate::surface::Watch as _;
use crate::validate;
use std::path::PathBuf;

/// The file the line comes from.
#[derive(Clone, Debug)]
pub struct LineInput {
    /// Its path; `-` is standard input.
    pub path: PathBuf,
    /// What is known about its format.
    pub options: ReadOptions,
    /// Make rings of lines that do not end where they begin.
    pub closed: bool,
    /// Make roads of open lines.
    pub formation: Option<Formation>,
    /// Unit of the run, if asked for; `None`: that of the file, else metres.
    pub unit: Option<LengthUnit>,
    /// How far breaklines may miss rings and each other, in plan and in height, in the length unit.
    pub tolerance: f64,
}

/// A line ready for use.
struct Given {
    line: Line,
    source: Source,
    /// Unit of the run: all lengths from here on.
    unit: LengthUnit,
}

/// Reads and checks a line; what is worth knowing goes to `observer`.
fn read_line(input: &LineInput, desk: Desk<'_>, observer: &watch::Stopwatch<'_>) -> Result<Given, Error> {
    observer.stage_of(watch::READING);
    let options = ReadOptions { memory: observer.memory(), ..input.options.clone() };
    let mut raw = desk.line(&input.path, &options)?;
    let unit = input.unit.or(raw.source.unit).unwrap_or_default();
    let converted = units::convert_line(&mut raw, unit);
    raw.notes.extend(converted);
    raw.notes.iter().for_each(|note| observer.note(note));
    observer.stage_of(watch::CHECKING);
    let checked = validate::check(&raw, &validate::Options { closed: input.closed })?;
    checked.notes.iter().for_each(|note| observer.note(note));
    let mut line = checked.line;
    if let Some(road) = &input.formation {
        let formed = formation::widen(&line, &raw.source.label, road)?;
        formed.notes.iter().for_each(|note| observer.note(note));
        line = formed.line;
    }
    let line = formation::place(line, &raw.source.label, input.tolerance)?;
    Ok(Given { line, source: raw.source, unit })
}

/// Refuses segments as steep as the slope.
fn check_steepness(line: &Line, source: &Source, slope: Slope) -> Result<(), Error> {
    Ok(validate::check_steepness(line, &source.label, slope)?)
}
