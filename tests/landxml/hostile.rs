//! Damaged and hostile files: an error, in bounded time and memory, and never a panic.

use super::{CHORD, file, ground, lines};
use slopegen::read::terrain::read_mesh;
use std::fmt::Write as _;
use std::time::{Duration, Instant};

/// A small file with something of everything.
fn everything() -> String {
    file(
        "<CoordinateSystem epsgCode=\"25832\"/><CgPoints><CgPoint name=\"1\">0 0 1</CgPoint></CgPoints>\n\
         <Alignments><Alignment name=\"a\" length=\"40.5\" staStart=\"10\"><CoordGeom><Line length=\"10\"><Start pntRef=\"1\"/><End>0 10 1</End></Line>\
         <Spiral rot=\"ccw\" spiType=\"clothoid\" length=\"10\" radiusStart=\"INF\" radiusEnd=\"50\"><Start>0 10</Start><End>0.3331 19.9900</End></Spiral>\
         <Curve rot=\"ccw\" radius=\"50\"><Start>0.3331 19.9900</Start><End>5.3 28.5</End></Curve></CoordGeom><Profile><ProfAlign name=\"p\">\
         <PVI>10 1</PVI><ParaCurve length=\"4\">20 2</ParaCurve><CircCurve radius=\"90\">30 2</CircCurve><PVI>40 3</PVI></ProfAlign></Profile></Alignment></Alignments>\n\
         <Surfaces><Surface name=\"s &amp; t\"><SourceData><Breaklines><Breakline name=\"b\"><PntList3D>0 0 1 0 1 1</PntList3D></Breakline></Breaklines></SourceData>\
         <Definition surfType=\"TIN\" area2DSurf=\"50\" elevMin=\"0\"><Pnts><P id=\"1\">0 0 0</P><P id=\"x\">0 10 0</P><P id=\"3\">10 0 1</P></Pnts>\
         <Faces><F>1 x 3</F><F i=\"1\">3 x 1</F></Faces></Definition></Surface></Surfaces>",
    )
}

#[test]
fn cut_off_anywhere() {
    let text = everything();
    assert!(ground(&text).is_ok());
    assert!(lines(&text, &[]).is_ok(), "{:?}", lines(&text, &[]).map(drop));
    let end = text.trim_end().len();
    for cut in 0..end {
        for message in [ground(&text.as_bytes()[..cut]).map(drop), lines(&text.as_bytes()[..cut], &[]).map(drop)] {
            let message = message.expect_err("a file that is cut off");
            assert!(message.contains("= help:") || message.contains("= "), "{cut}: {message}");
        }
    }
}

#[test]
fn changed_bytes() {
    let text = everything().into_bytes();
    let mut state = 88_172_645_463_325_252_u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    const BYTES: &[u8] = b"<>/\"'&;=!?-[] \0\t\n0159eE.+x\xC3\xFF";
    for _ in 0..6000 {
        let mut bytes = text.clone();
        for _ in 0..=random(3) {
            let at = random(bytes.len());
            match random(4) {
                0 => drop(bytes.remove(at)),
                1 => bytes.insert(at, BYTES[random(BYTES.len())]),
                2 => bytes[at] = BYTES[random(BYTES.len())],
                _ => {
                    let (from, to) = (at, (at + random(60)).min(bytes.len()));
                    let piece = bytes[from..to].to_vec();
                    let there = random(bytes.len());
                    bytes.splice(there..there, piece);
                }
            }
        }
        // Whatever comes of it is an answer; coordinates that are read are numbers.
        if let Ok(raw) = lines(&bytes, &[]) {
            assert!(raw.lines.iter().flat_map(|line| &line.vertices).all(|v| v.x.is_finite() && v.y.is_finite()));
        }
        if let Ok(raw) = ground(&bytes) {
            drop(slopegen::terrain::prepare(raw));
        }
    }
}

/// Refused, within a time that a quadratic reader would not keep even on a busy machine.
fn refused(what: &str, bytes: &[u8], words: &str) {
    let begun = Instant::now();
    for answer in [ground(bytes).map(drop), lines(bytes, &[]).map(drop)] {
        let message = answer.expect_err(what);
        assert!(message.contains(words) && message.len() < 4000, "{what}: {message}");
    }
    assert!(begun.elapsed() < Duration::from_secs(20), "{what}: {:?}", begun.elapsed());
}

