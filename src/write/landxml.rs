//! LandXML 1.2.
//!
//! Reference: the schema `LandXML-1.2.xsd`, <http://www.landxml.org/schema/LandXML-1.2/LandXML-1.2.xsd>. Points are northing,
//! easting, elevation.

use super::head::{epsg, finite, is_wkt, plain};
use super::lines::in_order;
use super::number::{push_f64, push_u64};
use super::obj::{finite_vertex, flush_if_full};
use super::{EncodeError, Head};
use crate::kernel::sum::Sum;
use crate::mesh::{check::HalfEdges, polygon, volume::MeshAreas};
use crate::model::{CurveKind, LengthUnit, LineFeature, Tin};
use glam::DVec3;
use std::io::Write;

const NAMESPACE: &str = "http://www.landxml.org/schema/LandXML-1.2";

/// Everything before the units. The schema demands a date and a time; that of the run would make the same input give other
/// bytes.
const ROOT: &str = "xmlns:xsi=\"http://www.w3.org/2001/XMLSchema-instance\" version=\"1.2\" date=\"1970-01-01\" \
                    time=\"00:00:00\" language=\"English\" readOnly=\"false\"";

/// Writes a mesh as a TIN surface in world coordinates, with the shortest digits that read back to the same bits, vertices
/// numbered from 1. As its source data the edges of the mesh that mean something (hinge, breaklines, ridges, valleys, daylight
/// line) as standard breaklines, and its outline: counter-clockwise loops as outer boundaries, the others as voids. Where
/// [`Head::earthworks`] are known also the volumes against the ground, of the method `composite`; their total is cut − fill.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a vertex or a line with a coordinate that is no number.
pub fn write_landxml(out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
    let mut bytes = start(head);
    bytes.extend_from_slice(b"<Surfaces>\n<Surface name=\"");
    push_escaped(&mut bytes, head.name);
    bytes.extend_from_slice(b"\">\n<SourceData>\n");
    boundaries(out, &mut bytes, tin)?;
    breaklines(out, &mut bytes, head)?;
    bytes.extend_from_slice(b"</SourceData>\n");
    definition(out, &mut bytes, tin)?;
    bytes.extend_from_slice(b"</Surface>\n");
    if let Some(earthworks) = head.earthworks {
        bytes.extend_from_slice(b"<SurfVolumes surfVolCalcMethod=\"composite\">\n<SurfVolume surfBase=\"");
        push_escaped(&mut bytes, earthworks.ground);
        bytes.extend_from_slice(b"\" surfCompare=\"");
        push_escaped(&mut bytes, head.name);
        let (cut, fill) = (finite(earthworks.cut, "volume", 1)?, finite(earthworks.fill, "volume", 2)?);
        for (key, value) in [("volCut", cut), ("volFill", fill), ("volTotal", cut - fill)] {
            bytes.extend_from_slice(format!("\" {key}=\"").as_bytes());
            push_f64(&mut bytes, value);
        }
        bytes.extend_from_slice(b"\" desc=\"volTotal is volCut - volFill\"/>\n</SurfVolumes>\n");
    }
    bytes.extend_from_slice(b"</Surfaces>\n</LandXML>\n");
    out.write_all(&bytes)?;
    Ok(())
}

/// Writes the line work [`Head::lines`] as plan features: each a chain of straight lines, its kind and number as name.
///
/// # Errors
/// As [`write_landxml`].
pub fn write_landxml_lines(out: &mut (impl Write + ?Sized), head: &Head<'_>) -> Result<(), EncodeError> {
    let mut bytes = start(head);
    bytes.extend_from_slice(b"<PlanFeatures name=\"");
    push_escaped(&mut bytes, head.name);
    bytes.extend_from_slice(b"\">\n");
    for (i, name) in named(head.lines, |_| true) {
        let feature = &head.lines[i];
        bytes.extend_from_slice(b"<PlanFeature name=\"");
        push_escaped(&mut bytes, &name);
        push_desc(&mut bytes, feature, i)?;
        bytes.extend_from_slice(b"\">\n<CoordGeom>\n");
        for ends in feature.points.windows(2) {
            for (before, p, after) in
                [(&b"<Line><Start>"[..], ends[0], &b"</Start>"[..]), (b"<End>", ends[1], b"</End></Line>\n")]
            {
                bytes.extend_from_slice(before);
                push_point(&mut bytes, p, i)?;
                bytes.extend_from_slice(after);
            }
            flush_if_full(out, &mut bytes)?;
        }
        bytes.extend_from_slice(b"</CoordGeom>\n</PlanFeature>\n");
    }
    bytes.extend_from_slice(b"</PlanFeatures>\n</LandXML>\n");
    out.write_all(&bytes)?;
    Ok(())
}

