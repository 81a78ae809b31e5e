//! GeoTIFF elevation models: whatever way the numbers are stored, they are the same.

use crate::maker::{KEYS, Kind, Maker};
use crate::{codes, ground, sound};
use glam::DVec2;
use slopegen::model::LengthUnit;
use slopegen::read::terrain::{RawGrid, RawGround, RawTerrain};
use slopegen::read::{CoordinateKind, InputFormat};

fn read(bytes: &[u8]) -> Result<RawTerrain, String> {
    ground(InputFormat::GeoTiff, bytes, &[])
}

fn grid(raw: RawTerrain) -> RawGrid {
    sound(&raw);
    let RawGround::Grid(grid) = raw.ground else { panic!("no grid") };
    grid
}

/// Numbers every type can hold.
fn value(column: usize, row: usize) -> f64 {
    ((37 * row + 11 * column) % 101) as f64
}

/// Reads a file of [`value`] and compares all of it.
#[track_caller]
fn agrees(maker: &Maker, value: impl Fn(usize, usize) -> f64) -> RawTerrain {
    let raw = read(&maker.make(&value)).unwrap_or_else(|error| panic!("{maker:?}: {error}"));
    let found = grid(raw.clone());
    assert_eq!((found.columns, found.rows), (maker.columns, maker.rows));
    for (i, z) in found.heights.iter().enumerate() {
        let expected = value(i % found.columns, i / found.columns);
        assert!(*z == expected || z.is_nan() && expected.is_nan(), "{maker:?}, {i}: {z}, not {expected}");
    }
    raw
}

#[test]
fn numbers_are_the_same_in_every_layout() {
    let mut files = 0;
    for (big, wide) in [(false, false), (true, false), (false, true), (true, true)] {
        for (tile, strip) in [(None, 7), (None, 3), (None, 1), (Some((4, 3)), 0), (Some((16, 16)), 0)] {
            for compression in [1, 5, 8, 32773] {
                for kind in Kind::ALL {
                    for predictor in [1, 2, 3] {
                        if predictor == 3 && !kind.is_float() {
                            continue;
                        }
                        let maker = Maker { big, wide, tile, strip, compression, predictor, ..Maker::new(kind) };
                        let raw = agrees(&maker, value);
                        assert_eq!(raw.source.crs.as_deref(), Some("EPSG:25832"));
                        assert_eq!(raw.notes, []);
                        files += 1;
                    }
                }
            }
        }
    }
    assert_eq!(files, 4 * 5 * 4 * (3 * 8 - 6));
}

#[test]
fn band_one_is_taken() {
    for planar in [false, true] {
        for (tile, predictor) in [(None, 1), (Some((4, 3)), 2), (None, 3)] {
            for big in [false, true] {
                let maker = Maker { big, planar, tile, predictor, bands: 3, strip: 3, compression: 8, ..Maker::new(Kind::F32) };
                assert_eq!(codes(&agrees(&maker, value).notes), ["raster-bands"]);
            }
        }
    }
}

#[test]
fn signs_and_fractions_are_kept() {
    let of = |kind: Kind, value: fn(usize, usize) -> f64| {
        for (big, predictor) in [(false, 1), (true, 2), (false, 2), (true, if kind.is_float() { 3 } else { 1 })] {
            agrees(&Maker { big, predictor, compression: 5, ..Maker::new(kind) }, value);
        }
    };
    of(Kind::I8, |c, r| c as f64 * 20.0 - r as f64 * 18.0);
    of(Kind::I16, |c, r| -32768.0 + (c + r) as f64);
    of(Kind::U16, |c, r| 65535.0 - (c * r) as f64);
    of(Kind::I32, |c, r| -2_147_483_648.0 + (c + 3 * r) as f64);
    of(Kind::U32, |c, r| 4_294_967_295.0 - (c + r) as f64);
    of(Kind::F32, |c, r| f64::from(0.1_f32 * c as f32 - 1.7_f32 * r as f32));
    of(Kind::F64, |c, r| 0.1 * c as f64 - 1.7 * r as f64);
}

