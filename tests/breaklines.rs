//! Breaklines and spot heights inside rings: closed forms, noding, refusals.

mod common;

use common::build::{build, design};
use slopegen::formation::{self, Crossfall, Formation};
use slopegen::model::{CurveKind, Extent, Line, Part};
use slopegen::read::{InputFormat, ReadOptions, parse_line};
use slopegen::surface::Surface;
use slopegen::validate::{self, Options};

/// How far breaklines may miss.
const TOLERANCE: f64 = 0.01;

/// A square of side 20 at elevation 10, its lower left corner at the origin.
const PAD: &str = r#"{"type":"Feature","properties":{"name":"pad"},"geometry":{"type":"Polygon",
    "coordinates":[[[0,0,10],[20,0,10],[20,20,10],[0,20,10],[0,0,10]]]}}"#;

fn feature(kind: &str, coordinates: &str) -> String {
    format!(
        r#"{{"type":"Feature","properties":{{"role":"breakline","name":"{}"}},"geometry":{{"type":"{kind}","coordinates":{coordinates}}}}}"#,
        kind.to_lowercase()
    )
}

fn checked(features: &[String]) -> Line {
    let text = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, features.join(","));
    let raw = parse_line("pad.geojson", text.as_bytes(), &ReadOptions::of(InputFormat::GeoJson)).unwrap();
    validate::check(&raw, &Options::default()).unwrap().line
}

fn placed(features: &[String]) -> Result<Line, String> {
    formation::place(checked(features), "pad.geojson", TOLERANCE).map_err(|e| e.to_string())
}

fn with(breaklines: &[(&str, &str)]) -> Result<Line, String> {
    let features = breaklines.iter().map(|(kind, coordinates)| feature(kind, coordinates));
    placed(&std::iter::once(PAD.to_owned()).chain(features).collect::<Vec<_>>())
}

/// Plan area of the platform and its volume above elevation 10.
fn platform(surface: &Surface) -> (f64, f64) {
    let (mut area, mut volume) = (0.0, 0.0);
    for t in (0..surface.tin.triangles.len()).filter(|&t| surface.tin.parts[t] == Part::Platform) {
        let [a, b, c] = surface.tin.corners(t);
        let own = 0.5 * (b - a).truncate().perp_dot((c - a).truncate());
        area += own;
        volume += own * ((a.z + b.z + c.z) / 3.0 - 10.0);
    }
    (area, volume)
}

#[track_caller]
fn figures(line: &Line) -> (f64, f64) {
    let surface = build(line, &design(0.5, Extent::Height(3.0)));
    platform(&surface)
}

#[track_caller]
fn close(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9 * expected.abs().max(1.0), "{found} against {expected}");
}

#[test]
fn a_ridge_from_edge_to_edge() {
    // All triangles meet in the middle, 2 above the rest: a pyramid of 400 by 2. Ends 4 mm off the edge are moved onto it.
    for coordinates in ["[[0,10,10],[10,10,12],[20,10,10]]", "[[0.004,10,10.002],[10,10,12],[20.004,10,9.998]]"] {
        let line = with(&[("LineString", coordinates)]).unwrap();
        assert_eq!(line.chains[0].vertices.len(), 6);
        assert_eq!(line.breaklines[0].of, Some(0));
        let (area, volume) = figures(&line);
        close(area, 400.0);
        close(volume, 400.0 * 2.0 / 3.0);
        let surface = build(&line, &design(0.5, Extent::Height(3.0)));
        let lines: Vec<_> = surface.lines.iter().filter(|l| l.kind == CurveKind::Breakline).collect();
        assert_eq!((lines.len(), lines[0].points.len(), lines[0].chain.as_deref()), (1, 3, Some("linestring")));
    }
}

#[test]
fn spot_heights_and_floating_lines() {
    // A cone of four triangles over the square: 400 · 3 / 3.
    let (_, volume) = figures(&with(&[("Point", "[10,10,13]")]).unwrap());
    close(volume, 400.0);
    // The same point twice, and one on the ring at its height.
    let (_, volume) = figures(&with(&[("MultiPoint", "[[10,10,13],[10,10,13],[20,5,10]]")]).unwrap());
    close(volume, 400.0);
    // A level square of side 10 in the middle, 1 lower: a frustum, (400 + 100 + 200) / 3, below 10.
    let inner = "[[5,5,9],[15,5,9],[15,15,9],[5,15,9],[5,5,9]]";
    for (kind, coordinates) in [("LineString", inner.to_owned()), ("Polygon", format!("[{inner}]"))] {
        let (area, volume) = figures(&with(&[(kind, &coordinates)]).unwrap());
        close(area, 400.0);
        close(volume, -700.0 / 3.0);
    }
}

