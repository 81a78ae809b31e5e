//! Formats of meshes and line work: all hold the same, in their own digits.

use super::Site;
use serde_json::Value;
use slopegen::model::LengthUnit;
use slopegen::read::terrain::{RawFaces, RawGround, RawTerrain, TerrainOptions, parse_terrain};
use slopegen::read::{InputFormat, Pick, ReadOptions, parse_line};
use std::fs;
use std::path::Path;

/// What viewers that read single precision may be off by.
const MILLIMETRE: f64 = 0.001;

const ROAD: &str = "build hill_road.geojson --width 7 --terrain ground.obj --cut-slope 1:1 --fill-slope 1:1.5 --quiet";

/// The road on the hillside, far from zero.
fn site() -> Site {
    let site = Site::new();
    for name in ["hill_road.geojson", "ground.obj"] {
        fs::copy(Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name), site.path(name)).unwrap();
    }
    site
}

/// A drawing of the works is checked like any mesh; its layers are the groups a slope is asked of.
#[test]
fn check_takes_drawings() {
    let site = site();
    site.run(&format!("{ROAD} -o road.dxf -o road.obj --finished all.dxf")).done();
    for slopes in ["--slope 1:1 --part cut_slope", "--slope 1:1.5 --part fill_slope"] {
        site.run(&format!("check all.dxf {slopes} --report check.json --quiet")).done();
        let report: Value = serde_json::from_str(&site.read("check.json")).unwrap();
        assert_eq!(report["inputs"][0]["format"], "dxf");
    }
    // The same figures as for the mesh, but for what the order of vertices decides.
    let looked = |arguments: &str| -> Value {
        site.run(&format!("check {arguments} --report check.json --quiet")).done();
        serde_json::from_str(&site.read("check.json")).unwrap()
    };
    let (drawing, mesh) = (looked("road.dxf"), looked("road.obj"));
    for key in ["faces", "triangles", "pieces"] {
        assert_eq!(drawing["mesh"][key], mesh["mesh"][key], "{key}");
    }
    let names = |report: &Value| -> Vec<String> {
        let mut names: Vec<_> = report["parts"].as_array().unwrap().iter().map(|part| part["name"].to_string()).collect();
        names.sort();
        names
    };
    assert_eq!(names(&drawing), names(&mesh));
    let one = looked("road.dxf --layer cut_slope");
    assert_eq!(one["parts"].as_array().unwrap().len(), 1);
    let run = site.run("check all.dxf --slope 1:1");
    assert_eq!(run.code, 5, "fill slopes are flatter: {}", run.stderr);
}

type Triangles = Vec<[[f64; 3]; 3]>;

/// Corners of the triangles as the library's own reader finds them.
fn read(site: &Site, name: &str, format: InputFormat) -> (RawTerrain, Triangles) {
    let bytes = fs::read(site.path(name)).unwrap();
    let raw = parse_terrain(name, &bytes, &TerrainOptions::of(format)).unwrap();
    let RawGround::Mesh { vertices, faces: RawFaces::Triangles(faces) } = &raw.ground else { panic!("{name}") };
    let triangles = faces.iter().map(|t| t.map(|v| vertices[v as usize].to_array())).collect();
    (raw, triangles)
}

/// Corners of the triangles of an OBJ file as they stand there.
fn obj(site: &Site, name: &str) -> Triangles {
    let text = site.read(name);
    let rows = |first: &'static str| {
        let rows = text.lines().filter_map(move |line| line.strip_prefix(first));
        rows.map(|row| row.split(' ').map(|word| word.parse::<f64>().unwrap()).collect::<Vec<_>>())
    };
    let vertices: Vec<[f64; 3]> = rows("v ").map(|v| v.try_into().unwrap()).collect();
    rows("f ").map(|f| [0, 1, 2].map(|k| vertices[f[k] as usize - 1])).collect()
}

