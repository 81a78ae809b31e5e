//! Memory that is not there: refused before it is taken, or told when it runs out.

use super::{Run, Site};
use std::fs;
use std::os::unix::process::ExitStatusExt as _;

#[test]
fn amounts_are_read_strictly() {
    let site = Site::new(3);
    let run = site.run("build road.csv --slope 1:1 --max-memory 2000 --threads 0");
    assert_eq!(run.code(), 2);
    assert_eq!(
        run.stderr,
        "error: `0` is not a number of threads\n  --> --threads 0\n   = help: give a whole number from 1 to 1024\n\
         error: an amount of memory needs a unit\n  --> --max-memory 2000\n   \
         = help: give a number and a unit, such as `2GB` or `1500MiB`\n"
    );
    for command in
        ["sample road.csv --slope 1:1 --raster r.asc --cell 1", "check ground.ply", "volume ground.ply --to-elevation 1"]
    {
        assert_eq!(site.run(&format!("{command} --max-memory -1GB")).code(), 2, "{command}");
    }
    assert!(site.files().is_empty());
}

#[test]
fn work_that_would_not_fit_is_refused() {
    let site = Site::new(400);
    fs::write(site.path("job.toml"), "input = 'road.csv'\nterrain = 'ground.ply'\nslope = '1:1.5'\noutput = 'j.obj'\n").unwrap();
    // What is asked for, the limit, and what would not fit: from the file itself to what comes out of it.
    for (arguments, limit, message) in [
        (
            "build road.csv --slope 1:1.5 --terrain ground.ply -o o.obj",
            "16MB",
            "to read the file\n  --> ground.ply\n   = its 8.0 MB would take about 18.0 MB; 16.0 MB are allowed, by `--max-memory`\n",
        ),
        // The mesh that is read beside it: 24 × 160 000 and 12 × 318 402 bytes; 66 for each triangle, and 10 MB.
        (
            "volume ground.ply ground.ply",
            "50MB",
            "to compare the surfaces\n  --> ground.ply\n   = 636804 triangles would take about 67.4 MB; 50.0 MB",
        ),
        ("diff ground.ply ground.ply", "50MB", "to compare the surfaces\n"),
        ("check ground.ply", "35MB", "to check the mesh\n  --> ground.ply\n   = its 318402 triangles would"),
        ("info ground.ply", "32MB", "to "),
        ("build road.csv --slope 1:1.5 --terrain ground.ply -o o.ply --finished f.ply", "34MB", "to cut the ground\n"),
        (
            "build ring.csv --closed --slope 1:1 --height 9 --interval 0.0012 -o o.ply",
            "200MB",
            "to build the surface\n  --> ring.csv\n",
        ),
        ("build ring.csv --closed --slope 1:1 --cell 0.01 -o o.asc", "100MB", "to make the raster\n"),
        ("sample ring.csv --closed --slope 1:1 --raster r.asc --cell 0.01", "100MB", "to make the raster\n"),
        ("batch job.toml -j 2", "16MB", "to read the file\n"),
    ] {
        let run = site.run(&format!("{arguments} --max-memory {limit}"));
        assert_eq!(run.code(), 6, "{arguments}: {}", run.stderr);
        let lines: Vec<&str> = run.stderr.lines().filter(|line| !line.starts_with("note[")).collect();
        let stderr = lines.join("\n");
        assert!(stderr.contains(&format!("error: there is not enough memory {message}")), "{arguments}: {stderr}");
        assert!(stderr.contains("or raise `--max-memory`"), "{arguments}: {stderr}");
        assert_eq!(site.files(), ["job.toml"], "{arguments}");
    }
}

/// The program itself is there once, however many jobs run.
#[test]
fn jobs_share_what_there_is_beside_the_program() {
    let site = Site::new(3);
    let names: Vec<String> = (1..=8).map(|i| format!("job{i}.toml")).collect();
    for (i, name) in names.iter().enumerate() {
        fs::write(site.path(name), format!("input = 'road.csv'\nslope = '1:1.5'\noutput = 'j{i}.obj'\n")).unwrap();
    }
    let run = site.run(&format!("batch {} --jobs 8 --max-memory 76MB", names.join(" ")));
    assert_eq!(run.code(), 0, "{}", run.stderr);
}

#[test]
fn the_limit_changes_no_result() {
    let site = Site::new(50);
    let job = "build road.csv --slope 1:1.5 --width 4 --terrain ground.ply -q --finished f.ply -o";
    assert_eq!(site.run(&format!("{job} a.obj")).code(), 0);
    let finished = fs::read(site.path("f.ply")).unwrap();
    assert_eq!(site.run(&format!("{job} b.obj --max-memory 1GB")).code(), 0);
    assert_eq!(fs::read(site.path("a.obj")).unwrap(), fs::read(site.path("b.obj")).unwrap());
    assert_eq!(finished, fs::read(site.path("f.ply")).unwrap());
}

