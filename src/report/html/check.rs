//! The page of `check`: whether a mesh is sound and keeps its slope.

use super::parts::{Fact, Units, count, facts, inputs, name, number, plain, title};
use super::shell::{Page, Section};
use crate::report::CheckReport;
use crate::report::check::{BoundFigures, FindingFigures, PartFigures, SlopesFigures, percent, place, share, verdict};
use crate::report::json::all_finite;
use crate::write::EncodeError;
use maud::{Markup, html};
use std::io::Write;

/// Parts that are listed.
const MOST_PARTS: usize = 200;

/// Width of the longest bar of the histogram, in rem.
const BAR: f64 = 18.0;

/// Writes the report of a check as a page.
///
/// # Errors
/// [`EncodeError::ReportNotFinite`] as [`crate::report::write_json`]; [`EncodeError::Io`] from the sink.
pub fn write_check_html(out: &mut (impl Write + ?Sized), report: &CheckReport) -> Result<(), EncodeError> {
    all_finite(report)?;
    out.write_all(render(report).as_bytes())?;
    Ok(())
}

pub(super) fn render(report: &CheckReport) -> String {
    let units = Units(report.units.length);
    let mut sections = Vec::new();
    let mut add = |id, title, body: Option<Markup>| sections.extend(body.map(|body| Section { id, title, body }));
    add("findings", "Findings", Some(findings(&report.findings)));
    add("slope", "The slope asked for", report.slope_bound.as_ref().map(bound));
    add("slopes", "Slopes", Some(slopes(&report.slopes)));
    add("parts", "Parts", (report.parts.len() > 1).then(|| parts(&report.parts, units)));
    add("mesh", "Mesh", Some(mesh(report, units)));
    add("inputs", "Inputs", Some(inputs(&report.inputs)));
    let page = Page {
        kind: "Check of a surface",
        title: title(&report.inputs),
        summary: summary(report, units),
        warnings: &report.warnings,
        sections,
        view: None,
        tool: &report.tool,
    };
    page.render()
}

fn summary(report: &CheckReport, units: Units<'_>) -> Markup {
    let v = &report.verdict;
    let (head, rest) = {
        let text = verdict(report);
        let (head, rest) = text.split_once(": ").unwrap_or((&text, ""));
        (head.to_owned(), rest.to_owned())
    };
    let errors = report.findings.iter().filter(|f| f.severity == "error").count();
    let tile = |title: &str, value: Markup| html! { div { dt { (title) } dd { (value) } } };
    html! {
        p.verdict { strong.good[v.passed].bad[!v.passed] { (head) } ": " (rest) "." }
        dl.tiles {
            (tile("Kinds of error found", count(errors)))
            (tile("Triangles", count(report.mesh.triangles)))
            (tile("Area in plan", html! { (number(report.mesh.plan_area, 0)) " " span.u { (units.0) "²" } }))
            (tile("Mean slope", html! { (plain(report.slopes.mean_degrees, 2)) "°" }))
        }
    }
}

