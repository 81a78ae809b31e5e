//! The report of a comparison for people.

use crate::report::between::{BetweenReference, BetweenReport, Spot};
use crate::report::page::Page;
use crate::write::EncodeError;
use std::io::Write;

/// Writes the report of a comparison as plain text, UTF-8. The same report gives the same bytes; times are not in it.
///
/// # Errors
/// [`EncodeError::Io`] from the sink.
pub fn write_between(out: &mut (impl Write + ?Sized), report: &BetweenReport) -> Result<(), EncodeError> {
    out.write_all(render(report).as_bytes())?;
    Ok(())
}

/// Writes the report of a comparison as Markdown, UTF-8: what the plain text says, in tables.
///
/// # Errors
/// [`EncodeError::Io`] from the sink.
pub fn write_between_markdown(out: &mut (impl Write + ?Sized), report: &BetweenReport) -> Result<(), EncodeError> {
    out.write_all(page(report).markdown().as_bytes())?;
    Ok(())
}

fn render(report: &BetweenReport) -> String {
    page(report).plain()
}

fn page(report: &BetweenReport) -> Page {
    let mut page = Page::new(&report.tool, "cut and fill between two surfaces", &report.units, true);
    page.section("Input");
    page.inputs(&report.inputs);
    for mesh in &report.meshes {
        page.section(&format!("Surface: {}", mesh.role));
        page.count("vertices", mesh.vertices);
        page.count("triangles", mesh.triangles);
        page.length("lowest", mesh.z_min);
        page.length("highest", mesh.z_max);
        page.area("area in plan", mesh.plan_area);
        page.area("area of the surface", mesh.surface_area);
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
    let (net, balance) = v.balance.shown(v.net);
    page.volume("net (cut − fill)", net, &format!(" {}", balance.word()));
    page.words("complete", if v.complete { "yes" } else { "NO, not all of the design lies over the existing surface" });
    if let Some(cells) = v.cells {
        page.count("prisms", cells);
    }
    page.words("method", v.method_text);
    page.words("sign", v.sign_rule);
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
    for (name, depth, mean, spot) in
        [("deepest cut", d.cut_max, d.cut_mean, d.cut_max_at), ("deepest fill", d.fill_max, d.fill_mean, d.fill_max_at)]
    {
        page.length(name, depth);
        if let Some(mean) = mean {
            page.length("  mean", mean);
        }
        if let Some(Spot { x, y, z }) = spot {
            page.words("  at", &format!("{x:.3}, {y:.3}, {z:.3}"));
        }
    }
    page.warnings(&report.warnings);
    page
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
    fn markdown_is_pinned() {
        let mut bytes = Vec::new();
        write_between_markdown(&mut bytes, &full()).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        compare(&text, include_str!("../../../tests/golden/between.md"), "between.md");
    }

    #[test]
    fn lines_fit_a_terminal() {
        let text = render(&full());
        assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
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
