use super::*;
use crate::ground::testing::{Random, closed_axis, corner, open_axis, straight_axis};
use crate::ground::{Axis, Corner, Tally};
use glam::DVec2;
use proptest::prelude::*;

fn sections(axis: Axis, spacing: f64, pieces: &[(Part, Vec<Corner>)]) -> SectionFigures {
    sections_off(0.0, axis, spacing, pieces)
}

fn sections_off(slack: f64, axis: Axis, spacing: f64, pieces: &[(Part, Vec<Corner>)]) -> SectionFigures {
    let stations = Stations::new(vec![axis], Some(spacing)).unwrap().standing_off(slack);
    let mut sections = Sections::new(&stations);
    for (part, corners) in pieces {
        sections.add(&Piece { part: *part, axis: Some(0), corners });
    }
    sections.finish()
}

fn near(found: f64, expected: f64) {
    assert!((found - expected).abs() <= 1e-12 * (1.0 + expected.abs()), "{found} for {expected}");
}

/// An embankment of height `h(x)` with a platform `width` wide and sides 2H:1V in section, in bays of `bay`.
fn embankment(length: f64, bay: f64, width: f64, h: impl Fn(f64) -> f64) -> Vec<(Part, Vec<Corner>)> {
    let mut pieces = Vec::new();
    let mut from = 0.0;
    while from < length {
        let to = f64::min(from + bay, length);
        let (w, toe) = (0.5 * width, |x: f64| 0.5 * width + 2.0 * h(x));
        let platform = [(from, -w), (to, -w), (to, w), (from, w)].map(|(x, y)| corner(x, y, h(x)));
        pieces.push((Part::Platform, platform.to_vec()));
        for sign in [-1.0, 1.0] {
            let (near, far) = ([(from, w), (to, w)], [(to, toe(to)), (from, toe(from))]);
            let mut side: Vec<Corner> = near.iter().map(|&(x, y)| corner(x, sign * y, h(x))).collect();
            side.extend(far.iter().map(|&(x, y)| corner(x, sign * y, 0.0)));
            if sign < 0.0 {
                side.reverse();
            }
            pieces.push((Part::FillSlope, side));
        }
        from = to;
    }
    pieces
}

/// Height 0.5 to 2.5 over 150, 11 wide: areas h(11 + 2h) = 6, 21, 40 at both ends and half-way. The prismoidal formula gives the
/// exact 3250, the end areas 3450.
#[test]
fn textbook_embankment() {
    let pieces = embankment(150.0, 150.0, 11.0, |x| 0.5 + x / 75.0);
    let found = sections(straight_axis(150.0), 150.0, &pieces);
    let one = found.axes[0][0];
    for (section, (station, area, reach)) in one.sections.iter().zip([(0.0, 6.0, 6.5), (75.0, 21.0, 8.5), (150.0, 40.0, 10.5)]) {
        assert_eq!((section.station, section.area.cut), (station, 0.0));
        near(section.area.fill, area);
        near(section.left, reach);
        near(section.right, reach);
    }
    near(found.prismoidal.fill, 3250.0);
    near(found.average_end_area.fill, 3450.0);
    // Shorter intervals bring the end areas nearer, and leave the prismoidal figure where it is. Bays that end at sections
    // put edges into them, which are seen from both sides.
    for (spacing, bay) in [(20.0, 150.0), (20.0, 10.0), (50.0, 25.0), (37.0, 11.0)] {
        let found = sections(straight_axis(150.0), spacing, &embankment(150.0, bay, 11.0, |x| 0.5 + x / 75.0));
        near(found.prismoidal.fill, 3250.0);
        near(found.axes[0].iter().map(|i| i.prismoidal.fill).sum(), 3250.0);
        assert!(found.average_end_area.fill > 3250.0 && found.average_end_area.fill < 3300.0);
    }
}

