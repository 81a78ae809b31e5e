//! The mass-haul diagram: the running net of cut and fill along an axis, and what each interval gives and takes.

use super::chart::Chart;
use super::course::courses;
use super::labels::{Labels, fitted, width};
use super::legend::{Block, Legend, Sample};
use super::scale::{figure, round_step, signed};
use super::stations::{columns, station_text};
use super::style::{MARGIN, SMALL};
use super::svg::{Drawn, Svg};
use super::{Scene, Style};
use crate::ground;
use glam::DVec2;

/// Room on the left for volumes.
const LEFT: f64 = 84.0;
const RIGHT: f64 = 26.0;
const HEAD: f64 = 72.0;

/// Height of the curve, and of the bars below.
const CURVE: f64 = 250.0;
const BARS: f64 = 130.0;

/// Most balance points that are marked.
const MOST_BALANCED: usize = 40;

/// The mass-haul diagram of an axis, an index into the lines given: running net at the ends of the intervals, cut and fill of
/// each. `None` without ground, for an axis there is not, and for one without length.
pub fn mass_haul(scene: &Scene<'_>, axis: usize, style: &Style) -> Option<String> {
    drawn(scene, axis, style).map(|drawn| drawn.text)
}

/// Station and running net at the beginning and at every break; compacted where that is known.
pub(super) fn curves(scene: &Scene<'_>, axis: usize) -> Option<(Vec<DVec2>, Option<Vec<DVec2>>)> {
    let intervals = scene.ground.as_ref()?.tallied.axes.get(axis)?;
    let haul = ground::mass_haul(intervals, scene.bulking);
    let begin = intervals.first().map(|interval| DVec2::new(interval.from, 0.0))?;
    let net = intervals.iter().zip(&haul).map(|(interval, haul)| DVec2::new(interval.to, haul.net));
    let compacted = intervals.iter().zip(&haul).map(|(interval, haul)| Some(DVec2::new(interval.to, haul.compacted?)));
    let with_begin = |rest: Vec<DVec2>| std::iter::once(begin).chain(rest).collect::<Vec<_>>();
    Some((with_begin(net.collect()), compacted.collect::<Option<Vec<_>>>().map(with_begin)))
}

/// What a curve ends with, with one decimal, and in a word what that means; nothing for what rounds to nought.
fn rest(end: f64) -> Option<(String, &'static str)> {
    let amount = figure(end.abs(), 1);
    let word = if end > 0.0 { "left over" } else { "lacking" };
    amount.contains(|c| ('1'..='9').contains(&c)).then_some((amount, word))
}

/// Where a curve comes back to nought between its ends.
fn balanced(curve: &[DVec2]) -> Vec<f64> {
    let mut found = Vec::new();
    for pair in curve.windows(2) {
        let (a, b) = (pair[0], pair[1]);
        if a.y * b.y < 0.0 {
            found.push(a.x + (b.x - a.x) * (a.y / (a.y - b.y)));
        } else if b.y == 0.0 && a.y != 0.0 {
            found.push(b.x);
        }
    }
    found
}

