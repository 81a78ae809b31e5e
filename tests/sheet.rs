//! The library's heights against brute force, on lines of all kinds; and the brute force against the definition.

mod common;

use common::lines::{Case, Random, case};
use common::oracle::{Polyline, burial, capsule_distance, height};
use glam::{DVec2, DVec3};
use slopegen::model::{Chain, Line, Place, Role, Sheet, Slope};
use slopegen::sheet::{Grid, Heights};

fn cases() -> impl Iterator<Item = Case> {
    (0..200).map(|seed| case(seed, 150))
}

/// A place about a random vertex: on it, close to it, or far off.
fn place(random: &mut Random, lines: &[Polyline]) -> [f64; 2] {
    let line = &lines[random.below(lines.len())];
    let p = line.points[random.below(line.points.len())];
    let reach = [0.0, 1e-3, 5.0, 50.0, 1e3][random.below(5)];
    [p[0] + random.between(-reach, reach), p[1] + random.between(-reach, reach)]
}

fn model(lines: &[Polyline], shift: DVec3) -> Line {
    let chain = |line: &Polyline| Chain {
        name: "line".into(),
        role: if line.closed { Role::Outer { polygon: 0 } } else { Role::Open },
        vertices: line.points.iter().map(|&p| DVec3::from(p) + shift).collect(),
        places: vec![Place::default(); line.points.len()],
        axis: None,
    };
    Line { chains: lines.iter().map(chain).collect(), ..Line::default() }
}

#[test]
fn heights_agree_with_brute_force() {
    let mut random = Random::new(1);
    for case in cases() {
        for (sheet, rising) in [(Sheet::Falling, false), (Sheet::Rising, true)] {
            let slope = Slope::from_ratio(case.k).expect("positive");
            let heights = Heights::new(&model(&case.lines, DVec3::ZERO), slope, sheet);
            for _ in 0..50 {
                let [x, y] = place(&mut random, &case.lines);
                let (found, expected) = (heights.at(DVec2::new(x, y)), height(&case.lines, case.k, rising, x, y));
                // Coordinates and heights of up to a few 1e4: 1e-15 of them, times the slope.
                assert!((found - expected).abs() <= 1e-10, "{}: {found} for {expected} at {x} {y}, {sheet:?}", case.name);
            }
        }
    }
}

#[test]
fn far_from_the_origin_only_the_rounding_of_the_input_is_lost() {
    let shift = DVec3::new(500_000.0, 5_000_000.0, 0.0);
    let mut random = Random::new(2);
    for case in cases().filter(|case| !case.name.starts_with("tiny")) {
        let slope = Slope::from_ratio(case.k).expect("positive");
        let near = Heights::new(&model(&case.lines, DVec3::ZERO), slope, Sheet::Falling);
        let far = Heights::new(&model(&case.lines, shift), slope, Sheet::Falling);
        let points: Vec<DVec2> = (0..20).map(|_| DVec2::from(place(&mut random, &case.lines))).collect();
        let moved: Vec<DVec2> = points.iter().map(|p| p + shift.truncate()).collect();
        for (found, p) in far.many(&moved).into_iter().zip(points) {
            // Plan coordinates of 5e6 are multiples of 1e-9; vertex and query are each off by half of that.
            assert!((found - near.at(p)).abs() <= 3e-9 * case.k, "{}: {found} for {} at {p}", case.name, near.at(p));
        }
    }
}

#[test]
fn rasters_agree_with_brute_force() {
    for case in cases().step_by(7) {
        let slope = Slope::from_ratio(case.k).expect("positive");
        let heights = Heights::new(&model(&case.lines, DVec3::ZERO), slope, Sheet::Rising);
        let [x, y, _] = case.lines[0].points[0];
        let grid = Grid { xll: x - 60.0, yll: y - 50.0, cell: 1.25, ncols: 90, nrows: 70 };
        for (i, found) in heights.raster(&grid).into_iter().enumerate() {
            let (east, north) = (i % 90, 69 - i / 90);
            let (x, y) = (grid.xll + 1.25 * east as f64, grid.yll + 1.25 * north as f64);
            let expected = height(&case.lines, case.k, true, x, y);
            assert!((found - expected).abs() <= 1e-10, "{}: {found} for {expected} at {x} {y}", case.name);
        }
    }
}

