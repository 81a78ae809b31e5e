//! Many jobs at once.

use super::BuildJob;
use super::build;
use crate::write::Footprint;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

impl BuildJob {
    /// What it writes and reads.
    pub fn footprint(&self) -> Footprint {
        let ground = self.ground.as_ref().map(|ground| ground.path.clone());
        let inputs: Vec<PathBuf> = std::iter::once(self.input.path.clone()).chain(ground).collect();
        Footprint { outputs: build::targets(self), inputs }
    }
}

/// How jobs are run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Batch {
    /// How many at once; at least one. The work within a job shares the threads of the whole program.
    pub at_once: usize,
    /// Begin no further job after one has failed.
    pub fail_fast: bool,
}

/// What became of the jobs so far.
struct Progress<R, F> {
    /// By job; `None`: not finished.
    results: Vec<Option<R>>,
    /// How many have been told.
    told: usize,
    tell: F,
}

impl<R, F: FnMut(usize, &R)> Progress<R, F> {
    /// Takes down a result, and tells all that can be told in order.
    fn put(&mut self, index: usize, result: R) {
        self.results[index] = Some(result);
        while let Some(Some(result)) = self.results.get(self.told) {
            (self.tell)(self.told, result);
            self.told += 1;
        }
    }
}

/// Runs the jobs 0 to `count` − 1, several at once, and returns what became of each; `None`: not begun, because another failed.
///
/// `work` says whether the job is done as well; a panic in it becomes what `broken` makes of it. `tell` learns the results one by
/// one in the order of the jobs, whichever is done first. With one job at a time `fail_fast` stops right behind the first
/// failure; with several, jobs that were begun until then are brought to their end.
pub fn run_batch<R: Send>(
    count: usize,
    batch: Batch,
    work: impl Fn(usize) -> (bool, R) + Sync,
    broken: impl Fn(usize) -> R + Sync,
    tell: impl FnMut(usize, &R) + Send,
) -> Vec<Option<R>> {
    let next = AtomicUsize::new(0);
    let stopped = AtomicBool::new(false);
    let progress = Mutex::new(Progress { results: std::iter::repeat_with(|| None).take(count).collect(), told: 0, tell });
    let one_by_one = || {
        loop {
            let stop = batch.fail_fast && stopped.load(Ordering::Acquire);
            let index = if stop { count } else { next.fetch_add(1, Ordering::Relaxed) };
            if index >= count {
                break;
            }
            let (done, result) = catch_unwind(AssertUnwindSafe(|| work(index))).unwrap_or_else(|_| (false, broken(index)));
            if !done {
                stopped.store(true, Ordering::Release);
            }
            progress.lock().unwrap_or_else(PoisonError::into_inner).put(index, result);
        }
    };
    std::thread::scope(|scope| {
        // Where the system gives no more threads, there are fewer jobs at once.
        let more = (1..batch.at_once.min(count)).map(|_| std::thread::Builder::new().spawn_scoped(scope, one_by_one));
        let _ = more.take_while(Result::is_ok).count();
        one_by_one();
    });
    progress.into_inner().unwrap_or_else(PoisonError::into_inner).results
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::time::Duration;

    #[test]
    fn results_are_told_in_order() {
        for at_once in [1, 2, 7, 100] {
            let mut told = Vec::new();
            let batch = Batch { at_once, fail_fast: false };
            // The first jobs take longest.
            let work = |i: usize| {
                std::thread::sleep(Duration::from_millis(20 - i as u64));
                (!i.is_multiple_of(3), i * i)
            };
            let results = run_batch(20, batch, work, |_| 0, |i, r| told.push((i, *r)));
            assert_eq!(told, (0..20).map(|i| (i, i * i)).collect::<Vec<_>>());
            assert_eq!(results, (0..20).map(|i| Some(i * i)).collect::<Vec<_>>());
        }
        assert_eq!(run_batch(0, Batch { at_once: 4, fail_fast: true }, |i| (true, i), |i| i, |_, _| ()), []);
    }

    #[test]
    fn the_first_failure_stops_the_rest() {
        let results = run_batch(5, Batch { at_once: 1, fail_fast: true }, |i| (i != 2, i), |i| i, |_, _| ());
        assert_eq!(results, [Some(0), Some(1), Some(2), None, None]);
        let work = |i: usize| {
            // Long enough for the other thread to see the failure.
            std::thread::sleep(Duration::from_millis(u64::from(i > 2)));
            (i != 2, i)
        };
        let results = run_batch(5000, Batch { at_once: 2, fail_fast: true }, work, |i| i, |_, _| ());
        assert!(results[2].is_some() && results[4999].is_none());
    }

    #[test]
    fn a_panic_is_the_failure_of_its_job() {
        let hook = std::panic::take_hook();
        std::panic::set_hook(Box::new(|_| ()));
        let work = |i: usize| if i == 1 { panic!("on purpose") } else { (true, i) };
        let results = run_batch(3, Batch { at_once: 2, fail_fast: false }, work, |_| 99, |_, _| ());
        std::panic::set_hook(hook);
        assert_eq!(results, [Some(0), Some(99), Some(2)]);
    }
}
