//! Existing ground from outside: every format gives the same surface, every defect is told.

use slopegen::model::Terrain;
use slopegen::read::InputFormat;
use slopegen::read::terrain::{TerrainOptions, parse_terrain, read_terrain};
use slopegen::terrain::{inspect, prepare};
use std::fmt::Write as _;

/// Reads, prepares and inspects; the codes of all notes.
fn ground(format: InputFormat, bytes: &[u8]) -> Result<(Terrain, Vec<&'static str>), String> {
    let raw = parse_terrain("a", bytes, &TerrainOptions::of(format)).map_err(|e| e.to_string())?;
    let prepared = prepare(raw).map_err(|e| e.to_string())?;
    let found = inspect("a", &prepared.terrain);
    found.defects.into_result().map_err(|e| e.to_string())?;
    let notes = prepared.notes.iter().chain(&found.notes).map(|note| note.code);
    Ok((prepared.terrain, notes.filter(|code| *code != "csv-dialect").collect()))
}

/// Plan area, and volume above zero. All triangles are counter-clockwise.
fn measure(terrain: &Terrain) -> (f64, f64) {
    (0..terrain.triangles.len()).fold((0.0, 0.0), |(area, volume), t| {
        let [a, b, c] = terrain.corners(t);
        let plan = 0.5 * (b - a).truncate().perp_dot((c - a).truncate());
        assert!(plan > 0.0);
        (area + plan, volume + plan * (a.z + b.z + c.z) / 3.0)
    })
}

/// Nodes from west to east in a row, rows from south to north.
const N: usize = 6;

/// Ground of 5 × 5 squares with sides of 10, heights all different, no square flat.
fn vertices() -> Vec<[f64; 3]> {
    let node = |i: usize| ((i % N) as f64, (i / N) as f64);
    (0..N * N)
        .map(node)
        .map(|(x, y)| [500_000.0 + 10.0 * x, 5_400_000.0 + 10.0 * y, 100.0 + 2.0 * x + 0.5 * y + 0.25 * x * y])
        .collect()
}

/// Each square cut from south-west to north-east or the other way, whichever ends differ less in height: with the heights above
/// the falling diagonal, always.
fn triangles() -> Vec<[usize; 3]> {
    let squares = (0..N * (N - 1)).filter(|i| i % N < N - 1);
    squares.flat_map(|a| [[a, a + 1, a + N], [a + 1, a + N + 1, a + N]]).collect()
}

fn obj(vertices: &[[f64; 3]], triangles: &[[usize; 3]]) -> String {
    let mut text = String::new();
    for [x, y, z] in vertices {
        writeln!(text, "v {x} {y} {z}").unwrap();
    }
    for [a, b, c] in triangles {
        writeln!(text, "f {} {} {}", a + 1, b + 1, c + 1).unwrap();
    }
    text
}

/// Types of coordinates, counts and indices of a binary PLY.
fn ply(little: bool, double: bool, count: usize, index: usize) -> Vec<u8> {
    let name = |size| ["", "uchar", "ushort", "", "int"][size];
    let (order, real) = (if little { "little" } else { "big" }, if double { "double" } else { "float" });
    let mut bytes = format!(
        "ply\nformat binary_{order}_endian 1.0\ncomment x\nelement vertex {}\nproperty uchar red\nproperty {real} x\nproperty {real} \
         y\nproperty {real} z\nelement other 2\nproperty list uchar short q\nelement face {}\nproperty float w\nproperty list {} {} \
         vertex_index\nend_header\n",
        N * N,
        triangles().len(),
        name(count),
        name(index)
    )
    .into_bytes();
    let mut put = |mut raw: Vec<u8>| {
        if !little {
            raw.reverse();
        }
        bytes.extend(raw);
    };
    for v in vertices() {
        put(vec![7]);
        v.into_iter().for_each(|x| put(if double { x.to_le_bytes().to_vec() } else { (x as f32).to_le_bytes().to_vec() }));
    }
    for _ in 0..2 {
        put(vec![2]);
        put(vec![1, 2]);
        put(vec![3, 4]);
    }
    for t in triangles() {
        put(1.5_f32.to_le_bytes().to_vec());
        put(3_u32.to_le_bytes()[..count].to_vec());
        t.into_iter().for_each(|v| put((v as u32).to_le_bytes()[..index].to_vec()));
    }
    bytes
}

