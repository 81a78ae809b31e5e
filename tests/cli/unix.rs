//! Devices, pipes and signals.

use super::Site;
use std::io::{BufRead, BufReader, Read};
use std::process::{Command, Stdio};

fn program(site: &Site, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_slopegen"));
    command.args(arguments.split_whitespace()).current_dir(site.folder.path()).stdin(Stdio::null());
    command
}

#[test]
fn a_reader_that_leaves_is_no_error() {
    let site = Site::new();
    // More than a pipe holds.
    for arguments in [
        "build road.geojson --slope 1:1.5 --interval 0.05 -o - -o m.ply",
        "sample road.geojson --slope 1:1.5 --raster - --cell 0.5",
    ] {
        let mut child = program(&site, arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        let mut first = String::new();
        BufReader::with_capacity(16, child.stdout.take().unwrap()).read_line(&mut first).unwrap();
        assert!(!first.is_empty());
        let mut stderr = String::new();
        child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(0), "{stderr}");
        assert!(!stderr.contains("error"), "{stderr}");
    }
    assert_eq!(site.new_files(), ["m.ply"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk() {
    let site = Site::new();
    site.run("build road.geojson --slope 1:1.5 -o a.obj --report r.json --lines /dev/full").refused(
        4,
        "error: the output could not be written\n  --> /dev/full\n   = No space left on device (os error 28)\n   \
         = help: what came out is not complete; make room or name another place",
    );
    assert!(site.new_files().is_empty(), "{:?}", site.new_files());
    for arguments in [
        "build road.geojson --slope 1:1.5",
        "build road.geojson --slope 1:1.5 -o -",
        "sample road.geojson --slope 1:1.5 --raster - --cell 5",
        "--help",
    ] {
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let output = program(&site, arguments).stdout(full).stderr(Stdio::piped()).output().unwrap();
        assert_eq!(output.status.code(), Some(4), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(site.new_files().is_empty(), "{arguments}: {:?}", site.new_files());
    }
}

#[test]
fn devices() {
    let site = Site::new();
    site.run("build road.geojson --slope 1:1.5 -o /dev/null --report /dev/null --lines /dev/null").done();
    assert!(site.new_files().is_empty());
    // A file of any name is fine as a device is; as a new file it is not.
    site.run("sample road.geojson --slope 1:1.5 --raster /dev/null --cell 5").done();
}

#[test]
fn a_closed_standard_error_is_no_panic() {
    let site = Site::new();
    let script = format!("{} build road.geojson --slope 1:0.5 2>&-", env!("CARGO_BIN_EXE_slopegen"));
    let status = Command::new("sh").args(["-c", &script]).current_dir(site.folder.path()).status().unwrap();
    assert_eq!(status.code(), Some(2));
}

#[test]
fn an_interrupt_leaves_no_files() {
    if super::interrupts_are_ignored() {
        return;
    }
    let site = Site::new();
    // The line never comes: the outputs are open, and the program waits for it.
    let mut child = program(&site, "build - --input-format csv --slope 1:1.5 -o a.obj --report r.json")
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let begun = std::time::Instant::now();
    while site.new_files().len() < 2 {
        assert!(begun.elapsed() < super::PATIENCE, "the outputs were never opened");
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    // Held open: waiting for the child would close it, and the program would see an empty input.
    let stdin = child.stdin.take();
    let id = child.id().to_string();
    assert!(Command::new("kill").args(["-INT", &id]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    drop(stdin);
    assert!(site.new_files().is_empty(), "{:?}", site.new_files());
}
