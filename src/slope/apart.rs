//! Whether what is wanted of the sheet meets the rest at the line only.
//!
//! The visible part of a facet hangs together with its foot: whole rulings, down to where another facet comes up. So it never
//! passes over a stretch of line that shows, and where all of the line shows, the facets on one side of it see only those that
//! reach the same region of the plane. A ring, or a polygon with its holes, then keeps its inside and its outside apart.

use super::trim::Sheet;
use crate::kernel::plan_box::PlanBox;
use crate::model::{Design, Line, Role, Side};
use rayon::prelude::*;
use rustc_hash::FxHashMap;

/// Sheets of other edges stay at least this far (length units) below an edge that shows: rounding of heights, and more.
const BELOW: f64 = 1e-9;

/// Sheets of edges at the same node fall away from an edge by at least this part of the slope.
const STEEPER: f64 = 1e-9;

/// An edge is looked at in at most this many parts, each half as long as the one before.
const MAX_PARTS: usize = 200;

/// An edge is compared with at most this many others.
const MAX_OTHERS: usize = 2000;

/// Whether facets that are wanted and facets that are not surely meet along the line only. Then the sheet is whole without the
/// latter.
pub fn sides_apart(line: &Line, design: &Design, sheet: &Sheet) -> bool {
    let edges = &sheet.network.edges;
    if edges.iter().all(|e| e.wanted == [true; 2]) {
        return true;
    }
    let in_or_out = matches!(design.side_of_rings, Side::Inside | Side::Outside);
    in_or_out && polygons_apart(line) && (0..edges.len() as u32).into_par_iter().all(|e| shows(sheet, e))
}

/// Whether there are only polygons, and none inside another: their boxes do not overlap.
fn polygons_apart(line: &Line) -> bool {
    let mut boxes: FxHashMap<u32, PlanBox> = FxHashMap::default();
    for chain in &line.chains {
        let polygon = match chain.role {
            Role::Open => return false,
            Role::Outer { polygon } | Role::Hole { polygon } => polygon,
        };
        let around = boxes.entry(polygon).or_insert(PlanBox::EMPTY);
        *around = around.join(PlanBox::of(chain.vertices.iter().map(|v| v.truncate())));
    }
    let mut boxes: Vec<PlanBox> = boxes.into_values().collect();
    boxes.sort_unstable_by(|a, b| a.lo.x.total_cmp(&b.lo.x));
    // Boxes that only touch do not overlap.
    let overlaps = |a: &PlanBox, b: &PlanBox| b.lo.x < a.hi.x && a.lo.y < b.hi.y && b.lo.y < a.hi.y;
    boxes.iter().enumerate().all(|(i, a)| boxes[i + 1..].iter().take_while(|b| b.lo.x < a.hi.x).all(|b| !overlaps(a, b)))
}

