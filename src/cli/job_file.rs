//! Job files: the options of `slopegen build` as TOML.
//!
//! What keys there are, and of which type, is read off the parser of the command line, so that no option can be missing. A file
//! is turned into arguments; those typed in win.

mod entry;
mod nearest;

use super::args::{Arguments, Command};
use super::build::{self, BuildArgs};
use super::record;
use super::usage::UsageErrors;
use crate::pipeline::Error;
use crate::read::ReadError;
use clap::error::{ContextKind, ErrorKind};
use clap::parser::ValueSource;
use clap::{Arg, CommandFactory as _, FromArgMatches as _, Id};
use entry::{Entry, Place};
use std::ffi::{OsStr, OsString};
use std::io::Read as _;
use std::path::{Path, PathBuf};

/// Name of the command whose options a job file holds.
const BUILD: &str = "build";

/// Key, and name of the argument, of the line.
const INPUT: &str = "input";

/// No job has this many bytes.
const LONGEST: u64 = 1 << 20;

/// A job file as read, and what stands beside it on the command line.
#[derive(Clone, Debug)]
pub(super) struct JobFile {
    /// Its path as given.
    label: String,
    /// Its folder, which the paths in it are relative to; empty for the working folder.
    folder: PathBuf,
    /// The options in the order of the file.
    entries: Vec<Entry>,
    /// The arguments given on the command line, whose entries do not count.
    given: Vec<Id>,
}

/// Why there are no arguments.
#[derive(Debug)]
pub(super) enum Stop {
    /// The parser of the command line refused, or was asked for help.
    Parser(clap::Error),
    /// The job file is at fault.
    File(anyhow::Error),
}

/// Parses the command line; where the line of `build` is a job file, together with it.
pub(super) fn parse(arguments: &[OsString]) -> Result<(Arguments, Option<JobFile>), Stop> {
    let (path, given) = match named(arguments) {
        Some(named) => named,
        None => return plain(arguments).map(|arguments| (arguments, None)).map_err(Stop::Parser),
    };
    let file = JobFile::read(&path, given).map_err(Stop::File)?;
    // The options of the file stand before those typed in.
    let at = arguments.iter().skip(1).position(|argument| argument == BUILD).map_or(arguments.len(), |at| at + 2);
    let (before, after) = arguments.split_at(at.min(arguments.len()));
    let words: Vec<OsString> = before.iter().cloned().chain(file.words()).chain(after.iter().cloned()).collect();
    let mut parsed = plain(&words).map_err(|error| match plain(arguments) {
        // What is wrong without the file is told as if there were none.
        Err(own) if own.kind() == error.kind() => Stop::Parser(own),
        _ => file.refusal(error),
    })?;
    if let Command::Build(args) = &mut parsed.command {
        file.complete(args).map_err(|error| Stop::File(error.into()))?;
    }
    Ok((parsed, Some(file)))
}

/// The arguments of a job file alone.
///
/// # Errors
/// What is wrong with it, or that it cannot be read.
pub(super) fn load(path: &Path) -> anyhow::Result<(BuildArgs, JobFile)> {
    // A name may begin with a hyphen.
    let words = [OsStr::new("slopegen"), OsStr::new(BUILD), OsStr::new("--"), path.as_os_str()].map(OsStr::to_owned);
    match parse(&words) {
        Ok((Arguments { command: Command::Build(args), .. }, Some(file))) => Ok((*args, file)),
        Ok(_) => Err(UsageErrors::one(format!(
            "this is no job file by its name\n  --> {}\n   = help: end the name of a job file in `.toml`",
            path.display()
        ))
        .into()),
        Err(Stop::File(error)) => Err(error),
        Err(Stop::Parser(error)) => Err(UsageErrors::one(bare(&error)).into()),
    }
}

/// Whether a path is that of a job file.
pub(super) fn is_job(path: &Path) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
}

pub(super) fn plain(arguments: &[OsString]) -> Result<Arguments, clap::Error> {
    let matches = super::command().try_get_matches_from(arguments)?;
    let mut parsed = Arguments::from_arg_matches(&matches)?;
    let options = |name| matches.subcommand_matches(name).map(|given| record::options(name, given)).unwrap_or_default();
    match &mut parsed.command {
        Command::Build(args) => args.options = options(BUILD),
        Command::Volume(args) => args.options = options("volume"),
        _ => {}
    }
    Ok(parsed)
}

/// The job file that stands in the place of the line, and what else was given.
fn named(arguments: &[OsString]) -> Option<(PathBuf, Vec<Id>)> {
    // What an option needs may stand in the file: errors are told when both are known.
    let matches = Arguments::command().ignore_errors(true).try_get_matches_from(arguments).ok()?;
    let (BUILD, matches) = matches.subcommand()? else { return None };
    let path = PathBuf::from(matches.get_raw(INPUT)?.next()?);
    let command = declared();
    // The line on the command line is the job file itself.
    let given =
        |arg: &&Arg| arg.get_id() != INPUT && matches.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine);
    is_job(&path).then(|| (path, command.get_arguments().filter(given).map(|arg| arg.get_id().clone()).collect()))
}

