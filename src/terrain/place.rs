//! Places of ground in messages.

pub(super) use crate::model::digits::counted;
use crate::model::{Defect, Defects, digits};
use glam::DVec3;

/// A number for a message: millimetres, without trailing zeros.
pub(super) fn short(value: f64) -> String {
    digits::fixed(value, 3)
}

/// A point in world coordinates.
pub(super) fn point(p: DVec3) -> String {
    format!("({}, {}, {})", short(p.x), short(p.y), short(p.z))
}

/// A single defect.
pub(super) fn defect(code: &'static str, what: &str, at: String, figures: String, help: &str) -> Defects {
    let mut defects = Defects::default();
    let help = help.to_owned();
    defects.push(code, || Defect { code, what: what.to_owned(), at, figures: Some(figures), help });
    defects
}

pub(super) fn nothing_left(label: &str) -> Defects {
    let figures = "no triangle has an area in plan".to_owned();
    defect("ground-empty", "the ground has no surface", label.to_owned(), figures, "give ground with an extent in plan")
}
