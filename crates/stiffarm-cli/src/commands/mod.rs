//! One file per verb: arguments to a call of the library, the answer to text, JSON, CSV and figure.

pub(crate) mod by_tool;
pub(crate) mod calibrate;
pub(crate) mod chatter;
pub(crate) mod check;
pub(crate) mod compare;
pub(crate) mod compliance;
mod drawing;
pub(crate) mod force;
pub(crate) mod identify;
pub(crate) mod import;
pub(crate) mod map;
pub(crate) mod measure;
pub(crate) mod mill;
pub(crate) mod modes;
pub(crate) mod paper;
pub(crate) mod path_ranking;
pub(crate) mod place;
pub(crate) mod rank;
pub(crate) mod robots;
mod sheet;
pub(crate) mod shell;
pub(crate) mod study;
pub(crate) mod validate;
pub(crate) mod verify;

use std::borrow::Cow;
use std::path::Path;
use std::sync::Once;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use stiffarm::catalogue::measurements::{Measurements, Points};
use stiffarm::catalogue::{Faults, ProcessFile, files, read_process_beside};
use stiffarm::watch::{Waiting, Watch};
use stiffarm_ask::request::{Request, Verb};

use crate::common::Common;
use crate::failure::Failure;
use crate::output::Told;

/// What a process file says, and what the files say that it names beside itself.
fn process_of(name: &str, shown: &str, common: &Common) -> Result<ProcessFile, Failure> {
    let mut onto_input = None;
    let mut beside = |other: &str| {
        let path = files::beside(Path::new(name), other);
        common.shelf.text(&path.to_string_lossy()).map(Cow::into_owned).map_err(|failure| {
            let told = failure.to_string();
            // No fault of the file, but of what is asked beside it.
            onto_input = Some(failure).filter(|failure| matches!(failure, Failure::OntoInput(_)));
            told
        })
    };
    let read = read_process_beside(&common.shelf.text(name)?, shown, &mut beside);
    onto_input.map_or(read.map_err(Failure::ProcessFile), Err)
}

/// What is asked of a zone, under the force of its process where one is given.
pub(crate) fn under_process<'a>(asked: &'a Request, common: &Common) -> Result<Cow<'a, Request>, Failure> {
    let Some(name) = asked.given_process() else { return Ok(Cow::Borrowed(asked)) };
    let read = process_of(&name, &files::shown(Path::new(&name)), common)?;
    for remark in &read.assumed {
        common.remark(&format!("note: {remark}"));
    }
    Ok(Cow::Owned(asked.under(&read.process)?))
}

/// The answer of a verb, whichever it is.
///
/// # Errors
/// Where there is none.
pub(crate) fn told<'a>(asked: &'a Request, common: &'a Common) -> Result<Box<dyn Told + 'a>, Failure> {
    Ok(match asked.verb {
        Verb::Rank => Box::new(rank::answer(asked, common)?),
        Verb::Place => Box::new(place::answer(asked, common)?),
        Verb::Map => Box::new(map::answer(asked, common)?),
        Verb::Compliance => Box::new(compliance::answer(asked, common)?),
        Verb::Modes => Box::new(modes::answer(asked, common)?),
        Verb::Chatter => Box::new(chatter::answer(asked, common)?),
        Verb::Study => Box::new(study::answer(asked, common)?),
        Verb::Compare => Box::new(compare::answer(asked, common)?),
        Verb::Identify => Box::new(identify::answer(asked, common)?),
        Verb::Measure => Box::new(measure::answer(asked, common)?),
        Verb::Mill if asked.is_dry() => Box::new(mill::surveyed(asked, common)?),
        Verb::Mill if asked.ranks_on_path() => Box::new(mill::ranked(asked, common)?),
        Verb::Mill if asked.mills_by_tool() => Box::new(by_tool::answer(asked, common)?),
        Verb::Mill => Box::new(mill::answer(asked, common)?),
        Verb::Force => Box::new(force::answer(asked, common)?),
        Verb::List => Box::new(robots::list_of(&[], asked)?),
    })
}

/// A progress bar on stderr: nothing where stderr is no terminal, or quiet is asked for.
fn progress(length: usize, doing: &'static str, common: &Common) -> ProgressBar {
    if common.quiet || common.client.is_some() {
        return ProgressBar::hidden();
    }
    let bar = ProgressBar::with_draw_target(Some(length as u64), ProgressDrawTarget::stderr_with_hz(10));
    bar.with_style(style("{msg} {bar:32} {pos}/{len} {eta}")).with_message(doing)
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).expect("a fixed template")
}

/// A table of measurements, made or planned, and its name as it is shown.
fn table_of(
    name: &str,
    (asked, common): (&Request, &Common),
    read: fn(&str, &str, &Points) -> Result<Measurements, Faults>,
) -> Result<(Measurements, String), Failure> {
    let (text, shown) = (common.shelf.text(name)?, files::shown(Path::new(name)));
    let found = read(&text, &shown, &asked.points()).map_err(Failure::Measurements)?;
    Ok((found, shown))
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

/// Puts on a bar what is told.
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

    fn told(&self, done: usize, total: Option<usize>) {
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
