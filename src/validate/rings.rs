//! Rings may not touch or cross themselves, nor cross each other; holes lie inside their polygon.
//!
//! All decisions are exact: signs come from adaptive predicates on the given coordinates.

mod contact;

use super::place::Locator;
use super::vertices::show;
use crate::kernel::ring_index::{RingIndex, doubled_area};
use crate::kernel::segment::{Meeting, meeting};
use crate::model::{Chain, Defect, Defects, Role};
use contact::{Contacts, is_spike};
use glam::DVec2;
use std::collections::{BTreeMap, HashSet};

/// After so many crossings the search ends: a scribble of n segments has n² of them.
const ENOUGH: usize = 1000;

/// A segment: its chain among the rings and its number there.
#[derive(Clone, Copy, Debug)]
struct Segment {
    ring: usize,
    index: usize,
    a: DVec2,
    b: DVec2,
}

/// The rings among the chains, with their segments in one list.
struct Rings<'a> {
    chains: Vec<&'a Chain>,
    locators: Vec<Locator<'a>>,
    label: &'a str,
    segments: Vec<Segment>,
    index: RingIndex,
    /// Whether each ring runs counter-clockwise.
    left_about: Vec<bool>,
}

/// Where pairs of rings touch, by the numbers of both in either order: on which side of the first the second lies.
type Touching = BTreeMap<(usize, usize), Contacts>;

/// Checks the rings among the chains. The result names, by number of chain, rings that lie inside an odd number of others, each
/// with the innermost ring around it; nothing while there are defects.
pub(super) fn check(label: &str, chains: &[Chain], defects: &mut Defects) -> Vec<(usize, usize)> {
    let all = Locator::of_chains(label, chains);
    let numbers: Vec<usize> = (0..chains.len()).filter(|&i| chains[i].closed()).collect();
    let (chains, locators): (Vec<_>, Vec<_>) = chains.iter().zip(all).filter(|(chain, _)| chain.closed()).unzip();
    if chains.is_empty() {
        return Vec::new();
    }
    let segments = chains.iter().enumerate().flat_map(|(ring, chain)| {
        (0..chain.segment_count()).map(move |index| {
            let (a, b) = chain.segment(index);
            Segment { ring, index, a: a.truncate(), b: b.truncate() }
        })
    });
    let segments: Vec<Segment> = segments.collect();
    let index = RingIndex::new(segments.iter().map(|s| (s.ring, s.a, s.b)).collect());
    let left_about = chains.iter().map(|chain| doubled_area(chain.vertices.iter().map(|v| v.truncate())) > 0.0).collect();
    let rings = Rings { chains, locators, label, segments, index, left_about };
    let mut contacts = Touching::new();
    let mut seen = HashSet::new();
    let mut found = 0;
    rings.index.tree().pairs(|i, j| {
        let (s, t) = (rings.segments[i], rings.segments[j]);
        if s.ring == t.ring {
            found += usize::from(rings.with_itself(s, t, &mut seen, defects));
        } else {
            match meeting([s.a, s.b], [t.a, t.b]) {
                Meeting::Apart => {}
                Meeting::Cross(at) => {
                    found += 1;
                    rings.cross(s, t, at, defects);
                }
                Meeting::Touch(_) => {
                    let (r, q) = (rings.chains[s.ring], rings.chains[t.ring]);
                    contacts.entry((s.ring, t.ring)).or_default().add(r, s, q, t);
                    contacts.entry((t.ring, s.ring)).or_default().add(q, t, r, s);
                }
            }
        }
        found < ENOUGH
    });
    if found > 0 {
        // Sides and insides mean nothing while rings cross.
        return Vec::new();
    }
    for (&(a, b), contacts) in contacts.iter().filter(|((a, b), _)| a < b) {
        rings.judge_contacts(a, b, contacts, defects);
    }
    rings.holes(&contacts, defects);
    if !defects.is_empty() {
        return Vec::new();
    }
    let within = rings.within(&contacts);
    let depth = |ring: usize| within[ring].len();
    let odd = (0..within.len()).filter(|&ring| depth(ring) % 2 == 1);
    odd.filter_map(|ring| Some((ring, *within[ring].iter().max_by_key(|&&around| depth(around))?)))
        .map(|(ring, around)| (numbers[ring], numbers[around]))
        .collect()
}

