//! One image of a TIFF file: how it is cut up and packed, and its first band as numbers.

use super::directory::{Directory, Tiff, Wholes};
use super::unpack::{Compression, MOST_EXPANSION, Predictor, Sample};
use crate::read::ReadError;
use crate::read::error::refuse;
use rayon::prelude::*;

/// Most cells of a grid: their heights take 8 bytes each, 0.8 GB.
pub(super) const MOST_CELLS: u64 = 100_000_000;

/// Most bytes of one strip or tile when unpacked: all cells in one, in double precision.
const MOST_BYTES: u64 = 8 * MOST_CELLS;

/// Most bytes of all strips and tiles when unpacked, what stands over the edges of the image and other bands among them.
const MOST_TOTAL: u64 = 10 * MOST_BYTES;

/// Strips and tiles larger than this, in bytes, are unpacked one after the other: each thread would hold one.
const LARGE: usize = 1 << 26;

const AGAIN: &str = "copy or export the file again";

/// The layout of an image.
pub(super) struct Image<'a> {
    tiff: Tiff<'a>,
    pub(super) width: usize,
    pub(super) height: usize,
    /// Bands.
    pub(super) bands: u64,
    pub(super) sample: Sample,
    /// Size of tiles; of strips the width of the image and the rows of one.
    cell: [usize; 2],
    /// Whether they are tiles, which are never shortened at the edges.
    tiles: bool,
    /// Samples beside each other for one pixel.
    samples: usize,
    compression: Compression,
    predictor: Predictor,
    offsets: Wholes<'a>,
    counts: Option<Wholes<'a>>,
}

impl<'a> Image<'a> {
    /// Number of its cells.
    pub(super) fn cells(&self) -> u64 {
        self.width as u64 * self.height as u64
    }

