//! Stretches of the line that lie below the slope of another part, in the words of the line: chains and stations.

use super::stations::Stations;
use crate::model::{Chain, Design, Line, Note, Sheet as SheetKind, Slope};
use crate::sheet::Segment;
use crate::slope::cover::Covers;
use crate::slope::network::{Edge, Network};
use crate::slope::trim::Sheet;
use glam::{DVec2, DVec3};

/// A stretch of the line below the slope of another part.
#[derive(Clone, Debug, PartialEq)]
pub struct Buried {
    /// Chain of the stretch.
    pub chain: usize,
    /// Station where it begins.
    pub from: f64,
    /// Station where it ends.
    pub to: f64,
    /// Greatest height of the covering slope above the line.
    pub depth: f64,
    /// Place of the greatest depth, world coordinates.
    pub at: DVec2,
    /// Chain that covers it there.
    pub by_chain: usize,
    /// Station of the foot of the covering slope.
    pub by_station: f64,
    /// The flattest slope (rise per run) that would leave the stretch free; `None` where parts meet in plan at different
    /// heights, so that none would.
    pub free_slope: Option<f64>,
}

impl Buried {
    /// The stretch in words.
    pub(crate) fn told(&self, line: &Line, design: &Design) -> String {
        let word = if design.sheet == SheetKind::Falling { "below" } else { "above" };
        format!(
            "`{}` lies up to {:.3} {word} the slope of `{}` from station {:.3} to {:.3}",
            line.chains[self.chain].name, self.depth, line.chains[self.by_chain].name, self.from, self.to
        )
    }
}

/// The flattest slope that leaves all stretches free, as it can be typed; `None` if there is none.
pub(crate) fn freeing(stretches: &[Buried]) -> Option<String> {
    let steepest = stretches.iter().try_fold(0.0, |steepest, b| Some(f64::max(steepest, b.free_slope?)))?;
    Slope::from_ratio(steepest).map(Slope::not_flatter)
}

/// What does not show of the line.
pub(crate) struct Found {
    /// Stretches below another part's slope.
    pub(crate) stretches: Vec<Buried>,
    /// Stretches beyond the end of the slope: chain, stations.
    pub(crate) below: Vec<(usize, f64, f64)>,
}

/// Points looked at along a stretch, per edge and at the ends.
const SAMPLES: usize = 32;

/// Steps of a search between two samples; each leaves two thirds.
const NARROWINGS: usize = 60;

/// Stretches shorter than this (length units) are not reported: they are the two sides of one touching point.
const SHORTEST: f64 = 1e-6;

/// A sheet less than this above the line (length units) does not cover it: rounding of heights a kilometre apart.
const TOUCHING: f64 = 1e-7;

/// Slopes beyond this ratio count as none.
const STEEPEST: f64 = 1e4;

/// A piece of one edge.
struct Part {
    edge: usize,
    s: [f64; 2],
    /// Whether another part lies above, or the end of the slope.
    covered: bool,
    stations: [f64; 2],
}

/// Stretches of edge `e` that do not show, as distances from its start, in order: below other parts (`true`), and below the end of
/// the slope.
pub(crate) fn hidden(sheet: &Sheet, covers: &Covers, e: u32) -> Vec<([f64; 2], bool)> {
    let segment = sheet.index.segment(e);
    let covered = covers.of(e);
    let mut hidden: Vec<([f64; 2], bool)> = covered.iter().map(|c| (c.1, true)).collect();
    // Where it lies below the end, and shows all the same.
    let to_end = (sheet.end - segment.za) / segment.gamma;
    let [mut from, to] = match [segment.za, segment.zb].map(|z| z <= sheet.end) {
        [true, true] => [0.0, segment.length],
        [true, false] => [0.0, to_end],
        [false, true] => [to_end, segment.length],
        [false, false] => return hidden,
    };
    for [cover_from, cover_to] in covered.iter().map(|c| c.1) {
        if cover_to > from && cover_from < to {
            hidden.push(([from, cover_from], false));
            from = cover_to;
        }
    }
    hidden.push(([from, to], false));
    hidden.retain(|(s, _)| s[1] > s[0]);
    hidden.sort_by(|a, b| a.0[0].total_cmp(&b.0[0]));
    hidden
}

