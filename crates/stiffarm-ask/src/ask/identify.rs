//! `stiffarm identify`: measured deflections to a robot file that says how well it is known.

use crate::answer::{Headline, IdentifyAnswer, Rows};
use crate::request::Request;
use serde_json::Value;
use stiffarm::catalogue::measurements;
use stiffarm::identify::identify;

use super::context::Context;
use super::reports::{self, Inputs};
use crate::error::AskError;
use crate::figures::{FigureSize, identify as figure};
use crate::forms::{Answer, Forms, Makes, Picture, Piece, tables_and_notes};
use crate::report::Report;

/// What to do where measurements tell nothing.
const MEASURE: &str = "`stiffarm measure ROBOT` tells which postures and loads to measure";

pub(crate) fn answer<'a>(asked: &'a Request, context: Context) -> Result<IdentifyOutput<'a>, AskError> {
    let robot = super::selection::robot(&asked.robot()?, context)?;
    let (measured, data) = super::context::table_of(&asked.data()?, (asked, context), measurements::read)?;
    let options = asked.identification();
    let found = context.watched("identifying", |watch| identify(&robot, &measured, &options, watch));
    let found = found.map_err(|error| AskError::unanswered(&data, error, MEASURE))?;
    found.remarks.iter().for_each(|remark| context.listener.remark(&format!("warning: {remark}")));
    let answer = IdentifyAnswer { found, before: robot, data, date: options.date };
    Ok(IdentifyOutput { answer, asked, inputs: Inputs::of(asked, context), figure_size: FigureSize::of(asked)? })
}

pub(crate) struct IdentifyOutput<'a> {
    answer: IdentifyAnswer,
    asked: &'a Request,
    inputs: Inputs,
    figure_size: FigureSize,
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms =
    Forms { command: "identify", makes: &[Makes::RobotFile, Makes::Picture(Picture::Figure), Makes::Report] };

impl Answer for IdentifyOutput<'_> {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let answer = &self.answer;
        let tables = [Some(answer.summary()), Some(answer.table()), answer.updated()];
        tables_and_notes(tables.into_iter().flatten(), answer.notes())
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn robot_file(&self) -> Option<Result<String, AskError>> {
        let nothing = || AskError::NotIdentified(self.answer.before.name.clone());
        Some(self.answer.robot_file().ok_or_else(nothing))
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(figure::svg(&self.answer, &self.figure_size)))
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::identify::of(&self.answer, self.figure_size, (self.asked, &self.inputs)))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
