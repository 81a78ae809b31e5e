//! Numbers of threads.

use super::{Run, Site};
use std::fs;

const COMMANDS: [&str; 7] = [
    "build road.csv --slope 1:1.5 --terrain ground.ply --allow-open -q -o o.ply",
    "sample ring.csv --closed --slope 1:1 --raster o.asc --cell 1",
    "volume ground.ply --to-elevation 100 -q --report o.json",
    "check ground.ply -q --report o.json",
    "diff ground.ply ground.ply -q --report o.json",
    "info ground.ply -q --report o.json",
    "batch job.toml -q --report o.json",
];

fn site() -> Site {
    let site = Site::new(30);
    fs::write(
        site.path("job.toml"),
        "input = 'road.csv'\nterrain = 'ground.ply'\nslope = '1:1.5'\nallow-open = true\noutput = 'j.ply'\n",
    )
    .unwrap();
    site
}

/// The files but for times, which differ from run to run.
fn results(site: &Site) -> Vec<(String, String)> {
    let timeless = |text: &str| {
        let line = |line: &&str| !["\"read\"", "\"total\"", "\"volume\"", "\"seconds\""].iter().any(|key| line.contains(key));
        text.lines().filter(line).collect::<Vec<_>>().join("\n")
    };
    let text = |name: &str| String::from_utf8_lossy(&fs::read(site.path(name)).unwrap()).into_owned();
    site.files().into_iter().map(|name| (name.clone(), timeless(&text(&name)))).collect()
}

#[test]
fn every_command_takes_them() {
    let site = site();
    for command in COMMANDS {
        for bad in ["0", "-1", "1025", "1.5", "many", "99999999999999999999"] {
            let run = site.run(&format!("{command} --threads {bad}"));
            assert_eq!(run.code(), 2, "{command} {bad}");
            let expected = format!(
                "error: `{bad}` is not a number of threads\n  --> --threads {bad}\n   = help: give a whole number from 1 to 1024\n"
            );
            assert_eq!(run.stderr, expected, "{command}");
            assert_eq!(site.files(), ["job.toml"], "{command}");
        }
    }
}

#[test]
fn results_are_the_same_with_any_number() {
    let site = site();
    for command in COMMANDS {
        let mut first = None;
        for threads in ["--threads 1", "", "--threads 2", "--threads 40"] {
            assert_eq!(site.run(&format!("{command} {threads}")).code(), 0, "{command} {threads}");
            let found = results(&site);
            assert_eq!(*first.get_or_insert(found.clone()), found, "{command} {threads}");
            site.files().iter().filter(|name| *name != "job.toml").for_each(|name| fs::remove_file(site.path(name)).unwrap());
        }
    }
}

#[test]
fn the_environment_does_not_matter() {
    let site = site();
    for value in ["0", "3", "100000", "garbage"] {
        let mut command = site.program(COMMANDS[0]);
        command.env("RAYON_NUM_THREADS", value);
        assert_eq!(Run::of(command).code(), 0, "{value}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn fewer_threads_than_asked_for_will_do() {
    let site = site();
    // Each has a stack of 2 MB: not all of 1000 fit.
    let run = Run::of(site.behind("ulimit -v 1000000", &format!("{} --threads 1000", COMMANDS[0])));
    assert_eq!(run.code(), 0, "{}", run.stderr);
    let run = Run::of(site.behind("ulimit -v 1000000", &format!("{} --threads 100 --jobs 1000", COMMANDS[6])));
    assert_eq!(run.code(), 0, "{}", run.stderr);
}
