//! The report of a check for people: one screen, unless much is wrong.

use super::{BoundFigures, CheckReport, FindingFigures, PartFigures, PlaceFigures, ShareFigures, SlopesFigures};
use crate::model::Slope;
use crate::model::digits::counted;
use crate::model::message::printable;
use crate::report::page::{Column, Group, Page, Row};

/// Degrees of a bin of the histogram as printed.
const BIN: usize = 5;
/// Length of the longest bar of the histogram.
const BAR: f64 = 40.0;
/// Parts that are listed.
const MOST_PARTS: usize = 12;

/// The report as plain text. The same report gives the same bytes.
pub fn render_check(report: &CheckReport) -> String {
    page(report).plain()
}

/// The report as Markdown: what the plain text says, in tables.
pub fn render_check_markdown(report: &CheckReport) -> String {
    page(report).markdown()
}

fn page(report: &CheckReport) -> Page {
    let mut page = Page::new(&report.tool, "check of a surface", &report.units, false);
    page.verdict(verdict(report));
    page.section("Mesh");
    page.inputs(&report.inputs);
    let mesh = &report.mesh;
    let split = if mesh.faces == mesh.triangles { String::new() } else { format!(" from {} faces", mesh.faces) };
    page.words("size", &format!("{} vertices, {} triangles{split}", mesh.vertices, mesh.triangles));
    if let (Some(lo), Some(hi)) = (mesh.min, mesh.max) {
        let range = |i: usize| format!("{:.3} to {:.3}", lo[i], hi[i]);
        page.words("extent", &format!("x {}, y {}, z {}", range(0), range(1), range(2)));
    }
    page.words("area", &format!("{:.2} in plan, {:.2} in space", mesh.plan_area, mesh.surface_area));
    let boundary = &report.boundary;
    let mut loops = vec![counted(boundary.outer, "outer loop", "outer loops"), counted(boundary.holes, "hole", "holes")];
    if boundary.seams > 0 {
        loops.push(counted(boundary.seams, "open seam", "open seams"));
    }
    if boundary.unclosed > 0 {
        loops.push(format!("{} not closed", boundary.unclosed));
    }
    let pieces = counted(mesh.pieces, "piece", "pieces");
    page.words("boundary", &format!("{pieces}, {}, length {:.3}", loops.join(", "), boundary.length));
    for (severity, title) in [("error", "Errors"), ("remark", "Remarks")] {
        let found: Vec<&FindingFigures> = report.findings.iter().filter(|f| f.severity == severity).collect();
        if !found.is_empty() {
            page.section(title);
            found.into_iter().for_each(|f| finding(&mut page, f));
        }
    }
    slopes(&mut page, &report.slopes);
    if report.parts.len() > 1 {
        parts(&mut page, &report.parts);
    }
    if let Some(bound) = &report.slope_bound {
        self::bound(&mut page, bound);
    }
    if let Some(smallest) = &report.angles.smallest {
        page.section("Smallest angles");
        let bins = report.angles.histogram.iter().map(|bin| format!("to {}°: {}", bin.to, bin.triangles));
        page.words("triangles", &bins.collect::<Vec<_>>().join(", "));
        page.words("smallest", &format!("{:.4}°  {}", smallest.degrees, place(&smallest.place)));
    }
    page.warnings(&report.warnings);
    page
}

pub(in crate::report) fn verdict(report: &CheckReport) -> String {
    let v = &report.verdict;
    let sound = if v.sound { "the surface is sound" } else { "the surface is not sound" };
    let kept = match v.slope_kept {
        None => "",
        Some(true) if v.sound => " and keeps the slope",
        Some(true) => " but keeps the slope",
        Some(false) if v.sound => " but does not keep the slope",
        Some(false) => " and does not keep the slope",
    };
    format!("{}: {sound}{kept}", if v.passed { "PASSED" } else { "FAILED" })
}

fn finding(page: &mut Page, f: &FindingFigures) {
    let least = if f.at_least { "at least " } else { "" };
    let mut below: Vec<String> = f.places.iter().map(place).collect();
    if f.count > f.places.len() && !f.places.is_empty() {
        below.push(format!("… and {} more", f.count - f.places.len()));
    }
    page.remark(&format!("{least}{} {} [{}]", f.count, f.message, f.code), below);
}

pub(in crate::report) fn place(p: &PlaceFigures) -> String {
    let [x, y, z] = p.at;
    let mut text = format!("at ({x:.3}, {y:.3}, {z:.3})");
    for (name, names, numbers) in [("triangle", "triangles", &p.triangles), ("vertex", "vertices", &p.vertices)] {
        let list: Vec<String> = numbers.iter().map(usize::to_string).collect();
        match list.len() {
            0 => {}
            1 => text += &format!("  {name} {}", list[0]),
            _ => text += &format!("  {names} {}", list.join(", ")),
        }
    }
    for (name, &value) in &p.figures {
        let (name, unit) = name.strip_suffix("_deg").map_or((*name, ""), |name| (name, "°"));
        text += &format!("  {} {}{unit}", name.replace('_', " "), small(value));
    }
    text
}

