//! One edge of a road: the line at half the width beside the centre line, cleaned where bends are tight.
//!
//! The edge is laid stroke by stroke: across the start of the road, along every segment, round the outside of sharp corners,
//! across the end. On the inside of a bend two strokes cross: in the mitre where both are long enough, else the strokes between
//! are dropped, and the two that do cross meet in the crossing point. A stack of strokes does it in one pass.

use super::steps::{self, Levelled};
use crate::kernel::orientation::{Turn, turn};
use crate::kernel::segment::{distance, foot};
use glam::{DVec2, DVec3};

/// The outside of a corner keeps its mitre up to this length, in halves of the width; the corner of a sharper one (a turn of more
/// than 96°) is rounded.
pub const LONGEST_MITRE: f64 = 1.5;

/// A bend is only a bend while the crossing point of its inner edges lies within this distance of all of the centre line it cuts
/// off, in halves of the width (a single corner may turn by 141°). Beyond, two legs lie closer together than the width.
pub const SHARPEST: f64 = 3.0;

/// Most chords of a rounded corner, whatever the tolerance.
const MOST_CHORDS: f64 = 1024.0;

/// What rounding may leave missing at the ends of strokes that meet, as a share of their length.
const MEETING: f64 = 1e-12;

/// The centre line as an edge sees it: plan about a local origin, the edge on the left.
pub(super) struct Centre {
    pub(super) plan: Vec<DVec2>,
    pub(super) heights: Vec<f64>,
    pub(super) stations: Vec<f64>,
}

/// A point of an edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct EdgePoint {
    pub(super) plan: DVec2,
    pub(super) z: f64,
    /// Station on the centre line.
    pub(super) station: f64,
    /// Vertex of the centre line it comes from.
    pub(super) vertex: usize,
    /// What the heights of the two edges that meet here had to change to meet, before and behind.
    pub(super) fold: Option<[f64; 2]>,
}

/// Why there is no edge.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Fault {
    /// The legs of the line beside these two stations are too close, so far apart.
    Narrow { stations: [f64; 2], distance: f64 },
    /// The line turns straight back at this vertex.
    Back { vertex: usize },
    /// From this vertex on no edge comes out on the inside of the bend.
    NoRoom { vertex: usize },
}

/// A directed piece of the edge.
#[derive(Clone, Copy)]
struct Stroke {
    /// Where it would begin and end alone.
    from: EdgePoint,
    to: EdgePoint,
    /// Where it begins.
    start: EdgePoint,
    /// Whether it lies across an end of the road.
    is_end: bool,
}

impl Stroke {
    fn new(from: EdgePoint, to: EdgePoint) -> Self {
        Self { from, to, start: from, is_end: false }
    }

    /// The point of the stroke at a plan position on it.
    fn at(&self, plan: DVec2) -> EdgePoint {
        let part = foot(plan, [self.from.plan, self.to.plan]);
        let between = |a: f64, b: f64| a + part * (b - a);
        EdgePoint {
            plan,
            z: between(self.from.z, self.to.z),
            station: between(self.from.station, self.to.station),
            vertex: if part < 0.5 { self.from.vertex } else { self.to.vertex },
            fold: None,
        }
    }
}

/// The left edge at distance `half` from the centre line, `drop` lower, chords of rounded corners within `chord`. Without the
/// ends of the centre line itself; and what was levelled. At least two vertices, neighbours distinct in plan, are expected.
pub(super) fn left(centre: &Centre, half: f64, drop: f64, chord: f64) -> Result<(Vec<EdgePoint>, Levelled), Fault> {
    let n = centre.plan.len() - 1;
    let mut edge = Edge::new(centre, half);
    let normals: Vec<DVec2> = normals(centre).collect();
    let beside = |vertex: usize, normal: DVec2| edge_point(centre, vertex, centre.plan[vertex] + half * normal, drop);
    let mut from = beside(0, normals[0]);
    edge.add(Stroke { is_end: true, ..Stroke::new(on_centre(centre, 0), from) })?;
    for i in 1..=n {
        let before = normals[i - 1];
        let square = beside(i, before);
        if i == n {
            edge.add(Stroke::new(from, square))?;
            edge.add(Stroke { is_end: true, ..Stroke::new(square, on_centre(centre, n)) })?;
            break;
        }
        let after = normals[i];
        let mitre = beside(i, (before + after) / (1.0 + before.dot(after)));
        let turns = turn(centre.plan[i - 1], centre.plan[i], centre.plan[i + 1]);
        if turns == Turn::Straight && before.dot(after) < 0.0 {
            return Err(Fault::Back { vertex: i });
        }
        if turns == Turn::Left {
            edge.add(Stroke::new(from, square))?;
            from = beside(i, after);
            edge.corner = Some(mitre);
        } else if is_sharp(before, after) {
            edge.add(Stroke::new(from, square))?;
            from = square;
            for normal in round(before, after, chord / half) {
                let to = beside(i, normal);
                edge.add(Stroke::new(from, to))?;
                from = to;
            }
        } else {
            edge.add(Stroke::new(from, mitre))?;
            from = mitre;
        }
    }
    edge.finish(n)
}

