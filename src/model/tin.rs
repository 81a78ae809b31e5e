//! Triangulated surfaces and line work, the products of the program.

use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use glam::DVec3;

/// What a triangle belongs to. The numbers are the `part` property of PLY files, the names the groups of OBJ files.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[repr(u8)]
pub enum Part {
    /// Finished level or surface bounded by the line (or the floor of a pit).
    Platform = 0,
    /// Falling slope.
    FillSlope = 1,
    /// Rising slope.
    CutSlope = 2,
    /// Existing ground.
    Ground = 3,
}

impl Part {
    /// All parts, in numerical order.
    pub const ALL: [Self; 4] = [Self::Platform, Self::FillSlope, Self::CutSlope, Self::Ground];

    /// Name in OBJ groups and reports.
    pub fn name(self) -> &'static str {
        match self {
            Self::Platform => "platform",
            Self::FillSlope => "fill_slope",
            Self::CutSlope => "cut_slope",
            Self::Ground => "ground",
        }
    }
}

/// A triangulated surface, single-valued in z (2.5D), triangles counter-clockwise seen from above.
#[derive(Clone, Debug)]
pub struct Tin {
    /// Shift between world and the coordinates in `vertices`.
    pub frame: Frame,
    /// Vertices in the local frame.
    pub vertices: Vec<DVec3>,
    /// Vertex indices, counter-clockwise in plan.
    pub triangles: Vec<[u32; 3]>,
    /// Part of each triangle; same length as `triangles`.
    pub parts: Vec<Part>,
}

impl Tin {
    /// Vertex `i` in world coordinates.
    pub fn world(&self, i: usize) -> DVec3 {
        self.frame.to_world(self.vertices[i])
    }

    /// Corners of triangle `t` in the local frame.
    pub fn corners(&self, t: usize) -> [DVec3; 3] {
        self.triangles[t].map(|v| self.vertices[v as usize])
    }

    /// Plan box of all vertices in the local frame.
    pub fn plan_box(&self) -> PlanBox {
        PlanBox::of(self.vertices.iter().map(|v| v.truncate()))
    }
}

/// Kind of a line in the line work (`kind` property of `--lines` files).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum CurveKind {
    /// Curve of constant elevation on the slope.
    LevelCurve,
    /// Crease where two slopes meet that is higher than its surroundings.
    Ridge,
    /// Crease that is lower than its surroundings.
    Valley,
    /// The given line.
    Hinge,
    /// A line on the platform: given, or the centre line of a road.
    Breakline,
    /// Where the slope ends.
    Boundary,
    /// Where the works meet the ground.
    Daylight,
    /// Where a platform changes from cut to fill.
    Zero,
}

impl CurveKind {
    /// Value of the `kind` property.
    pub fn name(self) -> &'static str {
        match self {
            Self::LevelCurve => "level_curve",
            Self::Ridge => "ridge",
            Self::Valley => "valley",
            Self::Hinge => "hinge",
            Self::Breakline => "breakline",
            Self::Boundary => "boundary",
            Self::Daylight => "daylight",
            Self::Zero => "zero",
        }
    }
}

/// One polyline of the line work, its vertices vertices of the mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct LineFeature {
    /// What it is.
    pub kind: CurveKind,
    /// Points in world coordinates; the first is repeated at the end of closed curves.
    pub points: Vec<DVec3>,
    /// Elevation of a level curve.
    pub elevation: Option<f64>,
    /// Name of the chain a hinge comes from, or of the breakline.
    pub chain: Option<String>,
    /// The part that meets the ground along a daylight line.
    pub part: Option<Part>,
}
