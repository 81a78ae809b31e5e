//! The report of a design on existing ground.

use super::{certificate, input, line_figures, surface_figures};
use crate::ground::{Ground, section_slope};
use crate::model::{Design, Line, Note, Sheet};
use crate::pipeline::BuildJob;
use crate::read::Source;
use crate::report::{
    Balance, BulkingFigures, Daylight, Depths, DesignFigures, ExtentFigures, FinishedFigures, GroundAreas, METHOD, METHOD_TEXT,
    Reference, Report, SCHEMA, SIGN_RULE, SectionSlopes, Slopes, TerrainFigures, Timing, Tool, Units, VolumeParts, Volumes,
    Warning, station_rows,
};

/// What the design was built from.
pub(in crate::pipeline) struct Inputs<'a> {
    pub(in crate::pipeline) line: &'a Line,
    pub(in crate::pipeline) source: &'a Source,
    pub(in crate::pipeline) ground: &'a Source,
    /// Figures of the ground as given.
    pub(in crate::pipeline) terrain: TerrainFigures,
    /// Its plan area.
    pub(in crate::pipeline) area: f64,
}

/// The report of a build on existing ground; its times are still to be filled in.
pub(in crate::pipeline) fn ground_report(
    inputs: &Inputs<'_>,
    job: &BuildJob,
    designs: &[Design],
    built: &Ground,
    notes: &[Note],
) -> Report {
    let of = |sheet: Sheet| designs.iter().find(|design| design.sheet == sheet).map(|design| design.slope);
    let seen = |sheet| of(sheet).and_then(|slope| section_slope(inputs.line, slope)).map(Into::into);
    let mut levels = built.levels.clone();
    levels.sort_by(f64::total_cmp);
    let total = &built.tallied.total;
    let extent = job.wishes.iter().find_map(|wishes| wishes.extent);
    let by_station = built.stations.spacing().is_some();
    Report {
        schema: SCHEMA,
        tool: Tool::default(),
        inputs: vec![input("line", inputs.source), input("terrain", inputs.ground)],
        units: Units::default(),
        design: DesignFigures::of(designs, job.wishes.iter().find_map(|wishes| wishes.interval)),
        slopes: Slopes { fill: of(Sheet::Falling).map(Into::into), cut: of(Sheet::Rising).map(Into::into), ..Slopes::default() },
        line: line_figures(inputs.line, (built.simplified, built.simplified_max), Vec::new()),
        extent: extent.map_or(ExtentFigures::GROUND, Into::into),
        levels,
        surface: surface_figures(&built.design, &built.areas),
        certificate: certificate(&built.certificate),
        volumes: Some(Volumes {
            method: METHOD,
            method_text: METHOD_TEXT,
            cut: total.cut,
            fill: total.fill,
            net: total.net(),
            sign_rule: SIGN_RULE,
            balance: Balance::of(total.cut, total.fill),
            error_bound: built.error_bound,
            complete: built.complete,
            reference: Reference::terrain(&inputs.ground.label),
            parts: Some(VolumeParts::of(&built.tallied)),
            bulking: job.bulking.map(|soil| BulkingFigures::of(total.cut, total.fill, soil)),
            end_area: built.sections.as_ref().map(|sections| sections.average_end_area.into()),
            prismoidal: built.sections.as_ref().map(|sections| sections.prismoidal.into()),
        }),
        areas: Some(GroundAreas {
            cut: total.cut_area,
            fill: total.fill_area,
            unaffected: (inputs.area - total.cut_area - total.fill_area).max(0.0),
        }),
        depths: Some(Depths::of(&built.tallied, &built.stations, built.design.frame)),
        daylight: Some(Daylight {
            loops: built.daylight.loops,
            length: built.daylight.length,
            open_length: built.daylight.open_length,
            cut_length: built.daylight.cut_length,
            fill_length: built.daylight.fill_length,
        }),
        stations: by_station.then(|| station_rows(&built.stations, &built.tallied, built.sections.as_ref(), job.bulking)),
        pads: (by_station && built.tallied.pads.plan_area() > 0.0).then(|| built.tallied.pads.into()),
        section_slope: Some(SectionSlopes { cut: seen(Sheet::Rising), fill: seen(Sheet::Falling) }),
        terrain: Some(TerrainFigures { triangles_used: built.ground_used, ..inputs.terrain }),
        finished: built
            .finished
            .as_ref()
            .map(|tin| FinishedFigures { vertices: tin.vertices.len(), triangles: tin.triangles.len() }),
        warnings: Warning::all(notes),
        run: None,
        result: None,
        timing: Timing::default(),
    }
}
