//! Header and variable-length records of LAS files (ASPRS LAS 1.4, R15).

use crate::read::ReadError;
use crate::read::error::refuse;
use glam::DVec3;

/// Bytes of a point record without extra bytes, by point format.
const LEAST_RECORD: [u16; 11] = [20, 28, 26, 34, 57, 63, 30, 36, 38, 59, 67];

/// Most points of a file that are read: their coordinates take 24 bytes each, 2.4 GB.
const MOST_POINTS: u64 = 100_000_000;

const AGAIN: &str = "copy or export the file again";

/// A LAS file up to its points.
pub(super) struct Header<'a> {
    pub(super) label: &'a str,
    pub(super) bytes: &'a [u8],
    /// Point format, 0 to 10.
    pub(super) format: u8,
    /// Whether the points are packed (LAZ).
    pub(super) packed: bool,
    /// Bytes of a point record.
    pub(super) record: usize,
    /// Where the points begin; within the file.
    pub(super) from: usize,
    /// Number of points, at least one.
    pub(super) count: usize,
    pub(super) scale: DVec3,
    pub(super) offset: DVec3,
    /// Box of all points, as the header gives it.
    pub(super) lo: DVec3,
    pub(super) hi: DVec3,
    /// Whether the reference system is told as well-known text.
    pub(super) wkt: bool,
    /// Variable-length records: owner, number, content.
    records: Vec<(&'a [u8], u16, &'a [u8])>,
}

/// Little-endian numbers at fixed places.
#[derive(Clone, Copy)]
struct Bytes<'a>(&'a [u8]);

impl<'a> Bytes<'a> {
    fn array<const N: usize>(self, at: u64) -> Option<[u8; N]> {
        self.slice(at, N as u64)?.try_into().ok()
    }

    fn slice(self, at: u64, length: u64) -> Option<&'a [u8]> {
        let end = at.checked_add(length)?;
        self.0.get(usize::try_from(at).ok()?..usize::try_from(end).ok()?)
    }

    fn u16(self, at: u64) -> Option<u16> {
        self.array(at).map(u16::from_le_bytes)
    }

    fn u32(self, at: u64) -> Option<u32> {
        self.array(at).map(u32::from_le_bytes)
    }

    fn u64(self, at: u64) -> Option<u64> {
        self.array(at).map(u64::from_le_bytes)
    }

    fn f64(self, at: u64) -> Option<f64> {
        self.array(at).map(f64::from_le_bytes)
    }

    /// Three numbers 16 or 8 bytes apart.
    fn triple(self, at: u64, apart: u64) -> Option<DVec3> {
        Some(DVec3::new(self.f64(at)?, self.f64(at + apart)?, self.f64(at + 2 * apart)?))
    }
}

