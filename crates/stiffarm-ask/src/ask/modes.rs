//! `stiffarm modes`: how the arm swings at one posture.

use crate::answer::{Headline, ModesAnswer, Rows};
use crate::request::Request;
use serde_json::Value;
use stiffarm::modes::modes;

use super::compliance::remarks;
use super::context::Context;
use super::reports::{self, Inputs};
use crate::error::AskError;
use crate::figures::{FigureSize, swinging};
use crate::forms::{Answer, Forms, Makes, Picture, Piece};
use crate::report::Report;

pub(crate) fn answer<'a>(asked: &'a Request, context: Context) -> Result<ModesOutput<'a>, AskError> {
    let robot = asked.equipped(super::selection::robot(&asked.robot()?, context)?)?;
    let (joints_deg, tool, damping) = (asked.joints_deg()?, asked.held_tool()?, asked.damping());
    let radians = joints_deg.map(f64::to_radians);
    let swing = modes(&robot, &radians, &tool, damping).map_err(AskError::Modes)?;
    remarks(&robot, &joints_deg, context);
    let answer = ModesAnswer { robot, joints_deg, tool, damping, count: asked.mode_count(), swing };
    Ok(ModesOutput { answer, asked, inputs: Inputs::of(asked, context), figure_size: FigureSize::of(asked)? })
}

pub(crate) struct ModesOutput<'a> {
    answer: ModesAnswer,
    asked: &'a Request,
    inputs: Inputs,
    figure_size: FigureSize,
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "modes", makes: &[Makes::Picture(Picture::Figure), Makes::Report] };

impl Answer for ModesOutput<'_> {
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

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(swinging::svg(&self.answer, &self.figure_size)))
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::modes::of(&self.answer, self.figure_size, (self.asked, &self.inputs)))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