/// Corners of the triangles of a LandXML file, its rows one element each.
fn landxml(site: &Site, name: &str) -> Triangles {
    let text = site.read(name);
    let rows = |tag: &'static str, end: &'static str| {
        let rows = text.lines().filter(move |line| line.starts_with(tag)).map(move |line| {
            let inner = line.split_once('>').unwrap().1.strip_suffix(end).unwrap();
            inner.split(' ').map(|word| word.parse::<f64>().unwrap()).collect::<Vec<_>>()
        });
        rows.collect::<Vec<_>>()
    };
    let points = rows("<P id=", "</P>");
    // Northing first.
    let point = |id: f64| [1, 0, 2].map(|k| points[id as usize - 1][k]);
    rows("<F>", "</F>").iter().map(|f| [0, 1, 2].map(|k| point(f[k]))).collect()
}

/// Corners of the 3DFACEs of a drawing, and the layers of its polylines.
fn dxf(site: &Site, name: &str) -> (Triangles, Vec<String>) {
    let text = site.read(name);
    let lines: Vec<&str> = text.lines().collect();
    let groups: Vec<(u32, &str)> = lines.chunks_exact(2).map(|pair| (pair[0].parse().unwrap(), pair[1])).collect();
    let (mut triangles, mut layers) = (Vec::new(), Vec::new());
    for entity in groups.chunk_by(|_, next| next.0 != 0) {
        let find = |code: u32| entity.iter().find(|group| group.0 == code).map(|group| group.1).unwrap();
        match entity[0].1 {
            "3DFACE" => {
                let corner = |k: u32| [10, 20, 30].map(|axis| find(axis + k).parse::<f64>().unwrap());
                assert_eq!(corner(2), corner(3));
                triangles.push([0, 1, 2].map(corner));
            }
            "POLYLINE" => layers.push(find(8).to_owned()),
            _ => {}
        }
    }
    layers.sort();
    layers.dedup();
    (triangles, layers)
}

fn single(bytes: &[u8], at: usize) -> f64 {
    f64::from(f32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()))
}

/// Corners of the triangles of a binary STL file.
fn stl(site: &Site, name: &str) -> Triangles {
    let bytes = fs::read(site.path(name)).unwrap();
    bytes[84..].chunks_exact(50).map(|t| [0, 1, 2].map(|c| [0, 1, 2].map(|k| single(t, 12 + 12 * c + 4 * k)))).collect()
}

/// Corners of the triangles of a GLB file, turned to z up, and its JSON part.
fn glb(site: &Site, name: &str) -> (Triangles, Value) {
    let bytes = fs::read(site.path(name)).unwrap();
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let json: Value = serde_json::from_slice(&bytes[20..20 + length]).unwrap();
    let binary = &bytes[28 + length..];
    let number = |value: &Value| value.as_u64().unwrap_or(0) as usize;
    let view = |accessor: &Value| number(&json["bufferViews"][number(&accessor["bufferView"])]["byteOffset"]);
    let mut triangles = Vec::new();
    for primitive in json["meshes"][0]["primitives"].as_array().unwrap() {
        let accessor = |key: &Value| &json["accessors"][number(key)];
        let (positions, indices) = (view(accessor(&primitive["attributes"]["POSITION"])), accessor(&primitive["indices"]));
        let begin = view(indices) + number(&indices["byteOffset"]);
        let corners = binary[begin..begin + 4 * number(&indices["count"])].chunks_exact(4).map(|index| {
            let at = positions + 12 * u32::from_le_bytes(index.try_into().unwrap()) as usize;
            [single(binary, at), -single(binary, at + 8), single(binary, at + 4)]
        });
        triangles.extend(corners.collect::<Vec<_>>().as_chunks::<3>().0.iter().copied());
    }
    (triangles, json)
}

/// The origin of a sidecar.
fn origin(site: &Site, name: &str) -> [f64; 3] {
    let json: Value = serde_json::from_str(&site.read(name)).unwrap();
    [0, 1, 2].map(|k| json["origin"][k].as_f64().unwrap())
}

fn shifted(triangles: &Triangles, by: [f64; 3]) -> Triangles {
    triangles.iter().map(|t| t.map(|p| [0, 1, 2].map(|k| p[k] + by[k]))).collect()
}

/// Same triangles in the same order, each coordinate within `most`.
#[track_caller]
fn alike(found: &Triangles, expected: &Triangles, most: f64) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.as_flattened().as_flattened().iter().zip(expected.as_flattened().as_flattened()) {
        assert!((found - expected).abs() <= most, "{found} {expected}");
    }
}

