//! Makes GeoTIFF files of every flavour, by the letter of the standard and without the program's own code.

use std::io::Write as _;

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    U8,
    I8,
    U16,
    I16,
    U32,
    I32,
    F32,
    F64,
}

impl Kind {
    pub(crate) const ALL: [Self; 8] = [Self::U8, Self::I8, Self::U16, Self::I16, Self::U32, Self::I32, Self::F32, Self::F64];

    pub(crate) fn size(self) -> usize {
        match self {
            Self::U8 | Self::I8 => 1,
            Self::U16 | Self::I16 => 2,
            Self::U32 | Self::I32 | Self::F32 => 4,
            Self::F64 => 8,
        }
    }

    fn format(self) -> u32 {
        match self {
            Self::U8 | Self::U16 | Self::U32 => 1,
            Self::I8 | Self::I16 | Self::I32 => 2,
            Self::F32 | Self::F64 => 3,
        }
    }

    pub(crate) fn is_float(self) -> bool {
        self.format() == 3
    }

    /// Big-endian bytes.
    fn bytes(self, value: f64) -> Vec<u8> {
        match self {
            Self::U8 => vec![value as u8],
            Self::I8 => (value as i8).to_be_bytes().to_vec(),
            Self::U16 => (value as u16).to_be_bytes().to_vec(),
            Self::I16 => (value as i16).to_be_bytes().to_vec(),
            Self::U32 => (value as u32).to_be_bytes().to_vec(),
            Self::I32 => (value as i32).to_be_bytes().to_vec(),
            Self::F32 => (value as f32).to_be_bytes().to_vec(),
            Self::F64 => value.to_be_bytes().to_vec(),
        }
    }
}

/// A file to be made.
#[derive(Clone, Debug)]
pub(crate) struct Maker {
    pub(crate) big: bool,
    pub(crate) wide: bool,
    pub(crate) columns: usize,
    pub(crate) rows: usize,
    /// Columns and rows of tiles; rows of strips.
    pub(crate) tile: Option<(usize, usize)>,
    pub(crate) strip: usize,
    pub(crate) kind: Kind,
    pub(crate) bands: usize,
    pub(crate) planar: bool,
    /// 1, 5, 8 or 32773.
    pub(crate) compression: u32,
    pub(crate) predictor: u32,
    /// Further tags: number, type, bytes of each value big-endian.
    pub(crate) tags: Vec<(u16, u16, Vec<Vec<u8>>)>,
    /// Strips or tiles to leave out.
    pub(crate) sparse: Vec<usize>,
}

/// Keys of a projected system in metres, for areas.
pub(crate) const KEYS: [u32; 16] = [1, 1, 0, 3, 1024, 0, 1, 1, 1025, 0, 1, 1, 3072, 0, 1, 25832];

impl Maker {
    /// Five by seven cells of 10 by 20, the corner at 500 000, 5 400 000.
    pub(crate) fn new(kind: Kind) -> Self {
        let maker = Self {
            big: false,
            wide: false,
            columns: 5,
            rows: 7,
            tile: None,
            strip: 7,
            kind,
            bands: 1,
            planar: false,
            compression: 1,
            predictor: 1,
            tags: Vec::new(),
            sparse: Vec::new(),
        };
        maker.doubles(33550, &[10.0, 20.0, 0.0]).doubles(33922, &[0.0, 0.0, 0.0, 5e5, 5.4e6, 0.0]).shorts(34735, &KEYS)
    }

    pub(crate) fn without(mut self, tag: u16) -> Self {
        self.tags.retain(|(number, ..)| *number != tag);
        self
    }

    fn with(mut self, tag: u16, kind: u16, values: Vec<Vec<u8>>) -> Self {
        self = self.without(tag);
        self.tags.push((tag, kind, values));
        self
    }

    pub(crate) fn doubles(self, tag: u16, values: &[f64]) -> Self {
        self.with(tag, 12, values.iter().map(|v| v.to_be_bytes().to_vec()).collect())
    }

    pub(crate) fn shorts(self, tag: u16, values: &[u32]) -> Self {
        self.with(tag, 3, values.iter().map(|v| (*v as u16).to_be_bytes().to_vec()).collect())
    }

    pub(crate) fn text(self, tag: u16, text: &str) -> Self {
        self.with(tag, 2, text.bytes().chain([0]).map(|b| vec![b]).collect())
    }

    /// One strip or tile: values of all its samples, row by row → bytes as stored.
    fn pack(&self, rows: &[Vec<f64>], samples: usize) -> Vec<u8> {
        let size = self.kind.size();
        let mut bytes = Vec::new();
        for row in rows {
            let mut values: Vec<Vec<u8>> = row.iter().map(|v| self.kind.bytes(*v)).collect();
            match self.predictor {
                2 => {
                    for i in (samples..values.len()).rev() {
                        let number = |bytes: &[u8]| bytes.iter().fold(0_u64, |n, b| n << 8 | u64::from(*b));
                        let difference = number(&values[i]).wrapping_sub(number(&values[i - samples]));
                        values[i] = difference.to_be_bytes()[8 - size..].to_vec();
                    }
                }
                3 => {
                    let mut planes: Vec<u8> = (0..size).flat_map(|b| values.iter().map(move |v| v[b])).collect();
                    for i in (samples..planes.len()).rev() {
                        planes[i] = planes[i].wrapping_sub(planes[i - samples]);
                    }
                    bytes.extend(planes);
                    continue;
                }
                _ => {}
            }
            for mut value in values {
                if !self.big {
                    value.reverse();
                }
                bytes.extend(value);
            }
        }
        match self.compression {
            5 => weezl::encode::Encoder::with_tiff_size_switch(weezl::BitOrder::Msb, 8).encode(&bytes).unwrap(),
            8 => {
                let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
                encoder.write_all(&bytes).unwrap();
                encoder.finish().unwrap()
            }
            // Plain stretches and, of what is alike, runs.
            32773 => bytes
                .chunk_by(|a, b| a == b)
                .flat_map(|run| run.chunks(128))
                .flat_map(|run| if run.len() > 1 { vec![(257 - run.len()) as u8, run[0]] } else { vec![0, run[0]] })
                .collect(),
            _ => bytes,
        }
    }

