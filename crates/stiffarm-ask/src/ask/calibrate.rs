//! `stiffarm calibrate`: measured points to a robot file that knows how this very arm differs from its drawing.

use serde_json::Value;
use stiffarm::calibrate::calibrate;

use super::context::{Context, readings_of};
use super::reports::{self, Inputs};
use crate::answer::{CalibrateAnswer, Headline, Rows};
use crate::date::today;
use crate::error::AskError;
use crate::figures::{FigureSize, calibrate as figure};
use crate::forms::{Answer, Forms, Makes, Picture, Piece, tables_and_notes};
use crate::report::Report;
use crate::request::Request;

/// What to do where points tell nothing.
const MEASURE_MORE: &str = "forty postures that move every joint through its range, three points each, tell most; docs/verify.md tells what to look at";

pub(crate) fn answer<'a>(asked: &'a Request, context: Context) -> Result<CalibrateOutput<'a>, AskError> {
    let robot = super::selection::robot(&asked.robot()?, context)?;
    let (readings, data) = readings_of(&robot.vendor, (asked, context))?;
    if robot.calibration.is_some() {
        context.listener.remark("note: the [calibration] of the robot file is not a start: the arm as drawn is");
    }
    let options = asked.calibration();
    let found = context.watched("calibrating", |watch| calibrate(&robot, &readings, &options, watch));
    let found = found.map_err(|error| AskError::unanswered(&data, error, MEASURE_MORE))?;
    for row in &found.wrong_rows {
        let which = if row.point == 0 { "all points".into() } else { format!("point {}", row.point) };
        let off = row.distance * 1e3;
        context.listener.warn(&format!("warning: {data}:{}: {which} {off:.2} mm off, left out", row.line));
    }
    let date = asked.date().unwrap_or_else(today);
    let answer = CalibrateAnswer { found, robot, data, date, is_chosen: options.level.is_none() };
    if let Some(moved) = answer.moved() {
        context.listener.warn(&format!("warning: {}: {moved}", answer.data));
    }
    Ok(CalibrateOutput { answer, asked, inputs: Inputs::of(asked, context), figure_size: FigureSize::of(asked)? })
}

pub(crate) struct CalibrateOutput<'a> {
    answer: CalibrateAnswer,
    asked: &'a Request,
    inputs: Inputs,
    figure_size: FigureSize,
}

/// In which forms it is shown.
pub(crate) const FORMS: Forms =
    Forms { command: "calibrate", makes: &[Makes::RobotFile, Makes::Picture(Picture::Figure), Makes::Report] };

impl Answer for CalibrateOutput<'_> {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let tables = [Some(self.answer.summary()), Some(self.answer.table()), self.answer.drives()];
        tables_and_notes(tables.into_iter().flatten(), self.answer.notes())
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn robot_file(&self) -> Option<Result<String, AskError>> {
        Some(Ok(self.answer.robot_file()))
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(figure::svg(&self.answer, &self.figure_size)))
    }

    fn headline(&self) -> Option<Headline> {
        Some(self.answer.headline())
    }

    fn report(&self) -> Option<Result<Report, AskError>> {
        Some(reports::calibrate::of(&self.answer, self.figure_size, (self.asked, &self.inputs)))
    }

    fn figure_size(&self) -> FigureSize {
        self.figure_size
    }
}
