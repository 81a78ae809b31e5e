//! What there is to draw.

use crate::ground::{Pieces, Stations, Tallied};
use crate::model::{Bulking, LengthUnit, Line, LineFeature, Terrain, Tin};

/// A design and what surrounds it. The frame of `design` is that of the ground, if there is ground.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// Name of the job: the input as given.
    pub title: &'a str,
    /// Unit of all lengths.
    pub unit: LengthUnit,
    /// Name of the coordinate system, if known.
    pub crs: Option<&'a str>,
    /// The given line, in world coordinates.
    pub line: &'a Line,
    /// Platform and slopes; with ground cut off at it.
    pub design: &'a Tin,
    /// Line work, in world coordinates.
    pub lines: &'a [LineFeature],
    /// How the soil changes its volume, if that is reckoned with.
    pub bulking: Option<Bulking>,
    /// The existing ground.
    pub ground: Option<OnGround<'a>>,
}

impl Scene<'_> {
    /// The title without folders.
    pub(super) fn name(&self) -> &str {
        self.title.rsplit(['/', '\\']).next().filter(|name| !name.is_empty()).unwrap_or(self.title)
    }
}

/// The existing ground and the works on it.
#[derive(Clone, Copy, Debug)]
pub struct OnGround<'a> {
    /// The ground as given, in the frame of the design.
    pub terrain: &'a Terrain,
    /// The works in convex pieces, each with the difference of design and ground, in the frame of the design.
    pub pieces: &'a Pieces,
    /// The axes and their intervals.
    pub stations: &'a Stations,
    /// Cut and fill by part and interval.
    pub tallied: &'a Tallied,
}