    /// The file whose first band has `value(column, row)`, further bands other numbers.
    pub(crate) fn make(&self, value: impl Fn(usize, usize) -> f64) -> Vec<u8> {
        let at = |band: usize, column: usize, row: usize| {
            let inside = column < self.columns && row < self.rows;
            if !inside {
                0.0
            } else if band == 0 {
                value(column, row)
            } else {
                99.0
            }
        };
        let (wide, high) = self.tile.unwrap_or((self.columns, self.strip));
        let mut chunks = Vec::new();
        for plane in 0..if self.planar { self.bands } else { 1 } {
            for top in (0..self.rows).step_by(high) {
                for left in (0..self.columns).step_by(wide) {
                    let high = if self.tile.is_some() { high } else { high.min(self.rows - top) };
                    let bands = if self.planar { plane..plane + 1 } else { 0..self.bands };
                    let rows: Vec<Vec<f64>> = (top..top + high)
                        .map(|row| {
                            (left..left + wide)
                                .flat_map(|column| bands.clone().map(move |band| (band, column)))
                                .map(|(band, column)| at(band, column, row))
                                .collect()
                        })
                        .collect();
                    let bytes = self.pack(&rows, bands.len());
                    chunks.push(if self.sparse.contains(&chunks.len()) { Vec::new() } else { bytes });
                }
            }
        }
        let long = |values: Vec<u64>| (if self.wide { 16 } else { 4 }, values);
        let mut tags: Vec<(u16, u16, Vec<Vec<u8>>)> = self.tags.clone();
        let mut put = |tag: u16, (kind, values): (u16, Vec<u64>)| {
            let size = match kind {
                3 => 2,
                4 => 4,
                _ => 8,
            };
            tags.push((tag, kind, values.iter().map(|v| v.to_be_bytes()[8 - size..].to_vec()).collect()));
        };
        put(256, (4, vec![self.columns as u64]));
        put(257, (4, vec![self.rows as u64]));
        put(258, (3, vec![8 * self.kind.size() as u64; self.bands]));
        put(259, (3, vec![u64::from(self.compression)]));
        put(262, (3, vec![1]));
        put(277, (3, vec![self.bands as u64]));
        put(284, (3, vec![if self.planar { 2 } else { 1 }]));
        put(317, (3, vec![u64::from(self.predictor)]));
        put(339, (3, vec![u64::from(self.kind.format()); self.bands]));
        let places = if self.tile.is_some() { (324, 325) } else { (273, 279) };
        put(places.0, long(vec![0; chunks.len()]));
        put(places.1, long(chunks.iter().map(|c| c.len() as u64).collect()));
        match self.tile {
            Some((wide, high)) => {
                put(322, (3, vec![wide as u64]));
                put(323, (3, vec![high as u64]));
            }
            None => put(278, (3, vec![self.strip as u64])),
        }
        tags.sort_by_key(|(tag, ..)| *tag);
        let (word, entry, inline, head) = if self.wide { (8, 20, 8, 16) } else { (2, 12, 4, 8) };
        let mut from = head + word + entry * tags.len() + inline;
        from += tags.iter().map(|t| t.2.concat().len()).filter(|n| *n > inline).sum::<usize>();
        let mut offsets = Vec::new();
        for chunk in &chunks {
            offsets.push(if chunk.is_empty() { 0 } else { from as u64 });
            from += chunk.len();
        }
        if let Some(tag) = tags.iter_mut().find(|t| t.0 == places.0) {
            tag.2 = offsets.iter().map(|v| v.to_be_bytes()[if self.wide { 0 } else { 4 }..].to_vec()).collect();
        }
        let order = |mut bytes: Vec<u8>| {
            if !self.big {
                bytes.reverse();
            }
            bytes
        };
        let number = |value: u64, size: usize| order(value.to_be_bytes()[8 - size..].to_vec());
        let mut file = if self.big { b"MM".to_vec() } else { b"II".to_vec() };
        file.extend(number(if self.wide { 43 } else { 42 }, 2));
        if self.wide {
            file.extend(number(8, 2));
            file.extend(number(0, 2));
        }
        file.extend(number(head as u64, inline));
        file.extend(number(tags.len() as u64, word));
        let mut behind = Vec::new();
        for (tag, kind, values) in &tags {
            file.extend(number(u64::from(*tag), 2));
            file.extend(number(u64::from(*kind), 2));
            file.extend(number(values.len() as u64, inline));
            let bytes: Vec<u8> = values.iter().flat_map(|value| order(value.clone())).collect();
            if bytes.len() <= inline {
                file.extend(&bytes);
                file.resize(file.len() + inline - bytes.len(), 0);
            } else {
                file.extend(number((head + word + entry * tags.len() + inline + behind.len()) as u64, inline));
                behind.extend(bytes);
            }
        }
        file.extend(number(0, inline));
        file.extend(behind);
        chunks.iter().for_each(|chunk| file.extend(chunk));
        file
    }
}
