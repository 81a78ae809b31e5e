//! `slopegen build job.toml`.

use super::{Site, on_ground};
use std::fs;

const JOB: &str = "\
input = 'hill_road.geojson'
terrain = 'ground.obj'
width = 7
cut-slope = '1:1'
fill_slope = '1:1.5'
output = ['works.obj', 'works.ply']
report = 'report.json'
lines = ['lines.geojson']
";

/// A site with a job in a folder of its own.
fn site(job: &str) -> Site {
    let site = on_ground();
    fs::create_dir(site.path("site")).unwrap();
    for name in ["hill_road.geojson", "ground.obj"] {
        fs::rename(site.path(name), site.path("site").join(name)).unwrap();
    }
    fs::write(site.path("site/job.toml"), job).unwrap();
    site
}

fn slope(site: &Site, report: &str) -> f64 {
    let report: serde_json::Value = serde_json::from_str(&site.read(report)).unwrap();
    report["slopes"]["fill"]["one_in"].as_f64().unwrap()
}

/// The same bytes as from options, and all paths in the folder of the job.
#[test]
fn a_job_file_is_its_options() {
    let site = site(JOB);
    site.run("build site/job.toml --quiet").done();
    site.run(
        "build site/hill_road.geojson --terrain site/ground.obj --width 7 --cut-slope 1:1 --fill-slope 1:1.5 -o a.obj -o a.ply \
         --lines a.geojson --quiet",
    )
    .done();
    for (job, options) in [("works.obj", "a.obj"), ("works.ply", "a.ply"), ("lines.geojson", "a.geojson")] {
        let bytes = |name: &str| fs::read(site.path(name)).unwrap();
        assert!(bytes(&format!("site/{job}")) == bytes(options), "{job}");
    }
    assert_eq!(slope(&site, "site/report.json"), 1.5);
    assert_eq!(site.new_files(), ["a.geojson", "a.obj", "a.ply", "site"]);
}

#[test]
fn options_win() {
    let site = site(JOB);
    // A list takes the place of the list in the file; its paths are relative to the working folder.
    let run = site.run("build site/job.toml --fill-slope 1:2 --report r.json -o m.obj --quiet");
    assert_eq!(run.done(), "");
    assert_eq!(slope(&site, "r.json"), 2.0);
    assert_eq!(site.new_files(), ["m.obj", "r.json", "site"]);
    assert!(!site.path("site/works.obj").exists() && site.path("site/lines.geojson").exists());
    // Options before the file, and an end in the place of another.
    fs::write(site.path("site/pit.toml"), "input = '../pit.csv'\nclosed = true\nside = 'inside'\nslope = '1:1'\nheight = 6\n")
        .unwrap();
    site.run("build --to-elevation 402 --report r.json site/pit.toml --quiet").done();
    let report: serde_json::Value = serde_json::from_str(&site.read("r.json")).unwrap();
    assert_eq!((report["extent"]["kind"].as_str(), report["extent"]["value"].as_f64()), (Some("elevation"), Some(402.0)));
    // Without a name the mesh has that of the line, in the folder of the job.
    assert!(site.path("site/pit.obj").exists());
}

/// A slope that was typed in is that of both sheets; what the file says of them, and what has no surface any more, gives way.
#[test]
fn a_typed_slope_wins() {
    let slopes = |job: &str, typed: &str| {
        let site = site(job);
        site.run(&format!("build site/job.toml {typed} --allow-open --report r.json --quiet")).done();
        let report: serde_json::Value = serde_json::from_str(&site.read("r.json")).unwrap();
        let one_in = |sheet: &str| report["slopes"][sheet]["one_in"].as_f64();
        let options: Vec<String> = report["run"]["options"].as_object().unwrap().keys().cloned().collect();
        (one_in("cut"), one_in("fill"), options.into_iter().filter(|key| key.ends_with("slope")).collect::<Vec<_>>())
    };
    let close = |found: (Option<f64>, Option<f64>, Vec<String>), cut: Option<f64>, fill: Option<f64>, options: &[&str]| {
        let same = |a: Option<f64>, b: Option<f64>| match (a, b) {
            (Some(a), Some(b)) => (a - b).abs() < 1e-12,
            (a, b) => a.is_none() && b.is_none(),
        };
        assert!(
            same(found.0, cut) && same(found.1, fill) && found.2 == options,
            "{found:?} against {cut:?} {fill:?} {options:?}"
        );
    };
    close(slopes(JOB, "--slope 1:3"), Some(3.0), Some(3.0), &["slope"]);
    close(slopes(JOB, "--slope 1:3 --cut-slope 1:2"), Some(2.0), Some(3.0), &["cut-slope", "slope"]);
    close(slopes(JOB, "--direction down"), None, Some(1.5), &["fill-slope"]);
    let both = "slope = '1:2'\ncut-slope = '1:1'\n";
    let job = JOB.replace("cut-slope = '1:1'\nfill_slope = '1:1.5'\n", both);
    close(slopes(&job, "--fill-slope 1:4"), Some(1.0), Some(4.0), &["cut-slope", "fill-slope"]);
    close(slopes(&job, ""), Some(1.0), Some(2.0), &["cut-slope", "slope"]);
    // In the file alone it is refused with its place.
    let site = site(&JOB.replace("width = 7", "width = 7\nslope = '1:2'"));
    let run = site.run("build site/job.toml");
    assert_eq!(run.code, 2);
    assert!(run.stderr.contains("  --> site/job.toml, line 4, column 9: --slope 1:2\n"), "{}", run.stderr);
}

