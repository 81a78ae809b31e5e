//! The lines of an OBJ file that `tobj` is to see.

use super::diagnose;
use crate::read::ReadError;
use memchr::{memchr, memchr_iter, memrchr};
use std::borrow::Cow;
use std::io::{self, BufRead, Read};
use std::ops::Range;

/// A text with line feeds where it had single carriage returns, which `tobj` does not take for line ends; and with lines joined
/// that end in a backslash.
pub(super) fn with_line_ends(bytes: &[u8]) -> Cow<'_, [u8]> {
    let lone = memchr(b'\r', bytes).is_some_and(|at| bytes.get(at + 1) != Some(&b'\n'));
    let joined = memchr_iter(b'\\', bytes).any(|at| matches!(bytes.get(at + 1), Some(b'\n' | b'\r')));
    if !lone && !joined {
        return Cow::Borrowed(bytes);
    }
    let mut text = bytes.to_vec();
    for at in 0..text.len() {
        if text[at] == b'\r' {
            text[at] = if text.get(at + 1) == Some(&b'\n') { b' ' } else { b'\n' };
        }
    }
    // A joined line stands where its first part stood; the line ends taken away are put behind it, to keep the numbers.
    let mut out = Vec::with_capacity(text.len());
    let mut owed = 0;
    for line in text.split_inclusive(|&b| b == b'\n') {
        let bare = line.trim_ascii_end();
        if let Some(part) = bare.strip_suffix(b"\\") {
            out.extend_from_slice(part);
            out.push(b' ');
            owed += 1;
        } else {
            out.extend_from_slice(line);
            out.extend(std::iter::repeat_n(b'\n', std::mem::take(&mut owed)));
        }
    }
    Cow::Owned(out)
}

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

/// Where the bytes for `tobj` stand.
enum Piece {
    /// In the file.
    Given(Range<usize>),
    /// Among the lines made here.
    Made(Range<usize>),
}

/// The vertices and faces of an OBJ file as text, after a first face made up of all vertices.
pub(super) struct Feed<'a> {
    bytes: &'a [u8],
    made: Vec<u8>,
    pieces: Vec<Piece>,
    /// Next piece, and what of it has been read.
    at: (usize, usize),
    /// Vertices of the file.
    pub(super) vertices: usize,
    /// Points and polylines left out.
    pub(super) skipped: usize,
    /// Faces of the file.
    faces: usize,
    /// Groups (`g`) and objects (`o`): how many faces stand before each, and its name.
    pub(super) groups: [Vec<(usize, String)>; 2],
}

impl<'a> Feed<'a> {
    /// Looks through a file. Lines that are right but would be misunderstood are left out or written anew.
    ///
    /// # Errors
    /// For lines that `tobj` would accept although they are wrong.
    pub(super) fn new(label: &str, bytes: &'a [u8]) -> Result<Self, ReadError> {
        let mut feed = Self {
            bytes,
            made: Vec::new(),
            pieces: Vec::new(),
            at: (0, 0),
            vertices: 0,
            skipped: 0,
            faces: 0,
            groups: [Vec::new(), Vec::new()],
        };
        let start = if bytes.starts_with(b"\xEF\xBB\xBF") { 3 } else { 0 };
        let mut begin = start;
        while begin < bytes.len() {
            let end = memchr(b'\n', &bytes[begin..]).map_or(bytes.len(), |n| begin + n + 1);
            feed.line(label, begin..end)?;
            begin = end;
        }
        // One face of all vertices: numbers from 1, at the front.
        let from = feed.made.len();
        feed.made.push(b'f');
        for i in 1..=feed.vertices {
            feed.made.push(b' ');
            push_number(&mut feed.made, i);
        }
        feed.made.push(b'\n');
        let all = Piece::Made(from..feed.made.len());
        feed.pieces.insert(0, all);
        Ok(feed)
    }

