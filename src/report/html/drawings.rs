//! Drawings on the page of `build`.

use crate::plot::Scene;
use maud::Markup;

pub(super) fn css() -> String { String::new() }
pub(super) fn plan(_scene: &Scene<'_>) -> Option<Markup> { None }
pub(super) fn mass_haul(_scene: &Scene<'_>) -> Option<Markup> { None }
pub(super) fn profile(_scene: &Scene<'_>) -> Option<Markup> { None }
pub(super) fn sections(_scene: &Scene<'_>) -> Option<Markup> { None }
