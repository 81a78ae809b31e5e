//! What differs, for people.

use super::{Change, DiffReport, Step, SurfaceChange};
use crate::model::message::printable;
use crate::report::result::short;
use serde_json::Value;
use std::fmt::Write as _;

/// Rows of one section that are shown; the JSON report has all.
const SHOWN: usize = 40;

/// Width of the names of figures.
const KEY: usize = 44;

/// Sections in the order shown, with the keys at the top of a report they hold. What has no section is in the last one.
const SECTIONS: [(&str, &[&str]); 8] = [
    ("Inputs", &["inputs", "meshes", "terrain"]),
    ("Parameters", &["units", "design", "slopes", "extent", "section_slope", "levels"]),
    ("Line", &["line"]),
    ("Volumes", &["volumes"]),
    ("Areas and depths", &["areas", "depths", "daylight", "surface", "finished", "pads"]),
    ("Certificate", &["certificate"]),
    ("Stations", &["stations"]),
    ("Warnings", &["warnings"]),
];

/// The report as plain text.
pub fn render_diff(report: &DiffReport) -> String {
    let mut text =
        format!("{} {}: differences, the second less the first\n\nInputs compared\n", report.tool.name, report.tool.version);
    for input in &report.inputs {
        let short = short(&input.sha256);
        let _ = writeln!(text, "  {:8}{} ({}, sha256 {short})", input.role, printable(&input.path), printable(&input.format));
    }
    if let Some(changes) = &report.changes {
        sections(&mut text, changes);
    }
    if let Some(surfaces) = &report.surfaces {
        self::surfaces(&mut text, surfaces, &report.unit);
    }
    if !report.bounds.is_empty() {
        text.push_str("\nBounds\n");
        for row in &report.bounds {
            let figure = |value: f64| if row.share { format!("{:.4} %", 100.0 * value) } else { number(value) };
            let word = if row.passed { "passed" } else { "beyond" };
            let (on, found, most) = (printable(&row.on), figure(row.found), figure(row.most));
            let _ = writeln!(text, "  {on:KEY$} {found} of {most} {word}");
        }
    }
    if !report.warnings.is_empty() {
        text.push_str("\nWarnings\n");
        for warning in &report.warnings {
            let _ = writeln!(text, "  {}: {}", warning.code, printable(&warning.message));
        }
    }
    text.push_str(if report.same { "\nNothing that counts differs\n" } else { "" });
    text
}

fn sections(text: &mut String, changes: &[Change]) {
    let section =
        |change: &Change| SECTIONS.iter().position(|(_, keys)| keys.contains(&top(&change.key))).unwrap_or(SECTIONS.len());
    let levels = changes.iter().filter(|change| top(&change.key) == "levels").count();
    for (index, title) in SECTIONS.iter().map(|(title, _)| *title).chain(["Other"]).enumerate() {
        // Times differ from run to run: nobody wants to read them.
        let of = |change: &&Change| section(change) == index && !change.key.starts_with("timing.");
        let mut here: Vec<&Change> = changes.iter().filter(of).collect();
        if here.is_empty() {
            continue;
        }
        if let Some((_, keys)) = SECTIONS.get(index) {
            here.sort_by_key(|change| keys.iter().position(|key| *key == top(&change.key)));
        }
        here.retain(|change| !repeats(change, changes));
        let _ = writeln!(text, "\n{title}");
        for change in here.iter().take(SHOWN) {
            let count = if top(&change.key) == "levels" { format!(" and {} more", levels - 1) } else { String::new() };
            let more = if levels > 1 { count.as_str() } else { "" };
            let _ = writeln!(text, "  {:KEY$} {}{more}", printable(&change.key), row(change));
        }
        if here.len() > SHOWN {
            let _ = writeln!(text, "  and {} more", here.len() - SHOWN);
        }
    }
}

/// Key at the top of the report.
fn top(key: &str) -> &str {
    key.split(['.', '[']).next().unwrap_or(key)
}

/// Whether a change says nothing that another does not: slopes have four forms, and levels shift together.
fn repeats(change: &Change, changes: &[Change]) -> bool {
    if top(&change.key) == "levels" {
        return changes.iter().find(|other| top(&other.key) == "levels").is_some_and(|first| first.key != change.key);
    }
    let other_form = ["ratio", "percent", "degrees"].iter().find_map(|form| change.key.strip_suffix(form));
    other_form.is_some_and(|slope| changes.iter().any(|other| other.key == format!("{slope}one_in")))
}

fn row(change: &Change) -> String {
    let shown = |value: Option<&Value>| value.map_or_else(|| "–".to_owned(), word);
    let (first, second) = (shown(change.first.as_ref()), shown(change.second.as_ref()));
    let Some(difference) = change.difference else { return format!("{first} → {second}") };
    let relative = change.relative.map_or_else(String::new, |share| format!("{:+.3} %", 100.0 * share));
    format!("{first:>16} → {second:>16} {:>14} {relative:>11}", signed(difference))
}

/// A value of a report short enough for a row.
fn word(value: &Value) -> String {
    const LONGEST: usize = 40;
    match value {
        Value::Number(n) => n.as_f64().map_or_else(|| n.to_string(), number),
        Value::String(text) => {
            let cut = text.chars().count() > LONGEST;
            let short: String = printable(text).chars().take(LONGEST).collect();
            format!("{short}{}", if cut { "…" } else { "" })
        }
        other => other.to_string(),
    }
}

/// A number in full if it is whole or short, else rounded to what lengths and volumes are read at.
fn number(value: f64) -> String {
    let whole = value.to_string();
    if whole.len() <= 12 || value == 0.0 {
        whole
    } else if value.abs() < 0.01 || value.abs() >= 1e12 {
        format!("{value:.3e}")
    } else {
        format!("{value:.4}")
    }
}

fn signed(value: f64) -> String {
    let sign = if value > 0.0 { "+" } else { "" };
    format!("{sign}{}", number(value))
}

fn surfaces(text: &mut String, found: &SurfaceChange, unit: &str) {
    text.push_str("\nSurfaces (over the plan area both share)\n");
    let mut line = |name: &str, value: f64, unit: &str| {
        let _ = writeln!(text, "  {name:28}{value:>16.4} {unit}");
    };
    let (area, volume) = (format!("{unit}²"), format!("{unit}³"));
    line("common area", found.common_area, &area);
    line("of it the same height", found.same_area, &area);
    line("first only", found.first_only, &area);
    line("second only", found.second_only, &area);
    line("second above first", found.above, &volume);
    line("second below first", found.below, &volume);
    line("mean height difference", found.height_mean, unit);
    line("mean without signs", found.height_mean_absolute, unit);
    line("greatest without sign", found.height_max, unit);
    for (name, step) in [("highest above", found.highest), ("lowest below", found.lowest)] {
        if let Some(Step { height, at }) = step {
            let _ = writeln!(text, "  {name:28}{height:>+16.4} {unit} at {:.3}, {:.3}, {:.3}", at.x, at.y, at.z);
        }
    }
}