/// Reads a file that is typed by hand.
///
/// # Errors
/// [`ReadError::Open`], or that it has more than [`LONGEST`] bytes: it is something else then.
pub(super) fn read_short(path: &Path) -> anyhow::Result<Vec<u8>> {
    let label = path.display().to_string();
    let open = |cause| Error::from(ReadError::Open { label: label.clone(), cause });
    let mut bytes = Vec::new();
    std::fs::File::open(path).and_then(|file| file.take(LONGEST + 1).read_to_end(&mut bytes)).map_err(open)?;
    if bytes.len() as u64 > LONGEST {
        let (figures, help) = (format!("it may have {LONGEST} bytes"), "give a file of options, or a list of such files");
        let message = format!("the file is too long for a job\n  --> {label}\n   = {figures}\n   = help: {help}");
        return Err(UsageErrors::one(message).into());
    }
    Ok(bytes)
}

/// The parser of `build` as declared.
fn declared() -> clap::Command {
    let command = Arguments::command();
    command.find_subcommand(BUILD).cloned().unwrap_or(command)
}

/// What the parser of the command line says, without the leading `error: `.
fn bare(error: &clap::Error) -> String {
    let text = error.render().to_string();
    text.strip_prefix("error: ").unwrap_or(&text).trim_end().to_owned()
}

impl JobFile {
    /// Reads a job file. `given`: the arguments on the command line.
    fn read(path: &Path, given: Vec<Id>) -> anyhow::Result<Self> {
        let label = path.display().to_string();
        let bytes = read_short(path)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_owned();
        Ok(Self::parse(label, folder, &bytes, given)?)
    }

    fn parse(label: String, folder: PathBuf, bytes: &[u8], given: Vec<Id>) -> Result<Self, UsageErrors> {
        let entries = entry::entries(&label, &folder, bytes, &declared())?;
        let file = Self { label, folder, entries, given };
        file.check_values()?;
        Ok(file)
    }

    /// Asks the parser about each value by itself, so that what it refuses can be told with its place.
    fn check_values(&self) -> Result<(), UsageErrors> {
        let mut wrong = Vec::new();
        for entry in self.options() {
            for (words, place) in entry.words() {
                let arguments = ["slopegen", BUILD, "-"].map(OsString::from).into_iter().chain([words]);
                let Err(error) = super::command().try_get_matches_from(arguments) else { continue };
                if matches!(error.kind(), ErrorKind::InvalidValue | ErrorKind::ValueValidation) {
                    wrong.push(invalid(&error, entry, &self.at(place)));
                }
            }
        }
        if wrong.is_empty() { Ok(()) } else { Err(UsageErrors::all(wrong)) }
    }

    /// The entries that are options.
    fn options(&self) -> impl Iterator<Item = &Entry> {
        self.entries.iter().filter(|entry| entry.key != INPUT)
    }

    /// The options that count, as arguments.
    fn words(&self) -> Vec<OsString> {
        let command = declared();
        let mut replaced = self.given.clone();
        for arg in command.get_arguments().filter(|arg| self.given.contains(arg.get_id())) {
            // What cannot stand beside an option typed in gives way to it.
            replaced.extend(command.get_arg_conflicts_with(arg).into_iter().map(|other| other.get_id().clone()));
            let mut groups: Vec<clap::ArgGroup> = command.get_groups().cloned().collect();
            groups.retain_mut(|group| !group.is_multiple() && group.get_args().any(|id| id == arg.get_id()));
            replaced.extend(groups.iter().flat_map(clap::ArgGroup::get_args).cloned());
        }
        let counts = |entry: &&Entry| !replaced.contains(&entry.id);
        self.options().filter(counts).flat_map(Entry::words).map(|(words, _)| words).collect()
    }

    /// Puts in what is no option: the line, and the folder of the mesh that is written by default. Takes out the slopes that what was
    /// typed in stands in the place of.
    fn complete(&self, args: &mut BuildArgs) -> Result<(), UsageErrors> {
        let Some(input) = self.entries.iter().find(|entry| entry.key == INPUT).and_then(|entry| entry.values.first()) else {
            return Err(UsageErrors::one(format!(
                "the job names no line\n  --> {}\n   = help: write `input = \"line.geojson\"`",
                self.label
            )));
        };
        args.input.input = PathBuf::from(&input.word);
        if args.output.is_empty() {
            args.output.push(self.folder.join(build::default_output(&args.input.input)).into_os_string());
        }
        let typed = |id: &str| self.given.iter().any(|given| given == id);
        for name in args.slope.give_way(args.terrain.is_some(), typed) {
            args.options.remove(name);
        }
        let shown = |word: &OsString| word.to_string_lossy().into_owned();
        args.options.insert(INPUT.to_owned(), vec![shown(&input.word)]);
        args.options.insert("output".to_owned(), args.output.iter().map(shown).collect());
        Ok(())
    }