/// Whether all of edge `e` surely lies above the sheets of the other edges.
fn shows(sheet: &Sheet, e: u32) -> bool {
    let (segment, k) = (sheet.index.segment(e), sheet.k);
    let edge = &sheet.network.edges[e as usize];
    let mut neighbours = Vec::new();
    for (node, gradient, along) in [(edge.a, segment.gamma, segment.u), (edge.b, -segment.gamma, -segment.u)] {
        for h in sheet.fans.leaving(node).iter().filter(|&&h| h / 2 != e) {
            let other = sheet.index.segment(h / 2);
            let (u, rise) = if h % 2 == 0 { (other.u, other.gamma) } else { (-other.u, -other.gamma) };
            // Its sheet along this edge, from the node on: a cone, or a strip whose foot moves outwards.
            let (forth, aside) = (u.dot(along), u.perp_dot(along).abs());
            let falls = if forth + aside * (rise / other.drop) <= 0.0 { -k } else { rise * forth - other.drop * aside };
            if falls > gradient - STEEPER * k {
                return false;
            }
            neighbours.push(h / 2);
        }
    }
    let steepest = k + segment.gamma.abs();
    let mut parts = vec![[0.0, segment.length]];
    let (mut looked_at, mut compared) = (0, 0);
    while let Some([from, to]) = parts.pop() {
        looked_at += 1;
        let half = 0.5 * (to - from);
        let p = segment.point(from + half);
        let (mut clear, mut covered) = (true, false);
        sheet.index.visit_above(p.truncate(), p.z - steepest * half - BELOW, |other| {
            compared += 1;
            if covered || compared > MAX_OTHERS || other == e || neighbours.contains(&other) {
                return;
            }
            // Sheets are concave: none lies above its tangent.
            let (height, gradient) = sheet.index.segment(other).tangent(p.truncate(), k);
            let above = height - p.z;
            covered |= above > -BELOW;
            clear &= above + (gradient.dot(segment.u) - segment.gamma).abs() * half < -BELOW;
        });
        if covered || compared > MAX_OTHERS || looked_at > MAX_PARTS {
            return false;
        }
        if !clear {
            parts.extend([[from, from + half], [from + half, to]]);
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::{Chain, Extent, Place, Slope};
    use crate::slope::fan::Fans;
    use crate::slope::network::Network;
    use crate::slope::trim::index_of;
    use glam::DVec3;

    fn chain(role: Role, points: &[[f64; 3]]) -> Chain {
        let vertices: Vec<DVec3> = points.iter().map(|&p| DVec3::from(p)).collect();
        Chain { name: String::new(), role, places: vec![Place::default(); vertices.len()], vertices, axis: None }
    }

    fn square(polygon: u32, [x, y, z]: [f64; 3], side: f64) -> Chain {
        chain(Role::Outer { polygon }, &[[x, y, z], [x + side, y, z], [x + side, y + side, z], [x, y + side, z]])
    }

    fn apart(chains: Vec<Chain>, side: Side) -> bool {
        let (line, k) = (Line { chains, ..Line::default() }, 0.5);
        let design = Design {
            slope: Slope::from_ratio(k).unwrap(),
            sheet: crate::model::Sheet::Falling,
            side_of_lines: side,
            side_of_rings: side,
            extent: Extent::Height(1.0),
            interval: None,
            tolerance: 0.01,
            levels: Vec::new(),
            companion: None,
            frame: None,
            joggle: None,
        };
        let network = Network::new(&line, &design, 0.001);
        let (fans, index) = (Fans::new(&network, k), index_of(&network, k));
        sides_apart(&line, &design, &Sheet::new(&network, &fans, &index, k, -2.0))
    }

    #[test]
    fn pads_beside_each_other_keep_their_sides_apart() {
        // The second one touches the first, the third stands 1 above it and 10 away.
        let pads = || vec![square(0, [0.0; 3], 10.0), square(1, [10.0, 0.0, 0.0], 10.0), square(2, [30.0, 0.0, 1.0], 10.0)];
        assert!(apart(pads(), Side::Outside) && apart(pads(), Side::Inside));
        // Both sides: nothing is left out.
        assert!(apart(pads(), Side::Both));
        assert!(!apart(pads(), Side::Left));
    }

    #[test]
    fn what_may_see_the_other_side_is_not_apart() {
        let open = chain(Role::Open, &[[-5.0, 0.0, 0.0], [-5.0, 9.0, 0.0]]);
        assert!(!apart(vec![square(0, [0.0; 3], 10.0), open], Side::Outside));
        // One inside the other; edges hidden by a pad 10 higher, by a peak across, and touched by one just as high as the slope rises.
        assert!(!apart(vec![square(0, [0.0; 3], 10.0), square(1, [3.0, 3.0, 0.0], 4.0)], Side::Outside));
        assert!(!apart(vec![square(0, [0.0; 3], 10.0), square(1, [12.0, 0.0, 10.0], 10.0)], Side::Outside));
        assert!(!apart(vec![square(0, [0.0; 3], 10.0), square(1, [12.0, 0.0, 1.0], 10.0)], Side::Outside));
        let peak = [[0.0, 0.0, 0.0], [300.0, 0.0, 0.0], [300.0, 2.0, 0.0], [50.0, 2.0, 1.01], [0.0, 2.0, 0.0]];
        assert!(!apart(vec![chain(Role::Outer { polygon: 0 }, &peak)], Side::Outside));
        let lower = peak.map(|[x, y, z]| [x, y, 0.98 * z]);
        assert!(apart(vec![chain(Role::Outer { polygon: 0 }, &lower)], Side::Outside));
    }

    #[test]
    fn a_rough_ring_shows() {
        let corner = |i: usize| {
            let (sin, cos) = (std::f64::consts::TAU * i as f64 / 3000.0).sin_cos();
            let noise = [(i * 7919 % 101) as f64, (i * 104_729 % 97) as f64].map(|n| 0.02 * (n / 50.0 - 1.0));
            [(300.0 + noise[0]) * cos, (200.0 + noise[0]) * sin, 5.0 * cos + 0.2 * noise[1]]
        };
        let ring: Vec<[f64; 3]> = (0..3000).map(corner).collect();
        assert!(apart(vec![chain(Role::Outer { polygon: 0 }, &ring)], Side::Outside));
    }
}
