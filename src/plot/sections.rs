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
use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;
use crate::mesh::drape::{Drape, Run};
use crate::model::{Part, Tin, digits};
use glam::{DVec2, DVec3};

/// Most sections of one axis in one drawing; others are left out, which the last one tells.
pub const MOST_SECTIONS: usize = 60;

const LEFT: f64 = 64.0;
const RIGHT: f64 = 18.0;
const HEAD: f64 = 34.0;

/// Least and greatest height of the field.
const HEIGHT: (f64, f64) = (110.0, 460.0);

/// Room above and below the lines, for figures.
const ABOVE: f64 = 50.0;
const UNDER: f64 = 46.0;

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
    /// The part of the design that is shown, with some ground on both sides.
    shown: (f64, f64),
    /// What the field shows.
    window: (f64, f64),
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
        let PlanBox { lo, hi } = PlanBox::of(used);
        let extent = if lo.is_finite() { hi - lo } else { DVec2::ZERO };
        let reach = extent.length() + 1.0;
        // The window of a section is hardly wider than the design is anywhere.
        let around = PlanBox { lo: lo - reach, hi: hi + reach };
        let ground =
            scene.ground.as_ref().map(|ground| Drape::new(&ground.terrain.vertices, &ground.terrain.triangles, Some(around)));
        Self { design: Drape::new(&tin.vertices, &tin.triangles, None), ground, reach }
    }

    /// The design in the plane through a point, looking along a direction; `figures` say how far the works of the axis go.
    fn design(&self, at: DVec2, along: DVec2, figures: Option<&Section>) -> Option<View> {
        let right = right_of(along);
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
        let margin = (0.1 * (to - from)).max(1.0);
        Some(View { design, counted, shown: (from - margin, to + margin), ..View::default() })
    }

    /// The ground in the window of a view.
    fn add_ground(&self, at: DVec2, along: DVec2, view: &mut View) {
        let Some(ground) = &self.ground else { return };
        let (right, window) = (right_of(along), view.window);
        let runs = ground.along(at + right * window.0, at + right * window.1);
        view.ground = runs.into_iter().map(|run| shifted(run, window.0).points).collect();
    }
}

fn right_of(along: DVec2) -> DVec2 {
    // `perp` points to the left.
    -along.perp()
}

fn shifted(run: Run, from: f64) -> Run {
    Run { points: run.points.iter().map(|p| DVec2::new(p.x + from, p.y)).collect(), ..run }
}

/// At the ends of an open axis sections stand this far inside, in the length unit: just there the slopes about the end begin.
/// More than what [`place`] takes for a vertex.
const INSIDE: f64 = 2e-6;

/// Sections with what they show and count, in windows that are `width` px wide; and the scale, in px per unit, one for all.
pub(super) fn views(scene: &Scene<'_>, course: &Course, axis: usize, stations: &[f64], width: f64) -> (f64, Vec<(f64, View)>) {
    let length = course.axis.length;
    let on_axis: Vec<f64> = stations.iter().copied().filter(|s| (0.0..=length).contains(s)).collect();
    let inside =
        |s: &f64| if course.axis.closed { *s } else { s.clamp(INSIDE.min(0.5 * length), (length - INSIDE).max(0.5 * length)) };
    let planes: Vec<f64> = on_axis.iter().map(inside).collect();
    let cutter = Cutter::new(scene);
    // The platform inside a ring belongs to no axis, and is shown whole.
    let figures = scene.ground.as_ref().filter(|_| !course.axis.closed);
    let figures = figures.map(|g| sections_at(g.pieces.iter(), g.stations, axis, &planes)).unwrap_or_default();
    let view = |(i, station): (usize, &f64)| {
        let (at, along) = place(&course.axis, planes[i])?;
        Some((*station, (at, along), cutter.design(at, along, figures.get(i))?))
    };
    let mut found: Vec<_> = on_axis.iter().enumerate().filter_map(view).collect();
    let mut scale = f64::INFINITY;
    for (_, _, View { design, shown: (from, to), .. }) in &found {
        let (low, high) = range(design.points.iter().filter(|p| (*from..=*to).contains(&p.x)).map(|p| p.y));
        scale = scale.min(width / (to - from)).min((HEIGHT.1 - ABOVE - UNDER) / (1.3 * (high - low)).max(1e-9));
    }
    for (_, (at, along), view) in &mut found {
        let middle = 0.5 * (view.shown.0 + view.shown.1);
        let half = 0.5 * width / scale;
        view.window = (middle - half, middle + half);
        cutter.add_ground(*at, *along, view);
    }
    (scale, found.into_iter().map(|(station, _, view)| (station, view)).collect())
}

