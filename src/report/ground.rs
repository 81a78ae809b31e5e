//! What there is to tell where a design meets existing ground.

use super::volumes::{Balance, BulkingFigures, Depths, mean};
use super::{CutFillFigures, DepthPlace, SlopeFigures, VolumeParts};
use crate::ground::{Amounts, CutFill, Deepest, Section, SectionFigures, SectionSlope, Sectioned, Stations, Tallied, mass_haul};
use crate::kernel::frame::Frame;
use crate::model::Bulking;
use schemars::JsonSchema;
use serde::Serialize;

/// Plan areas of the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct GroundAreas {
    /// Plan area where the design lies below the ground.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Plan area where it lies above.
    #[schemars(range(min = 0))]
    pub fill: f64,
    /// Plan area of the rest of the ground.
    #[schemars(range(min = 0))]
    pub unaffected: f64,
}

/// The line where slopes and ground meet. Lengths are in plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct Daylight {
    /// Number of closed loops.
    pub loops: usize,
    /// Length of the line.
    #[schemars(range(min = 0))]
    pub length: f64,
    /// Length along which the works end further off the ground than the tolerance.
    #[schemars(range(min = 0))]
    pub open_length: f64,
    /// The part of `length` above cut slopes.
    #[schemars(range(min = 0))]
    pub cut_length: f64,
    /// The part of `length` below fill slopes.
    #[schemars(range(min = 0))]
    pub fill_length: f64,
}

/// The existing ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct TerrainFigures {
    /// Vertices of the ground.
    pub vertices: usize,
    /// Triangles of the ground.
    pub triangles: usize,
    /// Triangles near the works: within reach of the slopes by a coarse bound, and under the platform.
    pub triangles_used: usize,
    /// Lowest elevation.
    pub z_min: f64,
    /// Highest elevation.
    pub z_max: f64,
}

/// The finished ground, as written.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct FinishedFigures {
    /// Vertices of the finished ground.
    pub vertices: usize,
    /// Triangles of the finished ground.
    pub triangles: usize,
}

/// The slopes as seen in sections perpendicular to the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct SectionSlopes {
    /// Side slope of cut in a section.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<SlopeRange>,
    /// Side slope of fill in a section.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill: Option<SlopeRange>,
}

/// Flattest and steepest slope.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SlopeRange {
    /// The flattest over the segments of the line.
    pub min: SlopeFigures,
    /// The steepest over the segments of the line.
    pub max: SlopeFigures,
}

impl SlopeRange {
    /// As `1V:1.5H`, or `1V:1.52H to 1V:1.5H` where the two differ.
    pub fn short(self) -> String {
        let (min, max) = (self.min.short(), self.max.short());
        if min == max { max } else { format!("{min} to {max}") }
    }
}

impl From<SectionSlope> for SlopeRange {
    fn from(range: SectionSlope) -> Self {
        Self { min: range.min.into(), max: range.max.into() }
    }
}

/// Cut and fill between two stations of a line.
#[derive(Clone, Debug, PartialEq, Serialize, JsonSchema)]
#[schemars(extend("dependentRequired" = {"section": ["average_end_area", "prismoidal"]}))]
pub struct StationRow {
    /// Name of the line.
    pub chain: String,
    /// Station where the interval begins.
    pub from: f64,
    /// Station where it ends.
    pub to: f64,
    /// Exact volume to be dug away on works whose foot lies between the stations.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Exact volume to be brought there.
    #[schemars(range(min = 0))]
    pub fill: f64,
    /// Plan area of cut.
    #[schemars(range(min = 0))]
    pub cut_area: f64,
    /// Plan area of fill.
    #[schemars(range(min = 0))]
    pub fill_area: f64,
    /// Cut − fill from the beginning of the line to the end of the interval.
    pub net_cumulative: f64,
    /// The same where all soil is compacted: cut × (1 − shrink) − fill.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub net_cumulative_compacted: Option<f64>,
    /// The cross-sections, and the volumes worked out from them.
    #[serde(flatten)]
    pub sections: Option<SectionRow>,
}

/// An interval as cross-sections see it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct SectionRow {
    /// Cross-sections at both ends and half-way.
    pub section: ThreeSections,
    /// Volumes by average end area.
    pub average_end_area: CutFillFigures,
    /// Volumes by the prismoidal formula.
    pub prismoidal: CutFillFigures,
}

/// The sections of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct ThreeSections {
    /// Section where the interval begins.
    pub from: EndArea,
    /// Section half-way.
    pub middle: EndArea,
    /// Section where the interval ends.
    pub to: EndArea,
}

/// End areas of a section, and how far it reaches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, JsonSchema)]
pub struct EndArea {
    /// Area of cut.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Area of fill.
    #[schemars(range(min = 0))]
    pub fill: f64,
    /// Reach of the works to the left of the line.
    pub left: f64,
    /// Reach of the works to the right of the line.
    pub right: f64,
}

