//! What is said, and with which code, when something is wrong. The texts are pinned: they are read by people in a hurry.

use super::Site;

#[track_caller]
fn refused(arguments: &str, code: i32, message: &str) {
    let site = Site::new();
    site.run(arguments).refused(code, message);
    assert!(site.new_files().is_empty(), "{:?}", site.new_files());
}

#[test]
fn slopes() {
    refused(
        "build road.geojson --slope 1:0.5",
        2,
        "error: `1:0.5` is ambiguous\n  --> --slope 1:0.5\n   = it may mean 63.43° or 26.57°\n   \
         = help: write `1V:0.5H` or `1H:0.5V`",
    );
    refused(
        "build road.geojson --slope 0",
        2,
        "error: `0` is not a positive slope\n  --> --slope 0\n   \
         = help: give the steepness; `--direction` says whether it falls or rises",
    );
    refused(
        "build road.geojson --slope -1:2",
        2,
        "error: `-1:2` is not a positive slope\n  --> --slope -1:2\n   \
         = help: give the steepness; `--direction` says whether it falls or rises",
    );
    refused(
        "build road.geojson --slope 90deg",
        2,
        "error: `90deg` is not less than a right angle\n  --> --slope 90deg\n   \
         = help: give an angle against the horizontal between 0.006° and 89.994°",
    );
    refused(
        "build road.geojson",
        2,
        "error: no slope was given for a surface that falls\n  --> --slope\n   \
         = help: give `--slope` or `--fill-slope`, such as 1:1.5, 2H:1V, 1in2, 50% or 26.57deg",
    );
    refused(
        "sample road.geojson --direction up --fill-slope 1:2 --at -",
        2,
        "error: no slope was given for a surface that rises\n  --> --slope\n   \
         = help: give `--slope` or `--cut-slope`, such as 1:1.5, 2H:1V, 1in2, 50% or 26.57deg",
    );
}

#[test]
fn everything_wrong_with_the_arguments_is_told_at_once() {
    refused(
        "build road.geojson --slope steep --interval 0 --tolerance -1 --to-elevation nan --csv-order xq -o a.step --lines b",
        2,
        "error: `q` is no column\n  --> --csv-order xq\n   = help: letters: x or e easting, y or n northing, z or h elevation, l line \
         id, p point number, d description, _ skip; e.g. xyz, enz, pnezd\n\
         error: `steep` is not a slope\n  --> --slope steep\n   = help: write `1:1.5`, `2H:1V`, `1in2`, `50%` or `26.57deg`\n\
         error: `nan` is not a finite number\n  --> --to-elevation nan\n   = help: give a number such as 12.5\n\
         error: `0` is not above zero\n  --> --interval 0\n   = help: give a positive number\n\
         error: `-1` is too small\n  --> --tolerance -1\n   = help: give 0.000001 or more\n\
         error: no format is known for the ending `.step`\n  --> a.step\n   \
         = help: end the name of a mesh in `.obj`, `.ply`, `.xml` (LandXML), `.dxf`, `.stl` or `.glb`\n\
         error: the name has no ending that tells the format\n  --> b\n   \
         = help: end the name of a line-work file in `.geojson`, `.json`, `.xml` (LandXML) or `.dxf`",
    );
}

#[test]
fn what_the_line_forbids() {
    refused(
        "build road.geojson --slope 1:1.5 --interval 1e-9",
        1,
        "error: the interval 0.000000001 is too small\n  --> road.geojson\n   = 23.3 from the highest to the lowest; at most \
         10000 level curves, at least 0.00001 apart\n   = help: give `--interval 0.0024` or more",
    );
    refused(
        "build road.geojson --slope 1:1.5 --to-elevation 500",
        1,
        "error: the slope would end before it begins\n  --> road.geojson\n   \
         = highest vertex at 425.7; `--to-elevation` 500\n   \
         = help: a falling slope ends below 425.7; for one that rises give `--direction up`",
    );
    refused(
        "build road.geojson --slope 1:1.5 --direction up --to-elevation 400",
        1,
        "error: the slope would end before it begins\n  --> road.geojson\n   \
         = lowest vertex at 412.4; `--to-elevation` 400\n   \
         = help: a rising slope ends above 412.4; for one that falls give `--direction down`",
    );
    refused(
        "build road.geojson --slope 1:1.5 --side inside",
        1,
        "error: `--side inside` needs rings, and `access road` is open\n  --> road.geojson, feature 1\n   \
         = help: ask for `left`, `right` or `both`, or close the line with `--closed`",
    );
    refused(
        "build road.geojson --slope 1:10000 --height 2000",
        1,
        "error: the slope would reach too far\n  --> road.geojson\n   = 20000000 in plan and 2000 in height, against a limit of \
         10000000\n   = help: end it sooner",
    );
}

