//! The report for people.

mod between;
mod ground;

pub use between::{write_between, write_between_markdown};

use super::page::{Column, Group, Page, Row};
use super::{BuriedStretch, ExtentKind, LineFigures, Report, SurfaceFigures, Volumes};
use crate::model::Slope;
use crate::model::message::printable;
use crate::write::EncodeError;
use std::io::Write;

/// Writes a report as plain text, UTF-8. The same report gives the same bytes; times are not in it.
///
/// # Errors
/// [`EncodeError::Io`] from the sink.
pub fn write_text(out: &mut (impl Write + ?Sized), report: &Report) -> Result<(), EncodeError> {
    out.write_all(render(report).as_bytes())?;
    Ok(())
}

/// Writes a report as Markdown, UTF-8: what the plain text says, in tables.
///
/// # Errors
/// [`EncodeError::Io`] from the sink.
pub fn write_markdown(out: &mut (impl Write + ?Sized), report: &Report) -> Result<(), EncodeError> {
    out.write_all(page(report).markdown().as_bytes())?;
    Ok(())
}

/// The report as plain text.
pub fn render(report: &Report) -> String {
    page(report).plain()
}

fn page(report: &Report) -> Page {
    let about = if report.terrain.is_some() { "works of constant slope on existing ground" } else { "surface of constant slope" };
    let mut page = Page::new(&report.tool, about, &report.units, true);
    page.section("Input");
    page.inputs(&report.inputs);
    line(&mut page, &report.line);
    page.section("Slope (true steepness, along the lines of steepest descent)");
    for (name, slope) in [("cut", report.slopes.cut), ("fill", report.slopes.fill)] {
        if let Some(slope) = slope {
            page.words(name, &slope.forms());
            let seen = report.section_slope.and_then(|seen| if name == "cut" { seen.cut } else { seen.fill });
            if let Some(range) = seen {
                ground::section_slope(&mut page, range);
            }
        }
    }
    page.section("Extent");
    let kind = match report.extent.kind {
        ExtentKind::Elevation => "to elevation",
        ExtentKind::Height => "height",
        ExtentKind::Distance => "plan distance",
        ExtentKind::Ground => "slopes end",
    };
    match report.extent.value {
        Some(value) => page.length(kind, value),
        None => page.words(kind, "at the existing ground"),
    }
    if let (Some(first), Some(last)) = (report.levels.first(), report.levels.last()) {
        page.words("levels", &format!("{} from {first} to {last}", report.levels.len()));
    }
    if let Some(interval) = report.design.interval {
        page.length("  interval", interval);
    }
    surface(&mut page, &report.surface);
    certificate(&mut page, report);
    page.small("  tolerance", &short(report.design.tolerance));
    ground::terrain(&mut page, report);
    if let Some(volumes) = &report.volumes {
        self::volumes(&mut page, report, volumes);
        ground::volumes(&mut page, volumes);
    }
    if let Some(depths) = &report.depths {
        ground::depths(&mut page, depths);
    }
    if let Some(soil) = report.volumes.as_ref().and_then(|volumes| volumes.bulking) {
        ground::bulking(&mut page, soil);
    }
    if let Some(stations) = &report.stations {
        ground::stations(&mut page, stations, report.pads, report.volumes.as_ref());
    }
    page.warnings(&report.warnings);
    page
}

fn line(page: &mut Page, line: &LineFigures) {
    page.section("Line");
    page.count("chains", line.chains);
    page.count("vertices", line.vertices);
    if line.simplified > 0 {
        page.count("simplified", line.simplified);
        page.small("  greatest shift", &short(line.simplified_max));
    }
    page.length("length", line.length);
    if let Some(width) = line.width {
        page.length("width of roads", width);
    }
    if let Some(fall) = line.crossfall.filter(|fall| fall.left != 0.0 || fall.right != 0.0) {
        let percent = |fall: f64| format!("{:.2}", 100.0 * fall);
        let both = if fall.left == fall.right { percent(fall.left) } else { [fall.left, fall.right].map(percent).join(", ") };
        page.figure("crossfall", &both, "%");
    }
    if line.breaklines > 0 {
        page.count("breaklines", line.breaklines);
    }
    page.length("lowest", line.z_min);
    page.length("highest", line.z_max);
    page.figure("greatest gradient", &format!("{:.2}", 100.0 * line.gradient_max), "%");
    if line.buried.is_empty() {
        return;
    }
    page.section("Buried stretches (stations; the line lies outside the surface there)");
    let columns = vec![
        Column::words("chain"),
        Column::numbers("from", 12),
        Column::numbers("to", 12),
        Column::numbers("depth", 10),
        Column::words("under"),
        Column::numbers("station", 12),
        Column::words("free from"),
    ];
    let row = |b: &BuriedStretch| {
        let free = b.free_slope.and_then(Slope::from_ratio).map_or_else(|| "no slope".to_owned(), Slope::not_flatter);
        let figure = |value: f64| format!("{value:.3}");
        let [chain, by_chain] = [&b.chain, &b.by_chain].map(|name| printable(name));
        Row::Cells(vec![chain, figure(b.from), figure(b.to), figure(b.depth), by_chain, figure(b.by_station), free])
    };
    page.table(vec![Group { title: "", columns }], line.buried.iter().map(row).collect());
}