/// Triangles by part, as OBJ and GLB have them; the part is that of the PLY file.
fn by_part(site: &Site, ply: &str, triangles: &Triangles) -> Triangles {
    let bytes = fs::read(site.path(ply)).unwrap();
    let records = &bytes[bytes.len() - 14 * triangles.len()..];
    let mut order: Vec<usize> = (0..triangles.len()).collect();
    order.sort_by_key(|&i| records[14 * i + 13]);
    order.into_iter().map(|i| triangles[i]).collect()
}

#[test]
fn every_format_holds_the_same_mesh() {
    let site = site();
    let files = |stem: &str, option: &str| {
        ["obj", "ply", "xml", "dxf", "stl", "glb"].map(|ending| format!(" {option} {stem}.{ending}")).concat()
    };
    site.run(&format!("{ROAD}{}{}", files("w", "-o"), files("f", "--finished"))).done();
    for stem in ["w", "f"] {
        let name = |ending: &str| format!("{stem}.{ending}");
        let (_, expected) = read(&site, &name("ply"), InputFormat::Ply);
        let in_parts = by_part(&site, &name("ply"), &expected);
        assert!(expected.len() > 1000 && in_parts != expected);
        assert_eq!(obj(&site, &name("obj")), in_parts);
        assert_eq!(landxml(&site, &name("xml")), expected);
        let (faces, layers) = dxf(&site, &name("dxf"));
        assert_eq!(faces, expected);
        assert_eq!(layers, ["BREAKLINE", "DAYLIGHT", "HINGE", "LEVEL_CURVE", "RIDGE", "VALLEY", "ZERO"]);
        let from = origin(&site, &name("stl.origin.json"));
        assert_eq!(from, [641_000.0, 5_203_000.0, 0.0]);
        assert_eq!(from, origin(&site, &name("glb.origin.json")));
        alike(&shifted(&stl(&site, &name("stl")), from), &expected, MILLIMETRE);
        let (triangles, json) = glb(&site, &name("glb"));
        alike(&shifted(&triangles, from), &in_parts, MILLIMETRE);
        assert_eq!(json["asset"]["extras"]["origin"], serde_json::json!(from));
    }
    colours(&site);
}

/// The works are white where they meet the ground, and as deep in colour as they are in cut and fill.
fn colours(site: &Site) {
    let report = site.run(&format!("{ROAD} --report -")).done().to_owned();
    let deepest = |what: &str| -> f64 {
        let line = report.lines().find(|line| line.trim().starts_with(what)).unwrap_or_else(|| panic!("{what}: {report}"));
        line.split_whitespace().find_map(|word| word.parse().ok()).unwrap()
    };
    let (cut, fill) = (deepest("deepest cut"), deepest("deepest fill"));
    let bytes = fs::read(site.path("w.glb")).unwrap();
    let (_, json) = glb(site, "w.glb");
    let scale = json["nodes"][0]["extras"]["depth_scale"].as_f64().unwrap();
    assert!(scale <= cut.max(fill) + 0.0005 && scale > 0.95 * cut.max(fill), "{scale} {cut} {fill}");
    let count = json["accessors"][1]["count"].as_u64().unwrap() as usize;
    let length = u32::from_le_bytes(bytes[12..16].try_into().unwrap()) as usize;
    let colours: Vec<[u8; 4]> = bytes[28 + length + 12 * count..28 + length + 16 * count].as_chunks().0.to_vec();
    // White, and the ends of the scale, as shares of light.
    assert!(colours.iter().filter(|c| **c == [237, 237, 237, 255]).count() > 100);
    let end = if cut > fill { [114, 2, 6, 255] } else { [4, 34, 105, 255] };
    let redder = |c: &[u8; 4]| i32::from(c[0]) - i32::from(c[2]);
    let (reddest, bluest) = (colours.iter().map(redder).max().unwrap(), colours.iter().map(redder).min().unwrap());
    assert!(colours.contains(&end) && reddest > 90 && bluest < -90, "{reddest} {bluest}");
}

