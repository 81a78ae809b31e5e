//! `slopegen batch`.

use super::Site;
use serde_json::Value;
use std::fs;

/// A site with jobs: a pad, a road, one with a wrong slope, one whose line is not there.
fn site() -> Site {
    let site = Site::new();
    fs::create_dir(site.path("jobs")).unwrap();
    for (name, job) in [
        ("a.toml", "input = '../pad.geojson'\nslope = '1:2'\nto-elevation = 405\noutput = 'a.obj'\nreport = 'a.json'\n"),
        ("b.toml", "input = '../road.geojson'\nslope = '1:1.5'\nheight = 3\noutput = 'b.obj'\n"),
        ("c.toml", "input = '../road.geojson'\nslope = '1:0.5'\noutput = 'c.obj'\n"),
        ("d.toml", "input = 'nothing.csv'\nslope = '1:1'\noutput = 'd.obj'\n"),
    ] {
        fs::write(site.path("jobs").join(name), job).unwrap();
    }
    site
}

fn names(site: &Site) -> Vec<String> {
    let mut names: Vec<String> =
        fs::read_dir(site.path("jobs")).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.retain(|name| !name.ends_with(".toml"));
    names.sort();
    names
}

/// A table or a message without the times.
fn without_times(table: &str) -> Vec<String> {
    let seconds = |word: &str| word.split_once('.').is_some_and(|(a, b)| b.len() == 2 && a.chars().all(|c| c.is_ascii_digit()));
    table
        .lines()
        .map(|line| match line.rsplit_once(' ') {
            Some((rest, last)) if seconds(last) => rest.trim_end().to_owned(),
            _ => line.to_owned(),
        })
        .collect()
}

const ERRORS: &str = "\
error: `1:0.5` is ambiguous
  --> jobs/c.toml, line 2, column 9: --slope 1:0.5
   = it may mean 63.43° or 26.57°
   = help: write `1V:0.5H` or `1H:0.5V`
   = job: jobs/c.toml, exit code 2
error: the input cannot be read
  --> jobs/nothing.csv
  --> jobs/d.toml, line 1, column 9
   = No such file or directory (os error 2)
   = job: jobs/d.toml, exit code 3
";

/// All jobs are done whatever becomes of the others; tables, messages and files are the same for any number at once.
#[test]
fn all_jobs_and_one_summary() {
    let site = site();
    let mut first: Option<(Vec<String>, Vec<u8>)> = None;
    for at_once in ["1", "2", "4"] {
        let run = site.run(&format!("batch jobs --jobs {at_once} --report s.json --report -"));
        // The gravest code: 3 before 2.
        assert_eq!(run.code, 3, "{}", run.stderr);
        let told = ["wrote jobs/a.obj\n", "wrote jobs/a.json\n", "wrote jobs/b.obj\n", ERRORS].concat();
        assert_eq!(run.stderr, told);
        let table = without_times(&run.stdout);
        assert!(table.iter().any(|line| line.starts_with("  jobs/a.toml  done       0 ")), "{table:?}");
        assert_eq!(table.last().unwrap(), "2 done, 2 failed");
        let mesh = fs::read(site.path("jobs/a.obj")).unwrap();
        let first = first.get_or_insert((table.clone(), mesh.clone()));
        assert!(*first == (table, mesh), "{at_once} at once");
        assert_eq!(names(&site), ["a.json", "a.obj", "b.obj"]);
    }
    let summary: Value = serde_json::from_str(&site.read("s.json")).unwrap();
    let report: Value = serde_json::from_str(&site.read("jobs/a.json")).unwrap();
    assert_eq!((summary["schema"].as_str(), summary["code"].as_u64()), (Some("slopegen-batch/1"), Some(3)));
    let jobs = summary["jobs"].as_array().unwrap();
    let codes: Vec<u64> = jobs.iter().map(|job| job["code"].as_u64().unwrap()).collect();
    assert_eq!(codes, [0, 0, 2, 3]);
    assert_eq!(jobs[0]["volumes"]["fill"], report["volumes"]["fill"]);
    assert!(jobs[3]["error"].as_str().unwrap().starts_with("the input cannot be read\n"));
    let sum = jobs[0]["volumes"]["fill"].as_f64().unwrap() + jobs[1]["volumes"]["fill"].as_f64().unwrap();
    assert!((summary["total"]["fill"].as_f64().unwrap() - sum).abs() < 1e-9 * sum);
}

