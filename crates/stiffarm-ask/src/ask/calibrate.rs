//! `stiffarm calibrate`: measured points to a robot file that knows how this very arm differs from its drawing.

use serde_json::Value;
use stiffarm::calibrate::calibrate;

use super::context::{Context, readings_of};
use crate::answer::{CalibrateAnswer, Rows};
use crate::date::today;
use crate::error::AskError;
use crate::figures::{Plate, calibrate as figure};
use crate::forms::{Answer, Forms, Piece, sheet};
use crate::request::Request;

pub(crate) fn answer(asked: &Request, context: Context) -> Result<CalibrateOutput, AskError> {
    let robot = super::selection::robot(&asked.robot()?, context)?;
    let (readings, data) = readings_of(&robot.vendor, (asked, context))?;
    if robot.calibration.is_some() {
        context.listener.remark("note: the [calibration] of the robot file is not a start: the arm as drawn is");
    }
    let options = asked.calibration();
    let found = context.watched("calibrating", |watch| calibrate(&robot, &readings, &options, watch));
    let found = found.map_err(|error| AskError::Calibrate { data: data.clone(), error })?;
    for row in &found.wrong_rows {
        let which = if row.point == 0 { "all points".into() } else { format!("point {}", row.point) };
        let off = row.distance * 1e3;
        context.listener.warn(&format!("warning: {data}:{}: {which} {off:.2} mm off, left out", row.line));
    }
    let date = asked.date().unwrap_or_else(today);
    let answer = CalibrateAnswer { found, robot, data, date, is_chosen: options.level.is_none() };
    Ok(CalibrateOutput(answer, Plate::of(asked)?))
}

pub(crate) struct CalibrateOutput(CalibrateAnswer, Plate);

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { further: &["toml", "svg", "png", "pdf"], ..Forms::of("calibrate") };

impl Answer for CalibrateOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        sheet([self.0.summary(), self.0.table()], self.0.notes())
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn robot_file(&self) -> Option<Result<String, AskError>> {
        Some(Ok(self.0.robot_file()))
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(figure::svg(&self.0, &self.1)))
    }

    fn plate(&self) -> Plate {
        self.1
    }
}
