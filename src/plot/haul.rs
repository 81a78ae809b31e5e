//! The mass-haul diagram.

use super::svg::Drawn;
use super::{Scene, Style};

/// The mass-haul diagram of an axis; `None` without ground.
pub fn mass_haul(scene: &Scene<'_>, axis: usize, style: &Style) -> Option<String> {
    drawn(scene, axis, style).map(|drawn| drawn.text)
}

pub(super) fn drawn(_: &Scene<'_>, _: usize, _: &Style) -> Option<Drawn> {
    None
}
