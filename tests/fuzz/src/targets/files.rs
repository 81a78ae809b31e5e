//! What is read from files only: job files, reports to be compared, and the command line.

use super::choices::Choices;
use super::messages::telling;
use slopegen::cli;
use slopegen::model::Note;
use slopegen::pipeline::{Bounds, DiffJob, Most, Observer, diff};
use slopegen::read::terrain::TerrainOptions;
use slopegen::report::ReportFormat;
use slopegen::surface::Watch;
use std::ffi::OsString;
use std::fs;
use std::path::PathBuf;

/// Listens to nothing.
struct Nobody;

impl Watch for Nobody {}

impl Observer for Nobody {
    fn note(&self, _: &Note) {}
}

/// A file of this process and thread.
fn file(name: &str, bytes: &[u8]) -> PathBuf {
    let thread = format!("{:?}", std::thread::current().id()).replace(['(', ')'], "");
    let folder = std::env::temp_dir().join(format!("slopegen-fuzz-{}-{thread}", std::process::id()));
    fs::create_dir_all(&folder).expect("there is room for temporary files");
    let path = folder.join(name);
    fs::write(&path, bytes).expect("there is room for temporary files");
    path
}

/// A job file, understood but not run.
pub(crate) fn job(bytes: &[u8]) {
    let path = file("a.toml", bytes);
    let arguments = ["slopegen", "build"].map(OsString::from).into_iter().chain([path.into_os_string()]);
    if let Err(message) = cli::understand(arguments) {
        telling(&message);
    }
}

/// Arguments, parted by line ends, understood but not carried out.
pub(crate) fn arguments(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let arguments = std::iter::once("slopegen").chain(text.split('\n')).map(OsString::from);
    if let Err(message) = cli::understand(arguments) {
        assert!(!message.is_empty());
    }
}

/// Two reports, parted by a zero byte, compared with bounds of all kinds.
pub(crate) fn report(bytes: &[u8]) {
    let mut choices = Choices::new(bytes);
    let flags = choices.byte();
    let most = |bit: u8| (flags & bit != 0).then_some(if flags & 1 == 0 { Most::Figure(1.0) } else { Most::Share(0.5) });
    let bounds = Bounds { volume: most(2), area: most(4), height: (flags & 8 != 0).then_some(0.5), exact: flags & 16 != 0 };
    let rest = choices.rest();
    let cut = rest.iter().position(|b| *b == 0).unwrap_or(rest.len());
    let (first, second) = (&rest[..cut], rest.get(cut + 1..).unwrap_or(rest));
    let (first, second) = (file("a.json", first), file("b.json", second));
    let target = slopegen::write::Target::File(first.with_file_name("diff.json"));
    let job = DiffJob { first, second, options: TerrainOptions::default(), bounds, reports: vec![(target, ReportFormat::Json)] };
    match diff(&job, &Nobody) {
        Err(error) => telling(&error.to_string()),
        Ok(found) => {
            assert_eq!(found.report.same, found.report.changes.as_ref().is_some_and(|c| c.iter().all(|c| !c.counts)));
            assert!(!slopegen::report::render_diff(&found.report).is_empty());
        }
    }
}
