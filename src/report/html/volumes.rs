//! Cut and fill on the page of `build`: measured, with the change in volume of the soil, by part, by station.

use super::parts::{Units, name, number, plain};
use crate::model::digits::in_percent;
use crate::report::{Balance, BulkingFigures, CutFillFigures, PadRow, Report, StationRow, Volumes};
use maud::{Markup, html};

/// Most rows of stations on a page; browsers get slow beyond.
pub(super) const MOST_ROWS: usize = 5000;

/// `629.16 m³ surplus`, in words.
pub(super) fn net(net: f64, balance: Balance, units: Units<'_>) -> Markup {
    let (net, balance) = balance.shown(net);
    let amount = units.volume(net.abs());
    html! {
        @match balance {
            Balance::Surplus => { "a " strong { "surplus of " (amount) } ", soil is left over" }
            Balance::Deficit => { "a " strong { "deficit of " (amount) } ", soil must be brought" }
            Balance::Balanced => { strong { "balanced" } }
        }
    }
}

/// A share as percent, with the digits it was typed with.
pub(super) fn percent(share: f64) -> String {
    format!("{} %", in_percent(share)).replace('-', "−")
}

pub(super) fn volumes(report: &Report, v: &Volumes, units: Units<'_>) -> Markup {
    let against = match (v.reference.elevation, &v.reference.path) {
        (Some(z), _) => html! { "the level plane at elevation " (z) " " (units.0) },
        (None, Some(path)) => html! { "the existing ground in " (name(path)) },
        (None, None) => html! { "the existing ground" },
    };
    html! {
        p { "Measured against "
            (against) ". Cut is what lies above the design and is dug away, fill what is missing below it and is brought." }
        div.beside {
            div {
                h3 { "As measured" }
                (measured(report, v, units))
            }
            @if let Some(soil) = v.bulking {
                div {
                    h3 { "With swell " (percent(soil.swell)) " and shrink " (percent(soil.shrink)) }
                    (bulking(soil, units))
                }
            }
        }
        @if v.end_area.is_some() || v.prismoidal.is_some() { (compared(v, report.pads, units)) }
    }
}

fn row(title: &str, class: &str, figures: CutFillFigures) -> Markup {
    html! {
        tr.(class) {
            th scope="row" { (title) }
            td.n { (number(figures.cut, 2)) } td.n { (number(figures.fill, 2)) } td.n { (number(figures.cut - figures.fill, 2)) }
        }
    }
}

fn cut_fill_head(units: Units<'_>) -> Markup {
    let unit = units.0;
    html! {
        thead { tr {
            th scope="col" { span.soft { (unit) "³" } } th.n.cut scope="col" { "Cut" } th.n.fill scope="col" { "Fill" }
                th.n scope="col" { "Net" }
        } }
    }
}

fn measured(report: &Report, v: &Volumes, units: Units<'_>) -> Markup {
    let pads = report.pads.filter(|pads| pads.cut > 0.0 || pads.fill > 0.0);
    html! {
        div.scroll {
            table {
                caption { "Volumes in place, without change of the soil. Each is right within "
                    (units.volume(v.error_bound)) " for the line given" }
                (cut_fill_head(units))
                tbody {
                    @if let Some(parts) = v.parts {
                        (row("Platform", "", parts.platform))
                        (row("Slopes", "", parts.slopes))
                    }
                    (row("Total", "sum", CutFillFigures { cut: v.cut, fill: v.fill }))
                }
            }
        }
        p.small {
            "Net " (units.volume(v.balance.shown(v.net).0)) ": " strong { (v.balance.shown(v.net).1.word()) } "."
            @if let Some(pads) = pads { " Of this, platforms without a station: cut " (units.volume(pads.cut)) ", fill "
                (units.volume(pads.fill)) "." }
        }
    }
}

fn bulking(soil: BulkingFigures, units: Units<'_>) -> Markup {
    html! {
        div.scroll {
            table {
                caption { "The same soil in the ground (bank), dug and on the lorry (loose), and built in (compacted). What was measured is bold" }
                thead { tr {
                    th scope="col" { span.soft { (units.0) "³" } } th.n scope="col" { "Bank" } th.n scope="col" { "Loose" }
                        th.n scope="col" { "Compacted" }
                } }
                tbody {
                    tr {
                        th.cut scope="row" { "Cut" } td.n { strong { (number(soil.cut_bank, 2)) } }
                        td.n { (number(soil.cut_loose, 2)) } td.n { (number(soil.cut_compacted, 2)) }
                    }
                    tr {
                        th.fill scope="row" { "Fill" } td.n { (number(soil.fill_bank, 2)) } td.n { (number(soil.fill_loose, 2)) }
                        td.n { strong { (number(soil.fill_compacted, 2)) } }
                    }
                    tr.sum { th scope="row" { "Net" } td.n { (number(soil.net_bank, 2)) } td colspan="2" {
                        (soil.balance.shown(soil.net_bank).1.word()) ", in bank" } }
                }
            }
        }
    }
}

