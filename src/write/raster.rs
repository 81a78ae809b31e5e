//! Rasters: their layout and formats, and ESRI ASCII grids.

use super::number::push_f64;
use super::obj::flush_if_full;
use super::{EncodeError, Target, UnknownFormat, ending};
use crate::model::LengthUnit;
use std::io::Write;

/// Value of nodes without a height.
pub const NO_DATA: f64 = -9999.0;

/// The formats a raster can be written in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RasterFormat {
    /// ESRI ASCII grid.
    Asc,
    /// GeoTIFF.
    #[cfg(feature = "geotiff")]
    GeoTiff,
}

impl RasterFormat {
    /// Endings of the names of rasters, as a phrase.
    pub const KNOWN: &'static str =
        if cfg!(feature = "geotiff") { "`.asc` or `.tif`" } else { "`.asc` (this program was built without GeoTIFF)" };

    /// Whether a target is named like a raster, one that can be written or not.
    pub fn is_named(target: &Target) -> bool {
        let Target::File(path) = target else { return false };
        ending(path).is_some_and(|ending| ["asc", "tif", "tiff"].contains(&ending.as_str()))
    }

    /// The format of a target: by the ending of its name, upper or lower case. Standard output and existing devices and pipes
    /// whose names end in none take ESRI ASCII grids.
    ///
    /// # Errors
    /// [`UnknownFormat`] for any other ending, or none.
    pub fn of(target: &Target) -> Result<Self, UnknownFormat> {
        let Target::File(path) = target else { return Ok(Self::Asc) };
        match ending(path).as_deref() {
            Some("asc") => Ok(Self::Asc),
            #[cfg(feature = "geotiff")]
            Some("tif" | "tiff") => Ok(Self::GeoTiff),
            _ if target.is_stream() => Ok(Self::Asc),
            _ => Err(UnknownFormat { what: "raster", path: path.clone(), known: Self::KNOWN }),
        }
    }

    /// Writes a raster in this format; what it cannot hold of the reference is left out.
    ///
    /// # Errors
    /// As [`write_raster`] and `write_geotiff`.
    pub fn write(
        self,
        out: &mut (impl Write + ?Sized),
        layout: &GridLayout,
        values: &[f64],
        #[cfg_attr(not(feature = "geotiff"), allow(unused_variables, reason = "only GeoTIFF tells it"))] reference: &Reference<
            '_,
        >,
    ) -> Result<(), EncodeError> {
        match self {
            Self::Asc => write_raster(out, layout, values),
            #[cfg(feature = "geotiff")]
            Self::GeoTiff => super::write_geotiff(out, layout, values, reference),
        }
    }
}

/// What is known of the coordinates of a raster.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Reference<'a> {
    /// Name of their reference system.
    pub crs: Option<&'a str>,
    /// Unit of plan and heights, where one was declared.
    pub unit: Option<LengthUnit>,
}

/// Which point of the south-west cell the grid's origin names.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Its south-west corner (`xllcorner`).
    Corner,
    /// Its centre (`xllcenter`): values are heights at the nodes of a lattice.
    Center,
}

/// Size and place of a grid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridLayout {
    /// Columns, west to east.
    pub columns: usize,
    /// Rows, north to south.
    pub rows: usize,
    /// Easting of the south-west cell, in world coordinates.
    pub x: f64,
    /// Northing of the south-west cell, in world coordinates.
    pub y: f64,
    /// What `x` and `y` name.
    pub anchor: Anchor,
    /// Side of a cell, in the length unit.
    pub cell: f64,
}

