//! One unit of length for a run: that asked for, else that of the line (or the design), else metres. Files that declare another
//! one are converted as they are read; files that declare none are taken to be in the unit of the run.

use crate::model::{LengthUnit, Note};
use crate::read::terrain::{RawGround, RawTerrain};
use crate::read::{RawInput, Source};

/// Brings a line to a unit; tells when it had another.
pub(super) fn convert_line(raw: &mut RawInput, unit: LengthUnit) -> Option<Note> {
    let (factor, note) = conversion(&raw.source, unit)?;
    for vertex in raw.lines.iter_mut().flat_map(|line| &mut line.vertices) {
        vertex.x *= factor;
        vertex.y *= factor;
        vertex.z = vertex.z.map(|z| z * factor);
    }
    Some(note)
}

/// Brings ground to a unit; tells when it had another.
pub(super) fn convert_ground(raw: &mut RawTerrain, unit: LengthUnit) -> Option<Note> {
    let (factor, note) = conversion(&raw.source, unit)?;
    match &mut raw.ground {
        RawGround::Mesh { vertices, .. } | RawGround::Points(vertices) => vertices.iter_mut().for_each(|v| *v *= factor),
        RawGround::Grid(grid) => {
            grid.origin *= factor;
            grid.step *= factor;
            grid.heights.iter_mut().for_each(|z| *z *= factor);
        }
    }
    Some(note)
}

fn conversion(source: &Source, unit: LengthUnit) -> Option<(f64, Note)> {
    let declared = source.unit.filter(|declared| *declared != unit)?;
    let factor = declared.per(unit);
    let message = format!(
        "`{}` is in {} and was brought to {}, the unit of this run: 1 {declared} = {factor} {unit}",
        source.label,
        declared.plural(),
        unit.plural()
    );
    Some((factor, Note::new("unit-converted", message)))
}
