//! Depths of cut and fill in bands; without ground the parts of the design.

use super::map::Map;
use crate::ground::{Deepest, Piece};
use crate::model::Part;
use crate::plot::bands::{Bands, Point};
use crate::plot::labels::Labels;
use crate::plot::legend::Block;
use crate::plot::lines::{Stroke, simplified};
use crate::plot::scale::{decimals, figure, round_step, signed};
use crate::plot::style::{CLASSES, SMALL};
use crate::plot::svg::{Path, STEPS, Svg};
use crate::plot::{OnGround, Scene};
use glam::DVec2;

/// The scale of depths: the same steps for cut and for fill.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Depths {
    /// Depth of one band.
    step: f64,
    /// Bands of cut, and as many of fill.
    count: usize,
    cut: Option<Deepest>,
    fill: Option<Deepest>,
    unit: &'static str,
}

impl Depths {
    /// The scale for a scene on ground.
    pub(super) fn of(scene: &Scene<'_>) -> Option<Self> {
        let OnGround { tallied, .. } = scene.ground.as_ref()?;
        let depth = |deepest: &Option<Deepest>| deepest.map_or(0.0, |deepest| deepest.depth);
        let most = depth(&tallied.deepest_cut).max(depth(&tallied.deepest_fill));
        let step = round_step(most / CLASSES as f64);
        let count = ((most / step - 1e-9).ceil().max(1.0) as usize).min(CLASSES);
        Some(Self { step, count, cut: tallied.deepest_cut, fill: tallied.deepest_fill, unit: scene.unit.label() })
    }

    /// Class of band `i`: the deepest band is the strongest colour there is.
    fn class(&self, letter: char, i: usize) -> String {
        format!("{letter}{}", ((i + 1) * CLASSES).div_ceil(self.count).min(CLASSES))
    }

    fn levels(&self) -> Vec<f64> {
        (0..self.count).map(|i| i as f64 * self.step).collect()
    }

    /// Greatest depths in words.
    pub(super) fn words(&self, scene: &Scene<'_>) -> String {
        let one = |deepest: &Option<Deepest>, what: &str| {
            deepest.map_or_else(|| format!("No {what}."), |d| format!("Greatest {what} {:.2} {}.", d.depth, scene.unit))
        };
        format!("{} {}", one(&self.cut, "cut"), one(&self.fill, "fill"))
    }

    /// The scale in the legend.
    pub(super) fn block(&self) -> Block {
        let classes = (0..self.count).rev().map(|i| self.class('c', i)).chain((0..self.count).map(|i| self.class('f', i)));
        let digits = decimals(self.step);
        let n = self.count as i64;
        let ends = (-n..=n).map(|i| figure((i as f64 * self.step).abs(), digits)).collect();
        Block::scale(classes.collect(), ends, self.unit)
    }

    /// Draws the bands, the shallow ones under the deep ones, so that no paper shows between them.
    pub(super) fn draw(&self, svg: &mut Svg, map: &Map, scene: &Scene<'_>, most: usize) {
        let Some(ground) = &scene.ground else { return };
        let all = outlines(ground.pieces.iter(), map, STEPS, vec![0.0], |_| 1.0);
        let cut = outlines(ground.pieces.iter(), map, STEPS, self.levels(), |height| -height);
        let fill = outlines(ground.pieces.iter(), map, STEPS, self.levels(), |height| height);
        let classes = |letter| (0..self.count).map(move |i| self.class(letter, i));
        let named = std::iter::once("nought".to_owned()).chain(classes('c')).chain(classes('f'));
        draw(svg, named.zip(all.into_iter().chain(cut).chain(fill)).collect(), most);
    }

    /// Marks the greatest depths.
    pub(super) fn marks(&self, svg: &mut Svg, map: &Map, labels: &mut Labels) {
        for (deepest, sign, class) in [(&self.cut, -1.0, "cut"), (&self.fill, 1.0, "fill")] {
            let Some(deepest) = deepest else { continue };
            let at = map.at(deepest.at);
            let text = signed(sign * deepest.depth, 2);
            let arm = DVec2::new(4.0, 0.0);
            let offset = DVec2::new(0.0, -10.0);
            if map.shows(at, 24.0) && labels.take(at + offset, 0.0, &text, SMALL) {
                labels.block(at - 5.0, at + 5.0);
                svg.line("thin", at - arm, at + arm);
                svg.line("thin", at - arm.perp(), at + arm.perp());
                svg.text(&format!("s b m halo {class}"), at + offset + DVec2::new(0.0, 0.36 * SMALL), 0.0, &text);
            }
        }
    }
}

/// Outlines of what lies above each level, on the map.
fn outlines<'a>(
    pieces: impl Iterator<Item = Piece<'a>>,
    map: &Map,
    steps: f64,
    levels: Vec<f64>,
    value: impl Fn(f64) -> f64,
) -> Vec<Vec<Stroke>> {
    let mut bands = Bands::new(levels, steps);
    let mut corners = Vec::new();
    for piece in pieces.filter(|piece| piece.corners.len() > 2 && piece.part != Part::Ground) {
        corners.clear();
        corners.extend(piece.corners.iter().map(|c| Point { at: map.at(c.at), value: value(c.height) }));
        bands.add(&corners);
    }
    bands.outlines()
}

/// Draws outlines, those of each class as one path, with so many points in all.
fn draw(svg: &mut Svg, named: Vec<(String, Vec<Stroke>)>, most: usize) {
    let counts: Vec<usize> = named.iter().map(|(_, strokes)| strokes.len()).collect();
    let (classes, strokes): (Vec<String>, Vec<Vec<Stroke>>) = named.into_iter().unzip();
    let mut kept = simplified(&strokes.concat(), most).into_iter();
    for (class, count) in classes.iter().zip(counts) {
        let mut path = Path::default();
        kept.by_ref().take(count).flatten().for_each(|stroke| path.add(&stroke.points, true));
        svg.path(class, &path);
    }
}

/// Draws the parts of a design without ground.
pub(super) fn draw_parts(svg: &mut Svg, map: &Map, scene: &Scene<'_>, most: usize) {
    let design = scene.design;
    let named = [(Part::FillSlope, "f2"), (Part::CutSlope, "c2"), (Part::Platform, "platform")].map(|(part, class)| {
        let mut bands = Bands::new(vec![0.0], STEPS);
        for t in (0..design.triangles.len()).filter(|t| design.parts[*t] == part) {
            bands.add(&design.corners(t).map(|v| Point { at: map.at(v.truncate()), value: 1.0 }));
        }
        (class.to_owned(), bands.outlines().concat())
    });
    draw(svg, named.into(), most);
}

/// For tests: scale of the map, outlines of all works, and of the bands of cut and fill, as they are before simplification.
#[cfg(test)]
pub(in crate::plot) fn band_outlines(scene: &Scene<'_>) -> Option<(f64, [Vec<Vec<Stroke>>; 3])> {
    /// Steps of a lattice that does not show in areas.
    const FINER: f64 = 1e5;
    let map = Map::of(scene, 1000.0)?;
    let depths = Depths::of(scene)?;
    let pieces = scene.ground.as_ref()?.pieces;
    let all = outlines(pieces.iter(), &map, FINER, vec![0.0], |_| 1.0);
    let cut = outlines(pieces.iter(), &map, FINER, depths.levels(), |height| -height);
    let fill = outlines(pieces.iter(), &map, FINER, depths.levels(), |height| height);
    Some((map.scale, [all, cut, fill]))
}
