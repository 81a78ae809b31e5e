//! DXF drawings, as AutoCAD Release 12 reads them: the version every program and every instrument knows.
//!
//! Reference: Autodesk, "AutoCAD Release 12 Customization Manual", chapter 11; the group codes still stand in the "DXF Reference"
//! of later versions. Release 12 has no handles and no variable for the unit, so the unit stands in a comment.

use super::head::{finite, plain};
use super::lines::in_order;
use super::number::{push_f64, push_u64};
use super::obj::{finite_vertex, flush_if_full};
use super::{EncodeError, GENERATOR, Head};
use crate::model::{CurveKind, LineFeature, Part, Tin};
use glam::DVec3;
use std::io::Write;

/// Numbers of colours in AutoCAD's index.
const RED: u64 = 1;
const YELLOW: u64 = 2;
const GREEN: u64 = 3;
const CYAN: u64 = 4;
const BLUE: u64 = 5;
const MAGENTA: u64 = 6;
const BLACK_OR_WHITE: u64 = 7;
const GREY: u64 = 8;
const ORANGE: u64 = 30;

/// Flags of a polyline: it is closed, it is in space; and of a vertex of one in space.
const CLOSED: u64 = 1;
const IN_SPACE: u64 = 8;
const VERTEX_IN_SPACE: u64 = 32;

/// Most characters of a comment line: the longest text of Release 12 is 255.
const LONGEST_TEXT: usize = 200;

/// Writes a mesh as 3DFACEs, on a layer for each part, and its line work as 3D polylines, on a layer for each kind. World
/// coordinates always, with the shortest digits that read back to the same bits. Comments tell program, reference system and
/// unit.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::NotFinite`] for a vertex or a line with a coordinate that is no number.
pub fn write_dxf(out: &mut (impl Write + ?Sized), tin: &Tin, head: &Head<'_>) -> Result<(), EncodeError> {
    drawing(out, Some(tin), head)
}

/// Writes the line work [`Head::lines`] alone, as [`write_dxf`] does.
///
/// # Errors
/// As [`write_dxf`].
pub fn write_dxf_lines(out: &mut (impl Write + ?Sized), head: &Head<'_>) -> Result<(), EncodeError> {
    drawing(out, None, head)
}

fn drawing(out: &mut (impl Write + ?Sized), tin: Option<&Tin>, head: &Head<'_>) -> Result<(), EncodeError> {
    let mut bytes = Vec::with_capacity(1 << 17);
    comment(&mut bytes, GENERATOR);
    if let Some(crs) = head.crs {
        comment(&mut bytes, &format!("crs: {}", plain(crs)));
    }
    comment(&mut bytes, &format!("unit: {}", head.unit));
    header(&mut bytes, tin, head);
    tables(&mut bytes, tin, head);
    text(&mut bytes, b"0", b"SECTION");
    text(&mut bytes, b"2", b"ENTITIES");
    if let Some(tin) = tin {
        faces(out, &mut bytes, tin)?;
    }
    for i in in_order(head.lines) {
        polyline(out, &mut bytes, &head.lines[i], i)?;
    }
    text(&mut bytes, b"0", b"ENDSEC");
    text(&mut bytes, b"0", b"EOF");
    out.write_all(&bytes)?;
    Ok(())
}

/// A group: its code and its text.
fn text(bytes: &mut Vec<u8>, code: &[u8], value: &[u8]) {
    for part in [code, b"\n", value, b"\n"] {
        bytes.extend_from_slice(part);
    }
}

fn whole(bytes: &mut Vec<u8>, code: &[u8], value: u64) {
    bytes.extend_from_slice(code);
    bytes.push(b'\n');
    push_u64(bytes, value);
    bytes.push(b'\n');
}

/// A point as three groups, whose codes end in `last`: `10`, `20`, `30` for `b'0'`.
fn point(bytes: &mut Vec<u8>, last: u8, values: [f64; 3]) {
    for (first, value) in [b'1', b'2', b'3'].into_iter().zip(values) {
        bytes.extend_from_slice(&[first, last, b'\n']);
        push_f64(bytes, value);
        bytes.push(b'\n');
    }
}

