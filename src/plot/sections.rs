//! Cross-sections: design and ground in the vertical plane perpendicular to an axis, lengths and heights in the same scale.
//!
//! A section looks along the axis: what lies left of it is on the left. It shows the design as far as it goes without a gap, and
//! shades, on the sides where the slopes belong to the axis, what [`sections_at`] counts; its areas are those.

use super::between::Between;
use super::chart::Chart;
use super::course::{Course, courses};
use super::labels::{Labels, fitted, width};
use super::scale::{figure, multiples, round_step, signed};
use super::style::SMALL;
use super::svg::{Drawn, Path, Svg};
use super::{Scene, Style};
use crate::ground::{Section, place, sections_at};
use crate::mesh::drape::{Drape, Run};
use crate::model::{Part, Tin};
use glam::{DVec2, DVec3};

/// Most sections of one axis in one drawing; others are left out, which the last one tells.
const MOST: usize = 60;

const LEFT: f64 = 64.0;
const RIGHT: f64 = 18.0;
const HEAD: f64 = 34.0;

/// Least and greatest height of the field.
const HEIGHT: (f64, f64) = (110.0, 460.0);

/// Design and ground beside each other up to this far, in the length unit, meet at the axis: rounding.
const AT_AXIS: f64 = 1e-6;

/// Cross-sections of an axis, an index into the lines given, at some stations. Stations that are not on the axis, and those where
/// there is no design, are left out.
pub fn sections(scene: &Scene<'_>, axis: usize, stations: &[f64], style: &Style) -> Vec<(f64, String)> {
    all(scene, axis, stations, style).into_iter().map(|(station, drawn)| (station, drawn.text)).collect()
}

pub(super) fn drawn(scene: &Scene<'_>, axis: usize, stations: &[f64], style: &Style) -> Vec<Drawn> {
    let own = scene.ground.as_ref().map_or(&[][..], |ground| ground.stations.breaks(axis));
    let stations = if stations.is_empty() { own } else { stations };
    all(scene, axis, stations, style).into_iter().map(|(_, drawn)| drawn).collect()
}

/// What one plane shows. Offsets are positive to the right.
#[derive(Clone, Debug, Default)]
pub(super) struct View {
    /// The design, where it goes without a gap through the axis, with the triangle below each stretch.
    pub(super) design: Run,
    /// The ground in the window.
    pub(super) ground: Vec<Vec<DVec2>>,
    /// Where cut and fill are counted.
    pub(super) counted: (f64, f64),
    /// What is shown.
    pub(super) window: (f64, f64),
}

/// Meshes to be cut, with the extent of the design.
struct Cutter<'a> {
    design: Drape<'a>,
    ground: Option<Drape<'a>>,
    reach: f64,
}

impl<'a> Cutter<'a> {
    fn new(scene: &Scene<'a>) -> Self {
        let tin = scene.design;
        let used = tin.triangles.iter().flatten().map(|v| tin.vertices[*v as usize].truncate());
        let empty = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (lo, hi) = used.fold(empty, |(lo, hi), p| (lo.min(p), hi.max(p)));
        let extent = if lo.is_finite() { hi - lo } else { DVec2::ZERO };
        let around = 0.5 * extent + 1.0;
        let ground = scene.ground.as_ref().map(|ground| {
            let within = Some((lo - around, hi + around));
            Drape::new(&ground.terrain.vertices, &ground.terrain.triangles, within)
        });
        Self { design: Drape::new(&tin.vertices, &tin.triangles, None), ground, reach: extent.length() + 1.0 }
    }

    /// The section through a point, looking along a direction; `figures` say how far the works of the axis go.
    fn cut(&self, at: DVec2, along: DVec2, figures: Option<&Section>) -> Option<View> {
        // `perp` points to the left.
        let right = -along.perp();
        let shifted =
            |run: Run, from: f64| Run { points: run.points.iter().map(|p| DVec2::new(p.x + from, p.y)).collect(), ..run };
        let runs = self.design.along(at - right * self.reach, at + right * self.reach);
        let mut runs = runs.into_iter().map(|run| shifted(run, -self.reach));
        let through = |run: &Run| {
            let ends = run.points.first().zip(run.points.last());
            ends.is_some_and(|(a, b)| a.x <= AT_AXIS && b.x >= -AT_AXIS)
        };
        let design = runs.find(through)?;
        let (a, b) = design.points.first().zip(design.points.last()).map(|(a, b)| (a.x, b.x))?;
        let counted = figures.map_or((a, b), |section| (-section.left, section.right));
        // Another leg of the line may lie far away in the same plane: what is counted, and as much again, is enough.
        let (from, to) = (a.max(2.0 * counted.0 - 5.0), b.min(2.0 * counted.1 + 5.0));
        let margin = (0.12 * (to - from)).max(1.0);
        let window = (from - margin, to + margin);
        let ground = self.ground.as_ref().map_or_else(Vec::new, |ground| {
            let runs = ground.along(at + right * window.0, at + right * window.1);
            runs.into_iter().map(|run| shifted(run, window.0).points).collect()
        });
        Some(View { design, ground, counted, window })
    }
}

