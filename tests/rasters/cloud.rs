//! LAS and LAZ: every version and point format, made by the package `las`, and damage to them.

use crate::{codes, ground, sound};
use glam::DVec3;
use las::point::{Classification, Format};
use las::{Builder, Point, Transform, Vector, Vlr, Writer};
use proptest::prelude::*;
use slopegen::model::LengthUnit;
use slopegen::read::terrain::{RawGround, RawTerrain};
use slopegen::read::{CoordinateKind, InputFormat};
use std::io::Cursor;

fn read(bytes: &[u8], classes: &[u8]) -> Result<RawTerrain, String> {
    let raw = ground(InputFormat::Las, bytes, classes)?;
    sound(&raw);
    Ok(raw)
}

fn points(raw: &RawTerrain) -> &[DVec3] {
    let RawGround::Points(points) = &raw.ground else { panic!("no points") };
    points
}

/// A cloud to be made.
#[derive(Clone)]
struct Cloud {
    version: (u8, u8),
    format: u8,
    packed: bool,
    extra: u16,
    records: Vec<Vlr>,
    wkt: bool,
}

impl Cloud {
    fn new(version: (u8, u8), format: u8, packed: bool) -> Self {
        Self { version, format, packed, extra: 0, records: Vec::new(), wkt: false }
    }

    fn record(mut self, record_id: u16, data: &[u8]) -> Self {
        let (user_id, description) = ("LASF_Projection".to_owned(), String::new());
        self.records.push(Vlr { user_id, record_id, description, data: data.to_vec() });
        self
    }

    /// Coordinates in millimetres about 500 000, 5 400 000, 100; class, withheld, overlap.
    fn make(&self, points: &[(i32, i32, i32, u8, bool, bool)]) -> Vec<u8> {
        let mut builder = Builder::from(self.version);
        builder.point_format = Format::new(self.format).unwrap();
        builder.point_format.is_compressed = self.packed;
        builder.point_format.extra_bytes = self.extra;
        builder.has_wkt_crs = self.wkt;
        builder.vlrs = self.records.clone();
        let axis = |offset| Transform { scale: 0.001, offset };
        builder.transforms = Vector { x: axis(5e5), y: axis(5.4e6), z: axis(100.0) };
        let format = builder.point_format;
        let mut writer = Writer::new(Cursor::new(Vec::new()), builder.into_header().unwrap()).unwrap();
        for (i, &(x, y, z, class, is_withheld, is_overlap)) in points.iter().enumerate() {
            let at = |n: i32, offset: f64| f64::from(n) * 0.001 + offset;
            let point = Point {
                x: at(x, 5e5),
                y: at(y, 5.4e6),
                z: at(z, 100.0),
                classification: Classification::new(class).unwrap(),
                is_withheld,
                is_overlap,
                intensity: (i % 97) as u16,
                return_number: 1,
                number_of_returns: 1,
                gps_time: format.has_gps_time.then_some(i as f64 * 0.25),
                color: format.has_color.then(|| las::Color::new(i as u16, 7, 9)),
                nir: format.has_nir.then_some(3),
                waveform: format.has_waveform.then(Default::default),
                extra_bytes: vec![i as u8; usize::from(self.extra)],
                ..Point::default()
            };
            writer.write_point(point).unwrap();
        }
        writer.into_inner().unwrap().into_inner()
    }
}

/// Ground in a grid of 20 by 15 with steps of about a metre; every fourth point is vegetation above it.
fn site() -> Vec<(i32, i32, i32, u8, bool, bool)> {
    (0..300)
        .map(|i| {
            let (x, y) = (1000 * (i % 20) + 7 * (i % 3), 1000 * (i / 20) - 5 * (i % 7));
            let (z, class) = if i % 4 == 3 { (8000 + 13 * i, 5) } else { (13 * i - 1999, 2) };
            (x, y, z, class, false, false)
        })
        .collect()
}

/// The ground of [`site`] as numbers of the standard: integer × scale + offset.
fn expected() -> Vec<DVec3> {
    let at = |n: i32, offset: f64| f64::from(n) * 0.001 + offset;
    let ground = site().into_iter().filter(|point| point.3 == 2);
    ground.map(|(x, y, z, ..)| DVec3::new(at(x, 5e5), at(y, 5.4e6), at(z, 100.0))).collect()
}