    /// What the parser refuses in file and command line together.
    fn refusal(&self, error: clap::Error) -> Stop {
        let named: Vec<String> = [ContextKind::InvalidArg, ContextKind::PriorArg]
            .into_iter()
            .filter_map(|kind| error.get(kind))
            .map(ToString::to_string)
            .collect();
        let is_named = |entry: &&Entry| {
            let option = format!("--{}", entry.key);
            let is = |text: &String| text.split([' ', ',', '=']).any(|word| word == option);
            named.iter().any(is) && !self.given.contains(&entry.id)
        };
        let places: Vec<String> = self
            .options()
            .filter(is_named)
            .filter_map(|entry| entry.values.first().map(|value| format!("  --> {}: {}", self.at(value.place), entry.key)))
            .collect();
        // Help is no refusal, and what was typed in is told as ever. What is missing has no place.
        let missing = error.kind() == ErrorKind::MissingRequiredArgument;
        if !error.use_stderr() || places.is_empty() && !missing {
            return Stop::Parser(error);
        }
        let text = bare(&error);
        let message = text.split("\n\nUsage:").next().unwrap_or(&text).trim_end();
        let places = if places.is_empty() { vec![format!("  --> {}", self.label)] } else { places };
        let help = "   = help: mend the file, or give the option on the command line, which wins";
        Stop::File(UsageErrors::one(format!("{message}\n{}\n{help}", places.join("\n"))).into())
    }

    /// A message with places in this file where it speaks of options and paths that come from it.
    pub(super) fn locate(&self, message: &str) -> String {
        let mut lines = Vec::new();
        for line in message.lines() {
            let Some(place) = line.strip_prefix("  --> ") else {
                lines.push(line.to_owned());
                continue;
            };
            if let Some(option) = place.strip_prefix("--") {
                let (name, value) = option.split_once(' ').unwrap_or((option, ""));
                let entry = self.options().find(|entry| entry.key == name && !self.given.contains(&entry.id));
                let exact = entry.and_then(|entry| entry.values.iter().find(|v| v.word == value));
                match exact.or(entry.and_then(|entry| entry.values.first())) {
                    Some(value) => lines.push(format!("  --> {}: {place}", self.at(value.place))),
                    None if self.is_typed(name) => lines.push(line.to_owned()),
                    None => lines.push(format!("  --> {}: {place}", self.label)),
                }
                continue;
            }
            lines.push(line.to_owned());
            let from_here = |entry: &&Entry| entry.is_path && !self.given.contains(&entry.id);
            let mut values = self.entries.iter().filter(from_here).flat_map(|entry| &entry.values);
            if let Some(value) = values.find(|value| Path::new(&value.word).display().to_string() == place) {
                lines.push(format!("  --> {}", self.at(value.place)));
            }
        }
        lines.join("\n")
    }

    /// Whether an option was given on the command line.
    fn is_typed(&self, name: &str) -> bool {
        declared().get_arguments().any(|arg| arg.get_long() == Some(name) && self.given.contains(arg.get_id()))
    }

    /// The same error, with places in this file in its message.
    pub(super) fn located(&self, error: &anyhow::Error) -> String {
        self.locate(&format!("{error:#}"))
    }

    /// Path as given.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// The options that are set, in the order of the file: key and values.
    pub(super) fn settings(&self) -> impl Iterator<Item = (&str, Vec<String>)> {
        let shown = |entry: &Entry| entry.values.iter().map(|value| value.word.to_string_lossy().into_owned()).collect();
        self.entries.iter().map(move |entry| (entry.key.as_str(), shown(entry)))
    }

    fn at(&self, place: Place) -> String {
        format!("{}, {place}", self.label)
    }
}

/// A value the parser refuses.
fn invalid(error: &clap::Error, entry: &Entry, at: &str) -> String {
    let text = |kind| error.get(kind).map(ToString::to_string).filter(|text| !text.is_empty());
    let value = text(ContextKind::InvalidValue).unwrap_or_default();
    let source = std::error::Error::source(error).map(ToString::to_string);
    let figures = match (text(ContextKind::ValidValue), source) {
        (Some(possible), _) => format!("possible: {possible}"),
        (None, Some(cause)) => cause,
        (None, None) => "it is not one of its values".to_owned(),
    };
    let help = match text(ContextKind::SuggestedValue) {
        Some(nearest) => format!("write `{nearest}`"),
        None => format!("see `--{}` in `slopegen build --help`", entry.key),
    };
    format!("`{value}` is no value of `{}`\n  --> {at}\n   = {figures}\n   = help: {help}", entry.key)
}

#[cfg(test)]
mod tests;