fn ascii_ply() -> String {
    let mut text = format!(
        "ply\nformat ascii 1.0\nelement vertex {}\nproperty double x\nproperty double y\nproperty double z\nelement face {}\nproperty \
         list uchar int vertex_indices\nend_header\n",
        N * N,
        triangles().len()
    );
    vertices().iter().for_each(|[x, y, z]| writeln!(text, "{x} {y} {z}").unwrap());
    triangles().iter().for_each(|[a, b, c]| writeln!(text, "3 {a} {b} {c}").unwrap());
    text
}

fn asc() -> String {
    let mut text = format!("ncols {N}\nnrows {N}\nxllcorner 499995\nyllcorner 5399995\ncellsize 10\n");
    for row in vertices().chunks(N).rev() {
        let row: Vec<String> = row.iter().map(|[_, _, z]| z.to_string()).collect();
        writeln!(text, "{}", row.join(" ")).unwrap();
    }
    text
}

#[test]
fn every_format_gives_the_same_ground() {
    let (given, faces) = (vertices(), triangles());
    let (reference, notes) = ground(InputFormat::Obj, obj(&given, &faces).as_bytes()).unwrap();
    assert!(notes.is_empty(), "{notes:?}");
    assert_eq!(reference.triangles.len(), 2 * (N - 1) * (N - 1));
    let (area, volume) = measure(&reference);
    assert_eq!(area, 2500.0);
    let world: Vec<[f64; 3]> = reference.vertices.iter().map(|v| reference.frame.to_world(*v).to_array()).collect();
    assert_eq!(world, given, "vertices of the file, in its order, to the bit");
    let flipped: Vec<[usize; 3]> = faces.iter().map(|&[a, b, c]| [a, c, b]).collect();
    let soup: Vec<[f64; 3]> = faces.iter().flatten().map(|&v| given[v]).collect();
    let soup_faces: Vec<[usize; 3]> = (0..faces.len()).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let twice = [&faces[..], &flipped[..3], &[[4, 4, 5], [0, 1, 2]]].concat();
    let apart = [&given[..], &[[0.0, 0.0, 0.0]]].concat();
    let cases: [(InputFormat, Vec<u8>, &[&str]); 12] = [
        (InputFormat::Obj, obj(&given, &flipped).into_bytes(), &["ground-faces-turned"]),
        (InputFormat::Obj, obj(&soup, &soup_faces).into_bytes(), &["ground-welded"]),
        (
            InputFormat::Obj,
            obj(&given, &twice).into_bytes(),
            &["ground-faces-turned", "ground-faces-degenerate", "ground-faces-repeated"],
        ),
        (InputFormat::Obj, obj(&apart, &faces).into_bytes(), &["ground-vertices-unused"]),
        (InputFormat::Ply, ascii_ply().into_bytes(), &[]),
        (InputFormat::Ply, ascii_ply().replace('\n', "\r\n").into_bytes(), &[]),
        (InputFormat::Ply, ply(true, true, 1, 4), &["ply-elements-ignored"]),
        (InputFormat::Ply, ply(false, true, 4, 2), &["ply-elements-ignored"]),
        (InputFormat::Ply, ply(true, false, 2, 1), &["ply-elements-ignored"]),
        (InputFormat::Ply, ply(false, false, 1, 4), &["ply-elements-ignored"]),
        (InputFormat::Asc, asc().into_bytes(), &["ground-grid"]),
        (InputFormat::Asc, asc().replace(' ', "\n").into_bytes(), &["ground-grid"]),
    ];
    for (i, (format, bytes, expected)) in cases.into_iter().enumerate() {
        let (terrain, notes) = ground(format, &bytes).unwrap_or_else(|e| panic!("case {i}: {e}"));
        assert_eq!(notes, expected, "case {i}");
        // Multiples of 1/4: the sums are exact but for the division by three.
        let (a, v) = measure(&terrain);
        assert!(a == area && (v - volume).abs() <= 1e-12 * volume, "case {i}: {a} {v}");
    }
}

