//! Completions and manual pages: from the same source as the help, and fit for those who read them.

use super::Site;
use std::fs;
use std::io::Write as _;
use std::process::{Command, Stdio};

/// Whether a program is there; says so loudly if not.
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn has(program: &str) -> bool {
    let found = Command::new(program).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status().is_ok();
    if !found {
        eprintln!("SKIPPED: `{program}` is not installed, and what it would read is not tested");
    }
    found
}

/// Feeds a text to a program; gives its output, standard error included.
fn feed(program: &str, arguments: &[&str], text: &str) -> (bool, String) {
    let mut child = Command::new(program)
        .args(arguments)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    child.stdin.take().unwrap().write_all(text.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let all = [output.stdout, output.stderr].concat();
    (output.status.success(), String::from_utf8_lossy(&all).into_owned())
}

/// All long options of a command.
fn options(command: &clap::Command) -> Vec<&str> {
    command.get_arguments().filter_map(clap::Arg::get_long).collect()
}

#[test]
fn completions_are_scripts_of_their_shells() {
    let site = Site::new();
    let command = slopegen::cli::command();
    for (shell, check) in [
        ("bash", Some(["bash", "-n"])),
        ("zsh", Some(["zsh", "-n"])),
        ("fish", Some(["fish", "-n"])),
        ("powershell", None),
        ("elvish", None),
    ] {
        let run = site.run(&format!("completions {shell}"));
        let script = run.done();
        for sub in command.get_subcommands() {
            assert!(script.contains(sub.get_name()), "{shell}: {}", sub.get_name());
            for option in options(sub) {
                assert!(script.contains(option), "{shell}: --{option}");
            }
        }
        if let Some([program, argument]) = check.filter(|[program, _]| has(program)) {
            let (passed, said) = feed(program, &[argument], script);
            assert!(passed && said.is_empty(), "{shell}: {said}");
        }
    }
    let run = site.run("completions tcsh");
    assert!(run.code == 2 && run.stderr.contains("possible values: bash"), "{run:?}");
}

/// A page as it is read, without its line breaks and hyphenation.
fn rendered(page: &str) -> String {
    let (passed, text) = feed("groff", &["-man", "-Tutf8", "-ww", "-P-cbou", "-rHY=0"], page);
    assert!(passed && !text.contains("warning"), "{text}");
    text.replace('\u{2010}', "-").split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn manual_pages_have_everything() {
    let site = Site::new();
    fs::create_dir(site.path("man")).unwrap();
    assert_eq!(site.run("man --out man").done(), "");
    let command = slopegen::cli::command();
    let groff = has("groff");
    let mut count = 0;
    for sub in command.get_subcommands().chain([&command]) {
        let name = if sub.get_name() == "slopegen" { "slopegen".to_owned() } else { format!("slopegen-{}", sub.get_name()) };
        let page = site.read(&format!("man/{name}.1"));
        for section in ["NAME", "SYNOPSIS", "DESCRIPTION", "EXAMPLES", "EXIT STATUS"] {
            assert!(
                page.lines().any(|line| line.trim_matches('"').replace(".SH ", "").trim_matches('"') == section),
                "{name}: {section}"
            );
        }
        if groff {
            let text = rendered(&page);
            for option in options(sub) {
                assert!(text.contains(&format!("--{option}")), "{name}: --{option} in\n{text}");
            }
            // Examples and codes as in the help.
            let help = sub.get_after_help().map(ToString::to_string).unwrap_or_default();
            for line in help.lines().filter(|line| line.starts_with("  ")) {
                let line = line.split_whitespace().collect::<Vec<_>>().join(" ");
                assert!(text.contains(&line), "{name}: {line} in\n{text}");
            }
            assert!(text.contains("4 an output could not be written"), "{text}");
        }
        count += 1;
    }
    assert_eq!(fs::read_dir(site.path("man")).unwrap().count(), count);
    // One page to standard output is the same.
    assert_eq!(site.run("man build").done(), site.read("man/slopegen-build.1"));
    assert_eq!(site.run("man").done(), site.read("man/slopegen.1"));
}

#[test]
fn pages_that_cannot_be_made() {
    let site = Site::new();
    assert!(site.run("man nope").stderr.starts_with("error: there is no command `nope`\n"));
    assert_eq!(site.run("man nope").code, 2);
    assert_eq!(site.run("man --out nowhere").code, 4);
    assert_eq!(site.run("man build --out .").code, 2);
}
