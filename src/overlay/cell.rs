//! One cell of the common refinement: a triangle clipped by another.

use super::fabric::double_area;
use glam::DVec3;

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

    /// Whether it is so thin that nothing can be measured in its coordinates: they are right to a few units in the last place of the
    /// square of its longest side, and its area is less than that. Such slivers come from rounding: a side cut twice at nearly the
    /// same place, corners nearly on one line.
    pub(super) fn is_sliver(&self) -> bool {
        let square = |side: DVec3| side.truncate().length_squared();
        let longest = square(self.first).max(square(self.second)).max(square(self.second - self.first));
        self.double_area <= ROUNDING * longest
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

    /// The patch itself, with heights above the plane through `plane`, taken directly at its corners.
    ///
    /// The same as clipping that triangle where the patch lies inside it, but without the rounding that far corners bring.
    pub(super) fn above_plane(&self, plane: [DVec3; 3]) -> Ring {
        let other = Patch::new(plane);
        // Seen from the plane, the height of a point is that of the plane above it: the other way round.
        let [a, b, c] = self.corners.map(|p| -other.corner(p)[HEIGHT] / other.double_area * self.double_area);
        let whole = self.double_area;
        Ring::whole([[0.0, 0.0, whole, a], [whole, 0.0, 0.0, b], [0.0, whole, 0.0, c]])
    }

    /// Point of the patch above a corner.
    pub(super) fn point(&self, c: &Corner) -> DVec3 {
        self.corners[0] + (self.first * c[0] + self.second * c[1]) / self.double_area
    }
}

/// A few units in the last place.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// Longest side of a triangle in plan.
fn longest_side([a, b, c]: &[DVec3; 3]) -> f64 {
    let side = |p: &DVec3, q: &DVec3| p.truncate().distance(q.truncate());
    side(a, b).max(side(b, c)).max(side(c, a))
}

/// Edges of a ring that come from the clipping triangle have this number or a greater one; others that of their edge.
pub(super) const CUT: u8 = 3;

/// Most corners of a ring: three, one more for each of three cuts, and one for the split at height nought.
const MOST: usize = 8;

/// The part of a triangle strictly inside the patch, `None` if there is none. The result is in one of the two rings.
#[inline]
pub(super) fn clip<'r>(triangle: &[Corner; 3], mut ring: &'r mut Ring, mut spare: &'r mut Ring) -> Option<&'r Ring> {
    let [p, q, r] = [outside(&triangle[0]), outside(&triangle[1]), outside(&triangle[2])];
    if p & q & r != 0 {
        return None;
    }
    ring.corners[..3].copy_from_slice(triangle);
    ring.edges[..3].copy_from_slice(&[0, 1, 2]);
    ring.len = 3;
    let planes = p | q | r;
    if planes & 1 != 0 {
        ring.cut::<0>(spare);
        std::mem::swap(&mut ring, &mut spare);
    }
    if planes & 2 != 0 {
        ring.cut::<1>(spare);
        std::mem::swap(&mut ring, &mut spare);
    }
    if planes & 4 != 0 {
        ring.cut::<2>(spare);
        std::mem::swap(&mut ring, &mut spare);
    }
    (ring.len > 0).then_some(ring)
}

/// A convex polygon, counter-clockwise, that knows where its edges come from. Edge `i` runs from corner `i` to the next.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ring {
    len: usize,
    corners: [Corner; MOST],
    edges: [u8; MOST],
}

impl Ring {
    pub(super) const EMPTY: Self = Self { len: 0, corners: [[0.0; 4]; MOST], edges: [0; MOST] };

    /// A whole triangle.
    pub(super) fn whole(triangle: [Corner; 3]) -> Self {
        let mut ring = Self::EMPTY;
        ring.corners[..3].copy_from_slice(&triangle);
        ring.edges[..3].copy_from_slice(&[0, 1, 2]);
        ring.len = 3;
        ring
    }

    /// Whether this is more than the sliver that rounding may leave where the patch and `other` only touch: corners are right to
    /// a few units in the last place of the larger triangle, along a side of either.
    pub(super) fn has_area(&self, patch: &Patch, other: &[DVec3; 3]) -> bool {
        let [own, other] = [&patch.corners, other].map(longest_side);
        self.measure().0 / patch.double_area > ROUNDING * own * other
    }

    /// The part where coordinate `K` is positive.
    ///
    /// Without branches on signs, which nothing can predict: every corner is written, and what does not belong is written over by
    /// the next. Crossings come second, into the places left for them: of a convex ring there are two.
    #[inline]
    fn cut<const K: usize>(&self, out: &mut Self) {
        // Never reached by more than `MOST` corners; the mask is cheaper than a check.
        const ROOM: usize = MOST - 1;
        let next = |i: usize| if i + 1 == self.len { 0 } else { (i + 1) & ROOM };
        let mut places = [0_u8; MOST];
        let mut changes = 0_u32;
        let mut len = 0;
        for (i, place) in places.iter_mut().enumerate().take(self.len) {
            let (stays, comes) = (self.corners[i][K] > 0.0, self.corners[next(i)][K] > 0.0);
            out.corners[len & ROOM] = self.corners[i];
            out.edges[len & ROOM] = self.edges[i];
            len += usize::from(stays);
            *place = (len & ROOM) as u8;
            out.edges[len & ROOM] = if stays { CUT + K as u8 } else { self.edges[i] };
            len += usize::from(stays != comes);
            changes |= u32::from(stays != comes) << i;
        }
        while changes != 0 {
            let i = changes.trailing_zeros() as usize & ROOM;
            out.corners[usize::from(places[i]) & ROOM] = crossing::<K>(&self.corners[i], &self.corners[next(i)]);
            changes &= changes - 1;
        }
        out.len = len;
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

/// Where coordinate `K` is nought between two corners of opposite sign. The same to the last bit from both ends of an edge, and
/// exactly a corner where `K` is nought there; for corners of one sign the result means nothing.
#[inline]
fn crossing<const K: usize>(here: &Corner, next: &Corner) -> Corner {
    let (a, b) = (next[K] / (next[K] - here[K]), here[K] / (here[K] - next[K]));
    let mut c = [0.0; 4];
    for i in 0..4 {
        c[i] = here[i] * a + next[i] * b;
    }
    c[K] = 0.0;
    c
}
