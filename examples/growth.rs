//! Draws how times grow: reads lines `name n seconds` (`panel/name n seconds` for several panels) from standard input and writes
//! an SVG file, both axes logarithmic, with the growth between the last two points of each curve: 1 is linear.
//!
//! ```text
//! cargo bench --bench growth | cargo run --example growth -- docs/growth.svg
//! ```

use std::fmt::Write as _;
use std::io::Read as _;

/// Width and height of the square of a panel, and the room around it for labels.
const SIDE: f64 = 360.0;
const LEFT: f64 = 64.0;
const RIGHT: f64 = 190.0;
const TOP: f64 = 44.0;
const BOTTOM: f64 = 52.0;

/// Least distance of the labels of two curves.
const LABEL: f64 = 24.0;

/// Colours of the curves, told apart also by those who see few (M. Okabe, K. Ito, "Color Universal Design", 2008).
const COLOURS: [&str; 7] = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", "#000000"];

/// A curve: its name and its points, by their size.
type Curve = (String, Vec<[f64; 2]>);

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let path = std::env::args().nth(1).ok_or("give the name of the file to be written")?;
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text)?;
    let panels = panels(&text);
    if panels.is_empty() {
        return Err("no line is `name n seconds`".into());
    }
    std::fs::write(path, svg(&panels))?;
    Ok(())
}

/// The curves by panel, in the order of their first lines. Other lines are passed over.
fn panels(text: &str) -> Vec<(String, Vec<Curve>)> {
    let mut panels: Vec<(String, Vec<Curve>)> = Vec::new();
    for line in text.lines() {
        let mut words = line.trim().rsplitn(3, ' ');
        let numbers = [words.next(), words.next()].map(|word| word.and_then(|w| w.parse::<f64>().ok()).filter(|v| *v > 0.0));
        let ([Some(seconds), Some(count)], Some(name)) = (numbers, words.next()) else { continue };
        let (panel, name) = name.split_once('/').unwrap_or(("", name));
        let at = panels.iter().position(|(known, _)| known == panel).unwrap_or_else(|| {
            panels.push((panel.to_owned(), Vec::new()));
            panels.len() - 1
        });
        let curves = &mut panels[at].1;
        match curves.iter_mut().find(|(known, _)| known == name) {
            Some((_, points)) => points.push([count, seconds]),
            None => curves.push((name.to_owned(), vec![[count, seconds]])),
        }
    }
    for (_, points) in panels.iter_mut().flat_map(|(_, curves)| curves) {
        points.sort_by(|a, b| a[0].total_cmp(&b[0]));
    }
    panels
}

fn svg(panels: &[(String, Vec<Curve>)]) -> String {
    let (width, height) = (panels.len() as f64 * (LEFT + SIDE + RIGHT), TOP + SIDE + BOTTOM);
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} \
         {height}\" font-family=\"system-ui, sans-serif\" font-size=\"12\"><title>How processor time grows</title>\n\
         <rect width=\"{width}\" height=\"{height}\" fill=\"#fff\"/>\n"
    );
    // All panels with the same decades of seconds, so that they can be compared.
    let seconds = decades(panels.iter().flat_map(|(_, curves)| curves).flat_map(|(_, points)| points).map(|p| p[1]));
    for (i, (name, curves)) in panels.iter().enumerate() {
        let _ = writeln!(svg, "<g transform=\"translate({} {TOP})\">", LEFT + i as f64 * (LEFT + SIDE + RIGHT));
        panel(&mut svg, name, curves, seconds);
        svg.push_str("</g>\n");
    }
    svg.push_str("</svg>\n");
    svg
}

/// Exponents of ten around all values.
fn decades(values: impl Iterator<Item = f64>) -> [i32; 2] {
    let logs = values.map(f64::log10).fold([f64::INFINITY, f64::NEG_INFINITY], |[lo, hi], v| [lo.min(v), hi.max(v)]);
    let [lo, hi] = [logs[0].floor() as i32, logs[1].ceil() as i32];
    [lo, hi.max(lo + 1)]
}

