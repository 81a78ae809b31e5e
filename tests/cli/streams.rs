//! Standard input and output.

use super::Site;

#[test]
fn from_standard_input() {
    let site = Site::new();
    let road = site.read("road.geojson");
    let run = site.run_with("build - --input-format geojson --slope 1:1.5 --report r.json --report -", road.clone());
    assert!(run.done().contains("  line                - (geojson, "), "{}", run.stdout);
    assert_eq!(site.new_files(), ["r.json", "slopegen.obj"]);
    // The same bytes from a file.
    site.run("build road.geojson --slope 1:1.5 -o file.obj").done();
    assert_eq!(site.read("slopegen.obj"), site.read("file.obj"));
}

#[test]
fn standard_output_belongs_to_one_output() {
    let site = Site::new();
    site.run("build road.geojson --slope 1:1.5 -o a.obj --lines a.geojson").done();
    let mesh = site.run("build road.geojson --slope 1:1.5 -o -");
    assert_eq!(mesh.done(), site.read("a.obj"));
    let lines = site.run("build road.geojson --slope 1:1.5 -o b.obj --lines -");
    assert_eq!(lines.done(), site.read("a.geojson"));
    let report = site.run("build road.geojson --slope 1:1.5 -o b.obj --report -");
    assert!(report.done().starts_with("slopegen "));
    assert_eq!(site.new_files(), ["a.geojson", "a.obj", "b.obj"]);
}

#[test]
fn quiet_means_quiet() {
    let site = Site::new();
    let run = site.run("build road.geojson --slope 1:1.5 --quiet");
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
    assert_eq!(site.new_files(), ["road.obj"]);
    // What was asked for by name is still written.
    let run = site.run("build road.geojson --slope 1:1.5 -q --report -");
    assert!(run.stdout.starts_with("slopegen ") && run.stderr.is_empty());
    let run = site.run("build missing.csv --slope 1:1.5 -q");
    assert!(run.code == 3 && run.stderr.starts_with("error: "), "{run:?}");
}

#[test]
fn verbose_tells_the_times() {
    let site = Site::new();
    let run = site.run("build road.geojson --slope 1:1.5 -v");
    run.done();
    for stage in ["read", "check", "write"] {
        assert!(run.stderr.lines().any(|l| l.ends_with(&format!(" s  {stage}"))), "{stage} in {}", run.stderr);
    }
}
