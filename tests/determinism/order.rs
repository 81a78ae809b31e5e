//! The order in which a file has its lines means nothing, nor does the vertex a ring begins with, nor which way it runs.

use crate::common::build::{design, line};
use crate::common::lines::{Case, Random, case};
use crate::common::oracle::Polyline;
use slopegen::mesh::fingerprint::fingerprint;
use slopegen::model::{Design, Extent, Sheet, Side};
use slopegen::surface;
use std::fs;
use std::path::Path;

/// The mesh as a set of triangles and the figures, to the last bit.
fn result(lines: &[Polyline], design: &Design) -> Option<(String, String)> {
    let surface = surface::build(&line(lines), design, None, &()).ok()?;
    // What the certificate measures is rounding.
    let figures = (&surface.levels, &surface.areas, &surface.volumes, surface.simplified);
    Some((fingerprint(&surface.tin), format!("{figures:?}")))
}

/// Lines in another order, each as `change` has it.
fn shuffled(case: &Case, random: &mut Random, change: impl Fn(&mut Polyline, &mut Random)) -> Vec<Polyline> {
    let mut lines = case.lines.clone();
    for i in (1..lines.len()).rev() {
        lines.swap(i, random.below(i + 1));
    }
    lines.iter_mut().for_each(|line| change(line, random));
    lines
}

/// Every ring from another vertex, and half of them the other way round; lines stay: left and right are seen along them.
fn rings(line: &mut Polyline, random: &mut Random) {
    if line.closed {
        let n = line.points.len();
        line.points.rotate_left(random.below(n));
        if random.below(2) == 0 {
            line.points.reverse();
        }
    }
}

/// Lines the other way round as well: without a side they are the same.
fn all(line: &mut Polyline, random: &mut Random) {
    rings(line, random);
    if !line.closed && random.below(2) == 0 {
        line.points.reverse();
    }
}

#[test]
fn the_same_result_in_any_order() {
    let random = &mut Random::new(3);
    let mut built = 0;
    for seed in 0..60 {
        let case = case(seed, 30);
        let extent = [Extent::Distance(5.0), Extent::Height(4.0 * case.k)][seed as usize % 2];
        let sheet = [Sheet::Falling, Sheet::Rising][seed as usize / 2 % 2];
        for (side_of_lines, side_of_rings) in [(Side::Both, Side::Outside), (Side::Left, Side::Both), (Side::Both, Side::Inside)]
        {
            let wanted = Design { sheet, side_of_lines, side_of_rings, tolerance: 0.01, ..design(case.k, extent) };
            let change = if side_of_lines == Side::Both { all } else { rings };
            let other = shuffled(&case, random, change);
            let (before, after) = (result(&case.lines, &wanted), result(&other, &wanted));
            assert!(before == after, "{} {side_of_rings:?}: {before:?} and {after:?}", case.name);
            built += usize::from(before.is_some());
        }
    }
    assert!(built > 120, "only {built} of 180 were built");
}

/// Buried stretches keep their stations along the line as given, whichever way it is taken inside.
#[test]
fn stations_stay_those_of_the_line_as_given() {
    // A level line crossed by one 6 higher: buried within 12 of the crossing, which is 50 from one end and 70 from the other.
    let across = Polyline { points: vec![[0.0, -40.0, 6.0], [0.0, 40.0, 6.0]], closed: false };
    for (points, at) in [([[-50.0, 0.0, 0.0], [70.0, 0.0, 0.0]], 50.0), ([[70.0, 0.0, 0.0], [-50.0, 0.0, 0.0]], 70.0)] {
        for (lines, number) in [
            (vec![Polyline { points: points.to_vec(), closed: false }, across.clone()], 0),
            (vec![across.clone(), Polyline { points: points.to_vec(), closed: false }], 1),
        ] {
            let found = surface::build(&line(&lines), &design(0.5, Extent::Elevation(-20.0)), None, &()).unwrap().buried;
            let [stretch] = &found[..] else { panic!("{found:?}") };
            assert_eq!((stretch.chain, stretch.by_chain), (number, 1 - number));
            let near = |a: f64, b: f64| (a - b).abs() < 1e-9;
            assert!(near(stretch.from, at - 12.0) && near(stretch.to, at + 12.0), "{stretch:?}");
            assert!((stretch.by_station - 40.0).abs() < 1e-5, "{stretch:?}");
        }
    }
}