/// The figures of the report stand in the surface file.
#[test]
fn volumes_stand_in_landxml() {
    let site = site();
    site.run(&format!("{ROAD} -o w.xml --finished f.xml --report r.json --lines l.xml")).done();
    let report: Value = serde_json::from_str(&site.read("r.json")).unwrap();
    let figure = |key: &str| report["volumes"][key].as_f64().unwrap();
    for (file, name) in [("w.xml", "hill_road"), ("f.xml", "hill_road finished ground")] {
        let text = site.read(file);
        let volumes = format!(
            "<SurfVolume surfBase=\"ground\" surfCompare=\"{name}\" volCut=\"{}\" volFill=\"{}\" volTotal=\"{}\"",
            figure("cut"),
            figure("fill"),
            figure("net")
        );
        assert!(text.contains(&volumes), "{volumes}");
        assert!(text.contains(&format!("<Surface name=\"{name}\">")));
    }
    let area = report["surface"]["plan_area"].as_f64().unwrap();
    let text = site.read("w.xml");
    let written: f64 = text.split("area2DSurf=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap();
    assert!((written - area).abs() < 1e-9 * area, "{written} {area}");
    assert!(site.read("l.xml").contains("<PlanFeature name=\"daylight 1\""));
    // Without ground there is nothing to compare with.
    site.run("build road.geojson --slope 1:2 -o r.xml --quiet").done();
    assert!(!site.read("r.xml").contains("SurfVolumes"));
}

#[test]
fn local_origins_add_up_to_the_world() {
    let site = site();
    site.run(&format!("{ROAD} -o w.obj -o w.ply -o w.dxf -o w.xml")).done();
    site.run(&format!("{ROAD} --local-origin -o a.obj -o a.ply -o a.dxf -o a.xml")).done();
    site.run(&format!("{ROAD} --local-origin=641234.5,-7,600 -o b.obj")).done();
    let mut files = site.new_files();
    files.retain(|name| name.ends_with(".json"));
    assert_eq!(files, ["a.obj.origin.json", "a.ply.origin.json", "b.obj.origin.json"]);
    assert_eq!((site.read("a.dxf"), site.read("a.xml")), (site.read("w.dxf"), site.read("w.xml")));

    let (world, local) = (obj(&site, "w.obj"), obj(&site, "a.obj"));
    let from = origin(&site, "a.obj.origin.json");
    assert_eq!(shifted(&local, from), world);
    // A viewer of single precision sees a millimetre; of the file in world coordinates it sees half a metre.
    let seen = |triangles: &Triangles| triangles.iter().map(|t| t.map(|p| p.map(|v| f64::from(v as f32)))).collect();
    alike(&shifted(&seen(&local), from), &world, MILLIMETRE);
    let coarse: Triangles = seen(&world);
    let lost = coarse.as_flattened().iter().zip(world.as_flattened()).map(|(a, b)| (a[1] - b[1]).abs());
    assert!(lost.fold(0.0, f64::max) > 0.2);
    assert_eq!(origin(&site, "b.obj.origin.json"), [641_234.5, -7.0, 600.0]);
    alike(&shifted(&obj(&site, "b.obj"), [641_234.5, -7.0, 600.0]), &world, 1e-9);

    // Read as ground they are back in the world, and it is told.
    for (name, format) in [("a.obj", InputFormat::Obj), ("a.ply", InputFormat::Ply)] {
        let (raw, triangles) = read(&site, name, format);
        let (_, expected) = read(&site, &name.replace('a', "w"), format);
        assert_eq!(triangles, expected);
        assert!(raw.notes.iter().any(|note| note.code == "local-origin"));
    }
}

/// Names of reference systems go into every file and break none.
#[test]
fn reference_systems_and_units_are_carried() {
    let site = site();
    let road = site.read("hill_road.geojson");
    let name = "site \\\"grid\\\" <A&B>\\nv 1 2 3\\nend_header \\\\";
    let road = road.replacen('{', &format!("{{\"crs\":{{\"type\":\"name\",\"properties\":{{\"name\":\"{name}\"}}}},"), 1);
    fs::write(site.path("hill_road.geojson"), road).unwrap();
    let files = ["obj", "ply", "xml", "dxf", "stl", "glb"].map(|ending| format!(" -o w.{ending}")).concat();
    let lines = ["geojson", "xml", "dxf"].map(|ending| format!(" --lines l.{ending}")).concat();
    site.run(&format!("{ROAD} --units us-ft{files}{lines}")).done();
    let plain = "site \"grid\" <A&B> v 1 2 3 end_header \\";
    for (file, format, crs) in [
        ("w.obj", InputFormat::Obj, plain.trim_end_matches(" \\")),
        ("w.ply", InputFormat::Ply, &plain.replace("end_header", "end header")),
    ] {
        let (raw, triangles) = read(&site, file, format);
        assert_eq!((raw.source.crs.as_deref(), raw.source.unit.map(|unit| unit.label())), (Some(crs), Some("us-ft")), "{file}");
        assert!(triangles.len() > 1000);
    }
    let escaped = "<CoordinateSystem name=\"site &quot;grid&quot; &lt;A&amp;B&gt; v 1 2 3 end_header \\\"/>";
    for file in ["w.xml", "l.xml"] {
        let text = site.read(file);
        assert!(
            text.contains(escaped) && text.contains("<Imperial areaUnit=\"squareFoot\" linearUnit=\"USSurveyFoot\""),
            "{file}"
        );
    }
    for file in ["w.dxf", "l.dxf"] {
        assert!(site.read(file).contains(&format!("999\ncrs: {plain}\n999\nunit: us-ft\n")), "{file}");
    }
    let told = "site \"grid\" <A&B>\nv 1 2 3\nend_header \\";
    let (_, json) = glb(&site, "w.glb");
    assert_eq!(
        (json["asset"]["extras"]["crs"].as_str(), json["nodes"][0]["extras"]["unit"].as_str()),
        (Some(told), Some("us-ft"))
    );
    assert_eq!(json["nodes"][0]["scale"][0].as_f64(), Some(1200.0 / 3937.0));
    for file in ["w.stl.origin.json", "w.glb.origin.json"] {
        let json: Value = serde_json::from_str(&site.read(file)).unwrap();
        assert_eq!((json["crs"].as_str(), json["unit"].as_str()), (Some(told), Some("us-ft")));
        assert_eq!(format!("{}.origin.json", json["file"].as_str().unwrap()), file);
    }
    let lines: Value = serde_json::from_str(&site.read("l.geojson")).unwrap();
    assert_eq!(lines["crs"]["properties"]["name"].as_str(), Some(told));
}

#[test]
fn origins_that_are_none_are_refused() {
    let site = Site::new();
    for (text, told) in [
        ("1,2", "an origin has three numbers\n  --> --local-origin=1,2\n"),
        ("1,2,x", "--local-origin"),
        ("1,2,1e300", "--local-origin"),
        ("", "an origin has three numbers"),
    ] {
        let run = site.run(&format!("build road.geojson --slope 1:2 --local-origin={text}"));
        assert_eq!(run.code, 2, "{text}: {}", run.stderr);
        assert!(run.stderr.contains(told), "{text}: {}", run.stderr);
    }
    // The file beside a mesh is an output like the others.
    let run = site.run("build road.geojson --slope 1:2 -o a.stl --report a.stl.origin.json");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("two outputs go to the same place"), "{}", run.stderr);
    assert!(site.new_files().is_empty());
}

