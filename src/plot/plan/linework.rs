//! Lines on the map: line work of the design, axes and their stations.

use super::is_index;
use super::map::Map;
use crate::ground::place;
use crate::kernel::sum::Sum;
use crate::mesh::drape::Drape;
use crate::model::{Chain, CurveKind, LineFeature, Part};
use crate::plot::Scene;
use crate::plot::course::Course;
use crate::plot::labels::{Labels, width};
use crate::plot::legend::{Block, Sample};
use crate::plot::lines::{Stroke, simplified};
use crate::plot::scale::{decimals, figure, is_multiple, round_step};
use crate::plot::style::SMALL;
use crate::plot::svg::{Path, Svg};
use glam::DVec2;

/// Points of all line work, at most.
const LINE_POINTS: usize = 18_000;

/// Kinds as drawn, the lowest first, with class and words.
const KINDS: [(CurveKind, &str, &str); 8] = [
    (CurveKind::LevelCurve, "ln level", "level curve of the design"),
    (CurveKind::Ridge, "ln crease", "ridge or valley"),
    (CurveKind::Valley, "ln crease", "ridge or valley"),
    (CurveKind::Breakline, "ln breakline", "breakline"),
    (CurveKind::Zero, "ln zero", "zero line: cut turns to fill"),
    (CurveKind::Boundary, "ln open", "end without ground"),
    (CurveKind::Daylight, "ln daylight", "daylight line"),
    (CurveKind::Hinge, "ln hinge", "given line (hinge)"),
];

/// The line work of a scene on its map.
#[derive(Debug)]
pub(super) struct LineWork<'a> {
    features: Vec<(&'a LineFeature, Stroke)>,
    /// The given line, whole.
    hinges: Vec<Stroke>,
    /// Interval of the level curves that are drawn; `None` where they stand at chosen heights.
    interval: Option<f64>,
    on_ground: bool,
}

/// Level curves are at least about this far apart, in px, or only every second, fifth, … is drawn.
const CURVES_APART: f64 = 5.0;

impl<'a> LineWork<'a> {
    /// Puts the line work on the map.
    pub(super) fn new(scene: &Scene<'a>, map: &Map) -> Self {
        let centres: Vec<&str> = scene.line.chains.iter().filter_map(|c| c.axis.as_ref()).map(|a| a.name.as_str()).collect();
        // Centre lines of roads are drawn as axes.
        let is_axis =
            |f: &LineFeature| f.kind == CurveKind::Breakline && f.chain.as_deref().is_some_and(|name| centres.contains(&name));
        let interval = interval(scene.lines).map(|interval| shown(interval, steepness(scene), map.scale));
        let is_shown = |f: &LineFeature| f.elevation.zip(interval).is_none_or(|(z, interval)| is_multiple(z, interval));
        let features: Vec<&LineFeature> = scene
            .lines
            .iter()
            .filter(|f| f.points.len() > 1 && f.kind != CurveKind::Hinge && !is_axis(f) && is_shown(f))
            .collect();
        let strokes: Vec<Stroke> = features
            .iter()
            .map(|f| {
                let closed = f.points.len() > 3 && f.points.first() == f.points.last();
                let points = &f.points[..f.points.len() - usize::from(closed)];
                Stroke { points: points.iter().map(|p| map.of_world(*p)).collect(), closed }
            })
            .collect();
        let kept = simplified(&strokes, LINE_POINTS);
        let given =
            |chain: &Chain| Stroke { points: chain.vertices.iter().map(|p| map.of_world(*p)).collect(), closed: chain.closed() };
        let given: Vec<Stroke> = scene.line.chains.iter().map(given).collect();
        let hinges = simplified(&given, LINE_POINTS / 4).into_iter().flatten().collect();
        let drawn = features.into_iter().zip(kept).filter_map(|(f, stroke)| Some((f, stroke?))).collect();
        Self { features: drawn, hinges, interval, on_ground: scene.ground.is_some() }
    }

