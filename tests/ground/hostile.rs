//! Ground that is not what it should be. Every answer is a message with an exit code, and no output is left behind.

use crate::common::build::{open, rectangle};
use crate::run::{Folder, Run};
use crate::site::Site;
use crate::tin::{Ground, about};

const BUILD: &str = "build line.geojson --slope 1:2 -o d.obj --finished f.ply --report r.json --lines l.geojson";

/// A pad 3 above level ground 80 wide, far from the origin.
fn site() -> Site {
    Site::new(vec![rectangle([-8.0, -6.0, 3.0], 16.0, 12.0)], 0.5, Ground::grid(about(40.0), 16, 16, |x, y| 0.02 * x + 0.01 * y))
        .map(|[x, y, z]| [x + 641_000.0, y + 5_203_000.0, z + 600.0])
}

/// Fails with one of these codes, says what it should, names the file, and leaves no file. Gives what was said.
#[track_caller]
fn refused(folder: &Folder, arguments: &str, codes: &[i32], words: &[&str]) -> String {
    let before = folder.files();
    let Run { code, stderr } = folder.run(&format!("{BUILD} {arguments}"));
    assert!(codes.contains(&code), "{arguments}: code {code}\n{stderr}");
    assert!(stderr.contains("error: ") && stderr.contains("-->") && stderr.contains("\n   = "), "{arguments}:\n{stderr}");
    for word in words {
        let found = word.split('|').any(|w| stderr.to_lowercase().contains(w));
        assert!(found, "{arguments}: no `{word}` in\n{stderr}");
    }
    assert_eq!(folder.files(), before, "{arguments}");
    stderr
}

#[track_caller]
fn refused_ground(content: impl AsRef<[u8]>, name: &str, codes: &[i32], words: &[&str]) -> String {
    let folder = Folder::of(&site()).with(name, content);
    let told = refused(&folder, &format!("--terrain {name}"), codes, words);
    assert!(told.contains(name), "{told}");
    told
}

#[test]
fn sound_ground_is_taken() {
    let folder = Folder::of(&site());
    folder.run(&format!("{BUILD} --terrain ground.obj")).done();
    assert_eq!(folder.files(), ["d.obj", "f.ply", "ground.obj", "l.geojson", "line.geojson", "r.json"]);
}

/// The height of a point to four digits, as a message may print it.
fn near(told: &str, x: f64, y: f64) -> bool {
    let numbers: Vec<f64> =
        told.split(|c: char| !(c.is_ascii_digit() || c == '.')).filter_map(|w| w.trim_matches('.').parse().ok()).collect();
    numbers.windows(2).any(|w| (w[0] - x).abs() < 25.0 && (w[1] - y).abs() < 25.0)
}

/// A hole under the platform, under the slopes, and one just beside the works, which does no harm.
#[test]
fn holes() {
    for (x, harm) in [(0.0, true), (11.0, true), (30.0, false)] {
        let site = site();
        let off = |t: [[f64; 3]; 3]| t.iter().all(|v| (v[0] - 641_000.0 - x).abs() < 5.1 && (v[1] - 5_203_000.0).abs() < 5.1);
        let folder = Folder::of(&site).with("g.obj", site.ground.only(|t| !off(t)).obj());
        if harm {
            let told = refused(&folder, "--terrain g.obj", &[1], &["g.obj", "edge|hole|gap|covered|ends|no ground"]);
            assert!(near(&told, 641_000.0 + x, 5_203_000.0), "no place in\n{told}");
        } else {
            folder.run(&format!("{BUILD} --terrain g.obj")).done();
        }
    }
}

/// Ground that ends before the slopes do: an error that says where, and with leave incomplete figures.
#[test]
fn ground_smaller_than_the_reach() {
    let site = site();
    // Slopes end about 6 beyond the pad, at 14; the ground ends at 10.
    let small = site.ground.only(|t| t.iter().all(|v| v[0] < 641_010.1));
    let folder = Folder::of(&site).with("g.obj", small.obj());
    let told = refused(&folder, "--terrain g.obj", &[1], &["g.obj", "--allow-open"]);
    assert!(near(&told, 641_010.0, 5_203_000.0), "no place in\n{told}");
    folder.run(&format!("{BUILD} --terrain g.obj --allow-open")).done();
    let report: serde_json::Value = serde_json::from_str(&folder.read("r.json")).unwrap();
    assert_eq!(report["volumes"]["complete"], false, "{report}");
    assert!(report["daylight"]["open_length"].as_f64().unwrap() > 1.0, "{report}");
    assert!(!report["warnings"].as_array().unwrap().is_empty(), "{report}");
    // No more than on the whole ground, and at least what the platform takes: 192 · 3.
    let whole = crate::run::build(&site, "").figures();
    let fill = report["volumes"]["fill"].as_f64().unwrap();
    assert!(fill < whole.fill && fill > 0.8 * whole.fill, "{fill} of {}", whole.fill);
}

