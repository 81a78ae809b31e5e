//! The polygon of a strip: sliced along level lines and triangulated.
//!
//! All its points lie in one plane, every `τ` meets it in one stretch of ruling, and every crossing of its outline with a
//! level is a corner. Signs are decided by the exact predicate on plan coordinates.

use super::emit::PointId;
use super::levels::Code;
use crate::kernel::orientation::{Turn, turn};
use glam::DVec2;
use rustc_hash::FxHashMap;

/// A corner of the outline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corner {
    /// Mesh vertex.
    pub id: PointId,
    /// Parameter of its ruling.
    pub tau: f64,
    /// Distance from the edge along the ruling.
    pub r: f64,
    /// Place in plan.
    pub plan: DVec2,
    /// Place among the levels.
    pub code: Code,
    /// Whether it lies on the edge of the network.
    pub near: bool,
}

/// Slices and triangulates outlines in one plane.
pub struct Slice {
    /// Direction of growing `τ` along level lines.
    along: DVec2,
    /// Level chords inside the polygons done so far: level and ends.
    pub chords: Vec<(u32, [PointId; 2])>,
}

/// A run of outline edges within one band, from corner `first` to corner `last` (indices of the outline, wrapping).
#[derive(Clone, Copy, Debug)]
struct Chain {
    band: Code,
    first: usize,
    last: usize,
}

/// Where a chain begins or ends on a level.
#[derive(Clone, Copy, Debug)]
struct ChainEnd {
    /// Place along the level.
    place: f64,
    /// Whether the chain ends there; else it begins.
    ends: bool,
    chain: usize,
}

impl Slice {
    /// For a strip with rulings in direction `d`.
    pub fn new(d: DVec2) -> Self {
        Self { along: -d.perp(), chords: Vec::new() }
    }

    /// Triangulates the counter-clockwise outline `ring`, no triangle crossing a level. Says whether it could.
    pub fn triangulate(&mut self, ring: &[Corner], out: &mut Vec<[PointId; 3]>) -> bool {
        if ring.len() < 3 {
            return true;
        }
        let n = ring.len();
        let band = |i: usize| band_of(&ring[i % n], &ring[(i + 1) % n]);
        let Some(start) = (0..n).find(|&i| band(i) != band(i + n - 1)) else {
            return triangulate(ring, out);
        };
        let mut chains: Vec<Chain> = Vec::new();
        for i in start..start + n {
            match chains.last_mut() {
                Some(chain) if chain.band == band(i) => chain.last = i + 1,
                _ => chains.push(Chain { band: band(i), first: i, last: i + 1 }),
            }
            let goes_on = i + 1 < start + n && band(i + 1) == band(i);
            if goes_on && touches_level(&ring[i % n], &ring[(i + 1) % n], &ring[(i + 2) % n]) {
                // The outline only touches the level here, and the level goes on on both sides: a corner of the pieces on
                // the far side of the level as well.
                let other = if ring[(i + 1) % n].code / 2 == band(i) { band(i) + 1 } else { band(i) - 1 };
                chains.push(Chain { band: other, first: i + 1, last: i + 1 });
            }
        }
        let Some(next) = self.link(ring, &chains) else { return false };
        let mut done = vec![false; chains.len()];
        let mut piece: Vec<Corner> = Vec::new();
        for begin in 0..chains.len() {
            if done[begin] {
                continue;
            }
            piece.clear();
            let mut at = begin;
            while !done[at] {
                done[at] = true;
                for i in chains[at].first..=chains[at].last {
                    let corner = ring[i % n];
                    if piece.last().is_none_or(|p| p.id != corner.id) {
                        piece.push(corner);
                    }
                }
                at = next[at];
            }
            if piece.len() > 1 && piece[0].id == piece[piece.len() - 1].id {
                piece.pop();
            }
            if at != begin || !triangulate(&piece, out) {
                return false;
            }
        }
        true
    }

