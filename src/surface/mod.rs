//! The finished surface: everything about one line and one design, from the network to the certificate.

mod body;
mod buried;
mod certificate;
pub mod curves;
mod ends;
mod error;
pub(crate) mod error_bound;
mod feet;
mod flats;
mod formation;
mod make;
mod room;
mod solve;
mod stations;
mod touching;

pub use buried::Buried;
pub use certificate::Certificate;
pub(crate) use certificate::{CONE_BOUND, Deviations, MEASURABLE_HEIGHT, STRIP_BOUND, flaw, height_deviation, height_rounding};
pub use curves::Mark;
pub use error::SurfaceError;
pub use feet::Foot;
pub(crate) use touching::{in_spite_of_touching, note as joggle_note};

use crate::kernel::sum::Sum;
use crate::mesh::volume;
use crate::model::{Design, Line, LineFeature, Memory, Note, Part, Tin};
use make::{Plane, made};

/// What a long run tells its caller.
pub trait Watch: Sync {
    /// A stage begins.
    fn stage(&self, _name: &'static str) {}

    /// Whether to stop.
    fn cancelled(&self) -> bool {
        false
    }

    /// How much memory the run may take.
    fn memory(&self) -> Memory {
        Memory::default()
    }
}

/// Nobody watches.
impl Watch for () {}

/// Plan and true areas.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Areas {
    /// Plan area of everything.
    pub plan: f64,
    /// True area of everything.
    pub slope: f64,
    /// True area of falling slopes.
    pub fill_slope: f64,
    /// True area of rising slopes.
    pub cut_slope: f64,
    /// True area of platforms and floors.
    pub platform: f64,
}

impl Areas {
    /// The areas of a mesh, by its parts.
    pub fn of(tin: &Tin) -> Self {
        let mut plan = Sum::default();
        let mut parts = [Sum::default(); 4];
        for (t, &part) in tin.parts.iter().enumerate() {
            let [a, b, c] = tin.corners(t);
            plan.add(volume::plan_area([a, b, c]));
            parts[part as usize].add(0.5 * (b - a).cross(c - a).length());
        }
        let of = |part: Part| parts[part as usize].value();
        let (platform, fill_slope, cut_slope) = (of(Part::Platform), of(Part::FillSlope), of(Part::CutSlope));
        Self { plan: plan.value(), slope: platform + fill_slope + cut_slope, fill_slope, cut_slope, platform }
    }
}

/// Volumes against a horizontal plane.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Volumes {
    /// Volume where the surface lies below the plane.
    pub cut: f64,
    /// Volume where it lies above.
    pub fill: f64,
    /// Bound for the error of either through simplification and chords.
    pub error_bound: f64,
    /// Elevation of the plane.
    pub reference: f64,
    /// Greatest depth below the plane.
    pub cut_max: f64,
    /// Greatest height above it.
    pub fill_max: f64,
}

/// Where a platform vertex of a road stands on the centre line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlatformStation {
    /// The mesh vertex.
    pub vertex: u32,
    /// The chain: a road.
    pub chain: u32,
    /// Station on its centre line.
    pub station: f64,
}

/// A surface of constant slope with its platform, and what was measured on it.
#[derive(Clone, Debug)]
pub struct Surface {
    /// The mesh.
    pub tin: Tin,
    /// Level curves, creases, hinge and boundary.
    pub lines: Vec<LineFeature>,
    /// Mesh edges that are more than diagonals, lower vertex first, in order. Levels are numbered as in `levels`.
    pub marks: Vec<(Mark, [u32; 2])>,
    /// The facets that slope triangles lie in.
    pub feet: Vec<Foot>,
    /// The facet of each slope triangle, an index into `feet`; slope triangles come first in the mesh.
    pub foot_of: Vec<u32>,
    /// Platform vertices of roads (chains with an axis) with their stations on the centre line, by vertex and chain. The stations
    /// of a point of a platform triangle are those of its corners, linear between them.
    pub platform_stations: Vec<PlatformStation>,
    /// Elevations of the level curves, from the top down.
    pub levels: Vec<f64>,
    /// Given vertices moved onto a chord.
    pub simplified: usize,
    /// Given vertices that lie on the straight line between their neighbours.
    pub collinear: usize,
    /// Largest displacement of a simplified vertex, `|Δz| + k·|Δplan|`.
    pub simplified_max: f64,
    /// Stretches of the line below the slope of another part.
    pub buried: Vec<Buried>,
    /// What was measured on the mesh.
    pub certificate: Certificate,
    /// Areas.
    pub areas: Areas,
    /// Volumes against the reference plane.
    pub volumes: Volumes,
    /// Things worth knowing.
    pub notes: Vec<Note>,
}

/// Builds the surface of `design` on `line`; `reference` is the elevation of the plane for volumes, by default the one where
/// the slopes end (the highest rim vertex of a falling slope inside a ring, the lowest of a rising one).
///
/// Expects a validated line, every segment flatter than the slope.
///
/// # Errors
/// See [`SurfaceError`]; a surface whose certificate fails is an error, never a result.
pub fn build(line: &Line, design: &Design, reference: Option<f64>, watch: &dyn Watch) -> Result<Surface, SurfaceError> {
    in_spite_of_touching(design.tolerance, SurfaceError::is_flaw, |joggle| {
        let mut surface = made(line, &Design { joggle, ..design.clone() }, Some(&Plane { reference }), watch)?;
        surface.notes.extend(joggle.map(|joggle| joggle_note(joggle, design.one_sided(line))));
        Ok(surface)
    })
    .map_err(|error| if watch.cancelled() { SurfaceError::Cancelled } else { error })
}

/// The same surface with its certificate, but without line work, areas and volumes: for those who cut it first.
///
/// # Errors
/// As [`build`].
pub fn build_uncut(line: &Line, design: &Design, watch: &dyn Watch) -> Result<Surface, SurfaceError> {
    made(line, design, None, watch)
}
