//! A diagram: two axes, and what is drawn between them.

use super::labels::width;
use super::lines::{Stroke, simplified};
use super::scale::{decimals, figure, multiples};
use super::style::SMALL;
use super::svg::{Path, Svg};
use glam::DVec2;

/// The field of a diagram, `x` to the right and `y` up.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chart {
    /// Upper left corner, in px.
    pub(super) at: DVec2,
    /// Size in px.
    pub(super) size: DVec2,
    /// Values at the lower left corner.
    pub(super) low: DVec2,
    /// Values at the upper right corner.
    pub(super) high: DVec2,
}

/// Points of one set of lines in a diagram, at most.
const POINTS: usize = 6000;

impl Chart {
    /// Where a point is drawn, in px.
    pub(super) fn px(&self, p: DVec2) -> DVec2 {
        let share = (p - self.low) / (self.high - self.low);
        self.at + DVec2::new(share.x, 1.0 - share.y) * self.size
    }

    /// Lower edge of the field.
    pub(super) fn bottom(&self) -> f64 {
        self.at.y + self.size.y
    }

    /// Right edge of the field.
    pub(super) fn right(&self) -> f64 {
        self.at.x + self.size.x
    }

    /// Grid lines at the multiples of a step of `y`, with figures on the left.
    pub(super) fn rows(&self, svg: &mut Svg, step: f64) {
        self.grid_rows(svg, step);
        self.row_figures(svg, step);
    }

    /// Grid lines at the multiples of a step of `y`.
    pub(super) fn grid_rows(&self, svg: &mut Svg, step: f64) {
        let mut path = Path::default();
        for y in multiples(self.low.y, self.high.y, step) {
            let a = self.px(DVec2::new(self.low.x, y));
            path.add(&[a, DVec2::new(self.right(), a.y)], false);
        }
        svg.path("grid", &path);
    }

    /// Figures of the multiples of a step of `y`, on the left.
    pub(super) fn row_figures(&self, svg: &mut Svg, step: f64) {
        for y in multiples(self.low.y, self.high.y, step) {
            let a = self.px(DVec2::new(self.low.x, y));
            if a.y < self.bottom() - 3.0 && a.y > self.at.y + 3.0 {
                svg.text("s e soft", a + DVec2::new(-6.0, 4.0), 0.0, &figure(y, decimals(step)));
            }
        }
    }

    /// Grid lines at some values of `x`.
    pub(super) fn columns(&self, svg: &mut Svg, at: &[f64], down_to: f64) {
        let mut path = Path::default();
        for x in at {
            let x = self.px(DVec2::new(*x, self.low.y)).x;
            path.add(&[DVec2::new(x, self.at.y), DVec2::new(x, down_to)], false);
        }
        svg.path("grid", &path);
    }

    /// Lines in the field.
    pub(super) fn lines(&self, svg: &mut Svg, class: &str, lines: &[Vec<DVec2>], closed: bool) {
        let stroke = |line: &Vec<DVec2>| Stroke { points: line.iter().map(|p| self.px(*p)).collect(), closed };
        let strokes: Vec<Stroke> = lines.iter().map(stroke).collect();
        let mut path = Path::default();
        for stroke in simplified(&strokes, POINTS).into_iter().flatten() {
            path.add(&stroke.points, closed);
        }
        svg.path(class, &path);
    }

    /// Figures in the middle below some values of `x`, at the height `y` in px; those without room are left out.
    pub(super) fn below(&self, svg: &mut Svg, class: &str, y: f64, figures: impl IntoIterator<Item = (f64, String)>) {
        let mut last = f64::NEG_INFINITY;
        for (x, text) in figures {
            let x = self.px(DVec2::new(x, self.low.y)).x;
            let half = 0.5 * width(&text, SMALL);
            if x - half > last + 4.0 {
                svg.text(class, DVec2::new(x, y), 0.0, &text);
                last = x + half;
            }
        }
    }
}
