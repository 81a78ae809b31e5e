//! The keys by which GeoTIFF files, and LAS files like them, name their reference system and units (OGC GeoTIFF 1.1, annexes B
//! to E).

use super::Said;
use crate::model::{LengthUnit, Note};
use crate::read::CoordinateKind;

/// Value of a key that is defined by other keys.
const USER_DEFINED: u16 = 32767;

/// How far the size of a unit that is given by its length may be off, as a share: the two feet differ by two parts in a million.
const SAME_UNIT: f64 = 1e-7;

/// What the keys say.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct GeoKeys {
    /// Whether values stand at points and not for areas.
    pub(super) at_points: bool,
    /// What plan coordinates are.
    pub(super) model: Model,
    /// The reference system: an EPSG code, else its name.
    pub(super) crs: Option<String>,
    /// Unit of the plan.
    pub(super) plan: Unit,
    /// Unit of the heights.
    pub(super) heights: Unit,
}

/// What plan coordinates are.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) enum Model {
    /// Nothing is said.
    #[default]
    Unsaid,
    /// Lengths in a projection.
    Projected,
    /// Longitude and latitude.
    Geographic,
    /// Distances from the centre of the earth.
    Geocentric,
}

/// A unit of length in the keys.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) enum Unit {
    /// Nothing is said.
    #[default]
    Unsaid,
    /// One of ours.
    Known(LengthUnit),
    /// Another one, by its EPSG code.
    Other(u16),
}

impl Unit {
    /// By EPSG code.
    pub(super) fn of(code: u16) -> Self {
        match code {
            0 => Self::Unsaid,
            9001 => Self::Known(LengthUnit::Metre),
            9002 => Self::Known(LengthUnit::Foot),
            9003 => Self::Known(LengthUnit::UsSurveyFoot),
            other => Self::Other(other),
        }
    }

    /// By its length in metres.
    pub(super) fn sized(metres: f64) -> Self {
        let known = LengthUnit::ALL.into_iter().find(|unit| (metres / unit.metres() - 1.0).abs() < SAME_UNIT);
        known.map_or(Self::Other(USER_DEFINED), Self::Known)
    }

    pub(super) fn known(self) -> Option<LengthUnit> {
        if let Self::Known(unit) = self { Some(unit) } else { None }
    }
}

impl GeoKeys {
    /// Reads a directory of keys with its numbers and texts. What is damaged or unknown in it says nothing.
    pub(super) fn new(directory: &[u16], numbers: &[f64], texts: &[u8]) -> Self {
        let mut keys = Self::default();
        let (mut projected, mut geographic) = (None, None);
        let (mut name, mut general) = (None, None);
        let mut sized = Unit::Unsaid;
        for entry in directory.get(4..).unwrap_or(&[]).chunks_exact(4) {
            let [key, place, count, value] = [entry[0], entry[1], entry[2], entry[3]];
            let text = || {
                let from = usize::from(value);
                let bytes = texts.get(from..from + usize::from(count))?;
                let text = String::from_utf8_lossy(bytes);
                let text = text.trim_matches(|c: char| c == '|' || c == '\0' || c.is_whitespace()).to_owned();
                (!text.is_empty()).then_some(text)
            };
            match (key, place) {
                (1024, 0) => {
                    keys.model = match value {
                        1 => Model::Projected,
                        2 => Model::Geographic,
                        3 => Model::Geocentric,
                        _ => Model::Unsaid,
                    }
                }
                (1025, 0) => keys.at_points = value == 2,
                (1026, 34737) => general = text(),
                (2048, 0) => geographic = Some(value),
                (3072, 0) => projected = Some(value),
                (3073, 34737) => name = text(),
                (3076, 0) => keys.plan = Unit::of(value),
                (3077, 34736) => sized = numbers.get(usize::from(value)).map_or(Unit::Unsaid, |metres| Unit::sized(*metres)),
                (4099, 0) => keys.heights = Unit::of(value),
                _ => {}
            }
        }
        if keys.plan == Unit::Other(USER_DEFINED) && sized != Unit::Unsaid {
            keys.plan = sized;
        }
        if keys.model == Model::Unsaid {
            keys.model = match (projected, geographic) {
                (Some(_), _) => Model::Projected,
                (None, Some(_)) => Model::Geographic,
                _ => Model::Unsaid,
            };
        }
        let code = if keys.model == Model::Geographic { geographic } else { projected };
        let code = code.filter(|code| *code != 0 && *code != USER_DEFINED).map(|code| format!("EPSG:{code}"));
        keys.crs = code.or(name).or(general);
        keys
    }