#[test]
fn roads() {
    refused(
        "build road.geojson --slope 1:1.5 --width 8 --side both",
        2,
        "error: a road has its slopes outside\n  --> --side\n   = `--width` makes a ring of the edges of the road\n   \
         = help: leave `--side` out; `outside` says the same",
    );
    refused(
        "build road.geojson --slope 1:1.5 --width 8 --closed",
        2,
        "error: `--width` needs open lines, and `--closed` makes rings of them\n  --> --width\n   \
         = help: leave `--closed` out for the centre line of a road, or `--width` for a ring",
    );
    refused(
        "sample road.geojson --slope 1:1.5 --width -8 --crossfall 2.5 --at -",
        2,
        "error: `-8` is too small\n  --> --width -8\n   = help: give 0.001 or more\n\
         error: `2.5` does not say which kind of slope it is\n  --> --crossfall 2.5\n   \
         = help: write `2.5V:1H`, `2.5H:1V`, `2.5%` or `2.5deg`",
    );
    refused(
        "build pad.geojson --slope 1:1.5 --width 8",
        1,
        "error: `--width` needs an open line, the centre line of a road\n  --> pad.geojson\n   = 1 rings, no open line\n   \
         = help: leave `--width` out, or give the centre line as a line that does not end where it begins",
    );
    let site = Site::with("u.csv", "x,y,z\n0,0,1\n100,0,1\n100,5,1\n0,5,1\n");
    site.run("build u.csv --slope 1:2 --width 8").refused(
        1,
        "error: the road of `line 1` lies on itself\n  --> u.csv, rows 2 to 5\n   = near stations 0.000 and 205.000 the centre \
         line is 5.000 apart, the width is 8\n   = help: give `--width` 4.99 or less, move the legs apart, or build them one by one",
    );
    // Corners every 0.1 rad on a radius of 5, each 0.1 higher. Inner mitres stand on the radius 5 − 4 / cos 0.05 = 0.99499, and
    // 2 · 0.99499 · sin 0.05 = 0.09946 apart: 0.1 / 0.09946 = 1.005.
    let bend: String = (0..=20)
        .map(|i| (f64::from(i) * 0.1).sin_cos())
        .enumerate()
        .map(|(i, (sin, cos))| format!("{},{},{}\n", 5.0 * sin, -5.0 * cos, 0.1 * i as f64))
        .collect();
    let site = Site::with("bend.csv", format!("x,y,z\n{bend}"));
    let run = site.run("build bend.csv --slope 1:1.5 --width 8");
    assert_eq!(run.code, 1, "{run:?}");
    for part in [
        "an edge of the road `line 1` is as steep as the slope asked for, or steeper\n  --> bend.csv, rows 3 to 21",
        "of the centre line (the inside of a bend is shorter than the centre line): steepest gradient 1.005 (100.5 %, 45.16°)",
    ] {
        assert!(run.stderr.contains(part), "{}", run.stderr);
    }
}

