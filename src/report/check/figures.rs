//! The figures of a check, as they stand in its report.

use crate::mesh::quality::{Bound, Finding, Kept, Kind, Loop, Place, Severity, Share, Slopes};
use crate::model::Slope;
use crate::report::SlopeFigures;
use schemars::JsonSchema;
use serde::Serialize;
use std::collections::BTreeMap;

/// A place with the figures found there.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PlaceFigures {
    /// World coordinates.
    pub at: [f64; 3],
    /// Numbers of faces, counted from 1 in the order of the file.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub triangles: Vec<usize>,
    /// Numbers of vertices, counted from 1.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub vertices: Vec<usize>,
    /// Figures found there, by their names.
    #[serde(flatten)]
    pub figures: BTreeMap<&'static str, f64>,
}

impl From<&Place> for PlaceFigures {
    fn from(place: &Place) -> Self {
        Self {
            at: place.at.to_array(),
            triangles: place.triangles.clone(),
            vertices: place.vertices.clone(),
            figures: place.figures.iter().copied().collect(),
        }
    }
}

/// All there is of one kind.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct FindingFigures {
    /// Stable name.
    #[schemars(extend("enum" = Kind::ALL.map(Kind::code)))]
    pub code: &'static str,
    /// An error makes the surface unsound, a remark does not.
    #[schemars(extend("enum" = ["error", "remark"]))]
    pub severity: &'static str,
    /// How many there are.
    pub count: usize,
    /// Counting was given up; there may be more.
    pub at_least: bool,
    /// What is counted.
    pub message: &'static str,
    /// Some places: the worst, or the first.
    pub places: Vec<PlaceFigures>,
}

impl From<&Finding> for FindingFigures {
    fn from(finding: &Finding) -> Self {
        Self {
            code: finding.kind.code(),
            severity: if finding.severity == Severity::Error { "error" } else { "remark" },
            count: finding.count,
            at_least: finding.at_least,
            message: finding.kind.what(finding.count),
            places: finding.places.iter().map(PlaceFigures::from).collect(),
        }
    }
}

/// The boundary of the surface.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BoundaryFigures {
    /// Number of loops around pieces.
    pub outer: usize,
    /// Number of loops around holes.
    pub holes: usize,
    /// Number of loops along seams that are not joined.
    pub seams: usize,
    /// Number of stretches that do not close.
    pub unclosed: usize,
    /// Length of all in plan.
    #[schemars(range(min = 0))]
    pub length: f64,
    /// The longest of them.
    pub loops: Vec<LoopFigures>,
}

/// A loop of the boundary.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct LoopFigures {
    /// What it runs around, or along.
    #[schemars(extend("enum" = ["outer", "hole", "seam", "unclosed"]))]
    pub kind: &'static str,
    /// Edges of the loop.
    pub edges: usize,
    /// Plan length.
    #[schemars(range(min = 0))]
    pub length: f64,
    /// Plan area it surrounds.
    #[schemars(range(min = 0))]
    pub area: f64,
    /// First vertex, world coordinates.
    pub at: [f64; 3],
}

/// Some triangles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ShareFigures {
    /// Number of triangles.
    pub triangles: usize,
    /// Their area in space.
    #[schemars(range(min = 0))]
    pub area: f64,
    /// Share of the area, 0 to 1.
    #[schemars(range(min = 0, max = 1))]
    pub share: f64,
}

impl ShareFigures {
    pub(super) fn new(of: &Share, all: f64) -> Self {
        Self { triangles: of.triangles, area: of.area, share: if all > 0.0 { (of.area / all).min(1.0) } else { 0.0 } }
    }
}

/// The slope of one triangle.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ExtremeFigures {
    /// Angle in degrees.
    pub degrees: f64,
    /// The triangle.
    #[serde(flatten)]
    pub place: PlaceFigures,
}

/// One bin of a histogram.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BinFigures {
    /// From this angle on, degrees.
    pub from: f64,
    /// Up to this angle, degrees.
    pub to: f64,
    /// What is in it.
    #[serde(flatten)]
    pub share: ShareFigures,
}

/// A slope much of the surface has.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct CommonFigures {
    /// Angle in degrees.
    pub degrees: f64,
    /// Run per unit of rise.
    pub one_in: f64,
    /// Share of the area, 0 to 1.
    #[schemars(range(min = 0, max = 1))]
    pub share: f64,
}

