//! Runs over a folder of awkward files, named by the environment variable `SLOPEGEN_DATA`: each line file named in
//! `quirks/manifest.csv` must be accepted or refused as the manifest says. Without the folder nothing is tested here; the
//! files under `fixtures/input` cover the same cases in small.

#![allow(clippy::print_stderr, reason = "tells what was skipped, and what each file gave")]

use slopegen::read::{self, ReadOptions};
use slopegen::validate::{self, Options};
use std::path::{Path, PathBuf};

/// The outcome in words.
fn outcome(path: &Path) -> Result<usize, String> {
    let name = path.file_name().and_then(|n| n.to_str()).unwrap_or("");
    let order = match name {
        "road_pnezd.csv" => Some("pnezd"),
        "road_noheader.csv" | "road_spaces.txt" | "two_lines_blank_separated.txt" => Some("xyz"),
        _ => None,
    };
    let options = ReadOptions { csv_order: order.map(|o| o.parse().unwrap()), ..ReadOptions::default() };
    let raw = read::read_line(path, &options).map_err(|e| e.to_string())?;
    let closed = name == "pad_open.csv";
    let checked = validate::check(&raw, &Options { closed }).map_err(|e| e.to_string())?;
    let slope = slopegen::model::Slope::from_ratio(1.0 / 1.5).unwrap();
    validate::check_steepness(&checked.line, &raw.source.label, slope).map_err(|e| e.to_string())?;
    Ok(checked.line.chains.len())
}

#[test]
fn awkward_files_are_taken_or_refused_as_listed() {
    let Some(folder) = std::env::var_os("SLOPEGEN_DATA").map(|d| PathBuf::from(d).join("quirks")) else {
        eprintln!("skipped: SLOPEGEN_DATA is not set");
        return;
    };
    let manifest = std::fs::read_to_string(folder.join("manifest.csv")).expect("quirks/manifest.csv");
    let mut wrong = Vec::new();
    let mut count = 0;
    for row in manifest.lines().skip(1) {
        let mut fields = row.split(',');
        let (Some(name), Some(expected)) = (fields.next(), fields.next()) else { continue };
        let is_line = ["road_", "pad_", "two_lines_"].iter().any(|p| name.starts_with(p)) || name == "terrain_lonlat.csv";
        if !is_line || name.ends_with(".dxf") {
            continue;
        }
        count += 1;
        let found = outcome(&folder.join(name));
        eprintln!(
            "{name}: {expected}\n{}\n",
            match &found {
                Ok(n) => format!("{n} chains"),
                Err(e) => e.clone(),
            }
        );
        let must_pass = expected == "same" || expected == "same_f32" || expected.starts_with("differ");
        let must_fail = !["same", "warn", "differ"].iter().any(|word| expected.contains(word));
        let lonlat = name.contains("lonlat");
        let two = name.starts_with("two_lines");
        match found {
            Ok(n) if must_fail || lonlat || (two && n != 2) => wrong.push(format!("{name}: accepted with {n} chains")),
            Err(e) if must_pass => wrong.push(format!("{name}: {e}")),
            _ => {}
        }
    }
    assert!(count > 50, "only {count} files found");
    assert!(wrong.is_empty(), "{}", wrong.join("\n\n"));
}