    fn line(&mut self, label: &str, range: Range<usize>) -> Result<(), ReadError> {
        let line = &self.bytes[range.clone()];
        match line {
            [b'v', b' ' | b'\t', rest @ ..] => {
                self.vertices += 1;
                // The usual case: three numbers and nothing else.
                if fields(rest) == 3 && memchr(b'#', rest).is_none() { self.given(range) } else { self.vertex(label, range)? }
            }
            [b'f', b' ' | b'\t', rest @ ..] if memchr(b'#', rest).is_none() => {
                self.faces += 1;
                self.given(range);
            }
            _ => {
                let bare = without_comment(line).trim_ascii();
                let word = bare.split(u8::is_ascii_whitespace).next().unwrap_or(bare);
                match word {
                    b"" => {}
                    b"v" => {
                        self.vertices += 1;
                        self.vertex(label, range)?;
                    }
                    b"f" => {
                        self.faces += 1;
                        let from = self.made.len();
                        self.made.extend_from_slice(bare);
                        self.made.push(b'\n');
                        self.pieces.push(Piece::Made(from..self.made.len()));
                    }
                    b"l" | b"p" => self.skipped += 1,
                    b"g" | b"o" => {
                        let name = String::from_utf8_lossy(bare[1..].trim_ascii()).into_owned();
                        self.groups[usize::from(word == b"o")].push((self.faces, name));
                    }
                    word if PASSED_OVER.contains(&word) => {}
                    _ => return Err(diagnose::unknown(label, self.bytes, range.start)),
                }
            }
        }
        Ok(())
    }

    /// A vertex with more than three numbers: only colours and a weight of one are passed over.
    fn vertex(&mut self, label: &str, range: Range<usize>) -> Result<(), ReadError> {
        let line = without_comment(&self.bytes[range.clone()]).trim_ascii();
        let mut fields = line.split(u8::is_ascii_whitespace).filter(|f| !f.is_empty()).skip(1);
        let from = self.made.len();
        self.made.push(b'v');
        for field in fields.by_ref().take(3) {
            self.made.push(b' ');
            self.made.extend_from_slice(field);
        }
        self.made.push(b'\n');
        let rest: Vec<&[u8]> = fields.take(6).collect();
        match rest.as_slice() {
            // Fewer than three numbers are found by `tobj`.
            [] | [_, _, _] | [_, _, _, _] => {}
            [weight] if crate::read::decimal::number(weight) == Some(1.0) => {}
            [_] => return Err(diagnose::weight(label, self.bytes, range.start)),
            _ => return Err(diagnose::fields(label, self.bytes, range.start)),
        }
        self.pieces.push(Piece::Made(from..self.made.len()));
        Ok(())
    }

    fn given(&mut self, range: Range<usize>) {
        match self.pieces.last_mut() {
            Some(Piece::Given(last)) if last.end == range.start => last.end = range.end,
            _ => self.pieces.push(Piece::Given(range)),
        }
    }
}

/// Fields separated by blanks.
fn fields(text: &[u8]) -> usize {
    let mut blank = true;
    let mut count = 0;
    for &byte in text {
        let now = byte <= b' ';
        count += usize::from(blank && !now);
        blank = now;
    }
    count
}

pub(super) fn without_comment(line: &[u8]) -> &[u8] {
    memchr(b'#', line).map_or(line, |at| &line[..at])
}

fn push_number(out: &mut Vec<u8>, mut n: usize) {
    let from = out.len();
    loop {
        out.push(b'0' + (n % 10) as u8);
        n /= 10;
        if n == 0 {
            break;
        }
    }
    out[from..].reverse();
}

impl Read for Feed<'_> {
    fn read(&mut self, out: &mut [u8]) -> io::Result<usize> {
        let n = self.fill_buf()?.read(out)?;
        self.consume(n);
        Ok(n)
    }
}

impl BufRead for Feed<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        loop {
            let (piece, done) = self.at;
            let rest = match self.pieces.get(piece) {
                None => return Ok(&[]),
                Some(Piece::Given(range)) => range.start + done..range.end,
                Some(Piece::Made(range)) => range.start + done..range.end,
            };
            if rest.is_empty() {
                self.at = (piece + 1, 0);
                continue;
            }
            return Ok(match self.pieces[piece] {
                Piece::Given(_) => &self.bytes[rest],
                Piece::Made(_) => &self.made[rest],
            });
        }
    }

    fn consume(&mut self, n: usize) {
        self.at.1 += n;
    }
}

/// Number of the line that begins at or before `at`, counted from 1, and its text.
pub(super) fn line_at(bytes: &[u8], at: usize) -> (usize, &[u8]) {
    let begin = memrchr(b'\n', &bytes[..at]).map_or(0, |n| n + 1);
    let end = memchr(b'\n', &bytes[at..]).map_or(bytes.len(), |n| at + n);
    (memchr_iter(b'\n', &bytes[..begin]).count() + 1, &bytes[begin..end])
}
