//! The long profile.

use super::svg::Drawn;
use super::{Scene, Style};

/// The long profile along an axis; `None` where there is none.
pub fn profile(scene: &Scene<'_>, axis: usize, style: &Style) -> Option<String> {
    drawn(scene, axis, style).map(|drawn| drawn.text)
}

pub(super) fn drawn(_: &Scene<'_>, _: usize, _: &Style) -> Option<Drawn> {
    None
}
