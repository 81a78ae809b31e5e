//! Which drawing a file is to hold.

use super::{Scene, Style, haul, plan, profile, sections, svg};
use crate::write::Target;
use std::path::PathBuf;

/// A drawing that can be asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    /// The plan.
    Plan,
    /// Long profiles, one for each axis.
    Profile,
    /// Cross-sections.
    Sections,
    /// Mass-haul diagrams, one for each axis.
    Haul,
}

impl Drawing {
    /// All drawings.
    pub const ALL: [Self; 4] = [Self::Plan, Self::Profile, Self::Sections, Self::Haul];

    /// The word that names of files end in.
    pub fn name(self) -> &'static str {
        match self {
            Self::Plan => "plan",
            Self::Profile => "profile",
            Self::Sections => "sections",
            Self::Haul => "haul",
        }
    }

    /// The drawing of a target: its name ends in the word for it and `.svg`, upper or lower case. A stream says nothing, and gets
    /// the plan.
    ///
    /// # Errors
    /// [`UnknownDrawing`] for any other name.
    pub fn of(target: &Target) -> Result<Self, UnknownDrawing> {
        let Target::File(path) = target else { return Ok(Self::Plan) };
        let lower = |part: Option<&std::ffi::OsStr>| part.map(|part| part.to_string_lossy().to_lowercase()).unwrap_or_default();
        let (stem, ending) = (lower(path.file_stem()), lower(path.extension()));
        let named = Self::ALL.into_iter().find(|drawing| ends_in_word(&stem, drawing.name()));
        match named.filter(|_| ending == "svg") {
            Some(drawing) => Ok(drawing),
            None if target.is_stream() => Ok(Self::Plan),
            None => Err(UnknownDrawing(path.clone())),
        }
    }
}

/// Whether a name is a word, or ends in one after something that is no letter.
fn ends_in_word(stem: &str, word: &str) -> bool {
    stem.strip_suffix(word).is_some_and(|before| before.chars().next_back().is_none_or(|c| !c.is_alphabetic()))
}

/// A file name that does not say what is to be drawn.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "the name does not say what is to be drawn\n  --> {}\n   = help: end it in `plan.svg`, `profile.svg`, `sections.svg` or \
     `haul.svg`; anything may stand before that, as in `site_plan.svg`",
    .0.display()
)]
pub struct UnknownDrawing(pub PathBuf);

/// Most axes drawn below each other in one file; the first ones.
const MOST_AXES: usize = 24;

/// A drawing as a file of its own, of several axes below each other; cross-sections at `stations`, or at all breaks.
///
/// Every drawing asked for is written: where there is nothing to draw, the file says so.
pub fn file(scene: &Scene<'_>, drawing: Drawing, stations: &[f64]) -> String {
    if let Some(plan) = (drawing == Drawing::Plan).then(|| plan::plan(scene, &Style::FILE)).flatten() {
        return plan;
    }
    let axes = scene.line.chains.len();
    let of_axis = |i: usize| match drawing {
        Drawing::Plan => Vec::new(),
        Drawing::Profile => profile::drawn(scene, i, &Style::INLINE).into_iter().collect(),
        Drawing::Sections => sections::drawn(scene, i, stations, &Style::INLINE),
        Drawing::Haul => haul::drawn(scene, i, &Style::INLINE).into_iter().collect::<Vec<_>>(),
    };
    let parts: Vec<svg::Drawn> = (0..axes.min(MOST_AXES)).flat_map(of_axis).collect();
    let left_out = axes.saturating_sub(MOST_AXES);
    let note = match (parts.is_empty(), left_out) {
        (true, _) => Some("There is nothing to draw.".to_owned()),
        (_, 0) => None,
        (_, n) => Some(format!("{n} more lines are not drawn.")),
    };
    let title = match drawing {
        Drawing::Sections => format!("Cross-sections: {}", scene.name()),
        _ => format!("{}: {}", drawing.name(), scene.name()),
    };
    // The other drawings have a heading each.
    let headed = parts.is_empty() || drawing == Drawing::Sections;
    svg::sheet(&parts, &title, headed, note.as_deref())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_what_is_drawn() {
        let of = |name: &str| Drawing::of(&Target::File(name.into()));
        assert_eq!(of("plan.svg"), Ok(Drawing::Plan));
        assert_eq!(of("out/Site_Profile.SVG"), Ok(Drawing::Profile));
        assert_eq!(of("a-2sections.svg"), Ok(Drawing::Sections));
        assert_eq!(of("mass-haul.svg"), Ok(Drawing::Haul));
        assert_eq!(Drawing::of(&Target::Stdout), Ok(Drawing::Plan));
        for name in ["floorplan.svg", "plan.png", "section.svg", "plan", ".svg"] {
            assert!(of(name).is_err(), "{name}");
        }
    }
}