/// Edges along a section are found whatever rounding does to the pieces on both sides of them, and counted once.
#[test]
fn rounding_does_not_hide_an_edge() {
    let random = &mut Random::new(7);
    for _ in 0..50 {
        let mut pieces = embankment(100.0, 10.0, 6.0, |_| 2.0);
        for corner in pieces.iter_mut().flat_map(|piece| &mut piece.1) {
            corner.at += DVec2::new(random.between(-1e-10, 1e-10), random.between(-1e-10, 1e-10));
        }
        let found = sections(straight_axis(100.0), 20.0, &pieces);
        for section in found.axes[0].iter().flat_map(|interval| &interval.sections) {
            assert!((section.area.fill - 20.0).abs() < 1e-8, "{section:?}");
        }
    }
}

/// `h = y` on a strip from −3 to 4: cut 9/2, fill 16/2.
#[test]
fn cut_and_fill_in_one_section() {
    let strip = [(0.0, -3.0), (10.0, -3.0), (10.0, 4.0), (0.0, 4.0)].map(|(x, y)| corner(x, y, y));
    let found = sections(straight_axis(10.0), 10.0, &[(Part::Platform, strip.to_vec())]);
    let section = found.axes[0][0].sections[1];
    assert_eq!((section.area, section.left, section.right), (CutFill { cut: 4.5, fill: 8.0 }, 4.0, 3.0));
    assert_eq!(found.average_end_area, CutFill { cut: 45.0, fill: 80.0 });
}

#[test]
fn what_is_not_connected_does_not_count() {
    let strip = |from, to| [(0.0, from), (10.0, from), (10.0, to), (0.0, to)].map(|(x, y)| corner(x, y, 1.0)).to_vec();
    let reach = |strips: &[(f64, f64)]| {
        let pieces: Vec<_> = strips.iter().map(|&(from, to)| (Part::FillSlope, strip(from, to))).collect();
        let section = sections(straight_axis(10.0), 10.0, &pieces).axes[0][0].sections[1];
        assert!((section.area.fill - section.left - section.right).abs() < 1e-8);
        (section.left, section.right)
    };
    assert_eq!(reach(&[(2.0, 3.0), (0.0, 2.0), (-4.0, -1.0)]), (3.0, 0.0));
    assert_eq!(reach(&[(-1.0, 1.0), (1.5, 2.0), (-2.0, -1.0 - 1e-9)]), (1.0, 2.0));
    assert_eq!(reach(&[(0.5, 2.0)]), (0.0, 0.0));
    assert_eq!(reach(&[]), (0.0, 0.0));
    // No station, no section: platforms without an axis, axes there are not, axes without length.
    let stations = Stations::new(vec![straight_axis(10.0), Axis { line: vec![], ..straight_axis(0.0) }], Some(5.0)).unwrap();
    let mut sections = Sections::new(&stations);
    for axis in [None, Some(1), Some(2)] {
        sections.add(&Piece { part: Part::Platform, axis, corners: &strip(-1.0, 1.0) });
    }
    let found = sections.finish();
    assert_eq!((found.axes[0].len(), found.axes[1].len(), found.prismoidal), (2, 1, CutFill::default()));
}

/// A corner of 90° to the left at x = 20: on its inside two strips meet in a crease on the diagonal. Behind it feet are twice as far
/// off as the section has come: it ends there, whatever the spacing.
#[test]
fn another_part_of_the_line_takes_over() {
    let axis = || open_axis(&[(0.0, 0.0), (20.0, 0.0), (20.0, 20.0)]);
    let first = [(0.0, 0.0), (20.0, 0.0), (0.0, 20.0)].map(|(x, y)| corner(x, y, 1.0));
    let second = [(20.0, 0.0), (20.0, 20.0), (0.0, 20.0)].map(|(x, y)| Corner { station: 20.0 + y, ..corner(x, y, 1.0) });
    let pieces = [(Part::FillSlope, first.to_vec()), (Part::FillSlope, second.to_vec())];
    // Feet at 5 and 35 where the section of x = 5 meets the crease.
    let left = |spacing, interval: usize, at: usize| sections(axis(), spacing, &pieces).axes[0][interval].sections[at].left;
    near(left(10.0, 0, 1), 15.0);
    // At the corner it runs along the crease itself, where both feet are the corner's.
    near(left(10.0, 1, 2), 800f64.sqrt());
    near(left(5.0, 1, 0), 15.0);
    // At 15: feet at 15 and 25, 10 apart, where the section has come to 5.
    near(left(10.0, 1, 1), 5.0);
    near(left(5.0, 3, 0), 5.0);
    near(left(40.0, 0, 1), 800f64.sqrt());
}

