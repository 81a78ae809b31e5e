//! Whether line and ground lie at the same place, and what may be wrong where they do not.

use super::at;
use super::place::{defect, short};
use crate::kernel::plan_box::PlanBox;
use crate::kernel::range::range;
use crate::model::{Defects, Line, Terrain};
use glam::{DVec2, Vec2Swizzles};

/// Factors between length units: those of the line times the factor are those of the ground.
const UNITS: [(f64, &str); 4] = [
    (0.3048, "the line seems to be in feet and the ground in metres"),
    (1.0 / 0.3048, "the line seems to be in metres and the ground in feet"),
    (1200.0 / 3937.0, "the line seems to be in US survey feet and the ground in metres"),
    (3937.0 / 1200.0, "the line seems to be in metres and the ground in US survey feet"),
];

/// Step of false eastings that carry a zone or a district number in front.
const ZONE: f64 = 1e6;

/// Triangles whose box is taken before it is compared with that of the line.
const CHUNK: usize = 4096;

fn inside(one: &PlanBox, other: &PlanBox) -> bool {
    other.lo.cmple(one.lo).all() && one.hi.cmple(other.hi).all()
}

/// Distance from box to box, along the axis on which they are further apart.
fn gap(one: &PlanBox, other: &PlanBox) -> f64 {
    (one.lo - other.hi).max(other.lo - one.hi).max_element()
}

fn mapped(one: &PlanBox, of: impl Fn(DVec2) -> DVec2) -> PlanBox {
    PlanBox::of([of(one.lo), of(one.hi)])
}

fn text(PlanBox { lo, hi }: &PlanBox) -> String {
    format!("x {} to {}, y {} to {}", short(lo.x), short(hi.x), short(lo.y), short(hi.y))
}

/// Refuses a line of which no part can lie on the ground: their boxes in plan do not meet. Only vertices that triangles use
/// count. `ground` and `label` name the files.
///
/// # Errors
/// Both boxes, and what would make them meet where that is clear: axes exchanged, feet against metres, Y-up, a zone number in
/// front of the easting.
pub fn check_overlap(terrain: &Terrain, ground: &str, line: &Line, label: &str) -> Result<(), Defects> {
    let world = |v: u32| terrain.frame.to_world(at(&terrain.vertices, v));
    let road = line.plan_box();
    let mut field = PlanBox::EMPTY;
    // The box only grows, so that the first part of the ground which meets the line decides.
    for some in terrain.triangles.chunks(CHUNK) {
        field = field.join(PlanBox::of(some.as_flattened().iter().map(|&v| world(v).truncate())));
        if road.meets(&field) {
            return Ok(());
        }
    }
    let heights = || {
        let corners = terrain.triangles.as_flattened().iter();
        range(corners.map(|&v| world(v).z))
    };
    let help = guess(&road, &field, heights)
        .unwrap_or_else(|| "check that both are in the same reference system and unit, and belong together".into());
    let apart = field.middle() - road.middle();
    let figures = format!(
        "line: {}\n   = ground `{ground}`: {}\n   = from the middle of the line to that of the ground: ({}, {})",
        text(&road),
        text(&field),
        short(apart.x),
        short(apart.y)
    );
    Err(defect("no-overlap", "line and ground do not lie at the same place", label.to_owned(), figures, &help))
}

