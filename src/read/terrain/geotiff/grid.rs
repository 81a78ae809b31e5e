//! From a GeoTIFF to a grid of heights.

use super::super::geokeys::{GeoKeys, Model, Unit};
use super::super::{NO_HEIGHT, RawGrid, RawGround, Said};
use super::directory::{Directory, Tiff};
use super::image::Image;
use super::metadata::{self, Metadata};
use super::place::Place;
use crate::model::{Memory, Note};
use crate::read::error::{clip, refuse};
use crate::read::{ReadError, room};

/// Most images of a file that are looked at.
const MOST_IMAGES: usize = 256;

/// The images of a file that matter.
struct Images<'a> {
    /// The first in full resolution.
    main: Directory<'a>,
    /// The mask that belongs to it: cells that have no height.
    mask: Option<Directory<'a>>,
    /// Further images in full resolution.
    others: usize,
}

/// Reads ground.
pub(super) fn read(label: &str, bytes: &[u8], memory: &Memory, notes: &mut Vec<Note>) -> Result<(RawGround, Said), ReadError> {
    let (tiff, first) = Tiff::open(label, bytes)?;
    let images = images(&tiff, first)?;
    let main = &images.main;
    not_a_picture(label, main)?;
    let image = Image::new(tiff, main)?;
    let place = Place::read(&tiff, main)?;
    let keys = keys(main)?;
    if keys.is_none() {
        let message = "the raster has no GeoTIFF keys: its reference system is not known, and its values are taken for the \
                       middle of their cells";
        notes.push(Note::new("raster-no-keys", message));
    }
    let mut keys = keys.unwrap_or_default();
    if keys.model == Model::Geocentric {
        let help =
            format!("project it, e.g. `gdalwarp -t_srs EPSG:25832 {label} projected.tif`, with the EPSG code of your grid");
        return Err(refuse("the raster is in geocentric coordinates", label, "no plan coordinates", &help));
    }
    if image.bands > 1 {
        notes.push(Note::new("raster-bands", format!("the raster has {} bands: the heights are those of band 1", image.bands)));
    }
    if images.others > 0 {
        let message = format!("the file holds {} images: the first is read", images.others + 1);
        notes.push(Note::new("raster-images", message));
    }
    let metadata = Metadata::read(main.text(42112)?.unwrap_or(b""));
    if keys.heights == Unit::Unsaid {
        keys.heights = metadata.unit;
    }
    let (said, factor) = keys.settle(notes);
    room::for_cells(label, bytes.len(), image.cells(), memory)?;
    let mut heights = image.read()?;
    let no_data = main.text(42113)?.map(metadata::no_data);
    let marker = match no_data {
        Some(Ok(number)) => image.sample.nearest(number),
        Some(Err(text)) => {
            let message = format!("the value that stands for no height cannot be understood: `{}`", clip(text));
            notes.push(Note::new("raster-no-data", message));
            f64::NAN
        }
        None => f64::NAN,
    };
    let (scale, offset) = (metadata.scale, metadata.offset);
    let scaled = scale != 1.0 || offset != 0.0;
    if scaled {
        let message = format!("the values of the raster are scaled, as it says: height = value · {scale} + {offset}");
        notes.push(Note::new("raster-scaled", message));
    }
    for value in &mut heights {
        let none = *value == marker || !value.is_finite() || value.abs() >= NO_HEIGHT;
        let height = if scaled || factor != 1.0 { (*value * scale + offset) * factor } else { *value };
        *value = if none || !height.is_finite() { f64::NAN } else { height };
    }
    if let Some(mask) = &images.mask {
        apply(&tiff, mask, &image, &mut heights)?;
    }
    if place.upside_down() {
        let rows = image.height;
        for row in 0..rows / 2 {
            let (above, below) = heights.split_at_mut((rows - 1 - row) * image.width);
            above[row * image.width..(row + 1) * image.width].swap_with_slice(&mut below[..image.width]);
        }
    }
    let origin = place.origin(image.height, keys.at_points);
    let grid = RawGrid { columns: image.width, rows: image.height, origin, step: place.step(), heights };
    Ok((RawGround::Grid(grid), said))
}

/// Finds the images that matter. Overviews, smaller copies of the first, are passed over in silence.
fn images<'a>(tiff: &Tiff<'a>, first: u64) -> Result<Images<'a>, ReadError> {
    let mut seen = Vec::new();
    let (mut main, mut mask, mut others) = (None, None, 0);
    let mut next = first;
    while next != 0 && seen.len() < MOST_IMAGES && !seen.contains(&next) {
        seen.push(next);
        let read = tiff.directory(next);
        // Without the first image nothing can be read; damage behind it does not matter.
        let (directory, after) = match read {
            Ok(found) => found,
            Err(error) if main.is_none() => return Err(error),
            Err(_) => break,
        };
        let kind = directory.whole(254)?.unwrap_or(0);
        let (reduced, masks) = (kind & 1 != 0, kind & 4 != 0);
        if masks && !reduced && main.is_some() {
            mask = mask.or(Some(directory));
        } else if !reduced && !masks {
            if main.is_none() {
                main = Some(directory);
            } else {
                others += 1;
            }
        }
        next = after;
    }
    let main = main.ok_or_else(|| {
        refuse("the GeoTIFF has no image in full resolution", tiff.label, "only overviews and masks", "export the file again")
    })?;
    Ok(Images { main, mask, others })
}

/// Refuses colours: their values are no heights.
fn not_a_picture(label: &str, directory: &Directory<'_>) -> Result<(), ReadError> {
    let kind = match directory.whole(262)? {
        Some(2) => "red, green and blue",
        Some(3) => "colours by number",
        Some(5) => "printing colours",
        Some(6) => "brightness and colour",
        _ => return Ok(()),
    };
    Err(refuse("the GeoTIFF is a picture", label, format!("it holds {kind}"), "give the elevations, not a picture of them"))
}

fn keys(directory: &Directory<'_>) -> Result<Option<GeoKeys>, ReadError> {
    let Some(wholes) = directory.wholes(34735)? else { return Ok(None) };
    // More keys than there are numbers for them do not exist.
    let words: Vec<u16> =
        (0..wholes.len().min(usize::from(u16::MAX))).filter_map(|i| wholes.get(i)).map(|word| word as u16).collect();
    Ok(Some(GeoKeys::new(&words, &directory.doubles(34736)?, directory.text(34737)?.unwrap_or(b""))))
}

/// Takes away the heights of cells that the mask leaves out.
fn apply<'a>(tiff: &Tiff<'a>, mask: &Directory<'a>, image: &Image<'_>, heights: &mut [f64]) -> Result<(), ReadError> {
    let found = Image::new(*tiff, mask)?;
    if (found.width, found.height) != (image.width, image.height) {
        let figures = format!("{} × {} cells, its mask {} × {}", image.width, image.height, found.width, found.height);
        return Err(refuse("the mask of the GeoTIFF has another size", tiff.label, figures, "export the file again"));
    }
    for (height, used) in heights.iter_mut().zip(found.read()?) {
        // Parts of a mask that are left out of the file hide their cells.
        if used.is_nan() || used == 0.0 {
            *height = f64::NAN;
        }
    }
    Ok(())
}
