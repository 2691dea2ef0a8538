//! A row per robot, for people.

use stiffarm::place::Placement;
use stiffarm::rank::{Ranking, Row};
use stiffarm::robot::Status;

use super::super::words::{self, fixed};
use super::super::{Table, margins};
use super::RankAnswer;

/// Who is best at a task.
pub(super) struct Leading<'a> {
    /// Of those whose geometry is published.
    published: Option<&'a Row>,
    /// Of all.
    of_all: Option<&'a Row>,
    /// Who may be as good as the first.
    rivals: Vec<&'a Row>,
}

impl RankAnswer {
    /// What a place counts along: in a cell, where the work may stand at any bearing, along the axes of that.
    pub(super) fn axes(&self) -> &'static [&'static str] {
        if self.options.cell.is_some() { &["x in the cell", "y", "z"] } else { &["x", "z"] }
    }

    /// Where a zone stands along these, m.
    pub(super) fn centre(&self, best: &Placement) -> Vec<String> {
        let at = match &self.options.cell {
            Some(cell) => best.in_cell(cell).to_vec(),
            None => best.centre.to_vec(),
        };
        at.into_iter().map(|metres| fixed(metres, 3)).collect()
    }

    /// Of several tasks: the columns that tell where each stands.
    pub fn place_headings(&self) -> Vec<String> {
        self.ranking.tasks.iter().map(|task| format!("{} at [m, deg]", task.label)).collect()
    }

    /// For people: one row per robot.
    pub fn table(&self) -> Table {
        let Ranking { tasks, rows, in_plane, .. } = &self.ranking;
        let mut headings: Vec<String> = ["#", "robot", "architecture", "status"].map(Into::into).into();
        if in_plane.is_none() {
            headings.push("bound".into());
        }
        headings.extend(tasks.iter().map(|task| task.label.clone()));
        let axes = self.axes();
        let places: Vec<String> = match tasks.as_slice() {
            [_] => axes.iter().map(|axis| format!("{axis} [m]")).chain(["margin [deg]".into()]).collect(),
            _ => self.place_headings(),
        };
        let is_several = 1 < tasks.len();
        let mut spare = vec!["bound", "mean ratio"];
        if is_several {
            spare.extend(places.iter().map(String::as_str));
        }
        spare.extend(["status", "architecture"]);
        headings.extend(places.iter().cloned());
        headings.push("mean ratio".into());
        if in_plane.is_some() {
            headings.push("planar #".into());
        }
        let mut table = Table::new(headings).with_room(2, &spare);
        let leading: Vec<Leading> = (0..tasks.len()).map(|task| self.leading(task)).collect();
        for (at, row) in rows.iter().enumerate() {
            let robot = &row.robot;
            let estimated = robot.status == Status::Estimated;
            let rank = |row: Option<&Row>| match row {
                Some(Row { rank: Some(rank), .. }) => rank.to_string(),
                _ if estimated => "~".into(),
                Some(row) if row.is_judged() => "-".into(),
                _ => "n/a".into(),
            };
            let mut cells = vec![
                rank(Some(row)),
                format!("{}{}", robot.full_name(), if estimated { " ~" } else { "" }),
                words::architecture(robot),
                words::status(robot).into(),
            ];
            if in_plane.is_none() {
                cells.push(row.floor.map_or_else(|| "n/a".to_owned(), |floor| fixed(floor * 1e3, 3)));
            }
            cells.extend((0..tasks.len()).map(|task| self.cell(at, task, &leading[task])));
            for best in (0..tasks.len()).map(|task| row.placement(task)) {
                match best {
                    None if is_several => cells.push("-".into()),
                    None => cells.extend(vec!["-".to_owned(); axes.len() + 1]),
                    Some(best) if is_several => {
                        let at = axes.iter().zip(self.centre(best)).map(|(axis, metres)| format!("{axis} {metres}"));
                        cells.push(format!("{}; {}", at.collect::<Vec<_>>().join(", "), smallest_margin(best)));
                    }
                    Some(best) => cells.extend(self.centre(best).into_iter().chain([smallest_margin(best)])),
                }
            }
            cells.push(row.mean_ratio.map_or_else(|| "-".into(), |ratio| fixed(ratio, 3)));
            cells.extend(in_plane.as_ref().map(|planar| rank(planar.row_of(robot))));
            table.row(cells);
        }
        table
    }

    pub(super) fn leading(&self, task: usize) -> Leading<'_> {
        let (published, of_all) = (self.best_published(task), self.best(task, |_| true));
        Leading { published, of_all, rivals: self.rivals(task) }
    }

    /// `1.234`, marked when it is the best of its column or may be as good, with verdict, margin and probability where a tolerance is given.
    pub(super) fn cell(&self, at: usize, task: usize, leading: &Leading) -> String {
        let row = &self.ranking.rows[at];
        let Some(deflection) = row.deflection(task) else {
            return match &row.cells[task] {
                Ok(_) => "-".into(),
                Err(error) if error.is_not_of_the_plane() => "n/a".into(),
                Err(_) => "?".into(),
            };
        };
        let is = |best: Option<&Row>| best.is_some_and(|best| best.robot == row.robot);
        let Leading { published, of_all, rivals } = leading;
        let beats = row.robot.status == Status::Estimated && is(*of_all) && published.is_some();
        let mark = match (is(*published), beats) {
            (true, _) => "*",
            (false, true) => "~",
            (false, false) if rivals.iter().any(|rival| rival.robot == row.robot) => "=",
            (false, false) => "",
        };
        // As on a path: who collides or may not carry it passes nothing.
        let judged = match self.verdict(at, task) {
            Some(verdict) => format!(" {}", verdict.short()),
            None if self.collides(at, task) => " COLLISION".into(),
            None if self.carried(&row.robot).is_exceeded() => " LOAD EXCEEDED".into(),
            None => String::new(),
        };
        format!("{}{mark}{judged}", fixed(deflection * 1e3, 3))
    }
}

/// The smallest margin of a place, deg, with what it is of.
fn smallest_margin(best: &Placement) -> String {
    best.smallest_margin()
        .map_or_else(|| "-".into(), |(least, of)| format!("{} {}", fixed(least.to_degrees(), 1), margins::short(of)))
}
