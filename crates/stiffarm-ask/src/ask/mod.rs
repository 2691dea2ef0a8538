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
use crate::forms::{Answer, Forms};
use crate::request::{Request, Verb};

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
        Verb::Modes if asked.swings_over_zone() => Box::new(modes_over::answer(asked, context)?),
        Verb::Modes => Box::new(modes::answer(asked, context)?),
        Verb::Chatter => Box::new(chatter::answer(asked, context)?),
        Verb::Study => Box::new(study::answer(asked, context)?),
        Verb::Compare => Box::new(compare::answer(asked, context)?),
        Verb::Identify => Box::new(identify::answer(asked, context)?),
        Verb::Measure if asked.plans_geometry() => Box::new(measure::geometry(asked, context)?),
        Verb::Measure => Box::new(measure::answer(asked, context)?),
        Verb::Calibrate => Box::new(calibrate::answer(asked, context)?),
        Verb::Verify if asked.is_of_any_robot() => Box::new(verify::of_any(asked, context)?),
        Verb::Verify => Box::new(verify::answer(asked, context)?),
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
        Verb::Modes if asked.swings_over_zone() => modes_over::FORMS,
        Verb::Modes => modes::FORMS,
        Verb::Chatter => chatter::FORMS,
        Verb::Study => study::FORMS,
        Verb::Compare => compare::FORMS,
        Verb::Identify => identify::FORMS,
        Verb::Measure => measure::FORMS,
        Verb::Calibrate => calibrate::FORMS,
        Verb::Verify if asked.is_of_any_robot() => verify::FORMS_OF_ANY,
        Verb::Verify => verify::FORMS,
        Verb::Mill if asked.is_dry() => path::FORMS,
        Verb::Mill if asked.ranks_on_path() => path_ranking::FORMS,
        Verb::Mill if asked.mills_by_tool() => by_tool::FORMS,
        Verb::Mill => mill::FORMS,
        Verb::Force => force::FORMS,
        Verb::List => robots::FORMS,
    }
}
