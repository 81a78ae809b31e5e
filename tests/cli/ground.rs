//! `slopegen build --terrain`: what concerns the command line. The figures are looked at in `tests/ground`.

use super::Site;

/// A pad 4 × 4 at height 2 over level ground at 0, as points in rows without a heading.
fn site() -> Site {
    let ground: String = (0..=10).flat_map(|i| (0..=10).map(move |j| format!("{},{},0\n", 3 * i, 3 * j))).collect();
    let site = Site::with("points.csv", ground);
    let ring = r#"{"type":"Feature","properties":{},"geometry":{"type":"LineString","coordinates":
        [[13,13,2],[17,13,2],[17,17,2],[13,17,2],[13,13,2]]}}"#;
    std::fs::write(site.path("raised.geojson"), ring).unwrap();
    site
}

/// Points without a heading need the option of the ground, not that of the line.
#[test]
fn columns_of_the_ground() {
    let site = site();
    let run = site.run("build raised.geojson --slope 1:1.5 --terrain points.csv");
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stderr.contains("`--terrain-order xyz`"), "{}", run.stderr);
    site.run("build raised.geojson --slope 1:1.5 --terrain points.csv --terrain-order xyz").done();
}

/// Only cut slopes for a pad that stands above the ground: it gets walls, and the reader is told.
#[test]
fn walls_are_told() {
    let site = site();
    let job = "build raised.geojson --slope 1:1.5 --terrain points.csv --terrain-order xyz --direction up";
    let run = site.run(job);
    run.done();
    // Round the pad, 4 · 4 long, as high as it stands.
    assert!(run.stderr.contains("[walls]: the line stands off the ground"), "{}", run.stderr);
    assert!(run.stderr.contains("on a length of 16.000: up to 2.000"), "{}", run.stderr);
    let refused = site.run(&format!("{job} --finished f.obj"));
    assert_eq!(refused.code, 1, "{}", refused.stderr);
    assert!(refused.stderr.contains("upright walls 16.000 long"), "{}", refused.stderr);
}

/// What needs ground, and what ground forbids.
#[test]
fn options_that_go_with_ground() {
    let site = site();
    for (job, told) in [
        ("--finished f.obj", "`--finished` needs existing ground"),
        ("--direction auto", "the direction `auto` needs existing ground"),
        ("--terrain points.csv --reference 3", "volumes are taken against the existing ground"),
        ("--terrain points.csv --side inside", "slopes inside a ring need a direction"),
    ] {
        let run = site.run(&format!("build raised.geojson --slope 1:1.5 {job}"));
        assert_eq!(run.code, 2, "{job}: {}", run.stderr);
        assert!(run.stderr.contains(told), "{job}: {}", run.stderr);
    }
}
