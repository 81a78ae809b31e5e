//! The page of `build`.

use super::parts::{Fact, Units, count, depths_head, depths_row, facts, inputs, name, number, plain, point, title};
use super::proof::{certificate, method, passed};
use super::shell::{Page, Section, noted};
use super::view::{MOST_TRIANGLES, View, view};
use super::{drawings, volumes};
use crate::model::CurveKind;
use crate::plot::Scene;
use crate::report::json::all_finite;
use crate::report::{DepthPlace, ExtentKind, LineFigures, Report, SlopeRange};
use crate::write::EncodeError;
use maud::{Markup, html};
use std::io::Write;

/// Most buried stretches listed.
const MOST_BURIED: usize = 1000;

/// Most elevations of level curves written out; of more the first and the last.
const MOST_LEVELS: usize = 24;

/// Writes the report of `build` as a page: figures, drawings and a 3D view, with cross-sections at the stations `asked` for, or
/// at some if there are none. Times are not in it.
///
/// # Errors
/// [`EncodeError::ReportNotFinite`] as [`crate::report::write_json`]; [`EncodeError::Io`] from the sink.
pub fn write_html(out: &mut (impl Write + ?Sized), report: &Report, scene: &Scene<'_>, asked: &[f64]) -> Result<(), EncodeError> {
    all_finite(report)?;
    out.write_all(render(report, scene, asked)?.as_bytes())?;
    Ok(())
}

pub(super) fn render(report: &Report, scene: &Scene<'_>, asked: &[f64]) -> Result<String, EncodeError> {
    let deepest = report.depths.as_ref().map_or([0.0; 2], |d| [d.cut_max, d.fill_max]);
    let view = view(scene, deepest, MOST_TRIANGLES)?;
    let units = Units(report.units.length);
    let mut sections = Vec::new();
    let mut add = |id, title, body: Option<Markup>| sections.extend(body.map(|body| Section { id, title, body }));
    add("plan", "Plan", drawings::plan(scene));
    add("model", "3D view", view.as_ref().map(|view| model(report, scene, view)));
    add("volumes", "Volumes", report.volumes.as_ref().map(|v| volumes::volumes(report, v, units)));
    add("stations", "Volumes by station", report.stations.as_ref().map(|rows| volumes::stations(report, rows, units)));
    add("haul", "Mass haul", report.stations.as_ref().and_then(|_| drawings::mass_haul(scene)));
    add("profile", "Long profile", drawings::profile(scene));
    add("sections", "Cross-sections", drawings::sections(report, scene, asked));
    add("slopes", "Slopes", Some(slopes(report)));
    add("depths", "Depths and areas", depths(report, units));
    add("daylight", "Daylight line", daylight(report, units));
    add("certificate", "Certificate", Some(certificate(report, units)));
    add("line", "Line and surface", Some(line(report, units)));
    add("inputs", "Inputs", Some(inputs(&report.inputs)));
    add("method", "Method and rule of signs", Some(method(report)));
    let page = Page {
        kind: if report.terrain.is_some() {
            "Earthworks report: cut and fill"
        } else {
            "Earthworks report: surface of constant slope"
        },
        title: title(&report.inputs),
        summary: summary(report, units),
        warnings: &report.warnings,
        sections,
        view: view.as_ref(),
        tool: &report.tool,
    };
    Ok(page.render())
}

/// Verdict and key figures.
fn summary(report: &Report, units: Units<'_>) -> Markup {
    let sound = passed(report);
    html! {
        @if let Some(v) = &report.volumes {
            p.verdict {
                strong.cut { "Cut " (units.volume(v.cut)) } ", "
                strong.fill { "fill " (units.volume(v.fill)) } ": "
                (volumes::net(v.net, v.balance, units)) "."
            }
            @if let Some(soil) = v.bulking {
                p {
                    "With swell " (volumes::percent(soil.swell)) " and shrink "
                        (volumes::percent(soil.shrink)) ", measured in the ground: "
                    (volumes::net(soil.net_bank, soil.balance, units)) "."
                }
            }
        } @else {
            p.verdict { "A surface of constant slope through the line, without volumes." }
        }
        ul.marks {
            @if report.volumes.is_some() {
                @let (whole, words) = report.completeness();
                @if whole { li.good { "Complete: " (words) } } @else { li.bad { "NOT complete: " (words) } }
            }
            @if sound { li.good { "Certificate passed" } } @else { li.bad { "Certificate NOT passed" } }
            (noted(&report.warnings))
        }
        (tiles(report, units))
    }
}