fn guess(road: &PlanBox, field: &PlanBox, heights: impl Fn() -> (f64, f64)) -> Option<String> {
    if mapped(road, |p| p.yx()).meets(field) {
        return Some(
            "easting and northing of one of them seem to be exchanged: name the columns, or exchange them in the file; for LandXML \
             with easting first give `--terrain-order enz`, or `--csv-order enz` for a line"
                .into(),
        );
    }
    // Another unit or zone would put it far away.
    let gap = gap(road, field);
    if gap <= road.size().max(field.size()).max_element() {
        return Some(format!("the line lies {} beside the ground: use a ground that reaches beyond the works", short(gap)));
    }
    // Both feet may fit: the one that puts the whole line on the ground fits better.
    let scaled = |whole: bool| {
        UNITS.iter().find(|(factor, _)| {
            let road = mapped(road, |p| p * *factor);
            if whole { inside(&road, field) } else { road.meets(field) }
        })
    };
    if let Some((_, what)) = scaled(true).or_else(|| scaled(false)) {
        return Some(format!("{what}: convert one of them, heights as well"));
    }
    let (low, high) = heights();
    for (lo, hi) in [(-high, -low), (low, high)] {
        let upright = PlanBox { lo: DVec2::new(field.lo.x, lo), hi: DVec2::new(field.hi.x, hi) };
        if road.meets(&upright) {
            return Some("`y` of the ground seems to be its height, and `z` its northing: export it with Z up".into());
        }
    }
    let zones = ((field.lo.x + field.hi.x - road.lo.x - road.hi.x) / (2.0 * ZONE)).round();
    if zones != 0.0 && mapped(road, |p| p + DVec2::new(zones * ZONE, 0.0)).meets(field) {
        let which = if zones > 0.0 { "ground" } else { "line" };
        return Some(format!(
            "the eastings differ by {} million: that of the {which} seems to have the number of its zone in front; take it away",
            zones.abs()
        ));
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;
    use crate::model::{Chain, Place, Role};
    use glam::DVec3;

    fn message(line: &[(f64, f64)], corner: DVec3, size: DVec3) -> Option<String> {
        let vertices: Vec<DVec3> = line.iter().map(|&(x, y)| DVec3::new(x, y, 5.0)).collect();
        let places = vec![Place::default(); vertices.len()];
        let line = Line {
            chains: vec![Chain { name: "line 1".into(), role: Role::Open, vertices, places, axis: None }],
            breaklines: Vec::new(),
        };
        let frame = Frame::around(corner.truncate(), (corner + size).truncate());
        let ground = [DVec3::ZERO, DVec3::X, DVec3::Y + DVec3::Z].map(|p| frame.to_local(corner + p * size));
        // A vertex no triangle uses must not count.
        let vertices = [&ground[..], &[frame.to_local(DVec3::new(500_000.0, 5_400_000.0, 0.0))]].concat();
        let terrain = Terrain { frame, vertices, triangles: vec![[0, 1, 2]] };
        check_overlap(&terrain, "ground.obj", &line, "road.csv").err().map(|e| e.to_string())
    }

    #[test]
    fn guesses() {
        let line = [(500_000.0, 5_400_000.0), (500_100.0, 5_400_050.0)];
        let size = DVec3::new(200.0, 200.0, 30.0);
        let at = |x: f64, y: f64| DVec3::new(x, y, 100.0);
        assert_eq!(message(&line, at(499_950.0, 5_399_950.0), size), None);
        for (corner, size, words) in [
            (at(5_399_950.0, 499_950.0), size, "exchanged"),
            (at(499_950.0 / 0.3048, 5_399_950.0 / 0.3048), size / 0.3048, "line seems to be in metres and the ground in feet"),
            (at(499_950.0 * 0.3048, 5_399_950.0 * 0.3048), size * 0.3048, "line seems to be in feet and the ground in metres"),
            (at(499_950.0 * 1200.0 / 3937.0, 5_399_995.0 * 1200.0 / 3937.0), size, "US survey feet"),
            (DVec3::new(499_950.0, 100.0, -5_400_100.0), DVec3::new(200.0, 30.0, 200.0), "export it with Z up"),
            (at(32_499_950.0, 5_399_950.0), size, "differ by 32 million: that of the ground"),
            (at(600_000.0, 5_399_950.0), size, "same reference system"),
            (at(500_101.5, 5_400_000.0), size, "the line lies 1.5 beside the ground"),
        ] {
            let message = message(&line, corner, size).unwrap();
            assert!(message.contains(words), "{words}\n{message}");
        }
        // Close to zero a factor moves nothing far.
        let beside = message(&[(101.0, -10.0), (120.0, 10.0)], DVec3::new(-100.0, -100.0, 0.0), size).unwrap();
        assert!(beside.contains("the line lies 1 beside the ground: use a ground that reaches beyond the works"), "{beside}");
        assert_eq!(
            message(&line, at(0.0, 0.0), size).unwrap(),
            "line and ground do not lie at the same place\n  --> road.csv\n   = line: x 500000 to 500100, y 5400000 to 5400050\n   \
             = ground `ground.obj`: x 0 to 200, y 0 to 200\n   \
             = from the middle of the line to that of the ground: (-499950, -5399925)\n   \
             = help: check that both are in the same reference system and unit, and belong together"
        );
    }
}
