//! Which drawing a file is to hold.

use crate::write::{Target, UnknownFormat};
use std::path::Path;

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
    /// [`UnknownFormat`] for any other name.
    pub fn of(target: &Target) -> Result<Self, UnknownFormat> {
        let Target::File(path) = target else { return Ok(Self::Plan) };
        let lower = |part: Option<&std::ffi::OsStr>| part.map(|part| part.to_string_lossy().to_lowercase()).unwrap_or_default();
        let (stem, ending) = (lower(path.file_stem()), lower(path.extension()));
        let named = Self::ALL.into_iter().find(|drawing| ends_in_word(&stem, drawing.name()));
        match named.filter(|_| ending == "svg") {
            Some(drawing) => Ok(drawing),
            None if target.is_stream() => Ok(Self::Plan),
            None => Err(unknown(path)),
        }
    }
}

/// Whether a name is a word, or ends in one after something that is no letter.
fn ends_in_word(stem: &str, word: &str) -> bool {
    stem.strip_suffix(word).is_some_and(|before| before.chars().next_back().is_none_or(|c| !c.is_alphabetic()))
}

fn unknown(path: &Path) -> UnknownFormat {
    let known = "`plan.svg`, `profile.svg`, `sections.svg` or `haul.svg`, which says what is drawn; something may stand before it, as in `site_plan.svg`";
    UnknownFormat { what: "drawing", path: path.to_owned(), known }
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
