use super::contact::is_spike;
use super::*;
use crate::kernel::testing::Random;
use crate::model::Place;
use glam::DVec3;

fn ring(name: &str, role: Role, points: &[(f64, f64)]) -> Chain {
    let vertices = points.iter().map(|&(x, y)| DVec3::new(x, y, 1.0)).collect();
    let places = (1..=points.len() as u32).map(|vertex| Place { feature: Some(1), vertex, row: None }).collect();
    Chain { name: name.into(), role, vertices, places, axis: None }
}

fn outer(name: &str, polygon: u32, points: &[(f64, f64)]) -> Chain {
    ring(name, Role::Outer { polygon }, points)
}

fn defects(chains: &[Chain]) -> Vec<&'static str> {
    let mut defects = Defects::default();
    check("a.geojson", chains, &mut defects);
    defects.list.iter().map(|d| d.code).collect()
}

const SQUARE: [(f64, f64); 4] = [(0., 0.), (10., 0.), (10., 10.), (0., 10.)];

#[test]
fn sound_rings_pass() {
    assert!(defects(&[outer("a", 0, &SQUARE)]).is_empty());
    let collinear = [(0., 0.), (4., 0.), (7., 0.), (10., 0.), (10., 10.)];
    assert!(defects(&[outer("a", 0, &collinear)]).is_empty());
    assert!(defects(&[outer("a", 0, &[(0., 0.), (1., 0.), (0., 1.)])]).is_empty());
}

#[test]
fn a_bow_tie_is_named_with_its_crossing() {
    let bow = outer("pad", 0, &[(0., 0.), (10., 10.), (10., 0.), (0., 8.)]);
    let mut defects = Defects::default();
    check("a.geojson", &[bow], &mut defects);
    // y = x meets y = 8 (1 − x/10) at x = 80/18.
    assert_eq!(
        defects.to_string(),
        "ring `pad` crosses itself\n  --> a.geojson, feature 1, vertices 1 to 2 and feature 1, vertices 3 to 4\n   = at x \
         4.444444444444445, y 4.444444444444445\n   = help: the inside of a ring must be clear: put its vertices in order, \
         take the spike out, or split it into rings that touch nowhere"
    );
}

#[test]
fn touching_oneself_is_a_defect() {
    // Vertex on vertex (figure of eight), vertex on segment, spike, spike over the start.
    let eight = [(0., 0.), (2., 0.), (2., 2.), (4., 2.), (4., 4.), (2., 4.), (2., 2.), (0., 2.)];
    assert_eq!(defects(&[outer("a", 0, &eight)]), ["ring-touches-itself"]);
    let nick = [(0., 0.), (10., 0.), (10., 10.), (5., 0.), (0., 10.)];
    assert_eq!(defects(&[outer("a", 0, &nick)]), ["ring-touches-itself"]);
    let spike = [(0., 0.), (10., 0.), (10., 10.), (10., 20.), (10., 10.), (0., 10.)];
    let codes = defects(&[outer("a", 0, &spike)]);
    assert!(codes.contains(&"ring-spike"), "{codes:?}");
    let start = [(0., 0.), (10., 0.), (10., 10.), (-5., 0.)];
    assert!(defects(&[outer("a", 0, &start)]).is_empty());
    let start = [(0., 0.), (10., 0.), (10., 10.), (5., 0.)];
    assert!(defects(&[outer("a", 0, &start)]).contains(&"ring-spike"));
}

#[test]
fn rings_of_different_polygons_may_touch_and_share_but_not_cross() {
    let a = outer("a", 0, &SQUARE);
    let with = |points: &[(f64, f64)]| defects(&[a.clone(), outer("b", 1, points)]);
    let nothing: [&str; 0] = [];
    // Common side, part of a side, corner on side, corner on corner, nested, nested with a common side.
    assert_eq!(with(&[(10., 0.), (20., 0.), (20., 10.), (10., 10.)]), nothing);
    assert_eq!(with(&[(10., 2.), (20., 0.), (20., 10.), (10., 8.)]), nothing);
    assert_eq!(with(&[(10., 5.), (20., 0.), (20., 10.)]), nothing);
    assert_eq!(with(&[(10., 10.), (20., 10.), (20., 20.)]), nothing);
    assert_eq!(with(&[(2., 2.), (8., 2.), (5., 8.)]), nothing);
    assert_eq!(with(&[(2., 0.), (8., 0.), (5., 8.)]), nothing);
    // Proper crossing; through a vertex; through a corner of both; in along a side and out on the other side of it.
    assert_eq!(with(&[(5., 5.), (15., 4.), (15., 6.)]), ["rings-cross", "rings-cross"]);
    assert_eq!(with(&[(5., 5.), (10., 5.), (15., 0.), (15., 15.), (5., 15.)]), ["rings-cross"]);
    assert_eq!(with(&[(5., 5.), (10., 10.), (20., 10.), (20., 20.), (10., 10.5), (-5., 15.), (-5., 5.)]), ["rings-cross"]);
    assert_eq!(with(&[(5., 5.), (10., 3.), (10., 7.), (20., 20.), (-20., 20.), (-20., -20.), (5., -5.), (0., 0.)]).len(), 1);
    assert_eq!(with(&[(10., 0.), (10., 10.), (0., 10.), (0., 0.)]), ["ring-twice"]);
    assert_eq!(with(&[(0., 10.), (10., 10.), (10., 0.), (5., 0.), (0., 0.)]), ["ring-twice"]);
}