fn tile(name: &str, class: &str, value: Markup, note: Option<Markup>) -> Markup {
    html! { div { dt { (name) } dd class=(class) { (value) } @if let Some(note) = note { dd.note { (note) } } } }
}

fn tiles(report: &Report, units: Units<'_>) -> Markup {
    let unit = units.0;
    let with = |value: Markup, power: &str| html! { (value) " " span.u { (unit) (power) } };
    let at = |place: Option<&DepthPlace>| place.and_then(|p| p.station).map(|s| html! { "at station " (plain(s, 2)) });
    html! {
        dl.tiles {
            @if let Some(v) = &report.volumes {
                (tile("Cut", "cut", with(number(v.cut, 2), "³"), None))
                (tile("Fill", "fill", with(number(v.fill, 2), "³"), None))
                (tile("Net (cut − fill)", "", with(number(v.net, 2), "³"), Some(html! { (v.balance.shown(v.net).1.word()) })))
                (tile("Error of each at most", "", with(number(v.error_bound, 2), "³"), None))
            }
            @if let Some(d) = report.depths.as_ref().filter(|_| report.volumes.is_some()) {
                (tile("Deepest cut", "cut", with(number(d.cut_max, 2), ""), at(d.cut_max_at.as_ref())))
                (tile("Deepest fill", "fill", with(number(d.fill_max, 2), ""), at(d.fill_max_at.as_ref())))
            }
            (tile("Works in plan", "", with(number(report.surface.plan_area, 0), "²"), None))
            (tile("Length of the line", "", with(number(report.line.length, 2), ""), report.line.width.map(|w| html! {
                (plain(w, 2)) " " (unit) " wide" })))
            @for (title, slope) in [("Cut slope", report.slopes.cut), ("Fill slope", report.slopes.fill)] {
                @if let Some(slope) = slope { (tile(title, "", html! { (slope.short()) }, Some(html! {
                    (plain(slope.percent, 1)) " % · " (plain(slope.degrees, 2)) "°" }))) }
            }
        }
    }
}

/// The 3D view, hidden until its script runs.
fn model(report: &Report, scene: &Scene<'_>, view: &View) -> Markup {
    let on_ground = scene.ground.is_some();
    let unit = scene.unit.label();
    let depths = report.depths.as_ref();
    html! {
        div id="view" data-state="waiting" {
            p.soft data-part="hint" { "The 3D view needs scripts, which are off here. Plan, profile and sections show the same works." }
            div data-part="stage" hidden {
                div.bar {
                    button type="button" data-part="home" { "Reset" }
                    button type="button" data-part="above" { "From above" }
                    button type="button" data-part="front" { "From the south" }
                    label { "Heights " select data-part="height" {
                        option value="1" selected { "×1" } option value="2" { "×2" } option value="5" { "×5" }
                            option value="10" { "×10" }
                    } }
                    fieldset {
                        legend { "Show" }
                        label { input type="checkbox" data-part="show-works" checked; "Works" }
                        @if on_ground {
                            label { input type="checkbox" data-part="show-ground" checked; "Ground around" }
                            label { input type="checkbox" data-part="show-before"; "Ground before" }
                        }
                        label { input type="checkbox" data-part="show-lines" checked; "Lines" }
                    }
                }
                div.stage {
                    canvas tabindex="0" data-part="canvas" role="application" aria-describedby="view-keys"
                        aria-label="3D view of the works; turn it with the arrow keys" {}
                    canvas.still data-part="still" aria-hidden="true" {}
                    svg.needle data-part="needle" viewBox="0 0 40 40" aria-hidden="true" {
                        path d="M20 3 L27 25 L20 21 L13 25 Z" fill="currentColor" {}
                        text x="20" y="38" text-anchor="middle" font-size="13" font-weight="700" fill="currentColor" { "N" }
                    }
                }
                p.readout data-part="readout" aria-live="polite" {}
                div.key {
                    @if on_ground {
                        span {
                            span.cut { "cut " (depths.map_or_else(String::new, |d| plain(d.cut_max, 2))) " " (unit) }
                            span.ramp {}
                            span.fill { "fill " (depths.map_or_else(String::new, |d| plain(d.fill_max, 2))) " " (unit) }
                        }
                        span { i.ground {} "existing ground" }
                        span { i.day {} "daylight line" }
                    } @else {
                        span { i.platform {} "platform" }
                        @if report.slopes.cut.is_some() { span { i.rise {} "rising slope" } }
                        @if report.slopes.fill.is_some() { span { i.fall {} "falling slope" } }
                        @if scene.lines.iter().any(|line| line.kind == CurveKind::Boundary) { span { i.day {} "boundary" } }
                    }
                    span { i.hinge {} "hinge" }
                }
                p.soft.small.screen id="view-keys" {
                    "Drag to turn, with shift or two fingers to move; scroll or pinch to zoom once the view has been clicked. Keys: arrows, with \
                     shift to move; + and −; 0 for all; T from above; F from the south. A click on the surface tells its coordinates, in the \
                     single precision of the view."
                }
            }
            @for note in &view.notes { p.small { (note) } }
        }
    }
}

