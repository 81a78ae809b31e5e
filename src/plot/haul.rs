//! The mass-haul diagram.

use super::{Scene, Style};

/// The mass-haul diagram of an axis; `None` without ground.
pub fn mass_haul(_: &Scene<'_>, _: usize, _: &Style) -> Option<String> {
    None
}
