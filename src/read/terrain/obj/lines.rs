//! Lines of an OBJ file → vertices and faces, by several threads.

use super::super::Faces;
use super::text::without_comment;
use crate::read::decimal;
use glam::DVec3;
use memchr::memchr;
use rayon::prelude::*;
use std::ops::Range;

/// Bytes read in one go, up to the end of a line.
const CHUNK: usize = 1 << 20;

/// Largest distance that a face counts back: numbers within a [`CHUNK`] are kept in 31 bits until those before it are known.
const FURTHEST_BACK: i64 = (1 << 31) - CHUNK as i64;

/// Statements of OBJ that have nothing to say about ground, in files of triangles.
const PASSED_OVER: [&[u8]; 31] = [
    b"vt",
    b"vn",
    b"vp",
    b"s",
    b"mg",
    b"mtllib",
    b"usemtl",
    b"usemap",
    b"maplib",
    b"lod",
    b"bevel",
    b"c_interp",
    b"d_interp",
    b"shadow_obj",
    b"trace_obj",
    b"ctech",
    b"stech",
    b"cstype",
    b"deg",
    b"bmat",
    b"step",
    b"curv",
    b"curv2",
    b"surf",
    b"parm",
    b"trim",
    b"hole",
    b"scrv",
    b"sp",
    b"end",
    b"con",
];

/// What a stretch of the file holds.
#[derive(Default)]
pub(super) struct Part {
    /// Coordinates may be no numbers.
    pub(super) vertices: Vec<DVec3>,
    /// Faces. Corners that count back are still counted within the stretch; so they may be below nought, as two's complements.
    pub(super) faces: Faces,
    /// Which of all corners, one after the other, count back.
    relative: Vec<usize>,
    /// Highest vertex named by a number of its own, counted from 0.
    pub(super) highest: u32,
    /// A face names a vertex that can be in no file.
    pub(super) missing: bool,
    /// Points and polylines left out.
    pub(super) skipped: usize,
    /// Groups (`g`) and objects (`o`): how many faces of the stretch stand before each, and its name.
    pub(super) groups: [Vec<(usize, String)>; 2],
    /// A line may go on in the next one, or have others in it, see [`super::text::with_line_ends`].
    pub(super) odd: bool,
    /// Corners of the face being read.
    corners: Vec<u32>,
    /// Which of them count back.
    back: Vec<usize>,
}

/// Reads all lines. The error is the place of the first that is wrong.
pub(super) fn read(bytes: &[u8]) -> Result<Vec<Part>, usize> {
    let start = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
    let mut chunks: Vec<Range<usize>> = Vec::new();
    let mut begin = start;
    while begin < bytes.len() {
        let least = (begin + CHUNK).min(bytes.len());
        let end = memchr(b'\n', &bytes[least..]).map_or(bytes.len(), |n| least + n + 1);
        chunks.push(begin..end);
        begin = end;
    }
    let parts: Vec<Result<Part, usize>> = chunks.into_par_iter().map(|chunk| part(bytes, chunk)).collect();
    parts.into_iter().collect()
}

fn part(bytes: &[u8], chunk: Range<usize>) -> Result<Part, usize> {
    let text = &bytes[..chunk.end];
    let mut part = Part::default();
    let mut at = chunk.start;
    while at < text.len() {
        // The usual lines first, in one go with the search for their ends.
        let used = match &text[at..] {
            [b'v', b' ' | b'\t', rest @ ..] => part.plain_vertex(rest),
            [b'f', b' ' | b'\t', rest @ ..] => part.face(rest),
            _ => None,
        };
        match used {
            Some(used) => at += 2 + used,
            None => {
                let end = memchr(b'\n', &text[at..]).map_or(text.len(), |n| at + n + 1);
                part.line(&text[at..end]).ok_or(at)?;
                at = end;
            }
        }
    }
    Ok(part)
}

impl Part {
    /// Gives corners that count back their numbers in the file, where `before` vertices stand before the stretch. False if one
    /// counts back too far.
    pub(super) fn place_relative(&mut self, before: usize) -> bool {
        let corners = self.faces.corners_mut();
        self.relative.iter().all(|&at| {
            let corner = &mut corners[at];
            let number = before as i64 + i64::from(*corner as i32);
            *corner = number as u32;
            number >= 0
        })
    }

    /// A vertex of three plain numbers, after its `v`; the bytes up to the end of the line.
    #[inline]
    fn plain_vertex(&mut self, text: &[u8]) -> Option<usize> {
        let mut at = 0;
        let mut number = || {
            at += blanks(&text[at..]);
            let (value, length) = decimal::leading(&text[at..])?;
            at += length;
            Some(value)
        };
        let vertex = DVec3::new(number()?, number()?, number()?);
        at += blanks(&text[at..]);
        let end = line_end(&text[at..])?;
        self.vertices.push(vertex);
        Some(at + end)
    }

