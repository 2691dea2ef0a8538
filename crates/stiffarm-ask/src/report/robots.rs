//! Where do the numbers of robots come from? A part of every report.

use crate::answer::words::{class, statuses};
use crate::answer::{Table, stiffness};
use stiffarm::robot::Robot;

use super::Section;

/// Status, stiffness and every source of one robot.
fn sources(robot: &Robot) -> Table {
    let mut table = geometry(robot);
    table.row(["stiffness".to_owned(), stiffness(robot)]);
    table
}

/// Where lengths and limits are from.
fn geometry(robot: &Robot) -> Table {
    let mut table = Table::new(["what", "where from"]);
    table.row(["status".to_owned(), class(robot)]);
    for (what, source) in &robot.source {
        table.row([what.clone(), source.clone()]);
    }
    table
}

/// The drawing of a robot whose drives or errors are found, as a section.
pub(crate) fn drawing_of(robot: &Robot) -> Section {
    let mut section = Section::new("Where the numbers come from");
    section.notes(statuses(std::iter::once(robot)).lines());
    section.heading(robot.full_name());
    section.table(geometry(robot));
    section
}

/// The same as a section.
pub(crate) fn provenance_of(robot: &Robot) -> Section {
    provenance(&[robot], &[])
}

/// Every source of some robots, and of others, a row each, that of their geometry; what their status means.
pub(crate) fn provenance(robots: &[&Robot], others: &[&Robot]) -> Section {
    let mut section = Section::new("Where the numbers come from");
    section.notes(statuses(robots.iter().chain(others).copied()).lines());
    for robot in robots {
        section.heading(robot.full_name());
        section.table(sources(robot));
    }
    if !others.is_empty() {
        section.heading("The others");
        let mut table = Table::new(["robot", "status", "stiffness", "geometry"]);
        for robot in others {
            let geometry = robot.source.get("geometry").map_or("-", String::as_str);
            table.row([robot.full_name(), class(robot), stiffness(robot), geometry.to_owned()]);
        }
        section.table(table);
    }
    section
}