#[test]
fn lines_that_cross_share_a_vertex() {
    // Two diagonals through the middle, 1 above: a pyramid.
    let line = with(&[("MultiLineString", "[[[0,0,10],[10,10,11],[20,20,10]],[[0,20,10],[10,10,11],[20,0,10]]]")]).unwrap();
    close(figures(&line).1, 400.0 / 3.0);
    // The same without the vertex in the middle, level: the crossing is found.
    let line = with(&[("MultiLineString", "[[[0,0,10],[20,20,10]],[[0,20,10],[20,0,10]]]")]).unwrap();
    assert!(line.breaklines.iter().all(|b| b.vertices.len() == 3), "{:?}", line.breaklines);
    close(figures(&line).0, 400.0);
}

#[test]
fn pieces_along_the_ring_are_dropped() {
    let line = with(&[("LineString", "[[0,0,10],[20,0,10],[20,20,10],[10,10,11],[5,0,10]]")]).unwrap();
    let pieces: Vec<usize> = line.breaklines.iter().map(|b| b.vertices.len()).collect();
    assert_eq!(pieces, [3]);
    close(figures(&line).0, 400.0);
}

#[test]
fn breaklines_of_their_own_ring() {
    let other = r#"{"type":"Feature","properties":{"name":"b"},"geometry":{"type":"Polygon",
        "coordinates":[[[100,0,5],[120,0,5],[120,20,5],[100,20,5],[100,0,5]],[[105,5,5],[105,15,5],[115,15,5],[115,5,5],[105,5,5]]]}}"#;
    let at = |x: f64| placed(&[PAD.into(), other.into(), feature("Point", &format!("[{x},10,6]"))]);
    assert_eq!(at(5.0).unwrap().breaklines[0].of, Some(0));
    assert_eq!(at(102.0).unwrap().breaklines[0].of, Some(1));
    // In the hole.
    assert!(at(110.0).unwrap_err().contains("outside of every ring"));
}

#[test]
fn refusals() {
    assert_eq!(
        with(&[("LineString", "[[10,10,10],[30,10,10]]")]).unwrap_err(),
        "breakline `linestring` lies outside of every ring\n  --> pad.geojson, feature 2, vertices 1 to 2\n   = at x 25.000, y 10.000\n   \
         = help: breaklines shape platforms: end them at the ring, take them out, or leave `role` out where the line carries \
         slopes itself"
    );
    assert_eq!(
        with(&[("LineString", "[[10,10,10],[20,10,10.5]]")]).unwrap_err(),
        "breakline `linestring` meets another line at a different height\n  --> pad.geojson, feature 2, vertex 2\n   \
         = at x 20.000, y 10.000: 10.500 against 10.000; tolerance 0.01\n   = help: lines that cross in plan must have one height \
         there: correct the heights, or end the breakline before"
    );
    let crossing = with(&[("MultiLineString", "[[[5,5,10],[15,15,10]],[[5,15,12],[15,5,12]]]")]).unwrap_err();
    assert!(crossing.contains("at x 10.000, y 10.000: 12.000 against 10.000"), "{crossing}");
    let text = format!(r#"{{"type":"FeatureCollection","features":[{}]}}"#, feature("Point", "[1,1,1]"));
    let error = parse_line("p", text.as_bytes(), &ReadOptions::of(InputFormat::GeoJson)).unwrap_err().to_string();
    assert!(error.contains("the file holds breaklines, but no line"), "{error}");
}

#[test]
fn kerbs_on_a_road() {
    // A centre line with a kerb 1.5 beside it, 0.15 above the road, and a line across: roads with more than their centre line.
    let centre =
        r#"{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":[[0,0,10],[50,0,10],[90,30,10]]}}"#;
    let line = checked(&[
        centre.into(),
        feature("LineString", "[[5,1.5,10.15],[40,1.5,10.15]]"),
        feature("LineString", "[[20,-4,10],[20,4,10]]"),
    ]);
    let formation = Formation { width: 8.0, crossfall: Crossfall::default(), chord: 0.001 };
    let line = formation::widen(&line, "a", &formation).unwrap().line;
    // The line across meets the kerb at another height.
    assert!(formation::place(line.clone(), "a", TOLERANCE).is_err());
    let line = formation::place(line, "a", 0.2).unwrap();
    let surface = build(&line, &design(0.5, Extent::Height(3.0)));
    close(platform(&surface).0, 800.0);
    let stations: Vec<f64> = surface.platform_stations.iter().map(|s| s.station).collect();
    assert!(stations.iter().filter(|s| (**s - 20.0).abs() < 1e-9).count() >= 2, "{stations:?}");
    let used = (0..surface.tin.triangles.len()).filter(|&t| surface.tin.parts[t] == Part::Platform);
    let on_axis = |v: u32| surface.platform_stations.iter().any(|s| s.vertex == v);
    assert!(used.flat_map(|t| surface.tin.triangles[t]).all(on_axis));
}