    /// A face, after its `f`; the bytes up to the end of the line. `None` if a corner is no vertex number, or if there are fewer
    /// than three.
    #[inline]
    fn face(&mut self, text: &[u8]) -> Option<usize> {
        self.corners.clear();
        self.back.clear();
        let mut missing = false;
        let mut at = 0;
        let used = loop {
            at += blanks(&text[at..]);
            if let Some(end) = line_end(&text[at..]) {
                break at + end;
            }
            let (index, length) = corner(&text[at..])?;
            at += length;
            let known = match index {
                0 => return None,
                1.. => u32::try_from(index - 1).ok(),
                _ if index >= -FURTHEST_BACK => {
                    self.back.push(self.corners.len());
                    Some((self.vertices.len() as i64 + index) as i32 as u32)
                }
                _ => None,
            };
            missing |= known.is_none();
            if index > 0 {
                self.highest = self.highest.max(known.unwrap_or(0));
            }
            self.corners.push(known.unwrap_or(0));
        };
        let before = self.faces.corner_count();
        match self.corners[..] {
            [a, b, c] => self.faces.triangle([a, b, c]),
            [_, _, _, ..] => self.faces.polygon(&self.corners),
            _ => return None,
        }
        self.missing |= missing;
        self.relative.extend(self.back.iter().map(|corner| before + corner));
        Some(used)
    }

    /// Any line. `None` if it is wrong.
    fn line(&mut self, line: &[u8]) -> Option<()> {
        let end = line.trim_ascii_end();
        self.odd |= end.ends_with(b"\\") || memchr(b'\r', end).is_some();
        let bare = without_comment(end).trim_ascii();
        let word = bare.split(u8::is_ascii_whitespace).next().unwrap_or(bare);
        match word {
            b"" => {}
            b"v" => self.vertex(&bare[1..])?,
            b"f" => drop(self.face(&bare[1..])?),
            b"l" | b"p" => self.skipped += 1,
            b"g" | b"o" => {
                let name = String::from_utf8_lossy(bare[1..].trim_ascii()).into_owned();
                self.groups[usize::from(word == b"o")].push((self.faces.len(), name));
            }
            word if PASSED_OVER.contains(&word) => {}
            _ => return None,
        }
        Some(())
    }

    /// A vertex of any numbers; of more than three, only colours and a weight of one are passed over.
    fn vertex(&mut self, text: &[u8]) -> Option<()> {
        let mut fields = text.split(u8::is_ascii_whitespace).filter(|f| !f.is_empty());
        let mut number = || decimal::number(fields.next()?);
        let vertex = DVec3::new(number()?, number()?, number()?);
        let first = fields.next();
        match fields.count() {
            0 => {
                if first.is_some_and(|weight| decimal::number(weight) != Some(1.0)) {
                    return None;
                }
            }
            // With the first three, or four: a colour, perhaps with its opacity.
            2 | 3 => {}
            _ => return None,
        }
        self.vertices.push(vertex);
        Some(())
    }
}

/// Blanks at the beginning of a text.
#[inline]
fn blanks(text: &[u8]) -> usize {
    text.iter().take_while(|b| matches!(b, b' ' | b'\t')).count()
}

/// The bytes of the end of a line, if there is one here.
#[inline]
fn line_end(text: &[u8]) -> Option<usize> {
    match text {
        [b'\n', ..] => Some(1),
        [b'\r', b'\n', ..] => Some(2),
        [] => Some(0),
        _ => None,
    }
}

/// A corner at the beginning of a text, `7`, `7/1`, `7//3`, `7/1/3`: its vertex and the length.
#[inline]
fn corner(text: &[u8]) -> Option<(i64, usize)> {
    let (vertex, mut at) = whole(text)?;
    for _ in 0..2 {
        if text.get(at) != Some(&b'/') {
            break;
        }
        at += 1;
        // Texture and normal may be left out.
        if text.get(at).is_some_and(|b| !matches!(b, b'/' | b' ' | b'\t' | b'\r' | b'\n')) {
            at += whole(&text[at..])?.1;
        }
    }
    text.get(at).is_none_or(u8::is_ascii_whitespace).then_some((vertex, at))
}

/// A whole number at the beginning of a text and its length; beyond 18 digits it is as large as can be.
#[inline]
fn whole(text: &[u8]) -> Option<(i64, usize)> {
    /// Digits that always fit.
    const FIT: usize = 18;
    let begin = usize::from(matches!(text.first(), Some(b'-' | b'+')));
    let mut value = 0_i64;
    let mut at = begin;
    while let Some(digit) = text.get(at).map(|b| b.wrapping_sub(b'0')).filter(|d| *d < 10) {
        value = value.wrapping_mul(10).wrapping_add(i64::from(digit));
        at += 1;
    }
    let count = at - begin;
    let value = if count > FIT { i64::MAX } else { value };
    (count > 0).then_some((if text[0] == b'-' { -value } else { value }, at))
}