fn surface(page: &mut Page, surface: &SurfaceFigures) {
    page.section("Surface");
    page.count("vertices", surface.vertices);
    page.count("triangles", surface.triangles);
    page.area("area in plan", surface.plan_area);
    page.area("slopes", surface.slope_area);
    page.area("  of fill", surface.fill_slope_area);
    page.area("  of cut", surface.cut_slope_area);
    page.area("platform", surface.platform_area);
}

fn certificate(page: &mut Page, report: &Report) {
    let c = &report.certificate;
    let yes = |yes: bool| if yes { "yes" } else { "NO" };
    let of_sheets = |of: bool| match report.terrain {
        Some(_) => format!("{}, before the ground cut it", yes(of)),
        None => yes(of).to_owned(),
    };
    page.section("Certificate (measured on this mesh)");
    page.words("facets pair", &of_sheets(c.paired));
    page.words("manifold", yes(c.manifold));
    page.words("line kept as edges", &of_sheets(c.input_edges_kept));
    page.count("overlaps", c.overlaps);
    page.figure("slope deviation", &angle(c.slope_max_deviation_deg), "°");
    page.figure("  planar strips", &angle(c.strip_max_deviation_deg), "°");
    page.figure("  cone sectors", &angle(c.sector_max_deviation_deg), "°");
    page.count("  beyond 0.1°", c.triangles_beyond_0_1deg);
    page.small("height deviation", &short(c.height_max_deviation));
}

fn volumes(page: &mut Page, report: &Report, v: &Volumes) {
    let against = match v.reference.elevation {
        Some(z) => format!("{} at elevation {z}", v.reference.kind),
        None if v.reference.kind == "terrain" => "existing ground".to_owned(),
        None => v.reference.kind.clone(),
    };
    page.section(&format!("Volumes ({}, against the {against})", v.method));
    page.volume("cut", v.cut, "");
    page.volume("fill", v.fill, "");
    let (net, balance) = v.balance.shown(v.net);
    page.volume("net (cut − fill)", net, &format!(" {}", balance.word()));
    page.volume("error at most", v.error_bound, "");
    let (whole, words) = report.completeness();
    page.words("complete", &format!("{}, {words}", if whole { "yes" } else { "NO" }));
    page.words("method", v.method_text);
    page.words("sign", v.sign_rule);
}

/// A deviation in degrees. What is only rounding has no digits worth printing, and they differ between machines.
pub(super) fn angle(degrees: f64) -> String {
    const ROUNDING: f64 = 1e-7;
    if degrees > 0.0 && degrees < ROUNDING { format!("< {ROUNDING:e}") } else { short(degrees) }
}

