//! What is fuzzed: one function of bytes for each target. They panic where something is wrong, and so does the program.
//!
//! The fuzzers call them, and so does `tests/fuzz_corpus.rs`, with the files under `fixtures/fuzz`.

mod choices;
mod drawn;
mod engine;
mod exact;
mod files;
mod ground;
mod grounds;
pub(crate) mod limits;
mod lines;
mod messages;
#[path = "../../../common/oracle.rs"]
#[allow(dead_code, reason = "other tests use the rest")]
mod oracle;
mod overlay;
mod tins;
mod words;
mod written;

use slopegen::read::InputFormat;

/// A name, and what is done with the bytes.
type Target = (&'static str, fn(&[u8]));

/// All targets by name.
pub(crate) const TARGETS: &[Target] = &[
    ("csv", |bytes| lines::read(bytes, InputFormat::Csv)),
    ("geojson", |bytes| lines::read(bytes, InputFormat::GeoJson)),
    ("landxml", |bytes| lines::read(bytes, InputFormat::LandXml)),
    ("dxf", |bytes| lines::read(bytes, InputFormat::Dxf)),
    ("gpx", |bytes| lines::read(bytes, InputFormat::Gpx)),
    ("landxml_ground", |bytes| grounds::read(bytes, InputFormat::LandXml)),
    ("dxf_ground", |bytes| grounds::read(bytes, InputFormat::Dxf)),
    ("points", |bytes| grounds::read(bytes, InputFormat::Csv)),
    ("obj", |bytes| grounds::read(bytes, InputFormat::Obj)),
    ("ply", |bytes| grounds::read(bytes, InputFormat::Ply)),
    ("asc", |bytes| grounds::read(bytes, InputFormat::Asc)),
    ("geotiff", |bytes| grounds::read(bytes, InputFormat::GeoTiff)),
    ("las", |bytes| grounds::read(bytes, InputFormat::Las)),
    ("job", files::job),
    ("arguments", files::arguments),
    ("report", files::report),
    ("words", words::run),
    ("engine", engine::run),
    ("ground", ground::run),
    ("overlay", overlay::run),
];
