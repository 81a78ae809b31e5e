//! Raw ground → a checked TIN: points are triangulated, faces turned up, defects told with their places.
//!
//! [`prepare`] does what every ground needs, in a few passes over the whole; [`inspect()`] looks at how triangles lie together,
//! which is worth its time only for the part of the ground near the works.

mod coordinates;
mod corners;
mod faces;
mod inspect;
mod overlap;
mod place;
mod points;
mod polygons;
mod spikes;
mod upright;
mod weld;

pub use inspect::{Findings, inspect};
pub use overlap::check_overlap;
pub use polygons::one as split_polygon;

use crate::kernel::frame::Frame;
use crate::model::{Defects, Note, Terrain};
use crate::read::terrain::{RawFaces, RawGround, RawTerrain};
use coordinates::Coordinates;
use corners::Corners;
use glam::DVec3;
use rayon::prelude::*;

/// Ground ready for use, and what was done to it on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Prepared {
    /// The ground.
    pub terrain: Terrain,
    /// What was turned, dropped, merged or noticed.
    pub notes: Vec<Note>,
}

/// Makes a TIN of ground as read: points are triangulated (Delaunay), cells and polygons split, given triangles kept.
///
/// Clockwise triangles are turned; those without area and repetitions are dropped; triangles that meet in vertices of the same
/// coordinates get common vertices. All of it is counted in notes. Vertices stay as they are, in their order, also those no
/// triangle uses. Exact in all its decisions; the coordinates are those of the file.
///
/// # Errors
/// All defects found: degrees, coordinates beyond [`crate::validate::INPUT_LIMIT`], vertical faces, Y-up, polygons that cross
/// themselves, too few points.
pub fn prepare(raw: RawTerrain) -> Result<Prepared, Defects> {
    let RawTerrain { source, ground, mut notes } = raw;
    let (mut vertices, mut triangles) = match ground {
        RawGround::Mesh { vertices, faces } => {
            let triangles = match faces {
                RawFaces::Triangles(triangles) => triangles,
                RawFaces::Polygons { corners, ends } => polygons::split(&source.label, &vertices, &corners, &ends, &mut notes)?,
            };
            (vertices, Some(triangles))
        }
        RawGround::Points(points) => (points, None),
        RawGround::Grid(grid) => {
            let (vertices, triangles) = points::grid(&source.label, &grid, &mut notes)?;
            (vertices, Some(triangles))
        }
    };
    let seen = triangles.as_mut().map(|triangles| {
        let turned = faces::turn_up(&vertices, triangles);
        (Corners::new(&vertices, triangles), turned)
    });
    let of_points = if seen.is_none() { Coordinates::new(&vertices) } else { Coordinates::default() };
    let coordinates = seen.as_ref().map_or(&of_points, |(corners, _)| &corners.coordinates);
    let mut defects = Defects::default();
    coordinates.check(&vertices, &source, &mut defects, &mut notes);
    defects.into_result()?;
    let frame = Frame::around(coordinates.lo.truncate(), coordinates.hi.truncate());
    if frame != Frame::WORLD {
        vertices.par_iter_mut().for_each(|v| *v = frame.to_local(*v));
    }
    let mut terrain = Terrain { frame, vertices, triangles: Vec::new() };
    terrain.triangles = match (triangles, seen) {
        (Some(mut triangles), Some((mut corners, turned))) => {
            unused(terrain.vertices.len(), corners.unused, &mut notes);
            if weld::weld(&terrain.vertices, &corners.border, &mut triangles, &mut notes) {
                corners.suspects = Corners::new(&terrain.vertices, &triangles).suspects;
            }
            faces::check(&source.label, &corners, &terrain, triangles, &turned, &mut notes)?
        }
        _ => points::triangulate(&source.label, &mut terrain, &mut notes)?,
    };
    if terrain.triangles.is_empty() {
        return Err(place::nothing_left(&source.label));
    }
    Ok(Prepared { terrain, notes })
}

/// Tells of the vertices no triangle uses in the file.
fn unused(count: usize, unused: usize, notes: &mut Vec<Note>) {
    if unused > 0 {
        let message = format!("{unused} of {count} vertices of the ground belong to no triangle");
        notes.push(Note::new("ground-vertices-unused", message));
    }
}

/// Corner of a triangle as a point.
fn at(vertices: &[DVec3], v: u32) -> DVec3 {
    vertices[v as usize]
}
