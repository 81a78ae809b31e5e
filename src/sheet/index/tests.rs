use glam::{DVec2, DVec3};

use super::Index;
use crate::sheet::testing::{Random, sets};
use crate::sheet::{Ruling, Segment};

/// Places near and far, some of them on the segments' ends.
fn places(random: &mut Random, segments: &[Segment]) -> Vec<DVec2> {
    let mut places = Vec::new();
    for i in 0..60 {
        let near = &segments[random.bits() as usize % segments.len()];
        let reach = [0.0, 1e-6, 1.0, 100.0, 1e4][i % 5];
        places.push(near.a + DVec2::new(random.between(-reach, reach), random.between(-reach, reach)));
    }
    places
}

#[test]
fn height_is_the_greatest_of_all() {
    let mut random = Random::new(3);
    for (k, segments) in sets(&mut random) {
        let index = Index::new(&segments, k);
        let mut hint = None;
        for x in places(&mut random, &segments) {
            let mut expected = (f64::NEG_INFINITY, 0);
            for (id, segment) in segments.iter().enumerate() {
                let height = segment.height(x, k);
                if height > expected.0 {
                    expected = (height, id as u32);
                }
            }
            assert_eq!(index.height(x, None), expected, "{} segments at {x}", segments.len());
            assert_eq!(index.height(x, hint), expected, "with a hint");
            assert_eq!(index.segment(expected.1), &segments[expected.1 as usize]);
            hint = Some(expected.1);
        }
    }
}

#[test]
fn visits_all_that_reach_the_floor() {
    let mut random = Random::new(4);
    for (k, segments) in sets(&mut random) {
        let index = Index::new(&segments, k);
        for x in places(&mut random, &segments) {
            let floor = index.height(x, None).0 - random.between(0.0, 5.0);
            let mut seen = Vec::new();
            index.visit_above(x, floor, |id| seen.push(id));
            seen.sort_unstable();
            let reaches = |id: &u32, floor: f64| segments[*id as usize].height(x, k) >= floor;
            let all = 0..segments.len() as u32;
            let expected: Vec<u32> = all.filter(|id| reaches(id, floor)).collect();
            seen.dedup();
            assert!(expected.iter().all(|id| seen.binary_search(id).is_ok()), "missed one at {x}");
            assert!(seen.iter().all(|id| reaches(id, floor - 2.0 * index.rounding(x))), "one too many at {x}");
        }
    }
}

/// Where the ruling falls below the segment's sheet, by bisection on the definition.
fn bisected(segment: &Segment, ruling: &Ruling, r: f64, k: f64) -> f64 {
    let above = |r: f64| segment.height(ruling.at(r), k) > ruling.z - k * r + 1e-10;
    if !above(r) {
        return r;
    }
    let (mut lo, mut hi) = (0.0, r);
    for _ in 0..80 {
        let mid = 0.5 * (lo + hi);
        if above(mid) { hi = mid } else { lo = mid }
    }
    hi
}

#[test]
fn trim_finds_the_first_crossing_of_all() {
    let mut random = Random::new(5);
    for (k, segments) in sets(&mut random) {
        let index = Index::new(&segments, k);
        for i in 0..30 {
            let own = &segments[random.bits() as usize % segments.len()];
            let foot = own.point(own.length * random.between(0.0, 1.0));
            let dir = if i % 2 == 0 { own.ruling_left() } else { own.ruling_right() };
            let ruling = Ruling { foot: foot.truncate(), z: foot.z, dir };
            let limit = [1.0, 50.0, 1e3][i % 3];
            let expected = segments.iter().map(|s| bisected(s, &ruling, limit, k)).fold(limit, f64::min);
            let mut calls = 0;
            let found = index.trim(&ruling, limit, &mut |id, r| {
                calls += 1;
                bisected(index.segment(id), &ruling, limit, k).min(r)
            });
            assert_eq!(found, expected, "{} segments, ruling {ruling:?}", segments.len());
            assert!(calls > 0, "the ruling's own segment reaches its end or another does");
        }
    }
}

#[test]
fn boxes_hold_their_segments_and_turn_with_them() {
    let mut random = Random::new(6);
    for (k, segments) in sets(&mut random) {
        let index = Index::new(&segments, k);
        let mut seen = 0;
        let mut open = vec![(0usize, Vec::new())];
        while let Some((at, above)) = open.pop() {
            let node = &index.nodes[at];
            let mut above: Vec<usize> = above;
            above.push(at);
            if node.count == 0 {
                open.extend([(node.first as usize, above.clone()), (node.first as usize + 1, above)]);
                continue;
            }
            seen += node.count as usize;
            for slot in node.first as usize..(node.first + node.count) as usize {
                let s = &index.segments[slot];
                for (p, z) in [(s.a, s.za), (s.b, s.zb)] {
                    for node in above.iter().map(|&n| &index.nodes[n]) {
                        assert!(node.bound(p, k) >= z - index.rounding(p), "{p} sticks out of {node:?}");
                    }
                }
            }
        }
        assert_eq!(seen, segments.len());
    }
}

#[test]
fn box_of_a_straight_line_is_as_good_as_the_line() {
    // A diagonal rise of 0.9 k: thin box, slanting lid, so the bound is the height itself.
    let step = DVec3::new(1.0, 1.0, 0.45 * 2f64.sqrt());
    let point = |i: u32| f64::from(i) * step;
    let segments: Vec<Segment> = (0..64).map(|i| Segment::new(point(i), point(i + 1), 0.5)).collect();
    let index = Index::new(&segments, 0.5);
    assert!(index.nodes[0].half.y <= 1e-12);
    for x in [DVec2::new(30.0, 0.0), DVec2::new(0.0, 90.0), DVec2::new(-20.0, -30.0), DVec2::new(99.0, 99.0)] {
        let (bound, height) = (index.nodes[0].bound(x, 0.5), index.height(x, None).0);
        assert!((bound - height).abs() <= 1e-12, "{bound} for {height} at {x}");
    }
}
