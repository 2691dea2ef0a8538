//! `stiffarm modes`: how the arm swings at one posture.

use std::io::{self, Write};

use stiffarm::modes::modes;
use stiffarm_ask::answer::{ModesAnswer, Rows};
use stiffarm_ask::request::Request;

use super::compliance::remarks;
use crate::common::Common;
use crate::failure::Failure;
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty};
use crate::selection;
use crate::table::{prose, shown};

pub(crate) fn run(asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<ModesOutput>(common)?;
    outputs.deliver(&answer(asked, common)?)
}

pub(super) fn answer(asked: &Request, common: &Common) -> Result<ModesOutput, Failure> {
    let robot = asked.equipped(selection::robot(&asked.robot()?, common)?)?;
    let (joints_deg, tool, damping) = (asked.joints_deg()?, asked.held_tool()?, asked.damping());
    let radians = joints_deg.map(f64::to_radians);
    let swing = modes(&robot, &radians, &tool, damping).map_err(Failure::Modes)?;
    remarks(&robot, [&joints_deg, &radians], common);
    Ok(ModesOutput(ModesAnswer { robot, joints_deg, tool, damping, count: asked.mode_count(), swing }))
}

pub(super) struct ModesOutput(ModesAnswer);

impl Answer for ModesOutput {
    const COMMAND: &'static str = "modes";

    fn text(&self, look: Look) -> String {
        format!("{}\n{}", shown(&self.0.table(), look), prose(&self.0.notes(), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.json())
    }

    fn rows(&self) -> Rows<'_> {
        self.0.rows()
    }
}
