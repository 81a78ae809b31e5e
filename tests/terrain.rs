//! Existing ground from outside: every format, every defect.

use slopegen::model::Terrain;
use slopegen::read::InputFormat;
use slopegen::read::terrain::parse_terrain;
use slopegen::terrain::prepare;

/// Reads and prepares; the notes as `code: message`.
fn ground(format: InputFormat, bytes: &[u8]) -> Result<(Terrain, Vec<String>), String> {
    let order = "xyz".parse().unwrap();
    let raw = parse_terrain("a", bytes, format, Some(&order)).map_err(|e| e.to_string())?;
    let prepared = prepare(raw).map_err(|e| e.to_string())?;
    let notes = prepared.notes.iter().map(|note| format!("{}: {}", note.code, note.message)).collect();
    Ok((prepared.terrain, notes))
}

/// Plan area and volume above zero.
fn measure(terrain: &Terrain) -> (f64, f64) {
    (0..terrain.triangles.len()).fold((0.0, 0.0), |(area, volume), t| {
        let [a, b, c] = terrain.corners(t);
        let plan = 0.5 * (b - a).truncate().perp_dot((c - a).truncate());
        assert!(plan > 0.0);
        (area + plan, volume + plan * (a.z + b.z + c.z) / 3.0)
    })
}

const OBJ: &str = "v 1000 2000 1\nv 1010 2000 2\nv 1010 2010 4\nv 1000 2010 3\nf 1 2 3\nf 1 3 4\n";

#[test]
fn a_square_as_obj() {
    let (terrain, notes) = ground(InputFormat::Obj, OBJ.as_bytes()).unwrap();
    assert_eq!((terrain.triangles.clone(), notes), (vec![[0, 1, 2], [0, 2, 3]], vec![]));
    // 100 × mean of (1 + 2 + 4) / 3 and (1 + 4 + 3) / 3.
    let (area, volume) = measure(&terrain);
    assert!((area - 100.0).abs() < 1e-9 && (volume - 250.0).abs() < 1e-9);
}
