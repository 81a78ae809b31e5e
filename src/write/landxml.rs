//! LandXML 1.2.
//!
//! Reference: the schema `LandXML-1.2.xsd`, <http://www.landxml.org/schema/LandXML-1.2/LandXML-1.2.xsd>. Points are northing,
//! easting, elevation.

mod lines;
mod parts;

use self::lines::breaklines;
use self::parts::{push_escaped, push_northing_first, start, volumes};
use super::number::{push_f64, push_u64};
use super::obj::{finite_vertex, flush_if_full};
use super::{EncodeError, Head};
use crate::kernel::range::range;
use crate::kernel::sum::Sum;
use crate::mesh::{check::HalfEdges, polygon, volume::MeshAreas};
use crate::model::Tin;
use glam::DVec3;
use std::io::Write;

pub use self::lines::write_landxml_lines;

/// Writes a mesh as a TIN surface in world coordinates, with the shortest digits that read back to the same bits, vertices
/// numbered from 1. As its source data the edges of the mesh that mean something (hinge, breaklines, ridges, valleys, daylight
/// line) as standard breaklines, and its outline: counter-clockwise loops as outer boundaries, the others as voids. Where
/// [`Head::earthworks`] are known also the volumes against the ground, of the method `composite`; their total is cut − fill.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a vertex or a line with a coordinate that is no number.
pub fn write_landxml(out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
    let mut bytes = start(head);
    bytes.extend_from_slice(b"<Surfaces>\n<Surface name=\"");
    push_escaped(&mut bytes, head.name);
    bytes.extend_from_slice(b"\">\n<SourceData>\n");
    boundaries(out, &mut bytes, tin)?;
    breaklines(out, &mut bytes, head)?;
    bytes.extend_from_slice(b"</SourceData>\n");
    definition(out, &mut bytes, tin)?;
    bytes.extend_from_slice(b"</Surface>\n");
    if let Some(earthworks) = head.earthworks {
        volumes(&mut bytes, &earthworks, head.name)?;
    }
    bytes.extend_from_slice(b"</Surfaces>\n</LandXML>\n");
    out.write_all(&bytes)?;
    Ok(())
}

/// The outline of the mesh.
fn boundaries(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>, tin: &Tin) -> Result<(), EncodeError> {
    let open = HalfEdges::new(tin.vertices.len(), &tin.triangles).open();
    let (loops, _) = polygon::loops(&open);
    if loops.is_empty() {
        return Ok(());
    }
    bytes.extend_from_slice(b"<Boundaries>\n");
    for ring in loops {
        let first = tin.vertices[ring[0] as usize].truncate();
        let mut twice = Sum::default();
        for (i, &v) in ring.iter().enumerate() {
            let next = ring[(i + 1) % ring.len()];
            let [a, b] = [v, next].map(|v| tin.vertices[v as usize].truncate() - first);
            twice.add(a.perp_dot(b));
        }
        let kind: &[u8] = if twice.value() > 0.0 { b"outer" } else { b"void" };
        bytes.extend_from_slice(b"<Boundary bndType=\"");
        bytes.extend_from_slice(kind);
        bytes.extend_from_slice(b"\" edgeTrim=\"false\"><PntList3D>");
        for (i, &v) in ring.iter().chain(&ring[..1]).enumerate() {
            if i > 0 {
                bytes.push(b' ');
            }
            push_northing_first(bytes, finite_vertex(tin, v as usize, DVec3::ZERO)?);
            flush_if_full(out, bytes)?;
        }
        bytes.extend_from_slice(b"</PntList3D></Boundary>\n");
    }
    bytes.extend_from_slice(b"</Boundaries>\n");
    Ok(())
}

/// Points and faces, with the figures by which a reader can check them.
fn definition(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>, tin: &Tin) -> Result<(), EncodeError> {
    let triangles = || (0..tin.triangles.len()).map(|t| tin.corners(t));
    let areas = MeshAreas::of(triangles());
    let (low, high) = range(triangles().flatten().map(|p| p.z));
    bytes.extend_from_slice(b"<Definition surfType=\"TIN");
    let figures = [("area2DSurf", areas.plan()), ("area3DSurf", areas.surface()), ("elevMin", low), ("elevMax", high)];
    // Infinite for a mesh without triangles, and for heights whose squares are: then left out.
    for (key, value) in figures.into_iter().filter(|(_, value)| value.is_finite()) {
        bytes.extend_from_slice(format!("\" {key}=\"").as_bytes());
        push_f64(bytes, value);
    }
    bytes.extend_from_slice(b"\">\n<Pnts>\n");
    for i in 0..tin.vertices.len() {
        bytes.extend_from_slice(b"<P id=\"");
        push_u64(bytes, i as u64 + 1);
        bytes.extend_from_slice(b"\">");
        push_northing_first(bytes, finite_vertex(tin, i, DVec3::ZERO)?);
        bytes.extend_from_slice(b"</P>\n");
        flush_if_full(out, bytes)?;
    }
    bytes.extend_from_slice(b"</Pnts>\n<Faces>\n");
    for triangle in &tin.triangles {
        bytes.extend_from_slice(b"<F>");
        for (k, &corner) in triangle.iter().enumerate() {
            if k > 0 {
                bytes.push(b' ');
            }
            push_u64(bytes, u64::from(corner) + 1);
        }
        bytes.extend_from_slice(b"</F>\n");
        flush_if_full(out, bytes)?;
    }
    bytes.extend_from_slice(b"</Faces>\n</Definition>\n");
    Ok(())
}

#[cfg(test)]
mod tests;
