//! Surfaces as ground: all ways to write the same, units, choice, what is refused.

use super::{codes, file, ground, surface};
use glam::DVec3;
use slopegen::model::LengthUnit;
use slopegen::read::terrain::{RawFaces, RawGround, RawTerrain, TerrainOptions, parse_terrain};
use slopegen::read::{CoordinateKind, InputFormat};
use slopegen::terrain;

/// Northing, easting and elevation of four points.
const POINTS: [[f64; 3]; 4] = [[5000.0, 100.0, 7.5], [5000.0, 140.0, 8.0], [5030.0, 140.0, 9.25], [5030.0, 100.0, 8.5]];

fn points(ids: [&str; 4]) -> String {
    ids.iter().zip(POINTS).map(|(id, [n, e, z])| format!("<P id=\"{id}\">{n} {e} {z}</P>\n")).collect()
}

fn tin(points: &str, faces: &str) -> String {
    format!(
        "<Surfaces><Surface name=\"EG\"><Definition surfType=\"TIN\"><Pnts>\n{points}</Pnts>\n{faces}</Definition></Surface></Surfaces>"
    )
}

fn plain() -> String {
    file(&tin(&points(["1", "2", "3", "4"]), "<Faces><F>1 2 3</F><F>1 3 4</F></Faces>"))
}

fn expected() -> RawGround {
    let vertices = POINTS.iter().map(|&[n, e, z]| DVec3::new(e, n, z)).collect();
    RawGround::Mesh { vertices, faces: RawFaces::Triangles(vec![[0, 1, 2], [0, 2, 3]]) }
}

fn utf16(text: &str, bytes: fn(u16) -> [u8; 2], mark: bool) -> Vec<u8> {
    mark.then_some(0xFEFF).into_iter().chain(text.encode_utf16()).flat_map(bytes).collect()
}

#[test]
fn all_ways_to_write_the_same() {
    let plain = plain();
    let four = points(["1", "2", "3", "4"]);
    let prefixed =
        plain.replace("</", "</lx:").replace("<L", "<lx:L").replace("<U", "<lx:U").replace("<M", "<lx:M").replace("<S", "<lx:S");
    let prefixed = prefixed
        .replace("<D", "<lx:D")
        .replace("<P", "<lx:P")
        .replace("<F", "<lx:F")
        .replace("version=\"1.2\"", "xmlns:lx=\"urn:x\"");
    let texts = [
        plain.clone(),
        prefixed,
        plain.replace("<?xml version=\"1.0\"?>\n", ""),
        format!("\u{feff}<!-- made by hand -->\n{}", &plain["<?xml version=\"1.0\"?>\n".len()..]),
        plain.replace(
            "<LandXML",
            "<!DOCTYPE LandXML SYSTEM \"LandXML.dtd\">\n<LandXML xmlns=\"http://www.inframodel.fi/inframodel\"",
        ),
        plain.replace('\n', "\r\n"),
        plain.replace("</P>\n", "</P>").replace("5000 ", "  5000\n\t"),
        file(&tin(&points(["7", "4000000000", "p &amp; q", "007x"]), "<Faces><F>7 4000000000 p</F></Faces>"))
            .replace("<F>7 4000000000 p</F>", "<F>7 4000000000 rest</F><F>7 rest 007x</F>")
            .replace("p &amp; q", "rest"),
        file(&tin(
            &points(["900000001", "2", "30000000", "4"]),
            "<Faces><F>900000001 2 30000000</F><F>900000001 30000000 4</F></Faces>",
        )),
        // Faces before points, in two lists; neighbours and breakline flags; a face that is not to be seen.
        plain.replace("<Faces><F>1 2 3</F><F>1 3 4</F></Faces>", "").replace(
            "<Pnts>",
            "<Faces><F n=\"0 2 0\" b=\"1\">1 2 3</F><F i=\"1\">1 2 4</F></Faces><Faces><F i=\"0\">1 3 4</F></Faces><Pnts>",
        ),
        plain.replace("1 2 3</F>", "1 <!-- two --><![CDATA[2 ]]>3<?x y?></F>"),
        plain.replace("1 2 3</F>", "1&#32;&#x32; 3<Feature code=\"x\"><Property label=\"9 9 9\"/></Feature></F>"),
        plain.replace("</Surfaces>", "<Surface name=\"empty\"><SourceData/></Surface></Surfaces>"),
        plain.replace("<Surfaces>", "<Somewhere><Else><Surfaces>").replace("</Surfaces>", "</Surfaces></Else></Somewhere>"),
        plain.replace("<F>1 3 4</F>", "<F>1 3 4 4</F>"),
        format!("{plain}\n\n<!-- end -->\n"),
        // Units behind the surface.
        plain
            .replace("<Units><Metric linearUnit=\"meter\"/></Units>\n", "")
            .replace("</LandXML>", "<Units><Metric linearUnit=\"meter\"/></Units></LandXML>"),
        file(&tin(&format!("{four}<P id=\"2\">5000 140 8</P>"), "<Faces><F>1 2 3</F><F>1 3 4</F></Faces>"))
            .replace("<P id=\"2\">5000 140 8</P></P", "</P"),
    ];
    for (i, text) in texts.iter().enumerate() {
        let raw = ground(text).unwrap_or_else(|e| panic!("{i}: {e}\n{text}"));
        match (raw.ground, expected()) {
            // The last one has a fifth point, which is the second once more.
            (RawGround::Mesh { vertices, faces }, RawGround::Mesh { vertices: all, faces: both }) => {
                assert_eq!((&vertices[..4], &faces), (&all[..], &both), "{i}: {text}");
            }
            other => panic!("{i}: {other:?}"),
        }
        assert_eq!(raw.source.unit, Some(LengthUnit::Metre));
    }
}

