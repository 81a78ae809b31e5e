//! What people see while the program runs: notes, progress, times. All of it on standard error.

mod paint;

use super::running::Running;
use crate::model::message::printable_lines;
use crate::model::{Memory, Note};
use crate::pipeline::{Observer, WRITING};
use crate::report::ReportFormat;
use crate::surface::Watch;
use crate::write::{EncodeError, Target};
use anstream::AutoStream;
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{IsTerminal as _, Write as _};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

/// Time between two frames of the progress display.
const FRAME: Duration = Duration::from_millis(100);

/// Writes a line to standard error. Where that is closed, there is nobody to be told.
fn say(text: &str) {
    let _ = writeln!(AutoStream::auto(std::io::stderr().lock()), "{}", paint::message(text));
}

/// A report that goes to a terminal with colours, and is written here instead of by the pipeline.
#[derive(Clone, Copy, Debug)]
pub(super) struct Screen(());

impl Screen {
    /// Takes the text report out of the outputs of a job, if it goes to a terminal with colours. `all`: every output of the job;
    /// if another one goes there as well, that is refused as ever.
    pub(super) fn take(reports: &mut Vec<(Target, ReportFormat)>, all: &[Target]) -> Option<Self> {
        let is_text = |(target, format): &(Target, ReportFormat)| *target == Target::Stdout && *format == ReportFormat::Text;
        let alone = all.iter().filter(|target| **target == Target::Stdout).count() == 1;
        if !alone || !reports.iter().any(is_text) || !has_colours() {
            return None;
        }
        reports.retain(|report| !is_text(report));
        Some(Self(()))
    }

    /// Writes the report. A terminal that went away is no error.
    pub(super) fn show(self, write: impl FnOnce(&mut Vec<u8>) -> Result<(), EncodeError>) -> Result<(), EncodeError> {
        let mut bytes = Vec::new();
        write(&mut bytes)?;
        let _ = write!(std::io::stdout().lock(), "{}", paint::report(&String::from_utf8_lossy(&bytes)));
        Ok(())
    }
}

/// Where reports go.
pub(super) fn targets(reports: &[(Target, ReportFormat)]) -> Vec<Target> {
    reports.iter().map(|(target, _)| target.clone()).collect()
}

/// Whether standard output is a terminal that is to have colours.
fn has_colours() -> bool {
    let stdout = std::io::stdout();
    stdout.is_terminal() && AutoStream::choice(&stdout) != anstream::ColorChoice::Never
}

pub(super) use paint::{asked, choose};

/// Tells a line of a message, whose names from files cannot harm a terminal.
pub(super) fn tell(message: &str) {
    say(&printable_lines(message));
}

/// Tells why the program failed.
pub(super) fn error(message: &str) {
    say(&format!("error: {}", printable_lines(message)));
}

/// Whether what goes to a target is seen at once.
pub(super) fn is_terminal(target: &Target) -> bool {
    *target == Target::Stdout && std::io::stdout().is_terminal()
}

/// What a note is called.
pub(super) fn kind(note: &Note) -> &'static str {
    if note.is_warning() { "warning" } else { "note" }
}

/// Shows what goes on, as much as was asked for.
#[derive(Debug)]
pub(super) struct Console {
    quiet: bool,
    verbose: bool,
    /// Notes are seen elsewhere: in a report on the terminal.
    notes_elsewhere: bool,
    /// What the run may take.
    memory: Memory,
    progress: Option<ProgressBar>,
    stage: Mutex<Option<(&'static str, Instant)>>,
}

impl Console {
    /// A console; `notes_elsewhere` where a report shows the notes on the same terminal.
    pub(super) fn new(running: &Running, memory: Memory, notes_elsewhere: bool) -> Self {
        let progress = (!running.quiet && std::io::stderr().is_terminal()).then(|| {
            let bar = ProgressBar::new_spinner();
            if let Ok(style) = ProgressStyle::with_template("{spinner} {msg} {elapsed}") {
                bar.set_style(style);
            }
            bar.enable_steady_tick(FRAME);
            bar
        });
        Self { quiet: running.quiet, verbose: running.verbose, notes_elsewhere, memory, progress, stage: Mutex::default() }
    }

    /// Tells of a file that has appeared; `size` may be empty.
    pub(super) fn wrote(&self, target: &Target, size: &str) {
        if !self.quiet {
            let colon = if size.is_empty() { "" } else { ": " };
            self.say(&printable_lines(&format!("wrote {target}{colon}{size}")));
        }
    }

    /// The work is done: the last stage has ended.
    pub(super) fn finish(&self) {
        self.end_stage(None);
        if let Some(bar) = &self.progress {
            bar.finish_and_clear();
        }
    }

    /// Writes a line above the progress display.
    fn say(&self, text: &str) {
        match &self.progress {
            Some(bar) => bar.suspend(|| say(text)),
            None => say(text),
        }
    }

    /// Notes that the stage has changed and, if asked for, how long the one before took.
    fn end_stage(&self, next: Option<&'static str>) {
        let mut stage = self.stage.lock().unwrap_or_else(PoisonError::into_inner);
        let ended = std::mem::replace(&mut *stage, next.map(|name| (name, Instant::now())));
        drop(stage);
        if let (true, Some((name, since))) = (self.verbose, ended) {
            self.say(&format!("{:>9.3} s  {name}", since.elapsed().as_secs_f64()));
        }
    }
}

impl Drop for Console {
    /// Leaves the terminal clean when the work failed, too.
    fn drop(&mut self) {
        if let Some(bar) = &self.progress {
            bar.finish_and_clear();
        }
    }
}

impl Watch for Console {
    fn memory(&self) -> Memory {
        self.memory
    }

    fn stage(&self, name: &'static str) {
        self.end_stage(Some(name));
        if let Some(bar) = &self.progress {
            // What goes to standard output would mix with the display on the same screen.
            if name == WRITING && std::io::stdout().is_terminal() {
                bar.finish_and_clear();
            } else {
                bar.set_message(name);
            }
        }
    }
}

impl Observer for Console {
    fn note(&self, note: &Note) {
        if !self.quiet && !self.notes_elsewhere {
            self.say(&printable_lines(&format!("{}[{}]: {}", kind(note), note.code, note.message)));
        }
    }
}
