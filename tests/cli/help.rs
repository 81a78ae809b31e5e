//! Help, version, and that the documents tell what the program does.

use super::Site;
use std::fs;
use std::path::Path;

const DOCUMENT: &str = include_str!("../../docs/cli.md");

#[test]
fn help_and_version_are_no_errors() {
    let site = Site::new();
    assert!(site.run("--help").done().contains("Exit codes:"));
    assert!(site.run("build --help").done().contains("slopegen build road.geojson --slope 1:1.5"));
    assert!(site.run("help sample").done().contains("--raster"));
    assert_eq!(site.run("--version").done(), concat!("slopegen ", env!("CARGO_PKG_VERSION"), "\n"));
    assert!(site.new_files().is_empty());
}

#[test]
fn without_arguments_help_goes_to_standard_error() {
    let run = Site::new().run("");
    assert_eq!((run.code, run.stdout.as_str()), (2, ""));
    assert!(run.stderr.contains("Usage: slopegen [OPTIONS] <COMMAND>"));
}

/// Every command has examples in its help, and the parser takes them.
#[test]
fn examples_of_the_help_are_understood() {
    let command = slopegen::cli::command();
    let mut count = 0;
    for sub in command.get_subcommands().chain([&command]) {
        let help = sub.get_after_help().map(ToString::to_string).unwrap_or_default();
        assert!(help.starts_with("Examples:\n  "), "{}: {help}", sub.get_name());
        for line in help.lines().filter(|line| line.starts_with("  ") && !line.starts_with("      ")) {
            let Some((_, example)) = line.split_once("slopegen ") else { continue };
            let example = example.split(['>', '|']).next().unwrap();
            let words = ["slopegen"].into_iter().chain(example.split_whitespace());
            let parsed = slopegen::cli::command().try_get_matches_from(words);
            assert!(parsed.is_ok(), "{line}: {}", parsed.unwrap_err());
            count += 1;
        }
        // Lines that are broken anywhere but at blanks would break commands.
        assert!(help.lines().all(|line| line.chars().count() <= 125), "{help}");
    }
    assert!(count > 25, "{count}");
}

/// All commands with their options.
fn options(command: &clap::Command, found: &mut Vec<String>) {
    found.extend(command.get_arguments().filter_map(clap::Arg::get_long).map(str::to_owned));
    command.get_subcommands().for_each(|c| options(c, found));
}

#[test]
fn every_option_is_documented() {
    let mut found = Vec::new();
    options(&slopegen::cli::command(), &mut found);
    assert!(found.len() > 20, "{found:?}");
    for option in found {
        assert!(DOCUMENT.contains(&format!("`--{option}")), "docs/cli.md does not name --{option}");
    }
}

/// Codes of notes in a source file: the first string after `Note::new(` or `note(self.…, `.
fn codes(source: &str) -> Vec<String> {
    let mut found = Vec::new();
    for start in ["Note::new(", "note(self."] {
        for rest in source.split(start).skip(1) {
            if let Some(code) = rest.split('"').nth(1).filter(|c| c.contains('-') || *c == "encoding") {
                found.push(code.to_owned());
            }
        }
    }
    found.retain(|code| code.chars().all(|c| c.is_ascii_lowercase() || c == '-'));
    found
}

fn sources(folder: &Path, found: &mut Vec<String>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else {
            found.extend(codes(&fs::read_to_string(path).unwrap()));
        }
    }
}

#[test]
fn every_warning_is_documented() {
    let mut found = Vec::new();
    sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &mut found);
    assert!(found.len() >= 14, "{found:?}");
    for code in found {
        assert!(DOCUMENT.contains(&format!("| `{code}` |")), "docs/cli.md does not list the code {code}");
    }
}

#[test]
fn documented_examples_run() {
    let site = Site::new();
    fs::create_dir(site.path("fixtures")).unwrap();
    for name in
        ["road.geojson", "pad.geojson", "pit.csv", "hill_road.geojson", "hill_pad.geojson", "hill_road.toml", "ground.obj"]
    {
        let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures").join(name);
        fs::copy(from, site.path("fixtures").join(name)).unwrap();
    }
    fs::create_dir(site.path("fixtures/landxml")).unwrap();
    let from = Path::new(env!("CARGO_MANIFEST_DIR")).join("fixtures/landxml/site.xml");
    fs::copy(from, site.path("fixtures/landxml/site.xml")).unwrap();
    let examples = DOCUMENT.split("## Examples").nth(1).unwrap().split("```").nth(1).unwrap();
    let mut count = 0;
    for line in examples.lines().filter(|line| !line.is_empty()) {
        let (before, command) = line.split_once("slopegen ").unwrap();
        let echoed = before.strip_prefix("echo ").and_then(|b| b.strip_suffix(" | ")).unwrap_or("");
        let (command, redirected) = command.split_once(" < ").map_or((command, None), |(c, r)| (c, Some(r)));
        let stdin = redirected.map_or_else(|| echoed.to_owned(), |r| site.read(r.split(' ').next().unwrap()));
        assert_eq!(site.run_with(command, stdin).code, 0, "{line}");
        count += 1;
    }
    assert!(count >= 10);
    for file in [
        "hill_road.obj",
        "finished.obj",
        "yard.ply",
        "yard.geojson",
        "yard.xml",
        "yard.dxf",
        "yard.glb",
        "yard.glb.origin.json",
        "yard_lines.dxf",
        "volume.json",
        "road.obj",
        "pad.ply",
        "pad_lines.geojson",
        "pad.json",
        "pit.obj",
        "cut.obj",
        "road.asc",
    ] {
        assert!(site.path(file).exists(), "{file}");
    }
}