#[test]
fn every_version_and_format_gives_the_same_points() {
    let mut files = 0;
    for (version, formats) in [((1, 0), 0..=1), ((1, 1), 0..=1), ((1, 2), 0..=3), ((1, 3), 0..=5), ((1, 4), 0..=10)] {
        for format in formats {
            for packed in [false, true] {
                for extra in [0, 5] {
                    let cloud = Cloud { extra, ..Cloud::new(version, format, packed) };
                    let raw =
                        read(&cloud.make(&site()), &[]).unwrap_or_else(|error| panic!("{version:?} {format} {packed}: {error}"));
                    assert_eq!(points(&raw), expected(), "{version:?} {format} {packed} {extra}");
                    assert_eq!(codes(&raw.notes), ["cloud-classes"]);
                    files += 1;
                }
            }
        }
    }
    assert_eq!(files, 4 * (2 + 2 + 4 + 6 + 11));
}

/// 48 bytes for each point that is taken, before they are taken: 225 of 300 here. What is in a packed file shows only when it is
/// unpacked.
#[test]
fn memory_is_asked_for() {
    use slopegen::model::{LimitedBy, Memory};
    use slopegen::read::terrain::{TerrainOptions, parse_terrain};
    for (packed, most) in [(false, 225), (true, 300)] {
        let file = Cloud::new((1, 2), 1, packed).make(&site());
        let with = |bytes: usize| {
            let memory = Memory::limited(10_000_000 + bytes as u64, LimitedBy::Option);
            let options = TerrainOptions { memory, ..TerrainOptions::of(InputFormat::Las) };
            parse_terrain("a.las", &file, &options).map(|_| ()).map_err(|error| error.to_string())
        };
        assert_eq!(with(file.len() + 48 * most), Ok(()));
        let message = with(file.len() + 48 * most - 1).unwrap_err();
        assert!(message.contains(&format!("--> a.las\n   = up to {most} points would take about 10.0 MB")), "{message}");
    }
}

#[test]
fn classes_are_taken_as_asked() {
    for format in [0, 6] {
        let file = Cloud::new((1, 4), format, true).make(&site());
        assert_eq!(points(&read(&file, &[5]).unwrap()).len(), 75);
        let both = read(&file, &[2, 5]).unwrap();
        assert_eq!(points(&both).len(), 300);
        assert_eq!(both.notes[0].message, "300 of 300 points are ground, classes 2 and 5");
        let error = read(&file, &[8]).unwrap_err();
        assert!(error.contains("no points of class 8"), "{error}");
        assert!(error.contains("classes there: 2 (ground) with 225, 5 (vegetation) with 75"), "{error}");
    }
}

#[test]
fn clouds_without_classes_are_told_of() {
    let mut points: Vec<_> = site();
    points.iter_mut().enumerate().for_each(|(i, point)| point.3 = u8::from(i % 3 == 0));
    let file = Cloud::new((1, 2), 1, false).make(&points);
    let error = read(&file, &[]).unwrap_err();
    assert!(error.contains("0 (never classified) with 200, 1 (unclassified) with 100"), "{error}");
    assert!(error.contains("`--class 0,1`"), "{error}");
    assert_eq!(self::points(&read(&file, &[0, 1]).unwrap()).len(), 300);
}

#[test]
fn withheld_points_and_overlap_are_left_out() {
    let mut points = site();
    points[0].4 = true;
    points[3].4 = true;
    points[1].5 = true;
    let of = |format: u8| {
        let raw = read(&Cloud::new((1, 4), format, format == 6).make(&points), &[]).unwrap();
        (self::points(&raw).len(), raw.notes.iter().map(|note| note.message.clone()).collect::<Vec<_>>())
    };
    for format in [6, 7] {
        let (count, notes) = of(format);
        assert_eq!(count, 223);
        assert_eq!(notes[0], "223 of 298 points are ground, class 2");
        assert_eq!(notes[1], "left out 2 points marked as withheld");
        assert_eq!(notes[2], "left out 1 point marked as overlap");
    }
    // Older formats have no mark for overlap but a class, 12.
    assert_eq!(of(1).0, 223);
}

