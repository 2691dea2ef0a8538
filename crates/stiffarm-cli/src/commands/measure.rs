//! `stiffarm measure`: which postures and loads to measure, with a certificate.

use std::io::{self, Write};

use stiffarm::catalogue::measurements;
use stiffarm::measure::{MeasureError, compare, over, plan};
use stiffarm_ask::answer::{MeasureAnswer, Rows};
use stiffarm_ask::request::Request;

use super::watched;
use crate::common::Common;
use crate::failure::Failure;
use crate::figures::{Plate, postures};
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty};
use crate::selection;
use crate::table::sheet;

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<MeasureOutput>(common)?;
    outputs.deliver(&answer(asked, common)?)
}

pub(super) fn answer(asked: &Request, common: &Common) -> Result<MeasureOutput, Failure> {
    let robot = asked.equipped(selection::robot(&asked.robot()?, common)?)?;
    let failed = |error: MeasureError| Failure::Measure { robot: robot.name.clone(), error };
    let mut options = asked.measurement_plan();
    let mut work = "anywhere within the limits".to_owned();
    if asked.is_given("task") {
        let task = asked.task()?;
        work = format!("{} at its best place, tool down", task.label);
        let tool = asked.held().tool();
        options.work = watched("placing", common, |watch| over(&robot, &tool, task.zone, watch)).map_err(failed)?;
    }
    let own = asked.compared().map(|name| own_runs(&name, asked, common)).transpose()?;
    let found = watched("planning", common, |watch| plan(&robot, &options, watch)).map_err(failed)?;
    let compared = match own {
        None => None,
        Some((name, runs)) => {
            let compared = watched("comparing", common, |watch| compare(&robot, &options, &runs, watch));
            let (value, efficiency) = compared.map_err(failed)?;
            Some((name, runs.len(), value, efficiency))
        }
    };
    Ok(MeasureOutput(MeasureAnswer { robot, options, work, plan: found, compared }, Plate::of(asked)?))
}

/// Postures and loads of a table of one's own; of several markers of one run the first.
fn own_runs(name: &str, asked: &Request, common: &Common) -> Result<(String, Vec<stiffarm::measure::OwnRun>), Failure> {
    let (planned, shown) = super::table_of(name, (asked, common), measurements::read_planned)?;
    Ok((shown, stiffarm::measure::own(&planned)))
}

pub(super) struct MeasureOutput(MeasureAnswer, Plate);

impl Answer for MeasureOutput {
    const COMMAND: &'static str = "measure";
    const FURTHER: &'static [&'static str] = &["svg", "png", "pdf"];

    fn text(&self, look: Look) -> String {
        let Self(answer, _) = self;
        sheet(&[answer.summary(), answer.table()], &answer.notes(), look)
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        let title = format!("Postures to measure, {}", self.0.robot.name);
        Some(Ok(postures::svg(&title, &self.0.postures(), &self.1)))
    }

    fn plate(&self) -> Plate {
        self.1
    }
}
