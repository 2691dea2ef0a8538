//! `stiffarm chatter`: does a cut swing with the arm, and how deep may it go?

use std::io::{self, Write};
use std::path::Path;

use stiffarm::catalogue::files;
use stiffarm::chatter::chatter;
use stiffarm_ask::answer::{ChatterAnswer, Rows};
use stiffarm_ask::request::Request;

use super::compliance::remarks;
use super::process_of;
use crate::common::Common;
use crate::failure::Failure;
use crate::figures::{Plate, lobes};
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty};
use crate::selection;
use crate::table::{prose, shown};

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<ChatterOutput>(common)?;
    outputs.deliver(&answer(asked, common)?)
}

pub(super) fn answer(asked: &Request, common: &Common) -> Result<ChatterOutput, Failure> {
    let robot = asked.equipped(selection::robot(&asked.robot()?, common)?)?;
    let (joints_deg, tool, wanted) = (asked.joints_deg()?, asked.held_tool()?, asked.chatter()?);
    let name = asked.process()?;
    let file = files::shown(Path::new(&name));
    let process = process_of(&name, &file, common)?;
    let radians = joints_deg.map(f64::to_radians);
    let found = chatter(&robot, &radians, &tool, &process.process, &wanted)
        .map_err(|error| Failure::Chatter { file: file.clone(), error })?;
    remarks(&robot, [&joints_deg, &radians], common);
    let answer = ChatterAnswer { robot, joints_deg, tool, file, process, chatter: found };
    Ok(ChatterOutput(answer, Plate::of(asked)?))
}

pub(super) struct ChatterOutput(ChatterAnswer, Plate);

impl Answer for ChatterOutput {
    const COMMAND: &'static str = "chatter";
    const FURTHER: &'static [&'static str] = &["svg", "png", "pdf"];

    fn text(&self, look: Look) -> String {
        format!("{}\n{}", shown(&self.0.table(), look), prose(&self.0.notes(), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }

    fn svg(&self) -> Option<Result<String, Failure>> {
        Some(Ok(lobes::svg(&self.0, &self.1)))
    }

    fn plate(&self) -> Plate {
        self.1
    }
}