fn slopes(report: &Report) -> Markup {
    let seen = |range: Option<SlopeRange>| range.map_or_else(String::new, SlopeRange::short);
    let sections = report.section_slope;
    html! {
        div.scroll {
            table {
                caption { "The side slopes in four forms" }
                thead { tr {
                    th scope="col" { "Slope" }
                        th scope="col" { "Vertical : horizontal · horizontal : vertical · percent · angle" }
                    @if sections.is_some() { th scope="col" { "In a section perpendicular to the line" } }
                } }
                tbody {
                    @for (title, class, slope, range) in [
                        ("Cut (rises from the line)", "cut", report.slopes.cut, sections.and_then(|s| s.cut)),
                        ("Fill (falls from the line)", "fill", report.slopes.fill, sections.and_then(|s| s.fill)),
                    ] {
                        @if let Some(slope) = slope {
                            tr {
                                th.p.(class) scope="row" { (title) } td.w { (slope.forms()) }
                                @if sections.is_some() { td.p { (seen(range)) } }
                            }
                        }
                    }
                }
            }
        }
        p {
            "The slope is the true steepness of the surface, along its lines of steepest descent. Where the line itself rises or falls, a \
             section perpendicular to it shows the slope flatter: √(k² − g²) for a slope k and a gradient g."
        }
    }
}

fn depths(report: &Report, units: Units<'_>) -> Option<Markup> {
    let depths = report.depths.as_ref();
    if depths.is_none() && report.areas.is_none() {
        return None;
    }
    let place = |place: Option<&DepthPlace>| {
        html! {
            @if let Some(p) = place {
                (point(p.x, p.y, p.z))
                @if let (Some(chain), Some(station)) = (&p.chain, p.station) { "; station " (plain(station, 3)) " of "
                    (name(chain)) }
            }
        }
    };
    let surface = report.surface;
    let mut rows = Vec::new();
    if let Some(areas) = report.areas {
        rows.push(Fact::new("Cut, in plan", units.area(areas.cut)));
        rows.push(Fact::new("Fill, in plan", units.area(areas.fill)));
        rows.push(Fact::new("Unaffected ground, in plan", units.area(areas.unaffected)));
    }
    rows.push(Fact::new("Works, in plan", units.area(surface.plan_area)));
    rows.push(Fact::new("Platform, measured in it", units.area(surface.platform_area)));
    rows.push(Fact::new("Slopes, measured in them", units.area(surface.slope_area)));
    rows.push(Fact::under("of cut", units.area(surface.cut_slope_area)));
    rows.push(Fact::under("of fill", units.area(surface.fill_slope_area)));
    Some(html! {
        @if let Some(d) = depths {
            div.scroll {
                table {
                    caption { "Vertical depths, and where the greatest are; the mean is volume over area" }
                    (depths_head())
                    tbody {
                        (depths_row("Cut", "cut", d.cut_max, d.cut_mean, &place(d.cut_max_at.as_ref()), units))
                        (depths_row("Fill", "fill", d.fill_max, d.fill_mean, &place(d.fill_max_at.as_ref()), units))
                    }
                }
            }
        }
        h3 { "Areas" }
        (facts("Areas in plan, and true areas of slopes and platform", &rows))
    })
}

fn daylight(report: &Report, units: Units<'_>) -> Option<Markup> {
    let d = report.daylight?;
    let mut rows = vec![
        Fact::new("Closed loops", count(d.loops)),
        Fact::new("Length", units.length(d.length)),
        Fact::under("above cut slopes", units.length(d.cut_length)),
        Fact::under("below fill slopes", units.length(d.fill_length)),
    ];
    if d.open_length > 0.0 {
        rows.push(Fact::new("Open: the works end without meeting the ground", units.length(d.open_length)));
    }
    Some(html! { (facts("Where the works meet the existing ground; lengths in plan", &rows)) })
}

