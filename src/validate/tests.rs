use super::*;
use crate::read::{CoordinateKind, InputFormat, RawLine, RawShape, RawVertex, Source};

/// A ring by the side of its square, about a common centre.
fn square(polygon: u32, hole: bool, side: f64) -> RawLine {
    let corners = [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.), (-1., -1.)];
    let vertex = |(x, y): (f64, f64)| RawVertex { x: 0.5 * side * x, y: 0.5 * side * y, z: Some(10.0), row: None };
    let vertices = corners.into_iter().map(vertex).collect();
    RawLine { name: Some(side.to_string()), feature: Some(polygon + 1), shape: RawShape::Ring { polygon, hole }, vertices }
}

fn checked(lines: Vec<RawLine>) -> Checked {
    let (label, sha256) = ("a.geojson".to_owned(), String::new());
    let (format, kind) = (InputFormat::GeoJson, CoordinateKind::Unknown);
    let source = Source { label, format, bytes: 0, sha256, crs: None, kind, unit: None };
    check(&RawInput { source, lines, notes: Vec::new() }, &Options::default()).unwrap()
}

/// All orders of the numbers below `n`.
fn orders(n: usize) -> Vec<Vec<usize>> {
    if n == 0 {
        return vec![Vec::new()];
    }
    let insert = |order: Vec<usize>| {
        (0..n).map(move |at| {
            let mut order = order.clone();
            order.insert(at, n - 1);
            order
        })
    };
    orders(n - 1).into_iter().flat_map(insert).collect()
}

/// Squares in squares bound by the even-odd rule, in whatever order the features stand: every second is a hole in the one around
/// it, also those the file calls holes of another polygon, and has one number with it that no other has.
#[test]
fn nested_rings_do_not_depend_on_the_order_of_features() {
    // One polygon with a hole of 40, and four rings, two of them between its outer ring and its hole.
    let features: [&[(bool, f64)]; 5] =
        [&[(false, 80.), (true, 40.)], &[(false, 100.)], &[(false, 60.)], &[(false, 50.)], &[(false, 20.)]];
    let all = orders(features.len());
    assert_eq!(all.len(), 120);
    for order in all {
        let rings =
            (0..).zip(&order).flat_map(|(polygon, &f)| features[f].iter().map(move |&(hole, side)| square(polygon, hole, side)));
        let Checked { mut line, notes } = checked(rings.collect());
        line.chains.sort_by(|a, b| b.vertices[1].x.total_cmp(&a.vertices[1].x));
        let mut numbers = Vec::new();
        for pair in line.chains.chunks(2) {
            let [Role::Outer { polygon }, Role::Hole { polygon: of }] = [pair[0].role, pair[1].role] else {
                panic!("{order:?}: {:?}", pair.iter().map(|c| c.role).collect::<Vec<_>>())
            };
            assert_eq!(polygon, of, "{order:?}: {}", pair[1].name);
            numbers.push(polygon);
        }
        numbers.sort_unstable();
        numbers.dedup();
        assert_eq!(numbers.len(), 3, "{order:?}");
        let mut told: Vec<&str> = notes.iter().map(|note| note.message.as_str()).collect();
        told.sort_unstable();
        assert_eq!(
            told,
            [
                "ring `20` lies inside ring `40`: it bounds a hole in it",
                "ring `50` lies inside ring `60`: it bounds a hole in it",
                "ring `80` lies inside ring `100`: it bounds a hole in it",
            ],
            "{order:?}"
        );
        // Once decided, they stay so.
        check_rings(&line, "a.geojson").unwrap();
    }
}
