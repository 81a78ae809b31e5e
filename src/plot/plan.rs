//! The plan: depths of cut and fill, line work, ground, grid and legend.

mod depths;
mod furniture;
mod linework;
mod map;

#[cfg(test)]
pub(super) use depths::band_outlines;

use super::course::courses;
use super::labels::Labels;
use super::legend::{Block, Legend, Sample};
use super::scale::{figure, round_step};
use super::svg::Svg;
use super::{Scene, Style, contours, lines};
use crate::kernel::plan_box::PlanBox;
use crate::mesh::drape::Drape;
use crate::model::Part;
use crate::write::GENERATOR;
use glam::DVec2;
use map::Map;

/// Points of all bands together, at most. With about eight bytes each, and the bounds of the other lines, a plan stays below
/// half a megabyte.
const BAND_POINTS: usize = 16_000;

/// Points of contours of the ground, at most.
const CONTOUR_POINTS: usize = 14_000;

/// Contours of the ground, at most, and about as many as are aimed at.
const CONTOURS: f64 = 24.0;

/// Mean distance of contours on the map, at least, in px.
const LEAST_SPACING: f64 = 14.0;

/// Contours that stand closer have this many times the interval, or the next round one.
const WIDER: f64 = 1.5;

/// Room above the map: title, and what it is of.
const HEAD: f64 = 56.0;

/// Room at the sides of the map: northings on the left.
const LEFT: f64 = 26.0;
const RIGHT: f64 = 10.0;

/// Room for the north arrow beside the title.
const NORTH: f64 = 50.0;

/// Room below the map, for eastings.
const BELOW: f64 = 22.0;

/// The plan of a scene, north up; `None` where there is nothing to draw.
pub fn plan(scene: &Scene<'_>, style: &Style) -> Option<String> {
    let width = style.width();
    let map = Map::of(scene, width - LEFT - RIGHT)?;
    let courses = courses(scene);
    let depths = depths::Depths::of(scene);
    let mut labels = Labels::default();
    let design = Drape::new(&scene.design.vertices, &scene.design.triangles, None);
    let lines = linework::LineWork::new(scene, &map);
    let ground = ground_contours(scene, &map, lines.interval());

    let mut blocks = Vec::new();
    blocks.extend(depths.as_ref().map(depths::Depths::block));
    blocks.push(Block::bar(map.size.x, map.scale, scene.unit));
    blocks.extend(parts(scene, depths.is_some()));
    blocks.extend(lines.blocks(scene, &courses));
    blocks.extend(ground.as_ref().map(|(interval, _)| {
        let text = format!("contour of the ground, every {}", measure(*interval, scene));
        Block::symbol(Sample::Line("ln contour i"), &text)
    }));
    let top = HEAD + map.size.y + BELOW;
    let legend = Legend::new(blocks, width - LEFT - RIGHT);
    let height = top + legend.height() + 16.0;

    let title = format!("Plan: {}", scene.name());
    let mut svg = Svg::new(style, DVec2::new(width, height.ceil()), &title, &description(scene, &map, depths.as_ref()));
    heading(&mut svg, scene, &title, width);
    furniture::north(&mut svg, DVec2::new(width - RIGHT - 14.0, 8.0));

    svg.window(DVec2::new(LEFT, HEAD), map.size);
    svg.rect("land", DVec2::ZERO, map.size);
    if let Some((interval, contours)) = &ground {
        draw_contours(&mut svg, *interval, contours);
    }
    match &depths {
        Some(depths) => depths.draw(&mut svg, &map, scene, BAND_POINTS),
        None => depths::draw_parts(&mut svg, &map, scene, BAND_POINTS),
    }
    furniture::crosses(&mut svg, &map);
    lines.draw(&mut svg);
    linework::axes(&mut svg, &map, &courses);
    linework::stations(&mut svg, &map, scene, &courses, &design, &mut labels);
    if let Some(depths) = &depths {
        depths.marks(&mut svg, &map, &mut labels);
    }
    lines.labels(&mut svg, &map, &mut labels);
    if let Some((interval, contours)) = &ground {
        label_contours(&mut svg, &map, *interval, contours, &design, &mut labels);
    }
    svg.end_window();
    svg.rect("frame", DVec2::new(LEFT, HEAD), map.size);
    furniture::coordinates(&mut svg, &map, DVec2::new(LEFT, HEAD));
    legend.draw(&mut svg, DVec2::new(LEFT, top));
    Some(svg.finish().text)
}

/// A length with its unit.
fn measure(length: f64, scene: &Scene<'_>) -> String {
    format!("{length} {}", scene.unit)
}

