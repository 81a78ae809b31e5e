//! Reference systems: what the heads of files may say of their coordinates, and what inputs say against each other.

use super::watch::Stopwatch;
use crate::model::message::printable;
use crate::model::{LengthUnit, Note};
use crate::read::{CoordinateKind, Source};
use crate::write::{Reference, SystemName};

/// What a file in `unit` may say of its coordinates: the system of the line, else of the ground, where coordinates still are
/// what it says, and a unit where a file or the command line declared one.
pub(super) fn reference<'a>(
    line: &'a Source,
    ground: Option<&'a Source>,
    asked: Option<LengthUnit>,
    unit: LengthUnit,
) -> Reference<'a> {
    let mut sources = std::iter::once(line).chain(ground);
    let declared = asked.is_some() || sources.clone().any(|source| source.unit.is_some());
    let kept = |source: &Source| source.kind != CoordinateKind::Degrees && source.unit.is_none_or(|own| own == unit);
    let crs = sources.find_map(|source| source.crs.as_deref().filter(|_| kept(source)));
    Reference { crs, unit: declared.then_some(unit) }
}

/// Tells of inputs whose coordinates are in another reference system than those of the first that names one.
pub(super) fn compare<'a>(watch: &Stopwatch<'_>, inputs: impl IntoIterator<Item = (&'static str, &'a Source)>) {
    let named = inputs.into_iter().filter(|(_, source)| source.kind != CoordinateKind::Degrees);
    let mut named = named.filter_map(|(role, source)| source.crs.as_deref().map(|crs| (role, crs)));
    let Some((first, system)) = named.next() else { return };
    for (other, own) in named.filter(|(_, own)| SystemName(system).contradicts(SystemName(own))) {
        let message = format!(
            "the {first} is in the reference system `{}`, the {other} in `{}`: their coordinates were taken as if they were in one",
            printable(system),
            printable(own)
        );
        watch.note(&Note::new("crs-differ", message));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::read::InputFormat;

    fn source(crs: &str, unit: Option<LengthUnit>, kind: CoordinateKind) -> Source {
        let (label, sha256) = (String::new(), String::new());
        let crs = (!crs.is_empty()).then(|| crs.to_owned());
        Source { label, format: InputFormat::Obj, bytes: 0, sha256, crs, kind, unit }
    }

    /// A name stays with coordinates that were neither converted nor degrees by what the file says.
    #[test]
    fn names_go_with_their_coordinates() {
        let (metre, foot) = (LengthUnit::Metre, LengthUnit::Foot);
        let line = source("A", Some(metre), CoordinateKind::Lengths);
        let ground = source("B", Some(foot), CoordinateKind::Lengths);
        let degrees = source("EPSG:4326", None, CoordinateKind::Degrees);
        let of = |line, ground, unit| reference(line, ground, None, unit).crs;
        assert_eq!(of(&line, Some(&ground), metre), Some("A"));
        assert_eq!(of(&line, Some(&ground), foot), Some("B"));
        assert_eq!(of(&line, None, foot), None);
        assert_eq!(of(&degrees, Some(&ground), foot), Some("B"));
        assert_eq!(of(&degrees, None, metre), None);
        assert_eq!(reference(&degrees, None, None, metre).unit, None);
        assert_eq!(reference(&degrees, None, Some(metre), metre).unit, Some(metre));
    }

    #[test]
    fn contradictions_are_told_once_for_each_input() {
        let named = |crs: &str| source(crs, None, CoordinateKind::Lengths);
        let told = |sources: &[(&'static str, Source)]| {
            let watch = Stopwatch::new(&());
            compare(&watch, sources.iter().map(|(role, source)| (*role, source)));
            watch.notes().into_iter().map(|note| note.message).collect::<Vec<_>>()
        };
        let (a, b) = ("EPSG:25832", "urn:ogc:def:crs:EPSG::25832");
        assert!(told(&[("line", named(a)), ("ground", named(b))]).is_empty());
        assert!(told(&[("line", named("")), ("ground", named(b))]).is_empty());
        let degrees = source("EPSG:4326", None, CoordinateKind::Degrees);
        assert!(told(&[("line", degrees), ("ground", named(b))]).is_empty());
        let found = told(&[("design", named("EPSG:25833")), ("existing", named(a)), ("within", named("EPSG:25833"))]);
        assert_eq!(
            found,
            [
                "the design is in the reference system `EPSG:25833`, the existing in `EPSG:25832`: their coordinates were taken as if \
              they were in one"
            ]
        );
    }
}