/// Finds the covered stretches of a sheet.
pub(crate) fn stretches(line: &Line, sheet: &Sheet, covers: &Covers) -> Found {
    let stations = OnEdges::new(line, sheet.network);
    let mut parts: Vec<(usize, Part)> = Vec::new();
    for (e, edge) in sheet.network.edges.iter().enumerate() {
        for (s, covered) in hidden(sheet, covers, e as u32).into_iter().filter(|(s, _)| s[1] - s[0] > SHORTEST) {
            let mut at = s.map(|s| stations.station(e, s));
            if edge.against {
                at.reverse();
            }
            parts.push((edge.given[0].chain as usize, Part { edge: e, s, covered, stations: at }));
        }
    }
    let on_line = |chain: usize, stations: [f64; 2]| axis_stations(&line.chains[chain], stations);
    parts.sort_by(|a, b| (a.0, a.1.covered).cmp(&(b.0, b.1.covered)).then(a.1.stations[0].total_cmp(&b.1.stations[0])));
    let mut found = Found { stretches: Vec::new(), below: Vec::new() };
    let joins = |a: &(usize, Part), b: &(usize, Part)| {
        a.0 == b.0 && a.1.covered == b.1.covered && (b.1.stations[0] - a.1.stations[1]).abs() <= SHORTEST
    };
    for group in parts.chunk_by(joins) {
        let (chain, from, to) = (group[0].0, group[0].1.stations[0], group[group.len() - 1].1.stations[1]);
        if group[0].1.covered {
            let mut stretch = describe(sheet, &stations, chain, [from, to], group);
            if stretch.depth <= TOUCHING {
                continue;
            }
            [stretch.from, stretch.to] = on_line(chain, [from, to]);
            stretch.by_station = on_line(stretch.by_chain, [stretch.by_station; 2])[0];
            found.stretches.push(stretch);
        } else {
            found.below.push((chain, from, to));
        }
    }
    found
}

/// Distances along the edge of a road as stations of its centre line, ascending; others stay what they are.
fn axis_stations(chain: &Chain, along: [f64; 2]) -> [f64; 2] {
    let Some(axis) = &chain.axis else { return along };
    let edge = chain.stations();
    let mut stations = along.map(|s| {
        let i = edge.partition_point(|e| *e < s).clamp(1, edge.len() - 1);
        let part = ((s - edge[i - 1]) / (edge[i] - edge[i - 1])).clamp(0.0, 1.0);
        axis.stations[i - 1] + part * (axis.stations[i] - axis.stations[i - 1])
    });
    stations.sort_by(f64::total_cmp);
    stations
}

/// The point of edge `edge` at plan distance `s` from its start.
fn on(sheet: &Sheet, edge: &Edge, s: f64) -> DVec3 {
    let (a, b) = (sheet.network.nodes[edge.a as usize], sheet.network.nodes[edge.b as usize]);
    a.lerp(b, s / sheet.network.length(edge))
}

fn describe(sheet: &Sheet, stations: &OnEdges<'_>, chain: usize, [from, to]: [f64; 2], group: &[(usize, Part)]) -> Buried {
    let mut deepest = (f64::NEG_INFINITY, DVec3::ZERO, 0);
    for (_, part) in group {
        let edge = &sheet.network.edges[part.edge];
        let depth = |s: f64| {
            let p = on(sheet, edge, s);
            let (height, by) = sheet.index.height(p.truncate(), None);
            (height - p.z, p, by)
        };
        let step = (part.s[1] - part.s[0]) / SAMPLES as f64;
        let mut best = (f64::NEG_INFINITY, part.s[0]);
        for i in 0..=SAMPLES {
            let s = part.s[0] + step * i as f64;
            let here = depth(s);
            if here.0 > best.0 {
                best = (here.0, s);
            }
        }
        // The greatest depth lies between the neighbours of the best sample, or at it.
        let (mut lo, mut hi) = ((best.1 - step).max(part.s[0]), (best.1 + step).min(part.s[1]));
        for _ in 0..NARROWINGS {
            let (m, n) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
            if depth(m).0 < depth(n).0 { lo = m } else { hi = n }
        }
        for s in [best.1, 0.5 * (lo + hi)] {
            let here = depth(s);
            if here.0 > deepest.0 {
                deepest = here;
            }
        }
    }
    let (depth, place, by) = deepest;
    let foot = sheet.index.segment(by).foot(place.truncate());
    Buried {
        chain,
        from,
        to,
        depth,
        at: sheet.network.world(place).truncate(),
        by_chain: sheet.network.edges[by as usize].given[0].chain as usize,
        by_station: stations.station(by as usize, foot),
        free_slope: free_slope(sheet, group),
    }
}

/// The least slope at which no other part covers the group: the greatest `(z_q − z_p)/|p − q|` over points `p` of it and `q` of
/// the line; `None` where a higher part passes over it. Greatest at a sample, then between its neighbours.
fn free_slope(sheet: &Sheet, group: &[(usize, Part)]) -> Option<f64> {
    let mut worst = (sheet.k, None);
    for (_, part) in group {
        if passed_over(sheet, part) {
            return None;
        }
        let step = (part.s[1] - part.s[0]) / SAMPLES as f64;
        for i in 0..=SAMPLES {
            let s = part.s[0] + step * i as f64;
            let slope = needed(sheet, on(sheet, &sheet.network.edges[part.edge], s), worst.0)?;
            if slope > worst.0 {
                worst = (slope, Some((part.edge, [(s - step).max(part.s[0]), (s + step).min(part.s[1])])));
            }
        }
    }
    let (mut slope, Some((edge, [mut lo, mut hi]))) = worst else { return Some(worst.0) };
    for _ in 0..NARROWINGS {
        let at = |s: f64| needed(sheet, on(sheet, &sheet.network.edges[edge], s), sheet.k);
        let (m, n) = (lo + (hi - lo) / 3.0, hi - (hi - lo) / 3.0);
        let (left, right) = (at(m)?, at(n)?);
        slope = slope.max(left).max(right);
        if left < right { lo = m } else { hi = n }
    }
    Some(slope)
}