#[test]
fn success_is_nought() {
    let site = site();
    let run = site.run("batch jobs/b.toml jobs/a.toml --quiet");
    assert_eq!((run.code, run.stdout.as_str(), run.stderr.as_str()), (0, "", ""));
    assert_eq!(names(&site), ["a.json", "a.obj", "b.obj"]);
    // The same bytes as from a job by itself.
    let bytes = fs::read(site.path("jobs/b.obj")).unwrap();
    fs::remove_file(site.path("jobs/b.obj")).unwrap();
    site.run("build jobs/b.toml --quiet").done();
    assert!(fs::read(site.path("jobs/b.obj")).unwrap() == bytes);
}

#[test]
fn a_list_of_jobs() {
    let site = site();
    fs::write(site.path("jobs/list.txt"), "\u{feff}# two jobs\na.toml\n\n  b.toml # the road\r\n").unwrap();
    let run = site.run("batch --list jobs/list.txt");
    assert!(run.done().ends_with("\n2 done, 0 failed\n"), "{}", run.stdout);
    // Names that look like options.
    fs::copy(site.path("jobs/b.toml"), site.path("-b.toml")).unwrap();
    fs::write(site.path("list.txt"), "-b.toml\n").unwrap();
    let run = site.run("batch --list list.txt");
    assert!(run.code == 3 && run.stderr.contains("--> ../road.geojson\n  --> -b.toml, line 1, column 9\n"), "{run:?}");
    fs::write(site.path("empty.txt"), "# none\n").unwrap();
    site.run("batch --list empty.txt")
        .refused(2, "error: there are no job files in this list\n  --> empty.txt\n   = help: name one job file a line");
    assert_eq!(site.run("batch --list nothing.txt").code, 3);
}

#[test]
fn fail_fast() {
    let site = site();
    // A wrong file shows before anything is done.
    let run = site.run("batch jobs --fail-fast");
    assert_eq!(run.code, 2, "{}", run.stderr);
    assert!(
        run.stdout.contains("jobs/a.toml  not run    –") && run.stdout.ends_with("0 done, 1 failed, 3 not run\n"),
        "{}",
        run.stdout
    );
    assert!(names(&site).is_empty());
    // A line that is not there shows when its job is begun.
    let run = site.run("batch jobs/a.toml jobs/d.toml jobs/b.toml --fail-fast --jobs 1");
    assert_eq!(run.code, 3, "{}", run.stderr);
    assert!(run.stdout.ends_with("1 done, 1 failed, 1 not run\n"), "{}", run.stdout);
    assert_eq!(names(&site), ["a.json", "a.obj"]);
}

#[test]
fn jobs_that_get_in_each_others_way() {
    let site = site();
    let more = |name: &str, job: &str| fs::write(site.path("jobs").join(name), job).unwrap();
    more("e.toml", "input = '../pad.geojson'\nslope = '1:2'\noutput = '../jobs/a.obj'\n");
    site.run("batch jobs").refused(
        2,
        "error: two jobs write the same file\n  --> jobs/a.toml: jobs/a.obj\n  --> jobs/e.toml: jobs/../jobs/a.obj\n   \
         = help: give each output a name of its own",
    );
    site.run("batch jobs/a.toml jobs/a.toml").refused(
        2,
        "error: two jobs write the same file\n  --> jobs/a.toml: jobs/a.obj\n  --> jobs/a.toml: jobs/a.obj\n   \
         = help: give each output a name of its own",
    );
    fs::write(site.path("jobs/a.obj"), "v 0 0 0\n").unwrap();
    more("e.toml", "input = '../pad.geojson'\nslope = '1:2'\nterrain = 'a.obj'\noutput = 'e.obj'\n");
    site.run("batch jobs/a.toml jobs/e.toml").refused(
        2,
        "error: a job writes what another reads\n  --> jobs/a.toml: writes jobs/a.obj\n  --> jobs/e.toml: reads jobs/a.obj\n   \
         = help: the jobs of a batch are done in any order: run one after the other",
    );
    let run = site.run("batch jobs/a.toml --report jobs/a.json");
    assert!(run.code == 2 && run.stderr.contains("--> the summary: jobs/a.json"), "{run:?}");
    assert_eq!(names(&site), ["a.obj"]);
    more("e.toml", "input = '../pad.geojson'\nslope = '1:2'\noutput = '-'\n");
    let run = site.run("batch jobs/e.toml");
    assert!(
        run.stderr.starts_with("error: standard output cannot be shared by the jobs of a batch\n  --> jobs/e.toml\n"),
        "{run:?}"
    );
}