/// Title, and below it what the coordinates are.
fn heading(svg: &mut Svg, scene: &Scene<'_>, title: &str, width: f64) {
    let system = scene.crs.map_or_else(String::new, |crs| format!(" · {crs}"));
    let text = format!("coordinates, elevations and depths in {}{system} · {GENERATOR}", scene.unit.plural());
    svg.heading(title, &text, LEFT, width - LEFT - RIGHT - NORTH);
}

fn description(scene: &Scene<'_>, map: &Map, depths: Option<&depths::Depths>) -> String {
    let PlanBox { lo, hi } = map.world();
    let of = |v: f64| figure(v, 0);
    let place = format!("East {} to {}, north {} to {}.", of(lo.x), of(hi.x), of(lo.y), of(hi.y));
    match depths {
        Some(depths) => format!("Cut in red, fill in blue, both by depth. {} {place}", depths.words(scene)),
        None => format!("Slopes and platform with level curves. {place}"),
    }
}

/// Legend of the parts where there are no depths.
fn parts(scene: &Scene<'_>, depths: bool) -> Vec<Block> {
    let has = |part: Part| !depths && scene.design.parts.contains(&part);
    let named =
        [(Part::Platform, "platform", "platform"), (Part::FillSlope, "f2", "fill slope"), (Part::CutSlope, "c2", "cut slope")];
    let block = |(_, class, name): &(Part, &'static str, &'static str)| Block::symbol(Sample::Patch(class), name);
    named.iter().filter(|(part, _, _)| has(*part)).map(block).collect()
}

/// A level and its lines on the map.
type Contour = (f64, Vec<lines::Stroke>);

/// Interval and contours of the ground in the map, with their levels.
fn ground_contours(scene: &Scene<'_>, map: &Map, interval: Option<f64>) -> Option<(f64, Vec<Contour>)> {
    let terrain = scene.ground.as_ref()?.terrain;
    let within = map.local();
    let (low, high) = contours::heights(&terrain.vertices, &terrain.triangles, within)?;
    // That of the level curves where it gives a number that can be read.
    let fits = |d: &f64| (6.0..=2.0 * CONTOURS).contains(&((high - low) / d));
    let mut interval = interval.filter(fits).unwrap_or_else(|| round_step((high - low) / CONTOURS));
    let mut levels;
    let mut strokes: Vec<(usize, lines::Stroke)>;
    loop {
        levels = super::scale::multiples(low, high, interval);
        let found = contours::contours(&terrain.vertices, &terrain.triangles, within, &levels);
        let numbered = found.into_iter().enumerate();
        strokes = numbered.flat_map(|(i, lines)| lines.into_iter().map(move |line| (i, map.stroke(line)))).collect();
        let length: f64 = strokes.iter().flat_map(|(_, s)| s.points.windows(2)).map(|w| w[0].distance(w[1])).sum();
        // On restless ground contours stand close however few levels there are.
        if length * LEAST_SPACING <= map.size.x * map.size.y || levels.len() < 3 {
            break;
        }
        interval = round_step(WIDER * interval);
    }
    let (at, strokes): (Vec<usize>, Vec<lines::Stroke>) = strokes.into_iter().unzip();
    let kept = lines::simplified(&strokes, CONTOUR_POINTS);
    let mut drawn: Vec<Contour> = levels.into_iter().map(|level| (level, Vec::new())).collect();
    for (level, stroke) in at.into_iter().zip(kept) {
        drawn[level].1.extend(stroke);
    }
    Some((interval, drawn))
}

/// Every fifth contour is heavier and has its height.
fn is_index(level: f64, interval: f64) -> bool {
    (level / interval).round() % 5.0 == 0.0
}

fn draw_contours(svg: &mut Svg, interval: f64, contours: &[Contour]) {
    for (heavy, class) in [(false, "ln contour"), (true, "ln contour i")] {
        let mut path = super::svg::Path::default();
        for (_, strokes) in contours.iter().filter(|(level, _)| is_index(*level, interval) == heavy) {
            strokes.iter().for_each(|stroke| path.add(&stroke.points, stroke.closed));
        }
        svg.path(class, &path);
    }
}

fn label_contours(svg: &mut Svg, map: &Map, interval: f64, contours: &[Contour], design: &Drape<'_>, labels: &mut Labels) {
    // Below the works contours are not seen.
    let seen = |p: DVec2| design.at(map.to_local(p)).is_none();
    for (level, strokes) in contours.iter().filter(|(level, _)| is_index(*level, interval)) {
        let text = figure(*level, super::scale::decimals(interval));
        for stroke in strokes {
            linework::label_along(svg, map, stroke, &text, "s m tc halo", labels, seen);
        }
    }
}
