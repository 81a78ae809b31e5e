use super::*;
use crate::ground::testing::{Random, corner, open_axis, straight_axis};
use proptest::prelude::*;

fn stations(length: f64, spacing: Option<f64>) -> Stations {
    Stations::new(vec![straight_axis(length)], spacing).unwrap()
}

fn tally(stations: &Stations, pieces: &[(Part, Option<u32>, Vec<Corner>)]) -> Tallied {
    let mut tally = Tally::new(stations);
    for (part, axis, corners) in pieces {
        tally.add(&Piece { part: *part, axis: *axis, corners });
    }
    tally.finish()
}

fn near(found: f64, expected: f64, scale: f64) {
    assert!((found - expected).abs() <= 1e-13 * scale, "{found} for {expected}");
}

/// A strip 4 wide with `h = x/10 − 2` from 0 to 50: cut up to x = 20, fill beyond.
/// Cut: 4 ∫₀²⁰ (2 − x/10) dx = 80; fill: 4 ∫₂₀⁵⁰ (x/10 − 2) dx = 180. Intervals of 15 by the antiderivative 4(x²/20 − 2x).
#[test]
fn a_strip_with_a_linear_height() {
    let stations = stations(50.0, Some(15.0));
    let corners = [(0.0, 0.0), (50.0, 0.0), (50.0, 4.0), (0.0, 4.0)].map(|(x, y): (f64, f64)| corner(x, y, x / 10.0 - 2.0));
    let found = tally(&stations, &[(Part::Platform, Some(0), corners.to_vec())]);
    near(found.total.cut, 80.0, 80.0);
    near(found.total.fill, 180.0, 180.0);
    near(found.total.cut_area, 80.0, 80.0);
    near(found.total.fill_area, 120.0, 120.0);
    assert_eq!(found.total.level_area, 0.0);
    assert_eq!((found.platform, found.fill_slope, found.pads), (found.total, Amounts::default(), Amounts::default()));
    let antiderivative = |x: f64| 4.0 * (x * x / 20.0 - 2.0 * x);
    let expected = [(0.0, 15.0), (15.0, 30.0), (30.0, 45.0), (45.0, 50.0)];
    assert_eq!(found.axes[0].len(), 4);
    for (interval, (from, to)) in found.axes[0].iter().zip(expected) {
        let turn = 20.0_f64.clamp(from, to);
        assert_eq!((interval.from, interval.to), (from, to));
        near(interval.amounts.cut, antiderivative(from) - antiderivative(turn), 80.0);
        near(interval.amounts.fill, antiderivative(to) - antiderivative(turn), 80.0);
        near(interval.amounts.net(), antiderivative(from) - antiderivative(to), 80.0);
        near(interval.amounts.cut_area, 4.0 * (turn - from), 80.0);
        near(interval.amounts.plan_area(), 4.0 * (to - from), 80.0);
    }
    let deepest = found.deepest_cut.unwrap();
    assert_eq!((deepest.depth, deepest.at, deepest.station), (2.0, DVec2::ZERO, Some((0, 0.0))));
    let deepest = found.deepest_fill.unwrap();
    assert_eq!((deepest.depth, deepest.at, deepest.station), (3.0, DVec2::new(50.0, 0.0), Some((0, 50.0))));
}

/// One triangle with differences +1, −1, −1 over the unit right triangle. The positive part is the similar triangle of half the
/// sides: volume 1/8 · 1/2 · 1/3 · 2 = 1/24 as area 1/8 times mean 1/3; the rest is 1/24 + 1/6 = 5/24. (Heights here are design
/// minus ground, so the figures stand for fill and cut.)
#[test]
fn a_triangle_of_both_signs() {
    let stations = Stations::new(vec![], None).unwrap();
    let corners = vec![corner(0.0, 0.0, 1.0), corner(1.0, 0.0, -1.0), corner(0.0, 1.0, -1.0)];
    let found = tally(&stations, &[(Part::Platform, None, corners)]);
    near(found.total.fill, 1.0 / 24.0, 1.0);
    near(found.total.cut, 5.0 / 24.0, 1.0);
    near(found.total.fill_area, 1.0 / 8.0, 1.0);
    near(found.total.cut_area, 3.0 / 8.0, 1.0);
    assert_eq!((found.pads, found.deepest_cut.unwrap().station), (found.total, None));
}