/// A comment, in as many lines as it takes; characters beyond ASCII as `\U+XXXX`, which AutoCAD puts for them.
fn comment(bytes: &mut Vec<u8>, value: &str) {
    let mut line = String::new();
    for c in value.chars() {
        if c.is_ascii() {
            line.push(c);
        } else {
            let mut units = [0; 2];
            c.encode_utf16(&mut units).iter().for_each(|unit| line.push_str(&format!("\\U+{unit:04X}")));
        }
        if line.len() >= LONGEST_TEXT {
            text(bytes, b"999", line.as_bytes());
            line.clear();
        }
    }
    if !line.is_empty() {
        text(bytes, b"999", line.as_bytes());
    }
}

/// Version and box of the drawing.
fn header(bytes: &mut Vec<u8>, tin: Option<&Tin>, head: &Head<'_>) {
    text(bytes, b"0", b"SECTION");
    text(bytes, b"2", b"HEADER");
    text(bytes, b"9", b"$ACADVER");
    text(bytes, b"1", b"AC1009");
    let vertices = tin.into_iter().flat_map(|tin| (0..tin.vertices.len()).map(|i| tin.world(i)));
    let points = drawn(head.lines).flat_map(|line| line.points.iter().copied());
    let empty = (DVec3::INFINITY, DVec3::NEG_INFINITY);
    let (low, high) = vertices.chain(points).fold(empty, |(low, high), p| (low.min(p), high.max(p)));
    if low.is_finite() && high.is_finite() {
        for (name, corner) in [(&b"$EXTMIN"[..], low), (b"$EXTMAX", high)] {
            text(bytes, b"9", name);
            point(bytes, b'0', corner.to_array());
        }
    }
    text(bytes, b"0", b"ENDSEC");
}

/// Lines of two points and more; others are none.
fn drawn(lines: &[LineFeature]) -> impl Iterator<Item = &LineFeature> {
    lines.iter().filter(|line| line.points.len() >= 2)
}