fn edge_point(centre: &Centre, vertex: usize, plan: DVec2, drop: f64) -> EdgePoint {
    EdgePoint { plan, z: centre.heights[vertex] - drop, station: centre.stations[vertex], vertex, fold: None }
}

/// A vertex of the centre line itself.
pub(super) fn on_centre(centre: &Centre, vertex: usize) -> EdgePoint {
    edge_point(centre, vertex, centre.plan[vertex], 0.0)
}

/// Greatest distance between the arc of a rounded corner, on either side, and its chords.
pub(super) fn sagitta(centre: &Centre, half: f64, chord: f64) -> f64 {
    let normals: Vec<DVec2> = normals(centre).collect();
    let rounded = normals.windows(2).filter(|pair| is_sharp(pair[0], pair[1])).map(|pair| {
        let (angle, count) = chords(pair[0], pair[1], chord / half);
        half * (1.0 - (0.5 * angle / count as f64).cos())
    });
    rounded.fold(0.0, f64::max)
}

/// The unit normals of the segments, to the left.
fn normals(centre: &Centre) -> impl Iterator<Item = DVec2> {
    centre.plan.windows(2).map(|w| (w[1] - w[0]).normalize_or_zero().perp())
}

/// Whether a corner between two normals is rounded on its outside: the mitre is 1 / cos(δ/2) long, the sum of the normals 2 cos(δ/2).
fn is_sharp(before: DVec2, after: DVec2) -> bool {
    (before + after).length() < 2.0 / LONGEST_MITRE
}

/// The angle from one normal to another, and the number of chords of the unit circle within `chord` that take it.
fn chords(before: DVec2, after: DVec2, chord: f64) -> (f64, usize) {
    let angle = before.angle_to(after);
    let step = 2.0 * (1.0 - chord).clamp(0.0, 1.0).acos();
    (angle, (angle.abs() / step).ceil().clamp(1.0, MOST_CHORDS) as usize)
}

/// The normals after `before` to `after` on the outside of a right turn, chords of the unit circle within `chord`.
fn round(before: DVec2, after: DVec2, chord: f64) -> impl Iterator<Item = DVec2> {
    let (angle, count) = chords(before, after, chord);
    (1..=count).map(move |k| if k == count { after } else { DVec2::from_angle(angle * k as f64 / count as f64).rotate(before) })
}

/// The edge so far.
struct Edge<'a> {
    centre: &'a Centre,
    half: f64,
    strokes: Vec<Stroke>,
    /// Set when the next stroke begins on the inside of a corner: where it would meet the one before.
    corner: Option<EdgePoint>,
    /// The vertex from which on nothing has been joined.
    gap: Option<usize>,
}

impl<'a> Edge<'a> {
    fn new(centre: &'a Centre, half: f64) -> Self {
        Self { centre, half, strokes: Vec::new(), corner: None, gap: None }
    }

