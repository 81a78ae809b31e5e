//! Files of other programs, in the folder named by the environment variable `SLOPEGEN_DATA` (`landxml/`).

#![allow(clippy::print_stderr, reason = "tells what was skipped")]

use slopegen::model::LengthUnit;
use slopegen::read::terrain::{RawFaces, RawGround, TerrainOptions, read_terrain};
use slopegen::read::{self, Pick, ReadOptions};
use slopegen::{terrain, validate};
use std::path::{Path, PathBuf};

fn folder() -> Option<PathBuf> {
    let folder = std::env::var_os("SLOPEGEN_DATA").map(|data| PathBuf::from(data).join("landxml"));
    if folder.is_none() {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
    }
    folder
}

/// Vertices, faces and plan area, as the file has them.
fn surface(path: &Path, name: Option<&str>) -> (usize, usize, f64, Option<LengthUnit>, Vec<&'static str>) {
    let pick = Pick { surface: name.map(str::to_owned), ..Pick::default() };
    let raw = read_terrain(path, &TerrainOptions { pick, ..TerrainOptions::default() }).unwrap_or_else(|e| panic!("{e}"));
    let RawGround::Mesh { vertices, faces: RawFaces::Triangles(faces) } = &raw.ground else { panic!("no triangles") };
    let (count, unit) = ((vertices.len(), faces.len()), raw.source.unit);
    let ground = terrain::prepare(raw).unwrap_or_else(|e| panic!("{e}"));
    let area = |t: usize| {
        let [a, b, c] = ground.terrain.corners(t);
        0.5 * (b - a).truncate().perp_dot((c - a).truncate())
    };
    let area = (0..ground.terrain.triangles.len()).map(area).sum();
    (count.0, count.1, area, unit, ground.notes.iter().map(|note| note.code).collect())
}

/// Counts of `<P>` and `<F>` in the files (`grep -c`), areas as declared, where they are.
#[test]
fn surfaces() {
    let Some(folder) = folder() else { return };
    for (file, name, vertices, faces, unit, declared) in [
        ("M3_Rockbed_survey.mm.xml", None, 2037, 3244, LengthUnit::Metre, None),
        ("Y10_Highest_Comb_rev2_Highest_combination_of_surface.mm.xml", None, 307, 547, LengthUnit::Metre, None),
        ("Y11_Highest_Comb_rev2_Highest_combination_of_surface.mm.xml", None, 320, 569, LengthUnit::Metre, None),
        ("landfill_S4.xml", None, 1657, 3199, LengthUnit::UsSurveyFoot, None),
        ("subdivision.xml", Some("EG"), 713, 1284, LengthUnit::Foot, Some(9_742_293.952_1)),
        ("subdivision.xml", Some("FG"), 2716, 5241, LengthUnit::Foot, Some(2_768_515.766_2)),
    ] {
        let found = surface(&folder.join(file), name);
        assert_eq!((found.0, found.1, found.3), (vertices, faces, Some(unit)), "{file}");
        assert!(declared.is_none_or(|declared| (declared - found.2).abs() < 1e-4), "{file}: {}", found.2);
        assert!(!found.4.iter().any(|code| code.starts_with("landxml-")), "{file}: {:?}", found.4);
    }
}

fn lines(path: &Path, name: Option<&str>) -> Result<(usize, f64, f64, Vec<&'static str>), String> {
    let pick = Pick { features: name.map(str::to_owned).into_iter().collect(), ..Pick::default() };
    let raw = read::read_line(path, &ReadOptions { pick, ..ReadOptions::default() }).map_err(|e| e.to_string())?;
    let checked = validate::check(&raw, &validate::Options::default()).map_err(|e| e.to_string())?;
    let chains = &checked.line.chains;
    let length =
        chains.iter().flat_map(|c| (0..c.segment_count()).map(|i| c.segment(i))).map(|(a, b)| (b - a).truncate().length());
    let end = chains.last().and_then(|chain| chain.vertices.last()).map_or(f64::NAN, |v| v.z);
    Ok((chains.len(), length.sum(), end, raw.notes.iter().map(|note| note.code).collect()))
}

