//! From a centre line to the ring of its road.

use super::edge::{Centre, EdgePoint, Fault, left, on_centre, sagitta};
use super::{Formation, FormationError, Formed, notes};
use crate::kernel::segment::meeting;
use crate::kernel::segment_tree::SegmentTree;
use crate::model::{Axis, Breakline, Chain, Line, Note, Role};
use crate::validate::{Locator, MERGE_DISTANCE, check_rings};
use glam::DVec2;

/// Makes a ring of every open chain: left edge, straight end, right edge, straight end, the centre line a breakline inside.
///
/// Edge points lie on the bisector of the two segments that meet at a vertex of the centre line, at half the width from both, and
/// `crossfall` times half the width lower than the vertex. The outside of corners sharper than [`super::LONGEST_MITRE`] is
/// rounded at the height of its vertex. On the inside of a bend tighter than half the width the edge ends where its two legs
/// cross, at their mean height; the step is levelled at 0.3 %, over one width of edge on both sides at most, as are those that kinks make of single
/// pieces of the edge. Vertices of the ring know the vertex
/// of the centre line they come from (`places`) and its station (`axis`). Rings stay what they are.
///
/// Expects a validated line; `label` names its input.
///
/// # Errors
/// [`FormationError`]: no open chain, a centre line that comes closer to itself than the width, rings that cross, a road on the
/// platform of a ring or of another road, a ring on a road.
pub fn widen(line: &Line, label: &str, formation: &Formation) -> Result<Formed, FormationError> {
    if line.chains.iter().all(Chain::closed) {
        return Err(FormationError::NoCentreLine { label: label.to_owned(), rings: line.chains.len() });
    }
    let mut formed = Formed { line: line.clone(), notes: Vec::new() };
    let taken = line.chains.iter().filter_map(|chain| match chain.role {
        Role::Open => None,
        Role::Outer { polygon } | Role::Hole { polygon } => Some(polygon + 1),
    });
    let mut polygon = taken.max().unwrap_or(0);
    for (i, locator) in Locator::of_chains(label, &line.chains).iter().enumerate() {
        let chain = &line.chains[i];
        if chain.closed() {
            continue;
        }
        let (ring, notes) = road(chain, formation, polygon, locator)?;
        formed.notes.extend(notes.into_iter().flatten());
        formed.line.breaklines.push(Breakline {
            name: chain.name.clone(),
            vertices: chain.vertices.clone(),
            places: chain.places.clone(),
            stations: Some(chain.stations()),
            of: Some(i),
        });
        formed.line.chains[i] = ring;
        polygon += 1;
    }
    check_nested(&formed.line, label)?;
    Ok(formed)
}

/// Rings and roads stand beside each other: no ring may lie on a road, nor a road on what a ring bounds. Slopes would cover the
/// one or the other, or the road be a hole.
fn check_nested(line: &Line, label: &str) -> Result<(), FormationError> {
    let nested = check_rings(line, label)?;
    // Rings that are holes already lie inside theirs; those on roads do, too, but not by right.
    let roads = |&(inner, around): &(usize, usize)| line.chains[inner].axis.is_some() || line.chains[around].axis.is_some();
    let Some((inner, around)) = nested.into_iter().find(roads) else { return Ok(()) };
    let (chain, outer) = (&line.chains[inner], &line.chains[around]);
    let at = Locator::of_chains(label, &line.chains)[inner].vertex(chain.places[0]);
    let (name, ring) = (outer.name.clone(), chain.name.clone());
    let (x, y) = (chain.vertices[0].x, chain.vertices[0].y);
    Err(match (&chain.axis, &outer.axis) {
        (None, _) => FormationError::RingInside { ring, name, at, x, y },
        (Some(_), axis) => FormationError::RoadInside { name: ring, of_road: axis.is_some(), ring: name, at, x, y },
    })
}

