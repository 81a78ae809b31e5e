//! ESRI ASCII grids.

use super::EncodeError;
use super::number::push_f64;
use super::obj::flush_if_full;
use std::io::Write;

/// Value of nodes without a height.
pub const NO_DATA: f64 = -9999.0;

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

/// Writes an ESRI ASCII grid. `values` runs row by row from north to south, each row from west to east; NaN stands for a node
/// without a height and is written as [`NO_DATA`].
///
/// # Errors
/// [`EncodeError::Io`] from the sink, [`EncodeError::GridSize`] unless there is one value per cell,
/// [`EncodeError::NotFinite`] for an infinite value.
pub fn write_raster(out: &mut (impl Write + ?Sized), layout: &GridLayout, values: &[f64]) -> Result<(), EncodeError> {
    let GridLayout { columns, rows, x, y, anchor, cell } = *layout;
    if columns == 0 || columns.checked_mul(rows) != Some(values.len()) {
        return Err(EncodeError::GridSize { columns, rows, values: values.len() });
    }
    let suffix = match anchor {
        Anchor::Corner => "corner",
        Anchor::Center => "center",
    };
    let mut bytes = format!("ncols {columns}\nnrows {rows}\n").into_bytes();
    for (index, (key, value)) in
        [(format!("xll{suffix}"), x), (format!("yll{suffix}"), y), ("cellsize".into(), cell)].into_iter().enumerate()
    {
        if !value.is_finite() {
            return Err(EncodeError::NotFinite { what: "figure of the grid's origin and cell", index: index + 1, value });
        }
        bytes.extend_from_slice(key.as_bytes());
        bytes.push(b' ');
        push_f64(&mut bytes, value);
        bytes.push(b'\n');
    }
    bytes.extend_from_slice(b"NODATA_value ");
    push_f64(&mut bytes, NO_DATA);
    bytes.push(b'\n');
    for (r, row) in values.chunks_exact(columns).enumerate() {
        for (c, &value) in row.iter().enumerate() {
            if value.is_infinite() {
                return Err(EncodeError::NotFinite { what: "grid value", index: r * columns + c + 1, value });
            }
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
