//! `stiffarm robots`: lists robots, and hands on what is asked of some.

use std::io::{self, Write};

use serde_json::Value;
use stiffarm::catalogue;
use stiffarm::robot::Robot;
use stiffarm_ask::answer::Rows;
use stiffarm_ask::answer::robot::{list, notes, sheet, table};
use stiffarm_ask::request::Request;

use super::sheet::Sheet;
use crate::args::RobotsAction;
use crate::common::Common;
use crate::failure::Failure;
use crate::figures::Plate;
use crate::look::Look;
use crate::output::{Answer, Outputs, pretty};
use crate::selection;
use crate::table::{prose, shown};

pub(crate) fn run(action: &RobotsAction, common: &Common) -> Result<(), Failure> {
    match action {
        RobotsAction::Show { robot, width_mm } => show(robot, *width_mm, common),
        RobotsAction::Check { files } => super::check::run(files, common),
        RobotsAction::Import(args) => super::import::run(args, common),
        RobotsAction::Verify(args) => super::verify::run(args, common),
    }
}

pub(crate) fn listed(words: &[String], asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<List>(common)?;
    outputs.deliver(&list_of(words, asked)?)
}

/// Those of the catalogue that have these words in their names and what is asked.
pub(crate) fn list_of(words: &[String], asked: &Request) -> Result<List, Failure> {
    Ok(List(selection::keep(catalogue::robots(), asked, words)?))
}

fn show(robot: &str, width_mm: Option<f64>, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<Sheet>(common)?;
    outputs.deliver(&sheet_of(robot, width_mm, common)?)
}

/// What is known of one robot.
pub(crate) fn sheet_of(robot: &str, width_mm: Option<f64>, common: &Common) -> Result<Sheet, Failure> {
    Ok(Sheet(selection::robot(robot, common)?, Plate { width_mm, scale: None }))
}

pub(crate) struct List(Vec<Robot>);

impl Answer for List {
    const COMMAND: &'static str = "robots list";

    fn text(&self, look: Look) -> String {
        format!("{}\n{}", shown(&table(&self.0), look), prose(&notes(&self.0), look))
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.iter().map(sheet).collect::<Value>())
    }

    fn rows(&self) -> Rows<'_> {
        list(&self.0)
    }
}