impl<'a> Header<'a> {
    /// Reads the header and refuses what cannot be read, before anything is reserved.
    pub(super) fn read(label: &'a str, bytes: &'a [u8]) -> Result<Self, ReadError> {
        let cut = || refuse("the LAS file is cut off within its header", label, format!("{} bytes", bytes.len()), AGAIN);
        let at = Bytes(bytes);
        if !bytes.starts_with(b"LASF") {
            let figures = format!("it begins with `{}`, not with `LASF`", crate::read::error::clip(bytes));
            return Err(refuse("the file is not a LAS or LAZ file", label, figures, "check the file"));
        }
        let version = at.array::<2>(24).ok_or_else(cut)?;
        if version[0] != 1 || version[1] > 4 {
            let figures = format!("version {}.{}; read are 1.0 to 1.4", version[0], version[1]);
            let help = format!("convert it, e.g. `pdal translate {label} ground.laz`");
            return Err(refuse("this version of LAS is not read", label, figures, &help));
        }
        let four = version[1] == 4;
        let size = u64::from(at.u16(94).ok_or_else(cut)?);
        let least = if four { 375 } else { 227 };
        if size < least || bytes.len() < least as usize {
            let figures = format!("{size} bytes of header in {}; at least {least}", bytes.len());
            return Err(refuse("the header of the LAS file is too short", label, figures, AGAIN));
        }
        let kind = at.array::<1>(104).ok_or_else(cut)?[0];
        // Packers mark the point format in its upper bits.
        let (format, packed) = (kind & 0x3F, kind & 0xC0 != 0);
        let record = at.u16(105).ok_or_else(cut)?;
        let Some(&shortest) = LEAST_RECORD.get(usize::from(format)) else {
            let figures = format!("point format {format}; read are 0 to 10");
            return Err(refuse("the points of the LAS file are of a kind that is not known", label, figures, AGAIN));
        };
        if record < shortest {
            let figures = format!("{record} bytes for a point of format {format}, which takes {shortest}");
            return Err(refuse("the points of the LAS file are too short", label, figures, AGAIN));
        }
        let old = u64::from(at.u32(107).ok_or_else(cut)?);
        let count = if four { at.u64(247).filter(|count| *count > 0).unwrap_or(old) } else { old };
        let from = u64::from(at.u32(96).ok_or_else(cut)?);
        if from < size || from > bytes.len() as u64 {
            let figures = format!("they begin at byte {from} of {}", bytes.len());
            return Err(refuse("the LAS file ends before its points", label, figures, AGAIN));
        }
        if count == 0 {
            return Err(refuse("the LAS file has no points", label, "0 points by its header", "check how it was made"));
        }
        if count > MOST_POINTS {
            let figures = format!("{count} points by its header; at most {MOST_POINTS} are read");
            let help = format!("thin it out, e.g. `pdal translate {label} thin.laz sample --filters.sample.radius=0.5`");
            return Err(refuse("the LAS file has too many points", label, figures, &help));
        }
        let scale = at.triple(131, 8).ok_or_else(cut)?;
        let offset = at.triple(155, 8).ok_or_else(cut)?;
        if !(scale.is_finite() && scale.cmpgt(DVec3::ZERO).all() && offset.is_finite()) {
            let figures = format!("scale {scale}, offset {offset}");
            return Err(refuse("scale or offset of the LAS file are no numbers that can be", label, figures, AGAIN));
        }
        let (hi, lo) = (at.triple(179, 16).ok_or_else(cut)?, at.triple(187, 16).ok_or_else(cut)?);
        let wkt = at.u16(6).ok_or_else(cut)? & 16 != 0;
        let mut records = plain_records(at, size, at.u32(100).ok_or_else(cut)?);
        if four {
            records.extend(far_records(at, at.u64(235).unwrap_or(0), at.u32(243).unwrap_or(0)));
        }
        let (record, from, count) = (usize::from(record), from as usize, count as usize);
        Ok(Self { label, bytes, format, packed, record, from, count, scale, offset, lo, hi, wkt, records })
    }

    /// Content of the first variable-length record of an owner with a number.
    pub(super) fn content(&self, owner: &str, number: u16) -> Option<&'a [u8]> {
        let found = self.records.iter().find(|(by, id, _)| *id == number && *by == owner.as_bytes());
        found.map(|(_, _, content)| *content)
    }
}

/// Owner without what fills its field.
fn owner(field: &[u8]) -> &[u8] {
    field.split(|b| *b == 0).next().unwrap_or(field).trim_ascii()
}

/// Variable-length records behind the header, as many as there are in the file.
fn plain_records<'a>(at: Bytes<'a>, mut from: u64, count: u32) -> Vec<(&'a [u8], u16, &'a [u8])> {
    let mut records = Vec::new();
    for _ in 0..count {
        let (Some(by), Some(number), Some(length)) = (at.slice(from + 2, 16), at.u16(from + 18), at.u16(from + 20)) else {
            break;
        };
        let Some(content) = at.slice(from + 54, u64::from(length)) else { break };
        records.push((owner(by), number, content));
        from += 54 + u64::from(length);
    }
    records
}

/// Variable-length records behind the points.
fn far_records<'a>(at: Bytes<'a>, mut from: u64, count: u32) -> Vec<(&'a [u8], u16, &'a [u8])> {
    let mut records = Vec::new();
    for _ in 0..count {
        // Beyond any file: its numbers are then not there.
        if from > at.0.len() as u64 {
            break;
        }
        let (Some(by), Some(number), Some(length)) = (at.slice(from + 2, 16), at.u16(from + 18), at.u64(from + 20)) else {
            break;
        };
        let Some(content) = at.slice(from + 60, length) else { break };
        records.push((owner(by), number, content));
        from += 60 + length;
    }
    records
}
