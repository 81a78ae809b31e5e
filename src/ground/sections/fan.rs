//! Which sections cross a piece: a tree over the planes of an axis, each without end.

use super::chord::ON_PLANE;
use crate::ground::Corner;
use crate::kernel::plan_box::PlanBox;
use glam::DVec2;

/// The vertical plane of a section.
#[derive(Clone, Copy, Debug)]
pub(super) struct Plane {
    /// Its point on the axis.
    pub(super) point: DVec2,
    /// Direction of the axis there, perpendicular to the plane; unit length.
    pub(super) along: DVec2,
    /// Station of the point.
    pub(super) station: f64,
}

impl Plane {
    /// Offset of a point from the axis, positive to the left, and its distance ahead of the plane.
    pub(super) fn split(&self, p: DVec2) -> (f64, f64) {
        let d = p - self.point;
        (self.along.perp_dot(d), self.along.dot(d))
    }
}

/// A run of neighbouring planes: their points within `radius` of `centre`, their directions within `spread` of `along`.
#[derive(Clone, Copy, Debug, Default)]
struct Run {
    centre: DVec2,
    radius: f64,
    along: DVec2,
    spread: f64,
}

impl Run {
    fn of(planes: &[Plane]) -> Self {
        let PlanBox { lo, hi } = PlanBox::of(planes.iter().map(|plane| plane.point));
        let centre = 0.5 * (lo + hi);
        let along = planes.iter().map(|plane| plane.along).sum::<DVec2>().normalize_or_zero();
        let most = |of: fn(&Plane) -> DVec2, from: DVec2| planes.iter().map(|p| of(p).distance(from)).fold(0.0, f64::max);
        Self { centre, radius: most(|plane| plane.point, centre), along, spread: most(|plane| plane.along, along) }
    }

    /// Whether one of the planes may come within `radius` of a point: `(c − pᵢ)·uᵢ` differs from `(c − p)·u` by no more than
    /// `|p − pᵢ| + |c − p| |u − uᵢ|`.
    fn may_meet(&self, centre: DVec2, radius: f64) -> bool {
        let d = centre - self.centre;
        d.dot(self.along).abs() <= radius + self.radius + d.length() * self.spread
    }
}

/// Planes of a leaf.
const LEAF: usize = 4;

/// The planes of one axis, in the order of their stations: neighbours have points close by and almost one direction, so a run of
/// them can be passed over at once, however far the planes reach.
#[derive(Debug)]
pub(super) struct Fan {
    planes: Vec<Plane>,
    /// Node `k` has the children `2k` and `2k + 1`; the leaves are the second half.
    nodes: Vec<Run>,
}

impl Fan {
    pub(super) fn new(planes: Vec<Plane>) -> Self {
        let leaves = planes.len().div_ceil(LEAF).next_power_of_two();
        let mut nodes = vec![Run::default(); 2 * leaves];
        let (mut size, mut first) = (LEAF, leaves);
        while first > 0 {
            for (i, run) in planes.chunks(size).enumerate() {
                nodes[first + i] = Run::of(run);
            }
            (size, first) = (2 * size, first / 2);
        }
        Self { planes, nodes }
    }

    pub(super) fn planes(&self) -> &[Plane] {
        &self.planes
    }

    /// Calls `visit` for every plane that may cross the polygon, and for few others.
    pub(super) fn near(&self, corners: &[Corner], mut visit: impl FnMut(usize, &Plane)) {
        let PlanBox { lo, hi } = PlanBox::of(corners.iter().map(|corner| corner.at));
        let centre = 0.5 * (lo + hi);
        let radius = 0.5 * lo.distance(hi) + 2.0 * ON_PLANE;
        let leaves = self.nodes.len() / 2;
        // Depth first: at most one node waits on each level, and there are fewer than 32 levels.
        let (mut stack, mut waiting) = ([1_usize; 64], 1);
        while waiting > 0 {
            waiting -= 1;
            let k = stack[waiting];
            let first = if k < leaves { 0 } else { (k - leaves) * LEAF };
            if first >= self.planes.len() || !self.nodes[k].may_meet(centre, radius) {
                continue;
            }
            if k < leaves {
                stack[waiting] = 2 * k + 1;
                stack[waiting + 1] = 2 * k;
                waiting += 2;
                continue;
            }
            let last = (first + LEAF).min(self.planes.len());
            for (i, plane) in self.planes[first..last].iter().enumerate() {
                if plane.split(centre).1.abs() <= radius {
                    visit(first + i, plane);
                }
            }
        }
    }
}