#[test]
fn brute_force_follows_the_definition() {
    let mut random = Random::new(3);
    for case in cases().filter(|case| case.lines.len() < 3) {
        let [x, y] = place(&mut random, &case.lines);
        let found = height(&case.lines, case.k, false, x, y);
        // The best of many points of the line, each a cone: never above, and below by no more than two slopes times half
        // of the spacing.
        let (mut best, mut spacing) = (f64::NEG_INFINITY, 0f64);
        for (a, b) in case.lines.iter().flat_map(Polyline::segments) {
            for i in 0..=500 {
                let w = f64::from(i) / 500.0;
                let p: [f64; 3] = std::array::from_fn(|j| a[j] * (1.0 - w) + b[j] * w);
                best = best.max(p[2] - case.k * (p[0] - x).hypot(p[1] - y));
            }
            spacing = spacing.max((b[0] - a[0]).hypot(b[1] - a[1]) / 500.0);
        }
        assert!(best <= found + 1e-10 && found <= best + case.k * spacing, "{}: {found} for {best} at {x} {y}", case.name);
        // The rising sheet is the falling one of the mirrored line, mirrored.
        let mut mirrored = case.lines.clone();
        mirrored.iter_mut().flat_map(|line| &mut line.points).for_each(|p| p[2] = -p[2]);
        assert_eq!(height(&mirrored, case.k, true, x, y), -found);
    }
}

#[test]
fn capsules_and_heights_tell_the_same_region() {
    let mut random = Random::new(4);
    for case in cases() {
        for rising in [false, true] {
            for _ in 0..20 {
                let [x, y] = place(&mut random, &case.lines);
                let h = height(&case.lines, case.k, rising, x, y);
                let toward = if rising { -1.0 } else { 1.0 };
                // A level above the sheet by `up`: the point lies outside by `up/k`, which is the distance to the nearest
                // capsule where there is one, and any sheet of slope k reaches the level after that way at the earliest.
                let up = random.between(0.0, 3.0);
                let outside = capsule_distance(&case.lines, case.k, rising, h + toward * up, x, y);
                assert!(outside >= (up / case.k) * (1.0 - 1e-9) - 1e-9, "{}: {outside} for {up}", case.name);
                let inside = capsule_distance(&case.lines, case.k, rising, h - toward * up, x, y);
                assert!((inside + up / case.k).abs() <= 1e-8, "{}: {inside} for {up} at {x} {y}", case.name);
            }
        }
    }
}

#[test]
fn made_lines_keep_their_promises() {
    for case in (0..400).map(|seed| case(seed, 80)) {
        let again = case_points(&common::lines::case(seed_of(&case), 80));
        assert_eq!(case_points(&case), again, "the same seed gives the same line");
        for line in &case.lines {
            assert!(line.points.len() >= if line.closed { 3 } else { 2 }, "{}", case.name);
            assert!(line.steepest() <= 0.98 * case.k, "{}: {}", case.name, line.steepest() / case.k);
            assert!(line.segments().all(|(a, b)| a[..2] != b[..2]), "{}", case.name);
        }
        let depth = burial(&case.lines, case.k, false, 4);
        assert!(case.may_be_buried || depth <= 1e-9, "{}: buried by {depth}", case.name);
    }
    let buried = (0..400).map(|seed| case(seed, 80)).filter(|case| burial(&case.lines, case.k, false, 4) > 0.01).count();
    assert!(buried >= 30, "only {buried} of 400 cases have buried stretches");
}

fn seed_of(case: &Case) -> u64 {
    let digits = case.name.split("seed ").nth(1).and_then(|rest| rest.split(',').next());
    digits.and_then(|digits| digits.parse().ok()).expect("a seed in the name")
}

fn case_points(case: &Case) -> Vec<Vec<[f64; 3]>> {
    case.lines.iter().map(|line| line.points.clone()).collect()
}
