//! The engine's figures in the words of the report.

mod on_ground;

pub(super) use on_ground::{Inputs, ground_report};

use crate::model::{Chain, Design, Line, Note, Sheet, Tin};
use crate::read::Source;
use crate::report::{
    Balance, BuriedStretch, Certificate, Depths, DesignFigures, Detail, Input, LineFigures, METHOD, METHOD_TEXT, Reference,
    Report, SCHEMA, SIGN_RULE, Slopes, SurfaceFigures, Timing, Tool, Units, Volumes, Warning,
};
use crate::surface::{self, Areas, Surface};
use std::collections::BTreeMap;

/// The report of a run; its times are still to be filled in.
pub(super) fn report(line: &Line, source: &Source, design: &Design, surface: &Surface, notes: &[Note]) -> Report {
    let slope = Some(design.slope.into());
    let slopes = match design.sheet {
        Sheet::Falling => Slopes { fill: slope, ..Slopes::default() },
        Sheet::Rising => Slopes { cut: slope, ..Slopes::default() },
    };
    let mut levels = surface.levels.clone();
    levels.sort_by(f64::total_cmp);
    let v = &surface.volumes;
    let buried = buried(line, surface);
    let mut warnings = Warning::all(notes);
    if let Some(warning) = warnings.iter_mut().find(|warning| warning.code == BURIED) {
        warning.details = buried_details(&buried);
    }
    Report {
        schema: SCHEMA,
        tool: Tool::default(),
        inputs: vec![input("line", source)],
        units: Units::default(),
        design: DesignFigures::of([design], design.interval),
        slopes,
        line: line_figures(line, (surface.simplified, surface.simplified_max), buried),
        extent: design.extent.into(),
        levels,
        surface: surface_figures(&surface.tin, &surface.areas),
        certificate: certificate(&surface.certificate),
        volumes: Some(Volumes {
            method: METHOD,
            method_text: METHOD_TEXT,
            cut: v.cut,
            fill: v.fill,
            net: v.cut - v.fill,
            sign_rule: SIGN_RULE,
            balance: Balance::of(v.cut, v.fill),
            error_bound: v.error_bound,
            complete: true,
            reference: Reference::plane(v.reference),
            parts: None,
            bulking: None,
            end_area: None,
            prismoidal: None,
        }),
        areas: None,
        depths: Some(Depths { cut_max: v.cut_max, fill_max: v.fill_max, ..Depths::default() }),
        daylight: None,
        stations: None,
        pads: None,
        section_slope: None,
        terrain: None,
        finished: None,
        warnings,
        run: None,
        result: None,
        timing: Timing::default(),
    }
}

/// Code of the note about buried stretches.
pub(super) const BURIED: &str = "buried";

/// The note about buried stretches, if there are any.
pub(super) fn buried_note(stretches: &[BuriedStretch]) -> Option<Note> {
    let depth = stretches.iter().map(|stretch| stretch.depth).fold(0.0, f64::max);
    let text = match stretches.len() {
        0 => return None,
        1 => "a stretch of the line lies".to_owned(),
        n => format!("{n} stretches of the line lie"),
    };
    Some(Note::new(BURIED, format!("{text} under the slope of another part, up to {depth:.3} deep: the report names the places")))
}

fn buried_details(stretches: &[BuriedStretch]) -> BTreeMap<&'static str, Detail> {
    let deepest = stretches.iter().max_by(|a, b| a.depth.total_cmp(&b.depth));
    let mut details = BTreeMap::from([("count", Detail::Count(stretches.len() as u64))]);
    if let Some(deepest) = deepest {
        details.insert("chain", Detail::Text(deepest.chain.clone()));
        details.insert("depth", Detail::Number(deepest.depth));
    }
    details
}

fn surface_figures(tin: &Tin, areas: &Areas) -> SurfaceFigures {
    SurfaceFigures {
        vertices: tin.vertices.len(),
        triangles: tin.triangles.len(),
        plan_area: areas.plan,
        slope_area: areas.fill_slope + areas.cut_slope,
        fill_slope_area: areas.fill_slope,
        cut_slope_area: areas.cut_slope,
        platform_area: areas.platform,
    }
}

pub(super) fn input(role: &str, source: &Source) -> Input {
    Input {
        role: role.to_owned(),
        path: if source.label == "<stdin>" { "-".to_owned() } else { source.label.clone() },
        bytes: source.bytes,
        sha256: source.sha256.clone(),
        format: source.format.name().to_owned(),
        crs: source.crs.clone(),
    }
}

/// Buried stretches with the names of their chains.
pub(super) fn buried(line: &Line, surface: &Surface) -> Vec<BuriedStretch> {
    let name = |chain: usize| line.chains.get(chain).map(|chain| chain.name.clone()).unwrap_or_default();
    let stretch = |b: &crate::surface::Buried| BuriedStretch {
        chain: name(b.chain),
        from: b.from,
        to: b.to,
        depth: b.depth,
        by_chain: name(b.by_chain),
        by_station: b.by_station,
        free_slope: b.free_slope,
    };
    surface.buried.iter().map(stretch).collect()
}

fn line_figures(line: &Line, simplified: (usize, f64), buried: Vec<BuriedStretch>) -> LineFigures {
    let (z_min, z_max) = line.elevation_range();
    let segments = line.chains.iter().flat_map(|chain| {
        // The ends of a road lie across it.
        let across = |i: usize| chain.axis.as_ref().is_some_and(|axis| axis.stations[i] == axis.stations[i + 1]);
        (0..chain.segment_count()).filter(move |&i| !across(i)).map(|i| chain.segment(i))
    });
    let length = |chain: &Chain| match &chain.axis {
        Some(axis) => axis.length,
        None => chain.stations().last().copied().unwrap_or(0.0),
    };
    let gradients = segments.map(|(a, b)| (b.z - a.z).abs() / a.truncate().distance(b.truncate()));
    LineFigures {
        chains: line.chains.len(),
        vertices: line.vertex_count(),
        simplified: simplified.0,
        simplified_max: simplified.1,
        length: line.chains.iter().map(length).sum(),
        width: None,
        crossfall: None,
        breaklines: line.breaklines.iter().filter(|breakline| breakline.stations.is_none()).count(),
        z_min,
        z_max,
        gradient_max: gradients.fold(0.0, f64::max),
        buried,
    }
}

/// The engine's certificate as reported.
fn certificate(c: &surface::Certificate) -> Certificate {
    Certificate {
        paired: c.paired,
        slope_max_deviation_deg: c.strip_max_deviation_deg.max(c.sector_max_deviation_deg),
        strip_max_deviation_deg: c.strip_max_deviation_deg,
        sector_max_deviation_deg: c.sector_max_deviation_deg,
        triangles_beyond_0_1deg: c.triangles_beyond_0_1deg,
        height_max_deviation: c.height_max_deviation,
        manifold: c.manifold,
        overlaps: c.overlaps,
        input_edges_kept: c.input_edges_kept,
    }
}
