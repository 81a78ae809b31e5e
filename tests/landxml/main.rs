//! LandXML and InfraModel in: surfaces, alignments and other lines, hostile files, files of other programs.

mod hostile;
mod lines;
mod real;
mod site;
mod surfaces;

use slopegen::model::Note;
use slopegen::read::terrain::{RawTerrain, TerrainOptions, parse_terrain};
use slopegen::read::{self, InputFormat, Pick, RawInput, ReadOptions};

/// A file of metres with this content.
fn file(content: &str) -> String {
    format!(
        "<?xml version=\"1.0\"?>\n<LandXML version=\"1.2\">\n<Units><Metric linearUnit=\"meter\"/></Units>\n{content}\n</LandXML>\n"
    )
}

fn ground(bytes: impl AsRef<[u8]>) -> Result<RawTerrain, String> {
    surface(bytes, None)
}

fn surface(bytes: impl AsRef<[u8]>, name: Option<&str>) -> Result<RawTerrain, String> {
    let pick = Pick { surface: name.map(str::to_owned), ..Pick::default() };
    let options = TerrainOptions { pick, ..TerrainOptions::of(InputFormat::LandXml) };
    parse_terrain("a.xml", bytes.as_ref(), &options).map_err(|e| e.to_string())
}

fn lines(bytes: impl AsRef<[u8]>, names: &[&str]) -> Result<RawInput, String> {
    let pick = Pick { features: names.iter().map(|&name| name.to_owned()).collect(), ..Pick::default() };
    let options = ReadOptions { pick, chord: CHORD, ..ReadOptions::of(InputFormat::LandXml) };
    read::parse_line("a.xml", bytes.as_ref(), &options).map_err(|e| e.to_string())
}

/// Chord error of the tests, in the unit of the file.
const CHORD: f64 = 0.002;

fn codes(notes: &[Note]) -> Vec<&'static str> {
    notes.iter().map(|note| note.code).collect()
}