fn slopes(page: &mut Page, s: &SlopesFigures) {
    let (Some(flattest), Some(steepest)) = (&s.flattest, &s.steepest) else { return };
    page.section("Slopes (by area in space)");
    page.words("flattest", &format!("{:.4}°  {}", flattest.degrees, place(&flattest.place)));
    page.words("steepest", &format!("{:.4}°  {}", steepest.degrees, place(&steepest.place)));
    page.words("mean", &format!("{:.4}°", s.mean_degrees));
    let common = s.common.iter().filter_map(|c| {
        let slope = Slope::from_ratio(c.degrees.to_radians().tan())?;
        let forms = slope.forms();
        let ratio = forms.split(" · ").next().unwrap_or_default();
        Some(format!("{:.2}° ({ratio}) {}", c.degrees, percent(c.share)))
    });
    let common: Vec<String> = common.collect();
    if !common.is_empty() {
        page.words("most common", &common.join(", "));
    }
    page.words("level, upright", &format!("{}, {}", share(&s.level), share(&s.upright)));
    if s.thin.triangles > 0 {
        page.words("too low to tell", &share(&s.thin));
    }
    let bins: Vec<(usize, f64, usize)> = (0..90 / BIN)
        .map(|i| {
            let inside = s.histogram.iter().filter(|bin| (bin.from as usize) / BIN == i);
            inside.fold((i * BIN, 0.0, 0), |(from, sum, n), bin| (from, sum + bin.share.share, n + bin.share.triangles))
        })
        .filter(|bin| bin.2 > 0)
        .collect();
    let most = bins.iter().map(|bin| bin.1).fold(f64::MIN_POSITIVE, f64::max);
    let row = |(from, part, triangles): (usize, f64, usize)| {
        let bar = "#".repeat((BAR * part / most).round() as usize);
        Row::Cells(vec![format!("{from}° to {:>2}°", from + BIN), percent(part), triangles.to_string(), bar])
    };
    let columns =
        vec![Column::numbers("slope", 0), Column::numbers("area", 9), Column::numbers("triangles", 9), Column::words("")];
    page.table(vec![Group { title: "", columns }], bins.into_iter().map(row).collect());
}

fn parts(page: &mut Page, parts: &[PartFigures]) {
    page.section("Parts");
    let columns = ["triangles", "plan area", "area", "flattest", "mean", "steepest"].map(|name| Column::numbers(name, 8));
    let columns = std::iter::once(Column::words("name")).chain(columns).collect();
    let row = |p: &PartFigures| {
        let s = &p.slopes;
        let degrees =
            |found: &Option<super::ExtremeFigures>| found.as_ref().map_or("-".to_owned(), |f| format!("{:.2}°", f.degrees));
        Row::Cells(vec![
            printable(&p.name),
            s.triangles.to_string(),
            format!("{:.2}", s.plan_area),
            format!("{:.2}", s.surface_area),
            degrees(&s.flattest),
            format!("{:.2}°", s.mean_degrees),
            degrees(&s.steepest),
        ])
    };
    let mut rows: Vec<Row> = parts.iter().take(MOST_PARTS).map(row).collect();
    if parts.len() > MOST_PARTS {
        rows.push(Row::Heading(format!("… and {} more", parts.len() - MOST_PARTS)));
    }
    page.table(vec![Group { title: "", columns }], rows);
}

fn bound(page: &mut Page, b: &BoundFigures) {
    page.section("Slope asked for");
    let forms = b.wanted().map_or_else(|| b.slope.ratio.to_string(), Slope::forms);
    page.words("slope", &format!("{forms}, within {}°", b.tolerance_deg));
    let about = if b.parts.is_empty() { "all that is not level".to_owned() } else { printable(&b.parts.join(", ")) };
    page.words("asked of", &about);
    page.words("on it", &share(&b.within));
    page.words("off it", &format!("{}; {} may be", share(&b.off), percent(b.max_off)));
    if b.parts.is_empty() && b.level.triangles > 0 {
        page.words("level, left out", &share(&b.level));
    }
    if b.thin.triangles > 0 {
        page.words("too low to tell", &share(&b.thin));
    }
    page.words("kept", if b.passed { "yes" } else { "NO" });
    if !b.worst.is_empty() {
        page.remark("triangles that deviate most", b.worst.iter().map(place).collect());
    }
}

pub(in crate::report) fn share(s: &ShareFigures) -> String {
    format!("{} of the area ({:.2}, {})", percent(s.share), s.area, counted(s.triangles, "triangle", "triangles"))
}

/// A share in percent. What is not all does not read as all, what is something not as nothing.
pub(in crate::report) fn percent(share: f64) -> String {
    let text = format!("{:.2} %", 100.0 * share);
    match text.as_str() {
        "0.00 %" if share > 0.0 => "< 0.01 %".to_owned(),
        "100.00 %" if share < 1.0 - f64::EPSILON * 8.0 => "> 99.99 %".to_owned(),
        _ => text,
    }
}

/// A figure: whole if it is whole, four decimals, or its order of magnitude.
fn small(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e12 {
        format!("{value}")
    } else if value.abs() < 1e-4 {
        format!("{value:.1e}")
    } else {
        format!("{value:.4}")
    }
}
