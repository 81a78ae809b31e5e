//! A mesh made ready to be walked about in: ordered, welded, with the neighbour across every edge.

use super::boxes::{Boxes, beyond};
use super::hilbert;
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::kernel::sum::Sum;
use crate::model::Terrain;
use glam::DVec3;

/// No neighbour, no number.
pub(super) const NONE: u32 = u32::MAX;

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
        let mut triangles = by_key(vertices.len(), &kept, |t| t[0].min(t[1]).min(t[2]));
        // Looked at only now, when triangles that follow each other have their corners near each other in memory.
        triangles.retain_mut(|t| {
            let double_area = double_area(t.map(|v| vertices[v as usize]));
            area.add(0.5 * double_area.abs());
            if double_area < 0.0 {
                t.swap(1, 2);
            }
            double_area != 0.0
        });
        Self { vertices, triangles, area: area.value() }
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

/// Stable counting sort of `items` by a key below `keys`.
fn by_key<T: Copy + Default>(keys: usize, items: &[T], key: impl Fn(&T) -> u32) -> Vec<T> {
    let mut next = vec![0_u32; keys + 1];
    for item in items {
        next[key(item) as usize + 1] += 1;
    }
    for k in 0..keys {
        next[k + 1] += next[k];
    }
    let mut sorted = vec![T::default(); items.len()];
    for item in items {
        let slot = &mut next[key(item) as usize];
        sorted[*slot as usize] = *item;
        *slot += 1;
    }
    sorted
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

/// Around a vertex with more edges than this they are sorted before they are matched.
const MANY: usize = 24;

/// Pairs the half-edges that run against each other.
fn opposites(vertices: usize, triangles: &[[u32; 3]]) -> Vec<u32> {
    let ends = |half: u32| {
        let t = triangles[half as usize / 3];
        let e = half as usize % 3;
        (t[e], t[if e == 2 { 0 } else { e + 1 }])
    };
    // By their lesser end: (half-edge, greater end, direction).
    let mut start = vec![0_u32; vertices + 1];
    for t in triangles {
        for e in 0..3 {
            start[t[e].min(t[(e + 1) % 3]) as usize + 1] += 1;
        }
    }
    for v in 0..vertices {
        start[v + 1] += start[v];
    }
    let mut halves = vec![(0_u32, 0_u32); 3 * triangles.len()];
    let mut next = start.clone();
    for half in 0..3 * triangles.len() as u32 {
        let (u, v) = ends(half);
        let slot = &mut next[u.min(v) as usize];
        halves[*slot as usize] = (half, u.max(v));
        *slot += 1;
    }
    let upwards = |half: u32| {
        let (u, v) = ends(half);
        u < v
    };
    let mut opposite = vec![NONE; 3 * triangles.len()];
    for v in 0..vertices {
        let around = &mut halves[start[v] as usize..start[v + 1] as usize];
        if around.len() > MANY {
            around.sort_unstable_by_key(|&(half, far)| (far, half));
        }
        for i in 0..around.len() {
            let (half, far) = around[i];
            if opposite[half as usize] != NONE {
                continue;
            }
            let later = around[i + 1..].iter().take_while(|o| around.len() <= MANY || o.1 == far);
            let partner = later
                .filter(|o| o.1 == far && opposite[o.0 as usize] == NONE)
                .find(|o| upwards(o.0) != upwards(half))
                .map(|o| o.0);
            if let Some(partner) = partner {
                opposite[half as usize] = partner;
                opposite[partner as usize] = half;
            }
        }
    }
    opposite
}
