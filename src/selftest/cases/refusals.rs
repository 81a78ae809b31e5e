//! What must be refused.

use crate::model::Extent;
use crate::selftest::jobs::{Build, GROUND, LINE, between, features, obj, open, plane, rectangle, ring, volume};
use crate::selftest::{Case, Expected, Row, Task};

const GROUP: &str = "Refusals";

pub(super) fn cases() -> Vec<Case> {
    vec![
        lines(
            "segment as steep as the slope",
            features(&[open(&[[0.0, 0.0, 0.0], [10.0, 0.0, 6.0]])]),
            "as steep as the slope asked for",
        ),
        lines(
            "elevation that is no number",
            features(&[open(&[[0.0, 0.0, 0.0], [10.0, 0.0, f64::NAN]])]).replace("NaN", "null"),
            "z is null",
        ),
        lines("longitude and latitude", features(&[open(&[[11.5, 48.1, 500.0], [11.6, 48.2, 501.0]])]), "degrees"),
        lines("ring that crosses itself", features(&[bow_tie()]), "cross"),
        lines("line without length", features(&[open(&[[1.0, 1.0, 0.0], [1.0, 1.0, 0.0]])]), "at least 2 distinct vertices"),
        ground(
            "easting and northing swapped",
            plane([5_400_000.0, 500_000.0], 200.0, |_, _| 0.0),
            "do not lie at the same place",
        ),
        ground("ground too small for the slopes", plane([500_000.0, 5_400_000.0], 20.0, |_, _| 0.0), "do not meet the ground"),
        ground("gap in the ground", gap(), "no ground"),
        ground("ground that lies upon itself", double(), "triangles of the ground lie on each other"),
        twice_there(),
    ]
}

fn refused(name: &'static str, files: Vec<(&'static str, String)>, task: Task, words: &'static str) -> Case {
    let row = Row {
        figure: "the job".to_owned(),
        formula: format!("the message has `{words}`"),
        expected: Expected::Refusal { job: 0, words },
    };
    Case { group: GROUP, name, files, jobs: vec![task], exact: true, rows: vec![row] }
}

fn lines(name: &'static str, line: String, words: &'static str) -> Case {
    refused(name, vec![(LINE, line)], Build::new(0.5, Extent::Height(5.0)).task(), words)
}

/// A pad of 30 by 20, 10 above ground at E 500 000, N 5 400 000.
fn ground(name: &'static str, ground: String, words: &'static str) -> Case {
    let pad = rectangle([499_985.0, 5_399_990.0, 10.0], 30.0, 20.0);
    refused(name, vec![(LINE, features(&[pad])), (GROUND, ground)], Build::on_ground(0.5).task(), words)
}

fn bow_tie() -> crate::selftest::jobs::Shape {
    ring(&[[0.0, 0.0, 5.0], [10.0, 10.0, 5.0], [10.0, 0.0, 5.0], [0.0, 10.0, 5.0]])
}

/// A square of ground with a square missing in the middle, under the pad.
fn gap() -> String {
    let square = |reach: f64| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [500_000.0 + x * reach, 5_400_000.0 + y * reach, 0.0])
    };
    let faces: [&[usize]; 4] = [&[0, 1, 5, 4], &[1, 2, 6, 5], &[2, 3, 7, 6], &[3, 0, 4, 7]];
    obj(&[square(200.0), square(5.0)].concat(), &faces)
}

/// Two squares of ground, one above the other.
fn double() -> String {
    let square = |z: f64| {
        [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]].map(|[x, y]| [500_000.0 + x * 200.0, 5_400_000.0 + y * 200.0, z])
    };
    obj(&[square(0.0), square(1.0)].concat(), &[&[0, 1, 2, 3], &[4, 5, 6, 7]])
}

fn twice_there() -> Case {
    let files = vec![("a.obj", double()), ("b.obj", plane([500_000.0, 5_400_000.0], 200.0, |_, _| 0.0))];
    refused(
        "volume of a surface that lies upon itself",
        files,
        volume(between("a.obj", "b.obj"), None),
        "lie on each other in plan",
    )
}