fn road(
    chain: &Chain,
    formation: &Formation,
    polygon: u32,
    locator: &Locator<'_>,
) -> Result<(Chain, [Option<Note>; 3]), FormationError> {
    let centre = Centre::new(&chain.vertices, chain.stations());
    let length = centre.stations[centre.stations.len() - 1];
    let half = 0.5 * formation.width;
    let refused = |fault| refusal(fault, chain, formation, &centre, locator);
    check_centre(&centre).map_err(refused)?;
    let fall = formation.crossfall;
    let (lefts, of_left) = left(&centre, half, fall.left * half, formation.chord).map_err(refused)?;
    let (mut rights, of_right) = left(&centre.mirrored(), half, fall.right * half, formation.chord).map_err(refused)?;
    rights.iter_mut().for_each(|p| p.plan.y = -p.plan.y);
    let folds = notes::folds(&[&lefts, &rights]);
    let levelled = of_left.join(of_right);

    let last = chain.vertices.len() - 1;
    let mut points = distinct(lefts);
    points.push(on_centre(&centre, last));
    let mut back = distinct(rights);
    back.reverse();
    points.append(&mut back);
    points.push(on_centre(&centre, 0));
    check_itself(&points, &centre, formation.width).map_err(refused)?;
    check_inside(&points, &centre).map_err(refused)?;

    let origin = chain.vertices[0].truncate();
    let world = |p: &EdgePoint| {
        // The ends are the given vertices, bit for bit.
        let given = [0, last].into_iter().find(|&v| p.plan == centre.plan[v]);
        given.map_or_else(|| (origin + p.plan).extend(p.z), |v| chain.vertices[v])
    };
    let mut stations: Vec<f64> = points.iter().map(|p| p.station).collect();
    stations.push(stations[0]);
    let ring = Chain {
        name: chain.name.clone(),
        role: Role::Outer { polygon },
        vertices: points.iter().map(world).collect(),
        places: points.iter().map(|p| chain.places[p.vertex]).collect(),
        axis: Some(Axis { name: chain.name.clone(), length, stations, sagitta: sagitta(&centre, half, formation.chord) }),
    };
    let notes = [
        notes::of_folds(&chain.name, &folds, formation.width).filter(|_| !notes::are_kinks(&folds, &centre)),
        notes::of_kinks(&chain.name, levelled, formation.width),
        notes::of_density(&chain.name, &folds, &centre, &ring, half),
    ];
    Ok((ring, notes))
}

/// Drops points that lie on the one before.
fn distinct(mut points: Vec<EdgePoint>) -> Vec<EdgePoint> {
    points.dedup_by(|b, a| a.plan.distance(b.plan) <= MERGE_DISTANCE);
    points
}

/// A centre line that crosses itself has no platform.
fn check_centre(centre: &Centre) -> Result<(), Fault> {
    let ends: Vec<(DVec2, DVec2)> = centre.plan.windows(2).map(|w| (w[0], w[1])).collect();
    let mut found = None;
    SegmentTree::new(&ends).pairs(|i, j| {
        if i.abs_diff(j) > 1
            && let Some(at) = meeting(ends[i].into(), ends[j].into()).points().next()
        {
            let station = |k: usize| centre.stations[k] + ends[k].0.distance(at);
            found = Some([station(i.min(j)), station(i.max(j))]);
        }
        found.is_none()
    });
    found.map_or(Ok(()), |stations| Err(Fault::Narrow { stations, distance: 0.0 }))
}