#[test]
fn encodings() {
    let text = plain().replace("\"EG\"", "\"Gelände €\"");
    let declared = |name: &str| text.replace("version=\"1.0\"?", &format!("version=\"1.0\" encoding=\"{name}\"?"));
    let narrow = |text: &str| text.chars().map(|c| if c == '€' { 0x80 } else { u8::try_from(c).unwrap() }).collect::<Vec<u8>>();
    for (bytes, noted) in [
        (text.clone().into_bytes(), false),
        (narrow(&declared("Windows-1252")), false),
        (narrow(&declared("ISO-8859-1")), false),
        (narrow(&declared("UTF-8")), true),
        (utf16(&declared("UTF-16"), u16::to_le_bytes, true), false),
        (utf16(&declared("UTF-16"), u16::to_be_bytes, true), false),
        (utf16(&text, u16::to_le_bytes, false), false),
        (utf16(&text, u16::to_be_bytes, false), false),
    ] {
        // Letters of bytes that are not as declared are only a guess.
        let name = (!noted).then_some("Gelände €");
        let raw = surface(&bytes, name).unwrap();
        assert_eq!(raw.ground, expected());
        assert_eq!(codes(&raw.notes).contains(&"encoding"), noted);
    }
}

fn with_units(units: &str) -> Result<RawTerrain, String> {
    ground(plain().replace("<Metric linearUnit=\"meter\"/>", units))
}

