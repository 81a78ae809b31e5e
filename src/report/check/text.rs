//! The report of a check for people: one screen, unless much is wrong.

use super::{BoundFigures, CheckReport, FindingFigures, PartFigures, PlaceFigures, ShareFigures, SlopesFigures};
use crate::model::Slope;
use std::fmt::Write as _;

/// Width of the names before the figures.
const NAME: usize = 20;
/// Degrees of a bin of the histogram as printed.
const BIN: usize = 5;
/// Length of the longest bar of the histogram.
const BAR: f64 = 40.0;
/// Hexadecimal digits of a SHA-256 that tell files apart by eye.
const SHORT_SHA: usize = 12;
/// Parts that are listed.
const MOST_PARTS: usize = 12;

/// The report as plain text. The same report gives the same bytes.
pub fn render_check(report: &CheckReport) -> String {
    let unit = &report.units.length;
    let mut text =
        format!("{} {}: check of a surface\nLengths in {unit}, areas in {unit}²\n\n", report.tool.name, report.tool.version);
    line(&mut text, verdict(report));
    section(&mut text, "Mesh");
    for input in &report.inputs {
        let short = input.sha256.get(..SHORT_SHA).unwrap_or(&input.sha256);
        named(&mut text, "input", format!("{} ({}, sha256 {short})", printable(&input.path), input.format));
    }
    let mesh = &report.mesh;
    let split = if mesh.faces == mesh.triangles { String::new() } else { format!(" from {} faces", mesh.faces) };
    named(&mut text, "size", format!("{} vertices, {} triangles{split}", mesh.vertices, mesh.triangles));
    if let (Some(lo), Some(hi)) = (mesh.min, mesh.max) {
        let range = |i: usize| format!("{:.3} to {:.3}", lo[i], hi[i]);
        named(&mut text, "extent", format!("x {}, y {}, z {}", range(0), range(1), range(2)));
    }
    named(&mut text, "area", format!("{:.2} in plan, {:.2} in space", mesh.plan_area, mesh.surface_area));
    let boundary = &report.boundary;
    let mut loops = vec![count(boundary.outer, "outer loop", "outer loops"), count(boundary.holes, "hole", "holes")];
    if boundary.seams > 0 {
        loops.push(count(boundary.seams, "open seam", "open seams"));
    }
    if boundary.unclosed > 0 {
        loops.push(format!("{} not closed", boundary.unclosed));
    }
    let pieces = count(mesh.pieces, "piece", "pieces");
    named(&mut text, "boundary", format!("{pieces}, {}, length {:.3}", loops.join(", "), boundary.length));
    for (severity, title) in [("error", "Errors"), ("remark", "Remarks")] {
        let found: Vec<&FindingFigures> = report.findings.iter().filter(|f| f.severity == severity).collect();
        if !found.is_empty() {
            section(&mut text, title);
            found.into_iter().for_each(|f| finding(&mut text, f));
        }
    }
    slopes(&mut text, &report.slopes);
    if report.parts.len() > 1 {
        parts(&mut text, &report.parts);
    }
    if let Some(bound) = &report.slope_bound {
        self::bound(&mut text, bound);
    }
    if let Some(smallest) = &report.angles.smallest {
        section(&mut text, "Smallest angles");
        let bins = report.angles.histogram.iter().map(|bin| format!("to {}°: {}", bin.to, bin.triangles));
        named(&mut text, "triangles", bins.collect::<Vec<_>>().join(", "));
        named(&mut text, "smallest", format!("{:.4}°{}", smallest.degrees, place(&smallest.place)));
    }
    if !report.warnings.is_empty() {
        section(&mut text, "Notes");
        for warning in &report.warnings {
            line(&mut text, format!("  {}: {}", warning.code, printable(&warning.message)));
        }
    }
    text
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

fn finding(text: &mut String, f: &FindingFigures) {
    let least = if f.at_least { "at least " } else { "" };
    line(text, format!("  {least}{} {} [{}]", f.count, f.message, f.code));
    for p in &f.places {
        line(text, format!("     {}", place(p).trim_start()));
    }
    if f.count > f.places.len() && !f.places.is_empty() {
        line(text, format!("     … and {} more", f.count - f.places.len()));
    }
}

pub(in crate::report) fn place(p: &PlaceFigures) -> String {
    let [x, y, z] = p.at;
    let mut text = format!("  at ({x:.3}, {y:.3}, {z:.3})");
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

fn slopes(text: &mut String, s: &SlopesFigures) {
    let (Some(flattest), Some(steepest)) = (&s.flattest, &s.steepest) else { return };
    section(text, "Slopes (by area in space)");
    named(text, "flattest", format!("{:.4}°{}", flattest.degrees, place(&flattest.place)));
    named(text, "steepest", format!("{:.4}°{}", steepest.degrees, place(&steepest.place)));
    named(text, "mean", format!("{:.4}°", s.mean_degrees));
    let common = s.common.iter().filter_map(|c| {
        let slope = Slope::from_ratio(c.degrees.to_radians().tan())?;
        let forms = slope.forms();
        let ratio = forms.split(" · ").next().unwrap_or_default();
        Some(format!("{:.2}° ({ratio}) {}", c.degrees, percent(c.share)))
    });
    let common: Vec<String> = common.collect();
    if !common.is_empty() {
        named(text, "most common", common.join(", "));
    }
    named(text, "level, upright", format!("{}, {}", share(&s.level), share(&s.upright)));
    if s.thin.triangles > 0 {
        named(text, "too low to tell", share(&s.thin));
    }
    let bins: Vec<(usize, f64, usize)> = (0..90 / BIN)
        .map(|i| {
            let inside = s.histogram.iter().filter(|bin| (bin.from as usize) / BIN == i);
            inside.fold((i * BIN, 0.0, 0), |(from, sum, n), bin| (from, sum + bin.share.share, n + bin.share.triangles))
        })
        .filter(|bin| bin.2 > 0)
        .collect();
    let most = bins.iter().map(|bin| bin.1).fold(f64::MIN_POSITIVE, f64::max);
    for (from, part, triangles) in bins {
        let bar = "#".repeat((BAR * part / most).round() as usize);
        line(
            text,
            format!("  {from:>2}° to {:>2}° {:>9} {triangles:>9}  {bar}", from + BIN, percent(part)).trim_end().to_owned(),
        );
    }
}

fn parts(text: &mut String, parts: &[PartFigures]) {
    section(text, "Parts");
    let width = parts.iter().take(MOST_PARTS).map(|p| printable(&p.name).chars().count()).max().unwrap_or(0).max(NAME - 2);
    line(
        text,
        format!(
            "  {:width$}{:>10}{:>14}{:>14}{:>10}{:>10}{:>10}",
            "name", "triangles", "plan area", "area", "flattest", "mean", "steepest"
        ),
    );
    for p in parts.iter().take(MOST_PARTS) {
        let s = &p.slopes;
        let degrees =
            |found: &Option<super::ExtremeFigures>| found.as_ref().map_or("-".to_owned(), |f| format!("{:.2}°", f.degrees));
        let (flattest, steepest) = (degrees(&s.flattest), degrees(&s.steepest));
        let name = printable(&p.name);
        line(
            text,
            format!(
                "  {name:width$}{:>10}{:>14.2}{:>14.2}{flattest:>10}{:>9.2}°{steepest:>10}",
                s.triangles, s.plan_area, s.surface_area, s.mean_degrees
            ),
        );
    }
    if parts.len() > MOST_PARTS {
        line(text, format!("  … and {} more", parts.len() - MOST_PARTS));
    }
}

fn bound(text: &mut String, b: &BoundFigures) {
    section(text, "Slope asked for");
    let forms = b.wanted().map_or_else(|| b.slope.ratio.to_string(), Slope::forms);
    named(text, "slope", format!("{forms}, within {}°", b.tolerance_deg));
    let about = if b.parts.is_empty() { "all that is not level".to_owned() } else { printable(&b.parts.join(", ")) };
    named(text, "asked of", about);
    named(text, "on it", share(&b.within));
    named(text, "off it", format!("{}; {} may be", share(&b.off), percent(b.max_off)));
    if b.parts.is_empty() && b.level.triangles > 0 {
        named(text, "level, left out", share(&b.level));
    }
    if b.thin.triangles > 0 {
        named(text, "too low to tell", share(&b.thin));
    }
    for p in &b.worst {
        line(text, format!("     {}", place(p).trim_start()));
    }
    named(text, "kept", if b.passed { "yes" } else { "NO" }.to_owned());
}

pub(in crate::report) fn share(s: &ShareFigures) -> String {
    format!("{} of the area ({:.2}, {})", percent(s.share), s.area, count(s.triangles, "triangle", "triangles"))
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

fn count(n: usize, one: &str, several: &str) -> String {
    format!("{n} {}", if n == 1 { one } else { several })
}

fn section(text: &mut String, title: &str) {
    // Writing to a String cannot fail.
    let _ = writeln!(text, "\n{title}");
}

fn line(text: &mut String, words: String) {
    let _ = writeln!(text, "{words}");
}

fn named(text: &mut String, name: &str, words: String) {
    let _ = writeln!(text, "  {name:NAME$}{}", words.trim_start());
}

/// Text from a file, without characters that would move the cursor or colour a terminal.
fn printable(text: &str) -> String {
    text.chars().map(|c| if c.is_control() { ' ' } else { c }).collect()
}
