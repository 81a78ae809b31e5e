//! The README says what is so: its commands run, its report has the lines shown, its links lead somewhere.
#![allow(clippy::print_stderr, reason = "tells what was skipped")]

mod common;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use tempfile::TempDir;

const PROGRAM: &str = env!("CARGO_BIN_EXE_slopegen");
const RUN: &str = "cargo run --release -- ";
const TEST: &str = "cargo test";

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: &str) -> String {
    fs::read_to_string(root().join(path)).unwrap_or_else(|e| panic!("{path}: {e}"))
}

/// The lines of the fenced block after `<!-- mark -->`.
fn block(text: &str, mark: &str) -> Vec<String> {
    let mark = format!("<!-- {mark} -->\n```");
    let rest = text.split_once(&mark).unwrap_or_else(|| panic!("no block `{mark}`")).1;
    let body = rest.split_once('\n').unwrap().1;
    body.split("\n```").next().unwrap().lines().map(str::to_owned).collect()
}

/// A working folder with the fixtures, as in a copy of the repository.
fn workplace() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    let fixtures = folder.path().join("fixtures");
    fs::create_dir(&fixtures).unwrap();
    for entry in fs::read_dir(root().join("fixtures")).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            fs::copy(&path, fixtures.join(path.file_name().unwrap())).unwrap();
        }
    }
    folder
}

fn run(arguments: &str, folder: &Path) -> Output {
    Command::new(PROGRAM).args(arguments.split_whitespace()).current_dir(folder).output().unwrap()
}

/// The files a command line asks for; the default mesh where it names none.
fn outputs(arguments: &str) -> Vec<PathBuf> {
    let words: Vec<&str> = arguments.split_whitespace().collect();
    let after = |option: &str| words.windows(2).filter(|w| w[0] == option).map(|w| PathBuf::from(w[1])).collect::<Vec<_>>();
    let mut files = after("-o");
    if words[0] == "build" && files.is_empty() {
        files.push(Path::new(Path::new(words[1]).file_stem().unwrap()).with_extension("obj"));
    }
    files.extend(["--finished", "--lines", "--report", "--station-table", "--raster"].iter().flat_map(|option| after(option)));
    files
}

/// Runs one line and checks its exit code and its files.
fn check(arguments: &str, expected: i32, folder: &Path) -> Output {
    let files = outputs(arguments);
    files.iter().for_each(|file| drop(fs::remove_file(folder.join(file))));
    let output = run(arguments, folder);
    let said = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(expected), "slopegen {arguments}\n{said}");
    for file in files {
        let size = fs::metadata(folder.join(&file)).map_or(0, |m| m.len());
        assert_eq!(size > 0, expected == 0, "slopegen {arguments}: {} has {size} bytes\n{said}", file.display());
    }
    common::schema::check_folder(folder);
    output
}

#[test]
fn quick_start_runs_and_reports_what_is_shown() {
    let readme = read("README.md");
    let commands = block(&readme, "quick start");
    assert_eq!(commands.len(), 2, "the quick start has two commands");
    assert_eq!(commands[1], TEST);
    let folder = workplace();
    let main_job = commands[0].strip_prefix(RUN).expect("the main job is a `cargo run`");
    let output = check(main_job, 0, folder.path());
    let report = String::from_utf8(output.stdout).unwrap();
    // Figures may change in the last digit with the engine; their names and their order may not.
    let name = |line: &str| line.split("  ").find(|part| !part.is_empty()).unwrap_or("").split(',').next().unwrap().to_owned();
    let mut left = report.lines().map(name);
    for shown in block(&readme, "report").iter().filter(|line| !line.is_empty()).map(|line| name(line)) {
        assert!(left.any(|line| line == shown), "the report does not say `{shown}` (there):\n{report}");
    }
}

#[test]
fn figures_shown_are_those_of_the_run() {
    let readme = read("README.md");
    let folder = workplace();
    let output = run(block(&readme, "quick start")[0].strip_prefix(RUN).unwrap(), folder.path());
    let report = String::from_utf8(output.stdout).unwrap();
    let figure = |text: &str, name: &str| -> f64 {
        let line = text.lines().find(|line| line.trim_start().starts_with(name)).unwrap_or_else(|| panic!("no `{name}`"));
        let rest = line.trim_start()[name.len()..].trim_start();
        let end = rest.find(|c: char| !(c.is_ascii_digit() || ".e-".contains(c))).unwrap_or(rest.len());
        rest[..end].parse().unwrap_or_else(|e| panic!("`{line}`: {e}"))
    };
    let shown = block(&readme, "report").join("\n");
    for (name, tolerance) in [
        ("overlaps", 0.0),
        ("cut", 1e-6),
        ("fill", 1e-6),
        ("net (cut − fill)", 1e-5),
        ("slope deviation", 0.1),
        ("height deviation", 0.5),
        ("error at most", 0.5),
    ] {
        // The slopes are called `cut` and `fill` as well; the volumes come after them.
        let report = if ["cut", "fill"].contains(&name) { report.split_once("Volumes").unwrap().1 } else { &report };
        let (a, b) = (figure(&shown, name), figure(report, name));
        assert!((a - b).abs() <= tolerance * b.abs(), "the README shows {a} for `{name}`, the run gives {b}");
    }
}