    fn add(&mut self, mut stroke: Stroke) -> Result<(), Fault> {
        let at_corner = self.corner.is_some();
        if let Some(mitre) = self.corner.take().filter(|_| self.gap.is_none()) {
            if self.mitre_fits(&stroke, &mitre) {
                stroke.start = mitre;
                self.strokes.push(stroke);
                return Ok(());
            }
            self.gap = Some(mitre.vertex);
        }
        let Some(gap) = self.gap else {
            self.strokes.push(stroke);
            return Ok(());
        };
        if let Some((k, plan)) = self.crossing(&stroke, gap) {
            self.check_reach(k, &stroke, plan)?;
            self.meet(k, stroke, plan);
        } else if self.far(stroke.from.vertex, gap) {
            return Err(self.parallel(stroke.from.vertex, gap));
        } else if stroke.is_end {
            self.end_beside(stroke);
        } else if at_corner {
            self.begin_beside(stroke);
        }
        Ok(())
    }

    /// Ends stroke `k` where the new one begins.
    fn meet(&mut self, k: usize, mut stroke: Stroke, plan: DVec2) {
        let (a, b) = (self.strokes[k].at(plan), stroke.at(plan));
        self.strokes.truncate(k + 1);
        let z = 0.5 * (a.z + b.z);
        // On the straight ends of the road the station stays what it is there.
        let station = if self.strokes[k].is_end {
            a.station
        } else if stroke.is_end {
            b.station
        } else {
            0.5 * (a.station + b.station)
        };
        stroke.start = EdgePoint { plan, z, station, vertex: a.vertex, fold: Some([z - a.z, z - b.z]) };
        self.strokes.push(stroke);
        self.gap = None;
    }

    /// The road ends within a bend: from where its edge was left, straight across to its end.
    fn end_beside(&mut self, end: Stroke) {
        let Some(last) = self.strokes.last() else { return };
        let across = Stroke::new(last.to, on_centre(self.centre, last.to.vertex));
        if let Some(plan) = meeting((across.start.plan, across.to.plan), (end.from.plan, end.to.plan), |turn| turn != 0.0) {
            self.strokes.push(across);
            self.meet(self.strokes.len() - 1, end, plan);
        }
    }

    /// The road begins within a bend: from its beginning straight across to where its edge can start.
    fn begin_beside(&mut self, stroke: Stroke) {
        let across = Stroke::new(on_centre(self.centre, stroke.from.vertex), stroke.from);
        let begin = self.strokes[0];
        let Some(plan) = meeting((begin.start.plan, begin.to.plan), (across.from.plan, across.to.plan), |turn| turn != 0.0)
        else {
            return;
        };
        if self.check_reach(0, &across, plan).is_ok() {
            self.meet(0, across, plan);
            self.strokes.push(stroke);
        }
    }

    /// Whether the mitre lies on both strokes that meet there, and the bend is not too sharp.
    fn mitre_fits(&self, stroke: &Stroke, mitre: &EdgePoint) -> bool {
        let Some(last) = self.strokes.last() else { return false };
        let ahead = |from: DVec2, to: DVec2, along: DVec2| (to - from).dot(along) >= 0.0;
        let corner = self.centre.plan[mitre.vertex];
        ahead(last.start.plan, mitre.plan, last.to.plan - last.from.plan)
            && ahead(mitre.plan, stroke.to.plan, stroke.to.plan - stroke.from.plan)
            && mitre.plan.distance(corner) <= SHARPEST * self.half
    }

    /// The last stroke that the new one crosses so that the edge can change from that to this, and where: on the inside of a
    /// bend it then turns towards its own side, at the ends of the road away from it.
    fn crossing(&self, stroke: &Stroke, gap: usize) -> Option<(usize, DVec2)> {
        let mut end = self.strokes.last()?.to.plan;
        for (k, other) in self.strokes.iter().enumerate().rev() {
            if self.far(other.to.vertex, gap) {
                return None;
            }
            let at_end = other.is_end || stroke.is_end;
            let wanted = |turn: f64| if at_end { turn < 0.0 } else { turn > 0.0 };
            if let Some(plan) = meeting((other.start.plan, end), (stroke.from.plan, stroke.to.plan), wanted) {
                return Some((k, plan));
            }
            end = other.start.plan;
        }
        None
    }

    /// Whether two vertices are too far apart to be cut off in one bend.
    fn far(&self, vertex: usize, gap: usize) -> bool {
        self.centre.plan[vertex].distance(self.centre.plan[gap]) > 2.0 * SHARPEST * self.half
    }