    /// For each chain the one that follows it around its piece, over a chord along a level.
    fn link(&mut self, ring: &[Corner], chains: &[Chain]) -> Option<Vec<usize>> {
        let n = ring.len();
        let mut by_level: FxHashMap<(Code, Code), Vec<ChainEnd>> = FxHashMap::default();
        for (c, chain) in chains.iter().enumerate() {
            for (corner, ends) in [(&ring[chain.first % n], false), (&ring[chain.last % n], true)] {
                let place = corner.plan.dot(self.along);
                by_level.entry((chain.band, corner.code)).or_default().push(ChainEnd { place, ends, chain: c });
            }
        }
        let mut keys: Vec<(Code, Code)> = by_level.keys().copied().collect();
        keys.sort_unstable();
        let mut next = vec![usize::MAX; chains.len()];
        for key in keys {
            let (band, code) = key;
            let list = by_level.get_mut(&key)?;
            // The level above a band is nearer to the edge: it is run with growing τ, the one below against it.
            let above = code + 1 == 2 * band;
            let below = code == 2 * band + 1;
            if !(above || below) {
                return None;
            }
            list.sort_by(|a, b| if above { a.place.total_cmp(&b.place) } else { b.place.total_cmp(&a.place) });
            let mut open: Option<usize> = None;
            for i in 0..list.len() {
                // Ends and starts take turns; where several fall on one corner, the one whose turn it is goes first.
                let same = list[i..].iter().take_while(|e| e.place == list[i].place).count();
                let at = (i..i + same).find(|&j| list[j].ends == open.is_none())?;
                list.swap(i, at);
                let chain = list[i].chain;
                match open.take() {
                    None => open = Some(chain),
                    Some(from) => {
                        next[from] = chain;
                        let chord = [ring[chains[from].last % n].id, ring[chains[chain].first % n].id];
                        if below && chord[0] != chord[1] {
                            self.chords.push((code / 2, chord));
                        }
                    }
                }
            }
            if open.is_some() {
                return None;
            }
        }
        next.iter().all(|&c| c != usize::MAX).then_some(next)
    }
}

/// Whether the outline turns back at `corner`, on a level, with the inside around it: a reflex corner.
fn touches_level(before: &Corner, corner: &Corner, after: &Corner) -> bool {
    corner.code % 2 == 1 && turn(before.plan, corner.plan, after.plan) == Turn::Right
}

/// The band an outline edge lies in. Along a level, an edge of the network bounds what is below it, any other edge what is
/// above.
fn band_of(a: &Corner, b: &Corner) -> Code {
    if a.code == b.code && a.code % 2 == 1 {
        if a.near && b.near { a.code.div_ceil(2) } else { a.code / 2 }
    } else {
        a.code.min(b.code).div_ceil(2)
    }
}

/// Triangles thinner than this (length units) are taken as straight, unless there is no other way: points on one straight
/// line in space are straight only up to rounding in the mesh.
const STRAIGHT: f64 = 1e-9;

/// Whether three corners turn left, to a triangle thicker than `least`. Corners on the edge of the network are on one straight
/// line, whatever rounding says.
fn left_turn(a: &Corner, b: &Corner, c: &Corner, least: f64) -> bool {
    if (a.near && b.near && c.near) || turn(a.plan, b.plan, c.plan) != Turn::Left {
        return false;
    }
    let longest =
        (b.plan - a.plan).length_squared().max((c.plan - b.plan).length_squared()).max((a.plan - c.plan).length_squared());
    let area = (b.plan - a.plan).perp_dot(c.plan - a.plan);
    area * area > least * least * longest
}

/// Triangulates a polygon that is monotone in `(τ, r)`; falls back to clipping ears.
fn triangulate(ring: &[Corner], out: &mut Vec<[PointId; 3]>) -> bool {
    let positive = |a: &Corner, b: &Corner, c: &Corner| left_turn(a, b, c, 0.0);
    match ring {
        [] | [_] | [_, _] => true,
        [a, b, c] => {
            out.push([a.id, b.id, c.id]);
            positive(a, b, c)
        }
        _ => {
            let before = out.len();
            [STRAIGHT, 0.0].into_iter().any(|least| {
                let done = sweep(ring, least, out) || {
                    out.truncate(before);
                    clip_ears(ring, least, out)
                };
                if !done {
                    out.truncate(before);
                }
                done
            })
        }
    }
}

