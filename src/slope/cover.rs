//! Which stretches of the line lie below the sheet of another edge.
//!
//! The sheet of an edge is concave, so along another edge, which is straight, it is higher on one stretch at most. The union of
//! those stretches is found for every edge by itself, before anything is closed and without regard to what is wanted.

use super::trim::Sheet;
use crate::sheet::Segment;
use rayon::prelude::*;
use rustc_hash::FxHashSet;

/// A sheet higher than an edge by no more than this (length units) does not cover it.
const COVERING: f64 = 1e-9;

/// With more edges than this that may cover a part of an edge, its halves are looked at one by one.
const AT_ONCE: usize = 12;

/// Parts of an edge are no shorter than this part of it.
const SHORTEST_PART: f64 = 1.0 / 4096.0;

/// Steps of a search along an edge; the last ones are shorter than rounding.
const STEPS: usize = 100;

/// The covered stretches of all edges.
pub struct Covers {
    /// Edge and distances from its start, in order; stretches of an edge are apart.
    stretches: Vec<(u32, [f64; 2])>,
}

impl Covers {
    /// Finds them all.
    pub fn find(sheet: &Sheet) -> Self {
        let edges = sheet.network.edges.len() as u32;
        let of = |e: u32| covered(sheet, e).into_iter().map(move |stretch| (e, stretch));
        Self { stretches: (0..edges).into_par_iter().flat_map_iter(of).collect() }
    }

    /// The covered stretches of edge `e`, as distances from its start.
    pub fn of(&self, e: u32) -> &[(u32, [f64; 2])] {
        let from = self.stretches.partition_point(|s| s.0 < e);
        let to = self.stretches.partition_point(|s| s.0 <= e);
        &self.stretches[from..to]
    }

    /// The edges with covered stretches, with these.
    pub fn edges(&self) -> impl Iterator<Item = &[(u32, [f64; 2])]> {
        self.stretches.chunk_by(|a, b| a.0 == b.0)
    }
}

/// The stretches of edge `e` below the sheets of others, in order.
fn covered(sheet: &Sheet, e: u32) -> Vec<[f64; 2]> {
    let own = sheet.index.segment(e);
    let edge = &sheet.network.edges[e as usize];
    let mut stretches = Vec::new();
    let mut done: FxHashSet<u32> = FxHashSet::default();
    for (node, forward) in [(edge.a, true), (edge.b, false)] {
        for h in sheet.fans.leaving(node).iter().filter(|&&h| h / 2 != e) {
            if done.insert(h / 2) {
                stretches.extend(Rise { own, other: sheet.index.segment(h / 2), k: sheet.k }.at_node(forward, h % 2 == 0));
            }
        }
    }
    let neighbours = done.clone();
    let steepest = sheet.k + own.gamma.abs();
    let mut parts = vec![[0.0, own.length]];
    let mut may_cover = Vec::new();
    while let Some([from, to]) = parts.pop() {
        let half = 0.5 * (to - from);
        let p = own.point(from + half);
        may_cover.clear();
        sheet.index.visit_above(p.truncate(), p.z - steepest * half, |other| {
            if other != e && !neighbours.contains(&other) && !done.contains(&other) {
                let (height, gradient) = sheet.index.segment(other).tangent(p.truncate(), sheet.k);
                if height - p.z + (gradient.dot(own.u) - own.gamma).abs() * half > COVERING {
                    may_cover.push(other);
                }
            }
        });
        if may_cover.len() > AT_ONCE && half > SHORTEST_PART * own.length {
            parts.extend([[from + half, to], [from, from + half]]);
            continue;
        }
        for &other in &may_cover {
            done.insert(other);
            stretches.extend(Rise { own, other: sheet.index.segment(other), k: sheet.k }.anywhere());
        }
    }
    united(stretches)
}

