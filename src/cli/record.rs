//! Arguments as a report records them, and back.

use super::args::Arguments;
use super::help;
use crate::report::Options;
use clap::parser::ValueSource;
use clap::{Arg, ArgMatches, CommandFactory as _};
use std::ffi::OsString;

/// What was given to a command, by the long names of options; files given by position by their own. What only says how the
/// program runs is left out.
pub(super) fn options(command: &str, matches: &ArgMatches) -> Options {
    let all = Arguments::command();
    let Some(declared) = all.find_subcommand(command) else { return Options::new() };
    let mut options = Options::new();
    for arg in declared.get_arguments().filter(|arg| is_recorded(arg)) {
        let id = arg.get_id().as_str();
        if matches.value_source(id) != Some(ValueSource::CommandLine) {
            continue;
        }
        let key = key(arg);
        let values = arg.get_action().takes_values().then(|| matches.get_raw(id)).flatten();
        let shown = values.into_iter().flatten().map(|word| word.to_string_lossy().into_owned());
        options.insert(key.to_owned(), shown.collect());
    }
    options
}

/// Whether an argument says what comes out, not how the program runs.
fn is_recorded(arg: &Arg) -> bool {
    arg.get_help_heading() != Some(help::RUNNING)
}

fn key(arg: &Arg) -> &str {
    arg.get_long().unwrap_or(arg.get_id().as_str())
}

/// The arguments that give these options to a command, without the name of the program.
///
/// # Errors
/// The key that is no option of the command, or that has values it cannot have.
pub(super) fn words(command: &str, options: &Options) -> Result<Vec<OsString>, String> {
    let all = Arguments::command();
    let Some(declared) = all.find_subcommand(command) else { return Err(command.to_owned()) };
    let mut words = vec![OsString::from(command)];
    for (name, values) in options {
        let arg = declared.get_arguments().find(|arg| is_recorded(arg) && key(arg) == name).ok_or_else(|| name.clone())?;
        let takes_values = arg.get_action().takes_values();
        if takes_values == values.is_empty() {
            return Err(name.clone());
        }
        if !arg.is_positional() {
            words.extend(values.iter().map(|value| OsString::from(format!("--{name}={value}"))));
            words.extend((!takes_values).then(|| OsString::from(format!("--{name}"))));
        }
    }
    words.push(OsString::from("--"));
    let positional = declared.get_positionals().filter_map(|arg| options.get(key(arg)));
    words.extend(positional.flatten().map(OsString::from));
    Ok(words)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::args::Command;
    use crate::cli::job_file::plain;

    fn recorded(words: &[OsString]) -> Options {
        match plain(words).unwrap().command {
            Command::Build(args) => args.options,
            Command::Volume(args) => args.options,
            _ => panic!("no command with a record"),
        }
    }

    /// What is recorded gives the same job again, whatever hyphens and commas it has.
    #[test]
    fn there_and_back() {
        for line in [
            "build a.geojson --slope 1:1.5 --level 1,-2.5 --level 4 --local-origin -o b.obj -o=c.ply --closed --threads 3 -q",
            "build --cut-slope=1:1 --fill-slope 50% --terrain g.obj --crossfall -2.5%,2.5% --width 7 --local-origin=-1,2,3 -- -odd.csv",
            "volume a.obj b.obj --report r.json --class 2,8",
            "volume a.obj --to-elevation -3.5",
        ] {
            let words: Vec<OsString> = std::iter::once("slopegen").chain(line.split(' ')).map(OsString::from).collect();
            let options = recorded(&words);
            assert!(!options.contains_key("threads") && !options.contains_key("quiet"), "{options:?}");
            let again = super::words(line.split(' ').next().unwrap(), &options).unwrap();
            let again: Vec<OsString> = std::iter::once(OsString::from("slopegen")).chain(again).collect();
            assert_eq!(recorded(&again), options, "{again:?}");
        }
    }

    #[test]
    fn what_is_no_option_is_refused() {
        let of = |key: &str, values: &[&str]| {
            let values = values.iter().map(|&value| value.to_owned()).collect();
            words("build", &Options::from([(key.to_owned(), values)]))
        };
        for (key, values) in
            [("sloppy", &["1"][..]), ("threads", &["1"]), ("closed", &["true"]), ("slope", &[]), ("help", &[]), ("", &[])]
        {
            assert_eq!(of(key, values), Err(key.to_owned()), "{key}");
        }
        assert!(words("man", &Options::new()).is_ok() && words("none", &Options::new()).is_err());
    }
}
