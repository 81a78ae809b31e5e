//! One cell of the common refinement: a triangle clipped by another.

use super::fabric::double_area;
use glam::{DVec2, DVec3};

/// A point in the coordinates of a [`Patch`]: three that are positive inside and add up to its double area, and the height of the
/// patch above the other mesh, times the double area. All four are linear in plan.
pub(super) type Corner = [f64; 4];

/// Index of the height in a corner.
pub(super) const HEIGHT: usize = 3;

/// The triangle that clips, and its coordinates. Its corners have coordinates that are exact, also when they are corners of the
/// other mesh; so surfaces that share them have heights of exactly nought there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Patch {
    pub(super) corners: [DVec3; 3],
    first: DVec3,
    second: DVec3,
    /// Twice the plan area; positive.
    pub(super) double_area: f64,
}

impl Patch {
    /// A patch; its triangle must be counter-clockwise.
    pub(super) fn new(corners: [DVec3; 3]) -> Self {
        let [a, b, c] = corners;
        Self { corners, first: b - a, second: c - a, double_area: double_area(corners) }
    }

    /// A point of the other mesh in the coordinates of the patch.
    #[inline]
    pub(super) fn corner(&self, p: DVec3) -> Corner {
        let from = p - self.corners[0];
        let plan = from.truncate();
        let s = plan.perp_dot(self.second.truncate());
        let t = self.first.truncate().perp_dot(plan);
        [s, t, self.double_area - s - t, s * self.first.z + t * self.second.z - from.z * self.double_area]
    }


    /// Point of the patch above a corner.
    pub(super) fn point(&self, c: &Corner) -> DVec3 {
        self.corners[0] + (self.first * c[0] + self.second * c[1]) / self.double_area
    }
}

/// Edges of a ring that come from the clipping triangle have this number or a greater one; others that of their edge.
pub(super) const CUT: u8 = 3;

/// Most corners of a ring: three, one more for each of three cuts, and one for the split at height nought.
const MOST: usize = 8;

/// A convex polygon, counter-clockwise, that knows where its edges come from. Edge `i` runs from corner `i` to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    len: usize,
    corners: [Corner; MOST],
    edges: [u8; MOST],
}

impl Ring {
    pub(super) const EMPTY: Self = Self { len: 0, corners: [[0.0; 4]; MOST], edges: [0; MOST] };

    /// The part of a triangle strictly inside the patch; `false` if there is none. `self` is the result, `spare` scratch.
    #[inline]
    pub(super) fn clip(&mut self, triangle: &[Corner; 3], spare: &mut Self) -> bool {
        let [p, q, r] = triangle.map(|c| outside(&c));
        if p & q & r != 0 {
            return false;
        }
        self.corners[..3].copy_from_slice(triangle);
        self.edges[..3].copy_from_slice(&[0, 1, 2]);
        self.len = 3;
        let planes = p | q | r;
        if planes & 1 != 0 {
            self.cut::<0>(spare);
            *self = *spare;
        }
        if planes & 2 != 0 {
            self.cut::<1>(spare);
            *self = *spare;
        }
        if planes & 4 != 0 {
            self.cut::<2>(spare);
            *self = *spare;
        }
        self.len > 0
    }

    /// The part where coordinate `K` is positive.
    #[inline]
    fn cut<const K: usize>(&self, out: &mut Self) {
        out.len = 0;
        for i in 0..self.len {
            let (here, next) = (&self.corners[i], &self.corners[if i + 1 == self.len { 0 } else { i + 1 }]);
            if here[K] > 0.0 {
                out.push(*here, self.edges[i]);
                if next[K] <= 0.0 {
                    out.push(crossing::<K>(here, next), CUT + K as u8);
                }
            } else if next[K] > 0.0 {
                out.push(crossing::<K>(next, here), self.edges[i]);
            }
        }
    }

    #[inline]
    fn push(&mut self, corner: Corner, edge: u8) {
        // There is always room, see `MOST`; what cannot happen must not be a panic.
        if self.len < MOST {
            self.corners[self.len] = corner;
            self.edges[self.len] = edge;
            self.len += 1;
        }
    }

    /// The part where the height is positive.
    pub(super) fn above(&self, out: &mut Self) {
        self.cut::<HEIGHT>(out);
    }

    /// The same with all heights reversed.
    pub(super) fn mirrored(&self) -> Self {
        let mut ring = *self;
        ring.corners.iter_mut().for_each(|c| c[HEIGHT] = -c[HEIGHT]);
        ring
    }

    /// Replaces the heights.
    pub(super) fn with_heights(&mut self, of: impl Fn(&Corner) -> f64) {
        for c in &mut self.corners[..self.len] {
            c[HEIGHT] = of(c);
        }
    }

    pub(super) fn corners(&self) -> &[Corner] {
        &self.corners[..self.len]
    }

    /// Where the edges come from.
    pub(super) fn edges(&self) -> &[u8] {
        &self.edges[..self.len]
    }

    /// Twice the area, and six times the integral of the height, in the coordinates of the patch.
    #[inline]
    pub(super) fn measure(&self) -> (f64, f64) {
        let corners = self.corners();
        let (mut area, mut volume) = (0.0, 0.0);
        if let Some((o, rest)) = corners.split_first() {
            for pair in rest.windows(2) {
                let (p, q) = (&pair[0], &pair[1]);
                let cross = (p[0] - o[0]) * (q[1] - o[1]) - (p[1] - o[1]) * (q[0] - o[0]);
                area += cross;
                volume += cross * (o[HEIGHT] + p[HEIGHT] + q[HEIGHT]);
            }
        }
        (area, volume)
    }
}

/// Bits of the coordinates that are not positive.
#[inline]
fn outside(c: &Corner) -> u8 {
    u8::from(c[0] <= 0.0) | u8::from(c[1] <= 0.0) << 1 | u8::from(c[2] <= 0.0) << 2
}

/// Where coordinate `K` is nought between a corner inside and one outside. The same from both sides of an edge.
#[inline]
fn crossing<const K: usize>(inside: &Corner, outside: &Corner) -> Corner {
    let share = inside[K] / (inside[K] - outside[K]);
    let mut c = [0.0; 4];
    for i in 0..4 {
        c[i] = inside[i] + (outside[i] - inside[i]) * share;
    }
    c[K] = 0.0;
    c
}
