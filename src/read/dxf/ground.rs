//! Faces and points of a drawing → raw ground.

use super::layers::LayerId;
use super::names::counted;
use super::walk::{Placed, Shape};
use crate::model::Note;
use crate::read::ReadError;
use crate::read::error::refuse;
use crate::read::terrain::{Faces, RawGround};
use glam::DVec3;
use rustc_hash::FxHashMap;

/// Collects faces and points. Faces of drawings have corners of their own: those with the same coordinates become one vertex.
pub(super) struct Ground<'l> {
    label: &'l str,
    vertices: Vec<DVec3>,
    at: FxHashMap<[u64; 3], u32>,
    faces: Faces,
    /// Layer of each face.
    layers: Vec<LayerId>,
    points: Vec<DVec3>,
}

impl<'l> Ground<'l> {
    pub(super) fn new(label: &'l str) -> Self {
        let (vertices, points) = (Vec::new(), Vec::new());
        Self { label, vertices, at: FxHashMap::default(), faces: Faces::with_capacity(0), layers: Vec::new(), points }
    }

    pub(super) fn take(&mut self, placed: Placed) -> Result<(), ReadError> {
        let Placed { shape, system, place, layer } = placed;
        let world = |p: DVec3| system.map_or(p, |system| system.transform_point3(p));
        let finite = |p: &DVec3| p.is_finite();
        let sound = match shape {
            Shape::Face(corners) => {
                let corners = corners.map(world);
                let sound = corners.iter().all(finite);
                if sound {
                    let corners = corners.map(|corner| self.vertex(corner));
                    self.face(corners, layer);
                }
                sound
            }
            Shape::Mesh(points, faces) => {
                let points: Vec<DVec3> = points.into_iter().map(world).collect();
                let sound = points.iter().all(finite);
                if sound {
                    let numbers: Vec<u32> = points.into_iter().map(|point| self.vertex(point)).collect();
                    for face in faces {
                        self.face(face.map(|corner| numbers.get(corner as usize).copied().unwrap_or(0)), layer);
                    }
                }
                sound
            }
            Shape::Point(point) => {
                self.points.push(world(point));
                self.points.last().is_some_and(finite)
            }
            Shape::Polyline(_) | Shape::Arc(_) | Shape::Segment(_) => true,
        };
        if !sound {
            let figures = "the numbers of the block and of its insert are too great together";
            return Err(refuse("a coordinate of the drawing is not finite", place.of(self.label), figures, "correct the insert"));
        }
        if u32::try_from(self.vertices.len()).is_err() {
            let figures = self.vertices.len().to_string();
            return Err(refuse("the drawing has too many vertices", self.label, figures, "cut the ground down to the site"));
        }
        Ok(())
    }

    fn vertex(&mut self, at: DVec3) -> u32 {
        // Zero has two signs.
        let at = at + 0.0;
        *self.at.entry(at.to_array().map(f64::to_bits)).or_insert_with(|| {
            self.vertices.push(at);
            (self.vertices.len() - 1) as u32
        })
    }

    /// Corners one after the other that are the same count as one; what has then fewer than three has no area.
    fn face(&mut self, [a, b, c, d]: [u32; 4], layer: LayerId) {
        self.layers.push(layer);
        match (a == b, b == c, c == d || d == a) {
            (false, false, false) => self.faces.polygon(&[a, b, c, d]),
            (true, _, _) => self.faces.triangle([a, c, d]),
            (_, true, _) => self.faces.triangle([a, b, d]),
            (_, _, true) => self.faces.triangle([a, b, c]),
        }
    }

    /// Layers of the faces, in their order.
    pub(super) fn layers(&mut self) -> Vec<LayerId> {
        std::mem::take(&mut self.layers)
    }

    /// The ground: the faces, or the points if there are none. `None` if there is neither.
    pub(super) fn finish(self, notes: &mut Vec<Note>) -> Option<RawGround> {
        drop(self.at);
        let heights = if self.faces.len() > 0 { &self.vertices } else { &self.points };
        if !heights.is_empty() && heights.iter().all(|v| v.z == 0.0) {
            notes.push(Note::new("dxf-zero", "all vertices of the ground are at the elevation 0"));
        }
        if self.faces.len() == 0 {
            return (!self.points.is_empty()).then_some(RawGround::Points(self.points));
        }
        if !self.points.is_empty() {
            let message =
                format!("passed over {}: the ground is made of the faces", counted(self.points.len(), "POINT", "POINTs"));
            notes.push(Note::new("dxf-points-ignored", message));
        }
        Some(RawGround::Mesh { vertices: self.vertices, faces: self.faces.finish() })
    }
}
