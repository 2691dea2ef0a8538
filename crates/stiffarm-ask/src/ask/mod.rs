//! A question and its sources go in, one answer comes out: [`ask`].
//!
//! A file a verb: a [`Request`] to a call of [`stiffarm`], and what it found as an [`Answer`], which is shown in every form it has. Whoever
//! asks says where names lead ([`Sources`]) and listens while it takes ([`Listener`]).

pub mod by_tool;
pub mod chatter;
pub mod compare;
pub mod compliance;
mod drawing;
mod error;
pub mod force;
pub mod identify;
pub mod map;
pub mod measure;
pub mod mill;
pub mod modes;
pub mod path;
pub mod path_ranking;
pub mod place;
pub mod rank;
pub mod robots;
pub mod selection;
pub mod study;

use std::borrow::Cow;
use std::path::Path;

use stiffarm::catalogue::measurements::{Measurements, Points};
use stiffarm::catalogue::{Faults, ProcessFile, files, read_process_beside};
use stiffarm::watch::{Stopped, Watch};

pub use error::AskError;

use crate::forms::{Answer, Forms};
use crate::request::{Request, Verb};
use crate::sources::Sources;

/// Who waits for an answer.
pub trait Listener: Sync {
    /// Hears something beside the answer that may be left out: how something was understood.
    fn remark(&self, text: &str);

    /// Hears what must not be missed.
    fn warn(&self, text: &str);

    /// Has a work done, and may be told how far it is. Called on the thread that asks; `work` must be called once.
    fn watch(&self, doing: &'static str, work: &mut dyn FnMut(Watch));

    /// Is an answer still wanted? Asked between short works.
    ///
    /// # Errors
    /// Where it is not.
    fn go_on(&self) -> Result<(), Stopped>;
}

/// With what a question is asked.
#[derive(Clone, Copy)]
pub struct Context<'a> {
    /// Where names lead.
    pub sources: &'a Sources,
    /// Who waits.
    pub listener: &'a dyn Listener,
    /// Into how many samples a path may be cut.
    pub most_samples: usize,
}

impl Context<'_> {
    /// Has a work done, of which the listener is told how far it is.
    fn watched<T>(&self, doing: &'static str, work: impl FnOnce(Watch) -> T) -> T {
        let (mut work, mut found) = (Some(work), None);
        self.listener.watch(doing, &mut |watch| found = work.take().map(|work| work(watch)));
        found.expect("a listener has the work done once")
    }
}

/// The answer to a question.
///
/// # Errors
/// Where there is none: what is named is not there or has faults, what is asked makes no sense, or nobody waits any longer.
pub fn ask<'a>(asked: &'a Request, context: Context<'a>) -> Result<Box<dyn Answer + 'a>, AskError> {
    Ok(match asked.verb {
        Verb::Rank => Box::new(rank::answer(asked, context)?),
        Verb::Place => Box::new(place::answer(asked, context)?),
        Verb::Map => Box::new(map::answer(asked, context)?),
        Verb::Compliance => Box::new(compliance::answer(asked, context)?),
        Verb::Modes => Box::new(modes::answer(asked, context)?),
        Verb::Chatter => Box::new(chatter::answer(asked, context)?),
        Verb::Study => Box::new(study::answer(asked, context)?),
        Verb::Compare => Box::new(compare::answer(asked, context)?),
        Verb::Identify => Box::new(identify::answer(asked, context)?),
        Verb::Measure => Box::new(measure::answer(asked, context)?),
        Verb::Mill if asked.is_dry() => Box::new(path::answer(asked, context)?),
        Verb::Mill if asked.ranks_on_path() => Box::new(path_ranking::answer(asked, context)?),
        Verb::Mill if asked.mills_by_tool() => Box::new(by_tool::answer(asked, context)?),
        Verb::Mill => Box::new(mill::answer(asked, context)?),
        Verb::Force => Box::new(force::answer(asked, context)?),
        Verb::List => Box::new(robots::answer(&[], asked)?),
    })
}

/// In which forms a question is answered, before it is.
pub fn forms(asked: &Request) -> Forms {
    match asked.verb {
        Verb::Rank => rank::FORMS,
        Verb::Place => place::FORMS,
        Verb::Map => map::FORMS,
        Verb::Compliance => compliance::FORMS,
        Verb::Modes => modes::FORMS,
        Verb::Chatter => chatter::FORMS,
        Verb::Study => study::FORMS,
        Verb::Compare => compare::FORMS,
        Verb::Identify => identify::FORMS,
        Verb::Measure => measure::FORMS,
        Verb::Mill if asked.is_dry() => path::FORMS,
        Verb::Mill if asked.ranks_on_path() => path_ranking::FORMS,
        Verb::Mill if asked.mills_by_tool() => by_tool::FORMS,
        Verb::Mill => mill::FORMS,
        Verb::Force => force::FORMS,
        Verb::List => robots::FORMS,
    }
}

/// What a process file says, and what the files say that it names beside itself.
fn process_of(name: &str, shown: &str, context: Context) -> Result<ProcessFile, AskError> {
    let mut onto_input = None;
    let mut beside = |other: &str| {
        let path = files::beside(Path::new(name), other);
        context.sources.text(&path.to_string_lossy()).map(Cow::into_owned).map_err(|error| {
            let said = error.to_string();
            // No fault of the file, but of what is asked beside it.
            onto_input = Some(error).filter(|error| matches!(error, AskError::OntoInput(_)));
            said
        })
    };
    let read = read_process_beside(&context.sources.text(name)?, shown, &mut beside);
    onto_input.map_or(read.map_err(AskError::ProcessFile), Err)
}

/// What is asked of a zone, under the force of its process where one is given.
fn under_process<'a>(asked: &'a Request, context: Context) -> Result<Cow<'a, Request>, AskError> {
    let Some(name) = asked.given_process() else { return Ok(Cow::Borrowed(asked)) };
    let read = process_of(&name, &files::shown(Path::new(&name)), context)?;
    for remark in &read.assumed {
        context.listener.remark(&format!("note: {remark}"));
    }
    Ok(Cow::Owned(asked.under(&read.process)?))
}

/// A table of measurements, made or planned, and its name as it is shown.
fn table_of(
    name: &str,
    (asked, context): (&Request, Context),
    read: fn(&str, &str, &Points) -> Result<Measurements, Faults>,
) -> Result<(Measurements, String), AskError> {
    let (text, shown) = (context.sources.text(name)?, files::shown(Path::new(name)));
    let found = read(&text, &shown, &asked.points()).map_err(AskError::Measurements)?;
    Ok((found, shown))
}
