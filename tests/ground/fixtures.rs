//! The small hillside in `fixtures/`: how it is made, and that it is what it is said to be.

use crate::common::lines::Random;
use crate::run::{Folder, build_in};
use crate::tin::{Cells, Ground};
use std::path::{Path, PathBuf};

/// South-west corner of the ground; lengths are metres.
const ORIGIN: [f64; 2] = [641_000.0, 5_203_000.0];
/// Size of the ground, and its points each way.
const SIZE: [f64; 2] = [300.0, 216.0];
const CELLS: [usize; 2] = [50, 36];

/// Coordinates of surveys have three decimals.
fn millimetres(v: f64) -> f64 {
    (v * 1000.0).round() / 1000.0
}

/// A hillside that rises to the north by 14 %, with a spur and a gully down it and some long waves.
fn hillside(x: f64, y: f64) -> f64 {
    let bell = |d: f64, width: f64| (-(d / width) * (d / width)).exp();
    let spur = 4.6 * bell(x - 92.0 - 0.08 * y, 27.0) * (1.0 - 0.3 * bell(y - 20.0, 60.0));
    let gully = -6.0 * bell(x - 196.0 + 0.12 * y, 22.0);
    let waves = 0.7 * (0.045 * x + 0.02 * y).sin() + 0.5 * (0.05 * y - 0.03 * x + 1.0).sin();
    612.0 + 0.14 * y + spur + gully + waves
}

/// The hillside with the jitter and the roughness of a survey on foot: ± 6 cm.
fn ground() -> Ground {
    let random = &mut Random::new(2026);
    let mut ground = Ground::grid([[0.0; 2], SIZE], CELLS[0], CELLS[1], |_, _| 0.0);
    for v in &mut ground.vertices {
        for axis in 0..2 {
            let shift = random.between(-1.4, 1.4);
            if v[axis] > 0.0 && v[axis] < SIZE[axis] {
                v[axis] += shift;
            }
        }
        v[2] = hillside(v[0], v[1]) + random.between(-0.06, 0.06);
        *v = [millimetres(v[0] + ORIGIN[0]), millimetres(v[1] + ORIGIN[1]), millimetres(v[2])];
    }
    // Of both diagonals the one with the smaller step in height: ridges and gullies are followed, not crossed.
    for pair in ground.triangles.chunks_exact_mut(2) {
        let mut ring: Vec<usize> = pair[0].to_vec();
        ring.extend(pair[1].iter().filter(|v| !pair[0].contains(v)));
        ring.sort_unstable();
        let [a, b, d, c] = ring[..] else { continue };
        let step = |v: usize, w: usize| (ground.vertices[v][2] - ground.vertices[w][2]).abs();
        let cut = if step(a, c) <= step(b, d) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        pair.copy_from_slice(&cut);
    }
    ground
}

/// Centre line along the hillside: from the west edge round the spur and over the gully. It begins and ends on the ground.
fn road() -> Vec<[f64; 3]> {
    let ground = ground();
    let cells = Cells::new(&ground);
    let at = |i: usize| {
        let x = 36.0 + 9.5 * i as f64;
        [x, 92.0 + 13.0 * ((x - 60.0) / 48.0).sin() + 0.05 * x]
    };
    let last = 24;
    let on = |i: usize| {
        let [x, y] = at(i);
        cells.height(&ground, x + ORIGIN[0], y + ORIGIN[1], 1e-6).expect("on the ground")
    };
    let (from, to) = (on(0), on(last));
    let z = |i: usize| {
        let w = i as f64 / last as f64;
        from + (to - from) * w + 2.0 * (std::f64::consts::PI * w).sin()
    };
    let point = |i: usize| [millimetres(at(i)[0] + ORIGIN[0]), millimetres(at(i)[1] + ORIGIN[1]), millimetres(z(i))];
    (0..=last).map(point).collect()
}

/// Edge of a yard of 36 by 24 that falls by 1 % to the south, turned by 8° and dug half into the hillside.
fn pad() -> Vec<[f64; 3]> {
    let (sin, cos) = 8_f64.to_radians().sin_cos();
    let middle = [142.0, 172.0];
    let z = (hillside(middle[0], middle[1]) * 10.0).round() / 10.0;
    let corner = |[u, v]: [f64; 2]| {
        let at = [middle[0] + cos * u - sin * v, middle[1] + sin * u + cos * v];
        [millimetres(at[0] + ORIGIN[0]), millimetres(at[1] + ORIGIN[1]), millimetres(z + 0.01 * v)]
    };
    [[-18.0, -12.0], [18.0, -12.0], [18.0, 12.0], [-18.0, 12.0]].map(corner).to_vec()
}