impl From<Section> for EndArea {
    fn from(section: Section) -> Self {
        Self { cut: section.area.cut, fill: section.area.fill, left: section.left, right: section.right }
    }
}

impl From<&Sectioned> for SectionRow {
    fn from(interval: &Sectioned) -> Self {
        let [from, middle, to] = interval.sections.map(EndArea::from);
        Self {
            section: ThreeSections { from, middle, to },
            average_end_area: interval.average_end_area.into(),
            prismoidal: interval.prismoidal.into(),
        }
    }
}

impl From<CutFill> for CutFillFigures {
    fn from(figures: CutFill) -> Self {
        Self { cut: figures.cut, fill: figures.fill }
    }
}

/// Works that belong to no station.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, JsonSchema)]
pub struct PadRow {
    /// Volume to be dug away.
    #[schemars(range(min = 0))]
    pub cut: f64,
    /// Volume to be brought.
    #[schemars(range(min = 0))]
    pub fill: f64,
    /// Plan area of cut.
    #[schemars(range(min = 0))]
    pub cut_area: f64,
    /// Plan area of fill.
    #[schemars(range(min = 0))]
    pub fill_area: f64,
}

impl From<Amounts> for PadRow {
    fn from(a: Amounts) -> Self {
        Self { cut: a.cut, fill: a.fill, cut_area: a.cut_area, fill_area: a.fill_area }
    }
}

/// One row for each interval of each axis, in their order. `sections` must be of the same stations.
pub fn station_rows(
    stations: &Stations,
    tallied: &Tallied,
    sections: Option<&SectionFigures>,
    bulking: Option<Bulking>,
) -> Vec<StationRow> {
    let mut rows = Vec::new();
    for (i, (axis, intervals)) in stations.axes().iter().zip(&tallied.axes).enumerate() {
        let sections = sections.and_then(|sections| sections.axes.get(i));
        let hauls = mass_haul(intervals, bulking);
        for (k, (interval, haul)) in intervals.iter().zip(hauls).enumerate() {
            let a = interval.amounts;
            rows.push(StationRow {
                chain: axis.name.clone(),
                from: interval.from,
                to: interval.to,
                cut: a.cut,
                fill: a.fill,
                cut_area: a.cut_area,
                fill_area: a.fill_area,
                net_cumulative: haul.net,
                net_cumulative_compacted: haul.compacted,
                sections: sections.and_then(|sections| sections.get(k)).map(SectionRow::from),
            });
        }
    }
    rows
}

impl VolumeParts {
    /// Platform and slopes of a tally.
    pub fn of(tallied: &Tallied) -> Self {
        let slopes = Amounts::sum([&tallied.fill_slope, &tallied.cut_slope]);
        let figures = |a: &Amounts| CutFillFigures { cut: a.cut, fill: a.fill };
        Self { platform: figures(&tallied.platform), slopes: figures(&slopes) }
    }
}

impl Depths {
    /// Greatest depths of a tally and their places, in world coordinates.
    pub fn of(tallied: &Tallied, stations: &Stations, frame: Frame) -> Self {
        let place = |deepest: &Deepest| {
            let at = frame.to_world(deepest.at.extend(0.0));
            let axis = deepest.station.and_then(|(axis, station)| Some((stations.axes().get(axis as usize)?, station)));
            DepthPlace {
                x: at.x,
                y: at.y,
                z: None,
                chain: axis.map(|(axis, _)| axis.name.clone()),
                station: axis.map(|(_, station)| station),
            }
        };
        let (cut, fill) = (tallied.deepest_cut.as_ref(), tallied.deepest_fill.as_ref());
        Self {
            cut_max: cut.map_or(0.0, |deepest| deepest.depth),
            fill_max: fill.map_or(0.0, |deepest| deepest.depth),
            cut_mean: mean(tallied.total.cut, tallied.total.cut_area),
            fill_mean: mean(tallied.total.fill, tallied.total.fill_area),
            cut_max_at: cut.map(place),
            fill_max_at: fill.map(place),
        }
    }
}

impl BulkingFigures {
    /// What becomes of cut and fill when soil changes its volume.
    pub fn of(cut: f64, fill: f64, soil: Bulking) -> Self {
        let fill_bank = soil.bank_for(fill);
        Self {
            swell: soil.swell(),
            shrink: soil.shrink(),
            cut_bank: cut,
            cut_loose: soil.loose(cut),
            cut_compacted: soil.compacted(cut),
            fill_compacted: fill,
            fill_bank,
            fill_loose: soil.loose(fill_bank),
            net_bank: cut - fill_bank,
            balance: Balance::of(cut, fill_bank),
        }
    }
}
