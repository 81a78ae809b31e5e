//! The long profile: line and ground along an axis, cut and fill between them, gradients, and the figures below.

use super::between::{Between, height};
use super::chart::Chart;
use super::course::{Course, courses};
use super::labels::width;
use super::legend::{Block, Legend, Sample};
use super::scale::{figure, round_step, signed};
use super::stations::{columns, station_text};
use super::style::{MARGIN, SMALL};
use super::svg::{Drawn, Path, Svg};
use super::{Scene, Style};
use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;
use crate::mesh::drape::Drape;
use crate::write::GENERATOR;
use glam::DVec2;

/// Room on the left for elevations and the names of the rows.
const LEFT: f64 = 116.0;
const RIGHT: f64 = 26.0;
const HEAD: f64 = 60.0;

/// Height of the field: about, and at most.
const HEIGHT: (f64, f64) = (250.0, 420.0);

/// Height of a row of figures.
const ROW: f64 = 19.0;

/// A stretch shorter than this has no room for its gradient, in px.
const SHORTEST: f64 = 32.0;

/// Gradients that differ by less are one, as a share of 1.
const SAME_GRADIENT: f64 = 2e-5;

/// Most gradients told apart in one drawing.
const MOST_GRADIENTS: usize = 1000;

/// Edges of a road this near the height of its centre line are not drawn, in the length unit: nobody builds to less.
const SAME_HEIGHT: f64 = 1e-3;

/// Pieces of ground this near each other along the axis, in the length unit, are one: gaps of rounding.
const GAP: f64 = 1e-6;

/// The long profile along an axis, an index into the lines given: the line, the ground below it, cut and fill between.
/// `None` for an axis there is not, and for one without length.
pub fn profile(scene: &Scene<'_>, axis: usize, style: &Style) -> Option<String> {
    drawn(scene, axis, style).map(|drawn| drawn.text)
}

/// The ground along an axis: station and elevation, one line for each stretch without a gap.
pub(super) fn ground_along(scene: &Scene<'_>, course: &Course) -> Vec<Vec<DVec2>> {
    let Some(ground) = &scene.ground else { return Vec::new() };
    let line = &course.axis.line;
    let along = PlanBox::of(line.iter().map(|p| p.0));
    let drape = Drape::new(&ground.terrain.vertices, &ground.terrain.triangles, Some(along));
    let mut found: Vec<Vec<DVec2>> = Vec::new();
    for pair in line.windows(2) {
        let ((a, from), (b, to)) = (pair[0], pair[1]);
        let length = a.distance(b);
        for run in drape.along(a, b) {
            let points = run.points.iter().map(|p| DVec2::new(from + (to - from) * (p.x / length), p.y));
            match found.last_mut() {
                Some(last)
                    if last.last().zip(run.points.first()).is_some_and(|(end, begin)| begin.x <= GAP && from - end.x <= GAP) =>
                {
                    last.extend(points.skip(1));
                }
                _ => found.push(points.collect()),
            }
        }
    }
    found
}

/// Whether the edges of a road lie elsewhere in the profile than its centre line.
fn edges_apart(course: &Course) -> bool {
    let apart = |p: &DVec2| height(&course.heights, p.x).is_some_and(|z| (z - p.y).abs() > SAME_HEIGHT);
    course.edges.iter().flatten().any(apart)
}

/// Ends of the stretches of one gradient.
fn gradients(heights: &[DVec2]) -> Vec<DVec2> {
    let mut kept: Vec<DVec2> = Vec::new();
    for p in heights.iter().copied() {
        if let [.., a, b] = kept[..] {
            let grade = |a: DVec2, b: DVec2| (b.y - a.y) / (b.x - a.x);
            if (grade(a, b) - grade(b, p)).abs() < SAME_GRADIENT || p.x <= b.x {
                kept.pop();
            }
        }
        kept.push(p);
    }
    kept
}

/// The least of 1, 2, 5 × 10ⁿ by which heights are drawn larger than lengths, so that they fill the field.
fn exaggeration(range: f64, scale: f64) -> f64 {
    let wanted = HEIGHT.0 / (range * scale);
    // Rounded down: a step up from half of it is never more than it.
    let up = round_step(wanted);
    if up > wanted * 1.3 { round_step(0.45 * wanted) } else { up }
}