#[test]
fn bombs() {
    let mut entities = String::from("<?xml version=\"1.0\"?>\n<!DOCTYPE LandXML [<!ENTITY a \"lol\">");
    for i in 0..30 {
        let _ = write!(entities, "<!ENTITY b{i} \"&a;&a;&a;&a;&a;&a;&a;&a;&a;&a;\">");
    }
    let entities = format!("{entities}]>\n<LandXML><Project name=\"&b29;\"/></LandXML>");
    refused("entities", entities.as_bytes(), "declares entities of its own\n  --> a.xml, line");
    refused(
        "external entity",
        b"<!DOCTYPE LandXML [<!ENTITY x SYSTEM \"file:///etc/passwd\">]><LandXML>&x;</LandXML>",
        "declares entities",
    );
    refused("unclosed document type", format!("<!DOCTYPE LandXML [{}", "<!ELEMENT a>".repeat(100_000)).as_bytes(), "damaged");
    refused("depth", format!("<LandXML>{}", "<a>".repeat(1_000_000)).as_bytes(), "nested too deep");
    refused("depth of features", file(&"<Surfaces><PlanFeature>".repeat(200)).as_bytes(), "nested too deep");
    let attributes: String = (0..200_000).fold(String::new(), |text, i| text + " a" + &i.to_string() + "=\"1\"");
    refused("attributes", file(&format!("<Surface{attributes}/><Alignment{attributes}/>")).as_bytes(), "");
    refused("one long name", file(&format!("<{}/>", "a".repeat(5_000_000))).as_bytes(), "");
    refused("one long value", format!("<{}/>", "q".repeat(3_000_000)).as_bytes(), "not LandXML");
    refused("no elements", &b"  \n ".repeat(1000), "");
    refused("zero bytes", &[0; 100_000], "");
    refused("only brackets", &b"<".repeat(1_000_000), "");
    refused(
        "comment without end",
        file("").replace("</LandXML>", &format!("<!--{}", " -".repeat(1_000_000))).as_bytes(),
        "damaged",
    );
}

#[test]
fn absurd_figures() {
    let faces = |points: &str, faces: &str| {
        file(&format!("<Surface name=\"a\"><Definition><Pnts>{points}</Pnts><Faces>{faces}</Faces></Definition></Surface>"))
    };
    // Ids that would make a table of 4 GB; counts are nowhere believed.
    let text = faces(
        "<P id=\"999999999\">0 0 0</P><P id=\"4294967295\">0 1 0</P><P id=\"99999999999999999999\">1 0 0</P>",
        "<F>999999999 4294967295 99999999999999999999</F>",
    );
    assert!(ground(text).is_ok());
    let message = ground(faces("<P id=\"1\" count=\"4000000000\">0 0 0</P>", &"<F>1 2 3</F>".repeat(1000))).unwrap_err();
    assert!(message.contains("no point has the id `2`"), "{message}");
    let message = ground(faces("<P id=\"1\">0 0 0</P>", &format!("<F>{}</F>", "1 ".repeat(1_000_000)))).unwrap_err();
    assert!(message.contains("1000000 corners"), "{message}");

    let spiral = |length: &str, radius: &str| {
        file(&format!(
            "<Alignment name=\"a\"><CoordGeom><Spiral rot=\"cw\" length=\"{length}\" radiusStart=\"{radius}\" radiusEnd=\"INF\"><Start>0 0 0</Start><End>10 0 0</End></Spiral></CoordGeom></Alignment>"
        ))
    };
    for (length, radius) in
        [("1e300", "1"), ("10", "1e-300"), ("-10", "5"), ("0", "5"), ("INF", "INF"), ("1e9", "1e-9"), ("10", "-INF")]
    {
        let answer = lines(spiral(length, radius), &[]);
        assert!(answer.is_err() || radius == "-INF", "{length} {radius}");
    }
    // An arc of so many chords that they would fill the memory.
    let arc = file(
        "<Alignment name=\"a\"><CoordGeom><Curve rot=\"cw\"><Start>0 0 0</Start><Center>0 9e15</Center><End>9e15 9e15 0</End></Curve></CoordGeom></Alignment>",
    );
    let message = lines(arc, &[]).unwrap_err();
    assert!(message.contains("take too many points") && message.contains(&CHORD.to_string()), "{message}");
}

