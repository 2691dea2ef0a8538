//! What stands below a ranking: what the marks mean, and what is odd.

use std::fmt::Write as _;

use super::super::verdict::HOLDS;
use super::super::words::{self, COLUMN};
use super::super::{cell, margins};
use super::RankAnswer;
use stiffarm::mass::GRAVITY;
use stiffarm::place::{Column, PlaceError, Placement};
use stiffarm::rank::{Cell, Ranking, Row};
use stiffarm::robot::Status;

/// A remark names no more robots than this.
pub(super) const MOST_NAMED: usize = 12;

impl RankAnswer {
    /// What stands below the table: what the marks mean, and what is odd.
    pub fn notes(&self) -> String {
        let Ranking { rows, tasks, in_plane, .. } = &self.ranking;
        let mut notes = String::from("* best of the robots whose geometry is published");
        if rows.iter().any(|row| self.is_barred(row)) {
            notes += ", of those that may be taken where there are such";
        }
        if (0..tasks.len()).any(|task| !self.rivals(task).is_empty()) {
            notes += "; = may be as good: its proved bound does not lie above the value of the best";
        }
        if rows.iter().any(|row| row.robot.status == Status::Estimated) {
            notes += "; ~ estimated robot: it cannot win, even where its value is smaller";
        }
        notes += match in_plane {
            None => "; - the zone does not fit (`stiffarm place` says why)\n",
            Some(_) => "; - no place was found (`stiffarm place --model spatial` says why)\n",
        };
        if rows.iter().any(|row| row.rank.is_some_and(|rank| rank.is_tied)) {
            notes += "#: one more than the robots that are certainly better, which their values and the proved bounds decide; = cannot be distinguished from some other by the proof\n";
        }
        notes += margins::SHORT;
        if in_plane.is_some() {
            let worst = if self.ranking.load.is_worst() { "" } else { ", the force in its worst direction" };
            let _ = writeln!(
                notes,
                "planar #: rank in the planar ranking of the same robots and tasks (zones in the arm plane, anywhere{worst})"
            );
        }
        if in_plane.is_some() && tasks.iter().any(|task| task.work.part().is_some()) {
            let _ = writeln!(notes, "n/a in the plane: {}", PlaceError::PartInPlane);
        }
        for row in in_plane.as_ref().map_or(rows, |planar| &planar.rows) {
            if let Some(error) = row.why_not_of_the_plane().filter(|error| **error != PlaceError::PartInPlane) {
                let advice = if in_plane.is_none() { " (--model spatial)" } else { "" };
                let _ = writeln!(notes, "n/a {}: {error}{advice}", row.robot.name);
            }
        }
        let unfinished = |cell: &Cell| cell.as_ref().is_err_and(|error| !error.is_not_of_the_plane());
        if rows.iter().any(|row| row.cells.iter().any(unfinished)) {
            notes += "? the search for a place did not end; `stiffarm place` says between which values\n";
        }
        notes += &self.overloaded();
        notes += &self.below_base();
        notes += &self.in_column();
        if self.tolerance_mm.is_some() {
            let _ = writeln!(
                notes,
                "{HOLDS}\npass: held with P of 95 % or more; pass, not sure: held at the nominal stiffness, with less or with P not known; P: probability over draws of the drive stiffness"
            );
        }
        notes += words::assumed_architecture(rows.iter().map(|row| &row.robot));
        if in_plane.is_none() && self.ranking.load.is_worst() {
            notes += "bound: deflection at the stiffest posture of the links; no placement of any task has less\n";
        }
        notes += &words::statuses(rows.iter().map(|row| &row.robot));
        notes += &self.proof();
        notes += &self.colliding();
        if in_plane.is_some() {
            notes += "clearance (JSON, CSV): links as capsules, those that enclose them where the robot file has such, at the poses of each answer; ";
            notes += &cell::known_about(rows.iter().map(|row| &row.robot), self.options.cell.as_ref());
        }
        notes
    }

    /// Counts the robots of which the force is more than the weight they are sold to carry.
    fn overloaded(&self) -> String {
        let held = self.options.tool_weight.map_or(0.0, |tool| tool.mass) + self.ranking.load.newtons() / GRAVITY;
        let rows = &self.ranking.rows;
        let light = |row: &&Row| row.robot.stiffness_is_assumed && row.robot.payload_kg.is_some_and(|kg| kg < held);
        let count = rows.iter().filter(light).count();
        if count == 0 {
            return String::new();
        }
        let (of, least) = (rows.len(), held.ceil());
        let what = if self.options.tool_weight.is_some() { "tool and force" } else { "this force" };
        format!(
            "{count} of {of} robots are sold for less than {what} ({held:.0} kg), and the 1 urad/(N m) that is assumed on every drive is that of \
             heavy robots: --payload-kg {least}.. leaves them out\n"
        )
    }

    /// Robots with the tasks of which the place is as `odd` says.
    pub(super) fn named(&self, odd: impl Fn(&Row, usize, &Placement) -> bool) -> Option<String> {
        let mut found = Vec::new();
        for row in &self.ranking.rows {
            let tasks: Vec<&str> = (0..row.cells.len())
                .filter(|&task| row.placement(task).is_some_and(|best| odd(row, task, best)))
                .map(|task| self.ranking.tasks[task].label.as_str())
                .collect();
            if !tasks.is_empty() {
                found.push(format!("{} on {}", row.robot.name, tasks.join(", ")));
            }
        }
        let more = found.len().saturating_sub(MOST_NAMED);
        let is_some = !found.is_empty();
        found.truncate(MOST_NAMED);
        let more = if more == 0 { String::new() } else { format!("; and {more} robots more") };
        is_some.then(|| format!("{}{more}", found.join("; ")))
    }

    /// Names the places that lie partly below the base: reached, but rarely meant.
    fn below_base(&self) -> String {
        let named = self.named(|_, _, best| best.outside.is_some_and(|outside| outside.below));
        named.map_or_else(String::new, |names| {
            format!("zones partly below the base (--floor 0 keeps them above): {names}\n")
        })
    }

    /// Names the places in space where most robots have their own base.
    fn in_column(&self) -> String {
        if self.options.margins.column != Column::Radius(0.0) {
            return String::new();
        }
        let named =
            self.named(|_, _, best| best.space().is_some() && best.from_axis_1.is_some_and(|near| near < COLUMN));
        named.map_or_else(String::new, |names| {
            format!(
                "zones within {COLUMN} m of the joint-1 axis, where the robot's own base stands (--clear-of-base-m keeps away): {names}\n"
            )
        })
    }

    /// How far the values in space are from being proved best; in the plane all are.
    fn proof(&self) -> String {
        if self.ranking.in_plane.is_none() {
            return String::new();
        }
        let rows = &self.ranking.rows;
        let placed = || {
            let cells = rows.iter().flat_map(|row| (0..row.cells.len()).map(move |task| (row, task)));
            cells.filter_map(|(row, task)| Some((100.0 * row.placement(task)?.gap(), row)))
        };
        let count = placed().count();
        let near = placed().filter(|(gap, _)| *gap <= 1.0).count();
        let widest = placed().max_by(|a, b| a.0.total_cmp(&b.0));
        let widest = widest
            .map_or_else(String::new, |(gap, row)| format!("; the largest gap is {gap:.1} % ({})", row.robot.name));
        format!("coarse search, then refined; {near} of {count} values proved best to 1 %{widest}\n")
    }
}
