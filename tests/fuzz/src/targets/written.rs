//! What is written reads as the same.

use glam::DVec3;
use slopegen::model::{CurveKind, LineFeature, Part, Terrain, Tin};
use slopegen::read::terrain::{RawFaces, RawGround, TerrainOptions, parse_terrain};
use slopegen::read::{InputFormat, ReadOptions, parse_line};
use slopegen::validate::Checked;
use slopegen::write::{Head, LineFormat, MeshFormat};

/// Larger things take too long to be written in every format.
const MOST: usize = 2000;

/// Writes the chains as line work and reads them again: the same coordinates, bit for bit.
pub(crate) fn lines_again(checked: &Checked) {
    let chains = &checked.line.chains;
    if checked.line.vertex_count() > MOST {
        return;
    }
    let features: Vec<LineFeature> = chains
        .iter()
        .map(|chain| {
            let mut points = chain.vertices.clone();
            points.extend(chain.closed().then(|| chain.vertices[0]));
            LineFeature { kind: CurveKind::Hinge, points, elevation: None, chain: Some(chain.name.clone()), part: None }
        })
        .collect();
    // In drawings, lines that meet are joined.
    let all = [
        (LineFormat::GeoJson, InputFormat::GeoJson),
        (LineFormat::LandXml, InputFormat::LandXml),
        (LineFormat::Dxf, InputFormat::Dxf),
    ];
    for (written, format) in &all[..if chains.len() == 1 { 3 } else { 1 }] {
        let mut bytes = Vec::new();
        written.write(&mut bytes, &Head { lines: &features, ..Head::default() }).expect("memory takes everything");
        let raw = parse_line("again", &bytes, &ReadOptions::of(*format)).unwrap_or_else(|e| panic!("{format}: {e}"));
        let read: Vec<Vec<DVec3>> = raw
            .lines
            .iter()
            .map(|line| line.vertices.iter().map(|v| DVec3::new(v.x, v.y, v.z.expect("all have heights"))).collect())
            .collect();
        let given: Vec<&[DVec3]> = features.iter().map(|f| &f.points[..]).collect();
        assert_eq!(read, given, "{format}");
    }
}

/// Writes a ground and reads it again: the same triangles, bit for bit.
pub(crate) fn ground_again(terrain: &Terrain) {
    if terrain.triangles.len() > MOST || terrain.vertices.len() > MOST {
        return;
    }
    let parts = vec![Part::Ground; terrain.triangles.len()];
    let tin = Tin { frame: terrain.frame, vertices: terrain.vertices.clone(), triangles: terrain.triangles.clone(), parts };
    let corners = |vertices: &[DVec3], triangles: &[[u32; 3]]| -> Vec<[DVec3; 3]> {
        triangles.iter().map(|t| t.map(|v| vertices[v as usize])).collect()
    };
    let world: Vec<DVec3> = (0..tin.vertices.len()).map(|i| tin.world(i)).collect();
    let given = corners(&world, &tin.triangles);
    let all = [
        (MeshFormat::Obj, InputFormat::Obj),
        (MeshFormat::Ply, InputFormat::Ply),
        (MeshFormat::LandXml, InputFormat::LandXml),
        (MeshFormat::Dxf, InputFormat::Dxf),
    ];
    for (written, format) in all {
        let mut bytes = Vec::new();
        written.write(&mut bytes, &tin, &Head { name: "ground", ..Head::default() }).expect("memory takes everything");
        let raw = parse_terrain("again", &bytes, &TerrainOptions::of(format)).unwrap_or_else(|e| panic!("{format}: {e}"));
        let RawGround::Mesh { vertices, faces: RawFaces::Triangles(triangles) } = raw.ground else {
            panic!("{format}: triangles were written")
        };
        assert_eq!(corners(&vertices, &triangles), given, "{format}");
    }
}
