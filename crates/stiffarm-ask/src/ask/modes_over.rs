//! `stiffarm modes --task`: how the arm swings over a zone at one place.

use serde_json::Value;
use stiffarm::modes::modes_over;
use stiffarm::place::{Placed, place};

use super::context::Context;
use super::reports::{self, Inputs};
use crate::answer::{Headline, ModesOverAnswer, Rows};
use crate::error::AskError;
use crate::forms::{Answer, Forms, Makes, Piece};
use crate::report::Report;
use crate::request::Request;

pub(crate) fn answer<'a>(asked: &'a Request, context: Context) -> Result<ModesOverOutput<'a>, AskError> {
    let robot = asked.equipped(super::selection::robot(&asked.robot()?, context)?)?;
    let ((task, options), tool, kind) = (asked.swinging_zone()?, asked.held_tool()?, asked.model());
    stiffarm::modes::SwingingArm::new(&robot, &tool).map_err(AskError::Modes)?;
    let failure = |error| AskError::Place { robot: robot.name.clone(), error };
    let model = kind.of(&robot).map_err(|error| failure(error.into()))?;
    let placed = context.watched("placing the zone", |watch| place(&model, &task.work.into(), &options, watch));
    let best = match placed.map_err(failure)? {
        Placed::Feasible(best) => best,
        Placed::Infeasible { reason, .. } => {
            return Err(AskError::NoPlace { robot: robot.name.clone(), task: task.label, reason: reason.into() });
        }
    };
    let over = modes_over(&model, task.work, &options, &best, &tool).map_err(AskError::Modes)?;
    let answer = ModesOverAnswer { robot, task, options, best, tool, count: asked.mode_count(), over };
    Ok(ModesOverOutput { answer, asked, inputs: Inputs::of(asked, context) })
}

pub(crate) struct ModesOverOutput<'a> {
    answer: ModesOverAnswer,
    asked: &'a Request,
    inputs: Inputs,
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "modes", makes: &[Makes::Report] };

impl Answer for ModesOverOutput<'_> {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.answer.table()), Piece::Break, Piece::Lines(self.answer.notes())]
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::modes::over(&self.answer, (self.asked, &self.inputs)))
    }
}
