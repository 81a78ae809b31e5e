//! Taking down everything wrong with the arguments, so that all of it is told at once.

use super::number::{self, Rule};
use crate::model::{LengthUnit, Slope, message};
use crate::read::ColumnOrder;
use crate::report::ReportFormat;
use crate::write::{self, Target, UnknownFormat};
use std::ffi::OsString;
use std::fmt;
use std::ops::RangeInclusive;

/// The smallest tolerance, height, distance and cell: what coordinates of lines are told apart by.
pub(super) const LEAST_LENGTH: f64 = crate::validate::MERGE_DISTANCE;

/// Everything wrong with the arguments, without the leading `error: ` of the first.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct UsageErrors(Vec<String>);

impl fmt::Display for UsageErrors {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0.join("\nerror: "))
    }
}

impl std::error::Error for UsageErrors {}

impl UsageErrors {
    /// One thing wrong.
    pub(super) fn one(message: String) -> Self {
        Self(vec![message])
    }

    /// Several; at least one.
    pub(super) fn all(messages: Vec<String>) -> Self {
        Self(messages)
    }
}

/// Gathers what is wrong, so that all of it is told at once.
#[derive(Default)]
pub(super) struct Checks(Vec<String>);

impl Checks {
    /// The value, or `None` after taking down what is wrong with it.
    pub(super) fn take<T>(&mut self, result: Result<T, String>) -> Option<T> {
        result.map_err(|error| self.0.push(error)).ok()
    }

    pub(super) fn number(&mut self, option: &str, text: Option<&String>, rule: Rule) -> Option<f64> {
        text.and_then(|text| self.take(number::read(option, text, rule)))
    }

    pub(super) fn format<T>(&mut self, result: Result<T, UnknownFormat>) -> Option<T> {
        self.take(result.map_err(|error| error.to_string()))
    }

    pub(super) fn order(&mut self, option: &str, text: Option<&String>) -> Option<ColumnOrder> {
        let text = text?;
        self.take(text.parse::<ColumnOrder>().map_err(|error| advised(&error, option, text)))
    }

    pub(super) fn slope(&mut self, option: &str, text: Option<&String>) -> Option<Slope> {
        let text = text?;
        self.take(text.parse::<Slope>().map_err(|error| placed(&error.to_string(), option, text)))
    }

    /// Whether nothing is wrong so far.
    pub(super) fn is_clean(&self) -> bool {
        self.0.is_empty()
    }

    /// Takes down something wrong.
    pub(super) fn refuse(&mut self, message: String) {
        self.0.push(message);
    }

    pub(super) fn unit(&mut self, text: Option<&String>) -> Option<LengthUnit> {
        let text = text?;
        self.take(text.parse::<LengthUnit>().map_err(|error| advised(&error, "--units", text)))
    }

    /// A whole number of `things`.
    pub(super) fn whole(
        &mut self,
        option: &str,
        text: Option<&String>,
        things: &str,
        range: RangeInclusive<usize>,
    ) -> Option<usize> {
        text.and_then(|text| self.take(number::whole(option, text, things, range)))
    }

    /// Outputs, each in the format its name ends in.
    pub(super) fn outputs<F>(
        &mut self,
        arguments: &[OsString],
        format: impl Fn(&Target) -> Result<F, UnknownFormat>,
    ) -> Vec<(Target, F)> {
        let with_format = |target: Target| self.format(format(&target)).map(|format| (target, format));
        targets(arguments).into_iter().filter_map(with_format).collect()
    }

    /// Outputs whose names must all end in one of `known`.
    pub(super) fn ending(
        &mut self,
        arguments: &[OsString],
        what: &'static str,
        known: &[&str],
        phrase: &'static str,
    ) -> Vec<Target> {
        let targets = targets(arguments);
        for target in &targets {
            self.format(ending(target, what, known, phrase));
        }
        targets
    }

    /// Where reports go: to standard output as text besides, unless quiet.
    pub(super) fn reports(&mut self, arguments: &[OsString], quiet: bool) -> Vec<(Target, ReportFormat)> {
        shown(self.outputs(arguments, ReportFormat::of), quiet)
    }

    /// The same for reports that are JSON or text.
    pub(super) fn plain_reports(&mut self, arguments: &[OsString], quiet: bool) -> Vec<(Target, ReportFormat)> {
        let plain = |target: &Target| ending(target, "report", &["json", "txt"], "`.json` or `.txt`");
        shown(self.outputs(arguments, |target| plain(target).and_then(|()| ReportFormat::of(target))), quiet)
    }

    pub(super) fn finish<T>(self, job: Option<T>) -> Result<T, UsageErrors> {
        match job {
            Some(job) if self.0.is_empty() => Ok(job),
            _ => Err(UsageErrors(self.0)),
        }
    }
}

/// A message with the option it is about below its first line.
pub(super) fn placed(message: &str, option: &str, text: &str) -> String {
    message::placed(message, [format!("{option} {text}")])
}

/// The same for a message on one line that ends in a semicolon and what mends it.
fn advised(message: &str, option: &str, text: &str) -> String {
    placed(&message.replacen("; ", "\n   = help: ", 1), option, text)
}

/// Adds the text report that is seen where nothing else goes to standard output, unless quiet.
fn shown(mut reports: Vec<(Target, ReportFormat)>, quiet: bool) -> Vec<(Target, ReportFormat)> {
    let is_used = reports.iter().any(|(target, _)| *target == Target::Stdout);
    reports.extend((!is_used && !quiet).then_some((Target::Stdout, ReportFormat::Text)));
    reports
}

/// Where arguments lead.
pub(super) fn targets(arguments: &[OsString]) -> Vec<Target> {
    arguments.iter().map(|argument| Target::from_arg(argument)).collect()
}

/// Refuses names of files that do not end in one of `known`; streams have any name.
pub(super) fn ending(target: &Target, what: &'static str, known: &[&str], phrase: &'static str) -> Result<(), UnknownFormat> {
    let Target::File(path) = target else { return Ok(()) };
    let fits = write::ending(path).is_some_and(|found| known.contains(&found.as_str()));
    if fits || target.is_stream() { Ok(()) } else { Err(UnknownFormat { what, path: path.clone(), known: phrase }) }
}