/// Northings of millions and single precision do not go together; whoever asks for it is told.
#[test]
fn lost_digits_are_told() {
    let site = Site::new();
    let run = site.run("build road.geojson --slope 1:2 -o a.stl --local-origin=0,0,0 --report r.json");
    // From 2²² to 2²³ numbers of 24 bits are 2⁻¹ apart.
    assert!(run.stderr.contains("[single-precision]: coordinates in `a.stl` are off by up to 0.2500"), "{}", run.stderr);
    assert!(site.read("r.json").contains("\"single-precision\""));
    let run = site.run("build road.geojson --slope 1:2 -o b.stl -o c.glb");
    assert!(!run.stderr.contains("single-precision"), "{}", run.stderr);
}

/// What stands beside an STL file does not make it coarser: its origin is its own, and so are the figures of the note.
#[test]
fn meshes_beside_do_not_cost_digits() {
    let site = site();
    // Ground that reaches 100 000 further to the west.
    let far = site.read("ground.obj") + "v 541000 5203000 600\nv 541010 5203000 600\nv 541000 5203010 600\nf -3 -2 -1\n";
    fs::write(site.path("far.obj"), far).unwrap();
    let build = "build hill_road.geojson --width 7 --terrain far.obj --slope 1:1.5 --quiet";
    site.run(&format!("{build} -o a.stl")).done();
    site.run(&format!("{build} -o b.stl --finished f.ply")).done();
    assert_eq!(fs::read(site.path("a.stl")).unwrap(), fs::read(site.path("b.stl")).unwrap());
    // All meshes that are about an origin have one.
    site.run(&format!("{build} -o c.stl --finished f.glb")).done();
    assert_eq!(origin(&site, "c.stl.origin.json"), origin(&site, "f.glb.origin.json"));
    // The note is of the single-precision file, not of the ground that reaches further.
    let build = build.replace(" --quiet", "");
    for outputs in ["-o a.stl", "-o a.stl --finished f.ply"] {
        let run = site.run(&format!("{build} {outputs} --local-origin=641000,5203000,0"));
        run.done();
        assert!(!run.stderr.contains("single-precision"), "{outputs}: {}", run.stderr);
    }
    let run = site.run(&format!("{build} -o a.stl --finished f.stl --local-origin=641000,5203000,0"));
    // From 2¹⁶ to 2¹⁷ numbers of 24 bits are 2⁻⁷ apart.
    assert!(run.stderr.contains("coordinates in `f.stl` are off by up to 0.0039"), "{}", run.stderr);
}