/// A small figure: four decimals, or its order of magnitude.
pub(super) fn short(value: f64) -> String {
    /// Smaller ones are written with an exponent.
    const PLAIN: f64 = 1e-4;
    if value == 0.0 {
        "0".to_owned()
    } else if value.abs() < PLAIN {
        format!("{value:.1e}")
    } else {
        format!("{value:.4}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::report::testing::{compare, full, least, on_ground};

    #[test]
    fn a_full_report_is_pinned() {
        compare(&render(&full()), include_str!("../../tests/golden/report.txt"), "report.txt");
    }

    #[test]
    fn a_full_report_on_ground_is_pinned() {
        compare(&render(&on_ground()), include_str!("../../tests/golden/report_ground.txt"), "report_ground.txt");
    }

    /// The running net is measured, not in bank: its last figure and the platforms without stations are the net.
    #[test]
    fn the_running_net_ends_at_the_net() {
        let report = on_ground();
        let last = report.stations.as_ref().unwrap().last().unwrap();
        let (pads, volumes) = (report.pads.unwrap(), report.volumes.as_ref().unwrap());
        assert!((last.net_cumulative + pads.cut - pads.fill - volumes.net).abs() < 1e-9);
        let soil = volumes.bulking.unwrap();
        assert!((soil.net_bank - volumes.net).abs() > 1.0, "in bank it is another figure");
        let text = render(&report);
        let row = text.lines().find(|line| line.trim_start().starts_with(&format!("{:.2}", last.from))).unwrap();
        let heads = text.lines().find(|line| line.contains("as measured")).unwrap();
        // The column below these words.
        let end = heads.find("as measured").unwrap() + "as measured".len();
        let figure = row[..end].split_whitespace().last().unwrap();
        assert_eq!(figure, format!("{:.2}", last.net_cumulative));
        assert!(!text.contains("in bank"), "{text}");
    }

    fn markdown(report: &Report) -> String {
        let mut bytes = Vec::new();
        write_markdown(&mut bytes, report).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn markdown_is_pinned() {
        compare(&markdown(&on_ground()), include_str!("../../tests/golden/report_ground.md"), "report_ground.md");
    }

    /// Words of a page without what shapes it.
    fn words(text: &str) -> Vec<String> {
        let plain: String = text.chars().map(|c| if "|#*\\–- \n:".contains(c) { ' ' } else { c }).collect();
        let mut words: Vec<String> = plain.split_whitespace().map(str::to_owned).collect();
        words.sort();
        words.dedup();
        words
    }

    #[test]
    fn both_forms_say_the_same() {
        for report in [full(), on_ground(), least()] {
            assert_eq!(words(&render(&report)), words(&markdown(&report)));
        }
    }

    #[test]
    fn names_from_files_are_no_markup() {
        let mut report = full();
        report.line.buried[0].chain = "a|b `c` <b>".into();
        report.inputs[0].path = "x|y.csv".into();
        report.warnings[0].message = "first\n# second".into();
        let text = markdown(&report);
        assert!(
            text.contains("\n| a\\|b \\`c\\` \\<b\\> |") && text.contains("| x\\|y.csv (") && text.contains("\n  * \\# second\n"),
            "{text}"
        );
    }

    #[test]
    fn lines_fit_a_terminal() {
        for report in [full(), on_ground(), least()] {
            let text = render(&report);
            assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
        }
    }

    #[test]
    fn lines_are_told_apart_by_name() {
        let mut report = on_ground();
        report.stations.as_mut().unwrap()[1].chain = "Rampe\u{1b}".into();
        let text = render(&report);
        assert!(text.matches("\n  road\n").count() == 2 && text.contains("\n  Rampe \n"), "{text}");
        report.stations.as_mut().unwrap()[1].chain = "road".into();
        assert!(!render(&report).contains("\n  road\n"));
    }

    #[test]
    fn sections_that_do_not_apply_are_left_out() {
        let text = render(&least());
        for absent in ["Buried", "simplified", "coordinate system", "levels", "Volumes", "deepest", "Warnings", "  cut  "] {
            assert!(!text.contains(absent), "{absent} in\n{text}");
        }
        assert!(text.contains("plan distance") && text.ends_with("m\n"), "{text}");
    }

    #[test]
    fn units_are_those_given() {
        let mut report = full();
        report.units = crate::model::LengthUnit::Foot.into();
        let text = render(&report);
        assert!(text.contains("Lengths in ft, areas in ft², volumes in ft³; 1 ft = 0.3048 m\n"));
        assert!(
            text.contains(" ft³ deficit\n")
                && !text.replace("0.3048 m\n", "").contains(" m\n")
                && !text.contains(" m²")
                && !text.contains(" m³")
        );
    }

    #[test]
    fn names_from_files_cannot_break_the_page() {
        let mut report = full();
        report.line.buried[0].chain = "a\nb\u{1b}[2J".into();
        report.inputs[0].crs = Some("x\ty".into());
        report.warnings[0].message = "first\nsecond\u{7}".into();
        let text = render(&report);
        assert!(text.contains("\n  a b [2J"), "{text}");
        assert!(text.contains("buried: first\n    second\n"), "{text}");
        assert!(text.chars().all(|c| c == '\n' || !c.is_control()));
    }

    #[test]
    fn failed_checks_stand_out() {
        let mut report = full();
        report.certificate.paired = false;
        assert!(render(&report).contains("  facets pair         NO\n"));
    }
}
