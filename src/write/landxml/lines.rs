//! Line work: as plan features of a file of its own, and as breaklines of a surface.

use super::parts::{push_escaped, push_northing_first, start};
use crate::model::{CurveKind, LineFeature};
use crate::write::head::finite;
use crate::write::lines::in_order;
use crate::write::number::push_f64;
use crate::write::obj::flush_if_full;
use crate::write::{EncodeError, Head};
use glam::DVec3;
use std::io::Write;

/// Writes the line work [`Head::lines`] as plan features: each a chain of straight lines, its kind and number as name.
///
/// # Errors
/// As [`super::write_landxml`].
pub fn write_landxml_lines(out: &mut (impl Write + ?Sized), head: &Head<'_>) -> Result<(), EncodeError> {
    let mut bytes = start(head);
    bytes.extend_from_slice(b"<PlanFeatures name=\"");
    push_escaped(&mut bytes, head.name);
    bytes.extend_from_slice(b"\">\n");
    for (i, name) in named(head.lines, |_| true) {
        let feature = &head.lines[i];
        bytes.extend_from_slice(b"<PlanFeature name=\"");
        push_escaped(&mut bytes, &name);
        push_desc(&mut bytes, feature, i)?;
        bytes.extend_from_slice(b"\">\n<CoordGeom>\n");
        for ends in feature.points.windows(2) {
            for (before, p, after) in
                [(&b"<Line><Start>"[..], ends[0], &b"</Start>"[..]), (b"<End>", ends[1], b"</End></Line>\n")]
            {
                bytes.extend_from_slice(before);
                push_point(&mut bytes, p, i)?;
                bytes.extend_from_slice(after);
            }
            flush_if_full(out, &mut bytes)?;
        }
        bytes.extend_from_slice(b"</CoordGeom>\n</PlanFeature>\n");
    }
    bytes.extend_from_slice(b"</PlanFeatures>\n</LandXML>\n");
    out.write_all(&bytes)?;
    Ok(())
}

/// The line work that shapes the surface. Level curves and the zero line lie on it and say nothing new; the boundary has an
/// element of its own.
pub(super) fn breaklines(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>, head: &Head<'_>) -> Result<(), EncodeError> {
    let shapes = |kind| !matches!(kind, CurveKind::LevelCurve | CurveKind::Zero | CurveKind::Boundary);
    let wanted = named(head.lines, shapes);
    if wanted.is_empty() {
        return Ok(());
    }
    bytes.extend_from_slice(b"<Breaklines>\n");
    for (i, name) in wanted {
        let feature = &head.lines[i];
        bytes.extend_from_slice(b"<Breakline brkType=\"standard\" name=\"");
        push_escaped(bytes, &name);
        push_desc(bytes, feature, i)?;
        bytes.extend_from_slice(b"\"><PntList3D>");
        for (k, p) in feature.points.iter().enumerate() {
            if k > 0 {
                bytes.push(b' ');
            }
            push_point(bytes, *p, i)?;
            flush_if_full(out, bytes)?;
        }
        bytes.extend_from_slice(b"</PntList3D></Breakline>\n");
    }
    bytes.extend_from_slice(b"</Breaklines>\n");
    Ok(())
}

/// The lines of the kinds wanted, in the order they are written, each with its kind and its number within the kind.
fn named(lines: &[LineFeature], wanted: impl Fn(CurveKind) -> bool) -> Vec<(usize, String)> {
    let order = in_order(lines).into_iter().filter(|&i| wanted(lines[i].kind));
    let mut count = (CurveKind::LevelCurve, 0_usize);
    order
        .map(|i| {
            let kind = lines[i].kind;
            count = if count.0 == kind { (kind, count.1 + 1) } else { (kind, 1) };
            (i, format!("{} {}", kind.name(), count.1))
        })
        .collect()
}

/// Appends `" desc="…` if there is more to say of a line: the chain it comes from, its elevation, the slope that ends there.
fn push_desc(bytes: &mut Vec<u8>, feature: &LineFeature, index: usize) -> Result<(), EncodeError> {
    if let Some(chain) = &feature.chain {
        bytes.extend_from_slice(b"\" desc=\"");
        push_escaped(bytes, chain);
    } else if let Some(elevation) = feature.elevation {
        bytes.extend_from_slice(b"\" desc=\"");
        push_f64(bytes, finite(elevation, "line feature", index + 1)?);
    } else if let Some(part) = feature.part {
        bytes.extend_from_slice(b"\" desc=\"");
        push_escaped(bytes, part.name());
    }
    Ok(())
}

/// Appends a point of the line `index`.
fn push_point(bytes: &mut Vec<u8>, point: DVec3, index: usize) -> Result<(), EncodeError> {
    for value in point.to_array() {
        finite(value, "line feature", index + 1)?;
    }
    push_northing_first(bytes, point.to_array());
    Ok(())
}