#[test]
fn a_line_as_steep_as_the_slope() {
    let site = Site::with("ramp.csv", "x,y,z\n0,0,10\n10,0,10\n20,0,16\n30,0,16\n");
    // 6 up on 10 is 60 %; 1/0.6 = 1.667, so 1:1.66 is the flattest in three digits that is steeper.
    let message = "error: segment 2 of `line 1` is as steep as the slope asked for, or steeper\n  --> ramp.csv, rows 3 to 4\n   \
                   = stations 10.000 to 20.000: gradient 0.6 (60.0 %, 30.96°); slope asked for 1V:2H (50.0 %, 26.57°)\n   \
                   = help: flatten the line there, or ask for 1:1.66 or steeper";
    site.run("build ramp.csv --slope 1:2").refused(1, message);
    site.run("sample ramp.csv --slope 1:2 --raster a.asc --cell 1").refused(1, message);
    site.run("build ramp.csv --slope 1:1.66 --height 1").done();
}

#[test]
fn defects_of_the_line() {
    let site = Site::with("b.csv", "x,y,z\n0,0,1\n0,0,1\n");
    let run = site.run("build b.csv --slope 1:2");
    assert_eq!(run.code, 1, "{run:?}");
    assert!(run.stderr.contains("error: a line needs at least 2 distinct vertices\n  --> b.csv"), "{}", run.stderr);
    let site = Site::with("lonlat.csv", "lon,lat,z\n9.1,48.7,400\n9.2,48.7,400\n");
    let run = site.run("build lonlat.csv --slope 1:2");
    assert_eq!(run.code, 1, "{run:?}");
    assert!(run.stderr.contains("ogr2ogr"), "{}", run.stderr);
}

#[test]
fn inputs_that_cannot_be_read() {
    refused(
        "build missing.geojson --slope 1:2",
        3,
        "error: the input cannot be read\n  --> missing.geojson\n   = No such file or directory (os error 2)",
    );
    for (name, content) in [
        ("empty.csv", &b""[..]),
        ("empty.geojson", b""),
        ("cut.geojson", b"{\"type\":\"LineString\",\"coordinates\":[[1,2,3],[4,5"),
        ("one.geojson", b"{\"type\":\"LineString\",\"coordinates\":[[1],[2]]}"),
        ("bytes.csv", b"\x00\x01\x02\xff\xfe"),
        ("huge.geojson", b"{\"type\":\"LineString\",\"coordinates\":[[1,2,3],[1e999,5,6]]}"),
        ("no_header.csv", b"1,2,3\n4,5,6\n"),
    ] {
        let site = Site::with(name, content);
        let run = site.run(&format!("build {name} --slope 1:2"));
        assert_eq!(run.code, 3, "{name}: {}", run.stderr);
        assert!(run.stderr.starts_with("error: ") && run.stderr.contains(&format!("\n  --> {name}")), "{name}: {}", run.stderr);
        assert_eq!(site.new_files(), [name]);
    }
}

#[test]
fn large_coordinates_are_refused() {
    let site = Site::with("far.geojson", "{\"type\":\"LineString\",\"coordinates\":[[1,2,3],[1e308,5,6]]}");
    let run = site.run("build far.geojson --slope 1:2");
    assert_eq!(run.code, 1, "{run:?}");
}

#[test]
fn usage() {
    for arguments in [
        "build",
        "build road.geojson --slope 1:2 --heigth 3",
        "build road.geojson --slope 1:2 --height 3 --distance 4",
        "build road.geojson --slope 1:2 --side up",
        "build road.geojson --slope 1:2 --quiet --verbose",
        "build road.geojson --slope 1:2 --threads 0",
        "build road.geojson --slope 1:2 --threads 1000000",
        "build road.geojson --slope 1:2 --threads -1",
        "build road.geojson --slope 1:2 --height -3",
        "build road.geojson --slope 1:2 --height 1e400",
        "build road.geojson --slope 1:2 --distance 0",
        "build road.geojson --slope 1:2 --reference inf",
        "build road.geojson --slope 1:2 -o a.obj -o ./a.obj",
        "build road.geojson --slope 1:2 -o - --report -",
        "build road.geojson --slope 1:2 --lines road.geojson",
        "build road.geojson --slope 1:2 -o .",
        "build road.geojson --slope 1:2 --report r.pdf",
        "build - --slope 1:2",
        "build road.dwg --slope 1:2",
        "sample road.geojson --slope 1:2",
        "sample road.geojson --slope 1:2 --raster a.asc",
        "sample road.geojson --slope 1:2 --raster a.png --cell 1",
        "sample road.geojson --slope 1:2 --raster a.asc --cell 0",
        "sample road.geojson --slope 1:2 --raster a.asc --cell 1 --box 0,0,1",
        "sample road.geojson --slope 1:2 --raster a.asc --cell 1 --box 1,0,0,1",
        "sample road.geojson --slope 1:2 --raster a.asc --cell 1 --box 0,0,nan,1",
        "sample road.geojson --slope 1:2 --raster a.asc --cell 1 --at pit.csv",
        "sample road.geojson --slope 1:2 --at pit.csv --cell 2",
        "sample road.geojson --slope 1:2 --at pit.csv -o heights.obj",
        "sample - --input-format csv --slope 1:2 --at -",
        "measure a b",
    ] {
        let site = Site::new();
        let run = site.run(arguments);
        assert_eq!(run.code, 2, "{arguments}: {}", run.stderr);
        assert!(!run.stderr.is_empty() && run.stdout.is_empty(), "{arguments}");
        assert!(site.new_files().is_empty(), "{arguments}: {:?}", site.new_files());
    }
}