/// A bend of 30° to the left at x = 20, strips w = 20 cos 15° wide. The section of x = 18 meets the crease at 2/tan 15°, where feet
/// are at 18 and 22, and goes on to the end of the other strip, (w − 2 sin 30°)/cos 30° from the axis; for every spacing.
#[test]
fn lesser_bends_do_not_end_a_section() {
    let (w, turned) = (20.0 * 15f64.to_radians().cos(), DVec2::from_angle(30f64.to_radians()));
    let vertex = DVec2::new(20.0, 0.0);
    let far = vertex + 20.0 * turned;
    let crease = vertex + 20.0 * DVec2::from_angle(105f64.to_radians());
    let first = [(0.0, 0.0), (20.0, 0.0), (crease.x, w), (0.0, w)].map(|(x, y)| corner(x, y, 1.0));
    let second = [vertex, far, far + w * turned.perp(), crease]
        .map(|at| Corner { station: 20.0 + (at - vertex).dot(turned), ..corner(at.x, at.y, 1.0) });
    let pieces = [(Part::FillSlope, first.to_vec()), (Part::FillSlope, second.to_vec())];
    for (spacing, interval, at) in [(1.0, 18, 0), (3.0, 6, 0), (9.0, 2, 0), (36.0, 0, 1)] {
        let axis = open_axis(&[(0.0, 0.0), (20.0, 0.0), (far.x, far.y)]);
        let section = sections(axis, spacing, &pieces).axes[0][interval].sections[at];
        assert_eq!(section.station, 18.0);
        near(section.left, (w - 1.0) / 30f64.to_radians().cos());
        near(section.area.fill, section.left);
    }
}

/// Slopes on one side of a line that was moved by 3 mm to either side are counted from where they begin, and on the other side there
/// are none; what lies on both sides is parted at the axis.
#[test]
fn the_line_may_stand_off_its_axis() {
    let strip = |from, to| [(0.0, from), (10.0, from), (10.0, to), (0.0, to)].map(|(x, y)| corner(x, y, 1.0)).to_vec();
    type Strips = &'static [(f64, f64)];
    let cases: [(Strips, f64, f64, f64); 6] = [
        (&[(0.003, 1.0), (1.0, 3.0)], 3.0, 0.0, 2.997),
        (&[(-0.003, 0.002), (0.002, 3.0)], 3.0, 0.0, 3.003),
        (&[(-3.0, -0.003)], 0.0, 3.0, 2.997),
        (&[(-3.0, 0.003), (0.003, 2.0)], 2.0, 3.0, 5.0),
        (&[(-0.003, 0.004)], 0.004, 0.003, 0.007),
        (&[(0.02, 3.0)], 0.0, 0.0, 0.0),
    ];
    for (strips, left, right, area) in cases {
        let pieces: Vec<_> = strips.iter().map(|&(from, to)| (Part::FillSlope, strip(from, to))).collect();
        let section = sections_off(0.01, straight_axis(10.0), 10.0, &pieces).axes[0][0].sections[1];
        near(section.left, left);
        near(section.right, right);
        near(section.area.fill, area);
    }
}