/// The edges of a sound road cross nowhere.
fn check_itself(points: &[EdgePoint], centre: &Centre, width: f64) -> Result<(), Fault> {
    let n = points.len();
    let ends: Vec<(DVec2, DVec2)> = (0..n).map(|i| (points[i].plan, points[(i + 1) % n].plan)).collect();
    let mut found = None;
    SegmentTree::new(&ends).pairs(|i, j| {
        let neighbours = j == i + 1 || (i == 0 && j + 1 == n);
        if !neighbours && let Some(at) = meeting(ends[i].into(), ends[j].into()).points().next() {
            let station = |k: usize| {
                let (a, b) = (&points[k], &points[(k + 1) % n]);
                let part = a.plan.distance(at) / a.plan.distance(b.plan);
                a.station + (b.station - a.station) * part.clamp(0.0, 1.0)
            };
            found = Some([station(i), station(j)]);
        }
        found.is_none()
    });
    let Some([mut a, mut b]) = found else { return Ok(()) };
    if a > b {
        std::mem::swap(&mut a, &mut b);
    }
    // The nearest way between the two legs there, one width on each side of the crossing.
    let segment = |s: f64| centre.stations.partition_point(|t| *t < s).clamp(1, centre.plan.len() - 1) - 1;
    let window = |s: f64, lo: f64, hi: f64| segment((s - width).max(lo))..segment((s + width).min(hi)) + 1;
    let middle = 0.5 * (a + b);
    let mut best = ([a, b], centre.at(a).distance(centre.at(b)));
    let windows = [window(a, 0.0, middle), window(b, middle, f64::INFINITY)];
    for (from, to) in [(0, 1), (1, 0)] {
        for i in windows[from].start..=windows[from].end {
            let (station, distance) = centre.nearest(centre.plan[i], windows[to].clone());
            if distance < best.1 {
                best = ([centre.stations[i], station], distance);
            }
        }
    }
    Err(Fault::Narrow { stations: best.0, distance: best.1 })
}

/// The centre line runs inside of its road, from end to end. It does not where a bend is so tight, for its distance from an end of
/// the line, that the inner edge passes on the wrong side.
fn check_inside(points: &[EdgePoint], centre: &Centre) -> Result<(), Fault> {
    let edges = points.iter().zip(points.iter().cycle().skip(1)).map(|(a, b)| (a.plan, b.plan));
    let (n, last) = (points.len(), centre.plan.len() - 1);
    let ends: Vec<(DVec2, DVec2)> = edges.chain(centre.plan.windows(2).map(|w| (w[0], w[1]))).collect();
    let at_end = |p: DVec2| [0, last].into_iter().any(|v| p.distance(centre.plan[v]) <= MERGE_DISTANCE);
    let mut found = None;
    SegmentTree::new(&ends).pairs(|i, j| {
        let (edge, segment) = (i.min(j), i.max(j));
        if edge < n && segment >= n {
            let at = meeting(ends[edge].into(), ends[segment].into()).points().find(|&p| !at_end(p));
            found = found.or(at.map(|_| points[edge].vertex));
        }
        found.is_none()
    });
    found.map_or(Ok(()), |vertex| Err(Fault::NoRoom { vertex }))
}

fn refusal(fault: Fault, chain: &Chain, formation: &Formation, centre: &Centre, locator: &Locator<'_>) -> FormationError {
    let name = chain.name.clone();
    let at = |vertex: usize| locator.vertex(chain.places[vertex]);
    let width = formation.width;
    match fault {
        Fault::Narrow { stations, distance } => {
            let nearest = |station: f64| {
                let after = centre.stations.partition_point(|s| *s < station).min(centre.stations.len() - 1);
                let before = after.saturating_sub(1);
                let nearer = station - centre.stations[before] < centre.stations[after] - station;
                chain.places[if nearer { before } else { after }]
            };
            let mut stations = stations;
            stations.sort_by(f64::total_cmp);
            let at = locator.pair(nearest(stations[0]), nearest(stations[1]));
            FormationError::Narrow { name, at, stations, distance, width }
        }
        Fault::Back { vertex } => FormationError::TurnsBack { name, at: at(vertex), station: centre.stations[vertex] },
        Fault::NoRoom { vertex } => FormationError::NoRoom {
            name,
            at: at(vertex),
            station: centre.stations[vertex],
            length: centre.stations[centre.stations.len() - 1],
            width,
        },
    }
}