/// Sections with what they show and count.
pub(super) fn views(scene: &Scene<'_>, course: &Course, axis: usize, stations: &[f64]) -> Vec<(f64, View)> {
    let length = course.axis.length;
    let on_axis: Vec<f64> = stations.iter().copied().filter(|s| (0.0..=length).contains(s)).collect();
    let cutter = Cutter::new(scene);
    // The platform inside a ring belongs to no axis, and is shown whole.
    let figures = scene.ground.as_ref().filter(|_| !course.axis.closed);
    let figures = figures.map(|g| sections_at(g.pieces.iter(), g.stations, axis, &on_axis)).unwrap_or_default();
    let view = |(i, station): (usize, &f64)| {
        let (at, along) = place(&course.axis, *station)?;
        Some((*station, cutter.cut(at, along, figures.get(i))?))
    };
    on_axis.iter().enumerate().filter_map(view).collect()
}

fn all(scene: &Scene<'_>, axis: usize, stations: &[f64], style: &Style) -> Vec<(f64, Drawn)> {
    let Some(course) = courses(scene).into_iter().nth(axis) else { return Vec::new() };
    let shown = &stations[..stations.len().min(MOST)];
    let left_out = stations.len() - shown.len();
    let views = views(scene, &course, axis, shown);
    let last = views.len();
    let draw = |(i, (station, view)): (usize, (f64, View))| {
        let note = (left_out > 0 && i + 1 == last).then(|| format!("{left_out} more stations are not drawn"));
        (station, section(scene, &course, station, &view, note.as_deref(), style))
    };
    views.into_iter().enumerate().map(draw).collect()
}

/// A stretch of one part and one slope.
#[derive(Clone, Copy, Debug)]
struct Stretch {
    part: Part,
    from: DVec2,
    to: DVec2,
    /// Steepest gradient of the first triangle.
    slope: f64,
}

/// Gradients of a section that differ by less are one.
const SAME_SLOPE: f64 = 5e-3;

fn stretches(tin: &Tin, run: &Run) -> Vec<Stretch> {
    let mut found: Vec<Stretch> = Vec::new();
    for (pair, t) in run.points.windows(2).zip(&run.triangles) {
        let (from, to, t) = (pair[0], pair[1], *t as usize);
        if to.x <= from.x {
            continue;
        }
        let grade = |a: DVec2, b: DVec2| (b.y - a.y) / (b.x - a.x);
        let part = tin.parts[t];
        match found.last_mut() {
            Some(last) if last.part == part && (grade(last.from, last.to) - grade(from, to)).abs() < SAME_SLOPE => last.to = to,
            _ => found.push(Stretch { part, from, to, slope: steepest(tin.corners(t)) }),
        }
    }
    found
}

/// Steepest gradient of a triangle.
fn steepest([a, b, c]: [DVec3; 3]) -> f64 {
    let normal = (b - a).cross(c - a);
    normal.truncate().length() / normal.z.abs()
}

/// A slope as engineers write it: one vertical to so many horizontal; spelt out where that could be read either way.
fn ratio(slope: f64) -> String {
    let run = 1.0 / slope;
    let text = format!("{run:.2}");
    let short = text.trim_end_matches('0').trim_end_matches('.');
    if run >= 0.995 { format!("1:{short}") } else { format!("1V:{short}H") }
}

fn section(scene: &Scene<'_>, course: &Course, station: f64, view: &View, note: Option<&str>, style: &Style) -> Drawn {
    let unit = scene.unit;
    let (from, to) = view.window;
    let shown = |p: &&DVec2| (from..=to).contains(&p.x);
    let heights = view.design.points.iter().chain(view.ground.iter().flatten()).filter(shown).map(|p| p.y);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
    let size_x = style.width() - LEFT - RIGHT;
    // Room above for figures at the hinge and at the daylight line.
    let (above, under) = (46.0, 26.0);
    let scale = (size_x / (to - from)).min((HEIGHT.1 - above - under) / (high - low).max(1e-9));
    let size_y = ((high - low) * scale + above + under).max(HEIGHT.0).round();
    let middle = 0.5 * (from + to);
    let half = 0.5 * size_x / scale;
    let spare = (size_y - above - under - (high - low) * scale) * 0.5;
    let bottom = low - (under + spare) / scale;
    let chart = Chart {
        at: DVec2::new(LEFT, HEAD),
        size: DVec2::new(size_x, size_y),
        low: DVec2::new(middle - half, bottom),
        high: DVec2::new(middle + half, bottom + size_y / scale),
    };

    let mut between = Between::default();
    view.ground.iter().for_each(|ground| between.add(&view.design.points, ground, view.counted.0, view.counted.1));
    let name = format!("Station {}", figure(station, 2));
    let title = format!("{name} of {}", course.axis.name);
    let areas = if view.ground.is_empty() {
        "no ground".to_owned()
    } else {
        format!("cut {} {unit}² · fill {} {unit}²", figure(between.cut_area, 2), figure(between.fill_area, 2))
    };
    let mut svg = Svg::new(style, DVec2::new(style.width(), HEAD + size_y + 40.0), &title, &format!("Cross-section: {areas}."));
    svg.text("b", DVec2::new(LEFT, 22.0), 0.0, &fitted(&name, 12.0, 160.0));
    let more = note.map_or_else(String::new, |note| format!(" · {note}"));
    let text = format!("{areas} · {}{more}", course.axis.name);
    svg.text("s soft", DVec2::new(LEFT + 170.0, 22.0), 0.0, &fitted(&text, SMALL, size_x - 180.0));

    let step = round_step(34.0 / scale);
    chart.rows(&mut svg, step);
    let across = round_step(56.0 / scale);
    let offsets = multiples(chart.low.x, chart.high.x, across);
    chart.columns(&mut svg, &offsets, chart.bottom());
    chart.lines(&mut svg, "c3", &between.cut, true);
    chart.lines(&mut svg, "f3", &between.fill, true);
    chart.lines(&mut svg, "ln ground", &view.ground, false);
    let axis = |y: f64| DVec2::new(0.0, y);
    chart.lines(&mut svg, "ln axis", &[vec![axis(chart.low.y), axis(chart.high.y)]], false);
    let design: Vec<DVec2> = view.design.points.iter().filter(shown).copied().collect();
    chart.lines(&mut svg, "ln design", &[design], false);
    annotate(&mut svg, &chart, scene.design, view);
    svg.rect("frame", chart.at, chart.size);
    let digits = super::scale::decimals(across);
    chart.below(&mut svg, "s m soft", chart.bottom() + 15.0, offsets.into_iter().map(|x| (x, signed(x, digits))));
    let words = format!("offset from the axis, right +; elevations; in {unit}, all to one scale");
    svg.text("s soft", DVec2::new(LEFT, chart.bottom() + 31.0), 0.0, &words);
    svg.finish()
}