    /// Reads the layout and refuses what cannot be read, before anything is reserved.
    pub(super) fn new(tiff: Tiff<'a>, directory: &Directory<'a>) -> Result<Self, ReadError> {
        let label = tiff.label;
        let get = |tag: u16, default: u64| directory.whole(tag).map(|value| value.unwrap_or(default));
        let (width, height) = (get(256, 0)?, get(257, 0)?);
        if width == 0 || height == 0 {
            return Err(refuse("the GeoTIFF has no cells", label, format!("{width} columns and {height} rows"), AGAIN));
        }
        if width.checked_mul(height).is_none_or(|cells| cells > MOST_CELLS) {
            let figures = format!("{width} columns and {height} rows; at most {MOST_CELLS} cells are read");
            let help =
                format!("cut out the part around the works, e.g. `gdal_translate -projwin XMIN YMAX XMAX YMIN {label} part.tif`");
            return Err(refuse("the raster is too large", label, figures, &help));
        }
        let compression = Compression::of(get(259, 1)?).map_err(|name| {
            let figures = format!("compression: {name}; read are none, LZW, deflate and PackBits");
            let help = format!("pack it another way, e.g. `gdal_translate -co COMPRESS=DEFLATE {label} ground.tif`");
            refuse("the compression of the GeoTIFF is not read", label, figures, &help)
        })?;
        let (bits, format, bands) = (get(258, 1)?, get(339, 1)?, get(277, 1)?.max(1));
        let same =
            |wholes: Option<Wholes<'_>>| wholes.is_none_or(|w| (1..w.len().min(bands as usize)).all(|i| w.get(i) == w.get(0)));
        let planar = get(284, 1)? == 2;
        let alike = planar || same(directory.wholes(258)?);
        let sample = Sample::of(bits, format).filter(|_| alike);
        let sample = sample.ok_or_else(|| {
            let figures = format!(
                "{bits} bits, sample format {format}; read are whole numbers of 8, 16, 32 bits and floating ones of 32, 64"
            );
            let help = format!("convert it, e.g. `gdal_translate -ot Float64 {label} ground.tif`");
            refuse("the numbers of the GeoTIFF are of a kind that is not read", label, figures, &help)
        })?;
        let predictor = match get(317, 1)? {
            1 => Predictor::None,
            2 if sample != Sample::Bit => Predictor::Difference,
            3 if matches!(sample, Sample::Single | Sample::Double) => Predictor::Floating,
            other => {
                let help = format!("write it without, e.g. `gdal_translate -co COMPRESS=DEFLATE {label} ground.tif`");
                return Err(refuse("the predictor of the GeoTIFF is not read", label, format!("predictor {other}"), &help));
            }
        };
        if get(266, 1)? != 1 {
            let figures = "bits are stored the other way round (fill order 2)";
            let help = format!("rewrite it, e.g. `gdal_translate {label} ground.tif`");
            return Err(refuse("the bit order of the GeoTIFF is not read", label, figures, &help));
        }
        let samples = if planar { 1 } else { bands };
        let tile = (directory.whole(322)?, directory.whole(323)?);
        let tiles = matches!(tile, (Some(_), Some(_)));
        let (cell, offsets, counts) = match tile {
            (Some(wide), Some(high)) => ([wide, high], directory.wholes(324)?, directory.wholes(325)?),
            _ => ([width, get(278, height)?.min(height)], directory.wholes(273)?, directory.wholes(279)?),
        };
        // Offsets and sizes of tiles may stand under the tags of strips.
        let offsets = if let Some(offsets) = offsets { Some(offsets) } else { directory.wholes(273)? };
        let counts = if let Some(counts) = counts { Some(counts) } else { directory.wholes(279)? };
        let Some(offsets) = offsets else {
            return Err(refuse("the GeoTIFF does not say where its cells are", label, "no strips and no tiles", AGAIN));
        };
        let bytes = cell[0].checked_mul(samples).and_then(|n| n.checked_mul(sample.bits())).map(|bits| bits.div_ceil(8));
        let bytes = bytes.and_then(|row| row.checked_mul(cell[1])).filter(|bytes| (1..=MOST_BYTES).contains(bytes));
        if bytes.is_none() {
            let figures = format!("{} by {} cells of {samples} times {} bits", cell[0], cell[1], sample.bits());
            return Err(refuse("the strips or tiles of the GeoTIFF are of an impossible size", label, figures, AGAIN));
        }
        let image = Self {
            tiff,
            width: width as usize,
            height: height as usize,
            bands,
            sample,
            cell: cell.map(|n| n as usize),
            tiles,
            samples: samples as usize,
            compression,
            predictor,
            offsets,
            counts,
        };
        let needed = image.across() * image.height.div_ceil(image.cell[1]);
        let there = image.offsets.len();
        let all = (image.row_bytes() * image.cell[1]) as u64 * needed as u64;
        if all > MOST_TOTAL {
            let figures = format!("{all} bytes when unpacked; at most {MOST_TOTAL} are read");
            let help =
                format!("take the band of the heights alone, e.g. `gdal_translate -b 1 -co COMPRESS=DEFLATE {label} ground.tif`");
            return Err(refuse("the GeoTIFF is too large", label, figures, &help));
        }
        if there < needed {
            let figures = format!("{needed} are needed, {there} are there");
            return Err(refuse("strips or tiles of the GeoTIFF are missing", label, figures, AGAIN));
        }
        // Everything that is to be unpacked is there, before room is made for it.
        let mut any = false;
        for number in 0..needed {
            any |= image.packed(number)?.is_some();
        }
        if !any {
            return Err(refuse("the GeoTIFF is empty", label, "none of its strips and tiles is in the file", AGAIN));
        }
        Ok(image)
    }

    /// Strips or tiles beside each other.
    fn across(&self) -> usize {
        self.width.div_ceil(self.cell[0])
    }

    /// Rows of a strip or tile, as stored.
    fn rows(&self, number: usize) -> usize {
        let first = number / self.across() * self.cell[1];
        if self.tiles { self.cell[1] } else { self.cell[1].min(self.height - first) }
    }

    fn row_bytes(&self) -> usize {
        (self.cell[0] as u64 * self.samples as u64 * self.sample.bits()).div_ceil(8) as usize
    }

