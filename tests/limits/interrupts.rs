//! Signals at any moment.

use super::{PATIENCE, Site};
use rustix::process::{Pid, Signal, kill_process};
use std::ffi::OsStr;
use std::fs;
use std::io::{Read as _, Write as _};
use std::os::unix::process::ExitStatusExt as _;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// Outputs of all kinds; the first ones are the same bytes in every run.
const OUTPUTS: [&str; 9] = ["a.obj", "a.ply", "a.xml", "a.dxf", "f.ply", "l.geojson", "r.json", "plan.svg", "t.csv"];
const JOB: &str = "build road.csv --width 4 --slope 1:1.5 --terrain ground.ply --stations 20 -q -o a.obj -o a.ply -o a.xml -o a.dxf \
                   --finished f.ply --lines l.geojson --report r.json --plot plan.svg --station-table t.csv";

const SIGNALS: [(Signal, i32); 3] = [(Signal::INT, 2), (Signal::TERM, 15), (Signal::HUP, 1)];

/// The program, with signals as in a terminal: what is started in the background, or by `nohup`, ignores some of them, and so
/// would what the tests start. (GNU's `env` can do this.)
fn signalled(site: &Site, arguments: &str) -> Command {
    let plain = site.program(arguments);
    let with_defaults = |program: &OsStr| {
        let mut command = Command::new("env");
        command.arg("--default-signal=INT,TERM,HUP").arg(program);
        command
    };
    if !with_defaults("true".as_ref()).status().is_ok_and(|status| status.success()) {
        return plain;
    }
    let mut command = with_defaults(plain.get_program());
    command.args(plain.get_args());
    site.here(command)
}

fn send(child: &Child, signal: Signal) {
    // One that has ended already has to be waited for first, which keeps its number.
    let _ = kill_process(Pid::from_child(child), signal);
}

/// The code of a child that was sent a signal: its own, or −1 if the signal came before anything was begun.
fn code(child: &mut Child, number: i32) -> i32 {
    let begun = Instant::now();
    let status = loop {
        if let Some(status) = child.try_wait().unwrap() {
            break status;
        }
        if begun.elapsed() > PATIENCE {
            let _ = child.kill();
            panic!("signal {number} did not end the run");
        }
        sleep(Duration::from_millis(5));
    };
    match status.signal() {
        Some(signal) => {
            assert_eq!(signal, number);
            -1
        }
        None => status.code().unwrap(),
    }
}

#[test]
fn at_random_moments_there_is_all_or_nothing() {
    let site = Site::new(60);
    let begun = Instant::now();
    assert_eq!(site.run(JOB).code(), 0);
    let whole = begun.elapsed();
    let mut expected: Vec<String> = OUTPUTS.map(str::to_owned).to_vec();
    expected.sort();
    assert_eq!(site.files(), expected);
    let mesh = fs::read(site.path("a.obj")).unwrap();
    site.clear();
    let mut state = 1_u32;
    let mut outcomes = [0; 2];
    for round in 0..40 {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let (signal, number) = SIGNALS[round % 3];
        // Half of the rounds replace what is there.
        let old = round % 2 == 1;
        if old {
            OUTPUTS.iter().for_each(|name| fs::write(site.path(name), "old").unwrap());
        }
        let mut child = signalled(&site, JOB).spawn().unwrap();
        sleep(whole.mul_f64(1.1 * f64::from(state >> 16) / 65536.0));
        send(&child, signal);
        let code = code(&mut child, number);
        assert!([0, -1, 128 + number].contains(&code), "round {round}: {code}");
        let files = site.files();
        if !old && files.is_empty() {
            assert_ne!(code, 0, "round {round}");
        } else {
            assert_eq!(files, expected, "round {round}");
            let fresh: Vec<bool> = OUTPUTS.iter().map(|name| fs::read(site.path(name)).unwrap() != b"old").collect();
            assert!(fresh.iter().all(|is| *is == fresh[0]), "round {round}: {fresh:?}");
            assert!(fresh[0] || (old && code != 0), "round {round}: {code}");
            assert!(!fresh[0] || fs::read(site.path("a.obj")).unwrap() == mesh, "round {round}");
        }
        outcomes[usize::from(code == 0)] += 1;
        site.clear();
    }
    assert!(outcomes[0] > 0, "no run was interrupted");
}