/// Coordinates whose squares are beyond all doubles: read or not, no line comes of them.
#[test]
fn coordinates_beyond_all() {
    for (centre, end) in
        [("0 1e200", "1e200 1e200 5"), ("1e308 0", "-1e308 0 0"), ("0 0", "1e308 -1e308 1e308"), ("0 1e-320", "0 2e-320 1")]
    {
        for element in ["Curve rot=\"cw\"", "Spiral rot=\"cw\" length=\"1e150\" radiusStart=\"1e150\" radiusEnd=\"INF\"", "Line"]
        {
            let name = element.split(' ').next().unwrap();
            let text = file(&format!(
                "<PlanFeature><CoordGeom><{element}><Start>0 0 0</Start><Center>{centre}</Center><End>{end}</End></{name}></CoordGeom></PlanFeature>"
            ));
            if let Ok(raw) = lines(&text, &[]) {
                let checked = slopegen::validate::check(&raw, &Default::default());
                assert!(checked.is_err() || name == "Line" && !end.contains("308"), "{text}");
            }
        }
    }
}

/// Every line with a note that names its place: finding places must not take the square of their number.
#[test]
fn many_notes() {
    let feature = "<PlanFeature name=\"p\"><CoordGeom><Line length=\"1.01\"><Start>0 0 0</Start><End>0 1 0</End></Line></CoordGeom></PlanFeature>\n";
    let begun = Instant::now();
    let raw = lines(file(&feature.repeat(60_000)), &[]).unwrap();
    assert_eq!(raw.notes.iter().filter(|note| note.code == "landxml-misfit").count(), 6);
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
}

/// One element with many attributes and a long name, and many lines in it.
#[test]
fn many_lines_of_one_element() {
    let attributes: String = (0..50_000).fold(String::new(), |text, i| text + " a" + &i.to_string() + "=\"1\"");
    let line = "<CoordGeom><Line><Start>0 0 0</Start><End>0 1 0</End></Line></CoordGeom>";
    let begun = Instant::now();
    for name in [String::new(), format!(" name=\"{}\"", "n".repeat(1_000_000))] {
        let raw = lines(file(&format!("<PlanFeature{attributes}{name}>{}</PlanFeature>", line.repeat(20_000))), &[]).unwrap();
        assert_eq!(raw.lines.len(), 20_000);
        assert!(raw.lines[7].name.as_ref().is_none_or(|name| name.len() < 1000));
        // One note for each line would drown all others.
        assert!(raw.notes.len() < 10, "{}", raw.notes.len());
    }
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
}

/// Many elements and many vertical curves: their product must not matter.
#[test]
fn many_elements_and_many_curves() {
    let count = 60_000;
    let mut elements = String::new();
    let mut profile = String::from("<PVI>0 0</PVI>");
    for i in 0..count {
        let _ = write!(elements, "<Line><Start>{i} 0</Start><End>{} 0</End></Line>", i + 1);
        let _ = write!(profile, "<ParaCurve length=\"0.4\">{i}.5 {}</ParaCurve>", i % 2);
    }
    let text = file(&format!(
        "<Alignment name=\"a\"><CoordGeom>{elements}</CoordGeom><Profile><ProfAlign>{profile}<PVI>{count} 0</PVI></ProfAlign></Profile></Alignment>"
    ));
    let begun = Instant::now();
    let raw = lines(text, &[]).unwrap();
    assert!(raw.lines[0].vertices.len() > 3 * count);
    assert!(begun.elapsed() < Duration::from_secs(30), "{:?}", begun.elapsed());
}

#[test]
fn other_files_under_this_name() {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes, words) in [
        ("a.xml", &b"{\"type\": \"FeatureCollection\"}"[..], "looks like JSON"),
        ("b.xml", b"v 1 2 3\n", "looks like an OBJ mesh"),
        ("c.xml", b"<gpx version=\"1.1\"/>", "looks like a GPS track"),
        ("d.xml", b"<html><body/></html>", "web page"),
        ("e.xml", b"<kml/>", "its root element is <kml>"),
        ("f.xml", b"", "empty"),
        ("g.xml", b"hello", "text outside of all elements"),
    ] {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let message = read_mesh(&path, None, &Default::default(), &Default::default()).unwrap_err().to_string();
        assert!(message.contains(words), "{name}: {message}");
    }
}
