//! `stiffarm modes --task`: how the arm swings over a zone at one place.

use serde_json::Value;
use stiffarm::modes::modes_over;
use stiffarm::place::{Placed, place_task_watched};

use super::context::Context;
use crate::answer::{ModesOverAnswer, Rows};
use crate::error::AskError;
use crate::forms::{Answer, Forms, Piece};
use crate::request::Request;

pub(crate) fn answer(asked: &Request, context: Context) -> Result<ModesOverOutput, AskError> {
    let robot = asked.equipped(super::selection::robot(&asked.robot()?, context)?)?;
    let ((task, options), tool, kind) = (asked.swinging_zone()?, asked.held_tool()?, asked.model());
    stiffarm::modes::SwingingArm::new(&robot, &tool).map_err(AskError::Modes)?;
    let failure = |error| AskError::Place { robot: robot.name.clone(), error };
    let model = kind.of(&robot).map_err(|error| failure(error.into()))?;
    let placed = context.watched("placing the zone", |watch| place_task_watched(&model, &task, &options, watch));
    let best = match placed.map_err(failure)? {
        Placed::Feasible(best) => best,
        Placed::Infeasible { reason, .. } => {
            return Err(AskError::NoPlace { robot: robot.name.clone(), task: task.label, reason });
        }
    };
    let over = modes_over(&model, task.zone, &options, &best, &tool).map_err(AskError::Modes)?;
    Ok(ModesOverOutput(ModesOverAnswer { robot, task, options, best, tool, count: asked.mode_count(), over }))
}

pub(crate) struct ModesOverOutput(ModesOverAnswer);

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms::of("modes");

impl Answer for ModesOverOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        vec![Piece::Table(self.0.table()), Piece::Break, Piece::Lines(self.0.notes())]
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }
}
