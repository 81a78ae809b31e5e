//! Damaged and hostile GeoTIFFs: a message in bounded time, never a panic, never much memory.

use crate::maker::{Kind, Maker};
use crate::{ground, sound};
use proptest::prelude::*;
use slopegen::read::InputFormat;
use std::io::Write as _;
use std::time::{Duration, Instant};

/// Longer than any small file may take, on a busy machine.
const PATIENCE: Duration = Duration::from_secs(20);

fn look(bytes: &[u8]) -> Result<(), String> {
    let begin = Instant::now();
    let result = ground(InputFormat::GeoTiff, bytes, &[]);
    assert!(begin.elapsed() < PATIENCE);
    result.map(|raw| sound(&raw))
}

fn samples() -> Vec<Vec<u8>> {
    let mut files = Vec::new();
    for (big, wide) in [(false, false), (true, true)] {
        for compression in [1, 5, 8, 32773] {
            let maker = Maker { big, wide, compression, tile: Some((4, 4)), ..Maker::new(Kind::F32) };
            files.push(maker.text(42113, "-9999").make(|c, r| (c * r) as f64));
            let maker = Maker { big, wide, compression, predictor: 2, strip: 2, ..Maker::new(Kind::I16) };
            files.push(maker.make(|c, r| (c + r) as f64));
        }
    }
    files
}

#[test]
fn files_cut_off_anywhere_are_refused() {
    for file in samples() {
        assert!(look(&file).is_ok());
        for length in 4..file.len() {
            let error = look(&file[..length]).unwrap_err();
            assert!(error.contains("help"), "{error}");
        }
    }
}

#[test]
fn single_bits_do_no_harm() {
    for mut file in samples() {
        for bit in 32..8 * file.len() {
            file[bit / 8] ^= 1 << (bit % 8);
            let _ = look(&file);
            file[bit / 8] ^= 1 << (bit % 8);
        }
    }
}

/// Sets a tag of a little-endian classic file that has one 32-bit value in place.
fn patch(file: &mut [u8], tag: u16, value: u32) {
    let count = usize::from(u16::from_le_bytes([file[8], file[9]]));
    for entry in file[10..10 + 12 * count].chunks_exact_mut(12) {
        if entry[..2] == tag.to_le_bytes() {
            entry[2..4].copy_from_slice(&4_u16.to_le_bytes());
            entry[4..8].copy_from_slice(&1_u32.to_le_bytes());
            entry[8..].copy_from_slice(&value.to_le_bytes());
        }
    }
}

#[test]
fn absurd_sizes_are_refused() {
    let plain = Maker { compression: 8, ..Maker::new(Kind::F64) }.make(|_, _| 1.0);
    for (tag, value, what) in [
        (256, u32::MAX, "too large"),
        (256, 0, "no cells"),
        (257, 0, "no cells"),
        (257, 10_000_000, "1428572 are needed, 1 are there"),
        (258, 64_000, "of a kind that is not read"),
        (277, u32::MAX, "impossible size"),
        (273, u32::MAX - 7, "cut off"),
        (279, u32::MAX, "cut off"),
        (278, 1, "missing"),
        (339, 6, "of a kind that is not read"),
    ] {
        let mut file = plain.clone();
        patch(&mut file, tag, value);
        let error = look(&file).unwrap_err();
        assert!(error.contains(what), "{tag}: {error}");
    }
    let mut tiled = Maker { tile: Some((4, 4)), compression: 8, ..Maker::new(Kind::F64) }.make(|_, _| 1.0);
    patch(&mut tiled, 322, u32::MAX);
    patch(&mut tiled, 323, u32::MAX);
    assert!(look(&tiled).unwrap_err().contains("impossible size"));
    // Tiles of 0.4 GB, which their packed bytes cannot hold; then twenty thousand of them.
    patch(&mut tiled, 322, 10_000);
    patch(&mut tiled, 323, 5_000);
    assert!(look(&tiled).unwrap_err().contains("shorter than it should be"));
    patch(&mut tiled, 256, 1);
    patch(&mut tiled, 257, 100_000_000);
    assert!(look(&tiled).unwrap_err().contains("too large"));
    patch(&mut tiled, 322, 0);
    assert!(look(&tiled).unwrap_err().contains("impossible size"));
}

