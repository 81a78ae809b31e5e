//! What all commands have: how much is told, threads, memory, and a terminal that shows the report.

use super::console::{self, Console, Screen};
use super::exit_code::Code;
use super::usage::{Checks, UsageErrors};
use super::{help, interrupt, memory};
use crate::model::Memory;
use crate::pipeline::Error;
use crate::report::ReportFormat;
use crate::write::{EncodeError, Target, WriteError};
use clap::{ArgAction, Args};
use std::sync::Mutex;

/// More threads than any machine this runs on has processors.
const MOST_THREADS: usize = 1024;

#[derive(Debug, Args)]
pub(super) struct Running {
    /// Print errors only
    #[arg(short, long, help_heading = help::RUNNING)]
    pub(super) quiet: bool,
    /// Print how long each stage took
    #[arg(short, long, conflicts_with = "quiet", action = ArgAction::SetTrue, help_heading = help::RUNNING)]
    pub(super) verbose: bool,
    /// Number of threads [default: one for each processor]
    #[arg(long, value_name = "N", allow_negative_numbers = true, help_heading = help::RUNNING)]
    pub(super) threads: Option<String>,
    /// Refuse work that would take more memory than this, such as 2GB or 1500MiB [default: what there is]
    #[arg(long, value_name = "SIZE", allow_hyphen_values = true, help_heading = help::RUNNING)]
    pub(super) max_memory: Option<String>,
}

/// A command at work, as people see it.
pub(super) struct Run {
    pub(super) console: Console,
    screen: Option<Screen>,
}

impl Run {
    /// Begins a command that has no outputs but `reports`. The one that a terminal shows with colours is taken out of them: see
    /// [`Run::show`].
    pub(super) fn begin(running: &Running, reports: &mut Vec<(Target, ReportFormat)>) -> anyhow::Result<Self> {
        let all = console::targets(reports);
        Self::beside(running, reports, &all)
    }

    /// The same for a command with more outputs; `all`: those and the reports.
    pub(super) fn beside(running: &Running, reports: &mut Vec<(Target, ReportFormat)>, all: &[Target]) -> anyhow::Result<Self> {
        let memory = start(running)?;
        // The report shows the notes on the same terminal.
        let to_terminal = reports.iter().any(|(target, _)| console::is_terminal(target));
        let screen = Screen::take(reports, all);
        Ok(Self { console: Console::new(running, memory, to_terminal), screen })
    }

    /// The work is done: shows the report, written by `text`, that was kept for a terminal.
    pub(super) fn show(&self, text: impl FnOnce(&mut Vec<u8>) -> Result<(), EncodeError>) -> Result<(), Error> {
        self.console.finish();
        show(self.screen, text)
    }

    /// Tells of the files that have appeared.
    pub(super) fn wrote(&self, files: &[Target]) {
        files.iter().for_each(|file| self.console.wrote(file, ""));
    }
}

/// Shows a report that was kept for the terminal.
pub(super) fn show(screen: Option<Screen>, text: impl FnOnce(&mut Vec<u8>) -> Result<(), EncodeError>) -> Result<(), Error> {
    let failed = |cause| WriteError::Write { target: Target::Stdout, cause }.into();
    screen.map_or(Ok(()), |screen| screen.show(text)).map_err(failed)
}

/// The number of threads and the memory asked for.
///
/// # Errors
/// What is wrong with them.
pub(super) fn asked(running: &Running) -> Result<(Option<usize>, Option<Memory>), UsageErrors> {
    let mut checks = Checks::default();
    let threads = checks.whole("--threads", running.threads.as_ref(), "threads", 1..=MOST_THREADS);
    let memory = running.max_memory.as_ref().and_then(|text| checks.take(memory::read(text)));
    checks.finish(Some((threads, memory)))
}

/// What must stand before the work begins; tells how much memory it may take.
pub(super) fn start(running: &Running) -> anyhow::Result<Memory> {
    let (threads, asked) = asked(running)?;
    let memory = memory::limit(asked);
    // Always a number of our own: what RAYON_NUM_THREADS says does not matter.
    let wanted = threads.unwrap_or_else(|| std::thread::available_parallelism().map_or(1, usize::from));
    let begun = interrupt::no_abort(Code::Memory, || match startable(memory::threads(wanted)) {
        0 => Err(NoThreads),
        count => {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build_global();
            // Until each of them runs.
            pool.map(|()| drop(rayon::broadcast(|_| ()))).map_err(|_| NoThreads)
        }
    });
    begun?;
    Ok(memory)
}

/// How many threads of `wanted` can be had at once. Limits of the system refuse some or all of them, and a pool cannot be tried
/// twice.
fn startable(wanted: usize) -> usize {
    let gate = Mutex::new(());
    std::thread::scope(|scope| {
        // Held until all have begun: a thread that ended would make room for the next.
        let _closed = gate.lock();
        let wait = || drop(gate.lock());
        (0..wanted).take_while(|_| std::thread::Builder::new().spawn_scoped(scope, wait).is_ok()).count()
    })
}

/// Not a single thread could be had.
#[derive(Clone, Copy, Debug, thiserror::Error)]
#[error(
    "no thread could be started\n   = the system refused: too little memory, or too many processes\n   \
     = help: raise what `--max-memory`, `ulimit -v` or `ulimit -u` allow, or end other programs"
)]
pub(super) struct NoThreads;