#[test]
fn points_are_triangulated() {
    let rows = |separator: &str| vertices().iter().map(|v| v.map(|x| x.to_string()).join(separator) + "\n").collect::<String>();
    let text = format!("x,y,z\n{}", rows(","));
    let (terrain, notes) = ground(InputFormat::Csv, text.as_bytes()).unwrap();
    assert_eq!((terrain.triangles.len(), measure(&terrain).0, notes), (50, 2500.0, vec!["ground-triangulated"]));
    let mut more = text.clone();
    more.push_str("500000,5400000,100\n500010,5400000,105.5\n");
    let (terrain, notes) = ground(InputFormat::Csv, more.as_bytes()).unwrap();
    assert_eq!(terrain.triangles.len(), 50);
    assert_eq!(notes, ["ground-points-repeated", "ground-points-conflict", "ground-triangulated"]);
    let error = ground(InputFormat::Csv, b"x,y,z\n1,1,5\n2,2,5\n3,3,5\n").unwrap_err();
    assert!(error.contains("make no surface"), "{error}");
    let error = ground(InputFormat::Csv, format!("{text}500005,5400005,-9999\n").as_bytes()).unwrap_err();
    assert!(error.contains("marker for a missing height") && error.contains("vertex 37"), "{error}");
    assert!(error.ends_with("help: take such points out"), "{error}");
    let grid = "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -32768\n100 101 102\n103 -9999 104\n";
    let error = ground(InputFormat::Asc, grid.as_bytes()).unwrap_err();
    assert!(error.ends_with("help: declare it in the head of the file: `NODATA_value -9999`"), "{error}");
    let mut with = vertices();
    with[14][2] = -9999.0;
    let error = ground(InputFormat::Obj, obj(&with, &triangles()).as_bytes()).unwrap_err();
    assert!(error.ends_with("help: take such points out, and the faces that use them"), "{error}");
    // The name of a file says its columns, or nothing does.
    let folder = tempfile::tempdir().unwrap();
    for (name, sound) in [("a.xyz", true), ("a.txt", false)] {
        let path = folder.path().join(name);
        std::fs::write(&path, rows(" ")).unwrap();
        assert_eq!(read_terrain(&path, &TerrainOptions::default()).is_ok(), sound, "{name}");
    }
}

#[test]
fn a_spike_a_hole_and_a_piece_are_told() {
    let (given, faces) = (vertices(), triangles());
    let mut spiked = given.clone();
    spiked[14][2] += 500.0;
    let codes = |v: &[[f64; 3]], t: &[[usize; 3]]| ground(InputFormat::Obj, obj(v, t).as_bytes()).unwrap().1;
    assert_eq!(codes(&spiked, &faces), ["ground-spikes"]);
    let around = |v: usize| faces.iter().copied().filter(|t| !t.contains(&v)).collect::<Vec<_>>();
    assert_eq!(codes(&given, &around(14)), ["ground-vertices-unused", "ground-holes"]);
    let mut pieces = given.clone();
    pieces.extend([[500_100.0, 5_400_000.0, 1.0], [500_110.0, 5_400_000.0, 1.0], [500_100.0, 5_400_010.0, 1.0]]);
    assert_eq!(codes(&pieces, &[&faces[..], &[[36, 37, 38]]].concat()), ["ground-pieces"]);
    // Single precision at 5 400 000 has steps of 0.5; the widest 2²² ≤ y < 2²³.
    let rounded: Vec<[f64; 3]> =
        given.iter().map(|v| [f64::from((v[0] + 0.03) as f32), f64::from((v[1] + 0.3) as f32), v[2]]).collect();
    let raw = parse_terrain("a", obj(&rounded, &faces).as_bytes(), &TerrainOptions::of(InputFormat::Obj)).unwrap();
    let notes = prepare(raw).unwrap().notes;
    assert_eq!(notes[0].code, "ground-single-precision");
    assert!(notes[0].message.contains("steps of up to 0.5 at 5400050"), "{}", notes[0].message);
}

