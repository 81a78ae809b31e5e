use super::*;
use crate::kernel::frame::Frame;
use crate::model::{CurveKind, LengthUnit, LineFeature, Part};
use crate::write::Earthworks;
use quick_xml::events::Event;

/// Elements as path, attributes and text, by a reader that shares nothing with the writer.
struct Element {
    path: String,
    attributes: Vec<(String, String)>,
    text: String,
}

fn elements(bytes: &[u8]) -> Vec<Element> {
    let mut reader = quick_xml::Reader::from_str(std::str::from_utf8(bytes).unwrap());
    let (mut found, mut open): (Vec<Element>, Vec<usize>) = (Vec::new(), Vec::new());
    loop {
        let event = reader.read_event().unwrap();
        let empty = matches!(event, Event::Empty(_));
        match event {
            Event::Start(start) | Event::Empty(start) => {
                let name = start.name().as_ref().to_owned();
                let parent = open.last().map_or(String::new(), |&i: &usize| format!("{}/", found[i].path));
                let attributes = start.attributes().map(|attribute| {
                    let attribute = attribute.unwrap();
                    let key = attribute.key.as_ref().to_owned();
                    (key, quick_xml::escape::unescape(&attribute.value).unwrap().into_owned())
                });
                found.push(Element { path: parent + &name, attributes: attributes.collect(), text: String::new() });
                if !empty {
                    open.push(found.len() - 1);
                }
            }
            Event::End(_) => drop(open.pop().unwrap()),
            Event::Text(text) => {
                if let Some(&i) = open.last() {
                    found[i].text.push_str(&text);
                }
            }
            Event::Eof => break,
            _ => {}
        }
    }
    assert!(open.is_empty());
    found
}

fn of<'a>(elements: &'a [Element], path: &str) -> Vec<&'a Element> {
    elements.iter().filter(|e| e.path == path).collect()
}

fn get<'a>(element: &'a Element, key: &str) -> &'a str {
    element.attributes.iter().find(|(k, _)| k == key).map_or("", |(_, value)| value)
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace().map(|word| word.parse().unwrap()).collect()
}

/// A square of side 4 with a hole of side 2 in its middle, on the plane z = 0.75 y, far from zero.
fn frame() -> Tin {
    let (outer, inner) = ([[0.0, 0.0], [4.0, 0.0], [4.0, 4.0], [0.0, 4.0]], [[1.0, 1.0], [3.0, 1.0], [3.0, 3.0], [1.0, 3.0]]);
    let frame = Frame::around(glam::DVec2::new(5e5, 5.4e6), glam::DVec2::new(500_004.0, 5_400_004.0));
    let world = |[x, y]: [f64; 2]| DVec3::new(5e5 + x, 5.4e6 + y, 0.75 * y);
    let vertices = outer.into_iter().chain(inner).map(|p| frame.to_local(world(p))).collect();
    let triangles: Vec<[u32; 3]> =
        (0..4).flat_map(|i| [[i, (i + 1) % 4, 4 + (i + 1) % 4], [i, 4 + (i + 1) % 4, 4 + i]]).collect();
    let parts = vec![Part::FillSlope; triangles.len()];
    Tin { frame, vertices, triangles, parts }
}

fn line(kind: CurveKind, chain: Option<&str>, elevation: Option<f64>) -> LineFeature {
    let points =
        vec![DVec3::new(5e5, 5.4e6, 0.1 + 0.2), DVec3::new(500_001.0, 5.4e6, 1.0), DVec3::new(500_001.0, 5_400_001.0, 1.5)];
    LineFeature { kind, points, elevation, chain: chain.map(Into::into), part: None }
}

fn surface(head: &Head<'_>) -> Vec<Element> {
    let mut bytes = Vec::new();
    write_landxml(&mut bytes, &frame(), head).unwrap();
    elements(&bytes)
}

#[test]
fn the_surface_with_its_figures() {
    let found = surface(&Head { name: "yard", ..Head::default() });
    let order: Vec<&str> = found.iter().map(|e| e.path.as_str()).filter(|path| path.matches('/').count() == 1).collect();
    assert_eq!(order, ["LandXML/Units", "LandXML/Application", "LandXML/Surfaces"]);
    assert_eq!(get(&found[0], "xmlns"), "http://www.landxml.org/schema/LandXML-1.2");
    assert_eq!(get(of(&found, "LandXML/Units/Metric")[0], "linearUnit"), "meter");
    assert_eq!(get(of(&found, "LandXML/Surfaces/Surface")[0], "name"), "yard");
    let definition = of(&found, "LandXML/Surfaces/Surface/Definition")[0];
    assert_eq!(get(definition, "surfType"), "TIN");
    // 4² − 2² in plan; by the slope of 3 to 4, five quarters of it in space.
    for (key, expected) in [("area2DSurf", 12.0), ("area3DSurf", 15.0), ("elevMin", 0.0), ("elevMax", 3.0)] {
        assert!((get(definition, key).parse::<f64>().unwrap() - expected).abs() < 1e-12, "{key}");
    }
    let points = of(&found, "LandXML/Surfaces/Surface/Definition/Pnts/P");
    let tin = frame();
    for (i, point) in points.iter().enumerate() {
        let p = tin.world(i);
        assert_eq!((get(point, "id"), numbers(&point.text)), ((i + 1).to_string().as_str(), vec![p.y, p.x, p.z]));
    }
    let faces: Vec<Vec<f64>> =
        of(&found, "LandXML/Surfaces/Surface/Definition/Faces/F").iter().map(|f| numbers(&f.text)).collect();
    let expected: Vec<Vec<f64>> = tin.triangles.iter().map(|t| t.iter().map(|&v| f64::from(v) + 1.0).collect()).collect();
    assert_eq!((points.len(), faces), (8, expected));
    assert!(of(&found, "LandXML/Surfaces/SurfVolumes").is_empty());
}