fn obj(ground: &Ground) -> String {
    let mut text = String::from("# A hillside of our own making, metres, easting northing elevation\n");
    for [x, y, z] in &ground.vertices {
        text += &format!("v {x:.3} {y:.3} {z:.3}\n");
    }
    for t in &ground.triangles {
        text += &format!("f {} {} {}\n", t[0] + 1, t[1] + 1, t[2] + 1);
    }
    text
}

fn feature(name: &str, kind: &str, points: &[[f64; 3]]) -> String {
    let ring = kind == "Polygon";
    let all = points.iter().chain(points.first().filter(|_| ring));
    let rows: Vec<String> = all.map(|[x, y, z]| format!("      [{x:.3}, {y:.3}, {z:.3}]")).collect();
    let rows = rows.join(",\n");
    let coordinates = if ring { format!("[[\n{rows}\n    ]]") } else { format!("[\n{rows}\n    ]") };
    format!(
        "{{\n  \"type\": \"Feature\",\n  \"properties\": {{ \"name\": \"{name}\" }},\n  \"geometry\": {{\n    \"type\": \"{kind}\",\n    \
         \"coordinates\": {coordinates}\n  }}\n}}\n"
    )
}

fn files() -> [(&'static str, String); 3] {
    [
        ("ground.obj", obj(&ground())),
        ("hill_road.geojson", feature("hill road", "LineString", &road())),
        ("hill_pad.geojson", feature("hill yard", "Polygon", &pad())),
    ]
}

fn fixtures() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures")
}

/// Makes the files again: `cargo test --test ground -- --ignored write_fixtures`.
#[test]
#[ignore = "writes into fixtures/"]
fn write_fixtures() {
    for (name, text) in files() {
        std::fs::write(fixtures().join(name), text).unwrap();
    }
}

#[test]
fn are_as_made() {
    for (name, text) in files() {
        assert!(text.len() < 300_000, "{name}: {} bytes", text.len());
        let found = std::fs::read_to_string(fixtures().join(name)).unwrap_or_default();
        assert!(found.replace("\r\n", "\n") == text, "fixtures/{name} is not what the generator makes");
    }
}

/// The road is deep in the ground and high above it; it begins and ends at it.
#[test]
fn road_goes_through_cut_and_fill() {
    let ground = ground();
    let cells = Cells::new(&ground);
    let above: Vec<f64> = road().iter().map(|p| p[2] - cells.height(&ground, p[0], p[1], 1e-6).unwrap()).collect();
    let (lowest, highest) = above.iter().fold((0.0_f64, 0.0_f64), |(lo, hi), &h| (lo.min(h), hi.max(h)));
    assert!((-6.0..-2.0).contains(&lowest) && (2.0..6.0).contains(&highest), "{above:?}");
    assert!(above[0].abs() < 0.01 && above[above.len() - 1].abs() < 0.01, "{above:?}");
    let points = road();
    let steepest = points.windows(2).map(|w| ((w[1][2] - w[0][2]) / (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).abs());
    assert!(steepest.fold(0.0, f64::max) < 0.08);
}

#[test]
fn build_as_shown() {
    let folder = Folder::new();
    let place = fixtures();
    for (file, options) in [("hill_road.geojson", "--width 7"), ("hill_pad.geojson", "")] {
        let (line, ground) = (place.join(file), place.join("ground.obj"));
        let (line, ground) = (line.display(), ground.display());
        let built = build_in(&folder, &format!("{line} --terrain {ground} --cut-slope 1:1 --fill-slope 1:1.5 {options}"));
        let found = built.figures();
        assert!(found.cut > 300.0 && found.fill > 300.0, "{file}: {found:?}");
        assert_eq!(built.report["volumes"]["complete"], true, "{file}");
        assert_eq!(built.report["line"]["buried"].as_array().map(Vec::len), Some(0), "{file}");
        let (by_mesh, _) = crate::clip::between(&built.finished.tin, &ground_of(&place));
        by_mesh.volumes_near(&found, 1e-9, file);
    }
}

fn ground_of(place: &Path) -> Ground {
    crate::run::Mesh::from_obj(&std::fs::read_to_string(place.join("ground.obj")).unwrap()).tin
}
