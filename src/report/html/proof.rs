//! Certificate and method on the page of `build`.

use super::parts::{Units, plain};
use crate::report::page::in_metres;
use crate::report::text::{angle, short};
use crate::report::{Certificate, Report};
use crate::surface::{CONE_BOUND, STRIP_BOUND};
use maud::{Markup, html};

/// Whether all figures of the certificate are what they must be. Whatever is written has passed: the program writes nothing else.
pub(super) fn passed(report: &Report) -> bool {
    let Certificate { paired, manifold, overlaps, input_edges_kept, .. } = report.certificate;
    let c = report.certificate;
    let sound = paired && manifold && overlaps == 0 && input_edges_kept && c.triangles_beyond_0_1deg == 0;
    sound && height_kept(report) && c.strip_max_deviation_deg <= STRIP_BOUND && c.sector_max_deviation_deg <= CONE_BOUND
}

/// Whether heights are within the tolerance; coordinates add rounding, relative to the largest of them.
fn height_kept(report: &Report) -> bool {
    /// Rounding of heights, in the length unit: 10⁻¹² of ten kilometres, as the certificate itself allows.
    const ROUNDING: f64 = 1e-8;
    report.certificate.height_max_deviation <= report.design.tolerance + ROUNDING
}

/// What the units are.
pub(super) fn units_of(units: &crate::report::Units) -> Markup {
    html! {
        "Coordinates are taken as given; lengths, heights and stations in " (units.length) ", areas in "
            (units.area) ", volumes in " (units.volume)
        @if let Some(metres) = in_metres(units) { "; " (metres) }
        ". They are grid figures: no scale factor has been applied."
    }
}

struct Check {
    name: &'static str,
    measured: String,
    wanted: String,
    good: bool,
    meaning: &'static str,
}

fn checks(report: &Report, unit: &str) -> Vec<Check> {
    let c = report.certificate;
    let yes = |yes: bool| if yes { "yes" } else { "NO" }.to_owned();
    let truth = |name, good: bool, meaning| Check { name, measured: yes(good), wanted: "yes".to_owned(), good, meaning };
    let none = |name, count: usize, meaning| Check {
        name,
        measured: count.to_string(),
        wanted: "0".to_owned(),
        good: count == 0,
        meaning,
    };
    let within = |name, degrees: f64, bound: f64, meaning| Check {
        name,
        measured: format!("{}°", angle(degrees)),
        wanted: format!("at most {bound}°"),
        good: degrees <= bound,
        meaning,
    };
    vec![
        truth(
            "Facets pair",
            c.paired,
            "Every crease between two facets is there from both sides: the slopes have no gap, nothing was missed. \
             (On existing ground: before it cuts them.)",
        ),
        truth(
            "Manifold",
            c.manifold,
            "Every edge has at most two triangles, one on each side, and all triangles face up: one clean surface.",
        ),
        none(
            "Overlaps",
            c.overlaps,
            "Edges of the border that cross in plan, or loops of it with several layers: none, so each place has one height.",
        ),
        truth(
            "Line kept as edges",
            c.input_edges_kept,
            "Every segment of the given line is a chain of edges of the mesh: the line was not moved. \
             (On existing ground: before it cuts the slopes.)",
        ),
        within(
            "Slope deviation, planar strips",
            c.strip_max_deviation_deg,
            STRIP_BOUND,
            "Greatest angle by which a triangle on a straight stretch is off the slope asked for.",
        ),
        within(
            "Slope deviation, cones",
            c.sector_max_deviation_deg,
            CONE_BOUND,
            "The same round convex corners, where narrow wedges stand for a cone.",
        ),
        none("Triangles beyond 0.1°", c.triangles_beyond_0_1deg, "Slope triangles further off the slope than that."),
        Check {
            name: "Height deviation",
            measured: format!("{} {unit}", short(c.height_max_deviation)),
            wanted: format!("at most {} {unit}", report.design.tolerance),
            good: height_kept(report),
            meaning: "Greatest difference between mesh and closed form of the surface through the given line, at up to 2048 triangles; the tolerance asked for.",
        },
    ]
}

pub(super) fn certificate(report: &Report, units: Units<'_>) -> Markup {
    html! {
        p {
            "Measured on the very mesh that was written, after it was built. A surface that fails one of these is an error of the program, \
             and no file is written."
            @if report.terrain.is_some() { " Pairing, heights and the line are checked on the slopes before the ground cuts them; soundness and slopes on what is left." }
        }
        div.scroll tabindex="0" role="region" aria-label="Certificate" {
            table {
                caption { "What was checked" }
                thead { tr { th scope="col" { "Check" } th.n scope="col" { "Measured" } th.n scope="col" { "Must be" }
                    th scope="col" { "" } th scope="col" { "What it means" } } }
                tbody {
                    @for check in checks(report, units.0) {
                        tr {
                            th.p scope="row" { (check.name) } td.n { (check.measured) } td.n.soft { (check.wanted) }
                            td { @if check.good { span.good { "passed" } } @else { strong.bad { "FAILED" } } }
                            td.w { (check.meaning) }
                        }
                    }
                }
            }
        }
    }
}

pub(super) fn method(report: &Report) -> Markup {
    let unit = report.units.length;
    let soil = report.volumes.as_ref().and_then(|v| v.bulking);
    html! {
        ul.plain {
            li {
                strong { "Slopes. " }
                "The surface of constant slope through the line: planes along straight stretches, cones at convex corners, cut off against each \
                 other where they meet. It is built facet by facet from their equations, not from sections at an interval."
            }
            @if report.terrain.is_some() {
                li {
                    strong { "Daylight. " }
                    "Design and ground are cut with each other triangle by triangle. Islands of ground stay; ground behind a hill that the slopes \
                     do not come to is left alone. The triangles of the ground are those of the file."
                }
            }
            @if let Some(v) = &report.volumes {
                li {
                    strong { "Volumes. " }
                    "Computed by " (v.method) ", "
                        (v.method_text) ". Simplification of the line and the chords of cones change each volume by "
                        (plain(v.error_bound, 2)) " " (unit) "³ at most"
                    @if report.terrain.is_some() { ", for works that reach the same ground" }
                    "."
                }
                li {
                    strong { "Sign rule. " }
                    "In this report " (v.sign_rule) ". Cut, fill, areas and depths are never negative."
                }
            }
            @if soil.is_some() {
                li {
                    strong { "Soil. " }
                    "Loose = bank × (1 + swell); compacted = bank × (1 − shrink). Cut is measured in the ground (bank), fill where it is built in \
                     (compacted)."
                }
            }
            @if report.stations.is_some() {
                li {
                    strong { "Stations. " }
                    "Plan distances along the line from its first vertex; of a road those of its centre line, on both edges. Average end area is \
                     length × mean of both end areas; prismoidal is length / 6 × (first + 4 × middle + last)."
                }
            }
            li {
                strong { "Units. " }
                (units_of(&report.units))
            }
        }
    }
}
