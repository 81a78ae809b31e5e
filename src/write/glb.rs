//! glTF 2.0 in one binary file (GLB).
//!
//! Reference: Khronos Group, "glTF 2.0 Specification", version 2.0.1, sections 3.6, 3.7, 3.9 and 4.

use super::obj::{finite_vertex, flush_if_full};
use super::origin::around;
use super::{EncodeError, GENERATOR, Head, palette, single};
use crate::model::{LengthUnit, Part, Tin};
use glam::DVec3;
use serde_json::{Map, Value, json};
use std::io::Write;

// Numbers of the specification.
const MAGIC: u32 = 0x4654_6C67;
const JSON_CHUNK: u32 = 0x4E4F_534A;
const BINARY_CHUNK: u32 = 0x004E_4942;
const SINGLE: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const UNSIGNED_BYTE: u32 = 5121;
const ARRAY_BUFFER: u32 = 34_962;
const ELEMENT_ARRAY_BUFFER: u32 = 34_963;

/// Writes a mesh as GLB: one primitive with a material per part that occurs, all on the same vertices. Where [`Head::depths`]
/// are known, vertices of the works have colours by them (`COLOR_0`), and the ground its own.
///
/// Positions are in single precision about [`Head::origin`] or else [`around`] the mesh, with `y` up as the format demands:
/// `x` is the easting, `y` the elevation, `z` the negative northing. Lengths are in the unit of the mesh; the node scales them
/// to the metres of the format. Origin, unit and reference system stand among the `extras` of asset and node. There are no
/// normals, which stands for flat shading (3.7.2.1).
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a vertex with a coordinate that is no number,
/// [`EncodeError::BeyondSingle`] for one too large for the format, [`EncodeError::TooMany`] for files of 4 GiB and more.
pub fn write_glb(out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
    let origin = head.origin.unwrap_or_else(|| around([tin]));
    let depths = head.depths.filter(|depths| depths.len() == tin.vertices.len());
    let counts = Part::ALL.map(|part| tin.parts.iter().filter(|p| **p == part).count());
    let (vertices, triangles) = (tin.vertices.len(), counts.iter().sum::<usize>());
    let binary = vertices * if depths.is_some() { 16 } else { 12 } + triangles * 12;
    let mut json = serde_json::to_vec(&document(tin, head, origin, depths, &counts, binary)?)?;
    json.resize(json.len().next_multiple_of(4), b' ');
    let total = 12 + 8 + json.len() + if triangles == 0 { 0 } else { 8 + binary };
    let Ok(short) = u32::try_from(total) else {
        return Err(EncodeError::TooMany { what: "bytes", count: total, most: u32::MAX as usize });
    };

    let mut bytes = Vec::with_capacity(1 << 17);
    for number in [MAGIC, 2, short, json.len() as u32, JSON_CHUNK] {
        bytes.extend_from_slice(&number.to_le_bytes());
    }
    bytes.append(&mut json);
    if triangles > 0 {
        for number in [binary as u32, BINARY_CHUNK] {
            bytes.extend_from_slice(&number.to_le_bytes());
        }
        for i in 0..vertices {
            bytes.extend_from_slice(&position(tin, i, origin)?.concat());
            flush_if_full(out, &mut bytes)?;
        }
        for colour in depths.iter().flat_map(|depths| colours(depths)) {
            bytes.extend_from_slice(&colour);
            flush_if_full(out, &mut bytes)?;
        }
        for part in Part::ALL {
            for (triangle, _) in tin.triangles.iter().zip(&tin.parts).filter(|(_, p)| **p == part) {
                triangle.iter().for_each(|corner| bytes.extend_from_slice(&corner.to_le_bytes()));
                flush_if_full(out, &mut bytes)?;
            }
        }
    }
    out.write_all(&bytes)?;
    Ok(())
}

/// Vertex `i` as the format wants it.
fn position(tin: &Tin, i: usize, origin: DVec3) -> Result<[[u8; 4]; 3], EncodeError> {
    let [east, north, up] = finite_vertex(tin, i, origin)?;
    Ok([single::bytes(east, i + 1)?, single::bytes(up, i + 1)?, single::bytes(-north, i + 1)?])
}

/// Greatest height over ground or depth below it.
fn deepest(depths: &[f64]) -> f64 {
    depths.iter().filter(|d| d.is_finite()).fold(0.0, |most: f64, d| most.max(d.abs()))
}

/// A colour for each depth: red, green, blue as shares of light, and no transparency.
fn colours(depths: &[f64]) -> impl Iterator<Item = [u8; 4]> {
    let deepest = deepest(depths);
    let light = std::array::from_fn::<u8, 256, _>(|value| (255.0 * palette::linear(value as u8)).round() as u8);
    depths.iter().map(move |&depth| {
        let [red, green, blue] = palette::of_depth(depth, deepest).map(|value| light[usize::from(value)]);
        [red, green, blue, 255]
    })
}

