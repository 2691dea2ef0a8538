//! With what a question is asked: where names lead, and who waits.

use std::borrow::Cow;
use std::path::Path;

use stiffarm::catalogue::measurements::{Measurements, Points};
use stiffarm::catalogue::readings::{self, Notation, Readings};
use stiffarm::catalogue::{Faults, ProcessFile, files, read_process_beside};
use stiffarm::chatter::{MeasuredTip, read_response};
use stiffarm::watch::{Stopped, Watch};

use crate::answer::{TipFile, fixed};
use crate::error::AskError;
use crate::request::{Request, opt};
use crate::sources::Sources;

/// Who waits for an answer.
pub trait Listener: Sync {
    /// Hears something beside the answer that may be left out: how something was understood.
    fn remark(&self, text: &str);

    /// Hears what must not be missed.
    fn warn(&self, text: &str);

    /// Has a work done, and may hear how far it is. Called on the thread that asks; `work` must be called once.
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
    /// Is advice given on what would keep a tolerance? It takes some placements more.
    pub advises: bool,
}

impl Context<'_> {
    /// Has a work done, and lets the listener hear how far it is.
    pub(super) fn watched<T>(&self, doing: &'static str, work: impl FnOnce(Watch) -> T) -> T {
        let (mut work, mut found) = (Some(work), None);
        self.listener.watch(doing, &mut |watch| found = work.take().map(|work| work(watch)));
        found.expect("a listener has the work done once")
    }
}

/// What to do about a file with faults, of each kind.
pub(super) const PROCESS_FILE: &str = "docs/examples/endmill.toml is a complete process file to compare with";
const MEASUREMENTS: &str = "every fault is named with its row and column; `stiffarm identify --help` lists the columns";
const READINGS: &str =
    "every fault is named with its row and column; --columns NAME=HEADING says what a table calls its columns";
const RESPONSE: &str =
    "expected is displacement over force in m/N along the tool axes, as analysers export a receptance; or its modes";

/// A file with faults.
pub(super) fn faulty(faults: &Faults, hint: &'static str) -> AskError {
    AskError::Unanswered { why: faults.to_string(), hint }
}

/// What a process file says, and what the files say that it names beside itself.
pub(super) fn process_of(name: &str, shown: &str, context: Context) -> Result<ProcessFile, AskError> {
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
    onto_input.map_or(read.map_err(|faults| faulty(&faults, PROCESS_FILE)), Err)
}

/// What is asked of a zone, under the force of its process where one is given.
pub(super) fn under_process<'a>(asked: &'a Request, context: Context) -> Result<Cow<'a, Request>, AskError> {
    let Some(name) = asked.given_process() else { return Ok(Cow::Borrowed(asked)) };
    let read = process_of(&name, &files::shown(Path::new(&name)), context)?;
    for remark in &read.assumed {
        context.listener.remark(&format!("note: {remark}"));
    }
    let under = asked.under(&read.process)?;
    let force = read.process.force().map_err(|error| asked.refused(opt::PROCESS, error.to_string()))?;
    let moment = force.moment;
    if moment != 0.0 {
        context.listener.remark(&format!(
            "note: {name}: its mean moment about the tool axis, {} N m, is left out of a zone; along a path `mill` counts it",
            fixed(moment, 2)
        ));
    }
    Ok(Cow::Owned(under))
}

/// What was measured at a tip, where that is given.
pub(super) fn tip_of(asked: &Request, context: Context) -> Result<Option<TipFile>, AskError> {
    let Some((name, held_by)) = asked.frf() else { return Ok(None) };
    let (text, file) = (context.sources.text(&name)?, files::shown(Path::new(&name)));
    let found = read_response(&text, &file, held_by).map_err(|faults| faulty(&faults, RESPONSE))?;
    let remarks = found.remarks.iter().map(|remark| format!("{file}: {remark}")).collect();
    Ok(Some(TipFile { tip: MeasuredTip { held_by, response: found.response }, file, remarks }))
}

/// A table of measurements, made or planned, and its name as it is shown.
pub(super) fn table_of(
    name: &str,
    (asked, context): (&Request, Context),
    read: fn(&str, &str, &Points) -> Result<Measurements, Faults>,
) -> Result<(Measurements, String), AskError> {
    let (text, shown) = (context.sources.text(name)?, files::shown(Path::new(name)));
    let found = read(&text, &shown, &asked.points()).map_err(|faults| faulty(&faults, MEASUREMENTS))?;
    Ok((found, shown))
}

/// Readings of an arm of this maker, and the name of their table as it is shown.
pub(super) fn readings_of(vendor: &str, (asked, context): (&Request, Context)) -> Result<(Readings, String), AskError> {
    let name = asked.data()?;
    let (text, shown) = (context.sources.text(&name)?, files::shown(Path::new(&name)));
    let found = readings::read(&text, &shown, &asked.reading(vendor)).map_err(|faults| faulty(&faults, READINGS))?;
    for remark in &found.remarks {
        context.listener.remark(&format!("note: {shown}: {remark}"));
    }
    // Of the others the headings say which angles they are.
    if let Some(notation @ (Notation::FixedXyz | Notation::TurnedXyz)) = found.notation {
        context.listener.remark(&format!("note: {shown}: the orientation is read as {}", notation.about()));
    }
    Ok((found, shown))
}
