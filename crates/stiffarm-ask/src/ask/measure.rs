//! `stiffarm measure`: which postures and loads to measure, with a certificate.

use crate::answer::{GeometryAnswer, MeasureAnswer, Rows};
use crate::request::{Request, opt};
use serde_json::Value;
use stiffarm::catalogue::measurements;
use stiffarm::measure::{MeasureError, Options, compare, geometry_plan, over, plan};
use stiffarm::robot::Robot;

use super::context::Context;
use crate::error::AskError;
use crate::figures::{FigureSize, postures};
use crate::forms::{Answer, Forms, Makes, Picture, Piece, tables_and_notes};

/// The robot, what is asked of a plan, and the work in words.
fn prepared(asked: &Request, context: Context) -> Result<(Robot, Options, String), AskError> {
    let robot = asked.equipped(super::selection::robot(&asked.robot()?, context)?)?;
    let mut options = asked.measurement_plan();
    let mut work = "anywhere within the limits".to_owned();
    if asked.is_given(opt::FLAT_TASK) {
        let task = asked.flat_task()?;
        work = format!("{} at its best place, tool down", task.label);
        let tool = asked.tool_pose().tool();
        let found = context.watched("placing", |watch| over(&robot, &tool, task.work, watch));
        options.work = found.map_err(|error| failed(&robot, error))?;
    }
    Ok((robot, options, work))
}

fn failed(robot: &Robot, error: MeasureError) -> AskError {
    const OPTIONS: &str = "--help behind the command tells its options: --loads, --window, --load-mm, --marker-mm";
    AskError::unanswered(&robot.name, error, OPTIONS)
}

pub(crate) fn answer(asked: &Request, context: Context) -> Result<MeasureOutput, AskError> {
    let (robot, options, work) = prepared(asked, context)?;
    let failed = |error: MeasureError| failed(&robot, error);
    let own = asked.compared().map(|name| own_runs(&name, asked, context)).transpose()?;
    let found = context.watched("planning", |watch| plan(&robot, &options, watch)).map_err(failed)?;
    let compared = match own {
        None => None,
        Some((name, runs)) => {
            let compared = context.watched("comparing", |watch| compare(&robot, &options, &runs, watch));
            let (value, efficiency) = compared.map_err(failed)?;
            Some((name, runs.len(), value, efficiency))
        }
    };
    Ok(MeasureOutput(MeasureAnswer { robot, options, work, plan: found, compared }, FigureSize::of(asked)?))
}

/// In which postures an arm is measured to be calibrated.
pub(crate) fn geometry(asked: &Request, context: Context) -> Result<GeometryOutput, AskError> {
    let (robot, options, work) = prepared(asked, context)?;
    let found = context.watched("planning", |watch| geometry_plan(&robot, &options, watch));
    let plan = found.map_err(|error| failed(&robot, error))?;
    Ok(GeometryOutput(GeometryAnswer { robot, options, work, plan }, FigureSize::of(asked)?))
}

/// Postures and loads of a table of one's own; of several markers of one run the first.
fn own_runs(
    name: &str,
    asked: &Request,
    context: Context,
) -> Result<(String, Vec<stiffarm::measure::OwnRun>), AskError> {
    let (planned, shown) = super::context::table_of(name, (asked, context), measurements::read_planned)?;
    Ok((shown, stiffarm::measure::own(&planned)))
}

pub(crate) struct MeasureOutput(MeasureAnswer, FigureSize);

/// In which forms it is shown.
pub(crate) const FORMS: Forms = Forms { command: "measure", makes: &[Makes::Picture(Picture::Figure)] };

impl Answer for MeasureOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let Self(answer, _) = self;
        tables_and_notes([answer.summary(), answer.table()], answer.notes())
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        let title = format!("Postures to measure, {}", self.0.robot.name);
        Some(Ok(postures::svg(&title, &self.0.postures(), &self.1)))
    }

    fn figure_size(&self) -> FigureSize {
        self.1
    }
}

pub(crate) struct GeometryOutput(GeometryAnswer, FigureSize);

impl Answer for GeometryOutput {
    fn forms(&self) -> Forms {
        FORMS
    }

    fn text(&self) -> Vec<Piece> {
        let Self(answer, _) = self;
        tables_and_notes([answer.summary(), answer.table()], answer.notes())
    }

    fn value(&self) -> Value {
        self.0.json()
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, AskError>> {
        let title = format!("Postures to calibrate, {}", self.0.robot.name);
        Some(Ok(postures::svg(&title, &self.0.postures(), &self.1)))
    }

    fn figure_size(&self) -> FigureSize {
        self.1
    }
}
