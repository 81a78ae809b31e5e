//! What there is to tell where a design meets existing ground.

use super::volumes::{Balance, BulkingFigures, Depths};
use super::{CutFillFigures, DepthPlace, SlopeFigures, VolumeParts};
use crate::ground::{Amounts, CutFill, Deepest, Section, SectionFigures, SectionSlope, Sectioned, Stations, Tallied, mass_haul};
use crate::kernel::frame::Frame;
use crate::model::Bulking;
use serde::Serialize;

/// Plan areas of the ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct GroundAreas {
    /// Where the design lies below the ground.
    pub cut: f64,
    /// Where it lies above.
    pub fill: f64,
    /// The rest of the ground.
    pub unaffected: f64,
}

/// The line where slopes and ground meet. Lengths are in plan.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Daylight {
    /// Closed loops.
    pub loops: usize,
    /// Length of all of it.
    pub length: f64,
    /// Length along which slopes end at the edge of the ground, before they meet it.
    pub open_length: f64,
    /// The part of `length` above cut slopes.
    pub cut_length: f64,
    /// The part of `length` below fill slopes.
    pub fill_length: f64,
}

/// The existing ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct TerrainFigures {
    /// Vertices of the file.
    pub vertices: usize,
    /// Its triangles.
    pub triangles: usize,
    /// Those the works lie on.
    pub triangles_used: usize,
    /// Lowest elevation.
    pub z_min: f64,
    /// Highest elevation.
    pub z_max: f64,
}

/// The finished ground.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct FinishedFigures {
    /// Its vertices.
    pub vertices: usize,
    /// Its triangles.
    pub triangles: usize,
}

/// The slopes as seen in sections perpendicular to the line.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct SectionSlopes {
    /// Of the rising sheet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub cut: Option<SlopeRange>,
    /// Of the falling sheet.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fill: Option<SlopeRange>,
}

/// Flattest and steepest slope.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SlopeRange {
    /// The flattest.
    pub min: SlopeFigures,
    /// The steepest.
    pub max: SlopeFigures,
}

impl From<SectionSlope> for SlopeRange {
    fn from(range: SectionSlope) -> Self {
        Self { min: range.min.into(), max: range.max.into() }
    }
}

/// Cut and fill between two stations of a line.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StationRow {
    /// Name of the line.
    pub chain: String,
    /// Station where the interval begins.
    pub from: f64,
    /// Station where it ends.
    pub to: f64,
    /// Exact volume to be dug away on works whose foot lies between the stations.
    pub cut: f64,
    /// Exact volume to be brought likewise.
    pub fill: f64,
    /// Plan area of cut.
    pub cut_area: f64,
    /// Plan area of fill.
    pub fill_area: f64,
    /// Cut − fill from the beginning of the line to the end of the interval.
    pub net_cumulative: f64,
    /// The same where all soil is compacted.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub net_cumulative_compacted: Option<f64>,
    /// The cross-sections, and the volumes worked out from them.
    #[serde(flatten)]
    pub sections: Option<SectionRow>,
}

/// An interval as cross-sections see it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct SectionRow {
    /// The sections.
    pub section: ThreeSections,
    /// Volumes by average end area.
    pub average_end_area: CutFillFigures,
    /// Volumes by the prismoidal formula.
    pub prismoidal: CutFillFigures,
}

/// The sections of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct ThreeSections {
    /// Where it begins.
    pub from: EndArea,
    /// Half-way.
    pub middle: EndArea,
    /// Where it ends.
    pub to: EndArea,
}

/// End areas of a section, and how far it reaches.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct EndArea {
    /// Area of cut.
    pub cut: f64,
    /// Area of fill.
    pub fill: f64,
    /// Reach to the left of the line.
    pub left: f64,
    /// Reach to the right.
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
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct PadRow {
    /// Volume to be dug away.
    pub cut: f64,
    /// Volume to be brought.
    pub fill: f64,
    /// Plan area of cut.
    pub cut_area: f64,
    /// Plan area of fill.
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
