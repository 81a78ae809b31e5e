//! Rasters and point clouds as ground, and the works as rasters: every flavour of the formats, damage, and round trips. The
//! files are made here, byte by byte or by other packages.

#[cfg(feature = "las")]
mod cloud;
#[cfg(feature = "geotiff")]
mod elevation;
#[cfg(feature = "geotiff")]
mod hostile;
#[cfg(feature = "geotiff")]
mod maker;
#[cfg(feature = "geotiff")]
mod output;
mod without;

use slopegen::read::terrain::{RawTerrain, TerrainOptions, parse_terrain};
use slopegen::read::{InputFormat, Pick};

/// Reads ground; the message where it is refused.
fn ground(format: InputFormat, bytes: &[u8], classes: &[u8]) -> Result<RawTerrain, String> {
    let pick = Pick { classes: classes.to_vec(), ..Pick::default() };
    parse_terrain("a", bytes, &TerrainOptions { pick, ..TerrainOptions::of(format) }).map_err(|e| e.to_string())
}

/// The codes of notes.
#[cfg(any(feature = "geotiff", feature = "las"))]
fn codes(notes: &[slopegen::model::Note]) -> Vec<&'static str> {
    notes.iter().map(|note| note.code).collect()
}

/// Sound whatever it is: all coordinates finite, all values that are there in their place.
#[cfg(any(feature = "geotiff", feature = "las"))]
fn sound(raw: &RawTerrain) {
    use slopegen::read::terrain::RawGround;
    match &raw.ground {
        RawGround::Grid(grid) => {
            assert_eq!(grid.heights.len(), grid.columns * grid.rows);
            assert!(grid.step.cmpgt(glam::DVec2::ZERO).all() && grid.origin.is_finite());
            assert!(grid.heights.iter().all(|z| !z.is_infinite()));
        }
        RawGround::Points(points) => assert!(points.iter().all(|point| point.is_finite()) && !points.is_empty()),
        RawGround::Mesh { .. } => panic!("a mesh"),
    }
}