/// Columns of 10, rows of 20, the corner of the first cell at 500 000, 5 400 000: the lowest row is 7 rows below.
#[test]
fn cells_lie_where_the_tags_say() {
    let place = |maker: &Maker| {
        let raw = agrees(maker, value);
        let found = grid(raw);
        (found.origin, found.step)
    };
    let step = DVec2::new(10.0, 20.0);
    let centres = (DVec2::new(500_005.0, 5_399_870.0), step);
    let plain = Maker::new(Kind::F32);
    assert_eq!(place(&plain), centres);
    assert_eq!(place(&plain.clone().without(34735)), centres);
    let mut keys = KEYS;
    keys[11] = 2;
    let points = plain.clone().shorts(34735, &keys);
    // Here the tie point is the middle of the first cell.
    assert_eq!(place(&points), (DVec2::new(500_000.0, 5_399_880.0), step));
    // Tied elsewhere: column 2, row 3.
    assert_eq!(place(&plain.clone().doubles(33922, &[2.0, 3.0, 0.0, 500_020.0, 5_399_940.0, 0.0])), centres);
    let matrix = [10.0, 0.0, 0.0, 5e5, 0.0, -20.0, 0.0, 5.4e6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    assert_eq!(place(&plain.clone().without(33550).without(33922).doubles(34264, &matrix)), centres);
}

#[test]
fn rows_from_the_south_are_turned() {
    let maker = Maker::new(Kind::F64).doubles(33550, &[10.0, -20.0, 0.0]).doubles(33922, &[0.0, 0.0, 0.0, 5e5, 5.4e6, 0.0]);
    let found = grid(read(&maker.make(value)).unwrap());
    assert_eq!(found.origin, DVec2::new(500_005.0, 5_400_010.0));
    for (i, z) in found.heights.iter().enumerate() {
        assert_eq!(*z, value(i % 5, 6 - i / 5));
    }
}

#[test]
fn markers_stand_for_no_height() {
    let holed = |marker: f64| move |c: usize, r: usize| if (c, r) == (2, 3) { marker } else { value(c, r) };
    let gone = holed(f64::NAN);
    for (kind, text, stored) in [
        (Kind::I16, "-32768", -32768.0),
        (Kind::F32, "-9999", -9999.0),
        (Kind::F32, "-9999.9", f64::from(-9999.9_f32)),
        (Kind::F32, "-3.40282347e+38", f64::from(f32::MIN)),
        (Kind::F32, "-3.4028234663852886e+38", f64::from(f32::MIN)),
        (Kind::F64, "-3.40282346638528859811704183484516925440e+38", f64::from(f32::MIN)),
        (Kind::F32, " 1e20 ", f64::from(1e20_f32)),
        (Kind::F64, "nan", f64::NAN),
        (Kind::U8, "255", 255.0),
    ] {
        let maker = Maker { compression: 8, ..Maker::new(kind) }.text(42113, text);
        let found = grid(read(&maker.make(holed(stored))).unwrap());
        for (i, z) in found.heights.iter().enumerate() {
            let expected = gone(i % 5, i / 5);
            assert!(*z == expected || z.is_nan() && expected.is_nan(), "{text}: {z}");
        }
    }
    // Not declared, and not so large that no height can be meant: how to declare it.
    let raw = read(&Maker::new(Kind::F32).make(holed(-9999.0))).unwrap();
    let message = slopegen::terrain::prepare(raw).unwrap_err().to_string();
    assert!(message.ends_with("help: declare it in the file, e.g. `gdal_translate -a_nodata -9999 a declared.tif`"), "{message}");
    // Not declared, and yet none.
    for odd in [f64::from(f32::MIN), 1e25, f64::INFINITY, f64::NAN] {
        let found = grid(read(&Maker::new(Kind::F32).make(holed(odd))).unwrap());
        assert!(found.heights[3 * 5 + 2].is_nan());
    }
    let odd = Maker::new(Kind::F32).text(42113, "none");
    assert_eq!(codes(&agrees(&odd, value).notes), ["raster-no-data"]);
}

#[test]
fn heights_are_scaled_as_the_file_says() {
    let text = "<GDALMetadata><Item name=\"SCALE\" sample=\"0\" role=\"scale\">0.1</Item><Item name=\"OFFSET\" sample=\"0\" \
                role=\"offset\">100</Item></GDALMetadata>";
    // The marker is that of the stored numbers.
    let maker = Maker::new(Kind::I16).text(42112, text).text(42113, "7");
    let raw = read(&maker.make(|c, r| if (c, r) == (0, 0) { 7.0 } else { -250.0 })).unwrap();
    assert_eq!(codes(&raw.notes), ["raster-scaled"]);
    let heights = grid(raw).heights;
    assert!(heights[0].is_nan() && heights[1..].iter().all(|z| *z == -250.0 * 0.1 + 100.0));
}

#[test]
fn parts_that_are_left_out_have_no_heights() {
    let maker = Maker { tile: Some((3, 4)), compression: 8, sparse: vec![1], ..Maker::new(Kind::F32) };
    // Tile 1 is the eastern one of the upper row: columns 3 and 4, rows 0 to 3.
    let found = grid(read(&maker.make(value)).unwrap());
    for (i, z) in found.heights.iter().enumerate() {
        assert_eq!(z.is_nan(), i % 5 >= 3 && i / 5 < 4, "{i}");
    }
    let error = read(&Maker { sparse: vec![0], ..Maker::new(Kind::F32) }.make(value)).unwrap_err();
    assert!(error.starts_with("the GeoTIFF is empty"), "{error}");
}

#[test]
fn units_and_systems_are_told() {
    let keyed = |more: &[u32]| {
        let mut keys = vec![1, 1, 0, 1 + more.len() as u32 / 2, 1024, 0, 1, 1];
        more.chunks(2).for_each(|key| keys.extend([key[0], 0, 1, key[1]]));
        read(&Maker::new(Kind::F32).shorts(34735, &keys).make(value)).unwrap()
    };
    let feet = keyed(&[3072, 2225, 3076, 9003, 4099, 9003]);
    assert_eq!((feet.source.unit, feet.source.kind), (Some(LengthUnit::UsSurveyFoot), CoordinateKind::Lengths));
    assert_eq!(grid(feet).heights[1], value(1, 0));
    let mixed = keyed(&[3072, 2225, 3076, 9003, 4099, 9001]);
    assert_eq!(codes(&mixed.notes), ["heights-converted"]);
    // 3937 US survey feet are 1200 m.
    assert!((grid(mixed).heights[1] - 11.0 * 3937.0 / 1200.0).abs() < 1e-12);
    let bare = read(&Maker::new(Kind::F32).without(34735).make(value)).unwrap();
    assert_eq!((bare.source.unit, bare.source.crs.clone(), codes(&bare.notes)), (None, None, vec!["raster-no-keys"]));
}

#[test]
fn degrees_are_refused_with_a_cure() {
    let maker = Maker::new(Kind::F32)
        .shorts(34735, &[1, 1, 0, 2, 1024, 0, 1, 2, 2048, 0, 1, 4326])
        .doubles(33550, &[0.001, 0.001, 0.0])
        .doubles(33922, &[0.0, 0.0, 0.0, 8.5, 47.5, 0.0]);
    let raw = read(&maker.make(value)).unwrap();
    assert_eq!(raw.source.kind, CoordinateKind::Degrees);
    let error = slopegen::terrain::prepare(raw).unwrap_err().to_string();
    assert!(
        error.contains("longitude and latitude") && error.contains("`gdalwarp -s_srs EPSG:4326 -t_srs EPSG:32632 a"),
        "{error}"
    );
}

/// What is not read is refused by its name, with what mends it.
#[test]
fn what_is_not_read_is_named() {
    let plain = Maker::new(Kind::F32);
    let turned = [7.0, 7.0, 0.0, 5e5, 7.0, -7.0, 0.0, 5.4e6, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0];
    let ties: Vec<f64> = (0..24).map(f64::from).collect();
    for (maker, what, cure) in [
        (Maker { compression: 50000, ..plain.clone() }, "Zstandard", "COMPRESS=DEFLATE"),
        (Maker { compression: 7, ..plain.clone() }, "JPEG", "COMPRESS=DEFLATE"),
        (Maker { compression: 50001, ..plain.clone() }, "WebP", "COMPRESS=DEFLATE"),
        (Maker { compression: 34887, ..plain.clone() }, "LERC", "COMPRESS=DEFLATE"),
        (Maker { predictor: 5, ..plain.clone() }, "predictor 5", "gdal_translate"),
        (plain.clone().without(33550).without(33922).doubles(34264, &turned), "turned", "gdalwarp"),
        (plain.clone().without(33550).doubles(33922, &ties), "4 control points", "gdalwarp"),
        (plain.clone().without(33550).without(33922), "does not say where it lies", "-a_ullr"),
        (plain.clone().doubles(33550, &[0.0, 10.0, 0.0]), "no size", "export"),
        (plain.clone().doubles(33550, &[f64::NAN, 10.0, 0.0]), "no size", "export"),
        (plain.clone().shorts(34735, &[1, 1, 0, 1, 1024, 0, 1, 3]), "geocentric", "gdalwarp"),
    ] {
        let error = read(&maker.make(value)).unwrap_err();
        assert!(error.contains(what) && error.contains(cure) && error.contains("--> a"), "{error}");
    }
}

/// Files of the package `tiff`: another hand than ours.
#[test]
fn files_of_another_encoder_are_read() {
    use tiff::encoder::{Compression, DeflateLevel, Predictor, TiffEncoder, colortype};
    use tiff::tags::Tag;
    let values: Vec<f32> = (0..35).map(|i| value(i % 5, i / 5) as f32 + 0.25).collect();
    for compression in
        [Compression::Uncompressed, Compression::Lzw, Compression::Deflate(DeflateLevel::Best), Compression::Packbits]
    {
        for (predictor, wide) in [(Predictor::None, false), (Predictor::None, true)] {
            let mut bytes = std::io::Cursor::new(Vec::new());
            macro_rules! write {
                ($encoder:expr) => {{
                    let mut encoder = $encoder.unwrap().with_compression(compression).with_predictor(predictor);
                    let mut image = encoder.new_image::<colortype::Gray32Float>(5, 7).unwrap();
                    image.rows_per_strip(3).unwrap();
                    image.encoder().write_tag(Tag::Unknown(33550), &[10.0, 20.0, 0.0][..]).unwrap();
                    image.encoder().write_tag(Tag::Unknown(33922), &[0.0, 0.0, 0.0, 5e5, 5.4e6, 0.0][..]).unwrap();
                    image.write_data(&values).unwrap();
                }};
            }
            if wide {
                write!(TiffEncoder::new_big(&mut bytes))
            } else {
                write!(TiffEncoder::new(&mut bytes))
            }
            let found = grid(read(bytes.get_ref()).unwrap());
            assert!(found.heights.iter().zip(&values).all(|(a, b)| *a == f64::from(*b)));
        }
    }
}
