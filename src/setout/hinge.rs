//! Where a slope leaves the line at a station, and in which directions its rulings leave.

use super::Hand;
use crate::kernel::frame::Frame;
use crate::model::{Chain, Part, Slope};
use glam::{DVec2, DVec3};

/// A hinge point this near a vertex, in plan, is at the vertex.
const AT_VERTEX: f64 = 1e-6;

/// Directions closer than this, in radians, are one: the rulings of a straight line.
const SAME: f64 = 1e-9;

/// A point of the line from which a slope leaves.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Hinge {
    /// The point, in the local frame.
    pub(super) at: DVec3,
    /// Plan direction and gradient of the segment that comes in, of the one that goes out: along the axis, as it ascends.
    pub(super) segments: [Option<(DVec2, f64)>; 2],
}

/// Where the ruling of a hinge point goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ruling {
    /// In a direction of plan, unit; `cone` where it is one of many from a vertex.
    Goes { direction: DVec2, cone: bool },
    /// Nowhere: two strips close up at the vertex, where their crease begins.
    Closed,
}

impl Hinge {
    /// The hinge of a chain that is its own axis: the point of the axis.
    pub(super) fn on_line(chain: &Chain, frame: &Frame, station: f64) -> Option<Self> {
        let stations = chain.stations();
        let count = chain.segment_count();
        let i = stations.partition_point(|s| *s <= station).saturating_sub(1).min(count.checked_sub(1)?);
        let segment = |i: usize| {
            let (a, b) = chain.segment(i);
            (frame.to_local(a), frame.to_local(b))
        };
        let before = if i > 0 { Some(i - 1) } else { chain.closed().then(|| count - 1) };
        let after = if i + 1 < count { Some(i + 1) } else { chain.closed().then_some(0) };
        Some(Self::between(
            segment(i),
            (station - stations[i]) / (stations[i + 1] - stations[i]),
            before.map(segment),
            after.map(segment),
        ))
    }

    /// The hinge of a road: where the perpendicular from the axis point crosses its edge on one side.
    pub(super) fn on_edge(chain: &Chain, frame: &Frame, hand: Hand, point: DVec2, outward: DVec2) -> Option<Self> {
        let axis = chain.axis.as_ref()?;
        // The left edge goes along the axis, the right edge comes back, and the ends lie across.
        let own = |i: usize| {
            let rise = axis.stations.get(i + 1)? - axis.stations.get(i)?;
            let (a, b) = chain.segment(i);
            let (a, b) = (frame.to_local(a), frame.to_local(b));
            match hand {
                Hand::Left => (rise > 0.0).then_some((a, b)),
                Hand::Right => (rise < 0.0).then_some((b, a)),
            }
        };
        let count = chain.segment_count();
        let mut nearest: Option<(f64, f64, usize)> = None;
        for i in 0..count {
            let Some((a, b)) = own(i) else { continue };
            let Some((away, share)) = crossing(point, outward, a.truncate(), b.truncate()) else { continue };
            if nearest.is_none_or(|(least, ..)| away < least - AT_VERTEX) {
                nearest = Some((away, share, i));
            }
        }
        let (_, share, i) = nearest?;
        let (previous, next) = ((i + count - 1) % count, (i + 1) % count);
        // On the right edge the axis runs against the ring.
        let (before, after) = if hand == Hand::Left { (previous, next) } else { (next, previous) };
        Some(Self::between(own(i)?, share, own(before), own(after)))
    }

    /// The point at a share of a segment, with the neighbours of the segment along the axis.
    fn between((a, b): (DVec3, DVec3), share: f64, before: Option<(DVec3, DVec3)>, after: Option<(DVec3, DVec3)>) -> Self {
        let share = share.clamp(0.0, 1.0);
        let length = a.truncate().distance(b.truncate());
        let along = |(a, b): (DVec3, DVec3)| {
            let plan = b.truncate() - a.truncate();
            (plan.normalize_or_zero(), (b.z - a.z) / plan.length())
        };
        let own = Some(along((a, b)));
        let (at, segments) = if share * length <= AT_VERTEX {
            (a, [before.map(along), own])
        } else if (1.0 - share) * length <= AT_VERTEX {
            (b, [own, after.map(along)])
        } else {
            (a.lerp(b, share), [own, own])
        };
        Self { at, segments }
    }

    /// The ruling on one side for a slope of a part; at an end of the line that of its one strip.
    ///
    /// On a segment of gradient `γ` the ruling leaves at the angle `φ`, `sin φ = γ/k`, from the normal: down-grade on falling
    /// slopes, up-grade on rising ones. At a vertex where the rulings of both strips open up it goes half-way between them.
    pub(super) fn ruling(&self, hand: Hand, part: Part, slope: Slope) -> Option<Ruling> {
        let turned = |(along, gradient): (DVec2, f64)| {
            let sine = gradient / slope.ratio() * if part == Part::CutSlope { 1.0 } else { -1.0 };
            (sine.abs() < 1.0).then(|| along * sine + hand.outward(along) * (1.0 - sine * sine).sqrt())
        };
        let [before, after] = self.segments;
        let (first, second) = match (before, after) {
            (Some(a), Some(b)) => (turned(a)?, turned(b)?),
            (Some(a), None) | (None, Some(a)) => (turned(a)?, turned(a)?),
            (None, None) => return None,
        };
        // From the strip before to the strip behind, seen so that opening is positive on either side.
        let turn = first.perp_dot(second).atan2(first.dot(second)) * if hand == Hand::Left { -1.0 } else { 1.0 };
        if turn.abs() <= SAME {
            return Some(Ruling::Goes { direction: first, cone: false });
        }
        if turn < 0.0 {
            return Some(Ruling::Closed);
        }
        let middle = (first + second).normalize_or_zero();
        let direction = if middle == DVec2::ZERO { hand.outward(first) } else { middle };
        Some(Ruling::Goes { direction, cone: true })
    }
}

/// Where a ray crosses a segment, its ends included: distance along the ray, share of the segment.
fn crossing(from: DVec2, direction: DVec2, a: DVec2, b: DVec2) -> Option<(f64, f64)> {
    let edge = b - a;
    let det = direction.perp_dot(edge);
    if det.abs() <= SAME * edge.length() {
        return None;
    }
    let (away, share) = ((a - from).perp_dot(edge) / det, (a - from).perp_dot(direction) / det);
    let slack = AT_VERTEX / edge.length();
    (away >= -AT_VERTEX && (-slack..=1.0 + slack).contains(&share)).then_some((away, share))
}