fn line(report: &Report, units: Units<'_>) -> Markup {
    let LineFigures { chains, vertices, simplified, simplified_max, length, width, crossfall, breaklines, .. } = report.line;
    let mut given = vec![
        Fact::new("Lines and rings", count(chains)),
        Fact::new("Vertices", count(vertices)),
        Fact::new("Length in plan", units.length(length)),
    ];
    if simplified > 0 {
        given.push(Fact::new("Vertices left out of the engine's copy", count(simplified)));
        given.push(Fact::under("greatest shift", html! { (plain(simplified_max, 4)) " " (units.0) }));
    }
    given.extend(width.map(|width| Fact::new("Width of the road", units.length(width))));
    if let Some(fall) = crossfall.filter(|fall| fall.left != 0.0 || fall.right != 0.0) {
        given.push(Fact::new(
            "Crossfall, left and right",
            html! { (plain(100.0 * fall.left, 2)) " %, " (plain(100.0 * fall.right, 2)) " %" },
        ));
    }
    if breaklines > 0 {
        given.push(Fact::new("Breaklines and spot heights", count(breaklines)));
    }
    given.extend([
        Fact::new("Lowest elevation", units.length(report.line.z_min)),
        Fact::new("Highest elevation", units.length(report.line.z_max)),
        Fact::new("Greatest gradient along it", html! { (plain(100.0 * report.line.gradient_max, 2)) " %" }),
    ]);
    let end = match report.extent.kind {
        ExtentKind::Elevation => "Slopes end at elevation",
        ExtentKind::Height => "Slopes end below or above the line by",
        ExtentKind::Distance => "Slopes end at a plan distance of",
        ExtentKind::Ground => "Slopes end",
    };
    let end = Fact::new(end, report.extent.value.map_or_else(|| html! { "at the existing ground" }, |value| units.length(value)));
    let mut made = vec![end];
    let mesh = |title: &str, vertices, triangles| {
        Fact::new(title, html! { (count(vertices)) " vertices, " (count(triangles)) " triangles" })
    };
    made.push(mesh("Mesh of the works", report.surface.vertices, report.surface.triangles));
    if let Some(terrain) = report.terrain {
        made.push(mesh("Existing ground", terrain.vertices, terrain.triangles));
        made.push(Fact::under("triangles near the works", count(terrain.triangles_used)));
        made.push(Fact::under("elevations", html! { (plain(terrain.z_min, 3)) " to " (plain(terrain.z_max, 3)) " " (units.0) }));
    }
    made.extend(report.finished.map(|finished| mesh("Finished ground", finished.vertices, finished.triangles)));
    html! {
        div.beside {
            (facts("The line as given", &given))
            (facts("What was built", &made))
        }
        (levels(&report.levels, units))
        @if !report.line.buried.is_empty() { (buried(report)) }
    }
}

fn levels(levels: &[f64], units: Units<'_>) -> Markup {
    html! {
        @if let (Some(first), Some(last)) = (levels.first(), levels.last()) {
            p {
                @if levels.len() <= MOST_LEVELS {
                    "Level curves at "
                    @for (i, level) in levels.iter().enumerate() { @if i > 0 { ", " } (level) }
                    " " (units.0) "."
                } @else {
                    (levels.len()) " level curves from " (first) " to " (last) " " (units.0) "."
                }
            }
        }
    }
}

fn buried(report: &Report) -> Markup {
    let rows = &report.line.buried;
    html! {
        h3 { "Buried stretches" }
        div.scroll tabindex="0" role="region" aria-label="Buried stretches" {
            table {
                caption { "Stretches of the line that lie under the slope of another part; the surface is right, the line is not part of it there" }
                thead { tr {
                    th scope="col" { "Line" } th.n scope="col" { "From" } th.n scope="col" { "To" } th.n scope="col" { "Depth" }
                    th scope="col" { "Under" } th.n scope="col" { "Station" } th scope="col" { "Free from" }
                } }
                tbody {
                    @for b in rows.iter().take(MOST_BURIED) {
                        tr {
                            th scope="row" { (name(&b.chain)) } td.n { (plain(b.from, 3)) } td.n { (plain(b.to, 3)) } td.n {
                                (plain(b.depth, 3)) }
                            td { (name(&b.by_chain)) } td.n { (plain(b.by_station, 3)) }
                            td { (b.free_slope.and_then(crate::model::Slope::from_ratio).map_or_else(|| "no slope".to_owned(), crate::model::Slope::not_flatter)) }
                        }
                    }
                }
            }
        }
        @if rows.len() > MOST_BURIED { p.small { "The first " (MOST_BURIED) " of "
            (rows.len()) "; the report as JSON has all." } }
    }
}
