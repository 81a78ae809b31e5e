//! What must not matter: where things are, which way they are turned, the order of the file, the number of threads.

use super::row;
use crate::model::Extent;
use crate::selftest::jobs::{Build, GROUND, LINE, Shape, features, open, plane, rectangle, ring};
use crate::selftest::{Bound, Case, Row, Task};

const GROUP: &str = "What must not matter";

/// Name of the line of the second job.
const OTHER: &str = "other.geojson";

/// Place of the Universal Transverse Mercator grid.
const FAR: [f64; 2] = [500_000.0, 5_400_000.0];

pub(super) fn cases() -> Vec<Case> {
    vec![far(), far_on_ground(), turned(), mirrored(), upside_down(), order(), threads()]
}

/// A ring of five corners at different heights, nowhere symmetrical.
fn crooked() -> Shape {
    ring(&[[-14.0, -9.0, 5.0], [13.0, -11.0, 5.5], [17.0, 6.0, 6.0], [1.0, 12.0, 5.25], [-11.0, 8.0, 4.75]])
}

fn twice(name: &'static str, other: &Shape, first: Build, second: Build, rows: Vec<Row>) -> Case {
    let files = vec![(LINE, features(&[crooked()])), (OTHER, features(std::slice::from_ref(other)))];
    Case { group: GROUP, name, files, jobs: vec![first.task(), second.line(OTHER).task()], exact: false, rows }
}

/// How much a figure of the second job is off one of the first.
fn off(first: &'static str, second: &'static str, formula: &str, bound: Bound) -> Row {
    let name = if first == second { first.to_owned() } else { format!("{first}, {second}") };
    row(&format!("{name}: difference"), formula, 0.0, bound, move |outcomes| {
        Some(outcomes.get(1)?.number(second)? - outcomes.first()?.number(first)?)
    })
}

fn down() -> Build {
    Build::new(0.5, Extent::Elevation(0.0))
}

fn far() -> Case {
    let rows = vec![
        off("volumes.fill", "volumes.fill", "0: moved to E 500 000, N 5 400 000", Bound::Fixed(1e-6)),
        off("surface.plan_area", "surface.plan_area", "0", Bound::Fixed(1e-6)),
    ];
    let moved = crooked().map(|[x, y, z]| [x + FAR[0], y + FAR[1], z]);
    twice("far from the origin", &moved, down(), down(), rows)
}

fn far_on_ground() -> Case {
    let pad = rectangle([-15.0, -10.0, 3.0], 30.0, 20.0);
    let moved = pad.map(|[x, y, z]| [x + FAR[0], y + FAR[1], z]);
    let height = |x: f64, y: f64| 3.0 + 0.0625 * x + 0.125 * y;
    let files = vec![
        (LINE, features(&[pad])),
        (GROUND, plane([0.0; 2], 128.0, height)),
        (OTHER, features(&[moved])),
        ("far.obj", plane(FAR, 128.0, |x, y| height(x - FAR[0], y - FAR[1]))),
    ];
    let second = Build::on_ground(0.5).line(OTHER).ground("far.obj");
    let rows = vec![
        off("volumes.cut", "volumes.cut", "0: moved to E 500 000, N 5 400 000", Bound::Fixed(1e-6)),
        off("volumes.fill", "volumes.fill", "0", Bound::Fixed(1e-6)),
        off("daylight.length", "daylight.length", "0", Bound::Fixed(1e-6)),
    ];
    let jobs = vec![Build::on_ground(0.5).task(), second.task()];
    Case { group: GROUP, name: "far from the origin, on ground", files, jobs, exact: false, rows }
}

/// Chords of cones begin elsewhere: within the bound that is reported.
fn turned() -> Case {
    let rows = vec![
        off("volumes.fill", "volumes.fill", "0: turned by cos = 0.6", Bound::Reported(1.0)),
        off("surface.platform_area", "surface.platform_area", "0", Bound::Fixed(1e-9)),
    ];
    let other = crooked().map(|[x, y, z]| [0.6 * x - 0.8 * y, 0.8 * x + 0.6 * y, z]);
    twice("turned", &other, down(), down(), rows)
}

fn mirrored() -> Case {
    let rows = vec![off("volumes.fill", "volumes.fill", "0: x to −x", Bound::Reported(1.0))];
    twice("mirrored in plan", &crooked().map(|[x, y, z]| [-x, y, z]), down(), down(), rows)
}

/// Fill below a line is cut above the line mirrored in z.
fn upside_down() -> Case {
    let rows = vec![
        off("volumes.fill", "volumes.cut", "0: z to −z", Bound::Fixed(1e-9)),
        off("surface.fill_slope_area", "surface.cut_slope_area", "0", Bound::Fixed(1e-9)),
    ];
    let up = Build::new(0.5, Extent::Elevation(0.0)).rising();
    twice("cut for fill, mirrored in z", &crooked().map(|[x, y, z]| [x, y, -z]), down(), up, rows)
}

/// Whether the results of the first two jobs differ, as a number.
fn same(formula: &str) -> Row {
    row("results that differ", formula, 0.0, Bound::Fixed(0.0), |outcomes| {
        let (first, second) = (outcomes.first()?.result()?, outcomes.get(1)?.result()?);
        Some(f64::from(u8::from(first != second)))
    })
}

fn order() -> Case {
    let line = open(&[[-40.0, 30.0, 8.0], [0.0, 40.0, 7.0], [30.0, 25.0, 9.0]]);
    let mut other = crooked();
    other.points.rotate_left(2);
    other.points.reverse();
    let files = vec![(LINE, features(&[crooked(), line.clone()])), (OTHER, features(&[line, other]))];
    let jobs = vec![down().task(), down().line(OTHER).task()];
    let rows = vec![same("0: lines in another order, a ring from another corner the other way round")];
    Case { group: GROUP, name: "order of the file", files, jobs, exact: false, rows }
}

fn threads() -> Case {
    let jobs = vec![down().task(), Task::OneThread(Box::new(down().task()))];
    let rows = vec![same("0: on all threads and on one")];
    Case { group: GROUP, name: "number of threads", files: vec![(LINE, features(&[crooked()]))], jobs, exact: false, rows }
}