pub(super) fn drawn(scene: &Scene<'_>, axis: usize, style: &Style) -> Option<Drawn> {
    let course = courses(scene).into_iter().nth(axis)?;
    let length = course.axis.length;
    let (first, _) = course.heights.first().zip(course.heights.last())?;
    if !(length > 0.0 && length.is_finite() && first.y.is_finite()) {
        return None;
    }
    let ground = ground_along(scene, &course);
    let all = course.heights.iter().chain(ground.iter().flatten()).chain(course.edges.iter().flatten()).map(|p| p.y);
    let (low, high) = range(all);

    let size_x = style.width() - LEFT - RIGHT;
    let scale = size_x / length;
    let relief = (high - low).max(0.02 * length).max(1e-3);
    let factor = exaggeration(relief, scale);
    let field = (relief * scale * factor + 2.0 * 18.0).min(HEIGHT.1).round();
    let middle = 0.5 * (low + high);
    let half = 0.5 * field / (scale * factor);
    let chart = Chart {
        at: DVec2::new(LEFT, HEAD),
        size: DVec2::new(size_x, field),
        low: DVec2::new(0.0, middle - half),
        high: DVec2::new(length, middle + half),
    };

    let on_ground = !ground.is_empty();
    let mut between = Between::default();
    ground.iter().for_each(|run| between.add(&course.heights, run, 0.0, length));
    let has_edges = edges_apart(&course);
    let last_row = row(&chart, row_count(on_ground));
    let below = last_row + 14.0;
    let legend = Legend::new(symbols(on_ground, has_edges), size_x);
    let total = below + legend.height() + 10.0;
    let title = format!("Long profile: {}", course.axis.name);
    let desc = format!(
        "Stations 0 to {} {unit}, elevations {} to {} {unit}.",
        figure(length, 2),
        figure(low, 2),
        figure(high, 2),
        unit = scene.unit
    );
    let mut svg = Svg::new(style, DVec2::new(style.width(), total.ceil()), &title, &desc);
    let words = if factor >= 1.0 {
        format!("heights {factor} times as large as lengths")
    } else {
        format!("heights {} times as small as lengths", figure(1.0 / factor, 1))
    };
    let text = format!("{words} · stations and elevations in {} · {GENERATOR}", scene.unit.plural());
    svg.heading(&title, &text, MARGIN, style.width() - 2.0 * MARGIN);

    let columns = columns(scene, length, scale);
    chart.columns(&mut svg, &columns, last_row);
    chart.rows(&mut svg, round_step(26.0 / (scale * factor)));
    chart.lines(&mut svg, "c3", &between.cut, true);
    chart.lines(&mut svg, "f3", &between.fill, true);
    chart.lines(&mut svg, "ln ground", &ground, false);
    for (edge, class) in course.edges.iter().zip(["ln edge", "ln edge right"]).filter(|_| has_edges) {
        chart.lines(&mut svg, class, std::slice::from_ref(edge), false);
    }
    chart.lines(&mut svg, "ln design", std::slice::from_ref(&course.heights), false);
    svg.rect("frame", chart.at, chart.size);

    figures(&mut svg, &chart, &course, &ground, &columns, scene.unit.label());
    legend.draw(&mut svg, DVec2::new(LEFT, below));
    Some(svg.finish())
}

/// What the legend explains.
fn symbols(on_ground: bool, has_edges: bool) -> Vec<Block> {
    let mut blocks = vec![Block::symbol(Sample::Line("ln design"), "line")];
    if has_edges {
        blocks.push(Block::symbol(Sample::Line("ln edge"), "left edge"));
        blocks.push(Block::symbol(Sample::Line("ln edge right"), "right edge"));
    }
    if on_ground {
        blocks.push(Block::symbol(Sample::Line("ln ground"), "ground"));
        blocks.push(Block::symbol(Sample::Patch("c3"), "cut"));
        blocks.push(Block::symbol(Sample::Patch("f3"), "fill"));
    }
    blocks
}

/// How many rows of figures there are below the field.
fn row_count(on_ground: bool) -> f64 {
    if on_ground { 5.0 } else { 3.0 }
}

/// Upper edge of a row of figures.
fn row(chart: &Chart, i: f64) -> f64 {
    chart.bottom() + i * ROW
}