/// Stretches that overlap become one.
fn united(mut stretches: Vec<[f64; 2]>) -> Vec<[f64; 2]> {
    stretches.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]));
    let mut apart: Vec<[f64; 2]> = Vec::new();
    for [from, to] in stretches {
        match apart.last_mut() {
            Some(last) if from <= last[1] => last[1] = last[1].max(to),
            _ => apart.push([from, to]),
        }
    }
    apart
}

/// How high the sheet of one edge stands above another edge, along the latter: a concave function.
struct Rise<'a> {
    own: &'a Segment,
    other: &'a Segment,
    k: f64,
}

impl Rise<'_> {
    fn at(&self, s: f64) -> f64 {
        let p = self.own.point(s);
        self.other.height(p.truncate(), self.k) - p.z
    }

    fn with_rate(&self, s: f64) -> (f64, f64) {
        let p = self.own.point(s);
        let (height, gradient) = self.other.tangent(p.truncate(), self.k);
        (height - p.z, gradient.dot(self.own.u) - self.own.gamma)
    }

    /// The stretch that an edge at the same node covers: from the node on, if it rises there at all. `forward`: whether the node is
    /// where this edge starts; `outward`: whether it is where the other one does.
    fn at_node(&self, forward: bool, outward: bool) -> Option<[f64; 2]> {
        let turned = |forth: bool| if forth { 1.0 } else { -1.0 };
        let along = self.own.u * turned(forward);
        let (u, rise) = (self.other.u * turned(outward), self.other.gamma * turned(outward));
        // A cone, or a strip whose foot moves away from the node.
        let (forth, aside) = (u.dot(along), u.perp_dot(along).abs());
        let falls = if forth * self.other.drop + aside * rise <= 0.0 { -self.k } else { rise * forth - self.other.drop * aside };
        let rate = falls - self.own.gamma * turned(forward);
        if rate <= 0.0 {
            return None;
        }
        let length = self.own.length;
        let ends = if forward { [(0.0, 0.0, rate), self.end(length)] } else { [self.end(0.0), (length, 0.0, -rate)] };
        let top = self.top(ends)?;
        Some(if forward { [0.0, self.root(top, length)] } else { [self.root(top, 0.0), length] })
    }

    /// The stretch that an edge elsewhere covers.
    fn anywhere(&self) -> Option<[f64; 2]> {
        let top = self.top([self.end(0.0), self.end(self.own.length)])?;
        Some([self.root(top, 0.0), self.root(top, self.own.length)])
    }

    fn end(&self, s: f64) -> (f64, f64, f64) {
        let (height, rate) = self.with_rate(s);
        (s, height, rate)
    }

    /// A place where it is higher than [`COVERING`]. `ends`: distance, height, rate.
    fn top(&self, [mut lo, mut hi]: [(f64, f64, f64); 2]) -> Option<f64> {
        if let Some(end) = [lo, hi].into_iter().find(|end| end.1 > COVERING) {
            return Some(end.0);
        }
        for _ in 0..STEPS {
            // Highest where the tangents at both ends meet, at most.
            let (width, rates) = (hi.0 - lo.0, lo.2 - hi.2);
            if lo.2 <= 0.0 || hi.2 >= 0.0 || width <= 0.0 {
                return None;
            }
            let part = (hi.1 - lo.1 - hi.2 * width) / rates;
            if lo.1 + lo.2 * part <= COVERING {
                return None;
            }
            let inside = part > 0.1 * width && part < 0.9 * width;
            let next = self.end(if inside { lo.0 + part } else { 0.5 * (lo.0 + hi.0) });
            if next.1 > COVERING {
                return Some(next.0);
            }
            *(if next.2 > 0.0 { &mut lo } else { &mut hi }) = next;
        }
        None
    }

    /// Where it comes down to nought between `top`, where it is higher, and an end of the edge; that end if it does not.
    fn root(&self, top: f64, end: f64) -> f64 {
        if self.at(end) > 0.0 {
            return end;
        }
        let (mut high, mut low) = (top, end);
        for _ in 0..STEPS {
            let middle = 0.5 * (high + low);
            *(if self.at(middle) > 0.0 { &mut high } else { &mut low }) = middle;
        }
        low
    }
}