/// Outside a square ring of side 10, height 1 on a strip 2 wide with quarter rounds as squares: each section away from the
/// corners has an area of 2; the ends of the ring are one place.
#[test]
fn a_ring_has_no_ends() {
    let points = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)];
    let mut pieces = Vec::new();
    for i in 0..4 {
        let (a, b) = (DVec2::from(points[i]), DVec2::from(points[(i + 1) % 4]));
        let along = (b - a) / 10.0;
        let out = -2.0 * along.perp();
        let station = 10.0 * i as f64;
        let at = |at: DVec2, station| Corner { at, height: 1.0, station };
        pieces.push((
            Part::FillSlope,
            vec![at(a, station), at(a + out, station), at(b + out, station + 10.0), at(b, station + 10.0)],
        ));
        let end = station + 10.0;
        pieces.push((
            Part::FillSlope,
            vec![at(b, end), at(b + out, end), at(b + out + 2.0 * along, end), at(b + 2.0 * along, end)],
        ));
    }
    let found = sections(closed_axis(&points), 5.0, &pieces);
    for (i, interval) in found.axes[0].iter().enumerate() {
        let [from, middle, to] = interval.sections;
        near(middle.area.fill, 2.0);
        near(middle.right, 2.0);
        assert_eq!(middle.left, 0.0);
        let corner = if i % 2 == 0 { from } else { to };
        near(corner.area.fill, 8f64.sqrt());
    }
    near(found.axes[0][0].sections[0].area.fill, found.axes[0][7].sections[2].area.fill);
}

/// Rulings that lean forward by half their length on a uniform body of area 4: inside, sections and shares by foot point are the
/// same 80 for every 20; at the beginning sections miss what leans away, and at the end the works reach beyond the last section.
#[test]
fn leaning_rulings_differ_at_the_ends() {
    let foot = |s: f64, y: f64| Corner { station: s, ..corner(s + 0.5 * y, y, 2.0 - 0.5 * y) };
    let pieces: Vec<(Part, Vec<Corner>)> = (0..10)
        .map(|i| (10.0 * f64::from(i), 10.0 * f64::from(i + 1)))
        .map(|(from, to)| (Part::FillSlope, vec![foot(from, 0.0), foot(to, 0.0), foot(to, 4.0), foot(from, 4.0)]))
        .collect();
    let found = sections(straight_axis(100.0), 20.0, &pieces);
    let stations = Stations::new(vec![straight_axis(100.0)], Some(20.0)).unwrap();
    let mut tally = Tally::new(&stations);
    pieces.iter().for_each(|(part, corners)| tally.add(&Piece { part: *part, axis: Some(0), corners }));
    let exact = tally.finish();
    for (i, interval) in found.axes[0].iter().enumerate() {
        near(exact.axes[0][i].amounts.fill, 80.0);
        near(interval.average_end_area.fill, if i == 0 { 40.0 } else { 80.0 });
        near(interval.sections[2].left, 4.0);
    }
    near(found.axes[0][0].prismoidal.fill, 20.0 / 6.0 * (4.0 * 4.0 + 4.0));
}

