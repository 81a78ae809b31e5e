//! Volumes between two surfaces: `slopegen volume`.

use super::{exact, key};
use crate::pipeline::Against;
use crate::selftest::formulas::frustum_volume;
use crate::selftest::jobs::{LINE, between, features, obj, plane, rectangle, volume};
use crate::selftest::{Bound, Case, Row, Task};
use std::path::PathBuf;

const GROUP: &str = "Between surfaces";

fn case(name: &'static str, files: Vec<(&'static str, String)>, task: Task, rows: Vec<Row>) -> Case {
    Case { group: GROUP, name, files, jobs: vec![task], exact: true, rows }
}

pub(super) fn cases() -> Vec<Case> {
    vec![wedge(), frustum(), within(), itself()]
}

/// Two planes that cross: a wedge on either side.
fn wedge() -> Case {
    let (a, s) = (0.1, 10.0);
    let files = vec![("a.obj", plane([0.0; 2], s, |x, _| a * x)), ("b.obj", plane([0.0; 2], s, |_, _| 0.0))];
    let rows = vec![
        exact("volumes.cut", "a·s³, a = 0.1, s = 10", a * s * s * s),
        exact("volumes.fill", "a·s³", a * s * s * s),
        exact("areas.cut", "2·s²", 2.0 * s * s),
        exact("depths.fill_max", "a·s", a * s),
    ];
    case("wedges between two planes", files, volume(between("a.obj", "b.obj"), None), rows)
}

/// A frustum of a pyramid, brought down to its foot.
fn frustum() -> Case {
    let (base, top, h) = (20.0, 8.0, 6.0);
    let square = |side: f64, z: f64| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [x * side / 2.0, y * side / 2.0, z])
    };
    let vertices = [square(base, 0.0), square(top, h)].concat();
    let faces: [&[usize]; 5] = [&[4, 5, 6, 7], &[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
    let against = Against::Elevation { existing: PathBuf::from("a.obj"), elevation: 0.0 };
    let half = Against::Elevation { existing: PathBuf::from("a.obj"), elevation: h / 2.0 };
    let middle = (base + top) / 2.0;
    let upper = frustum_volume(h / 2.0, middle * middle, top * top);
    let rows = vec![
        exact("volumes.cut", "h/3·(a + b + √(a·b)), a = 20², b = 8², h = 6", frustum_volume(h, base * base, top * top)),
        super::row("volumes.cut above half its height", "the same with a = 14², h = 3", upper, Bound::Fixed(1e-9), |outcomes| {
            outcomes.get(1)?.number("volumes.cut")
        }),
        super::row(
            "volumes.fill below half its height",
            "20²·h/2 less the lower frustum",
            base * base * h / 2.0 - frustum_volume(h / 2.0, base * base, middle * middle),
            Bound::Fixed(1e-9),
            |outcomes| outcomes.get(1)?.number("volumes.fill"),
        ),
    ];
    let mut case =
        case("frustum of a pyramid above a level", vec![("a.obj", obj(&vertices, &faces))], volume(against, None), rows);
    case.jobs.push(volume(half, None));
    case
}

/// Only inside a ring.
fn within() -> Case {
    let files = vec![
        ("a.obj", plane([0.0; 2], 10.0, |x, y| 2.0 + 0.1 * x - 0.2 * y)),
        ("b.obj", plane([0.0; 2], 10.0, |x, y| 0.1 * x - 0.2 * y)),
        (LINE, features(&[rectangle([-3.0, -2.0, 0.0], 7.0, 5.0)])),
    ];
    let rows = vec![
        exact("volumes.fill", "l·w·d, l = 7, w = 5, d = 2", 70.0),
        exact("areas.within", "l·w", 35.0),
        key("volumes.cut", "0", 0.0, Bound::Fixed(0.0)),
    ];
    case("prism inside a ring", files, volume(between("a.obj", "b.obj"), Some(LINE)), rows)
}

fn itself() -> Case {
    let files = vec![
        ("a.obj", plane([0.0; 2], 10.0, |x, y| 0.3 * x + 0.7 * y)),
        ("b.obj", plane([0.0; 2], 10.0, |x, y| 0.3 * x + 0.7 * y)),
    ];
    let rows = vec![
        key("volumes.cut", "0", 0.0, Bound::Fixed(0.0)),
        key("volumes.fill", "0", 0.0, Bound::Fixed(0.0)),
        exact("areas.unaffected", "(2·s)², s = 10", 400.0),
    ];
    case("a surface and itself", files, volume(between("a.obj", "b.obj"), None), rows)
}
