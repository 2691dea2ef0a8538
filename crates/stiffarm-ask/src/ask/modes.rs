//! `stiffarm modes`: how the arm swings at one posture.

use crate::answer::{ModesAnswer, Rows};
use crate::request::Request;
use serde_json::Value;
use stiffarm::modes::modes;

use super::compliance::remarks;
use super::context::Context;
use crate::error::AskError;
use crate::figures::{Plate, swinging};
use crate::forms::{Answer, Forms, Piece};

pub(crate) fn answer(asked: &Request, context: Context) -> Result<ModesOutput, AskError> {
    let robot = asked.equipped(super::selection::robot(&asked.robot()?, context)?)?;
    let (joints_deg, tool, damping) = (asked.joints_deg()?, asked.held_tool()?, asked.damping());
    let radians = joints_deg.map(f64::to_radians);
    let swing = modes(&robot, &radians, &tool, damping).map_err(AskError::Modes)?;
    remarks(&robot, [&joints_deg, &radians], context);
    let answer = ModesAnswer { robot, joints_deg, tool, damping, count: asked.mode_count(), swing };
    Ok(ModesOutput(answer, Plate::of(asked)?))
}

pub(crate) struct ModesOutput(ModesAnswer, Plate);

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { further: &["svg", "png", "pdf"], ..Forms::of("modes") };

impl Answer for ModesOutput {
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

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(swinging::svg(&self.0, &self.1)))
    }

    fn plate(&self) -> Plate {
        self.1
    }
}