/// The exact figures beside those of sections.
fn compared(v: &Volumes, pads: Option<PadRow>, units: Units<'_>) -> Markup {
    // Sections know nothing of platforms without stations.
    let pads = pads.unwrap_or_default();
    let exact = CutFillFigures { cut: v.cut - pads.cut, fill: v.fill - pads.fill };
    let share = |figure: f64, exact: f64| {
        if exact > 0.0 { format!("{} %", plain(100.0 * (figure / exact - 1.0), 2)) } else { String::new() }
    };
    html! {
        h3 { "Beside the figures of cross-sections" }
        div.scroll {
            table {
                caption { "Sums over the stations. Sections are an approximation; the exact figures hold" }
                thead { tr {
                    th scope="col" { span.soft { (units.0) "³" } } th.n.cut scope="col" { "Cut" } th.n scope="col" { "off by" }
                    th.n.fill scope="col" { "Fill" } th.n scope="col" { "off by" }
                } }
                tbody {
                    tr { th.strong scope="row" { "Exact" } td.n { (number(exact.cut, 2)) } td {} td.n {
                        (number(exact.fill, 2)) } td {} }
                    @for (title, figures) in [("Average end area", v.end_area), ("Prismoidal", v.prismoidal)] {
                        @if let Some(f) = figures {
                            tr {
                                th scope="row" { (title) } td.n { (number(f.cut, 2)) } td.n { (share(f.cut, exact.cut)) }
                                td.n { (number(f.fill, 2)) } td.n { (share(f.fill, exact.fill)) }
                            }
                        }
                    }
                }
            }
        }
    }
}

pub(super) fn stations(report: &Report, rows: &[StationRow], units: Units<'_>) -> Markup {
    let compacted = rows.iter().any(|row| row.net_cumulative_compacted.is_some());
    let sections = rows.iter().any(|row| row.sections.is_some());
    // Names are needed only to tell lines apart.
    let many = rows.windows(2).any(|pair| pair[0].chain != pair[1].chain);
    let columns = 7 + usize::from(compacted) + if sections { 4 } else { 0 };
    let cell = |value: f64| html! { td.n { (plain(value, 2)) } };
    let first = |value: f64| html! { td.n.lead { (plain(value, 2)) } };
    html! {
        p {
            "Every cubic "
                (if units.0 == "m" { "metre" } else { "foot" }) " belongs to the point of the line it is built from, so the rows add up to the total, on bends too. The running \
             net is cut − fill from the beginning of the line."
        }
        div.tall tabindex="0" role="region" aria-label="Volumes by station" {
            table {
                caption { "Volumes in " (units.0) "³, areas in plan in " (units.0) "², stations in " (units.0) }
                thead {
                    tr {
                        th scope="colgroup" colspan="2" { "Station" }
                        th.lead scope="colgroup" colspan="2" { "Exact volume" }
                        th.lead scope="colgroup" colspan="2" { "Area in plan" }
                        th.lead scope="colgroup" colspan=(if compacted { 2 } else { 1 }) { "Running net" }
                        @if sections {
                            th.lead scope="colgroup" colspan="2" { "Average end area" }
                            th.lead scope="colgroup" colspan="2" { "Prismoidal" }
                        }
                    }
                    tr {
                        th.n scope="col" { "from" } th.n scope="col" { "to" }
                        th.n.lead.cut scope="col" { "cut" } th.n.fill scope="col" { "fill" }
                        th.n.lead.cut scope="col" { "cut" } th.n.fill scope="col" { "fill" }
                        @if compacted { th.n.lead scope="col" { "as measured" } th.n scope="col" { "compacted" } } @else {
                            th.n.lead scope="col" { "cut − fill" } }
                        @if sections {
                            @for _ in 0..2 { th.n.lead.cut scope="col" { "cut" } th.n.fill scope="col" { "fill" } }
                        }
                    }
                }
                tbody {
                    @for (i, row) in rows.iter().take(MOST_ROWS).enumerate() {
                        @if many && (i == 0 || rows[i - 1].chain != row.chain) {
                            tr.name { th scope="rowgroup" colspan=(columns) { (name(&row.chain)) } }
                        }
                        tr {
                            th.n scope="row" { (plain(row.from, 2)) } (cell(row.to))
                            (first(row.cut)) (cell(row.fill)) (first(row.cut_area)) (cell(row.fill_area))
                                (first(row.net_cumulative))
                            @if let Some(net) = row.net_cumulative_compacted { (cell(net)) }
                            @if let Some(s) = row.sections {
                                (first(s.average_end_area.cut)) (cell(s.average_end_area.fill)) (first(s.prismoidal.cut))
                                    (cell(s.prismoidal.fill))
                            }
                        }
                    }
                }
                tfoot {
                    @if let Some(pads) = report.pads.filter(|pads| pads.cut > 0.0 || pads.fill > 0.0) {
                        tr {
                            th scope="row" colspan="2" { "no station" }
                            (first(pads.cut)) (cell(pads.fill)) (first(pads.cut_area)) (cell(pads.fill_area))
                            td.lead colspan=(columns - 6) {}
                        }
                    }
                    @if let Some(v) = &report.volumes {
                        tr {
                            th scope="row" colspan="2" { "total" }
                            (first(v.cut)) (cell(v.fill))
                            @if let Some(areas) = report.areas { (first(areas.cut)) (cell(areas.fill)) } @else {
                                td.lead colspan="2" {} }
                            td.lead colspan=(if compacted { 2 } else { 1 }) {}
                            @if sections {
                                @for f in [v.end_area, v.prismoidal] {
                                    @if let Some(f) = f { (first(f.cut)) (cell(f.fill)) } @else { td.lead colspan="2" {} }
                                }
                            }
                        }
                    }
                }
            }
        }
        @if rows.len() > MOST_ROWS {
            p.small { "The first " (MOST_ROWS) " of "
                (rows.len()) " rows; the total is that of all. The report as JSON has all of them." }
        }
    }
}