fn run(folder: &Path, arguments: &str) -> serde_json::Value {
    assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
        .args(arguments.split(' '))
        .args(["--quiet", "--report", "r.json"])
        .current_dir(folder)
        .timeout(std::time::Duration::from_secs(120))
        .assert()
        .success();
    serde_json::from_slice(&fs::read(folder.join("r.json")).unwrap()).unwrap()
}

/// Two pads and a line on ground, as GeoJSON.
fn site(order: [usize; 3], turned: bool) -> String {
    let mut rings = [
        vec![[-30.0, -20.0, 4.0], [-8.0, -22.0, 4.2], [-9.0, -3.0, 4.4], [-28.0, 1.0, 4.1]],
        vec![[12.0, 6.0, -1.0], [33.0, 8.0, -0.5], [30.0, 24.0, -0.75]],
    ];
    if turned {
        rings.iter_mut().for_each(|ring| ring.rotate_left(2));
        rings[0].reverse();
    }
    let positions = |points: &[[f64; 3]]| points.iter().map(|p| format!("{p:?}")).collect::<Vec<_>>().join(",");
    let polygon = |ring: &Vec<[f64; 3]>| {
        let closed: Vec<[f64; 3]> = ring.iter().chain(&ring[..1]).copied().collect();
        format!(r#""Polygon","coordinates":[[{}]]"#, positions(&closed))
    };
    let open =
        format!(r#""LineString","coordinates":[{}]"#, positions(&[[-40.0, 40.0, 1.0], [0.0, 45.0, 3.0], [35.0, 42.0, 2.0]]));
    let geometries = [polygon(&rings[0]), polygon(&rings[1]), open];
    let feature = |i: usize| format!(r#"{{"type":"Feature","properties":{{}},"geometry":{{"type":{}}}}}"#, geometries[i]);
    format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, order.map(feature).join(","))
}

/// Rolling ground of 30 by 30 squares; `turned`: faces and vertices in the opposite order.
fn ground(turned: bool) -> String {
    const N: usize = 31;
    let at = |i: usize| ((i % N) as f64 * 6.0 - 90.0, (i / N) as f64 * 6.0 - 90.0);
    let mut vertices: Vec<String> =
        (0..N * N).map(at).map(|(x, y)| format!("v {x} {y} {}", 2.0 * (x / 23.0).sin() + 1.5 * (y / 17.0).cos())).collect();
    let squares = (0..(N - 1) * (N - 1)).map(|i| i / (N - 1) * N + i % (N - 1) + 1);
    let mut faces: Vec<[usize; 3]> = squares.flat_map(|a| [[a, a + 1, a + 1 + N], [a, a + 1 + N, a + N]]).collect();
    if turned {
        vertices.reverse();
        faces.reverse();
        faces.iter_mut().flatten().for_each(|v| *v = N * N + 1 - *v);
    }
    let faces: Vec<String> = faces.iter().map(|[a, b, c]| format!("f {a} {b} {c}")).collect();
    format!("{}\n{}\n", vertices.join("\n"), faces.join("\n"))
}

/// The hash of the result, through the program, with ground and without. With the ground in another order figures agree within
/// rounding: where its triangles meet, the first of several equals counts.
#[test]
fn the_hash_of_the_result_in_any_order() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: String| fs::write(folder.path().join(name), text).unwrap();
    write("ground.obj", ground(false));
    write("turned.obj", ground(true));
    let build = |line: String, options: &str| {
        write("line.geojson", line);
        run(folder.path(), &format!("build line.geojson --slope 1:1.5 -o m.obj {options}"))
    };
    for options in ["--distance 6", "--terrain ground.obj --finished f.obj"] {
        let expected = build(site([0, 1, 2], false), options)["result"].clone();
        for order in [[2, 0, 1], [1, 2, 0], [2, 1, 0]] {
            for turned in [false, true] {
                let found = build(site(order, turned), options)["result"].clone();
                for key in ["mesh_sha256", "finished_sha256", "figures_sha256", "sha256"] {
                    assert_eq!(found[key], expected[key], "{options}: {order:?} {turned}: {key}");
                }
            }
        }
    }
    let before = build(site([0, 1, 2], false), "--terrain ground.obj");
    let after = build(site([0, 1, 2], false), "--terrain turned.obj");
    for path in ["/volumes/cut", "/volumes/fill", "/areas/cut", "/areas/fill", "/daylight/length", "/surface/plan_area"] {
        let of = |report: &serde_json::Value| report.pointer(path).and_then(serde_json::Value::as_f64).unwrap();
        let (a, b) = (of(&before), of(&after));
        assert!((a - b).abs() <= 1e-9 * a.abs(), "{path}: {a} and {b}");
    }
}