/// Nodes of a grid at half metres five thousand kilometres north are numbers of single precision, and rounded by nobody.
#[test]
fn grids_at_half_metres_are_not_rounded() {
    let text = "ncols 3\nnrows 3\nxllcorner 500000\nyllcorner 5400000\ncellsize 1\n1 2 3\n2 3 4\n3 4 6\n";
    let (terrain, notes) = ground(InputFormat::Asc, text.as_bytes()).unwrap();
    assert!(terrain.vertices.iter().all(|v| (terrain.frame.to_world(*v).y.fract() - 0.5).abs() < 1e-12));
    assert_eq!(notes, ["ground-grid"]);
}

#[test]
fn ground_that_is_no_surface_is_refused() {
    let (given, faces) = (vertices(), triangles());
    let error = |v: &[[f64; 3]], t: &[[usize; 3]]| ground(InputFormat::Obj, obj(v, t).as_bytes()).unwrap_err();
    // A triangle three above another; a wall along an inner edge; the whole on its side; longitude and latitude.
    let above = [&given[..], &[0, 1, 6].map(|v: usize| [given[v][0], given[v][1], given[v][2] + 3.0])].concat();
    assert!(error(&above, &[&faces[..], &[[36, 37, 38]]].concat()).contains("lie on each other"));
    let wall = [&given[..], &[[given[14][0], given[14][1], 150.0]]].concat();
    let message = error(&wall, &[&faces[..], &[[14, 15, 36]]].concat());
    assert!(message.contains("vertical faces") && message.contains("triangle 51"), "{message}");
    let upright: Vec<[f64; 3]> = given.iter().map(|[x, y, z]| [*x, *z, -y]).collect();
    assert!(error(&upright, &faces).contains("export it with Z up"), "{}", error(&upright, &faces));
    // Near the origin only the way the triangles lie can tell.
    let hilly: Vec<[f64; 3]> =
        (0..N * N).map(|i| [(i % N) as f64 * 10.0, [3.0, 0.0, 5.0, 1.0, 4.0][i * i % 5], -((i / N) as f64) * 10.0]).collect();
    assert!(error(&hilly, &faces).contains("export it with Z up"), "{}", error(&hilly, &faces));
    let degrees: Vec<[f64; 3]> = given.iter().map(|[x, y, z]| [(x - 5e5) * 1e-5 + 9.0, (y - 5.4e6) * 1e-5 + 48.0, *z]).collect();
    assert!(error(&degrees, &faces).contains("longitude and latitude"));
    let huge: Vec<[f64; 3]> = given.iter().map(|[x, y, z]| [x * 1e5, *y, *z]).collect();
    assert!(error(&huge, &faces).contains("beyond 10⁹"));
    let message = ground(
        InputFormat::Asc,
        asc()
            .replace("xllcorner 499995", "xllcorner 9")
            .replace("yllcorner 5399995", "yllcorner 48")
            .replace("cellsize 10", "cellsize 0.001")
            .as_bytes(),
    )
    .unwrap_err();
    assert!(message.contains("gdalwarp"), "{message}");
}

/// A sliver at the edge of a triangulation, its corners on one line in plan, may go.
#[test]
fn slivers_at_the_edge_go() {
    let vertices = [[0.0, 0.0, 0.0], [10.0, 0.0, 0.0], [5.0, 0.0, 0.2], [5.0, 9.0, 1.0]];
    let (terrain, notes) = ground(InputFormat::Obj, obj(&vertices, &[[0, 2, 3], [2, 1, 3], [0, 1, 2]]).as_bytes()).unwrap();
    assert_eq!((measure(&terrain).0, notes), (45.0, vec!["ground-faces-degenerate"]));
}