#[test]
fn outputs_that_clash() {
    refused(
        "build road.geojson --slope 1:2 -o a.obj --lines b.geojson -o ./a.obj",
        2,
        "error: two outputs go to the same place\n  --> a.obj\n  --> ./a.obj\n   = help: give each output a name of its own",
    );
    refused(
        "build road.geojson --slope 1:2 --lines ./road.geojson",
        2,
        "error: the output would overwrite an input\n  --> ./road.geojson\n   = help: give the output another name",
    );
}

#[test]
fn outputs_that_cannot_be_written() {
    refused(
        "build road.geojson --slope 1:2 -o a.obj -o missing/a.obj",
        4,
        "error: the output cannot be created\n  --> missing/a.obj\n   = No such file or directory (os error 2)\n   \
         = help: make sure that the folder `missing` exists",
    );
}

#[test]
fn names_from_files_cannot_drive_the_terminal() {
    let line = r#"{"type":"Feature","properties":{"name":"a\u001b[2Jb"},"geometry":{"type":"LineString",
        "coordinates":[[0,0,10],[10,0,30]]}}"#;
    let site = Site::with("evil.geojson", line);
    let run = site.run("build evil.geojson --slope 1:2");
    assert_eq!(run.code, 1, "{run:?}");
    assert!(!run.stderr.contains('\u{1b}'), "{:?}", run.stderr);
}

#[test]
fn stations_and_soil_need_ground() {
    refused(
        "build road.geojson --slope 1:2 --stations 20 --swell 25% --shrink 10%",
        2,
        "error: `--stations` needs existing ground\n  --> --stations 20\n   = help: give the ground with `--terrain`\n\
         error: `--swell` needs existing ground\n  --> --swell 25%\n   = help: give the ground with `--terrain`\n\
         error: `--shrink` needs existing ground\n  --> --shrink 10%\n   = help: give the ground with `--terrain`",
    );
}

#[test]
fn soil() {
    let site = Site::new();
    for (arguments, message) in [
        (
            "--swell 1.25",
            "`1.25` can be read in two ways\n  --> --swell 1.25\n   = help: write `25%` if 1.25 is a factor, `125%` if it is a share",
        ),
        ("--swell -5%", "`-5%` is out of range\n  --> --swell -5%\n   = help: give 0% to 200%"),
        ("--shrink 100%", "`100%` is out of range\n  --> --shrink 100%\n   = help: give -100% to 90%"),
        ("--stations 0", "`0` is too small\n  --> --stations 0\n   = help: give 0.000001 or more"),
    ] {
        let option = arguments.split(' ').next().unwrap();
        let ground =
            format!("error: `{option}` needs existing ground\n  --> {arguments}\n   = help: give the ground with `--terrain`");
        site.run(&format!("build road.geojson --slope 1:2 {arguments}")).refused(2, &format!("error: {message}\n{ground}"));
    }
}
