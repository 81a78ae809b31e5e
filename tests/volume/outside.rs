//! Figures of another program, from a folder of data named by the environment variable `SLOPEGEN_DATA`.

#![allow(clippy::print_stderr, reason = "tells what was skipped, and what was found")]

use super::*;
use slopegen::read::terrain::{TerrainOptions, read_terrain};
use std::path::{Path, PathBuf};

fn mesh(path: &Path) -> Terrain {
    let raw = read_terrain(path, &TerrainOptions::default()).unwrap_or_else(|e| panic!("{e}"));
    slopegen::terrain::prepare(raw).unwrap_or_else(|e| panic!("{e}")).terrain
}

/// A dual carriageway: design faces, ground, and the volumes of the solids that the design program wrote between them, with five
/// decimals.
#[test]
fn dual_carriageway() {
    let Some(folder) = std::env::var_os("SLOPEGEN_DATA").map(|d| PathBuf::from(d).join("truth/12d_dual_carriageway")) else {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
        return;
    };
    let found = volume(&mesh(&folder.join("design_faces.obj")), &mesh(&folder.join("ground.obj")));
    eprintln!("{found:?}");
    let truth: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(folder.join("truth.json")).unwrap()).unwrap();
    let figure = |part: &str, key: &str| truth[part][key].as_f64().unwrap();
    let area = ["fill1", "fill2", "fill3"].iter().map(|part| figure(part, "plan_area_m2")).sum::<f64>();
    near(found.cut, figure("total", "cut_m3"), 1e-6);
    near(found.fill, figure("total", "fill_m3"), 1e-6);
    near(found.areas.cut, figure("cut", "plan_area_m2"), 1e-6);
    near(found.areas.fill, area, 1e-6);
}
