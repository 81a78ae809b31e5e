//! Stanford PLY: text and binary.

mod header;
mod scan;

use super::comments::Spoken;
use super::{Faces, RawFaces, RawGround, Said};
use crate::model::Note;
use crate::read::ReadError;
use crate::read::error::{clip, refuse};
use glam::DVec3;
use header::{Element, Encoding, Header, Kind, Scalar};
use rayon::prelude::*;
use scan::{Miss, Scan, value};
use std::sync::atomic::{AtomicBool, Ordering};

/// Records a thread reads in one go.
const CHUNK: usize = 1 << 15;

/// Bytes of a triangle: how many corners it has, and those.
const RECORD: usize = 13;

/// Names the list of a face goes by.
const INDICES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Name of the property of faces that says what they belong to.
const PART: &str = "part";

pub(super) fn read(label: &str, bytes: &[u8], notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let Loaded { vertices, faces, spoken, .. } = load(label, bytes, notes)?;
    if let Some(at) = vertices.par_iter().with_min_len(CHUNK).position_first(|v| !v.is_finite()) {
        let v = vertices[at];
        let at = format!("{label}, vertex {}", at + 1);
        let help = "correct it, or take the vertex and its faces out";
        return Err(refuse("a vertex is not finite", at, format!("({}, {}, {})", v.x, v.y, v.z), help));
    }
    let ground = match faces {
        Some(faces) => RawGround::Mesh { vertices, faces },
        None => RawGround::Points(vertices),
    };
    Ok((ground, spoken.said()))
}

/// A PLY file as it is.
pub(super) struct Loaded {
    /// Coordinates may be no numbers.
    pub(super) vertices: Vec<DVec3>,
    pub(super) faces: Option<RawFaces>,
    /// The property `part` of each face; empty if there is none.
    pub(super) parts: Vec<f64>,
    /// What the comments say; the vertices are in world coordinates already.
    pub(super) spoken: Spoken,
}

/// Reads a file with whatever coordinates it has.
pub(super) fn load(label: &str, bytes: &[u8], notes: &mut Vec<Note>) -> Result<Loaded, ReadError> {
    let header = header::read(label, bytes)?;
    let mut vertices = None;
    let mut faces = None;
    let mut parts = Vec::new();
    let mut scan = Scan::new(&bytes[header.body..], header.encoding);
    for element in &header.elements {
        let reader = Reader { label, header: &header, element };
        match element.name.as_str() {
            "vertex" => vertices = Some(reader.vertices(&mut scan)?),
            "face" => faces = Some(reader.faces(&mut scan, &mut parts)?),
            _ => {
                if element.name == "tristrips" && element.count > 0 {
                    let help = "export the mesh with an element `face`";
                    return Err(refuse("triangle strips are not read", label, "element `tristrips`", help));
                }
                reader.pass_over(&mut scan)?;
            }
        }
    }
    let over = scan.rest.iter().filter(|b| **b != 0 && !b.is_ascii_whitespace()).count();
    if over > 0 {
        let help = "the header does not fit the data: export the mesh again";
        return Err(refuse("the PLY file goes on after its last element", label, format!("{} bytes", scan.rest.len()), help));
    }
    let Some(mut vertices) = vertices.filter(|v| !v.is_empty()) else {
        let help = "export the mesh again, with an element `vertex`";
        return Err(refuse("the PLY file has no vertices", label, "there is no element `vertex`, or it is empty", help));
    };
    let faces = faces.filter(|faces| faces.len() > 0).map(Faces::finish);
    if let Some(faces) = &faces {
        check_indices(label, faces, vertices.len())?;
    }
    let others: Vec<&str> = header
        .elements
        .iter()
        .filter(|e| e.count > 0 && !["vertex", "face"].contains(&e.name.as_str()))
        .map(|e| e.name.as_str())
        .collect();
    if !others.is_empty() {
        notes.push(Note::new("ply-elements-ignored", format!("elements passed over: `{}`", others.join("`, `"))));
    }
    let spoken = Spoken::of_ply(&bytes[..header.body]);
    spoken.place(&mut vertices, notes);
    Ok(Loaded { vertices, faces, parts, spoken })
}

fn check_indices(label: &str, faces: &RawFaces, count: usize) -> Result<(), ReadError> {
    let corners = match faces {
        RawFaces::Triangles(triangles) => triangles.as_flattened(),
        RawFaces::Polygons { corners, .. } => corners,
    };
    let highest = corners.par_iter().with_min_len(CHUNK).copied().max().unwrap_or(0);
    if (highest as usize) < count {
        return Ok(());
    }
    let at = corners.iter().position(|&v| v as usize >= count).unwrap_or(0);
    let face = match faces {
        RawFaces::Triangles(_) => at / 3,
        RawFaces::Polygons { ends, .. } => ends.partition_point(|&end| end <= at),
    };
    Err(refuse(
        "a face names a vertex that is not there",
        format!("{label}, face {}", face + 1),
        format!("vertex {} counted from 0, the file has {count}", i64::from(corners[at])),
        "export the mesh again: the file was put together wrongly",
    ))
}