    /// Interval of the level curves.
    pub(super) fn interval(&self) -> Option<f64> {
        self.interval
    }

    /// Without ground there is nothing odd about an end.
    fn class(&self, kind: CurveKind, class: &'static str) -> &'static str {
        if kind == CurveKind::Boundary && !self.on_ground { "ln daylight" } else { class }
    }

    fn heavy(&self, feature: &LineFeature) -> bool {
        feature.elevation.zip(self.interval).is_some_and(|(z, interval)| is_index(z, interval))
    }

    /// Symbols of the kinds there are.
    pub(super) fn blocks(&self, scene: &Scene<'_>, courses: &[Course]) -> Vec<Block> {
        let mut blocks = Vec::new();
        let mut last = "";
        for (kind, class, name) in KINDS.iter().rev() {
            let is_there = match kind {
                CurveKind::Hinge => !self.hinges.is_empty(),
                kind => self.features.iter().any(|(f, _)| f.kind == *kind),
            };
            if *name == last || !is_there {
                continue;
            }
            last = name;
            let text = match (kind, self.interval) {
                (CurveKind::LevelCurve, Some(interval)) => format!("{name}, every {interval} {}", scene.unit),
                (CurveKind::Boundary, _) if !self.on_ground => "end of the slopes".to_owned(),
                _ => (*name).to_owned(),
            };
            blocks.push(Block::symbol(Sample::Line(self.class(*kind, class)), &text));
            if *kind == CurveKind::Hinge && courses.iter().any(|course| course.road) {
                blocks.push(Block::symbol(Sample::Line("ln axis"), "axis"));
            }
        }
        if scene.ground.as_ref().is_some_and(|g| g.tallied.deepest_cut.is_some() || g.tallied.deepest_fill.is_some()) {
            blocks.push(Block::symbol(Sample::Cross, "greatest depth"));
        }
        blocks
    }

    /// Draws the lines, each kind as one path.
    pub(super) fn draw(&self, svg: &mut Svg) {
        for (kind, class, _) in KINDS {
            let class = self.class(kind, class);
            let of_kind = || self.features.iter().filter(|(f, _)| f.kind == kind);
            let path = |heavy: bool| {
                let mut path = Path::default();
                of_kind().filter(|(f, _)| self.heavy(f) == heavy).for_each(|(_, s)| path.add(&s.points, s.closed));
                path
            };
            if kind == CurveKind::Hinge {
                let mut path = Path::default();
                self.hinges.iter().for_each(|s| path.add(&s.points, s.closed));
                svg.path(class, &path);
                continue;
            }
            svg.path(class, &path(false));
            svg.path(&format!("{class} i"), &path(true));
        }
    }

    /// Heights on level curves: of every fifth, or of all where there are few.
    pub(super) fn labels(&self, svg: &mut Svg, map: &Map, labels: &mut Labels) {
        // Chosen heights are all written.
        let digits = |z: f64| {
            self.interval.map_or_else(|| (0..3).find(|n| is_multiple(z, 0.1f64.powi(*n))).unwrap_or(3) as usize, decimals)
        };
        let curves = || self.features.iter().filter(|(f, _)| f.kind == CurveKind::LevelCurve);
        let any_heavy = curves().any(|(f, _)| self.heavy(f));
        for (feature, stroke) in curves() {
            let Some(z) = feature.elevation.filter(|_| self.heavy(feature) || !any_heavy) else { continue };
            label_along(svg, map, stroke, &figure(z, digits(z)), "s m halo", labels, |_| true);
        }
    }
}

/// The least distance between levels; `None` where not all are multiples of it.
fn interval(features: &[LineFeature]) -> Option<f64> {
    let mut levels: Vec<f64> = features.iter().filter_map(|f| f.elevation).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let least = levels.windows(2).map(|pair| pair[1] - pair[0]).fold(f64::INFINITY, f64::min);
    // Levels are multiples of a decimal fraction: what rounding did to their difference is taken off.
    let short: f64 = format!("{least:.6}").parse().ok()?;
    let fits = short > 0.0 && short.is_finite() && levels.iter().all(|level| is_multiple(*level, short));
    fits.then_some(short)
}

/// Steepest gradient of the slopes: the mean over their triangles, by plan area.
fn steepness(scene: &Scene<'_>) -> f64 {
    let design = scene.design;
    let (mut rise, mut area) = (Sum::default(), Sum::default());
    for t in (0..design.triangles.len()).filter(|t| matches!(design.parts[*t], Part::FillSlope | Part::CutSlope)) {
        let [a, b, c] = design.corners(t);
        let normal = (b - a).cross(c - a);
        rise.add(normal.truncate().length());
        area.add(normal.z.abs());
    }
    if area.value() > 0.0 { rise.value() / area.value() } else { 1.0 }
}

/// The interval at which curves on a slope are apart enough, a multiple of the given one.
fn shown(interval: f64, steepness: f64, scale: f64) -> f64 {
    let least = CURVES_APART * steepness / scale;
    if interval >= least { interval } else { interval * round_step(least / interval).ceil() }
}

/// Axes of roads.
pub(super) fn axes(svg: &mut Svg, map: &Map, courses: &[Course]) {
    let strokes: Vec<Stroke> = courses
        .iter()
        .filter(|course| course.road)
        .map(|course| Stroke { points: course.axis.line.iter().map(|p| map.at(p.0)).collect(), closed: false })
        .collect();
    let mut path = Path::default();
    simplified(&strokes, LINE_POINTS / 4).into_iter().flatten().for_each(|stroke| path.add(&stroke.points, stroke.closed));
    svg.path("ln axis", &path);
}

/// Half the length of the tick at a station, in px.
const TICK: f64 = 5.0;

/// Stations with a figure are at least this far apart, in px.
const APART: f64 = 46.0;

/// The figure of a station this near the end of an axis gives way to that of the end, in px.
const CROWDED: f64 = 18.0;

/// Most ticks of one drawing.
const MOST_TICKS: usize = 2000;

/// Stations along the axes, where intervals were asked for.
pub(super) fn stations(svg: &mut Svg, map: &Map, scene: &Scene<'_>, courses: &[Course], design: &Drape<'_>, labels: &mut Labels) {
    let Some(ground) = &scene.ground else { return };
    let Some(spacing) = ground.stations.spacing() else { return };
    // Where intervals are too short to be seen, multiples of them.
    let every = |apart: f64| spacing * round_step(apart / map.scale / spacing).max(1.0).ceil();
    let (ticks, figures) = (every(5.0), every(APART));
    let mut path = Path::default();
    let mut count = 0;
    for (i, course) in courses.iter().enumerate() {
        let axis = &course.axis;
        for &station in
            ground.stations.breaks(i).iter().filter(|station| is_multiple(**station, ticks) || **station == axis.length)
        {
            // A ring ends where it begins.
            if axis.closed && station == axis.length || count == MOST_TICKS {
                continue;
            }
            let Some((at, along)) = place(axis, station) else { continue };
            let at = map.at(at);
            // To the left of the axis, on paper, where `y` goes down.
            let left = DVec2::new(-along.y, -along.x);
            path.add(&[at - left * TICK, at + left * TICK], false);
            count += 1;
            let crowded = station < axis.length && (axis.length - station) * map.scale < CROWDED && !axis.closed;
            if !(is_multiple(station, figures) || station == axis.length) || crowded || !map.shows(at, 12.0) {
                continue;
            }
            let digits = if is_multiple(station, spacing) { decimals(spacing) } else { 2 };
            label_station(svg, map, design, (at, left), &figure(station, digits), labels);
        }
    }
    svg.path("ln thin", &path);
}

/// Labels of stations stand beside the works, this far from the axis at most, in px.
const FARTHEST: f64 = 150.0;

/// Writes a station at the first place beside the works, on the left if there is room, with a thin line to its tick.
fn label_station(svg: &mut Svg, map: &Map, design: &Drape<'_>, (at, left): (DVec2, DVec2), text: &str, labels: &mut Labels) {
    let turn = upright(left.to_angle().to_degrees());
    let half = 0.5 * width(text, SMALL);
    let beside = |p: DVec2| design.at(map.to_local(p)).is_none();
    for away in [left, -left] {
        let mut off = TICK + 5.0;
        while off < FARTHEST && !(beside(at + away * off) && beside(at + away * (off + 2.0 * half))) {
            off += 4.0;
        }
        let centre = at + away * (off + 4.0 + half);
        if off < FARTHEST && map.shows(centre, half) && labels.take(centre, turn, text, SMALL) {
            svg.line("lead", at + away * TICK, at + away * (off + 2.0));
            centred(svg, "s b m halo", centre, turn, text);
            return;
        }
    }
    for away in [left, -left] {
        let centre = at + away * (TICK + 4.0 + half);
        if labels.take(centre, turn, text, SMALL) {
            centred(svg, "s b m halo", centre, turn, text);
            return;
        }
    }
}

/// An angle in degrees at which text can be read without turning the head more than a quarter.
fn upright(turn: f64) -> f64 {
    let turn = turn.rem_euclid(180.0);
    if turn > 90.0 { turn - 180.0 } else { turn }
}

/// Text about a point.
fn centred(svg: &mut Svg, class: &str, centre: DVec2, turn: f64, text: &str) {
    let down = DVec2::from_angle(turn.to_radians()).perp();
    svg.text(class, centre + down * (0.36 * SMALL), turn, text);
}

/// Labels on one line are this far apart, in px.
const REPEAT: f64 = 320.0;

/// Writes a text on a line, where the line is straight enough and there is room: about its middle, and again on long lines.
pub(super) fn label_along(
    svg: &mut Svg,
    map: &Map,
    stroke: &Stroke,
    text: &str,
    class: &str,
    labels: &mut Labels,
    free: impl Fn(DVec2) -> bool,
) {
    let long = width(text, SMALL) + 6.0;
    let mut stations = vec![0.0];
    let closing = stroke.closed.then(|| stroke.points.first()).flatten();
    let points: Vec<DVec2> = stroke.points.iter().chain(closing).copied().collect();
    for pair in points.windows(2) {
        stations.push(stations[stations.len() - 1] + pair[0].distance(pair[1]));
    }
    let length = stations[stations.len() - 1];
    if length < 1.6 * long {
        return;
    }
    let at = |station: f64| {
        let i = stations.partition_point(|s| *s <= station).clamp(1, points.len() - 1);
        let (a, b) = (stations[i - 1], stations[i]);
        points[i - 1].lerp(points[i], if b > a { ((station - a) / (b - a)).clamp(0.0, 1.0) } else { 0.0 })
    };
    let wanted = (length / REPEAT).floor().clamp(1.0, 6.0) as u32;
    for i in 0..wanted {
        let about = length * (f64::from(i) + 0.5) / f64::from(wanted);
        let room = length / f64::from(wanted) - long;
        for share in [0.0, 0.12, -0.12, 0.25, -0.25, 0.4, -0.4] {
            let station = about + share * room;
            let (from, middle, to) = (at(station - 0.5 * long), at(station), at(station + 0.5 * long));
            // Straight: the chord is nearly as long as the line, and the middle lies on it.
            let straight = from.distance(to) > 0.93 * long && middle.distance(0.5 * (from + to)) < 2.5;
            if !straight || !map.shows(from, 4.0) || !map.shows(to, 4.0) || ![from, middle, to].into_iter().all(&free) {
                continue;
            }
            let turn = upright((to - from).to_angle().to_degrees());
            if labels.take(middle, turn, text, SMALL) {
                centred(svg, class, middle, turn, text);
                break;
            }
        }
    }
}