/// Neither the summary nor a job writes over the list or a job file; and what is not complete shows.
#[test]
fn lists_are_not_written_over() {
    let site = site();
    fs::write(site.path("l.txt"), "jobs/a.toml\n").unwrap();
    let run = site.run("batch --list l.txt --report l.txt");
    assert!(run.code == 2 && run.stdout.is_empty(), "{run:?}");
    assert_eq!(site.read("l.txt"), "jobs/a.toml\n");
    fs::write(site.path("jobs/a.toml"), "input = '../pad.geojson'\nslope = '1:2'\nreport = '../l.txt'\n").unwrap();
    site.run("batch --list l.txt").refused(
        2,
        "error: a job writes a job file, or the list of them\n  --> jobs/a.toml: writes jobs/../l.txt\n   \
         = help: give the output a name of its own",
    );
    assert_eq!(site.read("l.txt"), "jobs/a.toml\n");
}

/// Slopes that stop short of the ground are a warning, and their volumes not complete.
#[test]
fn what_is_not_complete_shows() {
    let site = site();
    fs::write(site.path("level.obj"), "v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nf 1 2 3\nf 1 3 4\n").unwrap();
    fs::write(site.path("up.csv"), "x,y,z\n-2,-2,2\n2,-2,2\n2,2,2\n-2,2,2\n-2,-2,2\n").unwrap();
    let job = "input = 'up.csv'\nterrain = 'level.obj'\nslope = '1:1'\n";
    fs::write(site.path("whole.toml"), job).unwrap();
    fs::write(site.path("open.toml"), format!("{job}height = 1\nallow-open = true\noutput = 'o.obj'\n")).unwrap();
    let run = site.run("batch whole.toml open.toml --report s.json --report -");
    let rows: Vec<Vec<&str>> = run.done().lines().map(|line| line.split_whitespace().collect()).collect();
    let complete = |job: &str| rows.iter().find(|row| row.first() == Some(&job)).map(|row| row[row.len() - 2]);
    assert_eq!([complete("whole.toml"), complete("open.toml"), complete("total")], [Some("yes"), Some("NO"), Some("NO")]);
    assert!(run.stderr.contains("warning[open-ends]: open.toml: slopes end above or below the ground"), "{}", run.stderr);
    let summary: Value = serde_json::from_str(&site.read("s.json")).unwrap();
    assert_eq!(summary["jobs"][0]["volumes"]["complete"], true);
    assert_eq!((&summary["jobs"][1]["volumes"]["complete"], &summary["total"]["complete"]), (&false.into(), &false.into()));
}

#[test]
fn wrong_usage() {
    let site = site();
    fs::create_dir(site.path("none")).unwrap();
    for arguments in ["batch", "batch jobs --jobs 0", "batch jobs --report s.pdf", "batch none", "batch jobs -k --fail-fast"] {
        assert_eq!(site.run(arguments).code, 2, "{arguments}");
    }
    let run = site.run("batch road.geojson");
    assert!(run.code == 2 && run.stderr.contains("this is no job file by its name\n  --> road.geojson\n"), "{run:?}");
    assert_eq!(site.run("batch nothing.toml").code, 3);
}

#[cfg(unix)]
#[test]
fn an_interrupt_leaves_nothing_half_written() {
    use std::process::{Command, Stdio};
    if super::interrupts_are_ignored() {
        return;
    }
    let site = site();
    // A pipe nobody writes to: the job has opened its outputs, and waits.
    let pipe = site.path("jobs/line.csv");
    assert!(Command::new("mkfifo").arg(&pipe).status().unwrap().success());
    fs::write(site.path("jobs/w.toml"), "input = 'line.csv'\nslope = '1:2'\noutput = 'w.obj'\n").unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_slopegen"))
        .args(["batch", "jobs/a.toml", "jobs/w.toml", "--report", "s.json", "--jobs", "2"])
        .current_dir(site.folder.path())
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let begun = std::time::Instant::now();
    let parts = || names(&site).iter().filter(|name| name.ends_with(".part")).count();
    while parts() < 1 || !site.path("jobs/a.json").exists() {
        assert!(begun.elapsed() < super::PATIENCE, "the jobs were never begun: {:?}", names(&site));
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert_eq!(names(&site), ["a.json", "a.obj", "line.csv"]);
    assert_eq!(site.new_files(), ["jobs"]);
}
