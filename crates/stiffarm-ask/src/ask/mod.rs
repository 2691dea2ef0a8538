//! A question and its sources go in, one answer comes out: [`ask`].
//!
//! A file a verb: a [`Request`] to a call of [`stiffarm`], and what it found as an [`Answer`], which is shown in every form it has. Whoever
//! asks says where names lead ([`Sources`](crate::sources::Sources)) and listens while it takes ([`Listener`]).

pub mod by_tool;
pub mod calibrate;
pub mod chatter;
pub mod compare;
pub mod compliance;
mod context;
mod drawing;
pub mod force;
pub mod identify;
pub mod map;
pub mod measure;
pub mod mill;
pub mod modes;
pub mod modes_over;
mod outputs;
pub mod path;
pub mod path_ranking;
pub mod place;
pub mod rank;
mod reports;
pub mod robots;
pub mod selection;
mod sketch;
pub mod study;
pub mod verify;

pub use context::{Context, Listener};

pub use crate::error::AskError;
use crate::forms::{Answer, Form, Forms};
use crate::request::{Request, Verb};

/// An answer, or why there is none.
type Answered<'a> = Result<Box<dyn Answer + 'a>, AskError>;

/// Who answers a kind of question, and in which forms.
struct Answerer {
    answer: for<'a> fn(&'a Request, Context<'a>) -> Answered<'a>,
    forms: Forms,
}

/// A function of a verb's module, and what it makes.
macro_rules! by {
    ($answer:path, $forms:expr) => {
        Answerer { answer: |asked, context| Ok(Box::new($answer(asked, context)?)), forms: $forms }
    };
}

/// By the verb, and by what is asked of it where that has several kinds of answer.
fn answerer(asked: &Request) -> Answerer {
    match asked.verb {
        Verb::Rank => by!(rank::answer, rank::FORMS),
        Verb::Place => by!(place::answer, place::FORMS),
        Verb::Map => by!(map::answer, map::FORMS),
        Verb::Compliance => by!(compliance::answer, compliance::FORMS),
        Verb::Modes if asked.swings_over_zone() => by!(modes_over::answer, modes_over::FORMS),
        Verb::Modes => by!(modes::answer, modes::FORMS),
        Verb::Chatter => by!(chatter::answer, chatter::FORMS),
        Verb::Study => by!(study::answer, study::FORMS),
        Verb::Compare => by!(compare::answer, compare::FORMS),
        Verb::Identify => by!(identify::answer, identify::FORMS),
        Verb::Measure if asked.plans_geometry() => by!(measure::geometry, measure::FORMS),
        Verb::Measure => by!(measure::answer, measure::FORMS),
        Verb::Calibrate => by!(calibrate::answer, calibrate::FORMS),
        Verb::Verify if asked.is_of_any_robot() => by!(verify::of_any, verify::FORMS_OF_ANY),
        Verb::Verify => by!(verify::answer, verify::FORMS),
        Verb::Mill if asked.is_dry() => by!(path::answer, path::FORMS),
        Verb::Mill if asked.ranks_on_path() => by!(path_ranking::answer, path_ranking::FORMS),
        Verb::Mill if asked.mills_by_tool() => by!(by_tool::answer, by_tool::FORMS),
        Verb::Mill => by!(mill::answer, mill::FORMS),
        Verb::Force => by!(force::answer, force::FORMS),
        Verb::List => by!(robots::all, robots::FORMS),
    }
}

/// The answer to a question.
///
/// # Errors
/// Where there is none: what is named is not there or has faults, what is asked makes no sense, or nobody waits any longer.
pub fn ask<'a>(asked: &'a Request, context: Context<'a>) -> Result<Box<dyn Answer + 'a>, AskError> {
    (answerer(asked).answer)(asked, context)
}

/// That a form can be made of what is asked, as far as that is known before it is answered.
///
/// # Errors
/// Why not, where it is known that it cannot.
pub fn check_form(asked: &Request, form: Form) -> Result<(), AskError> {
    if asked.verb == Verb::Mill { mill::check_form(asked, form) } else { Ok(()) }
}

/// In which forms a question is answered, before it is.
pub fn forms(asked: &Request) -> Forms {
    answerer(asked).forms
}