pub(super) fn drawn(scene: &Scene<'_>, axis: usize, style: &Style) -> Option<Drawn> {
    let course = courses(scene).into_iter().nth(axis)?;
    let on_ground = scene.ground.as_ref()?;
    let intervals = on_ground.tallied.axes.get(axis)?;
    let (net, compacted) = curves(scene, axis)?;
    let length = course.axis.length;
    if !(length > 0.0 && length.is_finite()) {
        return None;
    }
    let main = compacted.as_ref().unwrap_or(&net);
    let unit = scene.unit;
    let size_x = style.width() - LEFT - RIGHT;
    let all = net.iter().chain(compacted.iter().flatten()).map(|p| p.y);
    let (low, high) = all.fold((0.0_f64, 0.0_f64), |(low, high), y| (low.min(y), high.max(y)));
    let range = (high - low).max(f64::MIN_POSITIVE);
    let curve = Chart {
        at: DVec2::new(LEFT, HEAD),
        size: DVec2::new(size_x, CURVE),
        low: DVec2::new(0.0, low - 0.12 * range),
        high: DVec2::new(length, high + 0.12 * range),
    };
    let most = |of: fn(&ground::Amounts) -> f64| intervals.iter().map(|i| of(&i.amounts)).fold(0.0, f64::max);
    let (cut, fill) = (most(|a| a.cut), most(|a| a.fill));
    let tall = (cut + fill).max(f64::MIN_POSITIVE);
    let bars = Chart {
        at: DVec2::new(LEFT, HEAD + CURVE + 44.0),
        size: DVec2::new(size_x, BARS),
        low: DVec2::new(0.0, -fill - 0.1 * tall),
        high: DVec2::new(length, cut + 0.1 * tall),
    };

    let mut blocks = Vec::new();
    if compacted.is_some() {
        blocks.push(Block::symbol(Sample::Line("ln design"), "running net, cut as compacted"));
        blocks.push(Block::symbol(Sample::Line("ln ground"), "running net, as measured"));
    } else {
        blocks.push(Block::symbol(Sample::Line("ln design"), "running net (cut − fill)"));
    }
    if !balanced(main).is_empty() {
        blocks.push(Block::symbol(Sample::Dot, "balance point: cut so far = fill so far"));
    }
    blocks.push(Block::symbol(Sample::Patch("c3"), "cut of an interval"));
    blocks.push(Block::symbol(Sample::Patch("f3"), "fill of an interval"));
    let legend = Legend::new(blocks, size_x);
    let below = bars.bottom() + 34.0;
    let height = below + legend.height() + 10.0;

    let end = main.last().map_or(0.0, |p| p.y);
    let balance = match rest(end) {
        Some((amount, word)) => format!("ends with {amount} {unit}³ {word}"),
        None => "ends balanced".to_owned(),
    };
    let title = format!("Mass haul: {}", course.axis.name);
    let mut svg =
        Svg::new(style, DVec2::new(style.width(), height.ceil()), &title, &format!("Running net of cut and fill; {balance}."));
    let pads = &on_ground.tallied.pads;
    let beside = if pads.cut + pads.fill > 0.0 {
        let [cut, fill] = [pads.cut, pads.fill].map(|volume| figure(volume, 1));
        format!(" · slopes only; platforms inside rings take part in none of it: cut {cut} {unit}³, fill {fill} {unit}³")
    } else {
        String::new()
    };
    let text = format!("volumes in {unit}³ · {balance}{beside}");
    svg.heading(&title, &text, MARGIN, style.width() - 2.0 * MARGIN);

    let stations = columns(scene, length, size_x / length);
    curve.columns(&mut svg, &stations, bars.bottom());
    curve.rows(&mut svg, round_step((curve.high.y - curve.low.y) / 8.0));
    bars.rows(&mut svg, round_step((bars.high.y - bars.low.y) / 4.0));

    let bar = |i: &ground::Interval, y: f64| [(i.from, 0.0), (i.to, 0.0), (i.to, y), (i.from, y)].map(DVec2::from).to_vec();
    let cuts: Vec<Vec<DVec2>> = intervals.iter().filter(|i| i.amounts.cut > 0.0).map(|i| bar(i, i.amounts.cut)).collect();
    let fills: Vec<Vec<DVec2>> = intervals.iter().filter(|i| i.amounts.fill > 0.0).map(|i| bar(i, -i.amounts.fill)).collect();
    bars.lines(&mut svg, "c3 gap", &cuts, true);
    bars.lines(&mut svg, "f3 gap", &fills, true);
    for chart in [&curve, &bars] {
        chart.lines(&mut svg, "ln thin", &[vec![DVec2::ZERO, DVec2::new(length, 0.0)]], false);
        svg.rect("frame", chart.at, chart.size);
    }
    if compacted.is_some() {
        curve.lines(&mut svg, "ln ground", std::slice::from_ref(&net), false);
    }
    curve.lines(&mut svg, "ln design", std::slice::from_ref(main), false);
    mark(&mut svg, &curve, main, unit.label());

    let figures = || stations.iter().map(|x| (*x, station_text(*x, &stations)));
    curve.below(&mut svg, "s m", curve.bottom() + 16.0, figures());
    bars.below(&mut svg, "s m", bars.bottom() + 16.0, figures());
    svg.text("s b", curve.at - DVec2::new(0.0, 7.0), 0.0, &fitted("running net: rising is cut, falling is fill", SMALL, size_x));
    svg.text("s b", bars.at - DVec2::new(0.0, 7.0), 0.0, "cut and fill of each interval");
    svg.text("s soft", DVec2::new(12.0, bars.bottom() + 16.0), 0.0, "station");
    legend.draw(&mut svg, DVec2::new(LEFT, below));
    Some(svg.finish())
}

/// Marks balance points, the greatest surplus, the greatest deficit and the end.
fn mark(svg: &mut Svg, chart: &Chart, curve: &[DVec2], unit: &str) {
    let mut labels = Labels::default();
    let balanced: Vec<f64> = balanced(curve).into_iter().take(MOST_BALANCED).collect();
    let by = |greater: fn(f64, f64) -> bool| {
        curve.iter().copied().fold(DVec2::ZERO, |best, p| if greater(p.y, best.y) { p } else { best })
    };
    let (top, bottom) = (by(|a, b| a > b), by(|a, b| a < b));
    let end = curve.last().copied().unwrap_or_default();
    for p in [top, bottom, end] {
        let text = format!("{} {unit}³ at {}", signed(p.y, 1), figure(p.x, 1));
        let half = 0.5 * width(&text, SMALL);
        let at = chart.px(p);
        let x = at.x.clamp(chart.at.x + half + 4.0, chart.right() - half - 4.0);
        // Beyond the curve: above where it is high, below where it is low.
        let centre = DVec2::new(x, at.y + if p.y < 0.0 { 14.0 } else { -12.0 });
        if p.y != 0.0 && labels.take(centre, 0.0, &text, SMALL) {
            svg.circle("solid", at, 3.0);
            svg.text("s b m halo", centre + DVec2::new(0.0, 4.0), 0.0, &text);
        }
    }
    for station in balanced {
        let at = chart.px(DVec2::new(station, 0.0));
        svg.circle("dot", at, 4.0);
        let text = figure(station, 1);
        for side in [-13.0, 13.0] {
            let centre = at + DVec2::new(0.5 * width(&text, SMALL) + 6.0, side);
            if labels.take(centre, 0.0, &text, SMALL) {
                svg.text("s m halo", centre + DVec2::new(0.0, 4.0), 0.0, &text);
                break;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Straight between (0, 0), (10, 20), (30, −20), (40, 0): nought at 20 and at the end.
    #[test]
    fn balance_points() {
        let curve = [(0.0, 0.0), (10.0, 20.0), (30.0, -20.0), (40.0, 0.0), (50.0, 0.0)].map(DVec2::from);
        assert_eq!(balanced(&curve), [20.0, 40.0]);
    }
}
