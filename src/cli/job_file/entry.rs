//! TOML → options, each with its place.

use super::super::usage::UsageErrors;
use super::INPUT;
use super::nearest::nearest;
use clap::{Arg, ArgAction, Id};
use std::any::TypeId;
use std::ffi::OsString;
use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

/// An option that a job file sets.
#[derive(Clone, Debug)]
pub(super) struct Entry {
    /// Its long name.
    pub(super) key: String,
    /// The argument.
    pub(super) id: Id,
    /// Whether it is true or false, and has no value on the command line.
    is_flag: bool,
    /// Whether its values are paths.
    pub(super) is_path: bool,
    /// Its values; of flags that are false, and of empty lists, none.
    pub(super) values: Vec<Value>,
}

/// A value as it would be typed in.
#[derive(Clone, Debug)]
pub(super) struct Value {
    /// The word. Paths are those of the file joined to its folder.
    pub(super) word: OsString,
    /// Where it stands.
    pub(super) place: Place,
}

impl Entry {
    /// The arguments that set it, with their places.
    pub(super) fn words(&self) -> Vec<(OsString, Place)> {
        let of = |value: &Value| {
            let mut words = OsString::from(format!("--{}", self.key));
            if !self.is_flag {
                words.push("=");
                words.push(&value.word);
            }
            (words, value.place)
        };
        self.values.iter().map(of).collect()
    }
}

/// Line and column, both counted from 1; columns in characters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Place {
    line: usize,
    column: usize,
}

impl Place {
    fn of(text: &str, at: usize) -> Self {
        let before = text.get(..at).unwrap_or(text);
        let begin = before.rfind('\n').map_or(0, |end| end + 1);
        Self { line: before.matches('\n').count() + 1, column: before[begin..].chars().count() + 1 }
    }
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "line {}, column {}", self.line, self.column)
    }
}

/// What is being read.
struct Reader<'a> {
    label: &'a str,
    folder: &'a Path,
    text: &'a str,
    wrong: Vec<String>,
}

/// The options of a job file.
///
/// # Errors
/// Everything wrong with the file as such: keys that are no options, values of the wrong type.
pub(super) fn entries(label: &str, folder: &Path, bytes: &[u8], command: &clap::Command) -> Result<Vec<Entry>, UsageErrors> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let line = bytes[..error.valid_up_to()].iter().filter(|b| **b == b'\n').count() + 1;
        let help = "save the file as UTF-8";
        UsageErrors::one(format!("the job file is no UTF-8 text\n  --> {label}, line {line}\n   = help: {help}"))
    })?;
    let table = DeTable::parse(text).map_err(|error| {
        let place = error.span().map_or_else(String::new, |span| format!(", {}", Place::of(text, span.start)));
        let what = error.message().replace('\n', ", ");
        let help = "write `key = value`, text in quotation marks, lists in brackets";
        UsageErrors::one(format!("the job file is not valid TOML\n  --> {label}{place}\n   = {what}\n   = help: {help}"))
    })?;
    let mut reader = Reader { label, folder, text, wrong: Vec::new() };
    let mut pairs: Vec<_> = table.get_ref().iter().collect();
    pairs.sort_by_key(|(key, _)| key.span().start);
    let mut entries: Vec<Entry> = Vec::new();
    for (key, value) in pairs {
        let Some(arg) = reader.argument(key, command) else { continue };
        let name = arg.get_long().unwrap_or(INPUT).to_owned();
        if entries.iter().any(|entry| entry.key == name) {
            let what = format!("`{name}` is set twice");
            reader.refuse(what, key.span(), "`-` and `_` in keys are the same", "keep one of them");
            continue;
        }
        entries.extend(reader.entry(name, arg, value));
    }
    if reader.wrong.is_empty() { Ok(entries) } else { Err(UsageErrors::all(reader.wrong)) }
}

