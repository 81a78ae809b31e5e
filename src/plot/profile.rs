//! The long profile.

use super::{Scene, Style};

/// The long profile along an axis; `None` where there is none.
pub fn profile(_: &Scene<'_>, _: usize, _: &Style) -> Option<String> {
    None
}
