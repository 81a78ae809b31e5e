//! Drawings on the page of `build`.

use crate::ground;
use crate::model::message::printable;
use crate::plot::{self, Scene, Style};
use crate::report::{DepthPlace, Report};
use maud::{Markup, PreEscaped, html};

/// Most lines with a profile, sections and a mass haul of their own; the first ones.
const MOST_AXES: usize = 6;

/// Most cross-sections of a line, those of the deepest cut and the highest fill not counted, unless more are asked for.
const MOST_SECTIONS: usize = 10;

/// Width of a cross-section in px: two stand side by side.
const SECTION_WIDTH: f64 = 500.0;

/// A drawing in its frame. What does not fit is moved in the frame, not with the page.
fn figure(label: &str, svg: String) -> Markup {
    html! {
        figure {
            div.scroll.drawing tabindex="0" role="region" aria-label=(label) { (PreEscaped(svg)) }
        }
    }
}

pub(super) fn plan(scene: &Scene<'_>) -> Option<Markup> {
    plot::plan(scene, &Style::INLINE).map(|svg| figure("Plan", svg))
}

/// What `draw` makes of the axes, with a note on those left out.
fn along(scene: &Scene<'_>, class: &str, draw: impl Fn(usize, &str, f64) -> Vec<Markup>) -> Option<Markup> {
    let axes = ground::axes(scene.line, &scene.design.frame);
    let many = axes.len() > 1;
    let drawn: Vec<Markup> = axes
        .iter()
        .enumerate()
        .take(MOST_AXES)
        .filter_map(|(i, axis)| {
            let name = printable(&axis.name);
            let figures = draw(i, &name, axis.length);
            let title = html! { @if many { h3 { (name) } } };
            (!figures.is_empty()).then(|| html! { (title) div.(class) { @for figure in figures { (figure) } } })
        })
        .collect();
    let rest = axes.len().saturating_sub(MOST_AXES);
    (!drawn.is_empty()).then(|| {
        html! {
            @for axis in drawn { (axis) }
            @if rest > 0 { p.small { "Of " (axes.len()) " lines the first " (MOST_AXES) " are drawn." } }
        }
    })
}

pub(super) fn profile(scene: &Scene<'_>) -> Option<Markup> {
    along(scene, "sheets", |i, name, _| {
        plot::profile(scene, i, &Style::INLINE).map(|svg| figure(&format!("Long profile of {name}"), svg)).into_iter().collect()
    })
}

pub(super) fn mass_haul(scene: &Scene<'_>) -> Option<Markup> {
    along(scene, "sheets", |i, name, _| {
        plot::mass_haul(scene, i, &Style::INLINE).map(|svg| figure(&format!("Mass haul of {name}"), svg)).into_iter().collect()
    })
}

/// Cross-sections where they were asked for, or at some of the stations and where cut and fill are deepest.
pub(super) fn sections(report: &Report, scene: &Scene<'_>, asked: &[f64]) -> Option<Markup> {
    let deepest = |name: &str, length: f64| -> Vec<f64> {
        let places = report.depths.iter().flat_map(|d| [&d.cut_max_at, &d.fill_max_at]).flatten();
        let own = |place: &&DepthPlace| place.chain.as_deref().is_some_and(|chain| printable(chain) == name);
        places.filter(own).filter_map(|place| place.station).filter(|s| (0.0..=length).contains(s)).collect()
    };
    along(scene, "sheets pair", |i, name, length| {
        let breaks = scene.ground.map_or(&[][..], |ground| ground.stations.breaks(i));
        let mut stations: Vec<f64> = if asked.is_empty() {
            let mut chosen = chosen(breaks, length);
            chosen.extend(deepest(name, length));
            chosen.sort_by(f64::total_cmp);
            chosen.dedup();
            chosen
        } else {
            asked.iter().copied().filter(|s| (0.0..=length).contains(s)).collect()
        };
        let count = stations.len();
        stations.truncate(plot::MOST_SECTIONS);
        let drawn = plot::sections(scene, i, &stations, &Style { width: SECTION_WIDTH, ..Style::INLINE });
        let mut figures: Vec<Markup> = drawn
            .into_iter()
            .map(|(station, svg)| figure(&format!("Cross-section of {name} at station {station:.2}"), svg))
            .collect();
        if count > plot::MOST_SECTIONS {
            figures.push(html! { p.small { "Of " (count) " stations asked for the first " (plot::MOST_SECTIONS)
            " are drawn; choose others with `--section`." } });
        }
        figures
    })
}

/// At most [`MOST_SECTIONS`] stations, evenly among the breaks inside a line; without breaks at round distances.
fn chosen(breaks: &[f64], length: f64) -> Vec<f64> {
    let inner: Vec<f64> = match breaks {
        [_, inner @ .., _] if !inner.is_empty() => inner.to_vec(),
        _ => {
            let step = plot::round_step(length / MOST_SECTIONS as f64);
            (1..=MOST_SECTIONS).map(|i| i as f64 * step).take_while(|s| *s < length).collect()
        }
    };
    let every = inner.len().div_ceil(MOST_SECTIONS).max(1);
    inner.into_iter().skip((every - 1) / 2).step_by(every).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sections_stand_at_some_of_the_breaks() {
        let breaks: Vec<f64> = (0..=100).map(|i| f64::from(i) * 20.0).collect();
        let some = chosen(&breaks, 2000.0);
        assert_eq!(some.len(), 10);
        assert!(some.iter().all(|s| breaks.contains(s) && *s > 0.0 && *s < 2000.0), "{some:?}");
        assert_eq!(chosen(&[0.0, 20.0, 40.0, 50.0], 50.0), [20.0, 40.0]);
        // Without stations: every 50 of a line of 430.
        assert_eq!(chosen(&[0.0, 430.0], 430.0), [50.0, 100.0, 150.0, 200.0, 250.0, 300.0, 350.0, 400.0]);
        assert!(chosen(&[], 0.0).is_empty());
        for length in [f64::NAN, f64::INFINITY, 1e-300, 1e300] {
            assert!(chosen(&[], length).len() <= MOST_SECTIONS);
        }
    }
}