/// Even the platform is not covered.
#[test]
fn line_partly_beside_the_ground() {
    let site = site();
    let small = site.ground.only(|t| t.iter().all(|v| v[0] < 641_000.1));
    let folder = Folder::of(&site).with("g.obj", small.obj());
    let told = refused(&folder, "--terrain g.obj", &[1], &["g.obj"]);
    assert!(near(&told, 641_004.0, 5_203_000.0), "no place in\n{told}");
}

#[test]
fn line_beside_the_ground() {
    let site = site();
    let moved = site.ground.map(|[x, y, z]| [x + 300.0, y, z]);
    // Both boxes.
    refused_ground(moved.obj(), "g.obj", &[1], &["640992", "641260", "overlap|apart|same place"]);
    let swapped = site.ground.map(|[x, y, z]| [y, x, z]);
    refused_ground(swapped.obj(), "g.obj", &[1], &["swap|exchang|northing"]);
}

/// Line in metres, ground in feet, and the other way round.
#[test]
fn feet_and_metres() {
    let site = site();
    for unit in [1.0 / 0.3048, 3937.0 / 1200.0, 0.3048] {
        refused_ground(site.ground.map(|p| p.map(|v| v * unit)).obj(), "g.obj", &[1], &["feet", "metre"]);
    }
}

#[test]
fn files_of_another_kind() {
    let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10\0\0\0\x10\x08\x06\0\0\0\x1f\xf3\xffa";
    let obj = site().ground.obj();
    let ply = site().ground.ply();
    for (name, content) in [
        ("png.obj", &png[..]),
        ("png.ply", &png[..]),
        ("obj.ply", obj.as_bytes()),
        ("ply.obj", &ply[..]),
        ("json.obj", b"{\"type\":\"FeatureCollection\",\"features\":[]}"),
        ("json.ply", b"{}"),
        ("empty.obj", b""),
        ("empty.ply", b""),
        ("zip.obj", b"PK\x03\x04\x14\0\0\0\x08\0"),
        ("header.ply", b"ply\nformat binary_little_endian 1.0\n"),
        ("format.ply", b"ply\nformat utf8 1.0\nelement vertex 0\nend_header\n"),
    ] {
        refused_ground(content, name, &[3], &[]);
    }
    let folder = Folder::of(&site());
    refused(&folder, "--terrain line.geojson", &[2, 3], &["line.geojson"]);
    refused(&folder, "--terrain missing.obj", &[3], &["missing.obj"]);
    let folder = folder.with("ground.tif", "II*\0").with("ground", "what is this\n");
    refused(&folder, "--terrain ground.tif", &[2, 3], &[".tif", ".obj|tiff"]);
    refused(&folder, "--terrain ground", &[2, 3], &["ending|extension"]);
    // Without an ending the content tells.
    folder.with("bare", &obj).run(&format!("{BUILD} --terrain bare")).done();
}

/// A PLY that promises more than it holds.
#[test]
fn promises_of_a_ply() {
    let header = |vertices: &str, faces: &str, format: &str| {
        format!(
            "ply\nformat {format} 1.0\nelement vertex {vertices}\nproperty double x\nproperty double y\nproperty double z\n\
             element face {faces}\nproperty list uchar int vertex_indices\nend_header\n"
        )
    };
    for format in ["binary_little_endian", "binary_big_endian", "ascii"] {
        for (vertices, faces) in
            [("1000000000", "1"), ("18446744073709551615", "1"), ("3", "4000000000"), ("-1", "1"), ("1e3", "0")]
        {
            let content = header(vertices, faces, format) + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
            let start = std::time::Instant::now();
            refused_ground(content, "large.ply", &[3], &[]);
            assert!(start.elapsed().as_secs() < 10, "{format} {vertices} {faces}");
        }
    }
    let whole = site().ground.ply();
    for length in [whole.len() - 1, whole.len() / 2, whole.len() / 4, 120, 30, 3] {
        refused_ground(&whole[..length], "cut.ply", &[3], &[]);
    }
}

#[test]
fn numbers_that_are_none() {
    let site = site();
    let obj = site.ground.obj();
    let vertex = obj.lines().nth(40).unwrap();
    let (plan, _) = vertex.rsplit_once(' ').unwrap();
    for bad in ["nan", "NaN", "inf", "-inf", "1e999", "abc", ""] {
        let told = refused_ground(obj.replace(vertex, &format!("{plan} {bad}")), "bad.obj", &[1, 3], &[]);
        // Line 41 of the file, vertex 40.
        assert!(told.contains("41") || told.contains("40"), "{bad}: {told}");
    }
    let mut ply = site.ground.clone();
    ply.vertices[100][2] = f64::NAN;
    refused_ground(ply.ply(), "nan.ply", &[1, 3], &["vertex"]);
    let mut ply = site.ground.clone();
    ply.vertices[100][0] = f64::INFINITY;
    refused_ground(ply.ply(), "inf.ply", &[1, 3], &["vertex"]);
}

