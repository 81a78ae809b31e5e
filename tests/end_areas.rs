//! Volumes from end areas against published tables, in the folder named by the environment variable `SLOPEGEN_DATA`. Without the
//! folder nothing is tested here; the unit tests of `ground` hold the same kind of case in small.

#![allow(clippy::print_stderr, reason = "tells what was skipped")]

use glam::DVec2;
use slopegen::ground::{Axis, Corner, Piece, SectionFigures, Sections, Stations, Tallied, Tally, average_end_area, prismoidal};
use slopegen::model::Part;
use std::path::PathBuf;

/// Cubic feet in a cubic yard.
const YARD: f64 = 27.0;

fn truth(name: &str) -> Option<String> {
    let Some(folder) = std::env::var_os("SLOPEGEN_DATA") else {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
        return None;
    };
    let path = PathBuf::from(folder).join("truth").join(name);
    Some(std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())))
}

/// The fields of a row, quoted ones included.
fn fields(row: &str) -> Vec<String> {
    let mut fields = vec![String::new()];
    let mut quoted = false;
    for c in row.chars() {
        match c {
            '"' => quoted = !quoted,
            ',' if !quoted => fields.push(String::new()),
            c => fields.last_mut().unwrap().push(c),
        }
    }
    fields
}

fn run(length: f64, spacing: f64, pieces: &[(Part, Vec<Corner>)]) -> (Tallied, SectionFigures) {
    let line = vec![(DVec2::ZERO, 0.0), (DVec2::new(length, 0.0), length)];
    let stations = Stations::new(vec![Axis { name: "a".into(), length, closed: false, line }], Some(spacing)).unwrap();
    let (mut tally, mut sections) = (Tally::new(&stations), Sections::new(&stations));
    for (part, corners) in pieces {
        let piece = Piece { part: *part, axis: Some(0), corners };
        tally.add(&piece);
        sections.add(&piece);
    }
    (tally.finish(), sections.finish())
}

/// The highway table of the Indiana Department of Transportation: areas in square feet to one decimal, volumes of the 50 ft
/// before each station in whole cubic yards. So each volume may be off by half a yard, and by 50/27 · 0.05 from its areas.
#[test]
fn highway_table() {
    let Some(table) = truth("indot_end_areas_20+00_31+50.csv") else { return };
    let rows: Vec<Vec<f64>> =
        table.lines().skip(1).map(|row| row.split(',').skip(1).map(|field| field.parse().unwrap()).collect()).collect();
    let error = 0.5 + 50.0 / YARD * 0.05 + 1e-9;
    let mut compared = 0;
    for pair in rows.windows(2) {
        for column in 0..3 {
            let found = average_end_area(50.0, [pair[0][column], pair[1][column]]) / YARD;
            assert!((found - pair[1][column + 3]).abs() <= error, "{found} for {}", pair[1][column + 3]);
            compared += 1;
        }
    }
    assert_eq!(compared, 23 * 3);
}

/// The same table through the sections themselves: a platform 10 wide whose heights give the areas, one bay between two stations.
/// Heights are linear in a bay, so the exact volumes, the end areas and the prismoidal figures are the same.
#[test]
fn highway_table_as_a_road() {
    const WIDTH: f64 = 10.0;
    let Some(table) = truth("indot_end_areas_20+00_31+50.csv") else { return };
    let areas: Vec<f64> = table.lines().skip(1).map(|row| row.split(',').nth(2).unwrap().parse().unwrap()).collect();
    let volumes: Vec<f64> = table.lines().skip(1).map(|row| row.split(',').nth(5).unwrap().parse().unwrap()).collect();
    let mut pieces = Vec::new();
    for (i, pair) in areas.windows(2).enumerate() {
        let from = 50.0 * i as f64;
        let at = |x: f64, y: f64, area: f64| Corner { at: DVec2::new(x, y), height: area / WIDTH, station: x };
        let (low, high) = (-0.5 * WIDTH, 0.5 * WIDTH);
        let to = from + 50.0;
        pieces.push((
            Part::Platform,
            vec![at(from, low, pair[0]), at(to, low, pair[1]), at(to, high, pair[1]), at(from, high, pair[0])],
        ));
    }
    let (tallied, sections) = run(50.0 * (areas.len() - 1) as f64, 50.0, &pieces);
    for (i, expected) in volumes[1..].iter().enumerate() {
        let exact = tallied.axes[0][i].amounts.fill;
        for found in [exact, sections.axes[0][i].average_end_area.fill, sections.axes[0][i].prismoidal.fill] {
            assert!((found - exact).abs() < 1e-9 && (found / YARD - expected).abs() <= 0.6, "{found} at {i} for {expected}");
        }
    }
}

#[test]
fn textbook_cases() {
    let Some(table) = truth("textbook.csv") else { return };
    let row = |id: &str| fields(table.lines().find(|line| line.starts_with(&format!("{id},"))).expect("the case is listed"));
    let number = |id: &str| row(id)[2].parse::<f64>().expect("a number is expected");

    // T1: an embankment 11 wide, 2H:1V in section, 0.5 high growing to 2.5 over 150.
    let h = |x: f64| 0.5 + x / 75.0;
    assert!((prismoidal(150.0, [6.0, 40.0], 21.0) - number("T1")).abs() < 1e-9);
    let at = |x: f64, y: f64, height: f64| Corner { at: DVec2::new(x, y), height, station: x };
    let toe = |x: f64| 5.5 + 2.0 * h(x);
    let (near, far) = (0.0, 150.0);
    let pieces = [
        (Part::Platform, vec![at(near, -5.5, h(near)), at(far, -5.5, h(far)), at(far, 5.5, h(far)), at(near, 5.5, h(near))]),
        (Part::FillSlope, vec![at(near, 5.5, h(near)), at(far, 5.5, h(far)), at(far, toe(far), 0.0), at(near, toe(near), 0.0)]),
        (
            Part::FillSlope,
            vec![at(near, -toe(near), 0.0), at(far, -toe(far), 0.0), at(far, -5.5, h(far)), at(near, -5.5, h(near))],
        ),
    ];
    for spacing in [150.0, 20.0] {
        let (tallied, sections) = run(150.0, spacing, &pieces);
        assert!((tallied.total.fill - number("T1")).abs() < 1e-9);
        assert!((sections.prismoidal.fill - number("T1")).abs() < 1e-9);
    }
    assert!((run(150.0, 150.0, &pieces).1.average_end_area.fill - 3450.0).abs() < 1e-9);

    // T4: differences +1, −1, −1 over half a unit square, design minus ground: the positive part is 1/24.
    let triangle = [at(0.0, 0.0, 1.0), at(1.0, 0.0, -1.0), at(0.0, 1.0, -1.0)];
    let (tallied, _) = run(1.0, 1.0, &[(Part::Platform, triangle.to_vec())]);
    assert!((tallied.total.fill - number("T4")).abs() < 1e-10);
    assert!((tallied.total.cut - 5.0 / 24.0).abs() < 1e-15);

    // T9, T10: end areas as given with the cases.
    let expected: Vec<f64> = row("T9")[2].split(' ').map(|field| field.parse().unwrap()).collect();
    let areas = [0.0, 580.0, 2100.0, 4650.0, 5870.0];
    assert_eq!(expected.len(), 4);
    for (pair, expected) in areas.windows(2).zip(expected) {
        assert!((average_end_area(100.0, [pair[0], pair[1]]) / YARD - expected).abs() < 0.005);
    }
    assert_eq!(average_end_area(100.0, [80.0, 140.0]), number("T10"));
}