fn panel(svg: &mut String, name: &str, curves: &[Curve], seconds: [i32; 2]) {
    let counts = decades(curves.iter().flat_map(|(_, points)| points).map(|p| p[0]));
    let share = |value: f64, [lo, hi]: [i32; 2]| SIDE * (value.log10() - f64::from(lo)) / f64::from(hi - lo);
    let place = |[n, s]: [f64; 2]| [share(n, counts), SIDE - share(s, seconds)];
    let _ = writeln!(svg, "<text x=\"0\" y=\"-16\" font-size=\"15\" font-weight=\"600\" fill=\"#222\">{}</text>", escaped(name));
    for exponent in counts[0]..=counts[1] {
        let [x, _] = place([10_f64.powi(exponent), 1.0]);
        let _ = writeln!(svg, "<path d=\"M{x:.1} 0V{SIDE}\" stroke=\"#ddd\"/>");
        let _ = writeln!(
            svg,
            "<text x=\"{x:.1}\" y=\"{}\" text-anchor=\"middle\" fill=\"#444\">{}</text>",
            SIDE + 18.0,
            power(exponent)
        );
    }
    for exponent in seconds[0]..=seconds[1] {
        let [_, y] = place([1.0, 10_f64.powi(exponent)]);
        let _ = writeln!(svg, "<path d=\"M0 {y:.1}H{SIDE}\" stroke=\"#ddd\"/>");
        let label = power(exponent);
        let _ = writeln!(svg, "<text x=\"-8\" y=\"{:.1}\" text-anchor=\"end\" fill=\"#444\">{label}</text>", y + 4.0);
    }
    let middle = SIDE / 2.0;
    let _ = writeln!(
        svg,
        "<text x=\"{middle}\" y=\"{}\" text-anchor=\"middle\" fill=\"#444\">vertices (dotted: linear)</text>",
        SIDE + 40.0
    );
    let _ = writeln!(
        svg,
        "<text transform=\"translate(-46 {middle}) rotate(-90)\" text-anchor=\"middle\" fill=\"#444\">processor time, s</text>"
    );
    // What is linear, for the eye.
    let from = counts[0].max(counts[1] + seconds[0] - seconds[1]);
    let (a, b) = (
        place([10_f64.powi(from), 10_f64.powi(from - counts[1] + seconds[1])]),
        place([10_f64.powi(counts[1]), 10_f64.powi(seconds[1])]),
    );
    let _ =
        writeln!(svg, "<path d=\"M{:.1} {:.1}L{:.1} {:.1}\" stroke=\"#aaa\" stroke-dasharray=\"2 4\"/>", a[0], a[1], b[0], b[1]);
    // Labels beside the last points, from the top down, none on another.
    let mut labels: Vec<(usize, f64)> =
        curves.iter().enumerate().filter_map(|(i, (_, points))| Some((i, place(*points.last()?)[1]))).collect();
    labels.sort_by(|a, b| a.1.total_cmp(&b.1));
    let mut free = f64::NEG_INFINITY;
    for (i, wanted) in labels {
        let (name, points) = &curves[i];
        let colour = COLOURS[i % COLOURS.len()];
        let path: Vec<String> = points.iter().map(|p| place(*p)).map(|[x, y]| format!("{x:.1} {y:.1}")).collect();
        let _ = writeln!(svg, "<path d=\"M{}\" fill=\"none\" stroke=\"{colour}\" stroke-width=\"2\"/>", path.join("L"));
        for [x, y] in points.iter().map(|p| place(*p)) {
            let _ = writeln!(svg, "<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"3\" fill=\"{colour}\"/>");
        }
        let y = wanted.max(free);
        free = y + LABEL;
        let last = points.last().map_or([0.0; 2], |p| place(*p));
        let _ = writeln!(
            svg,
            "<path d=\"M{:.1} {:.1}L{:.1} {y:.1}\" fill=\"none\" stroke=\"{colour}\" stroke-opacity=\"0.4\"/>",
            last[0] + 4.0,
            last[1],
            SIDE + 8.0
        );
        let _ = writeln!(svg, "<text x=\"{}\" y=\"{:.1}\" fill=\"{colour}\">{}</text>", SIDE + 11.0, y + 4.0, escaped(name));
        if let Some(growth) = growth(points) {
            let _ = writeln!(
                svg,
                "<text x=\"{}\" y=\"{:.1}\" font-size=\"10\" fill=\"#555\">n^{growth:.2}</text>",
                SIDE + 11.0,
                y + 15.0
            );
        }
    }
}

/// Exponent of the growth between the last two points.
fn growth(points: &[[f64; 2]]) -> Option<f64> {
    let [.., [n, s], [m, t]] = points else { return None };
    Some((t / s).ln() / (m / n).ln())
}

/// A power of ten: `0.01`, `1`, `1000`, `10⁶`.
fn power(exponent: i32) -> String {
    match exponent {
        -3..=3 => format!("{}", 10_f64.powi(exponent)),
        _ => {
            let digit = |c: char| "⁰¹²³⁴⁵⁶⁷⁸⁹".chars().nth(c.to_digit(10).unwrap_or(0) as usize);
            let sign = if exponent < 0 { "⁻" } else { "" };
            let digits: String = exponent.unsigned_abs().to_string().chars().filter_map(digit).collect();
            format!("10{sign}{digits}")
        }
    }
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