#[test]
fn holes_lie_inside() {
    for square in [SQUARE.to_vec(), SQUARE.iter().rev().copied().collect()] {
        let a = outer("a", 0, &square);
        let with = |points: &[(f64, f64)]| defects(&[a.clone(), ring("a", Role::Hole { polygon: 0 }, points)]);
        assert!(with(&[(2., 2.), (8., 2.), (5., 8.)]).is_empty());
        assert!(with(&[(0., 5.), (8., 2.), (5., 8.)]).is_empty(), "touching from inside");
        assert_eq!(with(&[(12., 2.), (18., 2.), (15., 8.)]), ["hole-outside"]);
        assert_eq!(with(&[(10., 5.), (18., 2.), (15., 8.)]), ["hole-outside"], "touching from outside");
        assert_eq!(with(&[(-5., 2.), (-2., 2.), (-3., 8.)]), ["hole-outside"]);
        assert_eq!(with(&[(2., 2.), (18., 2.), (5., 8.)])[0], "rings-cross");
    }
}

/// Rings inside an odd number of others, with the innermost around each.
#[test]
fn rings_inside_rings_are_told() {
    let told = |chains: &[Chain]| check("a.geojson", chains, &mut Defects::default());
    let square = |name: &str, polygon: u32, lo: f64, hi: f64| outer(name, polygon, &[(lo, lo), (hi, lo), (hi, hi), (lo, hi)]);
    let (a, b, c) = (square("a", 0, 0., 10.), square("b", 1, 2., 8.), square("c", 2, 3., 7.));
    assert_eq!(told(&[a.clone(), b.clone(), c.clone()]), [(1, 0)]);
    assert_eq!(told(&[c.clone(), a.clone(), b.clone()]), [(2, 1)]);
    assert_eq!(told(&[c, a.clone(), b, square("d", 3, 4., 5.)]), [(2, 1), (3, 0)]);
    // Touching along a side, in all corners, and from outside.
    assert_eq!(told(&[a.clone(), outer("b", 1, &[(2., 0.), (8., 0.), (5., 8.)])]), [(1, 0)]);
    assert_eq!(told(&[a.clone(), outer("b", 1, &[(5., 0.), (10., 5.), (5., 10.), (0., 5.)])]), [(1, 0)]);
    assert_eq!(told(&[a.clone(), outer("b", 1, &[(10., 0.), (20., 0.), (20., 10.), (10., 10.)])]), []);
    let open = Chain { role: Role::Open, ..square("open", 9, -5., -1.) };
    assert_eq!(told(&[open, a, ring("a", Role::Hole { polygon: 0 }, &[(2., 2.), (8., 2.), (5., 8.)])]), [(2, 1)]);
}

/// The tree must find what comparing every pair finds.
#[test]
fn agrees_with_comparing_every_pair() {
    let mut random = Random::new(1);
    let mut bad = 0;
    for round in 0..400 {
        let n = 3 + (7 * round) % 200;
        // A star-shaped ring is simple; shifting one vertex across makes some of them cross. Coarse grids make touches.
        let mut points: Vec<(f64, f64)> = (0..n)
            .map(|i| {
                let angle = std::f64::consts::TAU * (i as f64 + 0.8 * random.unit()) / n as f64;
                let radius = random.between(50.0, 100.0);
                (5e5 + radius * angle.cos(), 5e6 + radius * angle.sin())
            })
            .collect();
        if round % 2 == 0 {
            points[n / 2] = (random.between(5e5, 5e5 + 100.0), random.between(5e6, 5e6 + 100.0));
        }
        if round % 3 == 0 {
            points.iter_mut().for_each(|p| *p = ((p.0 / 10.0).round() * 10.0, (p.1 / 10.0).round() * 10.0));
            points.dedup();
        }
        if points.len() < 3 || points.first() == points.last() {
            continue;
        }
        let chain = outer("a", 0, &points);
        let m = points.len();
        let corner = |i: usize| DVec2::from(points[i % m]);
        let mut expected = false;
        for i in 0..m {
            expected |= is_spike(corner(i), corner(i + 1), corner(i + 2));
            for j in i + 2..m {
                if (j + 1) % m != i {
                    expected |= meeting([corner(i), corner(i + 1)], [corner(j), corner(j + 1)]) != Meeting::Apart;
                }
            }
        }
        bad += usize::from(expected);
        assert_eq!(!defects(&[chain]).is_empty(), expected, "{points:?}");
    }
    assert!((50..350).contains(&bad), "{bad} of 400");
}

