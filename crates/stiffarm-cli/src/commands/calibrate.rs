//! `stiffarm calibrate`: measured points to a robot file that knows how this very arm differs from its drawing.

use std::path::Path;

use serde_json::Value;
use stiffarm::calibrate::{CalibrateOptions, calibrate};
use stiffarm::catalogue::files;
use stiffarm::catalogue::readings::{self, ReadOptions};
use stiffarm_ask::answer::{CalibrateAnswer, Rows};
use stiffarm_ask::ask::{AskError, Listener, selection};
use stiffarm_ask::date::today;

use crate::args::CalibrateArgs;
use crate::common::Common;
use stiffarm_ask::forms::{Answer, Forms, Piece, sheet};

use crate::failure::Failure;
use crate::output::Outputs;
use crate::progress::watched;
use stiffarm_ask::figures::{Plate, calibrate as figure};

pub(crate) fn run(args: &CalibrateArgs, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, FORMS)?;
    let answer = answer(args, common)?;
    outputs.deliver(&answer)
}

fn answer(args: &CalibrateArgs, common: &Common) -> Result<CalibrateOutput, Failure> {
    let robot = selection::robot(&args.robot, common.context())?;
    let data = files::shown(Path::new(&args.points));
    let reading =
        ReadOptions { columns: args.columns.clone(), frame_by: args.frame_by.clone(), vendor: robot.vendor.clone() };
    let readings = readings::read(&common.sources.text(&args.points)?, &data, &reading).map_err(Failure::Readings)?;
    for remark in &readings.remarks {
        common.remark(&format!("note: {data}: {remark}"));
    }
    if robot.calibration.is_some() {
        common.remark("note: the [calibration] of the robot file is not a start: the arm as drawn is");
    }
    let options = CalibrateOptions { level: args.level.0, at: args.at, controller: args.controller_model };
    let found = watched("calibrating", common, |watch| calibrate(&robot, &readings, &options, watch));
    let found = found.map_err(|error| Failure::Calibrate { data: data.clone(), error })?;
    for row in &found.wrong_rows {
        let which = if row.point == 0 { "all points".into() } else { format!("point {}", row.point) };
        common.remark(&format!("warning: {data}:{}: {which} {:.2} mm off, left out", row.line, row.distance * 1e3));
    }
    let date = args.date.clone().unwrap_or_else(today);
    let answer = CalibrateAnswer { found, robot, data, date, is_chosen: args.level.0.is_none() };
    Ok(CalibrateOutput { answer, plate: Plate { width_mm: args.width_mm, scale: None } })
}

struct CalibrateOutput {
    answer: CalibrateAnswer,
    plate: Plate,
}

/// In which forms it is shown.
const FORMS: Forms = Forms { further: &["toml", "svg", "png", "pdf"], ..Forms::of("calibrate") };

impl Answer for CalibrateOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        sheet([self.answer.summary(), self.answer.table()], self.answer.notes())
    }

    fn value(&self) -> Value {
        self.answer.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn robot_file(&self) -> Option<String> {
        Some(self.answer.robot_file())
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        Some(Ok(figure::svg(&self.answer, &self.plate)))
    }

    fn plate(&self) -> Plate {
        self.plate
    }
}
