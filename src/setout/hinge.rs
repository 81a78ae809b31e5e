//! Where a slope leaves the line at a station, and in which directions its rulings leave.

use super::{Hand, STRIP_RATE};
use crate::ground::{Axis, Spot};
use crate::kernel::box_tree::BoxTree;
use crate::kernel::frame::Frame;
use crate::kernel::plan_box::PlanBox;
use crate::kernel::segment;
use crate::model::{Chain, CurveKind, LineFeature, Part, Slope};
use glam::{DVec2, DVec3};

/// A hinge point this near a vertex, in plan, is at the vertex; and one this near the given line is on it.
const AT_VERTEX: f64 = 1e-6;

/// Sine of the angle between an edge and a ray that does not cross it.
const PARALLEL: f64 = 1e-9;

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

/// Where the hinges of a chain are: on the chain itself, or on the edges of a road.
pub(super) enum Edges {
    /// The chain is its own axis.
    Line(Vec<(DVec3, DVec3)>),
    /// The left and the right edge.
    Road([Edge; 2]),
}

/// One edge of a road.
pub(super) struct Edge {
    /// All segments of the ring; along the axis those of this edge, `None` the others.
    segments: Vec<Option<(DVec3, DVec3)>>,
    hand: Hand,
    tree: BoxTree,
}

impl Edges {
    pub(super) fn of(chain: &Chain, frame: &Frame) -> Self {
        let segments = (0..chain.segment_count()).map(|i| {
            let (a, b) = chain.segment(i);
            (frame.to_local(a), frame.to_local(b))
        });
        let Some(axis) = &chain.axis else { return Self::Line(segments.collect()) };
        let segments: Vec<_> = segments.collect();
        Self::Road([Hand::Left, Hand::Right].map(|hand| {
            // The left edge goes along the axis, the right edge comes back, and the ends lie across.
            let own = |(i, &(a, b)): (usize, &(DVec3, DVec3))| {
                let rise = axis.stations.get(i + 1)? - axis.stations.get(i)?;
                match hand {
                    Hand::Left => (rise > 0.0).then_some((a, b)),
                    Hand::Right => (rise < 0.0).then_some((b, a)),
                }
            };
            let segments: Vec<_> = segments.iter().enumerate().map(own).collect();
            let boxed = |(one, i): (&Option<(DVec3, DVec3)>, u32)| Some((i, plan_box((*one)?)));
            let tree = BoxTree::new(&segments.iter().zip(0..).filter_map(boxed).collect::<Vec<_>>());
            Edge { segments, hand, tree }
        }))
    }

    /// The hinge at a station of the given line: `point` is that of the axis there, `outward` the normal, and edges of roads are
    /// looked for no farther than `far`.
    pub(super) fn hinge(
        &self,
        axis: &Axis,
        station: f64,
        hand: Hand,
        (point, outward): (DVec2, DVec2),
        far: f64,
    ) -> Option<Hinge> {
        match self {
            Self::Line(segments) => {
                let spot = Spot::of(axis, station)?;
                let segment = |i: usize| segments.get(i).copied();
                let (a, b) = segment(spot.segment)?;
                let at = if spot.share == 1.0 { b } else { a.lerp(b, spot.share) };
                Some(Hinge { at, segments: spot.segments.map(|i| i.and_then(segment).map(along)) })
            }
            Self::Road(edges) => edges.iter().find(|edge| edge.hand == hand)?.crossed(point, outward, far),
        }
    }
}

impl Edge {
    /// Where the perpendicular from an axis point crosses the edge.
    fn crossed(&self, point: DVec2, outward: DVec2, far: f64) -> Option<Hinge> {
        let (_, share, i) = super::in_steps(far, |reach| {
            let mut near = Vec::new();
            self.tree.meeting(&grown(PlanBox::of([point, point + outward * reach]), AT_VERTEX), |i| near.push(i as usize));
            near.sort_unstable();
            let mut nearest: Option<(f64, f64, usize)> = None;
            for i in near {
                let Some((a, b)) = self.segments[i] else { continue };
                let Some((away, share)) = crossing(point, outward, a.truncate(), b.truncate()) else { continue };
                if nearest.is_none_or(|(least, ..)| away < least - AT_VERTEX) {
                    nearest = Some((away, share, i));
                }
            }
            // What lies farther away may have company that was not looked at.
            nearest.filter(|(away, ..)| *away < reach)
        })?;
        let count = self.segments.len();
        let (previous, next) = ((i + count - 1) % count, (i + 1) % count);
        // On the right edge the axis runs against the ring.
        let (before, after) = if self.hand == Hand::Left { (previous, next) } else { (next, previous) };
        let own = self.segments[i]?;
        let [before, after] = [before, after].map(|i| self.segments[i].map(along));
        let (a, b) = own;
        let share = share.clamp(0.0, 1.0);
        let length = a.truncate().distance(b.truncate());
        let own = Some(along(own));
        Some(if share * length <= AT_VERTEX {
            Hinge { at: a, segments: [before, own] }
        } else if (1.0 - share) * length <= AT_VERTEX {
            Hinge { at: b, segments: [own, after] }
        } else {
            Hinge { at: a.lerp(b, share), segments: [own, own] }
        })
    }
}

/// The edges of a mesh from which its slopes leave: the line as it was built, which may be a simplified one.
pub(super) struct MeshLine {
    segments: Vec<(DVec3, DVec3)>,
    tree: BoxTree,
}

