//! Where do the numbers of robots come from? A part of every report.

use stiffarm::answer::words::{class, statuses};
use stiffarm::answer::{Table, stiffness};
use stiffarm::robot::Robot;

use super::{Block, Section};

/// Status, stiffness and every source of one robot.
pub(super) fn sources(robot: &Robot) -> Vec<Block> {
    let mut table = Table::new(["what", "where from"]);
    table.row(["status".to_owned(), class(robot)]);
    table.row(["stiffness".to_owned(), stiffness(robot)]);
    for (what, source) in &robot.source {
        table.row([what.clone(), source.clone()]);
    }
    vec![Block::Heading("Sources".into()), Block::Table(super::Listing { table, is_sortable: false })]
}

/// The same of several, a row each, with what their status means.
pub(super) fn provenance<'a>(robots: impl Iterator<Item = &'a Robot> + Clone) -> Section {
    let mut section = Section::new("Where the numbers come from");
    let mut table = Table::new(["robot", "status", "stiffness", "geometry"]);
    for robot in robots.clone() {
        let source = robot.source.get("geometry").map_or("-", String::as_str);
        table.row([robot.full_name(), class(robot), stiffness(robot), source.to_owned()]);
    }
    section.table(table);
    section.notes(statuses(robots).lines());
    section
}
