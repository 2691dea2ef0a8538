//! Who waits for an answer: the one before this terminal, who sees how far a work is, or a client of the server.

use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use stiffarm::watch::{Stopped, Waiting, Watch};
use stiffarm_ask::ask::{Context, Listener};

use crate::common::Common;
use crate::look::say;

impl Common {
    /// With what a question is asked.
    pub(crate) fn context(&self) -> Context<'_> {
        Context { sources: &self.sources, listener: self, most_samples: self.most_samples, advises: true }
    }
}

impl Listener for Common {
    fn remark(&self, text: &str) {
        if !self.quiet {
            self.warn(text);
        }
    }

    fn warn(&self, text: &str) {
        match &self.client {
            Some(client) => client.remark(text),
            None => say(text),
        }
    }

    fn watch(&self, doing: &'static str, work: &mut dyn FnMut(Watch)) {
        watched(doing, self, work);
    }

    fn go_on(&self) -> Result<(), Stopped> {
        self.client.as_ref().map_or(Watch::nobody(), |client| Watch::of(client.as_ref())).go_on()
    }
}

/// A progress bar on stderr: nothing where stderr is no terminal, or quiet is asked for.
pub(crate) fn progress(length: usize, doing: &'static str, common: &Common) -> ProgressBar {
    if common.quiet || common.client.is_some() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::stderr_with_hz(10));
    bar.with_style(style("{msg} {bar:32} {pos}/{len} {eta}")).with_message(doing)
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("a fixed template")
}

/// Shows on stderr how much of a work is done, or, where it does not say how much of it is left, for how long it has been going on;
/// nothing where stderr is no terminal, or quiet is asked for. A signal ends the program: only for a client is work ever stopped.
pub(crate) fn watched<T>(doing: &'static str, common: &Common, work: impl FnOnce(Watch) -> T) -> T {
    if let Some(client) = &common.client {
        client.begins(doing);
        return work(Watch::of(client.as_ref()));
    }
    let bar = progress(1, doing, common);
    if bar.is_hidden() {
        return work(Watch::nobody());
    }
    let known = bar.style();
    let bar = bar.with_style(style("{spinner} {msg} {elapsed}"));
    let shown = Shown { bar: &bar, known, is_known: Once::new() };
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
        let found = work(Watch::of(&shown));
        drop(end);
        if let Ok(ticking) = ticking {
            ticking.thread().unpark();
        }
        found
    })
}

/// Puts on a bar how far a work is.
struct Shown<'a> {
    bar: &'a ProgressBar,
    /// How it looks once it is known how much there is to do.
    known: ProgressStyle,
    is_known: Once,
}

impl Waiting for Shown<'_> {
    fn is_wanted(&self) -> bool {
        true
    }

    fn progress(&self, done: usize, total: Option<usize>) {
        if let Some(total) = total {
            self.is_known.call_once(|| {
                self.bar.set_length(total as u64);
                self.bar.set_style(self.known.clone());
            });
            self.bar.update(|state| state.set_pos(state.pos().max(done as u64)));
        }
    }
}

/// Ends the progress of a work, also of one that panics.
struct Ended<'a>(&'a AtomicBool);

impl Drop for Ended<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Relaxed);
    }
}