#[test]
fn systems_and_units_are_told_by_keys_and_by_text() {
    let words = |words: &[u16]| words.iter().flat_map(|w| w.to_le_bytes()).collect::<Vec<u8>>();
    let keys = words(&[1, 1, 0, 4, 1024, 0, 1, 1, 3072, 0, 1, 2992, 3076, 0, 1, 9002, 4099, 0, 1, 9001]);
    let keyed = Cloud::new((1, 2), 0, false).record(34735, &keys).make(&site());
    let raw = read(&keyed, &[]).unwrap();
    let source = &raw.source;
    assert_eq!(
        (source.crs.as_deref(), source.unit, source.kind),
        (Some("EPSG:2992"), Some(LengthUnit::Foot), CoordinateKind::Lengths)
    );
    assert_eq!(codes(&raw.notes), ["cloud-classes", "heights-converted"]);
    assert_eq!(points(&raw)[0].z, expected()[0].z * (1.0 / 0.3048));

    let text = br#"COMPD_CS["x",PROJCS["ETRS89 / UTM 32N",GEOGCS["E",UNIT["degree",0.017]],UNIT["metre",1],AUTHORITY["EPSG","25832"]],VERT_CS["h",UNIT["metre",1]]]"#;
    let told = Cloud { wkt: true, ..Cloud::new((1, 4), 6, true) }.record(2112, text).make(&site());
    let raw = read(&told, &[]).unwrap();
    assert_eq!((raw.source.crs.as_deref(), raw.source.unit), (Some("EPSG:25832"), Some(LengthUnit::Metre)));
    assert_eq!(codes(&raw.notes), ["cloud-classes"]);

    let degrees =
        Cloud { wkt: true, ..Cloud::new((1, 4), 6, false) }.record(2112, br#"GEOGCS["WGS 84",AUTHORITY["EPSG","4326"]]"#);
    let raw = read(&degrees.make(&site()), &[]).unwrap();
    assert_eq!(raw.source.kind, CoordinateKind::Degrees);
}

/// Bytes of the header, set to others.
fn patched(file: &[u8], at: usize, bytes: &[u8]) -> Vec<u8> {
    let mut file = file.to_vec();
    file[at..at + bytes.len()].copy_from_slice(bytes);
    file
}

#[test]
fn headers_that_cannot_be_are_refused() {
    let (old, new) = (Cloud::new((1, 2), 0, false).make(&site()), Cloud::new((1, 4), 6, false).make(&site()));
    let packed = Cloud::new((1, 4), 6, true).make(&site());
    for (file, what) in [
        (patched(&old, 0, b"LASX"), "the file is not a LAS or LAZ file"),
        (patched(&old, 24, &[2, 0]), "this version of LAS is not read"),
        (patched(&old, 25, &[5]), "this version of LAS is not read"),
        (patched(&old, 94, &[10, 0]), "the header of the LAS file is too short"),
        (patched(&old, 96, &[0xFF; 4]), "the LAS file ends before its points"),
        (patched(&old, 96, &[0; 4]), "the LAS file ends before its points"),
        (patched(&old, 104, &[11]), "of a kind that is not known"),
        (patched(&old, 105, &[19, 0]), "the points of the LAS file are too short"),
        (patched(&old, 107, &[0; 4]), "the LAS file has no points"),
        (patched(&old, 107, &301_u32.to_le_bytes()), "301 points by its header, 300 are there"),
        (patched(&old, 107, &[0xFF; 4]), "too many points"),
        (patched(&new, 247, &(1_u64 << 60).to_le_bytes()), "too many points"),
        (patched(&packed, 247, &(1_u64 << 60).to_le_bytes()), "too many points"),
        (patched(&packed, 247, &90_000_000_u64.to_le_bytes()), "fewer points than its header says"),
        (patched(&old, 131, &0.0_f64.to_le_bytes()), "scale or offset"),
        (patched(&old, 139, &f64::NAN.to_le_bytes()), "scale or offset"),
        (patched(&old, 147, &(-0.01_f64).to_le_bytes()), "scale or offset"),
        (patched(&old, 155, &f64::INFINITY.to_le_bytes()), "scale or offset"),
        (patched(&old, 131, &1e300_f64.to_le_bytes()), "a"),
    ] {
        match read(&file, &[]) {
            Err(error) => assert!(error.contains(what) && error.contains("help"), "{what}: {error}"),
            // Coordinates beyond all bounds are left to the next step.
            Ok(_) => assert_eq!(what, "a"),
        }
    }
    // A count of records that are not there does no harm.
    assert!(read(&patched(&old, 100, &[0xFF; 4]), &[]).is_ok());
    assert!(read(&patched(&new, 243, &[0xFF; 4]), &[]).is_ok());
    // Nor does a box that is wrong: it is told of.
    let raw = read(&patched(&old, 179, &500_001.0_f64.to_le_bytes()), &[]).unwrap();
    assert_eq!(codes(&raw.notes), ["cloud-classes", "cloud-outside-box"]);
}

/// One point per chunk and more: chunks of 50 000 points are the least most programs write.
#[test]
fn several_chunks_are_joined_in_their_order() {
    let many: Vec<_> = (0..120_000).map(|i| (i % 400 * 10, i / 400 * 10, i % 1000, 2, false, false)).collect();
    for format in [1, 7] {
        let raw = read(&Cloud::new((1, 4), format, true).make(&many), &[]).unwrap();
        assert_eq!(points(&raw).len(), many.len());
        let same = points(&raw).iter().zip(&many).all(|(point, made)| point.x == f64::from(made.0) * 0.001 + 5e5);
        assert!(same);
    }
}

/// Clouds of real surveys, from the folder named by `SLOPEGEN_DATA`: counts, boxes and units are those `laspy` 2.7 tells.
#[test]
#[allow(clippy::print_stderr, reason = "tells what was skipped")]
fn clouds_of_surveys_are_read() {
    let Some(folder) = std::env::var_os("SLOPEGEN_DATA").map(|data| std::path::PathBuf::from(data).join("las")) else {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
        return;
    };
    for (name, ground, all, crs, unit) in [
        ("4_6_crop.las", 9_003, 23_875, Some("EPSG:2903"), Some(LengthUnit::UsSurveyFoot)),
        ("autzen_trim.laz", 26_107, 110_000, Some("NAD_1983_HARN_Lambert_Conformal_Conic"), Some(LengthUnit::Foot)),
        ("simple.las", 276, 1_065, None, None),
    ] {
        let bytes = std::fs::read(folder.join(name)).unwrap();
        let raw = read(&bytes, &[]).unwrap();
        assert_eq!((points(&raw).len(), raw.source.crs.as_deref(), raw.source.unit), (ground, crs, unit), "{name}");
        assert!(!codes(&raw.notes).contains(&"cloud-outside-box"), "{name}");
        assert_eq!(points(&read(&bytes, &[1, 2]).unwrap()).len(), all, "{name}");
    }
    let lowest = |name: &str, classes: &[u8]| {
        let raw = read(&std::fs::read(folder.join(name)).unwrap(), classes).unwrap();
        points(&raw).iter().map(|point| point.z).fold(f64::INFINITY, f64::min)
    };
    assert!((lowest("autzen_trim.laz", &[1, 2]) - 406.26).abs() < 1e-9);
    assert!((lowest("4_6_crop.las", &[1, 2]) - 7077.92).abs() < 1e-9);
}

fn samples() -> Vec<Vec<u8>> {
    [(0, false), (6, false), (0, true), (3, true), (6, true), (8, true)]
        .map(|(format, packed)| Cloud { extra: 2, ..Cloud::new((1, 4), format, packed) }.make(&site()[..40]))
        .to_vec()
}

#[test]
fn files_cut_off_anywhere_are_refused() {
    for file in samples() {
        assert!(read(&file, &[]).is_ok());
        for length in 4..file.len() {
            let error = read(&file[..length], &[]).unwrap_err();
            assert!(error.contains("help"), "{error}");
        }
    }
}

#[test]
fn single_bits_do_no_harm() {
    for mut file in samples() {
        // Every fifth: each bit of a byte has its turn.
        for bit in (32..8 * file.len()).step_by(5) {
            file[bit / 8] ^= 1 << (bit % 8);
            let _ = read(&file, &[]);
            file[bit / 8] ^= 1 << (bit % 8);
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    /// Random bytes over a sound file: header, records, table of chunks and packed points.
    #[test]
    fn nothing_panics(
        which in 0..6_usize,
        noise in prop::collection::vec(any::<u8>(), 1..100),
        at in any::<prop::sample::Index>(),
    ) {
        let mut file = samples().swap_remove(which);
        let from = at.index(file.len() - 4) + 4;
        for (to, byte) in file[from..].iter_mut().zip(&noise) {
            *to = *byte;
        }
        let _ = read(&file, &[2, 5]);
    }
}
