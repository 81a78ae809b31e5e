//! What stands on and around the map: grid crosses, coordinates, north arrow.

use super::map::Map;
use crate::kernel::plan_box::PlanBox;
use crate::plot::labels::width;
use crate::plot::scale::{decimals, figure, multiples, round_step};
use crate::plot::style::SMALL;
use crate::plot::svg::{Path, Svg};
use glam::DVec2;

/// Grid lines are at least this far apart, in px.
const GRID: f64 = 120.0;

/// Half the length of the arms of a grid cross, in px.
const ARM: f64 = 4.0;

/// Multiples of the grid step in the map: eastings, northings, the step.
fn grid(map: &Map) -> (Vec<f64>, Vec<f64>, f64) {
    let step = round_step(GRID / map.scale);
    let PlanBox { lo, hi } = map.world();
    (multiples(lo.x, hi.x, step), multiples(lo.y, hi.y, step), step)
}

/// Crosses at round coordinates, in the window of the map.
pub(super) fn crosses(svg: &mut Svg, map: &Map) {
    let (eastings, northings, _) = grid(map);
    let mut path = Path::default();
    for y in &northings {
        for x in &eastings {
            let at = map.of_world(DVec2::new(*x, *y).extend(0.0));
            path.add(&[at - DVec2::X * ARM, at + DVec2::X * ARM], false);
            path.add(&[at - DVec2::Y * ARM, at + DVec2::Y * ARM], false);
        }
    }
    svg.path("ln tick", &path);
}

/// Ticks and figures along the lower and left edge of a map whose window is at `at`.
pub(super) fn coordinates(svg: &mut Svg, map: &Map, at: DVec2) {
    let (eastings, northings, step) = grid(map);
    let digits = decimals(step);
    let mut path = Path::default();
    let bottom = at.y + map.size.y;
    let mut last = f64::NEG_INFINITY;
    for e in eastings {
        let x = at.x + map.of_world(DVec2::new(e, 0.0).extend(0.0)).x;
        let text = format!("{} E", figure(e, digits));
        let half = 0.5 * width(&text, SMALL);
        path.add(&[DVec2::new(x, bottom), DVec2::new(x, bottom + 4.0)], false);
        if x - half > last + 8.0 && x + half < at.x + map.size.x + 8.0 && x - half > at.x - 20.0 {
            svg.text("s m soft", DVec2::new(x, bottom + 15.0), 0.0, &text);
            last = x + half;
        }
    }
    let mut last = f64::INFINITY;
    for n in northings {
        let y = at.y + map.of_world(DVec2::new(0.0, n).extend(0.0)).y;
        let text = format!("{} N", figure(n, digits));
        let half = 0.5 * width(&text, SMALL);
        path.add(&[DVec2::new(at.x - 4.0, y), DVec2::new(at.x, y)], false);
        if y + half < last - 8.0 && y - half > at.y - 20.0 && y + half < bottom + 8.0 {
            svg.text("s m soft", DVec2::new(at.x - 8.0, y), -90.0, &text);
            last = y - half;
        }
    }
    svg.path("ln tick", &path);
}

/// The north arrow, its tip at `tip`.
pub(super) fn north(svg: &mut Svg, tip: DVec2) {
    let at = |x: f64, y: f64| tip + DVec2::new(x, y);
    let mut half = Path::default();
    half.add(&[tip, at(8.0, 26.0), at(0.0, 20.0)], true);
    let mut whole = Path::default();
    whole.add(&[tip, at(8.0, 26.0), at(0.0, 20.0), at(-8.0, 26.0)], true);
    svg.path("ln thin", &whole);
    svg.path("solid", &half);
    svg.text("b m", at(0.0, 40.0), 0.0, "N");
}