#[test]
fn units() {
    for (units, unit, plan, height) in [
        ("<Metric linearUnit=\"meter\" areaUnit=\"squareMeter\" elevationUnit=\"meter\"/>", LengthUnit::Metre, 1.0, 1.0),
        ("<Metric linearUnit=\"millimeter\"/>", LengthUnit::Metre, 0.001, 0.001),
        ("<Metric linearUnit=\"centimeter\"></Metric>", LengthUnit::Metre, 0.01, 0.01),
        ("<Metric linearUnit=\"kilometer\" elevationUnit=\"meter\"/>", LengthUnit::Metre, 1000.0, 1.0),
        ("<Imperial linearUnit=\"foot\"/>", LengthUnit::Foot, 1.0, 1.0),
        ("<Imperial linearUnit=\"USSurveyFoot\"/>", LengthUnit::UsSurveyFoot, 1.0, 1.0),
        // The schema knows no other feet for heights.
        ("<Imperial linearUnit=\"USSurveyFoot\" elevationUnit=\"feet\"/>", LengthUnit::UsSurveyFoot, 1.0, 1.0),
        ("<Imperial linearUnit=\"inch\"/>", LengthUnit::Foot, 1.0 / 12.0, 1.0 / 12.0),
        ("<Metric linearUnit=\"meter\" elevationUnit=\"feet\"/>", LengthUnit::Metre, 1.0, 0.3048),
    ] {
        let raw = with_units(units).unwrap();
        assert_eq!(raw.source.unit, Some(unit), "{units}");
        let (RawGround::Mesh { vertices, .. }, RawGround::Mesh { vertices: plain, .. }) = (raw.ground, expected()) else {
            panic!()
        };
        assert_eq!(vertices[2], plain[2] * DVec3::new(plan, plan, height), "{units}");
        assert_eq!(codes(&raw.notes).contains(&"landxml-units"), (plan, height) != (1.0, 1.0), "{units}");
    }
    // Which of the two was changed, and by what.
    for (units, words) in [
        ("<Metric linearUnit=\"kilometer\" elevationUnit=\"meter\"/>", "bring both to metres, the plan was multiplied by 1000"),
        ("<Metric linearUnit=\"millimeter\" elevationUnit=\"meter\"/>", "bring both to metres, the plan was multiplied by 0.001"),
        ("<Metric linearUnit=\"meter\" elevationUnit=\"feet\"/>", "bring both to metres, the heights were multiplied by 0.3048"),
        ("<Metric linearUnit=\"millimeter\" elevationUnit=\"feet\"/>", "the plan was multiplied by 0.001, the heights by 0.3048"),
    ] {
        let raw = with_units(units).unwrap();
        assert!(raw.notes.iter().any(|note| note.message.ends_with(words)), "{units}: {:?}", raw.notes);
    }
    for (units, words) in [
        ("", "does not say its unit"),
        ("<Metric areaUnit=\"squareMeter\"/>", "give `--units m`"),
        ("<Imperial linearUnit=\"mile\"/>", "linearUnit=\"mile\""),
        ("<Metric linearUnit=\"meter\" elevationUnit=\"cubit\"/>", "elevationUnit=\"cubit\""),
    ] {
        let message = with_units(units).unwrap_err();
        assert!(message.contains(words), "{units}: {message}");
    }
    // Said by the caller.
    let text = plain().replace("<Metric linearUnit=\"meter\"/>", "");
    let options = TerrainOptions { unit: Some(LengthUnit::Foot), ..TerrainOptions::of(InputFormat::LandXml) };
    let raw = parse_terrain("a.xml", text.as_bytes(), &options).unwrap();
    assert_eq!((raw.source.unit, raw.ground), (Some(LengthUnit::Foot), expected()));
    assert_eq!(codes(&raw.notes), ["landxml-units"]);
}

#[test]
fn reference_systems() {
    for (system, crs, kind) in [
        ("epsgCode=\"25832\" name=\"ETRS89 / UTM zone 32N\"", Some("EPSG:25832"), CoordinateKind::Lengths),
        ("epsgCode=\"EPSG:3875\"", Some("EPSG:3875"), CoordinateKind::Lengths),
        ("epsgCode=\"0\" name=\"GK21\"", Some("GK21"), CoordinateKind::Unknown),
        ("epsgCode=\"\" desc=\"site grid\"", Some("site grid"), CoordinateKind::Unknown),
        ("epsgCode=\"4326\"", Some("EPSG:4326"), CoordinateKind::Degrees),
        ("ogcWktCode=\"PROJCS[&quot;x&quot;]\" name=\"y\"", Some("PROJCS[\"x\"]"), CoordinateKind::Unknown),
        ("", None, CoordinateKind::Unknown),
    ] {
        let text = plain().replace("<Surfaces>", &format!("<CoordinateSystem {system}/><Surfaces>"));
        let raw = ground(text).unwrap();
        assert_eq!((raw.source.crs.as_deref(), raw.source.kind), (crs, kind), "{system}");
    }
}

fn two() -> String {
    let more = plain();
    let one = &more[more.find("<Surface ").unwrap()..more.find("</Surfaces>").unwrap()];
    let other = one.replace("\"EG\"", "\"FG\"").replace(" 7.5<", " 17.5<").replace("<F>1 3 4</F>", "");
    more.replace("</Surfaces>", &format!("{other}</Surfaces>"))
}

