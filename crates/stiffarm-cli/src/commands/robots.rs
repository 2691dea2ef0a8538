//! `stiffarm robots`: lists robots, and hands on what is asked of some.

use stiffarm_ask::ask::robots::answer;
use stiffarm_ask::ask::{AskError, Context, forms, selection};
use stiffarm_ask::figures::FigureSize;
use stiffarm_ask::request::Request;

use super::data_sheet::{self, DataSheet};
use crate::args::RobotsAction;
use crate::common::Common;
use crate::failure::Failure;
use crate::output::Outputs;

pub(crate) fn run(action: &RobotsAction, common: &Common) -> Result<(), Failure> {
    match action {
        RobotsAction::Show { robot, width_mm } => show(robot, *width_mm, common),
        RobotsAction::Check { files } => super::check::run(files, common),
        RobotsAction::Import(args) => super::import::run(args, common),
    }
}

pub(crate) fn listed(words: &[String], asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, forms(asked))?;
    outputs.deliver(&answer(words, asked)?)
}

fn show(robot: &str, width_mm: Option<f64>, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open(common, data_sheet::FORMS)?;
    outputs.deliver(&data_sheet_of(robot, width_mm, common.context())?)
}

/// What is known of one robot.
pub(crate) fn data_sheet_of(robot: &str, width_mm: Option<f64>, context: Context) -> Result<DataSheet, AskError> {
    Ok(DataSheet(selection::robot(robot, context)?, FigureSize { width_mm, scale: None }))
}
