//! One file per verb: arguments to a call of the library, the answer to text, JSON, CSV and figure.

pub(crate) mod check;
pub(crate) mod compliance;
mod drawing;
pub(crate) mod identify;
pub(crate) mod import;
pub(crate) mod map;
pub(crate) mod measure;
pub(crate) mod paper;
pub(crate) mod place;
pub(crate) mod rank;
pub(crate) mod robots;
mod sheet;
pub(crate) mod shell;
pub(crate) mod study;
pub(crate) mod validate;

use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

use crate::args::Common;

/// A progress bar on stderr: nothing where stderr is no terminal, or quiet is asked for.
pub(crate) fn progress(length: usize, doing: &'static str, common: &Common) -> ProgressBar {
    if common.quiet {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::stderr_with_hz(10));
    let style = ProgressStyle::with_template("{msg} {bar:32} {pos}/{len} {eta}").expect("a fixed template");
    bar.with_style(style).with_message(doing)
}

/// Shows on stderr for how long a work has been going on that does not say how much of it is left; nothing where stderr
/// is no terminal, or quiet is asked for.
pub(crate) fn waiting<T>(doing: &'static str, common: &Common, work: impl FnOnce() -> T) -> T {
    let bar = progress(1, doing, common);
    if bar.is_hidden() {
        return work();
    }
    let bar = bar.with_style(ProgressStyle::with_template("{spinner} {msg} {elapsed}").expect("a fixed template"));
    let ended = AtomicBool::new(false);
    thread::scope(|scope| {
        let tick = || {
            while !ended.load(Ordering::Relaxed) {
                bar.tick();
                thread::park_timeout(Duration::from_millis(100));
            }
            bar.finish_and_clear();
        };
        // Where the system gives no further thread, there is an answer without progress.
        let ticking = thread::Builder::new().spawn_scoped(scope, tick);
        let end = Ended(&ended);
        let found = work();
        drop(end);
        if let Ok(ticking) = ticking {
            ticking.thread().unpark();
        }
        found
    })
}

/// Ends the progress of a work, also of one that panics.
struct Ended<'a>(&'a AtomicBool);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}
