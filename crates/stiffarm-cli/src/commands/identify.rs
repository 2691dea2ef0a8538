//! `stiffarm identify`: measured deflections to a robot file that says how well it is known.

use std::io::{self, Write};

use stiffarm::catalogue::measurements;
use stiffarm::identify::identify;
use stiffarm_ask::answer::{IdentifyAnswer, Rows};
use stiffarm_ask::request::Request;

use super::watched;
use crate::common::Common;
use crate::failure::Failure;
use crate::figures::{Plate, identify as figure};
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty};
use crate::report::{self, Inputs, Report};
use crate::selection;
use crate::table::sheet;

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<IdentifyOutput>(common)?;
    outputs.deliver(&answer(asked, common)?)
}

pub(super) fn answer<'a>(asked: &'a Request, common: &Common) -> Result<IdentifyOutput<'a>, Failure> {
    let robot = selection::robot(&asked.robot()?, common)?;
    let (measured, data) = super::table_of(&asked.data()?, (asked, common), measurements::read)?;
    let options = asked.identification();
    let found = watched("identifying", common, |watch| identify(&robot, &measured, &options, watch));
    let found = found.map_err(|error| Failure::Identify { data: data.clone(), error })?;
    found.remarks.iter().for_each(|remark| common.remark(&format!("warning: {remark}")));
    let answer = IdentifyAnswer { found, before: robot, data, date: options.date };
    Ok(IdentifyOutput { answer, asked, inputs: Inputs::of(asked, common), plate: Plate::of(asked)? })
}

pub(crate) struct IdentifyOutput<'a> {
    pub(crate) answer: IdentifyAnswer,
    asked: &'a Request,
    pub(crate) inputs: Inputs,
    pub(crate) plate: Plate,
}

impl Answer for IdentifyOutput<'_> {
    const COMMAND: &'static str = "identify";
    const IS_REPORTED: bool = true;
    const FURTHER: &'static [&'static str] = &["toml", "svg", "png", "pdf"];

    fn text(&self, look: Look) -> String {
        let answer = &self.answer;
        let tables = [Some(answer.summary()), Some(answer.table()), answer.updated()];
        sheet(&tables.into_iter().flatten().collect::<Vec<_>>(), &answer.notes(), look)
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.answer.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.answer.rows()
    }

    fn robot_file(&self) -> Option<String> {
        Some(self.answer.robot_file())
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(Ok(figure::svg(&self.answer, &self.plate)))
    }

    fn report(&self) -> Option<Result<Report, Failure>> {
        Some(report::identify::of(self, self.asked))
    }

    fn plate(&self) -> Plate {
        self.plate
    }
}
