//! Foot points: which place of the line every slope triangle belongs to.

use super::stations::Stations;
use crate::kernel::range::held;
use crate::model::{Line, Sheet as SheetKind};
use crate::slope::emit::Slopes;
use crate::slope::facet::{Facet, Kind};
use crate::slope::network::Network;
use crate::slope::trim::Sheet;
use glam::DVec2;

/// The foot points of one facet, as stations: a linear function of the plan position on a strip, one station on a cone.
///
/// Off the creases every point of the surface has exactly one foot (docs/theory.md, Section 5), so volumes can be
/// given to stations exactly.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Chain of the line.
    pub chain: u32,
    /// A foot point in plan, local frame.
    pub origin: DVec2,
    /// Its station.
    pub station: f64,
    /// Change of the station per length unit in plan; nought on cones.
    pub gradient: DVec2,
    /// Stations of the two ends of the strip, ascending. Where it runs over the first vertex of a ring, they count on past its
    /// length.
    pub range: [f64; 2],
    /// Whether the facet is a cone sector.
    pub on_cone: bool,
}

impl Foot {
    /// Station of the foot of the plan point `x`.
    pub fn station(&self, x: DVec2) -> f64 {
        held(self.station + self.gradient.dot(x - self.origin), self.range)
    }
}

/// The facets that have triangles, and the one of each triangle.
pub(super) fn of_triangles(line: &Line, sheet: &Sheet, slopes: &Slopes) -> (Vec<Foot>, Vec<u32>) {
    let stations = Stations::on_axes(line);
    let mut feet = Vec::new();
    let mut last = None;
    let mut foot_of = Vec::with_capacity(slopes.facets.len());
    for &f in &slopes.facets {
        if last != Some(f) {
            let facet = sheet.facet(f);
            let leaving = match facet.kind {
                Kind::Strip(_) => None,
                Kind::Sector(node) => sheet.fans.leaving(node).first().copied(),
            };
            feet.push(foot(facet, sheet.network, &stations, leaving));
            last = Some(f);
        }
        foot_of.push(feet.len() as u32 - 1);
    }
    (feet, foot_of)
}

/// The foot points of `facet`; `leaving` is a half-edge that leaves the node of a sector.
fn foot(facet: &Facet, network: &Network, stations: &Stations, leaving: Option<u32>) -> Foot {
    let (half_edge, on_cone) = match facet.kind {
        Kind::Strip(h) => (h, false),
        Kind::Sector(_) => (leaving.unwrap_or(0), true),
    };
    let edge = &network.edges[(half_edge / 2) as usize];
    let [a, b] = stations.counting_on(edge, edge.given.map(|given| stations.at(given)));
    let (from, to) = if half_edge & 1 == 0 { (a, b) } else { (b, a) };
    let (from, to) = if on_cone { (stations.on_ring(edge, from), stations.on_ring(edge, from)) } else { (from, to) };
    let gradient = if on_cone || facet.tau_max <= 0.0 {
        DVec2::ZERO
    } else {
        // τ(w) = u·w − r u·d with r = u⊥·w / u⊥·d, see `Facet::parameters`.
        let across = facet.u.perp();
        (facet.u - across * (facet.u.dot(facet.d) / across.dot(facet.d))) * ((to - from) / facet.tau_max)
    };
    Foot {
        chain: edge.given[0].chain,
        origin: facet.origin,
        station: from,
        gradient,
        range: [from.min(to), from.max(to)],
        on_cone,
    }
}

/// The kind of crease of a sheet: the falling one is the greatest of its facets, where two meet it is lower than around.
pub(super) fn crease(sheet: SheetKind) -> super::Mark {
    match sheet {
        SheetKind::Falling => super::Mark::Valley,
        SheetKind::Rising => super::Mark::Ridge,
    }
}