proptest! {
    /// The tree passes over no plane that a polygon touches.
    #[test]
    fn every_plane_that_crosses_is_found(seed: u64, count in 0_usize..70, bend in -0.3..0.3) {
        let random = &mut Random::new(seed);
        let mut direction = random.between(0.0, std::f64::consts::TAU);
        let mut point = DVec2::new(random.between(-1e3, 1e3), 0.0);
        let mut planes = Vec::new();
        for i in 0..count {
            planes.push(Plane { point, along: DVec2::from_angle(direction), station: i as f64 });
            direction += bend * random.unit();
            point += random.between(0.1, 5.0) * DVec2::from_angle(direction);
        }
        let fan = Fan::new(planes.clone());
        for _ in 0..20 {
            let centre = point + DVec2::new(random.between(-50.0, 50.0), random.between(-50.0, 50.0));
            let corners: Vec<Corner> = (0..3)
                .map(|_| Corner { at: centre + DVec2::new(random.unit(), random.unit()), ..Corner::default() })
                .collect();
            let mut seen = Vec::new();
            fan.near(&corners, |i, _| seen.push(i));
            prop_assert!(seen.windows(2).all(|pair| pair[0] < pair[1]));
            for (i, plane) in planes.iter().enumerate() {
                let ahead = corners.iter().filter(|corner| plane.split(corner.at).1 > 0.0).count();
                prop_assert!(ahead == 0 || ahead == 3 || seen.contains(&i));
            }
        }
    }

    /// A road that is turned and moved has the same sections.
    #[test]
    fn turned_and_moved(angle in 0.0..6.3, x in -1e4..1e4, y in -1e4..1e4, spacing in 7.0..40.0) {
        let pieces = embankment(100.0, 13.0, 8.0, |x| 1.0 + x / 40.0);
        let move_to = |p: DVec2| DVec2::new(x, y) + DVec2::from_angle(angle).rotate(p);
        let mut moved = pieces.clone();
        moved.iter_mut().flat_map(|piece| &mut piece.1).for_each(|corner| corner.at = move_to(corner.at));
        let mut axis = straight_axis(100.0);
        axis.line.iter_mut().for_each(|vertex| vertex.0 = move_to(vertex.0));
        let (a, b) = (sections(straight_axis(100.0), spacing, &pieces), sections(axis, spacing, &moved));
        for (a, b) in a.axes[0].iter().zip(&b.axes[0]) {
            prop_assert!((a.prismoidal.fill - b.prismoidal.fill).abs() < 1e-6);
            prop_assert!((a.sections[1].left - b.sections[1].left).abs() < 1e-7);
        }
    }

    /// Mirrored heights swap cut and fill; works seen from the other end of the line have left and right swapped.
    #[test]
    fn mirrors(seed: u64) {
        let random = &mut Random::new(seed);
        let mut strips = Vec::new();
        for (from, to) in [(-9.0, -4.0), (-4.0, 0.5), (0.5, 7.0)] {
            let h = [0, 1, 2].map(|_| random.between(-1.0, 1.0));
            let at = |x: f64, y: f64| corner(x, y, h[0] + 0.1 * h[1] * x + 0.3 * h[2] * y);
            strips.push((Part::Platform, vec![at(0.0, from), at(30.0, from), at(30.0, to), at(0.0, to)]));
        }
        let a = sections(straight_axis(30.0), 10.0, &strips);
        let mut turned = strips.clone();
        for corner in turned.iter_mut().flat_map(|strip| &mut strip.1) {
            corner.height = -corner.height;
        }
        let b = sections(straight_axis(30.0), 10.0, &turned);
        for (a, b) in a.axes[0].iter().zip(&b.axes[0]) {
            prop_assert_eq!((a.prismoidal.cut, a.prismoidal.fill), (b.prismoidal.fill, b.prismoidal.cut));
            prop_assert_eq!((a.average_end_area.cut, a.average_end_area.fill), (b.average_end_area.fill, b.average_end_area.cut));
        }
        let mut back = strips.clone();
        for corner in back.iter_mut().flat_map(|strip| &mut strip.1) {
            (corner.at, corner.station) = (DVec2::new(30.0, 0.0) - corner.at, 30.0 - corner.station);
        }
        let b = sections(straight_axis(30.0), 10.0, &back);
        for (a, b) in a.axes[0].iter().zip(b.axes[0].iter().rev()) {
            let (a, b) = (a.sections[1], b.sections[1]);
            prop_assert_eq!((a.left, a.right), (b.right, b.left));
            prop_assert!((a.area.cut - b.area.cut).abs() < 1e-12 && (a.area.fill - b.area.fill).abs() < 1e-12);
        }
    }
}
