//! The page of `volume`: two surfaces, or a surface and a level.

use super::parts::{Fact, Units, count, depths_head, depths_row, facts, inputs, name, number, plain, point};
use super::proof::units_of;
use super::shell::{Page, Section, noted};
use super::volumes::net;
use crate::report::between::{BetweenReference, BetweenReport, Spot};
use crate::report::json::all_finite;
use crate::write::EncodeError;
use maud::{Markup, html};
use std::io::Write;

/// Writes the report of a comparison as a page. Times are not in it.
///
/// # Errors
/// [`EncodeError::ReportNotFinite`] as [`crate::report::write_json`]; [`EncodeError::Io`] from the sink.
pub fn write_between_html(out: &mut (impl Write + ?Sized), report: &BetweenReport) -> Result<(), EncodeError> {
    all_finite(report)?;
    out.write_all(render(report).as_bytes())?;
    Ok(())
}

pub(super) fn render(report: &BetweenReport) -> String {
    let units = Units(report.units.length);
    let v = &report.volumes;
    let title = match &v.reference {
        BetweenReference::Terrain { .. } => "Two surfaces".to_owned(),
        BetweenReference::Plane { elevation } => format!("A surface brought to elevation {elevation}"),
    };
    let add = |id, title, body| Section { id, title, body };
    let page = Page {
        kind: "Earthworks report: cut and fill between surfaces",
        title: &title,
        summary: summary(report, units),
        warnings: &report.warnings,
        sections: vec![
            add("areas", "Areas", areas(report, units)),
            add("depths", "Depths", depths(report, units)),
            add("meshes", "Surfaces", meshes(report)),
            add("inputs", "Inputs", inputs(&report.inputs)),
            add("method", "Method and rule of signs", method(report)),
        ],
        view: None,
        tool: &report.tool,
    };
    page.render()
}

fn summary(report: &BetweenReport, units: Units<'_>) -> Markup {
    let (v, d) = (&report.volumes, &report.depths);
    let (unit, a) = (units.0, &report.areas);
    let (rest, balance) = v.balance.shown(v.net);
    let tile = |title: &str, class: &str, value: f64, power: &str, note: Option<&str>| {
        html! { div { dt { (title) } dd class=(class) { (number(value, 2)) " " span.u { (unit) (power) } }
        @if let Some(note) = note { dd.note { (note) } } } }
    };
    html! {
        p.verdict {
            strong.cut { "Cut " (units.volume(v.cut)) } ", " strong.fill { "fill " (units.volume(v.fill)) } ": "
                (net(v.net, v.balance, units)) "."
        }
        ul.marks {
            @if v.complete {
                li.good { "Complete: all of the design lies over the existing surface" }
            } @else {
                li.bad { "NOT complete: " (units.area(a.uncovered)) " of the design do not lie over the existing surface" }
            }
            (noted(&report.warnings))
        }
        dl.tiles {
            (tile("Cut", "cut", v.cut, "³", None))
            (tile("Fill", "fill", v.fill, "³", None))
            (tile("Net (cut − fill)", "", rest, "³", Some(balance.word())))
            (tile("Deepest cut", "cut", d.cut_max, "", None))
            (tile("Deepest fill", "fill", d.fill_max, "", None))
            (tile("Area of cut", "cut", a.cut, "²", None))
            (tile("Area of fill", "fill", a.fill, "²", None))
        }
    }
}

fn areas(report: &BetweenReport, units: Units<'_>) -> Markup {
    let a = &report.areas;
    let mut rows = vec![
        Fact::new("Cut: the existing surface is higher", units.area(a.cut)),
        Fact::new("Fill: the design is higher", units.area(a.fill)),
        Fact::new("Both the same", units.area(a.unaffected)),
    ];
    if let BetweenReference::Terrain { .. } = report.volumes.reference {
        rows.push(Fact::new("Design beside the existing surface, without volume", units.area(a.uncovered)));
        rows.push(Fact::new("Existing surface beside the design", units.area(a.existing_uncovered)));
    }
    rows.extend(a.within.map(|within| Fact::new("Inside the rings asked for", units.area(within))));
    facts("Areas in plan", &rows)
}

fn depths(report: &BetweenReport, units: Units<'_>) -> Markup {
    let d = &report.depths;
    let place = |spot: Option<Spot>| html! { @if let Some(s) = spot { (point(s.x, s.y, Some(s.z))) } };
    html! {
        div.scroll {
            table {
                caption { "Vertical depths, and where the greatest are; the mean is volume over area" }
                (depths_head())
                tbody {
                    (depths_row("Cut", "cut", d.cut_max, d.cut_mean, &place(d.cut_max_at), units))
                    (depths_row("Fill", "fill", d.fill_max, d.fill_mean, &place(d.fill_max_at), units))
                }
            }
        }
    }
}

fn meshes(report: &BetweenReport) -> Markup {
    let unit = report.units.length;
    html! {
        div.scroll tabindex="0" role="region" aria-label="Surfaces" {
            table {
                caption { "The surfaces as read" }
                thead { tr {
                    th scope="col" { "Surface" } th.n scope="col" { "Vertices" } th.n scope="col" { "Triangles" }
                        th.n scope="col" { "Lowest, " (unit) }
                    th.n scope="col" { "Highest, " (unit) } th.n scope="col" { "Area in plan, " (report.units.area) }
                    th.n scope="col" { "Area of the surface, " (report.units.area) }
                } }
                tbody {
                    @for m in &report.meshes {
                        tr {
                            th scope="row" { (m.role) } td.n { (count(m.vertices)) } td.n { (count(m.triangles)) }
                            td.n { (plain(m.z_min, 3)) } td.n { (plain(m.z_max, 3)) } td.n { (number(m.plan_area, 2)) } td.n {
                                (number(m.surface_area, 2)) }
                        }
                    }
                }
            }
        }
        @if let Some(cells) = report.volumes.cells { p { (count(cells)) " prisms were summed up." } }
    }
}

fn method(report: &BetweenReport) -> Markup {
    html! {
        ul.plain {
            li {
                strong { "Volumes. " }
                @match &report.volumes.reference {
                    BetweenReference::Terrain { path } => {
                        "Prisms over all pairs of triangles of the design and of the existing surface in "
                            (name(path)) " that lie over each other: \
                         exact for the two surfaces, no cells and no sections."
                    }
                    BetweenReference::Plane { elevation } => {
                        "Prisms between every triangle of the surface and the level plane at elevation "
                            (plain(*elevation, 3)) ": exact for its triangles."
                    }
                }
            }
            li {
                strong { "Sign rule. " }
                "Cut is where the design lies below the existing surface, fill where it lies above; " (report.volumes.sign_rule)
                ". Cut, fill, areas and depths are never negative."
            }
            li {
                strong { "Units. " }
                (units_of(&report.units)) " Nothing has been added for swell or shrink."
            }
        }
    }
}