#[test]
fn one_of_several() {
    assert_eq!(
        ground(two()).unwrap_err(),
        "the file holds several surfaces\n  --> a.xml\n   = 2 surfaces: `EG` (4 vertices, 2 faces), `FG` (4 vertices, 1 faces)\n   \
         = help: say which one with `--surface NAME`"
    );
    assert_eq!(surface(two(), Some("EG")).unwrap().ground, expected());
    let RawGround::Mesh { vertices, faces } = surface(two(), Some("FG")).unwrap().ground else { panic!() };
    assert_eq!((vertices[0].z, faces.len()), (17.5, 1));
    let message = surface(two(), Some("eg")).unwrap_err();
    assert!(message.contains("no surface `eg`") && message.contains("`FG`"), "{message}");
    let message = surface(two().replace("FG", "EG"), Some("EG")).unwrap_err();
    assert!(message.contains("2 surfaces have the name `EG`"), "{message}");
    let message = ground(file("<Surfaces/>")).unwrap_err();
    assert!(message.contains("holds no surface"), "{message}");
}

#[test]
fn points_alone() {
    let text = file(&tin(&points(["1", "2", "3", "4"]), ""));
    let raw = ground(&text).unwrap();
    assert!(matches!(raw.ground, RawGround::Points(points) if points.len() == 4));
    assert_eq!(codes(&raw.notes), ["landxml-no-faces"]);
    // Their triangles would not follow the breaklines.
    let breakline = "<SourceData><Breaklines><Breakline><PntList3D>5000 100 7.5 5030 140 9.25</PntList3D></Breakline></Breaklines></SourceData>";
    let message = ground(text.replace("<Definition", &format!("{breakline}<Definition"))).unwrap_err();
    assert!(message.contains("has no faces") && message.contains("1 breaklines and boundaries"), "{message}");
    let message = ground(plain().replace("<F>", "<F i=\"1\">")).unwrap_err();
    assert!(message.contains("all faces of the surface are hidden"), "{message}");
}

#[test]
fn cells_of_grids() {
    let text = file(&tin(&points(["1", "2", "3", "4"]), "<Faces><F>1 2 3 4</F></Faces>")).replace("TIN", "grid");
    let raw = ground(text).unwrap();
    let RawGround::Mesh { faces, .. } = &raw.ground else { panic!() };
    assert_eq!(*faces, RawFaces::Polygons { corners: vec![0, 1, 2, 3], ends: vec![4] });
    assert_eq!(terrain::prepare(raw).unwrap().terrain.triangles.len(), 2);
}

/// Points no face uses are in the file (900 000 km away) and do not matter: neither for the frame nor for its precision.
#[test]
fn far_points_no_face_uses() {
    let far = "<P id=\"5\">900000000 900000000 0</P>";
    let text = file(&tin(&format!("{far}{}", points(["1", "2", "3", "4"])), "<Faces><F>1 2 3</F><F>1 3 4</F></Faces>"));
    let prepared = terrain::prepare(ground(text).unwrap()).unwrap();
    let alone = terrain::prepare(ground(plain()).unwrap()).unwrap();
    assert_eq!(prepared.terrain.frame, alone.terrain.frame);
    let corners = |t: &slopegen::model::Terrain| t.corners(1);
    assert_eq!(corners(&prepared.terrain), corners(&alone.terrain));
    assert_eq!(codes(&prepared.notes), ["ground-vertices-unused"]);
}