/// Slopes along the design, and figures where they begin and end.
fn annotate(svg: &mut Svg, chart: &Chart, tin: &Tin, view: &View) {
    let mut labels = Labels::default();
    let all = stretches(tin, &view.design);
    let (from, to) = view.window;
    let mut points: Vec<DVec2> = Vec::new();
    for (i, stretch) in all.iter().enumerate() {
        let before = i.checked_sub(1).map(|i| all[i].part);
        if before != Some(stretch.part) {
            points.push(stretch.from);
        }
        if i + 1 == all.len() {
            points.push(stretch.to);
        }
    }
    for p in points.into_iter().filter(|p| (from..=to).contains(&p.x)) {
        let at = chart.px(p);
        let texts = [format!("{} ", signed(p.x, 2)), figure(p.y, 2)];
        let wide = texts.iter().map(|text| width(text, SMALL)).fold(0.0, f64::max);
        let widest = if texts[0].len() > texts[1].len() { &texts[0] } else { &texts[1] };
        svg.circle("dot", at, 2.6);
        for lift in [24.0, -24.0, 52.0, -52.0] {
            let centre = DVec2::new(at.x.clamp(chart.at.x + 0.5 * wide, chart.right() - 0.5 * wide), at.y - lift);
            let inside = centre.y > chart.at.y + 14.0 && centre.y < chart.bottom() - 14.0;
            let room = |labels: &mut Labels| {
                labels.take(centre - DVec2::new(0.0, 6.5), 0.0, widest, SMALL)
                    && labels.take(centre + DVec2::new(0.0, 6.6), 0.0, widest, SMALL)
            };
            if inside && room(&mut labels) {
                let mut path = Path::default();
                path.add(&[at - DVec2::new(0.0, lift.signum() * 4.0), centre + DVec2::new(0.0, lift.signum() * 13.0)], false);
                svg.path("tick", &path);
                svg.text("s m halo", centre - DVec2::new(0.0, 2.5), 0.0, texts[0].trim());
                svg.text("s m halo", centre + DVec2::new(0.0, 10.6), 0.0, &texts[1]);
                break;
            }
        }
    }
    for stretch in all {
        let (a, b) = (chart.px(stretch.from), chart.px(stretch.to));
        let seen = ((stretch.to.y - stretch.from.y) / (stretch.to.x - stretch.from.x)).abs();
        let text = match stretch.part {
            Part::Platform if seen < 5e-4 => continue,
            Part::Platform => format!("{} %", figure(100.0 * seen, 1)),
            _ if ratio(seen) == ratio(stretch.slope) => ratio(seen),
            _ => format!("{} ({} here)", ratio(stretch.slope), ratio(seen)),
        };
        if a.distance(b) < width(&text, SMALL) + 10.0 {
            continue;
        }
        let along = (b - a).normalize_or_zero();
        let turn = along.to_angle().to_degrees();
        for side in [-9.0, 9.0] {
            let centre = 0.5 * (a + b) + along.perp() * side;
            if labels.take(centre, turn, &text, SMALL) {
                svg.text("s m halo", centre + along.perp() * 4.0, turn, &text);
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ratios_can_be_read_one_way_only() {
        assert_eq!((ratio(1.0 / 1.5), ratio(1.0), ratio(2.0)), ("1:1.5".to_owned(), "1:1".to_owned(), "1V:0.5H".to_owned()));
    }
}
