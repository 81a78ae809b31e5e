//! Where the cells of a GeoTIFF lie (OGC GeoTIFF 1.1, section 7.4 and annex B.6).

use super::directory::{Directory, Tiff};
use crate::read::ReadError;
use crate::read::error::refuse;
use glam::DVec2;

/// Turned by less than this share of the size of a cell is not turned: what is left of decimal fractions.
const UPRIGHT: f64 = 1e-9;

/// Place of the grid: the point at the upper left of the first cell, or its centre for values at points, and the way from
/// column to column and from row to row.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Place {
    /// Position of column and row 0.
    corner: DVec2,
    /// Size of a cell; `y` is negative where rows run to the north.
    size: DVec2,
}

impl Place {
    /// From the tags of an image.
    pub(super) fn read(tiff: &Tiff<'_>, directory: &Directory<'_>) -> Result<Self, ReadError> {
        let label = tiff.label;
        let (scale, ties) = (directory.doubles(33550)?, directory.doubles(33922)?);
        let matrix = directory.doubles(34264)?;
        let place = if let (&[sx, sy, ..], &[i, j, _, x, y, ..]) = (&scale[..], &ties[..]) {
            Self { corner: DVec2::new(x - i * sx, y + j * sy), size: DVec2::new(sx, sy) }
        } else if let &[a, b, _, x, d, e, _, y, ..] = &matrix[..] {
            if b.abs() > UPRIGHT * a.abs() || d.abs() > UPRIGHT * e.abs() {
                let figures = format!("a step along a row: ({a}, {d}), along a column: ({b}, {e})");
                let help = format!("turn it upright, e.g. `gdalwarp {label} upright.tif`");
                return Err(refuse("the raster is turned against its coordinates", label, figures, &help));
            }
            Self { corner: DVec2::new(x, y), size: DVec2::new(a, -e) }
        } else if ties.len() > 6 {
            let figures = format!("{} control points, and no size of the cells", ties.len() / 6);
            let help = format!("bring it into place, e.g. `gdalwarp {label} upright.tif`");
            return Err(refuse("the raster is only tied to control points", label, figures, &help));
        } else {
            let help = format!("give it a place, e.g. `gdal_translate -a_ullr XMIN YMAX XMAX YMIN {label} ground.tif`");
            return Err(refuse("the raster does not say where it lies", label, "no tie point and no transformation", &help));
        };
        let sound = place.corner.is_finite() && place.size.is_finite() && place.size.x > 0.0 && place.size.y != 0.0;
        if !sound {
            let figures = format!("cells of {} by {}, from ({}, {})", place.size.x, place.size.y, place.corner.x, place.corner.y);
            return Err(refuse("the cells of the raster have no size or no place", label, figures, "export the file again"));
        }
        Ok(place)
    }

    /// Whether rows run from south to north.
    pub(super) fn upside_down(&self) -> bool {
        self.size.y < 0.0
    }

    /// Distance of the nodes, both positive.
    pub(super) fn step(&self) -> DVec2 {
        self.size.abs()
    }

    /// The south-west node of `rows` rows. Values for areas stand at the centres of the cells.
    pub(super) fn origin(&self, rows: usize, at_points: bool) -> DVec2 {
        let half = if at_points { 0.0 } else { 0.5 };
        let lowest = if self.upside_down() { 0.0 } else { rows.saturating_sub(1) as f64 };
        self.corner + DVec2::new(half, -(lowest + half)) * self.size
    }
}
