//! The cases, by what they are about.

mod heights;
mod invariance;
mod on_ground;
mod open_lines;
mod refusals;
mod rings;
mod surfaces;

use super::{Bound, Case, Expected, Figure, Outcome, ROUNDING, Row};

/// All cases of `slopegen selftest`.
pub fn all() -> Vec<Case> {
    [
        open_lines::cases(),
        rings::cases(),
        heights::cases(),
        on_ground::cases(),
        surfaces::cases(),
        invariance::cases(),
        refusals::cases(),
    ]
    .into_iter()
    .flatten()
    .collect()
}

/// A figure of the report of the first job.
fn key(key: &str, formula: &str, value: f64, bound: Bound) -> Row {
    let of = key.to_owned();
    row(key, formula, value, bound, move |outcomes| outcomes.first()?.number(&of))
}

/// A figure of the report of the first job that differs by rounding only.
fn exact(name: &str, formula: &str, value: f64) -> Row {
    key(name, formula, value, Bound::Fixed(ROUNDING * value.abs().max(1.0)))
}

/// A figure found in any other way.
fn row(figure: &str, formula: &str, value: f64, bound: Bound, got: impl Fn(&[Outcome]) -> Option<f64> + 'static) -> Row {
    let got: Figure = Box::new(got);
    Row { figure: figure.to_owned(), formula: formula.to_owned(), expected: Expected::Number { value, bound, got } }
}

/// The greatest value of a measure over all points of the lines of a kind; nothing where there are none, or where it is no
/// number.
fn greatest(outcome: &Outcome, kind: &str, measure: impl Fn([f64; 3]) -> f64) -> Option<f64> {
    let lines = outcome.lines(kind)?;
    let measures: Vec<f64> = lines.into_iter().flatten().map(measure).collect();
    let is_number = !measures.is_empty() && measures.iter().all(|value| value.is_finite());
    is_number.then(|| measures.into_iter().fold(f64::NEG_INFINITY, f64::max))
}

/// Length in space of all lines of a kind.
fn length(outcome: &Outcome, kind: &str) -> Option<f64> {
    let of = |line: &Vec<[f64; 3]>| line.windows(2).map(|w| distance(w[0], w[1])).sum::<f64>();
    Some(outcome.lines(kind)?.iter().map(of).sum())
}

fn distance(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]) * (a[i] - b[i])).sum::<f64>().sqrt()
}

/// Plan distance of a point from a segment.
fn from_segment([x, y, _]: [f64; 3], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (ux, uy) = (bx - ax, by - ay);
    let t = (((x - ax) * ux + (y - ay) * uy) / (ux * ux + uy * uy)).clamp(0.0, 1.0);
    let (dx, dy) = (x - ax - t * ux, y - ay - t * uy);
    (dx * dx + dy * dy).sqrt()
}
