//! Reports of the shipped examples, pinned. After a change that is meant, run the tests with `UPDATE_GOLDEN=1` and read the
//! difference.

use super::Site;
use std::path::Path;

#[track_caller]
fn pinned(name: &str, arguments: &str) {
    let site = Site::new();
    let run = site.run(&format!("{arguments} -o m.obj --report - --threads 1"));
    let report = run.done();
    assert_eq!(site.run(&format!("{arguments} -o m.obj --report - --threads 2")).done(), report, "on two threads");
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden").join(format!("{name}.txt"));
    if std::env::var_os("UPDATE_GOLDEN").is_some() {
        std::fs::write(path, report).unwrap();
    } else {
        let golden = std::fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
        assert_eq!(report, golden, "{}; after a change that is meant run the test with UPDATE_GOLDEN=1", path.display());
    }
}

#[test]
fn road_embankment() {
    pinned("road_embankment", "build road.geojson --slope 1:1.5");
}

#[test]
fn road_cutting() {
    pinned("road_cutting", "build road.geojson --slope 1:1 --direction up --distance 20 --side left");
}

#[test]
fn pad_above_level_ground() {
    pinned("pad_above_level_ground", "build pad.geojson --slope 1:2 --to-elevation 405");
}

#[test]
fn pit_inside_a_rim() {
    pinned("pit_inside_a_rim", "build pit.csv --closed --side inside --slope 45deg --height 6");
}