    /// The packed bytes of a strip or tile; `None` if it is left out of the file: it has no heights then.
    fn packed(&self, number: usize) -> Result<Option<&'a [u8]>, ReadError> {
        let size = (self.row_bytes() * self.rows(number)) as u64;
        let bytes = self.tiff.bytes;
        let from = self.offsets.get(number).unwrap_or(0);
        let rest = (bytes.len() as u64).saturating_sub(from);
        let count = match self.counts {
            Some(counts) => counts.get(number).unwrap_or(0),
            None if self.compression == Compression::Plain => size,
            None => rest,
        };
        if from == 0 || count == 0 {
            return Ok(None);
        }
        let what = if self.tiles { "tile" } else { "strip" };
        if count > rest {
            return Err(self.tiff.cut_off(&format!("{what} {} of {count} bytes at {from}", number + 1)));
        }
        let most = if self.compression == Compression::Plain { 1 } else { MOST_EXPANSION };
        if size / most > count {
            return Err(self.short(number, format!("{count} bytes packed")));
        }
        Ok(bytes.get(from as usize..(from + count) as usize))
    }

    fn short(&self, number: usize, found: String) -> ReadError {
        let what = if self.tiles { "tile" } else { "strip" };
        let figures = format!("{what} {}: {found}, but {} bytes are needed", number + 1, self.row_bytes() * self.rows(number));
        refuse("the GeoTIFF is damaged: a part of it is shorter than it should be", self.tiff.label, figures, AGAIN)
    }

    fn no_room(&self) -> ReadError {
        let figures = format!("{} columns and {} rows", self.width, self.height);
        refuse("there is not enough memory for the raster", self.tiff.label, figures, "give a smaller one")
    }

    /// The first band, row by row from the top; NaN where the file leaves strips or tiles out.
    pub(super) fn read(&self) -> Result<Vec<f64>, ReadError> {
        let cells = self.width * self.height;
        let mut values: Vec<f64> = Vec::new();
        values.try_reserve_exact(cells).map_err(|_| self.no_room())?;
        values.resize(cells, f64::NAN);
        let fill = |(band, rows): (usize, &mut [f64])| {
            let mut bytes = Vec::new();
            (0..self.across()).try_for_each(|column| self.place(band * self.across() + column, column, rows, &mut bytes))
        };
        let band = self.width * self.cell[1];
        // All results are kept, so that the first error is told and not any.
        let done: Vec<Result<(), ReadError>> = if self.row_bytes() * self.cell[1] > LARGE {
            values.chunks_mut(band).enumerate().map(fill).collect()
        } else {
            values.par_chunks_mut(band).enumerate().map(fill).collect()
        };
        done.into_iter().collect::<Result<(), ReadError>>()?;
        Ok(values)
    }

    /// Unpacks one strip or tile into the rows it stands in.
    fn place(&self, number: usize, column: usize, rows: &mut [f64], bytes: &mut Vec<u8>) -> Result<(), ReadError> {
        let Some(packed) = self.packed(number)? else { return Ok(()) };
        let row_bytes = self.row_bytes();
        let size = row_bytes * self.rows(number);
        bytes.clear();
        bytes.try_reserve_exact(size).map_err(|_| self.no_room())?;
        bytes.resize(size, 0);
        let filled = self.compression.unpack(packed, bytes);
        if filled < bytes.len() {
            return Err(self.short(number, format!("{filled} bytes unpacked")));
        }
        let from = column * self.cell[0];
        let wide = self.cell[0].min(self.width - from);
        let mut spare = Vec::new();
        for (row, stored) in rows.chunks_exact_mut(self.width).zip(bytes.chunks_exact_mut(row_bytes)) {
            let big = self.sample.predicted(self.predictor, stored, self.samples, self.tiff.big, &mut spare);
            for (i, value) in row[from..from + wide].iter_mut().enumerate() {
                *value = self.sample.value(stored, i * self.samples, big).unwrap_or(f64::NAN);
            }
        }
        Ok(())
    }
}
