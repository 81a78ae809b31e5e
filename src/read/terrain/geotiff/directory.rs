//! The structure of TIFF files: byte order, directories, tags (TIFF 6.0, section 2; BigTIFF).

use crate::read::ReadError;
use crate::read::error::refuse;

/// Most tags of one directory that are looked at; images have some twenty.
const MOST_TAGS: u64 = 4096;

/// A TIFF file.
#[derive(Clone, Copy)]
pub(super) struct Tiff<'a> {
    pub(super) label: &'a str,
    pub(super) bytes: &'a [u8],
    /// Big-endian.
    pub(super) big: bool,
    /// Offsets of 64 bits (BigTIFF).
    wide: bool,
}

/// The tags of one image.
pub(super) struct Directory<'a> {
    tiff: Tiff<'a>,
    entries: Vec<Entry<'a>>,
}

struct Entry<'a> {
    tag: u16,
    kind: u16,
    count: u64,
    /// The values; `None` if they lie beyond the end of the file.
    data: Option<&'a [u8]>,
}

/// Whole numbers of a tag, read as they are asked for.
#[derive(Clone, Copy)]
pub(super) struct Wholes<'a> {
    data: &'a [u8],
    size: usize,
    big: bool,
}

impl Wholes<'_> {
    pub(super) fn len(&self) -> usize {
        self.data.len() / self.size
    }

    pub(super) fn get(&self, index: usize) -> Option<u64> {
        let from = index.checked_mul(self.size)?;
        self.data.get(from..from.checked_add(self.size)?).map(|bytes| whole(bytes, self.big))
    }
}

/// An unsigned number of up to eight bytes.
pub(super) fn whole(bytes: &[u8], big: bool) -> u64 {
    let join = |value, byte: &u8| value << 8 | u64::from(*byte);
    if big { bytes.iter().fold(0, join) } else { bytes.iter().rev().fold(0, join) }
}

/// Bytes of one value of a type; `None` for types that do not exist.
fn size_of(kind: u16) -> Option<usize> {
    match kind {
        1 | 2 | 6 | 7 => Some(1),
        3 | 8 => Some(2),
        4 | 9 | 11 | 13 => Some(4),
        5 | 10 | 12 | 16 | 17 | 18 => Some(8),
        _ => None,
    }
}

impl<'a> Tiff<'a> {
    /// Reads the head of a file; gives the place of the first directory as well.
    pub(super) fn open(label: &'a str, bytes: &'a [u8]) -> Result<(Self, u64), ReadError> {
        let big = bytes.starts_with(b"MM\0");
        let tiff = Self { label, bytes, big, wide: bytes.starts_with(b"MM\0+") || bytes.starts_with(b"II+\0") };
        if !(tiff.wide || bytes.starts_with(b"MM\0*") || bytes.starts_with(b"II*\0")) {
            let figures = format!("it begins with `{}`, not with `II*` or `MM*`", crate::read::error::clip(bytes));
            return Err(refuse("the file is not a GeoTIFF", label, figures, "check the file"));
        }
        let first = if tiff.wide { tiff.number(8, 8)? } else { tiff.number(4, 4)? };
        Ok((tiff, first))
    }

    pub(super) fn cut_off(&self, what: &str) -> ReadError {
        let figures = format!("{what} lies beyond its end at {} bytes", self.bytes.len());
        refuse("the GeoTIFF is cut off or damaged", self.label, figures, "copy or export the file again")
    }

    fn slice(&self, from: u64, size: u64) -> Option<&'a [u8]> {
        let end = from.checked_add(size)?;
        self.bytes.get(usize::try_from(from).ok()?..usize::try_from(end).ok()?)
    }

    fn number(&self, from: u64, size: u64) -> Result<u64, ReadError> {
        self.slice(from, size).map(|bytes| whole(bytes, self.big)).ok_or_else(|| self.cut_off("a directory"))
    }

    /// Reads the directory at `from`; gives the place of the next one, 0 if there is none.
    pub(super) fn directory(&self, from: u64) -> Result<(Directory<'a>, u64), ReadError> {
        let (word, size, inline) = if self.wide { (8, 20, 8) } else { (2, 12, 4) };
        let count = self.number(from, word)?;
        if count > MOST_TAGS {
            let figures = format!("a directory of {count} tags; at most {MOST_TAGS} are read");
            return Err(refuse("the GeoTIFF is damaged", self.label, figures, "copy or export the file again"));
        }
        // Below the length of the file plus what 4096 tags take: no overflow.
        let table = from + word;
        let rows = self.slice(table, count * size).ok_or_else(|| self.cut_off("a directory"))?;
        let mut entries = Vec::with_capacity(count as usize);
        for row in rows.chunks_exact(size as usize) {
            let number = |range: std::ops::Range<usize>| row.get(range).map_or(0, |bytes| whole(bytes, self.big));
            let (tag, kind) = (number(0..2) as u16, number(2..4) as u16);
            let value = size as usize - inline;
            let count = number(4..value);
            let Some(unit) = size_of(kind) else { continue };
            let data = count.checked_mul(unit as u64).and_then(|length| {
                if length <= inline as u64 {
                    row.get(value..value + length as usize)
                } else {
                    self.slice(number(value..size as usize), length)
                }
            });
            entries.push(Entry { tag, kind, count, data });
        }
        // A file that ends right behind its last directory is whole enough.
        let next = self.number(table + count * size, inline as u64).unwrap_or(0);
        Ok((Directory { tiff: *self, entries }, next))
    }
}

impl<'a> Directory<'a> {
    /// The values of a tag of one of the types in `kinds`.
    fn find(&self, tag: u16, kinds: &[u16]) -> Result<Option<(u16, &'a [u8])>, ReadError> {
        let Some(entry) = self.entries.iter().find(|entry| entry.tag == tag && kinds.contains(&entry.kind)) else {
            return Ok(None);
        };
        let what = format!("tag {tag} with {} values", entry.count);
        entry.data.map(|data| Some((entry.kind, data))).ok_or_else(|| self.tiff.cut_off(&what))
    }

    pub(super) fn wholes(&self, tag: u16) -> Result<Option<Wholes<'a>>, ReadError> {
        let found = self.find(tag, &[1, 3, 4, 13, 16, 18])?;
        Ok(found.map(|(kind, data)| Wholes { data, size: size_of(kind).unwrap_or(1), big: self.tiff.big }))
    }

    pub(super) fn whole(&self, tag: u16) -> Result<Option<u64>, ReadError> {
        Ok(self.wholes(tag)?.and_then(|wholes| wholes.get(0)))
    }

    pub(super) fn doubles(&self, tag: u16) -> Result<Vec<f64>, ReadError> {
        let big = self.tiff.big;
        let found = self.find(tag, &[12])?.map_or(&[][..], |(_, data)| data);
        Ok(found.chunks_exact(8).map(|bytes| f64::from_bits(whole(bytes, big))).collect())
    }

    pub(super) fn text(&self, tag: u16) -> Result<Option<&'a [u8]>, ReadError> {
        Ok(self.find(tag, &[2, 1, 7])?.map(|(_, data)| data))
    }
}
