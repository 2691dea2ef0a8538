//! `stiffarm robots`: lists robots, and hands on what is asked of some.

use std::io::{self, Write};
use std::path::Path;

use serde_json::Value;
use stiffarm::answer::robot::{floor, list, sheet};
use stiffarm::answer::words::{ASSUMED_ARCHITECTURE, architecture};
use stiffarm::answer::{Rows, Table};
use stiffarm::catalogue;
use stiffarm::plane::PlanarArm;
use stiffarm::request::Request;
use stiffarm::robot::{Robot, Status};

use super::sheet::Sheet;
use crate::args::{Common, RobotsAction};
use crate::failure::Failure;
use crate::output::{Answer, Outputs, pretty};
use crate::selection;
use crate::table::{fixed_or_dash, shown};

pub(crate) fn run(action: &RobotsAction, common: &Common) -> Result<(), Failure> {
    match action {
        RobotsAction::Show { robot } => show(robot, common),
        RobotsAction::Check { files } => super::check::run(files, common),
        RobotsAction::Import(args) => super::import::run(args, common),
    }
}

pub(crate) fn listed(words: &[String], asked: &Request, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<List>(common, &[])?;
    outputs.deliver(&List(selection::keep(catalogue::robots(), asked, words)?))
}

fn show(robot: &str, common: &Common) -> Result<(), Failure> {
    let outputs = Outputs::open::<Sheet>(common, &[Path::new(robot)])?;
    outputs.deliver(&Sheet(selection::robot(robot, common)?))
}

struct List(Vec<Robot>);

impl List {
    /// `12 robots of 2 makers`.
    fn count(&self) -> String {
        let robots = self.0.len();
        let mut makers: Vec<&str> = self.0.iter().map(|robot| robot.vendor.as_str()).collect();
        makers.dedup(); // the list is in their order
        let of = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
        format!("{} of {}", of(robots, "robot"), of(makers.len(), "maker"))
    }

    fn notes(&self) -> String {
        let any = |holds: fn(&Robot) -> bool| self.0.iter().any(holds);
        let mut notes = String::new();
        if any(|robot| robot.architecture_is_assumed) {
            notes += ASSUMED_ARCHITECTURE;
        }
        if any(|robot| robot.status == Status::Derived) {
            notes += "derived: partly from published figures of the same or a sister model\n";
        }
        if any(|robot| robot.status == Status::Estimated) {
            notes += "estimated: lengths or limits partly assumed, see `stiffarm robots show NAME`\n";
        }
        notes + "bound: compliance at the stiffest posture of the links, with the joint compliances of the robot file\n"
    }
}

impl Answer for List {
    const COMMAND: &'static str = "robots list";

    fn text(&self, markdown: bool) -> String {
        let mut table = Table::new([
            "vendor",
            "robot",
            "architecture",
            "status",
            "payload kg",
            "reach m",
            "l2 m",
            "l3 m",
            "l3/l2",
            "bound um/N",
        ]);
        for robot in &self.0 {
            let arm = robot.two_links().ok().map(|plane| plane.arm);
            let of_arm = |value: fn(&PlanarArm) -> f64| fixed_or_dash(arm.as_ref().map(value), 3);
            table.row([
                robot.vendor.clone(),
                robot.name.clone(),
                architecture(robot),
                robot.status.to_string(),
                robot.payload_kg.map_or_else(|| "-".into(), |kg| kg.to_string()),
                fixed_or_dash(robot.reach, 3),
                of_arm(|arm| arm.l2),
                of_arm(|arm| arm.l3),
                of_arm(|arm| arm.l3 / arm.l2),
                fixed_or_dash(floor(robot), 3),
            ]);
        }
        format!("{}\n{}\n{}", shown(&table, markdown), self.count(), self.notes())
    }

    fn json(&self, out: &mut dyn Write) -> io::Result<()> {
        pretty(out, &self.0.iter().map(sheet).collect::<Value>())
    }

    fn rows(&self) -> Rows<'_> {
        list(&self.0)
    }
}