/// Order of the sweep: along `τ`, outwards where that ties.
fn before(a: &Corner, b: &Corner) -> bool {
    (a.tau, a.r) < (b.tau, b.r)
}

/// Garey–Johnson–Preparata–Tarjan sweep over a monotone polygon. False if a triangle would not be counter-clockwise.
fn sweep(ring: &[Corner], least: f64, out: &mut Vec<[PointId; 3]>) -> bool {
    let n = ring.len();
    let (mut low, mut high) = (0, 0);
    for i in 1..n {
        if before(&ring[i], &ring[low]) {
            low = i;
        }
        if before(&ring[high], &ring[i]) {
            high = i;
        }
    }
    // Both chains from the first to the last corner; the near one runs counter-clockwise.
    let mut order: Vec<(usize, bool)> = Vec::with_capacity(n);
    let (mut near, mut far) = ((low + 1) % n, (low + n - 1) % n);
    order.push((low, true));
    while near != high || far != high {
        if far == high || (near != high && !before(&ring[far], &ring[near])) {
            order.push((near, true));
            near = (near + 1) % n;
        } else {
            order.push((far, false));
            far = (far + n - 1) % n;
        }
    }
    order.push((high, false));
    let start = out.len();
    let mut push = |a: usize, b: usize, c: usize, is_near: bool| {
        let [a, b, c] = if is_near { [a, b, c] } else { [a, c, b] };
        let positive = left_turn(&ring[a], &ring[b], &ring[c], least);
        if positive {
            out.push([ring[a].id, ring[b].id, ring[c].id]);
        }
        positive
    };
    let mut stack = vec![order[0], order[1]];
    for (step, &(v, v_near)) in order.iter().enumerate().skip(2) {
        let top_near = stack[stack.len() - 1].1;
        // The last corner ends both chains: it goes on with the one on the stack.
        let v_near = if step + 1 == n { top_near } else { v_near };
        if v_near != top_near {
            for pair in stack.windows(2) {
                push(pair[0].0, pair[1].0, v, top_near);
            }
            let top = stack[stack.len() - 1];
            stack.clear();
            stack.extend([top, (v, v_near)]);
        } else {
            while let [.., a, b] = stack[..] {
                if !push(a.0, b.0, v, v_near) {
                    break;
                }
                stack.pop();
            }
            stack.push((v, v_near));
        }
    }
    out.len() - start == n - 2
}

/// Ear clipping, quadratic; for outlines that rounding has made slightly unmonotone.
fn clip_ears(ring: &[Corner], least: f64, out: &mut Vec<[PointId; 3]>) -> bool {
    let mut left: Vec<usize> = (0..ring.len()).collect();
    let plan = |i: usize| ring[i].plan;
    while left.len() > 3 {
        let n = left.len();
        let ear = (0..n).find(|&i| {
            let [a, b, c] = [left[(i + n - 1) % n], left[i], left[(i + 1) % n]];
            left_turn(&ring[a], &ring[b], &ring[c], least)
                && left.iter().all(|&p| {
                    [a, b, c].contains(&p)
                        || [(a, b), (b, c), (c, a)].iter().any(|&(s, t)| turn(plan(s), plan(t), plan(p)) == Turn::Right)
                })
        });
        let Some(i) = ear else { return false };
        out.push([left[(i + n - 1) % n], left[i], left[(i + 1) % n]].map(|p| ring[p].id));
        left.remove(i);
    }
    out.push([left[0], left[1], left[2]].map(|p| ring[p].id));
    left_turn(&ring[left[0]], &ring[left[1]], &ring[left[2]], least)
}