#[test]
fn declared_numbers_allocate_nothing() {
    let head = "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty double x\nproperty double y\nproperty double z\n";
    let faces = "element face 1000000000\nproperty list uint uint vertex_indices\nend_header\n";
    for text in [
        format!("{head}{faces}"),
        format!("{head}end_header\n{}", "x".repeat(1000)),
        format!("{head}{faces}").replace("binary_little_endian", "ascii"),
        format!("{head}property list uint double q\nend_header\n{}", "\u{7f}".repeat(500)),
        head.replace("1000000000", "0") + faces + &"\u{7f}".repeat(500),
    ] {
        let error = ground(InputFormat::Ply, text.as_bytes()).unwrap_err();
        assert!(error.contains("cut off") || error.contains("declares"), "{error}");
    }
    // Records without properties are nothing, however many.
    let text = ascii_ply().replace("element face", "element nothing 18446744073709551615\nelement face");
    assert!(ground(InputFormat::Ply, text.as_bytes()).is_ok());
}

#[test]
fn damaged_ply_is_refused() {
    let text = ascii_ply();
    for (from, to, words) in [
        ("3 0 1 6", "3 0 1 36", "vertex 36 counted from 0, the file has 36"),
        ("3 0 1 6", "3 0 1 -1", "not a whole number from 0"),
        ("3 0 1 6", "3 0 1 1.5", "not a whole number from 0"),
        ("3 0 1 6", "2 0 1", "fewer than three corners"),
        ("3 0 1 6", "3 0 1 x", "not a number"),
        ("500010 5400000 102", "500010 nan 102", "vertex 2"),
        ("property double z", "property double height", "no property `z`"),
        ("double x", "real x", "unknown type"),
        ("end_header", "end", "line 9"),
        ("format ascii", "format text", "unknown format"),
        ("element vertex 36", "element vertex many", "not a whole number"),
        ("element face 50", "element face 49", "goes on after its last element"),
        ("element face 50", "element face 51", "face 51"),
        ("vertex_indices", "corners", "no list `vertex_indices`"),
        ("element face 50", "element tristrips 50", "triangle strips"),
    ] {
        assert!(text.contains(from), "{from}");
        let error = ground(InputFormat::Ply, text.replacen(from, to, 1).as_bytes()).unwrap_err();
        assert!(error.contains(words), "{from} → {to}\n{error}");
    }
    // Cut off anywhere, and with any byte of the header changed: an error, or the same ground; never a panic.
    let bytes = ply(true, true, 1, 4);
    for end in (0..bytes.len()).step_by(7) {
        assert!(ground(InputFormat::Ply, &bytes[..end]).is_err(), "{end}");
    }
    for at in 0..bytes.len() {
        let mut changed = bytes.clone();
        changed[at] ^= 0x15;
        let _ = ground(InputFormat::Ply, &changed);
    }
}

/// Every byte of small files changed in two ways, and the files cut off anywhere: an error or some ground, never a panic.
#[test]
fn damaged_text_never_panics() {
    let (given, faces) = (vertices(), triangles());
    let quads = "v 0 0 1\nv 9 0 2\nv 9 9 3\nv 0 9 4\nv 4 1 5\nvt 0 0\ng a\nf 1/1 2/1 3/1 4/1 5/-1\nf -5 -4 -1 # c\n".to_owned();
    let points = "x,y,z\n0,0,1\n9,0,2\n9,9,3\n0,9,4\n".to_owned();
    for (format, text) in [
        (InputFormat::Obj, obj(&given[..14], &faces[..6])),
        (InputFormat::Obj, quads),
        (InputFormat::Ply, ascii_ply().chars().take(600).collect()),
        (InputFormat::Asc, asc()),
        (InputFormat::Csv, points),
    ] {
        for at in 0..text.len() {
            let _ = ground(format, &text.as_bytes()[..at]);
            for flip in [0x01, 0x0F, 0x1B, 0x60] {
                let mut bytes = text.clone().into_bytes();
                bytes[at] ^= flip;
                let _ = ground(format, &bytes);
            }
        }
    }
}