/// Whether a higher edge crosses a piece in plan.
fn passed_over(sheet: &Sheet, part: &Part) -> bool {
    let nodes = &sheet.network.nodes;
    let own = &sheet.network.edges[part.edge];
    let [a, b] = part.s.map(|s| on(sheet, own, s));
    let u = (b - a).truncate();
    let passes = |e: u32| {
        let edge = &sheet.network.edges[e as usize];
        let (c, d) = (nodes[edge.a as usize], nodes[edge.b as usize]);
        let (v, w) = ((d - c).truncate(), (c - a).truncate());
        let across = u.perp_dot(v);
        let (t, r) = (w.perp_dot(v) / across, w.perp_dot(u) / across);
        let meets = across != 0.0 && (0.0..=1.0).contains(&t) && (0.0..=1.0).contains(&r);
        e as usize != part.edge && meets && c.lerp(d, r).z - a.lerp(b, t).z > TOUCHING
    };
    // From a higher point anywhere on the piece, the sheet of an edge has not fallen farther at the middle.
    let middle = 0.5 * (a + b);
    let mut passed = false;
    sheet.index.visit_above(middle.truncate(), middle.z - sheet.k * u.length(), |e| passed = passed || passes(e));
    passed
}

/// The least slope, from `slope` on, at which nothing covers `p`, by Dinkelbach's iteration: the point of the line that is
/// highest at the present slope gives the next one. `None` beyond the steepest that counts.
///
/// Precondition: `slope` is no flatter than that of the sheet, so only what covers `p` in the sheet does so at all.
fn needed(sheet: &Sheet, p: DVec3, mut slope: f64) -> Option<f64> {
    const STEPS: usize = 60;
    let mut above: Vec<u32> = Vec::new();
    sheet.index.visit_above(p.truncate(), p.z, |e| above.push(e));
    above.sort_unstable();
    for _ in 0..STEPS {
        let mut best = (0.0, 0.0);
        for edge in above.iter().map(|&e| &sheet.network.edges[e as usize]) {
            let (a, b) = (sheet.network.nodes[edge.a as usize], sheet.network.nodes[edge.b as usize]);
            let segment = Segment::new(a, b, slope);
            let foot = segment.point(segment.foot(p.truncate()));
            let distance = foot.truncate().distance(p.truncate());
            let rise = foot.z - p.z;
            if rise - slope * distance > best.0 {
                best = (rise - slope * distance, rise / distance);
            }
        }
        if best.0 <= 1e-12 * (1.0 + p.z.abs()) {
            break;
        }
        slope = best.1;
        if slope >= STEEPEST {
            return None;
        }
    }
    Some(slope)
}

impl Found {
    /// A note on stretches beyond the end of the slope.
    pub(crate) fn below_note(&self, design: &Design) -> Option<Note> {
        let length: f64 = self.below.iter().map(|b| b.2 - b.1).sum();
        let word = if design.sheet == SheetKind::Falling { "below" } else { "above" };
        (!self.below.is_empty()).then(|| {
            Note::new(
                "line-beyond-end",
                format!(
                    "{length:.3} of the line in {} stretches lies {word} the end of the slope and has none",
                    self.below.len()
                ),
            )
        })
    }
}

/// Stations along the chains of places on edges.
struct OnEdges<'a> {
    network: &'a Network,
    stations: Stations,
    /// `(s, station)` of the given vertices along each edge.
    marks: Vec<Vec<(f64, f64)>>,
}

impl<'a> OnEdges<'a> {
    fn new(line: &Line, network: &'a Network) -> Self {
        let stations = Stations::along(line);
        let marks = |edge: &Edge| {
            let mut marks = vec![(0.0, stations.at(edge.given[0]))];
            marks.extend(edge.inner.iter().map(|p| (p.s, stations.at(p.given))));
            marks.push((network.length(edge), stations.at(edge.given[1])));
            marks
        };
        Self { network, marks: network.edges.iter().map(marks).collect(), stations }
    }

    /// Station of the place `s` along edge `e`.
    fn station(&self, e: usize, s: f64) -> f64 {
        let marks = &self.marks[e];
        let i = marks.partition_point(|m| m.0 < s).clamp(1, marks.len() - 1);
        let ((s0, a), (s1, b)) = (marks[i - 1], marks[i]);
        let [a, b] = self.stations.counting_on(&self.network.edges[e], [a, b]);
        a + (b - a) * ((s - s0) / (s1 - s0)).clamp(0.0, 1.0)
    }
}
