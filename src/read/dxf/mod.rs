//! AutoCAD DXF: lines and ground, from text and binary files of all releases.
//!
//! A drawing is a list of pairs: a group code, which says what the value is, and the value (Autodesk, "DXF Reference"). It is
//! read through twice where it lies: once for what it holds ([`index::Index`]), then for its entities ([`walk`]), those of blocks
//! as often as the blocks are inserted. Nothing is kept but what is asked for, and no value is looked at that is not needed.

mod bulge;
mod chain;
mod entity;
mod ground;
mod index;
mod layers;
mod lines;
mod names;
mod pairs;
mod transform;
mod walk;

pub(super) use pairs::SENTINEL;

use super::terrain::{RawFaces, RawGround, Said};
use super::{CoordinateKind, Pick, RawLine, ReadError, ReadOptions, Source};
use crate::model::{LengthUnit, Note};
use crate::read::error::refuse;
use glam::DVec3;
use index::Index;
use layers::{LayerId, Layers};
use names::counted;
use rustc_hash::FxHashMap;
use walk::{Passed, Want};

/// Lines of a DXF file: polylines with their arcs cut into chords, single LINEs and ARCs joined end to end.
///
/// # Errors
/// The file is damaged; it has no lines that are meant; a layer or a line asked for is not there.
pub(super) fn lines(
    bytes: &[u8],
    source: &mut Source,
    options: &ReadOptions,
    notes: &mut Vec<Note>,
) -> Result<Vec<RawLine>, ReadError> {
    let label = source.label.clone();
    check(&label, bytes)?;
    let mut layers = Layers::new(&options.pick.layers);
    let index = Index::read(&label, bytes, &mut layers)?;
    let mut told = Vec::new();
    let unit = unit(&index, &mut told);
    // The chord is in the unit of the run, if one was asked for.
    let chord = options.chord * options.unit.zip(unit).map_or(1.0, |(asked, unit)| asked.per(unit));
    let mut found = lines::Lines::new(&label, chord);
    let passed = walk::walk(&index, &mut layers, Want::Lines, &mut |placed| found.take(placed))?;
    layers.check(&label)?;
    let lines = found.finish(&layers, &options.pick.features, notes)?;
    if lines.is_empty() {
        let help = "give a drawing with polylines, LINEs or ARCs on layers that are on, or name a layer with `--layer`; convert \
                    splines and circles to polylines first";
        return Err(refuse("the drawing has no lines to read", label.as_str(), layers.holdings(), help));
    }
    passed.tell(notes);
    notes.append(&mut told);
    source.unit = unit;
    source.kind = CoordinateKind::Unknown;
    Ok(lines)
}

/// Ground of a DXF file: its faces and meshes, or its points if there are none.
///
/// # Errors
/// The file is damaged; it has no faces or points that are meant; a layer asked for is not there.
pub(super) fn ground(label: &str, bytes: &[u8], pick: &Pick, notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    collected(label, bytes, pick, notes).map(|(ground, _, said)| (ground, said))
}

/// Faces of a drawing grouped by layer: vertices, faces, the group of each face, names of the groups in the order of their first
/// faces.
pub(super) type LayeredMesh = (Vec<DVec3>, RawFaces, Vec<u32>, Vec<String>);

/// The faces of a drawing, to be looked at as they are.
///
/// # Errors
/// As [`ground`]; also where the drawing has points only.
pub(super) fn mesh(label: &str, bytes: &[u8], pick: &Pick, notes: &mut Vec<Note>) -> Result<(LayeredMesh, Said), ReadError> {
    // Here the layers have the option of lines.
    let found = collected(label, bytes, pick, notes).map_err(|error| error.with_option("--terrain-layer", "--layer"))?;
    let (ground, (groups, names), said) = found;
    match ground {
        RawGround::Mesh { vertices, faces } => Ok(((vertices, faces, groups, names), said)),
        RawGround::Points(points) => {
            let figures = counted(points.len(), "POINT", "POINTs");
            Err(refuse("the drawing has points, but no faces", label, figures, "give a drawing with 3DFACEs or meshes"))
        }
        RawGround::Grid(_) => {
            Err(refuse("the drawing is no mesh", label, "it is a grid", "give a drawing with 3DFACEs or meshes"))
        }
    }
}