/// The rows of figures: gradients, elevations of line and ground, depths, stations.
fn figures(svg: &mut Svg, chart: &Chart, course: &Course, ground: &[Vec<DVec2>], columns: &[f64], unit: &str) {
    let on_ground = !ground.is_empty();
    let rows = row_count(on_ground);
    let row = |i: f64| row(chart, i);
    let length = course.axis.length;
    let scale = chart.size.x / length;
    let mut rules = Path::default();
    for i in 1..=rows as u32 {
        rules.add(&[DVec2::new(12.0, row(f64::from(i))), DVec2::new(chart.right(), row(f64::from(i)))], false);
    }
    svg.path("grid", &rules);
    let mut name = |i: f64, text: &str| svg.text("s soft", DVec2::new(12.0, row(i) + 13.0), 0.0, text);
    let stretches = gradients(&course.heights);
    // Where most stretches are too short for a figure, the mean gradients between stations say more.
    let short = stretches.windows(2).map(|p| p[1].x - p[0].x).filter(|long| long * scale < SHORTEST).sum::<f64>();
    let means = columns.iter().filter_map(|x| Some(DVec2::new(*x, height(&course.heights, *x)?)));
    let (row_name, stretches) =
        if short > 0.5 * length { ("mean gradient in %", means.collect()) } else { ("gradient in %", stretches) };
    name(0.0, row_name);
    name(1.0, "line");
    if on_ground {
        name(2.0, "ground");
        name(3.0, "fill +, cut −");
    }
    name(rows - 1.0, "station");
    let design = |x: f64| height(&course.heights, x);
    let terrain = |x: f64| ground.iter().find_map(|run| height(run, x));
    draw_gradients(svg, chart, &stretches, row(0.0), unit);
    let baseline = |i: f64| row(i) + 13.0;
    let of = |value: &dyn Fn(f64) -> Option<String>| -> Vec<(f64, String)> {
        columns.iter().filter_map(|x| Some((*x, value(*x)?))).collect()
    };
    chart.below(svg, "s m", baseline(1.0), of(&|x| Some(figure(design(x)?, 2))));
    if on_ground {
        chart.below(svg, "s m", baseline(2.0), of(&|x| Some(figure(terrain(x)?, 2))));
        for (class, sign) in [("s m cut", -1.0), ("s m fill", 1.0)] {
            let depth = |x: f64| Some(design(x)? - terrain(x)?).filter(|d| (*d < 0.0) == (sign < 0.0));
            chart.below(svg, class, baseline(3.0), of(&|x| Some(signed(depth(x)?, 2))));
        }
    }
    chart.below(svg, "s b m", baseline(rows - 1.0), of(&|x| Some(station_text(x, columns))));
}

/// Gradients and lengths of the stretches that have room for them.
fn draw_gradients(svg: &mut Svg, chart: &Chart, ends: &[DVec2], y: f64, unit: &str) {
    let mut ticks = Path::default();
    for pair in ends.windows(2).take(MOST_GRADIENTS) {
        let (a, b) = (pair[0], pair[1]);
        let (from, to) = (chart.px(a).x, chart.px(b).x);
        ticks.add(&[DVec2::new(to, y + 3.0), DVec2::new(to, y + ROW - 3.0)], false);
        if b.x <= a.x {
            continue;
        }
        let percent = 100.0 * (b.y - a.y) / (b.x - a.x);
        let grade = |digits: usize| signed(percent, digits);
        let long = format!("{} · {} {unit}", grade(2), figure(b.x - a.x, 1));
        for text in [long, grade(2), grade(1)] {
            if width(&text, SMALL) + 4.0 < to - from {
                svg.text("s m", DVec2::new(0.5 * (from + to), y + 13.0), 0.0, &text);
                break;
            }
        }
    }
    svg.path("tick", &ticks);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stretches_of_one_gradient_are_one() {
        let points = |p: &[(f64, f64)]| p.iter().copied().map(DVec2::from).collect::<Vec<_>>();
        let heights = points(&[(0.0, 0.0), (10.0, 1.0), (30.0, 3.0), (40.0, 3.0), (50.0, 2.0)]);
        assert_eq!(gradients(&heights), points(&[(0.0, 0.0), (30.0, 3.0), (40.0, 3.0), (50.0, 2.0)]));
    }

    #[test]
    fn heights_fill_the_field_and_no_more() {
        for (range, scale) in [(1.0, 4.0), (10.0, 4.0), (60.0, 4.0), (500.0, 4.0), (0.001, 900.0)] {
            let high = range * scale * exaggeration(range, scale);
            assert!(high <= 1.3 * HEIGHT.0 + 1e-9 && high > 0.3 * HEIGHT.0, "{range}: {high}");
        }
    }
}
