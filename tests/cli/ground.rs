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

/// Each mesh is told with its own size.
#[test]
fn sizes_of_design_and_finished_ground() {
    let site = site();
    let job = "build raised.geojson --slope 1:1.5 --terrain points.csv --terrain-order xyz";
    let run = site.run(&format!("{job} -o design.obj --finished finished.obj"));
    run.done();
    for name in ["design.obj", "finished.obj"] {
        let mesh = site.read(name);
        let count = |key: &str| mesh.lines().filter(|line| line.starts_with(key)).count();
        let wrote = format!("wrote {name}: {} vertices, {} triangles\n", count("v "), count("f "));
        assert!(run.stderr.contains(&wrote), "{wrote}{}", run.stderr);
    }
}

/// Catch points lie on the ground, where the sections of the report end; along rulings the slope is that asked for.
#[test]
fn slope_stakes_agree_with_the_sections() {
    let site = Site::new();
    let fixtures = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures");
    let [line, ground] = ["hill_road.geojson", "ground.obj"].map(|name| fixtures.join(name).display().to_string());
    let job = ["build", &line, "--width", "7", "--terrain", &ground, "--cut-slope", "1:1", "--fill-slope", "1:1.5"];
    let outputs = ["--stations", "20", "--stakes", "stakes.csv", "--report", "road.json", "--level", "620,99"];
    let run = site.run_args(&[&job[..], &outputs[..]].concat(), "");
    run.done();
    assert!(run.stderr.contains("warning[level-missed]: there is no level curve at 99: "), "{}", run.stderr);
    let report: serde_json::Value = serde_json::from_str(&site.read("road.json")).unwrap();
    assert_eq!(report["levels"], serde_json::json!([620.0]));
    let text = site.read("stakes.csv");
    let mut rows = text.lines().map(|row| row.split(',').collect::<Vec<_>>());
    let header = rows.next().unwrap();
    let of = |row: &[&str], name: &str| row[header.iter().position(|h| *h == name).unwrap()].to_owned();
    let number = |row: &[&str], name: &str| of(row, name).parse::<f64>().unwrap();
    let mut sections = 0;
    for row in rows {
        assert_eq!(of(&row, "ends"), "ground");
        let asked = if of(&row, "part") == "cut" { 1.0 } else { 1.5 };
        let (one_in, station) = (number(&row, "one_in"), number(&row, "station"));
        if of(&row, "along") == "ruling" {
            assert!((one_in - asked).abs() < 1e-6, "{row:?}");
            continue;
        }
        // No section is steeper than the slope itself, but for the cones at the ends of the road.
        let inside = station > 0.0 && station < report["line"]["length"].as_f64().unwrap();
        assert!(!inside || one_in >= asked - 1e-9, "{row:?}");
        let intervals = report["stations"].as_array().unwrap();
        let at = |interval: &&serde_json::Value, end| interval[end].as_f64() == Some(station);
        let begins = intervals.iter().find(|i| at(i, "from")).map(|i| &i["section"]["from"]);
        let section = begins.or_else(|| intervals.iter().find(|i| at(i, "to")).map(|i| &i["section"]["to"])).unwrap();
        let reach = section[of(&row, "side")].as_f64().unwrap();
        assert!((number(&row, "catch_offset") - reach).abs() < 1e-7, "{row:?} {reach}");
        sections += 1;
    }
    // 233 long: 13 stations, two sides.
    assert_eq!(sections, 26);
}

/// Where a slope only touches an edge of the platform, the edge is still part of the hinge: all of it is in the line work.
#[test]
fn the_whole_hinge_is_in_the_line_work() {
    let site = super::plots::site();
    site.run("build way.geojson --width 5 --terrain ground.csv --slope 1:1.5 --tolerance 0.05 --interval 1 --lines l.geojson -q")
        .done();
    let lines: serde_json::Value = serde_json::from_str(&site.read("l.geojson")).unwrap();
    let length = |kind: &str| -> f64 {
        let of_kind = lines["features"].as_array().unwrap().iter().filter(|f| f["properties"]["kind"] == kind);
        let points = of_kind.map(|f| f["geometry"]["coordinates"].as_array().unwrap());
        let at = |p: &serde_json::Value, i: usize| p[i].as_f64().unwrap();
        let step = |w: &[serde_json::Value]| (at(&w[0], 0) - at(&w[1], 0)).hypot(at(&w[0], 1) - at(&w[1], 1));
        points.map(|points| points.windows(2).map(step).sum::<f64>()).sum()
    };
    // Both edges together are twice as long as the centre line (what one gains at the bend the other loses), the ends 5 each.
    let centre = 40_f64.hypot(3.0) + 40_f64.hypot(13.0);
    assert!((length("hinge") - (2.0 * centre + 10.0)).abs() < 1e-6, "{} {centre}", length("hinge"));
}