impl GridLayout {
    /// Whether there is one value per cell, and none is infinite.
    pub(super) fn check(&self, values: &[f64]) -> Result<(), EncodeError> {
        let Self { columns, rows, .. } = *self;
        if columns == 0 || columns.checked_mul(rows) != Some(values.len()) {
            return Err(EncodeError::GridSize { columns, rows, values: values.len() });
        }
        for (index, value) in [self.x, self.y, self.cell].into_iter().enumerate() {
            if !value.is_finite() {
                return Err(EncodeError::NotFinite { what: "figure of the grid's origin and cell", index: index + 1, value });
            }
        }
        match values.iter().position(|value| value.is_infinite()) {
            Some(index) => Err(EncodeError::NotFinite { what: "grid value", index: index + 1, value: values[index] }),
            None => Ok(()),
        }
    }
}

/// Writes an ESRI ASCII grid. `values` runs row by row from north to south, each row from west to east; NaN stands for a node
/// without a height and is written as [`NO_DATA`].
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::GridSize`] unless there is one value per cell,
/// [`EncodeError::NotFinite`] for an infinite value.
pub fn write_raster(out: &mut (impl Write + ?Sized), layout: &GridLayout, values: &[f64]) -> Result<(), EncodeError> {
    layout.check(values)?;
    let GridLayout { columns, rows, x, y, anchor, cell } = *layout;
    let suffix = match anchor {
        Anchor::Corner => "corner",
        Anchor::Center => "center",
    };
    let mut bytes = format!("ncols {columns}\nnrows {rows}\n").into_bytes();
    for (key, value) in [(format!("xll{suffix}"), x), (format!("yll{suffix}"), y), ("cellsize".into(), cell)] {
        bytes.extend_from_slice(key.as_bytes());
        bytes.push(b' ');
        push_f64(&mut bytes, value);
        bytes.push(b'\n');
    }
    bytes.extend_from_slice(b"NODATA_value ");
    push_f64(&mut bytes, NO_DATA);
    bytes.push(b'\n');
    for row in values.chunks_exact(columns) {
        for (c, &value) in row.iter().enumerate() {
            push_f64(&mut bytes, if value.is_nan() { NO_DATA } else { value });
            bytes.push(if c + 1 == columns { b'\n' } else { b' ' });
            flush_if_full(out, &mut bytes)?;
        }
    }
    out.write_all(&bytes)?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    const LAYOUT: GridLayout = GridLayout { columns: 3, rows: 2, x: 500_000.5, y: -2.0, anchor: Anchor::Center, cell: 0.25 };

    #[test]
    fn text_is_as_documented() {
        let mut bytes = Vec::new();
        write_raster(&mut bytes, &LAYOUT, &[1.0, 2.5, f64::NAN, 0.1, -3.0, 1e-7]).unwrap();
        assert_eq!(
            String::from_utf8(bytes).unwrap(),
            "ncols 3\nnrows 2\nxllcenter 500000.5\nyllcenter -2\ncellsize 0.25\nNODATA_value -9999\n1 2.5 -9999\n0.1 -3 1e-7\n"
        );
        let mut bytes = Vec::new();
        write_raster(&mut bytes, &GridLayout { anchor: Anchor::Corner, columns: 1, rows: 1, ..LAYOUT }, &[7.0]).unwrap();
        assert!(String::from_utf8(bytes).unwrap().contains("\nxllcorner 500000.5\nyllcorner -2\n"));
    }

    #[test]
    fn sizes_and_numbers_are_checked() {
        let refuse = |layout: GridLayout, values: &[f64]| write_raster(&mut Vec::new(), &layout, values).unwrap_err();
        assert!(matches!(refuse(LAYOUT, &[0.0; 5]), EncodeError::GridSize { values: 5, .. }));
        assert!(matches!(refuse(GridLayout { columns: 0, ..LAYOUT }, &[]), EncodeError::GridSize { .. }));
        assert!(matches!(
            refuse(LAYOUT, &[0.0, 0.0, 0.0, f64::INFINITY, 0.0, 0.0]),
            EncodeError::NotFinite { what: "grid value", index: 4, .. }
        ));
        assert!(matches!(refuse(GridLayout { x: f64::NAN, ..LAYOUT }, &[0.0; 6]), EncodeError::NotFinite { .. }));
    }
}