fn all(scene: &Scene<'_>, axis: usize, stations: &[f64], style: &Style) -> Vec<(f64, Drawn)> {
    let Some(course) = courses(scene).into_iter().nth(axis) else { return Vec::new() };
    let mut shown: Vec<f64> = stations.iter().copied().filter(|s| (0.0..=course.axis.length).contains(s)).collect();
    let left_out = shown.len().saturating_sub(MOST_SECTIONS);
    shown.truncate(MOST_SECTIONS);
    let (scale, views) = views(scene, &course, axis, &shown, style.width() - LEFT - RIGHT);
    let last = views.len();
    let draw = |(i, (station, view)): (usize, (f64, View))| {
        let note = (left_out > 0 && i + 1 == last).then(|| format!("{left_out} more stations are not drawn"));
        (station, section(scene, &course, station, &view, scale, note.as_deref(), style))
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

/// A slope that a section shows flatter than this is cut nearly along its contours: how it looks there says nothing.
const LEAST_SEEN: f64 = 0.01;

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
    let short = digits::fixed(run, 2);
    if run >= 0.995 { format!("1:{short}") } else { format!("1V:{short}H") }
}

fn section(
    scene: &Scene<'_>,
    course: &Course,
    station: f64,
    view: &View,
    scale: f64,
    note: Option<&str>,
    style: &Style,
) -> Drawn {
    let unit = scene.unit;
    let (from, to) = view.shown;
    let shown = |p: &&DVec2| (from..=to).contains(&p.x);
    let (low, high) = range(view.design.points.iter().chain(view.ground.iter().flatten()).filter(shown).map(|p| p.y));
    let size =
        DVec2::new(style.width() - LEFT - RIGHT, ((high - low) * scale + ABOVE + UNDER).clamp(HEIGHT.0, 1.5 * HEIGHT.1).round());
    let bottom = 0.5 * (low + high) - 0.5 * (size.y + UNDER - ABOVE) / scale;
    let chart = Chart {
        at: DVec2::new(LEFT, HEAD),
        size,
        low: DVec2::new(view.window.0, bottom),
        high: DVec2::new(view.window.1, bottom + size.y / scale),
    };

    let mut between = Between::default();
    view.ground.iter().for_each(|ground| between.add(&view.design.points, ground, view.counted.0, view.counted.1));
    let name = format!("Station {}", figure(station, 2));
    let title = format!("{name} of {}", course.axis.name);
    let areas = [("cut", between.cut_area), ("fill", between.fill_area)]
        .map(|(what, area)| format!("{what} {} {unit}²", figure(area, 2)));
    let words = if view.ground.is_empty() { "no ground".to_owned() } else { areas.join(", ") };
    let mut svg = Svg::new(style, DVec2::new(style.width(), HEAD + size.y + 40.0), &title, &format!("Cross-section: {words}."));
    svg.text("b", DVec2::new(LEFT, 22.0), 0.0, &fitted(&name, 12.0, 150.0));
    let mut x = LEFT + 160.0;
    for (text, class) in areas.iter().zip(["s b cut", "s b fill"]).filter(|_| !view.ground.is_empty()) {
        svg.text(class, DVec2::new(x, 22.0), 0.0, text);
        x += width(text, SMALL) + 18.0;
    }
    let more = note.map_or_else(String::new, |note| format!(" · {note}"));
    svg.text(
        "s soft e",
        DVec2::new(chart.right(), 22.0),
        0.0,
        &fitted(&format!("{}{more}", course.axis.name), SMALL, chart.right() - x),
    );

    svg.window(chart.at, size);
    let inner = Chart { at: DVec2::ZERO, ..chart };
    let step = round_step(34.0 / scale);
    let across = round_step(56.0 / scale);
    let offsets = multiples(chart.low.x, chart.high.x, across);
    inner.columns(&mut svg, &offsets, size.y);
    inner.grid_rows(&mut svg, step);
    inner.lines(&mut svg, "c3", &between.cut, true);
    inner.lines(&mut svg, "f3", &between.fill, true);
    inner.lines(&mut svg, "ln ground", &view.ground, false);
    let axis = |y: f64| DVec2::new(0.0, y);
    inner.lines(&mut svg, "ln axis", &[vec![axis(chart.low.y), axis(chart.high.y)]], false);
    inner.lines(&mut svg, "ln design", std::slice::from_ref(&view.design.points), false);
    annotate(&mut svg, &inner, scene.design, view);
    svg.end_window();
    svg.rect("frame", chart.at, chart.size);
    chart.row_figures(&mut svg, step);
    let digits = super::scale::decimals(across);
    chart.below(&mut svg, "s m soft", chart.bottom() + 15.0, offsets.into_iter().map(|x| (x, signed(x, digits))));
    let words = format!("offset from the axis in {unit}, right +; heights in the same scale");
    svg.text("s soft", DVec2::new(LEFT, chart.bottom() + 31.0), 0.0, &fitted(&words, 10.0, size.x));
    svg.finish()
}

/// Places on the design that get figures: where a part begins or ends, with the side on which there is room.
fn marked(all: &[Stretch]) -> Vec<(DVec2, f64)> {
    // A hinge has room below it in cut, above it in fill; where slopes end it is the other way round.
    let lift = |slope: Part, hinge: bool| if (slope == Part::CutSlope) == hinge { -1.0 } else { 1.0 };
    let mut found = Vec::new();
    for (i, stretch) in all.iter().enumerate() {
        match i.checked_sub(1).map(|i| all[i].part) {
            None => found.push((stretch.from, lift(stretch.part, false))),
            Some(before) if before != stretch.part => {
                let slope = if before == Part::Platform { stretch.part } else { before };
                found.push((stretch.from, lift(slope, true)));
            }
            Some(_) => {}
        }
    }
    found.extend(all.last().map(|last| (last.to, lift(last.part, false))));
    found
}

/// Slopes along the design, and figures where its parts begin and end.
fn annotate(svg: &mut Svg, chart: &Chart, tin: &Tin, view: &View) {
    let mut labels = Labels::default();
    let all = stretches(tin, &view.design);
    let (from, to) = view.shown;
    for (p, side) in marked(&all).into_iter().filter(|(p, _)| (from..=to).contains(&p.x)) {
        let at = chart.px(p);
        let texts = [signed(p.x, 2), figure(p.y, 2)];
        let wide = texts.iter().map(|text| width(text, SMALL)).fold(0.0, f64::max);
        svg.circle("dot", at, 2.6);
        for lift in [26.0, -26.0, 54.0, -54.0].map(|lift| lift * side) {
            let x = at.x.clamp(0.5 * wide + 3.0, (chart.size.x - 0.5 * wide - 3.0).max(0.0));
            let centre = DVec2::new(x, at.y - lift);
            let half = DVec2::new(0.5 * wide + 2.0, 13.5);
            let inside = centre.y > 14.0 && centre.y < chart.size.y - 14.0;
            if inside && labels.take_box(centre - half, centre + half) {
                let mut path = Path::default();
                let toward = lift.signum();
                path.add(&[at - DVec2::new(0.0, toward * 4.0), DVec2::new(at.x, centre.y + toward * 13.0)], false);
                svg.path("tick", &path);
                svg.text("s m halo", centre - DVec2::new(0.0, 2.5), 0.0, &texts[0]);
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
            _ if seen < LEAST_SEEN || ratio(seen) == ratio(stretch.slope) => ratio(stretch.slope),
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