/// Limits of a kind that the shell sets, over a job that would take more than most of them.
fn under(option: char, kilobytes: impl Iterator<Item = u32>) {
    let site = Site::new(230);
    // The estimates are put off, so that memory really runs out.
    let job = "build road.csv --slope 1:1.5 --width 4 --stations 20 --terrain ground.ply -q --max-memory 900GB -o o.obj -o o.glb \
               --finished f.obj --report r.html";
    let mut codes = Vec::new();
    for limit in kilobytes {
        let shell = format!("ulimit -c 0; ulimit -{option} {limit}");
        let run = Run::of(site.behind(&shell, job));
        if run.status.signal().is_some() && Run::of(site.behind(&shell, "--version")).status.signal().is_some() {
            // So little that the system ends the program while it loads it.
            assert!(site.files().is_empty(), "{limit}: {:?}", site.files());
            continue;
        }
        let code = run.code();
        codes.push(code);
        if code == 0 {
            assert_eq!(site.files(), ["f.obj", "o.glb", "o.glb.origin.json", "o.obj", "r.html"], "{limit}");
        } else {
            assert!(site.files().is_empty(), "{limit}: {:?}, {}", site.files(), run.stderr);
        }
        match code {
            0 => assert_eq!(run.stderr, "", "{limit}"),
            6 => assert!(run.stderr.starts_with("error: ") && run.stderr.contains("\n   = help: "), "{limit}: {}", run.stderr),
            // So little that the system cannot even load the program.
            _ => assert!(code == 127 || run.stderr.contains("cannot allocate memory"), "{limit}: {code}, {}", run.stderr),
        }
        site.clear();
    }
    assert!(codes.contains(&6), "{codes:?}");
}

#[test]
fn running_out_of_addresses_is_told() {
    under('v', (20_000..130_000).step_by(4_700));
}

#[cfg(target_os = "linux")]
#[test]
fn running_out_of_memory_is_told() {
    under('d', (1_000..60_000).step_by(2_300));
}

#[cfg(target_os = "linux")]
#[test]
fn an_endless_input_ends() {
    let site = Site::new(3);
    // A device has no length that could be looked at first.
    for arguments in ["volume /dev/zero --to-elevation 1", "check /dev/zero --input-format obj"] {
        let run = site.run(&format!("{arguments} --max-memory 60MB"));
        assert_eq!(run.code(), 6, "{arguments}: {}", run.stderr);
        assert!(run.stderr.starts_with("error: out of memory\n   = "), "{arguments}: {}", run.stderr);
        assert!(run.stderr.contains("; 60 MB are allowed in all, by `--max-memory`\n   = help: "), "{arguments}: {}", run.stderr);
    }
}

#[test]
fn nesting_is_no_matter_of_the_stack() {
    let site = Site::new(3);
    let deep = |open: &str, close: &str| format!("{}{}", open.repeat(200_000), close.repeat(200_000));
    let geojson = format!("{{\"type\":\"LineString\",\"coordinates\":{}}}", deep("[", "]"));
    let collection = deep("{\"type\":\"GeometryCollection\",\"geometries\":[", "]}");
    let xml = format!("<LandXML>{}</LandXML>", deep("<a>", "</a>"));
    let toml = format!("input = 'a.csv'\nslope = {}", deep("[", "]"));
    let tables = format!("input = 'a.csv'\n{}", deep("a = { ", "}"));
    let mut dxf = String::from("0\nSECTION\n2\nBLOCKS\n");
    for i in 0..20_000 {
        dxf += &format!("0\nBLOCK\n2\nB{i}\n10\n0\n20\n0\n0\nINSERT\n2\nB{}\n10\n0\n20\n0\n0\nENDBLK\n", i + 1);
    }
    dxf += "0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nINSERT\n2\nB0\n10\n0\n20\n0\n0\nENDSEC\n0\nEOF\n";
    for (name, text) in
        [("a.geojson", geojson), ("b.geojson", collection), ("c.xml", xml), ("d.toml", toml), ("e.toml", tables), ("f.dxf", dxf)]
    {
        fs::write(site.path(name), text).unwrap();
        for command in [format!("build {name} --slope 1:1.5 -o o.obj"), format!("info {name}")] {
            let run = site.run(&command);
            assert!(
                (0..=3).contains(&run.code()),
                "{command}: {:?} {}",
                run.status,
                run.stderr.chars().take(300).collect::<String>()
            );
        }
    }
}