impl Rings<'_> {
    /// Two segments of one ring. Returns whether a defect was found.
    fn with_itself(&self, s: Segment, t: Segment, seen: &mut HashSet<(usize, u64, u64)>, defects: &mut Defects) -> bool {
        let chain = self.chains[s.ring];
        let count = chain.segment_count();
        let name = &chain.name;
        let (code, what, at) = if t.index == s.index + 1 || (s.index == 0 && t.index + 1 == count) {
            // Neighbours share one vertex; more only where the ring turns back on itself.
            let (before, corner, after) = if t.index == s.index + 1 { (s.a, s.b, t.b) } else { (t.a, t.b, s.b) };
            if !is_spike(before, corner, after) {
                return false;
            }
            ("ring-spike", format!("ring `{name}` runs out and back on itself"), corner)
        } else {
            let met = meeting([s.a, s.b], [t.a, t.b]);
            let Some(at) = met.points().next() else { return false };
            match met {
                Meeting::Cross(_) => ("ring-crosses-itself", format!("ring `{name}` crosses itself"), at),
                _ => ("ring-touches-itself", format!("ring `{name}` touches itself"), at),
            }
        };
        // A vertex that lies on another one is met by four pairs of segments.
        if seen.insert((s.ring, (at.x + 0.0).to_bits(), (at.y + 0.0).to_bits())) {
            defects.push(code, || Defect {
                code,
                what,
                at: self.at(s, t),
                figures: Some(format!("at x {}, y {}", show(at.x), show(at.y))),
                help: "the inside of a ring must be clear: put its vertices in order, take the spike out, or split it into \
                       rings that touch nowhere"
                    .into(),
            });
        }
        true
    }

    fn at(&self, s: Segment, t: Segment) -> String {
        let name = |s: Segment| {
            let chain = self.chains[s.ring];
            let next = (s.index + 1) % chain.places.len();
            self.locators[s.ring].segment(chain.places[s.index], chain.places[next])
        };
        format!("{}, {} and {}", self.label, name(s), name(t))
    }

    fn cross(&self, s: Segment, t: Segment, at: DVec2, defects: &mut Defects) {
        defects.push("rings-cross", || Defect {
            code: "rings-cross",
            what: self.what(s.ring, t.ring, "cross each other"),
            at: self.at(s, t),
            figures: Some(format!("at x {}, y {}", show(at.x), show(at.y))),
            help: "join rings that overlap to one, or move them apart; a hole must lie inside its polygon".into(),
        });
    }

    fn what(&self, a: usize, b: usize, verb: &str) -> String {
        let name = |i: usize| {
            let kind = if matches!(self.chains[i].role, Role::Hole { .. }) { "hole" } else { "ring" };
            format!("{kind} `{}`", self.chains[i].name)
        };
        format!("{} and {} {verb}", name(a), name(b))
    }

    fn judge_contacts(&self, a: usize, b: usize, contacts: &Contacts, defects: &mut Defects) {
        let Some((s, t, at)) = contacts.first else { return };
        if contacts.left && contacts.right {
            self.cross(s, t, at, defects);
        } else if !contacts.left && !contacts.right {
            defects.push("ring-twice", || Defect {
                code: "ring-twice",
                what: self.what(a, b, "are the same"),
                at: self.at(s, t),
                figures: Some(format!(
                    "{} and {} vertices, one outline",
                    self.chains[a].places.len(),
                    self.chains[b].places.len()
                )),
                help: "take one of the two out".into(),
            });
        }
    }

    /// Holes must lie inside the outer ring of their polygon.
    fn holes(&self, contacts: &Touching, defects: &mut Defects) {
        let mut outer_of = BTreeMap::new();
        for (i, chain) in self.chains.iter().enumerate() {
            if let Role::Outer { polygon } = chain.role {
                outer_of.insert(polygon, i);
            }
        }
        for (hole, chain) in self.chains.iter().enumerate() {
            let Role::Hole { polygon } = chain.role else { continue };
            // Without a sound outer ring there is another defect already.
            let Some(&outer) = outer_of.get(&polygon) else { continue };
            let inside = match contacts.get(&(outer, hole)).filter(|c| c.left != c.right) {
                Some(contacts) => self.inside(outer, contacts),
                None => self.index.around(chain.vertices[0].truncate()).contains(&outer),
            };
            if !inside {
                defects.push("hole-outside", || Defect {
                    code: "hole-outside",
                    what: format!("a hole of polygon `{}` lies outside its outer ring", self.chains[outer].name),
                    at: self.locators[hole].line(chain.places[0].feature),
                    figures: Some(format!("at x {}, y {}", show(chain.vertices[0].x), show(chain.vertices[0].y))),
                    help: "move the hole inside, or make it a polygon of its own".into(),
                });
            }
        }
    }

    /// For each ring those it lies inside of.
    fn within(&self, contacts: &Touching) -> Vec<Vec<usize>> {
        let around = |(ring, chain): (usize, &&Chain)| {
            let around = self.index.around(chain.vertices[0].truncate());
            around.into_iter().filter(|&other| other != ring && !contacts.contains_key(&(other, ring))).collect()
        };
        let mut within: Vec<Vec<usize>> = self.chains.iter().enumerate().map(around).collect();
        for (&(around, ring), contacts) in contacts {
            if self.inside(around, contacts) {
                within[ring].push(around);
            }
        }
        within
    }

    /// Whether a ring that touches another lies inside it: on the side its inside is on.
    fn inside(&self, ring: usize, contacts: &Contacts) -> bool {
        contacts.left == self.left_about[ring]
    }
}

#[cfg(test)]
mod tests;