/// An embankment 11 wide, 2H:1V in section, height 0.5 growing to 2.5 over 150 (ground 1:50 up against a formation that falls
/// 1:150 the other way): end areas h(11 + 2h) = 6, 21, 40, so 150/6 · (6 + 4·21 + 40) = 3250.
#[test]
fn an_embankment_on_sloping_ground() {
    let stations = stations(150.0, Some(20.0));
    let h = |x: f64| 0.5 + x / 75.0;
    let mut pieces = vec![(Part::Platform, Some(0), vec![])];
    for (x, y) in [(0.0, -5.5), (150.0, -5.5), (150.0, 5.5), (0.0, 5.5)] {
        pieces[0].2.push(corner(x, y, h(x)));
    }
    for sign in [-1.0, 1.0] {
        let mut side = vec![
            corner(0.0, sign * 5.5, h(0.0)),
            corner(0.0, sign * (5.5 + 2.0 * h(0.0)), 0.0),
            corner(150.0, sign * (5.5 + 2.0 * h(150.0)), 0.0),
            corner(150.0, sign * 5.5, h(150.0)),
        ];
        if sign > 0.0 {
            side.reverse();
        }
        pieces.push((Part::FillSlope, Some(0), side));
    }
    let found = tally(&stations, &pieces);
    near(found.total.fill, 3250.0, 3250.0);
    near(found.platform.fill, 11.0 * 1.5 * 150.0, 3250.0);
    near(found.fill_slope.fill, 3250.0 - 2475.0, 3250.0);
    assert_eq!((found.total.cut, found.total.cut_area, found.cut_slope), (0.0, 0.0, Amounts::default()));
}

#[test]
fn a_sector_at_a_break_goes_to_the_interval_that_begins_there() {
    let axis = open_axis(&[(0.0, 0.0), (20.0, 0.0), (20.0, 20.0)]);
    let stations = Stations::new(vec![axis], Some(20.0)).unwrap();
    let sector =
        |station| [(20.0, 0.0), (20.0, -2.0), (22.0, 0.0)].map(|(x, y)| Corner { station, ..corner(x, y, 1.0) }).to_vec();
    for (station, expected) in [(0.0, [2.0, 0.0]), (20.0, [0.0, 2.0]), (20.0 - 1e-9, [2.0, 0.0]), (40.0, [0.0, 2.0])] {
        let found = tally(&stations, &[(Part::FillSlope, Some(0), sector(station))]);
        assert_eq!([0, 1].map(|i| found.axes[0][i].amounts.fill), expected, "{station}");
    }
}

#[test]
fn pieces_that_are_none() {
    let stations = stations(10.0, Some(3.0));
    let of = |part, axis, corners: &[Corner]| tally(&stations, &[(part, axis, corners.to_vec())]);
    let empty = of(Part::Platform, Some(0), &[]);
    assert_eq!(of(Part::Platform, Some(0), &[corner(0.0, 0.0, 5.0), corner(9.0, 0.0, 5.0)]), empty);
    let square = [(0.0, 0.0), (9.0, 0.0), (9.0, 1.0), (0.0, 1.0)];
    // An axis there is not is none; ground is no work.
    let up = square.map(|(x, y)| corner(x, y, 2.0));
    assert_eq!(of(Part::Platform, Some(7), &up).pads.fill, 18.0);
    assert_eq!(of(Part::Ground, Some(0), &up).total, Amounts::default());
    // What is neither cut nor fill is counted as area.
    let found = of(Part::CutSlope, Some(0), &square.map(|(x, y)| corner(x, y, 0.0)));
    assert_eq!((found.total.fill, found.total.cut, found.deepest_fill), (0.0, 0.0, None));
    near(found.total.level_area, 9.0, 9.0);
    // Stations beyond the axis go to its ends; what is no number changes nothing else.
    let found = of(Part::Platform, Some(0), &square.map(|(x, y)| Corner { station: x * 3.0 - 5.0, ..corner(x, y, 2.0) }));
    near(found.total.fill, 18.0, 18.0);
    let _ = of(Part::Platform, Some(0), &square.map(|(x, y)| Corner { station: f64::NAN, ..corner(x, y, 2.0) }));
    let _ = of(Part::Platform, Some(0), &square.map(|(x, y)| Corner { station: f64::INFINITY, ..corner(x, y, 2.0) }));
}

