//! What is typed: a question is asked and its answer delivered; and one file for each of the program's own commands.

pub(crate) mod check;
mod data_sheet;
pub(crate) mod import;
pub(crate) mod paper;
pub(crate) mod robots;
pub(crate) mod shell;
pub(crate) mod validate;

use stiffarm_ask::ask::{ask, check_form, forms};
use stiffarm_ask::forms::Form;
use stiffarm_ask::request::Request;

use crate::common::Common;
use crate::failure::Failure;
use crate::look::say;
use crate::output::{Outputs, verdict};

/// Asks a question, and delivers its answer.
pub(crate) fn asked(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, forms(asked))?;
    outputs.forms().try_for_each(|form| check_form(asked, form))?;
    if !(common.quiet || outputs.forms().any(Form::is_picture)) {
        for name in asked.given_of_figures() {
            say(&format!("note: {name} changes figures alone, and none is written; `-o NAME.svg` writes one"));
        }
    }
    let answer = ask(asked, common.context())?;
    let shortfall = answer.shortfall().filter(|_| common.check).map(Failure::NotHeld);
    let no = answer.refusal().map(Failure::from).or(shortfall);
    verdict(outputs.deliver(&*answer), no.map_or(Ok(()), Err))
}