/// What the program writes it reads: the same surfaces and lines, bit for bit, with unit and reference system.
#[test]
fn surfaces_and_drawings_read_back() {
    let site = site();
    let files = |stem: &str, option: &str| ["ply", "xml", "dxf"].map(|ending| format!(" {option} {stem}.{ending}")).concat();
    let lines = files("l", "--lines").replace(".ply", ".geojson");
    site.run(&format!("{ROAD}{}{}{lines}", files("w", "-o"), files("f", "--finished"))).done();
    for stem in ["w", "f"] {
        let (_, expected) = read(&site, &format!("{stem}.ply"), InputFormat::Ply);
        for (ending, format) in [("xml", InputFormat::LandXml), ("dxf", InputFormat::Dxf)] {
            let (raw, triangles) = read(&site, &format!("{stem}.{ending}"), format);
            assert_eq!(triangles, expected, "{stem}.{ending}");
            assert_eq!(raw.source.unit, (format == InputFormat::LandXml).then_some(LengthUnit::Metre));
        }
    }
    let hinge = |name: &str, options: &ReadOptions| -> Vec<[Option<f64>; 3]> {
        let raw = parse_line(name, &fs::read(site.path(name)).unwrap(), options).unwrap();
        assert_eq!(raw.lines.len(), 1, "{name}");
        raw.lines[0].vertices.iter().map(|v| [Some(v.x), Some(v.y), v.z]).collect()
    };
    let json: Value = serde_json::from_str(&site.read("l.geojson")).unwrap();
    let features = json["features"].as_array().unwrap();
    let expected = features.iter().find(|f| f["properties"]["kind"] == "hinge").unwrap();
    let expected: Vec<[Option<f64>; 3]> =
        expected["geometry"]["coordinates"].as_array().unwrap().iter().map(|p| [0, 1, 2].map(|k| p[k].as_f64())).collect();
    assert!(expected.len() > 20);
    let pick = |features: &[&str], layers: &[&str]| Pick {
        features: features.iter().map(ToString::to_string).collect(),
        layers: layers.iter().map(ToString::to_string).collect(),
        ..Pick::default()
    };
    let options = ReadOptions { pick: pick(&["hinge 1"], &[]), ..ReadOptions::of(InputFormat::LandXml) };
    assert_eq!(hinge("l.xml", &options), expected);
    let options = ReadOptions { pick: pick(&[], &["HINGE"]), ..ReadOptions::of(InputFormat::Dxf) };
    assert_eq!(hinge("l.dxf", &options), expected);
}