fn findings(findings: &[FindingFigures]) -> Markup {
    html! {
        @if findings.is_empty() {
            p.good { "Nothing was found: the mesh is a clean surface." }
        } @else {
            div.scroll tabindex="0" role="region" aria-label="Findings" {
                table {
                    caption { "What was found, errors first. A surface with errors is not sound; remarks do not count" }
                    thead { tr { th scope="col" { "" } th.n scope="col" { "Number" } th scope="col" { "What" }
                        th scope="col" { "Places" } } }
                    tbody {
                        @for f in findings {
                            tr {
                                th scope="row" { @if f.severity == "error" { strong.bad { "error" } } @else { span.soft {
                                    (f.severity) } } }
                                td.n { @if f.at_least { "at least " } (count(f.count)) }
                                td.w { (f.message) " " code { (f.code) } }
                                td.w.small {
                                    @for p in &f.places { div { (place(p).trim_start()) } }
                                    @if f.count > f.places.len() && !f.places.is_empty() { div.soft { "and "
                                        (f.count - f.places.len()) " more" } }
                                }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn bound(b: &BoundFigures) -> Markup {
    let mut rows = vec![
        Fact::new("Slope", html! { (b.slope.forms()) ", within " (b.tolerance_deg) "°" }),
        Fact::new(
            "Asked of",
            if b.parts.is_empty() {
                html! { "all that is not level" }
            } else {
                name(&b.parts.join(", "))
            },
        ),
        Fact::new("On it", html! { (share(&b.within)) }),
        Fact::new("Off it", html! { (share(&b.off)) "; " (percent(b.max_off)) " may be" }),
    ];
    if b.parts.is_empty() && b.level.triangles > 0 {
        rows.push(Fact::new("Level, left out", html! { (share(&b.level)) }));
    }
    if b.thin.triangles > 0 {
        rows.push(Fact::new("Too low to tell", html! { (share(&b.thin)) }));
    }
    rows.push(Fact::new("Kept", html! { @if b.passed { strong.good { "yes" } } @else { strong.bad { "NO" } } }));
    html! {
        (facts("Whether the surface keeps the slope", &rows))
        @if !b.worst.is_empty() {
            h3 { "Furthest off it" }
            ul.plain { @for p in &b.worst { li.small { (place(p).trim_start()) } } }
        }
    }
}

fn slopes(s: &SlopesFigures) -> Markup {
    let mut rows = Vec::new();
    for (title, found) in [("Flattest", &s.flattest), ("Steepest", &s.steepest)] {
        rows.extend(
            found
                .as_ref()
                .map(|f| Fact::new(title, html! { (plain(f.degrees, 4)) "° " span.soft { (place(&f.place).trim_start()) } })),
        );
    }
    rows.push(Fact::new("Mean over the area", html! { (plain(s.mean_degrees, 4)) "°" }));
    for common in &s.common {
        rows.push(Fact::new(
            "Common",
            html! { (plain(common.degrees, 2)) "° (1V:" (plain(common.one_in, 3)) "H), " (percent(common.share)) " of the area" },
        ));
    }
    rows.push(Fact::new("Level", html! { (share(&s.level)) }));
    rows.push(Fact::new("Upright", html! { (share(&s.upright)) }));
    if s.thin.triangles > 0 {
        rows.push(Fact::new("Too low to tell", html! { (share(&s.thin)) }));
    }
    let most = s.histogram.iter().map(|bin| bin.share.share).fold(f64::MIN_POSITIVE, f64::max);
    html! {
        (facts("Angles against the horizontal, by area in space", &rows))
        @if !s.histogram.is_empty() {
            h3 { "Distribution" }
            div.tall tabindex="0" role="region" aria-label="Distribution of slopes" {
                table {
                    caption { "Share of the area by angle" }
                    thead { tr { th.n scope="col" { "Angle" } th.n scope="col" { "Share" } th.n scope="col" { "Triangles" }
                        th scope="col" { "" } } }
                    tbody {
                        @for bin in &s.histogram {
                            tr {
                                th.n scope="row" { (bin.from) "° to " (bin.to) "°" } td.n { (percent(bin.share.share)) } td.n {
                                    (count(bin.share.triangles)) }
                                td { span.bin style={ "width:" (format!("{:.2}", BAR * bin.share.share / most)) "rem" } {} }
                            }
                        }
                    }
                }
            }
        }
    }
}

fn parts(parts: &[PartFigures], units: Units<'_>) -> Markup {
    html! {
        div.scroll tabindex="0" role="region" aria-label="Parts" {
            table {
                caption { "The groups of the file" }
                thead { tr {
                    th scope="col" { "Name" } th.n scope="col" { "Triangles" } th.n scope="col" { "Area in plan" }
                        th.n scope="col" { "Area in space" }
                    th.n scope="col" { "Flattest" } th.n scope="col" { "Mean" } th.n scope="col" { "Steepest" }
                } }
                tbody {
                    @for p in parts.iter().take(MOST_PARTS) {
                        tr {
                            th scope="row" { (name(&p.name)) } td.n { (count(p.slopes.triangles)) }
                            td.n { (units.area(p.slopes.plan_area)) } td.n { (units.area(p.slopes.surface_area)) }
                            td.n { @if let Some(f) = &p.slopes.flattest { (plain(f.degrees, 2)) "°" } }
                            td.n { (plain(p.slopes.mean_degrees, 2)) "°" }
                            td.n { @if let Some(f) = &p.slopes.steepest { (plain(f.degrees, 2)) "°" } }
                        }
                    }
                }
            }
        }
        @if parts.len() > MOST_PARTS { p.small { "The first " (MOST_PARTS) " of "
            (parts.len()) "; the report as JSON has all." } }
    }
}

fn mesh(report: &CheckReport, units: Units<'_>) -> Markup {
    let (m, b) = (&report.mesh, &report.boundary);
    let mut rows = vec![
        Fact::new("Vertices", count(m.vertices)),
        Fact::new("Faces", count(m.faces)),
        Fact::new("Triangles", count(m.triangles)),
        Fact::new("Pieces", count(m.pieces)),
        Fact::new("Area in plan", units.area(m.plan_area)),
        Fact::new("Area in space", units.area(m.surface_area)),
        Fact::new("Outer loops of the boundary", count(b.outer)),
        Fact::new("Holes", count(b.holes)),
        Fact::new("Open seams", count(b.seams)),
        Fact::new("Loops not closed", count(b.unclosed)),
        Fact::new("Length of the boundary in plan", units.length(b.length)),
        Fact::new("Gap within which edges should be joined", html! { (m.gap) " " (units.0) }),
    ];
    if let (Some(lo), Some(hi)) = (m.min, m.max) {
        for (axis, title) in ["East", "North", "Elevation"].into_iter().enumerate() {
            rows.push(Fact::new(title, html! { (plain(lo[axis], 3)) " to " (plain(hi[axis], 3)) }));
        }
    }
    if let Some(smallest) = &report.angles.smallest {
        rows.push(Fact::new(
            "Smallest angle",
            html! { (plain(smallest.degrees, 4)) "° " span.soft { (place(&smallest.place).trim_start()) } },
        ));
    }
    facts("The mesh as read", &rows)
}