impl MeshLine {
    /// Takes the hinges among the line work of a mesh in a frame.
    pub(super) fn new(lines: &[LineFeature], frame: &Frame) -> Self {
        let hinges = lines.iter().filter(|feature| feature.kind == CurveKind::Hinge);
        let ends = |feature: &LineFeature| -> Vec<(DVec3, DVec3)> {
            feature.points.windows(2).map(|ends| (frame.to_local(ends[0]), frame.to_local(ends[1]))).collect()
        };
        let segments: Vec<_> = hinges.flat_map(ends).collect();
        let tree = BoxTree::new(&segments.iter().zip(0..).map(|(one, i)| (i, plan_box(*one))).collect::<Vec<_>>());
        Self { segments, tree }
    }

    /// The segments that come within `reach` of a point in plan, ascending.
    fn near(&self, p: DVec2, reach: f64) -> Vec<usize> {
        let mut near = Vec::new();
        self.tree.meeting(&grown(PlanBox::of([p]), reach), |i| near.push(i as usize));
        near.sort_unstable();
        near
    }

    /// The hinge that was built for one of the given line, no more than `slack` from it in plan; `given` if there is none.
    pub(super) fn built(&self, given: Hinge, slack: f64) -> Hinge {
        let p = given.at.truncate();
        let mut nearest: Option<(f64, usize, f64)> = None;
        for i in self.near(p, slack) {
            let [a, b] = plan(self.segments[i]);
            let share = segment::foot(p, [a, b]);
            let away = p.distance(a.lerp(b, share));
            if away <= slack && nearest.is_none_or(|(least, ..)| away < least) {
                nearest = Some((away, i, share));
            }
        }
        let Some((_, i, share)) = nearest else { return given };
        let (a, b) = self.segments[i];
        let length = a.truncate().distance(b.truncate());
        let vertex = [(share, a), (1.0 - share, b)].into_iter().find(|(share, _)| share * length <= AT_VERTEX).map(|(_, v)| v);
        let at = vertex.unwrap_or_else(|| a.lerp(b, share));
        let [before, after] = given.segments;
        let segments = match vertex {
            // Feet on a chord follow each other as the points they belong to: so it runs with what it was given for.
            None => {
                let with = before.or(after).is_none_or(|(direction, _)| direction.dot((b - a).truncate()) >= 0.0);
                let own = along(if with { (a, b) } else { (b, a) });
                [before.map(|_| own), after.map(|_| own)]
            }
            Some(vertex) => self.through(vertex, given.segments),
        };
        // Where both are one, that is the point.
        let same = at.truncate().distance(p) <= AT_VERTEX && (at.z - given.at.z).abs() <= AT_VERTEX;
        Hinge { at: if same { given.at } else { at }, segments }
    }

    /// The segments through a vertex that go on most nearly as the given ones.
    fn through(&self, vertex: DVec3, [before, after]: [Option<(DVec2, f64)>; 2]) -> [Option<(DVec2, f64)>; 2] {
        let away = |i: usize| {
            let (a, b) = self.segments[i];
            let other = if a == vertex { Some(b) } else { (b == vertex).then_some(a) };
            other.map(|other| (i, (vertex, other)))
        };
        let mut ends: Vec<_> = self.near(vertex.truncate(), AT_VERTEX).into_iter().filter_map(away).collect();
        let mut take = |wish: Option<DVec2>| {
            let wish = wish?;
            let off = |&(_, ends): &(usize, (DVec3, DVec3))| -along(ends).0.dot(wish);
            let k = (0..ends.len()).min_by(|&k, &l| off(&ends[k]).total_cmp(&off(&ends[l])))?;
            Some(ends.swap_remove(k).1)
        };
        let out = take(after.map(|(direction, _)| direction));
        let back = take(before.map(|(direction, _)| -direction));
        [back.map(|(a, b)| along((b, a))).or(before), out.map(along).or(after)]
    }
}

/// Plan direction and gradient of a segment.
fn along((a, b): (DVec3, DVec3)) -> (DVec2, f64) {
    let plan = (b - a).truncate();
    (plan.normalize_or_zero(), (b.z - a.z) / plan.length())
}

fn plan((a, b): (DVec3, DVec3)) -> [DVec2; 2] {
    [a.truncate(), b.truncate()]
}

fn plan_box(ends: (DVec3, DVec3)) -> PlanBox {
    PlanBox::of(plan(ends))
}

fn grown(one: PlanBox, by: f64) -> PlanBox {
    PlanBox { lo: one.lo - by, hi: one.hi + by }
}

impl Hinge {
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
        let middle = (first + second).normalize_or_zero();
        // What passes for one slope on the way does so at its beginning.
        if turn.cos() >= 1.0 - STRIP_RATE {
            return Some(Ruling::Goes { direction: middle, cone: false });
        }
        if turn < 0.0 {
            return Some(Ruling::Closed);
        }
        let direction = if middle == DVec2::ZERO { hand.outward(first) } else { middle };
        Some(Ruling::Goes { direction, cone: true })
    }
}

/// Where a ray crosses a segment, its ends included: distance along the ray, share of the segment.
fn crossing(from: DVec2, direction: DVec2, a: DVec2, b: DVec2) -> Option<(f64, f64)> {
    let edge = b - a;
    let det = direction.perp_dot(edge);
    if det.abs() <= PARALLEL * edge.length() {
        return None;
    }
    let (away, share) = ((a - from).perp_dot(edge) / det, (a - from).perp_dot(direction) / det);
    let slack = AT_VERTEX / edge.length();
    (away >= -AT_VERTEX && (-slack..=1.0 + slack).contains(&share)).then_some((away, share))
}
