//! Colours: on terminals only, and as the environment and `--color` say.

use super::Site;
use std::process::{Command, Stdio};

/// The escape character that begins a colour.
const ESCAPE: char = '\u{1b}';

/// What the program writes through pipes, with these variables.
fn piped(site: &Site, arguments: &str, variables: &[(&str, &str)]) -> (String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_slopegen"))
        .args(arguments.split(' '))
        .current_dir(site.folder.path())
        .envs(variables.iter().copied())
        .env_remove("NO_COLOR")
        .stdin(Stdio::null())
        .output()
        .unwrap();
    (String::from_utf8_lossy(&output.stdout).into_owned(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[test]
fn pipes_have_none() {
    let site = Site::new();
    for arguments in ["build pad.geojson --slope 1:2", "build pad.geojson --slope 1:0.5", "--help", "build --nonsense"] {
        let (stdout, stderr) = piped(&site, arguments, &[("TERM", "xterm-256color")]);
        assert!(!stdout.contains(ESCAPE) && !stderr.contains(ESCAPE), "{arguments}: {stdout}{stderr}");
    }
}

#[test]
fn messages_have_them_where_they_are_forced() {
    let site = Site::new();
    let wrong = "build pad.geojson --slope 1:0.5";
    let red = "\u{1b}[1m\u{1b}[31merror:\u{1b}[0m `1:0.5` is ambiguous\n";
    assert!(piped(&site, wrong, &[("CLICOLOR_FORCE", "1")]).1.starts_with(red));
    assert!(piped(&site, &format!("{wrong} --color always"), &[]).1.starts_with(red));
    assert!(piped(&site, &format!("{wrong} --color=always"), &[("NO_COLOR", "1")]).1.starts_with("\u{1b}"));
    assert!(!piped(&site, &format!("{wrong} --color never"), &[("CLICOLOR_FORCE", "1")]).1.contains(ESCAPE));
    // Help and the errors of the parser as well.
    assert!(piped(&site, "build --help --color always", &[]).0.contains("\u{1b}[1mExamples:"));
    assert!(piped(&site, "--color always build --nonsense", &[]).1.contains(ESCAPE));
    // A report is a file as soon as it does not go to a terminal.
    let (report, _) = piped(&site, "build pad.geojson --slope 1:2 --color always --report r.txt", &[("CLICOLOR_FORCE", "1")]);
    assert!(report.contains("Volumes") && !report.contains(ESCAPE), "{report}");
    assert_eq!(site.read("r.txt"), report);
    assert!(!site.read("pad.obj").contains(ESCAPE));
}

/// What the program writes to a pseudo terminal; `None` where there is no `script` to make one.
#[cfg(target_os = "linux")]
#[allow(clippy::print_stderr, reason = "a test that is skipped says so")]
fn on_terminal(site: &Site, arguments: &str, variables: &str) -> Option<String> {
    let command = format!("env -u NO_COLOR {variables} {} {arguments}", env!("CARGO_BIN_EXE_slopegen"));
    let run = Command::new("script")
        .args(["-qec", &command, "/dev/null"])
        .current_dir(site.folder.path())
        .stdin(Stdio::null())
        .output();
    match run {
        Ok(output) => Some(String::from_utf8_lossy(&output.stdout).replace('\r', "")),
        Err(_) => {
            eprintln!("SKIPPED: `script` is not installed, and colours on terminals are not tested");
            None
        }
    }
}

#[cfg(target_os = "linux")]
#[test]
fn terminals_have_them_unless_told_otherwise() {
    let site = Site::new();
    let wrong = "build pad.geojson --slope 1:0.5";
    let Some(shown) = on_terminal(&site, wrong, "TERM=xterm") else { return };
    let red = "\u{1b}[31merror:\u{1b}[0m `1:0.5` is ambiguous\n";
    assert!(shown.contains(red), "{shown:?}");
    assert!(shown.contains("\u{1b}[36mhelp:\u{1b}[0m write"), "{shown:?}");
    for (arguments, variables) in
        [(wrong, "TERM=xterm NO_COLOR=1"), (wrong, "TERM=dumb"), (&format!("{wrong} --color never"), "TERM=xterm")]
    {
        let shown = on_terminal(&site, arguments, variables).unwrap();
        assert!(shown.contains("error: `1:0.5` is ambiguous") && !shown.contains(ESCAPE), "{arguments} {variables}: {shown:?}");
    }
    let report = on_terminal(&site, "build pad.geojson --slope 1:2 --to-elevation 405", "TERM=xterm").unwrap();
    assert!(report.contains("\u{1b}[1mCertificate (measured on this mesh)\u{1b}[0m\n"), "{report:?}");
    assert!(report.contains("\u{1b}[32myes\u{1b}[0m"), "{report:?}");
    // The same words as in a file.
    site.run("build pad.geojson --slope 1:2 --to-elevation 405 --report r.txt --quiet").done();
    let plain = anstream::adapter::strip_str(&report).to_string();
    let report = plain.split_once("slopegen ").map_or("", |(_, rest)| rest);
    let file = site.read("r.txt");
    assert!(report.starts_with(file.trim_start_matches("slopegen ").trim_end()), "{report}\n{file}");
    let shown = on_terminal(&site, "build pad.geojson --slope 1:2 --to-elevation 405", "TERM=xterm NO_COLOR=1").unwrap();
    assert!(!shown.contains("\u{1b}[1m") && shown.contains("\nCertificate"), "{shown:?}");
}