    /// All vertices cut off must lie near the crossing point.
    fn check_reach(&self, k: usize, stroke: &Stroke, plan: DVec2) -> Result<(), Fault> {
        let range = self.strokes[k].to.vertex..=stroke.from.vertex;
        let cut_off = self.centre.plan.get(range).unwrap_or(&[]);
        if cut_off.iter().all(|p| p.distance(plan) <= SHARPEST * self.half) {
            return Ok(());
        }
        let stations = [self.strokes[k].at(plan).station, stroke.at(plan).station];
        let [p, q] = stations.map(|station| self.centre.at(station));
        Err(Fault::Narrow { stations, distance: p.distance(q) })
    }

    /// Two legs that run beside each other.
    fn parallel(&self, vertex: usize, gap: usize) -> Fault {
        let p = self.centre.plan[vertex];
        let (station, distance) = self.centre.nearest(p, 0..gap);
        if distance >= 2.0 * self.half {
            return Fault::NoRoom { vertex: gap };
        }
        Fault::Narrow { stations: [station, self.centre.stations[vertex]], distance }
    }

    fn finish(self, last: usize) -> Result<(Vec<EdgePoint>, Levelled), Fault> {
        if let Some(vertex) = self.gap {
            let end = self.centre.plan[last];
            let (station, distance) = self.centre.nearest(end, 0..vertex);
            let clear = self.centre.stations[last] - station > 2.0 * self.half;
            return Err(if clear && distance < 2.0 * self.half {
                Fault::Narrow { stations: [station, self.centre.stations[last]], distance }
            } else {
                Fault::NoRoom { vertex }
            });
        }
        let mut points: Vec<EdgePoint> = self.strokes[1..].iter().map(|stroke| stroke.start).collect();
        steps::level_folds(&mut points, 2.0 * self.half);
        let levelled = steps::level_kinks(&mut points, self.half);
        Ok((points, levelled))
    }
}

/// Where two strokes meet, if the edge turns there as wanted (the sign of the cross product of their directions).
fn meeting((a, b): (DVec2, DVec2), (c, d): (DVec2, DVec2), wanted: impl Fn(f64) -> bool) -> Option<DVec2> {
    let (u, v, w) = (b - a, d - c, c - a);
    let turn = u.perp_dot(v);
    if !wanted(turn) {
        return None;
    }
    let (t, r) = (w.perp_dot(v) / turn, w.perp_dot(u) / turn);
    let on = |part: f64| (-MEETING..=1.0 + MEETING).contains(&part);
    (on(t) && on(r)).then(|| a + u * t.clamp(0.0, 1.0))
}

impl Centre {
    /// The plan point at a station.
    pub(super) fn at(&self, station: f64) -> DVec2 {
        let i = self.stations.partition_point(|s| *s < station).clamp(1, self.stations.len() - 1);
        let (a, b) = (self.stations[i - 1], self.stations[i]);
        self.plan[i - 1].lerp(self.plan[i], ((station - a) / (b - a)).clamp(0.0, 1.0))
    }

    /// Station and distance of the point of the segments `range` that is nearest to `p`.
    pub(super) fn nearest(&self, p: DVec2, range: std::ops::Range<usize>) -> (f64, f64) {
        let mut best = (self.stations[range.start], f64::INFINITY);
        for i in range {
            let segment = [self.plan[i], self.plan[i + 1]];
            let (part, distance) = (foot(p, segment), distance(p, segment));
            if distance < best.1 {
                best = (self.stations[i] + part * (self.stations[i + 1] - self.stations[i]), distance);
            }
        }
        best
    }

    /// The line in a mirror: its right edge is then on the left.
    pub(super) fn mirrored(&self) -> Self {
        let plan = self.plan.iter().map(|p| DVec2::new(p.x, -p.y)).collect();
        Self { plan, heights: self.heights.clone(), stations: self.stations.clone() }
    }

    /// The centre line of a chain, about its first vertex.
    pub(super) fn new(vertices: &[DVec3], stations: Vec<f64>) -> Self {
        let origin = vertices[0].truncate();
        let plan = vertices.iter().map(|v| v.truncate() - origin).collect();
        Self { plan, heights: vertices.iter().map(|v| v.z).collect(), stations }
    }
}