#[test]
fn between_the_renames() {
    let site = Site::new(3);
    // Many outputs, so that giving them their names takes a while.
    let outputs: String = (0..100).map(|i| format!(" -o o{i}.stl")).collect();
    let job = format!("build ring.csv --closed --slope 1:1 --height 1 -q{outputs}");
    // Each with the file that tells its origin.
    const ALL: usize = 200;
    for (signal, number) in SIGNALS {
        let mut child = signalled(&site, &job).spawn().unwrap();
        let begun = Instant::now();
        let named = || site.files().iter().any(|name| !name.starts_with('.'));
        while !named() {
            assert!(begun.elapsed() < PATIENCE && child.try_wait().unwrap().is_none_or(|status| status.success()));
        }
        send(&child, signal);
        let code = code(&mut child, number);
        assert!(code == 0 || code == 128 + number, "{code}");
        assert_eq!(site.files().iter().filter(|name| !name.starts_with('.')).count(), ALL);
        assert_eq!(site.files().len(), ALL);
        site.clear();
    }
}

#[test]
fn in_a_batch_every_job_is_whole_or_absent() {
    let site = Site::new(40);
    for i in 0..6 {
        let outputs = format!("output = ['b{i}.obj', 'b{i}.ply']\nreport = 'b{i}.json'\n");
        let job = format!(
            "input = 'road.csv'\nterrain = 'ground.ply'\nslope = '1:1.5'\nallow-open = true\nwidth = {}\n{outputs}",
            3 + i
        );
        fs::write(site.path(&format!("j{i}.toml")), job).unwrap();
    }
    let jobs: Vec<String> = (0..6).map(|i| format!("j{i}.toml")).collect();
    let command = format!("batch {} --jobs 3 -q --report s.json", jobs.join(" "));
    let begun = Instant::now();
    assert_eq!(site.run(&command).code(), 0);
    let whole = begun.elapsed();
    let results = || site.files().into_iter().filter(|name| !name.ends_with(".toml")).collect::<Vec<_>>();
    for round in 0..12 {
        results().iter().for_each(|name| fs::remove_file(site.path(name)).unwrap());
        let (signal, number) = SIGNALS[round % 3];
        let mut child = signalled(&site, &command).spawn().unwrap();
        sleep(whole.mul_f64((round + 1) as f64 / 13.0));
        send(&child, signal);
        let code = code(&mut child, number);
        assert!([0, -1, 128 + number].contains(&code), "round {round}: {code}");
        let found = results();
        assert!(!found.iter().any(|name| name.starts_with('.')), "round {round}: {found:?}");
        for i in 0..6 {
            let count = found.iter().filter(|name| name.starts_with(&format!("b{i}."))).count();
            assert!(count == 0 || count == 3, "round {round}: {found:?}");
        }
    }
}

/// A job that has opened its outputs and waits for its line.
fn waiting(site: &Site, mut command: std::process::Command) -> Child {
    let child = command.stdin(Stdio::piped()).spawn().unwrap();
    let begun = Instant::now();
    while !site.files().iter().any(|name| name.ends_with(".part")) {
        assert!(begun.elapsed() < PATIENCE, "the outputs were never opened");
        sleep(Duration::from_millis(5));
    }
    child
}

const WAITING: &str = "build - --input-format csv --slope 1:1.5 -q -o a.obj -o a.ply";

#[test]
fn every_signal_has_its_code() {
    let site = Site::new(3);
    for (signal, number) in SIGNALS {
        let mut child = waiting(&site, signalled(&site, WAITING));
        let stdin = child.stdin.take();
        send(&child, signal);
        assert_eq!(code(&mut child, number), 128 + number);
        drop(stdin);
        assert!(site.files().is_empty(), "{:?}", site.files());
    }
    // Twice at once, as `timeout` does: the second does not cut the first short.
    for _ in 0..5 {
        let mut child = waiting(&site, signalled(&site, WAITING));
        let stdin = child.stdin.take();
        send(&child, Signal::TERM);
        send(&child, Signal::TERM);
        send(&child, Signal::INT);
        assert!([143, 130].contains(&code(&mut child, 15)));
        drop(stdin);
        assert!(site.files().is_empty(), "{:?}", site.files());
    }
}

#[test]
fn what_nohup_switches_off_stays_off() {
    let site = Site::new(3);
    let mut child = waiting(&site, site.behind("trap '' HUP", WAITING));
    send(&child, Signal::HUP);
    sleep(Duration::from_millis(100));
    assert!(child.try_wait().unwrap().is_none(), "hung up all the same");
    child.stdin.take().unwrap().write_all(b"x,y,z\n0,0,10\n50,0,11\n").unwrap();
    let mut stderr = String::new();
    child.stderr.take().unwrap().read_to_string(&mut stderr).unwrap();
    assert!(child.wait().unwrap().success(), "{stderr}");
    assert_eq!(site.files(), ["a.obj", "a.ply"]);
}

#[test]
fn what_a_killed_run_leaves_is_known_by_its_name() {
    let site = Site::new(3);
    let mut child = waiting(&site, signalled(&site, WAITING));
    child.kill().unwrap();
    child.wait().unwrap();
    assert!(site.files().iter().all(|name| name.starts_with(".slopegen-") && name.ends_with(".part")), "{:?}", site.files());
}