/// The root element opened, units, coordinate system and program.
fn start(head: &Head<'_>) -> Vec<u8> {
    let units = match head.unit {
        LengthUnit::Metre => {
            "<Metric areaUnit=\"squareMeter\" linearUnit=\"meter\" volumeUnit=\"cubicMeter\" temperatureUnit=\"celsius\" \
             pressureUnit=\"milliBars\" angularUnit=\"decimal degrees\" directionUnit=\"decimal degrees\"/>"
        }
        LengthUnit::Foot => {
            "<Imperial areaUnit=\"squareFoot\" linearUnit=\"foot\" volumeUnit=\"cubicFeet\" temperatureUnit=\"fahrenheit\" \
             pressureUnit=\"inchHG\" angularUnit=\"decimal degrees\" directionUnit=\"decimal degrees\"/>"
        }
        LengthUnit::UsSurveyFoot => {
            "<Imperial areaUnit=\"squareFoot\" linearUnit=\"USSurveyFoot\" volumeUnit=\"cubicFeet\" \
             temperatureUnit=\"fahrenheit\" pressureUnit=\"inchHG\" angularUnit=\"decimal degrees\" \
             directionUnit=\"decimal degrees\"/>"
        }
    };
    let mut bytes = format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<LandXML xmlns=\"{NAMESPACE}\" {ROOT} \
         xsi:schemaLocation=\"{NAMESPACE} {NAMESPACE}/LandXML-1.2.xsd\">\n<Units>{units}</Units>\n"
    )
    .into_bytes();
    if let Some(crs) = head.crs {
        bytes.extend_from_slice(b"<CoordinateSystem ");
        let (key, value) = match epsg(crs) {
            Some(code) => ("epsgCode", code),
            None if is_wkt(crs) => ("ogcWktCode", crs),
            None => ("name", crs),
        };
        bytes.extend_from_slice(format!("{key}=\"").as_bytes());
        push_escaped(&mut bytes, value);
        bytes.extend_from_slice(b"\"/>\n");
    }
    let (name, version) = (env!("CARGO_PKG_NAME"), env!("CARGO_PKG_VERSION"));
    bytes.extend_from_slice(format!("<Application name=\"{name}\" version=\"{version}\"/>\n").as_bytes());
    bytes
}

/// The outline of the mesh.
fn boundaries(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>, tin: &Tin) -> Result<(), EncodeError> {
    let open = HalfEdges::new(tin.vertices.len(), &tin.triangles).open();
    let (loops, _) = polygon::loops(&open);
    if loops.is_empty() {
        return Ok(());
    }
    bytes.extend_from_slice(b"<Boundaries>\n");
    for ring in loops {
        let first = tin.vertices[ring[0] as usize].truncate();
        let mut twice = Sum::default();
        for (i, &v) in ring.iter().enumerate() {
            let next = ring[(i + 1) % ring.len()];
            let [a, b] = [v, next].map(|v| tin.vertices[v as usize].truncate() - first);
            twice.add(a.perp_dot(b));
        }
        let kind: &[u8] = if twice.value() > 0.0 { b"outer" } else { b"void" };
        bytes.extend_from_slice(b"<Boundary bndType=\"");
        bytes.extend_from_slice(kind);
        bytes.extend_from_slice(b"\" edgeTrim=\"false\"><PntList3D>");
        for (i, &v) in ring.iter().chain(&ring[..1]).enumerate() {
            if i > 0 {
                bytes.push(b' ');
            }
            push_northing_first(bytes, finite_vertex(tin, v as usize, DVec3::ZERO)?);
            flush_if_full(out, bytes)?;
        }
        bytes.extend_from_slice(b"</PntList3D></Boundary>\n");
    }
    bytes.extend_from_slice(b"</Boundaries>\n");
    Ok(())
}

/// The line work that shapes the surface. Level curves and the zero line lie on it and say nothing new; the boundary has an
/// element of its own.
fn breaklines(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>, head: &Head<'_>) -> Result<(), EncodeError> {
    let shapes = |kind| !matches!(kind, CurveKind::LevelCurve | CurveKind::Zero | CurveKind::Boundary);
    let wanted = named(head.lines, shapes);
    if wanted.is_empty() {
        return Ok(());
    }
    bytes.extend_from_slice(b"<Breaklines>\n");
    for (i, name) in wanted {
        let feature = &head.lines[i];
        bytes.extend_from_slice(b"<Breakline brkType=\"standard\" name=\"");
        push_escaped(bytes, &name);
        push_desc(bytes, feature, i)?;
        bytes.extend_from_slice(b"\"><PntList3D>");
        for (k, p) in feature.points.iter().enumerate() {
            if k > 0 {
                bytes.push(b' ');
            }
            push_point(bytes, *p, i)?;
            flush_if_full(out, bytes)?;
        }
        bytes.extend_from_slice(b"</PntList3D></Breakline>\n");
    }
    bytes.extend_from_slice(b"</Breaklines>\n");
    Ok(())
}

