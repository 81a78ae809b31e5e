//! Ground that stands up: vertical faces, and `y` for the height.

use super::at;
use super::coordinates::Coordinates;
use super::place::{defect, point, short};
use crate::model::{Defect, Defects, Terrain};
use glam::DVec3;
use rustc_hash::{FxHashMap, FxHashSet};

/// Height of a triangle without area in plan, in the length unit, up to which it is nothing but a straight line.
const THIN: f64 = 1e-6;

/// Refuses vertical faces among `flat`, the triangles without area in plan.
///
/// A triangle with three corners on one line in plan whose longest side borders no other is a sliver at the edge of a
/// triangulation: it may go, and the surface stays whole. Elsewhere, it is a wall.
pub(super) fn check(label: &str, terrain: &Terrain, triangles: &[[u32; 3]], flat: &[usize]) -> Result<(), Defects> {
    let thick: Vec<(usize, Panel)> = flat
        .iter()
        .map(|&i| (i, Panel::new(triangles[i], triangles[i].map(|v| at(&terrain.vertices, v)))))
        .filter(|(_, panel)| panel.height > THIN)
        .collect();
    if thick.is_empty() {
        return Ok(());
    }
    // How often triangles with an area use the longest sides.
    let mut sides: FxHashMap<[u32; 2], bool> = thick.iter().filter_map(|(_, panel)| panel.long).map(|e| (e, false)).collect();
    let flat: FxHashSet<usize> = flat.iter().copied().collect();
    for (i, t) in triangles.iter().enumerate() {
        for e in [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]] {
            if let Some(shared) = sides.get_mut(&sorted(e)) {
                *shared |= !flat.contains(&i);
            }
        }
    }
    let mut defects = Defects::default();
    for (i, panel) in &thick {
        if panel.long.is_none_or(|e| sides.get(&e).copied().unwrap_or(false)) {
            const CODE: &str = "ground-vertical-face";
            defects.push(CODE, || Defect {
                code: CODE,
                what: "the ground has vertical faces: it has no single height there".into(),
                at: format!("{label}, triangle {} at {}", i + 1, point(terrain.frame.to_world(panel.at))),
                figures: Some(format!("{} high", short(panel.height))),
                help: "give the surface of the ground only, without walls, skirts and undersides; pull the top edge of a \
                       vertical step back by a centimetre"
                    .into(),
            });
        }
    }
    defects.into_result()
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// A triangle whose corners are on one line in plan.
struct Panel {
    /// Its longest side in plan; `None` if two corners are one above the other.
    long: Option<[u32; 2]>,
    /// How far the third corner is above or below that side.
    height: f64,
    /// One of its corners.
    at: DVec3,
}

impl Panel {
    fn new(t: [u32; 3], p: [DVec3; 3]) -> Self {
        let length = |i: usize| p[i].truncate().distance_squared(p[(i + 1) % 3].truncate());
        let long = (0..3).max_by(|&i, &j| length(i).total_cmp(&length(j))).unwrap_or(0);
        let (a, b, c) = (p[long], p[(long + 1) % 3], p[(long + 2) % 3]);
        let whole = length(long);
        // Without any extent in plan the triangle is a line that stands up.
        let share = if whole > 0.0 { (c - a).truncate().dot((b - a).truncate()) / whole } else { 0.0 };
        let height = if whole > 0.0 { (c.z - a.z - share * (b.z - a.z)).abs() } else { 0.0 };
        let above = (0..3).any(|i| length(i) == 0.0);
        Self { long: (!above).then(|| sorted([t[long], t[(long + 1) % 3]])), height, at: c }
    }
}

/// Share of triangles that must wind the other way, or stand up, before `y` is taken for the height.
const MIXED: f64 = 0.1;

/// How much larger the extent in `z` must be than that in `y`.
const TALL: f64 = 2.0;

/// Refuses ground whose `y` is its height, as modelling programs write it: seen along `z` it is a side view, with triangles of
/// either direction, and `z` is a northing.
pub(super) fn y_up(label: &str, coordinates: &Coordinates, count: usize, turned: usize, upright: usize) -> Result<(), Defects> {
    let extent = coordinates.hi - coordinates.lo;
    let side = (turned.min(count - turned) + upright) as f64 / count.max(1) as f64;
    if side < MIXED || extent.z < TALL * extent.y {
        return Ok(());
    }
    let figures = format!(
        "extents: x {}, y {}, z {}; {turned} of {count} triangles are clockwise and {upright} upright",
        short(extent.x),
        short(extent.y),
        short(extent.z)
    );
    Err(on_its_side(label, figures))
}

/// Height in the length unit beyond which there is no ground, in metres or in feet.
const HIGHEST: f64 = 1e5;

/// Refuses ground with `y` as its height by its figures alone: `z` can be no height, and `y` can be one.
pub(super) fn far_up(label: &str, lo: DVec3, hi: DVec3) -> Result<(), Defects> {
    let extent = hi - lo;
    let height = |lo: f64, hi: f64| lo.abs().min(hi.abs()) < HIGHEST || lo.signum() != hi.signum();
    if height(lo.z, hi.z) || !height(lo.y, hi.y) || extent.z < extent.y {
        return Ok(());
    }
    let figures = format!("y {} to {}, z {} to {}", short(lo.y), short(hi.y), short(lo.z), short(hi.z));
    Err(on_its_side(label, figures))
}

fn on_its_side(label: &str, figures: String) -> Defects {
    let what = "the ground stands upright: `y` seems to be its height, and `z` its northing";
    let help = "export it with Z up, or exchange the columns: x, −z, y";
    defect("ground-y-up", what, label.to_owned(), figures, help)
}