#[test]
fn examples_run() {
    let folder = workplace();
    let readme = read("README.md");
    for line in block(&readme, "examples") {
        let (command, note) = line.split_once('#').unwrap_or((&line, ""));
        let arguments = command.strip_prefix("slopegen ").unwrap_or_else(|| panic!("`{line}` does not call slopegen"));
        let code = note.split_once("exits with ").map_or(0, |(_, rest)| rest[..1].parse().unwrap());
        check(arguments, code, folder.path());
    }
}

#[test]
fn continuous_integration_runs_the_same_two_commands() {
    let script = read(".ci/run");
    let lines: Vec<&str> = script.lines().collect();
    let commands = block(&read("README.md"), "quick start");
    assert!(commands.iter().all(|command| lines.contains(&command.as_str())), "{commands:?} are not lines of .ci/run");
    assert_eq!(lines.last(), Some(&TEST), "the results of the tests come last");
}

#[test]
fn links_lead_somewhere() {
    let mut checked = 0;
    let mut documents = vec!["README.md".to_owned(), "CHANGELOG.md".to_owned(), "fixtures/README.md".to_owned()];
    for entry in fs::read_dir(root().join("docs")).unwrap() {
        let name = entry.unwrap().file_name().into_string().unwrap();
        if name.ends_with(".md") {
            documents.push(format!("docs/{name}"));
        }
    }
    for document in documents {
        let text = read(&document);
        let links = text.split("](").skip(1).filter_map(|rest| rest.split_once(')')).map(|(link, _)| link);
        let pictures = text.split("src=\"").skip(1).filter_map(|rest| rest.split_once('"')).map(|(link, _)| link);
        for link in links.chain(pictures).filter(|link| !link.contains("://")) {
            checked += 1;
            let (file, anchor) = link.split_once('#').unwrap_or((link, ""));
            let folder = Path::new(&document).parent().unwrap();
            let target = if file.is_empty() { PathBuf::from(&document) } else { folder.join(file) };
            assert!(root().join(&target).exists(), "{document}: `{link}` leads nowhere");
            if !anchor.is_empty() {
                let text = fs::read_to_string(root().join(&target)).unwrap();
                let found = text.lines().filter(|line| line.starts_with('#')).any(|line| anchor_of(line) == anchor);
                assert!(found, "{document}: `{link}` names no heading");
            }
        }
    }
    assert!(checked > 20, "only {checked} links were found: the search is broken");
}

/// The anchor of a heading, as repositories show it.
fn anchor_of(heading: &str) -> String {
    let text = heading.trim_start_matches('#').trim().to_lowercase();
    let kept = text.chars().filter(|c| c.is_alphanumeric() || " -_".contains(*c));
    kept.map(|c| if c == ' ' { '-' } else { c }).collect()
}

/// The rows of the table between `<!-- mark -->` and `<!-- /mark -->`, cell by cell.
fn rows_between(text: &str, mark: &str) -> Vec<Vec<String>> {
    let rest = text.split_once(&format!("<!-- {mark} -->\n")).unwrap_or_else(|| panic!("no `{mark}`")).1;
    let table = rest.split_once(&format!("<!-- /{mark} -->")).unwrap_or_else(|| panic!("`{mark}` has no end")).0;
    let rows = table.lines().filter(|line| line.starts_with('|')).skip(2);
    rows.map(|line| line.split('|').map(|cell| cell.trim().to_owned()).collect()).collect()
}

#[test]
fn figures_of_other_tools_are_those_of_one_run() {
    let (short, whole) = (rows_between(&read("README.md"), "peers"), rows_between(&read("docs/peers.md"), "peers"));
    for row in &short {
        // Job, tool, CPU, greatest error, remark; the whole table has more columns between.
        let same = |other: &&Vec<String>| row[2..].iter().filter(|cell| !cell.is_empty()).all(|cell| other.contains(cell));
        assert!(whole.iter().any(|other| same(&other)), "README.md has figures of another run than docs/peers.md: {row:?}");
    }
    assert!(short.len() > 10 && short.len() < whole.len(), "{} rows of {}", short.len(), whole.len());
}

#[test]
fn scripts_beside_other_tools_are_sound() {
    let folder = root().join("tests/peers");
    let mut scripts: Vec<PathBuf> = fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    scripts.retain(|path| path.extension().is_some_and(|e| e == "py"));
    assert!(scripts.len() > 5, "only {} scripts were found", scripts.len());
    let compile = "import sys\nfor p in sys.argv[1:]: compile(open(p, encoding='utf-8').read(), p, 'exec')";
    for (program, arguments) in [("python3", vec!["-c".into(), compile.into()]), ("bash", vec!["-n".into()])] {
        let files = if program == "bash" { vec![folder.join("run")] } else { scripts.clone() };
        match Command::new(program).args::<_, std::ffi::OsString>(arguments).args(&files).output() {
            Ok(output) => assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr)),
            Err(why) => eprintln!("SKIPPED: {program} cannot be run ({why}); the scripts in tests/peers are not looked at"),
        }
    }
}
