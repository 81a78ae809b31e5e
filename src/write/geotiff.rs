//! GeoTIFF rasters: one band of double precision, packed with deflate, in strips (OGC GeoTIFF 1.1; TIFF 6.0; predictor 3 of
//! Adobe's TIFF Technical Note 3).

use super::crs::plan_epsg;
use super::raster::{Anchor, GridLayout, Reference};
use super::{EncodeError, GENERATOR};
use crate::model::LengthUnit;
use flate2::{Compression, write::ZlibEncoder};
use rayon::prelude::*;
use std::io::Write;

/// Bytes of a strip before packing, about: small enough to be read in pieces, large enough to pack well.
const STRIP: usize = 1 << 18;

/// Types of tags.
const TEXT: u16 = 2;
const SHORT: u16 = 3;
const LONG: u16 = 4;
const DOUBLE: u16 = 12;

/// Bytes of the head of the file, which stands before its directory.
const HEAD: usize = 8;

/// Writes a GeoTIFF. `values` runs row by row from north to south, each row from west to east; NaN stands for a node without a
/// height and is declared as such. Values are for areas (`PixelIsArea`), the middles of which are the nodes of a lattice.
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::GridSize`] unless there is one value per cell,
/// [`EncodeError::NotFinite`] for an infinite value, [`EncodeError::TooMany`] beyond 4 GB.
pub fn write_geotiff(
    out: &mut (impl Write + ?Sized),
    layout: &GridLayout,
    values: &[f64],
    reference: &Reference<'_>,
) -> Result<(), EncodeError> {
    layout.check(values)?;
    let GridLayout { columns, rows, x, y, anchor, cell } = *layout;
    let whole = |count: usize| {
        let most = u32::MAX as usize;
        u32::try_from(count).map_err(|_| EncodeError::TooMany { what: "bytes, columns or rows of a raster", count, most })
    };
    let (wide, high) = (whole(columns)?, whole(rows)?);
    let in_strip = (STRIP / (8 * columns)).clamp(1, rows);
    let strips: Vec<std::io::Result<Vec<u8>>> = values.par_chunks(in_strip * columns).map(|strip| pack(strip, columns)).collect();
    let strips = strips.into_iter().collect::<std::io::Result<Vec<Vec<u8>>>>()?;

    let (west, south) = match anchor {
        Anchor::Corner => (x, y),
        Anchor::Center => (x - 0.5 * cell, y - 0.5 * cell),
    };
    let mut directory = Directory::default();
    directory.whole(256, LONG, &[wide]);
    directory.whole(257, LONG, &[high]);
    directory.whole(258, SHORT, &[64]);
    // Deflate, in the number Adobe gave it.
    directory.whole(259, SHORT, &[8]);
    directory.whole(262, SHORT, &[1]);
    let places = directory.whole(273, LONG, &vec![0; strips.len()]);
    directory.whole(277, SHORT, &[1]);
    directory.whole(278, LONG, &[whole(in_strip)?]);
    directory.whole(279, LONG, &strips.iter().map(|strip| whole(strip.len())).collect::<Result<Vec<u32>, _>>()?);
    directory.whole(284, SHORT, &[1]);
    directory.text(305, GENERATOR);
    // Floating-point differences.
    directory.whole(317, SHORT, &[3]);
    // Floating.
    directory.whole(339, SHORT, &[3]);
    directory.doubles(33550, &[cell, cell, 0.0]);
    directory.doubles(33922, &[0.0, 0.0, 0.0, west, south + rows as f64 * cell, 0.0]);
    directory.whole(34735, SHORT, &keys(reference));
    if let Some(unit) = reference.unit {
        // A vertical unit among the keys would make a compound system of a plain one, with a vertical part nobody named.
        let name = match unit {
            LengthUnit::Metre => "metre",
            LengthUnit::Foot => "ft",
            LengthUnit::UsSurveyFoot => "US survey foot",
        };
        let item = format!("<Item name=\"UNITTYPE\" sample=\"0\" role=\"unittype\">{name}</Item>");
        directory.text(42112, &format!("<GDALMetadata>{item}</GDALMetadata>"));
    }
    directory.text(42113, "nan");

    let mut from = HEAD + directory.length();
    let mut offsets = Vec::with_capacity(strips.len());
    for strip in &strips {
        offsets.push(whole(from)?);
        from += strip.len();
    }
    whole(from)?;
    directory.replace(places, &offsets);
    out.write_all(b"II*\0")?;
    out.write_all(&(HEAD as u32).to_le_bytes())?;
    out.write_all(&directory.bytes())?;
    for strip in &strips {
        out.write_all(strip)?;
    }
    Ok(())
}

/// Packs a strip. Of each row first come the highest bytes of all its values, then the second ones and so on, and of all these
/// the difference from the byte before: heights of neighbours agree in their first bytes, which is all that packs in doubles.
/// What is left packs no better with more effort.
fn pack(values: &[f64], columns: usize) -> std::io::Result<Vec<u8>> {
    const SIZE: usize = size_of::<f64>();
    let mut encoder = ZlibEncoder::new(Vec::with_capacity(SIZE * values.len()), Compression::fast());
    let mut bytes = vec![0; SIZE * columns];
    for row in values.chunks(columns) {
        for (i, value) in row.iter().enumerate() {
            // All nodes without a height alike, whatever bits theirs have.
            let value = if value.is_nan() { f64::NAN } else { *value };
            for (plane, byte) in value.to_be_bytes().into_iter().enumerate() {
                bytes[plane * columns + i] = byte;
            }
        }
        for i in (1..bytes.len()).rev() {
            bytes[i] = bytes[i].wrapping_sub(bytes[i - 1]);
        }
        encoder.write_all(&bytes)?;
    }
    encoder.finish()
}

/// The keys: what the values stand for, reference system and unit.
fn keys(reference: &Reference<'_>) -> Vec<u32> {
    const PROJECTED: u32 = 1;
    const AREAS: u32 = 1;
    const USER_DEFINED: u32 = 32767;
    let code = reference.crs.and_then(plan_epsg);
    let unit = reference.unit.map(|unit| match unit {
        LengthUnit::Metre => 9001,
        LengthUnit::Foot => 9002,
        LengthUnit::UsSurveyFoot => 9003,
    });
    // Of a system without a code nothing but its unit is told: other programs then take it for a local one.
    let model = unit.map(|_| (1024, USER_DEFINED));
    let mut keys: Vec<(u32, u32)> = code.map_or(model, |_| Some((1024, PROJECTED))).into_iter().collect();
    keys.push((1025, AREAS));
    keys.extend(code.map(|code| (3072, code)));
    keys.extend(unit.map(|unit| (3076, unit)));
    let mut words = vec![1, 1, 1, keys.len() as u32];
    keys.into_iter().for_each(|(key, value)| words.extend([key, 0, 1, value]));
    words
}

/// Tags in ascending order, and values too long to stand in them.
#[derive(Default)]
struct Directory {
    /// Tag, type, number of values, bytes.
    entries: Vec<(u16, u16, u32, Vec<u8>)>,
}

impl Directory {
    fn put(&mut self, tag: u16, kind: u16, count: usize, bytes: Vec<u8>) -> usize {
        self.entries.push((tag, kind, count as u32, bytes));
        self.entries.len() - 1
    }

    /// Gives the number of the entry.
    fn whole(&mut self, tag: u16, kind: u16, values: &[u32]) -> usize {
        let size = if kind == SHORT { 2 } else { 4 };
        let bytes = values.iter().flat_map(|value| value.to_le_bytes().into_iter().take(size)).collect();
        self.put(tag, kind, values.len(), bytes)
    }

    fn doubles(&mut self, tag: u16, values: &[f64]) {
        let bytes = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        self.put(tag, DOUBLE, values.len(), bytes);
    }

    fn text(&mut self, tag: u16, text: &str) {
        let mut bytes = text.as_bytes().to_vec();
        bytes.push(0);
        self.put(tag, TEXT, bytes.len(), bytes);
    }

    /// Sets the numbers of an entry of 32-bit numbers, as many as there were.
    fn replace(&mut self, entry: usize, values: &[u32]) {
        self.entries[entry].3 = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    }

    fn table(&self) -> usize {
        2 + 12 * self.entries.len() + 4
    }

    /// Bytes of the directory with the values behind it.
    fn length(&self) -> usize {
        self.table()
            + self.entries.iter().filter(|entry| entry.3.len() > 4).map(|entry| entry.3.len().next_multiple_of(2)).sum::<usize>()
    }

    /// The directory as it stands behind the head.
    fn bytes(&self) -> Vec<u8> {
        let mut bytes = (self.entries.len() as u16).to_le_bytes().to_vec();
        let mut behind = Vec::new();
        for (tag, kind, count, values) in &self.entries {
            bytes.extend_from_slice(&tag.to_le_bytes());
            bytes.extend_from_slice(&kind.to_le_bytes());
            bytes.extend_from_slice(&count.to_le_bytes());
            if values.len() <= 4 {
                bytes.extend_from_slice(values);
                bytes.resize(bytes.len() + 4 - values.len(), 0);
            } else {
                bytes.extend_from_slice(&((HEAD + self.table() + behind.len()) as u32).to_le_bytes());
                behind.extend_from_slice(values);
                // Values begin at even places.
                behind.resize(behind.len().next_multiple_of(2), 0);
            }
        }
        // No further directory.
        bytes.extend_from_slice(&[0; 4]);
        bytes.append(&mut behind);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_say_what_is_known_and_no_more() {
        assert_eq!(keys(&Reference::default()), [1, 1, 1, 1, 1025, 0, 1, 1]);
        let known = Reference { crs: Some("EPSG:2193"), unit: Some(LengthUnit::Metre) };
        let expected = [1, 1, 1, 4, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 2193, 3076, 0, 1, 9001];
        assert_eq!(keys(&known), expected);
        let feet = Reference { crs: Some("local grid"), unit: Some(LengthUnit::Foot) };
        assert_eq!(keys(&feet), [1, 1, 1, 3, 1024, 0, 1, 32767, 1025, 0, 1, 1, 3076, 0, 1, 9002]);
    }

    #[test]
    fn sizes_and_numbers_are_checked() {
        let layout = GridLayout { columns: 2, rows: 2, x: 0.0, y: 0.0, anchor: Anchor::Corner, cell: 1.0 };
        let refuse = |values: &[f64]| write_geotiff(&mut Vec::new(), &layout, values, &Reference::default()).unwrap_err();
        assert!(matches!(refuse(&[0.0; 3]), EncodeError::GridSize { values: 3, .. }));
        assert!(matches!(refuse(&[0.0, 0.0, f64::INFINITY, 0.0]), EncodeError::NotFinite { index: 3, .. }));
    }
}
