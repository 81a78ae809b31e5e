//! The same bytes on any number of threads, and however often.

use crate::common::build::{design, line};
use crate::common::lines::{Random, case, crossing_roads, road, star};
use crate::common::oracle::Polyline;
use slopegen::model::{Design, Extent, Sheet, Side};
use slopegen::surface::{self, Surface};
use slopegen::write::{Head, LineFormat, MeshFormat};
use std::fs;
use std::path::Path;

/// Everything that is written of a surface.
fn bytes(surface: &Surface) -> Vec<u8> {
    let mut bytes = Vec::new();
    let head = Head { lines: &surface.lines, ..Head::default() };
    for format in [MeshFormat::Obj, MeshFormat::Ply, MeshFormat::LandXml, MeshFormat::Dxf, MeshFormat::Stl, MeshFormat::Glb] {
        format.write(&mut bytes, &surface.tin, &head).expect("a sink in memory");
    }
    for format in [LineFormat::GeoJson, LineFormat::LandXml, LineFormat::Dxf] {
        format.write(&mut bytes, &head).expect("a sink in memory");
    }
    // Figures of the report, to the last bit: `{:?}` of a number reads back as the same number.
    let figures = (&surface.levels, &surface.buried, surface.certificate, &surface.areas, &surface.volumes, &surface.notes);
    bytes.extend(format!("{figures:?} {} {}", surface.simplified, surface.simplified_max).into_bytes());
    bytes
}

fn on_threads(threads: usize, lines: &[Polyline], design: &Design) -> Vec<u8> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
    pool.install(|| bytes(&surface::build(&line(lines), design, None, &()).unwrap_or_else(|e| panic!("{design:?}: {e}"))))
}

#[track_caller]
fn same_on_any_number_of_threads(name: &str, lines: &[Polyline], design: &Design) {
    let expected = on_threads(1, lines, design);
    for threads in [1, 2, 5] {
        // Not assert_eq: the bytes are too many to print.
        assert!(on_threads(threads, lines, design) == expected, "{name}: other bytes on {threads} threads");
    }
}

#[test]
fn small_lines_of_all_kinds() {
    for seed in 0..30 {
        let case = case(seed, 40);
        let extent = [Extent::Distance(5.0), Extent::Height(4.0 * case.k)][seed as usize % 2];
        let sheet = [Sheet::Falling, Sheet::Rising][seed as usize / 2 % 2];
        let wanted = Design { sheet, side_of_rings: Side::Both, tolerance: 0.01, ..design(case.k, extent) };
        same_on_any_number_of_threads(&case.name, &case.lines, &wanted);
    }
}

/// Large enough that the work is really shared out.
#[test]
fn large_lines() {
    let k = 0.5;
    let random = &mut Random::new(11);
    let noisy = vec![star(random, 3_000, 200.0, 6.0, 0.02, k)];
    let rough = vec![road(random, 1_000, 4.0, true, k)];
    let crossing = crossing_roads(random, 60, 4.0, k);
    for (name, lines) in [("noisy ring", noisy), ("rough road", rough), ("crossing roads", crossing)] {
        let wanted = Design { tolerance: 0.01, ..design(k, Extent::Distance(12.0)) };
        same_on_any_number_of_threads(name, &lines, &wanted);
    }
}

/// The program itself: meshes, line work and JSON report (its times aside), twice on one thread and on two.
#[test]
fn files() {
    let lines = [star(&mut Random::new(5), 2_000, 150.0, 5.0, 0.02, 0.5)];
    let folder = tempfile::tempdir().expect("a folder");
    let ring: String = lines[0].points.iter().map(|p| format!("{},{},{}\n", p[0], p[1], p[2])).collect();
    fs::write(folder.path().join("ring.csv"), format!("x,y,z\n{ring}")).expect("written");
    let expected = run(folder.path(), "1");
    assert!(expected.iter().all(|(_, content)| !content.is_empty()));
    for threads in ["1", "2", "2", "4"] {
        for ((name, now), (_, before)) in run(folder.path(), threads).iter().zip(&expected) {
            assert!(now == before, "{name}: other bytes on {threads} threads");
        }
    }
}

/// Builds and reads what was written.
fn run(folder: &Path, threads: &str) -> Vec<(&'static str, Vec<u8>)> {
    let outputs = ["m.obj", "m.ply", "l.geojson", "r.json"];
    let arguments = "build ring.csv --closed --slope 1:2 --distance 15 -o m.obj -o m.ply --lines l.geojson --report r.json";
    assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
        .args(arguments.split(' ').chain(["--threads", threads]))
        .current_dir(folder)
        .timeout(std::time::Duration::from_secs(120))
        .assert()
        .success();
    assert_eq!(crate::common::schema::check_folder(folder), 1);
    let read = |name: &'static str| {
        let content = fs::read(folder.join(name)).expect(name);
        (name, if name == "r.json" { without_times(&content) } else { content })
    };
    outputs.map(read).to_vec()
}

/// Works on ground with every kind of output, volumes between meshes, and heights.
#[test]
fn every_output_of_the_program() {
    let folder = tempfile::tempdir().expect("a folder");
    let fixtures = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    for name in ["hill_road.geojson", "ground.obj", "road.geojson"] {
        fs::copy(fixtures.join(name), folder.path().join(name)).expect("a fixture");
    }
    let build = "build hill_road.geojson --width 7 --terrain ground.obj --cut-slope 1:1 --fill-slope 1:1.5 --stations 20 --cell 2 \
                 -o w.obj -o w.ply -o w.xml -o w.dxf -o w.stl -o w.glb -o w.tif -o w.asc --finished f.obj --finished f.ply --finished f.xml \
                 --lines l.geojson --lines l.xml --lines l.dxf --stakes s.csv --station-table t.csv --plot plan.svg --plot profile.svg \
                 --plot sections.svg --plot haul.svg --report r.json --report r.txt --report r.md --report r.html";
    let volume = "volume f.obj ground.obj --report v.json --report v.txt --report v.md --report v.html --quiet";
    let sample = "sample road.geojson --slope 1:1.5 --raster h.asc --cell 2";
    let outputs = |threads: &str| {
        for command in [build, volume, sample] {
            assert_cmd::Command::new(env!("CARGO_BIN_EXE_slopegen"))
                .args(command.split_whitespace().chain(["--threads", threads]))
                .current_dir(folder.path())
                .timeout(std::time::Duration::from_secs(300))
                .assert()
                .success();
        }
        let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(folder.path())
            .expect("a folder")
            .map(|entry| entry.expect("a file").path())
            .map(|path| (path.file_name().expect("a name").to_string_lossy().into_owned(), fs::read(&path).expect("content")))
            .collect();
        files.sort();
        for (_, content) in files.iter_mut().filter(|(name, _)| ["r.json", "v.json"].contains(&name.as_str())) {
            *content = without_times(content);
        }
        files
    };
    let expected = outputs("1");
    assert!(expected.len() > 30, "{} files", expected.len());
    for threads in ["2", "5"] {
        for ((name, now), (_, before)) in outputs(threads).iter().zip(&expected) {
            assert!(now == before, "{name}: other bytes on {threads} threads");
        }
    }
}

/// A report without the one key that may differ from run to run; the order of the others counts.
fn without_times(report: &[u8]) -> Vec<u8> {
    let text = std::str::from_utf8(report).expect("UTF-8");
    let timing = text.find("\n  \"timing\": {").expect("the report has times");
    let end = timing + text[timing..].find('}').expect("times end");
    [&text[..timing], &text[end..]].concat().into_bytes()
}