/// Each number of the place is finite, their product is not.
#[test]
fn places_beyond_all_numbers_are_refused() {
    for (size, corner) in [(1e308, 0.0), (5e307, 0.0), (2.5e307, -1.7e308), (1e308, -1.7e308), (1e300, f64::MAX)] {
        for transposed in [false, true] {
            let [x, y] = if transposed { [10.0, size] } else { [size, 20.0] };
            let maker = Maker::new(Kind::F32).doubles(33550, &[x, y, 0.0]);
            let maker = maker.doubles(33922, &[0.0, 0.0, 0.0, corner, -corner, 0.0]);
            // Seven rows below the corner, five columns beside it.
            let far = corner + if transposed { 6.5 } else { 4.5 } * size;
            let result = look(&maker.make(|_, _| 1.0));
            if far.is_finite() {
                result.unwrap();
            } else {
                let error = result.unwrap_err();
                assert!(error.contains("the grid reaches beyond all numbers"), "{size} {corner}: {error}");
            }
        }
    }
}

#[test]
fn heights_scaled_beyond_all_numbers_are_none() {
    let text = "<GDALMetadata><Item name=\"SCALE\" sample=\"0\" role=\"scale\">1e300</Item></GDALMetadata>";
    let file = Maker::new(Kind::F64).text(42112, text).make(|column, _| if column == 0 { 9e19 } else { 1.0 });
    let raw = ground(InputFormat::GeoTiff, &file, &[]).unwrap();
    sound(&raw);
    let slopegen::read::terrain::RawGround::Grid(grid) = raw.ground else { panic!("no grid") };
    assert!(grid.heights.iter().enumerate().all(|(i, z)| if i % 5 == 0 { z.is_nan() } else { *z == 1e300 }));
}

/// Ten megabytes of noughts in ten kilobytes: only what the image needs is unpacked.
#[test]
fn bombs_do_not_go_off() {
    let mut encoder = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::best());
    encoder.write_all(&vec![0; 10_000_000]).unwrap();
    let bomb = encoder.finish().unwrap();
    let mut file = Maker { compression: 8, ..Maker::new(Kind::F64) }.make(|_, _| 1.0);
    let from = file.len() as u32;
    patch(&mut file, 273, from);
    patch(&mut file, 279, bomb.len() as u32);
    file.extend(&bomb);
    assert!(look(&file).is_ok());
    // And one that says it holds the largest grid there may be.
    patch(&mut file, 256, 10_000);
    patch(&mut file, 257, 10_000);
    patch(&mut file, 278, 10_000);
    let error = look(&file).unwrap_err();
    assert!(error.contains("packed"), "{error}");
}

#[test]
fn directories_in_circles_end() {
    let mut file = Maker::new(Kind::F64).make(|_, _| 1.0);
    let count = usize::from(u16::from_le_bytes([file[8], file[9]]));
    let next = 10 + 12 * count;
    file[next..next + 4].copy_from_slice(&8_u32.to_le_bytes());
    assert!(look(&file).is_ok());
    file[next..next + 4].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(look(&file).is_ok());
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Random bytes behind a sound head, and random bytes over a sound file.
    #[test]
    fn nothing_panics(
        which in 0..16_usize,
        noise in prop::collection::vec(any::<u8>(), 0..200),
        at in any::<prop::sample::Index>(),
    ) {
        let mut file = samples().swap_remove(which);
        let from = at.index(file.len() - 8) + 8;
        for (to, byte) in file[from..].iter_mut().zip(&noise) {
            *to = *byte;
        }
        let _ = look(&file);
        let mut bare = file[..8].to_vec();
        bare.extend(&noise);
        let _ = look(&bare);
    }
}