#[test]
fn what_a_surface_says_of_itself_is_checked() {
    // 40 by 30, between 7.5 and 9.25.
    let with = |figures: &str| {
        let text = plain().replace("surfType=\"TIN\"", &format!("surfType=\"TIN\" {figures}"));
        codes(&ground(text).unwrap().notes)
    };
    let none: [&str; 0] = [];
    assert_eq!(with("area2DSurf=\"1200.0000\" elevMin=\"7.5\" elevMax=\"9.3\""), none);
    assert_eq!(with("area2DSurf=\"1200\" area3DSurf=\"1201.2\" elevMax=\"9.25\""), none);
    assert_eq!(with("area2DSurf=\"1203.5\""), ["landxml-area"]);
    assert_eq!(with("elevMin=\"7.4\" elevMax=\"9.252\""), ["landxml-elevation", "landxml-elevation"]);
    // Areas in hectares.
    let text = plain().replace("linearUnit", "areaUnit=\"hectare\" linearUnit");
    let notes = |area: &str| {
        let text = text.replace("surfType=\"TIN\"", &format!("area2DSurf=\"{area}\""));
        codes(&ground(text).unwrap().notes)
    };
    assert_eq!(notes("0.12"), none);
    assert_eq!(notes("0.1"), none, "half of the last digit is 500 m²");
    assert_eq!(notes("0.1300"), ["landxml-area"]);
    // Millimetres: the declared area is in the same unit.
    let text = plain().replace("meter", "millimeter").replace("surfType=\"TIN\"", "area2DSurf=\"1200\"");
    assert_eq!(codes(&ground(text).unwrap().notes), ["landxml-units"]);
}

#[test]
fn easting_first() {
    let text = plain();
    let read = |order: &str| {
        let options = TerrainOptions { csv_order: Some(order.parse().unwrap()), ..TerrainOptions::of(InputFormat::LandXml) };
        parse_terrain("a.xml", text.as_bytes(), &options).map(|raw| raw.ground).map_err(|e| e.to_string())
    };
    assert_eq!(read("nez").unwrap(), expected());
    assert_eq!(read("yxz").unwrap(), expected());
    let RawGround::Mesh { vertices, .. } = read("enz").unwrap() else { panic!() };
    assert_eq!(vertices[2], DVec3::new(5030.0, 140.0, 9.25));
    for order in ["zen", "pnez", "en", "nezd"] {
        assert!(read(order).unwrap_err().contains("cannot have this order"), "{order}");
    }
}

#[test]
fn damage_is_told_with_its_line() {
    let text = plain();
    for (from, to, line, words) in [
        ("<P id=\"2\">5000 140 8<", "<P id=\"2\">5000 140<", 6, "`5000 140`: 2 numbers"),
        ("<P id=\"2\">5000 140 8<", "<P id=\"2\">5000 140 8 9<", 6, "4 numbers"),
        ("<P id=\"2\">5000 140 8<", "<P id=\"2\">5000 140,5 8<", 6, "decimals behind a point"),
        ("<P id=\"2\">5000 140 8<", "<P id=\"2\">5000 140 nan<", 6, "`nan`"),
        ("<P id=\"2\">5000 140 8<", "<P id=\"2\">5000 1e400 8<", 6, "`1e400`"),
        ("<P id=\"2\">", "<P>", 6, "no id"),
        ("<P id=\"2\">", "<P id=\"2>", 6, "damaged"),
        ("<P id=\"2\">", "<P id=\"1\">", 4, "points 1 and 2 of the surface"),
        ("<F>1 3 4</F>", "<F>1 3</F>", 10, "2 corners"),
        ("<F>1 3 4</F>", "<F>1 2 3 4 1</F>", 10, "5 corners"),
        ("<F>1 3 4</F>", "\n<F i=\"1\">1 1 1</F><F>1 3 44</F>", 11, "no point has the id `44`; there are 4 points"),
        ("<F>1 3 4</F>", "<F>1 3 4</G>", 10, "damaged"),
        ("<F>1 3 4</F>", "<F>1 3 &four;</F>", 10, "`&four;`"),
        ("surfType=\"TIN\"", "area2DSurf=\"big\"", 4, "area2DSurf=\"big\""),
        ("name=\"EG\"", "name=\"&lol;\"", 4, "unrecognized entity `lol`"),
    ] {
        assert!(text.contains(from), "{from}");
        let message = ground(text.replace(from, to)).unwrap_err();
        assert!(message.contains(&format!("a.xml, line {line}\n")), "{to}\n{message}");
        assert!(message.contains(words), "{to}\n{message}");
    }
    let message = ground("<?xml version=\"1.0\"?>\n<kml><Surface/></kml>").unwrap_err();
    assert!(message.contains("not LandXML") && message.contains("<kml>"), "{message}");
}