/// The JSON part: one node with one mesh; without triangles a node alone, since an accessor cannot be empty.
fn document(
    tin: &Tin,
    head: &Head<'_>,
    origin: DVec3,
    depths: Option<&[f64]>,
    counts: &[usize; 4],
    binary: usize,
) -> Result<Value, EncodeError> {
    let mut extras = Map::new();
    extras.insert("origin".into(), json!(origin.to_array()));
    extras.insert("unit".into(), head.unit.label().into());
    extras.insert("axes".into(), "x = easting − origin[0], y = elevation − origin[2], z = −(northing − origin[1])".into());
    if let Some(crs) = head.crs {
        extras.insert("crs".into(), crs.into());
    }
    if let Some(depths) = depths {
        extras.insert("colours".into(), "red: cut, blue: fill, white: none; full at the depth_scale".into());
        extras.insert("depth_scale".into(), json!(deepest(depths)));
    }
    let coloured = depths.is_some();
    let mut node = json!({ "name": head.name, "extras": extras });
    if head.unit != LengthUnit::Metre {
        let metres = head.unit.metres();
        node["scale"] = json!([metres, metres, metres]);
    }
    let mut document = json!({
        "asset": { "version": "2.0", "generator": GENERATOR, "extras": extras },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [node],
    });
    if counts.iter().all(|&count| count == 0) {
        return Ok(document);
    }

    let mut low = [f64::INFINITY; 3];
    let mut high = [f64::NEG_INFINITY; 3];
    for i in 0..tin.vertices.len() {
        for (k, value) in position(tin, i, origin)?.map(single::value).into_iter().enumerate() {
            (low[k], high[k]) = (low[k].min(value), high[k].max(value));
        }
    }
    let count = tin.vertices.len();
    let mut views = vec![json!({ "buffer": 0, "byteOffset": 0, "byteLength": 12 * count, "target": ARRAY_BUFFER })];
    let mut accessors =
        vec![json!({ "bufferView": 0, "componentType": SINGLE, "type": "VEC3", "count": count, "min": low, "max": high })];
    let mut begin = 12 * count;
    if coloured {
        views.push(json!({ "buffer": 0, "byteOffset": begin, "byteLength": 4 * count, "target": ARRAY_BUFFER }));
        accessors.push(json!({
            "bufferView": 1, "componentType": UNSIGNED_BYTE, "normalized": true, "type": "VEC4", "count": count
        }));
        begin += 4 * count;
    }
    views.push(json!({
        "buffer": 0, "byteOffset": begin, "byteLength": binary - begin, "target": ELEMENT_ARRAY_BUFFER
    }));
    let (mut primitives, mut materials, mut offset) = (Vec::new(), Vec::new(), 0);
    for (part, &triangles) in Part::ALL.into_iter().zip(counts).filter(|(_, count)| **count > 0) {
        let by_depth = coloured && part != Part::Ground;
        let mut attributes = json!({ "POSITION": 0 });
        if by_depth {
            attributes["COLOR_0"] = json!(1);
        }
        primitives.push(json!({ "attributes": attributes, "indices": accessors.len(), "material": materials.len() }));
        accessors.push(json!({
            "bufferView": views.len() - 1, "byteOffset": offset, "componentType": UNSIGNED_INT, "type": "SCALAR",
            "count": 3 * triangles
        }));
        materials.push(material(part, by_depth));
        offset += 12 * triangles;
    }
    document["nodes"][0]["mesh"] = json!(0);
    document["buffers"] = json!([{ "byteLength": binary }]);
    document["bufferViews"] = views.into();
    document["accessors"] = accessors.into();
    document["materials"] = materials.into();
    document["meshes"] = json!([{ "name": head.name, "primitives": primitives }]);
    Ok(document)
}