/// Points and faces, with the figures by which a reader can check them.
fn definition(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>, tin: &Tin) -> Result<(), EncodeError> {
    let triangles = || (0..tin.triangles.len()).map(|t| tin.corners(t));
    let areas = MeshAreas::of(triangles());
    let heights = triangles().flatten().map(|p| p.z);
    let (low, high) = heights.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), z| (low.min(z), high.max(z)));
    bytes.extend_from_slice(b"<Definition surfType=\"TIN");
    let figures = [("area2DSurf", areas.plan()), ("area3DSurf", areas.surface()), ("elevMin", low), ("elevMax", high)];
    // Infinite for a mesh without triangles, and for heights whose squares are: then left out.
    for (key, value) in figures.into_iter().filter(|(_, value)| value.is_finite()) {
        bytes.extend_from_slice(format!("\" {key}=\"").as_bytes());
        push_f64(bytes, value);
    }
    bytes.extend_from_slice(b"\">\n<Pnts>\n");
    for i in 0..tin.vertices.len() {
        bytes.extend_from_slice(b"<P id=\"");
        push_u64(bytes, i as u64 + 1);
        bytes.extend_from_slice(b"\">");
        push_northing_first(bytes, finite_vertex(tin, i, DVec3::ZERO)?);
        bytes.extend_from_slice(b"</P>\n");
        flush_if_full(out, bytes)?;
    }
    bytes.extend_from_slice(b"</Pnts>\n<Faces>\n");
    for triangle in &tin.triangles {
        bytes.extend_from_slice(b"<F>");
        for (k, &corner) in triangle.iter().enumerate() {
            if k > 0 {
                bytes.push(b' ');
            }
            push_u64(bytes, u64::from(corner) + 1);
        }
        bytes.extend_from_slice(b"</F>\n");
        flush_if_full(out, bytes)?;
    }
    bytes.extend_from_slice(b"</Faces>\n</Definition>\n");
    Ok(())
}

/// The lines of the kinds wanted, in the order they are written, each with its kind and its number within the kind.
fn named(lines: &[LineFeature], wanted: impl Fn(CurveKind) -> bool) -> Vec<(usize, String)> {
    let order = in_order(lines).into_iter().filter(|&i| wanted(lines[i].kind));
    let mut count = (CurveKind::LevelCurve, 0_usize);
    order
        .map(|i| {
            let kind = lines[i].kind;
            count = if count.0 == kind { (kind, count.1 + 1) } else { (kind, 1) };
            (i, format!("{} {}", kind.name(), count.1))
        })
        .collect()
}

/// Appends `" desc="…` if there is more to say of a line: the chain it comes from, its elevation, the slope that ends there.
fn push_desc(bytes: &mut Vec<u8>, feature: &LineFeature, index: usize) -> Result<(), EncodeError> {
    if let Some(chain) = &feature.chain {
        bytes.extend_from_slice(b"\" desc=\"");
        push_escaped(bytes, chain);
    } else if let Some(elevation) = feature.elevation {
        bytes.extend_from_slice(b"\" desc=\"");
        push_f64(bytes, finite(elevation, "line feature", index + 1)?);
    } else if let Some(part) = feature.part {
        bytes.extend_from_slice(b"\" desc=\"");
        push_escaped(bytes, part.name());
    }
    Ok(())
}

/// Appends a point of the line `index`.
fn push_point(bytes: &mut Vec<u8>, point: DVec3, index: usize) -> Result<(), EncodeError> {
    for value in point.to_array() {
        finite(value, "line feature", index + 1)?;
    }
    push_northing_first(bytes, point.to_array());
    Ok(())
}

fn push_northing_first(bytes: &mut Vec<u8>, [east, north, up]: [f64; 3]) {
    push_f64(bytes, north);
    bytes.push(b' ');
    push_f64(bytes, east);
    bytes.push(b' ');
    push_f64(bytes, up);
}

/// Appends text for an attribute in double quotes.
fn push_escaped(bytes: &mut Vec<u8>, text: &str) {
    for byte in plain(text).bytes() {
        match byte {
            b'&' => bytes.extend_from_slice(b"&amp;"),
            b'<' => bytes.extend_from_slice(b"&lt;"),
            b'>' => bytes.extend_from_slice(b"&gt;"),
            b'"' => bytes.extend_from_slice(b"&quot;"),
            _ => bytes.push(byte),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;
    use crate::model::Part;
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
}
