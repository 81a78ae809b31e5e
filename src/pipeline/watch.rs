//! Whoever looks on while a job runs.

use crate::model::{Memory, Note};
use crate::surface::Watch;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Stage in which inputs are read.
pub(super) const READING: &str = "read";
/// Stage in which they are checked.
pub(super) const CHECKING: &str = "check";
/// Stage in which the ground is read.
pub(super) const READING_GROUND: &str = "read ground";
/// Stage in which the ground is triangulated and checked.
pub(super) const PREPARING: &str = "prepare ground";
/// Last stage, in which outputs are written.
pub const WRITING: &str = "write";

/// Whoever looks on while a job runs: learns the stages, can stop the engine, gets the notes as soon as they are known.
pub trait Observer: Watch {
    /// Something worth knowing about the input or the result.
    fn note(&self, note: &Note);
}

/// Nobody looks on.
impl Observer for () {
    fn note(&self, _: &Note) {}
}

/// Passes everything on, and keeps the notes and how long each stage took.
pub(super) struct Stopwatch<'a> {
    observer: &'a dyn Observer,
    begun: Instant,
    record: Mutex<Record>,
    /// Bytes held by what was read or built so far.
    held: AtomicU64,
}

#[derive(Default)]
struct Record {
    /// Stages in the order begun, each with its beginning.
    stages: Vec<(&'static str, Instant)>,
    notes: Vec<Note>,
}

impl<'a> Stopwatch<'a> {
    pub(super) fn new(observer: &'a dyn Observer) -> Self {
        Self { observer, begun: Instant::now(), record: Mutex::default(), held: AtomicU64::default() }
    }

    fn record(&self) -> MutexGuard<'_, Record> {
        self.record.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// From here on so many bytes are held.
    pub(super) fn holds(&self, bytes: u64) {
        self.held.store(bytes, Ordering::Relaxed);
    }

    /// A stage begins.
    pub(super) fn stage_of(&self, name: &'static str) {
        self.record().stages.push((name, Instant::now()));
        self.observer.stage(name);
    }

    pub(super) fn note(&self, note: &Note) {
        Observer::note(self, note);
    }

    /// All notes so far.
    pub(super) fn notes(&self) -> Vec<Note> {
        self.record().notes.clone()
    }

    /// Seconds since the start.
    pub(super) fn total(&self) -> f64 {
        self.begun.elapsed().as_secs_f64()
    }

    /// Seconds spent so far in the stages whose names `of` accepts.
    pub(super) fn seconds(&self, of: impl Fn(&str) -> bool) -> f64 {
        let now = Instant::now();
        let record = self.record();
        let ends = record.stages.iter().skip(1).map(|(_, at)| *at).chain([now]);
        let spent = |((name, from), to): (&(&'static str, Instant), Instant)| {
            if of(name) { to.saturating_duration_since(*from) } else { Duration::ZERO }
        };
        record.stages.iter().zip(ends).map(spent).sum::<Duration>().as_secs_f64()
    }
}

impl Watch for Stopwatch<'_> {
    fn stage(&self, name: &'static str) {
        self.stage_of(name);
    }

    fn cancelled(&self) -> bool {
        self.observer.cancelled()
    }

    fn memory(&self) -> Memory {
        self.observer.memory().holding(self.held.load(Ordering::Relaxed))
    }
}

impl Observer for Stopwatch<'_> {
    fn note(&self, note: &Note) {
        self.record().notes.push(note.clone());
        self.observer.note(note);
    }
}

/// Passes on what is seen of one of several inputs: notes with its name before them.
pub(super) struct Named<'a, 'b> {
    pub(super) watch: &'a Stopwatch<'b>,
    pub(super) name: &'static str,
}

impl Watch for Named<'_, '_> {
    fn stage(&self, name: &'static str) {
        self.watch.stage(name);
    }

    fn cancelled(&self) -> bool {
        self.watch.cancelled()
    }

    fn memory(&self) -> Memory {
        self.watch.memory()
    }
}

impl Observer for Named<'_, '_> {
    fn note(&self, note: &Note) {
        Observer::note(self.watch, &Note { code: note.code, message: format!("{}: {}", self.name, note.message) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Nobody;

    impl Watch for Nobody {
        fn stage(&self, _: &'static str) {}
    }

    impl Observer for Nobody {
        fn note(&self, _: &Note) {}
    }

    #[test]
    fn time_is_given_to_stages() {
        const LONG: Duration = Duration::from_millis(20);
        let watch = Stopwatch::new(&Nobody);
        for (name, time) in [("a", LONG), ("b", Duration::ZERO), ("a", LONG), ("c", Duration::ZERO)] {
            watch.stage_of(name);
            std::thread::sleep(time);
        }
        let [a, all, none] = [watch.seconds(|name| name == "a"), watch.seconds(|_| true), watch.seconds(|_| false)];
        assert!(a >= 2.0 * LONG.as_secs_f64(), "{a}");
        assert!(all >= a && watch.total() >= all && none == 0.0);
    }

    #[test]
    fn notes_are_kept_in_order() {
        let watch = Stopwatch::new(&Nobody);
        let notes = [Note::new("a", "first"), Note::new("b", "second")];
        notes.iter().for_each(|note| watch.note(note));
        assert_eq!(watch.notes(), notes);
    }
}