/// Slopes of a surface or a part.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SlopesFigures {
    /// Triangles with an area.
    pub triangles: usize,
    /// Their area in plan.
    #[schemars(range(min = 0))]
    pub plan_area: f64,
    /// Their area in space.
    #[schemars(range(min = 0))]
    pub surface_area: f64,
    /// Triangles too low for an angle to be told; the rest is about the others.
    pub thin: ShareFigures,
    /// Triangles flatter than 0.1°.
    pub level: ShareFigures,
    /// Triangles steeper than 89.9°.
    pub upright: ShareFigures,
    /// Mean over area, degrees.
    #[schemars(range(min = 0, max = 90))]
    pub mean_degrees: f64,
    /// The flattest triangle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub flattest: Option<ExtremeFigures>,
    /// The steepest triangle.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub steepest: Option<ExtremeFigures>,
    /// Up to three slopes that 2 % of the area or more have.
    pub common: Vec<CommonFigures>,
    /// Bins of one degree that hold something.
    pub histogram: Vec<BinFigures>,
}

impl From<&Slopes> for SlopesFigures {
    fn from(s: &Slopes) -> Self {
        let told = s.all.area - s.thin.area;
        let extreme = |found: &Option<(f64, Place)>| {
            found.as_ref().map(|(degrees, place)| ExtremeFigures { degrees: *degrees, place: place.into() })
        };
        let bin =
            |(i, bin): (usize, &Share)| BinFigures { from: i as f64, to: i as f64 + 1.0, share: ShareFigures::new(bin, told) };
        Self {
            triangles: s.all.triangles,
            plan_area: s.plan_area,
            surface_area: s.all.area,
            thin: ShareFigures::new(&s.thin, s.all.area),
            level: ShareFigures::new(&s.level, told),
            upright: ShareFigures::new(&s.upright, told),
            mean_degrees: s.mean,
            flattest: extreme(&s.flattest),
            steepest: extreme(&s.steepest),
            common: s
                .common
                .iter()
                .map(|c| CommonFigures {
                    degrees: c.degrees,
                    one_in: 1.0 / c.degrees.to_radians().tan(),
                    share: c.share.min(1.0),
                })
                .collect(),
            histogram: s.bins.iter().enumerate().filter(|(_, b)| b.triangles > 0).map(bin).collect(),
        }
    }
}

/// A part of the surface.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct PartFigures {
    /// Name of the group.
    pub name: String,
    /// Slopes of the part.
    #[serde(flatten)]
    pub slopes: SlopesFigures,
}

/// Smallest angles.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct AngleFigures {
    /// The smallest angle of all.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub smallest: Option<ExtremeFigures>,
    /// How many triangles have their smallest angle in a range.
    pub histogram: Vec<AngleBin>,
}

/// One bin of smallest angles.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct AngleBin {
    /// From this angle on, degrees.
    pub from: f64,
    /// Up to this angle, degrees.
    pub to: f64,
    /// Number of triangles.
    pub triangles: usize,
}

/// How the slope asked for is kept.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
pub struct BoundFigures {
    /// The slope asked for.
    pub slope: SlopeFigures,
    /// Deviation in degrees within which a triangle is on it.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance_deg: f64,
    /// Share of the area that may be off it, 0 to 1.
    #[schemars(range(min = 0, max = 1))]
    pub max_off: f64,
    /// Parts it is about; empty: all that is not level.
    pub parts: Vec<String>,
    /// Whether it is kept.
    pub passed: bool,
    /// Triangles on it.
    pub within: ShareFigures,
    /// Triangles off it.
    pub off: ShareFigures,
    /// Level triangles left out.
    pub level: ShareFigures,
    /// Triangles too low for an angle to be told, left out.
    pub thin: ShareFigures,
    /// Triangles that deviate most.
    pub worst: Vec<PlaceFigures>,
}

impl BoundFigures {
    pub(super) fn new(bound: &Bound, kept: &Kept, names: &[String]) -> Self {
        let both = kept.within.area + kept.off.area;
        let name = |group: &u32| names.get(*group as usize).cloned();
        Self {
            slope: bound.slope.into(),
            tolerance_deg: bound.tolerance_deg,
            max_off: bound.most_off,
            parts: bound.groups.iter().flatten().filter_map(name).collect(),
            passed: kept.passed,
            within: ShareFigures::new(&kept.within, both),
            off: ShareFigures::new(&kept.off, both),
            level: ShareFigures::new(&kept.level, kept.level.area + both),
            thin: ShareFigures::new(&kept.thin, kept.thin.area + both),
            worst: kept.worst.iter().map(PlaceFigures::from).collect(),
        }
    }

    /// The slope as such.
    pub fn wanted(&self) -> Option<Slope> {
        Slope::from_ratio(self.slope.ratio)
    }
}

impl From<&Loop> for LoopFigures {
    fn from(l: &Loop) -> Self {
        Self { kind: l.kind.name(), edges: l.edges, length: l.length, area: l.area, at: l.place.at.to_array() }
    }
}