#[test]
fn the_outline_is_outer_and_void() {
    let found = surface(&Head::default());
    let rings = of(&found, "LandXML/Surfaces/Surface/SourceData/Boundaries/Boundary");
    let lists = of(&found, "LandXML/Surfaces/Surface/SourceData/Boundaries/Boundary/PntList3D");
    let kinds: Vec<&str> = rings.iter().map(|ring| get(ring, "bndType")).collect();
    assert_eq!(kinds, ["outer", "void"]);
    for (list, side) in lists.iter().zip([4.0, 2.0]) {
        let points: Vec<Vec<f64>> = numbers(&list.text).chunks_exact(3).map(<[f64]>::to_vec).collect();
        assert_eq!((points.len(), &points[0]), (5, &points[4]));
        let length: f64 = points.windows(2).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
        assert!((length - 4.0 * side).abs() < 1e-9);
    }
}

#[test]
fn breaklines_have_kind_and_number() {
    let lines = [
        line(CurveKind::Daylight, None, None),
        line(CurveKind::Hinge, Some("a & <b> \"c\"\u{7}"), None),
        line(CurveKind::Hinge, Some("d"), None),
        line(CurveKind::Ridge, None, None),
        line(CurveKind::LevelCurve, None, Some(401.5)),
        line(CurveKind::Zero, None, None),
        line(CurveKind::Boundary, None, None),
    ];
    let found = surface(&Head { lines: &lines, ..Head::default() });
    let breaklines = of(&found, "LandXML/Surfaces/Surface/SourceData/Breaklines/Breakline");
    let names: Vec<[&str; 3]> = breaklines.iter().map(|b| ["brkType", "name", "desc"].map(|key| get(b, key))).collect();
    let expected = [
        ["standard", "ridge 1", ""],
        ["standard", "hinge 1", "a & <b> \"c\" "],
        ["standard", "hinge 2", "d"],
        ["standard", "daylight 1", ""],
    ];
    assert_eq!(names, expected);
    let list = of(&found, "LandXML/Surfaces/Surface/SourceData/Breaklines/Breakline/PntList3D")[0];
    assert_eq!(list.text, "5400000 500000 0.30000000000000004 5400000 500001 1 5400001 500001 1.5");

    let mut bytes = Vec::new();
    write_landxml_lines(&mut bytes, &Head { lines: &lines, name: "yard", ..Head::default() }).unwrap();
    let found = elements(&bytes);
    let features = of(&found, "LandXML/PlanFeatures/PlanFeature");
    let names: Vec<[&str; 2]> = features.iter().map(|f| ["name", "desc"].map(|key| get(f, key))).collect();
    assert_eq!((names.len(), names[0], names[2]), (7, ["level_curve 1", "401.5"], ["hinge 1", "a & <b> \"c\" "]));
    let ends = ["Start", "End"].map(|end| {
        let path = format!("LandXML/PlanFeatures/PlanFeature/CoordGeom/Line/{end}");
        of(&found, &path).iter().take(2).map(|e| e.text.clone()).collect::<Vec<_>>()
    });
    let [a, b, c] = ["5400000 500000 0.30000000000000004", "5400000 500001 1", "5400001 500001 1.5"];
    assert_eq!(ends, [[a, b], [b, c]]);
}

#[test]
fn volumes_are_those_of_the_run() {
    let earthworks = Some(Earthworks { ground: "hill", cut: 12.5, fill: 20.25 });
    let found = surface(&Head { name: "yard", earthworks, unit: LengthUnit::UsSurveyFoot, ..Head::default() });
    let units = of(&found, "LandXML/Units/Imperial")[0];
    assert_eq!((get(units, "linearUnit"), get(units, "volumeUnit")), ("USSurveyFoot", "cubicFeet"));
    assert_eq!(get(of(&found, "LandXML/Surfaces/SurfVolumes")[0], "surfVolCalcMethod"), "composite");
    let volume = of(&found, "LandXML/Surfaces/SurfVolumes/SurfVolume")[0];
    let found = ["surfBase", "surfCompare", "volCut", "volFill", "volTotal"].map(|key| get(volume, key));
    assert_eq!(found, ["hill", "yard", "12.5", "20.25", "-7.75"]);
}

#[test]
fn reference_systems_go_where_they_belong() {
    let wkt = "PROJCS[\"a\",\nGEOGCS[\"b\"]]";
    for (crs, key, expected) in [
        ("urn:ogc:def:crs:EPSG::25832", "epsgCode", "25832"),
        (wkt, "ogcWktCode", "PROJCS[\"a\", GEOGCS[\"b\"]]"),
        ("site <grid>", "name", "site <grid>"),
    ] {
        let found = surface(&Head { crs: Some(crs), ..Head::default() });
        let system = of(&found, "LandXML/CoordinateSystem")[0];
        assert_eq!(system.attributes, [(key.to_owned(), expected.to_owned())]);
    }
}

#[test]
fn numbers_that_are_none_are_refused() {
    let mut tin = frame();
    tin.vertices[7].z = f64::INFINITY;
    let error = write_landxml(&mut Vec::new(), &tin, &Head::default()).unwrap_err();
    assert!(matches!(error, EncodeError::NotFinite { what: "vertex", index: 8, .. }), "{error}");
    let mut bad = [line(CurveKind::Valley, None, None)];
    bad[0].points[1].y = f64::NAN;
    let error = write_landxml_lines(&mut Vec::new(), &Head { lines: &bad, ..Head::default() }).unwrap_err();
    assert!(matches!(error, EncodeError::NotFinite { what: "line feature", index: 1, .. }), "{error}");
}
