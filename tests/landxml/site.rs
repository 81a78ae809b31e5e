//! The fixture `fixtures/landxml/site.xml`: ground, the same ground half a metre lower, and the alignment of the other tests.
//! `cargo test --test landxml -- --ignored write_fixture` writes it again.

use super::lines::{START, alignment};
use super::{lines, surface};
use glam::DVec2;
use std::fmt::Write as _;
use std::path::PathBuf;

/// South-west corner, distance and number of the nodes.
const CORNER: DVec2 = DVec2::new(-60.0, -60.0);
const STEP: f64 = 20.0;
const NODES: [usize; 2] = [19, 19];

fn path() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("fixtures/landxml/site.xml")
}

fn tin(name: &str, lower: f64) -> String {
    let [columns, rows] = NODES;
    let (mut points, mut faces) = (String::new(), String::new());
    for i in 0..columns * rows {
        let p = CORNER + STEP * DVec2::new((i % columns) as f64, (i / columns) as f64);
        let z = 403.0 + 0.012 * p.x + 2.0 * (p.x / 55.0).sin() + 1.5 * (p.y / 40.0).cos() - lower;
        let _ = writeln!(points, "<P id=\"{}\">{:.1} {:.1} {z:.3}</P>", i + 1, START.y + p.y, START.x + p.x);
    }
    for i in 0..(columns - 1) * (rows - 1) {
        let a = i / (columns - 1) * columns + i % (columns - 1) + 1;
        let (b, c, d) = (a + 1, a + 1 + columns, a + columns);
        let _ = writeln!(faces, "<F>{a} {b} {c}</F><F>{a} {c} {d}</F>");
    }
    let area = STEP * STEP * ((columns - 1) * (rows - 1)) as f64;
    format!(
        "<Surface name=\"{name}\"><Definition surfType=\"TIN\" area2DSurf=\"{area:.3}\">\n<Pnts>\n{points}</Pnts>\n<Faces>\n{faces}</Faces>\n\
         </Definition></Surface>\n"
    )
}

fn site() -> String {
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<LandXML xmlns=\"http://www.landxml.org/schema/LandXML-1.2\" version=\"1.2\" \
         date=\"2024-05-01\" time=\"12:00:00\">\n<Units><Metric linearUnit=\"meter\" areaUnit=\"squareMeter\" volumeUnit=\"cubicMeter\" \
         temperatureUnit=\"celsius\" pressureUnit=\"HPA\"/></Units>\n<CoordinateSystem epsgCode=\"25832\"/>\n{}\n<Surfaces>\n{}{}</Surfaces>\n\
         </LandXML>\n",
        alignment(),
        tin("EG", 0.0),
        tin("FG", 0.5)
    )
}

#[test]
#[ignore = "writes the fixture"]
fn write_fixture() {
    std::fs::write(path(), site()).unwrap();
}

#[test]
fn the_fixture_is_as_made() {
    let text = std::fs::read_to_string(path()).unwrap().replace("\r\n", "\n");
    // Sines may differ in the last bit from one system to the next, and coordinates in their last digit.
    assert_eq!(text.lines().count(), site().lines().count());
    let alignment = lines(&text, &[]).unwrap();
    assert_eq!(alignment.source.crs.as_deref(), Some("EPSG:25832"));
    for name in ["EG", "FG"] {
        assert!(surface(&text, Some(name)).unwrap().notes.is_empty());
    }
}
