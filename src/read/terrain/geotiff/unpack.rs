//! Packed bytes of one strip or tile → its samples: compressions, predictors, numbers.

use super::super::single::single;
use super::directory::whole;
use std::io::Read;

/// The most bytes one packed byte can stand for: a string of 4096 bytes for a code of 12 bits (LZW); deflate and PackBits do
/// not reach that. What claims more is shorter than it says.
pub(super) const MOST_EXPANSION: u64 = 4096 * 2 / 3;

/// How the bytes of a strip or tile are packed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Compression {
    Plain,
    Lzw,
    Deflate,
    PackBits,
}

impl Compression {
    /// By its number in the file; the name of one that is not read.
    pub(super) fn of(number: u64) -> Result<Self, String> {
        Err(match number {
            1 => return Ok(Self::Plain),
            5 => return Ok(Self::Lzw),
            8 | 32946 => return Ok(Self::Deflate),
            32773 => return Ok(Self::PackBits),
            2..=4 => "CCITT fax".into(),
            6 | 7 => "JPEG".into(),
            33003 | 33005 | 34712 => "JPEG 2000".into(),
            34887 => "LERC".into(),
            34925 => "LZMA".into(),
            50000 => "Zstandard".into(),
            50001 => "WebP".into(),
            50002 | 52546 => "JPEG XL".into(),
            other => format!("number {other}"),
        })
    }

    /// Fills `out` from the beginning of what is packed; what follows is left. Gives how many bytes there were.
    pub(super) fn unpack(self, packed: &[u8], out: &mut [u8]) -> usize {
        match self {
            Self::Plain => {
                let count = packed.len().min(out.len());
                out[..count].copy_from_slice(&packed[..count]);
                count
            }
            Self::Deflate => {
                let mut decoder = flate2::read::ZlibDecoder::new(packed);
                let mut filled = 0;
                while filled < out.len() {
                    match decoder.read(&mut out[filled..]) {
                        Ok(0) | Err(_) => break,
                        Ok(count) => filled += count,
                    }
                }
                filled
            }
            Self::Lzw => {
                let mut decoder = weezl::decode::Decoder::with_tiff_size_switch(weezl::BitOrder::Msb, 8);
                let (mut taken, mut filled) = (0, 0);
                while filled < out.len() {
                    let step = decoder.decode_bytes(&packed[taken..], &mut out[filled..]);
                    taken += step.consumed_in;
                    filled += step.consumed_out;
                    if !matches!(step.status, Ok(weezl::LzwStatus::Ok)) {
                        break;
                    }
                }
                filled
            }
            Self::PackBits => pack_bits(packed, out),
        }
    }
}

/// Runs and plain stretches (TIFF 6.0, section 9).
fn pack_bits(mut packed: &[u8], out: &mut [u8]) -> usize {
    let mut filled = 0;
    while let [head, rest @ ..] = packed {
        let room = out.len() - filled;
        if room == 0 {
            break;
        }
        packed = rest;
        match *head {
            128 => {}
            count @ ..128 => {
                let there = (usize::from(count) + 1).min(packed.len());
                let taken = there.min(room);
                out[filled..filled + taken].copy_from_slice(&packed[..taken]);
                filled += taken;
                packed = &packed[there..];
            }
            count => {
                let [byte, rest @ ..] = packed else { break };
                let run = (257 - usize::from(count)).min(room);
                out[filled..filled + run].fill(*byte);
                filled += run;
                packed = rest;
            }
        }
    }
    filled
}

/// What samples are before packing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Predictor {
    /// Themselves.
    None,
    /// Differences from the sample to the left (TIFF 6.0, section 14).
    Difference,
    /// Bytes of floating numbers by significance, as differences (Adobe TIFF technical note 3).
    Floating,
}

/// Type of a sample.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sample {
    /// One bit, of masks.
    Bit,
    Unsigned(usize),
    Signed(usize),
    Single,
    Double,
}

impl Sample {
    /// By bits and sample format; `None` for one that is not read.
    pub(super) fn of(bits: u64, format: u64) -> Option<Self> {
        match (format, bits) {
            (1 | 4, 1) => Some(Self::Bit),
            (1 | 4, 8 | 16 | 32) => Some(Self::Unsigned(bits as usize / 8)),
            (2, 8 | 16 | 32) => Some(Self::Signed(bits as usize / 8)),
            (3, 32) => Some(Self::Single),
            (3, 64) => Some(Self::Double),
            _ => None,
        }
    }

    pub(super) fn bits(self) -> u64 {
        match self {
            Self::Bit => 1,
            Self::Unsigned(size) | Self::Signed(size) => 8 * size as u64,
            Self::Single => 32,
            Self::Double => 64,
        }
    }

    /// Bytes of a sample; of bits 1.
    fn size(self) -> usize {
        self.bits().div_ceil(8) as usize
    }

