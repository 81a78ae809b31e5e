//! The report of a comparison for people.

use super::{Page, SHORT_SHA, printable};
use crate::report::between::{BetweenReference, BetweenReport, Spot};
use crate::write::EncodeError;
use std::fmt::Write as _;
use std::io::Write;

/// Volumes below this are printed as nought.
pub(in crate::report) const ROUNDED: f64 = 0.005;

/// Writes the report of a comparison as plain text, UTF-8. The same report gives the same bytes; times are not in it.
///
/// # Errors
/// [`EncodeError::Io`] from the sink.
pub fn write_between(out: &mut (impl Write + ?Sized), report: &BetweenReport) -> Result<(), EncodeError> {
    out.write_all(render(report).as_bytes())?;
    Ok(())
}

fn render(report: &BetweenReport) -> String {
    let unit = report.units.length.as_str();
    let mut page = Page { text: String::new(), unit };
    page.text = format!(
        "{} {}: cut and fill between two surfaces\nLengths in {unit}, areas in {unit}², volumes in {unit}³\n",
        report.tool.name, report.tool.version
    );
    page.section("Input");
    for input in &report.inputs {
        let short = input.sha256.get(..SHORT_SHA).unwrap_or(&input.sha256);
        page.words(&input.role, &format!("{} ({}, sha256 {short})", input.path, input.format));
    }
    for mesh in &report.meshes {
        page.words(&format!("{} mesh", mesh.role), &format!("{} vertices, {} triangles", mesh.vertices, mesh.triangles));
    }
    let v = &report.volumes;
    match &v.reference {
        BetweenReference::Terrain { .. } => {
            page.section(&format!("Volumes ({}, the existing surface made the design)", v.method))
        }
        BetweenReference::Plane { elevation } => {
            page.section(&format!("Volumes ({}, the existing surface brought to elevation {elevation})", v.method));
        }
    }
    page.volume("cut", v.cut, "");
    page.volume("fill", v.fill, "");
    // What is left of rounding is no deficit.
    let net = if v.net.abs() < ROUNDED { 0.0 } else { v.net };
    page.volume("net (cut − fill)", net, &format!(" {}", v.balance.word()));
    if let Some(cells) = v.cells {
        page.count("prisms", cells);
    }
    let a = &report.areas;
    page.section("Areas in plan");
    page.area("cut", a.cut);
    page.area("fill", a.fill);
    page.area("unaffected", a.unaffected);
    if let BetweenReference::Terrain { .. } = v.reference {
        page.area("design uncovered", a.uncovered);
        page.area("existing beyond", a.existing_uncovered);
    }
    if let Some(within) = a.within {
        page.area("inside the rings", within);
    }
    page.section("Depths");
    let d = &report.depths;
    for (name, depth, spot) in [("deepest cut", d.cut_max, d.cut_max_at), ("deepest fill", d.fill_max, d.fill_max_at)] {
        page.length(name, depth);
        if let Some(Spot { x, y, z }) = spot {
            page.words("  at", &format!("{x:.3}, {y:.3}, {z:.3}"));
        }
    }
    if !report.warnings.is_empty() {
        page.section("Warnings");
        for warning in &report.warnings {
            let message: Vec<String> = warning.message.lines().map(printable).collect();
            let _ = writeln!(page.text, "  {}: {}", warning.code, message.join("\n    "));
        }
    }
    page.text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::between::testing::{full, least};
    use crate::report::testing::compare;

    #[test]
    fn a_full_comparison_is_pinned() {
        compare(&render(&full()), include_str!("../../../tests/golden/between.txt"), "between.txt");
    }

    #[test]
    fn what_does_not_apply_is_left_out() {
        let text = render(&least());
        for absent in ["uncovered", "beyond", "rings", "  at", "Warnings", "prisms  "] {
            assert!(!text.contains(absent), "{absent} in\n{text}");
        }
        assert!(text.contains("brought to elevation 30.5)"), "{text}");
    }
}
