//! Cross-sections.

use super::svg::Drawn;
use super::{Scene, Style};

/// Cross-sections of an axis at some stations.
pub fn sections(scene: &Scene<'_>, axis: usize, stations: &[f64], style: &Style) -> Vec<(f64, String)> {
    stations.iter().copied().zip(drawn(scene, axis, stations, style).into_iter().map(|drawn| drawn.text)).collect()
}

pub(super) fn drawn(_: &Scene<'_>, _: usize, _: &[f64], _: &Style) -> Vec<Drawn> {
    Vec::new()
}