/// Lengths are those the files declare (chords take a little off the sum); heights at the end are those of the last point of the
/// profile, or follow from it by the last grade.
#[test]
fn alignments() {
    let Some(folder) = folder() else { return };
    for (file, name, length, end) in [
        ("PR_Twin_Branch_section_alignment.xml", None, 2_796.679, 717.6755),
        ("UT-Alignment-Aplitop-1.xml", None, 507.067, 350.7),
        ("Y10_RS-CL.tg.xml", None, 37.339_894, 18.318_999),
        // From 0.018 to 48.601, where the profile is.
        ("Y11_RS-CL.tg.xml", None, 48.583, 17.503),
        ("subdivision.xml", Some("1stave"), 773.579_824, 262.75),
        ("subdivision.xml", Some("2ndave"), 811.350_97, 256.05),
        ("subdivision.xml", Some("3rdave"), 631.563_335, 262.55),
        ("subdivision.xml", Some("4thave"), 971.735_095, f64::NAN),
        ("subdivision.xml", Some("mainst"), 1_390.312_76, f64::NAN),
        ("subdivision.xml", Some("loop/eg"), 7_494.173_616, f64::NAN),
    ] {
        let found = lines(&folder.join(file), name).unwrap_or_else(|e| panic!("{file}: {e}"));
        assert_eq!(found.0, 1, "{file}");
        assert!(found.1 < length + 1e-3 && found.1 > length * (1.0 - 1e-4), "{file} {name:?}: {}", found.1);
        assert!(end.is_nan() || (found.2 - end).abs() < 1e-3, "{file} {name:?}: {}", found.2);
        assert!(!found.3.contains(&"landxml-misfit") && !found.3.contains(&"landxml-length"), "{file}: {:?}", found.3);
    }
    // Two vertical curves of this one overlap: 200 at 645.423, of which half is more than what 150 at 478.590 leaves.
    let message = lines(&folder.join("subdivision.xml"), Some("loop")).unwrap_err();
    assert!(message.contains("the curve at station 645.423282 needs 100.0000 on one side, where there is 91.8329"), "{message}");
}

#[test]
fn other_lines() {
    let Some(folder) = folder() else { return };
    // 118 features of 2387 lines, all by names of points.
    let found = lines(&folder.join("Partridge_Survey.xml"), None).unwrap();
    assert!(found.0 >= 110, "{found:?}");
    // A parcel without heights, as a plan feature.
    let found = lines(&folder.join("polyline.xml"), None).unwrap();
    assert_eq!((found.0, found.3), (1, vec!["landxml-flat"]));
    let found = lines(&folder.join("Y10_Highest_Comb_rev2_Highest_combination_of_surface.mm.xml"), None).unwrap();
    assert_eq!(found.0, 13);
    let message = lines(&folder.join("subdivision.xml"), Some("Lot #1")).unwrap_err();
    assert!(message.contains("no elevations"), "{message}");
    assert!(lines(&folder.join("landfill_S4.xml"), None).unwrap_err().contains("holds no line"));
}

/// Centre lines of the two roads as another program has stroked them into the breaklines of its surfaces (code D121): their
/// points lie on our alignments, in plan and in height. This tries arcs, circular vertical curves and stations on figures that
/// are not ours.
#[test]
fn centre_lines_of_another_program() {
    let Some(folder) = folder() else { return };
    for (road, breakline) in [("Y10", "54"), ("Y11", "63")] {
        let vertices = |file: PathBuf, name: Option<&str>| {
            let pick = Pick { features: name.map(str::to_owned).into_iter().collect(), ..Pick::default() };
            let raw = read::read_line(&file, &ReadOptions { pick, chord: 1e-4, ..ReadOptions::default() }).unwrap();
            raw.lines[0].vertices.iter().map(|v| glam::DVec3::new(v.x, v.y, v.z.unwrap())).collect::<Vec<_>>()
        };
        let ours = vertices(folder.join(format!("{road}_RS-CL.tg.xml")), None);
        let theirs =
            vertices(folder.join(format!("{road}_Highest_Comb_rev2_Highest_combination_of_surface.mm.xml")), Some(breakline));
        // The ends are where other surfaces meet, between points of theirs.
        assert!(theirs.len() > 25);
        for p in &theirs[1..theirs.len() - 1] {
            let off = ours.windows(2).map(|w| {
                let d = w[1] - w[0];
                (*p - w[0] - d * ((*p - w[0]).dot(d) / d.length_squared()).clamp(0.0, 1.0)).length()
            });
            let off = off.fold(f64::INFINITY, f64::min);
            // Half a millimetre in each coordinate.
            assert!(off < 0.000_5 * 3_f64.sqrt() + 1e-4, "{road} {p}: {off}");
        }
    }
}