impl Reader<'_> {
    fn refuse(&mut self, what: impl fmt::Display, span: Range<usize>, figures: &str, help: &str) {
        let place = Place::of(self.text, span.start);
        self.wrong.push(format!("{what}\n  --> {}, {place}\n   = {figures}\n   = help: {help}", self.label));
    }

    /// The argument a key stands for.
    fn argument<'c>(&mut self, key: &Spanned<std::borrow::Cow<'_, str>>, command: &'c clap::Command) -> Option<&'c Arg> {
        let name = key.get_ref().replace('_', "-");
        let keys = || command.get_arguments().filter(|arg| !arg.is_global_set());
        let is_meant = |arg: &&Arg| match arg.get_long() {
            Some(_) => arg.get_long_and_visible_aliases().is_some_and(|names| names.contains(&name.as_str())),
            None => name == INPUT && arg.get_id() == INPUT,
        };
        let found = keys().find(is_meant);
        if found.is_none() {
            let what = format!("`{}` is no option of `slopegen build`", shown(key.get_ref()));
            let names = keys().filter_map(Arg::get_long).chain([INPUT]);
            match nearest(&name, names) {
                Some(near) => {
                    self.refuse(what, key.span(), &format!("the nearest is `{near}`"), &format!("write `{near}`"));
                }
                None => {
                    let figures = "the keys are the long names of the options, without `--`";
                    self.refuse(what, key.span(), figures, "see `slopegen build --help`");
                }
            }
        }
        found
    }

    fn entry(&mut self, key: String, arg: &Arg, value: &Spanned<DeValue<'_>>) -> Option<Entry> {
        let type_id = arg.get_value_parser().type_id();
        let is_flag = matches!(arg.get_action(), ArgAction::SetTrue);
        let is_path = !is_flag && [TypeId::of::<PathBuf>(), TypeId::of::<OsString>()].iter().any(|path| type_id == *path);
        let is_list = matches!(arg.get_action(), ArgAction::Append);
        let mut entry = Entry { key, id: arg.get_id().clone(), is_flag, is_path, values: Vec::new() };
        match value.get_ref() {
            DeValue::Boolean(set) if is_flag => {
                let place = Place::of(self.text, value.span().start);
                entry.values.extend(set.then(|| Value { word: OsString::new(), place }));
            }
            _ if is_flag => {
                let (what, help) = (format!("`{0}` is true or false", entry.key), format!("write `{} = true`", entry.key));
                self.refuse(what, value.span(), &found(value.get_ref()), &help);
                return None;
            }
            DeValue::Array(list) if is_list => {
                for item in list {
                    let value = self.value(&entry, item)?;
                    entry.values.push(value);
                }
            }
            DeValue::Array(list) => {
                let what = format!("`{}` has one value", entry.key);
                let figures = format!("found a list of {}", list.len());
                self.refuse(what, value.span(), &figures, &format!("write `{} = …` without brackets", entry.key));
                return None;
            }
            _ => {
                let value = self.value(&entry, value)?;
                entry.values.push(value);
            }
        }
        Some(entry)
    }

    /// One value as a word.
    fn value(&mut self, entry: &Entry, value: &Spanned<DeValue<'_>>) -> Option<Value> {
        let place = Place::of(self.text, value.span().start);
        let word = match value.get_ref() {
            DeValue::String(text) if !text.trim().is_empty() => Some(text.to_string()),
            DeValue::Integer(number) if !entry.is_path && number.radix() == 10 => Some(number.as_str().to_owned()),
            DeValue::Float(number) if !entry.is_path => Some(number.as_str().to_owned()),
            _ => None,
        };
        let Some(word) = word else {
            let key = &entry.key;
            let (what, help) = if entry.is_path {
                (format!("`{key}` is the name of a file"), format!("write `{key} = \"name\"`"))
            } else {
                (format!("`{key}` is a text or a number"), format!("write `{key} = \"…\"`; see `slopegen build --help`"))
            };
            self.refuse(what, value.span(), &found(value.get_ref()), &help);
            return None;
        };
        let word = if entry.is_path && word != "-" { self.folder.join(word).into_os_string() } else { OsString::from(word) };
        Some(Value { word, place })
    }
}

/// What stands in the place of a value.
fn found(value: &DeValue<'_>) -> String {
    match value {
        DeValue::String(text) if text.trim().is_empty() => "found an empty text".to_owned(),
        DeValue::String(text) => format!("found the text \"{}\"", shown(text)),
        DeValue::Integer(number) => format!("found the number {}", shown(&number.to_string())),
        DeValue::Float(number) => format!("found the number {}", shown(number.as_str())),
        DeValue::Boolean(value) => format!("found {value}"),
        DeValue::Datetime(_) => "found a date".to_owned(),
        DeValue::Array(list) => format!("found a list of {}", list.len()),
        DeValue::Table(_) => "found a table; all options stand at the top of the file".to_owned(),
    }
}

/// A text short enough for a message.
fn shown(text: &str) -> String {
    const LONGEST: usize = 40;
    let mut short: String = text.chars().take(LONGEST).map(|c| if c.is_control() { ' ' } else { c }).collect();
    if text.chars().nth(LONGEST).is_some() {
        short.push('…');
    }
    short
}
