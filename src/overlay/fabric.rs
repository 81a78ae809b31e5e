//! A mesh made ready to be walked about in: ordered, welded, with the neighbour across every edge.

use super::boxes::{Boxes, beyond};
use super::hilbert;
use crate::kernel::buckets::Buckets;
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::kernel::sum::Sum;
use crate::mesh::neighbours::{NONE, opposites};
use crate::model::Terrain;
use glam::DVec3;

/// Marks a vertex that a triangle uses, beside the bits of [`beyond`].
const USED: u8 = 1 << 4;

/// Triangles in an order in which those that follow each other lie near each other.
///
/// Half-edge `3t + e` runs from corner `e` of triangle `t` to the next one.
#[derive(Debug, Default)]
pub(super) struct Fabric {
    pub(super) vertices: Vec<DVec3>,
    /// Counter-clockwise in plan, and not without area.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Plan area of all triangles given, also of those left out.
    pub(super) area: f64,
    /// Plan area of the triangles.
    pub(super) kept: f64,
}

impl Fabric {
    /// The triangles of `mesh` that may meet `keep`, in `frame`. Vertices with the same coordinates become one; triangles
    /// without plan area are left out, clockwise ones turned.
    pub(super) fn new(mesh: &Terrain, frame: Frame, keep: &PlanBox) -> Self {
        let same = mesh.frame == frame;
        let place = |v: &DVec3| if same { *v } else { frame.to_local(mesh.frame.to_world(*v)) };
        let points: Vec<DVec3> = mesh.vertices.iter().map(place).collect();
        let mut sides: Vec<u8> = points.iter().map(|p| beyond(keep, p.truncate())).collect();
        let mut area = Sum::default();
        let mut kept = Vec::with_capacity(mesh.triangles.len());
        for t in &mesh.triangles {
            let [a, b, c] = t.map(|v| sides[v as usize]);
            if a & b & c & !USED == 0 {
                t.iter().for_each(|&v| sides[v as usize] |= USED);
                kept.push(*t);
            } else {
                area.add(0.5 * double_area(t.map(|v| points[v as usize])).abs());
            }
        }
        let mut order: Vec<u32> = (0..points.len() as u32).filter(|&v| sides[v as usize] & USED != 0).collect();
        hilbert::sort(&points, &mut order);
        let mut rank = vec![NONE; points.len()];
        let mut vertices: Vec<DVec3> = Vec::with_capacity(order.len());
        for v in order {
            let p = points[v as usize];
            if vertices.last() != Some(&p) {
                vertices.push(p);
            }
            rank[v as usize] = vertices.len() as u32 - 1;
        }
        for t in &mut kept {
            *t = t.map(|v| rank[v as usize]);
        }
        let mut own = Sum::default();
        let lowest = |t: &[u32; 3]| t[0].min(t[1]).min(t[2]);
        let mut triangles = Buckets::new(vertices.len(), kept.iter().map(|t| (lowest(t), *t))).into_things();
        // Looked at only now, when triangles that follow each other have their corners near each other in memory.
        triangles.retain_mut(|t| {
            let double_area = double_area(t.map(|v| vertices[v as usize]));
            own.add(0.5 * double_area.abs());
            if double_area < 0.0 {
                t.swap(1, 2);
            }
            double_area != 0.0
        });
        area.join(own);
        Self { vertices, triangles, area: area.value(), kept: own.value() }
    }

    #[inline]
    pub(super) fn corners(&self, t: u32) -> [DVec3; 3] {
        self.triangles[t as usize].map(|v| self.vertices[v as usize])
    }

    /// Box of all of it.
    pub(super) fn whole(&self) -> PlanBox {
        PlanBox::of(self.vertices.iter().map(|v| v.truncate()))
    }

    #[inline]
    pub(super) fn bounds(&self, t: u32) -> PlanBox {
        PlanBox::of(self.corners(t).map(DVec3::truncate))
    }
}

/// Twice the plan area, positive counter-clockwise.
#[inline]
pub(super) fn double_area([a, b, c]: [DVec3; 3]) -> f64 {
    (b - a).truncate().perp_dot((c - a).truncate())
}

/// A fabric with its neighbours and the means to find a triangle.
#[derive(Debug)]
pub(super) struct Linked<'a> {
    pub(super) fabric: &'a Fabric,
    /// The half-edge on the other side of each, [`NONE`] on the rim.
    pub(super) opposite: Vec<u32>,
    /// All triangles.
    pub(super) boxes: Boxes,
    /// Triangles with an edge on the rim, ascending.
    pub(super) rim: Vec<u32>,
    pub(super) rim_boxes: Boxes,
}

impl<'a> Linked<'a> {
    /// Links the triangles of a fabric. Edges with more than two triangles count as rim beyond the first pair.
    pub(super) fn new(fabric: &'a Fabric) -> Self {
        let opposite = opposites(fabric.vertices.len(), &fabric.triangles);
        let count = fabric.triangles.len();
        let rim: Vec<u32> = (0..count as u32).filter(|&t| opposite[3 * t as usize..3 * t as usize + 3].contains(&NONE)).collect();
        let boxes = Boxes::new(count, |t| fabric.bounds(t as u32));
        let rim_boxes = Boxes::new(rim.len(), |i| fabric.bounds(rim[i]));
        Self { fabric, opposite, boxes, rim, rim_boxes }
    }
}