/// Reads the records of one element.
struct Reader<'a> {
    label: &'a str,
    header: &'a Header,
    element: &'a Element,
}

impl Reader<'_> {
    fn wrong(&self, index: u64, miss: Miss) -> ReadError {
        let Element { name, count, .. } = self.element;
        let name = clip(name.as_bytes());
        let at = format!("{}, {name} {}", self.label, index + 1);
        match miss {
            Miss::End => {
                let figures = format!("the header declares {count} of `{name}`, the data end in number {}", index + 1);
                refuse("the PLY file is cut off", at, figures, "copy or export the file again")
            }
            Miss::Text(text) => refuse("a value is not a number", at, format!("`{}`", clip(&text)), "correct the file"),
            Miss::Whole(value) => {
                refuse("a count or a vertex number is not a whole number from 0", at, format!("{value}"), "export the mesh again")
            }
        }
    }

    /// Records there can be at most, given the bytes that are left.
    fn at_most(&self, scan: &Scan<'_>) -> usize {
        let least: usize = self
            .element
            .properties
            .iter()
            .map(|p| match (self.header.encoding, p.kind) {
                // A digit and a blank.
                (Encoding::Ascii, _) => 2,
                (_, Kind::One(scalar)) | (_, Kind::List { count: scalar, .. }) => scalar.size(),
            })
            .sum();
        let room = scan.rest.len() / least.max(1) + 1;
        usize::try_from(self.element.count).map_or(room, |count| count.min(room))
    }

    fn vertices(&self, scan: &mut Scan<'_>) -> Result<Vec<DVec3>, ReadError> {
        let mut wanted = [(0, Scalar::Double); 3];
        for (place, name) in wanted.iter_mut().zip(["x", "y", "z"]) {
            let found = self.element.find(&[name]);
            *place = match found.map(|i| (i, self.element.properties[i].kind)) {
                Some((i, Kind::One(scalar))) => (i, scalar),
                _ => {
                    let figures = format!("element `vertex` has no property `{name}`");
                    let help = "export the mesh with vertices of `x`, `y` and `z`";
                    return Err(refuse("the PLY file has no full vertices", self.label, figures, help));
                }
            };
        }
        let mut vertices = Vec::with_capacity(self.at_most(scan));
        match self.element.stride().filter(|_| self.header.encoding != Encoding::Ascii) {
            Some(stride) => self.packed(scan, stride, wanted, &mut vertices)?,
            None => {
                for index in 0..self.element.count {
                    let mut vertex = [0.0; 3];
                    self.record(scan, |i, value| {
                        for (to, (place, _)) in vertex.iter_mut().zip(&wanted) {
                            if i == *place {
                                *to = value;
                            }
                        }
                    })
                    .map_err(|miss| self.wrong(index, miss))?;
                    vertices.push(DVec3::from(vertex));
                }
            }
        }
        if u32::try_from(vertices.len()).is_err() {
            let figures = format!("{}", vertices.len());
            return Err(refuse("the PLY file has too many vertices", self.label, figures, "cut the ground down to the site"));
        }
        Ok(vertices)
    }

    /// Binary vertices, each of the same number of bytes.
    fn packed(
        &self,
        scan: &mut Scan<'_>,
        stride: usize,
        wanted: [(usize, Scalar); 3],
        vertices: &mut Vec<DVec3>,
    ) -> Result<(), ReadError> {
        let there = (scan.rest.len() / stride) as u64;
        if there < self.element.count {
            return Err(self.wrong(there, Miss::End));
        }
        let little = self.header.encoding == Encoding::Little;
        let (data, rest) = scan.rest.split_at(self.element.count as usize * stride);
        scan.rest = rest;
        if little && stride == 24 && wanted == [(0, Scalar::Double), (1, Scalar::Double), (2, Scalar::Double)] {
            let (records, _) = data.as_chunks::<8>();
            let (records, _) = records.as_chunks::<3>();
            let read =
                |r: &[[u8; 8]; 3]| DVec3::new(f64::from_le_bytes(r[0]), f64::from_le_bytes(r[1]), f64::from_le_bytes(r[2]));
            records.par_iter().with_min_len(CHUNK).map(read).collect_into_vec(vertices);
            return Ok(());
        }
        let offsets = wanted.map(|(i, scalar)| {
            let before = self.element.properties[..i].iter();
            let offset: usize = before.map(|p| if let Kind::One(scalar) = p.kind { scalar.size() } else { 0 }).sum();
            (offset..offset + scalar.size(), scalar)
        });
        vertices.extend(data.chunks_exact(stride).map(|record| {
            let [x, y, z] = [0, 1, 2].map(|i| value(&record[offsets[i].0.clone()], offsets[i].1, little));
            DVec3::new(x, y, z)
        }));
        Ok(())
    }

    /// One record; single values are handed out with the index of their property.
    fn record(&self, scan: &mut Scan<'_>, mut visit: impl FnMut(usize, f64)) -> Result<(), Miss> {
        for (i, property) in self.element.properties.iter().enumerate() {
            match property.kind {
                Kind::One(scalar) => visit(i, scan.number(scalar)?),
                Kind::List { count, item } => {
                    let count = scan.whole(count)?;
                    scan.skip(count as usize, item)?;
                }
            }
        }
        Ok(())
    }

    fn faces(&self, scan: &mut Scan<'_>, parts: &mut Vec<f64>) -> Result<Faces, ReadError> {
        if self.element.count == 0 {
            return Ok(Faces::with_capacity(0));
        }
        let list = self.element.find(&INDICES).map(|i| (i, self.element.properties[i].kind));
        let Some((place, Kind::List { count: counter, item })) =
            list.filter(|(_, kind)| matches!(kind, Kind::List { item, .. } if item.is_whole()))
        else {
            let help = "export the mesh with `property list uchar int vertex_indices`";
            let figures = "element `face` has no list `vertex_indices` of whole numbers";
            return Err(refuse("the PLY file has no faces that can be read", self.label, figures, help));
        };
        let mut faces = Faces::with_capacity(self.at_most(scan));
        let mut done = 0_u64;
        let usual = self.header.encoding == Encoding::Little && counter.size() == 1 && item.size() == 4;
        if usual && self.element.properties.len() == 1 && self.triangles(scan, &mut faces) {
            done = self.element.count;
        }
        let part = self.element.find(&[PART]);
        let mut corners = Vec::new();
        for index in done..self.element.count {
            corners.clear();
            let own = self.face(scan, place, part, &mut corners).map_err(|miss| self.wrong(index, miss))?;
            parts.extend(own);
            match corners[..] {
                [a, b, c] => faces.triangle([a, b, c]),
                [_, _, _, ..] => faces.polygon(&corners),
                _ => {
                    let at = format!("{}, face {}", self.label, index + 1);
                    let help = "take the face out";
                    return Err(refuse("a face has fewer than three corners", at, format!("{}", corners.len()), help));
                }
            }
        }
        Ok(faces)
    }

    /// Faces as they are mostly written: three corners each, of four bytes, and nothing else. False if there are others among them.
    fn triangles(&self, scan: &mut Scan<'_>, faces: &mut Faces) -> bool {
        let (records, _) = scan.rest.as_chunks::<RECORD>();
        let Some(records) = usize::try_from(self.element.count).ok().and_then(|count| records.get(..count)) else { return false };
        let others = AtomicBool::new(false);
        let read = |record: &[u8; RECORD]| {
            if record[0] != 3 {
                others.store(true, Ordering::Relaxed);
            }
            // Numbers below zero turn up as ones that are too large.
            let (corners, _) = record[1..].as_chunks::<4>();
            [u32::from_le_bytes(corners[0]), u32::from_le_bytes(corners[1]), u32::from_le_bytes(corners[2])]
        };
        records.par_iter().with_min_len(CHUNK).map(read).collect_into_vec(&mut faces.triangles);
        if others.into_inner() {
            faces.triangles.clear();
            return false;
        }
        scan.rest = &scan.rest[RECORD * records.len()..];
        true
    }

    /// One face; its part, where it has one.
    fn face(&self, scan: &mut Scan<'_>, place: usize, part: Option<usize>, corners: &mut Vec<u32>) -> Result<Option<f64>, Miss> {
        let mut own = None;
        for (i, property) in self.element.properties.iter().enumerate() {
            match property.kind {
                Kind::One(scalar) if Some(i) == part => own = Some(scan.number(scalar)?),
                Kind::One(scalar) => scan.skip(1, scalar)?,
                Kind::List { count, item } => {
                    let count = scan.whole(count)?;
                    if i == place {
                        for _ in 0..count {
                            corners.push(scan.whole(item)?);
                        }
                    } else {
                        scan.skip(count as usize, item)?;
                    }
                }
            }
        }
        Ok(own)
    }

    fn pass_over(&self, scan: &mut Scan<'_>) -> Result<(), ReadError> {
        // Without properties there is nothing in the data, however many are declared.
        if self.element.properties.is_empty() {
            return Ok(());
        }
        for index in 0..self.element.count {
            self.record(scan, |_, _| ()).map_err(|miss| self.wrong(index, miss))?;
        }
        Ok(())
    }
}