    /// What a ground file with these keys says about its coordinates, and the factor its heights need to come to the unit of the
    /// plan. Notes tell what was assumed.
    pub(super) fn settle(&self, notes: &mut Vec<Note>) -> (Said, f64) {
        let kind = match self.model {
            Model::Projected => CoordinateKind::Lengths,
            Model::Geographic => CoordinateKind::Degrees,
            Model::Unsaid | Model::Geocentric => CoordinateKind::Unknown,
        };
        let said = |unit| Said { kind, crs: self.crs.clone(), unit };
        if kind == CoordinateKind::Degrees {
            return (said(None), 1.0);
        }
        for (what, unit) in [("plan coordinates", self.plan), ("heights", self.heights)] {
            if let Unit::Other(code) = unit {
                let message = format!(
                    "the unit of the {what} is not one that is known (EPSG code {code}; known: 9001 metre, 9002 international \
                     foot, 9003 US survey foot): the figures are taken as they are"
                );
                notes.push(Note::new("unit-unknown", message));
            }
        }
        let (plan, heights) = (self.plan.known(), self.heights.known());
        match (plan, heights) {
            (Some(plan), Some(heights)) if plan != heights => {
                let factor = heights.per(plan);
                let message = format!(
                    "the heights are in {}, the plan coordinates in {}: the heights were brought to {}, 1 {heights} = {factor} \
                     {plan}",
                    heights.plural(),
                    plan.plural(),
                    plan.plural()
                );
                notes.push(Note::new("heights-converted", message));
                (said(Some(plan)), factor)
            }
            (Some(plan), None) if plan != LengthUnit::Metre && self.heights == Unit::Unsaid => {
                let message = format!(
                    "the plan coordinates are in {}, and the file does not say in what unit the heights are: taken to be in {} as \
                     well",
                    plan.plural(),
                    plan.plural()
                );
                notes.push(Note::new("heights-unit-assumed", message));
                (said(Some(plan)), 1.0)
            }
            (None, Some(heights)) if heights != LengthUnit::Metre => {
                let message = format!(
                    "the heights are in {}, and the file does not say in what unit the plan coordinates are: taken to be in {} as \
                     well",
                    heights.plural(),
                    heights.plural()
                );
                notes.push(Note::new("heights-unit-assumed", message));
                (said(Some(heights)), 1.0)
            }
            _ => (said(plan), 1.0),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Keys whose values stand in the directory.
    fn keys(entries: &[(u16, u16)]) -> GeoKeys {
        let mut directory = vec![1, 1, 0, entries.len() as u16];
        entries.iter().for_each(|(key, value)| directory.extend([*key, 0, 1, *value]));
        GeoKeys::new(&directory, &[], &[])
    }

    #[test]
    fn systems_and_units_are_known_by_their_codes() {
        let utm = keys(&[(1024, 1), (1025, 2), (3072, 25832), (3076, 9001)]);
        assert_eq!(utm.crs.as_deref(), Some("EPSG:25832"));
        assert_eq!((utm.model, utm.at_points, utm.plan.known()), (Model::Projected, true, Some(LengthUnit::Metre)));
        let degrees = keys(&[(1024, 2), (2048, 4326)]);
        assert_eq!((degrees.model, degrees.crs.as_deref()), (Model::Geographic, Some("EPSG:4326")));
        assert_eq!(keys(&[(3072, 2193)]).model, Model::Projected);
        assert_eq!(keys(&[(3076, 9005)]).plan, Unit::Other(9005));
        assert_eq!(keys(&[]), GeoKeys::default());
    }

    #[test]
    fn what_is_defined_in_the_file_is_known_by_name_and_size() {
        let directory = [1, 1, 0, 4, 3072, 0, 1, 32767, 3073, 34737, 8, 2, 3076, 0, 1, 32767, 3077, 34736, 1, 1];
        let keys = GeoKeys::new(&directory, &[9.0, 1200.0 / 3937.0], b"??My grid|");
        assert_eq!(keys.crs.as_deref(), Some("My grid"));
        assert_eq!(keys.plan.known(), Some(LengthUnit::UsSurveyFoot));
        // Names and numbers that are not there say nothing.
        let keys = GeoKeys::new(&directory, &[], b"");
        assert_eq!((keys.crs, keys.plan), (None, Unit::Other(32767)));
        assert_eq!(GeoKeys::new(&[1, 1], &[], b""), GeoKeys::default());
    }

    #[test]
    fn heights_come_to_the_unit_of_the_plan() {
        let mut notes = Vec::new();
        let (said, factor) = keys(&[(3072, 2225), (3076, 9003), (4099, 9001)]).settle(&mut notes);
        assert_eq!(said.unit, Some(LengthUnit::UsSurveyFoot));
        // 3937 US survey feet are 1200 m.
        assert!((factor - 3937.0 / 1200.0).abs() < 1e-15);
        assert_eq!(notes[0].code, "heights-converted");
        for (entries, code, unit) in [
            (&[(3072, 2225), (3076, 9003)][..], "heights-unit-assumed", Some(LengthUnit::UsSurveyFoot)),
            (&[(3072, 2225), (4099, 9002)], "heights-unit-assumed", Some(LengthUnit::Foot)),
            (&[(3072, 2225), (3076, 9005)], "unit-unknown", None),
        ] {
            let mut notes = Vec::new();
            let (said, factor) = keys(entries).settle(&mut notes);
            assert_eq!((notes[0].code, notes.len(), said.unit, factor), (code, 1, unit, 1.0));
        }
        let mut notes = Vec::new();
        assert_eq!(keys(&[(3072, 25832), (3076, 9001)]).settle(&mut notes).1, 1.0);
        assert!(notes.is_empty());
    }
}