/// What an option needs may stand in the file.
#[test]
fn options_lean_on_the_file() {
    let site = site(JOB);
    site.run("build site/job.toml --crossfall 2.5% --report r.json --quiet").done();
    assert!(site.read("r.json").contains("\"crossfall\""));
}

#[track_caller]
fn refused(job: &str, arguments: &str, code: i32, message: &str) {
    let site = site(job);
    site.run(&format!("build site/job.toml {arguments}")).refused(code, message);
    assert_eq!(site.new_files(), ["site"]);
    assert_eq!(fs::read_dir(site.path("site")).unwrap().count(), 3);
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    refused(
        "input = 'hill_road.geojson'\nslope = '1:0.5'\nheight = 'x'\n",
        "",
        2,
        "error: `1:0.5` is ambiguous\n  --> site/job.toml, line 2, column 9: --slope 1:0.5\n   = it may mean 63.43° or 26.57°\n   \
         = help: write `1V:0.5H` or `1H:0.5V`\n\
         error: `x` is not a number\n  --> site/job.toml, line 3, column 10: --height x\n   = help: give a number such as 12.5",
    );
    refused(
        "input = 'hill_road.geojson'\ncutslope = '1:1'\n",
        "",
        2,
        "error: `cutslope` is no option of `slopegen build`\n  --> site/job.toml, line 2, column 1\n   = the nearest is `cut-slope`\n   \
         = help: write `cut-slope`",
    );
    refused(
        "slope = '1:1'\n",
        "",
        2,
        "error: the job names no line\n  --> site/job.toml\n   = help: write `input = \"line.geojson\"`",
    );
    refused(
        "input = 'hill_road.geojson'\n",
        "",
        2,
        "error: no slope was given for a surface that falls\n  --> site/job.toml: --slope\n   \
         = help: give `--slope` or `--fill-slope`, such as 1:1.5, 2H:1V, 1in2, 50% or 26.57deg",
    );
    refused(
        "input = 'hill_road.geojson'\nslope = '1:1'\ncrossfall = '2%'\n",
        "",
        2,
        "error: the following required arguments were not provided:\n  --width <W>\n  --> site/job.toml\n   \
         = help: mend the file, or give the option on the command line, which wins",
    );
    refused(
        "input = 'hill_road.geojson'\nslope = '1:1'\nheight = 5\ndistance = 5\n",
        "",
        2,
        "error: the argument '--height <H>' cannot be used with '--distance <D>'\n  --> site/job.toml, line 3, column 10: height\n  \
         --> site/job.toml, line 4, column 12: distance\n   \
         = help: mend the file, or give the option on the command line, which wins",
    );
    refused(
        "input = 'nothing.csv'\nslope = '1:1'\n",
        "",
        3,
        "error: the input cannot be read\n  --> site/nothing.csv\n  --> site/job.toml, line 1, column 9\n   \
         = No such file or directory (os error 2)",
    );
    // What stands on the command line is told as ever.
    refused(
        JOB,
        "--fill-slope 1:0.5",
        2,
        "error: `1:0.5` is ambiguous\n  --> --fill-slope 1:0.5\n   = it may mean 63.43° or 26.57°\n   \
         = help: write `1V:0.5H` or `1H:0.5V`",
    );
}

#[test]
fn mistakes_on_the_command_line() {
    let site = site(JOB);
    // A name has the place it is given at below it.
    fs::write(site.path("site/name.toml"), "input = 'hill_road.geojson'\nslope = '1:1'\noutput = 'a.docx'\n").unwrap();
    let run = site.run("build site/name.toml");
    let place = "error: no format is known for the ending `.docx`\n  --> site/a.docx\n  --> site/name.toml, line 3, column 10\n";
    assert!(run.code == 2 && run.stderr.starts_with(place), "{run:?}");
    let run = site.run("build site/job.toml --fil-slope 1:2");
    assert!(run.code == 2 && run.stderr.starts_with("error: unexpected argument '--fil-slope' found"), "{run:?}");
    assert!(!run.stderr.contains("--terrain"), "{}", run.stderr);
    let run = site.run("build site/job.toml --side lefft");
    assert!(run.code == 2 && run.stderr.contains("invalid value 'lefft'"), "{run:?}");
    assert_eq!(site.run("build nothing.toml").code, 3);
    assert!(site.run("build site/job.toml --help").done().contains("Usage: slopegen build"));
    fs::write(site.path("long.toml"), " ".repeat(2 << 20)).unwrap();
    assert!(site.run("build long.toml").stderr.starts_with("error: the file is too long for a job\n"));
    fs::create_dir(site.path("folder.toml")).unwrap();
    assert_eq!(site.run("build folder.toml").code, 3);
}

/// Files without an end are not read to it.
#[cfg(target_os = "linux")]
#[test]
fn endless_files() {
    let site = Site::new();
    for name in ["z.toml", "z"] {
        std::os::unix::fs::symlink("/dev/zero", site.path(name)).unwrap();
    }
    assert_eq!(site.run("build z.toml").code, 2);
    assert_eq!(site.run("batch --list z").code, 2);
    assert_eq!(site.run("info z").code, 3);
    assert_eq!(site.run("info z.toml").code, 2);
}