/// Two sound rings cross exactly if their insides overlap and each reaches outside the other; checked against the
/// intersection matrix of the `geo` crate on coarse grids, where most contacts go through vertices and along sides.
#[test]
fn crossing_agrees_with_the_intersection_matrix() {
    use geo::{Relate, coordinate_position::CoordPos, dimensions::Dimensions};
    let mut random = Random::new(7);
    let polygon = |points: &[(f64, f64)]| geo::Polygon::new(geo::LineString::from(points.to_vec()), vec![]);
    let (mut crossing, mut touching, mut same) = (0, 0, 0);
    for round in 0..100_000 {
        let mut ring = || (0..3 + random.below(3)).map(|_| (random.below(5) as f64, random.below(5) as f64)).collect::<Vec<_>>();
        let (a, mut b) = (ring(), ring());
        if round % 50 == 0 {
            b = a.iter().rev().copied().collect();
            b.rotate_left(1);
        }
        let sound = |points: &[(f64, f64)]| {
            let n = points.len();
            (0..n).all(|i| points[i] != points[(i + 1) % n]) && defects(&[outer("a", 0, points)]).is_empty()
        };
        if !sound(&a) || !sound(&b) {
            continue;
        }
        let matrix = polygon(&a).relate(&polygon(&b));
        let meets = |p, q| matrix.get(p, q) != Dimensions::Empty;
        let expected = meets(CoordPos::Inside, CoordPos::Inside)
            && meets(CoordPos::Inside, CoordPos::Outside)
            && meets(CoordPos::Outside, CoordPos::Inside);
        let found = defects(&[outer("a", 0, &a), outer("b", 1, &b)]);
        assert_eq!(found.contains(&"rings-cross"), expected, "{a:?} {b:?}: {found:?}");
        assert_eq!(found.contains(&"ring-twice"), matrix.is_equal_topo(), "{a:?} {b:?}: {found:?}");
        crossing += usize::from(expected);
        same += usize::from(matrix.is_equal_topo());
        touching += usize::from(!expected && meets(CoordPos::OnBoundary, CoordPos::OnBoundary));
        // The hole of a polygon lies inside exactly if the polygon covers it.
        let found = defects(&[outer("a", 0, &a), ring_of_hole(&b)]);
        let expected = matrix.is_covers() && !matrix.is_equal_topo();
        assert_eq!(found.is_empty(), expected, "{a:?} {b:?}: {found:?}");
        // The order of the rings does not matter.
        let found = defects(&[ring_of_hole(&b), outer("a", 0, &a)]);
        assert_eq!(found.is_empty(), expected, "{b:?} in {a:?}: {found:?}");
    }
    assert!(crossing > 1000 && touching > 1000 && same > 10, "{crossing} {touching} {same}");
}

/// A ring beside and one inside another, with which they share a stretch of many vertices.
#[test]
fn long_common_boundaries_take_no_time() {
    const N: u32 = 20_000;
    let common: Vec<(f64, f64)> = (0..=N).map(|i| (f64::from(i), (0.37 * f64::from(i)).sin())).collect();
    let right = f64::from(N);
    let above = [&common[..], &[(right, 100.), (0., 100.)]].concat();
    let below = [&common[..], &[(right, -50.), (0., -50.)]].concat();
    let whole = outer("whole", 2, &[(-1., -60.), (right + 1., -60.), (right + 1., 110.), (-1., 110.)]);
    let inside = [&common[..], &[(right, 60.), (0., 60.)]].concat();
    let start = std::time::Instant::now();
    let chains = [outer("below", 0, &below), outer("above", 1, &above), whole, outer("inside", 3, &inside)];
    let mut found = Defects::default();
    let nested = check("a.geojson", &chains, &mut found);
    assert!(found.is_empty(), "{found}");
    // `inside` lies in `above` and that in `whole`: `inside` is an island again.
    assert_eq!(nested, [(0, 2), (1, 2)]);
    assert!(start.elapsed() < std::time::Duration::from_secs(20), "{:?}", start.elapsed());
}

fn ring_of_hole(points: &[(f64, f64)]) -> Chain {
    ring("a", Role::Hole { polygon: 0 }, points)
}
