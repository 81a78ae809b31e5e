//! Surfaces of other programs, from the folder named by the environment variable `SLOPEGEN_DATA`: each must be looked at, and
//! what is known to be wrong with it must be found. Without the folder nothing is tested here.

#![allow(clippy::print_stderr, reason = "tells what was skipped")]

mod common;

use std::path::{Path, PathBuf};

/// Codes of errors and remarks, and the exit code.
fn check(path: &Path) -> (Option<i32>, Vec<String>, serde_json::Value) {
    let report = tempfile::NamedTempFile::with_suffix(".json").unwrap();
    let output = assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
        .args(["check", "-q", "--report"])
        .args([report.path(), path])
        .output()
        .unwrap();
    let json: serde_json::Value = serde_json::from_slice(&std::fs::read(report.path()).unwrap()).unwrap_or_default();
    assert!(
        json.is_null() || common::schema::faults(&json).is_empty(),
        "{}: {:?}",
        path.display(),
        common::schema::faults(&json)
    );
    let findings = json["findings"].as_array().cloned().unwrap_or_default();
    let codes = findings.iter().map(|f| format!("{} {}", f["code"].as_str().unwrap(), f["count"])).collect();
    (output.status.code(), codes, json)
}

#[test]
fn what_is_wrong_is_found() {
    let Some(folder) = std::env::var_os("SLOPEGEN_DATA").map(PathBuf::from) else {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
        return;
    };
    // Numbers are those of the folder's own manifest: seven faces twice, a vertex of seven faces that is no number, and so on.
    for (name, code, findings) in [
        ("quirks/terrain_crlf.obj", 0, &[][..]),
        ("quirks/terrain_bbe_f64.ply", 0, &[]),
        ("quirks/terrain_huge_offset.obj", 0, &[]),
        ("quirks/terrain_cw.obj", 0, &["clockwise 2666"]),
        ("quirks/terrain_unused_vertices.obj", 0, &["unused 5"]),
        ("quirks/terrain_soup.obj", 0, &["unshared 6590"]),
        ("quirks/terrain_hole.obj", 0, &["hole 1", "unused 11"]),
        ("quirks/terrain_dup_and_degenerate.obj", 5, &["degenerate 1", "duplicate 7"]),
        ("quirks/terrain_nan.obj", 5, &["not-finite 1", "not-usable 7", "hole 1"]),
        ("quirks/terrain_overhang.obj", 5, &["overlap 1", "crack 2", "pieces 2"]),
        ("truth/12d_dual_carriageway/ground.obj", 0, &["needle 3"]),
    ] {
        let (status, codes, _) = check(&folder.join(name));
        assert_eq!(
            (status, codes.as_slice()),
            (Some(code), findings.iter().map(|f| f.to_string()).collect::<Vec<_>>().as_slice()),
            "{name}"
        );
    }
    for name in ["quirks/terrain_bad_index.obj", "quirks/terrain_truncated.ply"] {
        assert_eq!(check(&folder.join(name)).0, Some(3), "{name}");
    }
    for name in ["cut_solid.obj", "fill1_solid.obj", "fill2_solid.obj", "fill3_solid.obj"] {
        let (status, codes, _) = check(&folder.join("truth/12d_dual_carriageway").join(name));
        assert!(status == Some(5) && codes.contains(&"closed 1".to_owned()), "{name}: {codes:?}");
    }
    // Batters of 1V:4H and 1V:3H beside carriageways that fall 2 %: atan(1/4) = 14.04°, atan(1/3) = 18.43°, atan(0.02) = 1.15°.
    let (_, _, json) = check(&folder.join("truth/12d_dual_carriageway/design_faces.obj"));
    let common: Vec<f64> = json["slopes"]["common"].as_array().unwrap().iter().map(|c| c["degrees"].as_f64().unwrap()).collect();
    for expected in [14.04, 18.43] {
        assert!(common.iter().any(|c| (c - expected).abs() < 0.06), "{expected} in {common:?}");
    }
}