    /// Undoes a predictor on one row of `samples` per pixel; gives whether the bytes are big-endian then.
    pub(super) fn predicted(self, predictor: Predictor, row: &mut [u8], samples: usize, big: bool, spare: &mut Vec<u8>) -> bool {
        let size = self.size();
        match predictor {
            Predictor::None => big,
            Predictor::Difference => {
                for at in (samples * size..row.len()).step_by(size) {
                    let before = at - samples * size;
                    if at + size > row.len() {
                        break;
                    }
                    let sum = whole(&row[before..before + size], big).wrapping_add(whole(&row[at..at + size], big));
                    let bytes = &mut row[at..at + size];
                    if big {
                        bytes.copy_from_slice(&sum.to_be_bytes()[8 - size..]);
                    } else {
                        bytes.copy_from_slice(&sum.to_le_bytes()[..size]);
                    }
                }
                big
            }
            Predictor::Floating => {
                for at in samples..row.len() {
                    row[at] = row[at].wrapping_add(row[at - samples]);
                }
                spare.clear();
                spare.extend_from_slice(row);
                let count = row.len() / size;
                for (at, byte) in row.iter_mut().enumerate().take(count * size) {
                    *byte = spare[at % size * count + at / size];
                }
                true
            }
        }
    }

    /// Sample number `index` of a row; `None` beyond its end.
    #[inline]
    pub(super) fn value(self, row: &[u8], index: usize, big: bool) -> Option<f64> {
        let size = self.size();
        let bytes = |index: usize| row.get(index * size..index * size + size).map(|bytes| whole(bytes, big));
        Some(match self {
            Self::Bit => f64::from(row.get(index / 8)? >> (7 - index % 8) & 1),
            Self::Unsigned(_) => bytes(index)? as f64,
            Self::Signed(_) => {
                let unused = 64 - 8 * size as u32;
                ((bytes(index)? << unused) as i64 >> unused) as f64
            }
            Self::Single => single(bytes(index)? as u32),
            Self::Double => f64::from_bits(bytes(index)?),
        })
    }

    /// The number of this type nearest to `value`, as far as it makes a difference: single precision has 24 of 53 bits.
    pub(super) fn nearest(self, value: f64) -> f64 {
        const DROPPED: u64 = (1 << 29) - 1;
        if self != Self::Single || !value.is_finite() {
            return value;
        }
        // To nearest, ties to even.
        let bits = value.to_bits();
        f64::from_bits((bits + (DROPPED >> 1) + (bits >> 29 & 1)) & !DROPPED)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pack_bits_follows_the_example_of_the_standard() {
        // TIFF 6.0, section 9 (from Apple's technical note 1023).
        let packed = [0xFE, 0xAA, 0x02, 0x80, 0x00, 0x2A, 0xFD, 0xAA, 0x03, 0x80, 0x00, 0x2A, 0x22, 0xF7, 0xAA];
        let plain = [
            0xAA, 0xAA, 0xAA, 0x80, 0x00, 0x2A, 0xAA, 0xAA, 0xAA, 0xAA, 0x80, 0x00, 0x2A, 0x22, 0xAA, 0xAA, 0xAA, 0xAA, 0xAA,
            0xAA, 0xAA, 0xAA, 0xAA, 0xAA,
        ];
        let mut out = [0; 24];
        assert_eq!(Compression::PackBits.unpack(&packed, &mut out), 24);
        assert_eq!(out, plain);
        for length in 0..packed.len() {
            assert!(Compression::PackBits.unpack(&packed[..length], &mut out) < 24);
        }
        assert_eq!(pack_bits(&packed, &mut out[..5]), 5);
    }

    #[test]
    fn numbers_of_all_types() {
        assert_eq!(Sample::Signed(2).value(&[0, 0, 0xFF, 0xFE], 1, true), Some(-2.0));
        assert_eq!(Sample::Signed(1).value(&[0x80], 0, false), Some(-128.0));
        assert_eq!(Sample::Unsigned(4).value(&[1, 0, 0, 0x80], 0, false), Some(2_147_483_649.0));
        assert_eq!(Sample::Single.value(&[0x3F, 0xC0, 0, 0], 0, true), Some(1.5));
        assert_eq!(Sample::Double.value(&(-0.1_f64).to_le_bytes(), 0, false), Some(-0.1));
        assert_eq!(Sample::Bit.value(&[0b0100_0000], 1, false), Some(1.0));
        assert_eq!(Sample::Single.value(&[0; 7], 1, false), None);
    }

    #[test]
    fn markers_are_met_in_single_precision() {
        // The largest negative number of single precision as often printed; the next digits are 46638528859811704….
        assert_eq!(Sample::Single.nearest(-3.40282347e+38), -3.402_823_466_385_288_6e38);
        assert_eq!(Sample::Single.nearest(-9999.9), -9_999.900_390_625);
        assert_eq!(Sample::Single.nearest(-9999.0), -9999.0);
        assert_eq!(Sample::Double.nearest(-9999.9), -9999.9);
    }
}