/// Stakes need stations; stations need ground or stakes.
#[test]
fn stakes_without_stations_or_ground() {
    let site = Site::new();
    let run = site.run("build road.geojson --slope 1:1.5 --stakes s.csv");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("--stations <D>"), "{}", run.stderr);
    let run = site.run("build road.geojson --slope 1:1.5 --stakes s.txt --stations 25");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("end the name of a table of slope stakes in `.csv`"), "{}", run.stderr);
    site.run("build road.geojson --slope 1:1.5 --stakes s.csv --stations 25").done();
    assert!(site.read("s.csv").lines().nth(1).is_some_and(|row| row.ends_with(",end")), "{}", site.read("s.csv"));
}

/// Only cut slopes for a pad that stands above the ground: it gets walls, and the reader is told.
#[test]
fn walls_are_told() {
    let site = site();
    let job = "build raised.geojson --slope 1:1.5 --terrain points.csv --terrain-order xyz --direction up";
    let run = site.run(job);
    run.done();
    // Round the pad, 4 · 4 long, as high as it stands.
    assert!(run.stderr.contains("warning[walls]: the line stands off the ground"), "{}", run.stderr);
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
        ("--stations 5 --stakes s.csv --station-table t.csv", "`--station-table` needs existing ground"),
        ("--direction auto", "the direction `auto` needs existing ground"),
        ("--terrain points.csv --reference 3", "volumes are taken against the existing ground"),
        ("--terrain points.csv --side inside", "slopes inside a ring need a direction"),
    ] {
        let run = site.run(&format!("build raised.geojson --slope 1:1.5 {job}"));
        assert_eq!(run.code, 2, "{job}: {}", run.stderr);
        assert!(run.stderr.contains(told), "{job}: {}", run.stderr);
    }
}

/// The table of stations: its rows are those of the JSON report, wherever it goes.
#[test]
fn stations_as_a_table() {
    let site = site();
    let job = "build raised.geojson --slope 1:1.5 --terrain points.csv --terrain-order xyz --stations 5 -o m.obj";
    let text = site.run(&format!("{job} --station-table s.csv --report r.json --report r.md"));
    assert!(text.done().contains("\nStations ("), "{}", text.stdout);
    let table = site.read("s.csv");
    let report: serde_json::Value = serde_json::from_str(&site.read("r.json")).unwrap();
    let mut rows = table.lines();
    let header: Vec<&str> = rows.next().unwrap().split(',').collect();
    let column = |name: &str| header.iter().position(|&n| n == name).unwrap();
    let stations = report["stations"].as_array().unwrap();
    // 16 round the pad: breaks at 5, 10 and 15, and the pad itself.
    assert_eq!((stations.len(), table.lines().count()), (4, 6));
    let mut fill = 0.0;
    for (row, station) in rows.zip(stations.iter().chain([&report["pads"]])) {
        let fields: Vec<&str> = row.split(',').collect();
        for key in ["to", "cut", "fill", "fill_area", "net_cumulative"] {
            let expected = station[key].as_f64().map_or(String::new(), |v| v.to_string());
            assert_eq!(fields[column(key)], expected, "{key} of {row}");
        }
        assert_eq!(fields[column("unit")], "m");
        fill += fields[column("fill")].parse::<f64>().unwrap();
    }
    let all = report["volumes"]["fill"].as_f64().unwrap();
    assert!((fill - all).abs() <= 1e-9 * all, "{fill} {all}");
    let markdown = site.read("r.md");
    assert!(markdown.contains("\n## Stations (") && markdown.contains("\n| **total** | |"), "{markdown}");
    // Standard output takes one thing.
    assert_eq!(site.run(&format!("{job} --station-table -")).done(), table);
    for (more, told) in [("--station-table s.txt", "end the name of a table in `.csv`"), ("--station-table -", "--stations")] {
        let job = if more.ends_with('-') { job.replace("--stations 5 ", "") } else { job.to_owned() };
        let run = site.run(&format!("{job} {more}"));
        assert_eq!(run.code, 2, "{more}: {}", run.stderr);
        assert!(run.stderr.contains(told), "{more}: {}", run.stderr);
    }
}
