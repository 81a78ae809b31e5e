//! Disks that are full, files that may not grow, folders that go away.

use super::{Run, Site};
use std::fs;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// One job for each kind of output, with the name of the output.
const JOBS: [(&str, &str); 13] = [
    ("o.obj", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o o.obj"),
    ("o.ply", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o o.ply"),
    ("o.xml", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o o.xml"),
    ("o.dxf", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o o.dxf"),
    ("o.stl", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o o.stl"),
    ("o.glb", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o o.glb"),
    ("o.asc", "build ring.csv --closed --slope 1:1 -q --cell 0.2 -o o.asc"),
    ("o.geojson", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o /dev/null --lines o.geojson"),
    ("o.html", "build ring.csv --closed --slope 1:1 -q -o /dev/null --report o.html"),
    ("plan.svg", "build ring.csv --closed --slope 1:1 --interval 0.05 -q -o /dev/null --plot plan.svg"),
    ("r.asc", "sample ring.csv --closed --slope 1:1 --raster r.asc --cell 0.2 -q"),
    ("p.csv", "sample ring.csv --closed --slope 1:1 --at ground.csv -o p.csv -q"),
    ("i.json", "info ground.ply -q --report i.json"),
];

/// Points, enough for a large table.
fn points(site: &Site) {
    let rows: String = (0..5000).map(|i| format!("{},{}\n", i % 70, i / 70)).collect();
    fs::write(site.path("ground.csv"), format!("x,y\n{rows}")).unwrap();
}

#[test]
fn files_beyond_what_the_shell_allows() {
    let site = Site::new(20);
    points(&site);
    for (name, job) in JOBS {
        // Blocks of 1024 bytes; a report of `info` is short.
        let blocks = if name == "i.json" { 0 } else { 8 };
        let run = Run::of(site.behind(&format!("ulimit -f {blocks}"), job));
        assert_eq!(run.code(), 4, "{job}: {}", run.stderr);
        let expected = format!("error: the output could not be written\n  --> {name}\n   = File too large (os error 27)");
        assert!(run.stderr.starts_with(&expected), "{job}: {}", run.stderr);
        assert!(run.stderr.contains("\n   = help: no part of the file was left behind"), "{job}: {}", run.stderr);
        assert_eq!(site.files(), ["ground.csv"], "{job}");
    }
    // How far it came.
    let run = Run::of(site.behind("ulimit -f 8", JOBS[0].1));
    assert!(run.stderr.contains("(os error 27), after 8192 bytes\n"), "{}", run.stderr);
    let run = Run::of(site.behind("ulimit -f 0", "man --out ."));
    assert!(run.code() == 4 && run.stderr.contains("File too large"), "{}", run.stderr);
    assert_eq!(site.files(), ["ground.csv"]);
}

#[test]
fn a_full_disk() {
    let site = Site::new(20);
    points(&site);
    fs::create_dir(site.path("small")).unwrap();
    // A small file system, seen by the command only.
    let on_small_disk = |command: &str| {
        let script = format!("mount -t tmpfs -o size=16k none small && cd small && {command}");
        let mut unshare = Command::new("unshare");
        unshare.args(["-m", "sh", "-c", &script]);
        site.here(unshare)
    };
    if !on_small_disk("true").status().is_ok_and(|status| status.success()) {
        eprintln!("SKIPPED: a small file system cannot be mounted here (needs root and `unshare -m`)");
        return;
    }
    for (name, job) in JOBS.iter().filter(|(name, _)| *name != "i.json") {
        let job = job.replace("ring.csv", "../ring.csv").replace("ground.csv", "../ground.csv");
        let run = Run::of(on_small_disk(&format!("{} {job}; code=$?; ls -A; exit $code", env!("CARGO_BIN_EXE_slopegen"))));
        assert_eq!(run.code(), 4, "{job}: {}", run.stderr);
        assert!(run.stderr.contains(&format!("--> {name}\n   = No space left on device (os error 28)")), "{job}: {}", run.stderr);
        assert_eq!(run.stdout, "", "{job}: left behind");
    }
}

#[test]
fn a_folder_that_goes_away() {
    let site = Site::new(3);
    fs::create_dir(site.path("out")).unwrap();
    let mut command = site.program("build - --input-format csv --slope 1:1.5 -q -o a.obj -o out/b.obj");
    let mut child = command.stdin(Stdio::piped()).spawn().unwrap();
    let begun = std::time::Instant::now();
    while fs::read_dir(site.path("out")).unwrap().count() == 0 {
        assert!(begun.elapsed() < super::PATIENCE, "the outputs were never opened");
        std::thread::sleep(std::time::Duration::from_millis(5));
    }
    fs::remove_dir_all(site.path("out")).unwrap();
    child.stdin.take().unwrap().write_all(b"x,y,z\n0,0,10\n50,0,11\n").unwrap();
    let output = child.wait_with_output().unwrap();
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(4), "{stderr}");
    assert!(stderr.starts_with("error: the output cannot be created\n  --> out/b.obj\n"), "{stderr}");
    // The one that had its name already has gone again.
    assert!(site.files().is_empty(), "{:?}", site.files());
}