/// A matt material, seen from both sides; white where the vertices have colours, because they are multiplied.
fn material(part: Part, white: bool) -> Value {
    // More digits than screens can show, fewer than mathematical libraries differ in.
    let four_digits = |share: f64| (share * 1e4).round() / 1e4;
    let [red, green, blue] =
        if white { [1.0; 3] } else { palette::of_part(part).map(|value| four_digits(palette::linear(value))) };
    json!({
        "name": part.name(),
        "doubleSided": true,
        "pbrMetallicRoughness": { "baseColorFactor": [red, green, blue, 1.0], "metallicFactor": 0.0, "roughnessFactor": 1.0 },
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;

    fn tin() -> Tin {
        let points = [[5e5, 5.4e6, 400.0], [500_010.0, 5.4e6, 401.5], [500_010.0, 5_400_020.0, 402.0], [5e5, 5_400_020.0, 400.0]];
        Tin {
            frame: Frame::WORLD,
            vertices: points.map(DVec3::from).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            parts: vec![Part::FillSlope, Part::Ground],
        }
    }

    /// The JSON part and the binary part.
    fn split(bytes: &[u8]) -> (Value, &[u8]) {
        let number = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!((&bytes[..4], number(4), number(8), &bytes[16..20]), (&b"glTF"[..], 2, bytes.len(), &b"JSON"[..]));
        let json = number(12);
        let rest = &bytes[20 + json..];
        if !rest.is_empty() {
            assert_eq!((number(20 + json), &rest[4..8]), (rest.len() - 8, &b"BIN\0"[..]));
        }
        assert!(json.is_multiple_of(4) && rest.len().is_multiple_of(4));
        (serde_json::from_slice(&bytes[20..20 + json]).unwrap(), rest.get(8..).unwrap_or_default())
    }

    fn written(tin: &Tin, head: &Head<'_>) -> Vec<u8> {
        let mut bytes = Vec::new();
        write_glb(&mut bytes, tin, head).unwrap();
        bytes
    }

    #[test]
    fn positions_have_y_up_and_are_about_the_origin() {
        let head = Head { crs: Some("EPSG:25832"), name: "a \"b\"", ..Head::default() };
        let bytes = written(&tin(), &head);
        let (json, binary) = split(&bytes);
        let singles: Vec<f64> = binary[..48].chunks_exact(4).map(|b| single::value(b.try_into().unwrap())).collect();
        assert_eq!(singles, [0.0, 400.0, 0.0, 10.0, 401.5, 0.0, 10.0, 402.0, -20.0, 0.0, 400.0, -20.0]);
        assert_eq!(json["accessors"][0]["min"], json!([0.0, 400.0, -20.0]));
        assert_eq!(json["accessors"][0]["max"], json!([10.0, 402.0, 0.0]));
        for extras in [&json["asset"]["extras"], &json["nodes"][0]["extras"]] {
            assert_eq!(extras["origin"], json!([5e5, 5.4e6, 0.0]));
            assert_eq!((extras["crs"].as_str(), extras["unit"].as_str()), (Some("EPSG:25832"), Some("m")));
        }
        assert_eq!((json["nodes"][0]["name"].as_str(), json["nodes"][0]["mesh"].as_u64()), (Some("a \"b\""), Some(0)));
        let indices: Vec<u32> = binary[48..].chunks_exact(4).map(|b| u32::from_le_bytes(b.try_into().unwrap())).collect();
        assert_eq!(indices, [0, 1, 2, 0, 2, 3]);
        let names: Vec<&str> = json["materials"].as_array().unwrap().iter().map(|m| m["name"].as_str().unwrap()).collect();
        assert_eq!(names, ["fill_slope", "ground"]);
        assert_eq!(json["accessors"][2]["byteOffset"], 12);
    }

    #[test]
    fn feet_are_scaled_by_the_node() {
        let bytes = written(&tin(), &Head { unit: LengthUnit::Foot, ..Head::default() });
        let (json, _) = split(&bytes);
        assert_eq!(json["nodes"][0]["scale"], json!([0.3048, 0.3048, 0.3048]));
    }

    #[test]
    fn depths_colour_the_works_and_not_the_ground() {
        let depths = [-3.0, 0.0, 3.0, f64::NAN];
        let bytes = written(&tin(), &Head { depths: Some(&depths), ..Head::default() });
        let (json, binary) = split(&bytes);
        let primitives = json["meshes"][0]["primitives"].as_array().unwrap();
        assert_eq!(primitives[0]["attributes"]["COLOR_0"], 1);
        assert!(primitives[1]["attributes"].get("COLOR_0").is_none());
        assert_eq!(json["nodes"][0]["extras"]["depth_scale"], 3.0);
        // sRGB (178, 24, 43), (247, 247, 247), (33, 102, 172), (158, 158, 158) as shares of light times 255.
        let expected = [[114, 2, 6, 255], [237, 237, 237, 255], [4, 34, 105, 255], [87, 87, 87, 255]];
        assert_eq!(binary[48..64], expected.concat());
        // Depths that do not belong to the mesh are passed over.
        let bytes = written(&tin(), &Head { depths: Some(&depths[1..]), ..Head::default() });
        let (json, _) = split(&bytes);
        assert_eq!(json["bufferViews"].as_array().unwrap().len(), 2);
    }

    #[test]
    fn nothing_to_write_is_still_a_scene() {
        let mut tin = tin();
        (tin.triangles, tin.parts) = (Vec::new(), Vec::new());
        let bytes = written(&tin, &Head::default());
        let (json, binary) = split(&bytes);
        assert!(binary.is_empty() && json.get("meshes").is_none());
        assert_eq!(json["asset"]["version"], "2.0");
    }

    #[test]
    fn numbers_the_format_cannot_hold_are_refused() {
        let mut tin = tin();
        tin.vertices[2].z = -1e39;
        let error = write_glb(&mut Vec::new(), &tin, &Head::default()).unwrap_err();
        assert!(matches!(error, EncodeError::BeyondSingle { index: 3, .. }), "{error}");
    }
}
