//! Colours of messages and of reports on terminals. Files and pipes never get them.

use super::super::args::ColorArg;
use anstyle::{AnsiColor, Style};
use std::ffi::OsString;

const ERROR: Style = AnsiColor::Red.on_default().bold();
const WARNING: Style = AnsiColor::Yellow.on_default().bold();
const NOTE: Style = AnsiColor::Green.on_default().bold();
const HELP: Style = AnsiColor::Cyan.on_default().bold();
const PLACE: Style = AnsiColor::Blue.on_default().bold();
const HEADING: Style = Style::new().bold();
const GOOD: Style = AnsiColor::Green.on_default();
const BAD: Style = AnsiColor::Red.on_default().bold();

/// Obeys `--color`. Without it the streams decide: a terminal has colours unless `NO_COLOR` is set or `TERM` is `dumb`;
/// `CLICOLOR_FORCE` brings them to files and pipes of the system.
pub(in crate::cli) fn choose(when: ColorArg) {
    let set = |name: &str| std::env::var_os(name).is_some_and(|value| !value.is_empty() && value != "0");
    // A terminal that says it has no colours has none, also where `CI` is set, which else counts for one that has them.
    let dumb = std::env::var_os("TERM").is_some_and(|term| term == "dumb") && !set("CLICOLOR_FORCE");
    let choice = match when {
        ColorArg::Auto if dumb => anstream::ColorChoice::Never,
        ColorArg::Auto => anstream::ColorChoice::Auto,
        ColorArg::Always => anstream::ColorChoice::Always,
        ColorArg::Never => anstream::ColorChoice::Never,
    };
    choice.write_global();
}

/// What `--color` says, seen before the arguments are parsed: help and errors of the parser have colours, too.
pub(in crate::cli) fn asked(arguments: &[OsString]) -> ColorArg {
    let mut when = ColorArg::Auto;
    let mut words = arguments.iter().skip(1).map(|word| word.to_string_lossy()).take_while(|word| word != "--");
    while let Some(word) = words.next() {
        let value = match word.strip_prefix("--color") {
            Some("") => words.next().map(|value| value.into_owned()),
            Some(rest) => rest.strip_prefix('=').map(str::to_owned),
            None => None,
        };
        when = match value.as_deref() {
            Some("always") => ColorArg::Always,
            Some("never") => ColorArg::Never,
            Some("auto") => ColorArg::Auto,
            _ => when,
        };
    }
    when
}

fn painted(style: Style, text: &str) -> String {
    format!("{style}{text}{style:#}")
}

/// A message for standard error, its key words in colour.
pub(super) fn message(text: &str) -> String {
    text.split('\n').map(line).collect::<Vec<_>>().join("\n")
}

fn line(line: &str) -> String {
    for (word, style) in [("error:", ERROR), ("warning[", WARNING), ("note[", NOTE)] {
        let Some(rest) = line.strip_prefix(word) else { continue };
        let (head, rest) = match word.strip_suffix('[').and(rest.split_once(']')) {
            Some((code, rest)) => (format!("{word}{code}]"), rest),
            None => (word.to_owned(), rest),
        };
        return format!("{}{rest}", painted(style, &head));
    }
    if let Some(rest) = line.strip_prefix("   = help:") {
        return format!("   {} {}{rest}", painted(PLACE, "="), painted(HELP, "help:"));
    }
    for (mark, indent) in [("-->", "  "), ("=", "   ")] {
        if let Some(rest) = line.strip_prefix(indent).and_then(|line| line.strip_prefix(mark)) {
            return format!("{indent}{}{rest}", painted(PLACE, mark));
        }
    }
    line.to_owned()
}

/// A report for a terminal: headings stand out, and the words one looks for.
pub(super) fn report(text: &str) -> String {
    let mut warnings = false;
    let paint = |line: &str| {
        if !line.is_empty() && !line.starts_with(' ') {
            warnings = line == "Warnings";
            let style = match line.split(':').next() {
                Some("Warnings") => WARNING,
                Some("PASSED") => GOOD,
                Some("FAILED") => BAD,
                _ => HEADING,
            };
            return painted(style, line);
        }
        let code = line.trim_start().split(':').next().unwrap_or("");
        if warnings && line.starts_with("  ") && !line.starts_with("    ") && !code.is_empty() {
            return line.replacen(code, &painted(WARNING, code), 1);
        }
        // Results of jobs stand in the middle of their rows.
        for (result, style) in [("  done  ", GOOD), ("  failed  ", BAD)] {
            if line.contains(result) {
                return line.replacen(result, &format!("  {}  ", painted(style, result.trim())), 1);
            }
        }
        let Some((before, last)) = line.rsplit_once(' ') else { return line.to_owned() };
        let style = match last {
            "surplus" | "deficit" | "balanced" => HEADING,
            "yes" | "passed" => GOOD,
            "NO" | "no" | "FAILED" | "beyond" => BAD,
            _ => return line.to_owned(),
        };
        format!("{before} {}", painted(style, last))
    };
    text.split('\n').map(paint).collect::<Vec<_>>().join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Without its colours a text is what it was.
    #[track_caller]
    fn plain(painted: &str, text: &str) {
        assert_eq!(anstream::adapter::strip_str(painted).to_string(), text);
    }

    #[test]
    fn key_words_of_messages() {
        let text = "error: no\n  --> a.csv\n   = 1 against 2\n   = help: mend it\nwarning[buried]: x: y\nnote[a]: b\nelse";
        let shown = message(text);
        plain(&shown, text);
        for part in
            ["\u{1b}[1m\u{1b}[31merror:\u{1b}[0m no", "\u{1b}[33mwarning[buried]\u{1b}[0m: x: y", "\u{1b}[36mhelp:\u{1b}[0m mend"]
        {
            assert!(shown.contains(part), "{part:?} in {shown:?}");
        }
        assert!(shown.ends_with("\nelse"));
    }

    #[test]
    fn key_words_of_reports() {
        let text = "slopegen 1: x\n\nVolumes\n  net   1 m³ deficit\n  watertight  NO\n\nWarnings\n  buried: 2 no\n";
        let shown = report(text);
        plain(&shown, text);
        for part in
            ["\u{1b}[1mVolumes\u{1b}[0m", "\u{1b}[1mdeficit\u{1b}[0m", "\u{1b}[31mNO\u{1b}[0m", "\u{1b}[33mburied\u{1b}[0m: 2 no"]
        {
            assert!(shown.contains(part), "{part:?} in {shown:?}");
        }
    }

    #[test]
    fn results_of_jobs() {
        let text = "slopegen 1: 2 jobs\n\n  a.toml  done       0  1.00\n  b.toml  failed     3     –\n\n1 done, 1 failed\n";
        let shown = report(text);
        plain(&shown, text);
        for part in ["  \u{1b}[32mdone\u{1b}[0m  ", "  \u{1b}[1m\u{1b}[31mfailed\u{1b}[0m  "] {
            assert!(shown.contains(part), "{part:?} in {shown:?}");
        }
    }

    #[test]
    fn color_is_seen_before_parsing() {
        let asked = |text: &str| asked(&text.split(' ').map(OsString::from).collect::<Vec<_>>());
        assert_eq!(asked("slopegen build --color never x"), ColorArg::Never);
        assert_eq!(asked("slopegen --color=always build"), ColorArg::Always);
        assert_eq!(asked("slopegen build -- --color never"), ColorArg::Auto);
        assert_eq!(asked("slopegen build --color"), ColorArg::Auto);
        assert_eq!(asked("slopegen build --colorful"), ColorArg::Auto);
    }
}
