//! Where do the arms of a ranking collide, or may they?

use stiffarm::clearance::Clearance;
use stiffarm::rank::Row;
use stiffarm::task::Task;

use super::super::place::clearance;
use super::super::words::{self, fixed};
use super::RankAnswer;

impl RankAnswer {
    /// How near the arm of a row comes to anything at its place for a task. In the plane that takes longer than the place: all are looked at
    /// once, where somebody asks.
    pub(super) fn clearance(&self, at: usize, task: usize) -> Option<Clearance> {
        let clear = |row: &Row| {
            let of_task = |(cell, task): (usize, &Task)| {
                clearance(&row.robot, (&self.ranking.model, &self.options), task, row.placement(cell)?)
            };
            self.ranking.tasks.iter().enumerate().map(of_task).collect()
        };
        self.clearances.get_or_init(|| self.ranking.rows.iter().map(clear).collect())[at][task]
    }

    /// The arm of a row collides at its place for a task; never in the plane, which has no wrist.
    pub fn collides(&self, at: usize, task: usize) -> bool {
        let in_space = self.ranking.rows[at].placement(task).and_then(|best| best.clearance_in_space);
        in_space.is_some_and(|clearance| clearance.is_collision())
    }

    /// The arm of a row collides at some task.
    pub(super) fn collides_somewhere(&self, row: &Row) -> bool {
        let at = self.at(row);
        (0..row.cells.len()).any(|task| self.collides(at, task))
    }

    /// What the arms of some rows overlap with at some tasks.
    pub(super) fn collisions(&self, rows: &[(&Row, Vec<usize>)]) -> Vec<String> {
        let of = |row: &Row, task: usize| {
            let clearance = self.clearance(self.at(row), task).filter(Clearance::is_collision)?;
            let by = fixed(-clearance.distance * 1e3, 0);
            let between = words::clearance_between(&clearance);
            Some(format!("{} on {}: by {by} mm, {between}", row.robot.name, self.ranking.tasks[task].label))
        };
        rows.iter().flat_map(|(row, tasks)| tasks.iter().filter_map(move |&task| of(row, task))).collect()
    }

    /// Names the places where the arm overlaps with something; nothing where no floor is known in the plane, as in the paper's convention.
    pub(super) fn colliding(&self) -> String {
        if self.ranking.in_plane.is_none() && self.options.margins.floor.is_none() {
            return String::new();
        }
        let where_it = |is: fn(&Clearance) -> bool| {
            self.named(|row, task, _| self.clearance(self.at(row), task).is_some_and(|clearance| is(&clearance)))
        };
        let collide = where_it(Clearance::is_collision)
            .map(|names| format!("COLLISION at the place (`stiffarm place --model spatial` says of what): {names}\n"));
        let may = where_it(Clearance::may_collide).map(|names| {
            format!("may collide at the place, as far as a model without wrist and tool tells (`stiffarm place` says of what, --model spatial knows): {names}\n")
        });
        [collide, may].into_iter().flatten().collect()
    }
}
