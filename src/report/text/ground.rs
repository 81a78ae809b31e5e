//! What the report for people says about existing ground.

use crate::model::digits::{self, in_percent};
use crate::model::message::printable;
use crate::report::page::{Column, Group, NAME, NUMBER, Page, Row};
use crate::report::{BulkingFigures, CutFillFigures, DepthPlace, Depths, PadRow, Report, SlopeRange, StationRow, Volumes};
use std::fmt::Write as _;

/// The slope as a section perpendicular to the line shows it.
pub(super) fn section_slope(page: &mut Page, range: SlopeRange) {
    page.words("  in section", &format!("{} (perpendicular to the line)", range.short()));
}

/// Existing ground, finished ground, daylight line.
pub(super) fn terrain(page: &mut Page, report: &Report) {
    if let Some(terrain) = report.terrain {
        page.section("Existing ground");
        page.count("vertices", terrain.vertices);
        page.count("triangles", terrain.triangles);
        page.count("  near the works", terrain.triangles_used);
        page.length("lowest", terrain.z_min);
        page.length("highest", terrain.z_max);
        if let Some(areas) = report.areas {
            page.area("area of cut", areas.cut);
            page.area("area of fill", areas.fill);
            page.area("unaffected", areas.unaffected);
        }
    }
    if let Some(daylight) = report.daylight {
        page.section("Daylight line (lengths in plan)");
        page.count("closed loops", daylight.loops);
        page.length("length", daylight.length);
        page.length("  of cut", daylight.cut_length);
        page.length("  of fill", daylight.fill_length);
        if daylight.open_length > 0.0 {
            page.length("ends off the ground", daylight.open_length);
        }
    }
    if let Some(finished) = report.finished {
        page.section("Finished ground");
        page.count("vertices", finished.vertices);
        page.count("triangles", finished.triangles);
    }
}

/// Parts and figures from sections, cut beside fill.
pub(super) fn volumes(page: &mut Page, volumes: &Volumes) {
    let mut rows: Vec<(&str, CutFillFigures)> = Vec::new();
    if let Some(parts) = volumes.parts {
        rows.extend([("platform", parts.platform), ("slopes", parts.slopes)]);
    }
    rows.extend(volumes.end_area.map(|figures| ("average end area", figures)));
    rows.extend(volumes.prismoidal.map(|figures| ("prismoidal", figures)));
    if rows.is_empty() {
        return;
    }
    let unit = page.unit_of_volume().to_owned();
    let row = |(name, figures): (&str, CutFillFigures)| {
        Row::Cells(vec![name.to_owned(), format!("{:.2} {unit}", figures.cut), format!("{:.2} {unit}", figures.fill)])
    };
    // Numbers stand below those of other figures, their unit behind.
    let number = NUMBER - 2 + 1 + unit.chars().count();
    let name = Column { least: NAME, ..Column::words("") };
    let columns = vec![name, Column::numbers("cut", number), Column::numbers("fill", number)];
    page.table(vec![Group { title: "", columns }], rows.into_iter().map(row).collect());
}

/// What becomes of cut and fill when soil changes its volume.
pub(super) fn bulking(page: &mut Page, soil: BulkingFigures) {
    let [swell, shrink] = [soil.swell, soil.shrink].map(in_percent);
    page.section(&format!("Soil (swell {swell} %, shrink {shrink} %)"));
    page.volume("cut in the ground", soil.cut_bank, " (bank)");
    page.volume("  dug", soil.cut_loose, " (loose)");
    page.volume("  compacted", soil.cut_compacted, "");
    page.volume("fill compacted", soil.fill_compacted, "");
    page.volume("  needed for it", soil.fill_bank, " (bank)");
    page.volume("  dug", soil.fill_loose, " (loose)");
    let (net, balance) = soil.balance.shown(soil.net_bank);
    page.volume("net in the ground", net, &format!(" (bank) {}", balance.word()));
}

/// Greatest and mean depths, with the places of the greatest.
pub(super) fn depths(page: &mut Page, depths: &Depths) {
    for (name, depth, mean, place) in [
        ("deepest cut", depths.cut_max, depths.cut_mean, depths.cut_max_at.as_ref()),
        ("deepest fill", depths.fill_max, depths.fill_mean, depths.fill_max_at.as_ref()),
    ] {
        page.length(name, depth);
        if let Some(mean) = mean {
            page.length("  mean", mean);
        }
        if let Some(place) = place {
            page.words("  at", &self::place(place));
        }
    }
}

fn place(place: &DepthPlace) -> String {
    let mut text = format!("{:.3}, {:.3}", place.x, place.y);
    if let Some(z) = place.z {
        let _ = write!(text, ", {z:.3}");
    }
    if let (Some(chain), Some(station)) = (&place.chain, place.station) {
        let _ = write!(text, " ({chain}, station {station:.3})");
    }
    text
}

/// The table of stations, all of it: whoever asks for stations wants them.
pub(super) fn stations(page: &mut Page, rows: &[StationRow], pads: Option<PadRow>, volumes: Option<&Volumes>) {
    let unit = page.unit_of_volume();
    page.section(&format!("Stations (volumes in {unit}; running net: cut − fill from the beginning of the line)"));
    let compacted = rows.iter().any(|row| row.net_cumulative_compacted.is_some());
    let sections = rows.iter().any(|row| row.sections.is_some());
    let group = |title, names: &[&'static str]| Group::numbers(title, names, LEAST_COLUMN);
    let mut groups = vec![group("", &["from", "to"]), group("exact", &["cut", "fill"])];
    groups.push(group("running net", if compacted { &["as measured", "compacted"] } else { &[""] }));
    if sections {
        groups.extend([group("average end area", &["cut", "fill"]), group("prismoidal", &["cut", "fill"])]);
    }
    let of = |cut: f64, fill: f64| vec![decimals(cut), decimals(fill)];
    let cells = |row: &StationRow| {
        let mut cells = of(row.from, row.to);
        cells.extend(of(row.cut, row.fill));
        cells.push(decimals(row.net_cumulative));
        cells.extend(row.net_cumulative_compacted.map(decimals));
        if let Some(s) = row.sections {
            cells.extend(of(s.average_end_area.cut, s.average_end_area.fill));
            cells.extend(of(s.prismoidal.cut, s.prismoidal.fill));
        }
        cells
    };
    let mut table = Vec::new();
    // Names are needed only to tell lines apart.
    let many = rows.iter().any(|row| row.chain != rows[0].chain);
    let mut chain = None;
    for row in rows {
        if many && chain.replace(&row.chain) != Some(&row.chain) {
            table.push(Row::Heading(printable(&row.chain)));
        }
        table.push(Row::Cells(cells(row)));
    }
    let blank = |count: usize| vec![String::new(); count];
    if let Some(pads) = pads {
        table.push(Row::Labelled("no station", [blank(2), of(pads.cut, pads.fill)].concat()));
    }
    if let Some(v) = volumes {
        let ends = [v.end_area, v.prismoidal].into_iter().flatten().flat_map(|f| of(f.cut, f.fill));
        let cells = [blank(2), of(v.cut, v.fill), blank(if compacted { 2 } else { 1 }), ends.collect()].concat();
        table.push(Row::Labelled("total", cells));
    }
    page.table(groups, table);
}

/// Least width of a column of a table.
const LEAST_COLUMN: usize = 6;

/// A figure of the table.
fn decimals(value: f64) -> String {
    digits::plain(value, 2)
}