/// Group of each face, and names of the groups: layers.
type Groups = (Vec<u32>, Vec<String>);

fn collected(label: &str, bytes: &[u8], pick: &Pick, notes: &mut Vec<Note>) -> Result<(RawGround, Groups, Said), ReadError> {
    check(label, bytes)?;
    let mut layers = Layers::new(&pick.layers);
    let index = Index::read(label, bytes, &mut layers)?;
    let mut found = ground::Ground::new(label);
    let passed = walk::walk(&index, &mut layers, Want::Ground, &mut |placed| found.take(placed))?;
    layers.check(label)?;
    let mut names = Vec::new();
    let mut numbers: FxHashMap<LayerId, u32> = FxHashMap::default();
    let number = |layer: LayerId| {
        *numbers.entry(layer).or_insert_with(|| {
            names.push(layers.name(layer).to_owned());
            names.len() as u32 - 1
        })
    };
    let groups: Vec<u32> = found.layers().into_iter().map(number).collect();
    let Some(ground) = found.finish(notes) else {
        let help = "give a drawing with 3DFACEs, meshes or POINTs on layers that are on, or name a layer with `--terrain-layer`; \
                    contours have to be triangulated first";
        return Err(refuse("the drawing has no ground to read", label, layers.holdings(), help));
    };
    passed.tell(notes);
    let unit = unit(&index, notes);
    Ok((ground, (groups, names), Said { unit, ..Said::default() }))
}

/// # Errors
/// The file is something else by its first bytes.
fn check(label: &str, bytes: &[u8]) -> Result<(), ReadError> {
    let help = "give a drawing saved as DXF";
    if bytes.trim_ascii().is_empty() {
        return Err(refuse("the file is empty", label, "no drawing in it", help));
    }
    if bytes.starts_with(b"AC10") {
        let help = "save it as DXF (any release), e.g. with `SAVEAS` of the CAD program";
        return Err(refuse("the file is a DWG drawing", label, "DWG is a format of one maker, and not read", help));
    }
    Ok(())
}

/// The unit `$INSUNITS` stands for. Templates declare millimetres or inches for drawings in metres or feet, so that no other
/// unit is believed: coordinates are taken as they are, with a note.
fn unit(index: &Index<'_>, notes: &mut Vec<Note>) -> Option<LengthUnit> {
    let code = index.units?;
    match code {
        0 => None,
        2 => Some(LengthUnit::Foot),
        6 => Some(LengthUnit::Metre),
        21 => Some(LengthUnit::UsSurveyFoot),
        _ => {
            let name = match code {
                1 => "inches".to_owned(),
                4 => "millimetres".to_owned(),
                5 => "centimetres".to_owned(),
                7 => "kilometres".to_owned(),
                10 => "yards".to_owned(),
                14 => "decimetres".to_owned(),
                other => format!("unit {other}"),
            };
            let message = format!(
                "the drawing declares {name} ($INSUNITS {code}), which is often left over from a template; its figures are taken as they are"
            );
            notes.push(Note::new("dxf-units", message));
            None
        }
    }
}

impl Passed {
    /// Notes on what was passed over.
    fn tell(&self, notes: &mut Vec<Note>) {
        if self.hidden > 0 {
            let entities = names::counted(self.hidden, "entity", "entities");
            let message =
                format!("left out {entities} on layers that are off or frozen, or invisible; layers named are read in any state");
            notes.push(Note::new("dxf-hidden", message));
        }
        if !self.kinds.is_empty() {
            let list = names::listed(self.kinds.iter().map(|(kind, n)| format!("{n} {kind}")));
            notes.push(Note::new("dxf-ignored", format!("entities of other kinds were passed over: {list}")));
        }
        if let Some((count, block)) = &self.missing {
            let inserts = names::counted(*count, "insert of a block that is", "inserts of blocks that are");
            notes.push(Note::new("dxf-blocks-missing", format!("passed over {inserts} not in the drawing, such as `{block}`")));
        }
    }
}