/// A convex polygon: points of an ellipse at ascending angles, with linear height and station.
fn convex(seed: u64, count: usize, length: f64) -> Vec<Corner> {
    let random = &mut Random::new(seed);
    let centre = DVec2::new(random.between(-50.0, 50.0), random.between(-50.0, 50.0));
    let size = DVec2::new(random.between(0.1, 20.0), random.between(0.1, 20.0));
    let (h, s) = ([0, 1, 2].map(|_| random.between(-1.0, 1.0)), [0, 1].map(|_| random.between(-2.0, 2.0)));
    let middle = random.between(0.2, 0.8) * length;
    let mut angles: Vec<f64> = (0..count).map(|_| random.between(0.0, std::f64::consts::TAU)).collect();
    angles.sort_by(f64::total_cmp);
    let corner = |angle: f64| {
        let d = size * DVec2::from_angle(angle);
        let height = h[0] * 3.0 + h[1] * d.x + h[2] * d.y;
        Corner { at: centre + d, height, station: (middle + s[0] * d.x + s[1] * d.y).clamp(0.0, length) }
    };
    angles.into_iter().map(corner).collect()
}

fn pieces(seed: u64) -> Vec<(Part, Option<u32>, Vec<Corner>)> {
    let axis = |i| if i % 5 == 0 { None } else { Some(0) };
    (0..40).map(|i| (Part::Platform, axis(i), convex(seed.wrapping_add(i), 3 + i as usize % 6, 200.0))).collect()
}

proptest! {
    #[test]
    fn stations_add_up_to_the_total(seed: u64, spacing in 0.5..60.0) {
        let pieces = pieces(seed);
        let (whole, fine) = (stations(200.0, None), stations(200.0, Some(spacing)));
        let (whole, fine) = (tally(&whole, &pieces), tally(&fine, &pieces));
        let sum = Amounts::sum(fine.axes[0].iter().map(|i| &i.amounts).chain([&fine.pads]));
        let scale = fine.total.cut + fine.total.fill;
        for (a, b) in [(sum, fine.total), (whole.total, fine.total), (whole.platform, fine.total)] {
            prop_assert!((a.cut - b.cut).abs() <= 1e-12 * scale && (a.fill - b.fill).abs() <= 1e-12 * scale);
            prop_assert!((a.plan_area() - b.plan_area()).abs() <= 1e-12 * b.plan_area());
        }
    }

    #[test]
    fn splitting_a_piece_changes_nothing(seed: u64, at in 10.0..190.0, spacing in 5.0..60.0) {
        let stations = stations(200.0, Some(spacing));
        let whole = pieces(seed);
        let mut split = Vec::new();
        for (part, axis, corners) in &whole {
            let (mut before, mut behind) = (Vec::new(), Vec::new());
            clip::split(corners, at, &mut before, &mut behind);
            split.extend([(*part, *axis, before), (*part, *axis, behind)]);
        }
        let (a, b) = (tally(&stations, &whole), tally(&stations, &split));
        let scale = a.total.cut + a.total.fill;
        for (a, b) in a.axes[0].iter().zip(&b.axes[0]) {
            prop_assert!((a.amounts.cut - b.amounts.cut).abs() <= 1e-13 * scale);
            prop_assert!((a.amounts.fill - b.amounts.fill).abs() <= 1e-13 * scale);
        }
    }

    #[test]
    fn mirrored_heights_swap_cut_and_fill(seed: u64, spacing in 5.0..60.0) {
        let stations = stations(200.0, Some(spacing));
        let mut pieces = pieces(seed);
        let a = tally(&stations, &pieces);
        pieces.iter_mut().flat_map(|p| &mut p.2).for_each(|c| c.height = -c.height);
        let b = tally(&stations, &pieces);
        for (a, b) in a.axes[0].iter().map(|i| i.amounts).chain([a.total, a.pads]).zip(
            b.axes[0].iter().map(|i| i.amounts).chain([b.total, b.pads])
        ) {
            prop_assert_eq!(a, Amounts { cut: b.fill, fill: b.cut, cut_area: b.fill_area, fill_area: b.cut_area, ..b });
        }
        prop_assert_eq!(a.deepest_cut, b.deepest_fill);
    }
}