#[test]
fn indices_out_of_range() {
    let obj = site().ground.obj();
    for face in ["f 1 2 999999", "f 0 1 2", "f 1 2 -999999", "f 1 2 99999999999999999999", "f 1 2 x"] {
        refused_ground(format!("{obj}{face}\n"), "bad.obj", &[1, 3], &[]);
    }
    for index in [u32::MAX, 1 << 31, 100_000] {
        let mut ply = site().ground.ply();
        let end = ply.len();
        ply[end - 4..].copy_from_slice(&index.to_le_bytes());
        refused_ground(ply, "bad.ply", &[1, 3], &[]);
    }
}

/// Ground with two heights at one place under the works.
#[test]
fn not_single_valued() {
    let ground = site().ground;
    let with = |corners: [[f64; 3]; 3]| {
        let mut ground = ground.clone();
        let n = ground.vertices.len();
        ground.vertices.extend(corners.map(|[x, y, z]| [x + 641_000.0, y + 5_203_000.0, z]));
        ground.triangles.push([n, n + 1, n + 2]);
        ground.obj()
    };
    refused_ground(
        with([[-3.0, -3.0, 605.0], [5.0, -3.0, 605.0], [0.0, 4.0, 605.0]]),
        "g.obj",
        &[1, 3],
        &["overlap|overhang|twice|single|above"],
    );
    // A face without area in plan takes no room: it is left out, and that is said.
    let wall = with([[-3.0, 1.0, 600.0], [5.0, 1.0, 600.0], [0.0, 1.0, 606.0]]);
    let run = Folder::of(&site()).with("g.obj", wall).run(&format!("{BUILD} --terrain g.obj")).done();
    assert!(run.stderr.contains("[ground-faces-degenerate]"), "{}", run.stderr);
}

/// Points without triangles are triangulated, which is said; no points are no ground.
#[test]
fn no_triangles() {
    let Ground { vertices, .. } = site().ground;
    let points = |vertices: &[[f64; 3]]| Ground { vertices: vertices.to_vec(), triangles: Vec::new() };
    let folder = Folder::of(&site()).with("points.ply", points(&vertices).ply()).with("points.obj", points(&vertices).obj());
    for name in ["points.ply", "points.obj"] {
        let run = folder.run(&format!("{BUILD} --terrain {name}")).done();
        assert!(run.stderr.contains("note[ground-triangulated]"), "{}", run.stderr);
    }
    for few in [0, 1, 2] {
        refused_ground(points(&vertices[..few]).ply(), "few.ply", &[1, 3], &[]);
        refused_ground(points(&vertices[..few]).obj(), "few.obj", &[1, 3], &[]);
    }
    // All on one line.
    refused_ground(points(&vertices[..10]).obj(), "row.obj", &[1, 3], &[]);
}

/// An output that cannot be written leaves the others unwritten.
#[test]
fn outputs_are_whole_or_absent() {
    let folder = Folder::of(&site());
    let before = folder.files();
    for output in ["-o no/d.obj", "--finished no/f.obj", "--lines no/l.geojson", "--report no/r.json"] {
        let run = folder.run(&format!("{BUILD} --terrain ground.obj {output}"));
        assert!([2, 4].contains(&run.code), "{output}: {}\n{}", run.code, run.stderr);
        assert_eq!(folder.files(), before, "{output}");
    }
    let run = folder.run("build line.geojson --slope 1:2 --terrain ground.obj -o d.obj --finished f.skp");
    assert_eq!((run.code, folder.files()), (2, before), "{}", run.stderr);
}

/// Options that mean nothing without ground, or nothing with it.
#[test]
fn options_that_do_not_fit() {
    let folder = Folder::of(&site());
    for arguments in ["--finished f.obj", "--direction auto", "--allow-open --finished f.obj"] {
        let run = folder.run(&format!("build line.geojson --slope 1:2 -o d.obj {arguments}"));
        assert_eq!(run.code, 2, "{arguments}: {}", run.stderr);
    }
    let steep = Site { lines: vec![open(&[[0.0, 0.0, 600.0], [10.0, 0.0, 606.0]])], ..site() };
    let run = Folder::of(&steep).run(&format!("{BUILD} --terrain ground.obj"));
    assert_eq!(run.code, 1, "{}", run.stderr);
}
