//! Which stations of an axis get figures in a diagram along it, and how they are written.

use super::Scene;
use super::scale::{decimals, figure, is_multiple, multiples, round_step};

/// Columns of figures are at least this far apart, in px.
const COLUMN: f64 = 48.0;

/// A station as text, with the decimals of its neighbours where it is a multiple as they are, else with two.
pub(super) fn station_text(station: f64, columns: &[f64]) -> String {
    let step = columns.get(1).map_or(1.0, |x| x - columns[0]);
    figure(station, if is_multiple(station, step) { decimals(step) } else { 2.max(decimals(step)) })
}

/// Stations with figures: multiples of the spacing of stations where there is one, and the end.
pub(super) fn columns(scene: &Scene<'_>, length: f64, scale: f64) -> Vec<f64> {
    let least = COLUMN / scale;
    let spacing = scene.ground.as_ref().and_then(|ground| ground.stations.spacing());
    let step = spacing.map_or_else(|| round_step(least), |d| if d >= least { d } else { d * round_step(least / d).ceil() });
    let mut columns = multiples(0.0, length, step);
    if columns.is_empty() {
        columns.push(0.0);
    }
    // The end has a column of its own, in place of one that is too near.
    while columns.len() > 1 && columns.last().is_some_and(|x| (length - x) * scale < COLUMN && *x < length) {
        columns.pop();
    }
    if columns.last().is_some_and(|x| *x < length) {
        columns.push(length);
    }
    columns
}
