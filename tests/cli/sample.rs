//! `slopegen sample`: exact heights.

use super::Site;

/// A level ridge 100 long at height 50.
const RIDGE: &str = "x,y,z\n1000,2000,50\n1100,2000,50\n";

/// Rows of a table of numbers, without its header.
fn rows(text: &str, separator: char) -> Vec<Vec<f64>> {
    text.lines().skip(1).map(|line| line.split(separator).map(|n| n.parse().unwrap()).collect()).collect()
}

#[test]
fn heights_at_points() {
    let site = Site::with("ridge.csv", RIDGE);
    let points = "x,y\n1050,2000\n1050,2010\n1050,1990\n1130,2040\n";
    let run = site.run_with("sample ridge.csv --slope 1:2 --at -", points);
    // Half the distance below the ridge; the last point is 50 (3-4-5) from its end.
    assert_eq!(run.done(), "x,y,z\n1050,2000,50\n1050,2010,45\n1050,1990,45\n1130,2040,25\n");
    // Rising, to a file, the points in another order of columns and without a header.
    std::fs::write(site.path("points.txt"), "1 2010 1050\n2 2040 1130\n").unwrap();
    let run = site.run("sample ridge.csv --slope 1:2 --direction up --at points.txt --at-order pne -o heights.csv");
    assert_eq!(run.done(), "");
    assert_eq!(site.read("heights.csv"), "x,y,z\n1050,2010,55\n1130,2040,75\n");
    assert!(run.stderr.contains("wrote heights.csv: 2 heights"), "{}", run.stderr);
}

#[test]
fn points_without_a_header_need_an_order() {
    let site = Site::new();
    let run = site.run_with("sample road.geojson --slope 1:2 --at -", "1,2\n3,4\n");
    assert_eq!(run.code, 3);
    assert!(run.stderr.contains("--at-order") && !run.stderr.contains("--csv-order"), "{}", run.stderr);
}

#[test]
fn heights_on_a_grid() {
    let site = Site::with("ridge.csv", RIDGE);
    let run = site.run("sample ridge.csv --slope 50% --raster a.asc --cell 25 --box 1000,1975,1050,2025");
    assert_eq!(run.done(), "");
    let text = site.read("a.asc");
    let head = "ncols 3\nnrows 3\nxllcenter 1000\nyllcenter 1975\ncellsize 25\nNODATA_value -9999\n";
    assert_eq!(text.strip_prefix(head), Some("37.5 37.5 37.5\n50 50 50\n37.5 37.5 37.5\n"), "{text}");
    // Without a box: 50 (five cells, more than a tenth of 100) around the line.
    let run = site.run("sample ridge.csv --slope 50% --raster - --cell 10");
    let head = "ncols 21\nnrows 11\nxllcenter 950\nyllcenter 1950\ncellsize 10\n";
    assert!(run.done().starts_with(head), "{}", run.stdout);
}

#[test]
fn the_line_itself_is_on_the_surface() {
    let site = Site::new();
    let run = site.run("sample road.geojson --slope 1:1.5 --at pit.csv");
    assert_eq!(rows(run.done(), ',').len(), 14);
    let run = site.run("sample pit.csv --closed --slope 1:1.5 --direction up --at pit.csv");
    let given: Vec<f64> = site.read("pit.csv").lines().skip(1).map(|l| l.split(',').nth(3).unwrap().parse().unwrap()).collect();
    for (row, z) in rows(run.done(), ',').iter().zip(given) {
        // Coordinates of 5.4e6 are told apart by 1e-9.
        assert!((row[2] - z).abs() < 1e-8, "{row:?} for {z}");
    }
}

#[test]
fn too_many_nodes() {
    let site = Site::with("ridge.csv", RIDGE);
    site.run("sample ridge.csv --slope 50% --raster a.asc --cell 0.001 --box 0,0,1000,1000").refused(
        1,
        "error: the raster would have too many nodes\n  --> ridge.csv\n   = 1000001 by 1000001 at a cell of 0.001; at most 1e8 in \
         all\n   = help: give a larger `--cell`, or a smaller `--box`",
    );
    assert_eq!(site.new_files(), ["ridge.csv"]);
}

#[test]
fn points_far_away_are_refused() {
    let site = Site::with("ridge.csv", RIDGE);
    site.run_with("sample ridge.csv --slope 50% --at -", "x,y\n0,0\n0,1e200\n").refused(
        1,
        "error: a coordinate is too large\n  --> <stdin>, row 3\n   = 1e200, against a limit of 1e9\n   \
         = help: check the columns; projected coordinates stay far below",
    );
}