/// The one line type, and the layers that occur.
fn tables(bytes: &mut Vec<u8>, tin: Option<&Tin>, head: &Head<'_>) {
    let has_part = |part: Part| tin.is_some_and(|tin| tin.parts.contains(&part));
    let mut layers: Vec<(String, u64)> =
        Part::ALL.into_iter().filter(|part| has_part(*part)).map(|part| (layer(part.name()), part_colour(part))).collect();
    let mut kinds: Vec<CurveKind> = drawn(head.lines).map(|line| line.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    layers.extend(kinds.into_iter().map(|kind| (layer(kind.name()), kind_colour(kind))));

    text(bytes, b"0", b"SECTION");
    text(bytes, b"2", b"TABLES");
    text(bytes, b"0", b"TABLE");
    text(bytes, b"2", b"LTYPE");
    whole(bytes, b"70", 1);
    text(bytes, b"0", b"LTYPE");
    text(bytes, b"2", b"CONTINUOUS");
    whole(bytes, b"70", 0);
    text(bytes, b"3", b"Solid line");
    whole(bytes, b"72", 65);
    whole(bytes, b"73", 0);
    text(bytes, b"40", b"0.0");
    text(bytes, b"0", b"ENDTAB");
    text(bytes, b"0", b"TABLE");
    text(bytes, b"2", b"LAYER");
    whole(bytes, b"70", layers.len() as u64 + 1);
    for (name, colour) in std::iter::once(("0".to_owned(), BLACK_OR_WHITE)).chain(layers) {
        text(bytes, b"0", b"LAYER");
        text(bytes, b"2", name.as_bytes());
        whole(bytes, b"70", 0);
        whole(bytes, b"62", colour);
        text(bytes, b"6", b"CONTINUOUS");
    }
    text(bytes, b"0", b"ENDTAB");
    text(bytes, b"0", b"ENDSEC");
}

/// Name of the layer of a part or kind: Release 12 knows capital letters only.
fn layer(name: &str) -> String {
    name.to_ascii_uppercase()
}

fn part_colour(part: Part) -> u64 {
    match part {
        Part::Platform => GREY,
        Part::FillSlope => BLUE,
        Part::CutSlope => RED,
        Part::Ground => GREEN,
    }
}

fn kind_colour(kind: CurveKind) -> u64 {
    match kind {
        CurveKind::LevelCurve => GREY,
        CurveKind::Ridge => ORANGE,
        CurveKind::Valley => CYAN,
        CurveKind::Hinge => YELLOW,
        CurveKind::Breakline | CurveKind::Boundary | CurveKind::Zero => BLACK_OR_WHITE,
        CurveKind::Daylight => MAGENTA,
    }
}

/// Triangles: faces whose fourth corner repeats the third.
fn faces(out: &mut (impl Write + ?Sized), bytes: &mut Vec<u8>, tin: &Tin) -> Result<(), EncodeError> {
    let layers = Part::ALL.map(|part| layer(part.name()));
    for (triangle, part) in tin.triangles.iter().zip(&tin.parts) {
        text(bytes, b"0", b"3DFACE");
        text(bytes, b"8", layers[*part as usize].as_bytes());
        let [a, b, c] = *triangle;
        for (last, v) in [(b'0', a), (b'1', b), (b'2', c), (b'3', c)] {
            point(bytes, last, finite_vertex(tin, v as usize, DVec3::ZERO)?);
        }
        flush_if_full(out, bytes)?;
    }
    Ok(())
}

/// One polyline, `index` its position in the caller's list. Closed ones do not repeat their first point. Daylight lines have the
/// colour of the slope that ends there.
fn polyline(
    out: &mut (impl Write + ?Sized),
    bytes: &mut Vec<u8>,
    feature: &LineFeature,
    index: usize,
) -> Result<(), EncodeError> {
    let name = layer(feature.kind.name());
    let closed = feature.points.len() > 3 && feature.points.first() == feature.points.last();
    let points = &feature.points[..feature.points.len() - usize::from(closed)];
    text(bytes, b"0", b"POLYLINE");
    text(bytes, b"8", name.as_bytes());
    if let Some(part) = feature.part {
        whole(bytes, b"62", part_colour(part));
    }
    whole(bytes, b"66", 1);
    whole(bytes, b"70", IN_SPACE + if closed { CLOSED } else { 0 });
    point(bytes, b'0', [0.0; 3]);
    for p in points {
        text(bytes, b"0", b"VERTEX");
        text(bytes, b"8", name.as_bytes());
        for value in p.to_array() {
            finite(value, "line feature", index + 1)?;
        }
        point(bytes, b'0', p.to_array());
        whole(bytes, b"70", VERTEX_IN_SPACE);
        flush_if_full(out, bytes)?;
    }
    text(bytes, b"0", b"SEQEND");
    text(bytes, b"8", name.as_bytes());
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::frame::Frame;

    fn tin() -> Tin {
        Tin {
            frame: Frame::WORLD,
            vertices: [[500_000.125, 5.4e6, 400.0], [500_010.0, 5.4e6, 0.1 + 0.2], [5e5, 5_400_020.0, -1.5]]
                .map(DVec3::from)
                .to_vec(),
            triangles: vec![[0, 1, 2]],
            parts: vec![Part::CutSlope],
        }
    }

    fn line(kind: CurveKind, points: &[[f64; 3]], part: Option<Part>) -> LineFeature {
        LineFeature { kind, points: points.iter().map(|p| DVec3::from(*p)).collect(), elevation: None, chain: None, part }
    }

    /// Groups as code and text, proved to be pairs of lines.
    fn groups(bytes: &[u8]) -> Vec<(u32, String)> {
        let text = std::str::from_utf8(bytes).unwrap();
        assert!(text.is_ascii() && text.lines().all(|line| line.len() <= 255));
        let lines: Vec<&str> = text.lines().collect();
        assert!(lines.len().is_multiple_of(2));
        lines.chunks_exact(2).map(|pair| (pair[0].parse().unwrap(), pair[1].to_owned())).collect()
    }

    fn written(tin: Option<&Tin>, head: &Head<'_>) -> Vec<(u32, String)> {
        let mut bytes = Vec::new();
        drawing(&mut bytes, tin, head).unwrap();
        groups(&bytes)
    }

    /// Entities as lists of groups that begin with code 0.
    fn entities(groups: &[(u32, String)]) -> Vec<&[(u32, String)]> {
        let begin = groups.iter().position(|g| *g == (2, "ENTITIES".into())).unwrap() + 1;
        groups[begin..].chunk_by(|_, next| next.0 != 0).collect()
    }

    #[test]
    fn faces_and_polylines_lie_on_their_layers() {
        let ring = [[0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [1.0, 1.0, 1.5], [0.0, 0.0, 1.0]];
        let lines = [
            line(CurveKind::Daylight, &ring, Some(Part::FillSlope)),
            line(CurveKind::Ridge, &ring[..2], None),
            line(CurveKind::Valley, &ring[..1], None),
        ];
        let groups = written(Some(&tin()), &Head { lines: &lines, ..Head::default() });
        let found = entities(&groups);
        let names: Vec<&str> = found.iter().map(|e| e[0].1.as_str()).collect();
        let polyline = |n: usize| [&["POLYLINE"][..], &vec!["VERTEX"; n], &["SEQEND"]].concat();
        assert_eq!(names, [&["3DFACE"][..], &polyline(2), &polyline(3), &["ENDSEC", "EOF"]].concat());
        let face: Vec<(u32, &str)> = found[0].iter().map(|(code, text)| (*code, text.as_str())).collect();
        let third = [("12", "500000"), ("22", "5400020"), ("32", "-1.5")].map(|(c, t)| (c.parse().unwrap(), t));
        let expected = [
            &[(0, "3DFACE"), (8, "CUT_SLOPE"), (10, "500000.125"), (20, "5400000"), (30, "400")][..],
            &[(11, "500010"), (21, "5400000"), (31, "0.30000000000000004")],
            &third,
            &third.map(|(code, text)| (code + 1, text)),
        ]
        .concat();
        assert_eq!(face, expected);
        // The ridge comes first; the daylight line is closed and blue.
        assert_eq!(found[1][1..4], [(8, "RIDGE".into()), (66, "1".into()), (70, "8".into())]);
        assert_eq!(found[5][1..5], [(8, "DAYLIGHT".into()), (62, "5".into()), (66, "1".into()), (70, "9".into())]);
        let layers: Vec<&str> = groups.windows(2).filter(|g| g[0] == (0, "LAYER".into())).map(|g| g[1].1.as_str()).collect();
        assert_eq!(layers, ["0", "CUT_SLOPE", "RIDGE", "DAYLIGHT"]);
    }

    #[test]
    fn the_box_holds_mesh_and_lines() {
        let lines = [line(CurveKind::Boundary, &[[5e5, 5.3e6, 7.0], [500_001.0, 5.4e6, 900.0]], None)];
        let groups = written(Some(&tin()), &Head { lines: &lines, ..Head::default() });
        let corner = |name: &str| {
            let at = groups.iter().position(|g| g.1 == name).unwrap();
            groups[at + 1..at + 4].iter().map(|g| g.1.parse().unwrap()).collect::<Vec<f64>>()
        };
        assert_eq!((corner("$EXTMIN"), corner("$EXTMAX")), (vec![5e5, 5.3e6, -1.5], vec![500_010.0, 5_400_020.0, 900.0]));
        assert!(written(None, &Head::default()).iter().all(|g| g.1 != "$EXTMIN"));
    }

    #[test]
    fn reference_systems_cannot_break_the_file() {
        let crs = format!("a\r\n0\nEOF\u{e4}\u{1F600}{}", "x".repeat(3000));
        let groups = written(None, &Head { crs: Some(&crs), ..Head::default() });
        let comments: String = groups.iter().filter(|g| g.0 == 999).map(|g| g.1.as_str()).collect();
        let expected = format!("{GENERATOR}crs: a  0 EOF\\U+00E4\\U+D83D\\U+DE00{}unit: m", "x".repeat(3000));
        assert_eq!(comments, expected);
        assert_eq!(groups.iter().filter(|g| g.1 == "EOF").count(), 1);
    }

    #[test]
    fn numbers_that_are_none_are_refused() {
        let mut bad = tin();
        bad.vertices[1].y = f64::NAN;
        let error = write_dxf(&mut Vec::new(), &bad, &Head::default()).unwrap_err();
        assert!(matches!(error, EncodeError::NotFinite { what: "vertex", index: 2, .. }), "{error}");
        let lines = [line(CurveKind::Zero, &[[0.0; 3], [f64::INFINITY, 0.0, 0.0]], None)];
        let error = write_dxf_lines(&mut Vec::new(), &Head { lines: &lines, ..Head::default() }).unwrap_err();
        assert!(matches!(error, EncodeError::NotFinite { what: "line feature", index: 1, .. }), "{error}");
    }
}
