//! LandXML 1.0 to 2.0 and InfraModel: surfaces as ground, alignments and other lines.
//!
//! Elements are known by their local names, so that versions, profiles and prefixes do not matter. Facts about the format are
//! from the schemas LandXML-1.2.xsd (landxml.org) and inframodel.xsd (buildingSMART Finland): points are northing, easting,
//! elevation; ids of points are unique in their surface; faces with `i="1"` are not to be seen.

mod choose;
mod coord_geom;
mod faces;
mod features;
mod lines;
mod numbers;
mod surface;
mod units;
mod walk;
mod xml;

use super::terrain::{RawFaces, RawGround, Said};
use super::{ColumnOrder, Held, Pick, RawLine, ReadError, ReadOptions, Source};
use crate::model::{LengthUnit, Note};
use crate::read::error::refuse;
use features::Features;
use glam::DVec3;
use surface::Surfaces;
use xml::Xml;

/// What the caller knows about a file.
#[derive(Clone, Copy, Debug)]
pub(super) struct Known<'p> {
    /// What is wanted of it.
    pub(super) pick: &'p Pick,
    /// Easting and northing in another order than they should be.
    pub(super) order: Option<&'p ColumnOrder>,
    /// The unit, if the file declares none.
    pub(super) unit: Option<LengthUnit>,
}

/// Lines of a LandXML file: alignments with their profile, plan features, breaklines.
///
/// Arcs, clothoids and vertical curves become chords within `options.chord` in space, with a vertex at both ends of every element
/// and wherever the profile changes.
///
/// # Errors
/// For files that are damaged, not LandXML or without a unit; where it is not clear what is meant; for elements that cannot be
/// built. The message names the line.
pub(super) fn lines(
    bytes: &[u8],
    source: &mut Source,
    options: &ReadOptions,
    notes: &mut Vec<Note>,
) -> Result<Vec<RawLine>, ReadError> {
    let label = source.label.clone();
    let text = xml::text(&label, bytes, notes)?;
    let exchanged = exchanged(&label, options.csv_order.as_ref())?;
    let mut features = Features::new(exchanged);
    let header = walk::walk(&mut Xml::new(&label, &text), &mut features)?;
    let scale = header.scale(&label, options.unit, notes)?;
    source.crs = header.crs.clone();
    source.kind = header.kind();
    source.unit = Some(scale.unit);
    let chosen = choose::choose(&label, &features, &options.pick, notes)?;
    // The chord is in the unit of the run, if one was asked for.
    let chord = options.chord * options.unit.map_or(1.0, |unit| unit.per(scale.unit));
    let mut maker = lines::Maker::new(&label, &text, &features, scale, chord);
    let (mut lines, mut told) = (Vec::new(), Vec::new());
    for chosen in &chosen {
        lines.extend(maker.make(chosen, &mut told)?);
    }
    thin(told, notes);
    Ok(lines)
}

/// The first few notes of each code, and how many more there are.
fn thin(told: Vec<Note>, notes: &mut Vec<Note>) {
    const MOST: usize = 5;
    let mut counts: Vec<(&'static str, usize)> = Vec::new();
    for note in told {
        let at = counts.iter().position(|(code, _)| *code == note.code).unwrap_or(counts.len());
        if at == counts.len() {
            counts.push((note.code, 0));
        }
        counts[at].1 += 1;
        if counts[at].1 <= MOST {
            notes.push(note);
        }
    }
    for (code, count) in counts.into_iter().filter(|(_, count)| *count > MOST) {
        notes.push(Note::new(code, format!("and {} more lines of which the same is to be said", count - MOST)));
    }
}

/// Ground of a LandXML file: one surface. Without faces its points, unless breaklines would be lost.
///
/// # Errors
/// As [`lines`]; also for points and faces that are damaged.
pub(super) fn ground(label: &str, bytes: &[u8], known: Known<'_>, notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let (vertices, faces, said) = mesh(label, bytes, known, notes)?;
    let ground = if faces.is_empty() {
        let message = "the surface has points only; its own triangles may have been others than those made of them";
        notes.push(Note::new("landxml-no-faces", message));
        RawGround::Points(vertices)
    } else {
        RawGround::Mesh { vertices, faces }
    };
    Ok((ground, said))
}

/// Points and faces of a surface, as [`ground`].
///
/// # Errors
/// As [`ground`].
pub(super) fn mesh(
    label: &str,
    bytes: &[u8],
    known: Known<'_>,
    notes: &mut Vec<Note>,
) -> Result<(Vec<DVec3>, RawFaces, Said), ReadError> {
    let text = xml::text(label, bytes, notes)?;
    let mut surfaces = Surfaces::new(known.pick.surface.as_deref(), exchanged(label, known.order)?);
    let header = walk::walk(&mut Xml::new(label, &text), &mut surfaces)?;
    let surface = surfaces.choose(label)?;
    let scale = header.scale(label, known.unit, notes)?;
    let (vertices, faces) = surface.finish(&text, label, &header, &scale, notes)?;
    Ok((vertices, faces, Said { kind: header.kind(), crs: header.crs, unit: Some(scale.unit) }))
}

/// All surfaces of a file, without their boxes.
///
/// # Errors
/// For files that are damaged or not LandXML.
pub(super) fn surfaces(label: &str, bytes: &[u8]) -> Result<Vec<Held>, ReadError> {
    /// A name no surface can have: points and faces are counted and not kept.
    const NONE: &str = "\0";
    let text = xml::text(label, bytes, &mut Vec::new())?;
    let mut surfaces = Surfaces::new(Some(NONE), false);
    walk::walk(&mut Xml::new(label, &text), &mut surfaces)?;
    let held = |surface: surface::Surface| {
        let (name, vertices, faces) = (Some(surface.name), surface.vertices, surface.faces);
        Held::Surface { name, vertices, faces, parts: Vec::new() }
    };
    Ok(surfaces.found.into_iter().map(held).collect())
}

/// Whether a file is said to have easting before northing.
fn exchanged(label: &str, order: Option<&ColumnOrder>) -> Result<bool, ReadError> {
    let Some(order) = order else { return Ok(false) };
    match order.columns(true).map(|columns| (columns.x, columns.y, columns.z, columns.named)) {
        Some((1, 0, Some(2), 3)) => Ok(false),
        Some((0, 1, Some(2), 3)) => Ok(true),
        _ => {
            let help = "give `nez`, which is usual, or `enz` for a file with easting first";
            Err(refuse("points of LandXML cannot have this order", label, format!("order: {order}"), help))
        }
    }
}
